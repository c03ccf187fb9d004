"""The dress form: a torso with neck cap and arm plates on a turned stand, its mesh, and its distance field.

+Y up, metres, floor at y = 0, facing +Z. A section at height y is a superellipse around the point (0, y, centre),
with half width `a`, front depth and back depth, plus soft bumps (bust, seat), cut flat where the arm plates are.
Measures: bust 86, waist 64, hip 92 cm.
"""
import numpy as np

#         y      a      front  back   n    centre
SECTIONS = np.array([
    [0.720, 0.138, 0.088, 0.098, 2.2, 0.000],
    [0.760, 0.152, 0.094, 0.106, 2.2, 0.000],
    [0.800, 0.163, 0.098, 0.112, 2.2, 0.000],
    [0.860, 0.170, 0.103, 0.116, 2.2, 0.000],
    [0.920, 0.162, 0.102, 0.108, 2.2, 0.000],
    [0.980, 0.140, 0.094, 0.090, 2.2, 0.002],
    [1.020, 0.123, 0.084, 0.078, 2.2, 0.003],
    [1.060, 0.115, 0.079, 0.074, 2.2, 0.003],
    [1.100, 0.119, 0.082, 0.078, 2.2, 0.003],
    [1.160, 0.130, 0.090, 0.086, 2.2, 0.001],
    [1.220, 0.141, 0.097, 0.092, 2.2, -0.001],
    [1.280, 0.156, 0.094, 0.096, 2.2, -0.004],
    [1.330, 0.174, 0.086, 0.095, 2.2, -0.008],
    [1.365, 0.180, 0.076, 0.088, 2.2, -0.012],
    [1.385, 0.173, 0.068, 0.080, 2.1, -0.014],
    [1.400, 0.148, 0.062, 0.073, 2.0, -0.016],
    [1.415, 0.113, 0.056, 0.065, 2.0, -0.016],
    [1.430, 0.083, 0.053, 0.059, 2.0, -0.014],
    [1.445, 0.064, 0.051, 0.055, 2.0, -0.011],
    [1.460, 0.056, 0.049, 0.052, 2.0, -0.007],
    [1.475, 0.053, 0.048, 0.051, 2.0, -0.003],
    [1.490, 0.052, 0.047, 0.050, 2.0, 0.001],
    [1.505, 0.051, 0.047, 0.050, 2.0, 0.004],
])
Y0, Y1, DY = 0.722, 1.500, 0.001
N_THETA = 720
ARM = np.array([0.1600, 1.325, -0.012])      # middle of the left arm plate
ARM_TILT = 0.09                              # its lower edge lies further inside
ARM_HEIGHT, ARM_DEPTH = 0.050, 0.040         # half axes of the plate


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
                                [1.0, 1.006, 1.015, 1.026, 1.04, 1.05, 1.02, 1.0]), 9.0)
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
            fall = np.where(above, 0.055, 0.042)  # fuller below than above
            bust = np.exp(-0.5 * ((x - side * 0.076) / 0.046) ** 2 - 0.5 * ((y - 1.215) / fall) ** 2)
            seat = np.exp(-0.5 * ((x - side * 0.062) / 0.055) ** 2 - 0.5 * ((y - 0.870) / 0.065) ** 2)
            radius = radius + 0.037 * bust * np.clip(c + 0.1, 0, 1) + 0.014 * seat * np.clip(-c, 0, 1)
        # Flat sides: a soft minimum of the radius and the distance to the plane of the arm plate.
        plane = ARM[0] + ARM_TILT * (self.y - ARM[1]) + 0.8 * np.maximum(1.26 - self.y, 0)
        plane = plane[:, None] / np.maximum(np.abs(s), 1e-3)
        soft = 0.004
        radius = -soft * np.logaddexp(-radius / soft, -plane / soft)
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
        self.cell, self.low = cell, np.array([-0.24, 0.735, -0.20])
        shape = np.ceil((np.array([0.24, 1.48, 0.20]) - self.low) / cell).astype(int) + 1
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

    def cap(self, ring_ids, bulge, up):
        """Closes a ring of 4k vertices by a k x k grid of quads, bulging by the vector `bulge`; `up` at its top end."""
        k = len(ring_ids) // 4
        centre = np.array([self.v[i] for i in ring_ids]).mean(axis=0)
        edge = ([(i, 0) for i in range(k)] + [(k, i) for i in range(k)]
                + [(k - i, k) for i in range(k)] + [(0, k - i) for i in range(k)])
        order = ring_ids if up else ring_ids[::-1]
        ids = dict(zip(edge, order))
        point_of = dict(zip(edge, [np.array(self.v[i]) for i in order]))
        for i in range(1, k):
            for j in range(1, k):
                a, b = 2 * i / k - 1, 2 * j / k - 1
                q = max(abs(a), abs(b))
                if q < 1e-9:
                    ids[i, j] = self.vertex(centre + bulge)
                    continue
                # Where the ray from the middle leaves the square, between two ring vertices.
                ea, eb = (a / q + 1) * k / 2, (b / q + 1) * k / 2
                lo = (int(np.floor(ea + 1e-9)), int(np.floor(eb + 1e-9)))
                hi = (int(np.ceil(ea - 1e-9)), int(np.ceil(eb - 1e-9)))
                f = (ea - lo[0]) + (eb - lo[1])
                p = (1 - f) * point_of[lo] + f * point_of[hi]
                ids[i, j] = self.vertex(centre + q * (p - centre) + (1 - q * q) * bulge)
        size = np.linalg.norm(np.array([self.v[i] for i in ring_ids]) - centre, axis=1).mean()
        uv = {e: self.uv((size * (2 * e[0] / k - 1), size * (2 * e[1] / k - 1))) for e in ids}
        for i in range(k):
            for j in range(k):
                e = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                self.face([ids[x] for x in e], [uv[x] for x in e])

    def turned(self, name, profile, place=lambda r, h, t: (r * np.sin(t), h, r * np.cos(t)), columns=24):
        """A closed part turned on the lathe: radius and height from bottom to top."""
        self.group(name)
        turn = (np.arange(columns) / columns + 0.5) * 2 * np.pi
        ids = self.loft(np.array([[place(r, h, t) for t in turn] for r, h in profile]))
        self.cap(ids[0], np.zeros(3), False)
        self.cap(ids[-1], np.zeros(3), True)


def _heights(figure):
    """Heights of the rings: fine where the form is seen, above the dress."""
    dense = np.interp(figure.y, [1.18, 1.25, 1.36, 1.39, 1.45], [1 / 0.022, 1 / 0.010, 1 / 0.010, 1 / 0.006, 1 / 0.006])
    count = np.concatenate([[0], np.cumsum(dense[1:] * DY)])
    return np.interp(np.linspace(0, count[-1], int(round(count[-1])) + 1), count, figure.y)


def dress_form(figure, columns=88):
    b = _Builder()
    b.group("torso")
    pick = (np.arange(columns) + 0.5) / columns * N_THETA
    rings = []
    for y in _heights(figure):
        section = figure.section(y)
        closed = np.vstack([section, section[:1]])
        s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
        # Evenly along the section, starting at the middle of the back.
        want = ((pick / N_THETA + 0.5) % 1.0) * s[-1]
        x, z = (np.interp(want, s, closed[:, c]) for c in (0, 1))
        rings.append(np.stack([x, np.full(columns, y), z], axis=1))
    ids = b.loft(np.array(rings))
    b.cap(ids[0], np.array([0, -0.012, 0]), False)
    b.cap(ids[-1], np.array([0, 0.002, 0]), True)
    _plates(b, rings[-1].mean(axis=0))
    _stand(b)
    return b


def _plates(b, neck):
    """The neck cap with its knob, and the two arm plates."""
    lip = [(0.046, 0.0005), (0.0545, 0.0008), (0.0565, 0.0030), (0.0565, 0.0075), (0.0545, 0.0100), (0.050, 0.0110),
           (0.030, 0.0135), (0.014, 0.0145), (0.0085, 0.0165), (0.0070, 0.0205), (0.0085, 0.0245), (0.0135, 0.0280),
           (0.0165, 0.0335), (0.0165, 0.0395), (0.0135, 0.0450), (0.0080, 0.0480), (0.0040, 0.0488)]
    b.turned("neck_cap", lip, lambda r, h, t: (r * np.sin(t) + neck[0], h + neck[1], 0.96 * r * np.cos(t) + neck[2]))
    plate = [(0.80, -0.0035), (0.96, -0.0030), (1.00, -0.0010), (1.00, 0.0022), (0.97, 0.0036), (0.90, 0.0040),
             (0.50, 0.0044), (0.20, 0.0046)]
    for name, side in (("arm_plate_left", 1), ("arm_plate_right", -1)):
        out = np.array([1, -ARM_TILT, 0]) / np.hypot(1, ARM_TILT)
        up = np.array([ARM_TILT, 1, 0]) / np.hypot(1, ARM_TILT)

        def place(r, h, t):
            p = ARM + h * out + ARM_HEIGHT * r * np.cos(t) * up + ARM_DEPTH * r * np.sin(t) * np.array([0, 0, 1])
            return p if side > 0 else p * [-1, 1, 1]
        b.turned(name, plate, place if side > 0 else lambda r, h, t: place(r, h, -t), 32)


def _stand(b):
    """A pole with a collar below the torso, and a turned foot."""
    pole = [(0.0120, 0.0445), (0.0150, 0.0450)] + [(0.0150, y) for y in np.linspace(0.06, 0.62, 22)]
    collar = [(0.0152, 0.640), (0.0200, 0.645), (0.0235, 0.655), (0.0200, 0.665), (0.0170, 0.672), (0.0210, 0.685),
              (0.0290, 0.697), (0.0330, 0.704), (0.0340, 0.7085), (0.0300, 0.7100)]
    b.turned("stand_pole", pole + collar)
    foot = [(0.140, 0.0), (0.1465, 0.0005), (0.150, 0.003), (0.150, 0.011), (0.147, 0.0155), (0.141, 0.0170),
            (0.137, 0.0185), (0.132, 0.0215), (0.110, 0.0245), (0.075, 0.0270), (0.045, 0.0300), (0.030, 0.0335),
            (0.024, 0.0385), (0.020, 0.0435), (0.014, 0.0442)]
    b.turned("stand_foot", foot, columns=40)
