"""The mannequin: one lofted figure on a stand, its mesh, and its distance field for the cloth.

+Y up, metres, floor at y = 0, facing +Z. A section at height y is a superellipse around the point (0, y, centre),
with half width `a`, front depth and back depth, plus soft bumps (bust, seat). Measures: bust 86, waist 64, hip 92 cm.
"""
import numpy as np

#         y      a      front  back   n    centre
SECTIONS = np.array([
    [0.740, 0.110, 0.078, 0.088, 2.2, 0.000],
    [0.760, 0.140, 0.090, 0.100, 2.2, 0.000],
    [0.800, 0.162, 0.098, 0.112, 2.2, 0.000],
    [0.860, 0.170, 0.103, 0.116, 2.2, 0.000],
    [0.920, 0.162, 0.102, 0.108, 2.2, 0.000],
    [0.980, 0.140, 0.094, 0.090, 2.2, 0.002],
    [1.020, 0.123, 0.084, 0.078, 2.2, 0.003],
    [1.060, 0.115, 0.079, 0.074, 2.2, 0.003],
    [1.100, 0.119, 0.082, 0.078, 2.2, 0.003],
    [1.160, 0.130, 0.090, 0.086, 2.2, 0.001],
    [1.220, 0.139, 0.097, 0.092, 2.2, -0.001],
    [1.280, 0.146, 0.094, 0.096, 2.2, -0.003],
    [1.330, 0.159, 0.086, 0.096, 2.2, -0.006],
    [1.365, 0.165, 0.076, 0.088, 2.2, -0.010],
    [1.385, 0.158, 0.068, 0.080, 2.1, -0.013],
    [1.405, 0.132, 0.061, 0.072, 2.0, -0.016],
    [1.425, 0.092, 0.055, 0.063, 2.0, -0.017],
    [1.445, 0.063, 0.051, 0.056, 2.0, -0.016],
    [1.470, 0.053, 0.049, 0.052, 2.0, -0.012],
    [1.500, 0.050, 0.049, 0.050, 2.0, -0.006],
    [1.520, 0.051, 0.056, 0.052, 2.0, 0.000],
    [1.540, 0.057, 0.068, 0.060, 2.0, 0.004],
    [1.570, 0.065, 0.083, 0.075, 2.0, 0.006],
    [1.610, 0.072, 0.090, 0.088, 2.0, 0.006],
    [1.650, 0.074, 0.090, 0.093, 2.0, 0.004],
    [1.690, 0.069, 0.080, 0.086, 2.0, 0.000],
    [1.715, 0.057, 0.066, 0.072, 2.0, -0.003],
    [1.730, 0.042, 0.047, 0.052, 2.0, -0.004],
])
Y0, Y1, DY = 0.742, 1.728, 0.001
N_THETA = 720


def _smooth(values, sigma_rows):
    half = int(4 * sigma_rows)
    kernel = np.exp(-0.5 * (np.arange(-half, half + 1) / sigma_rows) ** 2)
    padded = np.concatenate([2 * values[0] - values[half:0:-1], values, 2 * values[-1] - values[-2:-half - 2:-1]])
    return np.convolve(padded, kernel / kernel.sum(), mode="valid")


class Figure:
    """Radius table R(y, theta) around (0, y, centre(y)); theta = 0 faces +Z and grows towards +X."""

    def __init__(self):
        self.y = np.arange(Y0, Y1 + DY / 2, DY)
        a, front, back, power, self.centre = (
            _smooth(np.interp(self.y, SECTIONS[:, 0], SECTIONS[:, k]), 9.0) for k in range(1, 6))
        # To the measures: bust 86, waist 64, hip 92 cm.
        fit = _smooth(np.interp(self.y, [0.80, 0.865, 0.98, 1.06, 1.16, 1.22, 1.30, 1.36],
                                [1.0, 1.006, 1.015, 1.026, 1.04, 1.058, 1.04, 1.0]), 9.0)
        a, front, back = a * fit, front * fit, back * fit
        self.theta = np.arange(N_THETA) * 2 * np.pi / N_THETA
        s, c = np.sin(self.theta), np.cos(self.theta)
        blend = 0.5 + 0.5 * np.tanh(c / 0.15)  # front to back without a crease at the side
        depth = blend * front[:, None] + (1 - blend) * back[:, None]
        n = power[:, None]
        radius = (np.abs(s / a[:, None]) ** n + np.abs(c / depth) ** n) ** (-1 / n)
        x, y = radius * s, self.y[:, None]
        for side in (-1, 1):
            above = y > 1.215
            fall = np.where(above, 0.052, 0.040)  # fuller below than above
            bust = np.exp(-0.5 * ((x - side * 0.078) / 0.043) ** 2 - 0.5 * ((y - 1.215) / fall) ** 2)
            seat = np.exp(-0.5 * ((x - side * 0.062) / 0.055) ** 2 - 0.5 * ((y - 0.870) / 0.065) ** 2)
            radius = radius + 0.040 * bust * np.clip(c + 0.1, 0, 1) + 0.014 * seat * np.clip(-c, 0, 1)
        self.radius = radius

    def section(self, y):
        """Closed polygon (N_THETA, 2) of x, z at height y."""
        k = np.clip((y - Y0) / DY, 0, len(self.y) - 1.001)
        i, f = int(k), k - int(k)
        r = (1 - f) * self.radius[i] + f * self.radius[i + 1]
        centre = (1 - f) * self.centre[i] + f * self.centre[i + 1]
        return np.stack([r * np.sin(self.theta), r * np.cos(self.theta) + centre], axis=1)

    def implicit(self, p):
        """Radial excess over the surface; its sign is inside (-) and outside (+)."""
        yy = np.clip(p[:, 1], Y0, Y1)
        z = p[:, 2] - np.interp(yy, self.y, self.centre)
        ky = np.clip((yy - Y0) / DY, 0, len(self.y) - 1.001)
        kt = (np.arctan2(p[:, 0], z) / (2 * np.pi) % 1.0) * N_THETA
        i, j = ky.astype(int), kt.astype(int) % N_THETA
        fy, ft, j2 = ky - i, kt - kt.astype(int), (j + 1) % N_THETA
        r = ((1 - fy) * ((1 - ft) * self.radius[i, j] + ft * self.radius[i, j2])
             + fy * ((1 - ft) * self.radius[i + 1, j] + ft * self.radius[i + 1, j2]))
        return np.hypot(p[:, 0], z) - r


class DistanceField:
    """Signed distance of the torso on a regular grid, first order accurate near the surface."""

    def __init__(self, figure, cell=0.006):
        self.cell, self.low = cell, np.array([-0.24, 0.745, -0.20])
        shape = np.ceil((np.array([0.24, 1.52, 0.20]) - self.low) / cell).astype(int) + 1
        grid = np.stack(np.meshgrid(*(np.arange(n) * cell for n in shape), indexing="ij"), axis=-1) + self.low
        f = figure.implicit(grid.reshape(-1, 3)).reshape(shape)
        gradient = np.stack(np.gradient(f, cell), axis=-1)
        length = np.maximum(np.linalg.norm(gradient, axis=-1), 0.5)
        self.table = np.concatenate([gradient / length[..., None], (f / length)[..., None]], axis=-1)
        self.shape = shape

    def sample(self, p):
        """Distance and unit outward direction; far outside the grid the distance is 1."""
        k = (p - self.low) / self.cell
        inside = np.all((k >= 0) & (k < self.shape - 1.001), axis=1)
        distance, normal = np.ones(len(p)), np.zeros_like(p)
        k = k[inside]
        i = k.astype(int)
        f = k - i
        flat = self.table.reshape(-1, 4)
        stride = np.array([self.shape[1] * self.shape[2], self.shape[2], 1])
        base = i @ stride
        out = 0.0
        for corner in range(8):
            bits = np.array([corner >> 2 & 1, corner >> 1 & 1, corner & 1])
            weight = np.prod(np.where(bits, f, 1 - f), axis=1)
            out = out + weight[:, None] * flat[base + bits @ stride]
        distance[inside] = out[:, 3]
        normal[inside] = out[:, :3] / np.maximum(np.linalg.norm(out[:, :3], axis=1), 1e-9)[:, None]
        return distance, normal


# ---- mesh -----------------------------------------------------------------------------------------------------------

class _Builder:
    def __init__(self):
        self.v, self.vt, self.groups = [], [], []

    def group(self, name):
        self.groups.append((name, []))

    def vertex(self, p):
        self.v.append(tuple(p))
        return len(self.v) - 1

    def uv(self, q):
        self.vt.append(tuple(q))
        return len(self.vt) - 1

    def face(self, corners, uvs):
        self.groups[-1][1].append((corners, uvs))

    def loft(self, rings):
        """Rings from bottom to top, each (columns, 3); returns the vertex ids per ring. UV about in metres."""
        columns = rings.shape[1]
        ids = [[self.vertex(p) for p in ring] for ring in rings]
        step = np.linalg.norm(np.diff(rings, axis=0), axis=2).mean(axis=1)
        v = np.concatenate([[0], np.cumsum(step)])
        width = np.linalg.norm(np.roll(rings, -1, axis=1) - rings, axis=2).sum(axis=1).max()
        uv = [[self.uv((width * i / columns, h)) for i in range(columns + 1)] for h in v]
        for j in range(len(rings) - 1):
            for i in range(columns):
                n = (i + 1) % columns
                self.face((ids[j][i], ids[j][n], ids[j + 1][n], ids[j + 1][i]),
                          (uv[j][i], uv[j][i + 1], uv[j + 1][i + 1], uv[j + 1][i]))
        return ids

    def cap(self, ring_ids, height):
        """Closes a ring of 4k vertices with a k x k grid of quads bulging by `height` (negative: a bottom)."""
        k = len(ring_ids) // 4
        ring = np.array([self.v[i] for i in ring_ids])
        centre = ring.mean(axis=0)
        edge = ([(i, 0) for i in range(k)] + [(k, i) for i in range(k)]
                + [(k - i, k) for i in range(k)] + [(0, k - i) for i in range(k)])
        order = ring_ids if height >= 0 else ring_ids[::-1]
        ids = dict(zip(edge, order))
        point_of = dict(zip(edge, [np.array(self.v[i]) for i in order]))
        for i in range(1, k):
            for j in range(1, k):
                a, b = 2 * i / k - 1, 2 * j / k - 1
                q = max(abs(a), abs(b))
                if q < 1e-9:
                    ids[i, j] = self.vertex(centre + [0, height, 0])
                    continue
                # Where the ray from the middle leaves the square, between two ring vertices.
                ea, eb = (a / q + 1) * k / 2, (b / q + 1) * k / 2
                lo = (int(np.floor(ea + 1e-9)), int(np.floor(eb + 1e-9)))
                hi = (int(np.ceil(ea - 1e-9)), int(np.ceil(eb - 1e-9)))
                f = (ea - lo[0]) + (eb - lo[1])
                p = (1 - f) * point_of[lo] + f * point_of[hi]
                ids[i, j] = self.vertex(centre + q * (p - centre) + [0, height * (1 - q * q), 0])
        sign = 1 if height >= 0 else -1
        uv = {e: self.uv((self.v[n][0], -sign * self.v[n][2])) for e, n in ids.items()}
        for i in range(k):
            for j in range(k):
                e = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                self.face([ids[x] for x in e], [uv[x] for x in e])


def _even_heights(figure, spacing):
    """Heights whose rings lie `spacing` apart along the side and front profiles."""
    k = [N_THETA // 4, 0, N_THETA // 2]
    move = np.diff(figure.radius[:, k], axis=0)
    length = np.sqrt(DY ** 2 + 0.7 * (move ** 2).max(axis=1))
    arc = np.concatenate([[0], np.cumsum(length)])
    return np.interp(np.linspace(0, arc[-1], int(round(arc[-1] / spacing)) + 1), arc, figure.y)


def mannequin(figure, columns=56, spacing=0.0145):
    b = _Builder()
    b.group("figure")
    pick = (np.arange(columns) + 0.5) / columns * N_THETA
    rings = []
    for y in _even_heights(figure, spacing):
        section = figure.section(y)
        closed = np.vstack([section, section[:1]])
        s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
        # Evenly along the section, starting at the middle of the back.
        want = ((pick / N_THETA + 0.5) % 1.0) * s[-1]
        x, z = (np.interp(want, s, closed[:, c]) for c in (0, 1))
        rings.append(np.stack([x, np.full(columns, y), z], axis=1))
    ids = b.loft(np.array(rings))
    b.cap(ids[0], -0.022)
    b.cap(ids[-1], 0.016)

    turn = (np.arange(24) / 24 + 0.5) * 2 * np.pi
    def round_part(name, profile):
        b.group(name)
        ids = b.loft(np.array([[(r * np.sin(t), y, r * np.cos(t)) for t in turn] for r, y in profile]))
        b.cap(ids[0], -1e-9)
        b.cap(ids[-1], 1e-9)
    tall = [(0.0140, y) for y in np.linspace(0.026, 0.726, 24)]
    round_part("stand_pole", [(0.0120, 0.0245), (0.0137, 0.0247)] + tall + [(0.0137, 0.7275), (0.0120, 0.728)])
    round_part("stand_base", [(0.140, 0.0), (0.1475, 0.0004), (0.150, 0.002), (0.150, 0.008), (0.1475, 0.011),
                              (0.142, 0.0125), (0.10, 0.015), (0.06, 0.0185), (0.030, 0.023), (0.020, 0.0240)])
    return b
