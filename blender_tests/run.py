"""Runs one test file inside Blender and writes its counts: after `--`, the file and the JSON to write.

blender -b --factory-startup --python-exit-code 1 --python blender_tests/run.py -- FILE RESULT.json
python3 blender_tests/run.py -- FILE RESULT.json          (with the bpy module)
"""

import json
import os
import pathlib
import sys
import unittest

import bpy  # the bpy module must come first: it makes addon_utils and bmesh importable

HERE = pathlib.Path(__file__).resolve().parent


def main(test_file, result_file):
    sys.path[:0] = [str(HERE), str(HERE.parent / "tests" / "python")]
    suite = unittest.defaultTestLoader.loadTestsFromName(pathlib.Path(test_file).stem)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
    bad = len(result.failures) + len(result.errors)
    skipped = [f"{test.id()}: {reason}" for test, reason in result.skipped]
    counts = {"passed": result.testsRun - bad - len(skipped), "failed": bad, "skipped": skipped}
    pathlib.Path(result_file).write_text(json.dumps(counts))
    sys.stdout.flush()
    code = 1 if bad or result.testsRun == 0 else 0
    if bpy.app.version[:2] == (4, 2):
        # The bpy module 4.2 crashes when Python ends, once any script, ours or not, gave it a function (a handler, a getter).
        os._exit(code)
    sys.exit(code)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
