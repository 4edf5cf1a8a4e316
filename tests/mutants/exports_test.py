#!/usr/bin/env python3
"""Checks that the mutants' modules are separate from the program that loads them: each exports only
its one function and needs no symbol of the project from outside.

Usage: exports_test.py NM MODULES_DIR NAME…
"""

import pathlib
import subprocess
import sys
import unittest

NM, MODULES, NAMES = "", pathlib.Path(), []


def faults(listing):
    """The faults among a module's dynamic symbols, as listed by `nm --dynamic --demangle`."""
    found = []
    exported = set()
    for line in listing.splitlines():
        # ADDRESS KIND NAME; the address is missing if the symbol must come from outside.
        kind, name = line[16:].strip().split(" ", 1)
        if kind not in "Uwv":
            exported.add(name)
        elif "rastercheck" in name:
            found.append(f"expects {name} from outside")
    if exported != {"rastercheck_make_mutant"}:
        found.append(f"exports {sorted(exported)}")
    return found


class Modules(unittest.TestCase):
    def test_export_one_function_and_expect_nothing_of_the_project(self):
        self.assertGreater(len(NAMES), 0)
        for name in NAMES:
            with self.subTest(name):
                listing = subprocess.run([NM, "--dynamic", "--demangle", MODULES / f"{name}.so"],
                                         check=True, capture_output=True, text=True).stdout
                self.assertEqual(faults(listing), [])

    def test_the_check_sees_faults(self):
        entry = "00000000000012e6 T rastercheck_make_mutant\n"
        outside = "                 U operator new(unsigned long)@GLIBCXX_3.4\n"
        self.assertEqual(faults(entry + outside), [])
        for listing in [
            outside,
            entry + "0000000000001300 T rastercheck::rasterizer::draw(int)\n",
            entry + "0000000000001300 W std::vector<float>::push_back(float&&)\n",
            entry + "                 U rastercheck::cases::to_json(rastercheck::cases::Case const&)\n",
        ]:
            self.assertEqual(len(faults(listing)), 1, listing)


if __name__ == "__main__":
    NM, MODULES, NAMES = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
    unittest.main(argv=sys.argv[:1])
