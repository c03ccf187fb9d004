"""Checks dress.obj: counts, orientation, seams, stretch against the flat pattern. Usage: python3 check_dress.py [DIR]"""
import os
import sys

import numpy as np


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


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    failures = []

    def expect(true, text):
        print(("ok    " if true else "WRONG ") + text)
        if not true:
            failures.append(text)

    v, vt, groups = read(os.path.join(folder, "dress.obj"))
    faces = [f for g in groups.values() for f in g]
    quads = np.array([[c[0] for c in f] for f in faces])
    uv = vt[np.array([[c[1] for c in f] for f in faces])]
    p = v[quads]
    print("panels:", ", ".join(f"{n} {len(f)}" for n, f in groups.items()))
    print("box", v.min(axis=0), v.max(axis=0))
    expect(3000 <= len(faces) <= 12000, f"{len(faces)} quads, {len(v)} vertices")

    d, e = uv[:, 2] - uv[:, 0], uv[:, 3] - uv[:, 1]
    area = 0.5 * (d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])
    expect((area > 1e-6).all(), f"UV area of every face is positive, smallest {area.min() * 1e6:.1f} mm2")
    size = 0.5 * np.linalg.norm(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]), axis=1)
    expect((size > 1e-6).all(), f"area of the faces: {size.min() * 1e6:.1f} to {size.max() * 1e6:.1f} mm2")

    _, weld = np.unique(np.round(v * 1e5).astype(np.int64), axis=0, return_inverse=True)
    welded = edges_of([list(f) for f in weld.reshape(-1)[quads].tolist()])
    open_panels = sum(len(x) == 1 for g in groups.values() for x in edges_of([[c[0] for c in f] for f in g]).values())
    border = sum(len(x) == 1 for x in welded.values())
    expect(all(len(x) <= 2 for x in welded.values()), "no edge with more than two faces after welding")
    expect(all(len(x) < 2 or x[0] != x[1] for x in welded.values()), "all faces of one orientation")
    print(f"seam edges {(open_panels - border) // 2}, free edges {border}, welded vertices {weld.max() + 1}")
    ends = {}
    for a, b in (k for k, x in welded.items() if len(x) == 1):
        ends.setdefault(a, []).append(b)
        ends.setdefault(b, []).append(a)
    loops, seen = 0, set()
    for a in ends:
        if a not in seen:
            loops += 1
            todo = [a]
            while todo:
                k = todo.pop()
                if k not in seen:
                    seen.add(k)
                    todo += ends[k]
    # Hem, two armholes, neckline.
    expect(loops == 4 and all(len(x) == 2 for x in ends.values()), f"{loops} free borders")

    # Stretch: length of dP/du and dP/dv at the middle of each face.
    a, b = 0.5 * (uv[:, 1] + uv[:, 2] - uv[:, 0] - uv[:, 3]), 0.5 * (uv[:, 2] + uv[:, 3] - uv[:, 0] - uv[:, 1])
    pa, pb = 0.5 * (p[:, 1] + p[:, 2] - p[:, 0] - p[:, 3]), 0.5 * (p[:, 2] + p[:, 3] - p[:, 0] - p[:, 1])
    det = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])[:, None]
    weft = np.linalg.norm((pa * b[:, 1:] - pb * a[:, 1:]) / det, axis=1)
    warp = np.linalg.norm((pb * a[:, :1] - pa * b[:, :1]) / det, axis=1)
    for name, s in (("weft", weft), ("warp", warp)):
        low, middle, high = np.percentile(s, [2.5, 50, 97.5])
        expect(0.97 <= middle <= 1.05 and low >= 0.85 and high <= 1.2,
               f"stretch along the {name}: 2.5 % {low:.3f}, median {middle:.3f}, 97.5 % {high:.3f}, "
               f"all {s.min():.2f} to {s.max():.2f}")

    for name in ("dress.obj", "mannequin.obj"):
        print(f"{name}: {os.path.getsize(os.path.join(folder, name)) / 1e6:.2f} MB")
    m, mt, parts = read(os.path.join(folder, "mannequin.obj"))
    for name, part in parts.items():
        count = edges_of([[c[0] for c in f] for f in part])
        q = np.array([[c[0] for c in f] for f in part])
        volume = sum(np.einsum("ij,ij->i", m[q[:, 0]], np.cross(m[q[:, i]], m[q[:, i + 1]])).sum() for i in (1, 2)) / 6
        t = mt[np.array([[c[1] for c in f] for f in part])]
        d, e = t[:, 2] - t[:, 0], t[:, 3] - t[:, 1]
        turned = ((d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]) <= 0).sum()
        expect(all(len(x) == 2 and x[0] != x[1] for x in count.values()) and volume > 0 and turned == 0,
               f"{name}: closed, {len(part)} quads, {volume * 1e3:.2f} litres, {turned} mirrored UV faces")
    sys.exit(1 if failures else 0)


main()
