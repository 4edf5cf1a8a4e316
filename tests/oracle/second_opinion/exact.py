"""Exact numbers, lines and convex polygons in `fractions.Fraction`, for the second opinion."""

import itertools
from fractions import Fraction


def number(x):
    """The exact value of a JSON number (its nearest double) or a C99 hex-float string."""
    return Fraction(float.fromhex(x) if isinstance(x, str) else float(x))


def round_to_float32(x):
    """Nearest float32, ties to even, denormals kept; overflow is an error."""
    if x == 0:
        return Fraction(0)
    exponent = abs(x.numerator).bit_length() - x.denominator.bit_length()
    if Fraction(2) ** exponent > abs(x):
        exponent -= 1
    unit = Fraction(2) ** (max(exponent, -126) - 23)
    rounded = round(x / unit) * unit
    if abs(rounded) >= 2 ** 128:
        raise OverflowError("a clip position overflows float32")
    return rounded


def sign(x):
    return (x > 0) - (x < 0)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def combine(rows, factors):
    """The window-affine function sum factors_i rows_i."""
    return tuple(sum(f * row[k] for f, row in zip(factors, rows)) for k in range(3))


def adjugate(columns):
    """Rows of adj(M): row i is the line through the two vertices other than i, in cyclic order."""
    c0, c1, c2 = columns
    return [cross(c1, c2), cross(c2, c0), cross(c0, c1)]


def rectangle(x_low, x_high, y_low, y_high):
    """The four half planes of a closed rectangle."""
    return [(1, 0, -x_low), (-1, 0, x_high), (0, 1, -y_low), (0, -1, y_high)]


def corners_of(x_low, x_high, y_low, y_high):
    return [(x_low, y_low), (x_high, y_low), (x_high, y_high), (x_low, y_high)]


def clip_polygon(points, half_planes):
    """Vertices of the closed convex polygon `points` within {A u + B v + C >= 0}; [] if they do not meet.

    Touching in one point or along a segment leaves that point or segment (vertices may repeat).
    """
    for line in half_planes:
        values = [dot(line, (u, v, 1)) for u, v in points]
        kept = []
        for i, (p, s) in enumerate(zip(points, values)):
            q, t = points[i - 1], values[i - 1]
            if s * t < 0:  # the side from q to p crosses the line
                k = Fraction(t) / (t - s)
                kept.append((q[0] + k * (p[0] - q[0]), q[1] + k * (p[1] - q[1])))
            if s >= 0:
                kept.append(p)
        points = kept
    return points


def in_convex_hull(p, points):
    """Is p in the closed convex hull: on the right side of every line that has all points on one side?"""
    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    for axis in (0, 1):  # decides where the hull is a segment or a point
        if not min(q[axis] for q in points) <= p[axis] <= max(q[axis] for q in points):
            return False
    return not any(turn(a, b, p) < 0 and all(turn(a, b, q) >= 0 for q in points)
                   for a, b in itertools.permutations(points, 2))


def hull_of(ranges):
    """The smallest range containing all of `ranges`; None if `ranges` is empty."""
    ranges = list(ranges)
    return (min(r[0] for r in ranges), max(r[1] for r in ranges)) if ranges else None
