"""start(): the same call in the background."""

import os
import pathlib
import subprocess
import sys
import time

import atlas_refine
import pytest
import shapes


def test_a_job_returns_what_refine_returns():
    arrays = shapes.loose()
    job = atlas_refine.start(*arrays, pe_bound=0.8)
    result = job.result()
    assert job.done
    assert job.progress.fraction == 1.0
    assert result.corner_uvs.tobytes() == atlas_refine.refine(*arrays, pe_bound=0.8).corner_uvs.tobytes()


def test_a_job_raises_what_refine_raises():
    job = atlas_refine.start(*shapes.tight(), pe_bound=1.2)
    assert job.wait(5.0)
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        job.result()
    assert caught.value.code == "bad_option"


def test_cancel_ends_a_long_job_within_half_a_second_of_work():
    """Counted in processor time, of which a loaded machine gives less and asks no more."""
    job = atlas_refine.start(*shapes.slow(), pe_bound=0.95, threads=1)
    while job.progress.stage == "input" and not job.done:
        job.wait(0.01)
    assert not job.done
    began = time.process_time()
    job.cancel()
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        job.result()
    assert caught.value.code == "cancelled"
    assert time.process_time() - began < 0.5


def test_a_job_that_nobody_waits_for_stops_with_its_object_and_with_the_process():
    """The work itself takes several times as long as either may."""
    began = time.process_time()
    job = atlas_refine.start(*shapes.slow(), pe_bound=0.95, threads=1)
    del job
    assert time.process_time() - began < 1.0

    code = "import conftest, atlas_refine, shapes, time; job = atlas_refine.start(*shapes.slow(), pe_bound=0.95); time.sleep(0.1)"
    with subprocess.Popen([sys.executable, "-c", code], cwd=pathlib.Path(__file__).parent) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    assert usage.ru_utime + usage.ru_stime < 3.0
