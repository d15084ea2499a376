// Structs of the choice of blades that cross from Python; gpu/blades/choice_layouts.py holds the same as NumPy types.

struct ChunkRow {
    ball: vec4f,      // middle and radius round its blades, m
    size: vec4f,      // mean width as drawn and mean length of a section, m; 0; 0
    rows: vec4u,      // first blade; blades; first run; how many blades carry each of them
    sections: vec4u,  // at every level
}

struct ChoiceLook {
    eye: vec4f,               // m; pixels of 1 m at 1 m
    planes: array<vec4f, 5>,  // of the frustum, positive inside
    rules: vec4f,             // least width, least lengths of a section at the first levels, pixels; reach, m
    now: vec4f,               // that the card hands on in every row of `passes`
    counts: vec4u,            // chunks; depths; numbers of sections; joints that there is room for
    sections: array<vec4u, 4>,
}
