# SPDX-License-Identifier: GPL-3.0-or-later
"""The options as a layout, in the panels and in the redo panel alike, what the artist decides first at the top."""

import bpy

from .bridge import parts as objects
from .bridge.texture import find_texture, texture_of_material
from .core.words import counted, titled

MOST_TEXTURES = 5  # that are named


def draw_use(layout, holder):
    layout.prop(holder, "pe_bound", slider=True)


def draw_main(layout, holder, context):
    active = context.active_object
    layout.prop(holder, "aspect")
    textures = _textures(holder, context) if holder.aspect == "TEXTURE" else {"": None}
    if holder.aspect == "TEXTURE":
        _draw_textures(layout, textures)
    layout.prop(holder, "seams")
    limits = _with_long_names(layout).column(align=True)
    limits.prop(holder, "max_distortion")
    limits.prop(holder, "max_stretch")
    if holder.seams == "NEEDED":
        _draw_most_new_seams(layout, holder)
    if holder.seams != "NONE":
        layout.prop(holder, "cut")
    layout.prop(holder, "gap")
    if holder.gap == "PIXELS":
        layout.prop(holder, "gap_px", text="Pixels")
    if None in textures.values() and (holder.gap == "PIXELS" or holder.density == "VALUE"):
        layout.prop(holder, "texture_size", text="Texture px")
    layout.prop(holder, "stacks")
    layout.prop(holder, "density", text="Density")
    if holder.density == "VALUE":
        layout.prop(holder, "texel_density", text="px / m")
    if len(objects.objects_of(context)) > 1 or holder.atlases != "ALL" or _has_materials(active):
        layout.prop(holder, "atlases")
    layout.prop(holder, "tiles")
    _draw_uv_map(layout, holder, active)
    layout.prop(holder, "write_to")


def _with_long_names(layout):
    """Names stand in the fields themselves: beside them a sidebar has room for some ten letters."""
    inner = layout.column()
    inner.use_property_split = False
    return inner


def _textures(holder, context):
    """By the name of the material where each has its own; of the active object."""
    active = context.active_object
    if holder.atlases != "MATERIAL":
        return {"": find_texture(context, active, holder.atlases)}
    slots = active.material_slots if active is not None else ()
    names = [slot.material.name_full for slot in slots if slot.material]
    return {name: texture_of_material(context, name) for name in names} or {"": texture_of_material(context, "")}


def _draw_textures(layout, textures):
    for name, texture in list(textures.items())[:MOST_TEXTURES]:
        text = f"{texture.name}: {texture.width} x {texture.height}" if texture else "No image: square"
        layout.label(text=titled(name, text) if name else text, icon="IMAGE_DATA")
    if len(textures) > MOST_TEXTURES:
        layout.label(text=f"and {counted(len(textures) - MOST_TEXTURES, 'more material')}", icon="BLANK1")


def _draw_most_new_seams(layout, holder):
    row = _with_long_names(layout).row(align=True)
    row.prop(holder, "limit_new_seams", text="")
    value = row.row(align=True)
    value.active = holder.limit_new_seams
    value.prop(holder, "most_new_seams")


def _has_materials(obj):
    return obj is not None and len(obj.material_slots) > 1


def _draw_uv_map(layout, holder, obj):
    if obj is not None and obj.type == "MESH":
        layout.prop_search(holder, "uv_map", obj.data, "uv_layers", icon="GROUP_UVS")
    else:
        layout.prop(holder, "uv_map")


def draw_protected(layout, holder):
    """What is kept as it is: names of vertex groups and attributes."""
    labels = bpy.context.scene.atlas_refine.bl_rna.properties  # an operator's own have none
    for name, icon in (
        ("keep_shape", "GROUP_VERTEX"),
        ("importance", "GROUP_VERTEX"),
        ("no_seam", "EDGESEL"),
        ("prefer_seam", "EDGESEL"),
    ):
        halves = layout.split(factor=0.5)
        beside = halves.row()
        beside.alignment = "RIGHT"  # as Blender's own
        beside.label(text=labels[name].name)
        halves.prop(holder, name, text="", icon=icon)
    _with_long_names(layout).prop(holder, "mark_seams")


def draw_advanced(layout, holder):
    flags = _with_long_names(layout)
    for name in ("relax", "open_closed", "best_effort"):
        flags.prop(holder, name)
    if holder.seams == "NEEDED":
        layout.prop(holder, "effort")
        if holder.max_distortion == 0 and holder.max_stretch == 0:
            layout.prop(holder, "seam_cost")
    if holder.seams == "RECTANGLES":
        layout.prop(holder, "sigma")
        layout.prop(holder, "candidates")
    layout.prop(holder, "seed")
    layout.prop(holder, "threads")


def redraw_panels(context):
    _redraw(context.window_manager, "UI")


def redraw_views():
    _redraw(bpy.context.window_manager, "WINDOW")


def _redraw(window_manager, kind):
    for window in window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"IMAGE_EDITOR", "VIEW_3D"}:
                for region in area.regions:
                    if region.type == kind:
                        region.tag_redraw()


def is_over_uv_or_3d_view(context, event):
    """Whether the mouse is where a key is meant for the add-on, and not for a text or a console."""
    areas = context.window.screen.areas
    return any(area.type in {"IMAGE_EDITOR", "VIEW_3D"} and _is_over(area, event) for area in areas)


def is_over_redo_panel(context, event):
    """Whether the mouse is over Blender's panel of the last operator, in the corner of some area."""
    regions = (region for area in context.window.screen.areas for region in area.regions)
    return any(region.type == "HUD" and _is_over(region, event) for region in regions)


def _is_over(place, event):
    return 0 <= event.mouse_x - place.x < place.width and 0 <= event.mouse_y - place.y < place.height
