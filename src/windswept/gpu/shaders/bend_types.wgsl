// Structs of `bend` that cross from Python; gpu/bend/layouts.py holds the same fields as NumPy types, and a test compares.

struct Branch {
    leg0: vec4f,   // first leg at rest in the parent's frame, m; parameter on the parent's curve
    leg1: vec4f,   // second leg, unit; its length, m
    leg2: vec4f,   // third leg, unit; its length, m
    side: vec4f,   // handle S0 in the same frame, unit; bend factor per squared wind at the reference height
    tip: vec4f,    // x, y of the tip at rest in the world, m; 0; 0
    rows: vec4u,   // parent or NONE; stem; look; 0
}

struct BranchLook {
    origin: vec4f,   // base of its trunk in the world, m; a random number of the placement
    shade: vec4f,    // openness at base and tip; 0; 0
}

struct BentBranch {
    p0: vec4f,   // control points from the base of the trunk, m; p0.w: x of S0
    p1: vec4f,   // .w: y of S0
    p2: vec4f,   // .w: z of S0
    p3: vec4f,   // .w: 0
}
