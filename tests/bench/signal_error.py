"""Signal approximation error (section 4): what a texture of an atlas loses of a signal on the surface.

The signal is a checkerboard in space, 100 cells along each side of the mesh's bounding box, 0 and 1. The texture stores it at the centre of
every texel that the atlas covers, its borders dilated; the error is the mean over the surface of the squared difference between the
texture, read bilinearly, and the signal [Sander et al. 2002]. A chart that lies on another overwrites it.
"""

import numpy as np
from triangles import least_energy_triangles

CELLS = 100
TEXTURE = 4096
SAMPLES = 2_000_000
DILATIONS = 2  # a bilinear look-up reaches one texel beyond a border
AT_ONCE = 2_000_000  # texels or samples


class Checkerboard:
    def __init__(self, positions):
        self.low, size = positions.min(axis=0), np.ptp(positions, axis=0)
        self.cells_per_unit = np.divide(CELLS, size, out=np.zeros(3), where=size > 0)

    def __call__(self, points):
        cells = np.minimum((points - self.low) * self.cells_per_unit, CELLS - 1).astype(np.int32)
        return (cells.sum(axis=1) & 1).astype(np.float32)


class Surface:
    """An atlas' triangles in texel units of a square texture, whose side is the longer side of the atlas."""

    def __init__(self, obj, texture):
        corners = least_energy_triangles(obj)
        self.space = obj.positions[obj.corner_vertex[corners]]
        uv = obj.corner_uv - obj.corner_uv.min(axis=0)
        self.plane = (uv * (texture / np.ptp(uv, axis=0).max()))[corners]
        self.signal = Checkerboard(obj.positions[obj.corner_vertex])


def pieces(counts, at_once):
    """Slices of the counted things with about `at_once` counts in each."""
    total, start = np.cumsum(counts), 0
    while start < len(counts):
        end = int(np.searchsorted(total, (total[start - 1] if start else 0) + at_once, "right"))
        yield slice(start, max(end, start + 1))
        start = max(end, start + 1)


def steps(counts):
    """0 .. count - 1 for each count, one after the other, and whose step each is."""
    owner = np.repeat(np.arange(len(counts)), counts)
    return np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts), owner


def rows_of(plane):
    """For each triangle and each row of texel centres that it meets: triangle, row, first texel, number of texels."""
    first = np.ceil(plane[:, :, 1].min(axis=1) - 0.5).astype(np.int64)
    count = np.maximum(np.floor(plane[:, :, 1].max(axis=1) - 0.5).astype(np.int64) - first + 1, 0)
    step, triangle = steps(count)
    row = first[triangle] + step
    y = row + 0.5
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for k in range(3):
        a, b = plane[triangle, k], plane[triangle, (k + 1) % 3]
        rise = b[:, 1] - a[:, 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (y - a[:, 1]) / rise
            x = np.where((t >= 0) & (t <= 1), a[:, 0] + t * (b[:, 0] - a[:, 0]), np.nan)
        left, right = np.fmin(left, x), np.fmax(right, x)
    met = right >= left
    begin = np.ceil(np.where(met, left, 0) - 0.5).astype(np.int64)
    texels = np.where(met, np.floor(np.where(met, right, 0) - 0.5).astype(np.int64) - begin + 1, 0)
    return triangle, row, begin, np.maximum(texels, 0)


def gradients(surface):
    """How the point on the surface moves with the texel, for each triangle; 0 where the triangle has no area in the texture."""
    d1, d2 = surface.plane[:, 1] - surface.plane[:, 0], surface.plane[:, 2] - surface.plane[:, 0]
    e1, e2 = surface.space[:, 1] - surface.space[:, 0], surface.space[:, 2] - surface.space[:, 0]
    det = d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]
    inverse = np.divide(1, det, out=np.zeros_like(det), where=det != 0)[:, None]
    along_x = (e1 * d2[:, 1:] - e2 * d1[:, 1:]) * inverse
    along_y = (e2 * d1[:, :1] - e1 * d2[:, :1]) * inverse
    return along_x, along_y


def texture_of(surface, size):
    """(texture, what is covered): the signal at the centres of covered texels."""
    texture, covered = np.zeros((size, size), np.float32), np.zeros((size, size), bool)
    along_x, along_y = gradients(surface)
    triangle, row, begin, texels = rows_of(surface.plane)
    for part in pieces(texels, AT_ONCE):
        step, span = steps(texels[part])
        t, y, x = triangle[part][span], row[part][span], begin[part][span] + step
        inside = (x >= 0) & (x < size) & (y >= 0) & (y < size)
        t, x, y = t[inside], x[inside], y[inside]
        from_corner = np.stack([x + 0.5, y + 0.5], axis=1) - surface.plane[t, 0]
        texture[y, x] = surface.signal(surface.space[t, 0] + from_corner[:, :1] * along_x[t] + from_corner[:, 1:] * along_y[t])
        covered[y, x] = True
    return texture, covered


def sum_of_three_by_three(image):
    for axis in (0, 1):
        low, middle, high = (np.moveaxis(image, axis, 0)[part] for part in (slice(None, -1), slice(None), slice(1, None)))
        total = middle.copy()
        total[1:] += low
        total[:-1] += high
        image = np.moveaxis(total, 0, axis)
    return image


def dilated(texture, covered):
    """Each texel beside a covered one gets the mean of its covered neighbours. Texels that are not covered must be 0."""
    for _ in range(DILATIONS):
        count = sum_of_three_by_three(covered.astype(np.float32))
        grown = ~covered & (count > 0)
        texture[grown] = sum_of_three_by_three(texture)[grown] / count[grown]
        covered = covered | grown
    return texture


def surface_samples(space, count):
    """Triangles and barycentrics, spread evenly over the surface: strata of equal area, an R2 sequence in each triangle."""
    area = np.linalg.norm(np.cross(space[:, 1] - space[:, 0], space[:, 2] - space[:, 0]), axis=1)
    k = np.arange(count)
    triangle = np.searchsorted(np.cumsum(area), (k + 0.5) / count * area.sum(), "right")
    a, b = (k * 0.7548776662466927) % 1, (k * 0.5698402909980532) % 1
    over = a + b > 1
    a, b = np.where(over, 1 - a, a), np.where(over, 1 - b, b)
    return np.minimum(triangle, len(space) - 1), np.stack([1 - a - b, a, b], axis=1)


def bilinear(texture, points):
    """The texture at points in texel units."""
    size = len(texture)
    at = np.clip(points - 0.5, 0, size - 1)
    cell = np.minimum(at.astype(np.int64), size - 2)
    x, y = (at - cell).T
    i, j = cell.T
    low = texture[j, i] * (1 - x) + texture[j, i + 1] * x
    high = texture[j + 1, i] * (1 - x) + texture[j + 1, i + 1] * x
    return low * (1 - y) + high * y


def signal_error(obj, texture=TEXTURE, samples=SAMPLES):
    surface = Surface(obj, texture)
    image = dilated(*texture_of(surface, texture))
    triangle, weights = surface_samples(surface.space, samples)
    total = 0.0
    for start in range(0, samples, AT_ONCE):
        t, w = triangle[start : start + AT_ONCE], weights[start : start + AT_ONCE, :, None]
        truth = surface.signal((surface.space[t] * w).sum(axis=1))
        read = bilinear(image, (surface.plane[t] * w).sum(axis=1))
        total += float(((read - truth) ** 2).sum())
    return total / samples
