// Air velocity at every probe of every placement at both ends of an interval; wind/velocity.py is the same on the CPU.
// Set: motion + air + wind.

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

fn velocity(air: Air, point: vec3f) -> vec2f {
    var sum = air.mean.xy;
    for (var k = 0u; k < air.sources.y; k++) { sum += wave_push(waves[air.sources.x + k], point.xy); }
    for (var k = 0u; k < air.sources.w; k++) { sum += gust_push(gusts[air.sources.z + k], point.xy); }
    return profile_factor(air, point.z - ground_height(air, point.xy)) * sum;
}

fn turned(v: vec2f, cosine_yaw: f32, sine_yaw: f32) -> vec2f {
    return vec2f(cosine_yaw * v.x - sine_yaw * v.y, sine_yaw * v.x + cosine_yaw * v.y);
}

// A workgroup takes a block, a probe and an end: velocity in the plant's frame, and how far leaves fold.
@compute @workgroup_size(64)
fn sample(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        let rung = rungs[block.x];
        if group.y >= rung.probes.y || lane >= block.z { continue; }
        let here = rooted[members[rung.probes.w + block.y * LANES + lane]];
        let probe = probes[rung.probes.x + group.y].xyz;
        let yaw = vec2f(here.position.w, here.heading.x);
        let point = here.position.xyz + vec3f(turned(probe.xy, yaw.x, yaw.y), probe.z);
        let air = velocity(ends[group.z], point);
        let ratio = length(air) / rung.air.x;
        let row = 2u * (block.y * rung.probes.y + group.y) + group.z;
        wind[rung.room.z + row * stride_of(rung) + lane] = vec4f(turned(air, yaw.x, -yaw.y), 0.0, pow(1.0 + ratio * ratio, rung.air.y));
    }
}
