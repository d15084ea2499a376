// Sun, sky, shadow, haze and tone mapping, shared by everything that is coloured.
// Set: types + light + one of bark, leaves, ground, grass, sky.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
@group(2) @binding(2) var noise_map: texture_2d<f32>;
@group(2) @binding(3) var noise_sampler: sampler;

const GROUND_BOUNCE = vec3f(0.20, 0.22, 0.10);
const SUN_DISC = 0.99996;

// Tiling noise: red broad clouds, green fine grain, blue furrows along v, alpha white.
fn noise(uv: vec2f) -> vec4f {
    return textureSample(noise_map, noise_sampler, uv);
}

// The same at a level of detail that the caller knows: cheaper, and free of derivatives.
fn noise_level(uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(noise_map, noise_sampler, uv, level);
}

// Share of the sun that reaches a point: four bilinear comparisons round it.
fn sunlight(world: vec3f, normal: vec3f) -> f32 {
    let texel = frame.sun.w;
    let lifted = world + texel * (1.2 * normal + 1.0 * frame.sun.xyz);
    let clip = (frame.sun_projection * vec4f(lifted, 1.0)).xyz;
    let uv = vec2f(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y);
    let step = 0.75 / vec2f(textureDimensions(shadow_map));
    var lit = textureSampleCompareLevel(shadow_map, shadow_sampler, uv + step * vec2f(-0.4, -1.0), clip.z);
    lit += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + step * vec2f(1.0, -0.4), clip.z);
    lit += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + step * vec2f(0.4, 1.0), clip.z);
    lit += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + step * vec2f(-1.0, 0.4), clip.z);
    let edge = max(abs(clip.x), abs(clip.y));
    return mix(0.25 * lit, 1.0, smoothstep(0.92, 1.0, edge));
}

// One bilinear comparison, for surfaces as small as leaves.
fn sunlight_once(world: vec3f, normal: vec3f) -> f32 {
    let lifted = world + frame.sun.w * (1.5 * frame.sun.xyz);
    let clip = (frame.sun_projection * vec4f(lifted, 1.0)).xyz;
    let uv = vec2f(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y);
    let lit = textureSampleCompareLevel(shadow_map, shadow_sampler, uv, clip.z);
    let edge = max(abs(clip.x), abs(clip.y));
    return mix(lit, 1.0, smoothstep(0.92, 1.0, edge));
}

// Light from the sky above and the meadow below on a surface that faces `normal`.
fn ambient(normal: vec3f) -> vec3f {
    let below = GROUND_BOUNCE * (frame.sun_light.rgb * max(frame.sun.z, 0.0) + frame.sky_light.rgb) * 0.6;
    return mix(below, frame.sky_light.rgb, 0.5 + 0.5 * normal.z);
}

// Clear sky in a direction; the horizon's colour is also that of the haze.
fn sky_radiance(direction: vec3f) -> vec3f {
    let height = max(direction.z, 0.0);
    let towards = max(dot(direction, frame.sun.xyz), 0.0);
    let zenith = frame.sky_light.rgb * vec3f(0.20, 0.38, 0.72);
    let clear = mix(zenith, frame.haze.rgb, exp(-5.5 * height));
    let glow = 0.16 * pow(towards, 5.0) * exp(-2.0 * height) + 0.30 * pow(towards, 60.0);
    return clear + glow * frame.sun_light.rgb * 0.4;
}

// Distance haze, thicker near the ground.
fn hazed(colour: vec3f, world: vec3f) -> vec3f {
    let ray = world - frame.eye.xyz;
    let distance = length(ray);
    let flat_ray = vec3f(ray.xy, max(ray.z, 0.0)) / distance;
    let clear = exp(-distance * frame.haze.w);
    return mix(sky_radiance(flat_ray), colour, clear);
}

// Filmic curve (Narkowicz 2015, a fit of the ACES reference), linear in, linear out.
fn tone_mapped(colour: vec3f) -> vec3f {
    let bright = colour * frame.sun_light.w;
    let c = mix(vec3f(dot(bright, vec3f(0.2126, 0.7152, 0.0722))), bright, 0.9);
    return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), vec3f(0.0), vec3f(1.0));
}

fn finished(colour: vec3f, world: vec3f) -> vec4f {
    return vec4f(tone_mapped(hazed(colour, world)), 1.0);
}
