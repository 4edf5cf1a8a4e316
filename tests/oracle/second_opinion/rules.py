#!/usr/bin/env python3
"""A second opinion: the exact answer of a case, computed in `fractions.Fraction`.

Notation. Vertex i has clip position (x_i, y_i, z_i, w_i); its homogeneous window position (X_i, Y_i, w_i)
is column i of M (unit: pixels times w). Row i of Q = M^-1 is the window-affine function
e_i(u, v) = A_i u + B_i v + C_i, and

    D = 1/w = sum e_i      N/D = sum r_i e_i / D (smooth)      sum r_i w_i e_i (noperspective)
    z/w     = sum z_i e_i  (a plane)                           sum w_i e_i = 1 identically.

Since Q is divided by det M, all e_i are >= 0 exactly on the triangle, whatever the signs of det M and w_i,
and (A_i, B_i) points into it. Every edge, clip plane and plane of depth here is such a triple (A, B, C).

Three coverages:
  exact         the mathematical triangle: required or forbidden.
  snapped uncut no vertex is clipped: a *placement* chooses one grid point ("candidate") for each of the six
                window coordinates; all placements cover: required; none: forbidden; else permitted.
  snapped cut   some vertex is clipped (behind the eye, beyond the guard band, or outside a clip plane): each
                boundary answers in, out or maybe; samples near a cut boundary are permitted.
Attributes and depth come from the ideal map, the placed one, or both (`basis`); where several points or
placements are allowed, a value is a range [lo, hi]. Depth is biased and clamped, but not yet stored in the case's
format (depth.py); a depth test compares what is stored.

Window coordinates are pixels; grid coordinates g are integers in units of 2^-subpixel_bits pixels; sample
offsets are sixteenths of a pixel. Nothing is rounded, except clip positions to float32 with clip=True.

What this does not do: check its input, draw quickly, share code with the oracle, or answer for a slope bias
where several maps give the depth (`is_decided`).
Usage: rules.py [--clip] CASE.json
"""

import collections
import functools
import itertools
import json
import math
import sys
from fractions import Fraction

import depth as stored_depth
from exact import (adjugate, clip_polygon, combine, corners_of, cross, dot, hull_of, in_convex_hull, number,
                   rectangle, round_to_float32, sign)

REQUIRED, PERMITTED = "required", "permitted"
FORBIDDEN = None  # a judgement is FORBIDDEN or a pair (verdict, reason)
GUARD_BAND = 32768  # pixels from the window's origin; a vertex beyond it is clipped
MAX_PLACEMENTS = 729  # above it, corners and the convex hull decide

# In sixteenths of a pixel from the corner of smallest window x and y, in index order.
SAMPLES = {
    1: [(8, 8)],
    2: [(12, 12), (4, 4)],
    4: [(6, 2), (14, 6), (2, 10), (10, 14)],
    8: [(9, 5), (7, 11), (13, 9), (5, 3), (3, 13), (1, 7), (11, 15), (15, 1)],
    16: [(9, 9), (7, 5), (5, 10), (12, 7), (3, 6), (10, 13), (13, 11), (11, 3),
         (6, 14), (8, 1), (4, 2), (2, 12), (0, 8), (15, 4), (14, 15), (1, 0)],
}


# ---- the case -------------------------------------------------------------------------------------------

class Case:
    """The case's keys with their defaults filled in, numbers as Fractions."""

    def __init__(self, case, clip):
        self.rules = case["rules"]
        self.y_up = self.rules == "opengl"
        self.z_min = -1 if self.rules == "opengl" else 0  # clip depth: z_min w <= z <= w
        fb = case["framebuffer"]
        self.width, self.height = fb["width"], fb["height"]
        self.samples = SAMPLES[fb.get("samples", 1)]
        vp = case["viewport"]
        self.x0, self.y0, self.vw, self.vh = (number(vp[k]) for k in ("x", "y", "width", "height"))
        self.near, self.far = number(vp.get("min_depth", 0)), number(vp.get("max_depth", 1))
        self.viewport = (*sorted((self.x0, self.x0 + self.vw)), *sorted((self.y0, self.y0 + self.vh)))
        self.scissor = case.get("scissor")
        self.cull = case.get("cull", "none")
        self.front_face = case.get("front_face", "ccw")
        fill_rule = case.get("fill_rule", "bottom_left" if self.rules == "opengl" else "top_left")
        # +1: with A = 0, an edge whose normal points to larger v owns its samples.
        self.sigma = 1 if (fill_rule == "bottom_left") == self.y_up else -1
        self.depth_clamp = case.get("depth_clamp", False)
        self.clamps_depth = self.depth_clamp or self.rules == "d3d"
        self.depth_test = case.get("depth_test", "none")
        self.depth_clear = number(case["depth_clear"]) if "depth_clear" in case else None
        self.bias = stored_depth.read_bias(case)
        self.depth_bits = stored_depth.BITS[case.get("depth_format", "float32")]
        if self.clamps_depth:
            self.depth_limits = sorted((self.near, self.far))
        else:  # drawn without bias in floats, a depth is within the range that clipping leaves
            self.depth_limits = (0, 1) if self.bias or self.depth_bits else None
        self.attributes = [(a.get("interpolation", "smooth"), a.get("location", "sample"))
                           for a in case.get("attributes", [])]
        self.basis = case.get("basis", "snapped" if self.rules == "d3d" else "ideal")
        self.read_coverage(case.get("coverage", "exact"))
        self.clip_positions = self.read_positions(case, clip)
        self.vertices = case["vertices"]

    def read_coverage(self, coverage):
        self.snapped = coverage != "exact"
        self.ranged = False  # "unspecified": every value prints as a range
        if not self.snapped:
            self.basis = "ideal"  # basis matters only where positions are snapped
            return
        self.grid = 2 ** coverage["subpixel_bits"]  # grid units per pixel
        self.rounding = coverage.get("rounding", "nearest_even")
        self.error = number(coverage.get("position_error", 0))  # grid units
        self.radius = (1 if self.rounding == "unspecified" else Fraction(1, 2)) + self.error
        self.ranged = self.rounding == "unspecified" or self.error > 0 or self.basis == "unspecified"

    def read_positions(self, case, clip):
        """Clip positions: given, or projection * view * model * position."""
        positions = []
        for vertex in case["vertices"]:
            p = [number(c) for c in vertex["position"]]
            if "camera" in case:
                p += [Fraction(1)] * (4 - len(p))
                for key in ("model", "view", "projection"):
                    if key in case["camera"]:
                        m = [number(c) for c in case["camera"][key]]
                        p = [sum(m[4 * row + k] * p[k] for k in range(4)) for row in range(4)]
                if clip:
                    p = [round_to_float32(c) for c in p]
            positions.append(p)
        return positions

    def candidates(self, x):
        """The grid coordinates at which a vertex at window coordinate x (pixels) may be placed."""
        g = x * self.grid
        if self.rounding == "unspecified":  # |g' - g| < 1 + error
            return range(math.floor(g - self.radius) + 1, math.ceil(g + self.radius))
        if self.error > 0:  # |g' - g| <= 1/2 + error
            return range(math.ceil(g - self.radius), math.floor(g + self.radius) + 1)
        return [round(g) if self.rounding == "nearest_even" else math.floor(g + Fraction(1, 2))]

    def culls(self, det):
        """Is a triangle with this (nonzero) determinant culled?"""
        counter_clockwise = (det > 0) == self.y_up
        front = counter_clockwise == (self.front_face == "ccw")
        return (self.cull == "back" and not front) or (self.cull == "front" and front)

    def depth(self, z_over_w):
        """Window depth, before clamping."""
        return self.near + (self.far - self.near) * ((z_over_w + 1) / 2 if self.y_up else z_over_w)

    def contains(self, line, s):
        """Does the closed-or-open half plane `line` with value s at the sample contain it (tie rule)?"""
        if s == 0:
            return line[0] > 0 or (line[0] == 0 and self.sigma * line[1] > 0)
        return s > 0


class ProjectiveMap:
    """Q = M^-1 of three homogeneous columns; `rows` is None where det M = 0."""

    def __init__(self, columns):
        self.adj = adjugate(columns)
        self.det = dot(columns[0], self.adj[0])
        self.rows = [tuple(a / self.det for a in row) for row in self.adj] if self.det else None
        self.memo = {}

    def e(self, p):
        if p not in self.memo:
            self.memo[p] = [row[0] * p[0] + row[1] * p[1] + row[2] for row in self.rows]
        return self.memo[p]


# Something interpolated: kind "depth" (r = z_i), "smooth" or "noperspective"; hull = range of vertex values.
Channel = collections.namedtuple("Channel", "kind r hull")

# One choice of grid points, with its integer edge lines (times positive factors), oriented by sign det'.
Placement = collections.namedtuple("Placement", "points orientation lines culling")


# ---- one triangle ---------------------------------------------------------------------------------------

class Triangle:
    def __init__(self, case, indices):
        self.case = case
        clip = [case.clip_positions[i] for i in indices]
        self.z, self.w = [c[2] for c in clip], [c[3] for c in clip]
        h = -case.vh if case.rules == "d3d" else case.vh  # (NDC y runs against window y)
        self.columns = [(x * case.vw / 2 + w * (case.x0 + case.vw / 2),
                         y * h / 2 + w * (case.y0 + case.vh / 2), w) for x, y, z, w in clip]
        self.ideal = ProjectiveMap(self.columns)
        distances = [[number(d) for d in case.vertices[i].get("clip_distances", [])] for i in indices]
        self.distances = list(zip(*distances))  # one triple of vertex values per clip distance
        self.near = [z - case.z_min * w for z, w in zip(self.z, self.w)]
        self.far = [w - z for z, w in zip(self.z, self.w)]
        if self.ideal.det:
            rows = self.ideal.rows
            depth_planes = [] if case.depth_clamp else [combine(rows, self.near), combine(rows, self.far)]
            self.polygon = list(rows) + depth_planes + [combine(rows, d) for d in self.distances]
        self.provoking = indices[2 if case.rules == "opengl" else 0]
        self.region_memo = {}
        self.cut = False
        if case.snapped:
            self.prepare_snapped()
        self.ranged = case.ranged or (self.cut and case.basis == "snapped")
        depths = [case.depth(z / w) for z, w in zip(self.z, self.w)] if case.snapped and not self.cut else []
        self.depth_channel = Channel("depth", self.z, hull_of((v, v) for v in depths))
        self.channels = []
        for k, (kind, _) in enumerate(case.attributes):
            r = [number(case.vertices[i]["attributes"][k]) for i in indices]
            self.channels.append(Channel(kind, r, (min(r), max(r))))

    def prepare_snapped(self):
        """Which vertices are clipped; candidates, placements, corner placements."""
        case = self.case
        self.clipped = []
        for i, (X, Y, w) in enumerate(self.columns):
            outside = w <= 0 or abs(X) > GUARD_BAND * w or abs(Y) > GUARD_BAND * w
            if not case.depth_clamp:
                outside = outside or self.near[i] < 0 or self.far[i] < 0
            self.clipped.append(outside or any(d[i] < 0 for d in self.distances))
        self.cut = any(self.clipped)
        self.boxes = [None if clipped else (list(case.candidates(X / w)), list(case.candidates(Y / w)))
                      for clipped, (X, Y, w) in zip(self.clipped, self.columns)]
        if self.cut:
            self.rho = max(1 + case.error, case.radius) / case.grid
            self.prepare_cut()
            return
        self.rho = case.radius / case.grid
        axes = [axis for box in self.boxes for axis in box]
        self.placement_count = math.prod(len(axis) for axis in axes)
        self.placements = self.place(axes) if self.placement_count <= MAX_PLACEMENTS else None
        self.corners = self.place([sorted({axis[0], axis[-1]}) for axis in axes])
        self.corner_maps = [ProjectiveMap([(Fraction(x, case.grid) * w, Fraction(y, case.grid) * w, w)
                                            for (x, y), w in zip(placement.points, self.w)])
                             for placement in self.corners]  # columns (x' w, y' w, w)

    def place(self, axes):
        placements = []
        for x0, y0, x1, y1, x2, y2 in itertools.product(*axes):
            points = [(x0, y0), (x1, y1), (x2, y2)]
            columns = [(x, y, self.case.grid) for x, y in points]
            adj = adjugate(columns)
            o = sign(dot(columns[0], adj[0]))
            lines = [tuple(o * a for a in row) for row in adj]
            placements.append(Placement(points, o, lines, self.culling(o)))
        return placements

    def culling(self, orientation):
        """What culling does to an uncut placement: "kept", "culled", or "unknown"."""
        case, ideal = self.case, sign(self.ideal.det)
        if case.cull == "none":
            return "unknown" if case.basis == "ideal" and ideal == 0 else "kept"
        signs = {"ideal": [ideal], "snapped": [orientation], "unspecified": [ideal, orientation]}[case.basis]
        if orientation == 0 or 0 in signs:  # (a flat placement covers nothing anyway)
            return "unknown"
        culled = [case.culls(s) for s in signs]
        return "culled" if all(culled) else "unknown" if any(culled) else "kept"

    # ---- verdicts ----

    def verdict(self, x, y, offset):
        """The judgement of one sample of a pixel in the framebuffer, with scissor and viewport."""
        case, s = self.case, self.case.scissor
        if s and not (s["x"] <= x < s["x"] + s["width"] and s["y"] <= y < s["y"] + s["height"]):
            return FORBIDDEN
        p = (x + Fraction(offset[0], 16), y + Fraction(offset[1], 16))
        x_low, x_high, y_low, y_high = case.viewport
        if not (x_low <= p[0] <= x_high and y_low <= p[1] <= y_high):
            return FORBIDDEN
        far_border = p[0] == x_high or p[1] == y_high
        if far_border and case.rules == "d3d":
            return FORBIDDEN
        judgement = self.judge(p)
        if far_border and judgement and judgement[0] == REQUIRED:
            return (PERMITTED, "clip edge")
        return judgement

    def judge(self, p):
        if not self.case.snapped:
            return self.judge_exact(p)
        if not self.cut:
            return self.judge_uncut(p)
        judgement = self.judge_cut(p)
        if judgement and self.ideal.det and not self.near_polygon(p):
            return FORBIDDEN  # nothing that is drawn reaches there
        return judgement

    def judge_exact(self, p):
        case = self.case
        if self.ideal.det == 0 or case.culls(self.ideal.det):
            return FORBIDDEN
        tie = False
        e = self.ideal.e(p)
        for row, s in zip(self.ideal.rows, e):
            if not case.contains(row, s):
                return FORBIDDEN
            tie = tie or s == 0
        if not case.depth_clamp and (dot(e, self.near) < 0 or dot(e, self.far) < 0):
            return FORBIDDEN
        for d in self.distances:
            line, s = combine(self.ideal.rows, d), dot(e, d)
            if line == (0, 0, 0):
                continue
            if s < 0 or (s == 0 and case.rules != "d3d" and not case.contains(line, s)):
                return FORBIDDEN
            tie = tie or s == 0
        return (REQUIRED, "tie" if tie else "inside")

    def judge_uncut(self, p):
        """Judges over all placements, or over their corners and hull if there are too many."""
        case = self.case
        h = (int(16 * p[0]), int(16 * p[1]), 16)  # the sample, homogeneous, in integers
        if self.placements is None:
            return self.judge_corners(p, h)
        for axis in (0, 1):  # outside all candidates' bounding box no placement covers
            coordinates = [g for box in self.boxes for g in box[axis]]
            if not min(coordinates) <= p[axis] * case.grid <= max(coordinates):
                return FORBIDDEN
        possible, sure, tie = False, True, False
        for placement in self.placements:
            values = [dot(line, h) for line in placement.lines]
            inside = placement.orientation != 0 and all(map(case.contains, placement.lines, values))
            possible = possible or (inside and placement.culling != "culled")
            sure = sure and inside and placement.culling == "kept"
            tie = tie or (inside and 0 in values)
            if possible and not sure:
                return (PERMITTED, "snapping")
        if not possible:
            return FORBIDDEN
        return (REQUIRED, "tie" if tie else "inside")

    def judge_corners(self, p, h):
        case = self.case
        grid_point = (p[0] * case.grid, p[1] * case.grid)
        box_corners = [(x, y) for box in self.boxes for x in (box[0][0], box[0][-1])
                       for y in (box[1][0], box[1][-1])]
        if not in_convex_hull(grid_point, box_corners):
            return FORBIDDEN
        if all(placement.orientation == 0 or placement.culling == "culled" for placement in self.corners):
            return FORBIDDEN  # det is affine in every coordinate: no placement turns the other way
        orientation = self.corners[0].orientation
        for placement in self.corners:
            if (orientation == 0 or placement.orientation != orientation or placement.culling != "kept"
                    or any(dot(line, h) <= 0 for line in placement.lines)):
                return (PERMITTED, "snapping")
        return (REQUIRED, "inside")

    def prepare_cut(self):
        """The boundaries of a cut triangle: banded functionals, and snapped edges as (lines, None).

        An edge is turned if, for some choice of grid points, another corner of the clipped polygon,
        moved by rho, may lie on the edge or beyond it: then (lines, its exact line).
        """
        case, det = self.case, self.ideal.det
        self.snapped_edges, self.banded = [], []
        self.tolerance = (1 + case.error) / case.grid  # t: the contract's one grid unit, and the error, in pixels
        if det == 0:
            lines = [row for row in self.ideal.adj if row[0] != 0 or row[1] != 0]
            self.flat_line = lines[0] if lines else None
            return
        # A point deeper than rho inside every side keeps the polygon running round it the same way.
        inset = [(a, b, c - self.rho * (abs(a) + abs(b))) for a, b, c in self.polygon if a or b]
        box = corners_of(-GUARD_BAND, GUARD_BAND, -GUARD_BAND, GUARD_BAND)
        self.may_turn = not clip_polygon(box, inset)
        rows = self.ideal.rows
        corners = clip_polygon(box, self.polygon)
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            if self.clipped[j] or self.clipped[k]:
                self.banded.append(rows[i])
                continue
            lines = []  # columns (x', y', 1): the positive factors w_j w_k change no sign
            for xj, yj, xk, yk in itertools.product(*self.boxes[j], *self.boxes[k]):
                line = cross((xj, yj, case.grid), (xk, yk, case.grid))
                lines.append(tuple(sign(det) * a for a in line))
            ends = [(c[0] / c[2], c[1] / c[2]) for c in (self.columns[j], self.columns[k])]
            others = [c for c in corners if c not in ends]
            turned = any(dot(line, self.columns[i]) <= 0 or
                         any(dot(line, (*c, 1)) <= self.rho * (abs(line[0]) + abs(line[1]))
                             for c in others)
                         for line in lines)
            self.snapped_edges.append((lines, rows[i] if turned else None))
        if not case.depth_clamp:
            self.banded += [combine(rows, f) for f in (self.near, self.far) if min(f) < 0]
        self.banded += [combine(rows, d) for d in self.distances if min(d) < 0]

    def judge_cut(self, p):
        """Judges boundary by boundary, without the test against the ideal polygon."""
        case = self.case
        cut_reason = "w <= 0" if min(self.w) <= 0 else "clip edge"
        if self.ideal.det == 0:
            line = self.flat_line
            if line is None or abs(dot(line, (*p, 1))) > self.tolerance * (abs(line[0]) + abs(line[1])):
                return FORBIDDEN
            if min(self.w) > 0:  # (its vertices bound it along the line)
                for axis in (0, 1):
                    at = [column[axis] / column[2] for column in self.columns]
                    if not min(at) - self.rho <= p[axis] <= max(at) + self.rho:
                        return FORBIDDEN
            return (PERMITTED, cut_reason)
        facing_open = case.cull != "none" and case.basis != "ideal" and self.may_turn
        if not facing_open and case.culls(self.ideal.det):
            return FORBIDDEN
        maybe_snapped = tie = False
        maybe_cut = facing_open
        for line in self.banded:
            s, band = dot(line, (*p, 1)), self.tolerance * (abs(line[0]) + abs(line[1]))
            if s < -band:
                return FORBIDDEN
            if s <= band and band > 0:  # (a constant that is zero counts as in)
                maybe_cut = True
        h = (int(16 * p[0]), int(16 * p[1]), 16)
        for lines, ideal_line in self.snapped_edges:
            if ideal_line is not None:  # turned: known to within rho
                s = dot(ideal_line, (*p, 1))
                band = self.rho * (abs(ideal_line[0]) + abs(ideal_line[1]))
                if s < -band:
                    return FORBIDDEN
                maybe_snapped = maybe_snapped or s <= band
                continue
            values = [dot(line, h) for line in lines]
            inside = list(map(case.contains, lines, values))
            if not any(inside):
                return FORBIDDEN
            maybe_snapped = maybe_snapped or not all(inside)
            tie = tie or 0 in values
        if maybe_cut:
            return (PERMITTED, cut_reason)
        if maybe_snapped:
            return (PERMITTED, "snapping")
        return (REQUIRED, "tie" if tie else "inside")

    def near_polygon(self, p):
        """Vertices of the closed box p +- rho within the ideal clipped polygon."""
        if p not in self.region_memo:
            box = corners_of(p[0] - self.rho, p[0] + self.rho, p[1] - self.rho, p[1] + self.rho)
            self.region_memo[p] = clip_polygon(box, self.polygon)
        return self.region_memo[p]

    # ---- values: None, or a range (lo, hi) ----

    def evaluate(self, q, channel, p, style="sample"):
        """The value by one map at one point, as a range of one number."""
        if q.rows is None:
            return None
        e = q.e(p)
        d = sum(e)
        if d <= 0 and (channel.kind == "smooth" or (style == "center" and channel.kind != "depth")):
            return None
        n = dot(channel.r, e)
        if channel.kind == "smooth":
            value = n / d
        elif channel.kind == "noperspective":
            value = sum(r * w * x for r, w, x in zip(channel.r, self.w, e))
        else:
            value = self.case.depth(n)
        return (value, value)

    def value_at(self, channel, p, style):
        """`style`: "sample", or "center" (a point that need not be covered)."""
        case = self.case
        if case.basis == "ideal":  # exact coverage included
            return self.evaluate(self.ideal, channel, p, style)
        if len(case.samples) == 1 and not self.has_one_map():
            style = "sample"  # the centre is the covered sample
        if self.cut:
            return self.cut_value(channel, p, style)
        value = self.snapped_value(channel, p, style)
        if case.basis == "unspecified" and value is not None:
            ideal = self.evaluate(self.ideal, channel, p, style)
            value = hull_of([value, ideal]) if ideal is not None else value
        return value

    def has_one_map(self):
        """True if a single map gives the values, so that nothing about the basis is open."""
        snapped_once = self.case.basis == "snapped" and not self.cut and self.placement_count == 1
        return self.case.basis == "ideal" or snapped_once

    def snapped_value(self, channel, p, style):
        if self.placement_count == 1:
            return self.evaluate(self.corner_maps[0], channel, p, style)
        orientations = {placement.orientation for placement in self.corners}
        one_way = len(orientations) == 1 and 0 not in orientations
        if not one_way or any(sum(q.e(p)) <= 0 for q in self.corner_maps):
            return channel.hull if style == "sample" else None
        low, high = hull_of(self.evaluate(q, channel, p, style) for q in self.corner_maps)
        if style == "sample":
            low, high = max(low, channel.hull[0]), min(high, channel.hull[1])
        return (low, high)

    def cut_value(self, channel, p, style):
        if self.ideal.det == 0:
            return None
        if style == "center":
            judgement = self.judge_cut(p)
            if not judgement or judgement[0] != REQUIRED:
                return None
        # (all weights are >= 0 at the polygon's vertices, so D > 0)
        value = hull_of(self.evaluate(self.ideal, channel, q) for q in self.near_polygon(p))
        has_ideal = style == "sample" or sum(self.ideal.e(p)) > 0
        if value and self.case.basis == "unspecified" and has_ideal:
            value = hull_of(v for v in (value, self.evaluate(self.ideal, channel, p)) if v)
        return value

    def centroid_any(self, channel, x, y, covered):
        """OpenGL, Vulkan: any point of pixel and triangle. `covered`: the pixel's non-forbidden samples."""
        case = self.case
        one_placement = case.snapped and not self.cut and self.placement_count == 1
        placed = case.basis == "snapped" and one_placement
        q = self.corner_maps[0] if placed else self.ideal
        if q.rows is None:
            return None
        half_planes, r = (q.rows if placed else self.polygon), Fraction(0)
        samples = covered if placed or (case.snapped and case.basis != "snapped") else []
        if case.basis == "ideal" or placed:
            half_planes = half_planes + rectangle(*case.viewport)
        else:
            r = self.rho
        points = clip_polygon(corners_of(x - r, x + 1 + r, y - r, y + 1 + r), half_planes)
        values = [self.evaluate(q, channel, p) for p in points + samples]
        behind_the_eye = case.basis == "ideal" and None in values[len(points):]
        return None if behind_the_eye else hull_of(v for v in values if v is not None)

    def centroid_d3d(self, channel, centre, points, verdicts):
        """D3D: (range, number of candidates for the location)."""
        # Where all samples are covered, so is the centre, which lies in the hull of every pattern.
        style = "center" if self.has_one_map() else "sample"
        if all(j and j[0] == REQUIRED for j in verdicts):
            return self.value_at(channel, centre, style), 1
        values = []
        for p, judgement in zip(points, verdicts):
            if judgement:
                values.append(self.value_at(channel, p, "sample"))
                if judgement[0] == REQUIRED:
                    break
        if all(verdicts):  # some are merely permitted
            values.append(self.value_at(channel, centre, style))
        return (None if None in values else hull_of(values)), len(values)

    # ---- depth ----

    def slope(self):
        """max(|z_x|, |z_y|) per pixel; None where several maps give the depth, 0 where none does."""
        if self.case.basis == "ideal":
            q = self.ideal
        elif self.has_one_map():
            q = self.corner_maps[0]
        else:
            return None
        if q.rows is None:
            return Fraction(0)
        z_x, z_y, _ = combine(q.rows, self.z)
        scale = self.case.depth(Fraction(1)) - self.case.depth(Fraction(0))  # from z/w to window depth
        return abs(scale) * max(abs(z_x), abs(z_y))

    @functools.cached_property
    def offset(self):
        """What the bias adds to all depths."""
        case = self.case
        if case.bias is None:
            return 0
        low, high = sorted((case.near, case.far))
        depths = [min(max(case.depth(z / w), low), high) if w > 0 else high for z, w in zip(self.z, self.w)]
        r = stored_depth.unit(case.depth_bits, case.rules, depths)
        m = self.slope() if case.bias.slope else 0
        assert m is not None, "the slope is undecided: see is_decided()"
        return stored_depth.offset(case.bias, m, r)

    def fragment_depth(self, p):
        """The range of depths at p, biased and clamped; None where no map gives one."""
        value = self.value_at(self.depth_channel, p, "sample")
        if value is None:
            return None
        value = tuple(v + self.offset for v in value)
        if self.case.depth_limits:
            low, high = self.case.depth_limits
            value = tuple(min(max(v, low), high) for v in value)
        return value

    # ---- output ----

    def attribute(self, k, x, y, p, points, verdicts):
        """(value, does it print as a range by rule)."""
        case, channel = self.case, self.channels[k]
        kind, location = case.attributes[k]
        if kind == "flat":
            r = number(case.vertices[self.provoking]["attributes"][k])
            return (r, r), case.ranged
        ranged = self.ranged
        centre = (x + Fraction(1, 2), y + Fraction(1, 2))
        if location == "sample":
            return self.value_at(channel, p, "sample"), ranged
        if location == "center":
            return self.value_at(channel, centre, "center"), ranged
        if case.rules == "d3d":
            value, count = self.centroid_d3d(channel, centre, points, verdicts)
            return value, ranged or count > 1
        covered = [q for q, judgement in zip(points, verdicts) if judgement]
        return self.centroid_any(channel, x, y, covered), True

    def fragments(self, index):
        """By y, x, sample; "range" is what a depth test compares, as numbers."""
        case, found = self.case, []
        for y, x in itertools.product(range(case.height), range(case.width)):
            verdicts = [self.verdict(x, y, offset) for offset in case.samples]
            points = [(x + Fraction(a, 16), y + Fraction(b, 16)) for a, b in case.samples]
            for sample, (p, judgement) in enumerate(zip(points, verdicts)):
                if judgement is FORBIDDEN:
                    continue
                depth = self.fragment_depth(p)
                attributes = [printed(*self.attribute(k, x, y, p, points, verdicts))
                              for k in range(len(case.attributes))]
                found.append({"triangle": index, "x": x, "y": y, "sample": sample, "verdict": judgement[0],
                              "reason": judgement[1], "depth": printed(depth, self.ranged),
                              "attributes": attributes, "range": stored_depth.compared(depth, case.depth_bits)})
        return found


def printed(value, ranged):
    if value is None:
        return None
    if ranged:
        return [str(value[0]), str(value[1])]
    assert value[0] == value[1]
    return str(value[0])


def is_decided(case: dict, clip: bool = False) -> bool:
    """False if a triangle's slope matters to its depths, but several maps give them."""
    parsed = Case(case, clip)
    if parsed.bias is None or parsed.bias.slope == 0:
        return True
    return all(Triangle(parsed, indices).slope() is not None for indices in case["triangles"])


def oracle(case: dict, clip: bool = False) -> dict:
    """The exact fragments of a case; clip=True: of its clip positions rounded once to float32."""
    parsed = Case(case, clip)
    fragments = []
    for index, indices in enumerate(case["triangles"]):
        fragments += Triangle(parsed, indices).fragments(index)
    if parsed.depth_test == "less":
        fragments = stored_depth.depth_test_less(fragments, parsed.depth_clear, parsed.depth_bits)
    for f in fragments:
        del f["range"]
    return {"format": "rastercheck-oracle", "version": 1, "case": case.get("name", ""),
            "fragments": fragments}


if __name__ == "__main__":
    arguments = [a for a in sys.argv[1:] if a != "--clip"]
    if len(arguments) != 1:
        sys.exit("usage: rules.py [--clip] CASE.json")
    with open(arguments[0], encoding="utf-8") as file:
        json.dump(oracle(json.load(file), clip="--clip" in sys.argv[1:]), sys.stdout, indent=1)
    print()
