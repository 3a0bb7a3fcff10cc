# SPDX-License-Identifier: GPL-3.0-or-later
"""Who takes part: selection, pins, hidden faces, materials and tiles decide over whole charts."""

import numpy as np


def any_in_chart(charts, flags):
    """(faces,) whether a face of the same chart has the flag."""
    found = np.zeros(charts.max() + 1 if len(charts) else 0, dtype=bool)
    np.logical_or.at(found, charts, flags)
    return found[charts]


def all_in_chart(charts, flags):
    return ~any_in_chart(charts, ~flags)


def stay(charts, hidden, selected, pinned):
    """(left out, locked) faces. A chart that is hidden as a whole is left out, as in the UV editor; one that is hidden in part, is
    pinned anywhere, or has no selected face, is locked: it stays, and others go around it."""
    left_out = all_in_chart(charts, hidden)
    locked = any_in_chart(charts, hidden | pinned) | ~any_in_chart(charts, selected & ~hidden)
    return left_out, locked & ~left_out


def group_faces(codes):
    """Numbers from 0 on of the rows of (faces, 2) codes, none negative, in their order, and the first face of each."""
    rows = codes[:, 0].astype(np.int64) * (codes[:, 1].max() + 1) + codes[:, 1]  # unique() of rows takes ten times as long
    _, first, groups = np.unique(rows, return_index=True, return_inverse=True)
    return groups.astype(np.int32), first


def groups_without_work(groups, locked):
    """(faces,) whether all charts of the face's group are locked."""
    has_work = np.zeros(groups.max() + 1, dtype=bool)
    np.logical_or.at(has_work, groups, ~locked)
    return ~has_work[groups]
