#!/usr/bin/python3
"""Checks that the readers of baselines and policies agree with their schemas.

    gate_schema_test.py RASTERCHECK_BINARY BASELINE_SCHEMA POLICY_SCHEMA

The schemas must be valid, close every object and describe every key. Schema and reader must give
the same verdict on every one-step change of a file of each kind with every key, except for rules
that compare two places. Asks the readers through `rastercheck compare`. Needs
python3-jsonschema.
"""

import concurrent.futures
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cases"))
from schema_test import TIMEOUT_SECONDS, check_schema, children, mutations, run_all  # noqa: E402
from run_schema_test import validator_of  # noqa: E402

KINDS = ("coverage", "depth", "smooth", "noperspective", "flat")
STRATA = ("clipped", "near horizon", "sliver", "multisampled", "ordinary")
STAGES = (
    "transform", "clip space", "snap", "set-up", "coverage", "weights", "evaluation", "rounding",
    "left open", "excess", "bias", "store",
)
CLASSES = (
    "correct", "beyond bound", "missing", "extra", "wrong triangle", "not a number", "infinite",
    "wrong sign of zero",
)
DIGEST = "0123456789abcdef"
WORST = {
    "error": [-0.5, 0.75], "exact": "1/3", "actual": "0x1p-2", "triangle": 0, "x": 3, "y": 5,
    "sample": 0, "attribute": 1,
}
SUM = {"lo": "-12", "hi": "34", "count": 5, "beyond": 6}
BASELINE = {
    "format": "rastercheck-baseline",
    "version": 3,
    "sections": [
        {
            "backend": "cpu", "architecture": "x86_64", "instruction_set": "avx2",
            "compiler": "GNU 12.2.0", "records_version": 3, "rules_version": 1,
            "plan": {
                "seed": 1, "cases_per_property": 100, "property_patterns": ["*"], "corpus": "c", "known": ["k"],
                "ignores_known": True, "power": 5,
            },
            "taken": {
                "backend": "cpu", "version": "0.1.0", "commit": "", "instruction_set": "avx2",
                "compiler": "GNU 12.2.0",
            },
            "approvals": [
                {"reason": "why", "version": "0.1.0", "commit": "", "changes": ["a"]},
            ],
            "entries": [
                {
                    "property": "a law", "kind": "coverage", "stratum": "sliver",
                    "cases": {"checked": 3, "not_applicable": 1, "violations": 1, "known": 1},
                    "power": {"drawings": 7, "noticed": 6},
                    "classes": {name: 1 for name in CLASSES},
                    "not_judged": 2,
                    "worst": [0.5, 0.75],
                    "histogram": {"buckets": [[0, 1], [482, 2]], "non_finite": 1},
                    "stages": {"set-up": SUM},
                },
            ],
            "properties": [{"property": "a law", "cases": 3, "digest": DIGEST}],
            "corpus": [[0, "a name"]],
            "cases": [
                {
                    "property": "a law",
                    "cases": [
                        {
                            "corpus": 0, "found": DIGEST, "outcome": "violated", "mismatches": 1,
                            "worst": {"smooth": {"sliver": WORST}},
                        },
                        {"random": 0, "found": DIGEST},
                    ],
                },
            ],
            "specimens": [
                {
                    "property": "a law", "backend": "cpu", "origin": "random", "index": 1,
                    "name": "a name", "triangle": 0, "left": 3, "top": 5, "width": 2, "height": 1,
                    "samples": 1, "attributes": 1, "rows": ["- 3f000000:7fc00000"],
                },
            ],
        },
    ],
}


def with_all_names():
    """The baseline with every kind, stratum and stage; used unchanged, without mutations."""
    document = copy.deepcopy(BASELINE)
    section = document["sections"][0]
    section["entries"][0]["stages"] = {name: SUM for name in STAGES}
    section["cases"][0]["cases"][0]["worst"] = {
        kind: {stratum: WORST for stratum in STRATA} for kind in KINDS
    }
    return document


POLICY = {
    "format": "rastercheck-policy",
    "version": 1,
    "allow": [
        {
            "property": "a*", "backend": "cpu", "kind": "*", "stratum": "all", "reason": "why",
            "until": "2026-12-31", "worst": 0.75,
        },
        {"reason": "why", "until": "2026-02-28"},
    ],
}
EMPTY = {"format": "rastercheck-baseline", "version": 3, "sections": []}


def number(value):
    return float(value)


def sections_repeat(document):
    def repeats(keys):
        keys = list(keys)
        return len(set(keys)) < len(keys)

    def key(section):
        names = ("backend", "architecture", "instruction_set", "compiler")
        return tuple(section.get(name, "") for name in names)

    if repeats(key(section) for section in document["sections"]):
        return True
    for section in document["sections"]:
        entries = ((e["property"], e["kind"], e.get("stratum")) for e in section["entries"])
        laws = [law["property"] for law in section["properties"]]
        of_cases = [
            (one["property"], "corpus" in each, each.get("corpus", each.get("random")))
            for one in section["cases"]
            for each in one["cases"]
        ]
        if repeats(entries) or repeats(laws) or repeats(of_cases):
            return True
        if repeats(index for index, _ in section["corpus"]):
            return True
    return False


def law_is_missing(document):
    return any(
        one["property"] not in [law["property"] for law in section["properties"]]
        for section in document["sections"]
        for one in section["cases"]
    )


def specimen_has_other_rows(document):
    """True if the number or the length of the rows differs from what the specimen says."""

    def is_other(one):
        words = one["attributes"] + 1
        samples = [row.split(" ") for row in one["rows"]]
        return len(samples) != one["height"] or any(
            len(row) != one["width"] * one["samples"]
            or any(each != "-" and len(each.split(":")) != words for each in row)
            for row in samples
        )

    return any(
        is_other(one) for section in document["sections"] for one in section.get("specimens", [])
    )


def walk(value):
    yield value
    for _, child in children(value):
        yield from walk(child)


def is_out_of_order(document):
    for value in walk(document):
        if not isinstance(value, dict):
            continue
        for name in ("worst", "error"):
            ends = value.get(name)
            if isinstance(ends, list) and number(ends[0]) > number(ends[1]):
                return True
        if "buckets" in value:
            buckets = [bucket for bucket, _ in value["buckets"]]
            if buckets != sorted(set(buckets)):
                return True
        if "noticed" in value and number(value["noticed"]) > number(value["drawings"]):
            return True
        if "beyond" in value and "lo" in value:
            lo, hi, most = int(value["lo"]), int(value["hi"]), value["count"] << 72
            if lo > hi or lo < -most or hi > most:
                return True
    return False


def reader_only(document):
    """True if only the reader can refuse the file, because the rule compares two places."""
    return "sections" in document and (
        sections_repeat(document)
        or law_is_missing(document)
        or is_out_of_order(document)
        or specimen_has_other_rows(document)
    )


def is_read(binary, document, empty):
    """True if the program accepts the file, False if it refuses; ValueError if neither."""
    is_policy = document is not None and isinstance(document, dict) and "allow" in document
    arguments = ["--policy", "-", empty, empty] if is_policy else ["-", empty]
    done = subprocess.run(
        [binary, "compare", *arguments],
        input=json.dumps(document).encode(),
        capture_output=True,
        timeout=TIMEOUT_SECONDS,
        check=False,
    )
    said = done.stderr.decode("utf-8", errors="replace")
    if said.startswith("rastercheck: -: /"):
        return False
    if done.returncode != 0 and "there is nothing to compare" not in said:
        raise ValueError(f"exit code {done.returncode}, standard error: {said!r}")
    return True


def check(binary, validator, base, key, empty, pool):
    # Without these keys a file is of neither kind, so no reader is asked.
    def is_of_kind(document):
        if not isinstance(document, dict) or key not in document:
            return False
        return document.get("format") == base["format"]

    jobs = [("unchanged", base)] + [job for job in mutations(base) if is_of_kind(job[1])]
    if key == "sections":
        jobs.append(("with all names", with_all_names()))
    reached = sum(validator.is_valid(job[1]) and reader_only(job[1]) for job in jobs)

    def judge(document):
        is_valid = validator.is_valid(document) and not reader_only(document)
        reads = is_read(binary, document, empty)
        return None if is_valid == reads else f"schema: {is_valid}, reader: {reads}"

    return run_all(pool, judge, jobs), len(jobs), reached


def main(arguments):
    binary, baseline_schema, policy_schema = arguments[1:]
    failures = []
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(
        os.cpu_count()
    ) as pool:
        empty = pathlib.Path(folder) / "empty.json"
        empty.write_text(json.dumps(EMPTY), encoding="utf-8")
        for file, base, key in (
            (baseline_schema, BASELINE, "sections"),
            (policy_schema, POLICY, "allow"),
        ):
            schema = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))
            of_schema, keys = check_schema(schema)
            validator = validator_of(pathlib.Path(file), schema)
            if not validator.is_valid(base):
                of_schema.append(f"{file}: refuses the file of this test")
            found, count, reached = check(binary, validator, base, key, str(empty), pool)
            failures += of_schema + found
            print(f"{file}: {keys} keys, {count} mutations, {reached} by reader's rules only")
            if key == "sections" and reached == 0:
                failures.append("no rule of the reader's own was reached")
    for failure in failures[:40]:
        print(failure[:300])
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
