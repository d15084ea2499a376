// A group of branches that share one oscillator: how it swings, and what it passes on to the link that carries it;
// motion/groups.py is the same on the CPU. Set: motion + rotation + groups + springs, or + multibody's.

const GROUP_REST_THRESHOLD = 1e-7;

// Of a group on its carrier.
struct Push {
    force: vec3f,    // N
    arm: vec3f,      // from the carrier's joint to where it acts, m
    couple: vec3f,   // N m
}

// Air at a probe, so late in the interval, for a lane whose rows of wind begin at `first`.
fn air_at(first: u32, stride: u32, probe: u32, late: f32) -> vec4f {
    let row = first + 2u * probe * stride;
    return mix(wind[row], wind[row + stride], late);
}

fn tensor_times(diagonal: vec3f, aside: vec3f, v: vec3f) -> vec3f {
    return vec3f(
        v.x * diagonal.x + v.y * aside.x + v.z * aside.y,
        v.x * aside.x + v.y * diagonal.y + v.z * aside.z,
        v.x * aside.y + v.y * aside.z + v.z * diagonal.z,
    );
}

fn pressure_settled(value: vec3f) -> vec3f {
    return select(value, vec3f(0.0), abs(value) < vec3f(GROUP_REST_THRESHOLD));
}

// Steps a group, whose state begins at `row`, on a carrier with that rotation, angular velocity and velocity of its joint.
fn swing_group(group: Group, row: u32, stride: u32, air: vec4f, rotation: vec4f, spin: vec3f, velocity: vec3f) -> Push {
    let u = state[row].xyz;
    let rate = state[row + stride].xyz;
    let arm = rotate(rotation, group.centre.xyz);
    let swayed = vec3f(dot(group.sway_x.xyz, rate), dot(group.sway_y.xyz, rate), dot(group.sway_z.xyz, rate));
    let moving = velocity + cross(spin, arm) + rotate(rotation, swayed);
    let speed = sqrt(dot(air.xyz - moving, air.xyz - moving) + TINY);
    let relative = air.xyz - moving / (1.0 + speed * group.leaf_2.w);
    let leaf = speed * air.w;
    let pressure = relative * (leaf * group.centre.w + speed * group.leaf_1.w);
    let goal = rotate_back(rotation, pressure);
    let y = u - goal;
    state[row] = vec4f(pressure_settled(goal + group.swing.x * y + group.swing.y * rate), 0.0);
    state[row + stride] = vec4f(pressure_settled(group.swing.z * y + group.swing.w * rate), 0.0);
    let force = leaf * tensor_times(group.leaf_1.xyz, group.leaf_2.xyz, relative)
        + speed * tensor_times(group.wood_1.xyz, group.wood_2.xyz, relative);
    let couple = vec3f(
        dot(group.couple_x.xyz, pressure), dot(group.couple_y.xyz, pressure), dot(group.couple_z.xyz, pressure),
    );
    return Push(force, arm, couple);
}
