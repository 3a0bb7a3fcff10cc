#!/usr/bin/env python3
"""Checks a refined OBJ against its input without using the library: file kept, no new seam, valid, PE, gap, distortion.

    check_atlas.py IN.obj OUT.obj [--pe-bound B] [--aspect W:H] [--gap FRACTION] [--gap-unit diagonal|long_side]
                   [--cuts | --added-seams]

With --cuts seams may be added and faces divided; then the parts of each face must tile it, with everything else kept. With
--added-seams edges of the input may become seams; everything but UVs must be kept.

Faces that a reader may divide by a fan, by ears or by either diagonal and that are positive so in the input must be in the result;
faces that are new must be under each.

With --aspect the UVs are those of a texture of W:H, which [0, 1]^2 is the whole of: PE, gap and distortion are measured with u
stretched by W/H, and PE and gap in the smallest box of that shape. The exact tests take the UVs as they stand in the file.

Prints one JSON line; exit code 0 where everything holds, 1 where not, 2 where a file cannot be read. Needs numpy only. Signs are
decided in floating point where that is safe and in rational arithmetic where it is not.
"""

import argparse
import json
import math
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from borders import NEAR, Boundary
from check_cut import divided, joined_anew, torn_anew
from divisions import lost_divisions
from exact import orientation, polygon_is_simple
from obj_text import one_after_the_other, read_obj
from taking_part import taking_part
from topology import Topology, face_areas
from triangles import distortion, elements, fan_triangles


def check(
    in_path,
    out_path,
    pe_bound=None,
    aspect=0.0,
    gap=None,
    gap_unit="diagonal",
    gap_box="aspect",
    cuts=False,
    charts=None,
    added_seams=False,
):
    """All findings on one pair of files, or on the files of a collection; `problems` is empty where everything holds.

    aspect: width / height of the texture, 0 where it is free. gap: a fraction of the diagonal or of the long side of the smallest
    box of that aspect, or, with gap_box "charts", of the charts' own box. charts: what the program's report says of each."""
    started = time.monotonic()
    in_paths, out_paths = ([p] if isinstance(p, str | Path) else p for p in (in_path, out_path))
    found = {"file": Path(in_paths[0]).name, "ok": False, "problems": []}
    pairs = [(read_obj(a), read_obj(b)) for a, b in zip(in_paths, out_paths, strict=True)]
    sources = _check_files(pairs, cuts, found)
    before, after = (one_after_the_other(objs) for objs in zip(*pairs, strict=True))
    problems = found["problems"]
    if problems:
        return found
    before, after, sources = taking_part(before, after, sources, charts, found)
    found["faces"] = after.faces
    if not after.faces:
        found["ok"] = not problems
        return found
    if not np.isfinite(after.corner_uv).all():
        problems.append("UVs: not finite")
        return found
    meant = Topology(before, as_meant=True)
    kept = np.array_equal(before.corner_uv, after.corner_uv)
    topology = meant if kept else Topology(after)
    if kept:
        found.update(seams_in=meant.seams, seams=meant.seams, added_seams=0)
    elif cuts:
        _check_cut_seams(before, meant, after, topology, sources, found)
    else:
        _check_seams(before, meant, after, topology, added_seams, found)
    _check_faces(after, topology, found)
    _check_divisions((before, meant.sense), (after, topology.sense), sources, found)
    if kept:
        after = replace(after, corner_uv=meant.settled(after))
    _check_texture(after, topology, found, pe_bound=pe_bound, aspect=aspect, gap=gap, gap_unit=gap_unit, gap_box=gap_box)
    _measure_distortion(before, after, aspect or 1, found)
    found["ok"] = not problems
    found["seconds"] = round(time.monotonic() - started, 3)
    return found


def _check_files(pairs, cuts, found):
    """The face of the inputs that each face of the results is part of."""
    sources, first = [], 0
    for before, after in pairs:
        if before.kept == after.kept:
            own = np.arange(before.faces)
        elif cuts:
            own, problems = divided(before, after)
            found["problems"] += problems
        else:
            own = None
            found["problems"].append("file: records other than UVs differ")
        if own is not None:
            sources.append(own + first)
        first += before.faces
    return np.concatenate(sources) if sources else None


def _check_seams(source, before, result, after, may_add, found):
    """Edges that were whole and are torn, and the other way round. Folded edges and those of one-sided charts have to be torn."""
    torn = before.apart(result)
    split = np.flatnonzero(torn & ~before.fold & ~before.one_sided)
    welded = np.flatnonzero((after.partner >= 0) & (after.partner != before.partner) & after.noticeably_apart(source))
    found.update(seams_in=before.seams, seams=after.seams, added_seams=int((torn & ~before.one_sided).sum()) // 2)
    found.update(parted_folds=int((torn & before.fold).sum()) // 2, removed_seams=len(welded) // 2)
    found.update(bl_in=before.seam_length, bl=after.seam_length)
    if len(split) and not may_add:
        found["problems"].append(f"seams: {len(split) // 2} added, first at face {int(after.face[split[0]])}")
    if len(welded):
        found["problems"].append(f"seams: {len(welded) // 2} removed, first at face {int(after.face[welded[0]])}")


def _check_cut_seams(source, before, result, after, sources, found):
    added = torn_anew(source, before, result, after, sources)
    found.update(seams_in=before.seams, seams=after.seams, bl_in=before.seam_length, bl=after.seam_length, added_seams=added)
    joined = joined_anew(source, before, after, sources)
    if len(joined):
        found["problems"].append(f"seams: {len(joined)} removed, first at face {int(after.face[joined[0]])}")


def flipped_faces(obj, sense, triangles, face):
    """Faces that are not positive: their fan is not, and, where they have more than three corners, they are not simple either."""
    uv = obj.corner_uv
    sign = orientation(uv[triangles[:, 0]], uv[triangles[:, 1]], uv[triangles[:, 2]]) * sense[face]
    suspects = np.unique(face[sign <= 0])
    rings = (uv[obj.offsets[f] : obj.offsets[f + 1]][:: sense[f]] for f in suspects)
    return [int(f) for f, ring in zip(suspects, rings, strict=True) if len(ring) == 3 or not polygon_is_simple(ring)]


def _check_faces(after, topology, found):
    triangles, face = fan_triangles(after.offsets)
    flipped = flipped_faces(after, topology.sense, triangles, face)
    found.update(triangles=len(triangles), charts=int(topology.chart.max()) + 1, flipped=len(flipped))
    if flipped:
        found["problems"].append(f"flipped or flat: {len(flipped)} faces, first {flipped[0]}")


def _check_divisions(before, after, sources, found):
    """Whoever divides a polygon: what was positive in the input still is, and new faces are whatever the division."""
    lost, has = lost_divisions(before, after, sources)
    for name, faces in lost.items():
        found[f"{name}_flipped"] = int((~has[name]).sum())
        if len(faces):
            found["problems"].append(f"{name}: {len(faces)} faces are flipped where divided so, first {int(faces[0])}")


def fills_unit_square(uvs):
    """The UVs lie in [0, 1]^2 and reach from side to side of it in one direction at least."""
    return bool(uvs.min() >= -NEAR and uvs.max() <= 1 + NEAR and np.ptp(uvs, axis=0).max() >= 1 - 2 * NEAR)


def _check_texture(after, topology, found, *, pe_bound, aspect, gap, gap_unit, gap_box):
    """What is measured in units of the texture: PE and the gap."""
    width = aspect or 1
    area = math.fsum(topology.sense * face_areas(after, topology.next))
    found.update(texture_share=area, fills_texture=fills_unit_square(after.corner_uv))
    box = np.ptp(after.corner_uv, axis=0) * (width, 1)
    whole = max(box[0] / aspect, box[1]) * np.array([aspect, 1]) if aspect else box
    _check_efficiency(area * width, box, whole, pe_bound, found)
    _check_boundary(Boundary(after, topology, width), box if gap_box == "charts" else whole, gap, gap_unit, found)


def _check_efficiency(area, box, whole, pe_bound, found):
    found["pe"], found["pe_fixed_aspect"] = (area / float(np.prod(sides)) for sides in (box, whole))
    if pe_bound is not None and not found["pe_fixed_aspect"] >= pe_bound - 1e-12:
        found["problems"].append(f"PE: {found['pe_fixed_aspect']:.6f} is below {pe_bound}")


def _check_boundary(boundary, box, gap, gap_unit, found):
    unit = float(np.hypot(*box)) if gap_unit == "diagonal" else float(box.max())
    contacts, between = boundary.contacts_and_gap((gap or 0) * unit)
    loops = boundary.overlapping_loops() if not contacts else []
    found.update(contacts=len(contacts), overlapping_loops=len(loops), gap=between / unit)
    if contacts:
        found["problems"].append(f"borders: {len(contacts)} pairs of edges cross or touch")
    if loops:
        found["problems"].append(f"borders: {len(loops)} loops lie inside other charts")
    if gap is not None and not between / unit >= gap * (1 - 1e-9):
        found["problems"].append(f"gap: {between / unit:.9f} is below {gap}")


def _measure_distortion(before, after, width, found):
    before, after = (replace(obj, corner_uv=obj.corner_uv * (width, 1)) for obj in (before, after))
    found["e_d_in"] = distortion(before, *elements(before))[0]
    found["e_d"], found["stretch_99"], found["stretch_max"] = distortion(after, *elements(after))


def aspect_of(text):
    """Width / height of "free", "square" or "W:H"; 0 is free."""
    if text in ("free", "square"):
        return float(text == "square")
    width, height = map(float, text.split(":"))
    return width / height


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("input")
    parser.add_argument("output")
    parser.add_argument("--pe-bound", type=float)
    parser.add_argument("--aspect", type=aspect_of, default=0.0, help="free, square or W:H: shape of the texture [free]")
    parser.add_argument("--gap", type=float, help="smallest distance between charts that must hold, as fraction of the unit")
    parser.add_argument("--gap-unit", choices=["diagonal", "long_side"], default="diagonal")
    seams = parser.add_mutually_exclusive_group()
    seams.add_argument("--cuts", action="store_true", help="seams may be added and faces divided")
    seams.add_argument("--added-seams", action="store_true", help="edges of the input may become seams, nothing is divided")
    options = parser.parse_args()
    goal = (options.pe_bound, options.aspect, options.gap, options.gap_unit)
    try:
        found = check(options.input, options.output, *goal, cuts=options.cuts, added_seams=options.added_seams)
    except (OSError, ValueError, IndexError) as error:
        print(f"check_atlas: {options.output}: cannot be read: {error}", file=sys.stderr)
        return 2
    finite = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in found.items()}
    print(json.dumps(finite))
    return 0 if found["ok"] else 1


if __name__ == "__main__":
    sys.exit(main())
