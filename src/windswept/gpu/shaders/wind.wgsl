// Air velocity at every probe of every placement at both ends of an interval; wind/velocity.py is the same on the CPU.
// Set: motion + air + air_grid + wind.

@group(0) @binding(0) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(1) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(2) var<storage, read> members: array<u32>;
@group(0) @binding(3) var<storage, read> rooted: array<Rooted>;
@group(0) @binding(4) var<storage, read> probes: array<vec4f>;
@group(0) @binding(5) var<storage, read> waves: array<Wave>;
@group(0) @binding(6) var<storage, read> gusts: array<Gust>;
@group(0) @binding(7) var<storage, read_write> wind: array<vec4f>;
@group(0) @binding(8) var<uniform> ends: array<Air, 2>;
@group(0) @binding(9) var terrain: texture_2d<f32>;
@group(0) @binding(10) var<storage, read> field_nodes: array<vec4f>;   // what the force field adds to the wind, m/s; 0
@group(0) @binding(11) var<uniform> field_grids: array<AirGrid, 2>;    // at both ends; no nodes where there is no field

fn profile_factor(air: Air, height: f32) -> f32 {
    let z = max(height, 0.0);
    let above = log((max(z, air.profile.z) - air.profile.x) * air.profile.y);
    let below = exp(air.profile.w * (min(z, air.profile.z) / air.profile.z - 1.0));
    return select(below, above, z >= air.profile.z) * air.mean.z;
}

fn ground_height(air: Air, place: vec2f) -> f32 {
    let grid = clamp(place * air.ground.x + air.ground.y, vec2f(0.0), vec2f(air.ground.z + 1.0));
    let cell = min(floor(grid), vec2f(air.ground.z));
    let part = grid - cell;
    let corner = vec2i(cell);
    let south = mix(textureLoad(terrain, corner, 0).x, textureLoad(terrain, corner + vec2i(1, 0), 0).x, part.x);
    let north = mix(
        textureLoad(terrain, corner + vec2i(0, 1), 0).x,
        textureLoad(terrain, corner + vec2i(1, 1), 0).x,
        part.x,
    );
    return mix(south, north, part.y);
}

fn velocity(air: Air, place: vec2f, height: f32) -> vec2f {
    var sum = air.mean.xy;
    for (var k = 0u; k < air.sources.y; k++) { sum += wave_push(waves[air.sources.x + k], place); }
    for (var k = 0u; k < air.sources.w; k++) { sum += gust_push(gusts[air.sources.z + k], place); }
    return profile_factor(air, height) * sum;
}

// Between a node of the field and the one above it.
fn column(node: u32, part: f32) -> vec3f {
    return mix(field_nodes[node].xyz, field_nodes[node + 1u].xyz, part);
}

// What the field adds at x, y and height, trilinear between its nodes; nothing outside (wind/field/sample.py).
fn field_at(grid: AirGrid, place: vec3f) -> vec3f {
    let cells = in_cells(grid, place);
    if any(cells < vec3f(0.0)) || any(cells > last_cells(grid)) { return vec3f(0.0); }
    let cell = cell_of(grid, cells);
    let part = cell.part;
    let beyond = cell.node + cell.along_x;
    let near = mix(column(cell.node, part.z), column(cell.node + cell.along_y, part.z), part.y);
    let far = mix(column(beyond, part.z), column(beyond + cell.along_y, part.z), part.y);
    return mix(near, far, part.x);
}

fn turned(v: vec2f, cosine_yaw: f32, sine_yaw: f32) -> vec2f {
    return vec2f(cosine_yaw * v.x - sine_yaw * v.y, sine_yaw * v.x + cosine_yaw * v.y);
}

// A workgroup takes a block, some of its probes and an end: velocity in the plant's frame, and how far leaves fold.
@compute @workgroup_size(64)
fn sample(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        if lane >= block.z { continue; }
        let rung = rungs[block.x];
        let here = rooted[members[rung.probes.w + block.y * LANES + lane]];
        let yaw = vec2f(here.position.w, here.heading.x);
        for (var p = group.y; p < rung.probes.y; p += spread.y) {
            let probe = probes[rung.probes.x + p].xyz;
            let point = here.position.xyz + vec3f(turned(probe.xy, yaw.x, yaw.y), probe.z);
            let height = max(point.z - ground_height(ends[group.z], point.xy), 0.0);
            let added = field_at(field_grids[group.z], vec3f(point.xy, height));
            let air = vec3f(velocity(ends[group.z], point.xy, height), 0.0) + added;
            let ratio = length(air) / rung.air.x;
            let row = 2u * (block.y * rung.probes.y + p) + group.z;
            let here_now = vec4f(turned(air.xy, yaw.x, -yaw.y), air.z, pow(1.0 + ratio * ratio, rung.air.y));
            wind[rung.room.z + row * stride_of(rung) + lane] = here_now;
        }
    }
}
