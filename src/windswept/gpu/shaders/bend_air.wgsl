// The wind at the reference height, as wind/velocity.py adds it up.
// Set: types + bend_types + bend_air + bend.

// cos(2 pi turns) for -0.5..0.5 by Taylor's series of the sine about the nearest zero: the same on every driver.
fn cosine(turns: f32) -> f32 {
    let x = 6.283185307 * (0.25 - abs(turns));
    let s = x * x;
    return x + x * s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362880.0 - s / 39916800.0))));
}

// base^power; whole powers as products, since a printed wave raises negative numbers.
fn raised(base: f32, power: f32) -> f32 {
    if power != floor(power) { return pow(max(base, 0.0), power); }
    var product = base;
    for (var k = 1.0; k < power; k += 1.0) { product *= base; }
    return product;
}

fn ramp(progress: f32) -> f32 {
    let p = clamp(progress, 0.0, 1.0);
    return p * p * (3.0 - 2.0 * p);
}

fn wave_push(wave: BreezeWave, place: vec2f) -> vec2f {
    // A quarter turn back makes the sine a cosine.
    let turns = dot(wave.phase.xy, place) + wave.phase.z - 0.25;
    let base = 0.5 * (cosine(turns - round(turns)) + wave.phase.w);
    return wave.push.xy * (raised(base, wave.push.z) - wave.push.w);
}

fn gust_push(gust: BreezeGust, place: vec2f) -> vec2f {
    let offset = place - gust.place.xy;
    let direction = gust.place.zw;
    let behind = gust.shape.x - dot(offset, direction);
    let aside = abs(offset.y * direction.x - offset.x * direction.y);
    let decay = 1.0 - ramp((behind - gust.shape.w) * gust.fade.x);
    let shape = ramp(behind * gust.shape.z) * decay * (1.0 - ramp(aside * gust.fade.y));
    return gust.shape.y * shape * direction;
}

fn air(place: vec2f) -> vec2f {
    var sum = breeze.mean.xy;
    for (var i = 0u; i < breeze.counts.x; i++) { sum += wave_push(breeze.waves[i], place); }
    for (var i = 0u; i < breeze.counts.y; i++) { sum += gust_push(breeze.gusts[i], place); }
    return sum;
}
