// Balls that roll through the scene. Set: types + light + rotation + balls.

const RINGS = 14u;
const SIDES = 28u;
const CORNERS = array<vec2u, 6>(vec2u(0u, 0u), vec2u(0u, 1u), vec2u(1u, 0u), vec2u(1u, 0u), vec2u(0u, 1u), vec2u(1u, 1u));

struct BallRow {
    place: vec4f,      // middle in the world, m; radius, m
    rotation: vec4f,   // quaternion from the ball's own frame
}

@group(1) @binding(0) var<storage, read> balls: array<BallRow>;

struct BallVertex {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) own: vec3f,
}

fn own_point(vertex: u32) -> vec3f {
    let quad = vertex / 6u;
    let corner = CORNERS[vertex % 6u];
    let down = 3.14159265 * f32(quad / SIDES + corner.x) / f32(RINGS);
    let round = 6.2831853 * f32(quad % SIDES + corner.y) / f32(SIDES);
    return vec3f(sin(down) * cos(round), sin(down) * sin(round), cos(down));
}

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> BallVertex {
    let ball = balls[instance];
    let own = own_point(vertex);
    let normal = rotate(ball.rotation, own);
    let world = ball.place.xyz + ball.place.w * normal;
    return BallVertex(frame.view_projection * vec4f(world, 1.0), world, normal, own);
}

@fragment
fn fragment(in: BallVertex) -> @location(0) vec4f {
    let normal = normalize(in.normal);
    let own = normalize(in.own);
    // Six segments in turn red and white, with caps at both ends.
    let segment = 0.5 + 0.5 * sin(3.0 * atan2(own.y, own.x));
    let white = max(smoothstep(0.42, 0.58, segment) * smoothstep(0.97, 0.95, abs(own.z)), smoothstep(0.975, 0.985, abs(own.z)));
    let albedo = mix(vec3f(0.42, 0.03, 0.02), vec3f(0.62, 0.60, 0.55), white);
    let to_eye = normalize(frame.eye.xyz - in.world);
    let sun = frame.sun.xyz;
    let gloss = 0.25 * pow(max(dot(normal, normalize(sun + to_eye)), 0.0), 60.0);
    let direct = frame.sun_light.rgb * sunlight(in.world, normal) * (albedo * max(dot(normal, sun), 0.0) + gloss);
    let low = 0.35 + 0.65 * smoothstep(-0.9, 0.6, normal.z);
    return finished(direct + ambient(normal) * low * albedo, in.world);
}

@vertex
fn shadow(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    let ball = balls[instance];
    let world = ball.place.xyz + ball.place.w * rotate(ball.rotation, own_point(vertex));
    return frame.sun_projection * vec4f(world, 1.0);
}
