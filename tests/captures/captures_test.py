#!/usr/bin/env python3
"""Captures programs with RenderDoc, and holds the cases that scripts/rdc2case.py makes of their draws
against what the programs drew.

Usage: captures_test.py SOURCE_DIR RASTERCHECK C_COMPILER GLSLANG CLASS

Without RenderDoc, what needs it ends with exit code 77, or fails if the environment's
RASTERCHECK_REQUIRE_BACKENDS is `all`.
"""

import glob
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # no traces in the source tree

SOURCE, RASTERCHECK, CC, GLSLANG = pathlib.Path(), "", "", ""


def converter():
    """scripts/rdc2case.py as a module."""
    sys.path.insert(0, str(SOURCE / "scripts"))
    import rdc2case
    return rdc2case


def run(*command, folder, **environment):
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True,
                          check=False, env={**os.environ, **environment})


def missing():
    """What a capture needs and this machine lacks, as a sentence; empty if nothing."""
    if shutil.which("renderdoccmd") is None:
        return "no renderdoccmd"
    found = subprocess.run([sys.executable, "-c", "import renderdoc"], check=False, capture_output=True)
    return f"no module renderdoc for {sys.executable}" if found.returncode else ""


class Captured(unittest.TestCase):
    """A program of this folder, compiled, run and captured once."""

    # The driver that draws and replays, whatever graphics cards the machine has.
    DRIVER = {"VK_ICD_FILENAMES": ":".join(glob.glob("/usr/share/vulkan/icd.d/lvp_icd.*.json"))}
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="captures-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.build()
        done = cls.command("renderdoccmd", "capture", "--wait-for-exit", "--capture-file", "frame", "./draw")
        # Before and after what the program prints, renderdoccmd says what it does.
        cls.drawn = json.loads(re.search(r"\{.*\}", done.stdout, re.DOTALL)[0])
        cls.capture, = (file.name for file in cls.folder.glob("frame*.rdc"))
        cls.listed = cls.command(sys.executable, SOURCE / "scripts/rdc2case.py", cls.capture).stdout
        # The event of each draw, in the order of the frame.
        cls.events = [int(line.split()[0]) for line in cls.listed.splitlines()[1:]]

    @classmethod
    def command(cls, *words, code=0):
        done = run(*words, folder=cls.folder, **cls.DRIVER)
        if done.returncode != code:
            raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done

    def convert(self, *words, code=0):
        done = self.command(sys.executable, SOURCE / "scripts/rdc2case.py", *words, code=code)
        self.assertNotIn("Traceback", done.stderr)
        return done

    def case_of(self, number):
        """The case of a draw, and the name of its file."""
        file = f"draw-{number}.json"
        done = self.convert(self.capture, "--draw", self.events[number], "--output", file)
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        return json.loads((self.folder / file).read_text(encoding="utf-8")), file

    def check_state(self, case, number):
        """Holds size, viewport and scissor against what the program said."""
        drawn, width, height = self.drawn["draws"][number], self.drawn["width"], self.drawn["height"]
        self.assertEqual(case["framebuffer"], {"width": width, "height": height, "samples": 1})
        viewport = [case["viewport"][key] for key in ("x", "y", "width", "height", "min_depth", "max_depth")]
        self.assertEqual([float.fromhex(value) for value in viewport],
                         [float.fromhex(value) for value in drawn["viewport"]])
        scissor = dict(zip(("x", "y", "width", "height"), drawn["scissor"]))
        is_all = drawn["scissor"] == [0, 0, width, height]
        self.assertEqual(case.get("scissor"), None if is_all else scissor)

    def check_vertices(self, case, number, triangles, scale=1.0):
        """Holds triangles, given by the program's vertices, against those of a case. float.fromhex() is
        exact, and a product with a power of two as well."""
        numbers = list(map(float.fromhex, self.drawn["draws"][number]["vertices"]))
        rows = [numbers[i:i + 9] for i in range(0, len(numbers), 9)]
        expected = [[[value * scale for value in rows[i][:4]] + rows[i][4:] for i in triangle]
                    for triangle in triangles]
        order = [self.ATTRIBUTES.index(attribute["name"]) for attribute in case["attributes"]]
        self.assertEqual(sorted(order), [0, 1, 2, 3])

        def row(vertex):
            attributes = dict(zip(order, vertex["attributes"]))
            words = [*vertex["position"], *(attributes[i] for i in range(4)), *vertex["clip_distances"]]
            return [float.fromhex(word) for word in words]
        self.assertEqual([[row(case["vertices"][i]) for i in triangle] for triangle in case["triangles"]],
                         expected)

    ATTRIBUTES = ["uv.x", "uv.y", "in_window", "of_first"]

    def check_judged(self, file):
        (self.folder / "none").mkdir(exist_ok=True)
        said = self.command(RASTERCHECK, "run", "--backend", self.BACKEND, "--scene", file, "--cases", 0,
                            "--corpus", "none", "--no-known").stdout
        judged, samples = map(int, re.search(r"(\d+) of (\d+) samples judged \(.*\), all correct", said).groups())
        self.assertGreater(judged, 0)
        return judged / samples

    def check_pixels(self, case, file, number):
        """The driver draws the case as it drew for the program, bit for bit. A case is drawn as one fragment
        for each pixel here: triangles do not overlap, or the nearest one is seen."""
        said = json.loads(self.command(RASTERCHECK, "render", file, "--backend", self.BACKEND, "--json").stdout)
        width, height = self.drawn["width"], self.drawn["height"]
        order = [self.ATTRIBUTES.index(attribute["name"]) for attribute in case["attributes"]]
        picture = [["0x0p+0"] * 4 for _ in range(width * height)]
        for fragment in said["fragments"]:
            pixel = picture[fragment["y"] * width + fragment["x"]]
            self.assertEqual(pixel, ["0x0p+0"] * 4, fragment)
            for at, value in zip(order, fragment["attributes"]):
                pixel[at] = value
        seen = self.drawn["draws"][number]["pixels"]
        self.assertEqual(picture, [seen[i:i + 4] for i in range(0, len(seen), 4)])
        self.assertGreater(len(said["fragments"]), 100)


def interpolations(case):
    return {attribute["name"]: attribute["interpolation"] for attribute in case["attributes"]}


class Vulkan(Captured):
    BACKEND = "vulkan:lavapipe"

    @classmethod
    def build(cls):
        here = SOURCE / "tests/captures"
        cls.command(GLSLANG, "-V", "--vn", "vertex_code", "-o", "draw.vert.h", here / "draw.vert")
        for name in ("noperspective", "smooth"):
            cls.command(GLSLANG, "-V", f"-DLINEAR={name}", "--vn", f"{name}_code", "-o", f"{name}.frag.h",
                        here / "draw.frag")
        cls.command(CC, "-std=c11", "-Wall", "-Wextra", "-Werror", "-I.", here / "draw.c", "-o", "draw",
                    "-lvulkan", "-ldl")

    def test_lists_the_draws(self):
        lines = [line.split() for line in self.listed.splitlines()]
        self.assertEqual([line[1:3] for line in lines],
                         [["topology", "vertices"], ["TriangleStrip", "8"], ["TriangleList", "9"], ["LineList", "2"]])

    def test_a_strip_with_a_restart(self):
        case, file = self.case_of(0)
        self.check_state(case, 0)
        self.assertEqual((case["rules"], case["cull"], case["front_face"]), ("vulkan", "none", "cw"))
        self.assertNotIn("depth_clamp", case)
        self.assertNotIn("depth_test", case)
        self.assertEqual(interpolations(case), {"uv.x": "smooth", "uv.y": "smooth", "in_window": "noperspective",
                                                "of_first": "flat"})
        # Indices 1, 0, 4, 2, restart, 5, 6, 7; the second triangle of a strip begins with its own vertex.
        self.check_vertices(case, 0, [(1, 0, 4), (0, 2, 4), (5, 6, 7)], scale=0.5)
        # Lavapipe may shift the fractional viewport by pixels, so much is open.
        self.assertGreater(self.check_judged(file), 0.3)
        self.check_pixels(case, file, 0)

    def test_a_vertex_behind_the_eye(self):
        case, file = self.case_of(1)
        self.check_state(case, 1)
        self.assertEqual((case["rules"], case["cull"], case["front_face"]), ("vulkan", "back", "cw"))
        self.assertEqual((case["depth_clamp"], case["depth_test"], case["depth_clear"]), (True, "less", "0x1.cp-1"))
        self.assertEqual(interpolations(case)["in_window"], "smooth")
        self.check_vertices(case, 1, [(0, 1, 2), (3, 4, 5), (6, 7, 8)])
        self.assertGreater(self.check_judged(file), 0.9)
        self.check_pixels(case, file, 1)

    def test_all_draws_and_what_is_left_out(self):
        done = self.convert(self.capture, "--all", "--output", "every")
        self.assertEqual(done.stdout, "2 of 3 draws written to every\n")
        reason = f"event {self.events[2]}: left out: it draws a LineList; a case has only triangles\n"
        self.assertEqual(done.stderr, f"rdc2case: {self.capture}: {reason}")
        self.assertEqual({file.name for file in (self.folder / "every").iterdir()},
                         {f"event-{event}.json" for event in self.events[:2]})
        alone = self.convert(self.capture, "--draw", self.events[0])
        self.assertEqual(alone.stdout, (self.folder / f"every/event-{self.events[0]}.json").read_text(encoding="utf-8"))
        alone = self.convert(self.capture, "--draw", self.events[2], code=2)
        self.assertEqual((alone.stdout, alone.stderr), ("", done.stderr))

    def test_bad_input_is_one_line(self):
        (self.folder / "text.rdc").write_text("no capture\n", encoding="utf-8")
        (self.folder / "cut.rdc").write_bytes((self.folder / self.capture).read_bytes()[:5000])
        capture, event = self.capture, self.events[0]
        for words, message in (
                (["none.rdc"], "rdc2case: none.rdc: no such file"),
                (["text.rdc"], "rdc2case: text.rdc: RenderDoc cannot read it: "),
                (["cut.rdc", "--all", "--output", "cut"], "rdc2case: cut.rdc: RenderDoc cannot read it: "),
                ([capture, "--draw", 1],
                 f"rdc2case: {capture}: event 1 is no draw; without --draw, all draws are listed"),
                ([capture, "--draw", event, "--output", "text.rdc/case.json"],
                 f"rdc2case: {capture}: cannot write text.rdc/case.json: "),
                ([capture, "--all", "--output", "text.rdc"], f"rdc2case: {capture}: cannot write text.rdc/")):
            with self.subTest(words):
                done = self.convert(*words, code=2)
                self.assertEqual((done.stdout, len(done.stderr.splitlines())), ("", 1))
                self.assertTrue(done.stderr.startswith(message), done.stderr)
        self.assertIn("--all needs --output FOLDER", self.convert(capture, "--all", code=2).stderr)


if __name__ == "__main__":
    SOURCE, RASTERCHECK, CC, GLSLANG = pathlib.Path(sys.argv[1]).resolve(), *sys.argv[2:5]
    CLASS = sys.argv[5]
    if CLASS != "Cases" and missing():
        print(f"captures_test.py: {missing()}: scripts/setup test installs RenderDoc")
        sys.exit(1 if os.environ.get("RASTERCHECK_REQUIRE_BACKENDS") == "all" else 77)
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
