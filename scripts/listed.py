"""What there is, for the scripts that write pages of docs/: laws, generators, mutants."""

import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def listed():
    """What the built program lists, build/release/bin/rastercheck or the one that the environment's
    RASTERCHECK names."""
    program = os.environ.get("RASTERCHECK", ROOT / "build/release/bin/rastercheck")
    return json.loads(subprocess.run([program, "list", "--json"], check=True, capture_output=True).stdout)


def mutants():
    """name -> (fields of its patch's header, lines of its diff), by name. A field's further lines are
    indented."""
    found = {}
    for patch in sorted((ROOT / "tests/mutants").glob("*.patch")):
        lines = patch.read_text().splitlines()
        begin = next(at for at, line in enumerate(lines) if line.startswith("--- "))
        fields, field = {}, None
        for line in lines[:begin]:
            if line.startswith(" ") and field:
                fields[field] += " " + line.strip()
            elif ": " in line:
                field, text = line.split(": ", 1)
                fields[field] = text
        found[patch.stem] = fields, lines[begin:]
    return found
