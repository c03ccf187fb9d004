"""Makes dress.obj and mannequin.obj: a sewn satin dress, draped on a figure by simulation.

    blender --background --python make_dress.py -- OUTDIR      or      python3 make_dress.py OUTDIR

Needs numpy only. The panels are cut flat (UV in metres of cloth: u = weft, v = warp), sewn into one mesh whose seam
vertices are shared, draped, and written panel by panel. Same numbers on every run of one machine.
"""
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from body import DistanceField, Figure, mannequin  # noqa: E402
from cloth import Cloth  # noqa: E402

# ---- the design -----------------------------------------------------------------------------------------------------

COLUMNS = 54                # around the bodice; the skirt has three times as many
BODICE_ROWS = 15
WAIST_TOP, WAIST_BOTTOM = 1.083, 1.035
STRAP_ROWS = 30
SKIRT_ROWS = 54
SKIRT_LENGTH = 0.975
SKIRT_SPREAD = 4.0          # radians of the circle that the six gores make together
PETTICOAT_HEM = 0.235
TURN = 1.3                  # m/s2 along the hem
GATHER = 1.08               # skirt top length over waistband length
CLEARANCE = 0.006           # of the cloth's vertices from the figure
EASE = 1.018                # bodice pattern over body

DENSITY = 0.14              # kg/m2
THREAD_STIFFNESS = 1200.0   # N/m along warp and weft
SHEAR_STIFFNESS = 60.0      # N/m at 45 degrees to them
BENDING = 2.4e-5            # N m

# name, first and last bodice column, grain (degrees that the pattern is turned on the cloth)
BODICE_PANELS = [
    ("bodice_front", -5, 5, 45.0),
    ("bodice_side_front_left", 5, 14, 0.0),
    ("bodice_side_back_left", 14, 22, 0.0),
    ("bodice_back", 22, 32, 0.0),
    ("bodice_side_back_right", 32, 40, 0.0),
    ("bodice_side_front_right", 40, 49, 0.0),
]
WAISTBAND_PANELS = [("waistband_front", -14, 14, 90.0), ("waistband_back", 14, 40, 90.0)]
SKIRT_GRAIN = 0.0
# Height of the bodice's top edge by column (symmetric): a V in front, a scoop at the back.
TOP_EDGE = np.array([[0, 1.232], [1, 1.239], [2, 1.252], [3, 1.267], [4, 1.283], [5, 1.298], [7, 1.306], [9, 1.302],
                     [11, 1.281], [14, 1.262], [16, 1.266], [18, 1.283], [20, 1.288], [22, 1.280], [24, 1.258],
                     [26, 1.246], [27, 1.245]])


class Panel:
    """A piece of cloth: faces of shared vertex ids, and one flat position per vertex."""

    def __init__(self, name, faces, grain=0.0, flat=None):
        self.name, self.grain, self.flat = name, grain, flat
        self.faces = np.array(faces)
        self.ids = np.unique(self.faces)

    def turn_to_grain(self):
        a = np.radians(self.grain)
        turn = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
        self.flat = {i: turn.T @ q for i, q in self.flat.items()}


def grid_faces(ids):
    """Quads of a grid ids[row][column]; rows go up and columns to the right, seen from outside."""
    ids = np.asarray(ids)
    return np.stack([ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]], axis=-1).reshape(-1, 4)


# ---- the dress before draping ---------------------------------------------------------------------------------------

def hull(points):
    """Convex hull of 2D points, counter-clockwise."""
    p = points[np.lexsort((points[:, 1], points[:, 0]))]

    def half(seq):
        out = []
        for q in seq:
            while len(out) > 1 and np.cross(out[-1] - out[-2], q - out[-2]) <= 0:
                out.pop()
            out.append(q)
        return out[:-1]
    return np.array(half(p) + half(p[::-1]))


class Tape:
    """A tape around the figure at some height: point at a fraction of its length, from the middle of the front."""

    def __init__(self, figure):
        self.figure, self.cache = figure, {}

    def ring(self, y):
        y = round(y, 5)
        if y not in self.cache:
            h = hull(self.figure.section(y))[::-1]                    # clockwise from above: +Z towards +X
            edge = np.roll(h, -1, axis=0) - h
            out = np.stack([-edge[:, 1], edge[:, 0]], axis=1)
            out /= np.linalg.norm(out, axis=1)[:, None]
            normal = out + np.roll(out, 1, axis=0)
            h = h + CLEARANCE * normal / np.linalg.norm(normal, axis=1)[:, None]
            x, nx = h[:, 0], np.roll(h[:, 0], -1)
            k = np.nonzero((x < 0) & (nx >= 0))[0][0]                 # the edge that crosses the front's middle
            f = x[k] / (x[k] - nx[k])
            middle = (1 - f) * h[k] + f * h[(k + 1) % len(h)]
            h = np.vstack([middle, np.roll(h, -k - 1, axis=0), middle])
            s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(h, axis=0), axis=1))])
            self.cache[y] = (s, h)
        return self.cache[y]

    def length(self, y):
        return self.ring(y)[0][-1]

    def point(self, y, fraction):
        s, h = self.ring(y)
        t = fraction % 1.0 * s[-1]
        return np.array([np.interp(t, s, h[:, 0]), y, np.interp(t, s, h[:, 1])])


class Dress:
    def __init__(self, figure, field, rng):
        self.points, self.panels = [], []
        self.tape, self.field, self.rng = Tape(figure), field, rng
        self.bodice()
        self.waistband()
        self.straps()
        for panel in self.panels:
            panel.flat = flatten(panel, np.array(self.points))
        self.skirt()
        for panel in self.panels:
            panel.turn_to_grain()
        self.start = np.array(self.points)

    def add(self, p):
        self.points.append(np.asarray(p, float))
        return len(self.points) - 1

    def bodice(self):
        c = np.arange(COLUMNS)
        top = np.interp(np.minimum(c, COLUMNS - c), TOP_EDGE[:, 0], TOP_EDGE[:, 1])
        self.body = [[self.add(self.tape.point(WAIST_TOP + (top[i] - WAIST_TOP) * j / BODICE_ROWS, i / COLUMNS))
                      for i in c] for j in range(BODICE_ROWS + 1)]
        for name, first, last, grain in BODICE_PANELS:
            ids = [[row[k % COLUMNS] for k in range(first, last + 1)] for row in self.body]
            self.panels.append(Panel(name, grid_faces(ids), grain))

    def waistband(self):
        """Rows of bodice columns; the lowest row splits each column in three, by four quads."""
        rows = 4
        y = np.linspace(WAIST_BOTTOM, WAIST_TOP, rows + 1)
        coarse = [None] + [[self.add(self.tape.point(h, i / COLUMNS)) for i in range(COLUMNS)] for h in y[1:-1]]
        coarse.append(self.body[0])
        middle = y[0] + 0.52 * (y[1] - y[0])
        inner = [[self.add(self.tape.point(middle, (i + f) / COLUMNS)) for f in (0.32, 0.68)] for i in range(COLUMNS)]
        self.hem_of_band = [self.add(self.tape.point(WAIST_BOTTOM, i / (3 * COLUMNS))) for i in range(3 * COLUMNS)]
        self.pinned = coarse[2] + self.hem_of_band  # the band sits tight
        fine, n = self.hem_of_band, 3 * COLUMNS
        for name, first, last, grain in WAISTBAND_PANELS:
            faces = list(grid_faces([[row[k % COLUMNS] for k in range(first, last + 1)] for row in coarse[1:]]))
            for k in range(first, last):
                i = k % COLUMNS
                a, b, c, d = (fine[(3 * i + m) % n] for m in range(4))
                e, f = inner[i]
                left, right = coarse[1][i], coarse[1][(i + 1) % COLUMNS]
                faces += [(a, b, e, left), (b, c, f, e), (c, d, right, f), (e, f, right, left)]
            self.panels.append(Panel(name, faces, grain))

    def straps(self):
        for name, sign in (("strap_left", 1), ("strap_right", -1)):
            lanes = [self.strap_lane(sign, lane) for lane in range(5)]
            grid = np.array(lanes if sign > 0 else lanes[::-1]).T
            self.panels.append(Panel(name, grid_faces(grid), 0.0))
            self.pinned += grid[STRAP_ROWS // 2 - 1:STRAP_ROWS // 2 + 2].ravel().tolist()  # tailor's pins

    def strap_lane(self, sign, lane):
        """One line of the strap over the shoulder, from the front edge to the back edge; lane 0 lies at the neck."""
        front, back = (self.body[-1][(sign * k) % COLUMNS] for k in (5 + lane, 22 - lane))
        a, b = self.points[front], self.points[back]
        centre = np.array([1.27, -0.012])
        angle = [np.arctan2(p[1] - centre[0], p[2] - centre[1]) for p in (a, b)]
        t = np.linspace(0, 1, 121)
        shoulder = sign * (0.078 + 0.0108 * lane)
        x = a[0] + (b[0] - a[0]) * t + (shoulder - 0.5 * (a[0] + b[0])) * np.sin(np.pi * t) ** 0.8
        phi = angle[0] + (angle[1] - angle[0]) * t
        radius = np.linspace(0.03, 0.24, 400)
        line = []
        for xi, ph in zip(x, phi):
            ray = np.stack([np.full(400, xi), centre[0] + radius * np.sin(ph), centre[1] + radius * np.cos(ph)], axis=1)
            inside = self.field.sample(ray)[0] < CLEARANCE
            line.append(ray[np.nonzero(inside)[0][-1]] if inside.any() else ray[0])
        line = np.array(line)
        line[0], line[-1] = a, b
        for _ in range(6):
            line[1:-1] = (line[:-2] + 2 * line[1:-1] + line[2:]) / 4
        s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
        want = np.linspace(0, s[-1], STRAP_ROWS + 1)[1:-1]
        inner = [self.add([np.interp(w, s, line[:, c]) for c in range(3)]) for w in want]
        return [front] + inner + [back]

    def skirt(self):
        """Six gores of a circle's sector, on the same columns as the bodice panels, opened into a cone."""
        n = 3 * COLUMNS
        around = GATHER * self.tape.length(WAIST_BOTTOM)
        r0 = around / SKIRT_SPREAD
        g = np.linspace(0, 1, SKIRT_ROWS + 1)
        r = r0 + SKIRT_LENGTH * (0.42 * g + 0.58 * g ** 1.55)
        slope = SKIRT_SPREAD / (2 * np.pi)
        waves = [(k, self.rng.normal(), self.rng.uniform(0, 2 * np.pi)) for k in range(6, 20)]
        rows = [self.hem_of_band]
        for radius in r[1:]:
            t = radius - r0
            b = min(t / 0.16, 1.0)
            b = b * b * (3 - 2 * b)
            row = []
            for i in range(n):
                a = 2 * np.pi * i / n
                wave = sum(w * np.cos(k * a + phase + 0.8 * t) for k, w, phase in waves)
                circle = (radius * slope + 0.025 * t * wave) * np.array([np.sin(a), np.cos(a)])
                waist = self.points[self.hem_of_band[i]][[0, 2]]
                x, z = (1 - b) * waist * (1 + 1.2 * t) + b * circle
                row.append(self.add([x, WAIST_BOTTOM - t * np.sqrt(1 - slope ** 2), z]))
            rows.append(row)
        for name, first, last, _ in BODICE_PANELS:
            ids = [[row[k % n] for k in range(3 * first, 3 * last + 1)] for row in rows[::-1]]
            half = SKIRT_SPREAD * (last - first) / COLUMNS / 2
            a = np.linspace(-half, half, 3 * (last - first) + 1)
            flat = {ids[-1 - j][i]: r[j] * np.array([np.sin(a[i]), -np.cos(a[i])])
                    for j in range(SKIRT_ROWS + 1) for i in range(len(a))}
            self.panels.append(Panel(name.replace("bodice", "skirt"), grid_faces(ids), SKIRT_GRAIN, flat))


def flatten(panel, points):
    """Lays a panel flat with its edge and diagonal lengths kept as well as a plane allows."""
    local = {g: k for k, g in enumerate(panel.ids)}
    p = points[panel.ids]
    faces = np.vectorize(local.get)(panel.faces)
    # Begin with the projection on the panel's own plane, x to the right and y up the panel as seen from outside.
    quad = p[faces]
    normals = np.cross(quad[:, 2] - quad[:, 0], quad[:, 3] - quad[:, 1])
    if panel.name.startswith("strap"):
        # A strap bends over the shoulder by half a turn: begin with its row and lane instead.
        start = np.zeros((len(p), 2))
        rows = panel.faces.reshape(STRAP_ROWS, 4, 4)
        for j in range(STRAP_ROWS):
            for i in range(4):
                for corner, (dj, di) in enumerate(((0, 0), (0, 1), (1, 1), (1, 0))):
                    start[local[rows[j, i, corner]]] = (0.012 * (i + di), 0.0105 * (j + dj))
    else:
        out = normals.sum(axis=0) * [1, 0, 1]
        out /= np.linalg.norm(out)
        right = np.cross([0, 1, 0], out)
        middle = p.mean(axis=0)
        angle = np.arctan2((p - middle * [0, 1, 0]) @ right, (p - middle * [0, 1, 0]) @ out)
        start = np.stack([angle * np.hypot(p[:, 0], p[:, 2]).mean(), p[:, 1] - middle[1]], axis=1)
    ends = face_pairs(faces)
    rest = np.linalg.norm(p[ends[:, 0]] - p[ends[:, 1]], axis=1)
    flat = Cloth(np.column_stack([start, np.zeros(len(p))]), np.ones(len(p)), np.ones(len(p)))
    flat.add_springs(ends, rest, np.full(len(ends), 2.0))
    for _ in range(2500):
        flat.solve_springs(1.0)
    q = flat.p[:, :2]
    # Turn it back so that it stands as it began.
    a, b = q - q.mean(axis=0), start - start.mean(axis=0)
    turn = np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())
    c, s = np.cos(turn), np.sin(turn)
    q = EASE * a @ np.array([[c, s], [-s, c]])
    return {g: q[k] for g, k in local.items()}


# ---- sewing and draping ---------------------------------------------------------------------------------------------

def face_pairs(faces):
    """Edges and diagonals, each once."""
    pairs = np.concatenate([faces[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3))])
    return np.unique(np.sort(pairs, axis=1), axis=0)


def sew(dress):
    """The solver's cloth from all panels: rest lengths from the flat pattern, softer off the thread directions."""
    n = len(dress.start)
    mass, area = np.zeros(n), np.zeros(n)
    lengths = {}
    for panel in dress.panels:
        for face in panel.faces:
            q = np.array([panel.flat[i] for i in face])
            d, e = q[2] - q[0], q[3] - q[1]
            share = 0.5 * abs(d[0] * e[1] - d[1] * e[0]) / 4
            np.add.at(area, face, share)
        for i, j in face_pairs(panel.faces):
            d = panel.flat[j] - panel.flat[i]
            length = np.hypot(*d)
            off_thread = abs(2 * d[0] * d[1]) / length ** 2      # sin of twice the angle to the thread
            k = THREAD_STIFFNESS + (SHEAR_STIFFNESS - THREAD_STIFFNESS) * off_thread ** 2
            lengths.setdefault((i, j), []).append((length, k))
    mass = DENSITY * area
    inverse = 1 / mass
    inverse[dress.pinned] = 0
    spacing = np.sqrt(area)
    cloth = Cloth(dress.start, inverse, spacing)
    ends = np.array(list(lengths))
    # Where two panels meet the shorter edge rules: that is what gathers the skirt on the band.
    rest = np.array([min(x)[0] for x in lengths.values()])
    stiffness = np.array([max(k for _, k in x) for x in lengths.values()])
    cloth.add_springs(ends, rest, stiffness)
    rest_of = dict(zip(map(tuple, ends.tolist()), rest))

    # Bending: opposite edges at every vertex of four faces, and along the free edges.
    edge_faces, around = {}, {}
    faces = np.concatenate([p.faces for p in dress.panels]).tolist()
    for f, face in enumerate(faces):
        for a, b in zip(face, face[1:] + face[:1]):
            edge_faces.setdefault((min(a, b), max(a, b)), set()).add(f)
    for a, b in edge_faces:
        around.setdefault(a, []).append(b)
        around.setdefault(b, []).append(a)
    key = lambda a, b: (min(a, b), max(a, b))  # noqa: E731
    triples = []
    for m, others in around.items():
        border = [o for o in others if len(edge_faces[key(m, o)]) == 1]
        if border:
            if len(border) == 2 and len(others) == 3:
                triples.append((border[0], m, border[1]))
            continue
        if len(others) == 4:
            for x in range(4):
                for y in range(x + 1, 4):
                    if not edge_faces[key(m, others[x])] & edge_faces[key(m, others[y])]:
                        triples.append((others[x], m, others[y]))
    triples = np.array(triples)
    l0 = np.array([rest_of[key(a, b)] for a, b, _ in triples])
    l1 = np.array([rest_of[key(b, c)] for _, b, c in triples])
    half = 0.5 * (l0 + l1)
    cloth.add_bends(triples, l0, l1, BENDING * area[triples[:, 1]] / half ** 2)
    return cloth


def petticoat(y):
    """Half width by height of a stiff underskirt that is not drawn; it ends smoothly under the hips."""
    t = np.clip((y - 0.72) / 0.30, 0, 1)
    return (PETTICOAT_HEM - 0.11 * y) * (1 - t * t * (3 - 2 * t))


def obstacles(field):
    def collide(p, previous):
        distance, normal = field.sample(p)
        hit = np.nonzero(distance < CLEARANCE)[0]
        push = CLEARANCE - distance[hit]
        p[hit] += push[:, None] * normal[hit]
        # Friction of cloth on the figure's cover.
        slide = p[hit] - previous[hit]
        slide -= np.einsum("ij,ij->i", slide, normal[hit])[:, None] * normal[hit]
        length = np.maximum(np.linalg.norm(slide, axis=1), 1e-12)
        p[hit] -= slide * np.minimum(1, 0.7 * push / length)[:, None]

        reach = np.hypot(p[:, 0], p[:, 2] / 0.84)
        out = np.maximum(petticoat(p[:, 1]) / np.maximum(reach, 1e-6), 1)
        p[:, 0] *= out
        p[:, 2] *= out
        p[:, 1] = np.maximum(p[:, 1], 0.012)
    return collide


def drape(dress, field):
    cloth = sew(dress)
    collide = obstacles(field)

    def report(t, c):
        hem = c.p[:, 1].min()
        print(f"  {t:5.2f} s  lowest {hem:.3f}  fastest {np.linalg.norm(c.v, axis=1).max():.2f} m/s  "
              f"contacts {len(c.pairs)}", flush=True)

    def breeze(t, p):
        """A gust that disorders the folds and dies, over a faint turn that stays and sweeps them."""
        a = np.zeros_like(p)
        low = np.clip((1.0 - p[:, 1]) / 0.9, 0, 1)
        gust = low * max(0.0, 1 - t / 1.4)
        a[:, 0] = gust * (1.6 * np.sin(5.0 * p[:, 2] + 3.0 * t) + 1.2 * np.sin(9 * p[:, 1] + 7 * p[:, 2] + 2 * t))
        a[:, 2] = gust * (1.4 * np.sin(6.0 * p[:, 0] - 2.0 * t + 1.0) - 0.8)
        reach = np.maximum(np.hypot(p[:, 0], p[:, 2]), 1e-6)
        a[:, 0] += TURN * low * p[:, 2] / reach
        a[:, 2] -= TURN * low * p[:, 0] / reach
        return a

    def turn(t, p):
        return breeze(10.0, p)
    cloth.run(0.25, 1 / 700, collide, 25.0, None, report)
    cloth.run(1.8, 1 / 700, collide, 1.5, breeze, report)
    cloth.run(1.6, 1 / 900, collide, 3.0, turn, report)
    cloth.run(0.5, 1 / 1500, collide, 10.0, turn, report)
    return cloth.p


# ---- output ---------------------------------------------------------------------------------------------------------

NOTE = "# {} made by samples/data/dress/make_dress.py of Tsuya (Apache-2.0).\n"


def write_dress(path, dress, position):
    x = 0.0
    out = [NOTE.format("Draped satin dress"), "# Metres, +Y up. UV: metres of cloth, u along the weft, v along the warp.\n"]
    base = 0
    for panel in dress.panels:
        flat = np.array([panel.flat[i] for i in panel.ids])
        flat = flat - flat.min(axis=0) + [x, 0]
        x = flat[:, 0].max() + 0.02
        local = {g: base + k + 1 for k, g in enumerate(panel.ids)}
        out.append(f"g {panel.name}\n")
        out += ["v %.5f %.5f %.5f\n" % tuple(position[i]) for i in panel.ids]
        out += ["vt %.5f %.5f\n" % tuple(q) for q in flat]
        out += ["f " + " ".join(f"{local[i]}/{local[i]}" for i in face) + "\n" for face in panel.faces]
        base += len(panel.ids)
    save(path, out)


def write_mannequin(path, b):
    out = [NOTE.format("Dress form")]
    out += ["v %.5f %.5f %.5f\n" % p for p in b.v] + ["vt %.4f %.4f\n" % q for q in b.vt]
    for name, faces in b.groups:
        out.append(f"g {name}\n")
        out += ["f " + " ".join(f"{i + 1}/{j + 1}" for i, j in zip(*face)) + "\n" for face in faces]
    save(path, out)


def save(path, lines):
    with open(path + ".part", "w", newline="\n") as f:
        f.writelines(lines)
    os.replace(path + ".part", path)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    if len(arguments) != 1:
        sys.exit("usage: make_dress.py OUTDIR")
    begin = time.time()
    figure = Figure()
    tape = Tape(figure)
    for name, y in (("bust", 1.215), ("waist", 1.06), ("hip", 0.865)):
        print(f"{name}: {100 * (tape.length(y) - 2 * np.pi * CLEARANCE):.1f} cm")
    form = mannequin(figure)
    write_mannequin(os.path.join(arguments[0], "mannequin.obj"), form)
    field = DistanceField(figure)
    dress = Dress(figure, field, np.random.default_rng(7))
    print(f"{len(dress.start)} vertices, {sum(len(p.faces) for p in dress.panels)} quads, {time.time() - begin:.0f} s")
    write_dress(os.path.join(arguments[0], "dress.obj"), dress, drape(dress, field))
    print(f"done in {time.time() - begin:.0f} s")


main()
