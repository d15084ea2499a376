// Who is stepped at each level: compact lists of slots, after placements came and went. Set: motion + scan + members.
// `compact` a rung, `settle` a placement, `plan` once, `shift` a placement that takes another's slot. Nothing depends
// on the order in which invocations run: only the places of moves and joins in their lists do.

override MOST_JOINS: u32 = 0xffffffffu;   // that join a level at once: those after them wait for the next time

struct Tally {
    shifts: atomic<u32>,
    joins: atomic<u32>,
    refused: atomic<u32>,   // placements that had to stay where they are: no room at the level given, or not yet their turn
    unused: u32,
}

@group(0) @binding(0) var<uniform> kinds: array<Kind, 512>;
@group(0) @binding(1) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(2) var<storage, read_write> motions: array<Motion>;
@group(0) @binding(3) var<storage, read_write> members: array<u32>;
@group(0) @binding(4) var<storage, read_write> populations: array<u32>;   // members of each rung
@group(0) @binding(5) var<storage, read_write> shifts: array<Shift>;
@group(0) @binding(6) var<storage, read_write> joins: array<u32>;
@group(0) @binding(7) var<storage, read_write> tally: Tally;
@group(0) @binding(8) var<uniform> moment: Moment;

var<workgroup> population: u32;
var<workgroup> shift_first: u32;
var<workgroup> join_first: u32;

fn is_gone(rung: u32, slot: u32) -> bool {
    let motion = motions[members[rungs[rung].probes.w + slot]];
    return motion.origin.z == rung && motion.origin.w == slot;
}

// Members behind the new end take the slots of those that went.
fn list_shifts(rung: u32, lane: u32, run: vec2u, stay: u32) {
    var holes = 0u;
    var tails = 0u;
    for (var slot = run.x; slot < run.y; slot++) {
        let gone = is_gone(rung, slot);
        holes += select(0u, 1u, gone && slot < stay);
        tails += select(0u, 1u, !gone && slot >= stay);
    }
    var hole = sum_before(lane, holes);
    var tail = sum_before(lane, tails);
    if lane == 0u { shift_first = atomicAdd(&tally.shifts, crew_total()); }
    let first = workgroupUniformLoad(&shift_first);
    for (var slot = run.x; slot < run.y; slot++) {
        let gone = is_gone(rung, slot);
        if gone && slot < stay {
            shifts[first + hole].after = slot;
            hole++;
        }
        if !gone && slot >= stay {
            shifts[first + tail].rung = rung;
            shifts[first + tail].before = slot;
            shifts[first + tail].placement = members[rungs[rung].probes.w + slot];
            tail++;
        }
    }
}

fn comes(rung: u32, placement: u32) -> bool {
    let at = motions[placement].at;
    return at.w == 1u && at.x == rung;
}

// Who comes takes the slots behind those that stay, while there is room; gives the number that did.
fn list_joins(rung: u32, lane: u32, stay: u32) -> u32 {
    let kind = kinds[rungs[rung].links.w];
    let run = run_of(lane, kind.ladder.w);
    let room = min(rungs[rung].room.w - stay, MOST_JOINS);
    var count = 0u;
    for (var i = run.x; i < run.y; i++) { count += select(0u, 1u, comes(rung, kind.ladder.z + i)); }
    var place = sum_before(lane, count);
    let joined = min(crew_total(), room);
    if lane == 0u { join_first = atomicAdd(&tally.joins, joined); }
    let first = workgroupUniformLoad(&join_first);
    for (var i = run.x; i < run.y; i++) {
        let placement = kind.ladder.z + i;
        if !comes(rung, placement) { continue; }
        if place < room {
            members[rungs[rung].probes.w + stay + place] = placement;
            motions[placement].at = vec4u(rung, stay + place, motions[placement].at.zw);
            joins[first + place] = placement;
        } else {
            motions[placement].wish.z = 1u;
        }
        place++;
    }
    return joined;
}

@compute @workgroup_size(256)
fn compact(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    if lane == 0u { population = populations[group.x]; }
    let count = workgroupUniformLoad(&population);
    let run = run_of(lane, count);
    var gone = 0u;
    for (var slot = run.x; slot < run.y; slot++) { gone += select(0u, 1u, is_gone(group.x, slot)); }
    _ = sum_before(lane, gone);
    let stay = count - crew_total();
    list_shifts(group.x, lane, run, stay);
    storageBarrier();
    let joined = list_joins(group.x, lane, stay);
    if lane == 0u { populations[group.x] = stay + joined; }
}

// Who was refused is back where it came from; who left has left.
@compute @workgroup_size(64)
fn settle(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= moment.counts.z { return; }
    var motion = motions[id.x];
    if motion.wish.z == 1u {
        motion.at = vec4u(motion.origin.xy, 0u, 0u);
        motion.origin = vec4u(NONE);
        atomicAdd(&tally.refused, 1u);
    }
    motion.at.w = 0u;
    motion.origin = vec4u(motion.origin.xy, NONE, NONE);
    motions[id.x] = motion;
}

// One invocation takes the shift of one placement: members and slots; its state follows in shift_state.wgsl.
@compute @workgroup_size(64)
fn shift(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) spread: vec3u) {
    for (var k = id.x; k < atomicLoad(&tally.shifts); k += 64u * spread.x) {
        let moved = shifts[k];
        members[rungs[moved.rung].probes.w + moved.after] = moved.placement;
        if motions[moved.placement].at.x == moved.rung {
            motions[moved.placement].at.y = moved.after;
        } else {
            motions[moved.placement].origin.y = moved.after;
        }
    }
}
