#!/usr/bin/env python3
"""Runs the CI files of docs/ci as their services do, as far as possible on one machine.

Usage: ci_examples_test.py SOURCE_DIR RASTERCHECK C_COMPILER

Puts each file into a repository of its own: the project that `rastercheck plugin new` writes, with
a baseline. Runs the jobs one after the other, each in its own folder, with `bash -e` as on the
service, and passes on their artifacts. Stand-ins for apt-get and curl record what they are asked
for; `rastercheck` is on PATH once a job has installed its package. Runs everything twice: as in the
baseline, and with a plugin that is less precise.
"""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

SOURCE, RASTERCHECK, CC = pathlib.Path(), "", ""

# Adds a relative error of 2^-25 before the last rounding, which leaves constants and vertex values
# as they are.
PRECISE = "(weight[0] + weight[1] + weight[2]));"
OFF = "(weight[0] + weight[1] + weight[2]) * (1 + 0x1p-25));"
BACKEND = "plugin:./build/plugin.so"
PROMISES = (".smooth = {.constant = ", ".noperspective = {.constant = ")
CASES = 5  # instead of 100; enough to show the difference
LAW = "values-stay-within-the-bound"
PACKAGE_ADDRESS = "https://example.org/rastercheck.deb"

# Stand-ins for programs of the job's machine: the real ones would change this machine.
STAND_INS = {
    "apt-get": """#!/bin/bash
echo "apt-get $*" >>"$CALLS"
for word; do
  case $word in *.deb) [ -s "$word" ] || exit 100; ln -sf "$RASTERCHECK" "$JOB_PROGRAMS/rastercheck" ;; esac
done
""",
    "curl": f"""#!/bin/bash
echo "curl $*" >>"$CALLS"
[ "${{!#}}" = {PACKAGE_ADDRESS} ] || exit 6
while [ "$1" != -o ]; do shift; done
echo package >"$2"
""",
}


def result_of(done):
    return f"exit code {done.returncode}\n{done.stdout}{done.stderr}"


class Example(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ci-examples-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.artifacts = self.folder / "artifacts"
        (self.folder / "stand-ins").mkdir()
        for name, script in STAND_INS.items():
            file = self.folder / "stand-ins" / name
            file.write_text(script, encoding="utf-8")
            file.chmod(0o755)
        self.repository = self.folder / "repository"
        self.environment = {name: value for name, value in os.environ.items()
                            if not re.match("CI|GIT|GITHUB|GITLAB", name)}
        self.environment.update({
            "CALLS": str(self.folder / "calls"), "RASTERCHECK": RASTERCHECK, "CC": CC,
            "GIT_CONFIG_NOSYSTEM": "1", "HOME": str(self.folder), "GIT_AUTHOR_NAME": "Some Body",
            "GIT_AUTHOR_EMAIL": "some@body", "GIT_COMMITTER_NAME": "Some Body",
            "GIT_COMMITTER_EMAIL": "some@body"})
        self.execute([RASTERCHECK, "plugin", "new", self.repository], self.folder)
        self.execute(["git", "init", "-q", "-b", "main"], self.repository)
        # The plugin promises less than it keeps. So all laws hold even when it is less precise, and
        # only the gate notices.
        for promise in PROMISES:
            self.change("plugin.c", promise, promise + "1 + ")
        (self.repository / ".gitignore").write_text("build/\nrastercheck-out/\n", encoding="utf-8")
        self.commit("A plugin")

    def execute(self, words, folder, code=0, **more):
        """Runs a command and checks that its exit code is `code`."""
        done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True, check=False,
                              env={**self.environment, **more})
        self.assertEqual(done.returncode, code, f"{words}: {result_of(done)}")
        return done

    def commit(self, subject):
        self.execute(["git", "add", "-A"], self.repository)
        self.execute(["git", "commit", "-q", "-m", subject], self.repository)

    def take_baseline(self, text):
        """Makes a baseline by the commands in the first lines of an example, with fewer cases."""
        commands = re.findall(r"^#   (rastercheck .*)$", text, re.MULTILINE)
        self.assertEqual([command.split()[1] for command in commands], ["run", "baseline"])
        self.assertIn(" --cases 100 ", commands[0])
        self.execute(["bash", "-ec", "cmake -S . -B build\ncmake --build build"], self.repository)
        for command in commands:
            words = command.replace("--cases 100", f"--cases {CASES}").split()
            self.execute([RASTERCHECK, *words[1:]], self.repository)
        self.commit("The baseline")

    def change(self, name, before, after):
        file = self.repository / name
        text = file.read_text(encoding="utf-8")
        self.assertEqual(text.count(before), 1)
        file.write_text(text.replace(before, after), encoding="utf-8")

    def make_less_precise(self):
        self.change("plugin.c", PRECISE, OFF)
        self.commit("Off by a quarter of a step")

    # --- Jobs -----------------------------------------------------------------------------------

    def job_folder(self, name):
        """Makes a folder that serves as a job's own machine, with nothing installed yet."""
        folder = self.folder / "jobs" / name
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "programs").mkdir(parents=True)
        (folder / "work").mkdir()
        return folder

    def check_out(self, work):
        """Does what actions/checkout and GitLab do: takes the files of the commit, but nothing
        built."""
        self.execute(["git", "clone", "-q", self.repository, work.parent / "clone"], self.folder)
        for entry in (work.parent / "clone").iterdir():
            shutil.move(entry, work / entry.name)

    def run_script(self, job, script, variables):
        programs = job / "programs"
        path = f"{programs}:{self.folder / 'stand-ins'}:{os.environ['PATH']}"
        return subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", script], cwd=job / "work",
                              capture_output=True, text=True, check=False,
                              env={**self.environment, **variables, "PATH": path, "JOB_PROGRAMS": str(programs)})

    def keep(self, work, name, patterns):
        """Keeps artifacts: files and folders, which must exist, under their paths within `work`."""
        found = [file for pattern in patterns for file in work.glob(pattern)]
        self.assertTrue(found, f"{name}: {patterns}")
        target = self.artifacts / name
        for file in found:
            place = target / file.relative_to(work)
            place.parent.mkdir(parents=True, exist_ok=True)
            if file.is_dir():
                shutil.copytree(file, place, dirs_exist_ok=True)
            else:
                shutil.copy(file, place)

    def check_calls(self):
        calls = (self.folder / "calls").read_text(encoding="utf-8").splitlines()
        self.assertIn(f"curl -fsSL -o rastercheck.deb {PACKAGE_ADDRESS}", calls)
        for call in calls:
            self.assertRegex(call, r"^curl |^apt-get update -q$|^apt-get install -y -q --no-install-recommends ")

    def check_comparison(self, folder, *texts):
        """Checks that the report exists and names LAW, and that each of the texts names a law that
        got worse."""
        (comparison,) = json.loads((folder / "compare.json").read_text(encoding="utf-8"))["comparisons"]
        worse = {entry["property"] for entry in comparison["changed"] if entry["change"] == "worse"}
        self.assertIn(LAW, worse)
        for text in texts:
            self.assertTrue(any(law in text for law in worse), text)
        self.assertIn(LAW, (folder / "compare.html").read_text(encoding="utf-8"))


class GitHub(Example):
    """Jobs consist of steps. Fills in `${{ … }}`, and does the work of actions itself."""

    ACTIONS = {
        "actions/checkout@v4": set(), "actions/upload-artifact@v4": {"name", "path"},
        "actions/download-artifact@v4": {"name", "pattern", "path"},
        "github/codeql-action/upload-sarif@v3": {"sarif_file"}}

    def setUp(self):
        super().setUp()
        self.text = (SOURCE / "docs/ci/github-actions.yml").read_text(encoding="utf-8")
        self.workflow = yaml.safe_load(self.text)
        self.take_baseline(self.text)

    def fill_in(self, text, context):
        def value(match):
            self.assertIn(match[1], context, text)
            return str(context[match[1]])
        return re.sub(r"\$\{\{ ([\w.-]+) \}\}", value, str(text))

    def test_is_formed_as_workflows_are(self):
        # YAML reads the key "on" as the value true.
        self.assertEqual(set(self.workflow), {"name", True, "permissions", "env", "defaults", "jobs"})
        self.assertEqual(set(self.workflow[True]), {"push", "pull_request"})
        self.assertEqual(self.workflow["defaults"], {"run": {"shell": "bash"}})
        self.assertEqual(self.workflow["permissions"], {"contents": "read", "security-events": "write"})
        before = set()
        for name, job in self.workflow["jobs"].items():
            self.assertLessEqual(set(job), {"needs", "runs-on", "container", "strategy", "env", "steps"})
            self.assertEqual((job["runs-on"], job["container"]), ("ubuntu-24.04", "debian:12"))
            self.assertLessEqual({job["needs"]} if "needs" in job else set(), before)
            before.add(name)
            for step in job["steps"]:
                self.assertEqual(("run" in step) + ("uses" in step), 1, step)
                if "uses" in step:
                    self.assertLessEqual(set(step), {"uses", "with", "if"})
                    self.assertLessEqual(set(step.get("with", {})), self.ACTIONS[step["uses"]])
                else:
                    self.assertLessEqual(set(step), {"name", "run", "env", "if"})
                    # An expression in a script would let whoever names a branch run code.
                    self.assertNotIn("${{", step["run"])
                self.assertIn(step.get("if"), [None, "${{ !cancelled() }}"])

    def act(self, step, work, context):
        """Does the work of a step that uses one of the service's actions."""
        given = {key: self.fill_in(value, context) for key, value in step.get("with", {}).items()}
        name = step["uses"].split("@")[0]
        if name == "actions/checkout":
            self.check_out(work)
        elif name == "actions/upload-artifact":
            shutil.rmtree(self.artifacts / given["name"], ignore_errors=True)
            paths = given["path"].split()
            self.keep(work, given["name"], paths)
            if len(paths) == 1:  # the service keeps a folder's content without the folder
                kept = self.artifacts / given["name"]
                inner = kept / paths[0]
                self.assertTrue(inner.is_dir())
                shutil.copytree(inner, self.folder / "inner")
                shutil.rmtree(kept)
                shutil.move(self.folder / "inner", kept)
        elif name == "actions/download-artifact":
            target = work / given.get("path", ".")
            if "name" in given:
                shutil.copytree(self.artifacts / given["name"], target, dirs_exist_ok=True)
            else:
                found = sorted(self.artifacts.glob(given["pattern"]))
                self.assertTrue(found)
                for artifact in found:
                    shutil.copytree(artifact, target / artifact.name, dirs_exist_ok=True)
        else:
            sarif = json.loads((work / given["sarif_file"]).read_text(encoding="utf-8"))
            self.assertEqual(sarif["version"], "2.1.0")

    def run_job(self, name, matrix, outcomes):
        """Runs a job and returns its summary. Adds the result of each named step to `outcomes`."""
        job = self.workflow["jobs"][name]
        context = {"vars.RASTERCHECK_DEB": PACKAGE_ADDRESS, **matrix}
        folder = self.job_folder(name)
        summary = folder / "summary.md"
        summary.touch()
        fixed = {"GITHUB_ACTIONS": "true", "CI": "true", "GITHUB_STEP_SUMMARY": str(summary)}
        has_failed = False
        for step in job["steps"]:
            if has_failed and "if" not in step:
                continue
            if "uses" in step:
                self.act(step, folder / "work", context)
                continue
            variables = {key: self.fill_in(value, context) for level in (self.workflow, job, step)
                         for key, value in level.get("env", {}).items()}
            done = self.run_script(folder, step["run"], {**variables, "CASES": str(CASES), **fixed})
            outcomes[step["name"]] = done
            has_failed = has_failed or done.returncode != 0
        return summary.read_text(encoding="utf-8")

    def run_workflow(self):
        outcomes = {}
        for name in ("build", "shard", "gate"):
            matrix = self.workflow["jobs"][name].get("strategy", {}).get("matrix", {"": [None]})
            ((key, values),) = matrix.items()
            for value in values:
                summary = self.run_job(name, {f"matrix.{key}": value, "strategy.job-total": len(values)}, outcomes)
        return outcomes, summary

    def test_is_green_and_then_red(self):
        outcomes, summary = self.run_workflow()
        for name, done in outcomes.items():
            self.assertEqual(done.returncode, 0, f"{name}: {result_of(done)}")
        self.assertNotIn("::error", outcomes["Compare with the baseline"].stdout)
        self.assertIn("RasterCheck", summary)
        self.check_calls()

        self.make_less_precise()
        outcomes, summary = self.run_workflow()
        for name, done in outcomes.items():
            expected = 3 if name == "Compare with the baseline" else 0
            self.assertEqual(done.returncode, expected, f"{name}: {result_of(done)}")
        gate = outcomes["Compare with the baseline"].stdout
        annotations = [line for line in gate.splitlines() if line.startswith("::error")]
        self.assertTrue(annotations, gate)
        self.assertTrue(all("worse than the baseline" in line and "→" in line for line in annotations), annotations)
        self.check_comparison(self.artifacts / "rastercheck-out", summary, gate, *annotations)
        self.assertTrue((self.artifacts / "rastercheck-out/report.html").exists())


class GitLab(Example):
    """Jobs consist of scripts; runs them in the order of the stages."""

    KEYS = {"extends", "stage", "needs", "parallel", "script", "artifacts", "when", "before_script"}

    def setUp(self):
        super().setUp()
        self.text = (SOURCE / "docs/ci/gitlab-ci.yml").read_text(encoding="utf-8")
        self.pipeline = yaml.safe_load(self.text)
        self.jobs = {name: job for name, job in self.pipeline.items()
                     if name not in ("default", "stages", "variables") and not name.startswith(".")}
        self.take_baseline(self.text)

    def job(self, name):
        """The job, merged with the job that it extends."""
        job = self.jobs[name]
        return {**self.pipeline[job["extends"]], **job} if "extends" in job else job

    def test_is_formed_as_pipelines_are(self):
        self.assertEqual(self.pipeline["default"], {"image": "debian:12"})
        self.assertEqual([job["stage"] for job in self.jobs.values()], self.pipeline["stages"])
        self.assertTrue(all(isinstance(value, str) for value in self.pipeline["variables"].values()))
        before = []
        for name in self.jobs:
            job = self.job(name)
            self.assertLessEqual(set(job), self.KEYS)
            self.assertIsInstance(job["script"], list)
            self.assertTrue(all(isinstance(line, str) for line in job["script"] + job.get("before_script", [])))
            self.assertLessEqual(set(job.get("needs", [])), set(before))
            self.assertLessEqual(set(job["artifacts"]), {"when", "paths", "reports", "expose_as"})
            before.append(name)

    def run_job(self, name, number, numbers):
        job = self.job(name)
        folder = self.job_folder(name)
        self.check_out(folder / "work")
        for needed in job.get("needs", []):
            shutil.copytree(self.artifacts / needed, folder / "work", dirs_exist_ok=True)
        variables = {"CI": "true", "GITLAB_CI": "true", "RASTERCHECK_DEB": PACKAGE_ADDRESS,
                     **self.pipeline["variables"], "CASES": str(CASES)}
        if "parallel" in job:
            variables.update({"CI_NODE_INDEX": str(number), "CI_NODE_TOTAL": str(numbers)})
        done = self.run_script(folder, "\n".join(job.get("before_script", []) + job["script"]), variables)
        if done.returncode == 0 or job["artifacts"].get("when") == "always":
            reports = job["artifacts"].get("reports", {})
            self.assertLessEqual(set(reports), {"junit"})
            self.keep(folder / "work", name, [*job["artifacts"]["paths"], *reports.values()])
        return done

    def run_pipeline(self):
        shutil.rmtree(self.artifacts, ignore_errors=True)
        outcomes, has_failed = {}, False
        for name in self.jobs:
            if has_failed and self.job(name).get("when") != "always":
                continue
            numbers = self.job(name).get("parallel", 1)
            for number in range(1, numbers + 1):
                outcomes[name] = self.run_job(name, number, numbers)
                has_failed = has_failed or outcomes[name].returncode != 0
        return outcomes

    def test_is_green_and_then_red(self):
        outcomes = self.run_pipeline()
        self.assertEqual(list(outcomes), ["build", "shard", "merge", "gate"])
        for name, done in outcomes.items():
            self.assertEqual(done.returncode, 0, f"{name}: {result_of(done)}")
        self.check_calls()

        self.make_less_precise()
        outcomes = self.run_pipeline()
        for name, done in outcomes.items():
            expected = 3 if name == "gate" else 0
            self.assertEqual(done.returncode, expected, f"{name}: {result_of(done)}")
        self.check_comparison(self.artifacts / "gate/comparison", outcomes["gate"].stdout)
        self.assertTrue((self.artifacts / "merge/rastercheck-out/junit.xml").exists())


class Shell(Example):
    def gate(self, code, *words):
        path = f"{pathlib.Path(RASTERCHECK).parent}:{os.environ['PATH']}"
        return self.execute(["./gate.sh", *words], self.repository, code, PATH=path, CASES=str(CASES))

    def test_is_green_and_then_red(self):
        shutil.copy(SOURCE / "docs/ci/gate.sh", self.repository)
        self.gate(2, "other")
        self.gate(0, "save")
        self.commit("The baseline")
        self.gate(0)
        self.assertEqual(self.execute(["git", "status", "--porcelain"], self.repository).stdout, "")

        self.make_less_precise()
        done = self.gate(3)
        self.check_comparison(self.repository / "rastercheck-out", done.stdout)
        self.assertTrue((self.repository / "rastercheck-out/report.html").exists())


class Action(unittest.TestCase):
    """docs/ci/action: the step that unpacks scripts/package's archive, with an archive of its form."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ci-action-"))
        self.addCleanup(shutil.rmtree, self.folder)
        program = self.folder / "rastercheck-0/bin/rastercheck"
        program.parent.mkdir(parents=True)
        program.write_text("#!/bin/sh\necho rastercheck 0\n", encoding="utf-8")
        program.chmod(0o755)
        self.archive = self.folder / "it.tar.xz"
        subprocess.run(["tar", "-C", self.folder, "-cJf", self.archive, "rastercheck-0"], check=True)

    def run_step(self, sha256):
        action = yaml.safe_load((SOURCE / "docs/ci/action/action.yml").read_text(encoding="utf-8"))
        step = action["runs"]["steps"][0]
        self.assertEqual(set(action["inputs"]), {"archive", "sha256"})
        self.assertEqual(step["env"], {"ARCHIVE": "${{ inputs.archive }}", "SHA256": "${{ inputs.sha256 }}"})
        (self.folder / "path").touch()
        return subprocess.run(["bash", "-c", step["run"]], capture_output=True, text=True, check=False, env={
            "PATH": os.environ["PATH"], "RUNNER_TEMP": str(self.folder), "GITHUB_PATH": str(self.folder / "path"),
            "ARCHIVE": str(self.archive), "SHA256": sha256})

    def test_puts_the_program_on_the_path(self):
        done = self.run_step(hashlib.sha256(self.archive.read_bytes()).hexdigest())
        self.assertEqual(done.returncode, 0, result_of(done))
        self.assertTrue(done.stdout.endswith("rastercheck 0\n"), done.stdout)
        self.assertEqual((self.folder / "path").read_text(encoding="utf-8"), f"{self.folder}/rastercheck/bin\n")

    def test_refuses_another_archive(self):
        done = self.run_step("0" * 64)
        self.assertNotEqual(done.returncode, 0)
        self.assertFalse((self.folder / "rastercheck/bin").exists())


if __name__ == "__main__":
    SOURCE, RASTERCHECK, CC = pathlib.Path(sys.argv[1]), *sys.argv[2:4]
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
