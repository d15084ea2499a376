// Blades of the meadow: strips between posed joints, which are lit already. Set: types + blades_types + blades.

const BATCH = 64u;

@group(1) @binding(0) var<storage, read> posed: array<PosedJoint>;
@group(1) @binding(1) var<uniform> meadow_pass: MeadowPass;

struct BladeVertex {
    @builtin(position) clip: vec4f,
    @location(0) colour: vec3f,
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> BladeVertex {
    let vertices = meadow_pass.items.z;
    let item = instance * BATCH + vertex / vertices;
    if item >= meadow_pass.items.y { return BladeVertex(); }
    let corner = vertex % vertices;
    let joint = posed[meadow_pass.items.x + item * (vertices / 2u) + corner / 2u];
    let side = vec3f(unpack2x16snorm(joint.facing.x), unpack2x16snorm(joint.facing.y).x);
    let border = f32(corner % 2u) * 2.0 - 1.0;
    let bits = vec3u(joint.facing.w, joint.facing.w >> 10u, joint.facing.w >> 20u) & vec3u(1023u);
    let lit = vec3f(bits) / 1023.0;
    let world = vec4f(joint.place.xyz + border * joint.place.w * side, 1.0);
    return BladeVertex(frame.view_projection * world, lit * lit);
}

@fragment
fn fragment(in: BladeVertex) -> @location(0) vec4f {
    return vec4f(in.colour, 1.0);
}
