#!/usr/bin/env python3
"""Whatever a backend draws is within the mask of its contract, and right to the judge.

Usage: masks_test.py RASTERCHECK [CASES]

For each backend that can run here, random cases that it draws are rendered to pictures of numbers.
Each number must lie within the bounds of `mask --promised-by` that backend, and `judge` must call no
pixel wrong. As a check of the check, some number of all these pictures must leave its bounds if it
is doubled and moved.
"""

import array
import json
import pathlib
import subprocess
import sys
import tempfile

BACKENDS = ["cpu", "cpu:precision=float32", "gl:llvmpipe", "gl:softpipe", "vulkan:lavapipe", "vulkan:swiftshader"]
PROPERTIES = ["values-stay-within-the-bound", "the-nearest-fragment-wins", "coverage-obeys-the-contract"]


def run(program, *words, codes=(0,)):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{' '.join(map(str, words))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def numbers(file):
    """The float32 numbers of an NPY file."""
    data = file.read_bytes()
    return array.array("f", data[10 + int.from_bytes(data[8:10], "little"):])


def outside(drawn, bounds, channels):
    """The index of the first number that is out of its bounds; None if none is."""
    for i, value in enumerate(drawn):
        low = i // channels * 2 * channels + i % channels
        if not bounds[low] <= value <= bounds[low + channels]:
            return i
    return None


def pictures(program, backend, cases, folder):
    """Draws cases of a backend. Returns how many pictures there were, and how many of them leave their
    bounds once each number is changed."""
    (folder / "none").mkdir()
    made = folder / "cases"
    run(program, "cases", "--out", made, "--promised-by", backend, "--cases", cases, "--seed", 1,
        "--corpus", folder / "none", *(word for one in PROPERTIES for word in ("--property", one)))
    drawn = noticed = 0
    for name in (made / "list.txt").read_text().split():
        case, picture, mask = made / f"cases/{name}.json", folder / "drawn.npy", folder / "bounds.npy"
        shown = channels_of(case)
        # A backend may refuse a case.
        if run(program, "render", case, "--backend", backend, *shown, "--picture", picture, codes=(0, 2)).returncode:
            continue
        run(program, "mask", case, "--promised-by", backend, *shown, "--bounds", mask, codes=(0, 5))
        told = run(program, "judge", case, picture, "--promised-by", backend, *shown, codes=(0, 1, 5))
        if told.returncode == 1:
            sys.exit(f"{backend}, {name}: a right picture is called wrong\n{told.stdout}")
        values, bounds = numbers(picture), numbers(mask)
        place = outside(values, bounds, 3)
        if place is not None:
            sys.exit(f"{backend}, {name}: number {place} is {values[place]}, out of its bounds")
        changed = array.array("f", (2 * value + 1 for value in values))
        noticed += outside(changed, bounds, 3) is not None
        drawn += 1
    return drawn, noticed


def channels_of(case):
    """Options: what the three channels of a case's picture show."""
    attributes = json.loads(case.read_text()).get("attributes", [])
    third = f"attribute:{attributes[0]['name']}" if attributes else "0"
    return "--channels", f"R=depth,G=coverage,B={third}"


def main():
    program, cases = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 4
    listed = run(program, "list", "backends").stdout
    for backend in BACKENDS:
        if backend not in listed:
            continue
        with tempfile.TemporaryDirectory() as folder:
            drawn, noticed = pictures(program, backend, cases, pathlib.Path(folder))
        print(f"{backend}: {drawn} pictures within their masks; {noticed} changed ones are not")
        if drawn == 0 or noticed == 0:
            sys.exit(f"{backend}: nothing was drawn, or no change was noticed")


if __name__ == "__main__":
    main()
