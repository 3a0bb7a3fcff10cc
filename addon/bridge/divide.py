# SPDX-License-Identifier: GPL-3.0-or-later
"""Divides the faces of a BMesh as a CutPlan says; whatever vertices, edges, faces and corners carry follows."""

import itertools

import bmesh
import numpy as np

from . import versions

#: Of faces or edges, before the window has its turn; a changed corner takes some 10 microseconds.
ELEMENTS_OF_A_STEP = 1000


def divide_in_steps(mesh, uv_map, plan, mark_seams=True):
    """Makes the BMesh the plan's mesh, in the plan's order, with the plan's UVs in the map where faces are changed, and its new seams
    marked, or not. The first step only looks. Where it raises, the BMesh is half done: rehearse on a copy."""
    mesh.verts.index_update()
    verts, faces, changed = list(mesh.verts), list(mesh.faces), plan.changed_faces()
    source_loops = _loops_by_corner(faces, changed, plan.source.face_offsets)
    yield
    verts += [None] * len(plan.vertex_sources)
    yield from _split_edges(mesh, plan, verts)
    for vertex in range(plan.input_vertex_count, len(verts)):
        if verts[vertex] is None:  # inside of a face
            verts[vertex] = mesh.verts.new()
    pieces = yield from _make_pieces(mesh, plan, verts, faces, changed)
    yield from _fill_corners(mesh, plan, verts, pieces, source_loops)
    _place_new_vertices(mesh, plan, verts)
    yield
    in_order = _remove_divided(mesh, faces, pieces)
    if mark_seams:
        _mark_seams(mesh, plan, verts)
    yield
    _write_uvs(plan, verts, pieces, mesh.loops.layers.uv[uv_map])
    yield
    _sort(verts, mesh.verts, plan.input_vertex_count)
    yield
    _sort(in_order, mesh.faces)


def _loops_by_corner(faces, changed, starts):
    """The loops of the changed faces by their corner's index in the whole mesh."""
    return {int(starts[face]) + k: loop for face, _, _ in changed for k, loop in enumerate(faces[face].loops)}


def _split_edges(mesh, plan, verts):
    """BMesh's own edge split: edge marks, and whatever else an edge carries, hold for both halves."""
    for number, split in enumerate(plan.edge_splits, 1):
        last, reached = verts[split.start], 0.0
        for vertex, fraction in zip(split.vertices, split.fractions, strict=True):
            edge = mesh.edges.get((last, verts[split.end]))
            _, verts[vertex] = bmesh.utils.edge_split(edge, last, (fraction - reached) / (1.0 - reached))
            last, reached = verts[vertex], fraction
        if number % ELEMENTS_OF_A_STEP == 0:
            yield


def _make_pieces(mesh, plan, verts, faces, changed):
    """By changed face: (piece, its face in the plan). A face that only gains corners, which split edges have given it, is its own."""
    pieces, corners = {}, plan.atlas.corner_vertices
    for number, (source, first, end) in enumerate(changed, 1):
        face, spans = faces[source], [plan.corners_of(k) for k in range(first, end)]
        if len(spans) > 1 or _gains_on_a_point(plan.atlas.positions[corners[slice(*spans[0])]], len(face.verts)):
            made = [_make_piece(mesh, [verts[vertex] for vertex in corners[a:b].tolist()], face) for a, b in spans]
        elif len(face.verts) == spans[0][1] - spans[0][0]:
            made = [face]
        else:
            raise ValueError(f"the cut mesh does not fit the mesh: face {source} gains a corner off its edges")
        pieces[source] = list(zip(made, range(first, end), strict=True))
        if number % ELEMENTS_OF_A_STEP == 0:
            yield
    return pieces


def _gains_on_a_point(cycle, count):
    """A face of so many corners comes to have those at the positions `cycle`: new ones lie on edges without length, which are not
    split."""
    return count < len(cycle) <= count + int((cycle == np.roll(cycle, 1, axis=0)).all(axis=1).sum())


def _make_piece(mesh, cycle, face):
    piece = mesh.faces.new(cycle, face)
    if face.hide:
        piece.hide_set(True)
    elif face.select:
        piece.select_set(True)
    return piece


class _Sampler:
    """Interpolates everything that corners and vertices carry, at exact weights: a scratch triangle takes over three source
    corners, and BMesh interpolates from it, at the place where the corner's vertex is put meanwhile."""

    SIZE = 1024.0  # BMesh takes what is nearer than 1e-5 to the triangle's border for a point of the border

    def __init__(self, mesh):
        self.triangle = mesh.faces.new([mesh.verts.new(co) for co in ((0, 0, 0), (self.SIZE, 0, 0), (0, self.SIZE, 0))])
        self.triangle.normal_update()

    def fill(self, loop, sources, weights, with_vertex):
        for k, source in enumerate(sources):
            # Looked up each time: from Blender 4.0 on, what copy_from() wrote to counts as removed in Python.
            if with_vertex:
                self.triangle.verts[k].copy_from(source.vert)
            self.triangle.loops[k].copy_from(source)
        loop.vert.co = (self.SIZE * weights[1], self.SIZE * weights[2], 0.0)
        versions.interpolate_corner(loop, self.triangle, with_vertex)

    def remove(self, mesh):
        verts = list(self.triangle.verts)
        mesh.faces.remove(self.triangle)
        for vert in verts:
            mesh.verts.remove(vert)


def _fill_corners(mesh, plan, verts, pieces, source_loops):
    """Gives the corners of changed faces, and the new vertices, what the corners carry of which they are the mean."""
    sampler, filled = _Sampler(mesh), set()
    for number, (piece, face) in enumerate(_each(pieces), 1):
        span = slice(*plan.corners_of(face))
        sources = [[source_loops[corner] for corner in three] for three in plan.corner_sources[span].tolist()]
        place = {loop.vert: k for k, loop in enumerate(piece.loops)}
        for vertex, three, means in zip(
            plan.atlas.corner_vertices[span].tolist(), sources, plan.corner_weights[span].tolist(), strict=True
        ):
            k = place[verts[vertex]]
            heaviest = three[means.index(max(means))]
            if piece.loops[k] != heaviest:
                piece.loops[k].copy_from(heaviest)
            if vertex >= plan.input_vertex_count:
                sampler.fill(piece.loops[k], three, means, vertex not in filled)
                filled.add(vertex)
                _set_uvs_exactly(mesh, piece.loops[k], three, means)
        if number % ELEMENTS_OF_A_STEP == 0:
            yield
    sampler.remove(mesh)


def _each(pieces):
    """(piece, its face in the plan) of all changed faces."""
    return itertools.chain.from_iterable(pieces.values())


def _set_uvs_exactly(mesh, loop, sources, weights):
    """What UV maps hold is compared for equality, to the last bit, by what looks for their seams."""
    for layer in mesh.loops.layers.uv.values():
        loop[layer].uv = _mean([source[layer].uv for source in sources], weights)


def _mean(points, weights):
    """As core.cuts does it: positions and the basis of shape keys stay equal."""
    u, v, w = weights
    return [a * u + b * v + c * w for a, b, c in zip(*points, strict=True)]


def _place_new_vertices(mesh, plan, verts):
    """Positions and shape keys, in double precision and rounded once."""
    first, shapes = plan.input_vertex_count, mesh.verts.layers.shape.values()
    positions = plan.atlas.positions[first:].tolist()
    for k, (sources, weights) in enumerate(zip(plan.vertex_sources.tolist(), plan.vertex_weights.tolist(), strict=True)):
        verts[first + k].co = positions[k]
        for layer in shapes:
            verts[first + k][layer] = _mean([verts[source][layer] for source in sources], weights)


def _remove_divided(mesh, faces, pieces):
    """The changed faces that others have replaced. Returns all that there are then, in the plan's order."""
    in_order, reached = [], 0
    for source, made in pieces.items():
        in_order += faces[reached:source] + [piece for piece, _ in made]
        reached = source + 1
        if made[0][0] != faces[source]:
            mesh.faces.remove(faces[source])
    return in_order + faces[reached:]


def _sort(elements, sequence, first=0):
    """Puts a sequence of the BMesh in the order of `elements`, which thereafter stand for others: Python holds on to places. Those
    before the first one have their index."""
    for index in range(first, len(elements)):
        elements[index].index = index
    sequence.sort()


def _mark_seams(mesh, plan, verts):
    for a, b in plan.new_seams.tolist():
        mesh.edges.get((verts[a], verts[b])).seam = True


def _write_uvs(plan, verts, pieces, layer):
    for piece, face in _each(pieces):
        span = slice(*plan.corners_of(face))
        loops, first = list(piece.loops), verts[plan.atlas.corner_vertices[span.start]]
        start = next(k for k, loop in enumerate(loops) if loop.vert == first)
        for loop, uv in zip(loops[start:] + loops[:start], plan.atlas.corner_uvs[span].tolist(), strict=True):
            loop[layer].uv = uv
