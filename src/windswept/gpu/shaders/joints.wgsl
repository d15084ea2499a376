// What turns a joint of the plant, whatever the level: its own oscillator, or its shape under its group's pressure.
// motion/shapes.py is the same on the CPU, but for `slope_of`, which it takes by differences (levels/carry_over.py).

// Second-order terms of an angle, and their slope.
fn second_order(square: vec3f, mixed: vec3f, u: vec3f) -> f32 {
    return dot(square, u * u) + dot(mixed, vec3f(u.x * u.y, u.x * u.z, u.y * u.z));
}

fn second_order_slope(square: vec3f, mixed: vec3f, u: vec3f) -> vec3f {
    let across = vec3f(mixed.x * u.y + mixed.y * u.z, mixed.x * u.x + mixed.z * u.z, mixed.y * u.x + mixed.z * u.y);
    return 2.0 * square * u + across;
}

// Both angles under a pressure in the frame of the joint's parent; beyond `limit` they go on in proportion to it.
fn shaped(shape: Shape, u: vec3f, limit: f32) -> vec2f {
    let short = limit / sqrt(max(dot(u, u), limit * limit));
    let angles = vec2f(
        dot(shape.linear_1.xyz, u) + short * second_order(shape.square_1.xyz, shape.mixed_1.xyz, u),
        dot(shape.linear_2.xyz, u) + short * second_order(shape.square_2.xyz, shape.mixed_2.xyz, u),
    );
    return clamp(angles, vec2f(-MAX_ANGLE), vec2f(MAX_ANGLE));
}

// How one angle changes with the pressure, held as `shaped` holds it.
fn slope_of(linear: vec3f, square: vec3f, mixed: vec3f, u: vec3f, limit: f32) -> vec3f {
    let length_2 = max(dot(u, u), limit * limit);
    let short = limit / sqrt(length_2);
    let bent = short * second_order(square, mixed, u);
    let shrinking = select(vec3f(0.0), bent / length_2 * u, dot(u, u) > limit * limit);
    let slope = linear + short * second_order_slope(square, mixed, u) - shrinking;
    return select(slope, vec3f(0.0), abs(dot(linear, u) + bent) > MAX_ANGLE);
}

// A group's pressure, and its rate, as the parent of a joint feels them.
fn felt(q_parent: vec4f, q_carrier: vec4f, u: vec3f) -> vec3f {
    return rotate_back(q_parent, rotate(q_carrier, u));
}
