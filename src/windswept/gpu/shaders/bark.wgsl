// Stems: Skjermo's generalized de Casteljau surface in closed form; geometry/bark.py is the same in NumPy.
// Set: types + light + pieces or bend_pieces, which say what posed_piece is, + bark. An instance is a batch of BATCH
// pieces, each a grid of RINGS by SIDES faces.

override RINGS: u32 = 4u;
override SIDES: u32 = 8u;
const BATCH = 32u;
const TAU = 6.283185307;

@group(1) @binding(0) var<storage, read> stems: array<Stem>;
@group(1) @binding(2) var<uniform> looks: array<Look, 544>;
@group(1) @binding(3) var<uniform> batch: Batch;

struct Surface {
    position: vec3f,
    normal: vec3f,
}

struct Bark {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) grain: vec2f,   // turns round the stem in texture widths, metres along it
    @location(3) shade: vec4f,   // openness, height above a trunk's foot in m, radius in m, a random number
    @location(4) @interpolate(flat) look: u32,
}

struct LitVertex {
    @builtin(position) clip: vec4f,
    @location(0) colour: vec3f,
}

// Weber and Penn's taper with its rounded and beaded ends, and its slope, over Z; see plants/radius.py.
fn taper_radius(stem: Stem, z: f32) -> vec2f {
    let taper = stem.profile.y;
    let unit = select(max(2.0 - taper, 0.0), taper, taper < 1.0);
    let plain = vec2f(stem.profile.x * (1.0 - unit * z), -stem.profile.x * unit);
    if taper < 1.0 { return plain; }
    let to_tip = vec2f((1.0 - z) * stem.extent.w, -stem.extent.w);
    let rounded = taper < 2.0;
    if rounded && to_tip.x >= plain.x { return plain; }
    let bead = 2.0 * max(plain, vec2f(1e-9, -1e9));
    let offset = to_tip - select(bead * floor(to_tip.x / bead.x + 0.5), vec2f(0.0), rounded);
    let along = select(offset * sign(offset.x), to_tip, rounded);
    let depth = select(taper - 2.0, 1.0, rounded || to_tip.x < plain.x);
    let inward = along - plain;
    let bulge = sqrt(max(plain.x * plain.x - inward.x * inward.x, 0.0));
    let slope = (plain.x * plain.y - inward.x * inward.y) / max(bulge, 0.05 * plain.x + 1e-9);
    return (1.0 - depth) * plain + depth * vec2f(bulge, slope);
}

fn flare_factor(flare: f32, z: f32) -> vec2f {
    let power = flare * pow(100.0, max(0.0, 1.0 - 8.0 * z)) / 100.0;
    return vec2f(1.0 - flare / 100.0 + power, select(0.0, -36.84136 * power, z < 0.125));
}

// Radius without lobes at a share of the stem's length, m, and its slope over that share.
fn profile(stem: Stem, span: f32) -> vec2f {
    let z = mix(stem.extent.y, stem.extent.z, span);
    let taper = taper_radius(stem, z);
    let flare = flare_factor(stem.profile.z, z);
    let smooth_radius = taper.x * flare.x;
    let smooth_slope = taper.x * flare.y + taper.y * flare.x;
    let rate = 6.283185307 * f32(stem.rows.w);
    let bulge = 1.0 + stem.attach.w * sin(rate * z);
    let slope = smooth_slope * bulge + smooth_radius * stem.attach.w * rate * cos(rate * z);
    return vec2f(smooth_radius * bulge, slope * (stem.extent.z - stem.extent.y));
}

fn surface(piece: PosedPiece, stem: Stem, t: f32, angle: f32) -> Surface {
    let s = 1.0 - t;
    let curve = s * s * s * piece.p0.xyz + 3.0 * s * s * t * piece.p1.xyz + 3.0 * s * t * t * piece.p2.xyz
        + t * t * t * piece.p3.xyz;
    let legs = mat3x3f(piece.p1.xyz - piece.p0.xyz, piece.p2.xyz - piece.p1.xyz, piece.p3.xyz - piece.p2.xyz);
    let sides = mat3x3f(piece.side0.xyz, piece.side1.xyz, piece.side2.xyz);
    let tops = mat3x3f(
        cross(sides[0], normalize(legs[0])),
        cross(sides[1], normalize(legs[1])),
        cross(sides[2], normalize(legs[2])),
    );
    let weights = vec3f(s * s, 2.0 * s * t, t * t);
    let slopes = vec3f(-2.0 * s, 2.0 - 4.0 * t, 2.0 * t);
    let round = vec2f(sin(angle), cos(angle));
    let out = round.x * (sides * weights) + round.y * (tops * weights);
    let around = round.y * (sides * weights) - round.x * (tops * weights);
    let turning = round.x * (sides * slopes) + round.y * (tops * slopes);

    let extent = piece.p1.w - piece.p0.w;
    let span = mix(piece.p0.w, piece.p1.w, t);
    let lobes = stem.profile.w;
    let lobe = 1.0 + stem.extent.x * sin(lobes * angle);
    let shape = profile(stem, span) * piece.side0.w * lobe;
    let radius = shape.x;
    let taper = shape.y * extent;
    let swell = radius / lobe * stem.extent.x * lobes * cos(lobes * angle);

    let along = 3.0 * (legs * weights) + radius * turning + taper * out;
    return Surface(curve + radius * out, normalize(cross(swell * out + max(radius, 1e-5) * around, along)));
}

struct Place {
    item: u32,
    t: f32,
    turn: f32,
}

// Which piece of the batch a vertex belongs to and where on its grid it sits.
fn place(vertex: u32, instance: u32) -> Place {
    let row = SIDES + 1u;
    let grid = vertex % ((RINGS + 1u) * row);
    let item = instance * BATCH + vertex / ((RINGS + 1u) * row);
    return Place(item, f32(grid / row) / f32(RINGS), f32(grid % row) / f32(SIDES));
}

fn posed_vertex(vertex: u32, instance: u32) -> Bark {
    let at = place(vertex, instance);
    var out: Bark;
    if at.item >= batch.items.y { return out; }
    let piece = posed_piece(batch.items.x + at.item);
    let stem = stems[piece.rows.x];
    let point = surface(piece, stem, at.t, at.turn * TAU);
    let span = mix(piece.p0.w, piece.p1.w, at.t);
    let radius = profile(stem, span).x;
    let is_trunk = stem.rows.x == NONE;
    // A trunk's first ring is buried, so that no light shows under it on a slope.
    let buried = select(0.0, 0.6 * radius, is_trunk && span == 0.0);
    let world = point.position - vec3f(0.0, 0.0, buried);
    let girth = TAU * stem.profile.x;
    out.clip = frame.view_projection * vec4f(world, 1.0);
    out.world = world;
    out.normal = point.normal;
    let foot = select(1e3, span * stem.attach.z, is_trunk);
    out.grain = vec2f(at.turn * max(1.0, round(girth / 0.8)), span * stem.attach.z / 2.6 + 7.3 * piece.side1.w);
    out.shade = vec4f(mix(piece.p2.w, piece.p3.w, at.t), foot, radius, fract(piece.side1.w * 3.7));
    out.look = piece.rows.y;
    return out;
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Bark {
    return posed_vertex(vertex, instance);
}

@vertex
fn shadow(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    let at = place(vertex, instance);
    if at.item >= batch.items.y { return vec4f(0.0); }
    let piece = posed_piece(batch.items.x + at.item);
    let point = surface(piece, stems[piece.rows.x], at.t, at.turn * TAU);
    return frame.sun_projection * vec4f(point.position, 1.0);
}

// Turn a normal by the slope of a height field known only per pixel (Mikkelsen 2010).
fn bumped(normal: vec3f, world: vec3f, height: f32) -> vec3f {
    let x = dpdx(world);
    let y = dpdy(world);
    let across = cross(y, normal);
    let up = cross(normal, x);
    let scale = dot(x, across);
    let slope = sign(scale) * (dpdx(height) * across + dpdy(height) * up);
    return normalize(abs(scale) * normal - slope + 1e-9 * normal);
}

// Young wood is brown whatever the trunk's bark, but for stems that are of a colour of their own: green, red, straw.
fn wood_colour(bark: vec3f, radius: f32) -> vec3f {
    let most = max(bark.r, max(bark.g, bark.b));
    let least = min(bark.r, min(bark.g, bark.b));
    let plain = smoothstep(0.70, 0.58, (most - least) / max(most, 1e-4));
    return mix(bark, vec3f(0.13, 0.095, 0.06), 0.75 * plain * smoothstep(0.035, 0.010, radius));
}

@fragment
fn fragment(in: Bark) -> @location(0) vec4f {
    let look = looks[in.look];
    let coarse = noise(in.grain).b;
    let fine = noise(in.grain * 3.0 + 0.4).b;
    let broad = noise(in.grain * vec2f(0.5, 0.23) + 0.37).r;
    let scars = noise(in.grain * vec2f(0.6, 3.1)).g;
    // Bark breaks up as stems grow thick; twigs are smooth.
    let relief = look.bark.w * smoothstep(0.015, 0.12, in.shade.z);
    let furrow = mix(coarse, fine, 0.35);
    let near = clamp(14.0 / distance(in.world, frame.eye.xyz) - 0.3, 0.0, 1.0);
    let normal = bumped(normalize(in.normal), in.world, near * relief * 0.05 * furrow);

    let foot = smoothstep(-0.1, 0.9, in.shade.y + 0.5 * broad);
    let pale = smoothstep(0.30, 0.45, dot(look.bark.rgb, vec3f(0.333)));
    var albedo = wood_colour(look.bark.rgb, in.shade.z) * mix(1.0, 0.30 + 1.0 * furrow, 0.25 + 0.75 * relief) * (0.72 + 0.5 * broad);
    albedo *= 1.0 - 0.75 * pale * smoothstep(0.66, 0.76, scars) * smoothstep(0.02, 0.06, in.shade.z);
    albedo = mix(mix(albedo * 0.6, vec3f(0.055, 0.065, 0.025), 0.5 * broad), albedo, foot);

    let direct = max(dot(normal, frame.sun.xyz), 0.0);
    var light = ambient(normal) * (0.25 + 0.75 * in.shade.x) * (0.6 + 0.4 * furrow) * (0.5 + 0.5 * foot);
    if direct > 0.0 { light += frame.sun_light.rgb * direct * sunlight(in.world, in.normal); }
    return finished(albedo * light, in.world);
}

// Stems of a few pixels are lit at their vertices and have no furrows.
@vertex
fn vertex_lit(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> LitVertex {
    let in = posed_vertex(vertex, instance);
    let direct = max(dot(in.normal, frame.sun.xyz), 0.0);
    let sun = frame.sun_light.rgb * direct * sunlight_once(in.world, in.normal);
    let light = sun + ambient(in.normal) * (0.25 + 0.75 * in.shade.x);
    let albedo = wood_colour(looks[in.look].bark.rgb, in.shade.z) * (0.7 + 0.4 * in.shade.w);
    return LitVertex(in.clip, finished(albedo * light, in.world).rgb);
}

@fragment
fn fragment_lit(in: LitVertex) -> @location(0) vec4f {
    return vec4f(in.colour, 1.0);
}
