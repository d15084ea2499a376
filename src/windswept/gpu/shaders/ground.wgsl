// Meadow to the horizon. Set: types + light + meadow + ground.

struct Ground {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) meadow: vec3f,
}

@vertex
fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Ground {
    return Ground(frame.view_projection * vec4f(position, 1.0), position, normal, meadow(position.xy).colour);
}

// Noise with tiles of `size` m, at the level that suits ground seen from `away` m: a pixel spans some 0.003 of it.
fn ground_noise(at: vec2f, size: f32, away: f32) -> vec4f {
    return noise_level(at / size, floor(log2(max(1.6 * away / size, 1.0))));
}

// Fields and woods, far off.
fn country(at: vec2f, away: f32, near_by: vec3f) -> vec3f {
    let field = ground_noise(at, 410.0, away).r;
    let edge = 0.55 * (ground_noise(at + 119.0, 170.0, away).r - 0.5) + 0.25 * (field - 0.5);
    let wood = smoothstep(0.60, 0.66, ground_noise(at + 195.0, 1300.0, away).r + edge) * smoothstep(220.0, 500.0, away);
    let fields = mix(vec3f(0.060, 0.082, 0.026), vec3f(0.125, 0.118, 0.048), field);
    return mix(mix(near_by, fields, 0.7 * smoothstep(60.0, 300.0, away)), vec3f(0.030, 0.056, 0.018), 0.75 * wood);
}

@fragment
fn fragment(in: Ground) -> @location(0) vec4f {
    let at = in.world.xy;
    let away = distance(in.world, frame.eye.xyz);
    let far = smoothstep(10.0, 80.0, away);
    var albedo = in.meadow;
    if away > 60.0 { albedo = country(at, away, albedo); }
    if far < 1.0 {
        let grain = ground_noise(at, 1.9, away).g;
        let tufts = ground_noise(mat2x2f(0.8, 0.6, -0.6, 0.8) * at, 6.1, away).g;
        albedo *= mix(0.35 + 0.75 * grain + 0.55 * tufts, 1.0, far);
        // Between blades lie litter and shade; far off they cover it, and the ground has their colour.
        albedo *= mix(vec3f(1.0), vec3f(0.64, 0.56, 0.48), frame.terrain.w * (1.0 - far));
    }

    let normal = normalize(in.normal);
    let direct = caught_by_blades(dot(normal, frame.sun.xyz));
    let light = frame.sun_light.rgb * direct * sunlight(in.world, normal) + ambient(normal) * (0.6 + 0.3 * far);
    return finished(albedo * light, in.world);
}
