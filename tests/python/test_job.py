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


def stopped(job):
    """Its result, asked for once the charts bend."""
    while job.progress.stage != "squeeze" or job.progress.pe < 0.3:
        assert not job.done
        job.wait(0.01)
    job.finish()
    return job.result()


def test_a_job_that_is_finished_early_has_the_best_atlas_so_far():
    arrays = shapes.slow()
    result = stopped(atlas_refine.start(*arrays, pe_bound=0.999, threads=1))
    assert result.ended == "stopped"
    assert not result.bound_met
    assert any("stopped" in warning for warning in result.warnings)
    assert result.after.pe > result.before.pe
    assert atlas_refine.validate(*arrays[:3], result.corner_uvs).valid


def test_a_callback_may_finish_as_well_and_what_is_no_better_leaves_the_input():
    arrays = shapes.slow()
    result = atlas_refine.refine(*arrays, pe_bound=0.95, progress=lambda _: "finish")
    assert result.ended == "stopped"
    # On a loaded machine something better may have been found before the callback is asked.
    if result.intervention == "unchanged":
        assert result.corner_uvs.tobytes() == arrays[3].tobytes()
    else:
        assert result.after.pe > result.before.pe
