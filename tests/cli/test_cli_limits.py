"""What the machine does not give: memory, threads, room on the disk, time to finish; and inputs that never end."""

import json
import os
import resource
import signal
import subprocess
import sys
import time

import pytest
from obj_shapes import grid, uvs

MIB = 1 << 20


def run_limited(program, limits, *arguments, **more):
    def set_limits():
        for what, most in limits.items():
            resource.setrlimit(what, (most, most))

    return subprocess.run(
        [program.path, *arguments], preexec_fn=set_limits, capture_output=True, timeout=300, check=False, **more
    )


@pytest.fixture
def large(tmp_path):
    path = tmp_path / "large.obj"
    path.write_text(grid(150, 30))
    return path


def test_too_little_memory_is_said_and_the_old_output_stays(program, tmp_path, large):
    target = tmp_path / "out.obj"
    codes = []
    for most in (60, 90, 130, 180, 260):
        target.write_text("the old file")
        run = run_limited(program, {resource.RLIMIT_AS: most * MIB}, large, "-o", target, "--threads", "1")
        message = run.stderr.decode()
        codes.append(run.returncode)
        assert run.returncode in (0, 3), message
        if run.returncode == 3:
            assert message == f"atlas-refine: {large}: not enough memory for a mesh of this size\n"
            assert target.read_text() == "the old file"
    assert 3 in codes
    assert sorted(path.name for path in tmp_path.iterdir()) == ["large.obj", "out.obj"]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the stack of a thread is as large as the limit in glibc only")
def test_threads_that_cannot_be_started_do_not_matter(program, tmp_path, large):
    """Stacks of 1 GiB leave room for one more thread or two."""
    limits = {resource.RLIMIT_STACK: 1024 * MIB, resource.RLIMIT_AS: 2600 * MIB}
    results = []
    for limit in ({}, limits, {**limits, resource.RLIMIT_AS: 1000 * MIB}):
        target = tmp_path / "out.obj"
        run = run_limited(program, limit, large, "-o", target, "--threads", "8")
        assert (run.returncode, run.stderr) == (0, b"")
        results.append(target.read_bytes())
    assert results[0] == results[1] == results[2]


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/urandom", "/dev/null"])
@pytest.mark.parametrize("job", ["refine", "measure"])
def test_devices_are_not_read(program, tmp_path, device, job):
    arguments = [device, "-o", tmp_path / "out.obj"] if job == "refine" else ["measure", device]
    assert program.refused(3, *arguments) == f"atlas-refine: {device}: is a device, not an OBJ file"
    assert list(tmp_path.iterdir()) == []


def test_standard_input_is_read(program, tmp_path):
    text = grid(3)
    run = subprocess.run([program.path, "-", "-o", tmp_path / "out.obj"], input=text.encode(), capture_output=True, check=False)
    assert (run.returncode, run.stderr) == (0, b"")
    assert (tmp_path / "out.obj").read_text() == text


def test_a_named_pipe_is_read(program, tmp_path):
    pipe, text = tmp_path / "pipe.obj", grid(3)
    os.mkfifo(pipe)
    with subprocess.Popen([program.path, "measure", pipe, "--json"], stdout=subprocess.PIPE) as run:
        pipe.write_text(text)
        assert json.loads(run.stdout.read())["validity"]["valid"] is True


def test_a_pipe_that_never_ends_is_given_up(program, tmp_path):
    with subprocess.Popen(["yes", "v 0 0 0"], stdout=subprocess.PIPE) as endless:
        command = [program.path, "-", "-o", tmp_path / "out.obj"]
        run = subprocess.run(command, stdin=endless.stdout, capture_output=True, timeout=300, check=False)
        endless.stdout.close()
    assert run.returncode == 3
    assert run.stderr == b"atlas-refine: -: is a pipe that brings more than 1 GiB; write it to a file first\n"


def test_figures_that_cannot_be_printed_are_no_success(program, tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(grid(3))
    with open("/dev/full", "w") as full:
        run = subprocess.run([program.path, "measure", path], stdout=full, stderr=subprocess.PIPE, check=False)
    assert run.returncode == 2
    assert run.stderr == b"atlas-refine: standard output: cannot be written: No space left on device\n"


def test_a_file_that_grows_too_large_leaves_the_old_one(program, tmp_path, large):
    """A limit on the size of files fails a write as a full disk does."""
    target, report = tmp_path / "out.obj", tmp_path / "r.json"
    target.write_text("the old file")
    report.write_text("the old report")

    def set_limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (MIB // 2, MIB // 2))

    command = [program.path, large, "-o", target, "--report", report]
    run = subprocess.run(command, preexec_fn=set_limit, capture_output=True, check=False)
    assert run.returncode == 2
    assert run.stderr == f"atlas-refine: {target}: cannot be written: File too large\n".encode()
    assert (target.read_text(), report.read_text()) == ("the old file", "the old report")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["large.obj", "out.obj", "r.json"]


def test_killed_at_any_time_the_output_is_the_old_one_or_the_new_one(program, tmp_path, large):
    target = tmp_path / "out.obj"
    start = time.monotonic()
    assert program(large, "-o", target).returncode == 0
    seconds, new = time.monotonic() - start, target.read_bytes()
    for k in range(12):
        target.write_text("the old file")
        with subprocess.Popen([program.path, large, "-o", target], stdout=subprocess.DEVNULL) as run:
            # Most of them while it writes.
            time.sleep(seconds * (0.3 + 0.07 * k))
            run.send_signal(signal.SIGKILL)
        assert target.read_bytes() in (b"the old file", new)
        assert len(uvs(new.decode())) == 151 * 151


def test_what_is_left_out_is_in_the_figures(program, tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(grid(3) + "f 1 2 3\n")
    note = "1 face has corners without UVs and is left out"
    assert json.loads(program("measure", path, "--json").stdout)["notes"][0].startswith(note)
    assert f"warning: {note}".encode() in program("measure", path).stdout
