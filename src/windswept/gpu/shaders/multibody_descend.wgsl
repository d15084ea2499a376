// Root to leaf: where every link is `ahead` of the step's beginning, and the force on it, as motion/multibody/descend.py.
// Writes every link's record: its rotation; force and leaf drag over velocity; moment and wood drag over velocity; the air's
// force on it and its groups and what that stiffens the link by; the vector whose square is what drag over velocity gains.

// What groups do to the link that carries them.
struct Laden {
    force: vec3f,    // N
    torque: vec3f,   // about its joint, N m
    strain: f32,     // sum of every force along its lever, N m
}

// Swings the groups from `first` to before `end` on a link.
fn swing_groups(column: Column, first: u32, end: u32, carrier: Moving, late: f32) -> Laden {
    var laden = Laden(vec3f(0.0), vec3f(0.0), 0.0);
    let stride = column.stride;
    for (var k = first; k < end; k++) {
        let group = groups[column.crowd + k];
        let air = air_at(column.wind, stride, group.rows.x, late);
        let row = column.groups + 2u * k * stride;
        let push = swing_group(group, row, stride, air, carrier.rotation, carrier.turn, carrier.along);
        laden.force += push.force;
        laden.torque += cross(push.arm, push.force) + push.couple;
        laden.strain += dot(push.force, push.arm);
    }
    return laden;
}

// What the air does to a link by itself.
struct Drag {
    force: vec3f,   // N
    leaf: f32,      // drag over velocity of the leaves' tensor
    wood: f32,      // the same of the wood
    growth: vec3f,  // its square is what drag over velocity gains by growing with speed
    strain: f32,    // what the force stiffens the link by, N m
}

fn drag_on(rod: Rod, b: vec3f, velocity: vec3f, air: vec4f) -> Drag {
    let u = air.xyz - velocity;
    let speed = sqrt(dot(u, u) + TINY);
    let leaf = speed * air.w;
    let wood = speed * rod.leaf_1.w;
    let along = dot(b, u);
    let force = leaf * tensor_times(rod.leaf_1.xyz, rod.leaf_2.xyz, u) + wood * (u - along * b);
    let size = sqrt(dot(force, force) + TINY);
    let growth = 0.5 * sqrt(size / speed) * (force / size + u / speed);
    return Drag(force, leaf, wood, growth, rod.foot.w * (dot(force, b) + along * wood));
}

// The force that takes a link's mass by `pull` and its direction by `b_pull`, less the air's on it and its groups, and its
// moment.
fn weigh(rod: Rod, b: vec3f, pull: vec3f, b_pull: vec3f, drag: Drag, laden: Laden, record: u32, stride: u32) {
    let force = rod.mass.x * pull + rod.mass.y * b_pull - drag.force - laden.force;
    let torque = cross(b, rod.mass.y * pull + rod.mass.z * b_pull - rod.foot.w * drag.force) - laden.torque;
    records[record + stride] = vec4f(force, drag.leaf);
    records[record + 2u * stride] = vec4f(torque, drag.wood);
    records[record + 3u * stride] = vec4f(drag.force + laden.force, drag.strain + laden.strain);
    records[record + 4u * stride] = vec4f(drag.growth, 0.0);
}

fn descend(column: Column, late: f32) {
    let pace = column.pace;
    let stride = column.stride;
    var here = GROUND;
    var group = column.grounded;
    if LADEN { _ = swing_groups(column, 0u, group, here, late); }
    for (var i = 0u; i < column.links; i++) {
        let rod = rods[column.rods + i];
        let record = record_of(column, i);
        let link = swung(rod, moving_above(rod, here, column), state[column.state + i * stride], pace.y);
        here = link.moving;
        keep_moving(rod, here, column);
        records[record] = here.rotation;
        let b_rate = cross(here.turn, link.direction);
        // Carried velocities go as far beyond those of the joints as they were behind; `advance` adds the joints' gain.
        let kept = column.carried + CARRIED * i * stride;
        let behind = here.along - carried[kept].xyz;
        let b_behind = b_rate - carried[kept + stride].xyz;
        carried[kept] += vec4f(pace.z * behind, 0.0);
        carried[kept + stride] += vec4f(pace.z * b_behind, 0.0);
        let air = air_at(column.wind, stride, rod.rows.y, late);
        let drag = drag_on(rod, link.direction, here.along + rod.foot.w * b_rate, air);
        var laden = Laden(vec3f(0.0), vec3f(0.0), 0.0);
        if LADEN { laden = swing_groups(column, group, u32(rod.mass.w), here, late); }
        group = u32(rod.mass.w);
        weigh(rod, link.direction, behind / pace.y, b_behind / pace.y, drag, laden, record, stride);
    }
}
