# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with their UV maps as the triangles and lines that an overlay draws, in the UV editor and in space."""

from dataclasses import dataclass, field

import numpy as np

from . import borders, heat


@dataclass(frozen=True)
class Look:
    """What is drawn, and how."""

    layers: tuple  # of "stretch", "seams" and "gap"
    texture_size: tuple  # (width, height) in pixels
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
    shown: np.ndarray = None  # (V, 3) float32: where modifiers and shape keys move the vertices; None: nowhere else


@dataclass(frozen=True)
class Picture:
    """Of one mesh; `where` is "uv" or "space"."""

    colours: np.ndarray = None  # (3 T, 4) float32
    faces: dict = field(default_factory=dict)  # where: (3 T, 3) float32
    lines: dict = field(default_factory=dict)  # layer: {where: (2 n, 3) float32}


def picture_of(engine, sources, look):
    """A Picture of each Source; stretch is that of all of them in one texture."""
    near = _near(engine, [source.atlas for source in sources], look) if "gap" in look.layers else [()] * len(sources)
    colours, triangles = _heat(sources, look) if "stretch" in look.layers else ([None] * len(sources),) * 2
    out = []
    for k, source in enumerate(sources):
        picture = Picture(colours[k])
        if "stretch" in look.layers:
            picture.faces.update(_places(source, triangles[k].ravel()))
        if "seams" in look.layers:
            picture.lines["seams"] = _edges(source, borders.edge_corners(source.atlas, source.new_seams))
        if "gap" in look.layers:
            picture.lines["gap"] = _edges(source, near[k])
        out.append(picture)
    return out


def _heat(sources, look):
    """(colours of each source's corners of triangles, those triangles)."""
    aspect = np.array([look.texture_size[0] / look.texture_size[1], 1.0])
    positions, uvs, triangles, faces = [], [], [], []
    for source in sources:
        atlas = source.atlas
        corners, of_faces = heat.all_triangles(atlas.face_offsets, source.larger)
        positions.append(source.scale * atlas.positions.astype(np.float64)[atlas.corner_vertices[corners]])
        uvs.append(atlas.corner_uvs.astype(np.float64)[corners] * aspect)
        triangles.append(corners)
        faces.append(of_faces)
    values = heat.stretch(np.concatenate(positions), np.concatenate(uvs))
    colours, first = [], 0
    for source, corners, of_faces in zip(sources, triangles, faces, strict=True):
        face_count = len(source.atlas.face_offsets) - 1
        own = heat.worst_of_faces(values[first : first + len(corners)], of_faces, face_count)[of_faces]
        colours.append(np.repeat(heat.colours(own, look.low, look.high, look.worst, look.opacity), 3, axis=0))
        first += len(corners)
    return colours, triangles


def _near(engine, atlases, look):
    """The corners of each atlas at which an edge begins that is nearer than the margin to another chart or to the border."""
    corners = [borders.border_corners(atlas) for atlas in atlases]
    if look.margin_px == 0 or not any(map(len, corners)):
        return [own[:0] for own in corners]
    size = np.array(look.texture_size, dtype=np.float64)
    ends, charts, count = [], [], 0
    for atlas, own in zip(atlases, corners, strict=True):
        ends.append(borders.segments(atlas.corner_uvs.astype(np.float64), atlas.face_offsets, own) * size)
        uvs = np.nan_to_num(atlas.corner_uvs)
        of_faces = engine.charts_of_faces(atlas.positions, atlas.face_offsets, atlas.corner_vertices, uvs)
        charts.append(count + of_faces[np.searchsorted(atlas.face_offsets, own, side="right") - 1])
        count += int(of_faces.max()) + 1
    ends, charts = np.concatenate(ends), np.concatenate(charts)
    margin = look.margin_px * (1 - 1e-3)  # a margin that is kept exactly is kept
    usable = np.flatnonzero(np.isfinite(ends).all(axis=(1, 2)))
    near = np.zeros(len(ends), dtype=bool)
    apart = usable[borders.without_stacked(charts[usable], ends[usable])] if look.keeps_stacks else usable
    near[apart] = borders.near_others(ends[apart], charts[apart], margin)
    if look.to_border:
        near[usable] |= borders.near_texture_border(ends[usable], size, margin)
    parts = np.split(near, np.cumsum([len(own) for own in corners])[:-1])
    return [own[flags] for own, flags in zip(corners, parts, strict=True)]


def _edges(source, corners):
    both = np.column_stack([corners, borders.following_corners(source.atlas.face_offsets)[corners]]).astype(np.int64)
    return _places(source, both.ravel())


def _places(source, corners):
    """Where corners lie, in both editors."""
    uvs = source.atlas.corner_uvs[corners]
    flat = np.column_stack([uvs, np.zeros(len(corners), dtype=np.float32)])
    positions = source.atlas.positions if source.shown is None else source.shown
    return {"uv": np.ascontiguousarray(flat, dtype=np.float32), "space": positions[source.atlas.corner_vertices[corners]]}
