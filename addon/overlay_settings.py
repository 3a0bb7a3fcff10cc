# SPDX-License-Identifier: GPL-3.0-or-later
"""The overlay's switches in the panel."""

import bpy
from bpy.props import BoolProperty, PointerProperty

from . import overlay, preferences
from .bridge import parts as objects
from .bridge.mesh import has_other_faces


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
    if any(overlay.shown.values()) and context.area.type == "VIEW_3D" and _lies_on_the_cage(context):
        layout.label(text="Lies on the mesh", icon="INFO")
        layout.label(text="without its modifiers", icon="BLANK1")
    chosen = preferences.get()
    if switches.stretch and isinstance(chosen, bpy.types.AddonPreferences):  # else there is nothing to choose
        legend = layout.row(align=True)
        legend.prop(chosen, "heat_low", text="None")
        legend.prop(chosen, "heat_high", text=f"{chosen.heat_worst:g} x")


def _lies_on_the_cage(context):
    """An artist who sees a subdivided surface should know why the overlay does not follow it."""
    depsgraph = context.view_layer.depsgraph
    found = () if depsgraph is None or context.mode != "OBJECT" else objects.objects_of(context)
    return any(has_other_faces(obj, depsgraph) for obj in found if obj.visible_get())


def register():
    bpy.utils.register_class(AtlasRefineOverlay)
    bpy.types.WindowManager.atlas_refine_overlay = PointerProperty(type=AtlasRefineOverlay)
    overlay.register()


def unregister():
    overlay.unregister()
    del bpy.types.WindowManager.atlas_refine_overlay
    bpy.utils.unregister_class(AtlasRefineOverlay)
