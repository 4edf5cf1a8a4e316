#!/usr/bin/env python3
"""Random cases for the second opinion: `random_case(seed)` is a small case file as a dict.

A family decides the vertices (clip positions) and may ask for a particular state; everything else (rules,
viewport, coverage, basis, culling, attributes...) is drawn independently of it. Every number is exactly a
float32, written as a hex-float string, a JSON integer or a decimal. Same seed, same case.
Usage: generate.py SEED [FAMILY]
"""

import json
import math
import random
import struct
import sys


def f32(x):
    """The nearest float32."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def value_of(text):
    """The number of one of the spellings of `written`."""
    return float.fromhex(text) if isinstance(text, str) else float(text)


def next_f32(x, direction):
    """The float32 neighbour of x towards +-infinity (direction +1 or -1)."""
    if x == 0:
        return direction * 2.0 ** -149
    bits = struct.unpack("<i", struct.pack("<f", x))[0]
    return struct.unpack("<f", struct.pack("<i", bits + (direction if x > 0 else -direction)))[0]


def written(rng, x):
    """One of the allowed spellings of a float32."""
    x = float(x)
    negative_zero = x == 0 and math.copysign(1, x) < 0
    if x == int(x) and abs(x) < 2 ** 24 and not negative_zero and rng.random() < 0.6:
        return int(x)
    if len(repr(x)) < 9 and rng.random() < 0.4:
        return x
    return x.hex()


class Draft:
    """The part of a case that a family fills in: clip positions as floats, triangles, and requests
    for the state."""

    def __init__(self, rng):
        self.rng = rng
        self.rules = rng.choice(["opengl", "vulkan", "d3d"])
        self.z_min = -1.0 if self.rules == "opengl" else 0.0
        self.samples = rng.choice([1, 1, 1, 2, 4, 8, 16])
        self.width, self.height = rng.randint(4, 16), rng.randint(4, 16)
        if self.samples > 2:
            self.width, self.height = rng.randint(4, 8), rng.randint(4, 8)
        self.positions, self.triangles = [], []
        self.distances = None  # clip distances, a list per vertex
        self.camera = None
        self.viewport = None  # None: drawn at random
        self.depth_test = None

    def uniform(self, low, high):
        return f32(self.rng.uniform(low, high))

    def depth(self):
        """NDC depth within the clip planes; now and then outside."""
        return self.uniform(self.z_min, 1) if self.rng.random() < 0.93 else self.uniform(-1.5, 1.5)

    def add(self, ndc_x, ndc_y, w, z=None):
        z = self.depth() if z is None else z
        self.positions.append([f32(ndc_x * w), f32(ndc_y * w), f32(z * w), f32(w)])

    def add_triangle(self, corners):
        first = len(self.positions)
        for corner in corners:
            self.add(*corner)
        self.triangles.append([first, first + 1, first + 2])

    def positive_w(self):
        return self.rng.choice([1.0, 1.0, 2.0 ** self.rng.randint(-3, 3), self.uniform(0.1, 8)])


# ---- families -------------------------------------------------------------------------------------------

def ordinary(d):
    for _ in range(d.rng.randint(1, 3)):
        r = d.rng.choice([1, 1.4, 2, 4])
        d.add_triangle([(d.uniform(-r, r), d.uniform(-r, r), d.positive_w()) for _ in range(3)])


def through_the_eye(d):
    rng = d.rng
    for _ in range(rng.randint(1, 2)):
        first = len(d.positions)
        for _ in range(3):
            w = rng.choice([0.0, -0.0, 1.0, -1.0, d.uniform(-2, 2), d.uniform(-2, 2), d.uniform(0, 2)])
            if rng.random() < 0.04:
                w = -abs(w)
            z = rng.choice([0.0, d.uniform(-1, 1), f32(0.5 * w), f32(0.25 * w), abs(w)])
            reach = rng.choice([1, 3])
            d.positions.append([d.uniform(-reach, reach), d.uniform(-reach, reach), z, w])
        if rng.random() < 0.6:  # in one depth plane within the clip planes
            depth = d.uniform(0, 1)
            for p in d.positions[first:]:
                p[2] = f32(depth * p[3])
        if rng.random() < 0.08:  # all behind the eye, or all in its plane
            for p in d.positions[first:]:
                p[3] = rng.choice([0.0, -1.0]) * abs(p[3])
        d.triangles.append([first, first + 1, first + 2])


def slivers(d):
    for _ in range(d.rng.randint(1, 3)):
        a, b = [(d.uniform(-1.5, 1.5), d.uniform(-1.5, 1.5)) for _ in range(2)]
        if d.rng.random() < 0.5:  # along a row of pixel centres
            a = (-1.2, (2 * d.rng.randint(0, d.height - 1) + 1) / d.height - 1)
            b = (1.3, a[1])
        k, off = d.rng.uniform(-0.2, 1.2), 2.0 ** -d.rng.randint(2, 26) * d.rng.choice([-1, 1])
        c = (a[0] + k * (b[0] - a[0]) + off, a[1] + k * (b[1] - a[1]) - off)
        d.add_triangle([(*p, d.positive_w()) for p in (a, b, c)])


def layers(d):
    """Overlapping triangles at close, equal or crossing depths, for the depth test."""
    rng = d.rng
    w = rng.choice([1.0, 2.0, 0.5])
    base = d.uniform(0.2, 0.8)
    for _ in range(rng.randint(2, 4)):
        depths = [rng.choice([base, base, f32(base + 2.0 ** -rng.randint(3, 20)), d.uniform(0, 1)])] * 3
        if rng.random() < 0.6:
            depths = [rng.choice([depths[0], d.uniform(0, 1)]) for _ in range(3)]
        d.add_triangle([(d.uniform(-2, 2), d.uniform(-2, 2), w, depth) for depth in depths])
    d.depth_test = "less"


def grid_state(d):
    """A framebuffer where window positions on the sample grid are exact in clip space."""
    d.width, d.height = d.rng.choice([4, 8, 16]), d.rng.choice([4, 8, 16])
    if d.samples > 2:
        d.width, d.height = min(d.width, 8), min(d.height, 8)
    d.viewport = [0, 0, d.width, d.height]


def to_ndc(d, x, y):
    return 2 * x / d.width - 1, 2 * y / d.height - 1


def grid_point(d, step):
    """A window position that is a multiple of `step` pixels."""
    x = d.rng.randint(-2, int(d.width / step) + 2)
    y = d.rng.randint(-2, int(d.height / step) + 2)
    return x * step, y * step


def sample_offset(d):
    """An offset within a pixel where an edge is likely to meet samples, in pixels."""
    rng = d.rng
    if d.samples == 1:
        return rng.choice([0.5, 0.5, 0.5, 0]), rng.choice([0.5, 0.5, 0.5, 0])
    return rng.randrange(16) / 16, rng.randrange(16) / 16


def on_grid(d):
    """Vertices on the sample grid; edges along its rows, columns and diagonals, or in any
    direction."""
    rng = d.rng
    grid_state(d)
    for _ in range(rng.randint(1, 3)):
        if rng.random() < 0.3:
            step = rng.choice([1, 0.5, 0.5, 0.25, 0.0625])
            points = [grid_point(d, step) for _ in range(3)]
        else:
            a, b = sample_offset(d)
            x, y = rng.randint(-1, d.width - 1) + a, rng.randint(-1, d.height - 1) + b
            i, j = rng.choice([-6, -4, -3, 2, 3, 4, 5, 8]), rng.choice([-6, -4, -3, 2, 3, 4, 5, 8])
            third = rng.choice([(x, y + j), (x, y + i), (x + i, y + i), (x + j, y + 2 * j), (x + 1, y + j)])
            points = [(x, y), (x + i, y), third]
            rng.shuffle(points)
        d.add_triangle([(*to_ndc(d, *p), 2.0 ** rng.choice([0, 0, 0, 1, 2, -1])) for p in points])


def half_grid(d):
    """Vertices exactly between two grid points of a coarse snapping grid."""
    grid_state(d)
    for _ in range(d.rng.randint(1, 2)):
        step = 0.5 ** d.rng.randint(2, 5)
        d.add_triangle([(*to_ndc(d, *grid_point(d, step)), 2.0 ** d.rng.randint(-1, 1)) for _ in range(3)])


def tiny(d):
    for _ in range(d.rng.randint(1, 6)):
        size = 2.0 ** -d.rng.choice([1, 2, 2, 3, 3, 4, 6, 8, 12])
        x, y, w = d.uniform(-1, 1), d.uniform(-1, 1), d.positive_w()
        if d.rng.random() < 0.7:  # around a pixel centre
            x = (2 * d.rng.randint(0, d.width - 1) + 1) / d.width - 1
            y = (2 * d.rng.randint(0, d.height - 1) + 1) / d.height - 1
        d.add_triangle([(x + d.uniform(-size, size), y + d.uniform(-size, size), w) for _ in range(3)])


def huge(d):
    rng = d.rng
    if rng.random() < 0.5:  # an ordinary triangle at an extreme scale
        ordinary(d)
        scale = 2.0 ** (rng.choice([-1, 1]) * rng.randint(60, 120))
        d.positions = [[f32(c * scale) for c in p] for p in d.positions]
        return
    first = len(d.positions)
    for _ in range(3):  # vertices far out, beyond the guard band, or each at its own scale
        w = 2.0 ** rng.choice([0, 0, rng.randint(-120, 120)])
        reach = 2.0 ** rng.choice([0, 4, 12, 13, 16, 30])
        x, y = (max(-1e38, min(1e38, rng.uniform(-reach, reach) * w)) for _ in range(2))
        d.positions.append([f32(x), f32(y), f32(d.depth() * w), f32(w)])
    d.triangles.append([first, first + 1, first + 2])


def denormals(d):
    unit = 2.0 ** -149
    for _ in range(3):
        w = d.rng.choice([1, 2, 3, 7, 16, 100])
        d.positions.append([unit * d.rng.randint(-2 * w, 2 * w), unit * d.rng.randint(-2 * w, 2 * w),
                            unit * d.rng.randint(-w if d.z_min else 0, w), unit * w])
    if d.rng.random() < 0.3:
        d.positions[d.rng.randrange(3)] = [0.5, -0.25, 0.5, 1.0]
    d.triangles.append([0, 1, 2])


def grazing(d):
    """Depths on the clip planes, and one float32 unit to either side."""
    for _ in range(d.rng.randint(1, 2)):
        first = len(d.positions)
        for _ in range(3):
            w = d.positive_w()
            z = d.rng.choice([w, f32(d.z_min * w), 0.5 * w])
            z = d.rng.choice([z, z, next_f32(z, 1), next_f32(z, -1)])
            d.positions.append([f32(d.uniform(-1.5, 1.5) * w), f32(d.uniform(-1.5, 1.5) * w), z, w])
        d.triangles.append([first, first + 1, first + 2])


def clip_distances(d):
    rng = d.rng
    d.rng.choice([ordinary, on_grid, mesh, through_the_eye])(d)
    count = rng.randint(1, 3)
    d.distances = []
    for x, y, _, w in d.positions:
        plane = [f32(x + w * d.rng.choice([0, 0.5])), f32(w - x), rng.choice([0.0, 1.0, -1.0, -0.0]), f32(w)]
        d.distances.append(rng.sample(plane, count) if rng.random() < 0.3 else plane[:count])
    how, index = rng.random(), rng.randrange(count)
    if how < 0.4:  # a plane and its opposite
        d.distances = [row + [-row[index]] for row in d.distances]
    elif how < 0.6:  # one that is zero everywhere
        d.distances = [row + [0.0] for row in d.distances]


def far_border(d):
    """A viewport whose far borders run through samples, covered there."""
    d.samples = d.rng.choice([1, 1, 2, 4])
    x, y = d.rng.choice([0, 0.5, 1]), d.rng.choice([0, 0.5, 1])
    dx, dy = d.rng.choice([0.5, 0.75, 0.25, 0]), d.rng.choice([0.5, 0.75, 0.25, 0])
    d.viewport = [x, y, d.width - 2 + dx - x, d.height - 2 + dy - y]
    d.add_triangle([(d.uniform(-1, 1), d.uniform(-1, 1), 1.0, 0.5) if d.rng.random() < 0.3 else
                    (*corner, 1.0, 0.5) for corner in ((-2.0, -2.0), (4.0, -2.0), (0.0, 3.0))])


def degenerate(d):
    rng = d.rng
    d.rng.choice([on_grid, ordinary, through_the_eye])(d)
    for triangle in d.triangles:
        a, b, c = triangle
        how = rng.choice(["repeat", "same", "collinear", "zero", "keep"])
        if how == "repeat":
            triangle[rng.randrange(3)] = triangle[rng.randrange(3)]
        elif how == "same":
            d.positions[b] = list(d.positions[a])
        elif how == "collinear":
            d.positions[c] = [f32((p + q) / 2) for p, q in zip(d.positions[a], d.positions[b])]
        elif how == "zero":
            d.positions[c] = [0.0, 0.0, 0.0, rng.choice([0.0, 1.0])]


def mesh(d):
    """Triangles with shared edges: quads with a diagonal, on the sample grid or anywhere."""
    rng = d.rng
    columns, rows = rng.randint(1, 2), rng.randint(1, 2)
    exact = rng.random() < 0.6
    if exact:
        grid_state(d)
        (a, b), size_x, size_y = sample_offset(d), rng.randint(1, 5), rng.randint(1, 5)
        size_y = size_x if rng.random() < 0.6 else size_y
        left, bottom = rng.randint(0, d.width // 2) + a, rng.randint(0, d.height // 2) + b
    for j in range(rows + 1):
        for i in range(columns + 1):
            if exact:
                d.add(*to_ndc(d, left + i * size_x, bottom + j * size_y), 2.0 ** rng.choice([0, 0, 0, 1]))
            else:
                x, y = i / columns * 1.5 - 0.75, j / rows * 1.5 - 0.75
                d.add(x + d.uniform(-0.3, 0.3), y + d.uniform(-0.3, 0.3), d.positive_w())
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c = a + 1, a + columns + 1
            halves = [[a, b, c], [c, b, c + 1]] if rng.random() < 0.5 else [[a, b, c + 1], [a, c + 1, c]]
            d.triangles += [h[k:] + h[:k] for h in halves for k in [rng.randrange(3)]]


def camera(d):
    """Object positions and 4x4 matrices; everything stays far from float32's limits."""
    rng = d.rng

    def small():
        return rng.choice([0.0, 1.0, -1.0, 0.5, d.uniform(-1, 1), d.uniform(-1, 1)])

    def affine():
        m = [small() for _ in range(12)] + [0.0, 0.0, 0.0, 1.0]
        for k in range(3):
            m[5 * k] = d.uniform(0.5, 1.5)
        return m

    d.camera = {}
    if rng.random() < 0.7:
        d.camera["model"] = affine()
    if rng.random() < 0.7:
        d.camera["view"] = [1.0, 0.0, 0.0, d.uniform(-0.3, 0.3), 0.0, 1.0, 0.0, d.uniform(-0.3, 0.3),
                            0.0, 0.0, 1.0, d.uniform(-3, -1), 0.0, 0.0, 0.0, 1.0]
    if rng.random() < 0.8:
        near, far = 0.25, 8.0
        a, b = f32(far / (near - far)), f32(near * far / (near - far))
        d.camera["projection"] = [d.uniform(0.7, 2), 0.0, 0.0, 0.0, 0.0, d.uniform(0.7, 2), 0.0, 0.0,
                                  0.0, 0.0, a, b, 0.0, 0.0, -1.0, 0.0]
    if rng.random() < 0.1:
        d.camera["projection"] = [d.uniform(-1, 1) for _ in range(16)]
    three = rng.random() < 0.7
    for k in range(rng.randint(1, 2)):
        for _ in range(3):
            p = [d.uniform(-1.5, 1.5) for _ in range(3)] + [rng.choice([1.0, 1.0, d.uniform(0.5, 2)])]
            d.positions.append(p[:3] if three else p)
        d.triangles.append([3 * k, 3 * k + 1, 3 * k + 2])


FAMILIES = {f.__name__: f for f in (
    ordinary, through_the_eye, slivers, layers, on_grid, half_grid, tiny, huge, denormals, grazing,
    clip_distances, far_border, degenerate, mesh, camera)}


# ---- the rest of a case ---------------------------------------------------------------------------------

def random_viewport(d):
    rng = d.rng
    if d.viewport is not None:
        box = list(d.viewport)
    elif rng.random() < 0.55:
        box = [0, 0, d.width, d.height]
    else:
        step = rng.choice([1, 0.5, 0.25, 2.0 ** -4, 2.0 ** -10])
        x, y = rng.randrange(int(d.width / 2 / step)) * step, rng.randrange(int(d.height / 2 / step)) * step
        box = [x, y, rng.randint(1, int((d.width - x) / step)) * step,
               rng.randint(1, int((d.height - y) / step)) * step]
    if d.rules == "vulkan" and rng.random() < 0.3:
        box[1], box[3] = box[1] + box[3], -box[3]
    viewport = {k: written(rng, f32(v)) for k, v in zip(("x", "y", "width", "height"), box)}
    near, far = rng.choice([(0.0, 1.0), (0.0, 1.0), (0.25, 0.75), (0.5, 0.5), (0.0, d.uniform(0, 1)),
                            (1.0, 0.0), (d.uniform(0, 1), d.uniform(0, 1))])
    if d.rules == "d3d" and near > far:
        near, far = far, near
    if (near, far) != (0.0, 1.0) or rng.random() < 0.7:
        viewport["min_depth"], viewport["max_depth"] = written(rng, near), written(rng, far)
    return viewport


def random_coverage(d):
    """Exact, snapped with one candidate per vertex, or with several ("unspecified", position_error)."""
    rng = d.rng
    kind = rng.choice(["exact"] * 5 + ["snapped"] * 2 + ["unspecified", "error", "many"])
    if kind == "exact":
        return rng.choice([None, "exact"])
    coverage = {"subpixel_bits": rng.choice([8, 8, 4, 4, 2, 1, 0, 5, 16, rng.randint(0, 16)])}
    rounding = rng.choice([None, "nearest_even", "half_up"])
    error = None
    if kind == "unspecified":
        rounding, error = "unspecified", rng.choice([None, None, 0.0, f32(0.1)])
    elif kind == "error":
        error = rng.choice([f32(0.1), 0.25, 0.5, 2.0 ** -20])
    elif kind == "many":  # up to, and beyond, the number of placements that are enumerated
        rounding = rng.choice([rounding, "unspecified"])
        error = rng.choice([0.5, 1.0]) if rounding == "unspecified" else rng.choice([1.0, 1.25, 1.5])
    elif rng.random() < 0.2:
        error = 0.0
    if rounding is not None:
        coverage["rounding"] = rounding
    if error is not None:
        coverage["position_error"] = written(rng, error)
    if kind in ("error", "many") or rounding == "unspecified":  # many placements: keep the case small
        d.samples = min(d.samples, 4)
        if d.viewport is None:
            limit = 8 if d.samples == 1 else 6
            d.width, d.height = min(d.width, limit), min(d.height, limit)
    return coverage


def random_attributes(d):
    """Declarations, and the values of one vertex after the other."""
    rng = d.rng
    declared, columns = [], []
    for index in range(rng.choice([0, 1, 1, 1, 2, 2, 3])):
        attribute = {"name": f"a{index}"}
        interpolation = rng.choice([None, "smooth", "smooth", "noperspective", "flat"])
        location = rng.choice([None, "sample", "center", "centroid", "centroid"])
        if interpolation:
            attribute["interpolation"] = interpolation
        if location:
            attribute["location"] = location
        declared.append(attribute)
        scale = 2.0 ** rng.choice([0, 0, 0, 10, -10, 100, -130])
        constant = rng.random() < 0.1
        values = []
        for _ in d.positions:
            r = rng.choice([0.0, -0.0, 1.0, rng.randint(-8, 8), rng.uniform(-1, 1), rng.uniform(-1, 1)])
            values.append(f32(r * scale))
        columns.append([values[0]] * len(values) if constant else values)
    return declared, list(zip(*columns)) if columns else [()] * len(d.positions)


def random_case(seed: int, family: str = "") -> dict:
    """Case number `seed`, of a random family unless one is named."""
    rng = random.Random(seed)
    d = Draft(rng)
    name = rng.choice(list(FAMILIES))
    name = family or name
    coverage = random_coverage(d)
    FAMILIES[name](d)
    declared, values = random_attributes(d)
    case = {"format": "rastercheck-case", "version": 1, "name": f"{name} {seed}",
            "framebuffer": {"width": d.width, "height": d.height},
            "viewport": random_viewport(d), "rules": d.rules}
    if d.samples > 1 or rng.random() < 0.5:
        case["framebuffer"]["samples"] = d.samples
    if coverage is not None:
        case["coverage"] = coverage
    if rng.random() < 0.6:
        case["basis"] = rng.choice(["ideal", "snapped", "snapped", "unspecified"])
    if rng.random() < 0.4:
        case["cull"] = rng.choice(["none", "back", "front"])
    if rng.random() < 0.5:
        case["front_face"] = rng.choice(["ccw", "cw"])
    if rng.random() < 0.25:
        case["fill_rule"] = rng.choice(["top_left", "bottom_left"])
    if rng.random() < 0.15:
        x, y = rng.randrange(d.width), rng.randrange(d.height)
        case["scissor"] = {"x": x, "y": y, "width": rng.randint(1, d.width - x),
                           "height": rng.randint(1, d.height - y)}
    if rng.random() < 0.2:
        case["depth_clamp"] = rng.random() < 0.8
    if d.depth_test:
        case["depth_test"] = d.depth_test
    elif rng.random() < (0.5 if len(d.triangles) > 1 else 0.1):
        case["depth_test"] = rng.choice(["less", "less", "less", "none"])
    if d.camera is not None:
        case["camera"] = {k: [written(rng, c) for c in m] for k, m in d.camera.items()}
    case["attributes"] = declared
    case["vertices"] = []
    for index, position in enumerate(d.positions):
        vertex = {"position": [written(rng, c) for c in position],
                  "attributes": [written(rng, r) for r in values[index]]}
        if d.distances is not None:
            vertex["clip_distances"] = [written(rng, c) for c in d.distances[index]]
        case["vertices"].append(vertex)
    case["triangles"] = d.triangles
    return case


def random_biased_case(seed: int) -> dict:
    """Case number `seed` with a depth bias, a unorm format, or both."""
    case = random_case(seed)
    rng = random.Random(f"bias {seed}")
    depth_format = rng.choice([None, "float32", "unorm16", "unorm16", "unorm24"])
    if depth_format is not None:
        case["depth_format"] = depth_format
    if depth_format in (None, "float32") or rng.random() < 0.8:
        def signed(values):
            return rng.choice([-1, 1]) * rng.choice(values)

        bias = {"constant": signed([0, 1, 1, 3, 1000, 2.0 ** 16, 2.0 ** 22, rng.uniform(0, 2 ** 20)]),
                "slope": signed([0, 0, 0.5, 1, 2, 2.0 ** -10, rng.uniform(0, 4)]),
                "clamp": signed([0, 0, 2.0 ** -3, 2.0 ** -10, 2.0 ** -20, rng.uniform(0, 1)])}
        case["depth_bias"] = {key: written(rng, f32(value)) for key, value in bias.items() if value != 0
                              or rng.random() < 0.5}
    if rng.random() < 0.2:  # half-way between two numbers of every unorm format
        for vertex in case["vertices"]:
            if "camera" not in case and abs(w := value_of(vertex["position"][3])) > 2.0 ** -100:
                vertex["position"][2] = written(rng, (0 if case["rules"] == "opengl" else 0.5) * w)
    if case.get("depth_test") == "less" and rng.random() < 0.5:
        case["depth_clear"] = written(rng, f32(rng.choice([0.5, 1, rng.uniform(0, 1)])))
    return case


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: generate.py SEED [FAMILY]")
    print(json.dumps(random_case(int(sys.argv[1]), *sys.argv[2:]), indent=1))
