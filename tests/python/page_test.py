"""The programs that docs/python.md shows are those that its commands run."""

import textwrap
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.mark.parametrize("name", ["exact.py", "test_mine.py"])
def test_the_page_shows_the_file(name):
    shown = textwrap.indent((DOCS / "examples/python" / name).read_text(encoding="utf-8"), "    ")
    assert f"\n{shown}\n" in (DOCS / "python.md").read_text(encoding="utf-8")
