// The deformer's handles along a curve's legs, for bending and for drawing.

// S carried from one unit leg to the next by the least rotation.
fn carried(side: vec3f, from_leg: vec3f, to_leg: vec3f) -> vec3f {
    return side - (dot(side, to_leg) / max(1.0 + dot(from_leg, to_leg), 1e-6)) * (from_leg + to_leg);
}

// S0, S1, S2 of a curve with these legs.
fn handles(d0: vec3f, d1: vec3f, d2: vec3f, side: vec3f) -> mat3x3f {
    let l0 = normalize(d0);
    let l1 = normalize(d1);
    let s1 = carried(side, l0, l1);
    return mat3x3f(side, s1, carried(s1, l1, normalize(d2)));
}
