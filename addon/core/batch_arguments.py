# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of the headless script: files, options and where results go (docs/headless.md)."""

import argparse
import glob
import os
import pathlib
from dataclasses import dataclass, field

from .file_kinds import IMPORTERS, is_imported, result_name

PROGRAM = "atlas_refine"
USAGE = 2


class UsageError(Exception):
    """The message is one line."""


@dataclass(frozen=True)
class Item:
    """A file to refine and what comes of it; output is the input itself with --in-place."""

    source: pathlib.Path
    output: pathlib.Path

    @property
    def record(self):
        return self.output.with_name(f"{self.output.stem}.{PROGRAM}.json")


@dataclass(frozen=True)
class Arguments:
    items: list
    preset: str
    options: dict = field(default_factory=dict)  # given explicitly
    objects: tuple = ()  # patterns of names; empty: all
    selected: bool = False
    again: bool = False
    list_presets: bool = False
    point: int | None = None  # of the trade-off; None: what the limits ask for

    @property
    def chosen(self):
        """In words, for the record."""
        return "selected" if self.selected else list(self.objects) or "all"


def read_arguments(argv, kinds):
    """Arguments; UsageError for what is not understood. SystemExit(0) after --help."""
    parsed = _parser(kinds).parse_args(argv)
    options = {name: getattr(parsed, name) for name in kinds if hasattr(parsed, name)}
    if parsed.list_presets:
        return Arguments([], "", list_presets=True)
    if parsed.objects and parsed.selected:
        raise UsageError("--object and --selected exclude each other")
    if bool(parsed.output) == parsed.in_place:
        raise UsageError("one of -o DIR and --in-place says where results go")
    items = _share(_items(_expand(parsed.files), parsed.output), parsed.shard)
    chosen = {"objects": tuple(parsed.objects), "selected": parsed.selected, "point": parsed.point}
    return Arguments(items, parsed.preset, options, again=parsed.again, **chosen)


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise UsageError(message)


def _parser(kinds):
    # No abbreviations: one that is plain today would be ambiguous once there is another option.
    parser = _Parser(
        prog=PROGRAM, description=f"Refines the UV maps of .blend, {', '.join(IMPORTERS)} files.", allow_abbrev=False
    )
    parser.add_argument("files", nargs="*", metavar="FILE", help="files, or patterns as 'scenes/**/*.blend'")
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="folder for the results, .blend files by the files' names; made where missing"
    )
    parser.add_argument("--in-place", action="store_true", help="the files themselves become the results")
    parser.add_argument("--preset", default="", metavar="NAME", help="options of that preset, unless they are given as well")
    parser.add_argument("--list-presets", action="store_true", help="print the names of the presets there are, and end")
    parser.add_argument(
        "--object",
        dest="objects",
        action="append",
        default=[],
        metavar="NAME",
        help="only objects of that name, "
        "or pattern; may be given several times. Without it all mesh objects of the scene that have a UV map",
    )
    parser.add_argument("--selected", action="store_true", help="only objects that are selected in the file")
    parser.add_argument("--shard", type=_shard, default=(1, 1), metavar="I/N", help="only each N-th file, from the I-th on")
    parser.add_argument(
        "--point", type=_point, metavar="K", help="with needed seams: line K of the trade-off, from 0 on, whatever the limits"
    )
    parser.add_argument("--again", action="store_true", help="refine files anew that are done already")
    group = parser.add_argument_group("options of a refinement")
    for kind in kinds.values():
        _add_option(group, kind)
    return parser


def _add_option(group, kind):
    flag, text = f"--{kind.name.replace('_', '-')}", kind.description.replace("%", "%%")
    if isinstance(kind.default, bool):
        group.add_argument(flag, action=argparse.BooleanOptionalAction, default=argparse.SUPPRESS, help=text)
        return
    shown = "|".join(kind.choices).lower() or type(kind.default).__name__.upper()
    group.add_argument(flag, type=_reader(kind), default=argparse.SUPPRESS, metavar=shown, help=text)


def _reader(kind):
    def read(text):
        try:
            return kind.parsed(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None

    return read


def _shard(text):
    first, slash, count = text.partition("/")
    if not (slash and first.isdecimal() and count.isdecimal() and 1 <= int(first) <= int(count)):
        raise argparse.ArgumentTypeError(f"I/N with 1 <= I <= N, not {text!r}")
    return int(first), int(count)


def _point(text):
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"a whole number from 0 on, not {text!r}")
    return int(text)


def _expand(patterns):
    """Files in a fixed order, each once. A name without a match stays, to be reported when its turn comes."""
    found = []
    for pattern in patterns:
        if os.path.exists(pattern) or not glob.has_magic(pattern):
            found.append(pattern)
            continue
        matches = [path for path in glob.glob(pattern, recursive=True) if not os.path.isdir(path)]
        if not matches:
            raise UsageError(f"no file fits {pattern}")
        found += matches
    if not found:
        raise UsageError("no file is named")
    return sorted({os.path.abspath(path) for path in found})


def _items(paths, output):
    if not output:
        return [Item(path, path) for path in map(_no_import, paths)]
    folder = os.path.abspath(output)
    # What lies in the folder is an earlier run's, where a pattern reaches there.
    items = [Item(path, pathlib.Path(folder, result_name(path))) for path in map(pathlib.Path, paths) if not _is_in(path, folder)]
    if not items:
        raise UsageError(f"every file lies in the output folder {output}; --in-place is for that")
    by_output = {}
    for item in items:
        other = by_output.setdefault(item.output, item)
        if other is not item:
            raise UsageError(f"{other.source} and {item.source} would both become {item.output}")
    return items


def _no_import(path):
    if is_imported(path):
        raise UsageError(
            f"{path}: --in-place is for .blend files; the result of this one is such a file, too: name a folder with -o"
        )
    return pathlib.Path(path)


def _is_in(path, folder):
    return os.path.realpath(path).startswith(os.path.join(os.path.realpath(folder), ""))


def _share(items, shard):
    first, count = shard
    return items[first - 1 :: count]
