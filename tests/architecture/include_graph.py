"""The include graph: which file of the project includes which, and what each folder may include.

The table ALLOWED is that of docs/architecture.md. architecture_test.py checks that the two agree
and that the tree follows them; scripts/architecture-figure draws the actual includes.
"""

import pathlib
import re

# The folders that each folder may include, besides itself, in the order in which data flows.
ALLOWED = {
    "cases": set(),
    "records": {"cases"},
    "oracle": {"cases", "records"},
    "rasterizer": set(),
    "backends": {"cases", "records"},
    "backends/cpu": {"cases", "records", "backends", "rasterizer"},
    "properties": {"cases", "records", "oracle", "backends"},
    "properties/generators": {"cases", "oracle", "properties"},
    "properties/laws": {"cases", "records", "oracle", "backends", "properties"},
    "properties/campaign": {"cases", "records", "oracle", "backends", "properties"},
    "properties/probing": {"cases", "records", "oracle", "backends", "properties", "properties/campaign"},
    "properties/inspect": {"cases", "records", "oracle", "backends", "properties", "properties/campaign"},
    "reports": {"cases", "records"},
    "gate": {"cases", "records", "backends", "properties/campaign", "properties/inspect", "reports"},
    "cli/gallery": {"cases", "records", "rasterizer", "oracle", "backends", "properties", "reports"},
    "cli": {"cases", "records", "rasterizer", "oracle", "backends", "properties", "properties/campaign",
            "properties/probing", "properties/inspect", "reports", "gate", "cli/gallery"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(<([^>]+)>|"([^"]+)")', re.MULTILINE)


def folder_of(path):
    """The folder, as in ALLOWED, of a source path such as backends/cpu/draw.cpp; None if in
    none."""
    parts = pathlib.PurePosixPath(path).parts
    for length in (2, 1):
        room = "/".join(parts[:length])
        if len(parts) > length and room in ALLOWED:
            return room
    return None


def sources(root):
    """(path from the root, text) of every header and source file, tests included."""
    for pattern in ("*.h", "*.cpp"):
        for path in sorted(root.rglob(pattern)):
            relative = path.relative_to(root).as_posix()
            # The examples are a separate project with its own root.
            if not relative.startswith(("build/", "docs/examples/")):
                yield relative, path.read_text(encoding="utf-8")


def local_includes(text):
    """The project's own files that a text includes."""
    return [local for _, _, local in INCLUDE.findall(text) if local]
