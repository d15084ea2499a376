// Sky with drifting clouds behind everything else. Set: types + light + sky.

struct Ray {
    @builtin(position) clip: vec4f,
    @location(0) direction: vec3f,
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32) -> Ray {
    let corner = vec2f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0);
    let far = frame.clip_to_world * vec4f(corner, 1e-6, 1.0);
    return Ray(vec4f(corner, 0.0, 1.0), far.xyz / far.w - frame.eye.xyz);
}

// Cloud cover 0..1 where a ray meets the cloud layer.
fn cover(uv: vec2f) -> f32 {
    let shape = 0.62 * noise(uv).r + 0.28 * noise(uv * 3.1 + 0.21).r + 0.10 * noise(uv * 9.7 + 0.6).g;
    return smoothstep(0.50, 0.72, shape);
}

@fragment
fn fragment(in: Ray) -> @location(0) vec4f {
    let direction = normalize(in.direction);
    var colour = sky_radiance(direction);
    let layer = direction.xy / (max(direction.z, 0.0) + 0.12);
    let uv = 0.055 * layer + 0.00003 * frame.wind.zw;
    let thick = cover(uv);
    let sunward = cover(uv + 0.012 * frame.sun.xy);
    let towards = max(dot(direction, frame.sun.xyz), 0.0);
    let lit = frame.sun_light.rgb * (0.20 + 0.16 * pow(towards, 8.0)) * (1.0 - 0.55 * sunward);
    let cloud = lit + frame.sky_light.rgb * 0.45;
    colour = mix(colour, cloud, thick * 0.85 * smoothstep(0.01, 0.22, direction.z));
    colour += frame.sun_light.rgb * 4.0 * smoothstep(SUN_DISC - 0.00003, SUN_DISC + 0.00002, towards) * (1.0 - thick);
    return vec4f(tone_mapped(colour), 1.0);
}
