// From joint angles to where every link is, in the rows that curves.wgsl reads; motion/pose_links.py is the same on the
// CPU. Set: motion + rotation + joints + pose_links.

@group(0) @binding(0) var<uniform> kinds: array<Kind, 512>;
@group(0) @binding(1) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(2) var<storage, read> seats: array<vec4u>;   // how many follow; placement, first pose, poses
@group(0) @binding(3) var<storage, read> ranks: array<vec2u>;   // of each kind: link of each rank, rank of each link
@group(0) @binding(4) var<storage, read> links: array<Link>;
@group(0) @binding(5) var<storage, read> listeners: array<vec4u>;
@group(0) @binding(6) var<storage, read> shapes: array<Shape>;
@group(0) @binding(7) var<storage, read> motions: array<Motion>;
@group(0) @binding(8) var<storage, read> state: array<vec4f>;
@group(0) @binding(9) var<storage, read_write> poses: array<vec4f>;   // two rows of LinkPose a link, by rank
@group(0) @binding(10) var<uniform> moment: Moment;

// First pose of a placement, and how many of its ranks are posed: parents come before their children.
struct Seat {
    first: u32,
    count: u32,
}

fn rotation_of(kind: Kind, seat: Seat, link: u32) -> vec4f {
    if link == NONE { return vec4f(0.0, 0.0, 0.0, 1.0); }
    return poses[2u * (seat.first + ranks[kind.joints.w + link].y) + 1u];
}

// Angles of a joint now: rates go on since the last step.
fn angles_at(rung: Rung, column: u32, kind: Kind, link: u32, seat: Seat, q_parent: vec4f) -> vec2f {
    let stride = stride_of(rung);
    let listener = listeners[rung.probes.z + link];
    if listener.x != NONE {
        let joint = state[column + listener.x * stride];
        return joint.xz + moment.time.y * joint.yw;
    }
    let row = column + (rung.links.y + 2u * listener.y) * stride;
    let u = state[row].xyz + moment.time.y * state[row + stride].xyz;
    let q_carrier = rotation_of(kind, seat, listener.z);
    return shaped(shapes[kind.joints.w + link], felt(q_parent, q_carrier, u), kind.size.y);
}

// Share of the new level in a blend, smooth in value and slope.
fn share_of(motion: Motion) -> f32 {
    let passed = f32(moment.steps.x - motion.at.z) + moment.time.y / moment.time.z;
    let x = clamp(passed / f32(moment.counts.w), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

// Notes the angles of all joints as a level has them, in its own rotations, over what is noted already.
fn note_angles(rung: Rung, slot: u32, seat: Seat, share: f32) {
    let kind = kinds[rung.links.w];
    let column = state_row(rung, slot);
    for (var rank = 0u; rank < seat.count; rank++) {
        let i = ranks[kind.joints.w + rank].x;
        let link = links[kind.joints.x + i];
        let q_parent = rotation_of(kind, seat, link.rows.x);
        let angles = angles_at(rung, column, kind, i, seat, q_parent);
        let turn = angles.x * link.axis_1.xyz + angles.y * link.axis_2.xyz;
        let row = 2u * (seat.first + rank);
        poses[row] = vec4f(mix(poses[row].xy, angles, share), 0.0, 0.0);
        poses[row + 1u] = multiply(q_parent, from_rotation_vector(turn));
    }
}

// Poses a placement from one level's angles, or from those noted of two.
fn pose_placement(rung: Rung, motion: Motion, seat: Seat, is_noted: bool) {
    let kind = kinds[rung.links.w];
    let column = state_row(rung, motion.at.y);
    var position = vec3f(0.0);
    var rotation = vec4f(0.0, 0.0, 0.0, 1.0);
    var last = NONE;
    for (var rank = 0u; rank < seat.count; rank++) {
        let i = ranks[kind.joints.w + rank].x;
        let link = links[kind.joints.x + i];
        let row = 2u * (seat.first + rank);
        // A link often follows the one before it, whose pose is still at hand.
        if link.rows.x == NONE {
            position = vec3f(0.0);
            rotation = vec4f(0.0, 0.0, 0.0, 1.0);
        } else if link.rows.x != last {
            let parent = 2u * (seat.first + ranks[kind.joints.w + link.rows.x].y);
            position = poses[parent].xyz;
            rotation = poses[parent + 1u];
        }
        var angles = poses[row].xy;
        if !is_noted { angles = angles_at(rung, column, kind, i, seat, rotation); }
        position += rotate(rotation, link.foot.xyz);
        rotation = multiply(rotation, from_rotation_vector(angles.x * link.axis_1.xyz + angles.y * link.axis_2.xyz));
        poses[row] = vec4f(position, 0.0);
        poses[row + 1u] = rotation;
        last = i;
    }
}

fn seat_of(seated: vec4u) -> Seat {
    return Seat(seated.y, seated.z);
}

// One invocation takes a placement that has a seat. If it is between two levels, the angles of both are noted first.
@compute @workgroup_size(64)
fn note_origin(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= seats[0].x { return; }
    let seated = seats[1u + id.x];
    let motion = motions[seated.x];
    if motion.origin.x != NONE { note_angles(rungs[motion.origin.x], motion.origin.y, seat_of(seated), 1.0); }
}

@compute @workgroup_size(64)
fn note_goal(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= seats[0].x { return; }
    let seated = seats[1u + id.x];
    let motion = motions[seated.x];
    if motion.origin.x != NONE { note_angles(rungs[motion.at.x], motion.at.y, seat_of(seated), share_of(motion)); }
}

@compute @workgroup_size(64)
fn pose_seated(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= seats[0].x { return; }
    let seated = seats[1u + id.x];
    let motion = motions[seated.x];
    pose_placement(rungs[motion.at.x], motion, seat_of(seated), motion.origin.x != NONE);
}
