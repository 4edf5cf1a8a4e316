#!/usr/bin/env python3
"""Captures programs with RenderDoc, and holds the cases that scripts/rdc2case.py makes of their draws
against what the programs drew.

Usage: captures_test.py SOURCE_DIR RASTERCHECK C_COMPILER GLSLANG CLASS

Without RenderDoc, what needs it ends with exit code 77, or fails on Debian 12, which has it, if the
environment's RASTERCHECK_REQUIRE_BACKENDS is `all`.
"""

import glob
import json
import math
import os
import pathlib
import re
import shutil
import struct
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


def has_packages():
    """Whether this system is the Debian that scripts/setup installs RenderDoc on."""
    release = pathlib.Path("/etc/os-release")
    return release.exists() and 'VERSION_ID="12"' in release.read_text(encoding="utf-8").splitlines()


def float32(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


class Captured(unittest.TestCase):
    """A program of this folder, compiled, run and captured once."""

    # The driver that draws and replays, whatever graphics cards the machine has.
    DRIVER = {"VK_ICD_FILENAMES": ":".join(glob.glob("/usr/share/vulkan/icd.d/lvp_icd.*.json"))}
    ATTRIBUTES = ["uv.x", "uv.y", "in_window", "of_first"]

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="captures-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "none").mkdir()
        cls.make_headers()
        cls.command(CC, "-std=c11", "-Wall", "-Wextra", "-Werror", "-I.", SOURCE / "tests/captures" / cls.PROGRAM,
                    "-o", "draw", cls.LIBRARY, "-ldl")
        done = cls.command("renderdoccmd", "capture", "--wait-for-exit", "--capture-file", "frame", "./draw")
        # Before and after what the program prints, renderdoccmd says what it does.
        cls.drawn = json.loads(re.search(r"\{.*\}", done.stdout, re.DOTALL)[0])
        cls.capture, = (file.name for file in cls.folder.glob("frame*.rdc"))
        cls.listed = cls.convert(cls.capture).stdout
        # The event of each draw, in the order of the frame.
        cls.events = [int(line.split()[0]) for line in cls.listed.splitlines()[1:]]
        cls.every = cls.convert(cls.capture, "--all", "--output", "every")

    @classmethod
    def make_headers(cls):
        """Makes what the program includes."""

    @classmethod
    def command(cls, *words, code=0):
        done = run(*words, folder=cls.folder, **cls.DRIVER)
        if done.returncode != code:
            raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done

    @classmethod
    def convert(cls, *words, code=0):
        done = cls.command(sys.executable, SOURCE / "scripts/rdc2case.py", *words, code=code)
        if "Traceback" in done.stderr:
            raise AssertionError(done.stderr)
        return done

    def case_of(self, number):
        """The case of a draw, and its file."""
        file = f"every/event-{self.events[number]}.json"
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

    def drawn_row(self, number, vertex):
        """The nine numbers of a vertex that the program gave to its shader."""
        return list(map(float.fromhex, self.drawn["draws"][number]["vertices"][9 * vertex:9 * vertex + 9]))

    def check_vertices(self, case, rows):
        """Holds the rows of a case's triangles against expected ones, bit for bit."""
        order = [self.ATTRIBUTES.index(attribute["name"]) for attribute in case["attributes"]]
        self.assertEqual(sorted(order), [0, 1, 2, 3])

        def row(vertex):
            attributes = dict(zip(order, vertex["attributes"]))
            words = [*vertex["position"], *(attributes[i] for i in range(4)), *vertex["clip_distances"]]
            return [float.fromhex(word) for word in words]
        self.assertEqual([[row(case["vertices"][i]) for i in triangle] for triangle in case["triangles"]], rows)

    def check_judged(self, file):
        """Has the driver draw and judge a case: all is correct. Returns the share that could be judged."""
        said = self.command(RASTERCHECK, "run", "--backend", self.BACKEND, "--scene", file, "--cases", 0,
                            "--corpus", "none", "--no-known").stdout
        found = re.search(r"(\d+)(?: of (\d+))? samples judged.*, all correct", said)
        self.assertIsNotNone(found, said)
        return int(found[1]) / int(found[2] or found[1])

    def check_pixels(self, case, file, number, names=ATTRIBUTES):
        """The driver draws a case as it drew for the program: the same pixels, and in them the same bits of
        these attributes. A pixel has one fragment here: triangles do not overlap, or the nearest is seen."""
        said = json.loads(self.command(RASTERCHECK, "render", file, "--backend", self.BACKEND, "--json").stdout)
        order = [self.ATTRIBUTES.index(attribute["name"]) for attribute in case["attributes"]]
        width, texels = self.drawn["width"], self.drawn["draws"][number]["pixels"]
        seen = {}  # Nothing that is drawn has 0 of its first vertex, as the background has.
        for i in range(0, len(texels), 4):
            if texels[i + 3] != "0x0p+0":
                seen[i // 4 % width, i // 4 // width] = texels[i:i + 4]
        drawn = {}
        for fragment in said["fragments"]:
            at = fragment["x"], fragment["y"]
            self.assertNotIn(at, drawn)
            drawn[at] = [value for _, value in sorted(zip(order, fragment["attributes"]))]
        self.assertGreater(len(seen), 100)
        self.assertEqual(sorted(drawn), sorted(seen))
        compared = [self.ATTRIBUTES.index(name) for name in names]
        for at, values in seen.items():
            self.assertEqual([drawn[at][i] for i in compared], [values[i] for i in compared], at)


def interpolations(case):
    return {attribute["name"]: attribute["interpolation"] for attribute in case["attributes"]}


class Vulkan(Captured):
    BACKEND = "vulkan:lavapipe"
    PROGRAM, LIBRARY = "draw.c", "-lvulkan"

    @classmethod
    def make_headers(cls):
        here = SOURCE / "tests/captures"
        cls.command(GLSLANG, "-V", "--vn", "vertex_code", "-o", "draw.vert.h", here / "draw.vert")
        for name in ("noperspective", "smooth"):
            cls.command(GLSLANG, "-V", f"-DLINEAR={name}", "--vn", f"{name}_code", "-o", f"{name}.frag.h",
                        here / "draw.frag")

    def test_lists_the_draws(self):
        lines = [line.split() for line in self.listed.splitlines()]
        self.assertEqual([line[1:3] for line in lines],
                         [["topology", "vertices"], ["TriangleStrip", "8"], ["TriangleList", "9"], ["LineList", "2"]])

    def test_a_strip_with_a_restart(self):
        case, file = self.case_of(0)
        self.check_state(case, 0)
        self.assertEqual((case["rules"], case["cull"], case["front_face"]), ("vulkan", "none", "ccw"))
        self.assertNotIn("depth_clamp", case)
        self.assertNotIn("depth_test", case)
        self.assertEqual(interpolations(case), {"uv.x": "smooth", "uv.y": "smooth", "in_window": "noperspective",
                                                "of_first": "flat"})
        # Indices 1, 0, 4, 2, restart, 5, 6, 7; the second triangle of a strip begins with its own vertex.
        # The vertex shader halves positions.
        def row(vertex):
            whole = self.drawn_row(0, vertex)
            return [value / 2 for value in whole[:4]] + whole[4:]
        self.check_vertices(case, [[row(i) for i in triangle] for triangle in [(1, 0, 4), (0, 2, 4), (5, 6, 7)]])
        # Lavapipe may shift the fractional viewport by pixels, so much is open.
        self.assertGreater(self.check_judged(file), 0.3)
        self.check_pixels(case, file, 0)

    def test_a_vertex_behind_the_eye(self):
        case, file = self.case_of(1)
        self.check_state(case, 1)
        self.assertEqual((case["rules"], case["cull"], case["front_face"]), ("vulkan", "back", "cw"))
        self.assertEqual((case["depth_clamp"], case["depth_test"], case["depth_clear"]), (True, "less", "0x1.cp-1"))
        self.assertEqual(interpolations(case)["in_window"], "smooth")
        self.check_vertices(case, [[self.drawn_row(1, i) for i in range(at, at + 3)] for at in (0, 3, 6)])
        self.assertGreater(self.check_judged(file), 0.9)
        self.check_pixels(case, file, 1)

    def test_all_draws_and_what_is_left_out(self):
        self.assertEqual(self.every.stdout, "2 of 3 draws written to every\n")
        reason = f"event {self.events[2]}: left out: it draws a LineList; a case has only triangles\n"
        self.assertEqual(self.every.stderr, f"rdc2case: {self.capture}: {reason}")
        self.assertEqual({file.name for file in (self.folder / "every").iterdir()},
                         {f"event-{event}.json" for event in self.events[:2]})

    def test_one_draw(self):
        alone = self.convert(self.capture, "--draw", self.events[0], "--flat", "uv")
        whole = (self.folder / f"every/event-{self.events[0]}.json").read_text(encoding="utf-8")
        whole, count = re.subn(r'("name": "uv\..", "interpolation": )"smooth"', r'\1"flat"', whole)
        self.assertEqual(count, 2)
        self.assertEqual((alone.stdout, alone.stderr), (whole, ""))
        alone = self.convert(self.capture, "--draw", self.events[2], "--output", "lines.json", code=2)
        self.assertEqual((alone.stdout, alone.stderr), ("", self.every.stderr))
        self.assertFalse((self.folder / "lines.json").exists())

    def test_bad_input_is_one_line(self):
        (self.folder / "text.rdc").write_text("no capture\n", encoding="utf-8")
        (self.folder / "cut.rdc").write_bytes((self.folder / self.capture).read_bytes()[:5000])
        capture = self.capture
        for words, message in (
                (["none.rdc"], "rdc2case: none.rdc: no such file"),
                (["text.rdc"], "rdc2case: text.rdc: RenderDoc cannot read it: "),
                (["cut.rdc", "--all", "--output", "cut"], "rdc2case: cut.rdc: RenderDoc cannot read it: "),
                ([capture, "--draw", 1],
                 f"rdc2case: {capture}: event 1 is no draw; without --draw, all draws are listed"),
                ([capture, "--all", "--output", "text.rdc"], f"rdc2case: {capture}: cannot write text.rdc/")):
            with self.subTest(words):
                done = self.convert(*words, code=2)
                self.assertEqual((done.stdout, len(done.stderr.splitlines())), ("", 1))
                self.assertTrue(done.stderr.startswith(message), done.stderr)
        self.assertIn("--all needs --output FOLDER", self.convert(capture, "--all", code=2).stderr)
        self.assertIn("--output needs --draw", self.convert(capture, "--output", "case.json", code=2).stderr)


class OpenGL(Captured):
    BACKEND = "gl:llvmpipe"
    PROGRAM, LIBRARY = "draw_gl.c", "-lepoxy"

    def test_says_what_it_changes(self):
        left_out = [f"event {event}: left out attribute number: not float32" for event in self.events]
        turned = (f"event {self.events[1]}: turned its triangles, whose first vertex provokes; the last bits of "
                  "values may differ")
        self.assertEqual(self.every.stderr.splitlines(),
                         [f"rdc2case: {self.capture}: {line}" for line in [*left_out, turned]])

    def test_a_fan_of_two_instances(self):
        case, file = self.case_of(0)
        self.check_state(case, 0)
        self.assertEqual((case["rules"], case["cull"], case["front_face"]), ("opengl", "none", "ccw"))
        self.assertEqual(interpolations(case), {"uv.x": "smooth", "uv.y": "smooth", "in_window": "noperspective",
                                                "of_first": "flat"})

        def row(vertex, is_mirrored):
            x, *others = self.drawn_row(0, vertex)
            return [-x if is_mirrored else x, *others]
        self.check_vertices(case, [[row(i, is_mirrored) for i in triangle] for is_mirrored in (False, True)
                                   for triangle in [(1, 2, 3), (1, 3, 4)]])
        self.assertGreater(self.check_judged(file), 0.2)
        self.check_pixels(case, file, 0)

    def test_a_strip_whose_first_vertices_provoke(self):
        case, file = self.case_of(1)
        self.check_state(case, 1)
        self.assertEqual((case["rules"], case["cull"], case["front_face"]), ("opengl", "front", "cw"))
        # Indices 0, 1, 3, 2, restart, 0, 1 from vertex 1 on: triangles (1, 2, 4) and (2, 3, 4), in which the
        # first vertex provokes, and so has to come last.
        self.check_vertices(case, [[self.drawn_row(1, i) for i in triangle] for triangle in [(2, 4, 1), (3, 4, 2)]])
        self.assertGreater(self.check_judged(file), 0.9)
        # The driver starts from another vertex, so only what does not vary keeps its bits.
        self.check_pixels(case, file, 1, ["of_first"])


class Depths:
    """The programs with other depth buffers, and with a depth bias: what a class adds to an API's own."""
    # The format in a case, and the depth that is in the buffer of one that is cleared to 0.875, which is
    # 57343.125 steps of 16 bits, and 14680063.125 steps of 24 bits.
    OF_16_BITS = "unorm16", 57343 / 65535
    OF_24_BITS = "unorm24", 14680063 / 16777215
    OF_FLOATS = "float32", 0.875
    BIAS = {"constant": -3.0, "slope": 1.5, "clamp": 0.03125}

    def test_bias_and_format(self):
        for name, (depth_format, clear) in self.FORMATS.items():
            with self.subTest(name):
                self.command("renderdoccmd", "capture", "--wait-for-exit", "--capture-file", name, "./draw", name)
                capture, = (file.name for file in self.folder.glob(f"{name}_*.rdc"))
                done = self.convert(capture, "--draw", self.events[1])
                self.assertNotIn("depth", done.stderr)
                case = json.loads(done.stdout)
                self.assertEqual(case.get("depth_format", "float32"), depth_format)
                self.assertEqual(case["depth_test"], "less")
                self.assertEqual(float.fromhex(case["depth_clear"]), float32(clear))
                self.assertEqual({part: float.fromhex(value) for part, value in case["depth_bias"].items()}, self.BIAS)

    def test_nothing_without_a_depth_test(self):
        self.assertFalse({"depth_format", "depth_bias", "depth_test"} & set(self.case_of(0)[0]))


class VulkanDepths(Depths, Captured):
    PROGRAM, LIBRARY = "draw.c", "-lvulkan"
    FORMATS = {"D16_UNORM": Depths.OF_16_BITS, "X8_D24_UNORM": Depths.OF_24_BITS,
               "D24_UNORM_S8": Depths.OF_24_BITS, "D32_SFLOAT": Depths.OF_FLOATS, "D32_SFLOAT_S8": Depths.OF_FLOATS}
    make_headers = Vulkan.__dict__["make_headers"]


class OpenGLDepths(Depths, Captured):
    PROGRAM, LIBRARY = "draw_gl.c", "-lepoxy"
    FORMATS = {"DEPTH_COMPONENT16": Depths.OF_16_BITS, "DEPTH_COMPONENT24": Depths.OF_24_BITS,
               "DEPTH24_STENCIL8": Depths.OF_24_BITS, "DEPTH_COMPONENT32F": Depths.OF_FLOATS,
               "DEPTH32F_STENCIL8": Depths.OF_FLOATS}


class Cases(unittest.TestCase):
    """What needs no RenderDoc: draws as data, and qualifiers in shaders."""

    maxDiff = None

    def draw(self, **changes):
        """A draw of two triangles by a list, changed."""
        draw = {"name": "a draw", "rules": "vulkan", "size": (8, 4), "samples": 1,
                "viewport": (0.0, 0.0, 8.0, 4.0, 0.0, 1.0), "scissor": None, "topology": "list", "provoking": "first",
                "positions": [(float(i), 0.0, 0.0, 1.0) for i in range(6)], "columns": [], "strips": [list(range(6))]}
        return converter().Draw(**{**draw, **changes})

    def column(self, *values, interpolation="smooth", kind="attribute", name="u"):
        return converter().Column(kind, name, list(map(float, values)), interpolation)

    def triangles(self, **changes):
        return converter().triangles_of(self.draw(**changes))

    def refused(self, **changes):
        with self.assertRaises(converter().Unsayable) as caught:
            converter().case_of(self.draw(**changes))
        return str(caught.exception)

    def test_triangles_are_those_of_the_specifications(self):
        # Vulkan 1.3, 21.1.3 to 21.1.5, and OpenGL 4.6, 10.1.8 to 10.1.10 and table 13.2, of vertices 5, 6, ...
        five = [[5, 6, 7, 8, 9]]
        self.assertEqual(self.triangles(strips=five), [(5, 6, 7)])
        self.assertEqual(self.triangles(topology="strip", strips=five), [(5, 6, 7), (6, 8, 7), (7, 8, 9)])
        self.assertEqual(self.triangles(topology="fan", strips=five), [(6, 7, 5), (7, 8, 5), (8, 9, 5)])
        opengl = {"rules": "opengl", "provoking": "last"}
        self.assertEqual(self.triangles(topology="strip", strips=five, **opengl), [(5, 6, 7), (7, 6, 8), (7, 8, 9)])
        self.assertEqual(self.triangles(topology="fan", strips=five, **opengl), [(5, 6, 7), (5, 7, 8), (5, 8, 9)])
        # Strips begin anew after a restart.
        self.assertEqual(self.triangles(topology="strip", strips=[[0, 1, 2], [], [3, 4], [5, 4, 3, 2]]),
                         [(0, 1, 2), (5, 4, 3), (4, 2, 3)])

    def test_triangles_are_turned_for_flat_attributes_only(self):
        flat, smooth = self.column(*range(6), interpolation="flat"), self.column(*range(6))
        for rules, provoking, expected in (("opengl", "first", (1, 2, 0)), ("vulkan", "last", (2, 0, 1))):
            changes = {"rules": rules, "provoking": provoking, "strips": [[0, 1, 2]]}
            self.assertEqual(self.triangles(columns=[flat], **changes), [expected])
            self.assertEqual(self.triangles(columns=[smooth], **changes), [(0, 1, 2)])

    def test_only_what_lies_in_the_framebuffer_of_a_scissor_counts(self):
        for scissor, expected in (
                (None, None), ((0, 0, 8, 4), None), ((-5, -1, 2**31 - 1, 90), None),
                ((1, 2, 3, 1), (1, 2, 3, 1)), ((-2, 1, 5, 90), (0, 1, 3, 3)), ((9, 9, 5, 5), (8, 4, 0, 0)),
                ((0, 0, 0, 0), (0, 0, 0, 0))):
            case, _ = converter().case_of(self.draw(scissor=scissor))
            inside = expected and dict(zip(("x", "y", "width", "height"), expected))
            self.assertEqual(case.get("scissor"), inside, scissor)

    def test_what_is_not_finite_is_left_out_and_said(self):
        positions = [(0.0, 0.0, 0.0, 1.0)] * 5 + [(0.0, math.nan, 0.0, 1.0)]
        columns = [self.column(*[0.5] * 6), self.column(0, math.inf, 0, 0, 0, 0, name="v"),
                   self.column(0, 0, 0, 0, 0, math.nan, name="w"),
                   self.column(*[0.25] * 6, kind="clip distance", name="c")]
        case, notes = converter().case_of(self.draw(positions=positions, columns=columns))
        self.assertEqual(notes, ["left out 1 triangle: a position is NaN or infinite",
                                 "left out attribute v: has NaN or infinity"])
        # Vertex 5 is not drawn, so its NaN does not matter.
        self.assertEqual([attribute["name"] for attribute in case["attributes"]], ["u", "w"])
        self.assertEqual(case["triangles"], [[0, 1, 2]])
        self.assertEqual(case["vertices"][0]["clip_distances"], ["0x1p-2"])
        many = [self.column(*[0] * 6, name=f"u{i}") for i in range(34)]
        case, notes = converter().case_of(self.draw(columns=many))
        self.assertEqual(len(case["attributes"]), 32)
        self.assertEqual(notes, ["left out attribute u32, u33: a case has 32 at most"])

    def test_depth_bias_and_format(self):
        def of(**changes):
            case, _ = converter().case_of(self.draw(**changes))
            return case.get("depth_bias"), case.get("depth_format")
        self.assertEqual(of(), (None, None))
        self.assertEqual(of(depth_format="unorm24"), (None, "unorm24"))
        self.assertEqual(of(depth_bias=(1.0, -0.5, 0.0)),
                         ({"constant": "0x1p+0", "slope": "-0x1p-1", "clamp": "0x0p+0"}, None))

    def test_a_bias_that_adds_nothing_is_none(self):
        notes, held = [], converter().held_bias
        self.assertIsNone(held((0.0, -0.0, 0.5), notes))
        self.assertEqual(held((1.0, 0.0, math.nan), notes), (1.0, 0.0, 0.0))
        self.assertEqual(held((0.0, 2.0, -1.0), notes), (0.0, 2.0, -1.0))
        self.assertEqual(notes, [])
        self.assertIsNone(held((math.inf, 2.0, 0.0), notes))
        self.assertEqual(notes, ["left out the depth bias: has NaN or infinity"])

    def test_depths_of_buffers(self):
        depths_in, pack = converter().depths_in, struct.pack
        self.assertEqual(depths_in(pack("<3f", 0.5, 0.25, 0.5), "float32", False), {0.5, 0.25})
        self.assertEqual(depths_in(pack("<fIfI", 0.5, 7, 0.5, 9), "float32 stencil", False), {0.5})
        self.assertEqual(depths_in(pack("<3H", 0, 65535, 1), "unorm16", False), {0.0, 1.0, float32(1 / 65535)})
        # A stencil of 0x12 beside the depth.
        self.assertEqual(depths_in(pack("<2I", 0x12ffffff, 0x12000001), "unorm24", False),
                         {1.0, float32(1 / 16777215)})
        self.assertEqual(depths_in(pack("<2I", 0xffffff12, 0x00000112), "unorm24", True),
                         {1.0, float32(1 / 16777215)})

    def test_what_a_case_cannot_hold_is_refused(self):
        for changes, reason in (
                ({"size": (0, 4)}, "its framebuffer is not of 1 to 16384 pixels a side"),
                ({"samples": 32}, "it has 32 samples per pixel"),
                ({"viewport": (0.0, 0.0, 16385.0, 4.0, 0.0, 1.0)}, "its viewport has a side of more than 16384 pixels"),
                ({"viewport": (0.0, 0.0, 8.0, 4.0, 0.0, 1.5)}, "its depth range is not within 0 to 1"),
                ({"strips": [[0, 1], []]}, "it has no triangle")):
            self.assertEqual(self.refused(**changes), reason)

    def test_numbers_keep_their_bits(self):
        numbers = [0.0, -0.0, 1.0, -0.1, 2.0**-149, 2.0**-126, 1 + 2.0**-23, (2 - 2.0**-23) * 2.0**127, 1e9, 3.0e-39]
        numbers = [converter().struct.unpack("<f", converter().struct.pack("<f", number))[0] for number in numbers]
        columns = [self.column(number, *[0.0] * 5, name=f"u{i}") for i, number in enumerate(numbers)]
        case, _ = converter().case_of(self.draw(columns=columns, scissor=(1, 1, 2, 2), depth_clear=0.5,
                                                depth_clamp=True))
        with tempfile.TemporaryDirectory(prefix="captures-") as folder:
            (pathlib.Path(folder) / "case.json").write_text(converter().text_of(case), encoding="utf-8")
            done = run(RASTERCHECK, "import", "case.json", folder=folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        read = json.loads(done.stdout)
        self.assertEqual(read["vertices"][0]["attributes"], case["vertices"][0]["attributes"])
        self.assertEqual({key: read[key] for key in case}, case)
        self.assertEqual(list(map(float.hex, map(float.fromhex, read["vertices"][0]["attributes"]))),
                         list(map(float.hex, numbers)))

    QUALIFIED = """#version 450
        layout(location = 0) flat in vec4 a;
        layout(location = 1) noperspective in mat3 m;
        layout(location = 4) centroid in float c[2];
        layout(location = 6) in Block { vec2 first; flat vec2 second; noperspective centroid float third; } b;
        layout(location = 9) in vec3 plain;
        layout(location = 0) out vec4 color;
        void main() { color = a + vec4(m * plain, c[0] + c[1]) + vec4(b.first, b.second) * b.third MORE; }"""

    def spirv_inputs(self, source):
        with tempfile.TemporaryDirectory(prefix="captures-") as name:
            folder = pathlib.Path(name)
            (folder / "shader.frag").write_text(source, encoding="utf-8")
            done = run(GLSLANG, "-V", "-o", "shader.spv", "shader.frag", folder=folder)
            self.assertEqual(done.returncode, 0, done.stdout)
            return converter().spirv_inputs((folder / "shader.spv").read_bytes(), "main")

    def test_qualifiers_in_spirv(self):
        expected = {0: {"flat"}, **{i: {"noperspective"} for i in (1, 2, 3)}, **{i: {"centroid"} for i in (4, 5)},
                    6: set(), 7: {"flat"}, 8: {"noperspective", "centroid"}, 9: set()}
        self.assertEqual(self.spirv_inputs(self.QUALIFIED.replace("MORE", "")), expected)
        per_sample = {key: words | {"sample"} for key, words in expected.items()}
        self.assertEqual(self.spirv_inputs(self.QUALIFIED.replace("MORE", "* gl_SampleID")), per_sample)
        source = self.QUALIFIED.replace("MORE", "").replace("in vec3", "sample in vec3")
        self.assertEqual(self.spirv_inputs(source), per_sample)

    def test_qualifiers_in_glsl(self):
        inputs = converter().glsl_inputs
        self.assertEqual(inputs(self.QUALIFIED),
                         {"a": {"flat"}, "m": {"noperspective"}, "c": {"centroid"}, "plain": set()})
        self.assertEqual(inputs("in vec4 a; // flat in vec4 b;\n/* flat in\nvec4 c; */ flat\nin highp int d;"
                                "varying vec2 e;"),
                         {"a": set(), "d": {"flat"}, "e": set()})
        self.assertIn("sample", inputs("in vec4 a; sample in vec4 b;")["a"])
        self.assertIn("sample", inputs("in vec4 a; void main() { gl_SampleID; }")["a"])


if __name__ == "__main__":
    SOURCE, RASTERCHECK, CC, GLSLANG = pathlib.Path(sys.argv[1]).resolve(), *sys.argv[2:5]
    CLASS = sys.argv[5]
    if CLASS != "Cases" and missing():
        print(f"captures_test.py: {missing()}: scripts/setup test installs RenderDoc on Debian 12")
        is_required = os.environ.get("RASTERCHECK_REQUIRE_BACKENDS") == "all"
        sys.exit(1 if is_required and has_packages() else 77)
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
