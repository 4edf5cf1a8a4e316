"""What the oracle says, as Python has it. Expected values are computed by hand."""

import dataclasses
from fractions import Fraction

import pytest
from case_test import TRIANGLE
from rastercheck import Attribute, Case, Fragment, Snapping, ValueRange, Vertex, _oracle, oracle


def u_case(**changes):
    """The triangle (0, 0), (4, 0), (0, 2) in pixels, of w 1, 1 and 2, with u 0, 1 and 2."""
    vertices = [
        Vertex((-1, -1, 0, 1), [0]),
        Vertex((1, -1, 0, 1), [1]),
        Vertex((-2, 2, 0.5, 2), [2]),
    ]
    return dataclasses.replace(TRIANGLE, vertices=vertices, attributes=[Attribute("u")], **changes)


def test_fragments_are_exact():
    result = oracle(u_case(name="by hand"))
    assert result.case == "by hand"
    # Weights of pixel (0, 0), centre (1/2, 1/2): 5/8, 1/8, 1/4; divided by w: 5/8, 1/8, 1/8.
    exact = Fraction(1 * 1 + 2 * 1, 7)
    assert result.at(0, 0) == (
        Fragment(
            0, 0, 0, 0, "required", "inside",
            depth=ValueRange(Fraction(1, 16), Fraction(1, 16)),
            attributes=(ValueRange(exact, exact),),
        ),
    )  # fmt: skip
    (u,) = result.at(0, 0)[0].attributes
    assert (u.exact, float(u), exact in u, 0.43 in u) == (exact, 3 / 7, True, False)
    # The centres of (1, 1) and (3, 0) lie on the diagonal, a right edge, which owns no sample.
    assert [(one.x, one.y) for one in result] == [(0, 0), (1, 0), (2, 0), (0, 1)]
    assert (len(result.required), len(result.permitted), len(result)) == (4, 0, 4)


def test_files_are_taken_as_well(corpus):
    file = corpus / "behind-the-eye.json"
    assert oracle(file) == oracle(str(file)) == oracle(Case.load(file))
    assert len(oracle(file)) == 24


def test_what_is_open_is_a_range():
    case = u_case(coverage=Snapping(4, "unspecified"), basis="unspecified")
    ranges = [one.attributes[0] for one in oracle(case) if one.attributes[0].is_open]
    assert ranges
    moved = [Vertex((-1 + 2**-8, -1, 0, 1), [0]), *case.vertices[1:]]
    ranges = [one.attributes[0] for one in oracle(dataclasses.replace(case, vertices=moved))]
    wide = next(one for one in ranges if one.least < one.greatest)
    assert wide.least in wide and (wide.least + wide.greatest) / 2 in wide
    with pytest.raises(ValueError, match=f"any value from {wide.least} to {wide.greatest} is r"):
        float(wide)


def test_what_is_undefined_is_none(corpus):
    result = oracle(corpus / "center-behind-the-horizon.json")
    assert None in [value for one in result for value in one.attributes]


def test_details_are_fractions():
    (here,) = oracle(u_case(), details=True).at(0, 0)
    # u(x, y) = (x/4 + y/2) / (1 - y/4), whose derivative along x is 1/4 / (7/8) at y = 1/2.
    assert here.details.derivatives[0][0] == Fraction(2, 7)
    assert here.details.distance == (0.5, 0.5)
    assert here.details.kappa == (1,)
    assert oracle(u_case()).at(0, 0)[0].details is None


def test_clip_positions_may_be_rounded(corpus):
    file = corpus / "camera-rotated-rounds.json"
    assert oracle(file) != oracle(file, clip=True)


@pytest.mark.parametrize("digits", ["0", "-17", "1" * 4001, "-" + "90" * 5000])
def test_numbers_of_many_digits_are_read(digits):
    expected = 0
    for digit in digits.removeprefix("-"):
        expected = 10 * expected + int(digit)
    assert _oracle._whole(digits) == (-expected if digits.startswith("-") else expected)
