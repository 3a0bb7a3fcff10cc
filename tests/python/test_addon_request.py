"""addon/core: who takes part, several meshes as one, and the engine's result dealt out again, without Blender."""

import atlas_refine
import numpy as np
import pytest
import shapes
from core.atlas import AtlasArrays, stored_uvs
from core.canvas import Canvas
from core.cuts import plan_cut
from core.joined import Part
from core.options import Options, Texture
from core.request import NothingToDoError, prepare

FREE = Options(aspect="FREE", gap="AUTO")


def make_part(arrays=None, name="Part", **flags):
    positions, offsets, corners, uvs = shapes.loose() if arrays is None else arrays
    atlas = AtlasArrays(positions.astype(np.float32), offsets.astype(np.int32), corners.astype(np.int32), uvs.astype(np.float32))
    faces = len(offsets) - 1
    given = {
        "triangles": np.zeros((0, 3), dtype=np.int32),
        "hidden": np.zeros(faces, dtype=bool),
        "selected": np.ones(faces, dtype=bool),
        "pinned": np.zeros(faces, dtype=bool),
        "materials": np.zeros(faces, dtype=int),
    }
    return Part(name, "UVMap", atlas, **{**given, **flags})


def faces(part, begin, end):
    flags = np.zeros(len(part.taken), dtype=bool)
    flags[begin:end] = True
    return flags


#: Of shapes.loose(): 12 x 4, 6 x 6 and 9 x 2 quads.
FIRST, SECOND, THIRD = (0, 48), (48, 84), (84, 102)


def run(request):
    return atlas_refine.refine(*request.joined.arrays(), **request.arguments)


def test_all_of_one_mesh_is_given_as_it_is():
    part = make_part()
    request = prepare(atlas_refine, [part], FREE)
    for given, own in zip(request.joined.arrays(), part.atlas.as_tuple(), strict=True):
        assert np.array_equal(given, own)
    assert "locked" not in request.arguments
    assert "groups" not in request.arguments


def test_hidden_charts_are_left_out_and_keep_their_uvs():
    part = make_part()
    part.hidden = faces(part, *SECOND)
    request = prepare(atlas_refine, [part], FREE)
    assert request.face_count == 102 - 36
    uvs = request.joined.uvs_of(0, stored_uvs(run(request).corner_uvs))
    assert np.array_equal(uvs[4 * 48 : 4 * 84], part.atlas.corner_uvs[4 * 48 : 4 * 84])
    assert not np.array_equal(uvs[: 4 * 48], part.atlas.corner_uvs[: 4 * 48])


def test_one_pinned_one_hidden_and_one_unselected_face_lock_the_whole_chart():
    for flag, value in (("pinned", True), ("hidden", True)):
        part = make_part()
        getattr(part, flag)[50] = value
        request = prepare(atlas_refine, [part], FREE)
        assert np.array_equal(np.flatnonzero(request.arguments["locked"]), np.arange(*SECOND))
    part = make_part()
    part.selected = faces(part, 0, 1) | faces(part, 84, 85)
    request = prepare(atlas_refine, [part], FREE)
    assert np.array_equal(np.flatnonzero(request.arguments["locked"]), np.arange(*SECOND))


def test_nothing_to_do_says_why():
    for flag, value, words in (
        ("selected", False, "no chart is selected"),
        ("hidden", True, "hidden"),
        ("pinned", True, "pinned"),
    ):
        part = make_part()
        getattr(part, flag)[:] = value
        with pytest.raises(NothingToDoError, match=words):
            prepare(atlas_refine, [part], FREE)


def test_two_meshes_at_one_place_are_one_atlas_and_not_sewn_together():
    parts = [make_part(name="A"), make_part(name="B")]
    request = prepare(atlas_refine, parts, Options(gap="AUTO", stacks="SEPARATE"))
    result = run(request)
    assert result.after.chart_count == 6
    assert result.after.pe_fixed_aspect >= 0.8
    uvs = stored_uvs(result.corner_uvs)
    mine = [request.joined.uvs_of(k, uvs) for k in range(2)]
    assert mine[0].shape == parts[0].atlas.corner_uvs.shape
    assert not np.array_equal(mine[0], mine[1])


def test_larger_objects_get_more_of_one_atlas():
    parts = [make_part(shapes.tight(), name="Small"), make_part(shapes.tight(), name="Large", scale=2.0)]
    request = prepare(atlas_refine, parts, Options(gap="AUTO", density="EQUAL", stacks="SEPARATE", pe_bound=0.6))
    uvs = stored_uvs(run(request).corner_uvs)
    small, large = (np.ptp(request.joined.uvs_of(k, uvs), axis=0).prod() for k in range(2))
    assert large / small == pytest.approx(4.0, rel=0.3)


def test_charts_of_other_materials_or_where_one_density_is_asked_for_of_other_scales_are_no_stack():
    def groups(**options):
        parts = [make_part(name="A", materials=np.repeat([0, 1], [48, 54])), make_part(name="B", scale=2.0)]
        return prepare(atlas_refine, parts, Options(gap="AUTO", **options)).arguments.get("stack_groups")

    first, second = np.split(groups(density="KEEP"), 2)
    assert np.array_equal(np.unique(first), [0, 1])
    assert np.array_equal(second, np.full(102, first[0]))
    assert len(np.unique(groups(density="EQUAL"))) == 3
    assert groups(stacks="SEPARATE") is None
    assert "stack_groups" not in prepare(atlas_refine, [make_part()], Options(gap="AUTO")).arguments


def test_groups_by_material_across_meshes():
    parts = [make_part(name="A"), make_part(name="B")]
    parts[0].materials[48:] = 1
    parts[1].materials[:] = 1
    request = prepare(atlas_refine, parts, Options(gap="AUTO", atlases="MATERIAL"), [Canvas(name="Skin"), Canvas(name="Cloth")])
    assert request.arguments["group_names"] == ["Skin", "Cloth"]
    assert np.array_equal(np.bincount(request.arguments["groups"]), [48, 54 + 102])


def test_tiles_each_by_itself_or_only_the_active_one():
    tiles = [shapes.grid(4, 4, scale=0.1, bend=0.7), shapes.grid(6, 3, scale=0.1, origin=(1.1, 0.1), bend=1.2)]
    parts = [make_part(shapes.join(*tiles))]
    request = prepare(atlas_refine, parts, Options(gap="AUTO", tiles="EACH"))
    assert request.arguments["group_names"] == ["1001", "1002"]
    assert np.array_equal(request.arguments["group_origins"], [[0, 0], [1, 0]])
    uvs = run(request).corner_uvs
    assert uvs[:64].max() <= 1.0
    assert uvs[64:, 0].min() >= 1.0
    parts = [make_part(shapes.join(*tiles))]
    request = prepare(atlas_refine, parts, Options(gap="AUTO", tiles="ACTIVE"), [Canvas(tile=(1, 0))])
    assert request.face_count == 18
    assert run(request).corner_uvs[:, 0].min() >= 1.0
    with pytest.raises(NothingToDoError, match="active tile"):
        prepare(atlas_refine, [make_part(shapes.join(*tiles))], Options(tiles="ACTIVE"), [Canvas(tile=(5, 0))])


def test_materials_have_boxes_margins_and_tiles_of_their_own_images():
    tiles = [shapes.grid(4, 4, scale=0.1, bend=0.7), shapes.grid(6, 3, scale=0.1, origin=(1.1, 0.1), bend=1.2)]
    part = make_part(shapes.join(*tiles, shapes.grid(5, 5, scale=0.1, origin=(1.2, 0.1))))
    part.materials[34:] = 1
    canvases = [
        Canvas(Texture("Skin", 1024, 512, True, 1001, (1001,)), name="Skin"),
        Canvas(Texture("Cloth", 256, 256), name="Cloth"),
    ]
    request = prepare(atlas_refine, [part], Options(atlases="MATERIAL"), canvases)
    arguments = request.arguments
    assert arguments["group_names"] == ["Skin 1001", "Skin 1002", "Cloth"]
    assert np.array_equal(arguments["group_origins"], [[0, 0], [1, 0], [0, 0]])
    assert arguments["group_aspects"] == [2.0, 2.0, 1.0]
    assert arguments["group_gaps"] == [4 / 1024, 4 / 1024, 4 / 256]
    assert request.notes == ("Skin has no tile 1002, in which 18 faces lie and are packed: add it, or move them",)
    request = prepare(atlas_refine, [part], Options(atlases="MATERIAL", aspect="SQUARE"), canvases)
    assert "group_aspects" not in request.arguments
    assert "group_gaps" not in request.arguments


def test_a_group_that_is_locked_as_a_whole_is_left_out():
    part = make_part()
    part.materials[48:] = 1
    part.pinned = faces(part, *FIRST)
    request = prepare(atlas_refine, [part], Options(gap="AUTO", atlases="MATERIAL"), [Canvas(name="Skin"), Canvas(name="Cloth")])
    assert request.face_count == 54
    assert "locked" in request.arguments


def test_a_cut_of_several_meshes_is_dealt_out_to_each():
    parts = [make_part(name="A"), make_part(name="B")]
    options = Options(aspect="FREE", gap="AUTO", seams="RECTANGLES", cut="SPLIT", density="EQUAL", stacks="SEPARATE")
    request = prepare(atlas_refine, parts, options)
    result = run(request)
    assert result.cut is not None
    plans = [
        plan_cut(part.atlas, *request.joined.cut_of(k, result.cut, stored_uvs(result.corner_uvs))) for k, part in enumerate(parts)
    ]
    assert sum(len(plan.face_sources) for plan in plans) == len(result.cut.face_sources)
    assert all(len(plan.new_seams) for plan in plans)


def test_a_mesh_without_faces_has_its_part_of_a_cut():
    empty = np.zeros((3, 3)), np.zeros(1, int), np.zeros(0, int), np.zeros((0, 2))
    for at in range(3):
        parts = [make_part(name="First"), make_part(name="Second")]
        parts.insert(at, make_part(empty, name="Empty"))
        request = prepare(atlas_refine, parts, Options(aspect="FREE", gap="AUTO", seams="RECTANGLES", cut="SPLIT", candidates=20))
        result = run(request)
        uvs = stored_uvs(result.corner_uvs)
        plans = [plan_cut(part.atlas, *request.joined.cut_of(k, result.cut, uvs)) for k, part in enumerate(parts)]
        assert sum(len(plan.face_sources) for plan in plans) == len(result.cut.face_sources)
        assert len(plans[at].face_sources) == 0
        assert len(plans[at].atlas.positions) == 3


def test_protected_faces_and_edges_go_to_the_engine():
    parts = [make_part(name="A"), make_part(name="B")]
    parts[1].keep_shape = faces(parts[1], *THIRD)
    parts[0].importance = np.full(102, 3.0)
    parts[1].no_seam = np.array([[0, 1]])
    request = prepare(atlas_refine, parts, Options(aspect="FREE", gap="AUTO", stacks="SEPARATE"))
    assert np.array_equal(np.flatnonzero(request.arguments["keep_shape"]), 102 + np.arange(*THIRD))
    assert np.array_equal(np.unique(request.arguments["importance"]), [1.0, 3.0])
    first = len(parts[0].atlas.positions)
    assert request.arguments["no_seam"].tolist() == [[first, first + 1]]
    assert run(request).charts[5].fate == "kept"


def test_with_locked_charts_a_free_box_is_the_texture():
    part = make_part()
    part.pinned[50] = True
    arguments = prepare(atlas_refine, [part], FREE).arguments
    assert (arguments["box_aspect"], arguments["in_texture"]) == (1.0, True)


def test_what_only_looks_asks_for_nothing_that_may_move():
    part = make_part(pinned=np.ones(102, dtype=bool))
    with pytest.raises(NothingToDoError, match="pinned"):
        prepare(atlas_refine, [part], FREE)
    assert prepare(atlas_refine, [part], FREE, moves=False).face_count == 102
    part.atlas.corner_uvs[::4, 0] = np.nan  # one of each face
    with pytest.raises(NothingToDoError, match="no face has UVs: unwrap the mesh"):
        prepare(atlas_refine, [part], FREE, moves=False)


@pytest.mark.parametrize("tiles", ["ONE", "EACH"])
def test_faces_without_numbers_are_not_measured(tiles):
    positions, offsets, corners, uvs = (array.copy() for array in shapes.loose())
    uvs[:2] = np.nan, np.inf
    positions[corners[8]] = np.inf
    part = make_part((positions, offsets, corners, uvs))
    boxes = list(prepare(atlas_refine, [part], Options(tiles=tiles), moves=False).boxes())
    around = (corners.reshape(-1, 4) == corners[8]).any(axis=1)
    assert sum(len(own) - 1 for _, (_, own, _, _), _, _ in boxes) == 102 - 1 - around.sum()
    for _, arrays, own, aspect in (box for box in boxes if len(box[1][1]) > 1):
        atlas_refine.measure(*arrays, box_aspect=aspect, triangles=own)


def test_a_vertex_without_place_keeps_no_other_object_from_its_own():
    parts = [make_part(tuple(array.copy() for array in shapes.loose())) for _ in range(2)]
    parts[0].atlas.positions[0, 0], parts[0].atlas.positions[1, 0] = np.nan, np.inf
    positions = prepare(atlas_refine, parts, FREE).joined.arrays()[0]
    first, second = positions[: len(positions) // 2], positions[len(positions) // 2 :]
    assert np.isfinite(second).all()
    assert second[:, 0].min() > np.nanmax(first[2:, 0])


def test_boxes_have_the_triangles_of_their_faces():
    positions, offsets, corners, uvs = shapes.loose()
    triangles = np.concatenate([offsets[:-1, None] + [0, 1, 3], offsets[:-1, None] + [1, 2, 3]])
    part = make_part((positions, offsets, corners, uvs % 1 + np.repeat([0, 3], [4 * 48, 4 * 54])[:, None]), triangles=triangles)
    boxes = list(prepare(atlas_refine, [part], Options(tiles="EACH"), moves=False).boxes())
    assert len(boxes) > 1
    for _, (_, own_offsets, _, _), own, _ in boxes:
        assert np.array_equal(own, np.concatenate([own_offsets[:-1, None] + [0, 1, 3], own_offsets[:-1, None] + [1, 2, 3]]))
