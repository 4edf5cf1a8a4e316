#!/usr/bin/env python3
"""Runs what `rastercheck export` writes, without RasterCheck: tests of findings fail on the driver that
has the defect, and tests of cases that hold pass.

Usage: exported_test.py SOURCE_DIR RASTERCHECK C_COMPILER CLASS"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, RASTERCHECK, CC = pathlib.Path(), "", ""
REQUIRED = os.environ.get("RASTERCHECK_REQUIRE_BACKENDS") == "all"
SHADER_RUNNER = "/usr/lib/x86_64-linux-gnu/piglit/bin/shader_runner"
SWIFTSHADER = "/usr/lib/chromium/vk_swiftshader_icd.json"
SKIPPED = 77

# Cases of the corpus whose coverage obeys the contract on all four drivers.
HELD = ["attributes-thirty-two", "behind-the-eye", "camera", "centroid-of-4-samples", "clip-distances-eight"]



def run(arguments, folder, **environment):
    return subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=False, timeout=120,
                          env={**os.environ, **environment})


def known(driver):
    """The cases of a driver's known defects."""
    return sorted((SOURCE / f"backends/{driver}/known").glob("*.json"))


class Exported(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def export(self, case, backend, form):
        """The exported file; None and the reason if the format cannot say it."""
        file = self.folder / f"{case.stem}.{form}"
        done = run([RASTERCHECK, "export", case, "--backend", backend, "--format", form, "--output", file],
                   self.folder)
        if done.returncode == 0:
            return file, ""
        if done.returncode == 4 and not REQUIRED:
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return None, done.stderr

    def check(self, driver, backend, form, fails, at_least):
        """Exports a driver's findings and cases that hold; `fails(file)` runs one."""
        said = 0
        for case in known(driver):
            file, reason = self.export(case, backend, form)
            if file is None:
                self.assertIn("cannot say it: ", reason)
                continue
            said += 1
            self.assertTrue(fails(file), f"{case.name} passes")
        self.assertGreaterEqual(said, at_least)
        held_cases = 0
        for name in HELD:
            case = json.loads((SOURCE / f"cases/corpus/{name}.json").read_text(encoding="utf-8"))
            case["found"] = {"property": "coverage-obeys-the-contract", "backend": backend, "verdict": "missing",
                             "seed": 1, "index": 1}
            held = self.folder / f"{name}.json"
            held.write_text(json.dumps(case), encoding="utf-8")
            file, reason = self.export(held, backend, form)
            if "no property applies" in reason:  # the driver lacks something
                continue
            held_cases += 1
            self.assertIsNotNone(file, reason)
            self.assertIn("holds on", file.read_text(encoding="utf-8"))
            self.assertFalse(fails(file), f"{name} fails")
        self.assertGreaterEqual(held_cases, len(HELD) - 1)


class C(Exported):
    """Programs in C."""

    def compiled(self, file, *libraries):
        program = file.with_suffix("")
        done = run([CC, "-std=c11", "-Wall", "-Wextra", "-Werror", "-o", program, file, *libraries], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return program

    def fails(self, file, libraries, arguments=(), **environment):
        done = run([self.compiled(file, *libraries), *arguments], self.folder, **environment)
        self.assertIn(done.returncode, (0, 1), done.stdout + done.stderr)
        last = done.stdout.splitlines()[-1]
        if done.returncode == 0:
            self.assertEqual(last, "all right")
        else:
            self.assertRegex(last, r"^[1-9]\d* faults$")
            self.assertRegex(done.stdout, r"pixel \(\d+, \d+\), sample \d+: .* must be ")
        return done.returncode == 1

    def fails_on_opengl(self, driver):
        return lambda file: self.fails(file, ["-lEGL", "-lOpenGL"], GALLIUM_DRIVER=driver, LIBGL_ALWAYS_SOFTWARE="1")

    def test_of_llvmpipe(self):
        self.check("llvmpipe", "gl:llvmpipe", "c", self.fails_on_opengl("llvmpipe"), 4)

    def test_of_softpipe(self):
        self.check("softpipe", "gl:softpipe", "c", self.fails_on_opengl("softpipe"), 4)

    def test_of_lavapipe(self):
        self.check("lavapipe", "vulkan:lavapipe", "c",
                   lambda file: self.fails(file, ["-lvulkan"], ["llvmpipe"]), 4)

    def test_of_swiftshader(self):
        if not pathlib.Path(SWIFTSHADER).exists() and not REQUIRED:
            self.skipTest("no SwiftShader")
        self.check("swiftshader", "vulkan:swiftshader", "c",
                   lambda file: self.fails(file, ["-lvulkan"], ["SwiftShader"], VK_ICD_FILENAMES=SWIFTSHADER), 4)

    def test_of_one_driver_runs_on_another(self):
        if not pathlib.Path(SWIFTSHADER).exists() and not REQUIRED:
            self.skipTest("no SwiftShader")
        # A vertex with w = 0, which lavapipe draws right.
        file, _ = self.export(SOURCE / "backends/swiftshader/known/swiftshader-4.json", "vulkan:swiftshader", "c")
        self.assertFalse(self.fails(file, ["-lvulkan"], ["llvmpipe"]))
        # SwiftShader has 4 subpixel bits, lavapipe 8.
        file, _ = self.export(SOURCE / "backends/lavapipe/known/lavapipe-1.json", "vulkan:lavapipe", "c")
        done = run([self.compiled(file, "-lvulkan"), "SwiftShader"], self.folder, VK_ICD_FILENAMES=SWIFTSHADER)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("fewer subpixel bits", done.stderr)

    def test_says_that_it_cannot_run(self):
        file, _ = self.export(SOURCE / "backends/lavapipe/known/lavapipe-1.json", "vulkan:lavapipe", "c")
        done = run([self.compiled(file, "-lvulkan"), "no such device"], self.folder)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("no such device", done.stderr)
        self.assertEqual(list(self.folder.glob("case-*")), [])


class ShaderTest(Exported):
    """Tests of piglit's shader_runner."""

    def fails(self, file, driver):
        done = run([SHADER_RUNNER, file, "-auto", "-fbo"], self.folder, PIGLIT_PLATFORM="surfaceless_egl",
                   GALLIUM_DRIVER=driver, LIBGL_ALWAYS_SOFTWARE="1")
        results = [json.loads(line.removeprefix("PIGLIT: ")) for line in done.stdout.splitlines()
                   if line.startswith("PIGLIT: ")]
        self.assertEqual(len(results), 1, done.stdout + done.stderr)
        result = results[0]["result"]
        self.assertIn(result, ("pass", "fail"), done.stdout + done.stderr)
        # A shader that does not compile fails as well, but without a probe.
        self.assertEqual("SSBO" in done.stdout, result == "fail", done.stdout + done.stderr)
        return result == "fail"

    def test_of_llvmpipe(self):
        self.check("llvmpipe", "gl:llvmpipe", "shader_test", lambda file: self.fails(file, "llvmpipe"), 3)

    def test_of_softpipe(self):
        self.check("softpipe", "gl:softpipe", "shader_test", lambda file: self.fails(file, "softpipe"), 4)


if __name__ == "__main__":
    *_, source, RASTERCHECK, CC, which = sys.argv
    SOURCE = pathlib.Path(source)
    if which == "ShaderTest" and shutil.which(SHADER_RUNNER) is None:
        print("skipped: no piglit")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1] + [which], verbosity=2)
