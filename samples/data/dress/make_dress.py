"""Makes dress.obj and dress_form.obj: a sewn satin gown on a dress form, its skirt draped by simulation.

    python3 make_dress.py OUTDIR      or      blender --background --python make_dress.py -- OUTDIR

Needs numpy only. The bodice is cut to the form: its panels are laid flat from the body's shape (UV in metres of cloth:
u = weft, v = warp). The skirt is cut flat, six gores of a wide sector of a circle, and falls from the waistband. Same
numbers on every run of one machine.
"""
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from cloth import finer, off_form, report, tube_of, without_noise  # noqa: E402
from form import DistanceField, Figure, dress_form  # noqa: E402
from tailor import (Panel, Tape, fair, flatten, free_edges, grid_faces, loops_of, over_shoulder,  # noqa: E402
                    turn_edges, turn_hem, unroll, vertex_normals, write_form, write_garment)

# ---- the design -----------------------------------------------------------------------------------------------------

COLUMNS = 160               # around the dress, all the way down
BODICE_ROWS, BAND_ROWS, STRAP_ROWS, SKIRT_ROWS = 20, 3, 44, 72
WAIST_TOP, WAIST_BOTTOM = 1.070, 1.050
CLEARANCE = 0.0036          # of the bodice from the form
SEAM_DIP = 0.0005           # how far seams lie in the surface
SKIRT_SPREAD = 5.8          # radians of the circle that the six gores make together
SKIRT_LENGTH = 1.03
HEM = 0.010                 # height above the floor that the skirt is levelled to
TRAIN = 0.12                # how much longer the middle of the back is
PETTICOAT = 0.22            # radius at the floor of an underskirt of tulle that holds the skirt out; not drawn
SWEEP = 1.1                 # m/s2 of the slow turn that bends the folds to an S

DENSITY = 0.14              # kg/m2
THREADS, SHEAR = 1200.0, 120.0  # N/m along warp and weft, and at 45 degrees to them
BENDING = 5e-5              # N m

# name, first and last column, grain of the bodice (degrees that the pattern is turned on the cloth)
PANELS = [
    ("front", -16, 16, 45.0),
    ("side_front_left", 16, 40, 0.0),
    ("side_back_left", 40, 64, 0.0),
    ("back", 64, 96, 0.0),
    ("side_back_right", 96, 120, 0.0),
    ("side_front_right", 120, 144, 0.0),
]
BAND_PANELS = [("waistband_front", -40, 40, 90.0), ("waistband_back", 40, 120, 90.0)]
STRAP = (16, 22, 64)        # columns of a strap in front, and that of its inner edge at the back
# Height of the bodice's top edge by column (symmetric): a V in front, a shallow scoop at the back.
TOP_EDGE = np.array([[0, 1.226], [4, 1.243], [8, 1.267], [12, 1.299], [14, 1.317], [16, 1.338], [22, 1.336],
                     [24, 1.314], [27, 1.290], [31, 1.272], [36, 1.262], [40, 1.259], [44, 1.262], [49, 1.274],
                     [53, 1.295], [56, 1.317], [58, 1.336], [64, 1.338], [67, 1.312], [71, 1.285], [76, 1.268],
                     [80, 1.264]])


def top_edge():
    c = np.arange(COLUMNS)
    half = np.minimum(c, COLUMNS - c)
    top = np.interp(half, TOP_EDGE[:, 0], TOP_EDGE[:, 1])
    free = ~(((half >= 16) & (half <= 22)) | ((half >= 58) & (half <= 64)) | (half == 0))
    for _ in range(2):
        top = np.where(free, 0.25 * (np.roll(top, 1) + 2 * top + np.roll(top, -1)), top)
    return top


class Dress:
    def __init__(self, figure, field):
        self.points, self.panels = [], []
        self.tape, self.field, self.figure = Tape(figure, CLEARANCE), field, figure
        self.upper()
        self.skirt = self.cut_skirt()

    def add(self, p):
        self.points.append(np.asarray(p, float))
        return len(self.points) - 1

    # ---- bodice, band and straps

    def upper(self):
        top = top_edge()
        n = COLUMNS
        ring = lambda y: [self.add(self.tape.point(y, i / n)) for i in range(n)]  # noqa: E731
        self.band = [ring(y) for y in np.linspace(WAIST_BOTTOM, WAIST_TOP, BAND_ROWS + 1)]
        self.body = [self.band[-1]] + [
            [self.add(self.tape.point(WAIST_TOP + (top[i] - WAIST_TOP) * j / BODICE_ROWS, i / n)) for i in range(n)]
            for j in range(1, BODICE_ROWS + 1)]
        for name, first, last, grain in PANELS:
            ids = [[row[k % n] for k in range(first, last + 1)] for row in self.body]
            self.panels.append(Panel("bodice_" + name, grid_faces(ids), grain))
        for name, first, last, grain in BAND_PANELS:
            ids = [[row[k % n] for k in range(first, last + 1)] for row in self.band]
            self.panels.append(Panel(name, grid_faces(ids), grain))
        strips = {}
        for name, sign in (("strap_left", 1), ("strap_right", -1)):
            lanes = [self.strap_lane(sign, lane) for lane in range(STRAP[1] - STRAP[0] + 1)]
            grid = np.array(lanes if sign > 0 else lanes[::-1]).T
            strips[name] = {g: np.array([0.0055 * i, 0.008 * j]) for j, row in enumerate(grid) for i, g in enumerate(row)}
            self.panels.append(Panel(name, grid_faces(grid), 0.0))
        self.shape_upper()
        points = np.array(self.points)
        for panel in self.panels:
            panel.flat = flatten(panel, points, strips.get(panel.name) or unroll(panel, points))
            panel.turn_to_grain()

    def strap_lane(self, sign, lane):
        """One line of the strap over the shoulder, from the front edge to the back edge; lane 0 lies at the neck."""
        front, back = (self.body[-1][(sign * k) % COLUMNS] for k in (STRAP[0] + lane, STRAP[2] - lane))
        line = over_shoulder(self.field, self.points[front], self.points[back], CLEARANCE, STRAP_ROWS)
        return [front] + [self.add(p) for p in line[1:-1]] + [back]

    def shape_upper(self):
        """Evens the cloth out over the straps' roots, keeps it off the form, and lets the seams lie in it a little."""
        points = np.array(self.points)
        faces = np.concatenate([p.faces for p in self.panels])
        held = self.band[0]
        for _ in range(4):
            points = fair(points, faces, held, 3)
            distance, normal = self.field.sample(points)
            push = np.maximum(CLEARANCE - distance, 0)
            push[held] = 0
            points += push[:, None] * normal
        normals = vertex_normals(points, faces)
        owners = np.zeros(len(points), int)
        for panel in self.panels:
            owners[panel.ids()] += 1
        border = {a for a, _ in free_edges(faces)}
        seam = [i for i in np.nonzero(owners > 1)[0] if i not in border] + self.band[0]
        points[seam] -= SEAM_DIP * normals[seam]
        self.points = list(points)

    # ---- skirt

    def cut_skirt(self, lengths=None, step=1):
        """The pattern: radius r and angle a in the circle's sector for each vertex."""
        n = COLUMNS
        r0 = self.tape.length(WAIST_BOTTOM) / SKIRT_SPREAD
        length = np.full(n, SKIRT_LENGTH) if lengths is None else lengths
        g = np.linspace(0, 1, SKIRT_ROWS + 1)
        return r0 + length[None, :] * (0.45 * g + 0.55 * g ** 1.5)[:, None]

    def flat_skirt(self, step=1):
        """flat[row, column, 0 or 1] of every `step`th vertex, each column in the gore at its right; see tube_of."""
        r = self.skirt[::step, ::step]
        flat = np.zeros(r.shape + (2, 2))
        for _, first, last, _ in PANELS:
            for k in range(first, last, step):
                i, j = k % COLUMNS // step, (k + step) % COLUMNS // step
                for side, (c, at) in enumerate(((i, k), (j, k + step))):
                    a = SKIRT_SPREAD * (at - 0.5 * (first + last)) / COLUMNS
                    flat[:, i, side] = r[:, c, None] * np.array([np.sin(a), -np.cos(a)])
        return flat

    def hang(self, step, rng):
        """Where the skirt begins: a cone with faint irregular waves."""
        n = COLUMNS // step
        waist = np.array([self.points[i] for i in self.band[0]])[::step]
        r = self.skirt[::step, ::step]
        slope = 0.93 * SKIRT_SPREAD / (2 * np.pi)
        a = 2 * np.pi * np.arange(n) / n
        wave = np.zeros(n)
        for k in range(7, 17):
            wave += rng.normal() * np.exp(-0.5 * ((k - 12) / 2.5) ** 2) * np.cos(k * a + rng.uniform(0, 2 * np.pi))
        p = np.zeros(r.shape + (3,))
        for j in range(len(r)):
            t = r[j] - r[0]
            b = np.minimum(t / 0.14, 1.0)
            b = (b * b * (3 - 2 * b))[:, None]
            reach = r[j] * slope * (1 + 0.03 * np.minimum(t / 0.3, 1) * wave)
            circle = np.stack([reach * np.sin(a), reach * np.cos(a)], axis=1)
            flat = (1 - b) * waist[:, [0, 2]] * (1 + 2.0 * t[:, None]) + b * circle
            p[j, :, 0], p[j, :, 2] = flat.T
            p[j, :, 1] = WAIST_BOTTOM - t * np.sqrt(1 - slope ** 2)
        p[0] = waist
        return p

    def drape(self, floor=True, step=1, start=None, seconds=(), report=None):
        position = self.hang(step, np.random.default_rng(SEED)) if start is None else start
        pinned = np.zeros(position.shape[:2], bool)
        pinned[0] = True
        tube = tube_of(position, self.flat_skirt(step), pinned, DENSITY, THREADS, SHEAR, BENDING, 0.75)
        tube.material = self.hang(step, np.random.default_rng(SEED)).reshape(-1, 3)
        collide = self.obstacles(int(0.42 * len(position)), floor)
        for duration, dt, drag, push, sweeps in seconds:
            tube.run(duration, dt, collide, drag, push, report, sweeps)
        return np.moveaxis(tube.p, 0, -1)

    def obstacles(self, rows, floor):
        rub = off_form(self.field, CLEARANCE + 0.0005)

        def collide(p, previous):
            rub(p[:, 1:rows], previous[:, 1:rows])
            reach = np.maximum(np.hypot(p[0], p[2]), 1e-6)
            out = np.maximum(petticoat(p[1]) / reach, 1)
            p[0] *= out
            p[2] *= out
            if floor:
                below = p[1] < 0.004
                p[0] = np.where(below, previous[0] + 0.4 * (p[0] - previous[0]), p[0])
                p[2] = np.where(below, previous[2] + 0.4 * (p[2] - previous[2]), p[2])
                p[1] = np.maximum(p[1], 0.004)
        return collide


SEED = 11


def petticoat(y):
    t = np.clip((y - 0.55) / 0.45, 0, 1)
    return PETTICOAT * (1 - y) * (1 - t * t * (3 - 2 * t))


def sweep(t, p):
    """A slow turn of the form: one way at the knee, the other way at the hem, not everywhere alike."""
    a = np.zeros_like(p)
    theta = np.arctan2(p[0], p[2])
    down = np.clip((1.05 - p[1]) / 1.05, 0, 1)
    s = SWEEP * np.sin(1.6 * np.pi * down) * down * (0.7 + 0.5 * np.sin(2 * theta + 0.6) + 0.3 * np.sin(5 * theta))
    reach = np.maximum(np.hypot(p[0], p[2]), 1e-6)
    a[0], a[2] = s * p[2] / reach, -s * p[0] / reach
    return a


def gust(t, p):
    """Disorders the folds and dies; the sweep stays."""
    low = np.clip((1.0 - p[1]) / 0.9, 0, 1) * max(0.0, 1 - t / 0.9)
    a = sweep(t, p)
    a[0] += low * (1.6 * np.sin(5.0 * p[2] + 3.0 * t) + 1.2 * np.sin(9 * p[1] + 7 * p[2] + 2 * t))
    a[2] += low * (1.4 * np.sin(6.0 * p[0] - 2.0 * t + 1.0))
    return a


def level_hem(dress, p, step):
    """Cuts each column so that its end will hang at HEM, as on a stand, and adds the train."""
    low = p[-1, :, 1]
    n = len(low)
    kernel = np.exp(-0.5 * (np.minimum(np.arange(n), n - np.arange(n)) / (4 / step)) ** 2)
    low = np.real(np.fft.ifft(np.fft.fft(low) * np.fft.fft(kernel / kernel.sum())))
    low = np.interp(np.arange(COLUMNS), np.arange(n + 1) * step, np.append(low, low[0]))
    back = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(COLUMNS) / COLUMNS)
    lengths = dress.skirt[-1] - dress.skirt[0] + (low - HEM) + TRAIN * back ** 3
    print(f"hem levelled: {low.min():.3f} to {low.max():.3f} m; length {lengths.min():.3f} to {lengths.max():.3f} m")
    dress.skirt = dress.cut_skirt(lengths)


def drape(dress):
    fall = [(2.0, 1 / 450, 1.2, gust, 1), (0.6, 1 / 600, 5.0, sweep, 1), (0.25, 1 / 2000, 8.0, sweep, 2)]
    level_hem(dress, dress.drape(False, 2, None, fall, report), 2)
    coarse = dress.drape(True, 2, None, fall, report)
    fine = finer(coarse)
    fine[0] = [dress.points[i] for i in dress.band[0]]
    p = dress.drape(True, 1, fine, [(0.5, 1 / 800, 4.0, sweep, 1), (0.35, 1 / 2000, 10.0, sweep, 2)], report)
    return without_noise(p, np.ones(COLUMNS, bool))


# ---- finishing ------------------------------------------------------------------------------------------------------

def sew_skirt(dress, p):
    """The draped skirt as panels with a turned hem; flat positions along the circle's radius."""
    up = p[::-1]                                            # rows go up
    turned, beyond = turn_hem(up)
    rows = [[dress.add(q) for q in row] for row in turned] + [[dress.add(q) for q in row] for row in up[:-1]]
    rows.append(dress.band[0])
    radius = np.concatenate([dress.skirt[-1] + beyond[:, None], dress.skirt[::-1]])
    for name, first, last, _ in PANELS:
        columns = np.arange(first, last + 1)
        ids = np.array([[row[k % COLUMNS] for k in columns] for row in rows])
        a = SKIRT_SPREAD * (columns - 0.5 * (first + last)) / COLUMNS
        flat = {ids[j, i]: radius[j, k % COLUMNS] * np.array([np.sin(a[i]), -np.cos(a[i])])
                for j in range(len(rows)) for i, k in enumerate(columns)}
        panel = Panel("skirt_" + name, grid_faces(ids), 0.0, flat)
        panel.cut = np.unique(ids[len(turned):])
        dress.panels.append(panel)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    if len(arguments) != 1:
        sys.exit("usage: make_dress.py OUTDIR")
    begin = time.time()
    figure = Figure()
    tape = Tape(figure, 0.0)
    for name, y in (("bust", 1.215), ("waist", 1.06), ("hip", 0.865)):
        print(f"{name}: {100 * tape.length(y):.1f} cm")
    write_form(os.path.join(arguments[0], "dress_form.obj"), dress_form(figure))
    dress = Dress(figure, DistanceField(figure))
    upper = list(dress.panels)
    print(f"bodice cut in {time.time() - begin:.0f} s", flush=True)
    skirt = drape(dress)
    faces = np.concatenate([p.faces for p in upper])
    loops = [x for x in loops_of(free_edges(faces)) if not set(x) & set(dress.band[0])]
    dress.points = list(turn_edges(np.array(dress.points), dress.panels, loops))
    sew_skirt(dress, skirt)
    print(f"{sum(len(p.faces) for p in dress.panels)} quads")
    write_garment(os.path.join(arguments[0], "dress.obj"), "Draped satin gown", "make_dress.py", dress.panels,
                  np.array(dress.points))
    print(f"done in {time.time() - begin:.0f} s")


if __name__ == "__main__":
    main()
