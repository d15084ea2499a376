// What bark.wgsl draws: branches straight from the buffer that bend.wgsl writes.
// Set: types + light + bend_types + bend_frame + bend_pieces + bark.

@group(1) @binding(1) var<storage, read> bent: array<BentBranch>;
@group(1) @binding(4) var<storage, read> branches: array<Branch>;
@group(1) @binding(5) var<storage, read> branch_looks: array<BranchLook>;

fn posed_piece(item: u32) -> PosedPiece {
    let branch = bent[item];
    let look = branch_looks[item];
    let rows = branches[item].rows;
    let sides = handles(
        branch.p1.xyz - branch.p0.xyz,
        branch.p2.xyz - branch.p1.xyz,
        branch.p3.xyz - branch.p2.xyz,
        vec3f(branch.p0.w, branch.p1.w, branch.p2.w),
    );
    let origin = look.origin.xyz;
    return PosedPiece(
        vec4f(origin + branch.p0.xyz, 0.0),
        vec4f(origin + branch.p1.xyz, 1.0),
        vec4f(origin + branch.p2.xyz, look.shade.x),
        vec4f(origin + branch.p3.xyz, look.shade.y),
        vec4f(sides[0], 1.0),
        vec4f(sides[1], look.origin.w),
        vec4f(sides[2], 0.0),
        vec4u(rows.y, rows.z, 0u, 0u),
    );
}
