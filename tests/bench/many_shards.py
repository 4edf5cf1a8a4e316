#!/usr/bin/env python3
"""Makes the shards of a campaign that nobody has time to run, to measure `rastercheck merge`.

Usage: many_shards.py OUT SHARD…

The SHARDs are run.json files of some shards of one campaign, such as `run --shard 1/1000`. Writes OUT/1.json up to
OUT/COUNT.json, as many as the campaign has shards: each is a copy of one of the given ones, in turns, with

- its own number;
- its own place of each counterexample, so that those of different shards compete as real ones do;
- its own date, duration, and one of a hundred machines in "environment".

Everything else is the same in every copy: in a real campaign no two shards have the same records. Figures of memory and
time depend on how much there is to read and to keep, which the copies have as real shards do. What they do not show:
ways to fail that only few shards meet, so the merged run has no more counterexamples than the given shards together.
Runs with --keep-cases or of several backends cannot be multiplied: each case has its own entry there.
"""

import json
import pathlib
import re
import sys


def compact(value):
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def change_line(lines, key, change):
    """Changes the value of a member that has a line of its own, as all members of a run but lists have."""
    start = f'"{key}": '
    place = next(i for i, line in enumerate(lines) if line.startswith(start))
    comma = "," if lines[place].endswith(",") else ""
    value = json.loads(lines[place][len(start):].removesuffix(","))
    change(value)
    lines[place] = start + compact(value) + comma


def copy_of(lines, number, distance):
    """The lines of a shard as those of another one, whose cases are `distance` later in the campaign."""
    lines = list(lines)

    def set_number(plan):
        plan["shard"]["index"] = number

    def set_environment(environment):
        environment["date"] = f"2026-11-30T{number // 60 % 24:02}:{number % 60:02}:00Z"
        environment["machine"] = f"Linux 6.1 x86_64 node-{number % 100}"
        environment["seconds"] = f"{float(environment['seconds']) + number / 1000:.1f}"
    change_line(lines, "plan", set_number)
    change_line(lines, "environment", set_environment)
    if '"counterexamples": [' not in lines:
        return lines
    first = lines.index('"counterexamples": [') + 1
    for place in range(first, lines.index("],", first)):
        lines[place] = re.sub(r'("found":\{[^{}]*"index":)(\d+)', lambda found: found[1] + str(int(found[2]) + distance),
                              lines[place], count=1)
    return lines


def main(out, *shards):
    texts = [pathlib.Path(shard).read_text(encoding="utf-8") for shard in shards]
    given = [text.splitlines() for text in texts]
    runs = [json.loads(text) for text in texts]
    if any("cases" in run or "outcomes" in run for run in runs):
        sys.exit("many_shards.py: runs with --keep-cases or of several backends cannot be multiplied")
    count = runs[0]["plan"]["shard"]["count"]
    folder = pathlib.Path(out)
    folder.mkdir(parents=True)
    for number in range(1, count + 1):
        lines = copy_of(given[number % len(given)], number, number)
        (folder / f"{number}.json").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
