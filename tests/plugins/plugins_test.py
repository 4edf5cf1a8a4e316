#!/usr/bin/env python3
"""Judges the plugins of docs/examples/plugin as a user would: from the command line.

Usage: plugins_test.py SOURCE_DIR RASTERCHECK CMAKE C_COMPILER CXX_COMPILER PATCH CASES CLASS

CASES is the number of random cases of each law in a campaign on a correct plugin.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, RASTERCHECK, CMAKE, CC, CXX, PATCH, CASES = pathlib.Path(), "", "", "", "", "", 0

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]
COVERAGE, VALUES = "coverage-obeys-the-contract", "values-stay-within-the-bound"
OCCLUSION = "what-is-visible-is-not-called-occluded"
PICTURE = "a-picture-is-what-its-fragments-leave"
# The properties that judge the pictures of docs/examples/plugin/picture.c.
PICTURES = [PICTURE, "additive-blending-counts-overdraw", "texels-are-those-of-the-exact-coordinates",
            "discarding-draws-what-keeping-the-kept-texels-draws"]
VERTEX_ORDER = "vertex-order-changes-nothing-beyond-the-bound"
# A pattern that matches exactly these three laws.
THREE_LAWS = "[cv]*-the-[bc]o*"
RANDOM_CASES = 5
# Of a program, whose interpreter may take long.
PROGRAM_CASES = 5

# The fault, the class of its counterexamples (None: the plugin cannot be loaded), and the message.
FAULTS = [
    ("crash", "crash", "its process was killed by signal Segmentation fault while drawing; its last output: "
                       "the plugin touched address 0x0, which is in none of its arrays"),
    ("hang", "hang", "its process did not answer within 0.2 s (--timeout) while drawing"),
    ("out_of_bounds", "crash", "the plugin touched output->coverage beyond its end, by 1 byte"),
    ("before_the_beginning", "failed", "draw() wrote before the beginning of output->coverage"),
    ("says_and_aborts", "crash", "its process was killed by signal Aborted while drawing; its last output: "
                                 "assertion failed: the triangle is narrow"),
    ("forks", "crash", "its process was killed by signal Aborted while drawing"),
    ("writes_input", "crash", "the plugin wrote to draw->positions, which it may only read"),
    ("out_of_memory", "crash", "its process was killed by signal Aborted while drawing"),
    ("leak", "failed", "it leaks memory: each time this case is drawn again, memory use grows"),
    ("nan", "not a number", "depth was drawn as NaN"),
    ("nothing", "missing", "the sample is not drawn and must be"),
    ("coverage_two", "failed", "draw() wrote 2 to output->coverage, which must be 0 or 1"),
    ("wrong_triangle", "failed", "draw() wrote 7 to output->triangle, which must be below 1"),
    ("throws", "failed", "draw() threw an exception: vector::_M_range_check"),
    ("fails", "failed", "draw() reported failed: no room for so wide a triangle"),
    ("unknown_result", "failed", "draw() returned 99, which is not RASTERCHECK_OK"),
    ("rounding_mode", "failed", "draw() changed the rounding mode"),
    ("wrong_contract", "extra", "the sample is drawn and must not be (outside)"),
    ("invalid_contract", None, "its contract's subpixel_bits is 99, but must be from 0 to 16"),
    ("fast_math", None, "loading it changes the rounding mode or the treatment of subnormal numbers; "
                        "link it without -ffast-math"),
    ("wrong_abi", None, "it was compiled for plugin ABI 99, but this RasterCheck has ABI 1"),
    ("null_plugin", None, "rastercheck_plugin_get() returned a null pointer"),
    ("no_function", None, "does not export the function rastercheck_plugin_get()"),
]
# Plugins that draw narrow triangles correctly, and plugins that only draw wrong values.
WITHOUT_FAULT_WHERE_NARROW = {"before_the_beginning", "crash", "forks", "hang", "says_and_aborts", "writes_input", "out_of_memory", "nan", "fails"}
ONLY_VALUES = {"nan"}


def case(corners):
    """A case of one triangle with these NDC corners in 8×8 pixels, with snapped coverage and r =
    window x."""
    return {"format": "rastercheck-case", "version": 1, "name": "a triangle",
            "framebuffer": {"width": 8, "height": 8}, "viewport": {"x": 0, "y": 0, "width": 8, "height": 8},
            "rules": "vulkan", "coverage": {"subpixel_bits": 8}, "basis": "snapped",
            "attributes": [{"name": "r"}],
            "vertices": [{"position": [x, y, (y + 1) / 2, 1], "attributes": [4 * (x + 1)]}
                         for x, y in corners],
            "triangles": [[0, 1, 2]]}


WIDE = case([(-1, -1), (1, -1), (-1, 1)])
NARROW = case([(-0.25, -1), (0.375, -1), (-0.25, 1)])


class PluginTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="plugins-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "include/rastercheck").mkdir(parents=True)
        for header in ("plugin.h", "barycentrics.h"):
            shutil.copy(SOURCE / "backends/plugin" / header, self.folder / "include/rastercheck")
        for name, text in (("wide", WIDE), ("narrow", NARROW)):
            self.write(f"corpus/{name}.json", json.dumps(text))

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def run_command(self, *command):
        return subprocess.run([str(word) for word in command], cwd=self.folder, capture_output=True,
                              text=True, check=False)

    def rastercheck(self, code, *arguments):
        """The program's output on both streams; checks that its exit code is `code`."""
        done = self.run_command(RASTERCHECK, *arguments)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done.stdout + done.stderr

    def build(self, source, name, *options):
        """Builds a plugin and returns its specification."""
        is_c = source.suffix == ".c"
        done = self.run_command(CC if is_c else CXX, "-std=c11" if is_c else "-std=c++20", "-O2", *WARNINGS,
                                "-fPIC", "-shared", "-I", self.folder / "include", *options, source,
                                "-o", f"{name}.so", "-lm")
        self.assertEqual((done.returncode, done.stderr), (0, ""), source)
        return f"plugin:./{name}.so"

    def rows(self, output):
        """The rows of a run's table, by law and backend."""
        run = json.loads((self.folder / output / "run.json").read_text(encoding="utf-8"))
        table = {}
        for record in run["records"]:
            if record["attribute_kind"] == "coverage":
                row = table.setdefault((record["property"], record["backend"]), {})
                for key, count in record["cases"].items():
                    row[key] = row.get(key, 0) + count
        return table

    def counterexamples(self, output):
        """The saved counterexamples and where they were found."""
        return {file: json.loads(file.read_text(encoding="utf-8"))["found"]
                for file in sorted((self.folder / output / "counterexamples").glob("*.json"))}


class Little(PluginTest):
    def check(self, source, cases):
        plugin = self.build(source, "little")
        table = self.rastercheck(0, "run", "--backend", plugin, "--seed", 1, "--cases", cases, "--all")
        self.assertNotIn("Not reached", table)
        held = re.findall(r" held$", table, re.MULTILINE)
        self.assertGreater(len(held), 25, table)
        # The plugin lacks some requested features, but no more than that.
        checked = self.rows("rastercheck-out")[COVERAGE, plugin]
        self.assertGreater(checked["checked"], checked["not_applicable"])

        # Calculated by hand: the pixels whose centre lies above the diagonal, with r = x of the
        # centre.
        file = self.folder / "corpus/wide.json"
        drawn = json.loads(self.rastercheck(0, "render", file, "--backend", plugin, "--json"))
        self.assertEqual([(f["triangle"], f["x"], f["y"], f["sample"], float.fromhex(f["depth"]),
                           [float.fromhex(value) for value in f["attributes"]])
                          for f in drawn["fragments"]],
                         [(0, x, y, 0, (y + 0.5) / 8, [x + 0.5])
                          for y in range(8) for x in range(8) if x + y + 1 < 8])
        self.assertIn(f"{COVERAGE}, {plugin}: held", self.rastercheck(0, "replay", file, "--backend", plugin))

        listed = self.rastercheck(0, "list", "backends", "--backend", plugin)
        self.assertIn("little 1.0: coverage snapped to 8 subpixel bits", listed)
        self.assertIn("not supported: vertices with w <= 0, attributes at centres of several samples", listed)

    def test_c_holds_what_it_promises(self):
        self.check(SOURCE / "docs/examples/plugin/little.c", CASES)

    def test_cxx_holds_what_it_promises(self):
        self.check(SOURCE / "docs/examples/plugin/little.cpp", CASES // 4)

    def test_says_what_it_does_not_draw(self):
        plugin = self.build(SOURCE / "docs/examples/plugin/little.c", "little")
        behind = case([(-1, -1), (1, -1), (-1, 1)])
        behind["vertices"][0]["position"][3] = -1
        behind_file = self.write("behind.json", json.dumps(behind))
        self.assertIn("its contract lacks vertices with w <= 0",
                      self.rastercheck(2, "render", behind_file, "--backend", plugin))
        far_file = self.write("far.json", json.dumps(case([(-1, -1), (65536, -1), (-1, 1)])))
        self.assertIn("draw() reported unsupported: a vertex beyond the guard band",
                      self.rastercheck(2, "render", far_file, "--backend", plugin))
        # Exit code 0: laws that change the vertices do apply to the first case.
        for code, file in ((0, behind_file), (5, far_file)):
            self.assertIn(f"{COVERAGE}, {plugin}: not applicable",
                          self.rastercheck(code, "replay", file, "--backend", plugin))


class Lines(PluginTest):
    def test_holds_what_it_promises(self):
        plugin = self.build(SOURCE / "docs/examples/plugin/lines.c", "lines")
        table = self.rastercheck(0, "run", "--backend", plugin, "--seed", 1, "--cases", CASES, "--all",
                                 "--property", COVERAGE, "--property", "*line*", "--property", "*point*")
        held = re.findall(r"^(\S+) .* held$", table, re.MULTILINE)
        rows = self.rows("rastercheck-out")
        for law in ("lines-obey-the-contract", "points-obey-the-contract", "points-that-touch-part-the-samples",
                    "a-point-at-a-centre-covers-its-pixel", "bresenham-lines-stay-near-the-diamonds"):
            self.assertIn(law, held)
            self.assertGreater(rows[law, plugin]["checked"], 0, law)
        self.assertNotIn(COVERAGE, held)
        self.assertIn(", lines, points;", self.rastercheck(0, "list", "backends", "--backend", plugin))

    def test_is_not_asked_for_what_it_does_not_draw(self):
        plugin = self.build(SOURCE / "docs/examples/plugin/lines.c", "lines")
        little = self.build(SOURCE / "docs/examples/plugin/little.c", "little")
        lines = self.write("lines.json", json.dumps(
            {key: value for key, value in case([(-1, -1), (1, -1), (-1, 1)]).items() if key != "triangles"}
            | {"lines": [[0, 1]], "line_mode": "rectangular"}))
        self.assertIn("draw() reported unsupported: lines that are not Bresenham's",
                      self.rastercheck(2, "render", lines, "--backend", plugin))
        self.assertIn("its contract lacks lines", self.rastercheck(2, "render", lines, "--backend", little))


class Culler(PluginTest):
    def occlusion(self):
        return self.build(SOURCE / "docs/examples/plugin/occlusion.c", "occlusion")

    def test_holds_what_it_promises(self):
        plugin = self.occlusion()
        table = self.rastercheck(0, "run", "--backend", plugin, "--property", OCCLUSION, "--seed", 1,
                                 "--cases", CASES, "--all", "--keep-cases")
        self.assertIn(" held", table)
        self.assertNotIn("Not reached", table)
        self.assertGreater(self.rows("rastercheck-out")[OCCLUSION, plugin]["checked"], CASES)

    def test_says_that_it_draws_nothing(self):
        plugin = self.occlusion()
        self.assertIn("draw() reported unsupported: an occlusion culler draws nothing",
                      self.rastercheck(2, "render", "corpus/wide.json", "--backend", plugin))
        self.assertIn(f"{COVERAGE}, {plugin}: not applicable",
                      self.rastercheck(0, "replay", "corpus/wide.json", "--backend", plugin))

    def test_faults_of_a_query_are_found(self):
        """The fault, what replaces the end of the query, and what is said of it."""
        for name, code, verdict, message in (
                ("crash", "free(NULL); *(volatile int*)0 = 1;", "crash", "Segmentation fault"),
                ("fails", "strncpy(answer->message, \"too wide\", answer->message_size - 1); return RASTERCHECK_FAILED;",
                 "failed", "query() reported failed: too wide"),
                ("neither", "answer->visibility = 7; return RASTERCHECK_OK;", "failed",
                 "query() wrote 7 to answer->visibility"),
                ("leak", "if (malloc(100) == NULL) return RASTERCHECK_FAILED;", "failed", "it leaks memory"),
                ("writes_input", "((float*)(size_t)draw->positions)[0] = 1;", "crash",
                 "the plugin wrote to query->occludee->positions, which it may only read"),
                ("message", "answer->message[answer->message_size] = 1;", "crash",
                 "the plugin touched answer->message beyond its end, by 1 byte")):
            with self.subTest(name):
                whole = (SOURCE / "docs/examples/plugin/occlusion.c").read_text(encoding="utf-8")
                self.assertEqual(whole.count("  free(b.depth);\n"), 1)
                source = self.write(f"{name}.c", whole.replace("  free(b.depth);\n", f"  free(b.depth);\n  {code}\n"))
                plugin = self.build(source, name)
                said = self.rastercheck(1, "run", "--backend", plugin, "--property", OCCLUSION, "--seed", 1,
                                        "--corpus", "corpus", "--cases", RANDOM_CASES, "--shrink-tries", 40,
                                        "--output", name)
                self.assertIn(message, said)
                self.assertIn(verdict, {one["verdict"] for one in self.counterexamples(name).values()})


class Pictures(PluginTest):
    SOURCE_FILE = "docs/examples/plugin/picture.c"

    def test_holds_what_it_promises(self):
        plugin = self.build(SOURCE / self.SOURCE_FILE, "picture")
        table = self.rastercheck(0, "run", "--backend", plugin, "--seed", 1, "--cases", CASES, "--all")
        self.assertNotIn("Not reached", table)
        rows = self.rows("rastercheck-out")
        for law in (COVERAGE, VALUES, *PICTURES):
            self.assertGreater(rows[law, plugin]["checked"], 0.6 * CASES, law)

    def test_is_not_judged_by_pictures_that_it_refuses(self):
        whole = (SOURCE / self.SOURCE_FILE).read_text(encoding="utf-8")
        promise = "    .max_attributes = MOST_ATTRIBUTES,\n"
        self.assertEqual(whole.count(promise), 1)
        source = self.write("promises.c", whole.replace(promise, promise + "    .bilinear = 8,\n"))
        plugin = self.build(source, "promises")
        for law, why in (("filtered-colours-stay-within-the-bound", "filtered textures"),
                         ("differences-across-quads-stay-within-the-bound", "differences across quads, facing")):
            said = self.rastercheck(5, "run", "--backend", plugin, "--property", law, "--seed", 1,
                                    "--cases", RANDOM_CASES, "--all")
            self.assertIn("1 property not checked", said)
            self.assertIn(f"draw_picture() reported unsupported: {why}", said)

    def test_faults_of_a_picture_are_found(self):
        """The fault, what replaces the end of draw_picture(), and what is said of it."""
        for name, code, verdict, message in (
                ("crash", "*(volatile int*)0 = 1;", "crash", "Segmentation fault"),
                ("fails", 'strncpy(picture->message, "too wide", picture->message_size - 1);'
                          " return RASTERCHECK_FAILED;", "failed", "draw_picture() reported failed: too wide"),
                ("unwritten", "", "failed",
                 "draw_picture() wrote nothing to picture->depth (pixel 0, 0, sample 0)"),
                ("no_byte", "picture->color[0] = 0.3F;", "failed",
                 "draw_picture() wrote 0.3 to picture->color, which is not the float k / 255 of any byte k"),
                ("leak", "if (malloc(100) == NULL) return RASTERCHECK_FAILED;", "failed", "it leaks memory"),
                ("writes_input", "((float*)(size_t)draw->positions)[0] = 1;", "crash",
                 "the plugin wrote to draw->positions, which it may only read"),
                ("beyond", "picture->depth[(size_t)picture->width * picture->height * picture->samples] = 1;", "crash",
                 "the plugin touched picture->depth beyond its end, by 1 byte")):
            with self.subTest(name):
                whole = (SOURCE / self.SOURCE_FILE).read_text(encoding="utf-8")
                end = "  free(b.depth);\n"
                self.assertEqual(whole.count(end), 1)
                source = whole.replace(end, f"{end}  {code}\n")
                if name == "unwritten":
                    source = whole.replace("if (why == NULL) write_picture", "if (why != NULL) write_picture")
                plugin = self.build(self.write(f"{name}.c", source), name)
                said = self.rastercheck(1, "run", "--backend", plugin, "--property", PICTURE, "--seed", 1,
                                        "--cases", 8 * RANDOM_CASES, "--shrink-tries", 40, "--output", name)
                self.assertIn(message, said)
                self.assertIn(verdict, {one["verdict"] for one in self.counterexamples(name).values()})


# What a plugin that breaks its one promise is caught by.
BROKEN = {
    "clipped_at_viewport": None,  # these four have no such promise of their own
    "depth_only": None,
    "ids_and_barycentrics": None,
    "gpu_like": COVERAGE,
    "float_edges": COVERAGE,
    "integer_coordinates": COVERAGE,
    "corner_samples": COVERAGE,
    "inclusive_edges": COVERAGE,
    "console": COVERAGE,
    "conservative": COVERAGE,
    "colours_8_bit": VALUES,
    "occluder_depths": VALUES,
}


# How many properties judge a plugin, at least. Those that compare values with coverage at sample
# points do not judge conservative coverage.
FEWEST_PROPERTIES = {"conservative": 12}


class Typical(PluginTest):
    def test_holds_what_it_promises(self):
        sources = sorted(SOURCE.glob("tests/plugins/typical/*.c"))
        self.assertEqual({source.stem for source in sources}, BROKEN.keys())
        for source in sources:
            with self.subTest(source.stem):
                self.check(source)

    def check(self, source):
        plugin = self.build(source, source.stem)
        cases = max(CASES // 8, 60)
        self.rastercheck(0, "run", "--backend", plugin, "--seed", 1, "--cases", cases, "--output", source.stem)
        rows = self.rows(source.stem)
        # Cases are fitted to the plugin: for most laws that apply, most random cases are judged.
        judged = [row for row in rows.values() if row["checked"] > 0]
        self.assertGreaterEqual(len(judged), FEWEST_PROPERTIES.get(source.stem, 16))
        self.assertGreaterEqual(rows[COVERAGE, plugin]["checked"], 0.6 * cases)

    def test_is_caught_if_it_breaks_its_promise(self):
        for name, law in BROKEN.items():
            if law is None:
                continue
            with self.subTest(name):
                plugin = self.build(SOURCE / f"tests/plugins/typical/{name}.c", name, "-DBREAKS")
                said = self.rastercheck(1, "run", "--backend", plugin, "--property", law, "--seed", 1, "--cases", 60,
                                        "--output", name, "--shrink-tries", 20)
                self.assertIn("; shrunk in ", said)
                self.assertEqual({one["property"] for one in self.counterexamples(name).values()}, {law})


def source_of(fault):
    (file,) = SOURCE.glob(f"docs/examples/plugin/faulty/{fault}.c*")
    return file


class Faulty(PluginTest):
    def campaign(self, code, name):
        plugin = self.build(source_of(name), name)
        return plugin, self.rastercheck(
            code, "run", "--backend", plugin, "--backend", "cpu", "--property", THREE_LAWS, "--seed", 1,
            "--corpus", "corpus", "--cases", RANDOM_CASES, "--shrink-tries", 40, *self.timeout(name),
            "--output", name)

    def timeout(self, name):
        """Options with a short time-out for the plugin that hangs; the others keep the default, so
        that they do not fail on a busy machine."""
        return ["--timeout", 0.2] if name == "hang" else []

    def test_every_fault_is_found_and_the_campaign_goes_on(self):
        for name, verdict, message in FAULTS:
            with self.subTest(name):
                plugin, said = self.campaign(1 if verdict else 4, name)
                self.assertIn(message, said)
                if verdict is None:
                    self.assertEqual(said.count("\n"), 1, said)
                    continue
                table = self.rows(name)
                laws = [VALUES, VERTEX_ORDER] if name in ONLY_VALUES else [COVERAGE, VERTEX_ORDER]
                for law in (COVERAGE, VALUES, VERTEX_ORDER):
                    mine, ours = table[law, plugin], table[law, "cpu"]
                    self.assertEqual(mine["checked"] + mine["not_applicable"], 2 + RANDOM_CASES)
                    self.assertEqual((ours["checked"], ours["violations"]), (2 + RANDOM_CASES, 0))
                    self.assertGreaterEqual(mine["violations"], 1 if law in laws else 0)
                # A single fault gives one cause, or two.
                run = json.loads((self.folder / name / "run.json").read_text(encoding="utf-8"))
                self.assertIn(len(run["causes"]), (1, 2))
                if name == "wrong_contract":  # one cause for coverage, depth and values
                    self.assertEqual(run["causes"][0]["hint"]["change"],
                                     "positions are snapped to 1/256 pixel")
                found = self.counterexamples(name)
                self.assertIn((verdict, plugin), [(one["verdict"], one["backend"]) for one in found.values()])
                # A counterexample's file alone suffices to find the fault again.
                for file, one in found.items():
                    if one["verdict"] == verdict:
                        again = self.rastercheck(1, "replay", file, *self.timeout(name))
                        self.assertIn(f"{verdict} (as found)", again)
                        break

    def test_a_fault_of_some_draws_is_not_held_against_others(self):
        for name in sorted(WITHOUT_FAULT_WHERE_NARROW):
            plugin = self.build(source_of(name), name)
            narrow = self.rastercheck(0, "render", "corpus/narrow.json", "--backend", plugin, "--json")
            self.assertIn('"x"', narrow)

    def test_a_fault_of_one_drawing_is_not_held_against_the_next(self):
        plugin = self.build(SOURCE / "docs/examples/plugin/faulty/before_the_beginning.c", "before")
        said = self.rastercheck(1, "replay", "corpus/wide.json", "corpus/narrow.json", "--backend", plugin)
        self.assertIn(f"wide.json: {COVERAGE}, {plugin}: failed", said)
        self.assertIn(f"narrow.json: {COVERAGE}, {plugin}: held", said)

    def test_standard_streams_may_be_closed(self):
        plugin = self.build(SOURCE / "docs/examples/plugin/little.c", "little")
        done = subprocess.run([RASTERCHECK, "render", "corpus/narrow.json", "--backend", plugin, "--json"],
                              cwd=self.folder, stdout=subprocess.PIPE, text=True, check=False,
                              preexec_fn=lambda: (os.close(0), os.close(2)))
        self.assertEqual(done.returncode, 0)
        self.assertIn('"x"', done.stdout)

    def test_every_file_is_tested(self):
        self.assertEqual({path.stem for path in SOURCE.glob("docs/examples/plugin/faulty/*.c*")},
                         {name for name, _, _ in FAULTS})

    def test_each_says_in_its_file_what_is_said_of_it(self):
        for name, _, message in FAULTS:
            text = source_of(name).read_text(encoding="utf-8")
            comment = re.sub(r"\s*\n \*\s*", " ", text[:text.index("*/")])
            self.assertIn(f"RasterCheck: “{message}”".replace("0.2 s", "10 s"), comment, name)

    def test_a_file_that_is_not_there_is_bad_usage(self):
        said = self.rastercheck(2, "run", "--backend", "plugin:./nowhere.so")
        self.assertEqual(said, "rastercheck: plugin:./nowhere.so: no such file; paths are relative "
                               "to the folder that rastercheck runs in\n")


class Header(PluginTest):
    def test_barycentrics_are_as_calculated_by_hand(self):
        for compiler in ([CC, "-std=c99"], [CXX, "-x", "c++", "-std=c++11"]):
            words = [*compiler, *WARNINGS, "-I", self.folder / "include",
                     SOURCE / "tests/plugins/barycentrics_test.c", "-o", "barycentrics_test"]
            done = self.run_command(*words)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
            done = self.run_command(self.folder / "barycentrics_test")
            self.assertEqual((done.returncode, done.stderr), (0, ""))


def patched(test, patch):
    """The source that a patch changes, changed."""
    name = re.search(r"^--- a/(.*)$", patch.read_text(encoding="utf-8"), re.MULTILINE)[1]
    source = test.folder / name
    source.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(SOURCE / name, source)
    done = test.run_command(PATCH, "--fuzz=0", "-p1", "--batch", "--input", patch)
    test.assertEqual(done.returncode, 0, done.stdout)
    return source


class Mutants(PluginTest):
    def test_each_is_killed_by_the_law_it_names(self):
        patches = sorted(SOURCE.glob("tests/plugins/mutants/*.patch"))
        self.assertGreaterEqual(len(patches), 10)
        stages = set()
        for patch in patches:
            with self.subTest(patch.stem):
                header = dict(re.findall(r"^(Defect|Killed by|Stage): (.*)$", patch.read_text(encoding="utf-8"),
                                         re.MULTILINE))
                stages.add(header["Stage"])
                source = patched(self, patch)
                plugin = self.build(source, patch.stem)
                law = header["Killed by"]
                said = self.rastercheck(1, "run", "--backend", plugin, "--property", law, "--seed", 1,
                                        "--cases", 100, "--output", patch.stem)
                found = self.counterexamples(patch.stem)
                self.assertEqual({one["property"] for one in found.values()}, {law})
                self.assertIn("; shrunk in ", said)
                for file in found:
                    c = json.loads(file.read_text(encoding="utf-8"))
                    # Few triangles are left; a condition that must stay may need one more.
                    drawn = next(c[key] for key in ("triangles", "lines", "points") if key in c)
                    self.assertLessEqual(len(drawn), 4)
                    self.assertIn("(as found)", self.rastercheck(1, "replay", file))
                    # The undamaged rasterizer does not have the fault.
                    self.assertIn(": held", self.rastercheck(0, "replay", file, "--backend", self.whole(source.stem)))
        self.assertGreaterEqual(len(stages), 8)

    def whole(self, plugin):
        if not (self.folder / f"whole-{plugin}.so").exists():
            self.build(SOURCE / f"docs/examples/plugin/{plugin}.c", f"whole-{plugin}")
        return f"plugin:./whole-{plugin}.so"


# Rows of a probe that say what no contract can, and how their text begins then.
BEYOND_CONTRACTS = {"coverage as measured": "violated", "drawing twice": "other bits",
                    "conservative coverage": "not kept"}


class Probed(PluginTest):
    """What a probe finds out of a plugin is true of it: the plugin, right or not, keeps the contract
    that the probe writes, unless the probe says that it does not."""

    maxDiff = None

    def test_typical_plugins_keep_their_contracts(self):
        for source in sorted(SOURCE.glob("tests/plugins/typical/*.c")):
            for name, options in ((source.stem, []), (f"{source.stem}-breaks", ["-DBREAKS"])):
                with self.subTest(name):
                    self.check(self.build(source, name, *options), name)
        self.assertEqual(self.faults, {"corner_samples-breaks": ["moved"]})
        self.assertEqual(self.beyond, {"conservative-breaks": ["conservative coverage"]})

    def test_mutants_keep_their_contracts(self):
        if CASES < 1000:
            self.skipTest("left to runs with more cases")
        for patch in sorted(SOURCE.glob("tests/plugins/mutants/*.patch")):
            source = patched(self, patch)
            # Occlusion buffers draw nothing, contracts of a probe say nothing about pictures, lines and points, and
            # only hard cases show weights in float32.
            if source.stem in ("occlusion", "picture", "lines") or patch.stem == "weights-in-float32":
                continue
            with self.subTest(patch.stem):
                self.check(self.build(source, patch.stem), patch.stem)
        self.assertEqual(self.faults, {"half-a-pixel-off": ["moved"], "provoking-vertex-first": ["provoking-vertex"],
                                       "one-edge-without-tie-rule": ["inclusive-edges"]})
        self.assertEqual(self.beyond, {
            "provoking-vertex-of-the-draw-before": ["drawing twice"],
            **dict.fromkeys(("first-clip-distance-only", "front-face-ignored", "last-column-lost",
                             "near-plane-at-zero", "sample-positions-ignored", "scissor-one-too-wide",
                             "snapping-truncates", "viewport-upside-down"), ["coverage as measured"])})

    def setUp(self):
        super().setUp()
        self.faults, self.beyond = {}, {}

    def check(self, plugin, name):
        # On a busy machine the usual time ends before the last measures.
        done = self.run_command(RASTERCHECK, "probe", plugin, "--json", "--seconds", 600,
                                "--contract-out", f"{name}-contract.json")
        self.assertIn(done.returncode, (0, 1), done.stderr)
        found = json.loads(done.stdout)
        if found["faults"]:
            self.faults[name] = [fault["id"] for fault in found["faults"]]
            return
        beyond = [row["what"] for row in found["measured"]
                  if row["measured"].startswith(BEYOND_CONTRACTS.get(row["what"], "\0"))]
        if beyond:
            self.beyond[name] = beyond
            return
        self.rastercheck(0, "run", "--backend", plugin, "--contract", f"{name}-contract.json", "--seed", 2,
                         "--cases", 20, "--output", name)


def find(test, program):
    """Where a program is. Elsewhere than in CI, a language that a machine does not have is skipped."""
    found = shutil.which(program)
    if found is None:
        (test.fail if os.environ.get("RASTERCHECK_REQUIRE_BACKENDS") else test.skipTest)(f"no {program}")
    return found


class Starter(PluginTest):
    def test_builds_and_holds_as_it_is_written(self):
        for language in ("c", "c++"):
            with self.subTest(language):
                self.follow_readme(language, 3)

    # Defects of the rasterizers in the image starters: the law that has to find each, what it says,
    # and what is replaced in the text by what.
    IMAGE_DEFECTS = {
        "affine colours": (VALUES, "beyond bound", "w[i] /= t->vertex[i].position[3]; /* perspective */", ""),
        "half a pixel off": (COVERAGE, "extra", "x * GRID + GRID / 2", "x * GRID"),
        "the farthest is seen": ("the-nearest-fragment-wins", "another one is nearest here", "if (!(z < *depth)) return;",
                                 "if (*depth <= 1 && !(z > *depth)) return;"),
        "gamma": (COVERAGE, "which no triangle has", "(color * 255 + 0.5)", "(sqrt(color) * 255 + 0.5)"),
    }
    PYTHON_DEFECTS = {
        "affine colours": (VALUES, "beyond bound", "[weight / p[3] for weight,", "[weight for weight,"),
        "half a pixel off": (COVERAGE, "extra", "column * GRID + GRID // 2", "column * GRID"),
        "gamma": (COVERAGE, "which no triangle has", "int(color / sum(weights) * 255",
                  "int((color / sum(weights)) ** 0.5 * 255"),
    }

    def test_an_image_suffices(self):
        self.check_image(self.follow_readme("c++", 3, "--from", "image") / "rasterizer.cpp", {}, "")
        folder = self.follow_readme("c", 3, "--from", "image")
        self.check_image(folder / "rasterizer.c", self.IMAGE_DEFECTS, f"plugin:{folder}/build/plugin.so",
                         CMAKE, "--build", folder / "build")

    def test_an_image_suffices_in_python(self):
        folder = self.follow_readme("python", 1, "--from", "image")
        self.check_image(folder / "rasterizer.py", self.PYTHON_DEFECTS, f"exec:{sys.executable} {folder}/image.py",
                         "true")

    def check_image(self, source, defects, backend, *build):
        whole = source.read_text(encoding="utf-8")
        for name, (law, message, right, wrong) in defects.items():
            with self.subTest(name):
                self.assertEqual(whole.count(right), 1)
                source.write_text(whole.replace(right, wrong), encoding="utf-8")
                done = self.run_command(*build)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                said = self.rastercheck(1, "run", "--backend", backend, "--seed", 1, "--cases", 30, "--property", law,
                                        "--shrink-tries", 20, "--output", "broken")
                self.assertIn(message, said)
                self.assertEqual({one["property"] for one in self.counterexamples("broken").values()}, {law})

    def test_there_is_no_image_starter_for_every_language(self):
        said = self.rastercheck(2, "plugin", "new", "none", "--from", "image", "--language", "rust")
        self.assertEqual(said, "rastercheck: --from image: has no project in rust, but in: c, c++, python\n")
        self.assertFalse((self.folder / "none").exists())

    def test_programs_hold_as_they_are_written(self):
        for language, tool, count in (("python", "python3", 1), ("javascript", "node", 1), ("rust", "rustc", 2)):
            with self.subTest(language):
                find(self, tool)
                self.follow_readme(language, count)

    def follow_readme(self, language, count, *options):
        """Writes a project, and runs the commands that its README names before a counterexample."""
        folder = self.folder / language
        self.rastercheck(0, "plugin", "new", folder, "--language", language, *options)
        readme = (folder / "README.md").read_text(encoding="utf-8")
        commands = re.findall(r"^    (cmake .*|rustc .*|rastercheck run .*)$", readme, re.MULTILINE)
        self.assertEqual(len(commands), count, readme)
        for command in commands:
            words = shlex.split(command)
            if words[:2] == ["cmake", "-S"]:
                words += [f"-DCMAKE_C_COMPILER={CC}", f"-DCMAKE_CXX_COMPILER={CXX}", "-Wno-dev", "--no-warn-unused-cli"]
            if words[0] == "rastercheck":
                words = words[:words.index("--seed")] if "--seed" in words else words
                words += ["--seed", 1, "--cases", PROGRAM_CASES if language in ("python", "javascript") else 20]
                if language == "python":  # which takes a minute for the whole corpus
                    words += ["--corpus", self.folder / "corpus"]
            words[0] = {"cmake": CMAKE, "rastercheck": RASTERCHECK}.get(words[0], words[0])
            done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}\n{done.stderr}")
            self.assertNotIn("warning", done.stdout + done.stderr)
        self.assertTrue((folder / "rastercheck-out/report.html").exists())
        return folder

    def test_the_page_shows_what_is_printed(self):
        page = (SOURCE / "docs/judge-your-rasterizer.md").read_text(encoding="utf-8")
        folder = self.folder / "my-rasterizer"
        self.rastercheck(0, "plugin", "new", folder)
        plugin = folder / "plugin.c"
        whole = plugin.read_text(encoding="utf-8")
        broken = re.sub(r"^.*perspective \*/\n", "", whole, flags=re.MULTILINE)
        self.assertEqual(whole.count("\n") - 1, broken.count("\n"))
        self.assertIn("sed -i '/perspective \\*\\/$/d' plugin.c", page)
        plugin.write_text(broken, encoding="utf-8")
        (self.folder / "build").mkdir()
        self.build(plugin, "build/plugin")
        self.rastercheck(1, "run", "--backend", "plugin:build/plugin.so", "--seed", 1, "--property", VALUES)
        file = next(file for file in self.counterexamples("rastercheck-out")
                    if file.name.endswith("-beyond-bound-smooth.json"))
        self.assertIn(f"rastercheck replay {file.relative_to(self.folder)}\n", page)
        replayed = self.rastercheck(1, "replay", file)
        for line in replayed.splitlines()[1:]:
            self.assertIn(line.rstrip(), page)


class Programs(PluginTest):
    """Programs of docs/examples/exec, and plugins as programs."""

    def held(self, *words):
        command = " ".join(shlex.quote(str(word)) for word in words)
        self.rastercheck(0, "run", "--backend", f"exec:{command}", "--seed", 1, "--cases", PROGRAM_CASES,
                         "--corpus", self.folder / "corpus")

    def compile(self, *command):
        done = self.run_command(*command)
        self.assertEqual((done.returncode, done.stderr), (0, ""), command)

    def test_python(self):
        self.held(sys.executable, SOURCE / "docs/examples/exec/python/little.py")

    def test_javascript(self):
        self.held(find(self, "node"), SOURCE / "docs/examples/exec/javascript/little.mjs")

    def test_rust(self):
        self.compile(find(self, "rustc"), "-O", SOURCE / "docs/examples/exec/rust/little.rs", "-o", "little")
        self.held(self.folder / "little")

    def test_a_plugin_in_c(self):
        self.compile(CC, "-std=c11", "-O2", *WARNINGS, "-I", self.folder / "include",
                     SOURCE / "docs/examples/exec/c/little_exec.c", SOURCE / "docs/examples/plugin/little.c",
                     "-o", "little_exec", "-lm")
        for options in ((), ("--shared-memory",)):
            self.held(self.folder / "little_exec", *options)

    def test_a_faulty_plugin_in_c(self):
        self.compile(CC, "-std=c11", "-O2", "-I", self.folder / "include", SOURCE / "docs/examples/exec/c/little_exec.c",
                     SOURCE / "docs/examples/plugin/faulty/nan.c", "-o", "faulty", "-lm")
        said = self.rastercheck(1, "run", "--backend", f"exec:{self.folder}/faulty", "--corpus",
                                self.folder / "corpus", "--cases", 1)
        self.assertIn("was drawn as NaN", said)

    def test_an_echo_is_no_program(self):
        self.assertIn("repeats what it reads", self.rastercheck(4, "run", "--backend", "exec:cat"))


if __name__ == "__main__":
    SOURCE, RASTERCHECK, CMAKE, CC, CXX, PATCH = pathlib.Path(sys.argv[1]), *sys.argv[2:7]
    CASES = int(sys.argv[7])
    unittest.main(argv=[sys.argv[0], *sys.argv[8:]])
