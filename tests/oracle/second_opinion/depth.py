"""Depth as APIs store it, for the second opinion: depth bias and integer formats, in `fractions.Fraction`.

A triangle's depths are moved by

    o = m slope + r constant,   at most clamp if clamp > 0, at least clamp if clamp < 0,

with m = max(|z_x|, |z_y|), z_x and z_y the derivatives of window depth by window x and y (per pixel), and r the
unit of the format: 2^-b for b bits (d3d: the float32 nearest to 1/(2^b - 1)), in float32 2^(e - 23), where 2^e
is the greatest power of two that is not above the greatest depth of the vertices. The sum is clamped, to the
depth range or to [0, 1], and in a format of b bits an integer k nearest to depth (2^b - 1) is stored.

Here are only the choices that a case file asks for; what drivers may choose instead is not said here.
"""

import collections
import math
from fractions import Fraction

from exact import number, round_to_float32

BITS = {"float32": 0, "unorm16": 16, "unorm24": 24}

# constant and slope without unit, clamp in units of depth; 0: no clamp.
Bias = collections.namedtuple("Bias", "constant slope clamp")


def read_bias(case):
    """The bias of a case file; None if nothing is added to any depth."""
    given = case.get("depth_bias", {})
    bias = Bias(*(number(given.get(key, 0)) for key in ("constant", "slope", "clamp")))
    return bias if bias.constant != 0 or bias.slope != 0 else None


def exponent(z):
    """The integer e with 2^e <= z < 2^(e + 1), for z > 0."""
    e = z.numerator.bit_length() - z.denominator.bit_length()
    return e if Fraction(2) ** e <= z else e - 1


def unit(bits, rules, vertex_depths):
    """r. vertex_depths: window depths, each clamped to the depth range."""
    if bits:
        return round_to_float32(Fraction(1, 2 ** bits - 1)) if rules == "d3d" else Fraction(1, 2 ** bits)
    greatest = max(vertex_depths)
    return Fraction(2) ** (exponent(greatest) - 23) if greatest > 0 else Fraction(0)


def offset(bias, m, r):
    """o, for a slope m of the triangle (pixels^-1)."""
    o = m * bias.slope + r * bias.constant
    if bias.clamp > 0:
        return min(o, bias.clamp)
    return max(o, bias.clamp) if bias.clamp < 0 else o


def stored(depth, bits, store="nearest"):
    """(least, greatest) integer that a depth in [0, 1] may become.

    store: "nearest" (two integers only half-way between them), "nearly_nearest" (at most 0.6 away) or "either"
    neighbour. Integers become themselves.
    """
    steps = depth * (2 ** bits - 1)
    if store == "either":
        return math.floor(steps), math.ceil(steps)
    reach = {"nearest": Fraction(1, 2), "nearly_nearest": Fraction(3, 5)}[store]
    return math.ceil(steps - reach), math.floor(steps + reach)


def handed_over(k, bits):
    """The float32 that a fragment has for the stored integer k."""
    return round_to_float32(Fraction(k, 2 ** bits - 1))


def compared(depths, bits):
    """What a depth test compares, for a range of depths or None: integers, if such are stored."""
    if not bits or depths is None:
        return depths
    return stored(depths[0], bits)[0], stored(depths[1], bits)[1]


def depth_test_less(fragments, clear, bits):
    """Keeps fragments that may be nearest; those not surely nearest become permitted.

    clear: the depth buffer's initial value; None: 1 or anything beyond it.
    """
    least_clear, greatest_clear = compared((1, 1) if clear is None else (clear, clear), bits)

    def nearer(a, b):  # surely, in any choice of values; a tie goes to the earlier triangle
        if a["range"] is None or b["range"] is None:
            return False
        high, low = a["range"][1], b["range"][0]
        return high < low or (high == low and a["triangle"] < b["triangle"])

    def lies_before(a):  # the buffer's beginning, surely
        return a["range"] is not None and a["range"][1] < least_clear

    if clear is not None:
        fragments = [f for f in fragments if f["range"] is None or f["range"][0] < greatest_clear]
    groups = {}
    for f in fragments:
        groups.setdefault((f["y"], f["x"], f["sample"]), []).append(f)
    kept = []
    for f in fragments:
        others = [g for g in groups[f["y"], f["x"], f["sample"]] if g is not f]
        if any(g["verdict"] == "required" and nearer(g, f) for g in others):
            continue
        if f["verdict"] == "required" and not (lies_before(f) and all(nearer(f, g) for g in others)):
            f = {**f, "verdict": "permitted", "reason": "depth"}
        kept.append(f)
    return kept
