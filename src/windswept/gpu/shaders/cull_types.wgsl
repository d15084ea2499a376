// Structs of the choice of plants that cross from Python; gpu/culling/layouts.py holds the same as NumPy types.
// A *class* is 0 for placements that only throw shadows, 1 for those that are seen and do, 2 for those only seen.

struct Standing {
    position: vec4f,   // root, m; cosine of the yaw
    turn: vec4f,       // sine of the yaw; random number of the placement; 0; 0
    rows: vec4u,       // kind; look; 0; 0
}

struct DrawnKind {
    ball: vec4f,       // middle and radius at rest, m
    leaf: vec4f,       // mean length of a leaf, m; 0; 0; 0
    first: vec4u,      // first stem; first piece; first leaf; row of `prefixes` before its first leaf
    counts: vec4u,     // pieces; leaves; row of `prefixes` before its first piece; 0
}

struct Sight {
    eye: vec4f,               // m; pixels of 1 m at 1 m
    planes: array<vec4f, 5>,  // of the frustum, positive inside
    sun: vec4f,               // unit direction towards it; side of a texel of the shadow map, m
    shadow: vec4f,            // ball that receives shadows: middle and radius, m
    stem_pixels: vec4f,       // least width of the stems in each bucket, pixels
    leaf_pixels: vec4f,       // least length of a leaf; least share of the leaves; least length for each finer mesh
    counts: vec4u,            // placements; groups of GROUP; bits by which needs are shortened before they are added; 0
    room: vec4u,              // for link poses; shifted stems; posed pieces; posed leaves
}

// What is drawn of a placement: geometry/detail.py.
struct Choice {
    piece_limit: vec4u,   // as in Placement
    leaves: vec4f,        // as in Placement
    reach: vec4u,         // link poses; shifted stems, both from rank 0 on; mesh of the leaves; bits of the size at which stems end, m
    rows: vec4u,          // class, or HIDDEN; band of distance; 0; 0
}

// How much of everything that is laid out one after another a placement takes, or where its part begins.
struct Needs {
    pieces: vec4u,   // of each bucket
    leaves: vec4u,   // of each mesh; placements
    poses: vec4u,    // links; stems; 0; 0
    chunks: vec4u,   // of stems; pieces; leaves; 0
}

const CLASSES = 3u;
const HIDDEN = 3u;
const GROUP = 64u;    // placements of a workgroup
const CHUNK = 64u;    // of curves.wgsl
const BANDS = 128u;   // of distance
const TALLY = 96u;    // word of `plan`: needs of all in the four columns of Sight.room; bands with room; refused;
                      // placements, pieces and leaves drawn

fn needs_of(choice: Choice) -> Needs {
    let limit = choice.piece_limit;
    let leaves = u32(choice.leaves.x);
    var needs: Needs;
    needs.pieces = vec4u(limit.x, limit.yzw - limit.xyz);
    needs.leaves[choice.reach.z] = leaves;
    needs.leaves.w = 1u;
    needs.poses = vec4u(choice.reach.xy, 0u, 0u);
    needs.chunks = vec4u((vec3u(choice.reach.y, limit.w, leaves) + CHUNK - 1u) / CHUNK, 0u);
    return needs;
}

fn added(a: Needs, b: Needs) -> Needs {
    return Needs(a.pieces + b.pieces, a.leaves + b.leaves, a.poses + b.poses, a.chunks + b.chunks);
}
