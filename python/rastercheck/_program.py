"""Finds the program rastercheck and runs it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

from ._errors import BackendUnavailable, BadInput, ProgramError, ProgramNotFound, TimedOut

PathLike = Union[str, "os.PathLike[str]"]

# Seconds that the program has to end by itself once it is asked to. A run ends its workers and
# saves what it found in less than two.
_GRACE = 10.0


@dataclass(frozen=True)
class Ended:
    """A run of the program that ended with an expected exit code."""

    exit_code: int
    output: str


def find_program() -> str:
    """The path of the program: the environment variable RASTERCHECK, or else the first rastercheck
    on PATH. Raises ProgramNotFound."""
    named = os.environ.get("RASTERCHECK")
    found = shutil.which(named or "rastercheck")
    if found:
        return found
    if named:
        raise ProgramNotFound(
            f"RASTERCHECK is {named!r}, which is not a program; "
            "set it to the path of rastercheck, or unset it to use the one on PATH"
        )
    raise ProgramNotFound(
        "rastercheck is not on PATH; install the program, "
        "or set the environment variable RASTERCHECK to its path"
    )


def program_version() -> str:
    """The version of the program, as `rastercheck --version` prints it: "0.1.0"."""
    printed = call(["--version"], timeout=60).output.split()
    if len(printed) != 2 or printed[0] != "rastercheck":
        raise ProgramNotFound(
            f"{find_program()} is not RasterCheck: --version printed {' '.join(printed)!r}"
        )
    return printed[1]


def call(
    words: Sequence[str],
    *,
    given: str | None = None,
    expected: Collection[int] = (0,),
    timeout: float | None = None,
) -> Ended:
    """Runs the program with these arguments, and `given` on its standard input. Raises an exception
    for exit codes that are not expected, and after `timeout` seconds."""
    __tracebackhide__ = True  # pytest shows the caller's line, and the message
    command = (find_program(), *words)
    try:
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL if given is None else subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
        )
    except OSError as error:
        raise ProgramNotFound(f"{command[0]} cannot be started: {error.strerror}") from None
    try:
        output, complaint = process.communicate(given, timeout)
    except subprocess.TimeoutExpired:
        _stop(process)
        raise TimedOut(f"rastercheck {words[0]} did not end within {timeout:g} seconds") from None
    except BaseException:  # such as KeyboardInterrupt: the program must not go on alone
        _stop(process)
        raise
    if process.returncode not in expected:
        raise _error(process.returncode, complaint, command)
    return Ended(process.returncode, output)


def _stop(process: subprocess.Popen[str]) -> None:
    """Ends the program: asks it to end, so that it also ends its workers, before it is killed."""
    process.terminate()
    try:
        process.communicate(timeout=_GRACE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()


def _error(exit_code: int, complaint: str, command: tuple[str, ...]) -> ProgramError:
    lines = [line for line in complaint.splitlines() if line.startswith("rastercheck: ")]
    if lines:
        line = lines[-1]
    elif exit_code < 0:
        line = f"rastercheck {command[1]} was ended by signal {-exit_code}"
    else:
        line = f"rastercheck {command[1]} ended with exit code {exit_code}: {complaint.strip()}"
    kinds = {2: BadInput, 4: BackendUnavailable}
    return kinds.get(exit_code, ProgramError)(line, exit_code, command)


def read_document(text: str, kind: str, version: int) -> dict[str, Any]:
    """Reads a JSON document of the program. Raises ProgramError if its kind or version is not the
    expected one, as when the program is newer than this package."""
    document: dict[str, Any] = json.loads(text)
    written = document.get("format"), document.get("version")
    if written != (kind, version):
        raise ProgramError(
            f"{find_program()} wrote {written[0]}, version {written[1]}; "
            f"this package reads {kind}, version {version}",
            0,
            (),
        )
    return document


def add_option(words: list[str], name: str, value: object) -> None:
    """Appends an option to the words of a command, unless its value is None. A sequence repeats the
    option; True stands for the option without a value, False for none."""
    if value is None or value is False:
        return
    if value is True:
        words.append(name)
    elif isinstance(value, (list, tuple)):
        for one in value:
            add_option(words, name, one)
    else:
        # In one word, so that a value may begin with a dash.
        text = os.fspath(value) if isinstance(value, os.PathLike) else str(value)
        words.append(f"{name}={text}")


def contract_file(contract: PathLike | Mapping[str, Any] | None, folder: str) -> str | None:
    """The path of a contract: itself, or that of a file in `folder` with the given members."""
    if not isinstance(contract, Mapping):
        return None if contract is None else os.fspath(contract)
    members = {"format": "rastercheck-contract", "version": 1, **contract}
    path = Path(folder) / "contract.json"
    path.write_text(json.dumps(members), encoding="utf-8")
    return str(path)
