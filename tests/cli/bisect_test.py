#!/usr/bin/env python3
"""Runs `rastercheck bisect` on small repositories of a plugin, whose first worse commit is known.

Usage: bisect_test.py SOURCE_DIR RASTERCHECK C_COMPILER
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE, RASTERCHECK, CC = pathlib.Path(), "", ""

PRECISE = "weight[i] /= t->w[i]; /* perspective */"
IN_FLOAT = "weight[i] = (float)(weight[i] / t->w[i]); /* perspective */"
# Few laws and cases suffice: the expected results do not depend on their numbers.
LAWS = ["--property", "@(values-stay-within-the-bound|coverage-obeys-the-contract)", "--cases", "30"]
BUILD_SCRIPT = """set -e
mkdir -p build
"$CC" -std=c11 -O1 -fPIC -shared -I . plugin.c -o build/plugin.so -lm
"""
COMMITS = 8


class BisectTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bisect-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.repository = self.folder / "repository"
        (self.repository / "rastercheck").mkdir(parents=True)
        (self.folder / "tmp").mkdir()
        (self.folder / "corpus").mkdir()
        for name in ("behind-the-eye", "a-triangle"):
            file = SOURCE / f"cases/corpus/{name}.json"
            if file.exists():
                shutil.copy(file, self.folder / "corpus")
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT")}
        self.environment.update({
            "CC": CC, "HOME": str(self.folder), "TMPDIR": str(self.folder / "tmp"), "GIT_CONFIG_NOSYSTEM": "1",
            "GIT_AUTHOR_NAME": "Some Body", "GIT_AUTHOR_EMAIL": "some@body", "GIT_COMMITTER_NAME": "Some Body",
            "GIT_COMMITTER_EMAIL": "some@body"})

    # --- Repositories ---------------------------------------------------------------------------

    def git(self, *words):
        done = subprocess.run(["git", *words], cwd=self.repository, env=self.environment, capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, f"git {words}\n{done.stdout}{done.stderr}")
        return done.stdout.strip()

    def write(self, name, text):
        (self.repository / name).write_text(text, encoding="utf-8")

    def commit(self, number, subject):
        self.git("add", "-A")
        self.environment["GIT_AUTHOR_DATE"] = f"2026-01-{number + 1:02}T12:00:00Z"
        self.git("commit", "-q", "-m", subject)
        self.hashes.append(self.git("rev-parse", "HEAD"))

    def make_repository(self, worse, broken=()):
        """Makes commits 0 to COMMITS: from `worse` on weights are float; those in `broken` do not
        build."""
        self.hashes = []
        self.git("init", "-q", "-b", "main")
        shutil.copy(SOURCE / "backends/plugin/plugin.h", self.repository / "rastercheck")
        self.write(".gitignore", "build/\n")
        self.write("build.sh", BUILD_SCRIPT)
        plugin = (SOURCE / "docs/examples/plugin/little.c").read_text(encoding="utf-8")
        self.assertEqual(plugin.count(PRECISE), 1)
        for number in range(COMMITS + 1):
            text = plugin.replace(PRECISE, IN_FLOAT) if number >= worse else plugin
            self.write("plugin.c", f"{text}/* {number} */\n" + ("#error\n" if number in broken else ""))
            self.commit(number, "Weights in float" if number == worse else f"Commit {number}")

    # --- Bisecting ------------------------------------------------------------------------------

    def words(self, good, bad, *options, build=("sh", "build.sh")):
        corpus = [] if "--corpus" in options else ["--corpus", self.folder / "corpus"]
        laws = [] if "--property" in options else LAWS
        return [RASTERCHECK, "bisect", "--backend", "plugin:./build/plugin.so", *laws, *corpus, *options, good, bad,
                "--", *build]

    def bisect(self, code, *arguments, cwd=None, **named):
        done = subprocess.run(self.words(*arguments, **named), cwd=cwd or self.repository, env=self.environment,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}{done.stderr}")
        return done

    def refuses(self, reason, *arguments, **named):
        done = self.bisect(2, *arguments, "--quiet", **named)
        self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stderr)
        self.assertRegex(done.stderr, r"^rastercheck: ")
        self.assertIn(reason, done.stderr)

    def check_restored(self, head="main"):
        self.assertEqual(self.git("rev-parse", "--abbrev-ref", "HEAD"), head)
        self.assertEqual(self.git("status", "--porcelain"), "")
        self.assertFalse((self.repository / ".git/BISECT_LOG").exists())
        self.assertEqual(self.git("for-each-ref", "refs/bisect"), "")
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])


class Finds(BisectTest):
    def test_the_first_commit_and_its_case(self):
        self.make_repository(worse=6, broken=[4])  # 4 is the one in the middle
        done = self.bisect(0, self.hashes[0], "main")
        lines = done.stdout.splitlines()
        self.assertEqual(lines[0], f"First worse: {self.hashes[6][:10]} 2026-01-07 Weights in float (Some Body)")
        self.assertRegex(done.stdout, r"most in: values-stay-within-the-bound, (random case|case) \d+")
        self.assertRegex(done.stdout, r"error [0-9.]+ → [0-9.]+ ULP")
        self.assertRegex(done.stdout, r"exact \S+")
        self.assertRegex(done.stdout, r"now +\S+")
        self.assertRegex(done.stdout, r"then +\S+")
        self.assertRegex(done.stdout, rf"Judged \d of {COMMITS + 1} commits, skipped 1\.")
        self.assertEqual(lines[-1], f"See: git show {self.hashes[6][:10]}")
        self.assertRegex(done.stderr, rf"{self.hashes[4][:10]} skipped: sh build.sh: ended with exit code 1; its output: plugin.c:.*#error")
        self.check_restored()

    def test_the_same_as_json(self):
        self.make_repository(worse=3)
        found = json.loads(self.bisect(0, self.hashes[0], "main", "--json", "--quiet").stdout)
        self.assertEqual([commit["commit"] for commit in found["first"]], [self.hashes[3]])
        self.assertEqual(found["bad"]["subject"], f"Commit {COMMITS}")
        (worse,) = found["worse"]
        case = worse["case"]
        before = max(abs(end) for end in case["before"]["error"]) if case["before"] else 0
        self.assertLess(before, min(abs(end) for end in case["after"]["error"]))
        # One of the two laws is worse, so the runs in between check only that law.
        self.assertEqual({entry.split(":")[0] for entry in worse["worse"]}, {"values-stay-within-the-bound"})

    def test_nobody_reads_what_it_says(self):
        self.make_repository(worse=6)
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run(self.words(self.hashes[0], "main"), cwd=self.repository, env=self.environment,
                                  stdout=subprocess.PIPE, stderr=full, text=True, check=False)
        self.assertEqual(done.returncode, 0)
        self.assertIn(f"First worse: {self.hashes[6][:10]} ", done.stdout)
        self.check_restored()

    def test_several_where_those_between_do_not_build(self):
        self.make_repository(worse=6, broken=[4, 5])
        done = self.bisect(0, self.hashes[0], "main")
        self.assertRegex(done.stdout, r"^First worse is one of these")
        named = re.findall(r"^  ([0-9a-f]{10}) ", done.stdout, re.MULTILINE)
        self.assertEqual(named, [self.hashes[number][:10] for number in (6, 5, 4)])
        self.check_restored()

    def test_a_child_of_the_good_one_without_search(self):
        self.make_repository(worse=6)
        done = self.bisect(0, self.hashes[5], self.hashes[6])
        self.assertIn(f"First worse: {self.hashes[6][:10]} ", done.stdout)
        self.assertIn("Judged 2 of 2 commits.", done.stdout)
        self.check_restored()

    def test_nothing_where_the_bad_one_is_as_good(self):
        self.make_repository(worse=6)
        done = self.bisect(0, self.hashes[0], self.hashes[5])
        self.assertRegex(done.stdout, "^Not worse: ")
        # A better commit is not a worse one.
        self.write("plugin.c", (SOURCE / "docs/examples/plugin/little.c").read_text(encoding="utf-8"))
        self.commit(COMMITS + 1, "Weights in double")
        self.assertRegex(self.bisect(0, self.hashes[6], "main").stdout, "^Not worse: ")
        self.check_restored()

    def test_through_merges(self):
        self.make_repository(worse=99)
        self.git("checkout", "-q", "-b", "side", self.hashes[2])
        plugin = (self.repository / "plugin.c").read_text(encoding="utf-8")
        self.write("plugin.c", plugin.replace(PRECISE, IN_FLOAT))
        self.commit(10, "Weights in float, on a branch")
        self.git("checkout", "-q", "main")
        self.git("merge", "-q", "-X", "ours", "-m", "Merge", "side")
        done = self.bisect(0, self.hashes[0], "main")
        self.assertIn(f"First worse: {self.hashes[-1][:10]} ", done.stdout)
        self.check_restored()

    def test_from_elsewhere_with_what_lies_in_the_work_tree(self):
        self.make_repository(worse=6)
        corpus = self.repository / "corpus"
        shutil.copytree(self.folder / "corpus", corpus)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "Cases")  # the good commit has no corpus
        self.git("checkout", "-q", "--detach")
        kept = self.folder / "kept"
        done = self.bisect(0, self.hashes[0], "main", "--repository", self.repository / "rastercheck", "--corpus",
                           corpus, "--output", kept, cwd=self.folder)
        self.assertIn(f"First worse: {self.hashes[6][:10]} ", done.stdout)
        self.assertTrue((kept / self.hashes[6] / "run.json").exists())
        self.assertTrue((kept / "good/build.log").exists())
        # The saved case violates its law in the reported commit, but not in the commit before.
        (replay,) = re.findall(r"^    rastercheck (replay .*)$", done.stdout, re.MULTILINE)
        for number, code in ((6, 1), (5, 0)):
            self.git("checkout", "-q", self.hashes[number])
            subprocess.run(["sh", "build.sh"], cwd=self.repository, env=self.environment, check=True)
            again = subprocess.run([RASTERCHECK, *shlex.split(replay)], cwd=self.repository, env=self.environment,
                                   capture_output=True, text=True, check=False)
            self.assertEqual(again.returncode, code, f"{replay}\n{again.stdout}{again.stderr}")
        self.git("checkout", "-q", "--detach", "main")
        self.check_restored(head="HEAD")

    def test_with_the_program_that_is_built(self):
        self.make_repository(worse=6)
        build = f"sh build.sh\nprintf '#!/bin/sh\\nexec {RASTERCHECK} \"$@\"\\n' >build/program\nchmod +x build/program\n"
        done = self.bisect(0, self.hashes[0], "main", "--program", "./build/program", build=("sh", "-ec", build))
        self.assertIn(f"First worse: {self.hashes[6][:10]} ", done.stdout)


class Refuses(BisectTest):
    def test_what_is_no_history_to_search(self):
        self.make_repository(worse=6)
        first, last = self.hashes[0], self.hashes[-1]
        self.refuses("is not in a git work tree", first, last, "--repository", self.folder)
        # The folder made for the output is removed again, so the same command works with a right
        # commit.
        new = self.folder / "new/deep"
        self.refuses("nobody: is not a commit of this repository", "nobody", last, "--output", new)
        self.assertFalse(new.parent.exists())
        self.refuses("is not an ancestor of", last, first)
        self.refuses("is the same commit as", last, "main")
        self.git("checkout", "-q", "-b", "side", self.hashes[2])
        self.commit_empty("Beside")
        self.refuses(f"is not an ancestor of main; their common ancestor is {self.hashes[2]}", "side", "main")
        self.check_restored(head="side")

    def commit_empty(self, subject):
        self.git("commit", "-q", "--allow-empty", "-m", subject)

    def test_work_trees_in_use(self):
        self.make_repository(worse=6)
        self.write("plugin.c", "changed")
        self.refuses("the work tree has uncommitted changes (1 file, first ' M plugin.c')", self.hashes[0], "main")
        self.assertEqual((self.repository / "plugin.c").read_text(encoding="utf-8"), "changed")
        self.git("checkout", "-q", "plugin.c")
        self.git("bisect", "start", "main", self.hashes[0])
        self.refuses("a bisection is in progress here", self.hashes[0], "main")
        self.assertTrue((self.repository / ".git/BISECT_LOG").exists())

    def test_where_there_is_no_git(self):
        self.make_repository(worse=6)
        self.environment["PATH"] = str(self.folder / "tmp")
        self.refuses("git: cannot be started: No such file or directory", self.hashes[0], "main")

    def test_ends_that_cannot_be_judged(self):
        self.make_repository(worse=6, broken=[0])
        self.refuses(f"{self.hashes[0]}: sh build.sh: ended with exit code 1", self.hashes[0], "main")
        self.check_restored()
        self.refuses("nothing-builds: cannot be started", self.hashes[1], "main", build=("nothing-builds",))
        self.refuses("plugin:./build/plugin.so: no such file", self.hashes[1], "main", build=("rm", "-rf", "build"))
        self.check_restored()

    def test_a_command_that_changes_what_git_tracks(self):
        self.make_repository(worse=6)
        done = self.bisect(2, self.hashes[1], "main", build=("sh", "-c", "sh build.sh && echo more >>plugin.c"))
        self.assertIn("BUILD changes tracked files:  M plugin.c", done.stderr)
        self.assertIn("BUILD changed tracked files; the changes are stashed (see git stash list)", done.stderr)
        self.check_restored()
        self.assertIn("+more", self.git("stash", "show", "-p"))

    def test_wrong_usage(self):
        self.make_repository(worse=6)
        for words, reason in ((["main"], "BAD is required"), (["main", "main"], "BUILD is required")):
            done = subprocess.run([RASTERCHECK, "bisect", *words], cwd=self.repository, env=self.environment,
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn(reason, done.stderr)
        full = self.folder / "full"
        full.mkdir()
        (full / "file").touch()
        self.refuses("is not empty", self.hashes[0], "main", "--output", full)
        self.assertTrue((full / "file").exists())
        self.refuses("--property: none of them: no property is called this", self.hashes[0],
                     "main", "--property", "none of them")


class Interrupted(BisectTest):
    def check_interrupted(self, building, by=signal.SIGINT):
        """Sends a signal, such as Ctrl-C's, while commit number `building` is built, which never
        ends."""
        script = (f"if tail -n 1 plugin.c | grep -q '/\\* {building} \\*/'; then touch {self.folder}/begun; sleep 1000; "
                  "fi; sh build.sh")
        # Restores the default: a test started by nohup has SIGHUP ignored.
        before = signal.signal(signal.SIGHUP, signal.SIG_DFL)
        self.addCleanup(signal.signal, signal.SIGHUP, before)
        program = subprocess.Popen(self.words(self.hashes[0], "main", build=("sh", "-c", script)),
                                   cwd=self.repository, env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while not (self.folder / "begun").exists():
            self.assertIsNone(program.poll())
            time.sleep(0.01)
        program.send_signal(by)
        out, err = program.communicate()
        self.assertEqual((program.returncode, out), (130, ""), err)
        self.assertIn("rastercheck: stopping; restoring the commit that was checked out\n", err)
        self.check_restored()

    def test_while_an_end_is_built(self):
        self.make_repository(worse=6)
        self.check_interrupted(building=0)

    def test_while_git_searches(self):
        self.make_repository(worse=6)
        self.check_interrupted(building=4)

    def test_by_a_closed_terminal(self):
        self.make_repository(worse=6)
        self.check_interrupted(building=0, by=signal.SIGHUP)


if __name__ == "__main__":
    SOURCE, RASTERCHECK, CC = pathlib.Path(sys.argv[1]), *sys.argv[2:4]
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
