# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with their UV maps as the triangles and lines that an overlay draws, in the UV editor and in space."""

from dataclasses import dataclass, field

import numpy as np

from . import borders, heat


@dataclass(frozen=True)
class Look:
    """What is drawn, and how."""

    layers: tuple  # of "stretch", "seams" and "gap"
    texture_sizes: tuple  # (width, height) in pixels of each box: a texture of its own
    margin_px: float  # 0: no margin is asked for
    to_border: bool  # the margin is one to the texture's border as well
    keeps_stacks: bool
    low: tuple  # RGB colour of faces without stretch,
    high: tuple  # and of those whose stretch is
    worst: float  # this or more
    opacity: float


@dataclass(frozen=True)
class Source:
    """A mesh with its UV map, to be drawn."""

    atlas: object  # AtlasArrays
    larger: np.ndarray  # (T, 3) corners: the triangles of faces of more than three
    scale: float  # of the object in the world
    new_seams: np.ndarray  # (S, 2) vertices
    boxes: np.ndarray  # (F,) int: which box each face is packed in
    shown: np.ndarray = None  # (V, 3) float32: where modifiers and shape keys move the vertices; None: nowhere else
    evaluated: "Source" = None  # where modifiers make other faces: those, whose stretch is drawn in space


@dataclass(frozen=True)
class Picture:
    """Of one mesh; `where` is "uv" or "space"."""

    colours: dict = field(default_factory=dict)  # where: (3 T, 4) float32
    faces: dict = field(default_factory=dict)  # where: (3 T, 3) float32
    lines: dict = field(default_factory=dict)  # layer: {where: (2 n, 3) float32}


def picture_of(engine, sources, look):
    """A Picture of each Source; stretch is that of all that shares a box."""
    near = _near(engine, sources, look) if "gap" in look.layers else [()] * len(sources)
    out = [Picture() for _ in sources]
    if "stretch" in look.layers:
        _add_heat(sources, look, out)
    for k, (source, picture) in enumerate(zip(sources, out, strict=True)):
        if "seams" in look.layers:
            picture.lines["seams"] = _edges(source, borders.edge_corners(source.atlas, source.new_seams))
        if "gap" in look.layers:
            picture.lines["gap"] = _edges(source, near[k])
    return out


def _add_heat(sources, look, pictures):
    seen = [source.evaluated or source for source in sources]
    in_uv = _heat(sources, look)
    in_space = _heat(seen, look) if any(source.evaluated for source in sources) else in_uv
    for where, owners, found in (("uv", sources, in_uv), ("space", seen, in_space)):
        for picture, owner, colours, triangles in zip(pictures, owners, *found, strict=True):
            picture.colours[where] = colours
            picture.faces[where] = _places(owner, triangles.ravel())[where]


def _heat(sources, look):
    """(colours of each source's corners of triangles, those triangles)."""
    sizes = np.array(look.texture_sizes, dtype=np.float64)
    positions, uvs, triangles, faces, boxes = [], [], [], [], []
    for source in sources:
        atlas = source.atlas
        corners, of_faces = heat.all_triangles(atlas.face_offsets, source.larger)
        positions.append(source.scale * atlas.positions.astype(np.float64)[atlas.corner_vertices[corners]])
        boxes.append(source.boxes[of_faces])
        uvs.append(atlas.corner_uvs.astype(np.float64)[corners] * sizes[boxes[-1], None])
        triangles.append(corners)
        faces.append(of_faces)
    values = _stretch(np.concatenate(positions), np.concatenate(uvs), np.concatenate(boxes))
    colours, first = [], 0
    for source, corners, of_faces in zip(sources, triangles, faces, strict=True):
        face_count = len(source.atlas.face_offsets) - 1
        own = heat.worst_of_faces(values[first : first + len(corners)], of_faces, face_count)[of_faces]
        colours.append(np.repeat(heat.colours(own, look.low, look.high, look.worst, look.opacity), 3, axis=0))
        first += len(corners)
    return colours, triangles


def _stretch(positions, uvs, boxes):
    values = np.ones(len(boxes))
    for box in np.unique(boxes):
        own = boxes == box
        values[own] = heat.stretch(positions[own], uvs[own])
    return values


def _near(engine, sources, look):
    """The corners of each source at which an edge begins that is nearer than the margin to another chart or to the border."""
    corners = [borders.border_corners(source.atlas) for source in sources]
    if look.margin_px == 0 or not any(map(len, corners)):
        return [own[:0] for own in corners]
    sizes = np.array(look.texture_sizes, dtype=np.float64)
    ends, charts, boxes, count = [], [], [], 0
    for source, own in zip(sources, corners, strict=True):
        atlas, faces = source.atlas, np.searchsorted(source.atlas.face_offsets, own, side="right") - 1
        boxes.append(source.boxes[faces])
        ends.append(borders.segments(atlas.corner_uvs.astype(np.float64), atlas.face_offsets, own) * sizes[boxes[-1], None])
        uvs = np.nan_to_num(atlas.corner_uvs)
        of_faces = engine.charts_of_faces(atlas.positions, atlas.face_offsets, atlas.corner_vertices, uvs, groups=source.boxes)
        charts.append(count + of_faces[faces])
        count += int(of_faces.max()) + 1
    ends, charts, boxes = np.concatenate(ends), np.concatenate(charts), np.concatenate(boxes)
    near, is_usable = np.zeros(len(ends), dtype=bool), np.isfinite(ends).all(axis=(1, 2))
    for box, size in enumerate(sizes):
        usable = np.flatnonzero(is_usable & (boxes == box))
        near[usable] = _near_in_box(ends[usable], charts[usable], size, look)
    parts = np.split(near, np.cumsum([len(own) for own in corners])[:-1])
    return [own[flags] for own, flags in zip(corners, parts, strict=True)]


def _near_in_box(ends, charts, size, look):
    margin = look.margin_px * (1 - 1e-3)  # a margin that is kept exactly is kept
    near = np.zeros(len(ends), dtype=bool)
    apart = np.flatnonzero(borders.without_stacked(charts, ends)) if look.keeps_stacks else np.arange(len(ends))
    near[apart] = borders.near_others(ends[apart], charts[apart], margin)
    return near | borders.near_texture_border(ends, size, margin) if look.to_border else near


def _edges(source, corners):
    both = np.column_stack([corners, borders.following_corners(source.atlas.face_offsets)[corners]]).astype(np.int64)
    return _places(source, both.ravel())


def _places(source, corners):
    """Where corners lie, in both editors."""
    uvs = source.atlas.corner_uvs[corners]
    flat = np.column_stack([uvs, np.zeros(len(corners), dtype=np.float32)])
    positions = source.atlas.positions if source.shown is None else source.shown
    return {"uv": np.ascontiguousarray(flat, dtype=np.float32), "space": positions[source.atlas.corner_vertices[corners]]}
