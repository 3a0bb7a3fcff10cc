# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist asked for, in the engine's words."""

from dataclasses import dataclass, fields, replace


@dataclass(frozen=True)
class Texture:
    """The image that the UVs are for."""

    name: str
    width: int
    height: int
    is_tiled: bool = False
    active_tile: int = 1001
    tiles: tuple = ()  # numbers of those that a tiled one has


#: Least values of options that Blender must not raise in silence: what a script says is to be refused.
LEAST = {"texel_density": 0.001}


@dataclass(frozen=True)
class Options:
    pe_bound: float = 0.8
    aspect: str = "TEXTURE"  # TEXTURE, SQUARE or FREE
    seams: str = "NONE"  # NONE, NEEDED or RECTANGLES
    cut: str = "EDGES"  # EDGES or SPLIT: along the mesh's edges, or across faces
    gap: str = "PIXELS"  # PIXELS or AUTO
    gap_px: float = 4.0
    texture_size: int = 2048  # where aspect does not take it from an image
    stacks: str = "KEEP"  # KEEP or SEPARATE
    density: str = "KEEP"  # KEEP, EQUAL or VALUE: equal, and as much as texel_density
    texel_density: float = 512.0  # pixels per metre
    atlases: str = "ALL"  # ALL, OBJECT or MATERIAL
    tiles: str = "TEXTURE"  # TEXTURE, EACH, ACTIVE or ONE
    uv_map: str = ""  # name or index; empty: the active one
    write_to: str = "MAP"  # MAP or COPY
    mark_seams: bool = True
    keep_shape: str = ""  # names of vertex groups and attributes, here and below
    importance: str = ""
    no_seam: str = ""
    prefer_seam: str = ""
    relax: bool = False
    max_distortion: float = 0.0  # 0: no limit, and with NEEDED cuts where they pay
    max_stretch: float = 0.0  # the same
    limit_new_seams: bool = False  # of NEEDED, like the three below
    most_new_seams: float = 20.0  # per cent of the borders of all charts
    seam_cost: float = 0.1
    effort: str = "NORMAL"  # FAST, NORMAL or BEST
    open_closed: bool = True
    best_effort: bool = False
    sigma: float = 0.004  # of RECTANGLES, like candidates
    candidates: int = 500
    seed: int = 1
    threads: int = 0  # 0: all

    def __post_init__(self):
        """Blender's properties are float32: 0.8 arrives as 0.800000012."""
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, float):
                object.__setattr__(self, field.name, round(value, 6))

    @property
    def refusal(self):
        """(what, why) no run can be of these; None where one can."""
        least = LEAST["texel_density"]
        if self.density != "VALUE" or self.texel_density >= least:
            return None
        return "Pixels per Metre", f"it has to be {least:g} at least, not {self.texel_density:g}"

    def engine_arguments(self, texture=None):
        """Keywords of atlas_refine.start(), for UVs that are stored as float32; `texture`: of the atlas, where there is one."""
        arguments = {
            "pe_bound": self.pe_bound,
            **self.box_arguments(texture),
            "seams": self.seams.lower(),
            "cut": self.cut.lower(),
            "open_closed": self.open_closed,
            "stacks": self.stacks.lower(),
            "density": "keep" if self.density == "KEEP" else "equal",
            "relax": self.relax,
            "seed": self.seed,
            "best_effort": self.best_effort,
            "stored": "float32",
        }
        if self.max_distortion != 0:  # the engine refuses what is below 1
            arguments["max_distortion"] = self.max_distortion
        if self.max_stretch != 0:
            arguments["max_stretch"] = self.max_stretch
        if self.seams == "RECTANGLES":
            arguments.update(sigma=self.sigma, candidates=self.candidates)
        if self.seams == "NEEDED":
            arguments.update(self._arguments_of_cuts())
        if self.gap == "PIXELS":
            arguments.update(gap=self.gap_px / self.pixels(texture), gap_unit="long_side")
        return arguments

    def arguments_of_groups(self, textures):
        """Keywords for boxes that differ; `textures`: of each group. The others are those of engine_arguments(textures[0])."""
        aspects = [self.box_arguments(texture)["box_aspect"] for texture in textures]
        gaps = [self.gap_px / self.pixels(texture) for texture in textures]
        arguments = {"group_aspects": aspects} if len(set(aspects)) > 1 else {}
        if self.gap == "PIXELS" and len(set(gaps)) > 1:
            arguments["group_gaps"] = gaps
        return arguments

    def uv_densities(self, textures, metres):
        """The wanted density for each of these textures: UV units, of a texture's height, for each of a model's units, which are so
        many metres; empty where none is asked for."""
        if self.density != "VALUE":
            return []
        return [self.texel_density * metres / self.texture_pixels(texture)[1] for texture in textures]

    def for_trade_off(self):
        """The limits choose one outcome; for all there are they do not count."""
        return replace(self, seams="NEEDED", max_distortion=0.0, max_stretch=0.0, limit_new_seams=False)

    def _arguments_of_cuts(self):
        arguments = {"seam_cost": self.seam_cost, "effort": self.effort.lower()}
        if self.limit_new_seams:
            arguments["max_boundary_growth"] = round(self.most_new_seams / 100, 6)
        return arguments

    def box_arguments(self, texture=None):
        """The shape of the box, also for atlas_refine.measure()."""
        if self.aspect == "FREE":
            return {"box_aspect": 0.0, "in_texture": False}
        ratio = texture.width / texture.height if self.takes_image(texture) else 1.0
        return {"box_aspect": min(max(ratio, 0.01), 100.0), "in_texture": True}

    def notes_on_margins(self, textures):
        """Where the box does not take an image's shape, the margin is not of its pixels."""
        if self.gap != "PIXELS" or self.aspect == "TEXTURE":
            return
        for texture in dict.fromkeys(filter(None, textures)):
            size = texture.width, texture.height
            across, up = (self.gap_px * pixels / self.texture_size for pixels in size)
            if min(across, up) < self.gap_px and texture.width != texture.height:
                margin = f"the margin of {self.gap_px:g} px of {self.texture_size} is {across:.3g} px across and {up:.3g} px up"
                yield f"packed for square pixels: in {texture.name}, {size[0]} x {size[1]}, {margin}. Aspect: Texture takes its shape"

    def pixels(self, texture=None):
        """Of the texture's longer side."""
        return max(self.texture_pixels(texture))

    def texture_pixels(self, texture=None):
        """(width, height)"""
        return (texture.width, texture.height) if self.takes_image(texture) else (self.texture_size,) * 2

    def takes_image(self, texture):
        """The texture's size is an image's."""
        return texture is not None and self.aspect == "TEXTURE"

    @property
    def wanted_density(self):
        """In pixels per metre, 0 where none is asked for."""
        return self.texel_density if self.density == "VALUE" else 0.0

    def tiles_of(self, texture):
        """EACH, ACTIVE or ONE."""
        if self.tiles != "TEXTURE":
            return self.tiles
        return "EACH" if texture and texture.is_tiled else "ONE"
