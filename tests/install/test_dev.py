"""./dev on machines that lack something: no git, no home, a tree that was moved or is read-only, packages to be installed.

The tools that it calls are scripts that write down how they were called, but for git and, where said so, cmake.
"""

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
RUFF = re.search(r"^RUFF=(.+)$", (REPOSITORY / "dev").read_text(), re.MULTILINE).group(1)
NOBODY = 65534

TOOLS = {
    "dpkg-query": 'case " $MISSING " in *" ${@: -1} "*) exit 1 ;; *) echo installed ;; esac',
    "clang-format": '(($#)) && printf "clang-format %s\\n" "$*" >>"$LOG" && ! grep -ls "  badly" "${@:3}"',
    "clang-tidy": 'echo "clang-tidy $*" >>"$LOG"',
    "cmake": 'echo "cmake $* cache=$XDG_CACHE_HOME" >>"$LOG"; mkdir -p build && touch build/atlas-refine',
    "ccache": '"$@"',
}


class Tree:
    """A small source tree with the real ./dev, without git."""

    def __init__(self, folder):
        self.outside = folder
        self.root = folder / "tree"
        self.log = folder / "log"
        (self.root / "native").mkdir(parents=True)
        (self.root / "tools").mkdir()
        shutil.copy(REPOSITORY / "dev", self.root)
        (self.root / "native" / "one.cpp").write_text("int one;\n")
        (self.root / "native" / "one.h").write_text("extern int one;\n")
        (self.root / "tools" / "two.py").write_text("two = 2\n")
        self.tool = folder / "bin"
        self.tool.mkdir()
        for name, text in TOOLS.items():
            self.script(name, text)
        self.cache = folder / "home" / ".cache"
        self.install_ruff(self.cache)
        self.environment = {
            **os.environ,
            "PATH": f"{self.tool}:/usr/bin:/bin",
            "HOME": str(folder / "home"),
            "LOG": str(self.log),
        }
        for name in ("XDG_CACHE_HOME", "TMPDIR", "GIT_DIR", "GIT_WORK_TREE"):
            self.environment.pop(name, None)

    def script(self, name, text):
        path = self.tool / name
        path.write_text(f"#!/bin/bash\n{text}\n")
        path.chmod(0o755)

    def install_ruff(self, cache):
        ruff = cache / "atlas-refine" / RUFF / "bin" / "ruff"
        ruff.parent.mkdir(parents=True)
        ruff.write_text('#!/bin/bash\necho "ruff $*" >>"$LOG"\n')
        ruff.chmod(0o755)
        ruff.parents[1].joinpath("complete").touch()

    def __call__(self, *arguments, **options):
        """Runs ./dev with a standard input that never ends."""
        reader, writer = os.pipe()
        try:
            return subprocess.run(
                [self.root / "dev", *arguments],
                env=self.environment,
                cwd="/",
                stdin=reader,
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
                **options,
            )
        finally:
            os.close(reader)
            os.close(writer)

    def calls(self, tool):
        lines = self.log.read_text().splitlines() if self.log.exists() else []
        return [line.split()[1:] for line in lines if line.startswith(f"{tool} ")]

    def refuses(self, *arguments, **options):
        """Runs, checks that it fails with one line, and returns the line."""
        done = self(*arguments, **options)
        assert done.returncode == 1, done.stdout + done.stderr
        assert done.stderr.startswith("dev: ")
        assert done.stderr.count("\n") == 1, done.stderr
        return done.stderr

    def git(self, *arguments):
        identity = ["-c", "user.name=nobody", "-c", "user.email=nobody@localhost"]
        subprocess.run(["git", *identity, *arguments], cwd=self.root, env=self.environment, check=True, capture_output=True)

    def become_repository(self):
        (self.root / ".gitignore").write_text("/build*/\n")
        self.git("init", "-q", "-b", "main")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "all")
        self.git("update-ref", "refs/remotes/origin/main", "main")


@pytest.fixture
def tree():
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        yield Tree(Path(folder))


def names(calls):
    """The files among the arguments of several calls."""
    return sorted(Path(word).name for call in calls for word in call if word.endswith((".cpp", ".h", ".py")))


def test_lint_of_a_tarball_checks_what_is_there(tree):
    for folder in ("build", "build-address", "out", "dist", ".venv"):
        (tree.root / folder).mkdir()
        (tree.root / folder / "built.cpp").write_text("int  badly;\n")
        (tree.root / folder / "built.py").write_text("")
    done = tree("lint", "--format")
    assert done.returncode == 0, done.stderr
    assert names(tree.calls("clang-format")) == ["one.cpp", "one.h"]
    assert names(tree.calls("ruff")) == ["two.py", "two.py"]
    assert "2 files" in done.stdout
    assert "1 files" in done.stdout


def test_lint_of_a_tarball_finds_what_is_wrong(tree):
    (tree.root / "native" / "wrong.cpp").write_text("int  badly;\n")
    done = tree("lint", "--format")
    assert done.returncode == 1
    assert "wrong.cpp" in done.stdout
    assert "clean" not in done.stdout


def test_a_tarball_inside_a_repository_of_someone_else_is_no_repository(tree):
    subprocess.run(["git", "init", "-q", tree.outside], check=True, env=tree.environment)
    (tree.outside / ".gitignore").write_text("*\n")
    assert tree("lint", "--format").returncode == 0
    assert names(tree.calls("clang-format")) == ["one.cpp", "one.h"]


def test_lint_fails_where_there_is_nothing_to_check(tree):
    shutil.rmtree(tree.root / "native")
    assert "0 C++ and 1 Python files" in tree.refuses("lint", "--format")
    assert tree.calls("clang-format") == []


def test_lint_tidies_everything_where_there_is_nothing_to_compare_with(tree):
    done = tree("lint")
    assert done.returncode == 0, done.stderr
    assert names(tree.calls("clang-tidy")) == ["one.cpp"]
    assert "clang-tidy: 1 files, all of them" in done.stdout


def test_lint_of_a_fresh_clone_tidies_everything(tree):
    tree.become_repository()
    assert tree("lint").returncode == 0
    assert names(tree.calls("clang-tidy")) == ["one.cpp"]


def test_lint_of_a_branch_tidies_what_differs(tree):
    (tree.root / "native" / "gone.cpp").write_text("")
    tree.become_repository()
    (tree.root / "native" / "new.cpp").write_text("")
    (tree.root / "native" / "gone.cpp").unlink()
    done = tree("lint")
    assert done.returncode == 0, done.stderr
    assert names(tree.calls("clang-format")) == ["new.cpp", "one.cpp", "one.h"]
    assert names(tree.calls("clang-tidy")) == ["new.cpp"]
    assert "1 files, those that differ from origin/main" in done.stdout
    tree.log.unlink()
    assert tree("lint", "--all").returncode == 0
    assert names(tree.calls("clang-tidy")) == ["new.cpp", "one.cpp"]


def test_without_a_home_the_cache_is_in_the_build_folder(tree):
    del tree.environment["HOME"]
    tree.install_ruff(tree.root / "build" / "cache")
    done = tree("build")
    assert (done.returncode, done.stderr) == (0, "")
    assert {call[-1] for call in tree.calls("cmake")} == {f"cache={tree.root}/build/cache"}
    assert tree("lint", "--format").returncode == 0


def test_a_home_that_cannot_be_written(tree):
    tree.environment["HOME"] = "/proc/no/such/home"
    done = tree("build")
    assert (done.returncode, done.stderr) == (0, "")
    assert {call[-1] for call in tree.calls("cmake")} == {f"cache={tree.root}/build/cache"}


def test_a_tree_that_cannot_be_written(tree):
    (tree.root / "build").write_text("a file where a folder should be")
    assert f"{tree.root}/build cannot be written" in tree.refuses("build")
    assert tree.calls("cmake") == []
    tree.environment["HOME"] = "/proc/no/such/home"
    assert "XDG_CACHE_HOME" in tree.refuses("build")


def test_a_read_only_tree_of_someone_else(tree):
    """Whoever may write everywhere becomes a user who may not."""
    other = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}
    for path in [tree.root, *tree.root.rglob("*")]:
        path.chmod(0o555)
    tree.log.touch()
    for path in (tree.log, tree.cache / "atlas-refine"):
        path.chmod(0o777)
    try:
        assert f"{tree.root}/build cannot be written" in tree.refuses("build", **other)
        assert tree.calls("cmake") == []
        assert tree("lint", "--format", **other).returncode == 0
        assert names(tree.calls("clang-format")) == ["one.cpp", "one.h"]
    finally:
        for path in [tree.root, *tree.root.rglob("*")]:
            path.chmod(0o755)


PROJECT = """cmake_minimum_required(VERSION 3.25)
project(moved LANGUAGES NONE)
add_custom_target(atlas-refine COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_SOURCE_DIR}/native/one.cpp ${CMAKE_BINARY_DIR}/atlas-refine)
add_custom_target(atlas_refine_python)
"""


def test_a_tree_that_was_moved_is_configured_anew(tree):
    """With the real cmake and the real presets."""
    (tree.tool / "cmake").unlink()
    shutil.copy(REPOSITORY / "CMakePresets.json", tree.root)
    (tree.root / "CMakeLists.txt").write_text(PROJECT)
    assert "anew" not in tree("build").stdout
    old, tree.root = tree.root, tree.root.rename(tree.outside / "moved")
    done = tree("build")
    assert done.returncode == 0, done.stderr
    assert f"build/ was configured in {old}: configuring it anew\n" in done.stdout
    assert "CMake Error" not in done.stderr
    assert "anew" not in tree("build").stdout


APT = r"""
echo "apt-get $*" >>"$LOG"
[[ $* == *install* ]] || { echo "Hit:1 somewhere"; exit; }
echo "1 upgraded, 1 newly installed, 0 to remove and 7 not upgraded."
if [[ ${NETWORK:-} == none ]]; then
  echo "E: Unable to fetch some archives"; echo "E: and another line"; exit 100
fi
echo "Get:1 http://somewhere first 1.0"
sleep 2.1
echo "Get:2 http://somewhere second 1.0"
sleep 2.1
echo "Unpacking first (1.0) ..."
sleep 6
echo "Setting up first (1.0) ..."
"""


def test_installing_packages_shows_that_it_lives(tree):
    tree.script("apt-get", APT)
    tree.script("sudo", '"$@"')
    tree.environment["MISSING"] = "cmake ninja-build"
    done = tree("build")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("installing cmake ninja-build\n")
    shown = [line.strip() for line in done.stdout.splitlines() if line.startswith("  ")]
    assert shown[:2] == ["1 of 2: Get:1 http://somewhere first 1.0", "2 of 2: Get:2 http://somewhere second 1.0"]
    assert shown[2:4] == ["1 of 2: Unpacking first (1.0) ...", "still at work: 1 of 2: Unpacking first (1.0) ..."]
    assert tree.calls("apt-get")[-1][-2:] == ["cmake", "ninja-build"]


def test_packages_that_cannot_be_had(tree):
    tree.script("apt-get", APT)
    tree.script("sudo", '"$@"')
    tree.environment |= {"MISSING": "cmake", "NETWORK": "none"}
    assert tree.refuses("build") == "dev: apt-get install failed: E: Unable to fetch some archives\n"
    assert tree.calls("cmake") == []


def test_help_needs_nothing(tree):
    tree.environment.pop("HOME")
    shown = {command: tree(command) for command in ("--help", "-h", "help")}
    assert {done.returncode for done in shown.values()} == {0}
    for command in ("demo", "build", "test", "bench", "lint", "sanitize", "package", "wheel", "install"):
        assert f"\n  {command} " in shown["--help"].stdout
    assert tree("nonsense").returncode == 2
    assert tree().returncode == 2
    assert not (tree.root / "build").exists()
