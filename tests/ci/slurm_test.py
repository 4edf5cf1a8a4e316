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
HUNT = ["--backend", "method:screen-linear", "--contract", "contract.json", "--shrink-tries", "50"]
STEPS = 1024  # more than a second


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


def files_of(folder, pattern):
    """The contents of files, by their paths in a folder."""
    return {path.relative_to(folder): path.read_bytes() for path in folder.glob(pattern) if path.is_file()}


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
        self.command("rastercheck", "probe", "cpu", "--contract-out", "contract.json", "--quiet")

    def command(self, *words, code=0):
        return self.cluster.command(*words, folder=self.work, code=code)

    def set(self, script, before, after):
        """Replaces a line of a script, as a user would."""
        file = self.work / script
        text, count = re.subn(f"^{before}.*$", lambda _: after, file.read_text(encoding="utf-8"), flags=re.MULTILINE)
        self.assertEqual(count, 1, f"{script}: {before}")
        file.write_text(text, encoding="utf-8")

    def hold_task(self, nodes, command, is_wanted):
        """Stops a wanted task, by its process and its output folder, that runs `rastercheck COMMAND` on these nodes.
        Returns the folder's name and all processes of the task."""
        def held():
            for process in self.cluster.on_nodes(nodes):
                if process.words()[1:2] != [command]:
                    continue
                process.signal(signal.SIGSTOP)
                words = process.words()
                if "--output" in words:
                    output = words[words.index("--output") + 1]
                    if is_wanted(process, self.work / output):
                        job = process.environment().get("SLURM_JOB_ID")
                        return output.rpartition("/")[2], [
                            one for one in self.cluster.on_nodes(nodes) if one.environment().get("SLURM_JOB_ID") == job]
                process.signal(signal.SIGCONT)
            return None
        return wait_until(held, f"a task on {nodes}")

    def hold_shard(self, node):
        """Stops a shard half way. Returns its number and all processes of its task."""
        name, processes = self.hold_task([node], "run", lambda _, output: has_progress(output))
        return int(name.partition(".")[0]), processes

    def kill(self, processes):
        for process in processes:
            process.signal(signal.SIGKILL)

    def preempt(self, task, processes):
        self.command("scontrol", "requeue", task)
        for process in processes:
            process.signal(signal.SIGCONT)

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

    def array(self, folder):
        return (self.work / folder / "array").read_text(encoding="utf-8").strip()

    def log(self, name):
        return (self.work / name).read_text(encoding="utf-8", errors="replace")

    def test_a_campaign_survives_failures_of_nodes_and_tasks(self):
        self.set("campaign.sh", "shards=", f"shards={SHARDS}")
        self.set("campaign.sh", "set -- --backend", f"set -- {' '.join(CAMPAIGN)}".replace("*", "\\*"))
        self.command("./campaign.sh")
        first_array = self.array("campaign")
        self.assertIn(f"array {first_array} of campaign has not ended", self.command("./campaign.sh", code=2).stderr)

        of_failed_node, _ = self.hold_shard("n2")
        self.cluster.fail_node("n2")
        killed, processes = self.hold_shard("n1")
        self.kill(processes)
        preempted, processes = self.hold_shard("n3")
        self.preempt(f"{first_array}_{preempted}", processes)
        self.finish_jobs()

        hit = (of_failed_node, killed, preempted)
        self.assertEqual(len(set(hit)), 3)
        for shard in hit:
            log = self.log(f"campaign/logs/shard-{shard}.log")
            self.assertRegex(log, r"(?s) starts on n\d.* continues on n[13]")
            self.assertNotIn("is an unfinished run, which this one replaces", log)
        # Slurm requeues after a failure of the node, and whoever is preempted. Not what was killed.
        last_array = self.array("campaign")
        self.assertNotEqual(first_array, last_array)
        listed = self.command("scontrol", "show", "job", last_array).stdout
        self.assertEqual(re.findall(r"ArrayTaskId=(\S+)", listed), [str(killed)])

        campaign = self.work / "campaign"
        self.assertTrue((campaign / "merged/run.json").exists(), self.log("campaign/logs/campaign.log"))
        self.assertEqual(list((campaign / "unfinished").iterdir()), [])
        done = self.command("rastercheck", "run", *CAMPAIGN, "--jobs", "2", "--output", "whole", code=1)
        self.assertIn("violated", done.stdout)
        self.assertTrue(run_without_environment(campaign / "merged") == run_without_environment(self.work / "whole"))
        self.assertEqual(*(sorted(path.name for path in (folder / "counterexamples").iterdir())
                           for folder in (campaign / "merged", self.work / "whole")))
        # Nothing is left to submit: it merges again, here, and says what merge says.
        self.assertIn("violated", self.command("./campaign.sh", code=1).stdout)

    def test_hunts_start_from_those_of_the_round_before(self):
        for before, after in {"rounds=": "rounds=2", "tasks=": "tasks=2", "steps=": f"steps={STEPS}", "seed=": "seed=7",
                              "set -- --backend": f"set -- {' '.join(HUNT)}"}.items():
            self.set("hunt.sh", before, after)
        self.command("./hunt.sh")
        def is_half_way(hunt):
            return lambda process, output: output.name.startswith(hunt) and process.seconds() > 0.4
        _, processes = self.hold_task(NODES, "hunt", is_half_way("1-1."))
        self.kill(processes)
        _, processes = self.hold_task(NODES, "hunt", is_half_way("1-2."))
        self.preempt(f"{self.array('hunts')}_2", processes)
        self.finish_jobs()

        def hunt(output, seed, *more, code=1):
            words = ["rastercheck", "hunt", *HUNT, "--seed", seed, "--output", f"alone/{output}", *more]
            return self.command(*words, code=code).stdout
        hunt("round-1/hunt-1", 7, "--steps", STEPS)
        hunt("round-1/hunt-2", 8, "--steps", STEPS)
        from_first = ["--start", "alone/round-1/hunt-1", "--start", "alone/round-1/hunt-2", "--steps", STEPS]
        hunt("round-2/hunt-1", 9, *from_first)
        hunt("round-2/hunt-2", 10, *from_first)
        self.assertEqual(files_of(self.work / "hunts", "round-*/**/*"), files_of(self.work / "alone", "round-*/**/*"))

        # The outcome is the worst of the last round, by kind and stratum.
        last = list((self.work / "alone/round-2").glob("*/worst/*.json"))
        from_last = ["--start", "alone/round-2/hunt-1", "--start", "alone/round-2/hunt-2", "--steps", len(last)]
        table = hunt("all", 7, *from_last, code=0)
        self.assertIn(table.replace("alone/all", "hunts/all"), self.log("hunts/logs/hunt.log"))
        self.assertEqual(files_of(self.work / "hunts/all", "**/*"), files_of(self.work / "alone/all", "**/*"))


if __name__ == "__main__":
    SOURCE, RASTERCHECK = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    if slurm_cluster.missing_programs():
        print(f"Skipped: Slurm is not installed, {', '.join(slurm_cluster.missing_programs())} not found "
              "(Debian: slurm-wlm)")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
