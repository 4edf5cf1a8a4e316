"""Lists properties, generators and mutants for the scripts that write pages of docs/."""

import hashlib
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The built program, or the one that the environment variable RASTERCHECK names.
PROGRAM = os.environ.get("RASTERCHECK", ROOT / "build/release/bin/rastercheck")


def listed():
    """Everything that the built program lists."""
    return json.loads(subprocess.run([PROGRAM, "list", "--json"], check=True, capture_output=True).stdout)


def mutants(folder="tests/mutants"):
    """Maps names, sorted, to (fields of the patch's header, lines of its diff). In the header, the
    continuation lines of a field are indented."""
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
    """A digest of what a mutant changes, in twelve digits. Results about the mutant stay valid as
    long as the digest is the same."""
    changes = [fields["Of"], *(line for line in diff if line.startswith(("-", "+")))]
    return hashlib.sha256("\n".join(changes).encode()).hexdigest()[:12]
