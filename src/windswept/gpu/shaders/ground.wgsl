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

@fragment
fn fragment(in: Ground) -> @location(0) vec4f {
    let at = in.world.xy;
    let away = distance(at, frame.eye.xy);
    let grain = noise(at / 1.9).g;
    let tufts = noise(mat2x2f(0.8, 0.6, -0.6, 0.8) * at / 6.1).g;
    let field = noise(at / 410.0).r;
    let edge = 0.55 * (noise(at / 170.0 + 0.7).r - 0.5) + 0.25 * (field - 0.5);
    let wood = smoothstep(0.60, 0.66, noise(at / 1300.0 + 0.15).r + edge) * smoothstep(220.0, 500.0, away);
    let far = smoothstep(10.0, 80.0, away);
    let fields = mix(vec3f(0.060, 0.082, 0.026), vec3f(0.125, 0.118, 0.048), field);
    var albedo = mix(in.meadow, fields, 0.7 * smoothstep(60.0, 300.0, away));
    albedo *= mix(0.35 + 0.75 * grain + 0.55 * tufts, 1.0, 0.9 * far);
    albedo = mix(albedo, vec3f(0.026, 0.046, 0.018), wood);

    let normal = normalize(in.normal);
    let direct = caught_by_blades(dot(normal, frame.sun.xyz));
    let light = frame.sun_light.rgb * direct * sunlight(in.world, normal) + ambient(normal) * (0.6 + 0.3 * far);
    return finished(albedo * light, in.world);
}
