# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that Blender's window is not to wait for, as a generator: it yields where the window may have a turn, and functions that may
run beside it, since they touch nothing of Blender's, whose results are sent back to it."""

import threading


def at_once(generator):
    """Runs it to its end, and returns what it returns."""
    steps = Steps(generator)
    steps.finish()
    return steps.result


def to_its_end(functions):
    """In steps, a function each. Once it has begun it comes to its end: closed meanwhile, it calls the others at once."""
    waiting = iter(functions)
    for function in waiting:
        function()
        try:
            yield
        except GeneratorExit:
            for other in waiting:
                other()
            raise


class Steps:
    """A generator that is run piece by piece."""

    def __init__(self, generator):
        self.done = False
        self.result = None  # what the generator returns
        self._generator = generator
        self._work = None

    def step(self):
        """Until the window's next turn. Returns whether that was the end; raises what the generator does."""
        if self._work is not None and self._work.is_alive():
            return False
        self._resume()
        if self._work is not None:
            self._work.start()
        return self.done

    def finish(self):
        """At once, and without another thread."""
        while not self.done:
            if self._work is not None and self._work.is_alive():
                self._work.join()
            self._resume()
            if self._work is not None:
                self._work.run()

    def stop(self):
        """Ends it where it is."""
        if self._work is not None and self._work.is_alive():
            self._work.join()
        self._generator.close()
        self.done = True

    def _resume(self):
        """To the next yield."""
        work, self._work = self._work, None
        try:
            if work is None:
                function = next(self._generator)
            elif work.error is not None:
                function = self._generator.throw(work.error)
            else:
                function = self._generator.send(work.result)
        except StopIteration as end:
            self.done, self.result = True, end.value
            return
        except BaseException:
            self.done = True
            raise
        self._work = _Work(function) if function else None


class _Work(threading.Thread):
    def __init__(self, function):
        super().__init__(daemon=True)
        self.result = self.error = None
        self._function = function

    def run(self):
        try:
            self.result = self._function()
        except Exception as error:  # raised where it is waited for
            self.error = error
