// Rotations as unit quaternions (x, y, z, w); motion/rotation.py is the same on the CPU.

fn rotate(q: vec4f, v: vec3f) -> vec3f {
    let twice = 2.0 * cross(q.xyz, v);
    return v + q.w * twice + cross(q.xyz, twice);
}

fn rotate_back(q: vec4f, v: vec3f) -> vec3f {
    let twice = 2.0 * cross(v, q.xyz);
    return v + q.w * twice + cross(twice, q.xyz);
}

// First b, then a.
fn multiply(a: vec4f, b: vec4f) -> vec4f {
    return vec4f(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

// Of a rotation vector of up to pi, by Taylor series in the half angle: no branch at zero.
fn from_rotation_vector(v: vec3f) -> vec4f {
    let x = 0.25 * dot(v, v);
    let s = 0.5 * (1.0 - x * (1.0 / 6.0 - x * (1.0 / 120.0 - x * (1.0 / 5040.0 - x / 362880.0))));
    let c = 1.0 - x * (0.5 - x * (1.0 / 24.0 - x * (1.0 / 720.0 - x * (1.0 / 40320.0 - x / 3628800.0))));
    return vec4f(v * s, c);
}
