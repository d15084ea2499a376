// States of members that take another's slot. Set: motion + shift_state.

@group(0) @binding(0) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(1) var<storage, read> shifts: array<Shift>;   // how many stand in the tally
@group(0) @binding(2) var<storage, read_write> state: array<vec4f>;
@group(0) @binding(3) var<uniform> tally: vec4u;

// A workgroup takes one placement. Slots that are filled lie before the new end, those that are emptied behind it.
@compute @workgroup_size(64)
fn shift_state(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var k = group.x; k < tally.x; k += spread.x) {
        let moved = shifts[k];
        let rung = rungs[moved.rung];
        let before = state_row(rung, moved.before);
        let after = state_row(rung, moved.after);
        let rows = rung.links.y + 2u * rung.groups.y;
        let stride = stride_of(rung);
        for (var i = lane; i < rows; i += 64u) { state[after + i * stride] = state[before + i * stride]; }
    }
}
