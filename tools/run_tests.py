"""Runs every test suite and ends in a line that counts. A suite that does not report its counts has failed.

usage: run_tests.py --cache DIR [--all-blenders] [--only WORD]
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from dataclasses import dataclass, field

import blenders

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
RESULTS = BUILD / "test-results"


@dataclass
class Counts:
    passed: int = 0
    failed: int = 0
    skipped: list = field(default_factory=list)  # "test: reason"

    def __add__(self, other):
        return Counts(self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped)


def fresh(path):
    """A place for a result, without the one of an earlier run."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    return path


def run(command, **options):
    print("+", *map(str, command), flush=True)
    return subprocess.run(list(map(str, command)), cwd=ROOT, check=False, **options).returncode


def from_junit(path, exit_code):
    """The counts of a JUnit file; what does not add up is a failure."""
    if not path.exists():
        return Counts(failed=1)
    counts = Counts()
    for case in xml.etree.ElementTree.parse(path).iter("testcase"):
        skipped = case.find("skipped")
        if skipped is not None:
            counts.skipped.append(f"{case.get('classname')}.{case.get('name')}: {skipped.get('message')}")
        elif case.find("failure") is not None or case.find("error") is not None:
            counts.failed += 1
        else:
            counts.passed += 1
    if counts.failed == 0 and (exit_code != 0 or counts.passed == 0):
        counts.failed = 1
    return counts


def googletest():
    junit = fresh(RESULTS / "googletest.xml")
    jobs = str(os.cpu_count() or 1)
    code = run(["ctest", "--test-dir", BUILD, "--output-on-failure", "--no-tests=error", "-j", jobs, "--output-junit", junit])
    return from_junit(junit, code)


def pytest(folder):
    junit = fresh(RESULTS / f"{folder.name}.xml")
    paths = [folder] if folder != ROOT / "tests" else sorted(folder.glob("test_*.py"))
    return from_junit(junit, run([sys.executable, "-m", "pytest", "-q", "-rs", f"--junitxml={junit}", *paths]))


def from_json(path, exit_code):
    if not path.exists():
        return Counts(failed=1)
    counts = Counts(**json.loads(path.read_text()))
    if exit_code != 0 and counts.failed == 0:
        counts.failed = 1
    return counts


def in_blender(blender, cache):
    """Installs the zip into a new profile, as a user does, and runs each test file in a process of its own."""
    if not blender.can_be_had:
        return Counts(skipped=[f"{blender.name}: no Python 3.13 on this machine"])
    blender = blender.installed(cache)
    (archive,) = (ROOT / "dist").glob("atlas_refine-*.zip")
    with tempfile.TemporaryDirectory(prefix="atlas-refine-profile-") as profile:
        environment = {**os.environ, "BLENDER_USER_RESOURCES": profile}
        if run([*blender.script(ROOT / "blender_tests" / "install_addon.py"), archive], env=environment) != 0:
            return Counts(failed=1)
        counts = Counts()
        for test_file in sorted((ROOT / "blender_tests").glob("test_*.py")):
            result = fresh(RESULTS / blender.name.replace(" ", "-") / f"{test_file.stem}.json")
            code = run([*blender.script(ROOT / "blender_tests" / "run.py"), test_file, result], env=environment)
            counts += from_json(result, code)
        return counts


def in_window(blender):
    counts = Counts()
    for name, word in (("window", []), ("five-clicks", ["--five-clicks"])):
        result = fresh(RESULTS / f"{name}.json")
        script = ROOT / "blender_tests" / "window" / "run.py"
        counts += from_json(result, run([sys.executable, script, blender.executable, result, *word]))
    return counts


def suites(arguments):
    """(name, function) of everything there is to run."""
    yield "C++", googletest
    for folder in sorted({path.parent for path in (ROOT / "tests").rglob("test_*.py")}):
        yield f"pytest {folder.relative_to(ROOT)}", lambda folder=folder: pytest(folder)
    for blender in blenders.debian() + blenders.official(every=arguments.all_blenders):
        yield blender.name, lambda blender=blender: in_blender(blender, pathlib.Path(arguments.cache))
    for blender in blenders.debian():
        yield f"window of {blender.name}", lambda blender=blender: in_window(blender)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cache", required=True, help="where the official builds are installed")
    parser.add_argument("--all-blenders", action="store_true", help="every official build that can be had")
    parser.add_argument("--only", default="", help="only the suites whose name holds this word")
    arguments = parser.parse_args()
    table = []
    for name, function in suites(arguments):
        if arguments.only.lower() not in name.lower():
            continue
        print(f"\n=== {name}", flush=True)
        try:
            table.append((name, function()))
        except Exception as error:  # a suite that cannot start has failed, and the others still run
            print(f"{name}: {error}", flush=True)
            table.append((name, Counts(failed=1)))
    return summary(table)


def summary(table):
    total = sum((counts for _, counts in table), Counts())
    print()
    for name, counts in table:
        print(f"{name:36} {counts.passed:5} passed {counts.failed:5} failed {len(counts.skipped):5} skipped")
    for reason in total.skipped:
        print(f"skipped: {reason}")
    print(f"tests: {total.passed} passed, {total.failed} failed, {len(total.skipped)} skipped")
    return 1 if total.failed or total.passed == 0 else 0


if __name__ == "__main__":
    os.environ["PATH"] = "/usr/bin:/bin:" + os.environ["PATH"]
    shutil.rmtree(RESULTS, ignore_errors=True)
    sys.exit(main())
