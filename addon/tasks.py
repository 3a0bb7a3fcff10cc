# SPDX-License-Identifier: GPL-3.0-or-later
"""One call of the operator: read the meshes, run the engine beside Blender, write what comes. At most one runs with a window's progress."""

import os

import bpy
import numpy as np

from . import drawing, engine, preferences
from .atlas import Atlas, print_of
from .bridge import mesh as bridge
from .bridge import parts as objects
from .changes import Watch, no_longer, once_drawn
from .core.notes import joined
from .core.request import NothingToDoError
from .core.steps import Steps

#: What a run may fail with for reasons that lie in the objects or the options.
FAILURES = (engine.AtlasRefineError, bridge.MeshError, NothingToDoError, ValueError, ReferenceError)

#: The run whose progress the panel shows.
running = None
#: What the panel shows: the Done of the last run or measure, None where there is none or it is no longer true.
last = None
_in_doubt = False


class Run:
    """All atlases of one call, one after the other; what comes of them is written at the end.

    Beside a window it is driven by step(), else by wait() and finish()."""

    writes = True
    doing = "Refining"

    def __init__(self, context, options, keywords=None, beside_window=False, is_again=False):
        """`keywords`: the engine's, besides those of the options; `is_again`: of what was adjusted after a run (again.py), by a mouse
        button that may still be down."""
        self.is_again = is_again
        self.problems = []  # (object's name, why nothing was done with it)
        self.errors = []  # those of the engine and of writing, after finish()
        self.atlases = []
        self.cancelled = False
        self.finishing = False
        self._beside_window = beside_window
        # One core is left to the window.
        automatic = max(1, (os.cpu_count() or 1) - 1) if beside_window else 0
        self._threads = options.threads or preferences.get().threads or automatic
        self._keywords = keywords or {}
        self._at = 0
        self._written = ()
        self._writing = None
        self._reading = Steps(self._begin(context, options))
        if not beside_window:
            self._reading.finish()

    def _begin(self, context, options):
        self.atlases = yield from self._read(context, options)
        if self.atlases:
            yield self._start_next

    def _read(self, context, options):
        return read_atlases(context, options, self.problems)

    def _start_next(self):
        self.atlases[self._at].start(self._threads, self._keywords)

    def step(self):
        """Goes on for as long as the window may wait. True where there is no more to do."""
        if not self._reading.done:
            self._reading.step()
            return False
        if not self.done:
            return False
        if self.cancelled:
            return True
        if self._writing is None:
            self._writing = Steps(self._write())
        return self._writing.step()

    @property
    def is_solving(self):
        """The engine is at work: the meshes are neither read nor written, and may change."""
        return self._reading.done and self._at < len(self.atlases)

    @property
    def done(self):
        """Starts the next atlas where one has come to its end."""
        while self.is_solving and self.atlases[self._at].job.done:
            ends = self.cancelled or self.finishing
            if not ends and self.atlases[self._at].holds_unequal_densities():
                self.atlases[self._at].start_for_equal_densities(self._threads, self._keywords)
                continue
            self._at = len(self.atlases) if ends else self._at + 1
            if self._at < len(self.atlases):
                self._start_next()
        return self._reading.done and not self.is_solving

    @property
    def begun(self):
        """All atlases, but for those that keep_best() came before."""
        return [atlas for atlas in self.atlases if atlas.job is not None]

    def wait(self, seconds):
        """True where all are done."""
        if self.is_solving:
            self.atlases[self._at].job.wait(seconds)
        return self.done

    @property
    def progress(self):
        """(the stage, fraction of the whole)."""
        if not self._reading.done:
            return "input", 0.0
        if not self.is_solving:
            return "write", 1.0
        progress = self.atlases[self._at].job.progress
        return progress.stage, (self._at + progress.fraction) / len(self.atlases)

    def cancel(self):
        """Unless all are done."""
        if not self._reading.done:
            self.cancelled = True
            self._reading.stop()
        if self.is_solving:
            self.cancelled = True
            if self.atlases[self._at].job is not None:  # else its start has failed
                self.atlases[self._at].job.cancel()

    def keep_best(self):
        """Ends with the best valid atlas so far; those that were not begun stay as they are."""
        if self.is_solving:
            self.finishing = True
            self.atlases[self._at].job.finish()

    def stop(self):
        """Cancels and waits for the engine's thread. What was begun to be written is taken back."""
        self.cancel()
        if self.is_solving and self.atlases[self._at].job is not None:
            self.atlases[self._at].job.wait()
        if self._writing is not None:
            self._writing.stop()

    def finish(self):
        """Writes what came and returns it, a Done for each atlas; `problems` has the others."""
        if self._writing is None:
            self._writing = Steps(self._write())
        self._writing.finish()
        return self._written

    def _write(self):
        out = []
        for atlas in self.begun:
            try:
                out.append((yield from atlas.write(atlas.job.result(), is_alone=not self._beside_window)))
            except FAILURES as error:
                self.problems.append((atlas.title_of(error), atlas.words_of(why(error))))
                self.errors.append(error)
        if out:
            show(out)
        self._written = out


def read_atlases(context, options, problems, moves=True):
    """In steps: the atlases that the options ask for; what cannot be used goes to `problems`. `moves`: as of prepare()."""
    if options.refusal:
        problems.append(options.refusal)
        return []
    usable, without_map = usable_objects(context, options, problems)
    if not usable:
        problems += without_map
    by_object = options.atlases == "OBJECT"
    out, idle = [], []
    for objs in ([obj] for obj in usable) if by_object else [usable] if usable else []:
        atlas = Atlas(options, objs)
        try:
            yield from atlas.read(context, objs, moves)
            out.append(atlas)
        except NothingToDoError as error:
            idle.append((atlas.title, str(error)))
        except FAILURES as error:
            problems.append((atlas.title, why(error)))
    # Of several objects those without a selection are simply not meant.
    if not out and not problems:
        problems += idle
    if not out and usable:
        problems += without_map
    if out:
        out[0].notes += [f"left out: {note}" for note in joined(without_map)]
    return out


def why(error):
    """Python's own words for what Blender no longer has are not for artists."""
    return "the object or its mesh is gone; nothing was written" if isinstance(error, ReferenceError) else str(error)


def usable_objects(context, options, problems):
    """Objects that can be refined, and (name, why not) of those that lack the UV map which others may have."""
    usable, without_map = [], []
    for obj in objects.objects_of(context):
        reason = objects.why_not(obj)
        if reason:
            problems.append((obj.name, reason))
            continue
        try:
            bridge.find_uv_map(obj.data, options.uv_map)
            usable.append(obj)
        except bridge.MeshError as error:
            without_map.append((obj.name, str(error)))
    return usable, without_map


def show(done):
    global last, _in_doubt
    last, _in_doubt = done, False


def last_if_true():
    """`last`, after a look at the meshes where something may have changed them."""
    global last, _in_doubt
    if last is not None and _in_doubt:
        _in_doubt = False
        if not all(is_true_of(done.prints) for done in last):
            last = None
    return last


def last_to_draw():
    """`last`; where something may have changed the meshes they are looked at once it is drawn."""
    if last is not None and _in_doubt:
        once_drawn(_look_again)
    return last


def _look_again():
    if last is not None and last_if_true() is None:
        drawing.redraw_panels(bpy.context)


def is_true_of(prints):
    """Whether the meshes are as they were."""
    return all(print_of(name, uv_map) == known for name, uv_map, known in prints)


def new_seams(object_name):
    """(S, 2) vertices of the object's edges that the run whose result is shown has cut."""
    found = [edges for done in last_if_true() or () for name, edges in done.new_seams if name == object_name]
    return np.concatenate(found) if found else np.zeros((0, 2), dtype=np.int64)


def faces_left(object_name):
    """The object's faces that the run whose result is shown left as they are."""
    left = [faces for done in last_if_true() or () for name, faces in done.left if name == object_name]
    return np.concatenate(left) if left else np.zeros(0, dtype=np.int64)


def stop_running():
    """Ends the run, if there is one, and waits for its thread: before a file is loaded and on unregister."""
    global running
    if running is not None:
        ended, running = running, None
        ended.stop()


def _before_undo():
    """What reads or writes holds meshes that undo replaces."""
    if running is not None and not running.is_solving:
        stop_running()


def _doubt():
    global _in_doubt
    _in_doubt = True


def _forget():
    global last
    stop_running()
    last = None


_watch = Watch(_forget, _doubt, is_needed=lambda: last is not None, before_undo=_before_undo)


def register():
    _watch.register()


def unregister():
    no_longer(_look_again)
    _forget()
    _watch.unregister()
