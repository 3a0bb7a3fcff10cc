"""A mesh that carries one of everything a cut must take along, and all of it as arrays."""

import importlib

import bmesh
import bpy
import numpy as np
import shapes
from support import HAS_UV_ATTRIBUTE, MODULE, add_mesh, get_uvs, set_uvs


def bridge(name):
    return importlib.import_module(f"{MODULE}.bridge.{name}")


def core(name):
    return importlib.import_module(f"{MODULE}.core.{name}")


def grid_with_an_ngon():
    """4 x 3 quads; the two in the corner are one hexagon."""
    positions, offsets, corners, uvs = shapes.join(shapes.grid(4, 3))
    positions[:, 2] = 0.3 * np.sin(positions[:, 0] + positions[:, 1])
    faces = [corners[4 * k : 4 * k + 4].tolist() for k in range(12)]
    faces[-2:] = [[12, 13, 14, 19, 18, 17]]
    uv_of = dict(zip(corners.tolist(), uvs.tolist(), strict=True))
    flat = [vertex for face in faces for vertex in face]
    sizes = [len(face) for face in faces]
    return positions, np.cumsum([0] + sizes), np.array(flat), np.array([uv_of[vertex] for vertex in flat]) / 4


def add_rich_mesh(custom_normals=True):
    """An object that carries one of everything that a cut must take along."""
    obj = add_mesh(grid_with_an_ngon(), name="Rich")
    mesh, random = obj.data, np.random.default_rng(3)
    if HAS_UV_ATTRIBUTE:  # Blender 4.5 corrupts its heap where setting a pin makes the layer of pins
        mesh.attributes.new(".pn.UVMap", "BOOLEAN", "CORNER")
    set_uvs(mesh.uv_layers.new(name="Lightmap"), random.random((len(mesh.loops), 2)))
    mesh.uv_layers.active_index = 0
    for name in ("Spine", "Arm"):
        group = obj.vertex_groups.new(name=name)
        for vertex, weight in enumerate(random.random(len(mesh.vertices))):
            group.add([vertex], weight, "REPLACE")
    for name, domain, kind in (
        ("Paint", "CORNER", "FLOAT_COLOR"),
        ("Bytes", "CORNER", "BYTE_COLOR"),
        ("Mask", "POINT", "FLOAT_COLOR"),
    ):
        colours = mesh.color_attributes.new(name, kind, domain)
        colours.data.foreach_set("color", random.random(4 * len(colours.data)).astype(np.float32))
    for name, domain in (("wear", "POINT"), ("stress", "EDGE"), ("heat", "FACE"), ("dirt", "CORNER")):
        mesh.attributes.new(name, "FLOAT", domain)
        attribute = mesh.attributes[name]
        attribute.data.foreach_set("value", random.random(len(attribute.data)).astype(np.float32))
    mesh.attributes.new("part", "INT", "FACE").data.foreach_set("value", np.arange(len(mesh.polygons)))
    for name in ("Skin", "Cloth", "Metal"):
        mesh.materials.append(bpy.data.materials.new(name))
    for polygon in mesh.polygons:
        polygon.material_index, polygon.use_smooth = polygon.index % 3, polygon.index != 5
    for edge in mesh.edges:
        edge.use_seam, edge.use_edge_sharp = edge.index % 7 == 0, edge.index % 4 == 0
        if hasattr(edge, "use_freestyle_mark"):
            edge.use_freestyle_mark = edge.index % 3 == 0
    for name in ("crease", "bevel_weight"):
        set_edge_values(mesh, name, random.random(len(mesh.edges)).astype(np.float32))
    if custom_normals:
        add_custom_normals(mesh, random)
    obj.shape_key_add(name="Basis")
    for name in ("Smile", "Frown"):
        key = obj.shape_key_add(name=name)
        moved = random.normal(size=(len(key.data), 3)) + shape(obj, "Basis")
        key.data.foreach_set("co", moved.astype(np.float32).ravel())
    return obj


def edge_values(mesh, name):
    """(the collection, its attribute) that hold creases or bevel weights of edges."""
    if hasattr(mesh.edges[0], name):  # before 4.0
        return mesh.edges, name
    if f"{name}_edge" not in mesh.attributes:
        mesh.attributes.new(f"{name}_edge", "FLOAT", "EDGE")
    return mesh.attributes[f"{name}_edge"].data, "value"


def set_edge_values(mesh, name, values):
    collection, attribute = edge_values(mesh, name)
    collection.foreach_set(attribute, values)


def get_edge_values(mesh, name):
    collection, attribute = edge_values(mesh, name)
    return column(collection, attribute)[:, 0]


def add_custom_normals(mesh, random):
    """One for each vertex and side of its sharp edges: others Blender would average or make more edges sharp for."""
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = np.pi
    tilt = random.normal(size=(len(mesh.vertices), 3)) * 0.2 + [0.0, 0.0, 1.0]
    tilt /= np.linalg.norm(tilt, axis=1, keepdims=True)
    mesh.normals_split_custom_set([tilt[loop.vertex_index].tolist() for loop in mesh.loops])
    mesh.update()


def select_and_hide(mesh, selected, hidden):
    """By a BMesh: Blender 5.0 crashes where MeshEdge.select is set."""
    flagged = bmesh.new()
    flagged.from_mesh(mesh)
    for element in (*flagged.faces, *flagged.edges, *flagged.verts):
        element.select_set(False)
    for face in flagged.faces:
        if face.index in selected:
            face.select_set(True)
        if face.index in hidden:
            face.hide_set(True)
    flagged.to_mesh(mesh)
    flagged.free()


def column(collection, attribute, width=1, dtype=np.float32):
    values = np.empty(width * len(collection), dtype=dtype)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width).astype(np.float64) if dtype == np.float32 else values


def shape(obj, name):
    return column(obj.data.shape_keys.key_blocks[name].data, "co", 3)


def weights(obj):
    rows = np.zeros((len(obj.data.vertices), len(obj.vertex_groups)))
    for vertex in obj.data.vertices:
        for group in vertex.groups:
            rows[vertex.index, group.group] = group.weight
    return rows


def normals(mesh):
    return bridge("versions").custom_normals(mesh).astype(np.float64)


def data_of(obj):
    """Everything that is interpolated, by domain: name -> (n, k) arrays."""
    mesh = obj.data
    points = {
        "weights": weights(obj),
        "co": column(mesh.vertices, "co", 3),
        "Mask": column(mesh.attributes["Mask"].data, "color", 4),
    }
    points["wear"] = column(mesh.attributes["wear"].data, "value")
    points.update({key.name: shape(obj, key.name) for key in mesh.shape_keys.key_blocks})
    corners = {"Paint": column(mesh.attributes["Paint"].data, "color", 4)}
    corners["Bytes"] = column(mesh.attributes["Bytes"].data, "color_srgb", 4)  # as they are stored and interpolated
    corners["dirt"] = column(mesh.attributes["dirt"].data, "value")
    corners["Lightmap"] = get_uvs(mesh.uv_layers["Lightmap"]).astype(np.float64)
    faces = {name: column(mesh.attributes[name].data, "value") for name in ("heat",)}
    faces["part"] = column(mesh.attributes["part"].data, "value", dtype=np.int32)
    for name in ("material_index", "use_smooth"):
        faces[name] = column(mesh.polygons, name, dtype=np.int32 if name == "material_index" else bool)
    return points, corners, faces


def edge_data(mesh):
    """(seam, whatever else it carries) of each edge by its vertices."""
    stress = column(mesh.attributes["stress"].data, "value")[:, 0]
    marks = [edge.use_edge_sharp for edge in mesh.edges], [getattr(edge, "use_freestyle_mark", False) for edge in mesh.edges]
    rows = zip(*marks, stress, get_edge_values(mesh, "crease"), get_edge_values(mesh, "bevel_weight"), strict=True)
    return {edge.key: (edge.use_seam, row) for edge, row in zip(mesh.edges, rows, strict=True)}
