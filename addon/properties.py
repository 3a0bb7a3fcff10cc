# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a refinement as Blender properties, for the operator, the scene and the preferences."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from .bridge.named import names_of_edges, names_of_faces
from .core.options import Options

#: Limits are soft where a script's 1.2 must reach the engine and be refused there, not be cut off in silence.


def pe_bound_property(**more):
    return FloatProperty(
        name="Texture Use",
        description="Part of the texture that the charts are to cover: 0.8 is 80 %. Higher bends them more. With a Density in pixels "
        "per metre it is the most that they may cover",
        default=Options.pe_bound,
        soft_min=0.05,
        soft_max=0.99,
        step=1,
        precision=2,
        **more,
    )


#: Their numbers are stored in files.
SEAMS = [
    ("NONE", "None", "Charts move and bend; no seam is added and the mesh stays as it is", 0),
    (
        "NEEDED",
        "As Needed",
        "Charts are cut only where that spares much bending, one cut after the other: few seams, little distortion",
        2,
    ),
    (
        "RECTANGLES",
        "Rectangles",
        "Charts are cut towards rectangles, which pack (Liu et al. 2019): adds seams, and bends the charts less",
        1,
    ),
]


def seams_property(**more):
    return EnumProperty(name="Seams", description="Where new seams may come from", items=SEAMS, default=Options.seams, **more)


def sigma_property(**more):
    return FloatProperty(
        name="Sigma",
        description="For Seams Rectangles: how much the charts' borders are smoothed before they are straightened, as a part of "
        "their length",
        default=Options.sigma,
        soft_min=0.0001,
        soft_max=0.1,
        step=0.1,
        precision=4,
        **more,
    )


def gap_px_property(**more):
    return FloatProperty(
        name="Margin Pixels",
        description="Smallest distance between two charts and, unless Aspect is Free, of a chart to the texture's border, in pixels",
        default=Options.gap_px,
        min=0.0,
        soft_max=64.0,
        max=1024.0,
        **more,
    )


def texture_size_property(**more):
    return IntProperty(
        name="Texture Size",
        description="Pixels of the texture's longer side, where Aspect does not take them from an image",
        default=Options.texture_size,
        min=16,
        max=65536,
        **more,
    )


#: The options that have a preference: what new scenes start with.
PREFERRED = {
    "pe_bound": pe_bound_property,
    "seams": seams_property,
    "gap_px": gap_px_property,
    "texture_size": texture_size_property,
    "sigma": sigma_property,
}


def _choice(name, label, description, items):
    return EnumProperty(name=label, description=description, items=items, default=getattr(Options, name))


def _flag(name, label, description):
    return BoolProperty(name=label, description=description, default=getattr(Options, name))


def _name(label, description, **more):
    return StringProperty(name=label, description=description, default="", **more)


def _name_of(names, label, description):
    """`names`: of the active object, which are offered; others may be those of another object."""

    def offered(_holder, context, _text):
        obj = context.active_object
        return names(obj) if obj is not None and obj.type == "MESH" else []

    return _name(label, description, search=offered)


def _box_properties():
    return {
        "aspect": _choice(
            "aspect",
            "Aspect",
            "Shape of the box that the charts fill, and whose part they are to cover",
            [
                ("TEXTURE", "Texture", "That of the image in the UV editor, else of the active material; without one a square"),
                ("SQUARE", "Square", "A square texture, whatever the image"),
                (
                    "FREE",
                    "Free",
                    "Whatever box bends the charts least. It seldom has the texture's shape: what it leaves of that stays empty",
                ),
            ],
        ),
        "gap": _choice(
            "gap",
            "Margin",
            "Smallest distance between two charts",
            [
                ("PIXELS", "Pixels", "So many pixels of the texture, to its border as well unless Aspect is Free: always kept"),
                ("AUTO", "Automatic", "0.25 % of the box's diagonal, less where charts jam or bend too much; none to the border"),
            ],
        ),
        "atlases": _choice(
            "atlases",
            "Objects",
            "What shares one texture",
            [
                ("ALL", "One Atlas", "All selected objects share one texture"),
                ("OBJECT", "One for Each", "Each object has a texture of its own, of the shape of its active material's image"),
                (
                    "MATERIAL",
                    "By Material",
                    "What has the same material shares a texture, across the selected objects; each has the shape of its own image",
                ),
            ],
        ),
        "tiles": _choice(
            "tiles",
            "UDIM Tiles",
            "What becomes of charts in other tiles than the first",
            [
                ("TEXTURE", "As the Texture", "With a tiled image every chart stays in its tile; else all go to the first"),
                ("EACH", "Each Its Own", "Every chart stays in the tile that it lies in; each tile is filled by itself"),
                ("ACTIVE", "Active Only", "Only charts in the active tile change"),
                ("ONE", "All to the First", "All charts go to tile 1001"),
            ],
        ),
    }


def _chart_properties():
    return {
        "cut": _choice(
            "cut",
            "Cut",
            "Where new seams run",
            [
                ("EDGES", "Along Edges", "Only edges of the mesh become seams: its faces stay as they are"),
                ("SPLIT", "Across Faces", "Seams are straight and divide the faces that they cross"),
            ],
        ),
        "stacks": _choice(
            "stacks",
            "Stacks",
            "Charts of one shape and one material that lie on each other, mirrored ones too",
            [
                ("KEEP", "Keep", "They stay on each other and share their part of the texture"),
                ("SEPARATE", "Separate", "Each gets a place of its own"),
            ],
        ),
        "density": _choice(
            "density",
            "Texel Density",
            "How large the charts are beside each other",
            [
                (
                    "KEEP",
                    "Keep",
                    "Each chart keeps the relative size it has, as far as bending leaves it that. A Texture Use that only charts blown up "
                    "would reach is not reached, and the message names the one that is",
                ),
                (
                    "EQUAL",
                    "Equal",
                    "The same number of texels for every part of the surface, at the scale that objects have in the scene. Charts bend for "
                    "that also where the wanted use is there already",
                ),
                (
                    "VALUE",
                    "Pixels per Metre",
                    "Equal, and so many pixels for a metre: the charts cover what that takes of the texture. Where it takes more than "
                    "Texture Use they fill it up to there, and the result says how large a texture has to be",
                ),
            ],
        ),
        "texel_density": FloatProperty(
            name="Pixels per Metre",
            description="Pixels of the texture for each metre of the surface, at the scale that the object has in the scene",
            default=Options.texel_density,
            soft_min=1.0,
            soft_max=4096.0,
            precision=1,
        ),
        "keep_shape": _name_of(
            names_of_faces,
            "Keep Shape",
            "Vertex group or face attribute: charts with such a face are moved and turned, never bent",
        ),
        "importance": _name_of(
            names_of_faces,
            "Importance",
            "Vertex group or face attribute from 0 to 1: faces at 1 resist distortion ten times as much as those at 0",
        ),
        "no_seam": _name_of(names_of_edges, "No Seams", "Edge attribute: no new seam runs along these edges"),
        "prefer_seam": _name_of(names_of_edges, "Prefer Seams", "Edge attribute: new seams along edges like to follow these"),
        "write_to": _choice(
            "write_to",
            "Write To",
            "Where the result goes",
            [
                ("MAP", "The Map", "The UV map itself changes"),
                (
                    "COPY",
                    "A Copy",
                    "A new UV map, which becomes the active one; the old one stays, with what is painted by it. None is made where "
                    "nothing changes",
                ),
            ],
        ),
        "mark_seams": _flag("mark_seams", "Mark New Seams", "Edges that are cut in the UV map are marked as seams of the mesh"),
    }


def _cut_properties():
    """What only one kind of Seams reads."""
    return {
        "limit_new_seams": _flag(
            "limit_new_seams",
            "Limit New Seams",
            "For Seams As Needed: cut no more than Most New Seams says, whatever that spares",
        ),
        "most_new_seams": FloatProperty(
            name="Most New Seams",
            description="How much longer cuts may make the borders of all charts together, on the surface: at 20 % a map whose "
            "borders are 10 m long has 12 m at most. Both sides of a seam count",
            default=Options.most_new_seams,
            min=0.0,
            soft_max=100.0,
            max=10000.0,
            precision=0,
            subtype="PERCENTAGE",
        ),
        "seam_cost": FloatProperty(
            name="Seam Cost",
            description="For Seams As Needed without a Largest Distortion or Stretch: how much distortion a cut has to spare. At 0.1 one that "
            "makes the borders 10 % longer has to spare 0.01. Less makes more cuts",
            default=Options.seam_cost,
            soft_min=0.0,
            soft_max=1.0,
            precision=3,
        ),
        "effort": _choice(
            "effort",
            "Effort",
            "For Seams As Needed: how many cuts are tried",
            [
                ("FAST", "Fast", "Few: the first result, with more or longer seams than needed"),
                ("NORMAL", "Normal", "As many as mostly find a good one"),
                ("BEST", "Best", "Many: the fewest seams, in several times the time"),
            ],
        ),
        "candidates": IntProperty(
            name="Candidates",
            description="For Seams Rectangles: layouts that are tried. More take longer and may need fewer seams",
            default=Options.candidates,
            soft_min=1,
            soft_max=5000,
        ),
    }


def _advanced_properties():
    return {
        "relax": _flag(
            "relax",
            "Relax as Well",
            "Where moving the charts is enough, bend them all the same, as far as that lessens their distortion",
        ),
        "max_distortion": FloatProperty(
            name="Largest Distortion",
            description="Mean distortion: 1 is none, 1.05 hardly seen, 2 much. With Seams As Needed charts are cut until it is no "
            "more than this, 0: wherever a cut pays. Else results above it are refused, 0: no limit",
            default=Options.max_distortion,
            soft_min=0.0,
            soft_max=4.0,
            precision=3,
        ),
        "max_stretch": FloatProperty(
            name="Largest Stretch",
            description="The same for the stretch of 99 % of the surface, as Details has it: at 1.3 lengths there are at most "
            "1.3 times as long or as short in the texture as in the mean. 0: no limit",
            default=Options.max_stretch,
            soft_min=0.0,
            soft_max=4.0,
            precision=2,
        ),
        **_cut_properties(),
        "open_closed": _flag(
            "open_closed",
            "Open Closed Charts",
            "A chart without a border cannot be flat: open it along edges, which become seams",
        ),
        "best_effort": _flag(
            "best_effort",
            "Best Effort",
            "Where the wanted use is not reached, take the best valid UV map that was found",
        ),
        "seed": IntProperty(
            name="Seed",
            description="The same seed gives the same result; another one may find another layout",
            default=Options.seed,
            min=0,
        ),
        "threads": IntProperty(
            name="Threads",
            description="Processor threads; 0: what the preferences say. The result is the same",
            default=Options.threads,
            min=0,
            max=1024,
        ),
    }


def other_properties():
    """The options that have no preference."""
    uv_map = _name("UV Map", "Name or index of the UV map; empty: the active one")
    return {**_box_properties(), **_chart_properties(), "uv_map": uv_map, **_advanced_properties()}


def all_properties():
    return {**{name: make() for name, make in PREFERRED.items()}, **other_properties()}


def _colour(label, description, default):
    """As it will be seen: no view transform."""
    return FloatVectorProperty(
        name=label, description=description, subtype="COLOR_GAMMA", size=3, min=0.0, max=1.0, default=default
    )


def overlay_properties():
    """Colours that are told apart with any colour vision: dark blue to yellow, orange, pink."""
    return {
        "heat_low": _colour("No Stretch", "Faces that the UV map neither stretches nor squeezes", (0.0, 0.2, 0.5)),
        "heat_high": _colour("Stretch", "Faces whose stretch is Most Stretch or more", (1.0, 0.9, 0.1)),
        "heat_worst": FloatProperty(
            name="Most Stretch",
            description="Stretch from which on the colour stays the same: 2 is twice as long, or half as long",
            default=2.0,
            min=1.05,
            soft_max=10.0,
        ),
        "heat_opacity": FloatProperty(
            name="Opacity", description="Of the colours of stretch", default=0.7, min=0.05, max=1.0, subtype="FACTOR"
        ),
        "seam_colour": _colour("New Seams", "Edges that the last refinement has cut", (0.9, 0.4, 0.0)),
        "near_colour": _colour("Too Near", "Borders nearer than the margin", (1.0, 0.45, 0.8)),
    }


#: In the order of Options.
OPTION_NAMES = tuple(Options.__dataclass_fields__)


def to_options(holder):
    """An operator's or a scene's properties as core Options."""
    return Options(**{name: getattr(holder, name) for name in OPTION_NAMES})


def copy_options(holder, operator):
    """From the scene to a button's operator."""
    for name in OPTION_NAMES:
        setattr(operator, name, getattr(holder, name))
