// Root to leaf once more: every joint's acceleration and step, as motion/multibody/advance.py.

fn advance(column: Column) {
    let pace = column.pace;
    let stride = column.stride;
    var here = GROUND;
    for (var i = 0u; i < column.links; i++) {
        let rod = rods[column.rods + i];
        let record = record_of(column, i);
        let above = moving_above(rod, here, column);
        let before = state[column.state + i * stride];
        let angles = angles_ahead(before, pace.y);
        here.rotation = turned(above.rotation, rod, angles);
        here.along = carried_along(rod, above);
        let answer_1 = records[record];
        let answer_2 = records[record + stride];
        let yield_1 = records[record + 2u * stride].xyz;
        let yield_2 = records[record + 3u * stride].xyz;
        let rise = vec2f(
            answer_1.w - dot(answer_1.xyz, above.turn) - dot(yield_1, here.along),
            answer_2.w - dot(answer_2.xyz, above.turn) - dot(yield_2, here.along),
        );
        let joint = joint_in_world(here.rotation, rod, angles);
        here.turn = above.turn + rise.x * joint.axis_1 + rise.y * joint.axis_2;
        keep_moving(rod, here, column);
        let kept = column.carried + CARRIED * i * stride;
        carried[kept] = settled(carried[kept] + pace.x * vec4f(here.along, 0.0));
        let b_gain = pace.x * cross(here.turn, joint.direction);
        carried[kept + stride] = settled(carried[kept + stride] + vec4f(b_gain, 0.0));
        let gained = pace.y * rise;
        let inside = abs(before.xz) > vec2f(STOP_ANGLE);
        let most = select(vec2f(STOP_EDGE), vec2f(MOST_ANGLE), inside);
        let after = clamp(before.xz + pace.x * (before.yw + gained), -most, most);
        let rate = before.yw + gained + RATE_LEAD * gained;
        state[column.state + i * stride] = settled(vec4f(after.x, rate.x, after.y, rate.y));
    }
}
