// The motion of many blades, a lane a blade: motion/blades/step_blades.py on the card.
// Set: air_grid + lean_types + lean.
//
// Constants and leans lie in the CPU's tiles of eight blades: a row of a tile is the 32 bytes that a card fetches at
// once, so nothing that is fetched is wasted and nothing has to be laid out anew.

const WIDTH = 8u;             // blades in a tile
const BLOCK = 64u;            // blades of one kind in a workgroup
const CONSTANT_ROWS = 19u;
const STATE_ROWS = 7u;
const LARGEST_FORCE = 1e4;    // force scales
const REST_THRESHOLD = 1e-9;
const TINY = 1e-30;
const MOST_BITS = 0x7149f2cau;   // of 1e30; those of infinity and of what is no number are larger

@group(0) @binding(0) var<storage, read> blocks: array<LeanBlock>;
@group(0) @binding(1) var<storage, read> kinds: array<LeanKind>;
@group(0) @binding(2) var<storage, read> constants: array<f32>;   // as many tiles as the card binds at once
@group(0) @binding(3) var<storage, read> nodes: array<vec4f>;   // of every node velocity, m/s, then pressure, N/m^2
@group(0) @binding(4) var<storage, read_write> leans: array<f32>;
@group(0) @binding(5) var<storage, read_write> clamped: array<atomic<u32>, 1>;
@group(0) @binding(6) var<uniform> grids: array<AirGrid, 2>;
// No uniform: Mesa's software driver would compile the kernel anew, and keep it, for every dispatch of few steps.
@group(0) @binding(7) var<storage, read> lean_pass: LeanPass;

struct Air {
    wind: vec3f,
    push: vec3f,
}

struct Blade {
    frame: mat3x3f,   // columns axis, normal, side
    drag: f32,
    reach: f32,
    flat_step: vec4f,
    side_step: vec4f,
}

struct Motion {
    lean: vec3f,
    rate: vec3f,
    broken: f32,
    in_bounds: f32,
}

fn constant(at: u32, row: u32) -> f32 {
    return constants[at + row * WIDTH];
}

fn constant3(at: u32, row: u32) -> vec3f {
    return vec3f(constant(at, row), constant(at, row + 1u), constant(at, row + 2u));
}

fn constant4(at: u32, row: u32) -> vec4f {
    return vec4f(constant3(at, row), constant(at, row + 3u));
}

fn blade_at(at: u32) -> Blade {
    let axis = constant3(at, 3u);
    let normal = constant3(at, 6u);
    return Blade(
        mat3x3f(axis, normal, cross(axis, normal)),
        constant(at, 9u),
        constant(at, 10u),
        constant4(at, 11u),
        constant4(at, 15u)
    );
}

fn between(a: Air, b: Air, part: f32) -> Air {
    return Air(mix(a.wind, b.wind, part), mix(a.push, b.push, part));
}

// Between a node and the one above it.
fn column(node: u32, part: f32) -> Air {
    let low = Air(nodes[2u * node].xyz, nodes[2u * node + 1u].xyz);
    let high = Air(nodes[2u * node + 2u].xyz, nodes[2u * node + 3u].xyz);
    return between(low, high, part);
}

// The air at x, y and height, trilinear; outside the grid that on its border.
fn air_at(grid: AirGrid, place: vec3f) -> Air {
    let cell = cell_of(grid, clamp(in_cells(grid, place), vec3f(0.0), last_cells(grid)));
    let part = cell.part;
    let beyond = cell.node + cell.along_x;
    let near = between(column(cell.node, part.z), column(cell.node + cell.along_y, part.z), part.y);
    let far = between(column(beyond, part.z), column(beyond + cell.along_y, part.z), part.y);
    return between(near, far, part.x);
}

// base^exponent for a base from 1 up: the CPU's polynomials, so that every card agrees with it to 1e-6.
fn raised(base: f32, exponent: f32) -> f32 {
    let bits = bitcast<u32>(base);
    let m = bitcast<f32>((bits & 0x7fffffu) | 0x3f800000u) - 1.0;
    let low = -0.32461638 + m * (0.19238506 + m * (-0.078158208 + m * 0.015127916));
    let mantissa = m * (1.4426640 + m * (-0.72051551 + m * (0.47311335 + m * low)));
    let x = (f32(bits >> 23u) - 127.0 + mantissa) * exponent;
    let octave = floor(x + 0.5);
    let p = x - octave;
    let part = 1.0 + p * (0.69314721 + p * (0.24022228 + p * (0.055503272 + p * (0.0096721717 + p * 0.0013400432))));
    return ldexp(part, i32(octave));
}

// Drag of the air on the moving blade, and the push, in the base frame and force scales. `damping` bounds what the
// blade's own velocity can do in one step and leaves the force on a blade at rest untouched.
fn force_of(kind: LeanKind, blade: Blade, drag: f32, damping: f32, air: Air, moving: vec3f) -> vec3f {
    let relative = air.wind - moving;
    let speed = sqrt(dot(relative, relative) + TINY);
    let u = air.wind - moving / (speed * damping + 1.0);
    let square = dot(u, u);
    let felt = drag * raised(1.0 + square * kind.air.y, kind.share.w) * sqrt(square + TINY);
    return (u * blade.frame) * felt * kind.share.xyz + (air.push * blade.frame) * (drag * kind.air.x);
}

// The force, none where it is no number, at most LARGEST_FORCE; w is 1 where nothing had to be done.
fn kept_in_bounds(force: vec3f) -> vec4f {
    let square = dot(force, force);
    if bitcast<u32>(square) > MOST_BITS { return vec4f(0.0); }
    let sound = select(0.0, 1.0, square <= LARGEST_FORCE * LARGEST_FORCE);
    return vec4f(force * min(LARGEST_FORCE / sqrt(square + TINY), 1.0), sound);
}

// Lean of weight and force less that of the weight: exactly zero without a force (step_blades._equilibrium).
fn equilibrium(weight: vec3f, force: vec3f) -> vec3f {
    let own = 1.0 + dot(weight, weight);
    let more = dot(force, force) + 2.0 * dot(weight, force);
    let before = sqrt(own);
    let after = sqrt(own + more);
    return force / after - weight * (more / ((after + before) * before * after));
}

fn settled(value: vec3f) -> vec3f {
    return select(vec3f(0.0), value, abs(value) >= vec3f(REST_THRESHOLD));
}

// One exact step of the constraint law, along, across and aside.
fn swung(blade: Blade, target_lean: vec3f, motion: Motion) -> Motion {
    let y = motion.lean - target_lean;
    let f = blade.flat_step;
    let s = blade.side_step;
    let lean = target_lean + y * vec3f(f.x, f.x, s.x) + motion.rate * vec3f(f.y, f.y, s.y);
    let rate = y * vec3f(f.z, f.z, s.z) + motion.rate * vec3f(f.w, f.w, s.w);
    return Motion(settled(lean), settled(rate), motion.broken, motion.in_bounds);
}

fn stepped(kind: LeanKind, blade: Blade, air: Air, motion: Motion) -> Motion {
    let softer = motion.broken * kind.bounds.x + 1.0;
    let drag = blade.drag * softer;
    let weight = vec3f(blade.frame[0].z, blade.frame[1].z, blade.frame[2].z) * (-kind.air.z * softer);
    let across = blade.frame[1] * (motion.rate.y * blade.reach);
    let moving = across + blade.frame[2] * (motion.rate.z * blade.reach * kind.air.w);
    let damping = -2.0 * drag * blade.reach * blade.flat_step.z;
    let force = kept_in_bounds(force_of(kind, blade, drag, damping, air, moving));
    let swing = swung(blade, equilibrium(weight, force.xyz), motion);
    let bent = swing.lean + weight / sqrt(1.0 + dot(weight, weight));
    // No blade leans further than its length: there its swing ends.
    let shorter = min(1.0 / sqrt(dot(bent, bent) + TINY), 1.0);
    let bending = vec3f(min(bent.x, 0.0), bent.yz);
    return Motion(
        swing.lean + bent * (shorter - 1.0),
        swing.rate * shorter,
        select(1.0, motion.broken, dot(bending, bending) <= kind.bounds.y),
        motion.in_bounds * force.w
    );
}

fn motion_at(at: u32) -> Motion {
    return Motion(
        vec3f(leans[at], leans[at + WIDTH], leans[at + 2u * WIDTH]),
        vec3f(leans[at + 3u * WIDTH], leans[at + 4u * WIDTH], leans[at + 5u * WIDTH]),
        leans[at + 6u * WIDTH],
        1.0
    );
}

fn write_motion(at: u32, motion: Motion) {
    for (var a = 0u; a < 3u; a++) {
        leans[at + a * WIDTH] = motion.lean[a];
        leans[at + (a + 3u) * WIDTH] = motion.rate[a];
    }
    leans[at + 6u * WIDTH] = motion.broken;
}

// A workgroup takes a block: its blades' air once, then the steps that are due.
@compute @workgroup_size(64)
fn step_blades(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < arrayLength(&blocks); b += spread.x) {
        let block = blocks[b].rows;
        if lane >= block.y { continue; }
        let tile = block.x + lane / WIDTH;
        let constants_at = (tile - lean_pass.steps.y) * CONSTANT_ROWS * WIDTH + lane % WIDTH;
        let leans_at = tile * STATE_ROWS * WIDTH + lane % WIDTH;
        let kind = kinds[block.z];
        let blade = blade_at(constants_at);
        let air = air_at(grids[block.w], constant3(constants_at, 0u));
        var motion = motion_at(leans_at);
        for (var step = 0u; step < lean_pass.steps.x; step++) { motion = stepped(kind, blade, air, motion); }
        write_motion(leans_at, motion);
        if motion.in_bounds < 0.5 { atomicAdd(&clamped[0], 1u); }
    }
}
