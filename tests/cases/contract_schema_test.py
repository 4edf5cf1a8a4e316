#!/usr/bin/python3
"""Checks that the contract reader and cases/schema/contract.schema.json agree.

    contract_schema_test.py RASTERCHECK_BINARY SCHEMA

The reader is authoritative; the schema documents it for editors. The schema must be valid, close
every object and describe every key. Both must give the same verdict on a base file and on each
one-step mutation of it, except for the rules in reader_only(), each of which must decide at least
one mutation.

Asks the reader through `rastercheck replay --contract -`, with one process per file.
"""

import concurrent.futures
import copy
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

import schema_test

# Has every key at least once.
FULL_CONTRACT = {
    "format": "rastercheck-contract",
    "version": 1,
    "name": "every key",
    "coverage": {"subpixel_bits": 8, "rounding": {"x": "half_up", "y": "floor"}, "position_error": 0.125},
    "is_on_grid": False,
    "basis": "snapped",
    "tie_rule": "bottom_left",
    "conservative": {
        "kind": "outer",
        "error": 0.5,
        "growth": "0x1p-2",
        "corners": "edges",
        "covers_degenerates": True,
    },
    "guard_band": 16384,
    "culls_instead_of_clipping": True,
    "culls": "clockwise",
    "least_area": 0.5,
    "sample_position": ["7/12", 0],
    "clip_tolerance": "0x1p-1",
    "clip_error": 0.25,
    "viewport_error": 0.5,
    "depth_format": "unorm24",
    "depth_store": "either",
    "depth_bias": {"slope": "between", "unit": "least_value", "exponent": "open"},
    "depth_function": "less_or_equal",
    "depth_error": "never_nearer",
    "claims": "affine",
    "bounds": {
        "smooth": {"constant": 2, "per_horizon": 1, "per_condition": 0.5, "range_share": 0.25, "absolute": 0.5},
        "noperspective": {"constant": "0x1p+0"},
        "depth": {"constant": 1, "per_horizon": 0},
    },
    "keeps_equal_depth": True,
    "keeps_constants": True,
    "keeps_vertex_values": True,
    "keeps_sign_of_zero": False,
    "is_invariant": False,
    "derivative_bound": "none",
    "quad_share": 0.5,
    "numbers": {"least": 0.5, "greatest": 1},
}
WORDS_CONTRACT = {
    "format": "rastercheck-contract",
    "version": 1,
    "coverage": {"steps_per_pixel": 12, "rounding": "unspecified"},
    "guard_beyond_viewport": 2,
    "basis": "as_asked",
    "tie_rule": "unspecified",
    "derivative_bound": 1,
    "conservative": "none",
}
# Names one law, so that only this law is checked, and has nothing to draw.
CASE = {
    "format": "rastercheck-case",
    "version": 1,
    "framebuffer": {"width": 1, "height": 1},
    "viewport": {"x": 0, "y": 0, "width": 1, "height": 1},
    "rules": "vulkan",
    "vertices": [{"position": [0, 0, 0, 1]}],
    "triangles": [[0, 0, 0]],
    "found": {"property": "coverage-obeys-the-contract", "backend": "cpu"},
}


class ContractReader:
    """Asks the program under test."""

    def __init__(self, binary, case_file):
        self.command = [binary, "replay", "--quiet", "--contract", "-", case_file]

    def refusal(self, data):
        """None if the file is accepted, the message if refused; ValueError if neither."""
        done = subprocess.run(
            self.command,
            input=data,
            capture_output=True,
            timeout=schema_test.TIMEOUT_SECONDS,
            check=False,
        )
        said = done.stderr.decode("utf-8", errors="replace")
        if done.returncode == schema_test.EXIT_REFUSED:
            if not said.startswith("rastercheck: -: /"):
                raise ValueError(f"no place: {said!r}")
            return said
        if said:
            raise ValueError(f"exit code {done.returncode}, standard error: {said!r}")
        return None


def number(value):
    return float.fromhex(value) if isinstance(value, str) else value


def reader_only(contract):
    """Why only the reader can refuse a file that the schema accepts; None if it should not."""
    numbers = contract.get("numbers", {})
    if number(numbers.get("least", 0)) > number(numbers.get("greatest", 3.4e38)):
        return "least is above greatest"
    depth = contract.get("bounds", {}).get("depth", {})
    if any(number(value) != 0 for key, value in depth.items() if key not in ("constant", "absolute")):
        return "a bound of depth varies"
    conservative = contract.get("conservative")
    if isinstance(conservative, dict) and conservative.get("kind") == "inner":
        if number(conservative.get("growth", 0)) != 0:
            return "inner coverage grows"
        if conservative.get("corners") == "edges":
            return "inner coverage has shifted edges"
        if conservative.get("covers_degenerates"):
            return "inner coverage of triangles without area"
    return contradiction(contract)


def contradiction(contract):
    """Two members that contradict each other; None if no two do."""
    if "guard_band" in contract and "guard_beyond_viewport" in contract:
        return "two guard bands"
    is_exact = contract.get("coverage") == "exact"
    if is_exact and contract.get("basis") == "snapped":
        return "a basis without a grid"
    if is_exact and "guard_beyond_viewport" in contract:
        return "a guard band without a grid"
    coverage = contract.get("coverage")
    rounding = coverage.get("rounding") if isinstance(coverage, dict) else None
    if isinstance(rounding, dict) and (rounding["x"] == "unspecified") != (rounding["y"] == "unspecified"):
        return "one rounding is unspecified"
    for text in contract.get("sample_position", []):
        if text != 0 and not is_fraction(text):
            return "no fraction below 1"
    return None


def is_fraction(text):
    part, parts = text.split("/")
    return int(part) < int(parts) <= 256


READER_ONLY_RULES = 10  # the reasons above


def mutations(base):
    """(what was done, mutated file) for every mutation of one step."""
    yield from schema_test.mutations(base)
    changed = copy.deepcopy(base)
    changed.setdefault("bounds", {})["depth"] = {"constant": 1, "per_horizon": 1}
    yield "a bound of depth that varies", changed
    for keys in ({"guard_band": 1, "guard_beyond_viewport": 1}, {"coverage": "exact", "basis": "snapped"},
                 {"coverage": "exact", "basis": "ideal", "guard_beyond_viewport": 1},
                 {"coverage": {"subpixel_bits": 1, "rounding": {"x": "floor", "y": "unspecified"}}},
                 {"sample_position": ["3/3", 0]}):
        yield f"{keys}", {**copy.deepcopy(base), **keys}
    for key, value in (("growth", 1), ("corners", "edges"), ("covers_degenerates", True)):
        changed = copy.deepcopy(base)
        changed["conservative"] = {"kind": "inner", key: value}
        yield f"inner coverage with {key}", changed


def main(arguments):
    if len(arguments) != 3:
        print(f"usage: {arguments[0]} RASTERCHECK_BINARY SCHEMA", file=sys.stderr)
        return 2
    schema = json.loads(pathlib.Path(arguments[2]).read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    failures, keys = schema_test.check_schema(schema)
    reasons = set()
    counts = {True: 0, False: 0}
    jobs = []
    for name, base in (("full", FULL_CONTRACT), ("words", WORDS_CONTRACT)):
        for what, contract in itertools.chain([("unchanged", base)], mutations(base)):
            accepted = validator.is_valid(contract)
            reason = reader_only(contract) if accepted else None
            if what == "unchanged" and (reason or not accepted):
                failures.append(f"{name} contract: the schema refuses it")
            if reason:
                reasons.add(reason)
            expected = accepted and not reason
            counts[expected] += 1
            jobs.append((f"{name} contract, {what}", (json.dumps(contract).encode(), expected)))

    with tempfile.TemporaryDirectory() as folder:
        case_file = pathlib.Path(folder) / "case.json"
        case_file.write_text(json.dumps(CASE), encoding="utf-8")
        reader = ContractReader(arguments[1], str(case_file))

        def judge(job):
            data, expected = job
            said = reader.refusal(data)
            if expected and said:
                return f"refused: {said}"
            return None if expected or said else "accepted"

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            failures += schema_test.run_all(pool, judge, jobs)
    if len(reasons) != READER_ONLY_RULES:
        failures.append(f"only these reader's rules were reached: {sorted(reasons)}")

    print(f"{keys} keys, {counts[True]} accepted, {counts[False]} refused")
    for failure in failures[: schema_test.SHOWN_FAILURES]:
        print(f"FAILED {failure}")
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
