"""addon/core: the headless script's command line, and how it knows what is done."""

import json

import pytest
from core.batch_arguments import Item, UsageError, read_arguments
from core.batch_record import is_compressed, is_done, partial_name, read_record, write_record
from core.option_kinds import OptionKind

KINDS = {
    "pe_bound": OptionKind("pe_bound", 0.8, "100 %"),
    "seams": OptionKind("seams", "NONE", choices=("NONE", "RECTANGLES")),
    "open_closed": OptionKind("open_closed", True),
    "uv_map": OptionKind("uv_map", ""),
}
RECORD = {"status": "done", "options": {"seed": 1, "threads": 0}, "input_sha256": "a", "output_sha256": "b"}


def read(*arguments):
    return read_arguments(list(map(str, arguments)), KINDS)


@pytest.fixture
def files(tmp_path):
    for name in ("b.blend", "a.blend", "deep/c.blend", "out/d.blend", "e.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    return tmp_path


def sources(arguments):
    return [item.source.name for item in arguments.items]


def test_only_what_is_given_is_an_option():
    arguments = read("x.blend", "--in-place", "--pe-bound", "0.9", "--seams", "rectangles", "--no-open-closed")
    assert arguments.options == {"pe_bound": 0.9, "seams": "RECTANGLES", "open_closed": False}
    assert read("x.blend", "--in-place").options == {}


def test_patterns_reach_each_file_once_and_no_results(files):
    arguments = read(files / "**/*.blend", files / "a.blend", "-o", files / "out")
    assert sources(arguments) == ["a.blend", "b.blend", "c.blend"]
    assert arguments.items[0].output == files / "out/a.blend"
    assert arguments.items[0].record == files / "out/a.atlas_refine.json"


def test_patterns_reach_no_folders(files):
    assert sources(read(files / "**/*", "-o", files / "out")) == ["a.blend", "b.blend", "c.blend", "e.txt"]
    with pytest.raises(UsageError, match="no file fits"):
        read(files / "dee?", "-o", files / "out")


def test_in_place(files):
    (item,) = read(files / "a.blend", "--in-place").items
    assert item.source == item.output


def test_results_of_other_kinds_are_blend_files(tmp_path):
    items = read(tmp_path / "b.OBJ", tmp_path / "a.v2.glb", "-o", tmp_path / "out").items
    assert [item.output.name for item in items] == ["a.v2.blend", "b.blend"]
    with pytest.raises(UsageError, match="name a folder with -o"):
        read(tmp_path / "b.obj", "--in-place")
    with pytest.raises(UsageError, match="would both become"):
        read(tmp_path / "a.blend", tmp_path / "a.fbx", "-o", tmp_path / "out")


def test_a_line_of_the_trade_off():
    assert read("x.blend", "--in-place").point is None
    assert read("x.blend", "--in-place", "--point", "0").point == 0
    with pytest.raises(UsageError, match="from 0 on"):
        read("x.blend", "--in-place", "--point=-1")


def test_shards_share_the_files(files):
    shares = [sources(read(files / "**/*.blend", "--in-place", "--shard", f"{at}/3")) for at in (1, 2, 3)]
    assert sorted(name for share in shares for name in share) == ["a.blend", "b.blend", "c.blend", "d.blend"]
    assert sources(read(files / "a.blend", "--in-place", "--shard", "2/2")) == []


def test_a_file_whose_name_looks_like_a_pattern(tmp_path):
    (tmp_path / "a[1].blend").touch()
    assert sources(read(tmp_path / "a[1].blend", "--in-place")) == ["a[1].blend"]


def test_a_missing_file_is_kept_to_be_told():
    assert sources(read("gone.blend", "--in-place")) == ["gone.blend"]


@pytest.mark.parametrize("shard", ["0/2", "3/2", "1", "a/b", "1/0", "-1/2", "1/2/3"])
def test_no_shard(shard):
    with pytest.raises(UsageError, match="I/N"):
        read("x.blend", "--in-place", f"--shard={shard}")


def test_names_are_not_abbreviated():
    with pytest.raises(UsageError, match="--pe"):
        read("x.blend", "--in-place", "--pe", "0.9")


def test_results_that_would_be_one_file(files):
    (files / "deep/a.blend").touch()
    with pytest.raises(UsageError, match="would both become"):
        read(files / "a.blend", files / "deep/a.blend", "-o", files / "out")


def test_files_of_the_output_folder_alone(files):
    with pytest.raises(UsageError, match="--in-place is for that"):
        read(files / "out/d.blend", "-o", files / "out")


def test_done_is_what_was_asked_of_the_same_file():
    asked = {"options": {"seed": 1, "threads": 4}}
    assert is_done(RECORD, "a", asked, in_place=False)
    assert is_done(RECORD, "b", asked, in_place=True)
    assert not is_done(RECORD, "b", asked, in_place=False)
    assert not is_done(RECORD, "a", asked, in_place=True)
    assert not is_done(RECORD, "a", {"options": {"seed": 2, "threads": 0}}, in_place=False)
    assert not is_done({**RECORD, "status": "partly"}, "a", asked, in_place=False)
    for nothing in (None, [], "text", {}):
        assert not is_done(nothing, "a", asked, in_place=False)


def test_records_are_written_whole(tmp_path):
    path = tmp_path / "a.atlas_refine.json"
    write_record(path, RECORD)
    assert read_record(path) == RECORD
    with pytest.raises(ValueError, match="JSON"):
        write_record(path, {"price": float("nan")})
    assert json.loads(path.read_text()) == RECORD
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_a_record_that_cannot_be_read_is_none(tmp_path):
    path = tmp_path / "a.json"
    assert read_record(path) is None
    for text in (b"{", b"\xff"):
        path.write_bytes(text)
        assert read_record(path) is None


def test_partial_results_are_hidden_from_patterns(tmp_path):
    item = Item(tmp_path / "a.blend", tmp_path / "a.blend")
    assert partial_name(item.output).name == ".a.partial.blend"


def test_compressed_files(tmp_path):
    for start, compressed in ((b"BLENDER-v304", False), (b"\x1f\x8b\x08", True), (b"\x28\xb5\x2f\xfd", True), (b"", False)):
        (tmp_path / "a").write_bytes(start)
        assert is_compressed(tmp_path / "a") == compressed
