"""Runs a command and writes its processor time and peak memory to a file, as JSON.

usage: run_measured.py FIGURES COMMAND...

A process of its own, and a small one: a program's peak is never less than that of the process that started it.
"""

import json
import os
import sys


def main(figures, *command):
    pid = os.posix_spawn(command[0], command, os.environ)
    _, status, usage = os.wait4(pid, 0)
    with open(figures, "w") as file:
        json.dump({"cpu_seconds": usage.ru_utime + usage.ru_stime, "peak_bytes": usage.ru_maxrss * 1024}, file)
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
