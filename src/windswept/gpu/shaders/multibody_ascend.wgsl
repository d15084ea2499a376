// Leaf to root: the articulated inertia beyond every joint, and how the joint answers to it, as
// motion/multibody/ascend.py. Replaces every link's record by the answer: acceleration per angular acceleration of what
// carries the joint and the joint's own, for both axes; then per acceleration of the joint.
//
// Sums go from a link to its parent in registers where the parent comes next, through a slot at forks alone.

// A thin rod, drag over velocity times the step's implicit part, which resists like a mass at the drag centre, what it
// grows by, and the inertia that stands for the air's pull.
fn with_link(beyond: Beyond, rod: Rod, b: vec3f, leaf: f32, wood: f32, growth: vec3f, stiff: f32) -> Beyond {
    let still = added(across(b, wood), Tensor(leaf * rod.leaf_1.xyz, leaf * rod.leaf_2.xyz));
    let air = minus_product(still, -growth, growth);
    let arm = rod.foot.w * b;
    let held = risen(air, arm);
    let half = levered(arm, 0.5 * held);
    let x = rod.mass.y * b;
    var whole = beyond;
    whole.turning = added(added(beyond.turning, doubled(half)), across(b, rod.mass.z + stiff));
    whole.coupling += held + mat3x3f(0.0, -x.z, x.y, x.z, 0.0, -x.x, -x.y, x.x, 0.0);
    whole.mass = added(beyond.mass, air);
    whole.mass.diagonal += rod.mass.x;
    return whole;
}

// Torque of both springs, their dampers and stops for rates that stay, and what accelerations add to it.
fn springs_of(rod: Rod, joint: vec4f, ahead: f32) -> vec4f {
    let stiffness = vec2f(rod.axis_1.w, rod.axis_2.w);
    let over = joint.xz - clamp(joint.xz, vec2f(-STOP_ANGLE), vec2f(STOP_ANGLE));
    let lag = (ahead + rod.leaf_2.w) * select(vec2f(1.0), vec2f(1.0 + STOP_STIFFNESS), over != vec2f(0.0));
    return vec4f(-stiffness * (joint.xz + STOP_STIFFNESS * over + lag * joint.yw), ahead * lag * stiffness);
}

// Notes a joint's answer; gives inertia, force and moment as they are felt through the joint.
fn give_way(beyond: Beyond, joint: Joint, springs: vec4f, record: u32, stride: u32) -> Beyond {
    let turn_1 = times(beyond.turning, joint.axis_1);
    let turn_2 = times(beyond.turning, joint.axis_2);
    let push_1 = beyond.coupling * joint.axis_1;
    let push_2 = beyond.coupling * joint.axis_2;
    let torque_1 = springs.x - dot(joint.axis_1, beyond.torque);
    let torque_2 = springs.y - dot(joint.axis_2, beyond.torque);
    let d_1 = dot(joint.axis_1, turn_1) + springs.z;
    let d_2 = dot(joint.axis_2, turn_2) + springs.w;
    let d_12 = dot(joint.axis_1, turn_2);
    let e = vec3f(d_2, d_1, -d_12) / (d_1 * d_2 - d_12 * d_12);
    let rise_1 = torque_1 * e.x + torque_2 * e.z;
    let rise_2 = torque_1 * e.z + torque_2 * e.y;
    let answer_1 = e.x * turn_1 + e.z * turn_2;
    let answer_2 = e.z * turn_1 + e.y * turn_2;
    let yield_1 = e.x * push_1 + e.z * push_2;
    let yield_2 = e.z * push_1 + e.y * push_2;
    records[record] = vec4f(answer_1, rise_1);
    records[record + stride] = vec4f(answer_2, rise_2);
    records[record + 2u * stride] = vec4f(yield_1, 0.0);
    records[record + 3u * stride] = vec4f(yield_2, 0.0);
    return Beyond(
        minus_product(minus_product(beyond.turning, answer_1, turn_1), answer_2, turn_2),
        mat3x3f(
            beyond.coupling[0] - answer_1.x * push_1 - answer_2.x * push_2,
            beyond.coupling[1] - answer_1.y * push_1 - answer_2.y * push_2,
            beyond.coupling[2] - answer_1.z * push_1 - answer_2.z * push_2,
        ),
        minus_product(minus_product(beyond.mass, yield_1, push_1), yield_2, push_2),
        beyond.force + rise_1 * push_1 + rise_2 * push_2,
        beyond.torque + rise_1 * turn_1 + rise_2 * turn_2,
        beyond.pull,
        beyond.strain,
    );
}

fn ascend(column: Column) {
    let ahead = column.pace.y;
    let stride = column.stride;
    var rotation = vec4f(0.0);
    var beyond = Beyond();
    for (var k = column.links; k > 0u; k--) {
        let i = k - 1u;
        let rod = rods[column.rods + i];
        let record = record_of(column, i);
        if (rod.rows.w & TIP) != 0u {
            rotation = records[record];
            beyond = Beyond();
        }
        let pushed = records[record + stride];
        let twisted = records[record + 2u * stride];
        let state_now = state[column.state + i * stride];
        let joint = joint_in_world(rotation, rod, angles_ahead(state_now, ahead));
        beyond.force += pushed.xyz;
        beyond.torque += twisted.xyz;
        let pull = records[record + 3u * stride];
        beyond.pull += pull.xyz;
        beyond.strain += pull.w;
        var stiff = ahead * ahead * max(beyond.strain, 0.0);
        stiff *= 1.0 + stiff / (stiff + PULL_KNEE * rod.mass.z);
        let growth = sqrt(ahead) * records[record + 4u * stride].xyz;
        beyond = with_link(beyond, rod, joint.direction, ahead * pushed.w, ahead * twisted.w, growth, stiff);
        beyond = give_way(beyond, joint, springs_of(rod, state_now, ahead), record, stride);
        if rod.rows.x == NONE { continue; }
        rotation = records[record_of(column, rod.rows.x)];
        beyond = shifted(beyond, rotate(rotation, rod.foot.xyz));
        let row = slot_of(column, rod.rows.z);
        if (rod.rows.w & LATER) != 0u { beyond = with_slot(beyond, row, stride); }
        if (rod.rows.w & FOLLOWS) == 0u { lay_down_sum(row, stride, beyond); }
    }
}
