"""addon/core/cuts.py: how a mesh becomes the engine's cut mesh, without Blender."""

import itertools
from types import SimpleNamespace

import numpy as np
import pytest
import shapes
from core.atlas import AtlasArrays
from core.cuts import plan_cut, same_faces
from cuts import Cutter


def as_blender_stores(arrays):
    positions, offsets, corners, uvs = arrays
    return AtlasArrays(positions.astype(np.float32), offsets.astype(np.int32), corners.astype(np.int32), uvs.astype(np.float32))


def crossed():
    """A grid of 4 x 3 quads cut along x = 1.25 up to its second row and along y = 0.5: T-joints, corners inside of faces."""
    arrays = shapes.join(shapes.grid(4, 3))
    cutter = Cutter(*arrays).cut(0, 1.25, faces=range(8)).cut(1, 0.5)
    return as_blender_stores(arrays), *cutter.result(shift=0.1)


def test_points_of_an_edge_become_splits_of_it_in_order():
    source, cut, uvs = crossed()
    plan = plan_cut(source, cut, uvs)
    splits = {(split.start, split.end): split for split in plan.edge_splits}
    assert {(1, 2), (6, 7), (11, 12)} | {(k, k + 5) for k in range(5)} == set(splits)
    assert splits[1, 2].fractions == pytest.approx([0.25])
    inside = len(cut.new_vertex_corners) - sum(len(split.vertices) for split in plan.edge_splits)
    assert inside == 1
    for split in plan.edge_splits:
        along = plan.atlas.positions[[split.start, *split.vertices, split.end]]
        lengths = np.linalg.norm(np.diff(along, axis=0), axis=1)
        assert lengths.sum() == pytest.approx(np.linalg.norm(along[-1] - along[0]))


def test_several_points_of_one_edge_are_sorted_from_its_smaller_end():
    arrays = shapes.join(shapes.grid(2, 2))
    cut, uvs = Cutter(*arrays).cut(0, 0.75, faces=[0, 1]).cut(0, 0.25, faces=[0, 1]).cut(0, 0.5, faces=[0, 1]).result()
    plan = plan_cut(as_blender_stores(arrays), cut, uvs)
    assert [(s.start, s.end, s.fractions) for s in plan.edge_splits] == [
        (0, 1, [0.25, 0.5, 0.75]),
        (3, 4, [0.25, 0.5, 0.75]),
    ]
    assert plan.atlas.positions[plan.edge_splits[0].vertices, 0].tolist() == [0.25, 0.5, 0.75]
    cut.corner_weights[cut.corner_vertices >= len(arrays[0])] = [0.5, 0.5, 0.0]
    with pytest.raises(ValueError, match="coincide"):
        plan_cut(as_blender_stores(arrays), cut, uvs)


def test_an_edge_without_length_is_not_split():
    """Its sides are two edges to the engine, which may divide both at the same place."""
    arrays = shapes.join(shapes.grid(2, 2))
    cut, uvs = Cutter(*arrays).cut(0, 0.75, faces=[0, 1]).cut(0, 0.25, faces=[0, 1]).result()
    source = as_blender_stores(arrays)
    source.positions[1] = source.positions[0]
    on_edge = (source.corner_vertices[cut.corner_sources[:, :2]] < 2).all(axis=1) & (cut.corner_vertices >= len(arrays[0]))
    cut.corner_weights[on_edge] = [0.5, 0.5, 0.0]
    plan = plan_cut(source, cut, uvs)
    assert [(s.start, s.end) for s in plan.edge_splits] == [(3, 4)]


def test_corners_are_means_of_corners_of_their_own_face():
    source, cut, uvs = crossed()
    plan = plan_cut(source, cut, uvs)
    faces = np.repeat(cut.face_sources, np.diff(cut.face_offsets))
    begin, end = source.face_offsets[faces], source.face_offsets[faces + 1]
    assert np.all((plan.corner_sources >= begin[:, None]) & (plan.corner_sources < end[:, None]))
    means = np.einsum("ck,ckd->cd", plan.corner_weights, source.positions[source.corner_vertices[plan.corner_sources]])
    assert means == pytest.approx(plan.atlas.positions[cut.corner_vertices], abs=1e-6)
    old = plan.atlas.corner_vertices < plan.input_vertex_count
    assert np.all(plan.corner_weights[old] == [1.0, 0.0, 0.0])


def test_two_faces_read_a_shared_point_to_the_same_bits():
    source, cut, uvs = crossed()
    plan = plan_cut(source, cut, uvs)
    values = np.random.default_rng(2).random((len(source.positions), 2)).astype(np.float32)[source.corner_vertices]
    terms = values[plan.corner_sources] * plan.corner_weights[:, :, None]
    mean = terms[:, 0] + terms[:, 1] + terms[:, 2]
    for vertex in range(plan.input_vertex_count, len(plan.atlas.positions)):
        assert len({mean[corner].tobytes() for corner in np.flatnonzero(cut.corner_vertices == vertex)}) == 1


def test_new_vertices_between_doubled_vertices_are_doubled():
    positions, offsets, corners, uvs = shapes.join(shapes.grid(2, 1))
    cut, cut_uvs = Cutter(positions, offsets, corners, uvs).cut(1, 0.5).result()
    doubled = np.concatenate([positions, positions[[1, 4]]])
    corners = corners.copy()
    corners[4:][corners[4:] == 1] = 6
    corners[4:][corners[4:] == 4] = 7
    new = cut.corner_vertices >= 6
    cut.corner_vertices[new] += 2
    second = np.repeat(cut.face_sources, np.diff(cut.face_offsets)) == 1
    cut.corner_vertices[second & (cut.corner_vertices == 1)] = 6
    cut.corner_vertices[second & (cut.corner_vertices == 4)] = 7
    cut.new_seams = cut.new_seams + 2
    plan = plan_cut(as_blender_stores((doubled, offsets, corners, uvs)), cut, cut_uvs)
    means = np.einsum("ck,ckd->cd", plan.corner_weights, doubled[corners[plan.corner_sources]])
    assert means == pytest.approx(plan.atlas.positions[plan.atlas.corner_vertices], abs=1e-6)
    faces = np.repeat(cut.face_sources, np.diff(cut.face_offsets))
    sides = [set(plan.atlas.corner_vertices[faces == face].tolist()) for face in (0, 1)]
    assert sides[0] & sides[1] == set(), "the two quads stay apart"
    assert len(plan.edge_splits) == 4


def test_a_mesh_whose_faces_times_vertices_exceed_32_bits():
    positions, *rest = shapes.join(shapes.grid(100, 100))
    arrays = [np.concatenate([positions, np.zeros((300_000, 3))]), *rest]
    cut, uvs = Cutter(*arrays).cut(1, 99.5, faces=[9998, 9999]).result()
    plan = plan_cut(as_blender_stores(arrays), cut, uvs)
    assert [split.fractions for split in plan.edge_splits] == [[0.5]] * 3


def test_a_seam_beside_doubled_vertices_is_each_edge_at_its_place():
    positions, offsets, corners, uvs = shapes.join(shapes.grid(2, 1))
    doubled, apart = np.concatenate([positions, positions[[1, 4]]]), {1: 6, 4: 7}
    corners = np.array([apart.get(vertex, vertex) if k >= 4 else vertex for k, vertex in enumerate(corners.tolist())])
    cut = SimpleNamespace(
        face_offsets=offsets.astype(np.int32),
        corner_vertices=corners.astype(np.int32),
        face_sources=np.array([0, 1], dtype=np.int32),
        corner_sources=np.repeat(np.arange(8, dtype=np.int32)[:, None], 3, axis=1),
        corner_weights=np.tile([1.0, 0.0, 0.0], (8, 1)),
        new_vertex_corners=np.zeros((0, 3), dtype=np.int32),
        new_vertex_weights=np.zeros((0, 3)),
        new_seams=np.array([[1, 4], [1, 2]], dtype=np.int32),  # the latter is 6 to 2 in its only face
    )
    plan = plan_cut(as_blender_stores((doubled, offsets, corners, uvs)), cut, uvs.astype(np.float32))
    assert plan.new_seams.tolist() == [[1, 4], [2, 6], [6, 7]]


def test_directions_have_length_one():
    source, cut, uvs = crossed()
    plan = plan_cut(source, cut, uvs)
    normals = np.random.default_rng(1).normal(size=(len(source.corner_vertices), 3)).astype(np.float32)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    directions = plan.directions(normals)
    assert np.linalg.norm(directions, axis=1) == pytest.approx(1.0, abs=1e-6)
    old = cut.corner_vertices < plan.input_vertex_count
    assert directions[old] == pytest.approx(normals[plan.corner_sources[old, 0]], abs=1e-6)
    opposite = np.where(np.arange(len(normals)) % 2, 1.0, -1.0)[:, None] * [0.0, 0.0, 1.0]
    assert np.linalg.norm(plan.directions(opposite), axis=1) == pytest.approx(1.0)


def test_faces_that_start_elsewhere_are_the_same():
    source, cut, uvs = crossed()
    plan = plan_cut(source, cut, uvs)
    turned = np.concatenate([np.roll(np.arange(b, e), b % 3) for b, e in itertools.pairwise(cut.face_offsets)])
    mine = AtlasArrays(plan.atlas.positions, cut.face_offsets, cut.corner_vertices[turned], uvs[turned])
    corners = same_faces(mine, plan.atlas)
    assert np.array_equal(corners, turned)
    assert np.array_equal(plan.atlas.corner_uvs[corners], mine.corner_uvs)
    mine.corner_vertices[[0, 1]] = mine.corner_vertices[[1, 0]]
    assert same_faces(mine, plan.atlas) is None


@pytest.mark.parametrize(
    ("field", "change", "word"),
    [
        ("face_offsets", lambda a: a[:-1], "faces"),
        ("face_sources", lambda a: np.where(a == 0, 1, a), "face is lost"),
        ("face_sources", lambda a: a[::-1], "order"),
        ("corner_vertices", lambda a: a + 100, "vertices"),
        ("corner_vertices", lambda a: np.concatenate([a[:1], a[:1], a[2:]]), "twice"),
        ("new_seams", lambda a: a - 10**6, "vertices"),
        ("new_seams", lambda a: a * 0 + [0, 19], "new seam"),
        ("new_vertex_corners", lambda a: a[:-1], "vertices"),
        ("corner_sources", lambda a: a + 10**6, "outside"),
        ("corner_sources", lambda a: (a + 4) % 48, "outside"),
        ("corner_sources", lambda a: np.concatenate([a[1:4], a[:1], a[4:]]), "not where its vertex is"),
        ("corner_sources", lambda a: a[:-1], "sources"),
        ("corner_weights", lambda a: a * 0 + [1.0, 0.0, 0.0], "old one"),
        ("corner_weights", lambda a: a * 0.5, "weights"),
        ("corner_weights", lambda a: a * [-1.0, 1.0, 1.0], "weights"),
    ],
)
def test_what_does_not_fit_is_refused(field, change, word):
    source, cut, uvs = crossed()
    setattr(cut, field, change(getattr(cut, field)))
    with pytest.raises(ValueError, match=word):
        plan_cut(source, cut, uvs)
