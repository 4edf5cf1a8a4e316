"""Frozen dataclasses as JSON: one list of members per class serves reading and writing.

What the members mean is up to the program. This module only checks what it has to in order to
lose nothing: that an object is an object, a number a number. Errors begin with the place in the
document, a JSON pointer.
"""

from __future__ import annotations

import dataclasses
import json
import math
import re
from collections.abc import Mapping
from typing import Any, Protocol

from ._errors import CaseError

_HEX_FLOAT = re.compile(r"[+-]?0[xX][0-9a-fA-F]+(\.[0-9a-fA-F]+)?([pP][+-]?[0-9]+)?")
# From here on, not every whole number is a double.
_WHOLE_NUMBERS_END = 2.0**53


class Kind(Protocol):
    """A kind of value. `where` is the place of the value in the document."""

    def read(self, value: Any, where: str) -> Any:
        """Makes a value of what the JSON parser returned."""

    def write(self, value: Any, where: str) -> Any:
        """Makes what the JSON writer takes of a value."""


class Plain:
    """A text, a word or a flag; passed on as it is."""

    def read(self, value: Any, where: str) -> Any:
        return value

    def write(self, value: Any, where: str) -> Any:
        return value


class Number:
    """A JSON number, or a string with a hex float; a float here."""

    def read(self, value: Any, where: str) -> float:
        if isinstance(value, str) and _HEX_FLOAT.fullmatch(value):
            return float.fromhex(value)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise CaseError(f"{where}: not a number: {value!r}")
        return float(value)

    def write(self, value: Any, where: str) -> int | float:
        """A number that is read as the same double, with the sign of a zero."""
        number = float(value)
        if not math.isfinite(number):
            raise CaseError(f"{where}: not a finite number: {number!r}")
        is_minus_zero = number == 0 and math.copysign(1, number) < 0
        is_short = number.is_integer() and abs(number) < _WHOLE_NUMBERS_END and not is_minus_zero
        return int(number) if is_short else number


class Whole:
    """A whole number, which may be written as 64.0."""

    def read(self, value: Any, where: str) -> int:
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if not is_number or value != math.floor(value):
            raise CaseError(f"{where}: not a whole number: {value!r}")
        return int(value)

    def write(self, value: Any, where: str) -> int:
        return int(value)


class Many:
    """A list of one kind; a tuple here."""

    def __init__(self, kind: Kind) -> None:
        self.kind = kind

    def read(self, value: Any, where: str) -> tuple[Any, ...]:
        if not isinstance(value, (list, tuple)):
            raise CaseError(f"{where}: not a list: {value!r}")
        return tuple(self.kind.read(one, f"{where}/{i}") for i, one in enumerate(value))

    def write(self, value: Any, where: str) -> list[Any]:
        return [self.kind.write(one, f"{where}/{i}") for i, one in enumerate(value)]


class Object:
    """A dataclass with the field `extra`. Members that have their default value are not written;
    members that are not listed are read into `extra`, and written back."""

    def __init__(self, cls: type[Any], **members: Kind) -> None:
        self.cls = cls
        self.members = members
        self.defaults = {one.name: one.default for one in dataclasses.fields(cls)}

    def read(self, value: Any, where: str) -> Any:
        if not isinstance(value, Mapping):
            raise CaseError(f"{where or '/'}: not an object: {value!r}")
        known = {
            name: kind.read(value[name], f"{where}/{name}")
            for name, kind in self.members.items()
            if name in value
        }
        for name in self.members:
            if name not in known and self.defaults[name] is dataclasses.MISSING:
                raise CaseError(f"{where}/{name}: missing")
        extra = {name: one for name, one in value.items() if name not in self.members}
        return self.cls(**known, extra=extra)

    def write(self, value: Any, where: str) -> dict[str, Any]:
        if not isinstance(value, self.cls):
            raise CaseError(f"{where or '/'}: not a {self.cls.__name__}: {value!r}")
        members: dict[str, Any] = {}
        for name, kind in self.members.items():
            one = getattr(value, name)
            if repr(one) != repr(self.defaults[name]):  # tells -0.0 from 0.0
                members[name] = kind.write(one, f"{where}/{name}")
        return {**members, **value.extra}


def _refuse_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise CaseError(f"more than one member {twice!r} in an object")
    return members


def _refuse_constant(name: str) -> Any:
    raise CaseError(f"not a finite number: {name}")


def parse(text: str | bytes) -> Any:
    """Parses JSON. Minus zero keeps its sign; refuses doubled members, NaN and infinities."""
    try:
        return json.loads(
            text,
            parse_int=lambda digits: -0.0 if digits == "-0" else int(digits),
            parse_constant=_refuse_constant,
            object_pairs_hook=_refuse_doubles,
        )
    except CaseError:
        raise
    except (ValueError, RecursionError) as error:
        raise CaseError(f"not valid JSON: {error}") from None


def to_lines(members: Mapping[str, Any]) -> str:
    """An object as text, with a line for each member, and for each entry of a list of lists or
    objects."""

    def text(value: Any) -> str:
        return json.dumps(value, ensure_ascii=False, allow_nan=False)

    lines = []
    for name, value in members.items():
        if isinstance(value, list) and value and isinstance(value[0], (list, dict)):
            entries = ",\n".join(f"    {text(one)}" for one in value)
            lines.append(f"  {text(name)}: [\n{entries}\n  ]")
        else:
            lines.append(f"  {text(name)}: {text(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"
