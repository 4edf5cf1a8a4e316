#!/usr/bin/python3
"""Checks that the reader of run.json and reports/schema/run.schema.json agree.

    run_schema_test.py RASTERCHECK_BINARY SCHEMA RUN_JSON

The schema must be valid, close every object and describe every key. Both must accept RUN_JSON, a
run with every key except those added here, and a run that the program itself writes. In every
object of RUN_JSON, each key is left out, an unknown key is added, and each value is replaced by one
of another type: the schema must refuse exactly what the reader refuses. Leaves alone numbers that
only the reader can judge, because it compares them with others. Asks the reader through
`rastercheck report DIR`. Needs python3-jsonschema.
"""

import concurrent.futures
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import warnings

import jsonschema

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cases"))
from schema_test import TIMEOUT_SECONDS, at, check_schema, places, run_all  # noqa: E402

# Values to try in turn until one has another type than the replaced value.
REPLACEMENTS = (None, "\u2026", [[]], {"": []})
# The number of an array's elements that are tried: the others have the same form.
SHOWN_ELEMENTS = 2


def validator_of(schema_file, schema):
    """A validator that follows references to the schemas of cases and of known-defect lists."""
    with warnings.catch_warnings():
        # Debian 12 has no other way yet, but later versions of jsonschema warn about this one.
        warnings.simplefilter("ignore", DeprecationWarning)
        resolver = jsonschema.RefResolver(schema_file.resolve().as_uri(), schema)
        return jsonschema.Draft202012Validator(schema, resolver=resolver)


def accepts(binary, document):
    """True if the program accepts the run, False if it refuses; ValueError if neither."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "run.json"
        file.write_text(json.dumps(document), encoding="utf-8")
        done = subprocess.run(
            [binary, "report", folder, "--format", "cases", "--quiet"],
            capture_output=True, timeout=TIMEOUT_SECONDS, check=False)
    said = done.stderr.decode("utf-8", errors="replace")
    # A run without cases cannot give the requested file; the program says so only after it has read
    # the run.
    if done.returncode == 0 or "the run kept no cases" in said:
        return True
    if done.returncode != 2 or not said.startswith(f"rastercheck: {file}: /"):
        raise ValueError(f"exit code {done.returncode}, standard error: {said!r}")
    return False


def shortened(value):
    """The document with only a few elements in each array: this test is about forms, not sizes."""
    if isinstance(value, dict):
        return {key: shortened(child) for key, child in value.items()}
    if isinstance(value, list):
        return [shortened(child) for child in value[:SHOWN_ELEMENTS]]
    return value


def is_case(path):
    """True if a place is in a case file or a known-defect list, which have tests of their own."""
    return any(key in ("case", "terms", "list", "saved") and path[:1] != ("records",) for key in path)


def of_another_type(value):
    """A value of another type."""
    return next(new for new in REPLACEMENTS if type(new) is not type(value))


def mutations(base):
    """(what was done, changed document) for every change of one step."""
    for path in places(base):
        if is_case(path):
            continue
        pointer = "/" + "/".join(map(str, path))
        value = at(base, path)
        if path:
            changed = copy.deepcopy(base)
            at(changed, path[:-1])[path[-1]] = of_another_type(value)
            yield f"{pointer} of another type", changed
        if isinstance(value, dict):
            changed = copy.deepcopy(base)
            at(changed, path)["unknown"] = {}
            yield f"{pointer} with an unknown key", changed
            for key in value:
                if key == "shard":
                    continue  # stands in two places, each of which needs the other
                changed = copy.deepcopy(base)
                del at(changed, path)[key]
                yield f"{pointer} without {key}", changed


def complete(document):
    """The document with the keys that it lacks."""
    document["plan"] |= {
        "contract": {"file": "mine.json", "terms": {"format": "rastercheck-contract", "version": 1}},
        "capabilities": {"cpu": {
            "rules": ["opengl"], "sample_counts": [1, 4], "lacks": ["flat"], "max_size": 64, "max_viewport": 64,
            "max_attributes": 2, "max_clip_distances": 1, "numbers": {"least": "0x1p-4", "greatest": "0x1p+4"}}},
        "promise": "spec", "draw_by": "append", "corpus": "a folder", "known": ["another"], "ignores_known": True, "scene_size": 640,
        "shrink_tries": 5, "shrink_seconds": 2.5, "power": 5, "require_cases": 20,
        "keeps_cases": True,
        "shard": {"index": 2, "count": 7}}
    document["cases_left"] = 3
    document["records"][0]["power"] = {"values NaN": {"drawings": 5, "noticed": 4}}
    document["specimens"] = [
        {"property": "a", "backend": "cpu", "origin": "random", "index": 3, "name": "b", "triangle": 0,
         "left": 1, "top": 2, "width": 2, "height": 1, "samples": 1, "attributes": 1,
         "rows": ["3f000000:40490fdb -"]}]
    document["shard"] = {
        "is_whole": True, "corpus_digest": "c", "known_digest": "k",
        "scene_digest": "s", "saved": [copy.deepcopy(document["counterexamples"][0]["case"])],
        "promises": [{"backend": "cpu", "has_limits": False, "promise": "ieee", "draws_what_is_asked_for": True,
                      "unpromised": ["a"]}]}
    document["held_to"] = {"cpu": "ieee"}
    document["unexpected_passes"] = [
        {"backend": "cpu", "id": "driver-2", "property": "a", "staleness": "other version"}]
    document["known"] = [{"backend": "cpu", "file": "f", "driver_version": "Mesa 23", "run_out": ["driver-1"], "list": {
        "format": "rastercheck-known", "version": 1,
        "driver": {"name": "driver", "version": "Mesa 22"}, "entries": []}}]
    return document


def written(binary):
    """The run.json that the program writes for a small run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [binary, "run", "--seed", "1", "--cases", "3", "--keep-cases", "--quiet",
                   "--backend", "method:screen-linear", "--output", folder]
        done = subprocess.run(command, capture_output=True, check=False)
        if done.returncode not in (0, 1):
            raise ValueError(f"{command}: {done.stderr!r}")
        return json.loads((pathlib.Path(folder) / "run.json").read_text(encoding="utf-8"))


def main(arguments):
    binary, schema_file, run_file = arguments[1:]
    schema = json.loads(pathlib.Path(schema_file).read_text(encoding="utf-8"))
    validator = validator_of(pathlib.Path(schema_file), schema)
    failures, keys = check_schema(schema)
    whole = complete(json.loads(pathlib.Path(run_file).read_text(encoding="utf-8")))
    base = shortened(whole)
    missing = set(schema["properties"]) - set(base)
    if missing:
        failures.append(f"the run of this test lacks {sorted(missing)}")
    for what, document in (("approved", whole), ("written", written(binary))):
        error = jsonschema.exceptions.best_match(validator.iter_errors(document))
        if error:
            pointer = "/" + "/".join(map(str, error.absolute_path))
            failures.append(f"the schema refuses what was {what}: {pointer}: {error.message[:300]}")

    def judge(job):
        document, is_valid = job
        is_read = accepts(binary, document)
        return None if is_valid == is_read else f"schema: {is_valid}, reader: {is_read}"

    # Validators that follow references keep their place as state, so threads must not share them.
    jobs = [(what, (document, validator.is_valid(document)))
            for what, document in (("unchanged", base), *mutations(base))]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failures += run_all(pool, judge, jobs)
    for failure in failures[:40]:
        print(failure)
    print(f"{keys} keys described, {len(jobs)} documents judged by both, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
