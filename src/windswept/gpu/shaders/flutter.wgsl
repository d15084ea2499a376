// How far leaves tremble, from the wind in each crown that the card knows. Set: types + flutter.

override LARGEST_FLUTTER: f32 = 0.6;   // of a readily fluttering leaf in a storm, rad
override FLUTTER_SPEED: f32 = 5.0;     // at which it trembles with 63 % of that, m/s

@group(0) @binding(1) var<storage, read> speeds: array<f32>;
@group(0) @binding(2) var<storage, read_write> placements: array<Placement>;

@compute @workgroup_size(64)
fn flutter(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&placements) { return; }
    let speed = speeds[placements[id.x].number.x];
    placements[id.x].heading.y = LARGEST_FLUTTER * (1.0 - exp(-speed / FLUTTER_SPEED));
}
