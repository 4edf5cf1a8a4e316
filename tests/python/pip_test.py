"""pip installs the package without a network, and what it installs works."""

import os
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest
import rastercheck

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import build_package  # noqa: E402

# Leads nowhere, so that pip fails if it asks for anything.
OFFLINE = {
    "PIP_INDEX_URL": "http://127.0.0.1:9/",
    "PIP_RETRIES": "0",
    "PIP_CONFIG_FILE": os.devnull,
    "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    "PIP_NO_CACHE_DIR": "1",
}
USE = """
import importlib.metadata, importlib.resources, rastercheck
print(importlib.metadata.version("rastercheck"))
print(importlib.resources.files("rastercheck").joinpath("py.typed").is_file())
print(len(rastercheck.oracle({case!r})))
"""


def output(*command, cwd):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [str(word) for word in command], cwd=cwd, env=environment | OFFLINE, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout
    return done.stdout


def held(wheel):
    """The files of a wheel, by name."""
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture
def version():
    """The version of the project, as the program has it."""
    return rastercheck.program_version()


def test_it_installs_without_a_network(tmp_path, corpus, version):
    python = tmp_path / "venv/bin/python3"
    output(sys.executable, "-m", "venv", "venv", cwd=tmp_path)
    output(python, "-m", "pip", "install", ROOT / "python", cwd=tmp_path)
    used = output(python, "-c", USE.format(case=str(corpus / "behind-the-eye.json")), cwd=tmp_path)
    assert used.split() == [version, "True", "24"]


def test_an_archive_of_the_sources_makes_the_same(tmp_path, version):
    name = build_package.build_sdist(tmp_path)
    with tarfile.open(tmp_path / name) as packed:
        packed.extractall(tmp_path)
    script = "import build_package; print(build_package.build_wheel('..'))"
    wheel = output(sys.executable, "-c", script, cwd=tmp_path / f"rastercheck-{version}").strip()
    again = held(tmp_path / wheel)
    assert f"rastercheck-{version}.dist-info/LICENSE" in again
    assert again == held(tmp_path / build_package.build_wheel(tmp_path))


def test_an_editable_wheel_points_to_the_sources(tmp_path):
    editable = held(tmp_path / build_package.build_editable(tmp_path))
    assert editable["rastercheck.pth"] == f"{ROOT}/python\n".encode()
    assert [name for name in editable if name.startswith("rastercheck/")] == []
