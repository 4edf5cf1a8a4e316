"""Settings of all tests here: Hypothesis tries the same examples each time, and leaves no files."""

import stat
from pathlib import Path

import hypothesis
import pytest

hypothesis.settings.register_profile(
    "tests", derandomize=True, database=None, deadline=None, max_examples=12
)
hypothesis.settings.load_profile("tests")


@pytest.fixture
def corpus():
    """The folder of the corpus."""
    return Path(__file__).resolve().parents[2] / "cases/corpus"


@pytest.fixture
def stand_in(tmp_path, monkeypatch):
    """Makes a shell script the program that the package runs."""

    def make(script):
        path = tmp_path / "stand-in"
        path.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        monkeypatch.setenv("RASTERCHECK", str(path))
        return path

    return make
