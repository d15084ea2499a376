// Every struct that crosses from Python; gpu/layouts.py holds the same fields as NumPy types, and a test compares.
// Only 16-byte fields, so that both sides agree without padding rules.

struct Frame {
    view_projection: mat4x4f,  // world to clip; depth runs from 1 (near) to 0 (infinity)
    clip_to_world: mat4x4f,    // its inverse, for the sky's rays
    sun_projection: mat4x4f,   // world to the shadow map's clip space, depth 0..1
    eye: vec4f,                // position, m; time, s
    sun: vec4f,                // unit direction towards the sun; side of a shadow texel, m
    sun_light: vec4f,          // linear RGB of the sun on a surface that faces it; exposure
    sky_light: vec4f,          // linear RGB of the sky on a surface that faces up; 0
    haze: vec4f,               // linear RGB of the horizon; extinction, 1/m
    wind: vec4f,               // mean wind x, y in m/s; distance it has blown x, y in m
    terrain: vec4f,            // origin x, y in m; spacing, m; 1 where real blades stand on it
}

struct Placement {
    position: vec4f,      // root, m; cosine of the yaw
    heading: vec4f,       // sine of the yaw; flutter, rad; phase of the placement, rad; stem size at which stems end, m
    rows: vec4u,          // first link pose; first stem shift; first stem; stems that are shifted, from the first rank on
    first: vec4u,         // first piece; first leaf; first posed leaf; look
    piece_limit: vec4u,   // pieces up to each bucket's end, counted from the placement's first
    piece_out: vec4u,     // first posed piece of the placement in each bucket
    leaves: vec4f,        // leaves drawn; rank at which leaves end; ranks over which they shrink; scale
    number: vec4u,        // which of all placements this is; first chunk of its stems; of its pieces; of its leaves
}

struct Look {
    bark: vec4f,   // linear RGB; relief 0..1
    leaf: vec4f,   // linear RGB of the upper face; number of the shape
    back: vec4f,   // linear RGB of the lower face; readiness to flutter 0..1
}

struct LinkPose {
    position: vec4f,   // joint, plant frame, m; 0
    rotation: vec4f,   // quaternion from the rest pose
}

struct Stem {
    profile: vec4f,   // radius, m; taper; flare; lobes
    extent: vec4f,    // lobe depth; taper's Z at base and tip; taper length, m
    attach: vec4f,    // parameter on the parent's piece; size for detail, m; length, m; bulge depth
    rows: vec4u,      // parent stem or NONE; first link; parent's piece; bulges
}

// Stems, links and poses of a plant stand by rank: gpu/pose_order.py.
struct Piece {
    p0: vec4f,     // control points from the joint of the link that carries them, m; p0.w: span start
    p1: vec4f,     // .w: span end
    p2: vec4f,     // .w: openness at the start
    p3: vec4f,     // .w: openness at the end
    side0: vec4f,  // unit side vectors at rest
    side1: vec4f,
    rows: vec4u,   // stem; links that carry the start and the end; 0
}

struct Leaf {
    position: vec4f,  // from the joint of the link that carries it, m; length, m
    axis: vec4f,      // unit; width, m
    normal: vec4f,    // unit; openness
    outward: vec4f,   // unit; a random number in 0..1
    rows: vec4u,      // link; stem; 0; 0
}

struct StemShift {
    offset: vec4f,  // from the stem's rigid base to the parent's unshifted curve, m
    total: vec4f,   // the sum of offsets over the stem and its ancestors, m
}

struct PosedPiece {
    p0: vec4f,    // world, m; span start
    p1: vec4f,    // .w: span end
    p2: vec4f,    // .w: openness at the start
    p3: vec4f,    // .w: openness at the end
    side0: vec4f, // unit; share of its width that the stem is drawn with
    side1: vec4f, // unit; a random number of the placement
    side2: vec4f,
    rows: vec4u,  // stem; look; 0; 0
}

struct PosedLeaf {
    position: vec4f,  // world, m; drawn length, m
    axis: vec4f,      // unit; drawn width, m
    normal: vec4f,    // unit; openness
    outward: vec4f,   // unit; a random number in 0..1
    rows: vec4u,      // look; 0; 0; 0
}

// How much a frame poses: curves.wgsl takes it chunk by chunk.
struct Listed {
    counts: vec4u,  // placements; chunks of stems; of pieces; of leaves
}

struct Batch {
    items: vec4u,   // first item; items; step from one item to the next; 0
    scale: vec4f,   // factor on an item's size; 0; 0; 0
}

struct GrassBlade {
    root: vec4f,    // foot on the ground, m; size 0..1 by how far the camera is
    chance: vec4f,  // random numbers in 0..1
}

const NONE = 0xffffffffu;

@group(0) @binding(0) var<uniform> frame: Frame;
