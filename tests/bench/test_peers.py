"""The table of peers: what they are given, what is read back, and that none of them can end the table."""

import json
import sys
from pathlib import Path

import numpy as np
import peers
import pytest
from obj_text import read_obj
from pack_with_peer import fans

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt .5 0\nvt .5 .5\nvt 0 .5\nf 1/1 2/2 3/3 4/4\n"


@pytest.fixture
def source(tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(SQUARE)
    path.write_text(peers.obj_of(read_obj(path), read_obj(path).corner_uv))
    return path


def peer(folder, *lines):
    """A Python of its own that does not pack: what it is called with is in `words`."""
    path = folder / "peer"
    path.write_text(f"#!{sys.executable}\nimport json, sys\nfrom pathlib import Path\nwords = sys.argv[1:]\n" + "\n".join(lines))
    path.chmod(0o755)
    return path


def test_an_obj_holds_what_it_is_made_of(source, tmp_path):
    mesh = read_obj(source)
    again = tmp_path / "again.obj"
    again.write_text(peers.obj_of(mesh, 2 * mesh.corner_uv))
    found = read_obj(again)
    assert np.array_equal(found.corner_uv, 2 * mesh.corner_uv)
    assert np.array_equal(found.corner_vertex, mesh.corner_vertex)
    assert np.array_equal(found.positions, mesh.positions)


def test_polygons_are_fans():
    assert fans(np.array([0, 4, 7])).tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6]]


def test_what_a_peer_packs_is_measured_by_the_checker(source, tmp_path):
    python = peer(
        tmp_path,
        "import numpy as np",
        "np.save(Path(words[2]).with_suffix('.npy'), np.load(words[2])['corner_uv'] * 2)",
        "print(json.dumps({'peer': words[1], 'seconds': 0.5}))",
    )
    found = peers.packed(python, "xatlas", read_obj(source), source)
    assert (found.pe, found.e_d, found.seconds, found.reason) == (pytest.approx(1), pytest.approx(1), 0.5, "")


@pytest.mark.parametrize(
    ("line", "reason"), [("sys.exit('no such packer')", "no such packer"), ("import time; time.sleep(60)", "nothing after 2 s")]
)
def test_a_peer_without_a_result_says_why(source, tmp_path, line, reason):
    found = peers.packed(peer(tmp_path, line), "xatlas", read_obj(source), source, limit=2)
    assert reason in found.reason
    assert peers.cell(found) == ("-", "-", "-")


def test_the_table_has_three_cells_for_every_way_and_marks_what_is_not_valid():
    good, bad = peers.Result(0.8, 1.01, 0.5), peers.Result(0.7, 1.0, 0.25, "borders: 2 pairs of edges cross or touch")
    row = {
        "file": "disk/a",
        "triangles": 2,
        "given": good,
        "pack_islands": bad,
        "xatlas": peers.Result(),
        "none": good,
        "rectangles": good,
    }
    head, rule, line = peers.markdown([row])
    assert head.count("|") == rule.count("|") == line.count("|") == 3 + 3 * len(peers.WAYS) + 1
    assert line.startswith("| disk/a | 2 | 0.800 | 0.700 (not valid) | 1.0000 | 0.25 | - | - | - |")


def test_the_files_are_ten():
    assert sum(map(len, peers.FILES.values())) == 10


def test_every_way_is_written_as_it_is_shown(tmp_path, monkeypatch, capsys):
    good, bad = peers.Result(0.8, 1.01, 0.5), peers.Result(reason="exit 4: bound not reached")
    row = {"file": "disk/a", "triangles": 2, "given": good, "pack_islands": good, "xatlas": good, "none": good, "rectangles": bad}
    monkeypatch.setattr(peers, "pythons", lambda cache: {})
    monkeypatch.setattr(peers, "compare_file", lambda *_: row)
    assert peers.run_peers(tmp_path, {"disk": [Path("a.obj")]}, None, tmp_path, tmp_path) == 1
    assert "rectangles: exit 4: bound not reached" in capsys.readouterr().out
    assert json.dumps(peers.markdown([row])[-1])[1:-1] in (tmp_path / "peers.md").read_text()
