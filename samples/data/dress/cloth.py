"""A small cloth solver: extended position-based dynamics with many substeps and one iteration each.

The rest shape is the flat pattern. Threads (along u and v) are stiff, shear is soft, bending is a discrete curvature
along each grid line. All constraints of one colour share no vertex, so that a colour is one array operation.
"""
import numpy as np

REACH = 1.6         # of the search for contacts, in thicknesses
TOP_SPEED = 1.2     # m/s: slower than what crosses the reach between two searches


def colour(constraints, vertex_count):
    """Greedy colouring; returns a list of index arrays into `constraints`."""
    used = [0] * vertex_count
    groups = []
    for k, row in enumerate(constraints):
        taken = 0
        for i in row:
            taken |= used[i]
        c = 0
        while taken >> c & 1:
            c += 1
        for i in row:
            used[i] |= 1 << c
        if c == len(groups):
            groups.append([])
        groups[c].append(k)
    return [np.array(g) for g in groups]


class Cloth:
    def __init__(self, position, inverse_mass, spacing):
        self.p = position.copy()
        self.v = np.zeros_like(position)
        self.w = inverse_mass
        self.start = position.copy()
        self.thickness = 0.80 * spacing  # more than from a cell's middle to its corner: nothing slips through
        self.springs, self.bends = [], []
        self.pairs = np.zeros((0, 2), int)

    def add_springs(self, ends, rest, stiffness):
        for g in colour(ends.tolist(), len(self.p)):
            i, j = ends[g].T
            self.springs.append((i, j, rest[g], 1 / stiffness[g], self.w[i] + self.w[j]))

    def add_bends(self, triples, l0, l1, rigidity):
        for g in colour(triples.tolist(), len(self.p)):
            i, j, k = triples[g].T
            a, b = 1 / l0[g], 1 / l1[g]
            weight = self.w[i] * a * a + self.w[j] * (a + b) ** 2 + self.w[k] * b * b
            self.bends.append((i, j, k, a[:, None], b[:, None], 1 / rigidity[g], weight))

    def solve_springs(self, dt):
        p, w = self.p, self.w
        for i, j, rest, compliance, weight in self.springs:
            d = p[i] - p[j]
            length = np.sqrt(np.einsum("ij,ij->i", d, d))
            step = (length - rest) / ((weight + compliance / dt ** 2) * np.maximum(length, 1e-9))
            d *= step[:, None]
            p[i] -= d * w[i, None]
            p[j] += d * w[j, None]

    def solve_bends(self, dt):
        p, w = self.p, self.w
        for i, j, k, a, b, compliance, weight in self.bends:
            pj = p[j]
            d = (p[i] - pj) * a + (p[k] - pj) * b
            d /= (weight + compliance / dt ** 2)[:, None]
            p[i] -= d * a * w[i, None]
            p[k] -= d * b * w[k, None]
            p[j] += d * (a + b) * w[j, None]

    def find_pairs(self):
        """Vertices that may touch and are not neighbours in the cloth."""
        reach = REACH * self.thickness.max()
        low = self.p.min(axis=0) - 2 * reach
        cells = np.floor((self.p - low) / reach).astype(np.int64)
        size = cells.max(axis=0) + 3
        key = (cells[:, 0] * size[1] + cells[:, 1]) * size[2] + cells[:, 2]
        order = np.argsort(key, kind="stable")
        key_sorted = key[order]
        first, second = [], []
        offsets = [(0, 0, 0)] + [o for o in np.ndindex(3, 3, 3) if o > (1, 1, 1)]
        for n, o in enumerate(offsets):
            shift = 0 if n == 0 else ((o[0] - 1) * size[1] + o[1] - 1) * size[2] + o[2] - 1
            lo = np.searchsorted(key_sorted, key_sorted + shift, "left")
            hi = np.searchsorted(key_sorted, key_sorted + shift, "right")
            if n == 0:
                lo = np.arange(len(key)) + 1
            count = np.maximum(hi - lo, 0)
            a = np.repeat(np.arange(len(key)), count)
            b = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + np.repeat(lo, count)
            first.append(order[a])
            second.append(order[b])
        i, j = np.concatenate(first), np.concatenate(second)
        t = 0.5 * (self.thickness[i] + self.thickness[j])
        near = np.linalg.norm(self.p[i] - self.p[j], axis=1) < REACH * t
        apart = np.linalg.norm(self.start[i] - self.start[j], axis=1) > 2.2 * t
        keep = near & apart
        self.pairs = np.stack([i[keep], j[keep]], axis=1)

    def solve_pairs(self):
        i, j = self.pairs.T
        d = self.p[i] - self.p[j]
        length = np.maximum(np.linalg.norm(d, axis=1), 1e-9)
        need = 0.5 * (self.thickness[i] + self.thickness[j]) - length
        hit = need > 0
        i, j = i[hit], j[hit]
        if len(i) == 0:
            return
        d = d[hit] * (0.5 * need[hit] / length[hit])[:, None]
        move, count = np.zeros_like(self.p), np.zeros(len(self.p))
        np.add.at(move, i, d)
        np.add.at(move, j, -d)
        np.add.at(count, i, 1)
        np.add.at(count, j, 1)
        move *= (self.w > 0)[:, None]
        self.p += move / np.maximum(count, 1)[:, None]

    def run(self, seconds, dt, collide, drag, wind=None, report=None):
        """`collide(p, previous)` moves p out of obstacles in place; `wind(t, p)` is an acceleration."""
        free = (self.w > 0)[:, None]
        gravity = np.array([0.0, -9.81, 0.0])
        for n in range(int(round(seconds / dt))):
            if n % 4 == 0:
                self.find_pairs()
            acceleration = gravity if wind is None else gravity + wind(n * dt, self.p)
            previous = self.p.copy()
            self.v += dt * acceleration
            self.v *= 1 - drag * dt
            self.p += dt * self.v * free
            self.solve_bends(dt)
            self.solve_springs(dt)
            if len(self.pairs):
                self.solve_pairs()
            collide(self.p, previous)
            self.v = (self.p - previous) / dt
            speed = np.linalg.norm(self.v, axis=1)
            self.v *= np.minimum(1, TOP_SPEED / np.maximum(speed, 1e-9))[:, None]
            if report and n % 200 == 0:
                report(n * dt, self)
