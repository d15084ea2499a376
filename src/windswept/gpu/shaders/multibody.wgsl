// `multibody` on the card: every link a rigid body, all coupled, for LANES placements a workgroup, one a lane.
// motion/multibody/ is the same on the CPU. Set: motion + rotation + groups + multibody_types, _tensors, _joint, _descend,
// _ascend, _advance + multibody.
//
// Links stand depth first, so most follow their parent: what goes from link to link stays in registers along a stem, and
// passes through a slot of its depth at forks alone. All lanes are at the same link, so no branch parts them. Every walk
// is a dispatch of its own: a software driver leaves the loops of a shader after 65,535 turns in all.

@group(0) @binding(0) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(1) var<uniform> coupled: array<Coupled, 800>;   // by rung
@group(0) @binding(2) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(3) var<storage, read> rods: array<Rod>;
@group(0) @binding(4) var<storage, read> wind: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> state: array<vec4f>;
@group(0) @binding(6) var<storage, read_write> carried: array<vec4f>;
@group(0) @binding(7) var<storage, read_write> records: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> slots: array<vec4f>;
@group(0) @binding(9) var<uniform> moment: Moment;
@group(0) @binding(10) var<storage, read> groups: array<Group>;

// Whether this dispatch walks the rungs that have groups, or those that have none: the latter are spared the loop over a
// link's groups, through whose body a software driver goes once even where there are none.
override LADEN: bool = false;

@compute @workgroup_size(64)
fn descend_block(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let late = (f32(moment.steps.y) + 0.5) / f32(moment.steps.w);
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        let rung = rungs[block.x];
        let meant = is_coupled(rung) && (rung.groups.y > 0u) == LADEN;
        if meant && lane < block.z { descend(column_at(rung, coupled[block.x], block.y, lane), late); }
    }
}

@compute @workgroup_size(64)
fn ascend_block(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        let rung = rungs[block.x];
        if is_coupled(rung) && lane < block.z { ascend(column_at(rung, coupled[block.x], block.y, lane)); }
    }
}

@compute @workgroup_size(64)
fn advance_block(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        let rung = rungs[block.x];
        if is_coupled(rung) && lane < block.z { advance(column_at(rung, coupled[block.x], block.y, lane)); }
    }
}
