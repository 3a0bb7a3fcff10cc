# SPDX-License-Identifier: GPL-3.0-or-later
"""The image that a UV map is for: what the UV editor shows, else what the active material reads."""

import bpy

from ..core.canvas import Canvas
from ..core.options import Texture


def find_texture(context, obj, atlases="ALL"):
    """The Texture of an object, or None where no image tells the shape: then it is square. What all share is what the UV editor
    shows, else the image of the active material; where each has its own the other way round."""
    own, shared = _image_of_material(obj.active_material if obj else None), _image_in_editor(context)
    return _texture_of(shared or own if atlases == "ALL" else own or shared)


def find_canvases(context, objs, materials, atlases):
    """What an atlas of these objects is packed for: with MATERIAL a Canvas for each of these materials' names."""
    if atlases != "MATERIAL":
        return [_canvas(context, find_texture(context, objs[0], atlases))]
    return [_canvas(context, texture_of_material(context, name), name or "no material") for name in materials]


def texture_of_material(context, name):
    """Of its own image, else of what the UV editor shows."""
    return _texture_of(_image_of_material(_material_named(name)) or _image_in_editor(context))


def _canvas(context, texture, name=""):
    return Canvas(texture, active_tile(context, texture), name)


def _texture_of(image):
    if image is None:
        return None
    width, height = image.size
    if image.source != "TILED":
        return Texture(image.name, width, height)
    active = image.tiles.active.number if image.tiles.active else 1001
    return Texture(image.name, width, height, True, active, tuple(tile.number for tile in image.tiles))


def _image_in_editor(context):
    space = context.space_data
    if space is None or space.type != "IMAGE_EDITOR":
        return None
    return space.image if _has_size(space.image) else None


def other_images(texture, material_names):
    """Names of the images that these materials read and that are not the texture: ([of its shape], [of another])."""
    images = filter(None, (_image_of_material(_material_named(name)) for name in material_names))
    others = {image.name: image.size[0] / image.size[1] for image in images if image.name != texture.name}
    shape = texture.width / texture.height
    alike = {name for name, own in others.items() if abs(own - shape) <= 1e-3 * shape}
    return sorted(alike), sorted(others.keys() - alike)


def _material_named(full_name):
    return next((material for material in bpy.data.materials if material.name_full == full_name), None)


def _image_of_material(material):
    if material is None or material.node_tree is None:
        return None
    nodes = list(_image_nodes(material.node_tree))
    active = material.node_tree.nodes.active
    if active in nodes:
        return active.image
    used = [node for node in nodes if any(output.is_linked for output in node.outputs)]
    return next((node.image for node in used or nodes), None)


def _image_nodes(tree):
    """Those in groups too."""
    for node in tree.nodes:
        if node.type == "TEX_IMAGE" and _has_size(node.image):
            yield node
        elif node.type == "GROUP" and node.node_tree is not None:
            yield from _image_nodes(node.node_tree)


def _has_size(image):
    """Renders and images whose file is missing have none."""
    return image is not None and image.type not in {"RENDER_RESULT", "COMPOSITING"} and min(image.size) > 0


def active_tile(context, texture):
    """Lower left corner of the active UDIM tile: the image's, else the one that the UV editor's cursor is in."""
    if texture is not None and texture.is_tiled:
        number = texture.active_tile - 1001
        return number % 10, number // 10
    space = context.space_data
    if space is None or space.type != "IMAGE_EDITOR":
        return 0, 0
    return tuple(int(value // 1) for value in space.cursor_location)
