"""A small cloth solver for tubes of cloth: a grid of rows, each a closed ring of an even number of vertices.

Extended position-based dynamics with many substeps and one iteration each. The rest shape is the flat pattern.
Threads are stiff, shear is soft, bending is a discrete curvature along the grid lines. Springs of one parity share no
vertex, so that a parity is one operation on slices.
"""
import numpy as np

REACH = 1.6         # of the search for contacts, in thicknesses
TOP_SPEED = 1.5     # m/s: slower than what crosses the reach between two searches
SEARCH = 5          # steps between two searches
EDGES = ((0, 1), (1, 0), (1, 1), (1, -1))  # to the neighbour's row and column


def _length(d):
    return np.sqrt(np.einsum("kij,kij->ij", d, d))


class Tube:
    """Positions p[3, rows, columns], p[:, 0] the upper edge. `rest[k]` and `stiffness[k]` belong to EDGES[k]."""

    def __init__(self, position, mass, pinned, rest, stiffness, rigidity, spacing):
        self.p = np.moveaxis(np.asarray(position, float), -1, 0).copy()
        self.v = np.zeros_like(self.p)
        self.w = np.where(pinned, 0.0, 1 / mass)
        self.rest, self.compliance = rest, [1 / k for k in stiffness]
        self.rigidity = rigidity
        self.thickness = spacing
        self.material = self.p.reshape(3, -1).T.copy()     # neighbours of the cloth are neighbours here
        self.pairs = np.zeros((2, 0), int)

    # ---- springs

    def _spring(self, a, b, wa, wb, rest, compliance):
        d = a - b
        length = _length(d)
        d *= (length - rest) / ((wa + wb + compliance) * np.maximum(length, 1e-9))
        return d * wa, d * wb

    def solve_springs(self, dt):
        p, w = self.p, self.w
        for (down, right), rest, compliance in zip(EDGES, self.rest, self.compliance):
            c = compliance / dt ** 2
            for parity in (0, 1):
                if down == 0:
                    i = np.s_[:, parity::2]
                    other = np.s_[:, 1 - parity::2]
                    turn = -parity
                else:
                    count = (p.shape[1] - parity) // 2
                    i = np.s_[parity:parity + 2 * count:2]
                    other = np.s_[parity + 1:parity + 1 + 2 * count:2]
                    turn = -right
                a, b = p[(np.s_[:],) + np.index_exp[i]], p[(np.s_[:],) + np.index_exp[other]]
                near = np.roll(b, turn, axis=2) if turn else b
                weight = np.roll(w[other], turn, axis=1) if turn else w[other]
                da, db = self._spring(a, near, w[i], weight, rest[i], c[i])
                a -= da
                b += np.roll(db, -turn, axis=2) if turn else db

    # ---- bending

    def solve_bends(self, dt):
        """All at once, each taken by a third: three of them meet in every vertex and direction."""
        for axis in (1, 2):
            p = self.p
            if axis == 2:
                before, after = np.roll(p, 1, axis=2), np.roll(p, -1, axis=2)
                wb, wa, w = np.roll(self.w, 1, axis=1), np.roll(self.w, -1, axis=1), self.w
                lb, la = np.roll(self.rest[0], 1, axis=1), self.rest[0]
                middle, k = p, self.rigidity
            else:
                before, middle, after = p[:, :-2], p[:, 1:-1], p[:, 2:]
                wb, w, wa = self.w[:-2], self.w[1:-1], self.w[2:]
                lb, la = self.rest[1][:-1], self.rest[1][1:]
                k = self.rigidity[1:-1]
            a, b = 1 / lb, 1 / la
            half = 0.5 * (lb + la)
            d = (before - middle) * a + (after - middle) * b
            d /= 3 * (wb * a * a + w * (a + b) ** 2 + wa * b * b + half ** 2 / (k * dt ** 2))
            first, second, third = d * a * wb, d * (a + b) * w, d * b * wa
            if axis == 2:
                p -= np.roll(first, -1, axis=2) + np.roll(third, 1, axis=2) - second
            else:
                p[:, :-2] -= first
                p[:, 1:-1] += second
                p[:, 2:] -= third

    # ---- cloth on cloth

    def find_pairs(self):
        """Vertices that may touch and are not neighbours in the cloth."""
        p, thickness = self.p.reshape(3, -1).T, self.thickness.ravel()
        reach = REACH * thickness.max()
        cells = np.floor((p - p.min(axis=0) + 2 * reach) / reach).astype(np.int64)
        size = cells.max(axis=0) + 3
        key = (cells[:, 0] * size[1] + cells[:, 1]) * size[2] + cells[:, 2]
        order = np.argsort(key, kind="stable")
        key = key[order]
        first, second = [], []
        offsets = [(1, 1, 1)] + [o for o in np.ndindex(3, 3, 3) if o > (1, 1, 1)]
        for n, o in enumerate(offsets):
            shift = ((o[0] - 1) * size[1] + o[1] - 1) * size[2] + o[2] - 1
            lo = np.searchsorted(key, key + shift, "left") if n else np.arange(len(key)) + 1
            count = np.maximum(np.searchsorted(key, key + shift, "right") - lo, 0)
            first.append(order[np.repeat(np.arange(len(key)), count)])
            second.append(order[np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
                                + np.repeat(lo, count)])
        i, j = np.concatenate(first), np.concatenate(second)
        t = 0.5 * (thickness[i] + thickness[j])
        keep = np.linalg.norm(p[i] - p[j], axis=1) < REACH * t
        i, j, t = i[keep], j[keep], t[keep]
        keep = np.linalg.norm(self.material[i] - self.material[j], axis=1) > 2.2 * t
        self.pairs = np.stack([i[keep], j[keep]])

    def solve_pairs(self):
        p, thickness = self.p.reshape(3, -1), self.thickness.ravel()
        i, j = self.pairs
        d = p[:, i] - p[:, j]
        length = np.maximum(np.sqrt((d * d).sum(axis=0)), 1e-9)
        need = 0.5 * (thickness[i] + thickness[j]) - length
        hit = need > 0
        if not hit.any():
            return
        i, j = i[hit], j[hit]
        d = d[:, hit] * (0.5 * need[hit] / length[hit])
        n = p.shape[1]
        free = self.w.ravel() > 0
        count = np.maximum(np.bincount(i, minlength=n) + np.bincount(j, minlength=n), 1)
        for c in range(3):
            p[c] += free * (np.bincount(i, d[c], n) - np.bincount(j, d[c], n)) / count

    # ---- time

    def run(self, seconds, dt, collide, drag, push=None, report=None, sweeps=1):
        """`collide(p, previous)` moves p out of obstacles in place; `push(t, p)` is an acceleration. A light vertex carries
        no more than its mass over dt squared times the stretch: short steps and more sweeps over the springs tighten.
        """
        free = self.w > 0
        gravity = np.array([0.0, -9.81, 0.0])[:, None, None]
        for n in range(int(round(seconds / dt))):
            if n % SEARCH == 0:
                self.find_pairs()
            self.v += dt * (gravity if push is None else gravity + push(n * dt, self.p))
            self.v *= 1 - drag * dt
            previous = self.p.copy()
            self.p += dt * self.v * free
            self.solve_bends(dt)
            for _ in range(sweeps):
                self.solve_springs(dt)
            if self.pairs.shape[1]:
                self.solve_pairs()
            collide(self.p, previous)
            self.v = (self.p - previous) / dt
            self.v *= np.minimum(1, TOP_SPEED / np.maximum(_length(self.v), 1e-9))
            if report and n % 200 == 0:
                report(n * dt, self)


def tube_of(position, flat, pinned, density, threads, shear, bending, thickness):
    """The tube of a pattern. `flat[j, i, k]` is the place of vertex (j, i) for k = 0, that of its right neighbour in the
    same row for k = 1, in the plane of the piece at its right: pieces meet at seams, where vertices lie twice.
    """
    here, right = flat[:, :, 0], flat[:, :, 1]
    ends = (right - here, here[1:] - here[:-1], right[1:] - here[:-1], here[1:] - right[:-1])
    rest, stiffness = [], []
    for (down, side), d in zip(EDGES, ends):
        length = np.hypot(d[..., 0], d[..., 1])
        off_thread = abs(2 * d[..., 0] * d[..., 1]) / length ** 2        # sine of twice the angle to the thread
        k = threads + (shear - threads) * off_thread ** 2
        if side < 0:                                                     # stored at the vertex that it begins in
            length, k = np.roll(length, 1, axis=1), np.roll(k, 1, axis=1)
        rest.append(length)
        stiffness.append(k)
    cell = np.abs(ends[0][:-1, :, 0] * ends[1][..., 1] - ends[0][:-1, :, 1] * ends[1][..., 0])
    cell = 0.5 * (cell + np.roll(cell, 1, axis=1))
    area = np.zeros(position.shape[:2])
    area[:-1] += 0.5 * cell
    area[1:] += 0.5 * cell
    mass = density * np.maximum(area, 0.5 * area.mean())                # gravity does not ask for it
    return Tube(position, mass, pinned, rest, stiffness, bending * area, thickness * np.sqrt(area))


def off_form(field, clearance):
    """Keeps cloth off the form, with friction: a function of the positions p[3, rows, columns], changed in place, and of
    those before the step.
    """
    def rub(p, previous):
        flat = p.reshape(3, -1).T.copy()
        distance, normal = field.sample(flat)
        hit = np.nonzero(distance < clearance)[0]
        push = clearance - distance[hit]
        flat[hit] += push[:, None] * normal[hit]
        slide = flat[hit] - previous.reshape(3, -1).T[hit]
        slide -= np.einsum("ij,ij->i", slide, normal[hit])[:, None] * normal[hit]
        length = np.maximum(np.linalg.norm(slide, axis=1), 1e-12)
        flat[hit] -= slide * np.minimum(1, 0.5 * push / length)[:, None]
        p[:] = flat.T.reshape(p.shape)
    return rub


def finer(p):
    """Twice the rows and columns of a ring grid, by cubic midpoints."""
    def middle(q, axis):
        before, after = np.roll(q, 1, axis=axis), np.roll(q, -1, axis=axis)
        beyond = np.roll(q, -2, axis=axis)
        return (9 * (q + after) - before - beyond) / 16
    out = np.zeros((p.shape[0], 2 * p.shape[1], 3))
    out[:, ::2], out[:, 1::2] = p, middle(p, 1)
    ends = np.concatenate([[2 * out[0] - out[1]], out, [2 * out[-1] - out[-2]]])
    rows = np.zeros((2 * len(out) - 1, out.shape[1], 3))
    rows[::2], rows[1::2] = out, middle(ends, 0)[1:-2]
    return rows


def without_noise(p, held):
    """Takes out what alternates from vertex to vertex, of a ring grid; folds keep their depth. Row 0 may be held."""
    def even(q):
        n = len(q)
        q = np.concatenate([2 * q[:1] - q[2:0:-1], q, 2 * q[-1:] - q[-2:-4:-1]])
        return (10 * q[2:n + 2] + 4 * (q[1:n + 1] + q[3:n + 3]) - q[:n] - q[4:n + 4]) / 16
    for _ in range(2):
        around = np.concatenate([p[:, -3:], p, p[:, :3]], axis=1)
        around = np.moveaxis(even(np.moveaxis(around, 1, 0)), 0, 1)[:, 3:-3]
        inner = np.concatenate([p[:1], even(around)[1:-1], around[-1:]])
        inner[0] = np.where(held[:, None], p[0], around[0])
        p = inner
    return p


def report(t, c):
    print(f"  {t:5.2f} s  lowest {c.p[1].min():.3f}  fastest {np.sqrt((c.v ** 2).sum(axis=0)).max():.2f} m/s  "
          f"contacts {c.pairs.shape[1]}", flush=True)
