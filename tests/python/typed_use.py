"""Uses of the package that mypy --strict has to accept. Not run."""

from fractions import Fraction
from pathlib import Path

from hypothesis import given

import rastercheck
from rastercheck import strategies


def exact(path: Path) -> list[Fraction]:
    case = rastercheck.Case.load(path)
    found = rastercheck.oracle(case, details=True, timeout=10)
    return [one.depth.exact for one in found.required if one.depth is not None]


def built() -> rastercheck.Case:
    size = rastercheck.Framebuffer(4, 4)
    return rastercheck.Case(
        size,
        rastercheck.Viewport.of(size),
        "d3d",
        [rastercheck.Vertex([0, 0, 0, 1])],
        [[0, 0, 0]],
        coverage=rastercheck.Snapping(8),
    )


@given(strategies.cases(rules=["opengl"]))
def judged(case: rastercheck.Case) -> None:
    judgement: rastercheck.Judgement = rastercheck.assert_right(case, [[0.0]], rounding="either")
    wrong: int = judgement.wrong_value
    first: str = judgement.worst[0].verdict
    assert (wrong, first) == (0, "")


def checked() -> str:
    result = rastercheck.run(["cpu"], cases=1, contract={"keeps_constants": True})
    worst = [one.worst_ulp[1] for one in result.properties if one.worst_ulp is not None]
    return f"{result}, {max(worst)}, {result.counterexamples[0].case.rules}"
