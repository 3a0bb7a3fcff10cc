"""addon/core: what the add-on does without Blender."""

from types import SimpleNamespace

import atlas_refine
import numpy as np
import pytest
import shapes
from core.atlas import AtlasArrays, stored_uvs
from core.manifold import faces_at_fault
from core.notes import joined, notes, objects_of_charts
from core.options import Options, Texture
from core.summary import Asked, figures, growth, headline, in_parts, percent, trade_off_lines, what_was_done
from core.words import lines_of, named, plain, titled


def test_options_are_the_engines_keywords():
    options = Options(pe_bound=0.9, aspect="FREE", gap="AUTO", max_distortion=1.5)
    result = atlas_refine.refine(*shapes.tight(), **options.engine_arguments())
    assert result.intervention == "unchanged"


def test_a_float32_bound_becomes_the_decimal_that_was_typed():
    assert Options(pe_bound=float(np.float32(0.85))).engine_arguments()["pe_bound"] == 0.85


def test_the_gap_in_pixels_is_a_fraction_of_the_texture():
    arguments = Options(gap="PIXELS", gap_px=4, texture_size=1024).engine_arguments()
    assert (arguments["gap"], arguments["gap_unit"]) == (4 / 1024, "long_side")
    assert "gap" not in Options(gap="AUTO", gap_px=4).engine_arguments()


def test_the_gap_goes_by_the_textures_own_size():
    options, texture = Options(gap_px=4), Texture("Skin", 512, 1024)
    assert options.engine_arguments(texture)["gap"] == 4 / 1024
    assert options.engine_arguments()["gap"] == 4 / 2048
    assert Options(gap_px=4, aspect="SQUARE").engine_arguments(texture)["gap"] == 4 / 2048


def test_the_box_is_the_textures_unless_said_otherwise():
    wide = Texture("Skin", 1024, 512)
    assert Options().box_arguments(wide) == {"box_aspect": 2.0, "in_texture": True}
    assert Options().box_arguments() == {"box_aspect": 1.0, "in_texture": True}
    assert Options(aspect="SQUARE").box_arguments(wide) == {"box_aspect": 1.0, "in_texture": True}
    assert Options(aspect="FREE").box_arguments(wide) == {"box_aspect": 0.0, "in_texture": False}


def test_tiles_follow_the_texture_unless_said_otherwise():
    tiled = Texture("Skin.<UDIM>", 1024, 1024, is_tiled=True)
    assert [Options().tiles_of(texture) for texture in (None, Texture("Skin", 8, 8), tiled)] == ["ONE", "ONE", "EACH"]
    assert Options(tiles="ACTIVE").tiles_of(None) == "ACTIVE"


def test_the_density():
    assert Options().engine_arguments()["density"] == "keep"
    assert Options().engine_arguments()["stored"] == "float32"


def test_every_limit_but_0_reaches_the_engine():
    assert "max_distortion" not in Options().engine_arguments()
    arguments = Options(max_distortion=-1.0).engine_arguments()
    with pytest.raises(atlas_refine.AtlasRefineError, match="the largest distortion must be"):
        atlas_refine.refine(*shapes.loose(), **arguments)
    assert "max_stretch" not in Options().engine_arguments()
    assert Options(max_stretch=1.25).engine_arguments()["max_stretch"] == 1.25


def test_sigma_goes_with_rectangles_only():
    arguments = Options(seams="RECTANGLES", sigma=float(np.float32(0.004))).engine_arguments()
    assert (arguments["seams"], arguments["sigma"]) == ("rectangles", 0.004)
    arguments = Options(sigma=7.0).engine_arguments()
    assert (arguments["seams"], "sigma" in arguments) == ("none", False)


def test_the_limits_of_needed_seams_are_the_engines():
    arguments = Options(seams="NEEDED").engine_arguments()
    assert (arguments["seams"], arguments["effort"], arguments["seam_cost"]) == ("needed", "normal", 0.1)
    assert "max_boundary_growth" not in arguments
    limited = Options(seams="NEEDED", limit_new_seams=True, most_new_seams=float(np.float32(12.3)), effort="BEST")
    assert limited.engine_arguments()["max_boundary_growth"] == 0.123
    assert limited.engine_arguments()["effort"] == "best"


def test_what_belongs_to_needed_seams_reaches_the_engine_with_them_only():
    asked = {"limit_new_seams": True, "most_new_seams": 0.0, "seam_cost": -1.0, "effort": "FAST"}
    for seams in ("NONE", "RECTANGLES"):
        assert Options(seams=seams, **asked).engine_arguments() == Options(seams=seams).engine_arguments()


def test_a_trade_off_is_asked_for_without_limits():
    asked = Options(seams="NEEDED", max_distortion=1.01, max_stretch=1.2, limit_new_seams=True, effort="FAST", pe_bound=0.7)
    assert asked.for_trade_off() == Options(seams="NEEDED", effort="FAST", pe_bound=0.7)


def test_uvs_that_float32_cannot_hold_are_refused():
    assert stored_uvs(np.array([[0.5, 0.25]])).dtype == np.float32
    with pytest.raises(ValueError, match="single precision"):
        stored_uvs(np.array([[0.1, 0.25]]))


def test_arrays_are_compared_bit_for_bit():
    positions, offsets, corners, uvs = shapes.tight()
    atlas = AtlasArrays(positions, offsets, corners, uvs)
    assert atlas.same_as(AtlasArrays(positions.copy(), offsets.copy(), corners.copy(), uvs.copy()))
    assert not atlas.same_as(AtlasArrays(positions, offsets, corners, np.nextafter(uvs, 9.0)))
    assert not atlas.same_as(AtlasArrays(positions[:-1], offsets, corners, uvs))


def test_lines_fit_a_narrow_sidebar():
    text = "Distortion low (worst stretch 1.3)"
    assert lines_of(text, 196) == ["Distortion low (worst", "stretch 1.3)"]
    assert lines_of(text, 400) == [text]
    assert lines_of("short", 10) == ["short"]
    assert in_parts(text) == ["Distortion low", "worst stretch 1.3"]
    assert in_parts("No chart takes part") == ["No chart takes part"]


def test_the_words_of_a_result():
    result = atlas_refine.refine(*shapes.loose())
    assert headline(result) == "Texture use 17 % -> 80 %, distortion low (worst stretch 1.5), no new seams"
    assert headline(result, is_free=True).startswith("Box use 17 % -> 80 %")
    rows = {name: (before, after) for name, before, after in figures(result, face_count=102)}
    assert list(rows) == ["PE", "E_d", "Stretch", "Gap", "Charts", "Seams", "BL", "Faces"]
    assert rows["Faces"] == ("102", "102")
    one_chart = atlas_refine.refine(*shapes.tight())
    assert figures(one_chart, face_count=64)[3] == ("Gap", "-", "-")


def arc():
    """One sheet that bends far in its UVs: whole at 0.8 of a square its distortion is 1.116."""
    return shapes.join(shapes.grid(24, 3, bend=5.0))


def refined_arc(**options):
    options = Options(seams="NEEDED", stacks="SEPARATE", **options)
    return atlas_refine.refine(*arc(), **options.engine_arguments())


def test_the_words_of_needed_seams():
    result = refined_arc(max_distortion=1.03, limit_new_seams=True, most_new_seams=25.0)
    edges = f"{result.added_seams} new seam edges"
    told = f"{result.cuts.cuts} cuts, {edges}, +{100 * result.boundary_growth:.0f} % of the charts' borders"
    assert headline(result).endswith(told)
    assert (result.cuts.cuts, result.after.distortion <= 1.03, what_was_done(result)) == (2, True, "Charts cut, moved and bent")
    assert growth(0.004) == "+0.4 %"


def test_the_lines_of_a_trade_off():
    options = Options(seams="NEEDED", effort="FAST").for_trade_off()
    points = atlas_refine.refine(*arc(), trade_off=True, **options.engine_arguments()).cuts.trade_off
    lines = list(trade_off_lines(points))
    assert lines[0][0::2] == ("none", "0 cuts")
    assert lines[1] == (growth(points[1].boundary_growth), f"{points[1].distortion:.3f}", "1 cut")


def test_no_two_lines_of_a_trade_off_read_the_same():
    found = [(0, 0.0, 1.0071), (1, 0.0121, 1.0062), (2, 0.0190, 1.00523), (3, 0.0209, 1.00515), (5, 0.0307, 1.00512)]
    points = [SimpleNamespace(cuts=cuts, boundary_growth=growth, distortion=distortion) for cuts, growth, distortion in found]
    seams, distortions, _ = zip(*trade_off_lines(points), strict=True)
    assert seams == ("none", "+1.2 %", "+1.9 %", "+2.1 %", "+3.1 %")
    assert distortions == ("1.00710", "1.00620", "1.00523", "1.00515", "1.00512")
    assert [line[:2] for line in trade_off_lines(points[:2])] == [("none", "1.007"), ("+1 %", "1.006")]


def test_a_limit_that_is_missed_is_told():
    asked = {"max_distortion": 1.001, "limit_new_seams": True, "most_new_seams": 12.0, "effort": "FAST"}
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        refined_arc(**asked)
    assert "no atlas within a distortion of 1.001 and new seams of 12 % of the charts' borders was found" in plain(
        str(caught.value)
    )
    best = refined_arc(best_effort=True, **asked)
    assert what_was_done(best, Asked(max_stretch=1.001)) == "Charts cut, moved and bent; the stretch stays above its limit"
    assert what_was_done(best, Asked(max_distortion=1.001)) == "Charts cut, moved and bent; the distortion stays above its limit"
    assert 0 < best.boundary_growth <= 0.12


def test_a_bound_that_is_held_reads_so_and_one_that_is_missed_does_not():
    asked = 0.8
    shown = {0.8: "80 %", 0.7999999: "79.9 %", 0.796: "79.6 %", 0.479: "48 %", 0.809: "81 %", 0.0: "0 %"}
    assert {value: percent(value, asked) for value in shown} == shown
    assert [percent(value, 0.8044) for value in (0.8044, 0.80441, 0.8043)] == ["80.44 %", "80.44 %", "80 %"]
    assert percent(0.618) == "62 %"


def test_a_map_that_stays_reads_as_unchanged():
    """Its use used to be rounded before, and cut off after: 62 % -> 61 %."""
    result = atlas_refine.refine(*shapes.loose(), pe_bound=0.618)
    again = result_of(result, "unchanged", before=result.after)
    assert headline(again, asked=Asked(0.618)).startswith(f"Texture use {percent(again.after.pe_fixed_aspect)}, unchanged, dist")


def result_of(result, intervention, **instead):
    """The engine's, with others of its figures."""
    held = {name: getattr(result, name) for name in ("before", "after", "added_seams", "boundary_growth", "cuts", "groups")}
    return SimpleNamespace(**{**held, "intervention": intervention, "bound_met": True, "ended": "not_run", **instead})


def refined_groups(groups_of_names, **options):
    """A square sheet, and an arc, in groups of their own."""
    arrays = shapes.join(shapes.grid(24, 3, bend=5.0), *(shapes.grid(4, 4) for _ in groups_of_names[1:]))
    groups = np.repeat(np.arange(len(groups_of_names)), [72] + [16] * (len(groups_of_names) - 1))
    asked = {"groups": groups, "group_names": groups_of_names, "stacks": "separate", "gap": 0.002, **options}
    return atlas_refine.refine(*arrays, name="Crates", box_aspect=1.0, in_texture=True, gap_unit="long_side", **asked)


def test_a_tile_that_keeps_its_uvs_is_told_beside_those_that_hold():
    result = refined_groups(["1012", "1001", "1002"], max_distortion=1.01)
    told = headline(result, asked=Asked(0.8, boxes="tile"))
    assert told.startswith("2 of 3 tiles reached 80 %; 1012 keeps its UVs (no atlas within a distortion of 1.01 was found")
    assert told.endswith("; distortion low (worst stretch 1.0), no new seams")
    (note,) = (note for note in notes(result) if "keeps" in note)
    assert note.startswith("1012: keeps its UVs: no atlas within")


def test_what_best_effort_missed_is_told():
    missing = refined_groups(["A", "B"], pe_bound=0.97, max_distortion=1.2, best_effort=True)
    asked = Asked(0.97, 1.2, boxes="material")
    (arc,) = (group for group in missing.groups if not group.bound_met)
    share = percent(arc.after.pe_fixed_aspect, 0.97)
    assert headline(missing, asked=asked).endswith(f"; missed: A: texture use 97 %, reached {share}")
    limits = {"max_distortion": 1.001, "limit_new_seams": True, "most_new_seams": 12.0, "effort": "FAST"}
    best = refined_arc(best_effort=True, **limits)
    assert headline(best, asked=Asked(0.8, 1.001)).endswith(f"; missed: distortion 1.001, reached {best.after.distortion:.2f}")
    barely = result_of(
        best, "cut", bound_met=False, groups=[], after=SimpleNamespace(**{**best.after.as_dict(), "distortion": 1.00104})
    )
    assert headline(barely, asked=Asked(0.8, 1.001)).endswith("; missed: distortion 1.001, reached 1.00104")


def test_names_are_counted_from_the_fourth_on():
    assert [named(list(names)) for names in ("A", "AB", "ABC")] == ["A", "A and B", "A, B and C"]
    assert named(list("ABCDE")) == "A, B, C and 2 more"


def test_a_name_that_begins_a_message_is_told_all_the_same():
    assert titled("t", "the bound was not reached") == "t: the bound was not reached"
    assert titled("the", "the: no face has UVs") == "the: no face has UVs"


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("chart 7 has no area in the UV map", "1 chart has no area in the UV map"),
        ("charts 3, 5: mirrored, turned over", "2 charts: mirrored, turned over"),
        ("12 charts: mirrored", "12 charts: mirrored"),
        ("charts of several groups were parted along 2 edges", "charts of several materials were parted along 2 edges"),
        (
            "1 face is not convex in the UV map, valid only where divided as here; 0 of them would be flipped as a fan",
            "1 face is not convex in the UV map: to a program that divides faces otherwise than Blender they may be flipped",
        ),
        ("object 'Cube': face 7 of chart 0 is flipped", "face 7 is flipped"),
        ("1012: keeps its UVs: object 'Cube': the bound was not reached", "1012: keeps its UVs: the bound was not reached"),
        ("the boundaries of charts 0 and 12 touch or cross near (0, 1)", "the boundaries of 2 charts touch or cross near (0, 1)"),
    ],
)
def test_messages_count_charts_instead_of_numbering_them(said, meant):
    assert plain(said) == meant


def test_what_was_mended_and_left_is_told_by_counts():
    positions, offsets, corners, uvs = shapes.loose()
    uvs = uvs.copy()
    uvs[: offsets[48]] *= [-1, 1]  # the first chart is mirrored
    uvs[-4 * 18 :] = 0.25  # the last one is a point
    told = list(notes(atlas_refine.refine(positions, offsets, corners, uvs)))
    assert "1 chart: mirrored, turned over" in told
    assert any(note.startswith("1 chart: has no area in the UV map") for note in told)
    assert not any("chart 0" in note or "chart 2" in note for note in told)


def test_what_was_mended_in_the_same_way_is_told_once():
    repairs = [
        SimpleNamespace(what=what, charts=[k], faces=[1, 2]) for k, what in enumerate(("overlapped itself", "turned", "turned"))
    ]
    again = SimpleNamespace(what="overlapped itself", charts=[3], faces=[5, 6])
    result = SimpleNamespace(repairs=[*repairs, again], fallbacks=[], warnings=[])
    assert list(notes(result)) == ["2 charts: overlapped themselves (4 faces)", "2 charts: turned (4 faces)"]


def test_faces_at_edges_of_three_and_of_opposite_winding():
    positions = np.zeros((6, 3), dtype=np.float32)
    faces = [[0, 1, 2], [1, 0, 3], [0, 1, 4], [2, 1, 5]]  # three at 0-1; the last one fits the first
    offsets = np.arange(0, 13, 3)
    atlas = AtlasArrays(positions, offsets, np.concatenate(faces), np.zeros((12, 2), dtype=np.float32))
    assert faces_at_fault(atlas).tolist() == [0, 1, 2]
    turned = AtlasArrays(positions, offsets[:3], np.array([0, 1, 2, 0, 1, 3]), np.zeros((6, 2), dtype=np.float32))
    assert faces_at_fault(turned).tolist() == [0, 1]


def test_notes_name_the_objects():
    charts = [SimpleNamespace(fate=fate, reason=reason) for fate, reason in [("refined", "")] * 2 + [("left", "has no area")] * 8]
    said = [
        "chart 1: looks odd",
        "charts 0, 2 and 3: look odd",
        "8 charts: each has no area; left as before",
        "9 charts: unknown",
        "slow",
    ]
    result = SimpleNamespace(repairs=[], fallbacks=[], warnings=said, charts=charts)
    objects = objects_of_charts(np.arange(10).repeat(2), np.array([0, 4, 6]), ["Crate", "Barrel", "Tub"])
    assert objects == ("Crate", "Crate", "Barrel", *["Tub"] * 7)
    assert list(notes(result, objects)) == [
        "1 chart: looks odd (Crate)",
        "3 charts: look odd (Crate: 1, Barrel: 1 and Tub: 1)",
        "8 charts: each has no area; left as before (Tub: 7 and Barrel: 1)",
        "9 charts: unknown",
        "slow",
    ]
    assert next(notes(result)) == "1 chart: looks odd"


def test_repairs_that_differ_in_a_count_are_one_note():
    folded = [([0, 1], "2 edges"), ([1, 2, 3], "6 edges"), ([4, 5], "1 edge")]
    repairs = [SimpleNamespace(what=f"folded onto each other along {edges}, parted", charts=of, faces=[]) for of, edges in folded]
    result = SimpleNamespace(repairs=repairs, fallbacks=[], warnings=[], charts=[])
    assert list(notes(result)) == ["6 charts: folded onto each other along 9 edges, parted"]


def test_equal_notes_are_one_with_the_names():
    pairs = [(f"Cube {k}", "uneven") for k in range(40)] + [("Cube 0", "shared"), ("Cube 0", "uneven")]
    assert joined(pairs) == ["Cube 0, Cube 1, Cube 2 and 37 more: uneven", "Cube 0: shared"]
