"""The skirt of bench/skirt.cpp: as an OBJ and a scene file for Tsuya, and as lists for Blender."""
import math
import os

AROUND, DOWN = 500, 100
EYE, TARGET, ANGLE = (0, 1.0, 2.6), (0, 0.4, 0), 0.5
LIGHT_MIDDLE = (2 * math.sin(-0.5), 1.6, 2 * math.cos(-0.5))
LIGHT_SIDE, LIGHT_RADIANCE, SKY_RADIANCE = 0.3, 100.0, 0.3
DYE, PLANE, ALPHA_WEFT, ALPHA_WARP = 0.4, 0.5, 0.05, 0.6


def points():
    for j in range(DOWN + 1):
        for i in range(AROUND):
            angle, drop = 2 * math.pi * i / AROUND, j / DOWN
            radius = (0.15 + 0.35 * drop) * (1 + 0.12 * drop * math.cos(24 * angle))
            yield radius * math.sin(angle), 0.8 - 0.75 * drop, radius * math.cos(angle)


def faces():
    """Corners of each quad, with the places of its corners in the pattern: u around, v up."""
    for j in range(DOWN):
        for i in range(AROUND):
            a, b = j * AROUND + i, j * AROUND + (i + 1) % AROUND
            yield ((a, i, j), (a + AROUND, i, j + 1), (b + AROUND, i + 1, j + 1), (b, i + 1, j))


def uv(i, j):
    return 2.2 * i / AROUND, 0.8 * (1 - j / DOWN)


def write(folder, full, size):
    """Files for Tsuya. Returns the scene file."""
    with open(os.path.join(folder, "skirt.obj"), "w") as out:
        for p in points():
            out.write("v %.7f %.7f %.7f\n" % p)
        for j in range(DOWN + 1):
            for i in range(AROUND + 1):
                out.write("vt %.7f %.7f\n" % uv(i, j))
        for face in faces():
            out.write("f " + " ".join(f"{p + 1}/{j * (AROUND + 1) + i + 1}" for p, i, j in face) + "\n")
    with open(os.path.join(folder, "plane.obj"), "w") as out:
        out.write("v -3 0 3\nv 3 0 3\nv 3 0 -3\nv -3 0 -3\nf 1 2 3 4\n")
    with open(os.path.join(folder, "ggx.fabric.toml"), "w") as out:
        out.write('schema = "tsuya-fabric 1"\nname = "ggx"\nmodel = "ggx"\n[dye]\nconstant = %g\n'
                  "[ggx]\nalpha_weft = %g\nalpha_warp = %g\nf0 = 0.04\n" % (DYE, ALPHA_WEFT, ALPHA_WARP))
    path = os.path.join(folder, "full.scene.toml" if full else "direct.scene.toml")
    with open(path, "w") as out:
        out.write(f"""[camera]
width = {size}
height = {size}
eye = {list(EYE)}
target = {list(TARGET)}
vertical_angle_deg = {math.degrees(ANGLE)}
[fabrics.ggx]
file = "ggx.fabric.toml"
[fabrics.plane]
reflectance = {PLANE}
[garments.skirt]
mesh = "skirt.obj"
fabric = "ggx"
level = 0
[bodies.plane]
mesh = "plane.obj"
unit = "m"
fabric = "plane"
level = 0
fold_crease = 9
[lights.key]
centre = {list(LIGHT_MIDDLE)}
target = {list(TARGET)}
width = {LIGHT_SIDE}
height = {LIGHT_SIDE}
radiance = {LIGHT_RADIANCE}
[render]
channels = 8
max_bounces = {3 if full else 0}
widen_after_diffuse = false
""")
        if full:
            out.write(f"[environment]\nradiance = {SKY_RADIANCE}\ngroup = \"fill\"\n")
    return path
