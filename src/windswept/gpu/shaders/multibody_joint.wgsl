// A joint that turns its link by the rotation vector angle_1 axis_1 + angle_2 axis_2, see motion/multibody/joint.py.

struct Joint {
    direction: vec3f,   // of the link
    axis_1: vec3f,      // rate of turn per rate of either angle
    axis_2: vec3f,
}

// Angles that far ahead, at most MOST_ANGLE.
fn angles_ahead(joint: vec4f, ahead: f32) -> vec2f {
    return clamp(joint.xz + ahead * joint.yw, vec2f(-MOST_ANGLE), vec2f(MOST_ANGLE));
}

// Rotation of a link whose carrier has another.
fn turned(above: vec4f, rod: Rod, angles: vec2f) -> vec4f {
    return multiply(above, from_rotation_vector(angles.x * rod.axis_1.xyz + angles.y * rod.axis_2.xyz));
}

// The joint in the world. In the link's own frame the Jacobian of rotations is that of the opposite turn: nothing of the
// carrier is needed. Taylor series as on the CPU.
fn joint_in_world(rotation: vec4f, rod: Rod, angles: vec2f) -> Joint {
    let x = dot(angles, angles);
    let lean = 0.5 - x * (1.0 / 24.0 - x * (1.0 / 720.0 - x * (1.0 / 40320.0 - x / 3628800.0)));
    let curl = 1.0 / 6.0 - x * (1.0 / 120.0 - x * (1.0 / 5040.0 - x / 362880.0));
    let first = rotate(rotation, rod.axis_1.xyz);
    let second = rotate(rotation, rod.axis_2.xyz);
    let direction = cross(first, second);
    let mixed = curl * angles.x * angles.y;
    let straight = 1.0 - curl * angles.yx * angles.yx;
    return Joint(
        direction,
        straight.x * first + mixed * second + lean * angles.y * direction,
        mixed * first + straight.y * second - lean * angles.x * direction,
    );
}

// How a link is turned and how it moves: velocities on the way out, accelerations on the second way out.
struct Moving {
    rotation: vec4f,
    turn: vec3f,    // angular
    along: vec3f,   // of the joint
}

const GROUND = Moving(vec4f(0.0, 0.0, 0.0, 1.0), vec3f(0.0), vec3f(0.0));

// Of the link that a link hangs on, from what is known of the link before it.
fn moving_above(rod: Rod, before: Moving, column: Column) -> Moving {
    if (rod.rows.w & FOLLOWS) != 0u { return before; }
    if rod.rows.x == NONE { return GROUND; }
    let row = slot_of(column, rod.rows.z - 1u);
    let turn = slots[row + column.stride];
    let along = slots[row + 2u * column.stride];
    return Moving(slots[row], turn.xyz, along.xyz);
}

// Keeps it for the links that do not follow.
fn keep_moving(rod: Rod, here: Moving, column: Column) {
    if (rod.rows.w & FORKS) == 0u { return; }
    let row = slot_of(column, rod.rows.z);
    slots[row] = here.rotation;
    slots[row + column.stride] = vec4f(here.turn, 0.0);
    slots[row + 2u * column.stride] = vec4f(here.along, 0.0);
}

// Motion of a joint that is carried by a link in motion.
fn carried_along(rod: Rod, above: Moving) -> vec3f {
    return above.along + cross(above.turn, rotate(above.rotation, rod.foot.xyz));
}

// A link as its joint carries it.
struct Swung {
    moving: Moving,
    direction: vec3f,
}

// Where a link is so far ahead, and how it moves there at the rates of the joints, from its carrier's motion.
fn swung(rod: Rod, above: Moving, joint: vec4f, ahead: f32) -> Swung {
    let angles = angles_ahead(joint, ahead);
    let rotation = turned(above.rotation, rod, angles);
    let axes = joint_in_world(rotation, rod, angles);
    let turn = above.turn + joint.y * axes.axis_1 + joint.w * axes.axis_2;
    return Swung(Moving(rotation, turn, carried_along(rod, above)), axes.direction);
}
