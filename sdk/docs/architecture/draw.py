#!/usr/bin/env python3
"""Draws data.svg and layers.svg of this folder: python3 sdk/docs/architecture/draw.py"""

from html import escape
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
FONT = "DejaVu Sans, Verdana, sans-serif"
FILL = {
    "values": "#dfe8f5", "reflectance": "#d9f0e3", "render": "#f9e2d2", "garment": "#efe0f3",
    "color": "#fdf3c8", "lab": "#e5e5e5", "samples": "#f4d6dd", "tests": "#ffffff",
    "file": "#ffffff",
}


class Drawing:
    def __init__(self, width, height):
        self.size = width, height
        self.parts = []

    def text(self, x, y, words, size=13, weight="normal", colour="#222", anchor="middle"):
        self.parts.append(
            f'<text x="{x}" y="{y}" font-size="{size}" font-weight="{weight}" fill="{colour}" '
            f'text-anchor="{anchor}">{escape(words)}</text>')

    def box(self, x, y, width, height, layer, title, *lines):
        self.parts.append(
            f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="6" '
            f'fill="{FILL[layer]}" stroke="#555"/>')
        top = y + height / 2 - 8 * len(lines) + 5
        self.text(x + width / 2, top, title, weight="bold")
        for i, line in enumerate(lines):
            self.text(x + width / 2, top + 17 * (i + 1), line, size=11.5, colour="#444")

    def arrow(self, *points):
        line = " ".join(f"{x},{y}" for x, y in points)
        self.parts.append(f'<polyline points="{line}" fill="none" stroke="#333" '
                          'stroke-width="1.4"/>')
        (x0, y0), (x, y) = points[-2:]
        length = ((x - x0) ** 2 + (y - y0) ** 2) ** 0.5
        dx, dy = (x - x0) / length, (y - y0) / length
        back_x, back_y = x - 9 * dx, y - 9 * dy
        self.parts.append(
            f'<polygon points="{x:.1f},{y:.1f} {back_x - 4 * dy:.1f},{back_y + 4 * dx:.1f} '
            f'{back_x + 4 * dy:.1f},{back_y - 4 * dx:.1f}" fill="#333"/>')

    def write(self, name):
        width, height = self.size
        (FOLDER / name).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" font-family="{FONT}">\n'
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>\n'
            + "\n".join(self.parts) + "\n</svg>\n")


def data():
    d = Drawing(1000, 560)
    # What is measured
    d.box(20, 20, 180, 60, "lab", "lab/rig, session", "lamp, axes, camera")
    d.box(20, 100, 180, 60, "lab", "lab/weave", "draft, yarns, filaments")
    d.box(230, 20, 170, 60, "lab", "lab/measure", "over a white standard")
    d.box(230, 100, 170, 60, "lab", "lab/goniometer", "photons in filaments")
    d.box(430, 60, 180, 60, "values", "ReflectanceTable", "TABLE.csv")
    d.box(640, 60, 150, 60, "reflectance", "Bard", "surface through views")
    d.box(820, 60, 160, 60, "reflectance", "Fabric", "specular part, colours")
    d.arrow((200, 50), (230, 50))
    d.arrow((200, 130), (230, 130))
    d.arrow((400, 50), (415, 50), (415, 80), (430, 80))
    d.arrow((400, 130), (415, 130), (415, 100), (430, 100))
    d.arrow((610, 90), (640, 90))
    d.arrow((790, 90), (820, 90))
    # What is worn
    d.box(20, 200, 180, 60, "file", "mesh file", "OBJ, glTF, PLY, OFF")
    d.box(230, 200, 170, 60, "garment", "garment/files, mesh", "PolygonMesh")
    d.box(430, 200, 180, 60, "garment", "garment/repair", "seams joined, findings")
    d.box(640, 200, 150, 60, "garment", "garment/limit", "limit surface, yarns")
    d.box(820, 200, 160, 60, "values", "Surface", "triangles, warp, weft")
    d.arrow((200, 230), (230, 230))
    d.arrow((400, 230), (430, 230))
    d.arrow((610, 230), (640, 230))
    d.arrow((790, 230), (820, 230))
    # What is rendered
    d.box(820, 320, 160, 70, "render", "Scene", "objects, lights, camera")
    d.box(640, 320, 150, 70, "render", "plan", "what can be left out")
    d.box(430, 320, 180, 70, "render", "render", "spectral path tracer")
    d.box(230, 320, 170, 70, "values", "SpectralImage", "transport, no lamp in it")
    d.box(20, 320, 180, 70, "color", "color: relight", "XYZ under any lamp")
    d.arrow((980, 90), (992, 90), (992, 340), (980, 340))
    d.arrow((900, 260), (900, 320))
    d.arrow((820, 355), (790, 355))
    d.arrow((640, 355), (610, 355))
    d.arrow((430, 355), (400, 355))
    d.arrow((230, 355), (200, 355))
    # What is seen
    d.box(20, 450, 180, 70, "color", "color: display", "PNG, sheets")
    d.box(230, 450, 170, 70, "color", "color: compare", "CIEDE2000 of lamps")
    d.box(430, 450, 180, 70, "color", "color: spectra", "lamps, dyes, observers")
    d.box(640, 450, 340, 70, "samples", "samples/scene, samples/tsuya",
          "scene files and the program: join all of this")
    d.arrow((110, 390), (110, 450))
    d.arrow((160, 390), (160, 420), (315, 420), (315, 450))
    d.arrow((520, 450), (520, 405), (60, 405), (60, 390))
    d.text(365, 400, "lamps", size=11, colour="#666")
    d.arrow((610, 485), (625, 485), (625, 290), (805, 290), (805, 110), (820, 110))
    d.text(710, 285, "dyes", size=11, colour="#666")
    d.text(500, 548, "Boxes are data or the layer that makes it; one colour is one layer.",
           size=11.5, colour="#555")
    d.write("data.svg")


def layers():
    d = Drawing(1000, 480)
    d.box(20, 20, 960, 44, "tests", "tests", "may include everything")
    d.box(20, 84, 960, 60, "samples", "samples/tsuya, samples/api",
          "the program: one file a command; short examples of the API")
    d.box(20, 164, 960, 60, "samples", "samples/scene",
          "scene files, the try-on job, the studio, plots")
    d.box(20, 244, 200, 60, "render", "sdk/render", "scene, plan, path tracer")
    d.box(20, 324, 200, 60, "reflectance", "sdk/reflectance", "views, models, fabrics")
    d.box(250, 324, 200, 60, "garment", "garment", "mesh, files, repair, limit")
    d.box(470, 324, 150, 60, "color", "color", "lamps, dyes, pictures")
    d.box(470, 244, 150, 60, "lab", "lab/weave", "drafts, yarns, filaments")
    d.box(634, 244, 124, 60, "lab", "lab/goniometer", "photons to a table")
    d.box(770, 244, 100, 60, "lab", "lab/measure", "to a table")
    d.box(884, 244, 96, 60, "lab", "lab/session", "by a plan")
    d.box(860, 324, 120, 60, "lab", "lab/rig", "lamp, shutter")
    d.box(20, 404, 960, 60, "values", "sdk/values",
          "errors, files, spectra, pictures, surfaces, cameras, reflectance tables")
    d.arrow((500, 84 + 60), (500, 164))
    d.arrow((500, 64), (500, 84))
    d.arrow((120, 224), (120, 244))
    d.arrow((120, 304), (120, 324))
    d.arrow((350, 224), (350, 324))
    d.arrow((545, 224), (545, 244))
    d.arrow((545, 304), (545, 324))
    d.arrow((696, 224), (696, 244))
    d.arrow((634, 274), (620, 274))
    d.arrow((680, 304), (680, 344), (620, 344))
    d.arrow((820, 224), (820, 244))
    d.arrow((800, 304), (800, 364), (620, 364))
    d.arrow((870, 274), (884, 274))
    d.arrow((932, 224), (932, 244))
    d.arrow((932, 304), (932, 324))
    d.arrow((730, 304), (730, 404))
    d.arrow((840, 304), (840, 404))
    for x in (120, 350, 545, 915):
        d.arrow((x, 384), (x, 404))
    d.write("layers.svg")


if __name__ == "__main__":
    data()
    layers()
