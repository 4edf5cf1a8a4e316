#!/usr/bin/env python3
"""Runs in a terminal: the progress bar must vanish before results are printed; the verdict has
colours.

Usage: terminal_test.py RASTERCHECK CORPUS
"""

import os
import pty
import subprocess
import sys
import tempfile
import unittest

RASTERCHECK = ""
CORPUS = ""

ERASE = "\r\x1b[K"


class Terminal(unittest.TestCase):
    def shown(self, command, **environment):
        """All that a command writes to its terminal."""
        outer, inner = pty.openpty()
        known = {name: value for name, value in os.environ.items() if name not in ("CI", "NO_COLOR")}
        with subprocess.Popen([RASTERCHECK, *command], stdin=inner, stdout=inner, stderr=inner,
                              env={**known, "TERM": "xterm", **environment}) as run:
            os.close(inner)
            text = b""
            try:
                while block := os.read(outer, 65536):
                    text += block
            except OSError:  # on Linux, this means that the other side is closed
                pass
            self.assertEqual(run.wait(), 0, text)
        os.close(outer)
        return text.decode()

    def run_shown(self, **environment):
        with tempfile.TemporaryDirectory() as folder:
            return self.shown(["run", "--seed", "1", "--cases", "20", "--corpus", CORPUS, "--property",
                               "coverage-obeys-the-contract", "--output", folder + "/out"], **environment)

    def test_run_erases_its_bar(self):
        text = self.run_shown()
        self.assertIn("#] ", text)
        self.assertIn(ERASE + "Samples: ", text)

    def test_probe_erases_its_bar(self):
        text = self.shown(["probe", "cpu", "--seconds", "86400"])
        self.assertRegex(text, r"3 of \d+ measures: planes and division")
        self.assertNotIn(" measures: ", text[text.rindex(ERASE):])

    def test_the_verdict_has_colours_unless_refused(self):
        green = "cpu: \x1b[32m1 property held\x1b[0m.\r\n"
        self.assertIn(green, self.run_shown())
        plain = "cpu: 1 property held.\r\n"
        self.assertIn(plain, self.run_shown(NO_COLOR="1"))
        self.assertIn(green, self.run_shown(NO_COLOR=""))
        self.assertIn(plain, self.run_shown(TERM="dumb"))


if __name__ == "__main__":
    RASTERCHECK, CORPUS = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
