# SPDX-License-Identifier: GPL-3.0-or-later
"""A result's figures in words."""


def headline(result):
    """One line for the status bar: what was done, PE and E_d before and after, and BL, the seams' length, where it was cut."""
    before, after = result.before, result.after
    seams = "" if result.cut is None else f", BL {before.boundary_length:.3f} -> {after.boundary_length:.3f}"
    return (
        f"{result.intervention.capitalize()}: PE {before.pe_fixed_aspect:.3f} -> {after.pe_fixed_aspect:.3f}, "
        f"E_d {before.distortion:.4f} -> {after.distortion:.4f}{seams}"
    )


def figures(result, face_count):
    """(name, before, after) rows for the panel; short names, for the column is narrow. `face_count` is the input's."""
    before, after = result.before, result.after
    return [
        ("PE", f"{before.pe_fixed_aspect:.3f}", f"{after.pe_fixed_aspect:.3f}"),
        ("E_d", f"{before.distortion:.4f}", f"{after.distortion:.4f}"),
        ("Stretch", f"{before.stretch_99:.3f}", f"{after.stretch_99:.3f}"),
        ("Gap", _percent(before.gap_between), _percent(after.gap_between)),
        ("Charts", str(before.chart_count), str(after.chart_count)),
        ("Seams", str(before.seam_edges), str(after.seam_edges)),
        ("BL", f"{before.boundary_length:.3f}", f"{after.boundary_length:.3f}"),
        ("Faces", str(face_count), str(faces_after(result, face_count))),
    ]


def faces_after(result, face_count):
    return face_count if result.cut is None else len(result.cut.face_sources)


def _percent(fraction):
    return "-" if fraction == float("inf") else f"{100 * fraction:.2f} %"
