"""The faces that take part in an atlas: the program says of each chart what became of it, and some stay as they are."""

from dataclasses import replace

import numpy as np
from topology import Topology, face_areas

NEAR = 1e-9
ASIDE = ("left", "stacked")  # fates of charts that are no part of the atlas: as they were, or on top of another one


def of_faces(obj, chosen):
    """The geometry of some of the faces, as a mask."""
    sides = np.diff(obj.offsets)
    corners = np.repeat(chosen, sides)
    return replace(
        obj,
        corner_vertex=obj.corner_vertex[corners],
        corner_uv=obj.corner_uv[corners],
        corner_normal=obj.corner_normal[corners],
        offsets=np.concatenate([[0], np.cumsum(sides[chosen])]),
    )


def with_fate(charts, fate, face_count):
    """A mask of the faces of charts with this fate."""
    chosen = np.zeros(face_count, dtype=bool)
    for first, last in (run for chart in charts if chart["fate"] == fate for run in chart["face_ranges"]):
        chosen[first : last + 1] = True
    return chosen


def aside(before, charts):
    """Masks of the faces of charts that were left and that lie on others. `charts` are the report's, None where there is none:
    then, and by reports of old programs, those without UV area are taken for left."""
    if charts is not None and all("face_ranges" in chart for chart in charts):
        return tuple(with_fate(charts, fate, before.faces) for fate in ASIDE)
    topology = Topology(before, as_meant=True)
    area = np.bincount(topology.chart, np.abs(face_areas(before, topology.next)))
    return (area == 0)[topology.chart], np.zeros(before.faces, dtype=bool)


def lie_on(uvs, others, reach):
    """Which of the points are within `reach` of one of the others in each coordinate, or but a little farther."""
    cells = {tuple(cell) for cell in np.floor(others / reach).astype(np.int64).tolist()}
    near = np.stack(np.meshgrid([-1, 0, 1], [-1, 0, 1]), axis=-1).reshape(-1, 2)
    own = np.floor(uvs / reach).astype(np.int64)
    return np.array([any((x + dx, y + dy) in cells for dx, dy in near.tolist()) for x, y in own.tolist()], dtype=bool)


def near_edges(uvs, obj, reach):
    """Which of the points lie on an edge of a face: a follower may have a vertex where its leader has none."""
    following = np.arange(len(obj.corner_uv)) + 1
    following[obj.offsets[1:] - 1] = obj.offsets[:-1]
    a, along = obj.corner_uv, obj.corner_uv[following] - obj.corner_uv
    length2 = np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    out = []
    for p in uvs:
        t = np.clip(np.einsum("ij,ij->i", p - a, along) / length2, 0, 1)
        out.append(bool((np.linalg.norm(p - a - t[:, None] * along, axis=1) <= reach).any()))
    return np.array(out, dtype=bool)


def keeps_uvs(before, after, sources):
    """Whether faces that were left have the UVs that they had. Where a neighbour was cut they have points on their edges, and may be
    divided for these."""
    if before.faces == after.faces and np.array_equal(before.corner_uv, after.corner_uv, equal_nan=True):
        return True
    for f in range(before.faces):
        old = slice(before.offsets[f], before.offsets[f + 1])
        parts = of_faces(after, sources == f)
        places = {}
        for place, uv in zip(before.positions[before.corner_vertex[old]].tolist(), before.corner_uv[old].tolist(), strict=True):
            places.setdefault(tuple(place), []).append(uv)
        new = []
        for place, uv in zip(parts.positions[parts.corner_vertex].tolist(), parts.corner_uv.tolist(), strict=True):
            own = places.get(tuple(place), [])
            if repr(uv) in map(repr, own):
                continue
            if len(own) == 1:  # between several at one place there may be a new one
                return False
            new.append(uv)
        face = of_faces(before, np.arange(before.faces) == f)
        if not len(parts.corner_uv) or (new and not near_edges(np.array(new), face, NEAR).all()):
            return False
    return True


def taking_part(before, after, sources, charts, found):
    """(before, after, sources) of the faces in the atlas; what was left must have its UVs still."""
    finite = np.logical_and.reduceat(np.isfinite(before.corner_uv).all(axis=1), before.offsets[:-1])
    left, stacked = aside(before, charts)
    left |= ~finite
    if not (left | stacked).any():
        return before, after, sources
    of_left = left[sources]
    numbers = np.cumsum(left) - 1
    if not keeps_uvs(of_faces(before, left), of_faces(after, of_left), numbers[sources[of_left]]):
        found["problems"].append("UVs: of charts that were left they differ")
    found.update(left=int(left.sum()), stacked=int(stacked.sum()))
    part = ~(left | stacked)
    atlas, pile = (of_faces(after, of[sources]) for of in (part, stacked))
    if stacked.any():
        reach = Topology.noise_of(after)
        astray = np.flatnonzero(~lie_on(pile.corner_uv, atlas.corner_uv, reach))
        astray = astray[~near_edges(pile.corner_uv[astray], atlas, reach)]
        if len(astray):
            found["problems"].append(f"stacks: {len(astray)} corners lie on no corner of the atlas")
    number = np.cumsum(part) - 1
    return of_faces(before, part), of_faces(after, part[sources]), number[sources[part[sources]]]
