// Structs of coupled links that cross from Python; gpu/multibody/layouts.py holds the same fields, and a test compares.
// Set: motion + rotation + multibody_types + ...

struct Rod {
    axis_1: vec4f,   // unit axis of the first joint; stiffness, N m/rad
    axis_2: vec4f,   // the same of the second
    foot: vec4f,     // joint, from the parent's joint and in its frame, m, 0 on the ground; distance of the drag centre, m
    leaf_1: vec4f,   // drag tensor of the leaves, xx yy zz, kg/m; drag of the wood, kg/m
    leaf_2: vec4f,   // xy xz yz; damping over stiffness, s
    mass: vec4f,     // kg; first moment, kg m; inertia across the link through its joint, kg m^2; end of its groups
    rows: vec4u,     // parent or NONE; probe; depth; what the walks do at it: TIP, FOLLOWS, FORKS, LATER
}

// A rung whose links are coupled; zeros of any other.
struct Coupled {
    pace: vec4f,     // step to reckon with, s; how far into it forces are taken, s; the first over the second; 0
    rows: vec4u,     // first row of rods, carried velocities, records and slots
}

const TIP = 1u;      // nothing hangs on it
const FOLLOWS = 2u;  // its parent is the link before it, of which all is at hand
const FORKS = 4u;    // other links than the next hang on it
const LATER = 8u;    // links after it hang on its parent too

const CARRIED = 2u;  // rows of a link that last: velocity of its joint, m/s; rate of its direction, 1/s
const RECORD = 5u;   // rows of a link within a step, see multibody_descend.wgsl and multibody_ascend.wgsl
const SLOT = 8u;     // rows of a depth within a walk
const REST_THRESHOLD = 1e-9;
// As in motion/multibody/constants.py.
const STOP_ANGLE = 1.5;
const STOP_STIFFNESS = 30.0;
const STOP_EDGE = 1.5001;
const MOST_ANGLE = 2.0;
const PULL_KNEE = 4.0;
const RATE_LEAD = 0.5;

// What a lane walks over: its links, where its numbers lie, and how far apart.
struct Column {
    pace: vec4f,
    links: u32,
    grounded: u32,   // groups on the ground
    rods: u32,
    crowd: u32,      // constants of its groups
    state: u32,
    groups: u32,     // state of its groups
    carried: u32,
    records: u32,
    slots: u32,
    wind: u32,
    stride: u32,
}

fn column_at(rung: Rung, own: Coupled, block: u32, lane: u32) -> Column {
    let stride = stride_of(rung);
    let links = rung.links.y;
    let before = block * links * stride;   // links of the blocks before this one
    let joints = state_row(rung, block * LANES + lane);
    return Column(
        own.pace,
        links,
        rung.groups.z,
        own.rows.x,
        rung.groups.x,
        joints,
        joints + links * stride,
        own.rows.y + CARRIED * before + lane,
        own.rows.z + RECORD * before + lane,
        own.rows.w + SLOT * block * (rung.links.z + 1u) * stride + lane,
        rung.room.z + 2u * block * rung.probes.y * stride + lane,
        stride,
    );
}

fn record_of(column: Column, link: u32) -> u32 {
    return column.records + RECORD * link * column.stride;
}

fn slot_of(column: Column, depth: u32) -> u32 {
    return column.slots + SLOT * depth * column.stride;
}

fn settled(value: vec4f) -> vec4f {
    return select(value, vec4f(0.0), abs(value) < vec4f(REST_THRESHOLD));
}
