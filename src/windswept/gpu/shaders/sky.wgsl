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
    let shape = 0.60 * noise_level(uv, 0.0).r + 0.26 * noise_level(uv * 2.7 + 0.21, 0.0).r
        + 0.14 * noise_level(uv * 8.3 + 0.6, 0.0).r;
    return smoothstep(0.43, 0.78, shape);
}

@fragment
fn fragment(in: Ray) -> @location(0) vec4f {
    let direction = normalize(in.direction);
    var colour = sky_radiance(direction);
    let layer = direction.xy / (max(direction.z, 0.0) + 0.09);
    let uv = 0.11 * layer + 0.00004 * frame.wind.zw + 0.13;
    let thick = cover(uv);
    let sunward = smoothstep(0.45, 0.80, noise_level(uv + 0.02 * frame.sun.xy, 0.0).r);
    let towards = max(dot(direction, frame.sun.xyz), 0.0);
    let lit = frame.sun_light.rgb * (0.30 + 0.25 * pow(towards, 8.0)) * (1.0 - 0.6 * sunward);
    let cloud = lit + frame.haze.rgb * 0.42;
    colour = mix(colour, cloud, thick * 0.9 * smoothstep(0.0, 0.16, direction.z));
    let disc = smoothstep(SUN_DISC - 0.00003, SUN_DISC + 0.00002, towards);
    return vec4f(tone_mapped(colour + frame.sun_light.rgb * 4.0 * disc * (1.0 - thick)), 1.0);
}
