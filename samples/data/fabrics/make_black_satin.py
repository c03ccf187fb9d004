#!/usr/bin/env python3
"""Makes black_satin.csv: a synthetic black satin under light from straight above.

Two yarn systems, each with a microfacet distribution (anisotropic GGX) in the cloth's frame: the warp
floats of a warp-faced five-end satin cover four fifths, their facets tilt widely across the yarn (along
the weft) and little along it; the weft bindings cover one fifth, with the axes exchanged. Fresnel of a
dielectric of index 1.60 (a drawn polyester filament, between its two axes) and Smith masking. One quadrant at 5 degrees, no noise.
"""
import math
import sys

INDEX = 1.60
SYSTEMS = [  # cover, roughness along the weft, roughness along the warp
    (0.8, 0.45, 0.05),
    (0.2, 0.09, 0.38),
]


def fresnel(cosine):
    g = math.sqrt(INDEX**2 - 1 + cosine**2)
    a = (g - cosine) / (g + cosine)
    b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1)
    return 0.5 * a * a * (1 + b * b)


def ggx(h, ax, ay):
    q = (h[0] / ax) ** 2 + (h[1] / ay) ** 2 + h[2] ** 2
    return 1 / (math.pi * ax * ay * q * q)


def smith(v, ax, ay):
    """Lambda of Smith's masking for GGX."""
    t2 = ((v[0] * ax) ** 2 + (v[1] * ay) ** 2) / v[2] ** 2
    return 0.5 * (math.sqrt(1 + t2) - 1)


def rho0(theta, phi):
    v = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
    n = math.sqrt(2 + 2 * v[2])
    h = (v[0] / n, v[1] / n, (v[2] + 1) / n)
    total = 0
    for cover, ax, ay in SYSTEMS:
        masking = 1 / (1 + smith(v, ax, ay))
        total += cover * ggx(h, ax, ay) * fresnel(h[2]) * masking / (4 * v[2])
    return total


def main():
    out = open(sys.argv[1], "w") if len(sys.argv) > 1 else sys.stdout
    out.write("# instrument: none, computed by make_black_satin.py\n")
    out.write("# material: black polyester satin, warp-faced, five ends\n")
    out.write("# provenance: synthetic; two anisotropic GGX yarn systems (cover, alpha weft, alpha warp) "
              + "; ".join("%g, %g, %g" % s for s in SYSTEMS)
              + "; dielectric Fresnel n = %g; Smith masking; no noise\n" % INDEX)
    out.write("# symmetry: orthotropic\n")
    out.write("theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n")
    for theta in range(0, 90, 5):
        for phi in range(0, 95, 5):
            out.write("0,0,%d,%d,%.6g\n" % (theta, phi, rho0(math.radians(theta), math.radians(phi))))


main()
