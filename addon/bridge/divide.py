# SPDX-License-Identifier: GPL-3.0-or-later
"""Divides the faces of a BMesh as a CutPlan says; whatever vertices, edges, faces and corners carry follows."""

import itertools

import bmesh

from . import versions


def divide(mesh, uv_map, plan, mark_seams=True):
    """Makes the BMesh the plan's mesh, in the plan's order, with the plan's UVs in the map and its new seams marked, or not. Where it
    raises, the BMesh is half done: rehearse on a copy."""
    verts, faces = list(mesh.verts), list(mesh.faces)
    source_loops = _loops_by_corner(faces, plan.changed_faces())
    verts += [None] * len(plan.vertex_sources)
    _split_edges(mesh, plan, verts)
    for vertex in range(plan.input_vertex_count, len(verts)):
        if verts[vertex] is None:  # inside of a face
            verts[vertex] = mesh.verts.new()
    pieces = _make_pieces(mesh, plan, verts, faces)
    _fill_corners(mesh, plan, verts, pieces, source_loops)
    _place_new_vertices(mesh, plan, verts)
    _remove_divided(mesh, faces, set(pieces))
    if mark_seams:
        _mark_seams(mesh, plan, verts)
    _sort(verts, mesh.verts)
    _sort(pieces, mesh.faces)
    _write_uvs(mesh, uv_map, plan)


def _loops_by_corner(faces, wanted):
    """The loops of the wanted faces by their corner's index in the whole mesh."""
    starts = [0, *itertools.accumulate(len(face.loops) for face in faces)]
    return {starts[face] + k: loop for face in wanted for k, loop in enumerate(faces[face].loops)}


def _split_edges(mesh, plan, verts):
    """BMesh's own edge split: edge marks, and whatever else an edge carries, hold for both halves."""
    for split in plan.edge_splits:
        last, reached = verts[split.start], 0.0
        for vertex, fraction in zip(split.vertices, split.fractions, strict=True):
            edge = mesh.edges.get((last, verts[split.end]))
            _, verts[vertex] = bmesh.utils.edge_split(edge, last, (fraction - reached) / (1.0 - reached))
            last, reached = verts[vertex], fraction


def _make_pieces(mesh, plan, verts, faces):
    """The faces of the plan: an input face itself, which split edges have given its new corners, or those that divide it."""
    pieces, corners = [], plan.atlas.corner_vertices.tolist()
    outputs = zip(plan.face_sources.tolist(), _spans(plan), strict=True)
    for source, group in itertools.groupby(outputs, key=lambda output: output[0]):
        face, spans = faces[source], [span for _, span in group]
        if len(spans) == 1:
            pieces.append(face)
            if len(face.verts) != spans[0][1] - spans[0][0]:
                raise ValueError(f"the cut mesh does not fit the mesh: face {source} gains a corner off its edges")
        else:
            pieces += [_make_piece(mesh, [verts[vertex] for vertex in corners[begin:end]], face) for begin, end in spans]
    return pieces


def _spans(plan):
    """(first corner, end) of each face of the plan."""
    return itertools.pairwise(plan.atlas.face_offsets.tolist())


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
    sampler, filled, changed = _Sampler(mesh), set(), plan.changed_faces()
    vertices, weights = plan.atlas.corner_vertices.tolist(), plan.corner_weights.tolist()
    for piece, face, (begin, end) in zip(pieces, plan.face_sources.tolist(), _spans(plan), strict=True):
        if face not in changed:
            continue
        sources = [[source_loops[corner] for corner in three] for three in plan.corner_sources[begin:end].tolist()]
        place = {loop.vert: k for k, loop in enumerate(piece.loops)}
        for vertex, three, means in zip(vertices[begin:end], sources, weights[begin:end], strict=True):
            k = place[verts[vertex]]
            heaviest = three[means.index(max(means))]
            if piece.loops[k] != heaviest:
                piece.loops[k].copy_from(heaviest)
            if vertex >= plan.input_vertex_count:
                sampler.fill(piece.loops[k], three, means, vertex not in filled)
                filled.add(vertex)
                _set_uvs_exactly(mesh, piece.loops[k], three, means)
    sampler.remove(mesh)


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
    """The input faces that others have replaced."""
    for face in faces:
        if face not in pieces:
            mesh.faces.remove(face)


def _sort(elements, sequence):
    """Puts a sequence of the BMesh in the order of `elements`, which thereafter stand for others: Python holds on to places."""
    for index, element in enumerate(elements):
        element.index = index
    sequence.sort()


def _mark_seams(mesh, plan, verts):
    for a, b in plan.new_seams.tolist():
        mesh.edges.get((verts[a], verts[b])).seam = True


def _write_uvs(mesh, uv_map, plan):
    layer = mesh.loops.layers.uv[uv_map]
    vertices, uvs = plan.atlas.corner_vertices.tolist(), plan.atlas.corner_uvs.tolist()
    for face, (begin, end) in zip(mesh.faces, _spans(plan), strict=True):
        loops = list(face.loops)
        if loops[0].vert.index != vertices[begin]:
            start = next(k for k, loop in enumerate(loops) if loop.vert.index == vertices[begin])
            loops = loops[start:] + loops[:start]
        for loop, uv in zip(loops, uvs[begin:end], strict=True):
            loop[layer].uv = uv
