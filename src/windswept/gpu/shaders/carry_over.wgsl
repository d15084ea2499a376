// States of placements that change level or slot: levels/carry_over.py on the card.
// Set: motion + rotation + joints + carry_over.

override LONGEST: u32 = 1u;   // links of the largest plant

@group(0) @binding(0) var<uniform> kinds: array<Kind, 512>;
@group(0) @binding(1) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(2) var<storage, read> listeners: array<vec4u>;
@group(0) @binding(3) var<storage, read> shapes: array<Shape>;
@group(0) @binding(4) var<storage, read> links: array<Link>;
@group(0) @binding(5) var<storage, read> motions: array<Motion>;
@group(0) @binding(6) var<storage, read> joins: array<u32>;   // how many stand in the tally
@group(0) @binding(7) var<storage, read_write> state: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> notes: array<vec4f>;   // motion and rotation of every link that joins
@group(0) @binding(9) var<uniform> tally: vec4u;

fn rotation_of(first: u32, link: u32) -> vec4f {
    if link == NONE { return vec4f(0.0, 0.0, 0.0, 1.0); }
    return notes[first + 2u * link + 1u];
}

// Angle and rate about the first axis, then the second, of a joint at the level that it leaves.
fn motion_before(rung: Rung, column: u32, listener: vec4u, shape: Shape, rotations: mat2x4f, limit: f32) -> vec4f {
    let stride = stride_of(rung);
    if listener.x != NONE { return state[column + listener.x * stride]; }
    let row = column + (rung.links.y + 2u * listener.y) * stride;
    let u = felt(rotations[0], rotations[1], state[row].xyz);
    let rate = felt(rotations[0], rotations[1], state[row + stride].xyz);
    let angles = shaped(shape, u, limit);
    return vec4f(
        angles.x,
        dot(slope_of(shape.linear_1.xyz, shape.square_1.xyz, shape.mixed_1.xyz, u, limit), rate),
        angles.y,
        dot(slope_of(shape.linear_2.xyz, shape.square_2.xyz, shape.mixed_2.xyz, u, limit), rate),
    );
}

// One invocation takes a placement that joins a level: notes how all its links move, and lets those go on that are
// stepped there too.
@compute @workgroup_size(64)
fn join(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) spread: vec3u) {
    for (var k = id.x; k < tally.y; k += 64u * spread.x) {
        let placement = joins[k];
        let motion = motions[placement];
        let before = rungs[motion.origin.x];
        let after = rungs[motion.at.x];
        let kind = kinds[after.links.w];
        let first = 2u * k * LONGEST;
        let column = state_row(before, motion.origin.y);
        for (var i = 0u; i < kind.joints.y; i++) {
            let link = links[kind.joints.x + i];
            let listener = listeners[before.probes.z + i];
            let q_parent = rotation_of(first, link.rows.x);
            let rotations = mat2x4f(q_parent, rotation_of(first, listener.z));
            let joint = motion_before(before, column, listener, shapes[kind.joints.w + i], rotations, kind.size.y);
            let turn = joint.x * link.axis_1.xyz + joint.z * link.axis_2.xyz;
            notes[first + 2u * i] = joint;
            notes[first + 2u * i + 1u] = multiply(q_parent, from_rotation_vector(turn));
            let active_link = listeners[after.probes.z + i].x;
            if active_link != NONE { state[state_row(after, motion.at.y) + active_link * stride_of(after)] = joint; }
        }
    }
}
