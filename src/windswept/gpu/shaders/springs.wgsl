// `springs` on the card: motion/springs.py for LANES placements a workgroup, one a lane. Set: motion + rotation + groups
// + springs.
//
// The CPU walks root to leaf and back. One walk is enough: links stand depth first, so when a link's last descendant is
// done, the force and moment beyond its joint are complete, and the joint takes its step at once. Only the links
// between the root and the walk's place are held, in `stack`. Every lane owns its column: joints are stepped in place.

@group(0) @binding(0) var<uniform> rungs: array<Rung, 800>;
@group(0) @binding(1) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(2) var<storage, read> links: array<Link>;
@group(0) @binding(3) var<storage, read> groups: array<Group>;
@group(0) @binding(4) var<storage, read> wind: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> state: array<vec4f>;
@group(0) @binding(6) var<storage, read_write> stack: array<vec4f>;
@group(0) @binding(7) var<uniform> moment: Moment;
@group(0) @binding(8) var<storage, read> modes: array<vec4u>;   // see springs/mode_rows.py

// Links that this dispatch walks; where there are more, it goes on where the one before it left off.
override FIRST: u32 = 0u;
override MOST: u32 = 0xffffffffu;

const REST_THRESHOLD = 1e-9;
const RECORD = 5u;   // rows of a link in the stack
const MODES = 4u;    // MODE_COUNT of motion/modal.py
const MODE_RECORD = 5u;   // rows of the modes in the stack, beyond all links

// Sums over the joints that are done, for each mode, of the names in motion/modal.py; and which link comes next.
struct Modal {
    y: vec4f,
    wy: vec4f,
    v: vec4f,
    cv: vec4f,
    next: u32,
}

var<private> modal: Modal;

struct Body {
    rotation: vec4f,
    place: vec3f,      // of the joint, m
    spin: vec3f,       // rad/s
    velocity: vec3f,   // of the joint, m/s
    force: vec3f,      // of the air on everything beyond the joint that is done, N
    torque: vec3f,     // the same about the origin, N m
}

// Where a lane's numbers lie, and how far apart.
struct Column {
    state: u32,
    groups: u32,
    wind: u32,
    stack: u32,
    stride: u32,
}

fn lay_down(row: u32, stride: u32, body: Body) {
    stack[row] = body.rotation;
    stack[row + stride] = vec4f(body.place, body.spin.x);
    stack[row + 2u * stride] = vec4f(body.velocity, body.spin.y);
    stack[row + 3u * stride] = vec4f(body.force, body.spin.z);
    stack[row + 4u * stride] = vec4f(body.torque, 0.0);
}

fn take_up(row: u32, stride: u32) -> Body {
    let place = stack[row + stride];
    let velocity = stack[row + 2u * stride];
    let force = stack[row + 3u * stride];
    let spin = vec3f(place.w, velocity.w, force.w);
    return Body(stack[row], place.xyz, spin, velocity.xyz, force.xyz, stack[row + 4u * stride].xyz);
}

fn drag_force(link: Link, air: vec4f, velocity: vec3f, vector: vec3f) -> vec3f {
    let speed = sqrt(dot(air.xyz - velocity, air.xyz - velocity) + TINY);
    let u = air.xyz - velocity / (1.0 + speed * link.leaf_1.w);
    let leaf = tensor_times(link.leaf_1.xyz, link.leaf_2.xyz, u);
    let across = u - dot(vector, u) * link.vector.w * vector;
    return speed * (air.w * leaf + link.leaf_2.w * across);
}

// A link with the force and torque of a group that hangs on it; `number` is the group's in its rung.
fn with_group(body: Body, rung: Rung, number: u32, column: Column, late: f32) -> Body {
    let group = groups[rung.groups.x + number];
    let row = column.groups + 2u * number * column.stride;
    let air = air_at(column.wind, column.stride, group.rows.x, late);
    let push = swing_group(group, row, column.stride, air, body.rotation, body.spin, body.velocity);
    var loaded = body;
    loaded.force += push.force;
    loaded.torque += cross(body.place + push.arm, push.force) + push.couple;
    return loaded;
}

// Pose of a link half a step ahead, and the air's force on it.
fn pose_and_drag(link: Link, joint: vec4f, parent: Body, air: vec4f) -> Body {
    let angle_1 = joint.x + joint.y * link.more.z;
    let angle_2 = joint.z + joint.w * link.more.z;
    let turn = angle_1 * link.axis_1.xyz + angle_2 * link.axis_2.xyz;
    let rate = joint.y * link.axis_1.xyz + joint.w * link.axis_2.xyz;
    let reach = rotate(parent.rotation, link.foot.xyz);
    var body: Body;
    body.rotation = multiply(parent.rotation, from_rotation_vector(turn));
    body.place = parent.place + reach;
    body.spin = parent.spin + rotate(parent.rotation, rate);
    body.velocity = parent.velocity + cross(parent.spin, reach);
    let vector = rotate(body.rotation, link.vector.xyz);
    let lever = link.foot.w * vector;
    body.force = drag_force(link, air, body.velocity + cross(body.spin, lever), vector);
    body.torque = cross(body.place + lever, body.force);
    return body;
}

// Angle and rate as a joint may have them.
fn bounded(angle: f32, rate: f32) -> vec2f {
    let after = vec2f(clamp(angle, -2.0 * MAX_ANGLE, 2.0 * MAX_ANGLE), rate);
    return select(after, vec2f(0.0), abs(after) < vec2f(REST_THRESHOLD));
}

// The exact step of one spring (angle, rate) towards compliance x torque, and how far from there it gets; see springs.py
// on the tension.
fn oscillate(link: Link, angle: f32, rate: f32, bend: f32, tension: f32) -> vec3f {
    let y = (angle - clamp(bend, -MAX_ANGLE, MAX_ANGLE)) / tension;
    let goal = angle - y;
    let after = bounded(goal + y * link.swing.x + rate * link.swing.y, y * link.swing.z + rate * link.swing.w);
    return vec3f(after, after.x - goal);
}

fn mode_row(row: u32) -> vec4f {
    return bitcast<vec4f>(modes[row]);
}

fn swing_joint(link: Link, number: u32, mine: vec2u, row: u32, body: Body, parent: Body) {
    let joint = state[row];
    let torque = rotate_back(parent.rotation, body.torque - cross(body.place, body.force));
    let tension = max(sqrt(dot(body.force, body.force) + TINY) * link.more.y, 1.0);
    let first = oscillate(link, joint.x, joint.y, dot(torque, link.axis_1.xyz) * link.axis_1.w, tension);
    let second = oscillate(link, joint.z, joint.w, dot(torque, link.axis_2.xyz) * link.axis_2.w, tension);
    state[row] = vec4f(first.xy, second.xy);
    let entry = mine.x + 3u * MODES + 3u * modal.next;
    if modal.next < mine.y && modes[entry].x == number {
        let own = mode_row(entry);
        let y = first.z * mode_row(entry + 1u) + second.z * mode_row(entry + 2u);
        let v = first.y * mode_row(entry + 1u) + second.y * mode_row(entry + 2u);
        modal = Modal(modal.y + y, modal.wy + own.y * y, modal.v + v, modal.cv + own.z * v, modal.next + 1u);
    }
}

// Row-by-row product with one of the matrices of `Modes.gain`.
fn gained(row: u32, sum: vec4f) -> vec4f {
    return vec4f(
        dot(mode_row(row), sum), dot(mode_row(row + 1u), sum), dot(mode_row(row + 2u), sum), dot(mode_row(row + 3u), sum),
    );
}

// Changes the rates of all joints that take part by what the modes ask of them.
fn kick(rung: Rung, mine: vec2u, column: Column) {
    let whole = gained(mine.x + MODES, modal.y) - gained(mine.x, modal.wy)
        + gained(mine.x + 2u * MODES, modal.v) - gained(mine.x, modal.cv);
    let y = gained(mine.x, modal.y);
    let v = gained(mine.x, modal.v);
    for (var k = 0u; k < mine.y; k++) {
        let entry = mine.x + 3u * MODES + 3u * k;
        let number = modes[entry].x;
        let own = mode_row(entry);
        let link = links[rung.links.x + number];
        let row = column.state + number * column.stride;
        let push = own.w * (own.y * y + own.z * v - whole);
        let joint = state[row];
        state[row] = vec4f(
            bounded(joint.x, joint.y + link.axis_1.w * dot(mode_row(entry + 1u), push)),
            bounded(joint.z, joint.w + link.axis_2.w * dot(mode_row(entry + 2u), push)),
        );
    }
}

// One inner step of one placement: the walk over its links, or over a share of them. `mine` is where the rows of the
// rung's modes begin, and how many links take part.
fn walk(rung: Rung, mine: vec2u, column: Column, late: f32) {
    let stride = column.stride;
    let held = column.stack + (rung.links.z + 1u) * RECORD * stride;
    modal = Modal();
    var body: Body;
    var group = 0u;
    var top = column.stack;
    if FIRST == 0u {
        body.rotation = vec4f(0.0, 0.0, 0.0, 1.0);
        for (; group < rung.groups.z; group++) { body = with_group(body, rung, group, column, late); }
    } else {
        top += u32(links[rung.links.x + FIRST].more.w) * RECORD * stride;
        body = take_up(top, stride);
        modal = Modal(
            stack[held], stack[held + stride], stack[held + 2u * stride], stack[held + 3u * stride],
            u32(stack[held + 4u * stride].x),
        );
        group = links[rung.links.x + FIRST - 1u].rows.z;
    }
    let end = FIRST + min(MOST, rung.links.y - FIRST);
    for (var i = FIRST; i < end; i++) {
        let link = links[rung.links.x + i];
        lay_down(top, stride, body);
        top += RECORD * stride;
        let air = air_at(column.wind, stride, link.rows.y, late);
        body = pose_and_drag(link, state[column.state + i * stride], body, air);
        for (; group < link.rows.z; group++) { body = with_group(body, rung, group, column, late); }
        var done = i;
        for (var k = 0u; k < link.rows.w; k++) {
            let ended = links[rung.links.x + done];
            top -= RECORD * stride;
            var parent = take_up(top, stride);
            swing_joint(ended, done, mine, column.state + done * stride, body, parent);
            parent.force += ended.more.x * body.force;
            parent.torque += ended.more.x * body.torque;
            body = parent;
            done = ended.rows.x;
        }
    }
    if end < rung.links.y {
        lay_down(top, stride, body);
        stack[held] = modal.y;
        stack[held + stride] = modal.wy;
        stack[held + 2u * stride] = modal.v;
        stack[held + 3u * stride] = modal.cv;
        stack[held + 4u * stride] = vec4f(f32(modal.next), 0.0, 0.0, 0.0);
    } else {
        kick(rung, mine, column);
    }
}

@compute @workgroup_size(64)
fn step_block(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    for (var b = group.x; b < blocks[0].x; b += spread.x) {
        let block = blocks[1u + b];
        if lane >= block.z { continue; }
        let rung = rungs[block.x];
        if is_coupled(rung) { continue; }
        if FIRST > 0u && FIRST >= rung.links.y { continue; }
        let stride = stride_of(rung);
        let joints = state_row(rung, block.y * LANES + lane);
        let column = Column(
            joints,
            joints + rung.links.y * stride,
            rung.room.z + block.y * 2u * rung.probes.y * stride + lane,
            rung.room.y + block.y * ((rung.links.z + 1u) * RECORD + MODE_RECORD) * stride + lane,
            stride,
        );
        for (var s = moment.steps.y; s < moment.steps.z; s++) {
            walk(rung, modes[block.x].xy, column, f32(s + 1u) / f32(moment.steps.w));
        }
    }
}
