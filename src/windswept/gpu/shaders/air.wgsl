// What one wave and one gust add to the wind at the reference height, as wind/velocity.py adds them up.
// Set: motion + air + wind or bend.

// cos(2 pi turns) by Taylor's series of the sine about the nearest zero: the same on every driver.
fn cosine(turns: f32) -> f32 {
    let x = 6.2831853 * (0.25 - abs(turns - round(turns)));
    let s = x * x;
    return x + x * s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0
        + s * (1.0 / 362880.0 - s / 39916800.0))));
}

fn smooth_step(progress: f32) -> f32 {
    let p = clamp(progress, 0.0, 1.0);
    return p * p * (3.0 - 2.0 * p);
}

// base^power; whole powers as products, since a printed wave raises negative numbers.
fn raised(base: f32, power: f32) -> f32 {
    if power != floor(power) { return pow(max(base, 0.0), power); }
    var product = base;
    for (var k = 1.0; k < power; k += 1.0) { product *= base; }
    return product;
}

fn wave_push(wave: Wave, place: vec2f) -> vec2f {
    // A quarter turn back makes the sine a cosine.
    let turns = fract(wave.phase.x * place.x) + fract(wave.phase.y * place.y) + wave.phase.z - 0.25;
    let base = 0.5 * (cosine(turns) + wave.phase.w);
    return wave.push.xy * (raised(base, wave.push.z) - wave.push.w);
}

fn gust_push(gust: Gust, place: vec2f) -> vec2f {
    let from_origin = place - gust.place.xy;
    let direction = gust.place.zw;
    let behind = gust.shape.x - dot(from_origin, direction);
    let aside = abs(direction.x * from_origin.y - direction.y * from_origin.x);
    let rise = smooth_step(behind * gust.shape.z);
    let decay = 1.0 - smooth_step((behind - gust.shape.w) * gust.fade.x);
    return gust.shape.y * rise * decay * (1.0 - smooth_step(aside * gust.fade.y)) * direction;
}
