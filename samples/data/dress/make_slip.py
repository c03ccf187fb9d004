"""Makes slip.obj: a slip dress cut on the bias, with a cowl neckline and narrow straps, draped on the dress form.

    python3 make_slip.py OUTDIR      or      blender --background --python make_slip.py -- OUTDIR

Needs numpy only. Two panels, front and back, both with the warp at 45 degrees; the front is wider and higher at the
neckline than the form, and what is too much falls into the cowl. Same numbers on every run of one machine.
"""
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from cloth import finer, off_form, report, tube_of, without_noise  # noqa: E402
from form import DistanceField, Figure  # noqa: E402
from tailor import Panel, Tape, grid_faces, over_shoulder, turn_edges, turn_hem, write_garment  # noqa: E402

# ---- the design -----------------------------------------------------------------------------------------------------

COLUMNS, ROWS = 112, 128
FRONT, BACK = 14, 42        # columns of the left straps; the side seams are at a quarter and three quarters
UNDERARM = 1.262            # height where the pattern's t is 0; t grows down the cloth
LENGTH = 0.95
CLEARANCE = 0.0045
#                      t      half width of front and of back, metres
WIDTH = np.array([[-0.150, 0.325, 0.215],
                  [-0.040, 0.250, 0.218],
                  [0.000, 0.226, 0.218],
                  [0.060, 0.228, 0.214],
                  [0.200, 0.186, 0.180],
                  [0.400, 0.244, 0.244],
                  [0.600, 0.275, 0.275],
                  [1.000, 0.350, 0.350]])
COWL = -0.135               # t of the neckline in front
BACK_STRAP, BACK_MIDDLE = -0.020, 0.055
STRAP_POINT = (0.092, 1.345), (0.085, 1.290)    # |x| and height, in front and at the back

STRAP_SHAPE = 1e-3 * np.array([[0, 0.9], [2.2, 0.9], [3.0, 0.55], [3.0, -0.55], [2.2, -0.9], [0, -0.9], [-2.2, -0.9],
                               [-3.0, -0.55], [-3.0, 0.55], [-2.2, 0.9]])    # across, outwards
DENSITY = 0.09              # kg/m2
THREADS, SHEAR = 900.0, 45.0  # N/m along warp and weft, and at 45 degrees to them
BENDING = 3.0e-5            # N m
GRAIN = np.radians(45)


def top_of(f, back):
    """t of the upper edge; f runs from -1 to 1 between the side seams."""
    g = np.abs(f)
    at = np.interp(g, [0.5, 1.0], [0, 1])
    if back:
        middle = np.clip(g / 0.5, 0, 1)
        neck = BACK_MIDDLE + (BACK_STRAP - BACK_MIDDLE) * middle ** 2.2
        return np.where(g <= 0.5, neck, BACK_STRAP * (1 - at) ** 1.6)
    return np.where(g <= 0.5, COWL, COWL * (1 - at) ** 1.8)


def pattern():
    """Flat places [row, column, 0 or 1] before the grain is turned, as tube_of wants them, and t [row, column]."""
    n, quarter = COLUMNS, COLUMNS // 4
    g = np.linspace(0, 1, ROWS + 1)[:, None]
    flat, t = np.zeros((ROWS + 1, n, 2, 2)), np.zeros((ROWS + 1, n))
    for back, first in ((0, -quarter), (1, quarter)):
        k = np.arange(first, first + 2 * quarter + 1)
        f = (k - first) / quarter - 1
        top = top_of(f, back)
        down = top + (LENGTH - top) * g
        x = f * np.interp(down, WIDTH[:, 0], WIDTH[:, 1 + back])
        place = np.stack([x, -down], axis=2)
        flat[:, k[:-1] % n, 0], flat[:, k[:-1] % n, 1] = place[:, :-1], place[:, 1:]
        t[:, k[:-1] % n] = down[:, :-1]
    return flat, t


def turned(q):
    c, s = np.cos(GRAIN), np.sin(GRAIN)
    return q @ np.array([[c, s], [-s, c]])


def begin(tape, t, flat):
    """The cloth around the form, a little wide."""
    p = np.zeros(t.shape + (3,))
    i = np.arange(COLUMNS) / COLUMNS
    for j in range(len(t)):
        for k in range(COLUMNS):
            y = UNDERARM - t[j, k]
            q = tape.point(np.round(np.clip(y, 0.80, 1.36), 3), i[k])
            wide = 1.04 + 0.25 * max(0.80 - y, 0)
            f = min(k, COLUMNS - k) / FRONT
            slack = max(1 - f * f, 0) * np.clip((0.06 - t[j, k]) / 0.17, 0, 1)     # the cowl, begun
            p[j, k] = [q[0] * wide, y - 0.115 * slack, q[2] * wide + 0.05 * slack]
    return p


def strap_points(tape):
    """Columns of the four straps and their places on the form."""
    points = {}
    for side in (1, -1):
        for column, (x, y), front in ((FRONT, STRAP_POINT[0], True), (BACK, STRAP_POINT[1], False)):
            f = np.linspace(0, 0.25, 400) if front else np.linspace(0.25, 0.5, 400)
            line = np.array([tape.point(y, v) for v in f])
            q = line[np.argmin(abs(line[:, 0] - x))]
            points[side * column % COLUMNS] = q * [side, 1, 1]
    return points


def drape(field, tape):
    flat, t = pattern()
    start = begin(tape, t, flat)
    straps = strap_points(tape)
    rub = off_form(field, CLEARANCE)
    high = UNDERARM - t[:, 0] > 0.70

    def part(step, position, seconds):
        pinned = np.zeros(position.shape[:2], bool)
        for column, q in straps.items():
            pinned[0, column // step] = True
            position[0, column // step] = q
        tube = tube_of(position, turned(right_of(flat, step)), pinned, DENSITY, THREADS, SHEAR, BENDING, 0.75)
        tube.material = start[::step, ::step].reshape(-1, 3)
        rows = int(np.count_nonzero(high[::step]))
        for duration, dt, drag in seconds:
            tube.run(duration, dt, lambda p, previous: rub(p[:, :rows], previous[:, :rows]), drag, None, report)
        return np.moveaxis(tube.p, 0, -1)
    coarse = part(2, start[::2, ::2].copy(), [(1.4, 1 / 500, 3.0), (0.6, 1 / 700, 6.0)])
    p = part(1, finer(coarse), [(0.7, 1 / 800, 5.0), (0.3, 1 / 1000, 12.0)])
    return without_noise(p, np.isin(np.arange(COLUMNS), list(straps))), flat


def right_of(flat, step):
    """The pattern of every `step`th vertex: right neighbours are `step` columns away, in the same panel."""
    if step == 1:
        return flat
    here = flat[::step, ::step, 0]
    right = flat[::step, step - 1::step, 1]
    return np.stack([here, right], axis=2)


# ---- sewing ---------------------------------------------------------------------------------------------------------

def sew(p, flat):
    """Points and panels with the hem turned; flat positions with the warp on the bias."""
    up = p[::-1]
    hem, beyond = turn_hem(up)
    grid = np.concatenate([hem, up])
    ids = np.arange(grid.shape[0] * COLUMNS).reshape(-1, COLUMNS)
    down = flat[::-1]
    quarter, panels = COLUMNS // 4, []
    for name, first in (("slip_front", -quarter), ("slip_back", quarter)):
        k = np.arange(first, first + 2 * quarter + 1)
        own = ids[:, k % COLUMNS]
        place = np.concatenate([down[:, k[:-1] % COLUMNS, 0], down[:, k[-2:-1] % COLUMNS, 1]], axis=1)
        tail = place[0][None] - np.stack([np.zeros_like(beyond), beyond], axis=1)[:, None]
        place = turned(np.concatenate([tail, place]))
        panel = Panel(name, grid_faces(own), 0.0, {g: q for g, q in zip(own.ravel(), place.reshape(-1, 2))})
        panel.cut = np.unique(own[len(hem):])
        panels.append(panel)
    points = turn_edges(grid.reshape(-1, 3), panels, [ids[-1, ::-1].tolist()])
    return points, panels


def strap(field, a, b):
    """A narrow flat tube around a line over the shoulder: rings of STRAP_SHAPE."""
    line = over_shoulder(field, a, b, 0.0028, 56)
    along = np.gradient(line, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    out = field.sample(line)[1]
    out -= np.einsum("ij,ij->i", out, along)[:, None] * along
    for _ in range(12):
        out[1:-1] = 0.25 * (out[:-2] + 2 * out[1:-1] + out[2:])
    out /= np.linalg.norm(out, axis=1)[:, None]
    across = np.cross(out, along)
    return line[:, None] + STRAP_SHAPE[None, :, :1] * across[:, None] + STRAP_SHAPE[None, :, 1:] * out[:, None]


def add_strap(name, rings, points, panels):
    """A tube, slit along its inside in the pattern, with closed ends."""
    rows, around = rings.shape[:2]
    v = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(rings.mean(axis=1), axis=0), axis=1))])
    closed = np.concatenate([rings[0], rings[0][:1]])
    u = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    ring = rings[:, (np.arange(around + 1) + around // 2) % around]         # the slit lies at the form
    ids = len(points) + np.arange(rows * (around + 1)).reshape(rows, -1)
    points = np.concatenate([points, ring.reshape(-1, 3)])
    flat = {ids[j, i]: np.array([u[i], v[j]]) for j in range(rows) for i in range(around + 1)}
    faces = [grid_faces(ids)]
    for j, sign in ((0, 1), (rows - 1, -1)):
        end = len(points) + np.arange(around)
        points = np.concatenate([points, rings[j]])
        for k in range(around):
            flat[end[k]] = np.array([u[-1] / 2 + sign * STRAP_SHAPE[k, 0], v[j] + STRAP_SHAPE[k, 1] - sign * 2e-3])
        quads = end[[[1, 0, 5, 4], [2, 1, 4, 3], [0, 9, 6, 5], [9, 8, 7, 6]]]
        faces.append(quads if sign > 0 else quads[:, ::-1])
    panels.append(Panel(name, np.concatenate(faces), 0.0, flat))
    return points


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    if len(arguments) != 1:
        sys.exit("usage: make_slip.py OUTDIR")
    started = time.time()
    figure = Figure()
    field = DistanceField(figure)
    p, flat = drape(field, Tape(figure, CLEARANCE + 0.0005))
    points, panels = sew(p, flat)
    for name, side in (("strap_left", 1), ("strap_right", -1)):
        a, b = (p[0, side * c % COLUMNS] + 0.6 * (p[4, side * c % COLUMNS] - p[0, side * c % COLUMNS]) for c in (FRONT, BACK))
        distance, out = field.sample(np.array([a, b]))
        a, b = (q - (d - 0.0018) * n for q, d, n in zip((a, b), distance, out))
        points = add_strap(name, strap(field, a, b), points, panels)
    print(f"{sum(len(x.faces) for x in panels)} quads")
    write_garment(os.path.join(arguments[0], "slip.obj"), "Bias-cut slip dress", "make_slip.py", panels, points)
    print(f"done in {time.time() - started:.0f} s")


if __name__ == "__main__":
    main()
