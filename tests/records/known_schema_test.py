#!/usr/bin/python3
"""Checks that the reader of known-defect lists and cases/schema/known.schema.json agree.

    known_schema_test.py RASTERCHECK_BINARY SCHEMA LISTS_DIR

The schema must be valid, close every object and describe every key. Both must accept every
LISTS_DIR/*/known.json, whose cases must say which of their entry's properties they violate, and give
the same verdict on every one-step change of a list with every key, except for rules that compare two
places. Asks the reader through `rastercheck list known`. Needs python3-jsonschema.
"""

import concurrent.futures
import fnmatch
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cases"))
from schema_test import TIMEOUT_SECONDS, check_schema, mutations, run_all  # noqa: E402

DRIVER = "a-driver"
FULL_LIST = {
    "format": "rastercheck-known",
    "version": 1,
    "driver": {"name": DRIVER, "version": "Mesa 22.3.6"},
    "entries": [
        {
            "id": "a-driver-1",
            "reason": "Why.",
            "backends": ["gl:a-driver", "vulkan:*"],
            "until": "2027-01-31",
            "rule": "14.6.1",
            "finding": "a-driver-1",
            "properties": ["a law", "*edge*"],
            "verdicts": ["beyond bound", "crash"],
            "when": {
                "rules": ["vulkan", "opengl"],
                "primitive": ["lines", "points"],
                "samples": [2, 4],
                "attribute_kind": ["depth", "smooth"],
                "interpolation": ["flat", "noperspective"],
                "location": ["centroid", "center"],
                "note": "lost",
                **{
                    fact: True
                    for fact in (
                        "nonpositive_w", "clipped", "depth_clipped", "before_near", "beyond_far",
                        "perspective", "tie", "degenerate", "clip_distances", "depth_clamp",
                        "depth_test", "depth_clear", "depth_bias", "unorm_depth", "snapped",
                        "scissor", "culling", "reversed_depth_range", "negative_height",
                        "fractional_viewport", "beyond_viewport",
                    )
                },
                **{
                    limit: 2.5
                    for limit in (
                        "error_at_most", "distance_at_most", "largest_coordinate_at_least",
                        "w_ratio_at_least", "height_at_most", "largest_value_at_least",
                        "least_value_at_most", "point_size_at_most",
                    )
                },
            },
            "case": "known/a-driver-1.json",
        }
    ],
}
WAIVERS = {
    "format": "rastercheck-known",
    "version": 1,
    "entries": [
        {
            "id": "mine-1",
            "reason": "Why.",
            "verdicts": ["extra"],
            "when": {"tie": True},
            "case": "known/mine-1.json",
        },
        {"id": "a law", "reason": "Why.", "properties": ["a law"], "expected": "fail"},
    ],
}


def accepts(binary, document):
    """True if the program accepts the list, False if it refuses; ValueError if neither."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "known.json"
        file.write_text(json.dumps(document), encoding="utf-8")
        done = subprocess.run(
            [binary, "list", "known", "--known", file, "--json"],
            capture_output=True,
            timeout=TIMEOUT_SECONDS,
            check=False,
        )
    said = done.stderr.decode("utf-8", errors="replace")
    if done.returncode == 0:
        return True
    if done.returncode != 2 or not said.startswith(f"rastercheck: {file}: /"):
        raise ValueError(f"exit code {done.returncode}, standard error: {said!r}")
    return False


def reader_only(document):
    """True if only the reader can refuse the list, because the rule compares two places."""
    ids = [entry["id"] for entry in document["entries"]]
    return len(set(ids)) < len(ids)


def check_mutations(binary, validator, pool):
    """Failures among the mutations, and the number of mutations."""
    jobs = [("unchanged", FULL_LIST), *mutations(FULL_LIST)]
    jobs += [("unchanged waivers", WAIVERS), *mutations(WAIVERS)]

    def judge(document):
        is_valid = validator.is_valid(document)
        is_read = accepts(binary, document)
        if is_valid and reader_only(document):
            return "the reader accepts it" if is_read else None
        if is_valid == is_read:
            return None
        return f"schema: {is_valid}, reader: {is_read}"

    return run_all(pool, judge, jobs), len(jobs)


def faults_of_cases(file):
    """What is wrong with the cases of a list: a run reads them before it judges anything."""
    for entry in json.loads(file.read_text(encoding="utf-8"))["entries"]:
        place = f"{file}: {entry['id']}: {entry['case']}"
        case = file.parent / entry["case"]
        found = json.loads(case.read_text(encoding="utf-8")).get("found") if case.exists() else None
        if found is None:
            yield f"{place}: missing, or says not what was found"
        elif not any(fnmatch.fnmatchcase(found["property"], name) for name in entry["properties"]):
            yield f"{place}: violates a property that is not the entry's"
        elif found["verdict"] not in entry["verdicts"]:
            yield f"{place}: has a verdict that is not the entry's"


def main(arguments):
    binary, schema_file, lists = arguments[1:]
    schema = json.loads(pathlib.Path(schema_file).read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    failures, keys = check_schema(schema)
    if not validator.is_valid(FULL_LIST):
        failures.append("the schema refuses the list of this test")
    if set(FULL_LIST["entries"][0]["when"]) != set(schema["$defs"]["conditions"]["properties"]):
        failures.append("the list of this test does not have every condition of the schema")
    files = sorted(pathlib.Path(lists).glob("*/known.json"))
    for file in files:
        error = jsonschema.exceptions.best_match(
            validator.iter_errors(json.loads(file.read_text(encoding="utf-8")))
        )
        if error:
            failures.append(f"{file}: {error.message[:200]}")
        failures += faults_of_cases(file)
    done = subprocess.run([binary, "list", "known", "--known", lists], check=False)
    if done.returncode != 0:
        failures.append(f"the reader refuses a list of {lists}")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        mutation_failures, count = check_mutations(binary, validator, pool)
    failures += mutation_failures
    for failure in failures[:40]:
        print(failure)
    print(f"{keys} keys, {len(files)} lists, {count} mutations, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
