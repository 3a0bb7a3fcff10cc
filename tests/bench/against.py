"""Two programs compared file by file: both run in turn on each, three times, and the checker measures what they wrote."""

import math
import statistics
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from measure_file import Row, measure_run, refine

WORSE = 0.0005  # of E_d: less is no difference
REPEATS = 3  # of each program on each file: the median of its times counts


@dataclass(frozen=True)
class Programs:
    """What is compared, and the further options that each is given."""

    old: Path
    new: Path
    old_options: tuple = ()
    new_options: tuple = ()


@dataclass(frozen=True)
class Pair:
    """One file at one goal."""

    old: Row
    new: Row

    @property
    def both_ok(self):
        return self.old.ok and self.new.ok

    @property
    def lost(self):
        return self.old.ok and not self.new.ok

    @property
    def difference(self):
        return self.new.e_d_checked - self.old.e_d_checked

    @property
    def worse(self):
        return self.both_ok and self.difference > WORSE

    @property
    def ratio(self):
        return self.new.cpu_seconds / self.old.cpu_seconds

    @property
    def name(self):
        return f"{self.new.folder}/{self.new.file}"

    def as_json(self):
        return {"old": self.old.as_json(), "new": self.new.as_json()}


def compare_file(programs, folder, mesh, goals):
    """One pair per goal."""
    sides = (("old", programs.old, programs.old_options), ("new", programs.new, programs.new_options))
    pairs = []
    with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
        for goal in goals:
            runs = [
                (program, Path(scratch) / f"{side}.obj", replace(goal, options=goal.options + options))
                for side, program, options in sides
            ]
            rows = [measure_run(program, folder, mesh, output, own)[0] for program, output, own in runs]
            times = [[row.cpu_seconds] for row in rows]
            for _ in range(REPEATS - 1):
                for (program, output, own), seconds in zip(runs, times, strict=True):
                    seconds.append(refine(program, mesh, output, own).cpu_seconds)
            pairs.append(Pair(*(replace(r, cpu_seconds=statistics.median(t)) for r, t in zip(rows, times, strict=True))))
    return pairs


def shown(value, form):
    return format(value, form) if math.isfinite(value) else "-"


COLUMNS = (
    ("file", lambda p: p.name[:44], "44"),
    ("bound", lambda p: p.new.goal, "14"),
    ("how old", lambda p: p.old.how, "9"),
    ("how new", lambda p: p.new.how, "9"),
    ("E_d old", lambda p: shown(p.old.e_d_checked, ".4f"), ">7"),
    ("E_d new", lambda p: shown(p.new.e_d_checked, ".4f"), ">7"),
    ("new-old", lambda p: shown(p.difference, "+.4f"), ">7"),
    ("PE old", lambda p: shown(p.old.pe, ".4f"), ">6"),
    ("PE new", lambda p: shown(p.new.pe, ".4f"), ">6"),
    ("BL+ old", lambda p: shown(100 * p.old.added_length, "z.1f"), ">7"),
    ("BL+ new", lambda p: shown(100 * p.new.added_length, "z.1f"), ">7"),
    ("cpu old", lambda p: shown(p.old.cpu_seconds, ".2f"), ">7"),
    ("cpu new", lambda p: shown(p.new.cpu_seconds, ".2f"), ">7"),
    ("ratio", lambda p: shown(p.ratio, ".2f"), ">5"),
    ("reason", lambda p: "; ".join(f"{name}: {r.reason}" for name, r in (("old", p.old), ("new", p.new)) if r.reason), ""),
)
NOTES = """old, new: the commit compared against, this tree. E_d: as the checker measures it. BL+: seams added / seams before, per cent. cpu: processor seconds
of the whole process, files included, one thread, the median of three runs of both programs in turn; ratio: new / old."""


def header():
    return "  ".join(f"{name:{form}}" for name, _, form in COLUMNS)


def line(pair):
    return "  ".join(f"{cell(pair):{form}}" for _, cell, form in COLUMNS).rstrip()


def mean_change(pairs, value, form):
    """'1.0100 -> 1.0099': the means over the files for which both have the value."""
    both = [(value(pair.old), value(pair.new)) for pair in pairs]
    both = [values for values in both if all(map(math.isfinite, values))]
    if not both:
        return "- -> -"
    return " -> ".join(format(statistics.fmean(side), form) for side in zip(*both, strict=True))


def group_lines(name, pairs):
    """Counts, then the means and times of the files that are valid and at the bound for both."""
    good = [pair for pair in pairs if pair.both_ok]
    counts = " -> ".join(str(sum(row.ok for row in rows)) for rows in zip(*((p.old, p.new) for p in pairs), strict=True))
    out = [f"  {name}: ok {counts} of {len(pairs)}"]
    if not good:
        return out
    worst = max(good, key=lambda pair: pair.difference)
    total = [sum(row.cpu_seconds for row in rows) for rows in zip(*((p.old, p.new) for p in good), strict=True)]
    out.append(
        f"    means of {len(good)}: E_d {mean_change(good, lambda r: r.e_d_checked, '.4f')}"
        f"; PE {mean_change(good, lambda r: r.pe, '.4f')}; BL+ {mean_change(good, lambda r: 100 * r.added_length, 'z.1f')} %"
    )
    out.append(
        f"    E_d worse by more than {WORSE}: {sum(p.worse for p in good)}, better: {sum(p.difference < -WORSE for p in good)}"
        f"; worst difference {worst.difference:+.4f} ({worst.name})"
    )
    out.append(
        f"    processor time, new / old: median {statistics.median(p.ratio for p in good):.3f}"
        f", total {total[1] / total[0]:.3f} ({total[0]:.1f} s -> {total[1]:.1f} s)"
    )
    return out


def summary(pairs):
    """For each road and bound: every folder, all folders, and by name what is no longer valid or is worse."""
    out = []
    for goal in dict.fromkeys(pair.new.goal for pair in pairs):
        at_goal = [pair for pair in pairs if pair.new.goal == goal]
        folders = dict.fromkeys(pair.new.folder for pair in at_goal)
        out.append(goal)
        for folder in folders:
            out += group_lines(folder, [pair for pair in at_goal if pair.new.folder == folder])
        if len(folders) > 1:
            out += group_lines("all", at_goal)
        out += [f"  no longer valid and at the bound: {p.name}: {p.new.reason}" for p in at_goal if p.lost]
        out += [f"  worse: {p.name}: E_d {p.difference:+.4f}" for p in at_goal if p.worse]
    return out


def markdown(title, pairs, lines):
    out = [title, "", "| " + " | ".join(name for name, _, _ in COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    out += ["| " + " | ".join(cell(pair).replace("|", "/") for _, cell, _ in COLUMNS) + " |" for pair in pairs]
    return "\n".join([*out, "", NOTES, "", "```", *lines, "```", ""])
