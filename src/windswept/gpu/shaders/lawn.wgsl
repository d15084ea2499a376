// Where blades of meadow grass stand round a camera, and which are in sight: gpu/grass_field.py on the card.
// Set: scan + lawn. `mark` and `sow` a cell of the lattices, `plan_lawn` once in between. Places in the list follow the
// cells' order, so the same eye gets the same list.

struct LawnLook {
    eye: vec4f,                // m; 0
    planes: array<vec4f, 5>,   // of the frustum, positive inside
    ground: vec4f,             // origin x and y of the heights, m; spacing, m; 0
    counts: vec4u,             // columns and rows of heights; words of `marks`; cells of all rings
    rings: array<vec4f, 3>,    // spacing of the lattice, inner and outer radius, m; 0
    cells: array<vec4u, 3>,    // bits of x and y of the first cell; cells along a side; cells of the rings before
}

const BLEND = 0.25;    // share of a ring's radius over which blades shrink into the next ring
const MARGIN = 0.5;    // how far out of the picture a blade's foot may be, m
const BATCH = 64u;     // of grass.wgsl
const INDICES = 9u;    // of a blade

@group(0) @binding(0) var<uniform> look: LawnLook;
@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read_write> marks: array<atomic<u32>>;   // a bit a cell
@group(0) @binding(3) var<storage, read_write> firsts: array<u32>;          // of each word of marks its first blade
@group(0) @binding(4) var<storage, read_write> blades: array<vec4f>;        // two rows of GrassBlade each
@group(0) @binding(5) var<storage, read_write> words: array<u32>;           // arguments of the draw
@group(0) @binding(6) var<storage, read_write> batch: array<vec4u>;         // Batch

// The product of two numbers of 64 bits, low half first.
fn multiplied(a: vec2u, b: vec2u) -> vec2u {
    let x = vec2u(a.x & 0xffffu, a.x >> 16u);
    let y = vec2u(b.x & 0xffffu, b.x >> 16u);
    let low = x.x * y.x;
    let middle = x.y * y.x + (low >> 16u);
    let other = x.x * y.y + (middle & 0xffffu);
    let high = x.y * y.y + (middle >> 16u) + (other >> 16u);
    return vec2u((other << 16u) | (low & 0xffffu), high + a.x * b.y + a.y * b.x);
}

fn widened(cell: i32) -> vec2u {
    return vec2u(bitcast<u32>(cell), select(0u, 0xffffffffu, cell < 0));
}

// Random numbers in 0..1 that belong to a cell for ever.
fn chances(cell: vec2i) -> vec4f {
    var mixed = multiplied(widened(cell.x), vec2u(0x7f4a7c15u, 0x9e3779b9u));
    mixed ^= multiplied(widened(cell.y), vec2u(0x27d4eb4fu, 0xc2b2ae3du));
    mixed ^= vec2u((mixed.x >> 29u) | (mixed.y << 3u), mixed.y >> 29u);
    mixed = multiplied(mixed, vec2u(0x1ce4e5b9u, 0xbf58476du));
    mixed.x ^= mixed.y;
    return vec4f(vec4u(mixed.x & 0xffffu, mixed.x >> 16u, mixed.y & 0xffffu, mixed.y >> 16u)) / 65536.0;
}

fn ground_height(place: vec2f) -> f32 {
    let size = vec2f(look.counts.xy);
    let grid = clamp((place - look.ground.xy) / look.ground.z, vec2f(0.0), size - 1.0);
    let corner = min(vec2u(grid), look.counts.xy - 2u);
    let part = grid - vec2f(corner);
    let at = corner.y * look.counts.x + corner.x;
    let near = mix(heights[at], heights[at + 1u], part.x);
    let far = mix(heights[at + look.counts.x], heights[at + look.counts.x + 1u], part.x);
    return mix(near, far, part.y);
}

struct Cell {
    ring: vec4f,
    place: vec2i,
}

fn cell_of(number: u32) -> Cell {
    var ring = 0u;
    if number >= look.cells[1].w { ring = 1u; }
    if number >= look.cells[2].w { ring = 2u; }
    let row = look.cells[ring];
    let own = number - row.w;
    return Cell(look.rings[ring], bitcast<vec2i>(row.xy) + vec2i(vec2u(own % row.z, own / row.z)));
}

fn root_of(cell: Cell, chance: vec4f) -> vec2f {
    return (vec2f(cell.place) + chance.xy) * cell.ring.x;
}

// Size of a blade, 0..1: it shrinks into the rings before and after its own.
fn size_at(ring: vec4f, root: vec2f) -> f32 {
    let away = distance(root, look.eye.xy);
    let outer = saturate((ring.z * (1.0 + BLEND) - away) / (BLEND * ring.z));
    if ring.y == 0.0 { return outer; }
    return outer * saturate((away - ring.y) / (BLEND * ring.y));
}

@compute @workgroup_size(64)
fn mark(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= look.counts.w { return; }
    let cell = cell_of(id.x);
    let corner = vec2f(cell.place) * cell.ring.x;
    // No blade stands farther from its cell's corner than the cell is wide.
    if distance(corner, look.eye.xy) > cell.ring.z * (1.0 + BLEND) + 2.0 * cell.ring.x { return; }
    let point = vec4f(corner, ground_height(corner), 1.0);
    for (var p = 0u; p < 5u; p++) {
        if dot(look.planes[p], point) <= -MARGIN { return; }
    }
    if size_at(cell.ring, root_of(cell, chances(cell.place))) > 0.0 {
        atomicOr(&marks[id.x / 32u], 1u << (id.x % 32u));
    }
}

@compute @workgroup_size(256)
fn plan_lawn(@builtin(local_invocation_index) lane: u32) {
    let run = run_of(lane, look.counts.z);
    var own = 0u;
    for (var w = run.x; w < run.y; w++) { own += countOneBits(atomicLoad(&marks[w])); }
    var next = sum_before(lane, own);
    for (var w = run.x; w < run.y; w++) {
        firsts[w] = next;
        next += countOneBits(atomicLoad(&marks[w]));
    }
    if lane == 0u {
        let total = crew_total();
        words[0] = INDICES * BATCH;
        words[1] = (total + BATCH - 1u) / BATCH;
        for (var rest = 2u; rest < 5u; rest++) { words[rest] = 0u; }
        batch[0] = vec4u(0u, total, 1u, 0u);
        batch[1] = vec4u(0u);
    }
}

@compute @workgroup_size(64)
fn sow(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= look.counts.w { return; }
    let marked = atomicLoad(&marks[id.x / 32u]);
    let bit = 1u << (id.x % 32u);
    if (marked & bit) == 0u { return; }
    let cell = cell_of(id.x);
    let chance = chances(cell.place);
    let root = root_of(cell, chance);
    let row = 2u * (firsts[id.x / 32u] + countOneBits(marked & (bit - 1u)));
    blades[row] = vec4f(root, ground_height(root), size_at(cell.ring, root));
    blades[row + 1u] = chance;
}
