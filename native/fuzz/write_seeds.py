#!/usr/bin/env python3
"""What the fuzz targets start from: OBJ texts of every dialect, and bytes that are meshes with options.

usage: write_seeds.py FOLDER     writes FOLDER/fuzz_obj/ and FOLDER/fuzz_refine/
"""

import random
import sys
from pathlib import Path

QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
NORMALS = "vn 0 0 1\nvn 0 1 0\n"
OBJ_TEXTS = (
    QUAD + "f 1/1 2/2 3/3 4/4\n",
    QUAD + "f -4/-4 -3/-3 -2/-2\nf 1/1 3/3 4/4",
    QUAD + NORMALS + "f 1/1/1 2/2/1 3/3/2\nf 1/1/1 3/3/2 4/4/2\n",
    QUAD + "f 1/1 1/1 2/2 3/3 3/3 4/4 1/1\nf 1 2 3\nf 1/1 2/2\nf 1/1 2/2 3/3 1/1 4/4\n",
    QUAD.replace("\n", "\r\n") + "f 1/1 2/2 \\\r\n 3/3 4/4 # end\r\n",
    QUAD.replace("v 1 1 0", "v 2 2 0 2").replace("v 0 1 0", "v 0 1 0 .5 .25 1") + "f 1/1 2/2 3/3 4/4\n",
    "\ufeff# text\nmtllib a.mtl\no one\ng a b\nusemtl red\ns 1\n" + QUAD + "l 1/1 2/2\np 1 -1\nf 1/1 2/2 3/3 4/4\n",
    "f 1/1 2/2 3/3\n" + QUAD + "vt nan 0\nvt 0.5\nvt 1e400 -1e-400 0\nf 1/5 2/2 3/3\nf 1/6 2/2 3/3\n",
    "glTF",
    "ply\n",
    "solid x\nfacet\n",
    "\xff\xfe",
    '{"asset":{}}',
)
REFINE_SEEDS = 24  # of each kind


def small_mesh(rng):
    """Few bytes: what they leave open is as small and as plain as it can be."""
    return rng.randbytes(rng.randint(4, 40))


def options_of_grid(rng):
    """Any options, of one small grid: a packing of several charts would take a second. Numbers are taken from the end on."""
    one_part, grid, undamaged = 0, 0, 0
    columns, rows = rng.randint(0, 2), rng.randint(0, 2)  # beyond the first
    hole = rng.randint(0, (columns + 1) * (rows + 1))
    taken = [one_part, grid, columns, rows, hole, *rng.randbytes(3), undamaged]
    return rng.randbytes(60) + bytes(reversed(taken))


def write(folder, name, content):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(content)


def main(root):
    for k, text in enumerate(OBJ_TEXTS):
        write(root / "fuzz_obj", f"seed{k}", text.encode())
    rng = random.Random(1)
    for k in range(REFINE_SEEDS):
        write(root / "fuzz_refine", f"seed{2 * k}", small_mesh(rng))
        write(root / "fuzz_refine", f"seed{2 * k + 1}", options_of_grid(rng))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
