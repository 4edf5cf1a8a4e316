#!/usr/bin/env python3
"""Runs the scripts of docs/ci/slurm on a Slurm cluster of three nodes on this machine, and breaks it meanwhile.

Usage: slurm_test.py SOURCE_DIR RASTERCHECK [TEST…]

Ends with exit code 77, skipped, where Slurm is not installed (Debian's package slurm-wlm).
"""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # no traces in the source tree
import slurm_cluster  # noqa: E402
from slurm_cluster import wait_until  # noqa: E402

SOURCE, RASTERCHECK = pathlib.Path(), ""

NODES = ("n1", "n2", "n3")
SHARDS = 64
# Depths and values of this backend are wrong by the promise of another one, so there are counterexamples. A shard takes
# half a second: long enough to be stopped half way.
CAMPAIGN = ["--backend", "method:screen-linear", "--contract", "contract.json", "--seed", "1", "--cases", "1500",
            "--property", "coverage-obeys*", "--property", "values-stay-within*", "--shrink-tries", "50",
            "--keep-cases"]


def run_without_environment(folder):
    """The bytes of a run.json without those of its "environment", which has date, duration and machine."""
    rest, count = re.subn(rb'"environment": *\{[^{}]*\}', b"", (folder / "run.json").read_bytes())
    assert count == 1, count
    return rest


def has_progress(folder):
    """True if a run in this folder has checked some of its cases and not all."""
    try:
        return bool(json.loads((folder / "unfinished.json").read_text(encoding="utf-8"))["done"])
    except OSError:
        return False


class Slurm(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="slurm-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.folder.chmod(0o755)  # munged wants others to reach its socket
        for name in ("cluster", "bin", "work"):
            (self.folder / name).mkdir()
        self.work = self.folder / "work"
        (self.folder / "bin/rastercheck").symlink_to(pathlib.Path(RASTERCHECK).resolve())
        for script in (SOURCE / "docs/ci/slurm").iterdir():
            shutil.copy(script, self.work)
        environment = {name: value for name, value in os.environ.items()
                       if not re.match("CI|GITHUB|GITLAB|SLURM|SBATCH|SQUEUE", name)}
        environment["PATH"] = f"{self.folder}/bin:{environment['PATH']}"
        self.cluster = slurm_cluster.Cluster(self.folder / "cluster", NODES, environment)
        self.addCleanup(self.cluster.close)
        self.cluster.start()

    def command(self, *words, code=0):
        return self.cluster.command(*words, folder=self.work, code=code)

    def set(self, script, before, after):
        """Replaces a line of a script, as a user would."""
        file = self.work / script
        text, count = re.subn(f"^{before}.*$", lambda _: after, file.read_text(encoding="utf-8"), flags=re.MULTILINE)
        self.assertEqual(count, 1, f"{script}: {before}")
        file.write_text(text, encoding="utf-8")

    def hold_task(self, node):
        """Stops a shard half way on this node. Returns its number and all processes of its task."""
        def held():
            for process in self.cluster.on_node(node):
                if process.name() != "rastercheck" or "run" not in process.words():
                    continue
                process.signal(signal.SIGSTOP)
                words = process.words()
                if "--output" in words:
                    output = words[words.index("--output") + 1]
                    if has_progress(self.work / output):
                        task = process.environment()["SLURM_JOB_ID"]
                        return int(output.rpartition("/")[2].partition(".")[0]), [
                            one for one in self.cluster.on_node(node) if one.environment().get("SLURM_JOB_ID") == task]
                process.signal(signal.SIGCONT)
            return None
        return wait_until(held, f"a shard half way on {node}")

    def finish_jobs(self):
        """Waits until no job is left. Slurm lets jobs that start again wait for two minutes; the test does not."""
        def is_over():
            done = self.cluster.command("squeue", "--noheader", "--array", "--format=%i %r")
            for line in done.stdout.splitlines():
                job, _, reason = line.partition(" ")
                if reason == "BeginTime":
                    self.cluster.command("scontrol", "update", f"JobId={job}", "StartTime=now", code=None)
            return not done.stdout
        wait_until(is_over, "the end of all jobs", seconds=600, pause=0.3)

    def log(self, name):
        return (self.work / "campaign/logs" / name).read_text(encoding="utf-8", errors="replace")

    def test_a_campaign_survives_failures_of_nodes_and_tasks(self):
        self.set("campaign.sh", "shards=", f"shards={SHARDS}")
        self.set("campaign.sh", "set -- --backend", f"set -- {' '.join(CAMPAIGN)}".replace("*", "\\*"))
        self.command("rastercheck", "probe", "cpu", "--contract-out", "contract.json", "--quiet")
        self.command("./campaign.sh")
        first_array = (self.work / "campaign/array").read_text(encoding="utf-8").strip()
        self.assertIn(f"array {first_array} of campaign has not ended", self.command("./campaign.sh", code=2).stderr)

        of_failed_node, _ = self.hold_task("n2")
        self.cluster.fail_node("n2")
        killed, processes = self.hold_task("n1")
        for process in processes:
            process.signal(signal.SIGKILL)
        preempted, processes = self.hold_task("n3")
        self.command("scontrol", "requeue", f"{first_array}_{preempted}")
        for process in processes:
            process.signal(signal.SIGCONT)
        self.finish_jobs()

        hit = (of_failed_node, killed, preempted)
        self.assertEqual(len(set(hit)), 3)
        for shard in hit:
            log = self.log(f"shard-{shard}.log")
            self.assertRegex(log, r"(?s) starts on n\d.* continues on n[13]")
            self.assertNotIn("is an unfinished run, which this one replaces", log)
        # Slurm requeues after a failure of the node, and whoever is preempted. Not what was killed.
        last_array = (self.work / "campaign/array").read_text(encoding="utf-8").strip()
        self.assertNotEqual(first_array, last_array)
        listed = self.command("scontrol", "show", "job", last_array).stdout
        self.assertEqual(re.findall(r"ArrayTaskId=(\S+)", listed), [str(killed)])

        campaign = self.work / "campaign"
        self.assertTrue((campaign / "merged/run.json").exists(), self.log("campaign.log"))
        self.assertEqual(list((campaign / "unfinished").iterdir()), [])
        done = self.command("rastercheck", "run", *CAMPAIGN, "--jobs", "2", "--output", "whole", code=1)
        self.assertIn("violated", done.stdout)
        self.assertTrue(run_without_environment(campaign / "merged") == run_without_environment(self.work / "whole"))
        self.assertEqual(*(sorted(path.name for path in (folder / "counterexamples").iterdir())
                           for folder in (campaign / "merged", self.work / "whole")))
        # Nothing is left to submit: it merges again, here, and says what merge says.
        self.assertIn("violated", self.command("./campaign.sh", code=1).stdout)


if __name__ == "__main__":
    SOURCE, RASTERCHECK = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    if slurm_cluster.missing_programs():
        print(f"Skipped: Slurm is not installed, {', '.join(slurm_cluster.missing_programs())} not found "
              "(Debian: slurm-wlm)")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
