// Colour of the meadow at a place, shared by the ground and the grass that stands on it.
// Noise is laid out along turned axes at lengths without a common measure, so that its tiling never shows.

struct Meadow {
    colour: vec3f,
    dryness: f32,   // 0 lush to 1 dry
}

fn meadow_noise(at: vec2f) -> vec3f {
    let broad = textureSampleLevel(noise_map, noise_sampler, mat2x2f(0.6, 0.8, -0.8, 0.6) * at / 97.0, 0.0).r;
    let middle = textureSampleLevel(noise_map, noise_sampler, mat2x2f(0.28, -0.96, 0.96, 0.28) * at / 31.0, 1.0).r;
    let small = textureSampleLevel(noise_map, noise_sampler, at / 8.3 + 0.4, 1.0).r;
    return vec3f(broad, middle, small);
}

fn meadow(at: vec2f) -> Meadow {
    let n = meadow_noise(at);
    let dryness = smoothstep(0.30, 0.72, 0.40 * n.x + 0.38 * n.y + 0.22 * n.z);
    let lush = vec3f(0.040, 0.068, 0.016);
    let grown = vec3f(0.078, 0.098, 0.026);
    let dry = vec3f(0.150, 0.128, 0.052);
    let half_way = mix(lush, grown, smoothstep(0.0, 0.5, dryness));
    return Meadow(mix(half_way, dry, smoothstep(0.55, 1.0, dryness) * 0.8), dryness);
}
