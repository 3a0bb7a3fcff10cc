"""Ctrl-C stops the program within half a second, with exit code 130 and nothing written."""

import os
import pty
import signal
import subprocess
import time
from pathlib import Path

import pytest
from obj_shapes import arc


@pytest.fixture
def long_job(tmp_path):
    """A chart large enough to keep the program busy for seconds."""
    path = tmp_path / "in.obj"
    path.write_text(arc(400))
    (tmp_path / "out.obj").write_text("the old file")
    return [path, "-o", tmp_path / "out.obj", "--pe-bound", "0.95", "--report", tmp_path / "r.json", "--threads", "1"]


def seconds_worked(pid):
    """Processor time of a process so far."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.mark.parametrize("delay", [0.0, 0.1, 0.3, 1.0, 2.0])
def test_interrupt(program, long_job, tmp_path, delay):
    """Half a second is counted in processor time of the one thread, of which a loaded machine gives less and asks no more."""
    log = tmp_path / "log"
    with log.open("wb") as told, subprocess.Popen([program.path, *long_job], stdout=told, stderr=told) as process:
        time.sleep(0.05 + delay)
        if process.poll() is not None:
            pytest.skip("the job was done before the interrupt")
        before = seconds_worked(process.pid)
        process.send_signal(signal.SIGINT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert (process.returncode, log.read_bytes()) == (130, b"")
    assert usage.ru_utime + usage.ru_stime - before < 0.5
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.obj", "log", "out.obj"]
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
