// Structs of the simulation that cross from Python; gpu/layouts.py holds the same fields as NumPy types, and a test
// compares. Only 16-byte fields. "First" is a row of the buffer named; a *block* is LANES placements at one level.

struct Kind {
    ladder: vec4u,      // first rung; rungs; first placement; placements
    joints: vec4u,      // first link row of its finest rung; links; 0; first shape
    size: vec4f,        // radius of the ball that holds the plant, m; pressure up to which shapes hold, (m/s)^2; 0; 0
}

struct Rung {
    links: vec4u,       // first link row; active links; greatest depth; kind
    groups: vec4u,      // first group row; groups; groups on the ground; place on the ladder, 0 = finest
    probes: vec4u,      // first probe; probes; first listener; first member
    room: vec4u,        // first row of state, stack and wind; placements that there is room for
    air: vec4f,         // speed at which leaves fold, m/s; half the exponent of that; largest error so far, m; what moves it
}

// Listeners are rows of vec4u, one for each joint of the plant at each rung: the active link that the joint is, or NONE;
// else its group, and the link of the plant that carries the group, or NONE for the ground; 0.

struct Link {
    axis_1: vec4f,      // unit axis of the first joint; compliance, rad/(N m)
    axis_2: vec4f,      // the same of the second
    foot: vec4f,        // joint, from the parent's joint and in its frame, m; where the drag acts, 0 base to 1 tip
    vector: vec4f,      // base to tip at rest, m; one over its length squared
    leaf_1: vec4f,      // drag tensor of the leaves, xx yy zz, kg/m; mobility
    leaf_2: vec4f,      // xy xz yz; drag of the wood, kg/m
    swing: vec4f,       // exact step: angle from angle and from rate, rate from angle and from rate
    more: vec4f,        // propagation; tension per force, 1/N; half an inner step, s; links before it on its way from the root
    rows: vec4u,        // parent or NONE; probe; end of its groups; links whose last descendant this is, itself included
}

struct Group {
    centre: vec4f,      // centre of pressure from the carrier's joint, m; factor of leaf drag
    leaf_1: vec4f,      // drag tensor of the leaves, xx yy zz, kg/m; factor of wood drag
    leaf_2: vec4f,      // xy xz yz; mobility
    wood_1: vec4f,      // drag tensor of the wood
    wood_2: vec4f,
    couple_x: vec4f,    // couple per pressure, row by row
    couple_y: vec4f,
    couple_z: vec4f,
    sway_x: vec4f,      // displacement of the centre per pressure, row by row, s^2/m
    sway_y: vec4f,
    sway_z: vec4f,
    swing: vec4f,       // exact step, as of a link
    rows: vec4u,        // probe; first joint of the plant that listens; joints that do; 0
}

// How a joint of the plant that listens to a group bends under its pressure; see motion/shapes.py.
struct Shape {
    linear_1: vec4f,    // angle about the first axis per x, y, z of the pressure, rad s^2/m^2; stiffness, N m/rad
    square_1: vec4f,    // per xx, yy, zz; 0
    mixed_1: vec4f,     // per xy, xz, yz; 0
    linear_2: vec4f,    // the same about the second axis
    square_2: vec4f,
    mixed_2: vec4f,
}

struct Rooted {
    position: vec4f,    // root, m; cosine of the yaw
    heading: vec4f,     // sine of the yaw; 0; 0; 0
    rows: vec4u,        // kind; 0; 0; 0
}

struct Motion {
    at: vec4u,          // rung; slot there; step at which its blend began; whether it has just come here
    origin: vec4u,      // rung that it blends from, or NONE; slot there; rung that it leaves now, or NONE; slot there
    wish: vec4u,        // place on the ladder that the eye allows; rank among those of the same wish; refused; 0
}

struct Moment {
    eye: vec4f,         // position, m; error that may be seen per distance
    view: vec4f,        // unit direction it looks in; angle to the corner of the picture, or 0 where it looks all round
    time: vec4f,        // 1 + dead band; seconds since the last inner step; inner step, s; 0
    steps: vec4u,       // steps taken since rest; first and end of those to take now; steps of the wind's interval
    counts: vec4u,      // rungs; kinds; placements; steps of a blend
}

struct Air {
    profile: vec4f,     // displacement, m; 1 / roughness; join height, m; attenuation
    mean: vec4f,        // mean wind x and y at the reference height, m/s; 1 / log of the reference; 0
    ground: vec4f,      // 1 / spacing of the terrain's grid; middle of the grid; last cell; 0
    sources: vec4u,     // first wave; waves; first gust; gusts
}

struct Wave {
    phase: vec4f,       // turns per metre of x and of y; turns now at the origin; bias
    push: vec4f,        // x and y, m/s; power; mean
}

struct Gust {
    place: vec4f,       // origin x and y, m; direction x and y
    shape: vec4f,       // way of the front since its start, m; strength, m/s; 1 / rise length; start of the decay, m
    fade: vec4f,        // 1 / decay length; 1 / width; 0; 0
}

// A member that takes another's slot.
struct Shift {
    rung: u32,
    before: u32,
    after: u32,
    placement: u32,
}

// Rows from one number of a placement to the next: a kind of few placements has narrow blocks.
fn stride_of(rung: Rung) -> u32 {
    return min(rung.room.w, LANES);
}

// First row of the state of a slot; a narrow block is the only one of its rung.
fn state_row(rung: Rung, slot: u32) -> u32 {
    return rung.room.x + slot / LANES * (rung.links.y + 2u * rung.groups.y) * LANES + slot % LANES;
}

fn is_coupled(rung: Rung) -> bool {
    return rung.air.w == MULTIBODY;
}

const LANES = 64u;
const NONE = 0xffffffffu;
const STILL = 0.0;       // what moves the plants of a rung
const SPRINGS = 1.0;
const MULTIBODY = 2.0;
const TINY = 1e-30;      // roots of squares have a slope at rest too
const MAX_ANGLE = 1.5;   // no joint is pulled further, rad
