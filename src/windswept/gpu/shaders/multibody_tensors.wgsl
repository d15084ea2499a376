// Symmetric tensors and what an articulated inertia does with them, as motion/multibody/tensors.py.

struct Tensor {
    diagonal: vec3f,   // xx yy zz
    aside: vec3f,      // xy xz yz
}

fn times(t: Tensor, v: vec3f) -> vec3f {
    return tensor_times(t.diagonal, t.aside, v);
}

fn added(a: Tensor, b: Tensor) -> Tensor {
    return Tensor(a.diagonal + b.diagonal, a.aside + b.aside);
}

// s (1 - b b): what acts across the unit vector b alone.
fn across(b: vec3f, s: f32) -> Tensor {
    return Tensor(s - s * b * b, -s * b.xxy * b.yzz);
}

// T - a b, for vectors whose product is symmetric.
fn minus_product(t: Tensor, a: vec3f, b: vec3f) -> Tensor {
    return Tensor(t.diagonal - a * b, t.aside - a.xxy * b.yzz);
}

// Rows of [r] mass, as columns: moment about a point that lies -r away, per acceleration there.
fn risen(mass: Tensor, r: vec3f) -> mat3x3f {
    let x = vec3f(mass.diagonal.x, mass.aside.xy);
    let y = vec3f(mass.aside.x, mass.diagonal.y, mass.aside.z);
    let z = vec3f(mass.aside.yz, mass.diagonal.z);
    return mat3x3f(r.y * z - r.z * y, r.z * x - r.x * z, r.x * y - r.y * x);
}

// [r] rows^T.
fn levered(r: vec3f, rows: mat3x3f) -> mat3x3f {
    return mat3x3f(cross(r, rows[0]), cross(r, rows[1]), cross(r, rows[2]));
}

// Q + Q^T.
fn doubled(q: mat3x3f) -> Tensor {
    return Tensor(
        2.0 * vec3f(q[0].x, q[1].y, q[2].z),
        vec3f(q[0].y + q[1].x, q[0].z + q[2].x, q[1].z + q[2].y),
    );
}

// Articulated inertia of what lies beyond a joint, and the load on it.
struct Beyond {
    turning: Tensor,     // moment per angular acceleration, kg m^2
    coupling: mat3x3f,   // force per angular acceleration, kg m
    mass: Tensor,        // force per acceleration, kg
    force: vec3f,        // that keeps all joints beyond as they turn, N
    torque: vec3f,       // the same about the joint, N m
    pull: vec3f,         // of the air, N
    strain: f32,         // what it stiffens the link by that carries it, N m
}

// The same about a point that lies -r away: turning + Q + Q^T with Q = [r] (coupling + [r] mass / 2)^T.
fn shifted(beyond: Beyond, r: vec3f) -> Beyond {
    let gain = risen(beyond.mass, r);
    var here = beyond;
    here.turning = added(beyond.turning, doubled(levered(r, beyond.coupling + 0.5 * gain)));
    here.coupling = beyond.coupling + gain;
    here.torque += cross(r, beyond.force);
    here.strain = dot(r, beyond.pull);
    return here;
}

fn lay_down_sum(row: u32, stride: u32, beyond: Beyond) {
    slots[row] = vec4f(beyond.turning.diagonal, beyond.force.x);
    slots[row + stride] = vec4f(beyond.turning.aside, beyond.force.y);
    slots[row + 2u * stride] = vec4f(beyond.mass.diagonal, beyond.force.z);
    slots[row + 3u * stride] = vec4f(beyond.mass.aside, beyond.strain);
    slots[row + 4u * stride] = vec4f(beyond.coupling[0], beyond.torque.x);
    slots[row + 5u * stride] = vec4f(beyond.coupling[1], beyond.torque.y);
    slots[row + 6u * stride] = vec4f(beyond.coupling[2], beyond.torque.z);
    slots[row + 7u * stride] = vec4f(beyond.pull, 0.0);
}

fn with_slot(beyond: Beyond, row: u32, stride: u32) -> Beyond {
    let a = slots[row];
    let b = slots[row + stride];
    let c = slots[row + 2u * stride];
    let d = slots[row + 3u * stride];
    let x = slots[row + 4u * stride];
    let y = slots[row + 5u * stride];
    let z = slots[row + 6u * stride];
    return Beyond(
        added(beyond.turning, Tensor(a.xyz, b.xyz)),
        beyond.coupling + mat3x3f(x.xyz, y.xyz, z.xyz),
        added(beyond.mass, Tensor(c.xyz, d.xyz)),
        beyond.force + vec3f(a.w, b.w, c.w),
        beyond.torque + vec3f(x.w, y.w, z.w),
        beyond.pull + slots[row + 7u * stride].xyz,
        beyond.strain + d.w,
    );
}
