"""Checks dress.obj, slip.obj and dress_form.obj: counts, orientation, seams, stretch against the flat pattern, and that
the garments lie off the form. Usage: python3 check_dress.py [DIR]
"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from form import DistanceField, Figure  # noqa: E402

FAILURES = []


def expect(true, text):
    print(("ok    " if true else "WRONG ") + text)
    if not true:
        FAILURES.append(text)


def read(path):
    v, vt, groups = [], [], {}
    for line in open(path):
        word, *rest = line.split() or [""]
        if word == "v":
            v.append([float(x) for x in rest])
        elif word == "vt":
            vt.append([float(x) for x in rest])
        elif word == "g":
            faces = groups.setdefault(rest[0], [])
        elif word == "f":
            faces.append([tuple(int(k) - 1 for k in corner.split("/")) for corner in rest])
    return np.array(v), np.array(vt), groups


def edges_of(faces):
    count = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            count.setdefault((min(a, b), max(a, b)), []).append(a < b)
    return count


def check_garment(path, free_borders, least, most, field):
    v, vt, groups = read(path)
    faces = [f for g in groups.values() for f in g]
    quads = np.array([[c[0] for c in f] for f in faces])
    uv = vt[np.array([[c[1] for c in f] for f in faces])]
    p = v[quads]
    print(f"\n{os.path.basename(path)}: {os.path.getsize(path) / 1e6:.2f} MB")
    print("panels:", ", ".join(f"{n} {len(f)}" for n, f in groups.items()))
    print("box", v.min(axis=0), v.max(axis=0))
    expect(10000 <= len(faces) <= 20000, f"{len(faces)} quads, {len(v)} vertices")

    d, e = uv[:, 2] - uv[:, 0], uv[:, 3] - uv[:, 1]
    area = 0.5 * (d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])
    expect((area > 1e-7).all(), f"UV area of every face is positive, smallest {area.min() * 1e6:.2f} mm2")
    size = 0.5 * np.linalg.norm(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]), axis=1)
    expect((size > 1e-7).all(), f"area of the faces: {size.min() * 1e6:.2f} to {size.max() * 1e6:.1f} mm2")

    _, weld = np.unique(np.round(v * 1e5).astype(np.int64), axis=0, return_inverse=True)
    welded = edges_of([list(f) for f in weld.reshape(-1)[quads].tolist()])
    expect(all(len(x) <= 2 for x in welded.values()), "no edge with more than two faces after welding")
    expect(all(len(x) < 2 or x[0] != x[1] for x in welded.values()), "all faces of one orientation")
    loops, closed = borders(welded)
    expect(loops == free_borders and closed, f"{loops} free borders")
    check_stretch(p, uv, area, least, most)
    distance = field.sample(v)[0]
    expect(distance.min() > 2e-4, f"nearest to the form: {1e3 * distance.min():.2f} mm")


def borders(welded):
    """How many free borders, and whether each is a simple loop."""
    ends = {}
    for a, b in (k for k, x in welded.items() if len(x) == 1):
        ends.setdefault(a, []).append(b)
        ends.setdefault(b, []).append(a)
    loops, seen = 0, set()
    for a in ends:
        if a in seen:
            continue
        loops += 1
        todo = [a]
        while todo:
            k = todo.pop()
            if k not in seen:
                seen.add(k)
                todo += ends[k]
    return loops, all(len(x) == 2 for x in ends.values())


def check_stretch(p, uv, area, least, most):
    """Length of dP/du and dP/dv at the middle of each face, weighted by the cloth."""
    a, b = 0.5 * (uv[:, 1] + uv[:, 2] - uv[:, 0] - uv[:, 3]), 0.5 * (uv[:, 2] + uv[:, 3] - uv[:, 0] - uv[:, 1])
    pa, pb = 0.5 * (p[:, 1] + p[:, 2] - p[:, 0] - p[:, 3]), 0.5 * (p[:, 2] + p[:, 3] - p[:, 0] - p[:, 1])
    det = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])[:, None]
    weft = np.linalg.norm((pa * b[:, 1:] - pb * a[:, 1:]) / det, axis=1)
    warp = np.linalg.norm((pb * a[:, :1] - pa * b[:, :1]) / det, axis=1)
    for name, s in (("weft", weft), ("warp", warp)):
        order = np.argsort(s)
        share = np.cumsum(area[order]) / area.sum()
        low, middle, high = (s[order][np.searchsorted(share, q)] for q in (0.025, 0.5, 0.975))
        expect(0.95 <= middle <= 1.05 and low >= least and high <= most,
               f"stretch along the {name}: 2.5 % {low:.3f}, median {middle:.3f}, 97.5 % {high:.3f}, "
               f"all {s.min():.2f} to {s.max():.2f}")


def check_form(path):
    print(f"\n{os.path.basename(path)}: {os.path.getsize(path) / 1e6:.2f} MB")
    v, vt, parts = read(path)
    for name, part in parts.items():
        count = edges_of([[c[0] for c in f] for f in part])
        q = np.array([[c[0] for c in f] for f in part])
        volume = sum(np.einsum("ij,ij->i", v[q[:, 0]], np.cross(v[q[:, i]], v[q[:, i + 1]])).sum() for i in (1, 2)) / 6
        t = vt[np.array([[c[1] for c in f] for f in part])]
        d, e = t[:, 2] - t[:, 0], t[:, 3] - t[:, 1]
        turned = ((d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]) <= 0).sum()
        expect(all(len(x) == 2 and x[0] != x[1] for x in count.values()) and volume > 0 and turned == 0,
               f"{name}: closed, {len(part)} quads, {volume * 1e3:.2f} litres, {turned} mirrored UV faces")


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    field = DistanceField(Figure())
    check_garment(os.path.join(folder, "dress.obj"), 4, 0.5, 1.2, field)     # hem, two armholes, neckline; pressed in narrow folds
    check_garment(os.path.join(folder, "slip.obj"), 2, 0.85, 1.4, field)     # hem, upper edge; drawn long on the bias
    check_form(os.path.join(folder, "dress_form.obj"))
    sys.exit(1 if FAILURES else 0)


main()
