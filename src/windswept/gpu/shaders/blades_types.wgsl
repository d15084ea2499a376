// Structs of the meadow that cross from Python; gpu/meadow/layouts.py holds the same fields as NumPy types.

struct BladeRow {
    place: vec4f,   // root on the ground, m, or (place along the parent 0..1, 0, 0); size
    bits: vec4u,    // quaternion of the base frame, 4 x 16 bit; z of that frame's axes at rest, 2 x 16 bit; chance, 16 bit, and
                    // what the 2 x 16 bit before it lose, 2 x 8 bit
}

struct BladeRun {
    whole: vec4u,     // first row of the table of poses; its bins of angle, norm and direction
    broken: vec4u,    // the same for broken blades
    rows: vec4u,      // first blade; first number of their state or NONE; sections; first border
    shape: vec4f,     // section of a blade of size 1, m; weight; force scale whole over broken; power of size of the width
    width: vec4f,     // mean width as drawn, m; blades that each stands for; 1 for a tube; 1 on the ground
    colour: vec4f,    // linear RGB at the base; 0
    tip: vec4f,       // linear RGB at the tip; 0
}

struct PosedJoint {
    place: vec4f,    // world, m; half width, m
    facing: vec4u,   // side as drawn and normal, 6 x 16 bit; square roots of the lit colour, 3 x 10 bit
}

struct MeadowPass {
    items: vec4u,   // first item; items; vertices of each; 0
    now: vec4f,     // seconds since the last step; pixels of 1 m at 1 m; least width, pixels; where blades end, m
}
