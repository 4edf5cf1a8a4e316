#!/usr/bin/env python3
"""Uses an installed RasterCheck as users do: the rasterizer, as docs/using-the-rasterizer.md says
or as part of another build, and the properties as tests of a rasterizer, as docs/using-in-googletest.md
says.

Usage: consumer_test.py SOURCE_DIR BUILD_DIR CONFIG CMAKE COMPILER CMAKE_CXX_FLAGS=FLAGS CLASS
"""

import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import zlib

SOURCE, BUILD, CONFIG, CMAKE, COMPILER, FLAGS, BUNNY = pathlib.Path(), pathlib.Path(), "", "", "", "", ""

# The greatest permitted difference of a channel. The rasterizer draws the same bits with every
# compiler, but users' compilers may fuse products and sums in the examples' shader and camera. That
# changes a colour by far less than a unit of a byte, and rounding can turn this into one unit.
MOST_DIFFERENCE = 1
# The packages that the component `testing` needs, and those that only the project itself needs.
TESTING_NEEDS = ["fmt", "GTest", "nlohmann_json", "rapidcheck", "tl-expected"]
BUILD_NEEDS = ["assimp", "CGAL", "Eigen3", "CLI11", "Boost", "PNG", "benchmark"]
# Warnings as users may set them; the project's headers and macros must not cause any.
WARNINGS = "-Wall -Wextra -Wpedantic -Wshadow -Wold-style-cast -Werror"


def run(*command, expected=0, **environment):
    """The output of a command; also the message of the failure if its exit code is not
    `expected`."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False, env={**os.environ, **environment})
    if done.returncode != expected:
        raise AssertionError(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def install(prefix, *components):
    for component in components:
        run(CMAKE, "--install", BUILD, "--config", CONFIG, "--component", component, "--prefix", prefix)
    return {path.relative_to(prefix / "include").as_posix() for path in prefix.rglob("*.h")}


def without(packages):
    return [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in packages]


def configure(source, build, *options):
    return run(CMAKE, "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_BUILD_TYPE={CONFIG}",
               f"-DCMAKE_CXX_COMPILER={COMPILER}", f"-D{FLAGS}", *options)


def unfiltered(kind, line, above, step):
    """Undoes the filter of a row of a PNG (PNG specification, clause 9)."""
    row = bytearray(line)
    for i, byte in enumerate(line):
        a = row[i - step] if i >= step else 0
        b = above[i]
        c = above[i - step] if i >= step else 0
        paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
        row[i] = (byte + (0, a, b, (a + b) // 2, paeth)[kind]) % 256
    return row


def pixels(png):
    """Width, height and the bytes of an 8-bit RGBA picture."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, *layout = struct.unpack(">IIBBBBB", body)
            assert layout == [8, 6, 0, 0, 0], layout
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    lines = zlib.decompress(packed)
    rows, row, size = bytearray(), bytearray(4 * width), 4 * width + 1
    for y in range(height):
        line = lines[y * size:(y + 1) * size]
        row = unfiltered(line[0], line[1:], row, 4)
        rows += row
    return width, height, rows


def picture_faults(drawn, approved):
    """Sentences that say what is wrong with a picture."""
    (*size, drawn_bytes), (*approved_size, approved_bytes) = pixels(drawn), pixels(approved)
    if size != approved_size:
        return [f"it has {size} pixels, not {approved_size}"]
    worst = max(abs(a - b) for a, b in zip(drawn_bytes, approved_bytes))
    return [f"a channel is off by {worst}"] if worst > MOST_DIFFERENCE else []


def code_of(text):
    """The block of a page that must equal docs/examples/bunny.cpp: the only one with a main()."""
    blocks = re.findall(r"^```cpp\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    programs = [block for block in blocks if "int main(" in block]
    assert len(programs) == 1, len(programs)
    return programs[0]


def code_lines(program):
    """The number of a program's lines, not counting blank lines, comments, includes and `using`."""
    return sum(1 for line in program.splitlines()
               if line.strip() and not re.match(r"\s*(//|#include|using namespace)", line))


class Installed(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="consumer-", dir=BUILD))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_examples_draw_what_the_docs_show(self):
        prefix, build = self.folder / "prefix", self.folder / "build"
        headers = install(prefix, "rasterizer")
        self.assertEqual(headers, {f"rasterizer/{path.name}" for path in SOURCE.glob("rasterizer/*.h")})

        configure(SOURCE / "docs/examples", build, f"-DCMAKE_PREFIX_PATH={prefix}")
        run(CMAKE, "--build", build)

        run(build / "bunny", BUNNY, self.folder / "bunny.png")
        drawn = (self.folder / "bunny.png").read_bytes()
        approved = (SOURCE / "docs/images/bunny-lit.png").read_bytes()
        self.assertEqual(picture_faults(drawn, approved), [])
        self.assertNotEqual(subprocess.run([build / "bunny", "nowhere.obj", self.folder / "none.png"],
                                           check=False).returncode, 0)

        run(build / "wireframe", BUNNY, self.folder / "wireframe.png")
        self.assertGreater((self.folder / "wireframe.png").stat().st_size, len(drawn))

        # Sanitizers keep freed memory, and without optimisation 100 frames take minutes.
        if CONFIG == "Release" and "-fsanitize" not in FLAGS:
            for threads in (1, 2):
                print(run(build / "viewer", BUNNY, threads), end="")


class Subdirectory(unittest.TestCase):
    def test_needs_and_leaks_nothing(self):
        with tempfile.TemporaryDirectory(prefix="consumer-", dir=BUILD) as build:
            log = configure(SOURCE / "tests/consumer/subdirectory", build, f"-DRASTERCHECK_SOURCE={SOURCE}",
                            *without(TESTING_NEEDS + BUILD_NEEDS))
            self.assertNotIn("WARNING", log)
            run(CMAKE, "--build", build, "--target", "CMakeFiles/main.dir/main.cpp.o")


class Components(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="consumer-", dir=BUILD))
        self.addCleanup(shutil.rmtree, self.folder)

    def targets(self, prefix, request, *options, expected=0):
        """The targets that exist after find_package(RasterCheck REQUEST), and CMake's output."""
        (self.folder / "CMakeLists.txt").write_text(f"""
            cmake_minimum_required(VERSION 3.25)
            project(Asking LANGUAGES CXX)
            find_package(RasterCheck {request})
            foreach(name IN ITEMS rasterizer testing)
              if(TARGET RasterCheck::${{name}})
                message(STATUS "there is ${{name}}")
              endif()
            endforeach()
            """, encoding="utf-8")
        shutil.rmtree(self.folder / "build", ignore_errors=True)
        log = run(CMAKE, "-S", self.folder, "-B", self.folder / "build", "-G", "Ninja",
                  f"-DCMAKE_CXX_COMPILER={COMPILER}", f"-DCMAKE_PREFIX_PATH={prefix}", *options,
                  expected=expected)
        return re.findall("there is (.*)", log), " ".join(log.split())

    def test_are_taken_as_asked_for(self):
        alone, both = self.folder / "alone", self.folder / "both"
        install(alone, "rasterizer")
        install(both, "rasterizer", "testing")
        scarce = without(TESTING_NEEDS + BUILD_NEEDS)
        for prefix, request, options, expected in [
                (alone, "REQUIRED", scarce, ["rasterizer"]),
                (alone, "REQUIRED COMPONENTS rasterizer", scarce, ["rasterizer"]),
                (both, "REQUIRED COMPONENTS rasterizer", [], ["rasterizer"]),
                (both, "REQUIRED", [], ["rasterizer", "testing"]),
                (both, "REQUIRED", scarce, ["rasterizer"]),
                (both, "REQUIRED COMPONENTS testing", without(BUILD_NEEDS), ["rasterizer", "testing"]),
                (both, "REQUIRED COMPONENTS rasterizer OPTIONAL_COMPONENTS testing", scarce, ["rasterizer"])]:
            self.assertEqual(self.targets(prefix, request, *options)[0], expected, (prefix, request, options))

        _, log = self.targets(alone, "REQUIRED COMPONENTS testing", expected=1)
        self.assertIn("Its component testing lacks its own files.", log)
        _, log = self.targets(both, "REQUIRED COMPONENTS testing", *without(["fmt", "GTest"]), expected=1)
        self.assertIn("Its component testing lacks fmt, GTest.", log)

    def test_a_build_on_the_path_is_no_package(self):
        # CMake looks for packages beside each bin/ on the PATH, and the docs put the build's bin/
        # there.
        with unittest.mock.patch.dict(os.environ, PATH=f"{BUILD}/bin:{os.environ['PATH']}"):
            self.targets("", "QUIET")
        cache = (self.folder / "build/CMakeCache.txt").read_text(encoding="utf-8")
        (place,) = re.findall("^RasterCheck_DIR:PATH=(.*)$", cache, re.MULTILINE)
        self.assertNotEqual(place, str(BUILD))


class Testing(unittest.TestCase):
    """The properties as tests of a user's own rasterizer."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="consumer-", dir=BUILD))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.headers = install(cls.folder / "prefix", "rasterizer", "testing", "corpus")
        configure(SOURCE / "tests/consumer/testing", cls.folder / "build", *without(BUILD_NEEDS),
                  f"-DCMAKE_PREFIX_PATH={cls.folder / 'prefix'}", f"-D{FLAGS} {WARNINGS}")
        run(CMAKE, "--build", cls.folder / "build")
        cls.program = cls.folder / "build/my_tests"

    def properties(self):
        listed = run(BUILD / "bin/rastercheck", "list", "properties", "--json")
        return {one["id"] for one in json.loads(listed)["properties"]}

    def test_headers_are_in_folders_of_their_own(self):
        self.assertEqual({header.split("/")[0] for header in self.headers}, {"rasterizer", "rastercheck"})
        self.assertIn("rastercheck/backends/backend.h", self.headers)
        self.assertEqual([header for header in self.headers if "internal" in header], [])

    def test_every_property_is_a_test(self):
        listed = run(self.program, "--gtest_list_tests", "--gtest_filter=MyRasterizer.*")
        self.assertEqual(set(re.findall(r'GetParam\(\) = "(.*)"', listed)), self.properties())
        self.assertIn("  property/coverage_obeys_the_contract ", listed)

    def test_pass_for_what_is_right(self):
        log = run(self.program, "--gtest_filter=MyRasterizer.*", RASTERCHECK_CASES="50")
        self.assertIn("[       OK ] MyRasterizer.property/coverage_obeys_the_contract ", log)
        self.assertIn("[  SKIPPED ] MyRasterizer.property/the_traced_value_is_the_drawn_value ", log)
        self.assertIn("does not apply to: backends that do not trace", log)

    def test_fail_for_what_is_wrong(self):
        coverage = "CarelessInVulkan.property/coverage_obeys_the_contract"
        log = run(self.program, f"--gtest_filter={coverage}:MyRasterizer.property/coverage*", expected=1)
        self.assertIn("[       OK ] MyRasterizer.property/coverage_obeys_the_contract ", log)
        self.assertIn(f"[  FAILED  ] {coverage}", log)
        message = log.split("CarelessInVulkan violates", 1)[1]
        for words in ["the property “coverage obeys the contract”: ", "  Found in case ", " of the corpus, “",
                      "    exactly: ", "    drawn:   ", "rastercheck replay - --backend cpu"]:
            self.assertIn(words, message)

        # The message contains a case file, which `cpu` draws correctly.
        case = message[message.index("\n{\n"):message.index("\n}\n") + 3]
        self.assertEqual(json.loads(case)["rules"], "vulkan")
        self.assertEqual(json.loads(case)["found"]["backend"], "CarelessInVulkan")
        file = self.folder / "case.json"
        file.write_text(case, encoding="utf-8")
        self.assertIn("cpu: held", run(BUILD / "bin/rastercheck", "replay", file, "--backend", "cpu"))

    def test_heed_the_environment(self):
        coverage = "--gtest_filter=CarelessInVulkan.property/coverage_obeys_the_contract"
        output = self.folder / "output"
        log = run(self.program, coverage, expected=1, RASTERCHECK_CORPUS="", RASTERCHECK_SEED="5",
                  RASTERCHECK_CASES="1000", RASTERCHECK_OUTPUT=str(output))
        self.assertRegex(log, r"Found in case \d+ of seed 5,")
        self.assertEqual([path.name for path in output.iterdir()],
                         ["CarelessInVulkan-coverage-obeys-the-contract.json"])
        # The folder of saved cases is a corpus, too.
        log = run(self.program, coverage, expected=1, RASTERCHECK_CORPUS=str(output), RASTERCHECK_CASES="0")
        self.assertIn("Found in case 0 of the corpus", log)
        log = run(self.program, coverage, expected=1, RASTERCHECK_CASES="many")
        self.assertIn("RASTERCHECK_CASES: 'many' is not an integer", log)


class Docs(unittest.TestCase):
    def test_show_the_program_that_is_tested(self):
        program = (SOURCE / "docs/examples/bunny.cpp").read_text(encoding="utf-8")
        self.assertEqual(code_of((SOURCE / "docs/using-the-rasterizer.md").read_text(encoding="utf-8")),
                         program)
        self.assertLessEqual(code_lines(program), 40)

    def test_show_the_tests_that_are_tested(self):
        page = (SOURCE / "docs/using-in-googletest.md").read_text(encoding="utf-8")
        for kind, name in ("cpp", "my_tests.cpp"), ("cmake", "CMakeLists.txt"):
            blocks = re.findall(rf"^```{kind}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
            program = (SOURCE / "tests/consumer/testing" / name).read_text(encoding="utf-8")
            shown = [block for block in blocks if block in program]
            self.assertEqual(shown, blocks, name)
            self.assertTrue(shown, name)

    def test_the_checks_see_faults(self):
        self.assertEqual(code_lines("// a\n#include <a>\nusing namespace a;\n\nint a;\n  // b\n"), 1)
        page = "```cpp\nint a;\n```\n```cpp\nint main() {}\n```\n"
        self.assertEqual(code_of(page), "int main() {}\n")

        def picture(*rows):
            body = zlib.compress(b"".join(bytes(row) for row in rows))
            header = struct.pack(">IIBBBBB", (len(rows[0]) - 1) // 4, len(rows), 8, 6, 0, 0, 0)
            return b"\x89PNG\r\n\x1a\n" + b"".join(
                struct.pack(">I4s", len(data), kind) + data + bytes(4)
                for kind, data in ((b"IHDR", header), (b"IDAT", body)))

        plain = picture([0, 1, 2, 3, 4, 5, 6, 7, 8], [0, 9, 9, 9, 9, 9, 9, 9, 9])
        # The same picture with the filters Sub and Up, Average and Paeth.
        for rows in [([1, 1, 2, 3, 4, 4, 4, 4, 4], [2, 8, 7, 6, 5, 4, 3, 2, 1]),
                     ([0, 1, 2, 3, 4, 5, 6, 7, 8], [3, 9, 8, 8, 7, 2, 2, 1, 1]),
                     ([0, 1, 2, 3, 4, 5, 6, 7, 8], [4, 8, 7, 6, 5, 0, 0, 0, 0])]:
            self.assertEqual(pixels(picture(*rows)), pixels(plain), rows)
        near = picture([0, 1, 2, 3, 4, 5, 6, 7, 7], [0, 9, 9, 9, 9, 9, 9, 9, 9])
        far = picture([0, 1, 2, 3, 4, 5, 6, 7, 6], [0, 9, 9, 9, 9, 9, 9, 9, 9])
        self.assertEqual(picture_faults(near, plain), [])
        self.assertEqual(len(picture_faults(far, plain)), 1)
        self.assertEqual(len(picture_faults(picture([0, 1, 2, 3, 4]), plain)), 1)


if __name__ == "__main__":
    SOURCE, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    CONFIG, CMAKE, COMPILER, FLAGS, BUNNY = sys.argv[3:8]
    unittest.main(argv=[sys.argv[0], *sys.argv[8:]])
