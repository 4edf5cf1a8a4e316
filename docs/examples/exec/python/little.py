"""A little rasterizer in Python, for `rastercheck run --backend 'exec:python3 little.py'`.

It is docs/examples/plugin/little.c in Python: window positions are snapped to a grid of 1/256
pixel, edges are then exact integers, and values are computed from the same integers in double. The
comments there derive the bounds that its contract promises; float is double here as well.
"""

import math
import struct

from draws import Answer, Unsupported, serve

GRID = 256  # points per pixel and axis
GUARD_BAND = 32768.0  # pixels
MOST_DEPTH = 65536.0  # of z/w at vertices

CONTRACT = {
    "format": "rastercheck-contract",
    "version": 1,
    "coverage": {"subpixel_bits": 8, "rounding": "nearest_even", "position_error": 2**-27},
    "clip_tolerance": 1,
    "basis": "snapped",
    "keeps_constants": True,
    "keeps_equal_depth": True,
    "bounds": {
        "smooth": {"constant": 0.5 + 2**-24},
        "noperspective": {"constant": 0.5 + 2**-24},
        "depth": {"constant": 0.5 + 2**-9},
    },
}


def float32(number):
    """Rounds to float32, as storing an answer does."""
    return struct.unpack("f", struct.pack("f", number))[0]


class Triangle:
    """Edge i, opposite vertex i, is a u + b v + c in grid units: positive inside, 0 on the edge."""

    def __init__(self, draw, vertices):
        width, height = draw.viewport_width, draw.viewport_height
        half_height = -height / 2 if draw.rules == "d3d" else height / 2
        self.vertices = vertices
        self.z, self.w, self.x, self.y = [], [], [], []
        for vertex in vertices:
            x, y, z, w = draw.positions[vertex]
            u = x / w * (width / 2) + (draw.viewport_x + width / 2)
            v = y / w * half_height + (draw.viewport_y + height / 2)
            if not (abs(u) <= GUARD_BAND and abs(v) <= GUARD_BAND and abs(z / w) <= MOST_DEPTH):
                raise Unsupported("a vertex beyond the guard band, or z/w beyond 65536")
            self.x.append(round(u * GRID))  # to nearest even
            self.y.append(round(v * GRID))
            self.z.append(z)
            self.w.append(w)
        self.edges = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            a, b = self.y[j] - self.y[k], self.x[k] - self.x[j]
            self.edges.append((a, b, -(a * self.x[j] + b * self.y[j])))

    def area(self):
        return self.at(self.x[0], self.y[0])[0]

    def turn(self):
        self.edges = [(-a, -b, -c) for a, b, c in self.edges]

    def at(self, u, v):
        return [a * u + b * v + c for a, b, c in self.edges]


def is_shown(draw, triangle):
    """Makes edges positive inside; false if the triangle has no area or is culled."""
    area = triangle.area()
    is_ccw = (area > 0) == (draw.rules == "opengl")
    is_front = is_ccw == (draw.front_face == "ccw")
    if area < 0:
        triangle.turn()
    return area != 0 and draw.cull != ("front" if is_front else "back")


def owns_zero(draw, a, b):
    """Whether a sample at which a functional with this gradient is 0 is inside."""
    is_y_down = draw.rules != "opengl"
    is_top = b > 0 if (draw.tie_rule == "top_left") == is_y_down else b < 0
    return a > 0 or (a == 0 and is_top)


def is_cut(draw, triangle, heights, weights, is_distance):
    total = sum(h * weight for h, weight in zip(heights, weights))
    if total != 0 or not is_distance or draw.rules == "d3d":
        return total < 0
    a = sum(h * (edge[0] / w) for h, edge, w in zip(heights, triangle.edges, triangle.w))
    b = sum(h * (edge[1] / w) for h, edge, w in zip(heights, triangle.edges, triangle.w))
    return not (a == 0 and b == 0) and not owns_zero(draw, a, b)


def is_between(u, begin, size):
    return min(begin, begin + size) <= u / GRID < max(begin, begin + size)


def covers(draw, triangle, u, v):
    edges = triangle.at(u, v)
    for edge, (a, b, _) in zip(edges, triangle.edges):
        if edge < 0 or (edge == 0 and not owns_zero(draw, a, b)):
            return False
    if not is_between(u, draw.viewport_x, draw.viewport_width):
        return False
    if not is_between(v, draw.viewport_y, draw.viewport_height):
        return False
    weights = [edge / w for edge, w in zip(edges, triangle.w)]
    if not draw.depth_clamp:
        near = [z + w if draw.rules == "opengl" else z for z, w in zip(triangle.z, triangle.w)]
        far = [w - z for z, w in zip(triangle.z, triangle.w)]
        if is_cut(draw, triangle, near, weights, False) or is_cut(
            draw, triangle, far, weights, False
        ):
            return False
    for d in range(draw.clip_distance_count):
        heights = [draw.clip_distances[vertex][d] for vertex in triangle.vertices]
        if is_cut(draw, triangle, heights, weights, True):
            return False
    return True


def depth_at(draw, triangle, edges):
    near, far = draw.min_depth, draw.max_depth
    z = [z / w for z, w in zip(triangle.z, triangle.w)]
    # Adds differences to the first depth, so that equal depths come out equal.
    rise = (z[1] - z[0]) * edges[1] + (z[2] - z[0]) * edges[2]
    depth = z[0] + rise / sum(map(float, edges))
    if draw.rules == "opengl":
        depth = (depth + 1) / 2
    depth = near + (far - near) * depth
    if draw.depth_clamp or draw.rules == "d3d":
        depth = min(max(depth, min(near, far)), max(near, far))
    return float32(depth)


def shade(draw, triangle, sample, centroid):
    provoking = triangle.vertices[2 if draw.rules == "opengl" else 0]
    values = []
    for i, (interpolation, location) in enumerate(zip(draw.interpolations, draw.locations)):
        if interpolation == "flat":
            values.append(draw.values[provoking][i])
            continue
        place = centroid if location == "centroid" else sample
        weights = [float(edge) for edge in triangle.at(*place)]
        if interpolation == "smooth":
            weights = [weight / w for weight, w in zip(weights, triangle.w)]
        r = [draw.values[vertex][i] for vertex in triangle.vertices]
        # Not by sum(), which begins with +0 and so loses the sign of -0.
        total = r[0] * weights[0] + r[1] * weights[1] + r[2] * weights[2]
        values.append(total / (weights[0] + weights[1] + weights[2]))
    return values


def draw_pixel(draw, triangle, number, x, y, drawn):
    points = [
        (x * GRID + round(px * GRID), y * GRID + round(py * GRID))
        for px, py in draw.sample_positions
    ]
    covered = [covers(draw, triangle, u, v) for u, v in points]
    if not any(covered):
        return
    centroid = (x * GRID + GRID // 2, y * GRID + GRID // 2)
    if not all(covered):
        centroid = points[covered.index(True)]
    for sample, is_covered in enumerate(covered):
        if not is_covered:
            continue
        depth = depth_at(draw, triangle, triangle.at(*points[sample]))
        place = (x, y, sample)
        if draw.depth_test:
            before = drawn[place][1] if place in drawn else draw.depth_clear
            if not depth < before:
                continue
        drawn[place] = (number, depth, shade(draw, triangle, points[sample], centroid))


def check_viewport(draw):
    for begin, size in (
        (draw.viewport_x, draw.viewport_width),
        (draw.viewport_y, draw.viewport_height),
    ):
        end = begin + size
        is_exact = end - begin == size and end - size == begin
        if abs(begin + size / 2) > GUARD_BAND or not is_exact:
            raise Unsupported("a viewport that is too far away, or of too many digits")


def draw_all(draw):
    check_viewport(draw)
    drawn = {}  # (x, y, sample): (triangle, depth, values)
    for number, vertices in enumerate(draw.triangles):
        triangle = Triangle(draw, vertices)
        if not is_shown(draw, triangle):
            continue
        # Pixels that the triangle's box, the scissor and the framebuffer have in common.
        x_end = min(draw.width, draw.scissor_x + draw.scissor_width, max(triangle.x) // GRID + 1)
        y_end = min(draw.height, draw.scissor_y + draw.scissor_height, max(triangle.y) // GRID + 1)
        for y in range(max(0, draw.scissor_y, min(triangle.y) // GRID), y_end):
            for x in range(max(0, draw.scissor_x, min(triangle.x) // GRID), x_end):
                draw_pixel(draw, triangle, number, x, y, drawn)
    if not drawn:
        return Answer(draw, 0, 0, 0, 0)
    xs, ys = [place[0] for place in drawn], [place[1] for place in drawn]
    answer = Answer(draw, min(xs), min(ys), max(xs) + 1, max(ys) + 1)
    for (x, y, sample), (number, depth, values) in drawn.items():
        answer.put(x, y, sample, number, depth, values)
    return answer


if __name__ == "__main__":
    serve(
        draw_all,
        name="little.py",
        version="1.0",
        contract=CONTRACT,
        limits={"lacks": ["nonpositive_w", "center"], "max_size": 64},
    )
