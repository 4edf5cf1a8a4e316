"""Hypothesis strategies that make valid cases.

    from hypothesis import given
    from rastercheck import assert_right, strategies

    @given(strategies.cases())
    def test_my_rasterizer(case):
        assert_right(case, my_rasterizer.draw(case))

Cases shrink as Hypothesis shrinks: towards one triangle on one pixel, whole coordinates, w = 1 and
the first of the given rules. Pass strategies to narrow what is drawn to what your rasterizer can
do; `st.just()` fixes a value.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Optional

from hypothesis import strategies as st

from ._case import Attribute, Case, Channel, Framebuffer, PictureLayout, Rules, Vertex, Viewport

__all__ = ["attributes", "cases", "float32s", "positions", "triangles"]

_FLOAT32_MAX = float.fromhex("0x1.fffffep+127")


def float32s(
    least: float = -_FLOAT32_MAX, greatest: float = _FLOAT32_MAX
) -> st.SearchStrategy[float]:
    """Finite float32 numbers from `least` to `greatest`, which must be float32 themselves."""
    return st.floats(least, greatest, width=32, allow_nan=False, allow_infinity=False)


def _coordinates() -> st.SearchStrategy[float]:
    """Coordinates in and around the viewport: multiples of 1/16, which put vertices and edges on
    samples, and any others."""
    return st.integers(-32, 32).map(lambda n: n / 16) | float32s(-4, 4)


def positions(
    *,
    xy: Optional[st.SearchStrategy[float]] = None,
    z: Optional[st.SearchStrategy[float]] = None,
    w: Optional[st.SearchStrategy[float]] = None,
) -> st.SearchStrategy[tuple[float, float, float, float]]:
    """Clip positions. By default x and y lie around the viewport, z between the depth planes of all
    rules, and w from 1/16 to 16: such vertices are in front of the eye. With
    `w=float32s(-16, 16)` some lie behind it."""
    weights = w if w is not None else st.just(1.0) | float32s(0.0625, 16)
    return st.tuples(
        xy if xy is not None else _coordinates(),
        xy if xy is not None else _coordinates(),
        z if z is not None else st.just(0.0) | float32s(0, 0.0625),
        weights,
    )


def attributes(
    interpolations: Sequence[str] = ("smooth", "noperspective", "flat"),
    *,
    most: int = 3,
) -> st.SearchStrategy[tuple[Attribute, ...]]:
    """Up to `most` attributes, named a, b, c, …, each evaluated at the sample."""
    kinds: st.SearchStrategy[Any] = st.sampled_from(list(interpolations))
    return st.lists(kinds, max_size=most).map(
        lambda found: tuple(Attribute(chr(ord("a") + i), kind) for i, kind in enumerate(found))
    )


def _corners(count: int) -> st.SearchStrategy[list[int]]:
    """Three different ones of `count` vertices, without trying until they differ."""

    def pick(choices: tuple[int, int, int]) -> list[int]:
        left = list(range(count))
        return [left.pop(choice) for choice in choices]

    first, second, third = (st.integers(0, count - 1 - taken) for taken in range(3))
    return st.tuples(first, second, third).map(pick)


@st.composite
def cases(
    draw: st.DrawFn,
    *,
    rules: Sequence[Rules] = ("vulkan", "opengl", "d3d"),
    max_size: int = 16,
    samples: Sequence[int] = (1,),
    max_triangles: int = 3,
    attributes: st.SearchStrategy[tuple[Attribute, ...]] = attributes(),
    positions: st.SearchStrategy[tuple[float, float, float, float]] = positions(),
    values: Optional[st.SearchStrategy[float]] = None,
    shared_vertices: bool = True,
) -> Case:
    """Cases that rastercheck takes: up to `max_triangles` triangles on a framebuffer of up to
    `max_size` pixels along each side, which is the viewport.

    values           of attributes; by default float32 from -1 to 1
    shared_vertices  whether triangles may have vertices in common, as meshes do

    Pictures of these cases show the attributes, one in each channel, or if the case has none,
    1 where a triangle is drawn (`case.picture`).
    """
    framebuffer = Framebuffer(
        draw(st.integers(1, max_size)),
        draw(st.integers(1, max_size)),
        draw(st.sampled_from(samples)),
    )
    declared = draw(attributes)
    values = values if values is not None else float32s(-1, 1)
    vertex = st.tuples(positions, st.tuples(*[values] * len(declared)))
    # Lists that Hypothesis can delete entries from, so that cases shrink to few triangles.
    if shared_vertices:
        drawn = draw(st.lists(vertex, min_size=3, max_size=3 * max_triangles))
        found = draw(st.lists(_corners(len(drawn)), min_size=1, max_size=max_triangles))
        used = sorted({corner for three in found for corner in three})
        triangles = [[used.index(corner) for corner in three] for three in found]
        drawn = [drawn[corner] for corner in used]
    else:
        three = st.tuples(vertex, vertex, vertex)
        parts = draw(st.lists(three, min_size=1, max_size=max_triangles))
        drawn = [one for part in parts for one in part]
        triangles = [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(len(parts))]
    return Case(
        framebuffer,
        Viewport.of(framebuffer),
        draw(st.sampled_from(rules)),
        [Vertex(position, numbers) for position, numbers in drawn],
        triangles,
        attributes=declared,
        picture=None if declared else PictureLayout([Channel("Y", "coverage")]),
    )


def triangles(**narrowed: Any) -> st.SearchStrategy[Case]:
    """Cases of one triangle. Takes the arguments of cases(), except those about several."""
    return cases(max_triangles=1, shared_vertices=False, **narrowed)
