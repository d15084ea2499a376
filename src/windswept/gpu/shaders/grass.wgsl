// Tufts of meadow grass round the camera, one blade of five vertices a cell of a world-fixed lattice.
// Set: types + light + grass. SPACING grows from ring to ring and blades with it.

override SPACING: f32 = 0.12;
override INNER: f32 = 0.0;
const CELLS = 110u;
const BLADE = 5u;
const BATCH = 64u;

@group(1) @binding(0) var height_map: texture_2d<f32>;

struct Blade {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec3f,
}

fn hashed(cell: vec2i) -> vec4f {
    var h = bitcast<u32>(cell.x) * 0x9e3779b9u ^ bitcast<u32>(cell.y) * 0x85ebca6bu;
    h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12u)) * 0x297a2d39u;
    h = h ^ (h >> 15u);
    return vec4f(vec4u(h, h >> 8u, h >> 16u, h >> 24u) & vec4u(255u)) / 255.0;
}

fn ground_height(at: vec2f) -> f32 {
    let size = vec2i(textureDimensions(height_map));
    let grid = clamp((at - frame.terrain.xy) / frame.terrain.z, vec2f(0.0), vec2f(size - 1) - 1e-3);
    let cell = vec2i(grid);
    let part = fract(grid);
    let low = mix(textureLoad(height_map, cell, 0).r, textureLoad(height_map, cell + vec2i(1, 0), 0).r, part.x);
    let up = cell + vec2i(0, 1);
    let high = mix(textureLoad(height_map, up, 0).r, textureLoad(height_map, up + vec2i(1, 0), 0).r, part.x);
    return mix(low, high, part.y);
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Blade {
    let item = instance * BATCH + vertex / BLADE;
    let corner = vertex % BLADE;
    let centre = vec2i(floor(frame.eye.xy / SPACING));
    let cell = centre + vec2i(i32(item % CELLS), i32(item / CELLS)) - i32(CELLS / 2u);
    let chance = hashed(cell);
    let root = (vec2f(cell) + chance.xy) * SPACING;
    let reach = 0.5 * f32(CELLS) * SPACING;
    let away = distance(root, frame.eye.xy);

    let patch_noise = textureSampleLevel(noise_map, noise_sampler, root / 13.0 + 0.3, 0.0).r;
    let clump = textureSampleLevel(noise_map, noise_sampler, root / 4.7, 0.0).r;
    let fade = smoothstep(INNER * 0.8, INNER * 1.2 + 1e-3, away) * (1.0 - smoothstep(0.75 * reach, reach, away));
    let tall = (0.14 + 0.34 * chance.z * clump) * (1.0 - smoothstep(0.60, 0.75, patch_noise)) * fade;
    let broad = (0.0035 + 0.03 * SPACING) * min(1.0, 3.0 * fade);

    let heading = 6.283 * chance.w + 2.0 * clump;
    let across = vec2f(cos(heading), sin(heading));
    let gust = sin(0.9 * dot(root, frame.wind.xy) / (length(frame.wind.xy) + 0.1) - 2.3 * frame.eye.w
        + 5.0 * clump + 1.5 * chance.x);
    let sway = frame.wind.xy * 0.035 * (0.7 + 0.5 * gust);
    let lean = 0.45 * vec2f(-across.y, across.x) * (chance.y - 0.3) + sway;

    // Rows: two vertices at the foot, two half way up, one at the tip; the tip leans with the square of height.
    let rise = f32(corner / 2u) * 0.5;
    let side = select(f32(corner % 2u) * 2.0 - 1.0, 0.0, corner == 4u) * (1.0 - 0.45 * rise);
    let bend = lean * rise * rise * tall * 1.6;
    let foot = vec3f(root, ground_height(root) - 0.02);
    let drop = 0.35 * dot(bend, bend) / max(tall, 0.01);
    let world = foot + vec3f(across * side * broad + bend, rise * tall - drop);

    let tip = mix(vec3f(0.050, 0.105, 0.016), vec3f(0.16, 0.17, 0.05), rise * (0.35 + 0.4 * chance.z));
    let facing = normalize(vec3f(-across.y, across.x, 0.8) * vec3f(select(-1.0, 1.0, chance.x > 0.5)));
    return Blade(
        frame.view_projection * vec4f(world, 1.0),
        world,
        normalize(facing * 0.5 + vec3f(0.0, 0.0, 1.0)),
        tip * (0.45 + 0.75 * rise),
    );
}

@fragment
fn fragment(in: Blade) -> @location(0) vec4f {
    let direct = max(dot(in.normal, frame.sun.xyz), 0.0);
    let towards = normalize(in.world - frame.eye.xyz);
    let through = 0.9 * pow(max(dot(towards, frame.sun.xyz), 0.0), 3.0);
    let light = frame.sun_light.rgb * (direct + through) * sunlight_once(in.world, in.normal) + ambient(in.normal);
    return finished(in.colour * light, in.world);
}
