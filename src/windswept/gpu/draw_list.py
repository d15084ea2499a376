"""Frame -> what is drawn of every placement and where its posed parts lie; culling/ does the same on the card."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windswept.geometry.detail import LEAF_MESHES, Detail, DetailRules, choose_detail
from windswept.gpu import layouts
from windswept.gpu.frame import Camera, PosedPlants
from windswept.gpu.plant_buffers import Kind
from windswept.plants.plant import Ints

Doubles = NDArray[np.float64]

NEAREST = 1.0
"""Distance at which detail stops growing, m."""
CHUNK = 64
"""Stems, pieces or leaves of one placement that a workgroup poses: CHUNK of ``curves.wgsl``."""


@dataclass(frozen=True, slots=True)
class View:
    """What can be seen and what can throw a shadow into it."""

    camera: Camera
    screen_height: int
    planes: Doubles
    """(5, 4) planes of the frustum, positive inside."""
    sun: Doubles
    """(3,) unit direction towards the sun."""
    shadow_centre: Doubles
    """(3,) middle of the ball that receives shadows, m."""
    shadow_radius: float
    shadow_texel: float
    """Side of a texel of the shadow map, m: all the detail that a plant out of sight needs."""

    def coarser(self, share: float) -> View:
        """The same in a picture of ``share`` times the height."""
        return replace(self, screen_height=int(share * self.screen_height))


@dataclass(frozen=True, slots=True)
class ItemRange:
    """Posed items of one bucket: those that only throw shadows, then those seen near by, then those far off."""

    first: int
    hidden: int
    """Items out of sight, at the front."""
    casters: int
    """Items that throw shadows, from the front."""
    total: int


@dataclass(frozen=True, slots=True)
class DrawList:
    """What one frame poses and draws."""

    placements: NDArray[np.void]
    """(n,) ``PLACEMENT`` rows of the placements that matter."""
    pieces: tuple[ItemRange, ...]
    """One for each bucket of stems."""
    leaves: tuple[ItemRange, ...]
    """One for each leaf mesh."""
    chunks: tuple[int, int, int]
    """Runs of up to ``CHUNK`` stems, pieces and leaves of all placements."""
    links: Ints
    """(n,) poses that each placement needs, from rank 0 on: they stand one after another."""

    @property
    def piece_count(self) -> int:
        """Posed pieces of all buckets."""
        return sum(bucket.total for bucket in self.pieces)

    @property
    def leaf_count(self) -> int:
        """Posed leaves of all meshes."""
        return sum(mesh.total for mesh in self.leaves)

    @property
    def counts(self) -> tuple[int, int, int, int]:
        """Link poses, shifted stems, posed pieces and posed leaves of all placements."""
        stems = int(self.placements["rows"][:, 3].sum(dtype=np.int64))
        return int(self.links.sum(dtype=np.int64)), stems, self.piece_count, self.leaf_count


def draw_list(
    kinds: tuple[Kind, ...], plants: tuple[PosedPlants, ...], view: View, rules: DetailRules
) -> DrawList:
    """Choose detail, drop what neither is seen nor throws a shadow, and lay out the posed items.

    Args:
        kinds: what the card holds.
        plants: placements of each kind.
        view: camera and shadow volume.
        rules: what may be spent.
    """
    rows, centres = [np.zeros(0, layouts.PLACEMENT)], [np.zeros((0, 3))]
    radii, meshes, links = [np.zeros(0)], [np.zeros(0, np.int32)], [np.zeros(0, np.int32)]
    for look, (kind, posed) in enumerate(zip(kinds, plants, strict=True)):
        centre = _placed_centres(kind, posed)
        seen = _seen(centre, kind.radius, view)
        pixels = _pixels(view, centre, kind.radius)
        pixels = np.where(seen, pixels, np.minimum(pixels, 1.0 / view.shadow_texel))
        detail = choose_detail(kind.order, pixels, rules)
        reach = kind.pose.reach(detail.piece_limit[:, -1], detail.leaf_count)
        rows.append(_placement_rows(kind, posed, detail, reach[:, 1], look, len(kinds)))
        centres.append(centre)
        radii.append(np.full(len(centre), kind.radius))
        meshes.append(detail.leaf_mesh)
        links.append(reach[:, 0])
    placements = np.concatenate(rows)
    placements["number"][:, 0] = np.arange(len(placements))
    return _arrange(
        placements,
        np.concatenate(centres),
        np.concatenate(radii),
        np.concatenate(meshes),
        np.concatenate(links),
        view,
    )


def _placed_centres(kind: Kind, posed: PosedPlants) -> Doubles:
    """(P, 3) middle of every placement in the world, m."""
    x, y, z = kind.centre
    cosine, sine = np.cos(posed.yaw), np.sin(posed.yaw)
    turned = np.stack([cosine * x - sine * y, sine * x + cosine * y, np.full(len(cosine), z)], axis=1)
    return posed.position + turned


def _pixels(view: View, centre: Doubles, radius: float) -> Doubles:
    """(P,) pixels a metre takes in the nearer half of each placement."""
    away = np.linalg.norm(centre - np.asarray(view.camera.eye), axis=1) - 0.5 * radius
    return view.screen_height / (2.0 * np.tan(0.5 * view.camera.fov_y) * np.maximum(away, NEAREST))


def _placement_rows(
    kind: Kind,
    posed: PosedPlants,
    detail: Detail,
    stems: Ints,
    look: int,
    kinds_count: int,
) -> NDArray[np.void]:
    """``PLACEMENT`` rows without the places of their posed items."""
    count = len(posed.position)
    rows = np.zeros(count, layouts.PLACEMENT)
    rows["position"][:, :3] = posed.position
    rows["position"][:, 3] = np.cos(posed.yaw)
    rows["heading"] = np.stack(
        [np.sin(posed.yaw), posed.flutter, phases(count, look), detail.size_cut], axis=1
    )
    rows["rows"][:, 2] = kind.stem_first
    rows["rows"][:, 3] = stems
    rows["first"] = kind.piece_first, kind.leaf_first, 0, look
    rows["first"][:, 3] = looks_of(posed, look, kinds_count)
    rows["piece_limit"] = detail.piece_limit
    rows["leaves"] = np.stack(
        [detail.leaf_count, detail.leaf_cut, detail.leaf_fade, detail.leaf_scale], axis=1
    )
    return rows


def phases(count: int, look: int) -> Doubles:
    """(count,) random number of every placement of a kind, 0 to 1."""
    return np.asarray((np.arange(count) * 0.7548776662 + 0.13 * look) % 1.0, np.float64)


def looks_of(posed: PosedPlants, look: int, kinds_count: int) -> NDArray[np.int64]:
    """(P,) look that every placement of a kind wears."""
    if posed.extra_look is None:
        return np.full(len(posed.position), look)
    return kinds_count + np.asarray(posed.extra_look, np.int64)


def _arrange(
    rows: NDArray[np.void], centres: Doubles, radii: Doubles, mesh: Ints, links: Ints, view: View
) -> DrawList:
    """Order placements as shadows only, near, far; then give each its places among the posed items."""
    seen = _seen(centres, radii, view)
    casts = _casts(centres, radii, view)
    distance = np.linalg.norm(centres - np.asarray(view.camera.eye), axis=1)
    group = np.where(~seen, 0, np.where(casts, 1, 2))
    order = np.lexsort([distance, group])
    order = order[(seen | casts)[order]]
    rows, seen, casts, mesh, links = rows[order], seen[order], casts[order], mesh[order], links[order]

    piece_limit = rows["piece_limit"].astype(np.int64)
    piece_counts = np.concatenate([piece_limit[:, :1], piece_limit[:, 1:] - piece_limit[:, :-1]], axis=1)
    leaf_counts = rows["leaves"][:, 0].astype(np.int64)
    by_mesh = np.where(mesh[:, None] == np.arange(LEAF_MESHES), leaf_counts[:, None], 0)
    piece_out, piece_ranges = _lay_out(piece_counts, seen, casts)
    leaf_out, leaf_ranges = _lay_out(by_mesh, seen, casts)
    rows["piece_out"] = piece_out
    rows["first"][:, 2] = np.take_along_axis(leaf_out, mesh[:, None].astype(np.int64), axis=1)[:, 0]
    stem_counts = rows["rows"][:, 3].astype(np.int64)
    rows["rows"][:, 0] = np.cumsum(links, dtype=np.int64) - links
    rows["rows"][:, 1] = np.cumsum(stem_counts) - stem_counts
    chunks = -(-np.stack([stem_counts, piece_limit[:, -1], leaf_counts], axis=1) // CHUNK)
    rows["number"][:, 1:] = np.cumsum(chunks, axis=0) - chunks
    stems, pieces, leaves = (int(count) for count in chunks.sum(axis=0))
    return DrawList(rows, piece_ranges, leaf_ranges, (stems, pieces, leaves), links)


def _seen(centres: Doubles, radii: Doubles | float, view: View) -> NDArray[np.bool_]:
    """(n,) whether balls reach into the frustum."""
    inside = centres @ view.planes[:, :3].T + view.planes[:, 3]
    reach = np.broadcast_to(np.asarray(radii), len(centres))
    return np.all(inside > -reach[:, None], axis=1)


def _casts(centres: Doubles, radii: Doubles, view: View) -> NDArray[np.bool_]:
    """(n,) whether a placement's shadow can fall into the ball that receives shadows."""
    offset = centres - view.shadow_centre
    along = offset @ view.sun
    aside = np.linalg.norm(offset - along[:, None] * view.sun, axis=1)
    reach = view.shadow_radius + radii
    return (aside < reach) & (along > -reach) & (along < 4.0 * reach)


def _lay_out(
    counts: NDArray[np.int64], seen: NDArray[np.bool_], casts: NDArray[np.bool_]
) -> tuple[NDArray[np.int64], tuple[ItemRange, ...]]:
    """Places (n, buckets) for ``counts`` items, bucket after bucket, and the range of each bucket."""
    totals = counts.sum(axis=0)
    bucket_first = np.concatenate([[0], np.cumsum(totals)[:-1]])
    places = bucket_first + np.cumsum(counts, axis=0) - counts
    hidden, casting = counts[~seen].sum(axis=0), counts[casts].sum(axis=0)
    ranges = zip(bucket_first, hidden, casting, totals, strict=True)
    return places, tuple(ItemRange(*(int(value) for value in values)) for values in ranges)
