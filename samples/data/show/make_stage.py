"""Makes stage.obj: a catwalk before a wall with a gate, the truss above it, and two rows of guests on each side.

    python3 make_stage.py [OUTDIR]

Needs Python alone; the same bytes on every run. Metres, +Y up, floor at y = 0, the catwalk's top at y = 0.4 along z,
its end towards +Z. One group (`g`) for each thing that has a fabric of its own.
"""
import math
import os
import random
import sys

HALF_WIDTH, TOP, BEGIN, END = 1.1, 0.4, -5.5, 6.0   # of the catwalk
WALL, GATE, GATE_HEIGHT = -5.6, 1.25, 3.0           # the wall's front, half the gate's width, its height
FINS = [1.75, 2.45, 3.15, 3.85, 4.55]               # |x| of the fins on the wall
TRUSS = [(-3.0, 4.3), (1.5, 4.5), (5.5, 4.7)]       # z and height of each beam
LAMPS = [-1.8, -0.6, 0.6, 1.8]                      # x of the lamps on each beam
SEATS = [(1.75, 0.0), (2.45, 0.18)]                 # |x| of each row, and how much higher it stands


class Mesh:
    def __init__(self):
        self.points, self.faces = [], {}

    def add(self, group, points, faces):
        first = len(self.points)
        self.points += points
        self.faces.setdefault(group, []).extend([tuple(first + i for i in face) for face in faces])

    def box(self, group, low, high):
        """Each side has corners of its own: its edges stay sharp."""
        points = [(x, y, z) for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]
        for side in (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5):
            self.add(group, [points[i] for i in side], [(0, 1, 2, 3)])

    def turned(self, group, profile, sides, place):
        """A surface of revolution: rows of (radius, height) from below, round in x and z; place(x, y, z) puts it."""
        rows = [[place(r * math.sin(2 * math.pi * i / sides), y, r * math.cos(2 * math.pi * i / sides))
                 for i in range(sides)] for r, y in profile]
        faces = [(j * sides + i, j * sides + (i + 1) % sides, (j + 1) * sides + (i + 1) % sides, (j + 1) * sides + i)
                 for j in range(len(rows) - 1) for i in range(sides)]
        ends = [tuple(reversed(range(sides))), tuple(range((len(rows) - 1) * sides, len(rows) * sides))]
        self.add(group, [p for row in rows for p in row], faces + ends)

    def write(self, path):
        with open(path, "w") as out:
            out.write("# A stage made by samples/data/show/make_stage.py of Tsuya (Apache-2.0).\n")
            for x, y, z in self.points:
                out.write(f"v {x:.4f} {y:.4f} {z:.4f}\n")
            for group, faces in self.faces.items():
                out.write(f"g {group}\n")
                for face in faces:
                    out.write("f " + " ".join(str(i + 1) for i in face) + "\n")


def build():
    mesh = Mesh()
    mesh.box("floor", (-9, -0.2, -7), (9, 0, 11.5))
    mesh.box("catwalk", (-HALF_WIDTH, 0.001, BEGIN), (HALF_WIDTH, TOP, END))
    for side in (-1, 1):
        x0, x1 = sorted((side * GATE, side * 7))
        mesh.box("wall", (x0, 0.001, WALL - 0.2), (x1, 5.2, WALL))
        for x in FINS:
            mesh.box("fins", (side * x - 0.05, 0.002, WALL + 0.001), (side * x + 0.05, 5.0, WALL + 0.35))
    mesh.box("wall", (-GATE + 0.001, GATE_HEIGHT, WALL - 0.2), (GATE - 0.001, 5.2, WALL))
    for z, height in TRUSS:
        for dy, dz in ((0, -0.12), (0, 0.12), (0.2, 0)):
            mesh.box("truss", (-4, height + dy, z + dz - 0.02), (4, height + dy + 0.04, z + dz + 0.02))
        for x in LAMPS:
            # A can whose mouth looks down to the middle of the catwalk
            lean = math.atan2(x, height - 1.5)
            mesh.turned("lamps", [(0.05, 0.2), (0.1, 0.14), (0.1, -0.16), (0.085, -0.16), (0.085, -0.1)][::-1], 24,
                        lambda px, py, pz, x=x, lean=lean, height=height, z=z:
                        (x + px * math.cos(lean) + py * math.sin(lean), height - 0.25 - px * math.sin(lean)
                         + py * math.cos(lean), z + pz))
    guests(mesh)
    return mesh


def guests(mesh):
    chance = random.Random(7)
    torso = [(0.15, 0.40), (0.19, 0.46), (0.17, 0.62), (0.19, 0.80), (0.20, 0.93), (0.14, 1.01), (0.065, 1.05),
             (0.055, 1.10)]
    head = [(0.035, 1.08), (0.07, 1.12), (0.085, 1.18), (0.088, 1.24), (0.075, 1.30), (0.045, 1.335)]
    lap = [(0.085, 0.0), (0.09, 0.2), (0.08, 0.42)]
    for side in (-1, 1):
        for x, up in SEATS:
            mesh.box("benches", (side * x - 0.2, up + 0.001, BEGIN + 1), (side * x + 0.2, up + 0.4, END - 0.4))
            z = BEGIN + 1.3 + chance.uniform(0, 0.2)
            while z < END - 0.6:
                turn = side * -math.pi / 2 + chance.uniform(-0.5, 0.5)   # towards the catwalk
                scale, sway = chance.uniform(0.92, 1.06), chance.uniform(-0.03, 0.05)

                def place(px, py, pz, depth=1.0, z=z, turn=turn, scale=scale, sway=sway, up=up, x=x):
                    y = up + 0.4 + (py - 0.4) * scale
                    pz = pz * depth + sway * (py - 0.4)
                    return (side * x + px * math.cos(turn) + pz * math.sin(turn), y,
                            z - px * math.sin(turn) + pz * math.cos(turn))
                mesh.turned("guests", torso, 16, lambda a, b, c: place(a, b, c, 0.62))
                mesh.turned("heads", head, 14, lambda a, b, c: place(a, b, c + 0.012, 1.15))
                for leg in (-0.09, 0.09):
                    mesh.turned("guests", lap, 8, lambda a, b, c, leg=leg: place(a + leg, 0.46 + c * 0.9, b + 0.02))
                z += chance.uniform(0.52, 0.68)


if __name__ == "__main__":
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    build().write(os.path.join(folder, "stage.obj"))
