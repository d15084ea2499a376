// Where every section of every blade in sight is: motion/blades/pose_blades.py on the card, a blade a thread. They are
// lit here as well, joint by joint. Set: types + light + meadow + rotation + blades_types + blades_light + blades_pose.

override LAST_NORM: f32 = 0.95276552;
const LARGEST_LEAN = 0.99999;
const STATE_ROWS = 7u;
const WIDTH = 8u;
const LEAST_LINE = 0.22;   // half width on the screen, pixels
const FADE = 0.25;   // of the blades that are drawn, the last ones grow thin

@group(1) @binding(0) var<storage, read> blades: array<BladeRow>;
@group(1) @binding(1) var<storage, read> items: array<vec4u>;   // blade; first posed joint; run; carrier
@group(1) @binding(2) var<storage, read> leans: array<f32>;
@group(1) @binding(3) var<storage, read> tables: array<vec2f>;
@group(1) @binding(4) var<storage, read> runs: array<BladeRun>;
@group(1) @binding(5) var<storage, read> borders: array<f32>;
@group(1) @binding(6) var<storage, read_write> posed: array<PosedJoint>;
@group(1) @binding(7) var<uniform> meadow_pass: MeadowPass;
// A carrier is the parent's first posed joint x 16 + its sections - 1, or NONE on the ground.

struct Basis {
    axis: vec3f,
    normal: vec3f,
    side: vec3f,
}

struct Root {
    place: vec3f,
    basis: Basis,
}

// Where a lean lies in a table: the bin's first node, and how far into the bin along angle, norm and direction.
struct Bin {
    first: u32,
    along_angle: u32,
    along_norm: u32,
    part: vec3f,
    mirror: f32,
}

fn normal_of(facing: vec4u) -> vec3f {
    return vec3f(unpack2x16snorm(facing.y).y, unpack2x16snorm(facing.z));
}

fn orthogonal(axis: vec3f, normal: vec3f) -> Basis {
    let across = normalize(normal - axis * dot(axis, normal));
    return Basis(axis, across, cross(axis, across));
}

// The root in the world, and the base frame there.
fn root_of(blade: BladeRow, carrier: u32) -> Root {
    let q = vec4f(unpack2x16snorm(blade.bits.x), unpack2x16snorm(blade.bits.y));
    let unit = q / length(q);
    let own = Basis(rotate(unit, vec3f(1.0, 0.0, 0.0)), rotate(unit, vec3f(0.0, 1.0, 0.0)), rotate(unit, vec3f(0.0, 0.0, 1.0)));
    if carrier == NONE { return Root(blade.place.xyz, own); }
    let parent = carrier >> 4u;
    let sections = (carrier & 15u) + 1u;
    let along = clamp(blade.place.x, 0.0, 1.0) * f32(sections);
    let section = min(u32(along), sections - 1u);
    let below = posed[parent + section];
    let above = posed[parent + section + 1u];
    let held = orthogonal(normalize(above.place.xyz - below.place.xyz), normal_of(below.facing) + normal_of(above.facing));
    let frame_of = mat3x3f(held.axis, held.normal, held.side);
    return Root(
        mix(below.place.xyz, above.place.xyz, along - f32(section)),
        Basis(frame_of * own.axis, frame_of * own.normal, frame_of * own.side)
    );
}

// z of the base frame's axis, normal and side at rest: where its weight pulls.
fn rest_down(bits: vec4u) -> vec3f {
    let folded = unpack2x16snorm(bits.z) + unpack4x8snorm(bits.w).zw * (0.5 / 32767.0);
    var down = vec3f(folded, 1.0 - abs(folded.x) - abs(folded.y));
    let under = max(-down.z, 0.0);
    down.x += select(under, -under, down.x >= 0.0);
    down.y += select(under, -under, down.y >= 0.0);
    return normalize(down);
}

fn bin_of(table: vec4u, sections: u32, lean: vec3f) -> Bin {
    let across = length(lean.yz);
    let size = min(length(lean), LARGEST_LEAN);
    let load = size / sqrt(1.0 - size * size);
    let place = vec3f(
        atan2(across, lean.x) / 3.14159265,
        (1.0 - 1.0 / sqrt(1.0 + 2.0 * load)) / LAST_NORM,
        atan2(abs(lean.z), lean.y) / 3.14159265
    ) * vec3f(table.yzw);
    let cell = clamp(floor(place), vec3f(0.0), vec3f(table.yzw) - 1.0);
    let node = vec3u(cell);
    let along_norm = (table.w + 1u) * sections;
    let along_angle = (table.z + 1u) * along_norm;
    let first = table.x + node.x * along_angle + node.y * along_norm + node.z * sections;
    return Bin(first, along_angle, along_norm, place - cell, select(-1.0, 1.0, lean.z >= 0.0));
}

// Turns of one joint, interpolated between the eight nodes round the lean.
fn turns_at(bin: Bin, sections: u32, joint: u32) -> vec2f {
    let a = bin.first + joint;
    let b = a + bin.along_norm;
    let c = a + bin.along_angle;
    let d = c + bin.along_norm;
    let w = bin.part.z;
    let here = mix(mix(tables[a], tables[a + sections], w), mix(tables[b], tables[b + sections], w), bin.part.y);
    let there = mix(mix(tables[c], tables[c + sections], w), mix(tables[d], tables[d + sections], w), bin.part.y);
    return mix(here, there, bin.part.x) * vec2f(1.0, bin.mirror);
}

// Bent across the flat face, then to the side.
fn bent(f: Basis, turn: vec2f) -> Basis {
    let c = cos(turn);
    let s = sin(turn);
    let ahead = f.axis * c.x + f.normal * s.x;
    return Basis(ahead * c.y + f.side * s.y, f.normal * c.x - f.axis * s.x, f.side * c.y - ahead * s.y);
}

// How much wider than itself a blade is drawn: few stand for many, and the last of the few are thin.
fn widening(run: BladeRun, chance: f32, away: f32) -> f32 {
    let share = run.width.x * meadow_pass.now.y / (away * meadow_pass.now.z);
    let shown = clamp((share - chance) / (FADE * share), 0.0, 1.0);
    let all = min(share, 1.0 / (1.0 - FADE));
    let past = max(all - 1.0, 0.0);
    let mean_shown = select(
        (1.0 - 0.5 * FADE) * all,
        (1.0 - FADE) * all + (FADE * FADE * all * all - past * past) / (2.0 * FADE * all),
        all > 1.0
    );
    let last = meadow_pass.now.w;
    return run.width.y * shown / mean_shown * (1.0 - smoothstep(0.7 * last, last, away));
}

// From the axis to the right border, at least as wide on the screen as a line must be to be drawn unbroken: a strip
// seen at its edge is turned a little to the eye.
fn border_of(axis: vec3f, side: vec3f, half_width: f32, run: BladeRun, place: vec3f) -> vec3f {
    let ray = frame.eye.xyz - place;
    let across = normalize(cross(axis, ray) + vec3f(1e-12, 0.0, 0.0));
    let seen = half_width * dot(side, across);
    let least = LEAST_LINE * length(ray) / meadow_pass.now.y * clamp(20.0 * half_width / run.width.x, 0.0, 1.0);
    return half_width * side + select(-1.0, 1.0, seen >= 0.0) * max(least - abs(seen), 0.0) * across;
}

// A joint between two sections, lit. A stalk is drawn as a strip that turns to the eye.
fn joint_between(
    before: Basis, after: Basis, place: vec3f, half_width: f32, run: BladeRun, look: BladeLook, along: f32
) -> PosedJoint {
    let normal = normalize(before.normal + after.normal);
    var side = normalize(before.side + after.side);
    var facing = normal;
    if run.width.z > 0.5 {
        facing = normalize(frame.eye.xyz - place);
        side = normalize(cross(before.axis + after.axis, facing));
    }
    let border = border_of(before.axis + after.axis, side, half_width, run, place);
    let reach = length(border);
    side = border / max(reach, 1e-9);
    let lit = sqrt(finished(blade_light(run, look, facing, along, place), place).rgb);
    let colour = vec3u(round(1023.0 * clamp(lit, vec3f(0.0), vec3f(1.0))));
    return PosedJoint(vec4f(place, reach), vec4u(
        pack2x16snorm(side.xy),
        pack2x16snorm(vec2f(side.z, normal.x)),
        pack2x16snorm(normal.yz),
        colour.r | (colour.g << 10u) | (colour.b << 20u)
    ));
}

@compute @workgroup_size(64)
fn pose(@builtin(global_invocation_id) id: vec3u) {
    let number = id.x + id.y * 65536u;
    if number >= meadow_pass.items.y { return; }
    let item = items[meadow_pass.items.x + number];
    let blade = blades[item.x];
    let run = runs[item.z];
    // Only where all have two sections (make_room of blade_choice.wgsl), so that what hangs on it comes after it.
    if item.y + run.rows.z >= arrayLength(&posed) { return; }
    let root = root_of(blade, item.w);
    let chance = f32(blade.bits.w & 0xffffu) / 65536.0;
    let size = blade.place.w;
    let sections = run.rows.z;

    var moved = vec3f(0.0);
    var broken = false;
    if run.rows.y != NONE {
        let local = item.x - run.rows.x;
        let at = run.rows.y + (local / WIDTH) * STATE_ROWS * WIDTH + local % WIDTH;
        let lean = vec3f(leans[at], leans[at + WIDTH], leans[at + 2u * WIDTH]);
        let rate = vec3f(leans[at + 3u * WIDTH], leans[at + 4u * WIDTH], leans[at + 5u * WIDTH]);
        moved = lean + meadow_pass.now.x * rate;
        broken = leans[at + 6u * WIDTH] > 0.5;
    }
    let weight = -run.shape.y * select(1.0, run.shape.z, broken) * rest_down(blade.bits);
    let lean = moved + weight / sqrt(1.0 + dot(weight, weight));
    var table = run.whole;
    if broken { table = run.broken; }
    let bin = bin_of(table, sections, lean);

    let wide = pow(size, run.shape.w) * widening(run, chance, max(distance(root.place, frame.eye.xyz), 0.3));
    let step = size * run.shape.x;
    let look = blade_look(chance, root.place, 0.6 * step * f32(sections));
    var before = bent(root.basis, turns_at(bin, sections, 0u));
    var place = root.place;
    // The base frame is no section: at the root the surface faces as the first one does.
    posed[item.y] = joint_between(before, before, place, wide * borders[run.rows.w], run, look, 0.0);
    for (var joint = 1u; joint < sections; joint += 1u) {
        let now = bent(before, turns_at(bin, sections, joint));
        place += step * before.axis;
        let half_width = wide * borders[run.rows.w + joint];
        let along = f32(joint) / f32(sections);
        posed[item.y + joint] = joint_between(before, now, place, half_width, run, look, along);
        before = now;
    }
    place += step * before.axis;
    let end = wide * borders[run.rows.w + sections];
    posed[item.y + sections] = joint_between(before, before, place, end, run, look, 1.0);
}
