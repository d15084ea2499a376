// Light on blades, from both sides and through. Set: types + light + meadow + ... + blades_light + blades_pose.

// What all of a blade shares.
struct BladeLook {
    tint: vec3f,     // of the meadow's patch and of its own, on what is green
    bloom: f32,      // factor on what is not
    sun: f32,        // share of the sun that gets past the trees
}

fn blade_look(chance: f32, root: vec3f, height: f32) -> BladeLook {
    let patch_tint = meadow(root.xy).colour / vec3f(0.075, 0.092, 0.028);
    let vary = mix(vec3f(0.92, 0.97, 0.95), vec3f(1.22, 1.05, 0.85), chance) * (0.8 + 0.4 * fract(17.3 * chance));
    let up = vec3f(0.0, 0.0, 1.0);
    let sun = sunlight_once(root + height * up, up);
    return BladeLook(vary * mix(vec3f(1.0), patch_tint, 0.55), 0.88 + 0.24 * chance, sun);
}

fn blade_light(run: BladeRun, look: BladeLook, facing: vec3f, along: f32, world: vec3f) -> vec3f {
    let own = mix(run.colour.rgb, run.tip.rgb, along);
    let leafy = clamp(12.0 * (own.g - max(own.r, own.b)), 0.0, 1.0);
    let albedo = own * mix(vec3f(look.bloom), look.tint, leafy);
    let to_eye = normalize(frame.eye.xyz - world);
    let normal = select(-facing, facing, dot(facing, to_eye) > 0.0);
    let sun = frame.sun.xyz;
    // Deep between its neighbours a blade sees little sky and less sun.
    let rooted = run.width.w > 0.5;
    let open = select(0.85, mix(0.22, 1.0, smoothstep(0.0, 0.9, along)), rooted);
    let reaches = look.sun * select(0.95, mix(0.12, 1.0, smoothstep(0.05, 0.75, along)), rooted);
    let turned = dot(normal, sun);
    let reflected = albedo * (0.75 * max(turned, 0.0) + 0.25 * max(sun.z, 0.0));
    let through = albedo * vec3f(1.30, 1.25, 0.55) * (max(-turned, 0.0) + 0.25 * pow(max(dot(-to_eye, sun), 0.0), 4.0));
    let gloss = 0.06 * pow(max(dot(normal, normalize(sun + to_eye)), 0.0), 24.0);
    let direct = frame.sun_light.rgb * reaches * (reflected + through + gloss);
    let dim = ambient(normalize(normal + vec3f(0.0, 0.0, 1.2))) * open;
    return direct + dim * albedo * 1.15;
}
