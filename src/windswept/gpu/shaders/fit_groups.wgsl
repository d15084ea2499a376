// A group that a placement joins takes the pressure whose static shape is nearest in elastic energy to how the joints
// are: Gauss and Newton's method of levels/carry_over.py. Set: motion + rotation + joints + fit_groups.
// A workgroup takes a group of a placement; the sums over its joints are taken by all its lanes.

@group(0) @binding(0) var<uniform> kinds: array<Kind, 512>;
@group(0) @binding(1) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(2) var<storage, read> listeners: array<vec4u>;
@group(0) @binding(3) var<storage, read> shapes: array<Shape>;
@group(0) @binding(4) var<storage, read> links: array<Link>;
@group(0) @binding(5) var<storage, read> groups: array<Group>;
@group(0) @binding(6) var<storage, read> motions: array<Motion>;
@group(0) @binding(7) var<storage, read> joins: array<u32>;
@group(0) @binding(8) var<storage, read_write> state: array<vec4f>;
@group(0) @binding(9) var<storage, read> notes: array<vec4f>;   // motion and rotation of every link, from `join`
@group(0) @binding(10) var<uniform> tally: vec4u;

override LONGEST: u32 = 1u;   // links of the largest plant

// As in levels/carry_over.py: where shapes are far from linear the rounds do not close in, and their number counts.
const MOST_ROUNDS = 12u;
const REGULAR = 2e-5;
const CLOSE = 1e-5;

// What the joints ask of a change of the pressure: normal matrix, right side of the pressure and of its rate.
struct Equations {
    diagonal: vec3f,
    aside: vec3f,     // xy, xz, yz
    right: vec3f,
    rates: vec3f,
}

var<workgroup> parts: array<Equations, 64>;
var<workgroup> is_close: u32;

// One angle's part: `slope` in the frame of the carrier, and what is missing of the angle and of its rate.
fn add_angle(sum: Equations, slope: vec3f, stiffness: f32, missing: f32, rate: f32) -> Equations {
    let weighted = stiffness * slope;
    return Equations(
        sum.diagonal + weighted * slope,
        sum.aside + weighted.xxy * slope.yzz,
        sum.right + missing * weighted,
        sum.rates + rate * weighted,
    );
}

// How one angle would change with the pressure if nothing held it; see shape_slopes in motion/shapes.py.
fn unheld_slope(linear: vec3f, square: vec3f, mixed: vec3f, u: vec3f, limit: f32) -> vec3f {
    let short = limit / sqrt(max(dot(u, u), limit * limit));
    return linear + short * second_order_slope(square, mixed, u);
}

// A joint's part: `joint` is its motion, `pressure` what the group has so far.
fn add_joint(
    sum: Equations, shape: Shape, joint: vec4f, q_parent: vec4f, q: vec4f, pressure: vec3f, limit: f32
) -> Equations {
    let u = felt(q_parent, q, pressure);
    let angles = shaped(shape, u, limit);
    let slope_1 = felt(q, q_parent, unheld_slope(shape.linear_1.xyz, shape.square_1.xyz, shape.mixed_1.xyz, u, limit));
    let slope_2 = felt(q, q_parent, unheld_slope(shape.linear_2.xyz, shape.square_2.xyz, shape.mixed_2.xyz, u, limit));
    let first = add_angle(sum, slope_1, shape.linear_1.w, joint.x - angles.x, joint.y);
    return add_angle(first, slope_2, shape.linear_2.w, joint.z - angles.y, joint.w);
}

fn add_up(lane: u32, part: Equations) -> Equations {
    workgroupBarrier();
    parts[lane] = part;
    for (var reach = 32u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            let other = parts[lane + reach];
            let own = parts[lane];
            parts[lane] = Equations(
                own.diagonal + other.diagonal, own.aside + other.aside, own.right + other.right, own.rates + other.rates,
            );
        }
    }
    workgroupBarrier();
    return parts[0];
}

// Change of the pressure and its rate, by L D L^T; no pivot is smaller than the regular part.
fn solve(sum: Equations, pressure: vec3f) -> mat2x3f {
    let trace = sum.diagonal.x + sum.diagonal.y + sum.diagonal.z;
    if trace <= 0.0 { return mat2x3f(); }
    let least = REGULAR * trace;
    let x = sum.diagonal.x + least;
    let lower_y = sum.aside.x / x;
    let lower_z = sum.aside.y / x;
    let y = max(sum.diagonal.y + least - lower_y * sum.aside.x, least);
    let cross_z = (sum.aside.z - lower_y * sum.aside.y) / y;
    let z = max(sum.diagonal.z + least - lower_z * sum.aside.y - cross_z * cross_z * y, least);
    let right = sum.right - least * pressure;
    let first = vec2f(right.x, sum.rates.x);
    let second = vec2f(right.y, sum.rates.y) - lower_y * first;
    let third = (vec2f(right.z, sum.rates.z) - lower_z * first - cross_z * second) / z;
    let middle = second / y - cross_z * third;
    let outer = first / x - lower_y * middle - lower_z * third;
    return mat2x3f(vec3f(outer.x, middle.x, third.x), vec3f(outer.y, middle.y, third.y));
}

// Pressure and rate of a group whose joints are a range of the plant's links.
fn fitted(lane: u32, group: Group, carrier: u32, kind: Kind, first: u32) -> mat2x3f {
    var q = vec4f(0.0, 0.0, 0.0, 1.0);
    if carrier != NONE { q = notes[first + 2u * carrier + 1u]; }
    var pressure = vec3f(0.0);
    var rate = vec3f(0.0);
    for (var round = 0u; round < MOST_ROUNDS; round++) {
        // Written out: a variable without a value is not cleared again at every turn of a loop (naga 27).
        var part = Equations(vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0));
        for (var i = group.rows.y + lane; i < group.rows.y + group.rows.z; i += 64u) {
            let parent = links[kind.joints.x + i].rows.x;
            var q_parent = vec4f(0.0, 0.0, 0.0, 1.0);
            if parent != NONE { q_parent = notes[first + 2u * parent + 1u]; }
            let joint = notes[first + 2u * i];
            part = add_joint(part, shapes[kind.joints.w + i], joint, q_parent, q, pressure, kind.size.y);
        }
        let change = solve(add_up(lane, part), pressure);
        pressure += change[0];
        rate = change[1];
        if lane == 0u { is_close = select(0u, 1u, all(abs(change[0]) < vec3f(CLOSE * kind.size.y))); }
        if workgroupUniformLoad(&is_close) == 1u { break; }
    }
    return mat2x3f(pressure, rate);
}

@compute @workgroup_size(64)
fn fit_groups(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var k = group.x; k < tally.y; k += spread.x) {
        let motion = motions[joins[k]];
        let rung = rungs[motion.at.x];
        if group.y >= rung.groups.y { continue; }
        let kind = kinds[rung.links.w];
        let row = groups[rung.groups.x + group.y];
        let first = 2u * k * LONGEST;
        let carrier = listeners[rung.probes.z + row.rows.y].z;
        let pressure = fitted(lane, row, carrier, kind, first);
        let place = state_row(rung, motion.at.y) + (rung.links.y + 2u * group.y) * stride_of(rung);
        if lane == 0u {
            let moves = select(1.0, 0.0, rung.air.w == STILL);
            state[place] = moves * vec4f(pressure[0], 0.0);
            state[place + stride_of(rung)] = moves * vec4f(pressure[1], 0.0);
        }
    }
}
