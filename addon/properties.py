# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a refinement as Blender properties, for the operator, the scene and the preferences."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from .core.options import Options

OPTION_NAMES = (
    "pe_bound",
    "seams",
    "cut",
    "open_closed",
    "stacks",
    "sigma",
    "aspect",
    "density",
    "gap",
    "gap_px",
    "texture_size",
    "seed",
    "best_effort",
)


def pe_bound_property(**more):
    return FloatProperty(
        name="PE Bound",
        description="Packing efficiency to reach: the part of the UV box that charts cover",
        default=Options.pe_bound,
        soft_min=0.05,
        soft_max=0.99,  # soft, here and below: a script's 1.2 must reach the engine and be refused there, not be cut off in silence
        step=1,
        precision=3,
        **more,
    )


#: Their numbers are stored in files.
SEAMS = [
    ("NONE", "None", "Charts bend inside a shrinking box; the mesh stays as it is", 0),
    (
        "RECTANGLES",
        "Rectangles (Liu et al. 2019)",
        "Charts are cut towards rectangles, which pack; adds seams",
        1,
    ),
]


def seams_property(**more):
    return EnumProperty(
        name="Seams",
        description="Where new seams may come from",
        items=SEAMS,
        default=Options.seams,
        **more,
    )


def sigma_property(**more):
    return FloatProperty(
        name="Sigma",
        description="Smoothing of the chart borders' directions, as a part of their length; for the seams mode Rectangles",
        default=Options.sigma,
        soft_min=0.0001,
        soft_max=0.1,
        step=0.1,
        precision=4,
        **more,
    )


def other_properties():
    """The options that have no preference."""
    return {
        "cut": EnumProperty(
            name="Cut",
            description="Where new seams run",
            items=[
                ("EDGES", "Along Edges", "Only edges of the mesh become seams: its faces stay as they are"),
                ("SPLIT", "Across Faces", "Seams are straight and divide the faces that they cross"),
            ],
            default=Options.cut,
        ),
        "open_closed": BoolProperty(
            name="Open Closed Charts",
            description="A chart without a border cannot be flat: open it along edges, which become seams",
            default=Options.open_closed,
        ),
        "stacks": EnumProperty(
            name="Stacks",
            description="Charts of one shape that lie on each other, mirrored ones too",
            items=[
                ("KEEP", "Keep", "They stay on each other and share their part of the texture"),
                ("SEPARATE", "Separate", "Each gets a place of its own"),
            ],
            default=Options.stacks,
        ),
        "aspect": EnumProperty(
            name="Aspect",
            description="Shape of the UV box",
            items=[
                ("FREE", "Free", "Any box: the one that distorts the charts least"),
                ("SQUARE", "Square", "A square box, for square textures"),
            ],
            default=Options.aspect,
        ),
        "density": EnumProperty(
            name="Density",
            description="Relative texel density of the charts",
            items=[
                ("KEEP", "Keep", "Each chart keeps the relative scale it has, as far as bending leaves it that"),
                ("EQUAL", "Equal", "One texel density for the whole surface"),
            ],
            default=Options.density,
        ),
        "gap": EnumProperty(
            name="Gap",
            description="Smallest distance between two charts",
            items=[
                ("AUTO", "Automatic", "0.25 % of the box's diagonal, less where charts jam or distort too much"),
                ("PIXELS", "Pixels", "So many pixels at a texture size, whatever it takes"),
            ],
            default=Options.gap,
        ),
        "gap_px": FloatProperty(
            name="Gap Pixels",
            description="Smallest distance between two charts in pixels, where Gap is Pixels",
            default=Options.gap_px,
            min=0.0,
            soft_max=64.0,
            max=1024.0,
        ),
        "texture_size": IntProperty(
            name="Texture Size",
            description="Pixels of the texture's longer side, where Gap is Pixels",
            default=Options.texture_size,
            min=16,
            max=65536,
        ),
        "seed": IntProperty(name="Seed", description="The same seed gives the same result", default=Options.seed, min=0),
        "best_effort": BoolProperty(
            name="Best Effort",
            description="Where the bound is not reached, take the best valid UV map that was found",
            default=Options.best_effort,
        ),
    }


def to_options(holder):
    """An operator's or a scene's properties as core Options."""
    return Options(**{name: getattr(holder, name) for name in OPTION_NAMES})
