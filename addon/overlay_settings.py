# SPDX-License-Identifier: GPL-3.0-or-later
"""The overlay's switches in the panel."""

import bpy
from bpy.props import BoolProperty, PointerProperty

from . import overlay, preferences
from .bridge import parts as objects
from .bridge.mesh import evaluated_mesh, has_other_faces
from .overlay import map_of


def _switch(layer, label, description):
    return BoolProperty(
        name=label,
        description=description,
        get=lambda _: overlay.shown[layer],
        set=lambda _, on: overlay.show(layer, on),
    )


class AtlasRefineOverlay(bpy.types.PropertyGroup):
    """What is drawn over the editors; a file that is loaded switches it off."""

    __annotations__ = {
        "stretch": _switch("stretch", "Stretch", "Colour the faces by how much the UV map stretches or squeezes them"),
        "seams": _switch("seams", "Seams", "Draw the edges that the last refinement has cut"),
        "gap": _switch(
            "gap",
            "Too Near",
            "Draw borders of charts that are nearer than the margin in pixels to another chart or to the texture's border",
        ),
    }


def draw(layout, context):
    """The switches, and what the colours mean."""
    switches = context.window_manager.atlas_refine_overlay
    row = layout.row(align=True)
    for name in overlay.shown:
        row.prop(switches, name, toggle=True)
    if context.area.type == "VIEW_3D":
        for layer in _on_the_cage(context):
            layout.label(text=f"{layer} on the mesh", icon="INFO")
            layout.label(text="without its modifiers", icon="BLANK1")
    chosen = preferences.get()
    if switches.stretch and isinstance(chosen, bpy.types.AddonPreferences):  # else there is nothing to choose
        legend = layout.row(align=True)
        legend.prop(chosen, "heat_low", text="None")
        legend.prop(chosen, "heat_high", text=f"{chosen.heat_worst:g} x")


def _on_the_cage(context):
    """What does not follow a subdivided surface, of which an artist who sees that should know."""
    depsgraph = context.view_layer.depsgraph
    found = () if depsgraph is None or context.mode != "OBJECT" else objects.objects_of(context)
    found = [obj for obj in found if obj.visible_get() and obj.data.uv_layers and has_other_faces(obj, depsgraph)]
    uv_map = context.scene.atlas_refine.uv_map
    if overlay.shown["stretch"] and any(evaluated_mesh(obj, map_of(obj, uv_map), depsgraph) is None for obj in found):
        yield "Stretch lies"
    if found and (overlay.shown["seams"] or overlay.shown["gap"]):
        yield "Lines lie"


def register():
    bpy.utils.register_class(AtlasRefineOverlay)
    bpy.types.WindowManager.atlas_refine_overlay = PointerProperty(type=AtlasRefineOverlay)
    overlay.register()


def unregister():
    overlay.unregister()
    del bpy.types.WindowManager.atlas_refine_overlay
    bpy.utils.unregister_class(AtlasRefineOverlay)
