"""`rastercheck oracle`: what must be drawn for a case, exactly."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal, Optional, Union

from . import _program
from ._case import Case

# Texts of more digits are converted in parts: Python limits them, as converting takes time that
# grows with the square of the length.
_DIGITS_AT_ONCE = 4000


@dataclass(frozen=True)
class ValueRange:
    """All right answers for a depth or an attribute, both ends inclusive. One number, unless
    `is_open`: then the case leaves open where vertices are placed."""

    least: Fraction
    greatest: Fraction
    is_open: bool = False

    @property
    def exact(self) -> Fraction:
        """The only right answer. Raises ValueError if there are several."""
        if self.least != self.greatest:
            raise ValueError(f"any value from {self.least} to {self.greatest} is right")
        return self.least

    def __float__(self) -> float:
        """The double nearest to the only right answer."""
        return float(self.exact)

    def __contains__(self, value: Union[Fraction, float]) -> bool:
        return self.least <= value <= self.greatest

    def __str__(self) -> str:
        if self.least == self.greatest:
            return str(self.least)
        return f"{self.least} to {self.greatest}"


@dataclass(frozen=True)
class Details:
    """How close a fragment is to being another one. None: it has no such number.

    distance     to the boundary that decides, in pixels, as two doubles that enclose it
    derivatives  of each attribute along window x and y
    kappa        of each attribute, how much relative errors of the weights are amplified
    kappa_d      of each attribute, how much the weights cancel
    """

    distance: Optional[tuple[Optional[float], Optional[float]]]
    derivatives: tuple[Optional[tuple[Fraction, Fraction]], ...]
    kappa: tuple[Optional[Fraction], ...]
    kappa_d: tuple[Optional[Fraction], ...]


@dataclass(frozen=True)
class Fragment:
    """A sample that a triangle must cover ("required") or may cover ("permitted")."""

    triangle: int
    x: int
    y: int
    sample: int
    verdict: Literal["required", "permitted"]
    reason: str
    depth: Optional[ValueRange]
    attributes: tuple[Optional[ValueRange], ...]  # None: undefined, any value is right
    details: Optional[Details] = None


@dataclass(frozen=True)
class OracleResult:
    """Every fragment that must or may be drawn, triangle by triangle."""

    case: str  # its name
    fragments: tuple[Fragment, ...]

    @property
    def required(self) -> tuple[Fragment, ...]:
        return tuple(one for one in self.fragments if one.verdict == "required")

    @property
    def permitted(self) -> tuple[Fragment, ...]:
        return tuple(one for one in self.fragments if one.verdict == "permitted")

    def at(self, x: int, y: int, sample: int = 0) -> tuple[Fragment, ...]:
        """The fragments of one sample, in the order of their triangles."""
        place = (x, y, sample)
        return tuple(one for one in self.fragments if (one.x, one.y, one.sample) == place)

    def __len__(self) -> int:
        return len(self.fragments)

    def __iter__(self) -> Iterator[Fragment]:
        return iter(self.fragments)


def oracle(
    case: Union[Case, _program.PathLike],
    *,
    clip: bool = False,
    details: bool = False,
    large: bool = False,
    timeout: Optional[float] = None,
) -> OracleResult:
    """What must be drawn for a case, or for a case file: `rastercheck oracle --json`.

    clip     with clip positions rounded to float32, as backends receive them
    details  also distances, derivatives and condition numbers
    large    permits more than 2^26 samples
    timeout  seconds; TimedOut is raised after them
    """
    __tracebackhide__ = True
    words = ["oracle", case_word(case), "--json"]
    _program.add_option(words, "--clip", clip)
    _program.add_option(words, "--details", details)
    _program.add_option(words, "--all", large)
    ended = _program.call(words, given=case_text(case), timeout=timeout)
    document = _program.read_document(ended.output, "rastercheck-oracle", 1)
    return OracleResult(document["case"], tuple(map(_fragment, document["fragments"])))


def case_word(case: Union[Case, _program.PathLike]) -> str:
    """How the command line names a case: standard input, or its file."""
    return "-" if isinstance(case, Case) else os.fspath(case)


def case_text(case: Union[Case, _program.PathLike]) -> Optional[str]:
    """What standard input holds for case_word()."""
    return case.to_json() if isinstance(case, Case) else None


def _whole(digits: str) -> int:
    if len(digits) <= _DIGITS_AT_ONCE:
        return int(digits)
    high, low = digits[:-_DIGITS_AT_ONCE], digits[-_DIGITS_AT_ONCE:]
    sign = -1 if digits.startswith("-") else 1
    scale: int = 10**_DIGITS_AT_ONCE
    return _whole(high) * scale + sign * int(low)


def _fraction(text: str) -> Fraction:
    numerator, _, denominator = text.partition("/")
    return Fraction(_whole(numerator), _whole(denominator or "1"))


def _range(value: Any) -> Optional[ValueRange]:
    if value is None:
        return None
    if isinstance(value, str):
        exact = _fraction(value)
        return ValueRange(exact, exact)
    return ValueRange(_fraction(value[0]), _fraction(value[1]), is_open=True)


def _details(members: dict[str, Any]) -> Optional[Details]:
    if "distance" not in members:
        return None

    def fractions(texts: Sequence[Optional[str]]) -> tuple[Optional[Fraction], ...]:
        return tuple(None if text is None else _fraction(text) for text in texts)

    distance = members["distance"]
    return Details(
        distance=None if distance is None else (distance[0], distance[1]),
        derivatives=tuple(
            None if one is None else (_fraction(one[0]), _fraction(one[1]))
            for one in members["derivatives"]
        ),
        kappa=fractions(members["kappa"]),
        kappa_d=fractions(members["kappa_d"]),
    )


def _fragment(members: dict[str, Any]) -> Fragment:
    return Fragment(
        triangle=members["triangle"],
        x=members["x"],
        y=members["y"],
        sample=members["sample"],
        verdict=members["verdict"],
        reason=members["reason"],
        depth=_range(members["depth"]),
        attributes=tuple(map(_range, members["attributes"])),
        details=_details(members),
    )
