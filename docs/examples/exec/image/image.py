"""Judges a rasterizer that gives only 8-bit images and knows nothing of triangles or pixels.

Leave this file as it is, except for the contract; rasterizer.py is yours.

Each draw becomes several images. In the first one a triangle's colour is its number, the same at
all three vertices, so each pixel says which triangle is seen. Every further image shows three
attributes as red, green and blue, from 0 at one end of the attribute's range over the triangle to 1
at the other end. A byte B then stands for the value that is B/255 of the way.

A byte is off by half a step or more: errors of a value below 1/510 of its range cannot be seen.
Depth does not show in a colour. It is computed here from the triangle that is seen, so that
RasterCheck can tell whether a nearer one should be; the number itself judges nothing.
"""

from draws import Answer, Unsupported, serve
from rasterizer import draw_image

# How far a byte may be off, in steps of 1/255: half a step if colours are rounded to the nearest
# byte, and 1/64 for the rasterizer's own rounding. 1 if it cuts off digits, as int(255 * c) does.
STEPS = 0.5 + 1 / 64

MOST_PIXELS = 2048  # from the window's origin; more is not asked for
MOST_W = 2.0**60  # and as much in 1/w

# What is promised: any way to round window positions to 1/256 pixel, any rule for samples on edges.
# Say more if you know more, and errors that are now permitted are found.
CONTRACT = {
    "format": "rastercheck-contract",
    "version": 1,
    "coverage": {"subpixel_bits": 8, "rounding": "unspecified", "position_error": 0.125},
    "clip_tolerance": 1,
    "tie_rule": "unspecified",
    "basis": "unspecified",
    "keeps_constants": True,
    "depth_format": "unorm16",  # your depth buffer, if it is no worse
    "bounds": {
        # Rounded up to a multiple of 2^-20, which is a float32 for sure.
        "smooth": {
            "constant": 1,
            "per_horizon": 4,
            "per_condition": 4,
            "range_share": (int(STEPS / 255 * 2**20) + 1) / 2**20,
        },
        "depth": {"constant": 1},  # of the numbers computed here
    },
}
LACKS = (
    "nonpositive_w depth_clipping clip_distances depth_clamp depth_range depth_clear viewport "
    "viewport_fractions scissor culling noperspective flat center centroid"
)

# Colours hold 7 bits of a number in each channel, as the odd byte 2 k + 1, which comes back as k
# even if it is off by one step downwards.
NUMBER_BITS = 7


def window(draw, vertex):
    """x and y in pixels, z/w."""
    x, y, z, w = draw.positions[vertex]
    return (x / w + 1) / 2 * draw.width, (y / w + 1) / 2 * draw.height, z / w


def check(draw):
    """Refuses vertices that are farther away than is asked for."""
    for vertices in draw.triangles:
        for vertex in vertices:
            x, y, _ = window(draw, vertex)
            w = draw.positions[vertex][3]
            if max(abs(x), abs(y)) > MOST_PIXELS or not 1 / MOST_W <= w <= MOST_W:
                raise Unsupported("a vertex too far away")


def with_colors(draw, color_of):
    """The triangles, with the colours color_of(triangle, corner)."""
    return [
        [(draw.positions[vertex], color_of(t, i)) for i, vertex in enumerate(vertices)]
        for t, vertices in enumerate(draw.triangles)
    ]


def number_color(number):
    digits = [number >> (NUMBER_BITS * channel) & (2**NUMBER_BITS - 1) for channel in range(3)]
    return tuple((2 * digit + 1) / 255 for digit in digits)


def number_in(pixel):
    """The number in a pixel's colour, 0 for the background."""
    return sum((byte >> 1) << (NUMBER_BITS * channel) for channel, byte in enumerate(pixel))


def ends_of(draw, triangle, attribute):
    """The ends of an attribute's range over a triangle. The first one, shown as 0, is the value of
    the first vertex at an end, so that negative values behave as positive ones."""
    values = [draw.values[vertex][attribute] for vertex in draw.triangles[triangle]]
    first = values[0] if values[0] in (min(values), max(values)) else values[1]
    return first, max(values) if first == min(values) else min(values)


def attribute_color(draw, triangle, corner, first):
    shares = [0.0, 0.0, 0.0]
    for a in range(first, min(first + 3, draw.attribute_count)):
        begin, end = ends_of(draw, triangle, a)
        value = draw.values[draw.triangles[triangle][corner]][a]
        shares[a - first] = 0.0 if begin == end else (value - begin) / (end - begin)
    return tuple(shares)


def depth_at(draw, triangle, x, y):
    """Depth at a pixel's centre, from corners rounded to the grid: these have an area where the
    unrounded ones may have none."""
    corners = [window(draw, vertex) for vertex in draw.triangles[triangle]]
    rounded = [(round(x * 256) / 256, round(y * 256) / 256, z) for x, y, z in corners]
    for (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) in (rounded, corners):
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if area != 0:
            u, v = x + 0.5 - x0, y + 0.5 - y0
            s1 = (u * (y2 - y0) - v * (x2 - x0)) / area
            s2 = (v * (x1 - x0) - u * (y1 - y0)) / area
            return z0 + (z1 - z0) * s1 + (z2 - z0) * s2
    return corners[0][2]


def seen_triangles(draw):
    """Which triangle is seen at each pixel (x, y) that is covered."""
    count = len(draw.triangles)
    if count >= 2 ** (3 * NUMBER_BITS):
        raise Unsupported("too many triangles")
    image = draw_image(with_colors(draw, lambda t, _: number_color(t + 1)), draw.width, draw.height)
    seen = {}
    for at in range(draw.width * draw.height):
        pixel = image[4 * at : 4 * at + 3]
        place, number = (at % draw.width, at // draw.width), number_in(pixel)
        if number > count:
            raise ValueError(
                f"pixel {place} has the colour {list(pixel)}, which no triangle has: colours must "
                "not be blended, filtered or converted"
            )
        if number > 0:
            seen[place] = number - 1
    return seen


def draw_all(draw):
    check(draw)
    seen = seen_triangles(draw)
    values = {place: [] for place in seen}
    for first in range(0, draw.attribute_count, 3):
        triangles = with_colors(draw, lambda t, i: attribute_color(draw, t, i, first))
        image = draw_image(triangles, draw.width, draw.height)
        for (x, y), triangle in seen.items():
            for a in range(first, min(first + 3, draw.attribute_count)):
                begin, end = ends_of(draw, triangle, a)
                share = image[4 * (y * draw.width + x) + a - first] / 255
                values[x, y].append(begin + (end - begin) * share if share > 0 else begin)
    if not seen:
        return Answer(draw, 0, 0, 0, 0)
    xs, ys = [x for x, _ in seen], [y for _, y in seen]
    answer = Answer(draw, min(xs), min(ys), max(xs) + 1, max(ys) + 1)
    for (x, y), triangle in seen.items():
        answer.put(x, y, 0, triangle, depth_at(draw, triangle, x, y), values[x, y])
    return answer


if __name__ == "__main__":
    serve(
        draw_all,
        name="image",
        version="1.0",
        contract=CONTRACT,
        limits={"rules": ["vulkan"], "sample_counts": [1], "lacks": LACKS.split(), "max_size": 64},
    )
