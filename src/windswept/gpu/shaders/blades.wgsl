// Blades of the meadow: strips from posed joints, lit at their vertices, from both sides and through.
// Set: types + light + meadow + blades_types + blades.

const BATCH = 64u;

@group(1) @binding(0) var<storage, read> posed: array<PosedJoint>;
@group(1) @binding(1) var<storage, read> runs: array<BladeRun>;
@group(1) @binding(2) var<uniform> meadow_pass: MeadowPass;

struct BladeVertex {
    @builtin(position) clip: vec4f,
    @location(0) colour: vec3f,
}

// Linear colour at a place along a blade; grass and leaves take part in the meadow's patches, petals do not.
fn blade_albedo(run: BladeRun, along: f32, chance: f32, world: vec3f) -> vec3f {
    let own = mix(run.colour.rgb, run.tip.rgb, along);
    let leafy = clamp(12.0 * (own.g - max(own.r, own.b)), 0.0, 1.0);
    let patch_tint = meadow(world.xy).colour / vec3f(0.075, 0.092, 0.028);
    let vary = mix(vec3f(0.92, 0.97, 0.95), vec3f(1.22, 1.05, 0.85), chance) * (0.8 + 0.4 * fract(17.3 * chance));
    return own * mix(vec3f(0.88 + 0.24 * chance), vary * mix(vec3f(1.0), patch_tint, 0.55), leafy);
}

fn blade_light(run: BladeRun, facing: vec3f, along: f32, chance: f32, world: vec3f) -> vec3f {
    let albedo = blade_albedo(run, along, chance, world);
    let to_eye = normalize(frame.eye.xyz - world);
    let normal = select(-facing, facing, dot(facing, to_eye) > 0.0);
    let sun = frame.sun.xyz;
    // Deep between its neighbours a blade sees little sky and less sun.
    let rooted = run.width.w > 0.5;
    let open = select(0.85, mix(0.22, 1.0, smoothstep(0.0, 0.9, along)), rooted);
    let reaches = sunlight_once(world, normal) * select(0.95, mix(0.12, 1.0, smoothstep(0.05, 0.75, along)), rooted);
    let turned = dot(normal, sun);
    let reflected = albedo * (0.75 * max(turned, 0.0) + 0.25 * max(sun.z, 0.0));
    let through = albedo * vec3f(1.30, 1.25, 0.55) * (max(-turned, 0.0) + 0.25 * pow(max(dot(-to_eye, sun), 0.0), 4.0));
    let gloss = 0.06 * pow(max(dot(normal, normalize(sun + to_eye)), 0.0), 24.0);
    let direct = frame.sun_light.rgb * reaches * (reflected + through + gloss);
    let dim = ambient(normalize(normal + vec3f(0.0, 0.0, 1.2))) * open;
    return direct + dim * albedo * 1.15;
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> BladeVertex {
    let vertices = meadow_pass.items.z;
    let item = instance * BATCH + vertex / vertices;
    if item >= meadow_pass.items.y { return BladeVertex(); }
    let corner = vertex % vertices;
    let joint = posed[meadow_pass.items.x + item * (vertices / 2u) + corner / 2u];
    let run = runs[joint.facing.w >> 20u];
    let chance = f32((joint.facing.w >> 12u) & 255u) / 255.0;
    let along = f32((joint.facing.w >> 4u) & 255u) / 255.0;
    var side = vec3f(unpack2x16snorm(joint.facing.x), unpack2x16snorm(joint.facing.y).x);
    var normal = vec3f(unpack2x16snorm(joint.facing.y).y, unpack2x16snorm(joint.facing.z));
    let border = f32(corner % 2u) * 2.0 - 1.0;
    if run.width.z > 0.5 {
        // A stalk is a strip that turns to the eye, and is lit as the half of a tube.
        let to_eye = normalize(frame.eye.xyz - joint.place.xyz);
        side = normalize(cross(to_eye, cross(normal, side)));
        normal = normalize(to_eye + border * side);
    }
    let world = joint.place.xyz + border * joint.place.w * side;
    let light = blade_light(run, normal, along, chance, world);
    return BladeVertex(frame.view_projection * vec4f(world, 1.0), finished(light, world).rgb);
}

@fragment
fn fragment(in: BladeVertex) -> @location(0) vec4f {
    return vec4f(in.colour, 1.0);
}
