#!/usr/bin/env python3
"""Runs scripts/bench-table on small results.

Usage: bench_table_test.py SOURCE_DIR
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path()


def run(name, time, **more):
    return {"name": f"raster/{name}/real_time", "run_type": "iteration", "real_time": time,
            "time_unit": "ms", **more}


def tables_of(runs, *options):
    """For each table, the cells of its rows, without the header."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "result.json")
        file.write_text(json.dumps({"benchmarks": runs}), encoding="utf-8")
        text = subprocess.run([SOURCE / "scripts/bench-table", file, *options], check=True,
                              capture_output=True, text=True).stdout
    return [[[cell.strip() for cell in line.strip("|").split("|")]
             for line in table.splitlines()[2:]] for table in text.split("\n\n")]


def table_of(runs, *options):
    """The cells of the rows of the only table."""
    table, = tables_of(runs, *options)
    return table


class BenchTable(unittest.TestCase):
    def test_compares_medians_with_the_better_width(self):
        runs = [run("draw/threads:1/bunny", time) for time in (30, 10, 20)]
        runs += [run("draw/threads:2/bunny", 10_000, time_unit="us"),
                 run("draw-avx2/threads:1/bunny", 40),
                 run("llvmpipe/threads:1/width:default/bunny", 50),
                 run("llvmpipe/threads:1/width:512/bunny", 30),
                 run("llvmpipe/threads:2/width:default/bunny", 15),
                 run("llvmpipe-rgba8/threads:1/width:512/bunny", 5)]
        self.assertEqual(table_of(runs), [
            ["bunny", "20", "30", "1.50", "10", "15", "1.50", "2.00", "1.25"]])
        self.assertEqual(table_of(runs, "--rgba8"), [
            ["bunny", "20", "5", "0.25", "10", "–", "–", "2.00", "–"]])

    def test_other_kinds_have_rows_of_their_own(self):
        runs = [run("draw-samples:4/threads:1/bunny", 8),
                run("draw-snapped:8/threads:1/bunny", 4),
                run("llvmpipe/threads:1/width:512/bunny", 2),
                run("llvmpipe-samples:4/threads:1/width:512/bunny", 24)]
        self.assertEqual([row[:4] for row in table_of(runs)], [
            ["bunny, samples:4", "8", "24", "3.00"], ["bunny, snapped:8", "4", "2", "0.50"]])

    def test_shaded_frames_have_a_table_of_their_own(self):
        shaded = [run("draw-textured-bilinear/threads:1/bunny", 10),
                  run("draw-textured-bilinear/threads:2/bunny", 5),
                  run("llvmpipe-textured-bilinear/threads:1/width:default/bunny", 40),
                  run("llvmpipe-textured-bilinear/threads:1/width:512/bunny", 30),
                  run("llvmpipe-textured-bilinear/threads:2/width:default/bunny", 20),
                  run("llvmpipe-textured-bilinear-float32/threads:1/width:default/bunny", 60),
                  run("llvmpipe-blended-over/threads:1/width:default/fill", 7)]
        rows = [["blended-over", "fill", "–", "7", "–", "–", "–", "–"],
                ["textured-bilinear", "bunny", "10", "30", "3.00", "5", "20", "4.00"],
                ["textured-bilinear-float32", "bunny", "–", "60", "–", "–", "–", "–"]]
        self.assertEqual(table_of(shaded), rows)
        plain = [run("draw/threads:1/bunny", 20), run("draw-float32/threads:1/bunny", 25)]
        first, second = tables_of(plain + shaded)
        self.assertEqual([row[:2] for row in first], [["bunny", "20"], ["bunny, float32", "25"]])
        self.assertEqual(second, rows)

    def test_leaves_out_what_was_skipped(self):
        runs = [run("draw/threads:1/bunny", 0, error_occurred=True), run("fill", 1)]
        self.assertEqual(table_of(runs), [])

    def test_takes_medians_that_stand_alone(self):
        runs = [run("draw/threads:1/bunny", time, run_type="aggregate", aggregate_name=name)
                for name, time in (("mean", 3), ("median", 2))]
        self.assertEqual(table_of(runs)[0][:2], ["bunny", "2"])


if __name__ == "__main__":
    SOURCE = pathlib.Path(sys.argv.pop(1))
    unittest.main()
