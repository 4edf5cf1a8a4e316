#!/usr/bin/env python3
"""Compares `rastercheck oracle` with the second opinion (second_opinion/rules.py).

For each random case (seeds S to S+N-1), each random case with a depth bias or a unorm format of
depth (--biased), each FILE and, with --vectors, each known answer, the program's fragments must
equal those of rules.py: same samples, verdicts, reasons, rationals, ranges and nulls. Cases with a
camera are compared twice, the second time with --clip. The last line counts what was compared. A
run of 500 or more random cases also fails if it met no fragment, no permitted sample, no tie or no
range, or no biased fragment if it was to meet some.

--self-check needs no program: it compares rules.py with the known answers alone.
"""

import argparse
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True  # leave the source tree as it is
sys.path.insert(0, os.path.join(HERE, "second_opinion"))

import generate  # noqa: E402
import rules  # noqa: E402

TIMEOUT_SECONDS = 120  # for one case; a program that hangs fails it
ENOUGH_CASES = 500  # from here on a count of zero is an error
SHOWN = 10  # differences printed in full


class Tally:
    def __init__(self):
        self.cases = self.failures = self.fragments = self.permitted = self.ties = self.ranges = 0
        self.biased = 0

    def count(self, fragments, is_biased=False):
        self.cases += 1
        self.fragments += len(fragments)
        self.biased += len(fragments) if is_biased else 0
        for f in fragments:
            self.permitted += f["verdict"] == "permitted"
            self.ties += f["reason"] == "tie"
            self.ranges += any(isinstance(v, list) for v in [f["depth"], *f["attributes"]])

    def __str__(self):
        return (f"second opinion: {self.cases} cases, {self.fragments} fragments, of which "
                f"{self.permitted} permitted, {self.ties} ties, {self.ranges} with ranges, {self.biased} biased; "
                f"{self.failures} differences")


def ask(binary, case, clip):
    """The program's answer as (fragments, None), or (None, message)."""
    command = [binary, "oracle", "--json"] + (["--clip"] if clip else []) + ["-"]
    try:
        done = subprocess.run(command, input=json.dumps(case), capture_output=True, text=True,
                              timeout=TIMEOUT_SECONDS, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        return None, str(error)
    if done.returncode != 0:
        return None, f"exit code {done.returncode}: {done.stderr.strip()[-500:]}"
    try:
        return json.loads(done.stdout)["fragments"], None
    except (ValueError, KeyError, TypeError) as error:
        return None, f"unreadable output: {error!r}"


def first_difference(program, opinion):
    """None if the lists are equal, else the first pair that differs."""
    for k in range(max(len(program), len(opinion))):
        a = program[k] if k < len(program) else "(none)"
        b = opinion[k] if k < len(opinion) else "(none)"
        if a != b:
            return k, a, b
    return None


def compare(binary, label, case, clip, tally, keep):
    expected = rules.oracle(case, clip)["fragments"]
    fragments, trouble = ask(binary, case, clip)
    if trouble is None:
        tally.count(expected, is_biased="depth_bias" in case)
        difference = first_difference(fragments, expected)
        if difference is None:
            return
        k, a, b = difference
        trouble = (f"fragment {k} of {len(fragments)} (program), {len(expected)} (second opinion)\n"
                   f"  program:        {json.dumps(a)}\n  second opinion: {json.dumps(b)}")
    tally.failures += 1
    if tally.failures <= SHOWN:
        print(f"DIFFERENT: {label} \"{case.get('name', '')}\"{' --clip' if clip else ''}: {trouble}")
    if keep:
        os.makedirs(keep, exist_ok=True)
        name = "".join(c if c.isalnum() else "_" for c in os.path.basename(label)) + ".json"
        with open(os.path.join(keep, name), "w", encoding="utf-8") as file:
            json.dump(case, file, indent=1)


def biased_case(seed):
    """A random case with a bias or a unorm format that rules.py answers."""
    case = generate.random_biased_case(seed)
    if not rules.is_decided(case) or not rules.is_decided(case, clip=True):
        del case["depth_bias"]["slope"]
    return case


def read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def vector_files(folder):
    files = sorted(os.path.join(folder, f) for f in os.listdir(folder) if f.endswith(".json"))
    if not files:
        sys.exit(f"{folder}: no known answers here")
    return files


def self_check(folder):
    """Compares rules.py with the known answers."""
    files = vector_files(folder)
    tally = Tally()
    for path in files:
        vector = read_json(path)
        answer = rules.oracle(vector["case"])
        tally.count(answer["fragments"])
        if answer != vector["oracle"]:
            tally.failures += 1
            print(f"DIFFERENT: {path}: "
                  f"{first_difference(answer['fragments'], vector['oracle']['fragments'])}")
    print(tally)
    return tally.failures == 0 and tally.fragments > 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?", metavar="RASTERCHECK_BINARY")
    parser.add_argument("files", nargs="*", metavar="FILE", help="case files, or known answers")
    parser.add_argument("--cases", type=int, default=200, metavar="N", help="random cases (default 200)")
    parser.add_argument("--biased", type=int, default=0, metavar="N",
                        help="random cases with a depth bias or a unorm format (default 0)")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="first seed (default 1)")
    parser.add_argument("--vectors", metavar="DIR", help="known answers: {\"case\": ..., \"oracle\": ...}")
    parser.add_argument("--keep", metavar="DIR", help="save the cases that differ")
    parser.add_argument("--self-check", action="store_true", help="rules.py against the known answers only")
    options = parser.parse_intermixed_args()
    if options.self_check:
        return 0 if self_check(options.vectors or os.path.join(HERE, "vectors")) else 1
    if not options.binary:
        parser.error("RASTERCHECK_BINARY is missing")

    tally = Tally()

    def both(label, case):
        for clip in (False, True) if "camera" in case else (False,):
            compare(options.binary, label, case, clip, tally, options.keep)

    for path in options.files + (vector_files(options.vectors) if options.vectors else []):
        content = read_json(path)
        case = content.get("case", content)
        if "oracle" in content and rules.oracle(case) != content["oracle"]:
            tally.failures += 1
            print(f"DIFFERENT: {path}: the second opinion contradicts the known answer")
        both(path, case)
    for seed in range(options.seed, options.seed + options.cases):
        both(f"seed {seed}", generate.random_case(seed))
    for seed in range(options.seed, options.seed + options.biased):
        both(f"biased {seed}", biased_case(seed))

    wanted = ["fragments", "permitted", "ties", "ranges"] + (["biased"] if options.biased else [])
    vacuous = [k for k in wanted if getattr(tally, k) == 0]
    if tally.fragments == 0 or (options.cases + options.biased >= ENOUGH_CASES and vacuous):
        print(f"nothing was compared: no {', no '.join(vacuous)}")
        tally.failures += 1
    print(tally)
    return 1 if tally.failures else 0


if __name__ == "__main__":
    sys.exit(main())
