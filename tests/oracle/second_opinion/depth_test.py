#!/usr/bin/env python3
"""Checks depth.py, and rules.py where it uses depth.py, against numbers calculated by hand.

Whole cases are in ../bias_cases, whose README.md has the calculations; their depths are in ../bias_depths.json.
"""

import json
import os
import sys
import unittest
from fractions import Fraction

HERE = os.path.dirname(os.path.abspath(__file__))
CASES = os.path.join(HERE, os.pardir, "bias_cases")
DEPTHS = os.path.join(HERE, os.pardir, "bias_depths.json")
sys.dont_write_bytecode = True  # leave the source tree as it is
sys.path.insert(0, HERE)

import depth  # noqa: E402
import rules  # noqa: E402


def read_json(name):
    with open(os.path.join(CASES, name), encoding="utf-8") as file:
        return json.load(file)


class Exponent(unittest.TestCase):
    def test_is_that_of_the_power_of_two_not_above(self):
        for z, e in ((1, 0), (Fraction(1, 2), -1), (Fraction(3, 4), -1), (Fraction(1, 3), -2),
                     (1 - Fraction(1, 2 ** 60), -1), (Fraction(1, 5000000), -23), (Fraction(1, 2 ** 149), -149),
                     (Fraction(2 ** 70 + 1, 2 ** 70), 0), (Fraction(7, 2), 1)):
            self.assertEqual(depth.exponent(Fraction(z)), e, z)


class Unit(unittest.TestCase):
    def test_of_an_integer_format(self):
        self.assertEqual(depth.unit(16, "vulkan", []), Fraction(1, 65536))
        self.assertEqual(depth.unit(24, "opengl", []), Fraction(1, 16777216))
        # 1/65535 = 2^-16 (1 + 2^-16 + 2^-32 + ...), of which a float keeps 24 bits; likewise with 24.
        self.assertEqual(depth.unit(16, "d3d", []), Fraction(65537, 2 ** 32))
        self.assertEqual(depth.unit(24, "d3d", []), Fraction(1, 2 ** 24) + Fraction(1, 2 ** 47))

    def test_of_floats_belongs_to_the_greatest_depth(self):
        self.assertEqual(depth.unit(0, "d3d", [Fraction(0), Fraction(1, 2), Fraction(1, 8)]), Fraction(1, 2 ** 24))
        self.assertEqual(depth.unit(0, "vulkan", [Fraction(0), Fraction(1), Fraction(0)]), Fraction(1, 2 ** 23))
        self.assertEqual(depth.unit(0, "vulkan", [Fraction(0)] * 3), 0)


class Offset(unittest.TestCase):
    def test_is_limited_on_the_side_of_the_clamp_only(self):
        def offset(slope, clamp):
            return depth.offset(depth.Bias(Fraction(0), Fraction(slope), Fraction(clamp)), Fraction(1, 4), Fraction(1))

        self.assertEqual(offset(2, 0), Fraction(1, 2))
        self.assertEqual(offset(2, Fraction(1, 8)), Fraction(1, 8))
        self.assertEqual(offset(-2, Fraction(1, 8)), Fraction(-1, 2))
        self.assertEqual(offset(-2, Fraction(-1, 8)), Fraction(-1, 8))
        self.assertEqual(offset(2, Fraction(-1, 8)), Fraction(1, 2))

    def test_is_the_sum_of_both_parts(self):
        bias = depth.Bias(Fraction(3), Fraction(-2), Fraction(0))
        self.assertEqual(depth.offset(bias, Fraction(1, 4), Fraction(1, 8)), Fraction(-1, 8))

    def test_is_no_bias_without_constant_and_slope(self):
        self.assertIsNone(depth.read_bias({"depth_bias": {"clamp": 0.5}}))
        self.assertIsNone(depth.read_bias({}))
        self.assertEqual(depth.read_bias({"depth_bias": {"slope": "0x1p-3"}}), (0, Fraction(1, 8), 0))


class Stored(unittest.TestCase):
    def stored(self, steps, store):
        return depth.stored(Fraction(steps) / 65535, 16, store)

    def test_integers_stay(self):
        for store in ("nearest", "nearly_nearest", "either"):
            for k in (0, 1, 40000, 65535):
                self.assertEqual(self.stored(k, store), (k, k))

    def test_between_integers(self):
        self.assertEqual(self.stored(Fraction(21, 2), "nearest"), (10, 11))
        self.assertEqual(self.stored(Fraction(1049, 100), "nearest"), (10, 10))
        self.assertEqual(self.stored(Fraction(1051, 100), "nearest"), (11, 11))
        self.assertEqual(self.stored(Fraction(1041, 100), "nearly_nearest"), (10, 11))
        self.assertEqual(self.stored(Fraction(104, 10), "nearly_nearest"), (10, 11))
        self.assertEqual(self.stored(Fraction(1039, 100), "nearly_nearest"), (10, 10))
        self.assertEqual(self.stored(Fraction(1001, 100), "either"), (10, 11))

    def test_floats_tell_all_numbers_of_a_format_apart(self):
        numbers = [depth.handed_over(k, 16) for k in range(65536)]
        self.assertEqual(len(set(numbers)), 65536)
        self.assertEqual(numbers, sorted(numbers))
        around_one = [depth.handed_over(k, 24) for k in range(2 ** 24 - 1000, 2 ** 24)]
        self.assertEqual(len(set(around_one)), 1000)
        self.assertEqual((numbers[-1], around_one[-1]), (1, 1))


class WholeCases(unittest.TestCase):
    def test_have_the_depths_calculated_by_hand(self):
        expected = read_json(DEPTHS)
        files = sorted(name for name in os.listdir(CASES) if name.endswith(".json"))
        self.assertEqual(files, sorted(expected))
        for name, fragments in expected.items():
            with self.subTest(name):
                found = rules.oracle(read_json(name))["fragments"]
                self.assertEqual([(f["triangle"], f["x"], f["y"], f["verdict"], f["depth"]) for f in found],
                                 [(f["triangle"], f["x"], f["y"], "required", f["depth"]) for f in fragments])

    def test_store_the_numbers_calculated_by_hand(self):
        checked = 0
        for name, fragments in read_json(DEPTHS).items():
            bits = depth.BITS[read_json(name).get("depth_format", "float32")]
            for f in fragments:
                self.assertEqual("nearest" in f, bits > 0, name)
                for store in ("nearest", "nearly_nearest", "either") if bits else ():
                    least, greatest = depth.stored(Fraction(f["depth"]), bits, store)
                    self.assertEqual(list(range(least, greatest + 1)), f[store], (name, store))
                    checked += 1
        self.assertGreater(checked, 0)

    def test_without_a_known_slope_are_undecided(self):
        case = read_json("edge-on.json")
        self.assertTrue(rules.is_decided(case))
        case["coverage"] = {"subpixel_bits": 8, "position_error": 1}
        self.assertTrue(rules.is_decided(case))  # depths are those of the ideal triangle
        case["basis"] = "snapped"
        self.assertFalse(rules.is_decided(case))
        case["depth_bias"] = {"constant": 1}
        self.assertTrue(rules.is_decided(case))

    def test_take_the_slope_from_the_placed_triangle(self):
        case = read_json("slope-with-negative-clamp.json")
        case.update(depth_bias={"slope": 1}, depth_format="float32", basis="snapped",
                    coverage={"subpixel_bits": 0})
        # The corner at 8 pixels moves to 7.6: placed at 8 again, so that depth still grows by 1/8 per pixel.
        case["vertices"][1]["position"][0] = "0x1.666666p+1"
        depths = [f["depth"] for f in rules.oracle(case)["fragments"]]
        self.assertEqual(depths, ["3/16", "5/16", "7/16", "9/16"])


if __name__ == "__main__":
    unittest.main()
