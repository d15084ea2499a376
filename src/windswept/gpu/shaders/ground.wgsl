// Meadow to the horizon. Set: types + light + ground.

struct Ground {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
}

@vertex
fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Ground {
    return Ground(frame.view_projection * vec4f(position, 1.0), position, normal);
}

@fragment
fn fragment(in: Ground) -> @location(0) vec4f {
    let uv = in.world.xy;
    let broad = noise(uv / 61.0).r;
    let middle = noise(uv / 13.0 + 0.3).r;
    let fine = noise(uv / 2.3).g;
    let far = smoothstep(60.0, 400.0, distance(uv, frame.eye.xy));
    let lush = vec3f(0.055, 0.105, 0.018);
    let dry = vec3f(0.17, 0.15, 0.055);
    let soil = vec3f(0.085, 0.062, 0.040);
    var albedo = mix(lush, dry, smoothstep(0.35, 0.75, 0.6 * broad + 0.4 * middle));
    albedo = mix(albedo, soil, 0.7 * smoothstep(0.60, 0.78, middle) * (1.0 - far));
    albedo *= mix(0.6 + 0.8 * fine, 1.0, far);
    let woods = smoothstep(0.50, 0.56, noise(uv / 700.0).r) * smoothstep(150.0, 500.0, distance(uv, frame.eye.xy));
    albedo = mix(albedo, vec3f(0.028, 0.052, 0.018), woods);

    let slope = (noise(uv / 3.1 + 0.013).rg - noise(uv / 3.1).rg) * (1.0 - far);
    let normal = normalize(in.normal + vec3f(1.5 * slope, 0.0));
    let direct = max(dot(normal, frame.sun.xyz), 0.0);
    let light = frame.sun_light.rgb * direct * sunlight(in.world, normal) + ambient(normal) * 0.85;
    return finished(albedo * light, in.world);
}
