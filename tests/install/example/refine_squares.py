"""Two squares that lie far apart in the UV map are brought to a packing efficiency of 0.9; prints the result as JSON."""

import json

import atlas_refine
import numpy as np
from numpy.typing import NDArray


def squares() -> tuple[NDArray[np.float64], list[int], NDArray[np.int64], NDArray[np.float64]]:
    """positions, face_offsets, corner_vertices, corner_uvs"""
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    positions = np.zeros((8, 3))
    positions[:, :2] = np.concatenate([square, square + [2.0, 0.0]])
    return positions, [0, 4, 8], np.arange(8), np.concatenate([square, square + 7.0])


def show(progress: atlas_refine.Progress) -> bool:
    """Called several times a second; False would cancel."""
    return progress.fraction <= 1.0


def main() -> None:
    arrays = squares()
    result = atlas_refine.refine(*arrays, pe_bound=0.9, density="keep", progress=show)
    uvs: NDArray[np.float64] = result.corner_uvs
    before: float = result.before.pe
    validity = atlas_refine.validate(*arrays[:3], uvs)
    assert validity.valid, validity.problem
    assert before < 0.9 <= atlas_refine.measure(*arrays[:3], uvs).pe
    if result.cut is not None:
        print(result.cut.new_vertex_weights.shape)
    job = atlas_refine.start(*arrays, pe_bound=0.9, density="keep")
    assert job.wait(timeout=None)
    assert np.array_equal(job.result().corner_uvs, uvs)
    print(json.dumps(result.as_dict()))


if __name__ == "__main__":
    main()
