// Which level every placement goes to: levels/choose.py and scene/moving_kind.py on the card.
// Set: motion + scan + choose. Three dispatches: `wish` a placement, `rank` a rung, `give` a placement.

override REGISTER: u32 = 8u;   // placements that the CPU steps at once: idle lanes of finer levels are filled

@group(0) @binding(0) var<uniform> kinds: array<Kind, 512>;
@group(0) @binding(1) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(2) var<storage, read> rooted: array<Rooted>;
@group(0) @binding(3) var<storage, read_write> motions: array<Motion>;
@group(0) @binding(4) var<storage, read_write> wishes: array<u32>;   // placements of each rung's wish
@group(0) @binding(5) var<uniform> moment: Moment;

const NEAREST = 0.1;       // no part of a plant is seen from nearer than this, m
const OUT_OF_VIEW = 4.0;   // who is far outside the picture counts as this many times farther away
const OUT_OF_VIEW_FROM = 0.1396263;   // angles outside the picture's corner between which that rises, rad
const OUT_OF_VIEW_TO = 0.5235988;

// Distance from which a plant is seen: levels/choose.py.
fn seen_distance(position: vec3f, radius: f32) -> f32 {
    let towards = position - moment.eye.xyz;
    let away = length(towards);
    let near = max(away - radius, NEAREST);
    let far = max(away, NEAREST);
    let off = acos(clamp(dot(towards, moment.view.xyz) / far, -1.0, 1.0)) - asin(min(radius / far, 1.0));
    let share = saturate((off - moment.view.w - OUT_OF_VIEW_FROM) / (OUT_OF_VIEW_TO - OUT_OF_VIEW_FROM));
    let seen = moment.view.w <= 0.0 || away <= radius;
    return select(near * (1.0 + (OUT_OF_VIEW - 1.0) * share), near, seen);
}

// Coarsest place on the ladder whose error is not seen.
fn coarsest(kind: Kind, metres: f32) -> u32 {
    var place = 0u;
    for (var k = 1u; k < kind.ladder.y; k++) {
        if rungs[kind.ladder.x + k].air.z <= metres { place = k; }
    }
    return place;
}

@compute @workgroup_size(64)
fn wish(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= moment.counts.z { return; }
    let here = rooted[id.x];
    let kind = kinds[here.rows.x];
    let away = seen_distance(here.position.xyz, kind.size.x);
    let allowed = coarsest(kind, moment.eye.w * away);
    let kept = coarsest(kind, moment.eye.w * away * moment.time.x);
    let current = motions[id.x].wish.x;
    motions[id.x].wish = vec4u(select(min(current, kept), allowed, allowed >= current), 0u, 0u, 0u);
}

// A workgroup takes a rung and ranks the placements that wish for it.
@compute @workgroup_size(256)
fn rank(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let rung = rungs[group.x];
    let kind = kinds[rung.links.w];
    let run = run_of(lane, kind.ladder.w);
    var count = 0u;
    for (var i = run.x; i < run.y; i++) {
        count += select(0u, 1u, motions[kind.ladder.z + i].wish.x == rung.groups.w);
    }
    var place = sum_before(lane, count);
    for (var i = run.x; i < run.y; i++) {
        let wanted = motions[kind.ladder.z + i].wish;
        if wanted.x == rung.groups.w {
            motions[kind.ladder.z + i].wish = vec4u(wanted.x, place, 0u, 0u);
            place++;
        }
    }
    if lane == 0u { wishes[group.x] = crew_total(); }
}

// Place on the ladder of who stands at `index` among all placements in the order of their wishes (fill_registers).
fn filled_place(kind: Kind, index: u32) -> u32 {
    var start = 0u;
    var counted = 0u;
    for (var k = 0u; k < kind.ladder.y; k++) {
        counted += wishes[kind.ladder.x + k];
        if counted > start {
            start += (counted - start + REGISTER - 1u) / REGISTER * REGISTER;
            if index < start { return k; }
        }
    }
    return kind.ladder.y - 1u;
}

@compute @workgroup_size(64)
fn give(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= moment.counts.z { return; }
    let kind = kinds[rooted[id.x].rows.x];
    var motion = motions[id.x];
    if motion.origin.x != NONE && moment.steps.x - motion.at.z >= moment.counts.w {
        motion.origin = vec4u(NONE, NONE, motion.origin.xy);
    }
    var index = motion.wish.y;
    for (var k = 0u; k < motion.wish.x; k++) { index += wishes[kind.ladder.x + k]; }
    let given = kind.ladder.x + filled_place(kind, index);
    if given != motion.at.x && motion.origin.x == NONE {
        motion.origin = vec4u(motion.at.xy, motion.origin.zw);
        motion.at = vec4u(given, NONE, moment.steps.x, 1u);
    }
    motions[id.x] = motion;
}
