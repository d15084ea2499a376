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

struct BreezeWave {
    phase: vec4f,   // turns per metre of x and y; turns now at the origin; bias
    push: vec4f,    // x, y in m/s; power; mean
}

struct BreezeGust {
    place: vec4f,   // x, y of the front's start, m; its direction
    shape: vec4f,   // way of the front so far, m; strength, m/s; per rise length, 1/m; where the decay starts, m
    fade: vec4f,    // per decay length, 1/m; per width, 1/m; 0; 0
}

struct Breeze {
    mean: vec4f,     // x, y in m/s; 0; 0
    counts: vec4u,   // waves; gusts; 0; 0
    waves: array<BreezeWave, 16>,
    gusts: array<BreezeGust, 8>,
}

struct BendPass {
    rows: vec4u,      // first branch of the pass; its end; 0; 0
    weights: vec4f,   // share of b that turns the second leg; what the third gets more; 0; 0
}
