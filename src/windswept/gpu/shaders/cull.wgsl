// Which placements are seen or throw shadows, and in what detail: gpu/draw_list.py and geometry/detail.py on the card.
// Set: cull_types + scan + cull. Three dispatches: `see` a placement, `admit` once, `count` a group of placements.

const NEAREST = 1.0;              // distance at which detail stops growing, m
const FADE = 0.25;                // share of the full leaves over which the last ones shrink to nothing
const LEAF_RUN = 2.0;             // leaves are drawn in whole runs
const BANDS_PER_OCTAVE = 10.0;
const COLUMNS = 5u;               // of `bands`: those of Sight.room, and placements

@group(0) @binding(0) var<uniform> sight: Sight;
@group(0) @binding(1) var<uniform> kinds: array<DrawnKind, 512>;
@group(0) @binding(2) var<storage, read> standing: array<Standing>;
@group(0) @binding(3) var<storage, read> prefixes: array<vec4u>;   // of each piece and leaf: bits of its size; reach
@group(0) @binding(4) var<storage, read_write> choices: array<Choice>;
@group(0) @binding(5) var<storage, read_write> bands: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> totals: array<Needs>;   // of every class of every group
@group(0) @binding(7) var<storage, read_write> plan: array<u32>;

var<workgroup> crowd: array<Needs, 64>;
var<workgroup> classes: array<u32, 64>;

fn is_in_sight(centre: vec3f, radius: f32) -> bool {
    var inside = true;
    for (var p = 0u; p < 5u; p++) { inside = inside && dot(sight.planes[p], vec4f(centre, 1.0)) > -radius; }
    return inside;
}

// Whether a shadow can fall into the ball that receives shadows.
fn casts_shadow(centre: vec3f, radius: f32) -> bool {
    let offset = centre - sight.shadow.xyz;
    let along = dot(offset, sight.sun.xyz);
    let aside = length(offset - along * sight.sun.xyz);
    let reach = sight.shadow.w + radius;
    return aside < reach && along > -reach && along < 4.0 * reach;
}

// How many pieces of a kind are larger than a size; they stand by falling size.
fn pieces_above(kind: DrawnKind, size: f32) -> u32 {
    var low = 0u;
    var high = kind.counts.x;
    while low < high {
        let middle = (low + high) / 2u;
        if bitcast<f32>(prefixes[kind.counts.z + 1u + middle].x) > size { low = middle + 1u; } else { high = middle; }
    }
    return low;
}

// Leaves drawn; rank at which they end; ranks over which they shrink; scale.
fn choose_leaves(kind: DrawnKind, on_screen: f32) -> vec4f {
    let total = f32(kind.counts.y);
    let share = on_screen / sight.leaf_pixels.x;
    let full = clamp(share * share, sight.leaf_pixels.y, 1.0) * total;
    let fade = max(FADE * full, 1.0);
    let gap = 1.0 - clamp((total - full) / fade, 0.0, 1.0);
    let area = full + fade / 3.0 * (1.0 - gap * gap * gap);
    let runs = min(ceil((full + fade) / LEAF_RUN), ceil(total / LEAF_RUN));
    return vec4f(LEAF_RUN * runs, full + fade, fade, sqrt(total / max(area, 1e-9)));
}

// choose_detail where a metre takes so many pixels.
fn choose_detail(kind: DrawnKind, pixels: f32) -> Choice {
    let cuts = sight.stem_pixels / pixels;
    let on_screen = kind.leaf.x * pixels;
    let total = f32(kind.counts.y);
    var choice: Choice;
    for (var bucket = 0u; bucket < 4u; bucket++) { choice.piece_limit[bucket] = pieces_above(kind, cuts[bucket]); }
    choice.leaves = choose_leaves(kind, on_screen);
    let full = choice.leaves.y - choice.leaves.z;
    let drawn_length = on_screen * sqrt(total / max(full, 1.0));
    let mesh = select(0u, 1u, sight.leaf_pixels.z > drawn_length) + select(0u, 1u, sight.leaf_pixels.w > drawn_length);
    let of_pieces = prefixes[kind.counts.z + choice.piece_limit.w].yz;
    let of_leaves = prefixes[kind.first.w + u32(choice.leaves.x)].yz;
    choice.reach = vec4u(max(of_pieces, of_leaves), mesh, bitcast<u32>(cuts.w));
    return choice;
}

fn middle_of(here: Standing, kind: DrawnKind) -> vec3f {
    let c = here.position.w;
    let s = here.turn.x;
    let v = kind.ball.xyz;
    return here.position.xyz + vec3f(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
}

// Adds what a placement needs to what its band of distance needs.
fn note_needs(choice: Choice) {
    let needs = vec4u(choice.reach.xy, choice.piece_limit.w, u32(choice.leaves.x));
    let rounded = (needs + (1u << sight.counts.z) - 1u) >> vec4u(sight.counts.z);
    for (var column = 0u; column < 4u; column++) {
        atomicAdd(&bands[COLUMNS * choice.rows.y + column], rounded[column]);
    }
    atomicAdd(&bands[COLUMNS * choice.rows.y + 4u], 1u);
}

@compute @workgroup_size(64)
fn see(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= sight.counts.x { return; }
    let here = standing[id.x];
    let kind = kinds[here.rows.x];
    let centre = middle_of(here, kind);
    let is_seen = is_in_sight(centre, kind.ball.w);
    let casts = casts_shadow(centre, kind.ball.w);
    if !is_seen && !casts {
        choices[id.x].rows = vec4u(HIDDEN, 0u, 0u, 0u);
        return;
    }
    let away = distance(centre, sight.eye.xyz);
    let pixels = sight.eye.w / max(away - 0.5 * kind.ball.w, NEAREST);
    var choice = choose_detail(kind, select(min(pixels, 1.0 / sight.sun.w), pixels, is_seen));
    let band = BANDS_PER_OCTAVE * log2(max(away / NEAREST, 1.0));
    choice.rows = vec4u(select(0u, select(2u, 1u, casts), is_seen), min(u32(band), BANDS - 1u), 0u, 0u);
    note_needs(choice);
    choices[id.x] = choice;
}

// The nearest bands for which there is room are drawn, whole; who stands farther off is refused and counted.
@compute @workgroup_size(256)
fn admit(@builtin(local_invocation_index) lane: u32) {
    var fits = lane < BANDS;
    for (var column = 0u; column < 4u; column++) {
        var own = 0u;
        if lane < BANDS { own = atomicLoad(&bands[COLUMNS * lane + column]); }
        let needed = sum_before(lane, own) + own;
        if lane == 0u { plan[TALLY + column] = crew_total(); }
        fits = fits && needed <= sight.room[column] >> sight.counts.z;
    }
    _ = sum_before(lane, select(0u, 1u, fits));
    let admitted = crew_total();
    var refused = 0u;
    if lane >= admitted && lane < BANDS { refused = atomicLoad(&bands[COLUMNS * lane + 4u]); }
    _ = sum_before(lane, refused);
    if lane == 0u {
        plan[TALLY + 4u] = admitted;
        plan[TALLY + 5u] = crew_total();
    }
}

// What the placements of a group need, class by class.
@compute @workgroup_size(64)
fn count(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = group.x * GROUP + lane;
    classes[lane] = HIDDEN;
    if i < sight.counts.x {
        let choice = choices[i];
        if choice.rows.x != HIDDEN && choice.rows.y < plan[TALLY + 4u] {
            classes[lane] = choice.rows.x;
            crowd[lane] = needs_of(choice);
        } else {
            choices[i].rows.x = HIDDEN;
        }
    }
    workgroupBarrier();
    if lane >= CLASSES { return; }
    var sum: Needs;
    for (var other = 0u; other < GROUP; other++) {
        if classes[other] == lane { sum = added(sum, crowd[other]); }
    }
    totals[CLASSES * group.x + lane] = sum;
}
