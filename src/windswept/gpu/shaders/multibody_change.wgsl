// What coupled links carry of placements that change level or slot: levels/carry_over.py on the card.
// Set: motion + rotation + multibody_types, _joint + multibody_change.

@group(0) @binding(0) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(1) var<uniform> coupled: array<Coupled, 800>;   // by rung
@group(0) @binding(2) var<storage, read> rods: array<Rod>;
@group(0) @binding(3) var<storage, read> motions: array<Motion>;
@group(0) @binding(4) var<storage, read> joins: array<u32>;        // how many stand in the tally
@group(0) @binding(5) var<storage, read> shifts: array<Shift>;     // the same
@group(0) @binding(6) var<storage, read> state: array<vec4f>;
@group(0) @binding(7) var<storage, read_write> carried: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> slots: array<vec4f>;
@group(0) @binding(9) var<uniform> tally: vec4u;

fn column_of_slot(rung: u32, slot: u32) -> Column {
    return column_at(rungs[rung], coupled[rung], slot / LANES, slot % LANES);
}

// A workgroup takes one placement that takes another's slot, as in shift_state.wgsl.
@compute @workgroup_size(64)
fn shift_carried(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var k = group.x; k < tally.x; k += spread.x) {
        let moved = shifts[k];
        if !is_coupled(rungs[moved.rung]) { continue; }
        let before = column_of_slot(moved.rung, moved.before);
        let after = column_of_slot(moved.rung, moved.after);
        for (var i = lane; i < CARRIED * after.links; i += 64u) {
            carried[after.carried + i * after.stride] = carried[before.carried + i * before.stride];
        }
    }
}

// One invocation takes a placement that joins a level: its links carry on at the velocities that its joints give them.
@compute @workgroup_size(64)
fn join_carried(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) spread: vec3u) {
    for (var k = id.x; k < tally.y; k += 64u * spread.x) {
        let at = motions[joins[k]].at;
        if !is_coupled(rungs[at.x]) { continue; }
        let column = column_of_slot(at.x, at.y);
        let stride = column.stride;
        var here = GROUND;
        for (var i = 0u; i < column.links; i++) {
            let rod = rods[column.rods + i];
            let link = swung(rod, moving_above(rod, here, column), state[column.state + i * stride], 0.0);
            here = link.moving;
            keep_moving(rod, here, column);
            let kept = column.carried + CARRIED * i * stride;
            carried[kept] = vec4f(here.along, 0.0);
            carried[kept + stride] = vec4f(cross(here.turn, link.direction), 0.0);
        }
    }
}
