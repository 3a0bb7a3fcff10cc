"""Finds the package in build/python, or where ATLAS_REFINE_PYTHON says, and the add-on's core."""

import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, os.environ.get("ATLAS_REFINE_PYTHON", str(ROOT / "build" / "python")))
sys.path.insert(0, str(ROOT / "addon"))
