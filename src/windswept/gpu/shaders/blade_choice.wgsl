// Which blades are posed and drawn, with how many sections: gpu/meadow/blade_list.py on the card. Places in lists come
// from sums in the order of the blades, not from the order of arrival, so the same eye gets the same lists.
// Set: scan + blade_choice_types + blade_choice.

const NONE = 0xffffffffu;
const NEAREST = 0.3;       // m
const CHUNK = 128u;
const COARSEST = 2u;       // level
const BATCH = 64u;         // blades in an instance of what is drawn
const MOST_CARRIED = 16u;
const MOST_DEPTH = 8u;     // rows of 3 in `plan`, then rows of 5; the last number is that of all joints
const LAST = 104u;
const GROUP = 64u;         // threads of a workgroup that poses, in rows of ROW threads
const ROW = 65536u;
const STRIDE = 16u;        // rows of `passes` from one pass to the next

@group(0) @binding(0) var<uniform> look: ChoiceLook;
@group(0) @binding(1) var<storage, read> chunks: array<ChunkRow>;     // by depth, then in the order of their blades
@group(0) @binding(2) var<storage, read> members: array<vec2u>;       // of every blade its parent or NONE; bits of its chance
@group(0) @binding(3) var<storage, read_write> seen: array<vec4u>;    // of every chunk level; bits of its share; blades; first item
@group(0) @binding(4) var<storage, read_write> firsts: array<u32>;    // of every chunk its first joint
@group(0) @binding(5) var<storage, read_write> carriers: array<atomic<u32>>;   // of every blade 0 where hidden, 1, or 1 + carrier
@group(0) @binding(6) var<storage, read_write> items: array<vec4u>;
@group(0) @binding(7) var<storage, read_write> plan: array<u32>;
@group(0) @binding(8) var<storage, read_write> passes: array<vec4u>;

var<workgroup> masks: array<atomic<u32>, 4>;

// A lane a chunk: its level, and the share of its blades that is drawn; none where it is out of sight.
@compute @workgroup_size(64)
fn see(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= look.counts.x { return; }
    let chunk = chunks[id.x];
    let away = max(distance(chunk.ball.xyz, look.eye.xyz) - chunk.ball.w, NEAREST);
    let pixels = chunk.size.y * look.eye.w / away;
    let level = select(0u, 1u, pixels < look.rules.y) + select(0u, 1u, pixels < look.rules.z);
    var inside = away < look.rules.w;
    for (var p = 0u; p < 5u; p++) {
        inside = inside && dot(look.planes[p], vec4f(chunk.ball.xyz, 1.0)) > -chunk.ball.w;
    }
    let share = chunk.size.x * look.eye.w / (away * look.rules.x);
    seen[id.x] = vec4u(level, bitcast<u32>(select(0.0, share, inside)), 0u, 0u);
}

fn chunk_of(group: vec3u, spread: vec3u) -> u32 {
    return group.x + group.y * spread.x;
}

// A workgroup a chunk: marks the blades that are drawn, and those on which they hang.
@compute @workgroup_size(128)
fn mark(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let c = chunk_of(group, spread);
    if c >= look.counts.x || lane >= chunks[c].rows.y { return; }
    var blade = chunks[c].rows.x + lane;
    if bitcast<f32>(members[blade].y) >= bitcast<f32>(seen[c].y) { return; }
    for (var carried = 0u; carried < MOST_CARRIED && blade != NONE; carried++) {
        atomicStore(&carriers[blade], 1u);
        blade = members[blade].x;
    }
}

// How many of a chunk's marked blades come before that of a lane, and how many there are.
fn rank_of(c: u32, lane: u32) -> vec2u {
    let chosen = c < look.counts.x && lane < chunks[c].rows.y && atomicLoad(&carriers[chunks[c].rows.x + lane]) != 0u;
    // wgpu 0.32 leaves a workgroup's memory as it finds it, though WGSL clears it.
    if lane < 4u { atomicStore(&masks[lane], 0u); }
    workgroupBarrier();
    if chosen { atomicOr(&masks[lane / 32u], 1u << (lane % 32u)); }
    workgroupBarrier();
    var before = 0u;
    var all = 0u;
    for (var word = 0u; word < 4u; word++) {
        let mask = atomicLoad(&masks[word]);
        let lower = select(mask, mask & ((1u << (lane % 32u)) - 1u), word == lane / 32u);
        before += select(0u, countOneBits(lower), word <= lane / 32u);
        all += countOneBits(mask);
    }
    return vec2u(select(NONE, before, chosen), all);
}

@compute @workgroup_size(128)
fn count(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let c = chunk_of(group, spread);
    let rank = rank_of(c, lane);
    if lane == 0u && c < look.counts.x { seen[c].z = rank.y; }
}

// What is dispatched to pose the items of a depth.
fn plan_poses(depth: u32, first: u32, total: u32) {
    plan[3u * depth] = (min(total, ROW) + GROUP - 1u) / GROUP;
    plan[3u * depth + 1u] = (total + ROW - 1u) / ROW;
    plan[3u * depth + 2u] = 1u;
    passes[STRIDE * depth] = vec4u(first, total, 0u, 0u);
    passes[STRIDE * depth + 1u] = bitcast<vec4u>(look.now);
}

// What is drawn of blades with so many sections, as far as there is room for their joints.
fn plan_draw(row: u32, first: u32, chosen: u32, sections: u32) {
    let total = min(chosen, (max(look.counts.w, first) - first) / (sections + 1u));
    let at = 3u * MOST_DEPTH + 5u * row;
    plan[at] = 6u * sections * min(BATCH, total);
    plan[at + 1u] = (total + BATCH - 1u) / BATCH;
    for (var rest = 2u; rest < 5u; rest++) { plan[at + rest] = 0u; }
    passes[STRIDE * (MOST_DEPTH + row)] = vec4u(first, total, 2u * (sections + 1u), 0u);
    passes[STRIDE * (MOST_DEPTH + row) + 1u] = bitcast<vec4u>(look.now);
}

// First item of every chunk, those on the ground first; what is dispatched for each depth.
fn plan_items(lane: u32, run: vec2u) {
    var first = 0u;
    for (var depth = 0u; depth < look.counts.y; depth++) {
        var own = 0u;
        for (var c = run.x; c < run.y; c++) { own += select(0u, seen[c].z, chunks[c].rows.w == depth); }
        var next = first + sum_before(lane, own);
        let total = crew_total();
        for (var c = run.x; c < run.y; c++) {
            if chunks[c].rows.w == depth {
                seen[c].w = next;
                next += seen[c].z;
            }
        }
        if lane == 0u { plan_poses(depth, first, total); }
        first += total;
    }
}

// First joint of every chunk, those of few sections first; what is drawn for each number of sections.
fn plan_joints(lane: u32, run: vec2u) {
    var first = 0u;
    for (var row = 0u; row < look.counts.z; row++) {
        let sections = look.sections[row / 4u][row % 4u];
        var own = 0u;
        for (var c = run.x; c < run.y; c++) { own += select(0u, seen[c].z, chunks[c].sections[seen[c].x] == sections); }
        var next = first + (sections + 1u) * sum_before(lane, own);
        let total = crew_total();
        for (var c = run.x; c < run.y; c++) {
            if chunks[c].sections[seen[c].x] == sections {
                firsts[c] = next;
                next += (sections + 1u) * seen[c].z;
            }
        }
        if lane == 0u { plan_draw(row, first, total, sections); }
        first += (sections + 1u) * total;
    }
    if lane == 0u { plan[LAST] = first; }
}

// Takes chunks to the next coarser level while there is no room for all their joints.
fn make_room(lane: u32, run: vec2u) {
    for (var coarser = 0u; coarser < COARSEST; coarser++) {
        var own = 0u;
        for (var c = run.x; c < run.y; c++) { own += seen[c].z * (chunks[c].sections[seen[c].x] + 1u); }
        sum_before(lane, own);
        let more = select(0u, 1u, crew_total() > look.counts.w);
        for (var c = run.x; c < run.y; c++) { seen[c].x = min(seen[c].x + more, COARSEST); }
    }
}

@compute @workgroup_size(256)
fn plan_all(@builtin(local_invocation_index) lane: u32) {
    let run = run_of(lane, look.counts.x);
    make_room(lane, run);
    plan_items(lane, run);
    plan_joints(lane, run);
}

// Writes the chosen blades of a chunk into the list, and where their joints are.
@compute @workgroup_size(128)
fn place(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let c = chunk_of(group, spread);
    let rank = rank_of(c, lane);
    if rank.x == NONE { return; }
    let chunk = chunks[c];
    let level = seen[c].x;
    let sections = chunk.sections[level];
    let blade = chunk.rows.x + lane;
    let first = firsts[c] + rank.x * (sections + 1u);
    items[seen[c].w + rank.x] = vec4u(blade, first, chunk.rows.z + level, NONE);
    atomicStore(&carriers[blade], 16u * first + sections);
}

// Tells every item of what carries it.
@compute @workgroup_size(128)
fn carry(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let c = chunk_of(group, spread);
    if c >= look.counts.x || lane >= seen[c].z { return; }
    let at = seen[c].w + lane;
    let parent = members[items[at].x].x;
    if parent != NONE { items[at].w = atomicLoad(&carriers[parent]) - 1u; }
}
