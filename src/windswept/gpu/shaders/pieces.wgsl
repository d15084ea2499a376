// What bark.wgsl draws: pieces as curves.wgsl posed them.
// Set: types + light + pieces + bark.

@group(1) @binding(1) var<storage, read> posed_pieces: array<PosedPiece>;

fn posed_piece(item: u32) -> PosedPiece {
    return posed_pieces[item];
}
