"""What can go wrong, as exceptions. All derive from RasterCheckError."""

from __future__ import annotations


class RasterCheckError(Exception):
    """The base of every exception of this package, except WrongPicture."""


class CaseError(RasterCheckError, ValueError):
    """A text, file or dictionary is not a case, or a case cannot be written."""


class PictureError(RasterCheckError, ValueError):
    """An array or a list is not a picture."""


class ProgramNotFound(RasterCheckError):
    """The program rastercheck is not on this machine, or cannot be started."""


class ProgramError(RasterCheckError):
    """The program ended with an error. The message is the line that the program printed."""

    def __init__(self, line: str, exit_code: int, command: tuple[str, ...]) -> None:
        super().__init__(line)
        self.exit_code = exit_code
        self.command = command


class BadInput(ProgramError):
    """The program refused a case, a picture, a contract or an option (exit code 2)."""


class BackendUnavailable(ProgramError):
    """A backend cannot run on this machine (exit code 4)."""


class TimedOut(RasterCheckError, TimeoutError):
    """The program did not end within the timeout, and was stopped."""
