// Sums over a workgroup of 256. Every invocation takes a run of neighbouring items, so that ranks follow their order
// and the same motion gives the same lists on every card.

const CREW = 256u;
var<workgroup> sums: array<u32, 256>;

// Sum of `value` over the invocations before this one; `crew_total` is then the sum over all.
fn sum_before(lane: u32, value: u32) -> u32 {
    workgroupBarrier();
    sums[lane] = value;
    workgroupBarrier();
    for (var reach = 1u; reach < CREW; reach *= 2u) {
        var left = 0u;
        if lane >= reach { left = sums[lane - reach]; }
        workgroupBarrier();
        sums[lane] += left;
        workgroupBarrier();
    }
    return sums[lane] - value;
}

fn crew_total() -> u32 {
    return sums[CREW - 1u];
}

// First and end of the run of an invocation among `count` items.
fn run_of(lane: u32, count: u32) -> vec2u {
    let size = (count + CREW - 1u) / CREW;
    return min(vec2u(lane * size, (lane + 1u) * size), vec2u(count));
}
