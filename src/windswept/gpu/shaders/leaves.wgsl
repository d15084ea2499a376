// Leaves: two-sided blades that let the sun through. Set: types + light + leaves.
// An instance is a batch of BATCH leaves, each a mesh of VERTICES vertices out of a table with one row a shape.

override VERTICES: u32 = 4u;
const BATCH = 64u;

@group(1) @binding(0) var<storage, read> blade: array<vec4f>;  // position and normal of a unit leaf, shape by shape
@group(1) @binding(1) var<storage, read> posed_leaves: array<PosedLeaf>;
@group(1) @binding(2) var<uniform> looks: array<Look, 544>;
@group(1) @binding(3) var<uniform> batch: Batch;

struct LeafVertex {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) outward: vec3f,
    @location(3) shade: vec4f,   // openness, random number, place across and along the blade
    @location(4) @interpolate(flat) look: u32,
}

struct LitVertex {
    @builtin(position) clip: vec4f,
    @location(0) colour: vec3f,
}

fn blade_row(leaf: PosedLeaf, vertex: u32) -> u32 {
    return 2u * (u32(looks[leaf.rows.x].leaf.w) * VERTICES + vertex % VERTICES);
}

fn blade_point(leaf: PosedLeaf, shape: vec3f) -> vec3f {
    let across = cross(leaf.axis.xyz, leaf.normal.xyz);
    let size = batch.scale.x;
    return leaf.position.xyz + size * (shape.y * leaf.position.w * leaf.axis.xyz
        + leaf.axis.w * (shape.x * across + shape.z * leaf.normal.xyz));
}

fn posed_vertex(vertex: u32, instance: u32) -> LeafVertex {
    let item = instance * BATCH + vertex / VERTICES;
    var out: LeafVertex;
    if item >= batch.items.y { return out; }
    let leaf = posed_leaves[batch.items.x + item * batch.items.z];
    let row = blade_row(leaf, vertex);
    let facing = blade[row + 1u].xyz;
    let across = cross(leaf.axis.xyz, leaf.normal.xyz);
    out.world = blade_point(leaf, blade[row].xyz);
    out.clip = frame.view_projection * vec4f(out.world, 1.0);
    out.normal = facing.x * across + facing.y * leaf.axis.xyz + facing.z * leaf.normal.xyz;
    out.outward = leaf.outward.xyz;
    out.shade = vec4f(leaf.normal.w, leaf.outward.w, blade[row].xy);
    out.look = leaf.rows.x;
    return out;
}

// Linear colour of a leaf seen from its upper face (front) or its lower one.
fn leaf_colour(in: LeafVertex, front: bool) -> vec3f {
    let look = looks[in.look];
    let open = in.shade.x;
    let chance = in.shade.y;
    let to_eye = normalize(frame.eye.xyz - in.world);
    let blade_normal = select(-1.0, 1.0, front) * normalize(in.normal);
    let sun = frame.sun.xyz;

    // A few leaves are yellower, most only lighter or darker than their neighbours.
    let tint = mix(vec3f(1.0), vec3f(1.4, 1.1, 0.75), chance * chance * 0.5) * (0.75 + 0.4 * fract(chance * 17.3));
    let albedo = tint * select(look.back.rgb, look.leaf.rgb, front);
    let through = tint * look.leaf.rgb * vec3f(1.35, 1.25, 0.45);

    let crown_normal = normalize(blade_normal + 0.9 * in.outward);
    let facing = dot(blade_normal, sun);
    let reflected = max(mix(facing, dot(crown_normal, sun), 0.45), 0.0);
    let passed = max(-facing, 0.0);
    let gloss = 0.08 * pow(max(dot(blade_normal, normalize(sun + to_eye)), 0.0), 28.0);
    let lit = sunlight_once(in.world, blade_normal) * (0.5 + 0.5 * open);
    let direct = frame.sun_light.rgb * lit * (albedo * reflected + through * passed + gloss);
    let dim = ambient(crown_normal) * (0.16 + 0.84 * open);
    return direct + dim * (albedo + 0.25 * through);
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> LeafVertex {
    return posed_vertex(vertex, instance);
}

@fragment
fn fragment(in: LeafVertex, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let aside = abs(in.shade.z);
    let midrib = smoothstep(0.035, 0.010, aside);
    let ribs = 0.5 + 0.5 * cos(48.0 * (in.shade.w - 0.9 * aside));
    let veins = 1.0 + 0.22 * midrib - 0.10 * ribs * ribs * smoothstep(0.02, 0.2, aside);
    return finished(leaf_colour(in, front) * veins, in.world);
}

// Leaves of a few pixels are lit at their vertices.
@vertex
fn vertex_lit(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> LitVertex {
    let leaf = posed_vertex(vertex, instance);
    let front = dot(leaf.normal, frame.eye.xyz - leaf.world) > 0.0;
    return LitVertex(leaf.clip, finished(leaf_colour(leaf, front), leaf.world).rgb);
}

@fragment
fn fragment_lit(in: LitVertex) -> @location(0) vec4f {
    return vec4f(in.colour, 1.0);
}

@vertex
fn shadow(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    let item = instance * BATCH + vertex / VERTICES;
    if item >= batch.items.y { return vec4f(0.0); }
    let leaf = posed_leaves[batch.items.x + item * batch.items.z];
    return frame.sun_projection * vec4f(blade_point(leaf, blade[blade_row(leaf, vertex)].xyz), 1.0);
}
