#!/usr/bin/env python3
"""Makes copies of cases whose pictures have FACTOR times as many pixels along each axis.

Usage: enlarged_cases.py FACTOR OUT CASE…

Framebuffer, viewport and scissor grow; vertices stay, so that what is clipped, thin or near the horizon stays so. A case
whose framebuffer would be wider or higher than 2048 pixels, or whose viewport or scissor than 16384, is left out, and
counted.
"""

import json
import pathlib
import sys

LARGEST = {"framebuffer": 2048, "viewport": 16384, "scissor": 16384}


def number(value):
    return float.fromhex(value) if isinstance(value, str) else value


def enlarged(case, factor):
    for name in LARGEST.keys() & case.keys():
        for member in {"x", "y", "width", "height"} & case[name].keys():
            # A power of two changes no digit of a hex float.
            value = number(case[name][member]) * factor
            case[name][member] = value.hex() if isinstance(value, float) else value
    return case


def is_allowed(case):
    return all(abs(number(case[name].get(member, 0))) <= most
               for name, most in LARGEST.items() if name in case for member in ("x", "y", "width", "height"))


def main(factor, out, *files):
    folder = pathlib.Path(out)
    folder.mkdir(parents=True)
    left_out = 0
    for index, file in enumerate(files):
        case = enlarged(json.loads(pathlib.Path(file).read_text(encoding="utf-8")), int(factor))
        if not is_allowed(case):
            left_out += 1
            continue
        (folder / f"{index:05}.json").write_text(json.dumps(case), encoding="utf-8")
    print(f"{len(files) - left_out} cases written, {left_out} left out")


if __name__ == "__main__":
    main(*sys.argv[1:])
