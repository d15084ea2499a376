// Mean speed of the wind in every placement's crown, of the coarser level if two move it. Set: motion + crown.

@group(0) @binding(0) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(1) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(2) var<storage, read> members: array<u32>;
@group(0) @binding(3) var<storage, read> motions: array<Motion>;
@group(0) @binding(4) var<storage, read> wind: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> speeds: array<f32>;

@compute @workgroup_size(64)
fn crown_speed(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        if lane >= block.z { continue; }
        let rung = rungs[block.x];
        let placement = members[rung.probes.w + block.y * LANES + lane];
        let motion = motions[placement];
        let other = select(motion.origin.x, motion.at.x, motion.at.x != block.x);
        if other != NONE && other > block.x { continue; }
        var sum = 0.0;
        for (var probe = 0u; probe < rung.probes.y; probe++) {
            let row = 2u * (block.y * rung.probes.y + probe) + 1u;
            sum += length(wind[rung.room.z + row * stride_of(rung) + lane].xyz);
        }
        speeds[placement] = sum / f32(rung.probes.y);
    }
}
