#!/usr/bin/env python3
"""Closes a run's terminal: the run must end with its reports and with the exit code of its
findings.

Usage: closed_terminal_test.py RASTERCHECK
"""

import fcntl
import json
import os
import pathlib
import pty
import signal
import subprocess
import sys
import tempfile
import termios
import time
import unittest

RASTERCHECK = ""


def in_terminal(terminal):
    """Makes `terminal` the controlling terminal of this process, its session's leader, so that
    closing the terminal sends SIGHUP."""
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup, if it started the test, ignores it
    fcntl.ioctl(terminal, termios.TIOCSCTTY, 0)


class ClosedTerminal(unittest.TestCase):
    def close_on(self, *options):
        """Closes the terminal of an endless run once cases are checked; returns the exit code and
        the run's folder."""
        folder = tempfile.TemporaryDirectory(prefix="closed-")
        self.addCleanup(folder.cleanup)
        output = pathlib.Path(folder.name) / "out"
        outer, inner = pty.openpty()
        run = subprocess.Popen(
            [RASTERCHECK, "run", "--seed", "1", "--cases", "1000000", "--output", output, *options],
            stdin=inner, stdout=inner, stderr=inner, start_new_session=True,
            preexec_fn=lambda: in_terminal(inner), env={**os.environ, "TERM": "xterm"})
        self.addCleanup(run.kill)
        os.close(inner)
        while not (output / "unfinished.json").exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        os.close(outer)
        return run.wait(), output

    def test_ends_a_run_with_its_reports(self):
        code, output = self.close_on("--property", "values-stay-within-the-bound", "--jobs", "2")
        self.assertEqual(code, 130)
        self.assertTrue((output / "report.html").exists())
        self.assertGreater(json.loads((output / "run.json").read_text(encoding="utf-8"))["cases_left"], 0)


if __name__ == "__main__":
    RASTERCHECK = sys.argv[1]
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
