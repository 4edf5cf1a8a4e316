"""Cases as plain data, with the names of the case file (docs/case-format.md).

All classes are frozen; `dataclasses.replace()` makes a changed copy. Lists and arrays that are
passed to them become tuples. The program, not this module, checks the values: whether a number is
exactly a float32, an index in range or a size permitted.
"""

from __future__ import annotations

import dataclasses
import os
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, Optional, Union

from . import _json
from ._errors import CaseError

FORMAT, VERSION = "rastercheck-case", 1

Rules = Literal["opengl", "vulkan", "d3d"]
Rounding = Literal["nearest_even", "half_up", "unspecified"]
Basis = Literal["ideal", "snapped", "unspecified"]
FillRule = Literal["top_left", "bottom_left"]
Interpolation = Literal["smooth", "noperspective", "flat"]
Location = Literal["sample", "center", "centroid"]
Storage = Literal["float32", "float16", "unorm8", "unorm16", "srgb8"]


def float32(number: float) -> float:
    """The float32 nearest to a number, as cases need it: float32(0.1) is 0.10000000149011612.
    Raises CaseError for numbers that have none, such as 1e39."""
    try:
        nearest: float = struct.unpack("<f", struct.pack("<f", number))[0]
    except OverflowError:
        raise CaseError(f"no float32 is near {number!r}") from None
    return nearest


def _frozen(value: Any) -> Any:
    """A value with tuples in place of its lists and arrays."""
    if hasattr(value, "__array_interface__"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return tuple(_frozen(one) for one in value)
    return value


@dataclass(frozen=True, repr=False)
class Record:
    """The base of all parts of a case. `extra` holds the members of the file that this version of
    the package does not know; they are written back."""

    extra: Mapping[str, Any] = field(default_factory=dict, kw_only=True, hash=False)

    def __post_init__(self) -> None:
        for one in dataclasses.fields(self):
            if one.name != "extra":
                object.__setattr__(self, one.name, _frozen(getattr(self, one.name)))

    def __repr__(self) -> str:
        """Like that of any dataclass, without the fields that have their default value."""
        shown = []
        for one in dataclasses.fields(self):
            value = getattr(self, one.name)
            usual = one.default if one.default_factory is dataclasses.MISSING else {}
            if repr(value) != repr(usual):  # tells -0.0 from 0.0
                shown.append(f"{one.name}={value!r}")
        return f"{type(self).__name__}({', '.join(shown)})"


@dataclass(frozen=True, repr=False)
class Framebuffer(Record):
    """What is drawn into: sizes in pixels, and samples per pixel (1, 2, 4, 8 or 16)."""

    width: int
    height: int
    samples: int = 1


@dataclass(frozen=True, repr=False)
class Viewport(Record):
    """Where NDC lands in the window, in pixels, and the depth range."""

    x: float
    y: float
    width: float
    height: float
    min_depth: float = 0.0
    max_depth: float = 1.0

    @classmethod
    def of(cls, framebuffer: Framebuffer) -> Viewport:
        """The viewport that is the whole framebuffer."""
        return cls(0, 0, framebuffer.width, framebuffer.height)


@dataclass(frozen=True, repr=False)
class DepthBias(Record):
    """What is added to depths: constant times the unit of the depth format, plus slope times the
    slope of the triangle; at most clamp if that is positive, at least clamp if it is negative."""

    constant: float = 0.0
    slope: float = 0.0
    clamp: float = 0.0


@dataclass(frozen=True, repr=False)
class Scissor(Record):
    """The rectangle of whole pixels that may be drawn."""

    x: int
    y: int
    width: int
    height: int


@dataclass(frozen=True, repr=False)
class Snapping(Record):
    """Coverage by vertices that are rounded to a grid of 2^-subpixel_bits pixels."""

    subpixel_bits: int
    rounding: Rounding = "nearest_even"
    position_error: float = 0.0


@dataclass(frozen=True, repr=False)
class Attribute(Record):
    """An attribute that every vertex has a value of."""

    name: str
    interpolation: Interpolation = "smooth"
    location: Location = "sample"


@dataclass(frozen=True, repr=False)
class Camera(Record):
    """clip = projection · view · model · position, each of 16 numbers, row by row; None is the
    identity."""

    model: Optional[Sequence[float]] = None
    view: Optional[Sequence[float]] = None
    projection: Optional[Sequence[float]] = None


@dataclass(frozen=True, repr=False)
class Vertex(Record):
    """A vertex: a clip position (x, y, z, w), or with a camera an object position of 3 or 4
    numbers; one value for each attribute of the case; user clip distances."""

    position: Sequence[float]
    attributes: Sequence[float] = ()
    clip_distances: Sequence[float] = ()


@dataclass(frozen=True, repr=False)
class Channel(Record):
    """What one channel of a picture shows: an attribute, depth, triangle, coverage, a number, or
    "-"."""

    name: str
    shows: str
    background: Optional[float] = None


@dataclass(frozen=True, repr=False)
class PictureLayout(Record):
    """What pictures of a case show (docs/image-tests.md); None is the default."""

    channels: Optional[Sequence[Channel]] = None
    storage: Optional[Storage] = None
    rounding: Optional[Literal["nearest", "either"]] = None
    first_row: Optional[Literal["top", "bottom"]] = None
    resolve: Optional[Literal["linear", "stored"]] = None
    alpha: Optional[Literal["straight", "premultiplied"]] = None
    blend: Optional[Literal["off", "over", "additive"]] = None


@dataclass(frozen=True, repr=False)
class Found(Record):
    """Where a counterexample comes from; `property` is the id of the violated property."""

    property: Optional[str] = None
    backend: Optional[str] = None
    verdict: Optional[str] = None
    seed: Optional[int] = None
    index: Optional[int] = None
    kind: Optional[str] = None
    condition: Optional[str] = None


@dataclass(frozen=True, repr=False)
class Case(Record):
    """Everything that decides what is drawn. A case has triangles, lines or points. None stands for
    a default that the program chooses, such as the fill rule of the rules."""

    framebuffer: Framebuffer
    viewport: Viewport
    rules: Rules
    vertices: Sequence[Vertex]
    triangles: Optional[Sequence[Sequence[int]]] = None
    lines: Optional[Sequence[Sequence[int]]] = field(default=None, kw_only=True)
    points: Optional[Sequence[int]] = field(default=None, kw_only=True)
    line_width: float = field(default=1.0, kw_only=True)
    line_mode: Optional[Literal["rectangular", "parallelogram", "bresenham"]] = field(
        default=None, kw_only=True
    )
    point_size: float = field(default=1.0, kw_only=True)
    name: str = field(default="", kw_only=True)
    coverage: Union[Literal["exact"], Snapping] = field(default="exact", kw_only=True)
    basis: Optional[Basis] = field(default=None, kw_only=True)
    fill_rule: Optional[FillRule] = field(default=None, kw_only=True)
    cull: Literal["none", "back", "front"] = field(default="none", kw_only=True)
    front_face: Literal["ccw", "cw"] = field(default="ccw", kw_only=True)
    scissor: Optional[Scissor] = field(default=None, kw_only=True)
    depth_test: Literal["none", "less"] = field(default="none", kw_only=True)
    depth_clear: Optional[float] = field(default=None, kw_only=True)
    depth_clamp: bool = field(default=False, kw_only=True)
    depth_bias: Optional[DepthBias] = field(default=None, kw_only=True)
    depth_format: Literal["float32", "unorm16", "unorm24"] = field(
        default="float32", kw_only=True
    )
    attributes: Sequence[Attribute] = field(default=(), kw_only=True)
    camera: Optional[Camera] = field(default=None, kw_only=True)
    essential: Optional[Sequence[str]] = field(default=None, kw_only=True)
    choices: Optional[int] = field(default=None, kw_only=True)
    picture: Optional[PictureLayout] = field(default=None, kw_only=True)
    found: Optional[Found] = field(default=None, kw_only=True)

    def to_dict(self) -> dict[str, Any]:
        """The members of the case file, in its order, without those that have their default value.
        Raises CaseError for what a case file cannot hold, such as NaN."""
        return {"format": FORMAT, "version": VERSION, **_CASE.write(self, "")}

    def to_json(self) -> str:
        """The text of the case file, with a line for each vertex and triangle."""
        return _json.to_lines(self.to_dict())

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the case file."""
        Path(path).write_text(self.to_json(), encoding="utf-8")

    @classmethod
    def from_dict(cls, members: Mapping[str, Any]) -> Case:
        """Makes a case of the members of a case file. Raises CaseError."""
        if not isinstance(members, Mapping):
            raise CaseError(f"/: not an object: {members!r}")
        written = members.get("format"), members.get("version")
        if written != (FORMAT, VERSION):
            raise CaseError(
                f"/: format {written[0]!r}, version {written[1]!r}; "
                f"a case has format {FORMAT!r}, version {VERSION}"
            )
        rest = {name: one for name, one in members.items() if name not in ("format", "version")}
        case: Case = _CASE.read(rest, "")
        return case

    @classmethod
    def from_json(cls, text: Union[str, bytes]) -> Case:
        """Reads the text of a case file. Raises CaseError."""
        return cls.from_dict(_json.parse(text))

    @classmethod
    def load(cls, path: Union[str, os.PathLike[str]]) -> Case:
        """Reads a case file. Raises CaseError, which names the file, or OSError."""
        text = Path(path).read_bytes()
        try:
            return cls.from_json(text)
        except CaseError as error:
            raise CaseError(f"{os.fspath(path)}: {error}") from None


class _Coverage:
    """A word, or an object."""

    def read(self, value: Any, where: str) -> Any:
        return _SNAPPING.read(value, where) if isinstance(value, Mapping) else value

    def write(self, value: Any, where: str) -> Any:
        return _SNAPPING.write(value, where) if isinstance(value, Snapping) else value


_PLAIN, _NUMBER, _WHOLE = _json.Plain(), _json.Number(), _json.Whole()
_NUMBERS = _json.Many(_NUMBER)
_SNAPPING = _json.Object(
    Snapping, subpixel_bits=_WHOLE, rounding=_PLAIN, position_error=_NUMBER
)
# The members of a case file in the order in which they are written.
_CASE = _json.Object(
    Case,
    name=_PLAIN,
    framebuffer=_json.Object(Framebuffer, width=_WHOLE, height=_WHOLE, samples=_WHOLE),
    viewport=_json.Object(
        Viewport,
        x=_NUMBER,
        y=_NUMBER,
        width=_NUMBER,
        height=_NUMBER,
        min_depth=_NUMBER,
        max_depth=_NUMBER,
    ),
    rules=_PLAIN,
    coverage=_Coverage(),
    basis=_PLAIN,
    fill_rule=_PLAIN,
    cull=_PLAIN,
    front_face=_PLAIN,
    scissor=_json.Object(Scissor, x=_WHOLE, y=_WHOLE, width=_WHOLE, height=_WHOLE),
    depth_test=_PLAIN,
    depth_clear=_NUMBER,
    depth_clamp=_PLAIN,
    depth_bias=_json.Object(DepthBias, constant=_NUMBER, slope=_NUMBER, clamp=_NUMBER),
    depth_format=_PLAIN,
    line_width=_NUMBER,
    line_mode=_PLAIN,
    point_size=_NUMBER,
    attributes=_json.Many(
        _json.Object(Attribute, name=_PLAIN, interpolation=_PLAIN, location=_PLAIN)
    ),
    camera=_json.Object(Camera, model=_NUMBERS, view=_NUMBERS, projection=_NUMBERS),
    vertices=_json.Many(
        _json.Object(Vertex, position=_NUMBERS, attributes=_NUMBERS, clip_distances=_NUMBERS)
    ),
    triangles=_json.Many(_json.Many(_WHOLE)),
    lines=_json.Many(_json.Many(_WHOLE)),
    points=_json.Many(_WHOLE),
    essential=_json.Many(_PLAIN),
    choices=_WHOLE,
    picture=_json.Object(
        PictureLayout,
        channels=_json.Many(_json.Object(Channel, name=_PLAIN, shows=_PLAIN, background=_NUMBER)),
        storage=_PLAIN,
        rounding=_PLAIN,
        first_row=_PLAIN,
        resolve=_PLAIN,
        alpha=_PLAIN,
        blend=_PLAIN,
    ),
    found=_json.Object(
        Found,
        property=_PLAIN,
        backend=_PLAIN,
        verdict=_PLAIN,
        seed=_WHOLE,
        index=_WHOLE,
        kind=_PLAIN,
        condition=_PLAIN,
    ),
)
