// What blows at one moment, and the wind at the reference height of a place.
// Set: motion + air + bend_types + bend_frame + bend_air + bend.

struct Breeze {
    mean: vec4f,     // x, y in m/s; 0; 0
    counts: vec4u,   // waves; gusts; 0; 0
    waves: array<Wave, 16>,
    gusts: array<Gust, 8>,
}

struct BendPass {
    rows: vec4u,      // first branch of the pass; its end; 0; 0
    weights: vec4f,   // share of b that turns the second leg; what the third gets more; 0; 0
}

@group(0) @binding(3) var<uniform> breeze: Breeze;

fn air(place: vec2f) -> vec2f {
    var sum = breeze.mean.xy;
    for (var i = 0u; i < breeze.counts.x; i++) { sum += wave_push(breeze.waves[i], place); }
    for (var i = 0u; i < breeze.counts.y; i++) { sum += gust_push(breeze.gusts[i], place); }
    return sum;
}
