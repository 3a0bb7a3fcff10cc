# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators that run the engine share: at once in scripts, beside Blender with progress and Esc from a button."""

import bpy

from . import again, drawing, tasks
from .bridge import parts as objects
from .core.notes import joined
from .core.words import phase, plain

POLL_SECONDS = 0.1
#: While meshes are read and written, of which each turn does a part.
STEP_SECONDS = 0.01


class OnObjects:
    """An operator that needs something to work on."""

    replaces_again = False  # it may end a run of what was adjusted

    @classmethod
    def poll(cls, context):
        """The message says why not."""
        found = objects.objects_of(context)
        if not found:
            cls.poll_message_set("Select a mesh object")
            return False
        reasons = [(obj.name, objects.why_not(obj)) for obj in found]
        if all(reason for _, reason in reasons):
            cls.poll_message_set(f"{reasons[0][0]}: {reasons[0][1]}")
            return False
        if tasks.running is not None and not (cls.replaces_again and tasks.running.is_again):
            cls.poll_message_set("A refinement is running; Esc cancels it")
            return False
        return True

    def report_problems(self, problems):
        for line in joined((name, plain(text).removeprefix(f"{name}: ")) for name, text in problems):
            self.report({"ERROR"}, line)


class Runs(OnObjects):
    """An operator with _start(context, beside_window), a tasks.Run or None, and _finish(run), what Blender is answered."""

    def execute(self, context):
        if "UNDO" not in self.bl_options and again.is_asked(context, self):
            again.once_more(context, self)
            return {"CANCELLED"}  # its end is that of the other
        run = self._start(context)
        if run is None or not self._has_work(run):
            return {"CANCELLED"}
        while not run.wait(POLL_SECONDS):  # in steps, so that Ctrl-C is heard
            pass
        return self._finish(run)

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        self._run = self._start(context, beside_window=True)
        if self._run is None:
            return {"CANCELLED"}
        tasks.running = self._run
        self._shown = ""
        self._timer = None
        self._set_timer(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if tasks.running is not self._run:  # another run has taken its place
            self._leave(context)
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            self._run.cancel()
            return {"RUNNING_MODAL"}
        if self._is_keep_best(context, event):
            self._run.keep_best()
            return {"RUNNING_MODAL"}
        if event.type == "TIMER" and self._step(context):
            self._leave(context)
            has_work = self._run.cancelled or self._has_work(self._run)
            return self._finish(self._run) if has_work else {"CANCELLED"}
        if event.type == "TIMER":
            self._show_progress(context)
            self._set_timer(context)
        # While a mesh is read or written nobody may change it.
        passes = event.type == "TIMER" or self._run.is_solving or self._is_of_adjusting(context, event)
        return {"PASS_THROUGH"} if passes else {"RUNNING_MODAL"}

    def _is_of_adjusting(self, context, event):
        """By the mouse, in Blender's panel of the last operator: what was pressed there before the run may be let go, or goes on to
        another value, whose run takes the place of this one."""
        if not self._run.is_again:
            return False
        return event.value == "RELEASE" or "MOUSEMOVE" in event.type or drawing.is_over_redo_panel(context, event)

    def _step(self, context):
        try:
            return self._run.step()
        except Exception:  # Blender shows it; the operator has come to its end
            self._leave(context)
            raise

    def cancel(self, context):
        """Blender ends the operator: another file, a closed window."""
        self._leave(context)

    def _has_work(self, run):
        """Tells the reasons where it has none."""
        if not run.atlases:
            self.report_problems(run.problems or [("Atlas Refine", "there is nothing to refine")])
        return bool(run.atlases)

    def _set_timer(self, context):
        seconds = POLL_SECONDS if self._run.is_solving else STEP_SECONDS
        if self._timer is None or self._seconds != seconds:
            self._drop_timer(context)
            self._seconds = seconds
            self._timer = context.window_manager.event_timer_add(seconds, window=context.window)

    def _drop_timer(self, context):
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None

    def _is_keep_best(self, context, event):
        is_enter = event.type in {"RET", "NUMPAD_ENTER"} and event.value == "PRESS"
        return is_enter and self._run.writes and drawing.is_over_uv_or_3d_view(context, event)

    def _show_progress(self, context):
        stage, fraction = self._run.progress
        keys = "stopping" if self._run.finishing else "Enter: stop and keep the best, Esc: cancel"
        if not self._run.writes:
            keys = "Esc: cancel"
        text = f"{self._run.doing}: {phase(stage)} {100 * fraction:.0f} % ({keys})"
        if text != self._shown:  # each redraw costs the window time
            self._shown = text
            context.workspace.status_text_set(text)
            drawing.redraw_panels(context)

    def _leave(self, context):
        if tasks.running is self._run:
            tasks.stop_running()
        self._drop_timer(context)
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        drawing.redraw_panels(context)
