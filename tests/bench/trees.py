"""Built programs to measure: this tree's, and that of another commit in a worktree of its own."""

import os
import shutil
import subprocess
from pathlib import Path

PROGRAM, HELPER = "atlas-refine", "atlas_refine_bench"
PYTHON = "atlas_refine_python"  # a target, not a file


class TreeError(Exception):
    """A tree cannot be had or built; the message is one line."""


def run(command, what, **options):
    done = subprocess.run(list(map(str, command)), check=False, **options)
    if done.returncode:
        raise TreeError(f"{what}: {' '.join(map(str, command))}: exit {done.returncode}")
    return done


def git(root, *arguments):
    done = subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise TreeError(f"git {' '.join(map(str, arguments))}: {done.stderr.strip().splitlines()[-1]}")
    return done.stdout.strip()


def tree_of(commit, root, cache):
    """The files of `commit` of the repository at `root`, in a worktree under `cache` that is used again."""
    sha = git(root, "rev-parse", "--verify", f"{commit}^{{commit}}")
    tree = Path(cache) / "commits" / sha[:12]
    if not (tree / ".git").exists():
        git(root, "worktree", "prune")
        git(root, "worktree", "add", "--detach", tree, sha)
    return tree


def require_built(folder, *targets):
    for target in targets:
        if not (folder / target).is_file():
            raise TreeError(f"{folder / target} is not built")


def build(tree, configure, targets):
    """Builds `targets` with ccache where it is installed; the build folder. What cmake and the compiler say goes to stderr."""
    environment = {**os.environ, "CCACHE_BASEDIR": os.environ.get("CCACHE_BASEDIR", str(tree))}
    if shutil.which("ccache"):
        environment["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    run(["cmake", *configure], "configuring", cwd=tree, env=environment, stdout=subprocess.DEVNULL)
    run(["cmake", "--build", "build", "--target", *targets], "building", cwd=tree, env=environment, stdout=2)
    require_built(tree / "build", *targets)
    return tree / "build"


def build_own(root, *more):
    found = build(root, ["--preset", "release"], [PROGRAM, HELPER])
    if more:
        run(["cmake", "--build", "build", "--target", *more], "building", cwd=root, stdout=2)
    return found


def build_commit(commit, root, cache):
    """Only the program; presets and options of the commit do not matter as far as it has them."""
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DATLAS_REFINE_BUILD_TESTS=OFF", "-DATLAS_REFINE_BUILD_PYTHON=OFF"]
    return build(tree_of(commit, root, cache), ["-S", ".", "-B", "build", "-G", "Ninja", *options], [PROGRAM])
