// Structs of the blades' motion that cross from Python; gpu/blades/layouts.py holds the same fields as NumPy types.

struct LeanBlock {
    rows: vec4u,      // first tile; blades; kind; air
}

struct LeanKind {
    share: vec4f,     // of the drag along axis, normal and side; half the reconfiguration exponent
    air: vec4f,       // push over drag; 1 over the square of the reconfiguration speed; weight; reach to the side
    bounds: vec4f,    // how much softer once broken; square of the lean that breaks it; 0; 0
}

struct LeanPass {
    steps: vec4u,     // inner steps that are due; tile at which `constants` begins; 0; 0
}
