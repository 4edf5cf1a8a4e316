#!/usr/bin/python3
"""Checks that the case reader and cases/schema/case.schema.json agree.

    schema_test.py RASTERCHECK_BINARY SCHEMA BROKEN_DIR VALID_DIR...

The reader is authoritative; the schema documents it for editors. Four checks:

  schema     the schema is valid (draft 2020-12), closes every object and describes every key
  valid      both accept every *.json under each VALID_DIR (a case, or {"case": ..., "oracle": ...})
  broken     the reader refuses every file of BROKEN_DIR at the place and for the reason that
             expected.tsv gives; the schema refuses exactly those that expected.tsv assigns to it
  mutations  both give the same verdict on every one-step mutation of two base cases, except for the
             rules in reader_only(), each of which must decide at least one mutation

Asks the reader through `rastercheck oracle --json FILE`, with one process per case. Exit code 0
means "accepted". Exit code 2 with one line `rastercheck: FILE: PLACE: REASON` on standard error and
nothing on standard output means "refused". Anything else fails the test. Needs
python3-jsonschema.
"""

import concurrent.futures
import copy
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys

import jsonschema

TIMEOUT_SECONDS = 120  # of one process: far above what a case needs, even under a sanitizer
SHOWN_FAILURES = 40

EXIT_ACCEPTED = 0
EXIT_REFUSED = 2

# A place is a JSON pointer or LINE:COLUMN; no key in these files contains ": ".
REFUSAL = re.compile(r"(?P<place>/.*?|[1-9][0-9]*:[1-9][0-9]*): (?P<reason>.+)")


# --- The two judges ---------------------------------------------------------------------------


class Reader:
    """Asks the program under test."""

    def __init__(self, binary):
        self.binary = binary

    def refusal(self, source):
        """None if the case is accepted, (place, reason) if refused; ValueError if neither.

        `source` is a path, or bytes for standard input.
        """
        name, data = ("-", source) if isinstance(source, bytes) else (str(source), b"")
        done = subprocess.run(
            [self.binary, "oracle", "--json", name],
            input=data,
            capture_output=True,
            timeout=TIMEOUT_SECONDS,
            check=False,
        )
        said = done.stderr.decode("utf-8", errors="replace")
        if done.returncode == EXIT_ACCEPTED:
            return None
        if done.returncode != EXIT_REFUSED:
            raise ValueError(f"exit code {done.returncode}, standard error: {said!r}")
        prefix = f"rastercheck: {name}: "
        match = REFUSAL.fullmatch(said[len(prefix) :].removesuffix("\n"))
        if not said.startswith(prefix) or not said.endswith("\n") or not match:
            raise ValueError(f"not one line `{prefix}PLACE: REASON`: {said!r}")
        if done.stdout:
            raise ValueError(f"refused, but wrote to standard output: {done.stdout[:80]!r}")
        return match["place"], match["reason"]


def parse_strictly(data):
    """The JSON value of some bytes; ValueError if there is none.

    Stricter than json.loads, as JSON has no NaN or Infinity. Like json.loads and every schema
    validator, does not notice duplicate keys; the last one counts.
    """

    def no_such_number(literal):
        raise ValueError(f"{literal} is not JSON")

    try:
        return json.loads(data.decode("utf-8"), parse_constant=no_such_number)
    except RecursionError as error:
        raise ValueError("nested too deep for this parser") from error


# --- Check 1: the schema itself ---------------------------------------------------------------


def check_schema(schema):
    """Failures of the schema itself, and the number of keys that it describes."""
    jsonschema.Draft202012Validator.check_schema(schema)
    failures = []
    keys = 0

    def walk(node, place):
        nonlocal keys
        if isinstance(node, list):
            for i, child in enumerate(node):
                walk(child, f"{place}/{i}")
        if not isinstance(node, dict):
            return
        if node.get("type") == "object":
            # A map has a schema for its values.
            is_map = isinstance(node.get("additionalProperties"), dict)
            if node.get("additionalProperties") is not False and not is_map:
                failures.append(f"schema: {place} is open for unknown keys")
            for key, child in node.get("properties", {}).items():
                keys += 1
                if not child.get("description"):
                    failures.append(f"schema: {place}/properties/{key} has no description")
        for key, child in node.items():
            walk(child, f"{place}/{key}")

    walk(schema, "#")
    return failures, keys


# --- Check 2: valid cases ---------------------------------------------------------------------


def check_valid(reader, validator, pool, directories):
    """Failures among the valid cases, and the number of these cases."""
    failures = []
    files = []
    for directory in directories:
        found = sorted(pathlib.Path(directory).rglob("*.json"))
        if not found:
            failures.append(f"valid: no *.json under {directory}")
        files += found

    def judge(file):
        data = file.read_bytes()
        value = parse_strictly(data)
        if isinstance(value, dict) and "case" in value:
            value = value["case"]
            data = json.dumps(value).encode()
        error = jsonschema.exceptions.best_match(validator.iter_errors(value))
        if error:
            pointer = "/" + "/".join(map(str, error.absolute_path))
            return f"the schema refuses it: {pointer}: {error.message[:200]}"
        refusal = reader.refusal(data)
        return f"the reader refuses it: {': '.join(refusal)}" if refusal else None

    failures += run_all(pool, judge, [(f"valid: {file}", file) for file in files])
    return failures, len(files)


# --- Check 3: broken cases --------------------------------------------------------------------


def read_expectations(table):
    """expected.tsv as {file: (place, reason, by)}; ValueError if it is not well formed."""
    rows = {}
    for number, line in enumerate(table.read_text(encoding="utf-8").splitlines(), start=1):
        if not line or line.startswith("#"):
            continue
        fields = line.split("\t")
        if len(fields) != 4 or fields[3] not in ("schema", "reader") or not fields[1]:
            raise ValueError(f"{table}:{number}: not FILE, PLACE, REASON, schema|reader: {line!r}")
        if fields[0] in rows:
            raise ValueError(f"{table}:{number}: a second row for {fields[0]}")
        rows[fields[0]] = tuple(fields[1:])
    return rows


def check_broken(reader, validator, pool, directory):
    """Failures among the broken files, and the numbers of files that reader and schema must
    refuse."""
    rows = read_expectations(directory / "expected.tsv")
    files = {file.name for file in directory.glob("*.json")}
    failures = [f"broken: {name} has no row in expected.tsv" for name in sorted(files - set(rows))]
    failures += [f"broken: {name} of expected.tsv is missing" for name in sorted(set(rows) - files)]

    def judge_by_schema(name, by):
        try:
            value = parse_strictly((directory / name).read_bytes())
        except ValueError as error:
            return None if by == "reader" else f"given to the schema, but does not parse: {error}"
        if validator.is_valid(value) == (by == "schema"):
            verdict = "accepts" if by == "schema" else "refuses"
            return f"given to the {by}, but the schema {verdict} it"
        return None

    def judge(name):
        expected_place, expected_reason, by = rows[name]
        refusal = reader.refusal(directory / name)
        if refusal is None:
            return "the reader accepts it"
        place, reason = refusal
        if expected_place not in ("*", place):
            return f"refused at {place}, expected {expected_place} (reason: {reason})"
        if expected_reason not in reason:
            return f"refused at {place} with {reason!r}, expected {expected_reason!r} in it"
        return judge_by_schema(name, by)

    names = sorted(files & set(rows))
    failures += run_all(pool, judge, [(f"broken: {name}", name) for name in names])
    by_schema = sum(rows[name][2] == "schema" for name in names)
    return failures, by_schema, len(names) - by_schema


# --- Check 4: mutations -----------------------------------------------------------------------

# Has every key at least once, with values other than the default where the default would hide a
# fault.
FULL_CASE = {
    "format": "rastercheck-case",
    "version": 1,
    "name": "every key",
    "framebuffer": {"width": 4, "height": 3, "samples": 2},
    "viewport": {
        "x": 0.5,
        "y": "-0x1p-1",
        "width": 4,
        "height": 3,
        "min_depth": 0.25,
        "max_depth": "0x1.8p-1",
    },
    "rules": "d3d",
    "coverage": {"subpixel_bits": 8, "rounding": "half_up", "position_error": 0.125},
    "cull": "back",
    "front_face": "cw",
    "fill_rule": "bottom_left",
    "basis": "snapped",
    "scissor": {"x": -1, "y": 1, "width": 3, "height": 2},
    "depth_test": "less",
    "depth_clear": 0.5,
    "depth_clamp": True,
    "depth_bias": {"constant": -2, "slope": "0x1.8p+0", "clamp": -0.125},
    "depth_format": "unorm16",
    "essential": ["rules", "centroid"],
    "choices": 18446744073709551615,
    "picture": {
        "channels": [{"name": "R", "shows": "u", "background": 0.5}, {"name": "id", "shows": "triangle"}],
        "storage": "srgb8",
        "rounding": "either",
        "first_row": "bottom",
        "resolve": "stored",
        "alpha": "premultiplied",
        "blend": "over",
    },
    "attributes": [
        {"name": "u", "interpolation": "noperspective", "location": "center"},
        {"name": "v", "interpolation": "flat", "location": "centroid"},
    ],
    "camera": {
        "model": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
        "view": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, "0x1p+0", 0, 0, 0, 1],
        "projection": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5, 0, 0, 0, 0.5, 1],
    },
    "vertices": [
        {"position": [-1, "-0x1p+0", 0, 1], "attributes": [0, 1], "clip_distances": [1, 2]},
        {"position": [1, -1, 0], "attributes": ["0x1.8p+1", -2], "clip_distances": [1, -2]},
        {"position": [0, 1, 0.5, 2], "attributes": [4, 0.5], "clip_distances": [2, 0]},
    ],
    "triangles": [[0, 1, 2], [2, 1, 0]],
    "found": {"property": "a", "backend": "cpu", "verdict": "missing", "seed": 1, "index": 2**64 - 1,
              "kind": "coverage", "condition": "tie"},
}

# Has only the required keys, so no camera.
SMALL_CASE = {
    "format": "rastercheck-case",
    "version": 1,
    "framebuffer": {"width": 4, "height": 4},
    "viewport": {"x": 0, "y": 0, "width": 4, "height": 4},
    "rules": "vulkan",
    "vertices": [
        {"position": [-1, -1, 0, 1]},
        {"position": [1, -1, 0, 1]},
        {"position": [0, 1, 0, 1]},
    ],
    "triangles": [[0, 1, 2]],
}

LINES_CASE = {
    **{key: value for key, value in SMALL_CASE.items() if key != "triangles"},
    "lines": [[0, 1], [2, 0]],
    "line_width": 2.5,
    "line_mode": "parallelogram",
}
POINTS_CASE = {
    **{key: value for key, value in SMALL_CASE.items() if key != "triangles"},
    "points": [2, 0],
    "point_size": "0x1p+1",
}
CASES = {"full": FULL_CASE, "small": SMALL_CASE, "lines": LINES_CASE, "points": POINTS_CASE}
# Keys of one kind of primitive, added to cases of the others.
OF_ONE_PRIMITIVE = {"triangles": [], "lines": [], "points": [], "line_width": 1, "line_mode": "bresenham",
                    "point_size": 1, "cull": "none", "depth_bias": {}}

REPLACEMENTS = (None, True, 0, -1, 1.5, "x", [], {}, 1e39)


def reader_only(case):
    """Why only the reader can refuse a case that the schema accepts; None if it should not.

    These rules compare one place of a case with another, which JSON Schema cannot do. Nor can it
    check which numbers are float32, duplicate keys, syntax or nesting depth, but no mutation breaks
    these."""
    count = len(case["vertices"])
    indices = [index for key in ("triangles", "lines") for one in case.get(key, []) for index in one]
    if any(not 0 <= index < count for index in indices + case.get("points", [])):
        return "an index is not below the number of vertices"

    declared = len(case.get("attributes", []))
    if any(len(vertex.get("attributes", [])) != declared for vertex in case["vertices"]):
        return "a vertex does not have one value for each declared attribute"

    distances = {len(vertex.get("clip_distances", [])) for vertex in case["vertices"]}
    if len(distances) > 1:
        return "vertices differ in their number of clip distances"

    def depth(key, default):
        value = case["viewport"].get(key, default)
        return float.fromhex(value) if isinstance(value, str) else value

    if case["rules"] == "d3d" and depth("min_depth", 0) > depth("max_depth", 1):
        return "the depth range of d3d is reversed"
    return None


READER_ONLY_RULES = 4  # the reasons above


def children(value):
    """(key or index, child) of an object or array; nothing for other values."""
    if isinstance(value, dict):
        return list(value.items())
    return list(enumerate(value)) if isinstance(value, list) else []


def places(value, path=()):
    """The paths of a value and of all values within it."""
    yield path
    for key, child in children(value):
        yield from places(child, (*path, key))


def at(value, path):
    """The value at a path."""
    for key in path:
        value = value[key]
    return value


def mutations(base, keys=None, added=()):
    """(what was done, mutated document) for every mutation of one step, all of them or those below these keys; and with
    each of the added members that the document lacks."""

    def mutated(path, change):
        case = copy.deepcopy(base)
        change(at(case, path))
        return case

    for path in places(base):
        if path and keys is not None and path[0] not in keys:
            continue
        pointer = "/" + "/".join(map(str, path))
        value = at(base, path)
        for new in REPLACEMENTS:
            if json.dumps(new) == json.dumps(value):
                continue
            if path:
                case = mutated(path[:-1], lambda parent: parent.__setitem__(path[-1], new))
            else:
                case = copy.deepcopy(new)
            yield f"{pointer} replaced by {json.dumps(new)}", case
        if isinstance(value, dict):
            yield f"{pointer} with an unknown key", mutated(path, lambda o: o.update(unknown=0))
            for key in value:
                yield f"{pointer} without {key}", mutated(path, lambda o: o.pop(key))
        if isinstance(value, list):
            yield (
                f"{pointer} with its first element twice",
                mutated(path, lambda a: a.insert(0, copy.deepcopy(a[0]))),
            )
            yield f"{pointer} without its last element", mutated(path, lambda a: a.pop())
    for key in [key for key in added if key not in base]:
        yield f"with {key}", mutated((), lambda o: o.update({key: added[key]}))


def check_mutations(reader, validator, pool):
    """Failures among the mutations, and how many had each outcome."""
    counts = {"accepted by both": 0, "refused by both": 0}
    reasons = {}
    failures = []
    jobs = []
    for name, base in CASES.items():
        keys = None if name in ("full", "small") else OF_ONE_PRIMITIVE.keys()
        mutated = mutations(base, keys, OF_ONE_PRIMITIVE)
        for what, case in itertools.chain([("unchanged", base)], mutated):
            label = f"mutation: {name} case, {what}"
            accepted_by_schema = validator.is_valid(case)
            reason = reader_only(case) if accepted_by_schema else None
            if what == "unchanged" and (reason or not accepted_by_schema):
                failures.append(f"{label}: the schema refuses it")
            if reason:
                reasons[reason] = reasons.get(reason, 0) + 1
            else:
                counts["accepted by both" if accepted_by_schema else "refused by both"] += 1
            jobs.append((label, (json.dumps(case).encode(), accepted_by_schema, reason)))

    def judge(job):
        data, accepted_by_schema, reason = job
        refusal = reader.refusal(data)
        if reason:
            return None if refusal else f"the reader accepts it, although {reason}"
        if accepted_by_schema and refusal:
            return f"the schema accepts it, the reader says {': '.join(refusal)}"
        if not accepted_by_schema and not refusal:
            return "the schema refuses it, the reader accepts it"
        return None

    failures += run_all(pool, judge, jobs)
    if len(reasons) != READER_ONLY_RULES:
        failures.append(f"mutation: only these reader's rules were reached: {sorted(reasons)}")
    return failures, counts, reasons


# --- Running ----------------------------------------------------------------------------------


def run_all(pool, judge, jobs):
    """Judges (label, argument) jobs in parallel; returns the failures in the order of the jobs."""

    def run(job):
        label, argument = job
        try:
            problem = judge(argument)
        except (ValueError, OSError, subprocess.TimeoutExpired) as error:
            problem = str(error)
        return f"{label}: {problem}" if problem else None

    return [failure for failure in pool.map(run, jobs) if failure]


def main(arguments):
    if len(arguments) < 5:
        usage = "RASTERCHECK_BINARY SCHEMA BROKEN_DIR VALID_DIR..."
        print(f"usage: {arguments[0]} {usage}", file=sys.stderr)
        return 2
    reader = Reader(arguments[1])
    schema = json.loads(pathlib.Path(arguments[2]).read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failures, keys = check_schema(schema)
        valid_failures, valid = check_valid(reader, validator, pool, arguments[4:])
        broken_failures, by_schema, by_reader = check_broken(
            reader, validator, pool, pathlib.Path(arguments[3])
        )
        mutation_failures, counts, reasons = check_mutations(reader, validator, pool)
    failures += valid_failures + broken_failures + mutation_failures

    totals = {
        "keys described by the schema": keys,
        "valid cases": valid,
        "broken files, refused by both": by_schema,
        "broken files, refused by the reader alone": by_reader,
        **{f"mutations {outcome}": count for outcome, count in counts.items()},
        **{f"mutations for the reader alone: {reason}": n for reason, n in sorted(reasons.items())},
    }
    for name, count in totals.items():
        print(f"{count:6} {name}")
        if count == 0:
            failures.append(f"nothing was checked: 0 {name}")

    for failure in failures[:SHOWN_FAILURES]:
        print(f"FAILED {failure}")
    if len(failures) > SHOWN_FAILURES:
        print(f"FAILED {len(failures) - SHOWN_FAILURES} more")
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
