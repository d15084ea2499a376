// From joint angles to where every link is, in the rows that curves.wgsl reads; motion/pose_links.py is the same on the
// CPU. Set: motion + rotation + joints + pose_links.

@group(0) @binding(0) var<uniform> kinds: array<Kind, 64>;
@group(0) @binding(1) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(2) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(3) var<storage, read> members: array<u32>;
@group(0) @binding(4) var<storage, read> links: array<Link>;
@group(0) @binding(5) var<storage, read> listeners: array<vec4u>;
@group(0) @binding(6) var<storage, read> shapes: array<Shape>;
@group(0) @binding(7) var<storage, read> motions: array<Motion>;
@group(0) @binding(8) var<storage, read> state: array<vec4f>;
@group(0) @binding(9) var<storage, read_write> poses: array<vec4f>;   // two rows of LinkPose a link
@group(0) @binding(10) var<uniform> moment: Moment;

fn rotation_of(first: u32, link: u32) -> vec4f {
    if link == NONE { return vec4f(0.0, 0.0, 0.0, 1.0); }
    return poses[2u * (first + link) + 1u];
}

// Angles of a joint now: rates go on since the last step.
fn angles_at(rung: Rung, column: u32, kind: Kind, link: u32, first: u32, q_parent: vec4f) -> vec2f {
    let stride = stride_of(rung);
    let listener = listeners[rung.probes.z + link];
    if listener.x != NONE {
        let joint = state[column + listener.x * stride];
        return joint.xz + moment.time.y * joint.yw;
    }
    let row = column + (rung.links.y + 2u * listener.y) * stride;
    let u = state[row].xyz + moment.time.y * state[row + stride].xyz;
    return shaped(shapes[kind.joints.w + link], felt(q_parent, rotation_of(first, listener.z), u), kind.size.y);
}

// Share of the new level in a blend, smooth in value and slope.
fn share_of(motion: Motion) -> f32 {
    let passed = f32(moment.steps.x - motion.at.z) + moment.time.y / moment.time.z;
    let x = clamp(passed / f32(moment.counts.w), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

// Notes the angles of all joints as a level has them, in its own rotations, over what is noted already.
fn note_angles(rung: Rung, slot: u32, first: u32, share: f32) {
    let kind = kinds[rung.links.w];
    let column = column_of(rung, slot);
    for (var i = 0u; i < kind.joints.y; i++) {
        let link = links[kind.joints.x + i];
        let q_parent = rotation_of(first, link.rows.x);
        let angles = angles_at(rung, column, kind, i, first, q_parent);
        let turn = angles.x * link.axis_1.xyz + angles.y * link.axis_2.xyz;
        let row = 2u * (first + i);
        poses[row] = vec4f(mix(poses[row].xy, angles, share), 0.0, 0.0);
        poses[row + 1u] = multiply(q_parent, from_rotation_vector(turn));
    }
}

// Poses a placement from one level's angles, or from those noted of two.
fn pose_placement(rung: Rung, motion: Motion, first: u32, is_noted: bool) {
    let kind = kinds[rung.links.w];
    let column = column_of(rung, motion.at.y);
    var position = vec3f(0.0);
    var rotation = vec4f(0.0, 0.0, 0.0, 1.0);
    for (var i = 0u; i < kind.joints.y; i++) {
        let link = links[kind.joints.x + i];
        let row = 2u * (first + i);
        // A link mostly follows the one before it, whose pose is still at hand.
        if link.rows.x == NONE {
            position = vec3f(0.0);
            rotation = vec4f(0.0, 0.0, 0.0, 1.0);
        } else if link.rows.x + 1u != i {
            position = poses[2u * (first + link.rows.x)].xyz;
            rotation = rotation_of(first, link.rows.x);
        }
        var angles = poses[row].xy;
        if !is_noted { angles = angles_at(rung, column, kind, i, first, rotation); }
        position += rotate(rotation, link.foot.xyz);
        rotation = multiply(rotation, from_rotation_vector(angles.x * link.axis_1.xyz + angles.y * link.axis_2.xyz));
        poses[row] = vec4f(position, 0.0);
        poses[row + 1u] = rotation;
    }
}

@compute @workgroup_size(64)
fn pose_block(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        if lane >= block.z { continue; }
        let placement = members[rungs[block.x].probes.w + block.y * LANES + lane];
        let motion = motions[placement];
        // A placement between two levels is posed by the one that it goes to.
        if motion.at.x != block.x { continue; }
        let rung = rungs[block.x];
        let kind = kinds[rung.links.w];
        let first = kind.joints.z + (placement - kind.ladder.z) * kind.joints.y;
        let is_blending = motion.origin.x != NONE;
        if is_blending {
            note_angles(rungs[motion.origin.x], motion.origin.y, first, 1.0);
            note_angles(rung, motion.at.y, first, share_of(motion));
        }
        pose_placement(rung, motion, first, is_blending);
    }
}
