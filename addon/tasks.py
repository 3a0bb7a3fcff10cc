# SPDX-License-Identifier: GPL-3.0-or-later
"""One refinement: read the mesh, run the engine beside Blender, write what comes. At most one runs with a window's progress."""

import os

import bpy

from .bridge import cuts
from .bridge import mesh as bridge
from .core.atlas import stored_uvs
from .core.cuts import plan_cut, seam_edges
from .engine import AtlasRefineError, start

#: What a task may fail with for reasons that lie in the object or the options.
FAILURES = (AtlasRefineError, bridge.MeshError, ValueError)

#: The task whose progress the panel shows.
running = None
#: The name of an object, how many faces it had, and the result that the panel shows.
last = None


class Task:
    """Starts at once. Holds names, not Blender's data: undo may replace that meanwhile."""

    def __init__(self, obj, uv_map, options, beside_window=False):
        bridge.check_writable(obj)
        if options.seams != "NONE" and options.cut == "SPLIT":
            cuts.check_divisible(obj)
        self.object_name = obj.name
        self.uv_map = bridge.find_uv_map(obj.data, uv_map)
        self.uneven_scale = bridge.has_uneven_scale(obj)
        self.atlas = bridge.read_atlas(obj, self.uv_map)
        threads = max(1, (os.cpu_count() or 1) - 1) if beside_window else 0  # one core is left to the window
        triangles = bridge.read_triangles(obj)
        self.job = start(
            *self.atlas.as_tuple(), name=obj.name, threads=threads, triangles=triangles, **options.engine_arguments()
        )

    def finish(self):
        """Waits for the engine, writes the result and returns it; raises one of FAILURES with the mesh as it was."""
        global last
        result = self.job.result()
        obj = bpy.data.objects.get(self.object_name)
        if obj is None or obj.type != "MESH":
            raise bridge.MeshError("the object is gone")
        if self.uv_map not in obj.data.uv_layers or not bridge.read_atlas(obj, self.uv_map).same_as(self.atlas):
            raise bridge.MeshError("the mesh was changed meanwhile; nothing was written")
        self._write(obj, result)
        last = (self.object_name, len(self.atlas.face_offsets) - 1, result)
        return result

    def _write(self, obj, result):
        if result.cut is not None:
            cuts.check_divisible(obj)  # again: its mode may be another by now
            cuts.write_cut(obj, self.uv_map, plan_cut(self.atlas, result.cut, stored_uvs(result.corner_uvs)))
        elif result.intervention != "unchanged":
            bridge.write_uvs(obj, self.uv_map, stored_uvs(result.corner_uvs))
            bridge.mark_seams(obj, seam_edges(self.atlas, result.new_seams))

    def warnings(self, result):
        if self.uneven_scale:
            yield "the object's scale is uneven; the UVs follow the mesh without it"
        yield from (repair.text for repair in result.repairs)
        yield from result.fallbacks
        yield from result.warnings


def stop_running(*_):
    """Ends the running task, if there is one, and waits for its thread: before a file is loaded and on unregister."""
    global running
    if running is not None:
        running.job.cancel()
        running.job.wait()
        running = None
