"""Ctrl-C stops the program within half a second, with exit code 130 and nothing written."""

import os
import pty
import signal
import subprocess
import time

import pytest
from obj_shapes import arc


@pytest.fixture
def long_job(tmp_path):
    """A chart large enough to keep the program busy for seconds."""
    path = tmp_path / "in.obj"
    path.write_text(arc(200))
    (tmp_path / "out.obj").write_text("the old file")
    return [path, "-o", tmp_path / "out.obj", "--pe-bound", "0.95", "--report", tmp_path / "r.json"]


@pytest.mark.parametrize("delay", [0.0, 0.1, 0.3, 1.0, 2.0])
def test_interrupt(program, long_job, tmp_path, delay):
    with subprocess.Popen([program.path, *long_job], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        time.sleep(0.05 + delay)
        if process.poll() is not None:
            pytest.skip("the job was done before the interrupt")
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=20)
        waited = time.monotonic() - sent
    assert (process.returncode, out, err) == (130, b"", b"")
    assert waited < 0.5
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.obj", "out.obj"]
    assert (tmp_path / "out.obj").read_text() == "the old file"


def test_progress_bar_on_a_terminal_only(program, tmp_path):
    (tmp_path / "in.obj").write_text(arc(30))
    command = [program.path, tmp_path / "in.obj", "-o", tmp_path / "out.obj"]
    leader, follower = pty.openpty()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=follower)
    os.close(follower)
    shown = b""
    try:
        while chunk := os.read(leader, 4096):
            shown += chunk
    except OSError:  # Linux: the other side is closed
        pass
    os.close(leader)
    assert process.wait() == 0
    assert b"[" in shown
    assert b"%" in shown
    assert shown.endswith(b"\r\x1b[K")
    assert subprocess.run(command, capture_output=True, check=True).stderr == b""
