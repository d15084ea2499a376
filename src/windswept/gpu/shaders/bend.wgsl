// Skjermo's first pass: the wind at a branch's tip bends its Bezier curve on its parent's; one thread a branch.
// motion/bend_plain.py is the same in NumPy. Set: motion + air + bend_types + bend_frame + bend_air + bend.

@group(0) @binding(0) var<storage, read> branches: array<Branch>;
@group(0) @binding(1) var<storage, read> before: array<BentBranch>;
@group(0) @binding(2) var<storage, read_write> after: array<BentBranch>;
@group(0) @binding(4) var<uniform> bend_pass: BendPass;

const FOLD = -0.9;

// normalize(a + b) - a of a unit vector, with b along a above FOLD; exactly 0 where b is. See motion/bend.py.
fn turned_by(a: vec3f, b: vec3f) -> vec3f {
    let along = dot(a, b);
    let p = max(along, FOLD);
    let q = 2.0 * p + p * p + max(dot(b, b) - along * along, 0.0);
    let r = sqrt(1.0 + q);
    return (b + a * (p - along - q / (1.0 + r))) / r;
}

// What the least rotation from unit a to unit a + e adds to v; exactly 0 where e is.
fn rotated_by(v: vec3f, a: vec3f, e: vec3f) -> vec3f {
    let axis = cross(a, e);
    let once = cross(axis, v);
    return once + cross(axis, once) / max(2.0 + dot(a, e), 1e-6);
}

// The ground's frame is (x, y, -z): ROOT_FRAME of motion/bend_branches.py.
fn ground() -> BentBranch {
    return BentBranch(vec4f(0.0), vec4f(1.0, 0.0, 0.0, 1.0), vec4f(2.0, 0.0, 0.0, 0.0), vec4f(3.0, 0.0, 0.0, 0.0));
}

fn attached_and_bent(branch: Branch, parent: BentBranch) -> BentBranch {
    let t = branch.leg0.w;
    let s = 1.0 - t;
    let d0 = parent.p1.xyz - parent.p0.xyz;
    let d1 = parent.p2.xyz - parent.p1.xyz;
    let d2 = parent.p3.xyz - parent.p2.xyz;
    let sides = handles(d0, d1, d2, vec3f(parent.p0.w, parent.p1.w, parent.p2.w));
    let square = vec3f(s * s, 2.0 * s * t, t * t);
    let along = normalize(mat3x3f(d0, d1, d2) * square);
    let sloping = sides * square;
    let across = normalize(sloping - dot(sloping, along) * along);
    let frame = mat3x3f(along, across, cross(across, along));

    let base = parent.p0.xyz + d0 * (t * (3.0 + t * (t - 3.0))) + d1 * (t * t * (3.0 - 2.0 * t)) + d2 * (t * t * t);
    let second = frame * branch.leg1.xyz;
    let third = frame * branch.leg2.xyz;
    let wind = air(branch.tip.xy);
    let b = vec3f(wind, 0.0) * (length(wind) * branch.side.w);
    let e2 = turned_by(second, b * bend_pass.weights.x);
    let e3 = rotated_by(third, second, e2);
    let e4 = turned_by(third + e3, b * bend_pass.weights.y);

    let p1 = base + frame * branch.leg0.xyz;
    let p2 = p1 + second * branch.leg1.w + e2 * branch.leg1.w;
    let p3 = p2 + third * branch.leg2.w + (e3 + e4) * branch.leg2.w;
    let side = frame * branch.side.xyz;
    return BentBranch(vec4f(base, side.x), vec4f(p1, side.y), vec4f(p2, side.z), vec4f(p3, 0.0));
}

// All branches at once, each on its parent of the step before (Skjermo section 4.2).
@compute @workgroup_size(64)
fn lagged(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let row = bend_pass.rows.x + id.x + id.y * groups.x * 64u;
    if row >= bend_pass.rows.y { return; }
    let branch = branches[row];
    if branch.rows.x == NONE {
        after[row] = attached_and_bent(branch, ground());
    } else {
        after[row] = attached_and_bent(branch, before[branch.rows.x]);
    }
}

// One level, each branch on its parent as it is now: dispatched level by level (PHYSICS C1.13).
@compute @workgroup_size(64)
fn ordered(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let row = bend_pass.rows.x + id.x + id.y * groups.x * 64u;
    if row >= bend_pass.rows.y { return; }
    let branch = branches[row];
    if branch.rows.x == NONE {
        after[row] = attached_and_bent(branch, ground());
    } else {
        after[row] = attached_and_bent(branch, after[branch.rows.x]);
    }
}
