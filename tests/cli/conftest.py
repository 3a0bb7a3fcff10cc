"""The built program as a fixture: ATLAS_REFINE_BIN, or build/atlas-refine."""

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Program:
    path: Path

    def __call__(self, *arguments, timeout=900):
        command = [self.path, *arguments]
        return subprocess.run(command, capture_output=True, timeout=timeout, check=False)

    def refused(self, code, *arguments):
        """Runs, checks the exit code and that stderr is one line `atlas-refine: <thing>: <what>`; returns the line."""
        run = self(*arguments)
        message = run.stderr.decode(errors="replace")
        assert run.returncode == code, message
        assert message.startswith("atlas-refine: ")
        assert message.count("\n") == 1
        assert message.endswith("\n")
        assert message.count(": ") >= 2
        assert run.stdout == b""
        return message.rstrip("\n")


@pytest.fixture(scope="session")
def program():
    path = Path(os.environ.get("ATLAS_REFINE_BIN", REPOSITORY / "build" / "atlas-refine"))
    assert path.is_file(), f"{path} is not built; run ./dev build"
    return Program(path)
