"""Makes sakura.png, a print of cherry blossoms that tiles, border.png, a border for a hem, and
lace.png, where the holes of a lace are: white is thread.

    python3 make_prints.py [OUTDIR]

Needs Python alone. The pictures are the same bytes on every run.
"""
import math
import os
import random
import struct
import sys
import zlib

INDIGO, NIGHT = (0.055, 0.075, 0.21), (0.03, 0.035, 0.11)
PETAL, BLUSH, HEART = (0.93, 0.72, 0.76), (0.78, 0.22, 0.34), (0.86, 0.62, 0.18)
LEAF, TWIG, GOLD = (0.16, 0.33, 0.20), (0.30, 0.20, 0.14), (0.78, 0.58, 0.24)


class Picture:
    """Linear RGB; what leaves it at the sides comes in again, as at top and bottom if it tiles."""

    def __init__(self, width, height, colour, tiles=True):
        self.width, self.height, self.tiles = width, height, tiles
        self.rows = [[colour] * width for _ in range(height)]

    def draw(self, x, y, radius, shape):
        """shape(dx, dy) is None or a colour and the distance to its outline in pixels, inside below 0."""
        for j in range(math.floor(y - radius), math.ceil(y + radius) + 1):
            if not self.tiles and not 0 <= j < self.height:
                continue
            row = self.rows[j % self.height]
            for i in range(math.floor(x - radius), math.ceil(x + radius) + 1):
                drawn = shape(i + 0.5 - x, j + 0.5 - y)
                if drawn is None:
                    continue
                colour, distance = drawn
                cover = min(max(0.5 - distance, 0.0), 1.0)
                if cover > 0:
                    below = row[i % self.width]
                    row[i % self.width] = tuple(b + cover * (c - b) for b, c in zip(below, colour))

    def write(self, path):
        def code(v):
            v = min(max(v, 0.0), 1.0)
            return round(255 * (12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        rows = b"".join(b"\0" + bytes(code(v) for pixel in row for v in pixel) for row in self.rows)
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n"
                       + chunk(b"IHDR", struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0))
                       + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def mixed(a, b, share):
    share = min(max(share, 0.0), 1.0)
    return tuple(x + share * (y - x) for x, y in zip(a, b))


def blossom(size, turn):
    def shape(dx, dy):
        r, angle = math.hypot(dx, dy), math.atan2(dy, dx) + turn
        in_petal = (angle * 5 / (2 * math.pi)) % 1 - 0.5    # 0 in the middle of a petal
        notch = 0.13 * math.exp(-(in_petal / 0.09) ** 2)
        outline = size * (0.52 + 0.48 * math.cos(math.pi * in_petal) ** 0.7 - notch)
        if r < 0.13 * size:
            return HEART, r - 0.13 * size
        stamen = abs(((angle * 10 / (2 * math.pi)) % 1) - 0.5) * 2 * math.pi / 10 * r
        if 0.12 * size < r < 0.42 * size and stamen < 0.018 * size + 0.3:
            return mixed(BLUSH, HEART, (r / size - 0.3) / 0.1), -1
        edge = 1 - abs(in_petal) * 2
        colour = mixed(BLUSH, PETAL, (r / size - 0.12) / 0.42)
        return mixed(colour, BLUSH, 0.28 * (1 - edge) ** 6 * 2), r - outline

    return shape


def petal(size, turn):
    def shape(dx, dy):
        x, y = dx * math.cos(turn) + dy * math.sin(turn), dy * math.cos(turn) - dx * math.sin(turn)
        width = 0.45 * size * math.sin(math.pi * min(max(x / size + 0.5, 0), 1)) ** 0.8
        return mixed(PETAL, BLUSH, 0.2 + x / size), max(abs(y) - width, abs(x) - 0.5 * size)

    return shape


def leaf(size, turn):
    def shape(dx, dy):
        x, y = dx * math.cos(turn) + dy * math.sin(turn), dy * math.cos(turn) - dx * math.sin(turn)
        width = 0.2 * size * math.sin(math.pi * min(max(x / size + 0.5, 0), 1))
        vein = abs(y) < 0.5 + 0.006 * size
        return mixed(LEAF, GOLD, 0.6 if vein else 0.0), max(abs(y) - width, abs(x) - 0.5 * size)

    return shape


def twig(length, turn, bend):
    def shape(dx, dy):
        x, y = dx * math.cos(turn) + dy * math.sin(turn), dy * math.cos(turn) - dx * math.sin(turn)
        off = abs(y - bend * math.sin(math.pi * (x / length + 0.5)))
        return TWIG, max(off - 0.012 * length * (1.2 - x / length), abs(x) - 0.5 * length)

    return shape


def places(count, width, height, apart, random_):
    """Points that are apart also across the edges of a tile."""
    found = []
    for _ in range(20000):
        p = (random_.uniform(0, width), random_.uniform(0, height))
        if all(math.hypot(min(abs(p[0] - q[0]), width - abs(p[0] - q[0])),
                          min(abs(p[1] - q[1]), height - abs(p[1] - q[1]))) > apart for q in found):
            found.append(p)
        if len(found) == count:
            break
    return found


def sakura(side):
    random_ = random.Random(7)
    picture = Picture(side, side, INDIGO)
    centres = places(13, side, side, 0.2 * side, random_)
    for x, y in centres:
        turn = random_.uniform(0, 2 * math.pi)
        picture.draw(x, y, 0.13 * side, twig(0.24 * side, turn, random_.uniform(-0.03, 0.03) * side))
        for side_turn in (0.6, -0.7):
            away = 0.095 * side
            angle = turn + side_turn
            picture.draw(x + away * math.cos(angle), y + away * math.sin(angle), 0.05 * side,
                         leaf(0.085 * side, angle))
    for k, (x, y) in enumerate(centres):
        size = side * (0.078 if k % 3 else 0.098)
        picture.draw(x, y, 1.05 * size, blossom(size, random_.uniform(0, 2 * math.pi)))
    for x, y in places(30, side, side, 0.09 * side, random_):
        size = random_.uniform(0.02, 0.032) * side
        if all(math.hypot(min(abs(x - a), side - abs(x - a)), min(abs(y - b), side - abs(y - b))) > 0.115 * side
               for a, b in centres):
            picture.draw(x, y, size, petal(size, random_.uniform(0, 2 * math.pi)))
    return picture


def border(width, height):
    """Waves along the lower edge, in the manner of seigaiha, below a cord; the rest is plain."""
    picture = Picture(width, height, INDIGO, tiles=False)
    radius = width / 12
    for row in range(4, -1, -1):
        y = height - (row + 0.35) * radius / 2
        for k in range(-1, 7):
            x = (2 * k + 1 + row % 2) * radius

            def wave(dx, dy):
                r = math.hypot(dx, dy)
                ring = (r / radius * 4) % 1
                colour = mixed(NIGHT, GOLD, 1 if ring > 0.55 else 0)
                return colour, r - radius

            picture.draw(x, y, 1.02 * radius, wave)
    cord = height - 3.6 * radius
    for x in range(width):
        for dy in range(-4, 5):
            j = round(cord + 5 * math.sin(2 * math.pi * x / width * 6)) + dy
            if 0 <= j < height:
                picture.rows[j][x] = mixed(picture.rows[j][x], GOLD, 1 - (abs(dy) / 5) ** 2)
    return picture


def lace(side):
    """Flowers on a net of diamonds; tiles."""
    black, white = (0.0,) * 3, (1.0,) * 3
    picture = Picture(side, side, black)
    apart = side / 28

    def net(dx, dy):
        def to_line(v):
            return abs((v / apart + 0.5) % 1 - 0.5) * apart / math.sqrt(2)

        return white, min(to_line(dx + dy), to_line(dx - dy)) - 1.1

    picture.draw(side / 2, side / 2, side / 2 - 1, net)

    def flower(size, turn):
        def shape(dx, dy):
            r, angle = math.hypot(dx, dy), math.atan2(dy, dx) + turn
            in_petal = (angle * 6 / (2 * math.pi)) % 1 - 0.5
            outline = size * (0.55 + 0.45 * math.cos(math.pi * in_petal) ** 0.8)
            hole = max(0.1 * size - r, 0)
            vein = 0.5 + 0.5 * math.cos(10 * math.pi * r / size)
            cover = 0.55 + 0.45 * vein if abs(in_petal) < 0.34 else 1.0
            return (cover if hole <= 0 else 0.0,) * 3, r - outline

        return shape

    for k in range(9):
        x, y = (k % 3 + 0.5 * (k // 3 % 2)) * side / 3 + side / 6, (k // 3) * side / 3 + side / 6
        picture.draw(x, y, 0.12 * side, flower(0.11 * side, 0.4 * k))
    return picture


if __name__ == "__main__":
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    sakura(768).write(os.path.join(folder, "sakura.png"))
    border(768, 512).write(os.path.join(folder, "border.png"))
    lace(512).write(os.path.join(folder, "lace.png"))
