"""The include graph: which file of the project includes which, and what the folders may include.

The table ALLOWED is the one of docs/architecture.md; architecture_test.py holds the two together and the
tree to it, and scripts/architecture-figure draws what the tree really does.
"""

import pathlib
import re

# What each folder may include, beside itself, in the order of the flow.
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
    """The room of a source path such as backends/cpu/draw.cpp; None outside the rooms."""
    parts = pathlib.PurePosixPath(path).parts
    for length in (2, 1):
        room = "/".join(parts[:length])
        if len(parts) > length and room in ALLOWED:
            return room
    return None


def sources(root):
    """(path from the root, text) of every header and source file, tests too."""
    for pattern in ("*.h", "*.cpp"):
        for path in sorted(root.rglob(pattern)):
            relative = path.relative_to(root).as_posix()
            # The examples are a project of their own, with a root of their own.
            if not relative.startswith(("build/", "docs/examples/")):
                yield relative, path.read_text(encoding="utf-8")


def local_includes(text):
    """The project's files that a file's text includes."""
    return [local for _, _, local in INCLUDE.findall(text) if local]
