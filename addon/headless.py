# SPDX-License-Identifier: GPL-3.0-or-later
"""Many files without a window: `blender --command atlas_refine`, or atlas_refine_headless.py (docs/headless.md)."""

import shutil
import signal
import sys
import time
import traceback
from contextlib import contextmanager, suppress
from dataclasses import asdict
from fnmatch import fnmatchcase

import bpy

from . import engine, presets, tasks, trade_off
from .bridge import files, parts, versions
from .core.batch_arguments import PROGRAM, USAGE, UsageError, read_arguments
from .core.batch_record import (
    DONE,
    FAILED,
    PARTLY,
    atlas_record,
    is_compressed,
    is_done,
    partial_name,
    read_record,
    replace,
    sha256,
    write_record,
)
from .core.options import Options
from .core.presets import PresetError
from .core.summary import groups_left, nothing_takes_part
from .core.words import plain

#: Exit codes, in the words of docs/command_line.md. Of several the first counts.
INTERRUPTED, INTERNAL, INPUT, MISSED = 130, 1, 3, 4
_ORDER = (INTERNAL, USAGE, INPUT, MISSED, 0)
_OF_THE_ENGINE = {"bad_option": USAGE, "bad_input": INPUT, "bound_not_reached": MISSED, "not_certified": MISSED}
_WAIT_SECONDS = 0.1


class FileError(Exception):
    """A file cannot be used; the message is one line."""


class OutputError(Exception):
    """A result cannot be written; the message is one line."""


def main(argv):
    """The exit code."""
    with _ctrl_c_ends():
        try:
            kinds = presets.option_kinds()
            arguments = read_arguments(argv, kinds)
            if arguments.list_presets:
                print("\n".join(dict.fromkeys(preset.name for preset in presets.all_presets())))
                return 0
            options = _options(arguments)
            if arguments.point is not None and options.seams != "NEEDED":
                raise UsageError("--point is of --seams needed")
            for folder in {item.output.parent for item in arguments.items if item.output != item.source}:
                _make_folder(folder)
            codes = [_refine(item, options, arguments, at) for at, item in enumerate(arguments.items, 1)]
            return max((*codes, 0), key=_weight)
        except (UsageError, PresetError) as error:
            _complain(str(error))
            return USAGE
        except SystemExit as ended:  # --help
            return ended.code or 0
        except KeyboardInterrupt:
            _complain("stopped; what is done stays done")
            return INTERRUPTED
        finally:
            sys.stdout.flush()


def _complain(text):
    print(f"{PROGRAM}: {text}", file=sys.stderr, flush=True)


def _make_folder(folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{folder}: {_words(error)}") from None


def _options(arguments):
    return Options(**{**(presets.values_of(arguments.preset) if arguments.preset else {}), **arguments.options})


@contextmanager
def _ctrl_c_ends():
    """Ctrl-C raises KeyboardInterrupt here, also where Blender has a handler of its own."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before if before is not None else signal.SIG_DFL)


@contextmanager
def _ctrl_c_kills():
    """While Blender reads or writes a file no Python runs that could hear Ctrl-C. To be killed there harms nothing: a result has its
    name only once it is whole."""
    before = signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _refine(item, options, arguments, at):
    """Does one file, prints what came of it, and returns its exit code. Whatever goes wrong, the next one is done."""
    began = time.monotonic()
    asked = {"program": "atlas-refine", "version": engine.module.__version__, "options": asdict(options)}
    asked.update(objects=arguments.chosen, point=arguments.point)
    record = {**asked, "blender": bpy.app.version_string, "input": str(item.source), "output": str(item.output)}
    record.update(atlases=[], problems=[], left_out=[])  # of a file that fails as a whole too
    lines = []
    print(f"[{at}/{len(arguments.items)}] {item.source}", flush=True)
    try:
        if item.source.is_dir():
            raise FileError(f"it is a folder: name its files, as '{item.source.name}/*.blend'")
        if not item.source.is_file():
            raise FileError("there is no such file")
        record["input_sha256"] = sha256(*files.files_of(item.source))
        if not arguments.again and item.output.exists() and _was_done(item, record["input_sha256"], asked):
            print("  done already", flush=True)
            return 0
        code, lines = _refine_file(item, options, arguments, record)
    except Exception as error:  # of any kind: the other files are to be done all the same
        code = _code(error)
        record.update(status=FAILED, error=_words(error))
        _complain(f"{item.source}: {record['error']}")
    if "input_sha256" not in record:
        return code
    record["seconds"] = round(time.monotonic() - began, 3)
    for line in (record["status"], *lines):
        print(f"  {line}", flush=True)
    return max((code, _keep(item, record)), key=_weight)


def _was_done(item, source_hash, asked):
    return is_done(read_record(item.record), source_hash, asked, item.output == item.source)


def _weight(code):
    return -_ORDER.index(code)


def _code(error):
    if isinstance(error, engine.AtlasRefineError):
        return _OF_THE_ENGINE.get(error.code, INTERNAL)
    if isinstance(error, OutputError):
        return USAGE
    if isinstance(error, (FileError, files.UnreadableError, *tasks.FAILURES, OSError, MemoryError)):
        return INPUT
    traceback.print_exception(error)
    return INTERNAL


def _words(error):
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return plain(str(error)) or type(error).__name__


def _keep(item, record):
    """Writes the record; the exit code says whether it could be."""
    try:
        write_record(item.record, record)
    except OSError as error:
        _complain(f"{item.record}: {_words(error)}")
        return USAGE
    return 0


def _refine_file(item, options, arguments, record):
    """(exit code, lines) of a file; fills the record."""
    _open(item.source)
    objects, left_out = _chosen(arguments)
    with bpy.context.temp_override(active_object=objects[0], selected_objects=objects):
        run = _run_to_the_end(options, arguments.point)
        done = run.finish()
    done, problems = _parted(run, done)
    record["atlases"] = [atlas_record(one.title, one.result, one.told) for one in done]
    record["problems"] = [{"object": name, "message": plain(text)} for _, name, text in problems]
    record["left_out"] = left_out
    record["status"] = DONE if not problems else PARTLY if done else FAILED
    for problem in record["problems"]:
        _complain(f"{item.source}: {problem['object']}: {problem['message']}")
    if done:
        _save(item, any(one.result.intervention != "unchanged" for one in done))
        record["output_sha256"] = sha256(item.output)
    return max((0, *(code for code, _, _ in problems)), key=_weight), [line for one in done for line in _told(one)]


def _parted(run, done):
    """(the atlases of which something was refined, or was there already; (exit code, name, what is wrong) of all that was not)."""
    # What could not be read has no error of the engine's.
    codes = [INPUT] * (len(run.problems) - len(run.errors)) + [_code(error) for error in run.errors]
    problems = [(code, name, text) for code, (name, text) in zip(codes, run.problems, strict=True)]
    for one in done:
        if nothing_takes_part(one.result):
            problems.append((INPUT, one.title, f"no chart can be refined: {'; '.join(one.mended)}"))
        problems += [(MISSED, f"{one.title}, {name}", f"keeps its UVs: {reason}") for name, reason in groups_left(one.result)]
    return [one for one in done if not nothing_takes_part(one.result)], problems


def _told(done):
    yield f"{done.title}: {done.headline}"
    for note in (*done.told, *done.mended):
        yield f"{done.title}: {note}"


def _run_to_the_end(options, point):
    run = tasks.Run(bpy.context, *trade_off.picked(options, point))
    try:
        while not run.wait(_WAIT_SECONDS):
            pass
    except KeyboardInterrupt:
        run.stop()
        raise
    return run


def _open(source):
    with open(source, "rb"):  # for the system's own words where it cannot be read
        pass
    with _ctrl_c_kills():
        files.open_file(source)


def _chosen(arguments):
    """(mesh objects, those left out and why)."""
    meshes = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
    if arguments.selected:
        meshes = [obj for obj in meshes if obj.select_get()]
    elif arguments.objects:
        meshes = [obj for obj in meshes if any(fnmatchcase(obj.name, pattern) for pattern in arguments.objects)]
    if not meshes:
        which = " that is selected" if arguments.selected else " of such a name" if arguments.objects else ""
        raise FileError(f"there is no mesh object{which}")
    left_out = [{"object": obj.name, "message": parts.why_not(obj)} for obj in meshes if parts.why_not(obj)]
    usable = [obj for obj in meshes if not parts.why_not(obj)]
    if not usable:
        raise FileError("; ".join(f"{entry['object']}: {entry['message']}" for entry in left_out))
    return usable, left_out


def _save(item, is_changed):
    """Blender's file under another name, then in its place, so that what stands there is whole at all times."""
    if not is_changed and item.output == item.source:
        return
    target = item.output.resolve()  # a link stays one
    partial = partial_name(target)
    try:
        with _ctrl_c_kills():
            compress = is_compressed(item.source)
            bpy.ops.wm.save_as_mainfile(filepath=str(partial), check_existing=False, copy=True, compress=compress)
        shutil.copymode(item.source, partial)
        replace(partial, target)
    except RuntimeError as error:
        raise OutputError(f"Blender cannot save it: {' '.join(str(error).split())}") from None
    except OSError as error:
        raise OutputError(f"it cannot be saved: {_words(error)}") from None
    finally:
        with suppress(OSError):
            partial.unlink()


def register():
    versions.register_command(PROGRAM, main)


def unregister():
    versions.unregister_command(PROGRAM)
