// Poses stems, pieces and leaves on the card; geometry/pose_curves.py is the same in NumPy.
// Set: types + rotation + curves. A stem's shift is the sum of `offset` over its ancestors, and an offset needs only
// unshifted curves, so three dispatches (offsets, shifts, then pieces and leaves) serve any depth. A workgroup takes a
// chunk: up to CHUNK stems, pieces or leaves of one placement, whose row it finds by where each placement's chunks begin.

const CHUNK = 64u;

@group(1) @binding(0) var<storage, read> placements: array<Placement>;
@group(1) @binding(1) var<storage, read> stems: array<Stem>;
@group(1) @binding(2) var<storage, read> pieces: array<Piece>;
@group(1) @binding(3) var<storage, read> leaves: array<Leaf>;
@group(1) @binding(4) var<storage, read> links: array<LinkPose>;
@group(1) @binding(5) var<storage, read_write> shifts: array<StemShift>;
@group(1) @binding(6) var<storage, read_write> posed_pieces: array<PosedPiece>;
@group(1) @binding(7) var<storage, read_write> posed_leaves: array<PosedLeaf>;
@group(1) @binding(8) var<uniform> looks: array<Look, 544>;
@group(1) @binding(9) var<uniform> listed: Listed;

// Row of a placement, and the rank of what an invocation takes of it.
struct Item {
    row: u32,
    rank: u32,
}

// `column` of Placement.number counts the chunks; the last placement that begins at or before a chunk owns it.
fn item_of(group: vec3u, spread: vec3u, lane: u32, column: u32) -> Item {
    let chunk = group.x + group.y * spread.x;
    if chunk >= listed.counts[column] { return Item(NONE, 0u); }
    var low = 0u;
    var high = listed.counts.x;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if placements[middle].number[column] <= chunk { low = middle; } else { high = middle; }
    }
    return Item(low, CHUNK * (chunk - placements[low].number[column]) + lane);
}

fn carry(link: u32, offset: vec3f) -> vec3f {
    let pose = links[link];
    return pose.position.xyz + rotate(pose.rotation, offset);
}

// Turn about +Z by the placement's yaw.
fn turned(placement: Placement, v: vec3f) -> vec3f {
    let c = placement.position.w;
    let s = placement.heading.x;
    return vec3f(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
}

fn placed(placement: Placement, point: vec3f) -> vec3f {
    return placement.position.xyz + turned(placement, point);
}

fn perpendicular(v: vec3f, direction: vec3f) -> vec3f {
    return normalize(v - dot(v, direction) * direction);
}

@compute @workgroup_size(64)
fn offsets(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let item = item_of(group, spread, lane, 1u);
    if item.row == NONE { return; }
    let placement = placements[item.row];
    let rank = item.rank;
    if rank >= placement.rows.w { return; }
    let stem = stems[placement.rows.z + rank];
    var offset = vec3f(0.0);
    if stem.rows.x != NONE {
        let piece = pieces[placement.first.x + stem.rows.z];
        let t = stem.attach.x;
        let s = 1.0 - t;
        let start = placement.rows.x + piece.rows.y;
        let end = placement.rows.x + piece.rows.z;
        let on_parent = s * s * s * carry(start, piece.p0.xyz) + 3.0 * s * s * t * carry(start, piece.p1.xyz)
            + 3.0 * s * t * t * carry(end, piece.p2.xyz) + t * t * t * carry(end, piece.p3.xyz);
        offset = on_parent - links[placement.rows.x + stem.rows.y].position.xyz;
    }
    shifts[placement.rows.y + rank].offset = vec4f(offset, 0.0);
}

@compute @workgroup_size(64)
fn sum_shifts(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let item = item_of(group, spread, lane, 1u);
    if item.row == NONE { return; }
    let placement = placements[item.row];
    let rank = item.rank;
    if rank >= placement.rows.w { return; }
    var total = vec4f(0.0);
    var stem = rank;
    while stem != NONE {
        total += shifts[placement.rows.y + stem].offset;
        stem = stems[placement.rows.z + stem].rows.x;
    }
    shifts[placement.rows.y + rank].total = total;
}

// Row of `posed_pieces` that piece `rank` of a placement is drawn from: buckets stand one after the other.
fn piece_row(placement: Placement, rank: u32) -> u32 {
    let limit = placement.piece_limit;
    let out = placement.piece_out;
    if rank < limit.x { return out.x + rank; }
    if rank < limit.y { return out.y + rank - limit.x; }
    if rank < limit.z { return out.z + rank - limit.y; }
    return out.w + rank - limit.z;
}

@compute @workgroup_size(64)
fn pose_pieces(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let item = item_of(group, spread, lane, 2u);
    if item.row == NONE { return; }
    let placement = placements[item.row];
    let rank = item.rank;
    if rank >= placement.piece_limit.w { return; }
    let piece = pieces[placement.first.x + rank];
    let stem = stems[placement.rows.z + piece.rows.x];
    let shift = shifts[placement.rows.y + piece.rows.x].total.xyz;
    let start = placement.rows.x + piece.rows.y;
    let end = placement.rows.x + piece.rows.z;
    let p0 = placed(placement, carry(start, piece.p0.xyz) + shift);
    let p1 = placed(placement, carry(start, piece.p1.xyz) + shift);
    let p2 = placed(placement, carry(end, piece.p2.xyz) + shift);
    let p3 = placed(placement, carry(end, piece.p3.xyz) + shift);
    let side0 = turned(placement, rotate(links[start].rotation, piece.side0.xyz));
    let side2 = turned(placement, rotate(links[end].rotation, piece.side1.xyz));
    let cut = placement.heading.w;
    let width = clamp(2.0 * (stem.attach.y - cut) / max(cut, 1e-9), 0.0, 1.0);
    var posed: PosedPiece;
    posed.p0 = vec4f(p0, piece.p0.w);
    posed.p1 = vec4f(p1, piece.p1.w);
    posed.p2 = vec4f(p2, piece.p2.w);
    posed.p3 = vec4f(p3, piece.p3.w);
    posed.side0 = vec4f(perpendicular(side0, normalize(p1 - p0)), width);
    posed.side1 = vec4f(perpendicular(side0 + side2, normalize(p2 - p1)), placement.heading.z);
    posed.side2 = vec4f(perpendicular(side2, normalize(p3 - p2)), 0.0);
    posed.rows = vec4u(placement.rows.z + piece.rows.x, placement.first.w, 0u, 0u);
    posed_pieces[piece_row(placement, rank)] = posed;
}

struct Blade {
    axis: vec3f,
    normal: vec3f,
}

// A leaf trembles about its petiole (roll) and up and down at it (pitch); both vanish with the flutter.
fn fluttered(axis: vec3f, normal: vec3f, amplitude: f32, phase: f32) -> Blade {
    let time = frame.eye.w;
    let rate = 9.0 + 8.0 * fract(phase * 7.31);
    let roll = amplitude * (sin(rate * time + 40.0 * phase) + 0.5 * sin(1.73 * rate * time + 11.0 * phase));
    let pitch = 0.5 * amplitude * sin(0.61 * rate * time + 23.0 * phase);
    let across = cross(axis, normal);
    let rolled = cos(roll) * normal + sin(roll) * across;
    return Blade(cos(pitch) * axis + sin(pitch) * rolled, cos(pitch) * rolled - sin(pitch) * axis);
}

@compute @workgroup_size(64)
fn pose_leaves(
    @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) spread: vec3u, @builtin(local_invocation_index) lane: u32
) {
    let item = item_of(group, spread, lane, 3u);
    if item.row == NONE { return; }
    let placement = placements[item.row];
    let rank = item.rank;
    if f32(rank) >= placement.leaves.x { return; }
    let leaf = leaves[placement.first.y + rank];
    let link = placement.rows.x + leaf.rows.x;
    let rotation = links[link].rotation;
    let shift = shifts[placement.rows.y + leaf.rows.y].total.xyz;
    let amplitude = placement.heading.y * looks[placement.first.w].back.w;
    let blade = fluttered(
        turned(placement, rotate(rotation, leaf.axis.xyz)),
        turned(placement, rotate(rotation, leaf.normal.xyz)),
        amplitude,
        leaf.outward.w + placement.heading.z,
    );
    let shrink = clamp((placement.leaves.y - f32(rank)) / placement.leaves.z, 0.0, 1.0);
    let scale = placement.leaves.w * shrink;
    var posed: PosedLeaf;
    posed.position = vec4f(placed(placement, carry(link, leaf.position.xyz) + shift), leaf.position.w * scale);
    posed.axis = vec4f(blade.axis, leaf.axis.w * scale);
    posed.normal = vec4f(blade.normal, leaf.normal.w);
    posed.outward = vec4f(turned(placement, rotate(rotation, leaf.outward.xyz)), leaf.outward.w);
    posed.rows = vec4u(placement.first.w, 0u, 0u, 0u);
    posed_leaves[placement.first.z + rank] = posed;
}
