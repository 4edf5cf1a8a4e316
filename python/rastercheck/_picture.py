"""Arrays and lists as pictures: the bytes of an NPY file, which the program reads.

https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html describes the file. NumPy
is not needed for it: its arrays, like those of others, show their memory through the buffer
protocol.
"""

from __future__ import annotations

import importlib
import os
import sys
from array import array
from collections.abc import Sequence
from typing import Any, Protocol, Union

from ._errors import PictureError


class Array(Protocol):
    """An array of NumPy, or of a library whose arrays NumPy takes."""

    def __array__(self, *args: Any, **kwargs: Any) -> Any: ...


# A file, an array, or rows of pixels, each of which is a number or has a number for each channel.
Picture = Union[
    str,
    "os.PathLike[str]",
    Array,
    memoryview,
    Sequence[Sequence[float]],
    Sequence[Sequence[Sequence[float]]],
]

# The order of this machine's bytes, as NPY files name it, and the types of numbers in the words of
# the buffer protocol and of NPY files. The program refuses what is not little-endian.
_ORDER = "<" if sys.byteorder == "little" else ">"
_DESCRIPTIONS = {"f": f"{_ORDER}f4", "e": f"{_ORDER}f2", "B": "|u1", "H": f"{_ORDER}u2"}


def is_file(picture: Picture) -> bool:
    """True for the path of a picture file, false for numbers."""
    return isinstance(picture, (str, os.PathLike))


def to_npy(picture: Any) -> bytes:
    """The NPY file of an array of float32, float16, uint8 or uint16, as it is, or of doubles or
    lists of numbers, each rounded to float32. Raises PictureError."""
    try:
        view = memoryview(picture)
    except TypeError:
        if not hasattr(picture, "__array__"):
            shape, numbers = _from_lists(picture)
            return _npy(_DESCRIPTIONS["f"], shape, numbers.tobytes())
        view = memoryview(importlib.import_module("numpy").asarray(picture))
    shape = view.shape or ()
    if len(shape) not in (2, 3):
        raise PictureError(
            "a picture has 2 axes (height, width) or 3 (height, width, channel); "
            f"this array has {len(shape)}"
        )
    kind = view.format.lstrip(f"@={_ORDER}")
    if kind == "d":
        doubles = array("d", view.tobytes())
        return _npy(_DESCRIPTIONS["f"], shape, array("f", doubles).tobytes())
    if kind not in _DESCRIPTIONS:
        raise PictureError(
            "a picture holds float32, float16, uint8 or uint16, or float64, which is rounded to "
            f"float32; this array holds numbers of the format {view.format!r}"
        )
    return _npy(_DESCRIPTIONS[kind], shape, view.tobytes())


def _from_lists(rows: Any) -> tuple[tuple[int, ...], array[float]]:
    """The shape and numbers of nested sequences."""
    shape: tuple[int, ...] = ()
    level = rows
    while isinstance(level, Sequence) and not isinstance(level, (str, bytes)):
        shape += (len(level),)
        level = level[0] if level else 0.0
    if len(shape) not in (2, 3) or 0 in shape:
        raise PictureError(
            "a picture is a file, an array, or a list of rows of pixels; "
            f"this is a {type(rows).__name__} of the shape {shape}"
        )
    numbers = array("f")

    def append(level: Any, lengths: tuple[int, ...], place: str) -> None:
        if not lengths:
            numbers.append(level)
        elif not isinstance(level, Sequence) or len(level) != lengths[0]:
            raise PictureError(f"the list at {place or '[]'} does not have {lengths[0]} entries")
        else:
            for i, one in enumerate(level):
                append(one, lengths[1:], f"{place}[{i}]")

    try:
        append(rows, shape, "")
    except TypeError as error:
        raise PictureError(f"a picture holds numbers: {error}") from None
    return shape, numbers


def _npy(description: str, shape: tuple[int, ...], numbers: bytes) -> bytes:
    header = f"{{'descr': '{description}', 'fortran_order': False, 'shape': {shape}, }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"  # numbers begin at a multiple of 64 bytes
    return b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode() + numbers
