"""What packing efficiency costs where nothing is cut: the other half of a trade-off."""

from typing import Any

from numpy.typing import ArrayLike

from ._atlas_refine import refine

BOUNDS = (0.60, 0.65, 0.70, 0.75, 0.80, 0.85, 0.90, 0.95)


def packing_curve(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    bounds: tuple[float, ...] = BOUNDS,
    **options: Any,
) -> list[tuple[float, float]]:
    """E_d without cuts at one bound after the other, as far as these are reached: pairs (bound, E_d).

    Options are those of refine() that are neither of the bound nor of cuts or their limits; it is one run for each bound.
    What holds a bound holds those below it too, so E_d never falls.
    """
    mesh = (positions, face_offsets, corner_vertices, corner_uvs)
    out: list[tuple[float, float]] = []
    for bound in sorted(bounds):
        result = refine(*mesh, pe_bound=bound, best_effort=True, relax=True, **options)
        if result.bound_met:
            out.append((bound, result.after.distortion))
    for k in range(len(out) - 1, 0, -1):
        out[k - 1] = (out[k - 1][0], min(out[k - 1][1], out[k][1]))
    return out
