// Air on a grid over the terrain, read by blades and by the probes of plants. gpu/blades/layouts.py holds the same
// fields of AirGrid as NumPy types.

struct AirGrid {
    nodes: vec4u,     // along x, y and up; first node
    origin: vec4f,    // m; 0
    per_metre: vec4f, // nodes in a metre; 0
}

// The lowest of the eight nodes round a place, the ways to its neighbours, and how far into the cell the place is.
struct Cell {
    node: u32,
    along_x: u32,
    along_y: u32,
    part: vec3f,
}

// x, y and height counted in cells from the first node.
fn in_cells(grid: AirGrid, place: vec3f) -> vec3f {
    return (place - grid.origin.xyz) * grid.per_metre.xyz;
}

fn last_cells(grid: AirGrid) -> vec3f {
    return vec3f(grid.nodes.xyz) - 1.0;
}

// The cell of a place within the grid, counted in cells.
fn cell_of(grid: AirGrid, cells: vec3f) -> Cell {
    let first = min(floor(cells), last_cells(grid) - 1.0);
    let corner = vec3u(first);
    let node = grid.nodes.w + (corner.x * grid.nodes.y + corner.y) * grid.nodes.z + corner.z;
    return Cell(node, grid.nodes.y * grid.nodes.z, grid.nodes.z, cells - first);
}
