"""addon/core/presets.py: presets by name, from files that may hold anything."""

import dataclasses

import pytest
from core.option_kinds import OptionKind
from core.options import Options
from core.presets import (
    BUILT_IN,
    OWN,
    STUDIO,
    Preset,
    PresetError,
    built_in_values,
    find_presets,
    preset_named,
    preset_text,
    preset_values,
)

NAMES = ["Game Texture", "Film UDIM Tile", "Lightmap", "Mobile", "Paper Defaults"]
KINDS = {
    "pe_bound": OptionKind("pe_bound", 0.8),
    "seams": OptionKind("seams", "NONE", choices=("NONE", "RECTANGLES")),
    "seed": OptionKind("seed", 1, low=0),
    "relax": OptionKind("relax", False),
    "uv_map": OptionKind("uv_map", ""),
}


def written(folder, name, text):
    path = folder / f"{name}.py"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return Preset(name, OWN, path)


def test_the_built_in_presets():
    presets = find_presets([], "")
    assert [preset.name for preset in presets] == NAMES
    assert {preset.source for preset in presets} == {BUILT_IN}
    for name in NAMES:
        Options(**built_in_values(name)).engine_arguments()


def test_each_built_in_preset_sets_every_option_of_a_purpose():
    options = {field.name for field in dataclasses.fields(Options)}
    scenes = {"uv_map", "keep_shape", "importance", "no_seam", "prefer_seam", "seed", "threads"}
    for name in NAMES:
        assert set(built_in_values(name)) == options - scenes


def test_built_in_presets_fit_their_purpose():
    values = {name: Options(**built_in_values(name)) for name in NAMES}
    margins = {name: options.gap_px / options.texture_size for name, options in values.items()}
    assert margins["Lightmap"] > margins["Game Texture"]
    assert (values["Lightmap"].aspect, values["Lightmap"].density, values["Lightmap"].stacks) == ("SQUARE", "EQUAL", "SEPARATE")
    assert values["Film UDIM Tile"].tiles == "EACH"
    assert values["Mobile"].pe_bound > values["Game Texture"].pe_bound
    assert (values["Paper Defaults"].seams, values["Paper Defaults"].aspect) == ("RECTANGLES", "FREE")
    assert (values["Paper Defaults"].sigma, values["Paper Defaults"].candidates) == (0.004, 500)


def test_a_preset_is_found_however_its_name_is_written():
    presets = find_presets([], "")
    for name in ("Game Texture", "game texture", "game_texture", " Game-Texture "):
        assert preset_named(name, presets).name == "Game Texture"


def test_an_unknown_name_lists_those_there_are(tmp_path):
    written(tmp_path, "hero_prop", "op.seed = 2")
    with pytest.raises(PresetError) as caught:
        preset_named("Gane", find_presets([tmp_path], ""))
    assert str(caught.value) == f'there is no preset "Gane"; there are {", ".join(NAMES)}, Hero Prop'


def test_own_presets_come_before_the_studios_and_those_before_built_in_ones(tmp_path):
    own, studio = tmp_path / "own", tmp_path / "studio"
    for folder in (own, studio):
        folder.mkdir()
        written(folder, "mobile", "op.seed = 2")
    written(studio, "lightmap", "op.seed = 3")
    presets = find_presets([own], studio)
    assert preset_named("Mobile", presets).source == OWN
    assert preset_named("Lightmap", presets).source == STUDIO
    assert preset_named("Game Texture", presets).source == BUILT_IN


def test_folders_that_are_not_there_hold_none(tmp_path):
    assert len(find_presets([tmp_path / "none"], tmp_path / "neither")) == len(NAMES)


def test_values_go_out_and_come_back(tmp_path):
    values = {"pe_bound": 0.85, "seams": "RECTANGLES", "seed": 7, "relax": True, "uv_map": 'it\'s "2"'}
    assert preset_values(written(tmp_path, "mine", preset_text(values)), KINDS) == values


def test_what_blender_writes_is_read(tmp_path):
    text = "import bpy\nop = bpy.context.active_operator\n\nop.pe_bound = 0.8500000238418579\nop.seams = 'NONE'\n"
    assert preset_values(written(tmp_path, "mine", text), KINDS) == {"pe_bound": 0.8500000238418579, "seams": "NONE"}


def test_a_preset_is_never_run(tmp_path):
    trap = tmp_path / "trap"
    text = f"open({str(trap)!r}, 'w')\nop.seed = 2\n"
    assert preset_values(written(tmp_path, "mine", text), KINDS) == {"seed": 2}
    assert not trap.exists()


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("op.seed = (", "line 1 is not Python"),
        ("op.seed = 1\nop.relax = maybe()", "line 2: relax is not a plain value"),
        ("op.speed = 2", 'line 1: there is no option "speed"'),
        ("op.seams = 'SOME'", "line 1: seams is one of NONE, RECTANGLES, not 'SOME'"),
        ("op.seed = -1", "line 1: seed is from 0 to inf, not -1"),
        ("op.seed = 0.5", "line 1: seed is a whole number, not 0.5"),
        ("op.relax = 1", "line 1: relax is True or False, not 1"),
        ("op.pe_bound = 'high'", "line 1: pe_bound is a number, not 'high'"),
        ("op.seams = []", "line 1: seams is one of NONE, RECTANGLES, not []"),
        ("", "it sets no option"),
        (b"\xff\xfe\x00", "it is not text"),
        (b"op.seed = 1\x00", "null byte"),
        ("op.seed = " + "(" * 5000 + ")" * 5000, ""),
    ],
)
def test_a_broken_preset_is_named_with_its_fault(tmp_path, text, reason):
    with pytest.raises(PresetError) as caught:
        preset_values(written(tmp_path, "mine", text), KINDS)
    assert str(caught.value).startswith('preset "mine" is broken: ')
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_preset_that_is_gone_is_told(tmp_path):
    with pytest.raises(PresetError, match="No such file"):
        preset_values(Preset("mine", OWN, tmp_path / "mine.py"), KINDS)


def test_options_from_a_command_line():
    assert KINDS["seams"].parsed("rectangles") == "RECTANGLES"
    assert KINDS["pe_bound"].parsed("0.9") == 0.9
    for name, text in (("seams", "some"), ("seed", "many"), ("seed", "-1"), ("pe_bound", "nan")):
        with pytest.raises(ValueError, match=name):
            KINDS[name].parsed(text)
