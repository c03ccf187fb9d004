"""What both garments are made with: a tape around the form, panels and their flat pattern, turned edges, the file."""
import os

import numpy as np

ROLL = 0.8e-3               # radius of a turned edge
FACING = (0.005, 0.012)     # rows of what is turned inside, metres from the edge
HEM = (0.006, 0.018)        # the same of a hem


def hull(points):
    """Convex hull of 2D points, counter-clockwise."""
    p = points[np.lexsort((points[:, 1], points[:, 0]))].tolist()

    def half(seq):
        out = []
        for x, y in seq:
            while len(out) > 1 and ((out[-1][0] - out[-2][0]) * (y - out[-2][1])
                                    <= (out[-1][1] - out[-2][1]) * (x - out[-2][0])):
                out.pop()
            out.append((x, y))
        return out[:-1]
    return np.array(half(p) + half(p[::-1]))


class Tape:
    """A tape around the form at some height: point at a fraction of its length, from the middle of the front."""

    def __init__(self, figure, clearance):
        self.figure, self.clearance, self.cache = figure, clearance, {}

    def ring(self, y):
        y = round(y, 5)
        if y not in self.cache:
            h = hull(self.figure.section(y))[::-1]                    # clockwise from above: +Z towards +X
            edge = np.roll(h, -1, axis=0) - h
            out = np.stack([-edge[:, 1], edge[:, 0]], axis=1)
            out /= np.linalg.norm(out, axis=1)[:, None]
            normal = out + np.roll(out, 1, axis=0)
            h = h + self.clearance * normal / np.linalg.norm(normal, axis=1)[:, None]
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


class Panel:
    """A piece of cloth: faces of shared vertex ids, and one flat position per vertex (u weft, v warp)."""

    def __init__(self, name, faces, grain=0.0, flat=None):
        self.name, self.grain, self.flat = name, grain, flat
        self.faces = np.array(faces)
        self.cut = self.ids()                   # without what is turned inside

    def ids(self):
        return np.unique(self.faces)

    def turn_to_grain(self):
        """`grain`: degrees that the pattern is turned on the cloth."""
        a = np.radians(self.grain)
        turn = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
        self.flat = {i: turn.T @ q for i, q in self.flat.items()}


def grid_faces(ids):
    """Quads of a grid ids[row][column]; rows go up and columns to the right, seen from outside."""
    ids = np.asarray(ids)
    return np.stack([ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]], axis=-1).reshape(-1, 4)


def vertex_normals(points, faces):
    p = points[faces]
    normal = np.zeros_like(points)
    n = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
    for k in range(4):
        np.add.at(normal, faces[:, k], n)
    return normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-12)[:, None]


def free_edges(faces):
    """Directed edges (a, b) that one face has: the cloth lies at their left, seen from outside."""
    edges = np.concatenate([faces[:, [k, (k + 1) % 4]] for k in range(4)])
    count = {}
    for a, b in edges.tolist():
        count[min(a, b), max(a, b)] = count.get((min(a, b), max(a, b)), 0) + 1
    return [(a, b) for a, b in edges.tolist() if count[min(a, b), max(a, b)] == 1]


def loops_of(edges):
    after, loops = dict(edges), []
    while after:
        start, b = after.popitem()
        loop = [start]
        while b != start:
            loop.append(b)
            b = after.pop(b)
        loops.append(loop)
    return loops


def fair(points, faces, held, passes, edges_too=True):
    """Evens a surface out; free edges run along themselves, vertices in `held` stay."""
    pairs = np.unique(np.sort(np.concatenate([faces[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1), axis=0)
    border = free_edges(faces)
    on_border = np.zeros(len(points), bool)
    on_border[np.array(border).ravel()] = True
    a, b = pairs.T
    keep = ~(on_border[a] | on_border[b])
    ends = np.concatenate([np.stack([a[keep], b[keep]]), np.array(border).T], axis=1)
    half = ~keep & ~(on_border[a] & on_border[b])               # from the border to the inside
    inner = np.where(on_border[a[half]], b[half], a[half])
    outer = np.where(on_border[a[half]], a[half], b[half])
    fixed = np.ones(len(points), bool)
    fixed[np.unique(faces)] = False
    fixed[list(held)] = True
    if not edges_too:
        fixed |= on_border
    for _ in range(passes):
        total, count = np.zeros_like(points), np.zeros(len(points))
        for i, j in ((ends[0], ends[1]), (ends[1], ends[0]), (inner, outer)):
            np.add.at(total, i, points[j])
            np.add.at(count, i, 1)
        mean = total / np.maximum(count, 1)[:, None]
        points = np.where((fixed | (count == 0))[:, None], points, 0.5 * (points + mean))
    return points


def flatten(panel, points, start):
    """Lays a panel flat, each triangle as rigidly as the others allow (local-global iteration). `start`: id to plane."""
    ids = panel.ids()
    local = {g: k for k, g in enumerate(ids)}
    faces = np.vectorize(local.get)(panel.faces)
    triangles = np.concatenate([faces[:, t] for t in ([0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3])])
    p = points[ids][triangles]
    x = np.linalg.norm(p[:, 1] - p[:, 0], axis=1)
    along = (p[:, 1] - p[:, 0]) / x[:, None]
    c = p[:, 2] - p[:, 0]
    cx = np.einsum("ij,ij->i", c, along)
    cy = np.linalg.norm(c - cx[:, None] * along, axis=1)
    shape = np.zeros((len(triangles), 3, 2))
    shape[:, 1, 0], shape[:, 2, 0], shape[:, 2, 1] = x, cx, cy
    n = len(ids)
    laplacian = np.zeros((n, n))
    weights = []
    for k in range(3):
        i, j, o = triangles[:, k], triangles[:, (k + 1) % 3], (k + 2) % 3
        d, e = shape[:, k] - shape[:, o], shape[:, (k + 1) % 3] - shape[:, o]
        w = 0.5 * np.einsum("ij,ij->i", d, e) / np.maximum(abs(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]), 1e-12)
        w = np.clip(w, 0.02, 20)
        weights.append(w)
        for a, b, s in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
            np.add.at(laplacian, (a, b), s * w)
    laplacian[0, 0] += 1.0
    inverse = np.linalg.inv(laplacian)
    q = np.array([start[g] for g in ids])
    for _ in range(200):
        covariance = np.zeros((len(triangles), 2, 2))
        edge = []
        for k in range(3):
            d = shape[:, (k + 1) % 3] - shape[:, k]
            e = q[triangles[:, (k + 1) % 3]] - q[triangles[:, k]]
            covariance += weights[k][:, None, None] * e[:, :, None] * d[:, None, :]
            edge.append(d)
        angle = np.arctan2(covariance[:, 1, 0] - covariance[:, 0, 1], covariance[:, 0, 0] + covariance[:, 1, 1])
        cos, sin = np.cos(angle), np.sin(angle)
        right = np.zeros((n, 2))
        for k, d in enumerate(edge):
            r = weights[k][:, None] * np.stack([cos * d[:, 0] - sin * d[:, 1], sin * d[:, 0] + cos * d[:, 1]], axis=1)
            np.add.at(right, triangles[:, (k + 1) % 3], r)
            np.add.at(right, triangles[:, k], -r)
        right[0] += q[0]
        q = inverse @ right
    a, b = q - q.mean(axis=0), np.array([start[g] for g in ids])
    b = b - b.mean(axis=0)
    turn = np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())
    cos, sin = np.cos(turn), np.sin(turn)
    q = a @ np.array([[cos, sin], [-sin, cos]])
    return {g: q[k] for g, k in local.items()}


def unroll(panel, points):
    """Where `flatten` begins: the panel as it stands around the y axis, x to the right, seen from outside."""
    ids = panel.ids()
    p = points[ids]
    middle = p.mean(axis=0)
    towards = np.arctan2(middle[0], middle[2])
    angle = (np.arctan2(p[:, 0], p[:, 2]) - towards + np.pi) % (2 * np.pi) - np.pi
    start = np.stack([angle * np.hypot(p[:, 0], p[:, 2]).mean(), p[:, 1] - middle[1]], axis=1)
    return {g: start[k] for k, g in enumerate(ids)}


def turn_edges(points, panels, loops):
    """Turns the cloth over along its free edges: the edge rolls inwards in its own panel, and a facing of its own pattern
    follows inside. Returns all points; adds to the panels and to their list.
    """
    faces = np.concatenate([p.faces for p in panels])
    normals = vertex_normals(points, faces)
    rows, widths = {}, {}                        # vertex ids and widths of the facing, by the vertex of the edge
    new = list(points)
    for loop in loops:
        e, n = points[loop], normals[loop]
        t = np.roll(e, -1, axis=0) - np.roll(e, 1, axis=0)
        inwards = np.cross(n, t)
        inwards /= np.linalg.norm(inwards, axis=1)[:, None]
        layers = [e - ROLL * np.sin(a) * inwards - ROLL * (1 - np.cos(a)) * n for a in np.radians([55, 120, 180])]
        share = np.minimum(1, 0.6 * _room(e, inwards) / FACING[-1])
        share = np.minimum(share, np.minimum(np.roll(share, 1), np.roll(share, -1)) + 0.15)
        for w in FACING:
            q = e + (w * share)[:, None] * inwards - 2 * ROLL * n
            near = np.argmin(((q[:, None] - points[None, np.unique(faces)]) ** 2).sum(axis=2), axis=1)
            near = np.unique(faces)[near]
            depth = np.einsum("ij,ij->i", q - points[near], normals[near])
            layers.append(q - (depth + 2 * ROLL)[:, None] * normals[near])
        for k, a in enumerate(loop):
            widths[a] = [0.0] + [w * share[k] for w in FACING]
            rows[a] = [a] + list(range(len(new) + k, len(new) + k + len(layers) * len(loop), len(loop)))
        new += [q for layer in layers for q in layer]
    ends = {a: b for loop in loops for a, b in zip(loop, loop[1:] + loop[:1])}
    for panel in list(panels):
        own = [(a, b) for a, b in free_edges(panel.faces) if ends.get(a) == b]
        if own:
            panels.append(_turn_panel(panel, own, rows, widths))
    return np.array(new)


def _room(edge, inwards):
    """How far the cloth reaches inwards from each point of an edge before it is nearer to another: narrow in corners."""
    d = edge[None] - edge[:, None]
    ahead = np.einsum("ijk,ik->ij", d, inwards)
    square = (d * d).sum(axis=2)
    return np.where(ahead > 1e-9, square / np.maximum(2 * ahead, 1e-9), np.inf).min(axis=1)


def _turn_panel(panel, own, rows, widths):
    """Adds the roll to a panel along its edges `own`; returns the facing."""
    across = {}
    for a, b in own:
        d = panel.flat[b] - panel.flat[a]
        for x in (a, b):
            across.setdefault(x, []).append(np.array([d[1], -d[0]]) / np.hypot(*d))
    arc = ROLL * np.radians([55, 120, 180])
    facing = Panel(panel.name + "_facing", np.zeros((0, 4), int), 0.0, {})
    roll_faces, facing_faces = [], []
    for x, directions in across.items():
        out = np.sum(directions, axis=0)
        out /= np.hypot(*out)
        for k, s in enumerate(arc):
            panel.flat[rows[x][1 + k]] = panel.flat[x] + s * out
        for k, w in enumerate(widths[x]):
            q = panel.flat[x] - (w + 0.25 * ROLL) * out
            facing.flat[rows[x][3 + k]] = q * [-1, 1]
    for a, b in own:
        for k in range(5):
            (roll_faces if k < 3 else facing_faces).append([rows[b][k], rows[a][k], rows[a][k + 1], rows[b][k + 1]])
    panel.faces = np.concatenate([panel.faces, roll_faces])
    facing.faces = np.array(facing_faces)
    facing.cut = facing.ids()
    return facing


def turn_hem(up):
    """Rows that turn the lowest row of a ring grid up[row][column] over, from the innermost to the edge, and how far each
    lies beyond the edge on the flat cloth.
    """
    normals = np.cross(np.roll(up, -1, axis=1) - np.roll(up, 1, axis=1), np.gradient(up, axis=0))[0]
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    for _ in range(5):                                  # a narrow fold may not twist the roll
        normals = np.roll(normals, 1, axis=0) + 2 * normals + np.roll(normals, -1, axis=0)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
    down = up[0] - up[1]
    down -= np.einsum("ij,ij->i", down, normals)[:, None] * normals
    down /= np.linalg.norm(down, axis=1)[:, None]
    arc = np.concatenate([np.zeros((1, up.shape[1])),
                          np.cumsum(np.linalg.norm(np.diff(up[:6], axis=0), axis=2), axis=0)])
    rows, beyond = [], []
    for w in HEM[::-1]:
        inside = np.array([[np.interp(w, arc[:, i], up[:6, i, c]) for c in range(3)] for i in range(up.shape[1])])
        rows.append(inside - 2 * ROLL * normals)
        beyond.append(np.pi * ROLL + w)
    for a in np.radians([180, 120, 55]):
        rows.append(up[0] + ROLL * np.sin(a) * down - ROLL * (1 - np.cos(a)) * normals)
        beyond.append(ROLL * a)
    return rows, np.array(beyond)


def over_shoulder(field, a, b, clearance, pieces):
    """A line over the shoulder from a in front to b at the back, off the form by the clearance, in even pieces."""
    centre = np.array([1.27, -0.012])
    angle = [(np.arctan2(p[1] - centre[0], p[2] - centre[1]) + 0.5 * np.pi) % (2 * np.pi) - 0.5 * np.pi for p in (a, b)]
    t = np.linspace(0, 1, 161)
    phi = angle[0] + (angle[1] - angle[0]) * t
    x = a[0] + (b[0] - a[0]) * t + np.sign(a[0]) * 0.004 * np.sin(np.pi * t) ** 2
    low, high = np.full(len(t), 0.02), np.full(len(t), 0.26)
    for _ in range(40):
        r = 0.5 * (low + high)
        inside = field.sample(np.stack([x, centre[0] + r * np.sin(phi), centre[1] + r * np.cos(phi)],
                                       axis=1))[0] < clearance
        low, high = np.where(inside, r, low), np.where(inside, high, r)
    line = np.stack([x, centre[0] + low * np.sin(phi), centre[1] + low * np.cos(phi)], axis=1)
    line[0], line[-1] = a, b
    for _ in range(8):
        line[1:-1] = (line[:-2] + 2 * line[1:-1] + line[2:]) / 4
    s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    want = np.linspace(0, s[-1], pieces + 1)
    return np.stack([np.interp(want, s, line[:, c]) for c in range(3)], axis=1)


# ---- output ---------------------------------------------------------------------------------------------------------

NOTE = "# {} made by samples/data/dress/{} of Tsuya (Apache-2.0).\n"


def write_garment(path, title, script, panels, position):
    """Each panel with vertices of its own; the patterns lie side by side, what is cut begins at v = 0."""
    x, base = 0.0, 0
    out = [NOTE.format(title, script), "# Metres, +Y up. UV: metres of cloth, u along the weft, v along the warp.\n"]
    for panel in panels:
        ids = panel.ids()
        flat = np.array([panel.flat[i] for i in ids])
        cut = np.array([panel.flat[i] for i in panel.cut])
        flat = flat - [flat[:, 0].min(), cut[:, 1].min()] + [x, 0]
        x = flat[:, 0].max() + 0.02
        local = {g: base + k + 1 for k, g in enumerate(ids)}
        out.append(f"g {panel.name}\n")
        out += ["v %.5f %.5f %.5f\n" % tuple(position[i]) for i in ids]
        out += ["vt %.5f %.5f\n" % tuple(q) for q in flat]
        out += ["f " + " ".join(f"{local[i]}/{local[i]}" for i in face) + "\n" for face in panel.faces]
        base += len(ids)
    save(path, out)


def write_form(path, b):
    out = [NOTE.format("Dress form", "make_dress.py")]
    out += ["v %.5f %.5f %.5f\n" % p for p in b.v] + ["vt %.4f %.4f\n" % q for q in b.vt]
    for name, faces in b.groups:
        out.append(f"g {name}\n")
        out += ["f " + " ".join(f"{i + 1}/{j + 1}" for i, j in zip(*face)) + "\n" for face in faces]
    save(path, out)


def save(path, lines):
    with open(path + ".part", "w", newline="\n") as f:
        f.writelines(lines)
    os.replace(path + ".part", path)
