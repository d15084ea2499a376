// Colour of the meadow at a place, shared by the ground and the grass that stands on it.
// Noise is laid out along turned axes at lengths without a common measure, so that its tiling never shows.

struct Meadow {
    colour: vec3f,
    dryness: f32,   // 0 lush to 1 dry
}

fn meadow_noise(at: vec2f) -> vec3f {
    let broad = noise_level(mat2x2f(0.6, 0.8, -0.8, 0.6) * at / 97.0, 0.0).r;
    let middle = noise_level(mat2x2f(0.28, -0.96, 0.96, 0.28) * at / 31.0, 1.0).r;
    let small = noise_level(at / 8.3 + 0.4, 1.0).r;
    return vec3f(broad, middle, small);
}

fn meadow(at: vec2f) -> Meadow {
    let n = meadow_noise(at);
    let dryness = smoothstep(0.30, 0.72, 0.40 * n.x + 0.38 * n.y + 0.22 * n.z);
    let lush = vec3f(0.040, 0.068, 0.016);
    let grown = vec3f(0.070, 0.102, 0.024);
    let dry = vec3f(0.138, 0.130, 0.050);
    let half_way = mix(lush, grown, smoothstep(0.0, 0.5, dryness));
    return Meadow(mix(half_way, dry, smoothstep(0.55, 1.0, dryness) * 0.8), dryness);
}

// Share of the sun that upright blades catch on ground with this cosine to it: a low sun still lights them.
fn caught_by_blades(cosine: f32) -> f32 {
    return select(0.0, 0.62 * cosine + 0.30 * sqrt(max(1.0 - cosine * cosine, 0.0)), cosine > 0.0);
}
