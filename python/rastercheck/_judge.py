"""`rastercheck judge`: which pixels of a picture are wrong."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Optional, Union

from . import _picture, _program
from ._case import Case, Storage
from ._oracle import case_text, case_word
from ._picture import Picture

# Exit codes with which the program judged: right, wrong, nothing could be judged.
_JUDGED = (0, 1, 5)
# Wrong pixels that str() of a judgement shows.
_MOST_SHOWN = 8


class WrongPicture(AssertionError):
    """Raised by assert_right(). The message is the judgement as text."""

    def __init__(self, judgement: Judgement) -> None:
        super().__init__(str(judgement))
        self.judgement = judgement


@dataclass(frozen=True)
class JudgedChannel:
    """What a wrong pixel stores in one channel, and what the nearest permitted drawing stores: from
    `least` to `greatest`, or anything if these are None. An integer k of a picture stands for
    k/255 or k/65535."""

    name: str
    stored: float
    least: Optional[float]
    greatest: Optional[float]

    @property
    def is_right(self) -> bool:
        if self.least is None or self.greatest is None:
            return True
        return self.least <= self.stored <= self.greatest

    def __str__(self) -> str:
        if self.least is None or self.greatest is None:
            return f"{self.name} {self.stored:.9g}"
        least, greatest = f"{self.least:.9g}", f"{self.greatest:.9g}"
        permitted = least if least == greatest else f"{least} to {greatest}"
        return f"{self.name} {self.stored:.9g}, not {permitted}"


@dataclass(frozen=True)
class WrongPixel:
    """A wrong pixel. `row` counts the rows of the picture; `steps` is how far the pixel is from the
    nearest permitted drawing, in steps from one storable number to the next (None: no number)."""

    x: int
    row: int
    verdict: str
    channels: tuple[JudgedChannel, ...]
    triangle: Optional[int]
    steps: Optional[float]

    def __str__(self) -> str:
        wrong = "; ".join(str(one) for one in self.channels if not one.is_right)
        return f"x {self.x}, row {self.row}: {self.verdict}: {wrong}"


@dataclass(frozen=True)
class Judgement:
    """How many pixels of a picture are right, and in which ways the others are not.

    pixels       by verdict: "right", "wrong value", "wrong triangle", "extra", "missing",
                 "not a number", "not judged"
    worst        wrong pixels, those farthest off first; the program lists a limited number
    one_value, may_differ, background
                 how many pixels have only one right value, have several, show the background
    """

    case: str  # its name
    width: int
    height: int
    channels: tuple[str, ...]
    pixels: Mapping[str, int]
    wrong: int
    worst: tuple[WrongPixel, ...]
    one_value: int
    may_differ: int
    background: int
    verdict: Literal["right", "wrong", "not judged"]

    @property
    def right(self) -> int:
        return self.pixels["right"]

    @property
    def wrong_value(self) -> int:
        return self.pixels["wrong value"]

    @property
    def wrong_triangle(self) -> int:
        return self.pixels["wrong triangle"]

    @property
    def extra(self) -> int:
        return self.pixels["extra"]

    @property
    def missing(self) -> int:
        return self.pixels["missing"]

    @property
    def not_a_number(self) -> int:
        return self.pixels["not a number"]

    @property
    def not_judged(self) -> int:
        return self.pixels["not judged"]

    @property
    def is_right(self) -> bool:
        """True if no pixel is wrong and some pixel was judged."""
        return self.verdict == "right"

    def __str__(self) -> str:
        """The verdict, and the pixels that are farthest off, each with what is permitted there."""
        name = f" of {self.case!r}" if self.case else ""
        every = self.width * self.height
        if self.verdict == "not judged":
            return f"no pixel{name} could be judged"
        if self.verdict == "right":
            left = f"; {self.not_judged} not judged" if self.not_judged else ""
            return f"right: {self.right} of {every} pixels{name}{left}"
        others = [
            f"{count} {verdict}"
            for verdict, count in self.pixels.items()
            if count and verdict != "right"
        ]
        lines = [f"wrong: {self.wrong} of {every} pixels{name} ({', '.join(others)})"]
        lines += [f"  {pixel}" for pixel in self.worst[:_MOST_SHOWN]]
        if self.wrong > len(lines) - 1:
            lines.append(f"  … and {self.wrong - len(lines) + 1} more")
        return "\n".join(lines)


def judge(
    case: Union[Case, _program.PathLike],
    picture: Picture,
    *,
    contract: Union[_program.PathLike, Mapping[str, Any], None] = None,
    promised_by: Optional[str] = None,
    channels: Union[str, Mapping[str, str], None] = None,
    background: Optional[str] = None,
    storage: Optional[Storage] = None,
    rounding: Optional[Literal["nearest", "either"]] = None,
    first_row: Optional[Literal["top", "bottom"]] = None,
    resolve: Optional[Literal["linear", "stored"]] = None,
    alpha: Optional[Literal["straight", "premultiplied"]] = None,
    blend: Optional[Literal["off", "over", "additive"]] = None,
    chw: bool = False,
    html: Optional[_program.PathLike] = None,
    large: bool = False,
    timeout: Optional[float] = None,
) -> Judgement:
    """Says which pixels of a picture are wrong: `rastercheck judge --json`.

    case         a Case, or the path of a case file
    picture      the path of a picture file (OpenEXR, PNG, NPY, PFM); an array of the axes height,
                 width and, for several channels, channel; or a list of rows of pixels. Doubles
                 and lists are rounded to float32.
    contract     what the picture is judged by: the members of a contract, or the path of a contract
                 file; by default, what the case asks for
    promised_by  judge by what this backend promises
    html         write the report to this file
    large        permits more than 2^26 samples
    timeout      seconds; TimedOut is raised after them

    The other arguments are the options of the same names, and replace what the case says in
    `picture`.
    """
    __tracebackhide__ = True
    if isinstance(channels, Mapping):
        channels = ",".join(f"{name}={shows}" for name, shows in channels.items())
    with tempfile.TemporaryDirectory(prefix="rastercheck-") as folder:
        if _picture.is_file(picture):
            file = os.fspath(picture)  # type: ignore[arg-type]
        else:
            file = os.path.join(folder, "picture.npy")
            Path(file).write_bytes(_picture.to_npy(picture))
        # Before the options: one that takes a list would take the files, too.
        words = ["judge", case_word(case), file, "--json"]
        for name, value in (
            ("--contract", _program.contract_file(contract, folder)),
            ("--promised-by", promised_by),
            ("--channels", channels),
            ("--background", background),
            ("--storage", storage),
            ("--rounding", rounding),
            ("--first-row", first_row),
            ("--resolve", resolve),
            ("--alpha", alpha),
            ("--blend", blend),
            ("--chw", chw),
            ("--html", html),
            ("--all", large),
        ):
            _program.add_option(words, name, value)
        ended = _program.call(words, given=case_text(case), expected=_JUDGED, timeout=timeout)
    document = _program.read_document(ended.output, "rastercheck-judged-picture", 1)
    named = case.name if isinstance(case, Case) else os.fspath(case)
    return _judgement(document, named, ended.exit_code)


def assert_right(
    case: Union[Case, _program.PathLike], picture: Picture, **options: Any
) -> Judgement:
    """Judges a picture, with the arguments of judge(), and raises WrongPicture, an AssertionError
    that shows the pixels farthest off, unless the picture is right. "Not judged" is not right."""
    __tracebackhide__ = True
    judgement = judge(case, picture, **options)
    if not judgement.is_right:
        raise WrongPicture(judgement)
    return judgement


def _number(text: Optional[str]) -> Optional[float]:
    """A number of the program: a hex float, NaN or an infinity."""
    if text is None:
        return None
    return float.fromhex(text)


def _pixel(members: dict[str, Any], names: tuple[str, ...]) -> WrongPixel:
    channels = []
    for name, one in zip(names, members["channels"]):
        stored = float.fromhex(one["stored"])
        channels.append(
            JudgedChannel(name, stored, _number(one.get("least")), _number(one.get("greatest")))
        )
    return WrongPixel(
        x=members["x"],
        row=members["row"],
        verdict=members["verdict"],
        channels=tuple(channels),
        triangle=members.get("triangle"),
        steps=members.get("steps"),
    )


def _judgement(document: dict[str, Any], case: str, exit_code: int) -> Judgement:
    names = tuple(one["name"] for one in document["channels"])
    verdicts: dict[int, Literal["right", "wrong", "not judged"]] = {
        0: "right",
        1: "wrong",
        5: "not judged",
    }
    return Judgement(
        case=case,
        width=document["width"],
        height=document["height"],
        channels=names,
        pixels=document["pixels"],
        wrong=document["wrong"],
        worst=tuple(_pixel(one, names) for one in document["worst"]),
        one_value=document["one_value"],
        may_differ=document["may_differ"],
        background=document["background"],
        verdict=verdicts[exit_code],
    )
