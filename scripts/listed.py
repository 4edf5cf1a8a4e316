"""What there is, for the scripts that write pages of docs/: laws, generators, mutants."""

import hashlib
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The built program, or the one that the environment's RASTERCHECK names.
PROGRAM = os.environ.get("RASTERCHECK", ROOT / "build/release/bin/rastercheck")


def listed():
    """What the built program lists."""
    return json.loads(subprocess.run([PROGRAM, "list", "--json"], check=True, capture_output=True).stdout)


def mutants(folder="tests/mutants"):
    """name -> (fields of its patch's header, lines of its diff), by name. A field's further lines are
    indented."""
    found = {}
    for patch in sorted((ROOT / folder).glob("*.patch")):
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


def key_of(fields, diff):
    """What a mutant changes, in twelve digits: what is known of it holds while that is the same."""
    changes = [fields["Of"], *(line for line in diff if line.startswith(("-", "+")))]
    return hashlib.sha256("\n".join(changes).encode()).hexdigest()[:12]
