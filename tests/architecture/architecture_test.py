#!/usr/bin/env python3
"""Checks that the source tree and the build follow the rules of docs/architecture.md.

Usage: architecture_test.py SOURCE_DIR BUILD_DIR CONFIG
Tries every rule on something that breaks it as well, to detect a rule that cannot fail.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True  # no traces in the source tree
from include_graph import ALLOWED, INCLUDE, folder_of, local_includes, sources  # noqa: E402

SOURCE, BUILD, CONFIG = pathlib.Path(), pathlib.Path(), ""

# Headers that public headers must not include: every includer would have to compile them too.
HEAVY = re.compile(r"^(CGAL/|gmp|mpfr|Eigen/|rapidcheck|nlohmann/json\.hpp|assimp/|gtest/|epoxy/|EGL/|GL/|vulkan/)")
# The one public header that may include GoogleTest: it is only for users of GoogleTest.
FOR_GTEST = "properties/campaign/testing.h"
# The folders whose files the documents name.
ROOMS = {"cases", "records", "rasterizer", "oracle", "backends", "properties", "reports", "gate", "cli", "python", "tests", "docs",
         "scripts", "cmake", ".ci"}
# A placeholder for a name that the reader chooses, as in tests/mutants/NAME.patch.
PLACEHOLDER = re.compile(r"[A-Z]{4}")
# A type, function or object that a line without indentation declares. Leaves out members of classes
# declared elsewhere, GoogleTest's macros, and the beginnings of shaders.
DECLARED = re.compile(r"(?:struct|class|enum class|enum|using) (?!namespace)(\w+)\b(?!::)"
                      r"|(?!using|namespace|template|return|TEST|INSTANTIATE|MATCHER|RC_|void main\()"
                      r"[\w:][\w:<>,*& ]*[ *&](\w+)(?:\(|\{| = |\[|;|$)")
# Symbols that libraries must not use, because they return errors as values.
FORBIDDEN_SYMBOLS = {"abort", "exit", "_exit", "quick_exit", "printf", "puts", "putchar", "std::cout",
                     "std::cerr", "std::clog", "__assert_fail", "std::terminate()"}


def include_faults(path, text):
    """Sentences that say what is wrong with the includes of one file."""
    faults = []
    own = folder_of(path)
    for _, system, local in INCLUDE.findall(text):
        if not local:
            is_public_header = path.endswith(".h") and "/internal/" not in path
            is_meant = path == FOR_GTEST and system.startswith("gtest/")
            if own and is_public_header and HEAVY.match(system) and not is_meant:
                faults.append(f"{path}: a public header includes the heavy <{system}>")
            continue
        if local.startswith(".") or "/" not in local:
            faults.append(f'{path}: "{local}" is not written from the root')
            continue
        other = folder_of(local)
        if own and other and other != own and other not in ALLOWED[own]:
            faults.append(f"{path}: {own} may not include {other}")
        if own and local.startswith("tests/"):
            faults.append(f"{path}: includes a test's file {local}")
        private_to = local.split("/internal/")[0] if "/internal/" in local else None
        # Fuzz targets test readers of all folders; benchmarks draw frames with drivers through
        # parts of their backends.
        insiders = (f"{private_to}/", f"tests/{private_to}/", "tests/fuzz/",
                    *(["tests/bench/"] if private_to in ("backends/gl", "backends/vulkan") else []))
        if private_to and not path.startswith(insiders):
            faults.append(f"{path}: {local} is private to {private_to}")
    return faults


def circles(graph):
    """Every file of a graph (file -> files it includes) that includes itself indirectly."""
    def reachable(start):
        seen, todo = set(), [start]
        while todo:
            for other in graph.get(todo.pop(), ()):
                if other not in seen:
                    seen.add(other)
                    todo.append(other)
        return seen
    return sorted(path for path in graph if path in reachable(path))


def missing_places(text, exists):
    """The files and folders that a page names in backticks or links to, but that do not exist."""
    named = re.findall(r"`((?:\.ci|\w+)/[\w./*-]*)`", text)
    named = [name for name in named if name.split("/")[0] in ROOMS and not PLACEHOLDER.search(name)]
    return [name for name in named if not exists(name)]


def library_of(path):
    """The nearest enclosing folder with a CMakeLists.txt. Only files below the same one are
    compiled together."""
    return next(folder for folder in pathlib.PurePosixPath(path).parents
                if (SOURCE / folder / "CMakeLists.txt").exists())


def unnamed(text):
    """(namespace, name) of each declaration in an unnamed namespace; `namespace` is the enclosing
    one."""
    names, outer, is_inside = set(), "", False
    for line in text.splitlines():
        if opened := re.match(r"namespace ([\w:]+) \{", line):
            outer = opened[1]
        elif line in ("namespace {", "}  // namespace"):
            is_inside = line == "namespace {"
        elif is_inside and (declared := DECLARED.match(line)):
            names.add((outer, declared[1] or declared[2]))
    return names


def undefined_symbols(library):
    """The names that a static library needs from elsewhere, without argument lists."""
    listing = subprocess.run(["nm", "--undefined-only", "--demangle", library], check=True,
                             capture_output=True, text=True).stdout
    symbols = set()
    for member in listing.split("\n\n"):
        names = {line.split(" U ", 1)[1].split("@")[0] for line in member.splitlines() if " U " in line}
        # The destructor of std::thread refers to std::terminate(), for a thread that nobody joined;
        # std::async joins all.
        if any(name.startswith("std::thread::_M_start_thread") for name in names):
            names.discard("std::terminate()")
        symbols |= names
    return symbols


def needs_exact_numbers(symbol):
    return "CGAL::" in symbol or symbol.startswith(("__gmp", "mpfr_"))


class Includes(unittest.TestCase):
    def test_run_one_way(self):
        files = list(sources(SOURCE))
        self.assertGreater(len(files), 50)
        faults = [fault for path, text in files for fault in include_faults(path, text)]
        self.assertEqual(faults, [])

    def test_the_scan_sees_faults(self):
        for path, line in [
            ("cases/case.h", '#include "oracle/rational.h"'),
            ("oracle/ulp.cpp", '#include "rasterizer/edge.h"'),
            ("rasterizer/edge.cpp", '#include "cases/case.h"'),
            ("backends/gl/context.cpp", '#include "rasterizer/draw.h"'),
            ("cli/main.cpp", '#include "oracle/internal/number.h"'),
            ("cli/commands/gallery.cpp", '#include "cli/gallery/internal/panel.h"'),
            ("cli/gallery/gallery.cpp", '#include "cli/command.h"'),
            ("tests/cases/json_test.cpp", '#include "oracle/internal/number.h"'),
            ("oracle/ulp.cpp", '#include "rational.h"'),
            ("oracle/ulp.cpp", '#include "../cases/case.h"'),
            ("oracle/ulp.h", "#include <CGAL/Gmpq.h>"),
            ("backends/gl/context.h", "#include <epoxy/gl.h>"),
            ("properties/law.h", "#include <gtest/gtest.h>"),
            ("properties/campaign/testing.h", "#include <rapidcheck.h>"),
            ("oracle/ulp.cpp", '#include "tests/oracle/small_case.h"'),
        ]:
            self.assertEqual(len(include_faults(path, line)), 1, (path, line))
        self.assertEqual(include_faults("backends/cpu/draw.cpp", '#include "rasterizer/draw.h"'), [])


    def test_run_in_no_circle(self):
        graph = {path: local_includes(text) for path, text in sources(SOURCE)}
        self.assertEqual(circles(graph), [])
        self.assertEqual(circles({"a": ["b"], "b": ["c"], "c": ["b"]}), ["b", "c"])


class UnnamedNamespaces(unittest.TestCase):
    """Release builds compile several files as one, so that their unnamed namespaces become one."""

    def test_of_a_folder_share_no_name(self):
        owners = collections.defaultdict(set)
        for path, text in sources(SOURCE):
            # The rasterizer's files and the benchmarks are compiled one by one.
            if path.endswith(".cpp") and not path.startswith(("rasterizer/", "tests/bench/")):
                for name in unnamed(text):
                    owners[library_of(path), *name].add(path)
        self.assertGreater(len(owners), 1000)
        shared = {name: files for name, files in owners.items() if len(files) > 1}
        self.assertEqual(shared, {}, shared)

    def test_the_scan_sees_names(self):
        text = ("namespace rastercheck::a {\nnamespace {\n\nconstexpr int kSize = 3;\nstruct Pair {\n  int x;\n};\n"
                "std::vector<int> all_of(int a,\n    int b) {\n  return f(a);\n}\n\n}  // namespace\n\n"
                "void seen() {}\n\n}  // namespace rastercheck::a\n")
        self.assertEqual(unnamed(text), {("rastercheck::a", name) for name in ("kSize", "Pair", "all_of")})


class Documents(unittest.TestCase):
    def test_the_table_is_the_rule(self):
        table = {}
        page = (SOURCE / "docs/architecture.md").read_text(encoding="utf-8")
        rows = page.split("| may include |\n", 1)[1].split("\n\n", 1)[0]
        for line in rows.splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if cells[0].strip("`").rstrip("/") in ALLOWED:
                table[cells[0].strip("`").rstrip("/")] = set(re.findall(r"`([\w/]+)`", cells[2]))
        self.assertEqual(table, ALLOWED)

    def test_the_figure_is_of_these_includes(self):
        subprocess.run([SOURCE / "scripts/architecture-figure", "--check"], check=True)

    def test_name_what_is_there(self):
        def exists(place):
            return any(SOURCE.glob(place)) if "*" in place else (SOURCE / place).exists()
        pages = [*SOURCE.glob("*.md"), *(SOURCE / "docs").glob("*.md")]
        self.assertGreater(len(pages), 10)
        for page in pages:
            missing = missing_places(page.read_text(encoding="utf-8"), exists)
            self.assertEqual(missing, [], page.name)
        self.assertEqual(missing_places("see `oracle/gone.cpp`", exists), ["oracle/gone.cpp"])


class Libraries(unittest.TestCase):
    def setUp(self):
        if CONFIG != "Release":
            self.skipTest("symbols are those of the release build; assertions and sanitizers add some")

    def libraries(self):
        found = {path.stem.removeprefix("librastercheck_"): path for path in BUILD.glob("lib/*.a")}
        self.assertTrue({"cases", "records", "oracle"} <= set(found))
        return found

    def test_neither_print_nor_exit(self):
        for name, path in self.libraries().items():
            self.assertEqual(undefined_symbols(path) & FORBIDDEN_SYMBOLS, set(), name)

    def test_exact_numbers_stay_in_the_oracle(self):
        for name, path in self.libraries().items():
            exact = any(map(needs_exact_numbers, undefined_symbols(path)))
            self.assertEqual(exact, name == "oracle", name)

    def test_rasterizer_and_oracle_share_nothing(self):
        libraries = self.libraries()
        uses = [s for s in undefined_symbols(libraries["oracle"]) if "rastercheck::rasterizer" in s]
        self.assertEqual(uses, [])
        if "rasterizer" in libraries:
            uses = [s for s in undefined_symbols(libraries["rasterizer"]) if "rastercheck::oracle" in s]
            self.assertEqual(uses, [])


class Flags(unittest.TestCase):
    def setUp(self):
        with open(BUILD / "compile_commands.json", encoding="utf-8") as commands:
            files = {pathlib.Path(entry["file"]): entry["command"] for entry in json.load(commands)}
        # The build folder contains sources that include several of the project's, at their
        # library's place in the tree, and CMake's own sources for precompiled headers, which are
        # left out.
        self.commands = {path.relative_to(BUILD if path.is_relative_to(BUILD) else SOURCE).as_posix(): command
                         for path, command in files.items() if "cmake_pch" not in path.name}

    def test_rounding_math_only_where_cgal_is(self):
        with_flag = {path for path, command in self.commands.items() if "-frounding-math" in command}
        self.assertTrue(any(path.startswith("oracle/") for path in with_flag))
        self.assertEqual([path for path in with_flag if not path.startswith(("oracle/", "tests/oracle/"))],
                         [])

    def test_arithmetic_is_as_written(self):
        for path, command in self.commands.items():
            self.assertIn("-ffp-contract=off", command, path)
            self.assertNotIn("-ffast-math", command, path)


if __name__ == "__main__":
    SOURCE, BUILD, CONFIG = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    unittest.main(argv=sys.argv[:1])
