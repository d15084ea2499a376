// Where everything that is drawn stands, after `count`: rows of placements, seats for their poses, places of what is
// posed, and the arguments of indirect dispatches and draws; gpu/draw_list.py and gpu/draw_plan.py are the same on the
// CPU. Set: types + scan + cull_types + cull_places. `plan_all` once, `place` a group of placements.

override LARGEST_FLUTTER: f32 = 0.6;   // of a readily fluttering leaf in a storm, rad
override FLUTTER_SPEED: f32 = 5.0;     // wind at which it trembles with 63 % of that, m/s

const POSES = 0u;      // words of `plan`: workgroups along x, y and z
const STEMS = 3u;      // and of pieces and leaves behind them
const DRAWS = 12u;     // arguments of draws, 5 each
const RANGES = 7u;     // of items: buckets of stems, then meshes of leaves
const MOST = 65535u;   // workgroups along x
const STRIDE = 16u;    // rows of `batches` from one draw to the next

@group(0) @binding(1) var<uniform> sight: Sight;
@group(0) @binding(2) var<uniform> kinds: array<DrawnKind, 512>;
@group(0) @binding(3) var<uniform> meshes: array<vec4u, 16>;   // indices of one item; of a batch; one of how many; range
@group(0) @binding(4) var<storage, read> standing: array<Standing>;
@group(0) @binding(5) var<storage, read> choices: array<Choice>;
@group(0) @binding(6) var<storage, read_write> totals: array<array<vec4u, 4>>;   // Needs, column by column
@group(0) @binding(7) var<storage, read_write> placements: array<Placement>;
@group(0) @binding(8) var<storage, read_write> seats: array<vec4u>;
@group(0) @binding(9) var<storage, read_write> plan: array<u32>;
@group(0) @binding(10) var<storage, read_write> batches: array<vec4u>;
@group(0) @binding(11) var<storage, read> speeds: array<f32>;   // mean wind in the crown of every placement, m/s

var<workgroup> crowd: array<Needs, 64>;
var<workgroup> classes: array<u32, 64>;

// Turns a column of `totals` into where each class of each group begins; gives the ends of the classes.
fn lay_out(lane: u32, column: u32, first: u32) -> vec3u {
    let run = run_of(lane, sight.counts.y);
    let row = column / 4u;
    let part = column % 4u;
    var ends = vec3u(first);
    var begin = first;
    for (var tier = 0u; tier < CLASSES; tier++) {
        var own = 0u;
        for (var g = run.x; g < run.y; g++) { own += totals[CLASSES * g + tier][row][part]; }
        var next = begin + sum_before(lane, own);
        begin += crew_total();
        for (var g = run.x; g < run.y; g++) {
            let taken = totals[CLASSES * g + tier][row][part];
            totals[CLASSES * g + tier][row][part] = next;
            next += taken;
        }
        ends[tier] = begin;
    }
    return ends;
}

fn plan_chunks(word: u32, chunks: u32) {
    plan[word] = min(chunks, MOST);
    plan[word + 1u] = (chunks + MOST - 1u) / MOST;
    plan[word + 2u] = 1u;
}

// `range` is the first item, the ends of those out of sight, of those that throw shadows, and of all.
fn plan_draw(slot: u32, range: vec4u) {
    let mesh = meshes[slot];
    let of_shadows = slot >= RANGES;
    let first = select(range.y, range.x, of_shadows);
    let items = select(range.w - range.y, (range.z - range.x) / mesh.z, of_shadows);
    let at = DRAWS + 5u * slot;
    plan[at] = mesh.x * min(mesh.y, items);
    plan[at + 1u] = (items + mesh.y - 1u) / mesh.y;
    for (var rest = 2u; rest < 5u; rest++) { plan[at + rest] = 0u; }
    batches[STRIDE * slot] = vec4u(first, items, mesh.z, 0u);
    batches[STRIDE * slot + 1u] = vec4u(bitcast<u32>(sqrt(f32(mesh.z))), 0u, 0u, 0u);
}

@compute @workgroup_size(256)
fn plan_all(@builtin(local_invocation_index) lane: u32) {
    var ranges: array<vec4u, 7>;
    var first = 0u;
    for (var k = 0u; k < RANGES; k++) {
        // Pieces and leaves lie in buffers of their own.
        if k == 4u { first = 0u; }
        let ends = lay_out(lane, k, first);
        ranges[k] = vec4u(first, ends);
        first = ends.z;
    }
    let rows = lay_out(lane, 7u, 0u).z;
    _ = lay_out(lane, 8u, 0u);
    _ = lay_out(lane, 9u, 0u);
    let chunks = vec3u(lay_out(lane, 12u, 0u).z, lay_out(lane, 13u, 0u).z, lay_out(lane, 14u, 0u).z);
    if lane < 2u * RANGES { plan_draw(lane, ranges[meshes[lane].w]); }
    if lane < 3u { plan_chunks(STEMS + 3u * lane, chunks[lane]); }
    if lane == 0u {
        plan[POSES] = (rows + GROUP - 1u) / GROUP;
        plan[POSES + 1u] = 1u;
        plan[POSES + 2u] = 1u;
        batches[STRIDE * 2u * RANGES] = vec4u(rows, chunks);
        seats[0] = vec4u(rows, 0u, 0u, 0u);
        plan[TALLY + 6u] = rows;
        plan[TALLY + 7u] = ranges[3].w;
        plan[TALLY + 8u] = ranges[6].w;
    }
}

fn placement_of(i: u32, choice: Choice, first: Needs) -> Placement {
    let here = standing[i];
    let kind = kinds[here.rows.x];
    let flutter = LARGEST_FLUTTER * (1.0 - exp(-speeds[i] / FLUTTER_SPEED));
    var placement: Placement;
    placement.position = here.position;
    placement.heading = vec4f(here.turn.x, flutter, here.turn.y, bitcast<f32>(choice.reach.w));
    placement.rows = vec4u(first.poses.xy, kind.first.x, choice.reach.y);
    placement.first = vec4u(kind.first.yz, first.leaves[choice.reach.z], here.rows.y);
    placement.piece_limit = choice.piece_limit;
    placement.piece_out = first.pieces;
    placement.leaves = choice.leaves;
    placement.number = vec4u(i, first.chunks.xyz);
    return placement;
}

// Of a class, a group's placements stand one after another.
@compute @workgroup_size(64)
fn place(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = group.x * GROUP + lane;
    var choice: Choice;
    choice.rows.x = HIDDEN;
    if i < sight.counts.x { choice = choices[i]; }
    let own = choice.rows.x;
    classes[lane] = own;
    crowd[lane] = needs_of(choice);
    workgroupBarrier();
    if own == HIDDEN { return; }
    let begin = totals[CLASSES * group.x + own];
    var first = Needs(begin[0], begin[1], begin[2], begin[3]);
    for (var other = 0u; other < lane; other++) {
        if classes[other] == own { first = added(first, crowd[other]); }
    }
    let row = first.leaves.w;
    placements[row] = placement_of(i, choice, first);
    seats[1u + row] = vec4u(i, first.poses.x, choice.reach.x, 0u);
}
