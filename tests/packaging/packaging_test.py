#!/usr/bin/env python3
"""Checks the Debian packages that `cpack -G DEB` makes, and uses them on a Debian of this machine's
release with nothing else on it.

Usage: packaging_test.py SOURCE_DIR BUILD_DIR PACKAGES CLASS

PACKAGES is the packages' folder. Exit code 77: this machine lacks something that the test needs;
the last line names it. Makes the Debian in the build folder from this machine's apt sources, and
removes it at the end.
"""

import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD, PACKAGES = pathlib.Path(), pathlib.Path(), pathlib.Path()

SKIPPED = 77  # CTest's SKIP_RETURN_CODE
RELEASE = platform.freedesktop_os_release().get("VERSION_CODENAME", "")
# The settings of apt that are needed to reach the sources.
REACHING = re.compile(r"^Acquire::(Check-|Languages|Retries|https?::)")

# The script that runs there as root; the test checks its output. Programs run as another user with
# the environment of a login: first with the package rastercheck alone, then as a C++ user works
# with both packages.
ON_DEBIAN = """
set -e
apt-get install -y -q --no-install-recommends /packages/rastercheck_*.deb
apt-get install -y -q --no-install-recommends passwd  # Debian 13 does without
useradd --create-home somebody
su - somebody -c 'rastercheck list'
su - somebody -c 'rastercheck run --cases 3 --seed 1 --output out'
echo "The run ended with $?."
apt-get install -y -q --no-install-recommends python3
su - somebody -c 'python3 -c "
import importlib.metadata, rastercheck
case = rastercheck.Case.load(\\"/usr/share/rastercheck/corpus/behind-the-eye.json\\")
print(\\"Python\\", importlib.metadata.version(\\"rastercheck\\"), len(rastercheck.oracle(case)))"'
apt-get install -y -q --no-install-recommends /packages/rastercheck-dev_*.deb g++ cmake ninja-build
su - somebody -c 'cmake -G Ninja -S /tests -B tests && cmake --build tests'
su - somebody -c 'RASTERCHECK_CASES=3 tests/my_tests --gtest_filter=MyRasterizer.property/coverage*'
echo "The tests ended with $?."
"""


def output(*command, **options):
    """The output of a command, which is also the message if the command fails."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def package(name):
    """The only file of a package."""
    found = list(PACKAGES.glob(f"{name}_*.deb"))
    assert len(found) == 1, found
    return found[0]


def field(name, key):
    return output("dpkg-deb", "--field", package(name), key).strip()


def files(name):
    """The files of a package, from the root, with their modes."""
    lines = output("dpkg-deb", "--contents", package(name)).splitlines()
    rows = [line.split(maxsplit=5) for line in lines]
    return {row[5].removeprefix("./"): row[0] for row in rows if not row[0].startswith("d")}


def dependencies(text):
    """The packages that a list of dependencies names, without the suffix t64, which Debian 13 gives
    to libraries with 64-bit times."""
    return {entry.split()[0].removesuffix("t64") for entry in text.split(", ")}


def sources(targets, code):
    """apt's sources of one release of Debian, one line each, from lines "URI|RELEASE|COMPONENT"."""
    rows = [line.split("|") for line in targets.splitlines()]
    return [f"deb {uri} {release} {component}" for uri, release, component in rows
            if release in (code, f"{code}-updates", f"{code}-security") and component == "main"]


def sources_here():
    if not shutil.which("apt-get"):
        return []
    return sources(output("apt-get", "indextargets", "--format", "$(REPO_URI)|$(RELEASE)|$(COMPONENT)",
                          "Created-By: Packages"), RELEASE)


def ways_to_reach(dump):
    """The options of an apt-config dump that are needed to reach the sources, without empty
    ones."""
    return [line for line in dump.splitlines() if REACHING.match(line) and not line.endswith(' "";')]


def lacking():
    """The reason why no clean Debian can be made here; None if one can."""
    if not shutil.which("mmdebstrap"):
        return "there is no mmdebstrap"
    inside = [] if os.geteuid() == 0 else ["--map-auto", "--map-root-user"]
    if subprocess.run(["unshare", *inside, "--mount", "true"], capture_output=True, check=False).returncode != 0:
        return "neither root nor a user with namespaces, who may mount, runs it"
    found = sources_here()
    first = next((line for line in found if f" {RELEASE} " in line), None)
    if not first:
        return "apt knows no source of Debian here"
    _, uri, release, _ = first.split()
    with tempfile.TemporaryDirectory(prefix="packaging-", dir=BUILD) as folder:
        asked = subprocess.run(["timeout", "60", "/usr/lib/apt/apt-helper", "download-file",
                                f"{uri.rstrip('/')}/dists/{release}/InRelease", f"{folder}/InRelease"],
                               capture_output=True, check=False)
    return f"{uri} cannot be reached" if asked.returncode != 0 else None


class Contents(unittest.TestCase):
    def test_the_program_has_all_that_it_reads(self):
        held = files("rastercheck")
        self.assertEqual(held["usr/bin/rastercheck"], "-rwxr-xr-x")
        corpus = {path.name for path in (SOURCE / "cases/corpus").glob("*")}
        self.assertGreater(len(corpus), 300)
        data = {name.removeprefix("usr/share/rastercheck/") for name in held
                if name.startswith("usr/share/rastercheck/")}
        known = {f"known/{path.relative_to(SOURCE / 'backends')}"
                 for path in [*(SOURCE / "backends").glob("*/known.json"),
                              *(SOURCE / "backends").glob("*/known/*.json")]}
        self.assertGreater(len(known), 20)
        self.assertEqual(data, {f"corpus/{name}" for name in corpus} | known | {"accuracy/table.json"})
        docs = "usr/share/doc/rastercheck/"
        for name in ["copyright", "README.md", "docs/when-it-fails.md", "docs/images/bunny-cpu.png"]:
            self.assertIn(docs + name, held)
        self.assertEqual(held[docs + "docs/ci/gate.sh"], "-rwxr-xr-x")
        python = {name.removeprefix("usr/lib/python3/dist-packages/") for name in held if "python3/" in name}
        modules = {f"rastercheck/{path.name}" for path in (SOURCE / "python/rastercheck").glob("*.py")}
        self.assertGreater(len(modules), 5)
        version = field("rastercheck", "Version")
        self.assertEqual(python, {*modules, "rastercheck/py.typed", f"rastercheck-{version}.dist-info/METADATA"})
        others = {name for name in held
                  if not name.startswith((docs, "usr/share/rastercheck/", "usr/lib/python3/dist-packages/"))}
        self.assertEqual(others, {"usr/bin/rastercheck", "usr/share/man/man1/rastercheck.1",
                                  "usr/share/bash-completion/completions/rastercheck"})

    def test_the_program_needs_libraries_and_no_headers(self):
        needed = dependencies(field("rastercheck", "Depends"))
        self.assertLessEqual({"libc6", "libgmp10", "libtbb12", "libassimp5", "libepoxy0",
                              "libvulkan1"}, needed)
        self.assertEqual([name for name in needed if name.endswith("-dev")], [])

    def test_the_other_has_what_cmake_finds(self):
        held = files("rastercheck-dev")
        library = r"usr/lib/(\S+/)?"
        for pattern in [r"usr/include/rasterizer/rasterizer\.h", r"usr/include/rastercheck/backends/backend\.h",
                        r"usr/include/rastercheck/plugin\.h", r"usr/include/rastercheck/barycentrics\.h",
                        library + r"librastercheck_rasterizer\.a", library + r"librastercheck_campaign\.a",
                        library + r"cmake/RasterCheck/RasterCheckConfig\.cmake",
                        r"usr/share/doc/rastercheck-dev/copyright"]:
            self.assertEqual(len([name for name in held if re.fullmatch(pattern, name)]), 1, pattern)
        self.assertEqual(set(held) & set(files("rastercheck")), set())
        needed = field("rastercheck-dev", "Depends")
        self.assertIn(f"rastercheck (= {field('rastercheck', 'Version')})", needed)
        # The packages of all libraries that find_package(RasterCheck) looks for.
        self.assertEqual(dependencies(needed) - {"rastercheck"}, {
            "libexpected-dev", "libfmt-dev", "libglm-dev", "libgmp-dev", "libgtest-dev", "libhwy-dev",
            "libmpfr-dev", "librapidcheck-dev", "libseccomp-dev", "libtbb-dev", "nlohmann-json3-dev"})

    def test_say_what_they_are(self):
        for name, words in [("rastercheck", "Computes what a drawn triangle has to be"),
                            ("rastercheck-dev", "For programs in C++ built with CMake")]:
            first, *more = field(name, "Description").splitlines()
            self.assertEqual(first, "Checks rasterizers against exact rational arithmetic")
            self.assertTrue(more[0].strip().startswith(words), more)
            self.assertEqual(package(name).name, f"{name}_{field(name, 'Version')}_"
                                                 f"{field(name, 'Architecture')}.deb")
            self.assertEqual(field(name, "Homepage"), "")
            self.assertNotEqual(field(name, "Maintainer"), "")


class OnCleanDebian(unittest.TestCase):
    def test_they_do_what_they_are_for(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="packaging-", dir=BUILD))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "on_debian").write_text(ON_DEBIAN, encoding="utf-8")
        options = ways_to_reach(output("apt-config", "dump"))
        tests = SOURCE / "tests/consumer/testing"
        log = output(
            "mmdebstrap", "--variant=apt", "--format=null", "--dpkgopt=force-unsafe-io",
            *(f"--aptopt={option}" for option in options),
            '--customize-hook=mkdir "$1/packages" "$1/tests"',
            f"--customize-hook=copy-in {package('rastercheck')} {package('rastercheck-dev')} /packages",
            f"--customize-hook=copy-in {tests}/CMakeLists.txt {tests}/my_tests.cpp /tests",
            f"--customize-hook=copy-in {folder}/on_debian /",
            '--customize-hook=chroot "$1" sh /on_debian',
            f"--customize-hook=copy-out /home/somebody/out/run.json {folder}",
            RELEASE, "-", *sources_here(), env={**os.environ, "TMPDIR": str(folder), "LC_ALL": "C.UTF-8"})
        print(log)

        self.assertIn("The run ended with 0.", log)
        self.assertIn(f"Python {field('rastercheck', 'Version')} 24\n", log)
        self.assertIn("The tests ended with 0.", log)
        self.assertIn("[  PASSED  ] 1 test.", log)
        self.assertIn("coverage-obeys-the-contract", log)
        self.assertIn("method:rational-linear", log)
        # The run checked the whole corpus of the package: no source tree exists there.
        run = json.loads((folder / "run.json").read_text(encoding="utf-8"))
        checked = [record["cases"]["checked"] for record in run["records"]
                   if record["property"] == "coverage-obeys-the-contract" and record["stratum"] == "corpus"]
        self.assertGreater(sum(checked), 300)


class Checks(unittest.TestCase):
    """Tests the functions of this file that decide whether the test above runs."""

    def test_take_debian_and_nothing_else(self):
        self.assertEqual(sources("http://a/debian/|bookworm|main\nhttp://b/|nodistro|main\n"
                                 "http://a/debian/|bookworm|contrib\nhttp://a/s/|bookworm-security|main\n",
                                 "bookworm"),
                         ["deb http://a/debian/ bookworm main", "deb http://a/s/ bookworm-security main"])

    def test_take_the_settings_for_the_way_there(self):
        dump = ('Acquire "";\nAcquire::Check-Date "false";\nAcquire::http::Proxy "http://p:1";\n'
                'Acquire::Languages "";\nAcquire::Languages:: "none";\nAcquire::cdrom::mount "/m/";\n'
                'APT::Architecture "amd64";\n')
        self.assertEqual(ways_to_reach(dump),
                         ['Acquire::Check-Date "false";', 'Acquire::http::Proxy "http://p:1";',
                          'Acquire::Languages:: "none";'])


if __name__ == "__main__":
    SOURCE, BUILD, PACKAGES = map(pathlib.Path, sys.argv[1:4])
    if sys.argv[4] == "OnCleanDebian":
        reason = lacking()
        if reason:
            print(f"skipped: {reason}")
            sys.exit(SKIPPED)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
