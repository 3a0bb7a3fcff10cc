# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON beside each result of the headless script: what was done, and by which a later run knows that it is done."""

import hashlib
import json
import os
from contextlib import suppress

#: What a record says of its file.
DONE, PARTLY, FAILED = "done", "partly", "failed"

#: Of a result's as_dict(), in the words of docs/report.schema.json.
_OF_A_RESULT = (
    "intervention",
    "bound_met",
    "before",
    "after",
    "boundary_growth",
    "gap",
    "price",
    "iterations",
    "ended",
    "triangulations",
    "groups",
    "cuts",
    "repairs",
    "fallbacks",
    "warnings",
    "timings",
)
#: These do not change a result.
_NOT_COMPARED = ("threads",)


def atlas_record(title, result, notes):
    held = result.as_dict()
    return {
        "name": title,
        **{name: held[name] for name in _OF_A_RESULT},
        "added_seam_edges": held["added_seams"],
        "notes": list(notes),
    }


def is_done(record, source_hash, asked, in_place):
    """Whether an earlier run did just this. `asked`: what identifies a run, as it is in the record."""
    if not isinstance(record, dict) or record.get("status") != DONE:
        return False
    # A file that was refined in place is by now its own result.
    known = record.get("output_sha256" if in_place else "input_sha256")
    return source_hash == known and all(_comparable(record.get(name)) == _comparable(value) for name, value in asked.items())


def _comparable(value):
    if isinstance(value, dict):
        return {name: held for name, held in value.items() if name not in _NOT_COMPARED}
    return value


def read_record(path):
    """None where there is none that can be read."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def write_record(path, record):
    """Whole or not at all."""
    text = json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    partial = partial_name(path)
    try:
        partial.write_text(text, encoding="utf-8")
        replace(partial, path)
    finally:
        with suppress(OSError):
            partial.unlink()


def partial_name(path):
    """Where a file is written before it takes its name: beside it, since only there a rename is one step. Fixed, so that a run that
    was killed leaves no more than one."""
    return path.with_name(f".{path.stem}.partial{path.suffix}")


def replace(partial, path):
    """Gives a written file its name, once it is on the disk."""
    with open(partial, "rb") as file:
        os.fsync(file.fileno())
    os.replace(partial, path)


def sha256(*paths):
    """Of what the files hold, one after the other."""
    digest = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            while block := file.read(1 << 20):
                digest.update(block)
    return digest.hexdigest()


def is_compressed(path):
    """Whether a .blend file is: by gzip, until 2.9x, or by Zstandard."""
    with open(path, "rb") as file:
        return file.read(4).startswith((b"\x1f\x8b", b"\x28\xb5\x2f\xfd"))
