"""addon/core: work in steps, without Blender."""

import threading

import pytest
from core.steps import Steps, at_once, to_its_end


def main_thread():
    return threading.current_thread() is threading.main_thread()


def work(log):
    log.append("begun")
    yield
    log.append((yield main_thread))
    try:
        yield lambda: 1 // 0
    except ZeroDivisionError:
        log.append("caught")
    yield
    return "end"


def test_at_once_runs_all_in_one_thread():
    log = []
    assert at_once(work(log)) == "end"
    assert log == ["begun", True, "caught"]


def test_step_by_step_functions_run_beside():
    log = []
    steps = Steps(work(log))
    turns = 0
    while not steps.step():
        turns += 1
    assert (steps.done, steps.result) == (True, "end")
    assert turns >= 4
    assert log == ["begun", False, "caught"]


def test_what_was_begun_can_be_finished_at_once():
    log = []
    steps = Steps(work(log))
    steps.step()
    steps.step()
    steps.finish()
    assert steps.result == "end"
    assert log == ["begun", False, "caught"]


def test_what_is_stopped_is_tidied_up():
    log = []

    def with_end():
        try:
            yield from work(log)
        finally:
            log.append("tidy")

    steps = Steps(with_end())
    steps.step()
    steps.stop()
    assert steps.done
    assert log == ["begun", "tidy"]


def test_errors_come_out():
    def failing():
        yield
        yield lambda: 1 // 0

    with pytest.raises(ZeroDivisionError):
        at_once(failing())
    steps = Steps(failing())
    steps.step()
    with pytest.raises(ZeroDivisionError):
        steps.finish()
    assert steps.done


def test_what_must_come_to_its_end_does_so_where_it_is_stopped():
    log = []
    functions = [lambda k=k: log.append(k) for k in range(3)]
    steps = Steps(to_its_end(functions))
    steps.step()
    assert log == [0]
    steps.stop()
    assert log == [0, 1, 2]
    at_once(to_its_end(functions))
    assert log == [0, 1, 2] * 2
