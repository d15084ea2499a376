// Meadow grass near the camera: one blade of five vertices, lit there, or the head of a flower.
// Set: types + light + meadow + grass.

const BLADE = 5u;
const BATCH = 64u;
const FLOWER_SHARE = 0.03;

@group(1) @binding(0) var<storage, read> blades: array<GrassBlade>;
@group(1) @binding(1) var<uniform> batch: Batch;

struct BladeVertex {
    @builtin(position) clip: vec4f,
    @location(0) colour: vec3f,
}

fn petal_colour(at: vec2f, chance: f32) -> vec3f {
    let kind = noise_level(at / 23.0, 0.0).r + 0.3 * chance;
    return select(select(vec3f(0.80, 0.78, 0.70), vec3f(0.80, 0.58, 0.05), kind > 0.55),
        vec3f(0.32, 0.16, 0.50), kind > 0.85);
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> BladeVertex {
    let item = instance * BATCH + vertex / BLADE;
    if item >= batch.items.y { return BladeVertex(); }
    let corner = vertex % BLADE;
    let blade = blades[item];
    let chance = blade.chance;
    let root = blade.root.xyz;
    let away = distance(root, frame.eye.xyz);
    let clump = noise_level(root.xy / 3.7, 0.0);
    let here = meadow(root.xy);
    let flower = fract(chance.z * 61.7) < FLOWER_SHARE * (0.3 + 2.5 * clump.r * here.dryness);
    let tall = blade.root.w * (0.10 + 0.30 * chance.z * (0.35 + clump.g)) * select(1.0, 1.25, flower);
    let broad = (0.0028 + 0.0011 * away) * min(blade.root.w, 1.0);

    let across = vec2f(cos(6.283 * chance.w), sin(6.283 * chance.w));
    let speed = length(frame.wind.xy);
    let along = dot(root.xy, frame.wind.xy) / (speed + 0.01);
    let gust = sin(0.55 * along - 2.1 * frame.eye.w + 4.0 * clump.r) + 0.4 * sin(2.3 * along - 6.7 * frame.eye.w + 9.0 * chance.x);
    let sway = frame.wind.xy / (speed + 4.0) * (0.55 + 0.30 * gust) * select(0.0, 1.0, speed > 0.0);
    let lean = (0.9 * chance.y - 0.25) * vec2f(-across.y, across.x) + 0.5 * (clump.rg - 0.5) + sway;

    // Rows: two vertices at the foot, two half way up, one at the tip.
    let rise = 0.5 * f32(corner / 2u);
    let side = select(f32(corner % 2u) * 2.0 - 1.0, 0.0, corner == 4u) * (1.0 - 0.7 * rise);
    let bend = lean * rise * rise * tall;
    let drop = 0.4 * dot(bend, bend) / max(tall, 0.01);
    var world = root + vec3f(across * side * broad + bend, rise * tall - drop - 0.02);
    let straw = mix(here.colour * 1.7, vec3f(0.22, 0.18, 0.075), 0.55 * here.dryness * chance.x);
    var colour = mix(here.colour * 0.5, straw, rise * (0.6 + 0.4 * chance.y));
    if flower {
        // A head alone, its stalk lost among the blades: a rhomb that looks up and a little aside.
        let spread = vec2f(select(0.0, side, corner == 2u || corner == 3u), 2.0 * rise - 1.0) * 1.25 * broad;
        let up = normalize(vec3f(lean, 0.8));
        let head = root + vec3f(lean * tall, tall);
        world = head + spread.x * vec3f(across, 0.0) + spread.y * cross(up, vec3f(across, 0.0));
        colour = petal_colour(root.xy, chance.y);
    }
    let normal = normalize(vec3f(0.3 * (chance.xy - 0.5) + 0.15 * bend / max(tall, 0.01), 1.0));
    let towards = normalize(world - frame.eye.xyz);
    let direct = caught_by_blades(max(dot(normal, frame.sun.xyz), 0.05));
    let through = 0.7 * pow(max(dot(towards, frame.sun.xyz), 0.0), 3.0);
    let light = frame.sun_light.rgb * (direct + through) * sunlight_once(world, normal) + ambient(normal) * 0.8;
    return BladeVertex(frame.view_projection * vec4f(world, 1.0), finished(colour * light, world).rgb);
}

@fragment
fn fragment(in: BladeVertex) -> @location(0) vec4f {
    return vec4f(in.colour, 1.0);
}
