// Root to leaf: where every link is `ahead` of the step's beginning, and the force on it, as motion/multibody/descend.py.
// Writes every link's record: its rotation; force and leaf drag over velocity; moment and wood drag over velocity; the drag
// and what it stiffens the link by; the vector whose square is what drag over velocity gains by growing with speed.

fn air_at(column: Column, probe: u32, late: f32) -> vec4f {
    let row = column.wind + 2u * probe * column.stride;
    return mix(wind[row], wind[row + column.stride], late);
}

// Force that takes a link's mass from its carried velocity to that of the joints, less the drag, and its moment.
fn weigh_and_drag(rod: Rod, b: vec3f, velocity: vec3f, air: vec4f, pull: vec3f, b_pull: vec3f, record: u32, stride: u32) {
    let u = air.xyz - velocity;
    let speed = sqrt(dot(u, u) + TINY);
    let leaf = speed * air.w;
    let wood = speed * rod.leaf_1.w;
    let along = dot(b, u);
    let drag = leaf * times(Tensor(rod.leaf_1.xyz, rod.leaf_2.xyz), u) + wood * (u - along * b);
    let size = sqrt(dot(drag, drag) + TINY);
    let growth = 0.5 * sqrt(size / speed) * (drag / size + u / speed);
    let force = rod.mass.x * pull + rod.mass.y * b_pull - drag;
    let torque = cross(b, rod.mass.y * pull + rod.mass.z * b_pull - rod.foot.w * drag);
    records[record + stride] = vec4f(force, leaf);
    records[record + 2u * stride] = vec4f(torque, wood);
    records[record + 3u * stride] = vec4f(drag, rod.foot.w * (dot(drag, b) + along * wood));
    records[record + 4u * stride] = vec4f(growth, 0.0);
}

fn descend(column: Column, late: f32) {
    let pace = column.pace;
    let stride = column.stride;
    var here = Moving(vec4f(0.0, 0.0, 0.0, 1.0), vec3f(0.0), vec3f(0.0));
    for (var i = 0u; i < column.links; i++) {
        let rod = rods[column.rods + i];
        let record = record_of(column, i);
        let above = moving_above(rod, here, column);
        let state_now = state[column.state + i * stride];
        let angles = angles_ahead(state_now, pace.y);
        here.rotation = turned(above.rotation, rod, angles);
        let joint = joint_in_world(here.rotation, rod, angles);
        here.turn = above.turn + state_now.y * joint.axis_1 + state_now.w * joint.axis_2;
        here.along = carried_along(rod, above);
        keep_moving(rod, here, column);
        records[record] = here.rotation;
        let b_rate = cross(here.turn, joint.direction);
        // Carried velocities go as far beyond those of the joints as they were behind; `advance` adds the joints' gain.
        let kept = column.carried + CARRIED * i * stride;
        let behind = here.along - carried[kept].xyz;
        let b_behind = b_rate - carried[kept + stride].xyz;
        carried[kept] += vec4f(pace.z * behind, 0.0);
        carried[kept + stride] += vec4f(pace.z * b_behind, 0.0);
        let air = air_at(column, rod.rows.y, late);
        let velocity = here.along + rod.foot.w * b_rate;
        weigh_and_drag(rod, joint.direction, velocity, air, behind / pace.y, b_behind / pace.y, record, stride);
    }
}
