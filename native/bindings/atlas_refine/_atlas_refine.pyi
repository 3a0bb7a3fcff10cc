"""Types of the native module. "Gap" is a smallest distance between boundaries; E_d is 1 where nothing is distorted.

as_dict() of every class goes through json.dumps(): nested values are dicts, arrays are lists, infinity is None.
"""

from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str
_Ended: TypeAlias = Literal["not_run", "at_optimum", "enough", "stalled", "out_of_iterations", "distortion_limit", "stopped"]

class AtlasRefineError(RuntimeError):
    code: Literal["bad_option", "bad_input", "bound_not_reached", "not_certified", "cancelled"]
    stage: str
    chart: int  # 0-based, -1 where none applies
    face: int  # 0-based input face, -1 where none applies

class Progress:
    @property
    def stage(self) -> str: ...
    # input, embed, align, layout, reduce, pack, squeeze, certify, compare; of a Job that has a result: done
    @property
    def fraction(self) -> float: ...  # of the whole call, in [0, 1], never decreasing
    @property
    def pe(self) -> float: ...  # packing efficiency of the present state, 0 where unknown
    def as_dict(self) -> dict[str, Any]: ...

class Gap:
    @property
    def value(self) -> float: ...  # fraction of the unit
    @property
    def unit(self) -> Literal["diagonal", "long_side"]: ...
    def as_dict(self) -> dict[str, Any]: ...

class Measures:
    @property
    def pe(self) -> float: ...  # sum of UV triangle areas / area of the UV bounding box
    @property
    def pe_fixed_aspect(
        self,
    ) -> float: ...  # the same against the smallest box of the texture's shape; pe where the aspect is free
    @property
    def box_width(self) -> float: ...  # UV units
    @property
    def box_height(self) -> float: ...  # UV units
    @property
    def unit_square_share(self) -> float: ...  # sum of UV triangle areas: the share of the texture, where the UVs lie in [0, 1]^2
    @property
    def boundary_length(self) -> float: ...  # 3D length of all seams / diagonal of the 3D bounding box
    @property
    def seam_edges(self) -> int: ...
    @property
    def chart_count(self) -> int: ...
    @property
    def smallest_chart(self) -> float: ...  # its area / total area, on the surface
    @property
    def small_charts(self) -> int: ...  # charts under 3 % of the area
    @property
    def distortion(self) -> float: ...  # E_d under the one global scale that minimises it
    @property
    def distortion_to_input(self) -> float: ...  # E_2: the same energy from the input's UVs to these
    @property
    def stretch_99(self) -> float: ...  # area-weighted 99th percentile of max(s1, 1 / s2)
    @property
    def stretch_max(self) -> float: ...
    @property
    def gap_between(self) -> float: ...  # between two charts / box diagonal; inf with one chart
    @property
    def gap_within(self) -> float: ...  # within one chart, far apart along its border / box diagonal
    def as_dict(self) -> dict[str, Any]: ...

class Triangulations:
    """Faces of more than three corners that some division turns over, by how they are divided."""

    @property
    def fan_flipped(self) -> int: ...  # as a fan from the first corner
    @property
    def ears_flipped(self) -> int: ...  # by ear clipping: the outline crosses itself, or is turned over
    @property
    def not_convex(self) -> int: ...  # by some division
    def as_dict(self) -> dict[str, Any]: ...

class Validity:
    @property
    def valid(self) -> bool: ...
    @property
    def problem(self) -> str: ...  # empty where valid
    @property
    def chart(self) -> int: ...
    @property
    def face(self) -> int: ...
    @property
    def flipped_faces(self) -> int: ...
    @property
    def mirrored_charts(self) -> int: ...
    @property
    def crossings(self) -> int: ...  # pairs of boundary edges that cross or touch
    @property
    def triangulations(self) -> Triangulations: ...
    def as_dict(self) -> dict[str, Any]: ...

class ChartReport:
    """One chart of the input. Texel density: sqrt(UV area / surface area) / the same of the whole atlas."""

    @property
    def faces(self) -> int: ...
    @property
    def area(self) -> float: ...  # on the surface, model units squared
    @property
    def mirrored(self) -> bool: ...  # was turned over
    @property
    def re_embedded(self) -> bool: ...  # overlapped or touched itself and was embedded anew
    @property
    def fate(self) -> Literal["refined", "left", "stacked", "kept", "locked"]: ...
    @property
    def reason(self) -> str: ...  # why it was left
    @property
    def stacked_on(self) -> int: ...  # the chart that it went with, -1 where none
    @property
    def distortion_before(self) -> float: ...  # E_d of the chart alone at its own best scale
    @property
    def distortion_after(self) -> float: ...
    @property
    def stretch_max(self) -> float: ...  # after, at the atlas' global scale
    @property
    def density_before(self) -> float: ...  # 1 = as dense as the atlas
    @property
    def density_after(self) -> float: ...
    def as_dict(self) -> dict[str, Any]: ...

class PieceReport:
    """One chart of the output, where charts were cut."""

    @property
    def chart(self) -> int: ...  # index into RefineResult.charts: what it is a part of
    @property
    def faces(self) -> int: ...  # of the output
    @property
    def area(self) -> float: ...  # on the surface, model units squared
    @property
    def distortion(self) -> float: ...  # E_d of the piece alone at its own best scale
    @property
    def stretch_max(self) -> float: ...  # at the atlas' global scale
    def as_dict(self) -> dict[str, Any]: ...

class CutMesh:
    """The input's vertices come first, unchanged, then the new ones. A face that no cut crosses keeps its corners and gains one
    where a new vertex lies on one of its edges. Every array is new each time."""

    @property
    def face_offsets(self) -> NDArray[np.int32]: ...  # (F' + 1,), from 0
    @property
    def corner_vertices(self) -> NDArray[np.int32]: ...  # (C',)
    @property
    def face_sources(self) -> NDArray[np.int32]: ...  # (F',), not decreasing: the input face that each face is part of
    @property
    def corner_sources(self) -> NDArray[np.int32]: ...
    # (C', 3): input corners of that face, whose mean the corner is; one that was the input's has itself three times
    @property
    def corner_weights(self) -> NDArray[np.float64]: ...
    # (C', 3): >= 0, sum 1; sources of weight 0 repeat the heaviest
    @property
    def new_vertex_corners(self) -> NDArray[np.int32]: ...  # (N, 3): input corners, all of one face
    @property
    def new_vertex_weights(self) -> NDArray[np.float64]: ...  # (N, 3): >= 0, sum 1; the third is 0 on an edge of the face
    @property
    def new_seams(self) -> NDArray[np.int32]: ...  # (S, 2): the edges that were cut as vertex pairs, each once
    def as_dict(self) -> dict[str, Any]: ...

class RectangleReport:
    @property
    def tutte_charts(self) -> int: ...  # that Tutte's embedding onto a rectangle had to save
    @property
    def boxed_charts(self) -> int: ...  # packed by their bounding box as they were
    @property
    def holes_cut(self) -> int: ...  # boundary loops that were joined to the outer one
    @property
    def extra_corners(self) -> int: ...  # added to each chart because the bound was missed without
    @property
    def trails(self) -> int: ...  # that the charts were cut along
    @property
    def packed_pe(self) -> float: ...  # of the rectangles, before the distortion was reduced
    def as_dict(self) -> dict[str, Any]: ...

class TradeOff:
    """One outcome of the search for cuts: no other has both less boundary and less distortion."""

    @property
    def boundary_growth(self) -> float: ...
    @property
    def distortion(self) -> float: ...  # E_d
    @property
    def cuts(self) -> int: ...
    def as_dict(self) -> dict[str, Any]: ...

class CutReport:
    """How the search for cuts went."""

    @property
    def cuts(self) -> int: ...  # from border to border, or to a point inside
    @property
    def tried(self) -> int: ...  # sets of cuts whose outcome was forecast
    @property
    def trade_off(self) -> list[TradeOff]: ...  # by growth; with several groups empty
    @property
    def chosen(self) -> int: ...  # index into it of the result; -1 where it is empty
    def as_dict(self) -> dict[str, Any]: ...

class Repair:
    """What was mended in charts before they were refined."""

    @property
    def what(self) -> str: ...
    @property
    def charts(self) -> list[int]: ...
    @property
    def faces(self) -> list[int]: ...  # that were at fault; empty where the charts as a whole were
    @property
    def distortion_to_input(self) -> float: ...  # E_2 over the faces that were not at fault
    @property
    def text(self) -> str: ...  # all of it in one line
    def as_dict(self) -> dict[str, Any]: ...

class GroupReport:
    """One atlas of several."""

    @property
    def group(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def charts(self) -> int: ...  # that took part
    @property
    def intervention(self) -> Literal["unchanged", "moved", "squeezed", "cut"]: ...
    @property
    def bound_met(self) -> bool: ...
    @property
    def reason(self) -> str: ...  # why its charts keep their UVs; empty where they are refined
    @property
    def before(self) -> Measures: ...  # but for seams
    @property
    def after(self) -> Measures: ...
    @property
    def gap(self) -> Gap: ...
    def as_dict(self) -> dict[str, Any]: ...

class Profile:
    @property
    def phases(self) -> dict[str, float]: ...  # processor seconds of each kind of work: "order", "factor", ..., "other"
    @property
    def steps(self) -> int: ...  # Newton steps under contact, on coarse charts and for forecasts as well
    @property
    def mean_step(self) -> float: ...  # the mean part of them that was taken
    def as_dict(self) -> dict[str, Any]: ...

class RefineResult:
    @property
    def corner_uvs(self) -> NDArray[np.float64]: ...  # (C, 2) of `cut` or, without it, of the input; a new array
    @property
    def cut(self) -> CutMesh | None: ...  # None where neither faces were divided nor seams added
    @property
    def intervention(self) -> Literal["unchanged", "moved", "squeezed", "cut"]: ...
    @property
    def bound_met(self) -> bool: ...  # False only with best_effort, where PE is below the bound
    @property
    def before(self) -> Measures: ...
    @property
    def after(self) -> Measures: ...
    @property
    def added_seams(self) -> int: ...  # edges that were whole in the UV map and are torn
    @property
    def boundary_growth(self) -> float: ...  # what cuts add to the charts' boundary on the surface, as a fraction of it
    @property
    def new_seams(self) -> NDArray[np.int32]: ...  # (S, 2): vertex pairs that were cut where no face was divided
    @property
    def triangulations(self) -> Triangulations: ...
    @property
    def gap(self) -> Gap: ...  # guaranteed in the result
    @property
    def price(self) -> float: ...  # marginal objective for one unit of log PE at the bound
    @property
    def iterations(self) -> int: ...  # Newton iterations, all stages
    @property
    def ended(self) -> _Ended: ...  # why the last optimisation did
    @property
    def charts(self) -> list[ChartReport]: ...  # one for each chart of the input, by their smallest face
    @property
    def face_charts(self) -> NDArray[np.int32]: ...  # (F,) of the input: index into `charts`
    @property
    def pieces(self) -> list[PieceReport]: ...  # one for each chart of the output; empty unless "cut"
    @property
    def cuts(self) -> CutReport | None: ...  # only with "needed" seams, where the input was not good enough as it is
    @property
    def rectangles(self) -> RectangleReport | None: ...  # only where the charts were cut
    @property
    def groups(self) -> list[GroupReport]: ...  # empty without `groups`
    @property
    def repairs(self) -> list[Repair]: ...  # what was mended and where
    @property
    def fallbacks(self) -> list[str]: ...  # what was tried first, and what was done instead
    @property
    def warnings(self) -> list[str]: ...
    @property
    def timings(self) -> dict[str, float]: ...  # seconds per stage, all attempts and groups together
    @property
    def profile(self) -> Profile: ...
    def as_dict(self) -> dict[str, Any]: ...

class Job:
    @property
    def done(self) -> bool: ...
    @property
    def progress(self) -> Progress: ...
    def cancel(self) -> None: ...
    def finish(self) -> None: ...  # with the best valid atlas so far
    def wait(self, timeout: float | None = None) -> bool: ...
    def result(self) -> RefineResult: ...

def refine(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    pe_bound: float = 0.8,
    seams: Literal["none", "needed", "rectangles"] = "none",
    box_aspect: float = 0.0,
    in_texture: bool = False,
    gap: float | None = None,
    gap_unit: Literal["diagonal", "long_side"] = "diagonal",
    max_distortion: float | None = None,
    max_stretch: float | None = None,
    max_boundary_growth: float | None = None,
    seam_cost: float = 0.1,
    effort: Literal["fast", "normal", "best"] = "normal",
    trade_off: bool = False,
    point: int | None = None,
    relax: bool = False,
    best_effort: bool = False,
    density: Literal["equal", "keep"] = "equal",
    uv_density: float = 0.0,
    stored: Literal["double", "float32"] = "double",
    sigma: float = 0.004,
    candidates: int = 500,
    omega: float = 0.1,
    until_input: bool = False,
    reference: Literal["surface", "input"] = "surface",
    importance: ArrayLike | None = None,
    cut: Literal["split", "edges"] = "split",
    open_closed: bool = False,
    stacks: Literal["keep", "separate"] = "keep",
    stack_groups: ArrayLike | None = None,
    collapsed: Literal["leave", "embed"] = "leave",
    rotate: Literal["any", "90", "none"] = "any",
    align_axes: bool = False,
    triangulate: bool = False,
    groups: ArrayLike | None = None,
    group_origins: ArrayLike | None = None,
    group_aspects: Sequence[float] | None = None,
    group_gaps: Sequence[float] | None = None,
    group_densities: Sequence[float] | None = None,
    group_names: Sequence[str] | None = None,
    keep_shape: ArrayLike | None = None,
    locked: ArrayLike | None = None,
    no_seam: ArrayLike | None = None,
    prefer_seam: ArrayLike | None = None,
    triangles: ArrayLike | None = None,
    seed: int = 1,
    threads: int = 0,
    progress: Callable[[Progress], bool | Literal["finish"] | None] | None = None,
    name: str = "",
) -> RefineResult: ...
def start(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    pe_bound: float = 0.8,
    seams: Literal["none", "needed", "rectangles"] = "none",
    box_aspect: float = 0.0,
    in_texture: bool = False,
    gap: float | None = None,
    gap_unit: Literal["diagonal", "long_side"] = "diagonal",
    max_distortion: float | None = None,
    max_stretch: float | None = None,
    max_boundary_growth: float | None = None,
    seam_cost: float = 0.1,
    effort: Literal["fast", "normal", "best"] = "normal",
    trade_off: bool = False,
    point: int | None = None,
    relax: bool = False,
    best_effort: bool = False,
    density: Literal["equal", "keep"] = "equal",
    uv_density: float = 0.0,
    stored: Literal["double", "float32"] = "double",
    sigma: float = 0.004,
    candidates: int = 500,
    omega: float = 0.1,
    until_input: bool = False,
    reference: Literal["surface", "input"] = "surface",
    importance: ArrayLike | None = None,
    cut: Literal["split", "edges"] = "split",
    open_closed: bool = False,
    stacks: Literal["keep", "separate"] = "keep",
    stack_groups: ArrayLike | None = None,
    collapsed: Literal["leave", "embed"] = "leave",
    rotate: Literal["any", "90", "none"] = "any",
    align_axes: bool = False,
    triangulate: bool = False,
    groups: ArrayLike | None = None,
    group_origins: ArrayLike | None = None,
    group_aspects: Sequence[float] | None = None,
    group_gaps: Sequence[float] | None = None,
    group_densities: Sequence[float] | None = None,
    group_names: Sequence[str] | None = None,
    keep_shape: ArrayLike | None = None,
    locked: ArrayLike | None = None,
    no_seam: ArrayLike | None = None,
    prefer_seam: ArrayLike | None = None,
    triangles: ArrayLike | None = None,
    seed: int = 1,
    threads: int = 0,
    name: str = "",
) -> Job: ...
def measure(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    box_aspect: float = 0.0,
    in_texture: bool = False,
    triangles: ArrayLike | None = None,
    name: str = "",
) -> Measures: ...
def validate(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    name: str = "",
) -> Validity: ...
def charts_of_faces(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    groups: ArrayLike | None = None,
    name: str = "",
) -> NDArray[np.int32]: ...
def find_problems(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    triangles: ArrayLike | None = None,
    name: str = "",
) -> dict[Literal["unwrapped", "zero_area", "flipped", "mirrored", "overlapping"], NDArray[np.int32]]: ...
def group_by_tile(
    positions: ArrayLike,
    face_offsets: ArrayLike,
    corner_vertices: ArrayLike,
    corner_uvs: ArrayLike,
    *,
    name: str = "",
) -> tuple[NDArray[np.int32], NDArray[np.float64], list[str]]: ...
