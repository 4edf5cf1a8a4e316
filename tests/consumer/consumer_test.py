#!/usr/bin/env python3
"""Uses the rasterizer as its users do: installed, as a part of another build, by the words of
docs/using-the-rasterizer.md.

Usage: consumer_test.py SOURCE_DIR BUILD_DIR CONFIG CMAKE COMPILER CMAKE_CXX_FLAGS=FLAGS CLASS
"""

import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SOURCE, BUILD, CONFIG, CMAKE, COMPILER, FLAGS = pathlib.Path(), pathlib.Path(), "", "", "", ""

BUNNY = "/usr/share/glmark2/models/bunny.obj"
# What the rasterizer draws is the same to the bit with every compiler, but the examples' shader and
# camera are compiled by their users', who may fuse products and sums: that moves a colour by far less
# than a byte's unit, which rounding can make one.
MOST_DIFFERENCE = 1
# Everything but the rasterizer's own needs.
NOT_NEEDED = ["CGAL", "Eigen3", "fmt", "tl-expected", "nlohmann_json", "assimp", "CLI11", "Boost", "PNG",
              "rapidcheck", "GTest", "benchmark"]


def run(*command):
    """What a command prints; its output is the failure where it fails."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def configure(source, build, *options):
    return run(CMAKE, "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_BUILD_TYPE={CONFIG}",
               f"-DCMAKE_CXX_COMPILER={COMPILER}", f"-D{FLAGS}", *options)


def unfiltered(kind, line, above, step):
    """A row of a PNG as it was before its filter (the PNG specification, clause 9)."""
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
    """What is wrong with a picture, as sentences."""
    (*size, drawn_bytes), (*approved_size, approved_bytes) = pixels(drawn), pixels(approved)
    if size != approved_size:
        return [f"it has {size} pixels, not {approved_size}"]
    worst = max(abs(a - b) for a, b in zip(drawn_bytes, approved_bytes))
    return [f"a channel is off by {worst}"] if worst > MOST_DIFFERENCE else []


def code_of(text):
    """The block of code of a page that is docs/examples/bunny.cpp, to the byte."""
    blocks = re.findall(r"^```cpp\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    programs = [block for block in blocks if "int main(" in block]
    assert len(programs) == 1, len(programs)
    return programs[0]


def code_lines(program):
    """How many lines a program has besides blank ones, comments, includes and `using`."""
    return sum(1 for line in program.splitlines()
               if line.strip() and not re.match(r"\s*(//|#include|using namespace)", line))


class Installed(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="consumer-", dir=BUILD))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_examples_draw_what_the_docs_show(self):
        prefix, build = self.folder / "prefix", self.folder / "build"
        run(CMAKE, "--install", BUILD, "--config", CONFIG, "--component", "rasterizer", "--prefix", prefix)
        headers = {path.relative_to(prefix / "include").as_posix() for path in prefix.rglob("*.h")}
        self.assertEqual(headers, {f"rasterizer/{path.name}" for path in SOURCE.glob("rasterizer/*.h")})

        configure(SOURCE / "docs/examples", build, f"-DCMAKE_PREFIX_PATH={prefix}")
        run(CMAKE, "--build", build)

        run(build / "bunny", BUNNY, self.folder / "bunny.png")
        drawn = (self.folder / "bunny.png").read_bytes()
        approved = (SOURCE / "docs/images/bunny-lit.png").read_bytes()
        self.assertEqual(picture_faults(drawn, approved), [])
        self.assertNotEqual(subprocess.run([build / "bunny", "nowhere.obj", self.folder / "none.png"],
                                           check=False).returncode, 0)

        # Sanitizers keep what is given back, and without optimisation 100 frames take minutes.
        if CONFIG == "Release" and "-fsanitize" not in FLAGS:
            for threads in (1, 2):
                print(run(build / "viewer", BUNNY, threads), end="")


class Subdirectory(unittest.TestCase):
    def test_needs_and_leaks_nothing(self):
        with tempfile.TemporaryDirectory(prefix="consumer-", dir=BUILD) as build:
            log = configure(SOURCE / "tests/consumer/subdirectory", build, f"-DRASTERCHECK_SOURCE={SOURCE}",
                            *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in NOT_NEEDED))
            self.assertNotIn("WARNING", log)
            run(CMAKE, "--build", build, "--target", "CMakeFiles/main.dir/main.cpp.o")


class Docs(unittest.TestCase):
    def test_show_the_program_that_is_tested(self):
        program = (SOURCE / "docs/examples/bunny.cpp").read_text(encoding="utf-8")
        self.assertEqual(code_of((SOURCE / "docs/using-the-rasterizer.md").read_text(encoding="utf-8")),
                         program)
        self.assertLessEqual(code_lines(program), 40)

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
        # The same by the filters Sub and Up, Average and Paeth.
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
    CONFIG, CMAKE, COMPILER, FLAGS = sys.argv[3:7]
    unittest.main(argv=[sys.argv[0], *sys.argv[7:]])
