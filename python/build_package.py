"""Builds the package for pip (PEP 517 and PEP 660), with nothing but Python.

A backend of its own, because pip downloads setuptools into every build that names it. A wheel is a
zip archive of the modules, and of a folder *.dist-info that describes them (PEP 427).
"""

import base64
import hashlib
import io
import re
import tarfile
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
WHEEL = "Wheel-Version: 1.0\nGenerator: rastercheck\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def version():
    """The version of the project; in an unpacked archive, that of its PKG-INFO."""
    packed = HERE / "PKG-INFO"
    if packed.exists():
        return re.search(r"^Version: (\S+)$", packed.read_text(encoding="utf-8"), re.MULTILINE)[1]
    lists = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(RasterCheck VERSION ([\d.]+)", lists, re.MULTILINE)[1]


def metadata():
    """The text of METADATA, which PKG-INFO equals."""
    project = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {project['name']}",
        f"Version: {version()}",
        f"Summary: {project['description']}",
        f"License: {project['license']['text']}",
        f"Requires-Python: {project['requires-python']}",
    ]
    for extra, packages in project["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f"Requires-Dist: {package}; extra == '{extra}'" for package in packages]
    return "\n".join(lines) + "\n"


def modules():
    """The files of the package, by their paths in it."""
    files = sorted((HERE / "rastercheck").iterdir())
    return {
        f"rastercheck/{path.name}": path.read_bytes()
        for path in files
        if path.suffix == ".py" or path.name == "py.typed"
    }


def licence():
    return next(path for path in (HERE / "LICENSE", ROOT / "LICENSE") if path.exists()).read_bytes()


def write_wheel(folder, files):
    """Writes a wheel of these files, and returns its name."""
    stem = f"rastercheck-{version()}"
    info = f"{stem}.dist-info"
    files = {
        **files,
        f"{info}/METADATA": metadata().encode(),
        f"{info}/WHEEL": WHEEL.encode(),
        f"{info}/LICENSE": licence(),
    }
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"{stem}-py3-none-any.whl"
    with zipfile.ZipFile(Path(folder) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    return write_wheel(wheel_directory, modules())


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    return write_wheel(wheel_directory, {"rastercheck.pth": f"{HERE}\n".encode()})


def build_sdist(sdist_directory, config_settings=None):
    stem = f"rastercheck-{version()}"
    own = ("pyproject.toml", "build_package.py")
    files = {
        **{name: (HERE / name).read_bytes() for name in own},
        **modules(),
        "PKG-INFO": metadata().encode(),
        "LICENSE": licence(),
    }
    with tarfile.open(Path(sdist_directory) / f"{stem}.tar.gz", "w:gz") as archive:
        for name, data in files.items():
            entry = tarfile.TarInfo(f"{stem}/{name}")
            entry.size = len(data)
            archive.addfile(entry, io.BytesIO(data))
    return f"{stem}.tar.gz"
