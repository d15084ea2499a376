// From how many members every level has to what is dispatched: one workgroup. Set: motion + scan + plan.

const STEP = 0u;     // rows of `dispatches`: workgroups along x; y and z stand there from the beginning
const WIND = 3u;
const SHIFT = 6u;
const JOIN = 9u;
const JOIN_GROUPS = 12u;
const MOST = 65535u;

@group(0) @binding(0) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(1) var<storage, read> populations: array<u32>;
@group(0) @binding(2) var<storage, read> tally: array<u32, 4>;
@group(0) @binding(3) var<storage, read_write> blocks: array<vec4u>;   // [0]: number of blocks
@group(0) @binding(4) var<storage, read_write> dispatches: array<u32>;
@group(0) @binding(5) var<uniform> moment: Moment;

@compute @workgroup_size(256)
fn plan(@builtin(local_invocation_index) lane: u32) {
    let run = run_of(lane, moment.counts.x);
    var count = 0u;
    for (var r = run.x; r < run.y; r++) { count += (populations[r] + LANES - 1u) / LANES; }
    var row = 1u + sum_before(lane, count);
    for (var r = run.x; r < run.y; r++) {
        for (var slot = 0u; slot < populations[r]; slot += LANES) {
            blocks[row] = vec4u(r, slot / LANES, min(populations[r] - slot, LANES), 0u);
            row++;
        }
    }
    if lane == 0u {
        let total = crew_total();
        blocks[0] = vec4u(total, 0u, 0u, 0u);
        dispatches[STEP] = min(total, MOST);
        dispatches[WIND] = min(total, MOST);
        dispatches[SHIFT] = min(tally[0], MOST);
        dispatches[JOIN] = min((tally[1] + 63u) / 64u, MOST);
        dispatches[JOIN_GROUPS] = min(tally[1], MOST);
    }
}
