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
    let wood = smoothstep(0.56, 0.62, noise(at / 900.0 + 0.15).r + 0.2 * (field - 0.5)) * smoothstep(220.0, 500.0, away);
    let far = smoothstep(25.0, 160.0, away);
    let fields = mix(vec3f(0.060, 0.082, 0.026), vec3f(0.125, 0.118, 0.048), field);
    var albedo = mix(in.meadow, fields, 0.7 * far);
    albedo *= mix(0.35 + 0.75 * grain + 0.55 * tufts, 1.0, 0.8 * far);
    albedo = mix(albedo, vec3f(0.022, 0.040, 0.016), wood);

    let normal = normalize(in.normal);
    let direct = caught_by_blades(dot(normal, frame.sun.xyz));
    let light = frame.sun_light.rgb * direct * sunlight(in.world, normal) + ambient(normal) * (0.6 + 0.3 * far);
    return finished(albedo * light, in.world);
}
