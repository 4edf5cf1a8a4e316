"""Pictures judged: right ones, and wrong ones in every way."""

import dataclasses
import math

import numpy
import pytest
from oracle_test import u_case
from rastercheck import (
    BadInput,
    Framebuffer,
    PictureLayout,
    TimedOut,
    Vertex,
    Viewport,
    WrongPicture,
    assert_right,
    judge,
    oracle,
)


@pytest.fixture
def case():
    return u_case(name="judged")


@pytest.fixture
def picture(case):
    """The right picture."""
    drawn = numpy.zeros((2, 4), numpy.float32)
    for one in oracle(case):
        drawn[one.y, one.x] = one.attributes[0].exact
    return drawn


def test_a_right_picture_is_right(case, picture, tmp_path):
    numpy.save(tmp_path / "right.npy", picture)
    case.save(tmp_path / "case.json")
    for where in (picture, picture.tolist(), picture[..., None], tmp_path / "right.npy"):
        judgement = assert_right(case, where)
        assert judgement.is_right
        assert (judgement.right, judgement.wrong, judgement.background) == (8, 0, 4)
        assert (judgement.width, judgement.height, judgement.channels) == (4, 2, ("Y",))
    assert judge(tmp_path / "case.json", str(tmp_path / "right.npy")).is_right
    assert str(judge(case, picture)) == "right: 8 of 8 pixels of 'judged'"


def test_wrong_pixels_are_told_apart(case, picture):
    picture[0, 0] = 0.75
    picture[1, 3] = 1
    picture[1, 0] = 0
    picture[0, 2] = numpy.nan
    judgement = judge(case, picture)
    assert (judgement.verdict, judgement.is_right, judgement.wrong) == ("wrong", False, 4)
    assert judgement.pixels == {
        "right": 4, "wrong value": 1, "wrong triangle": 0, "extra": 1, "missing": 1,
        "not a number": 1, "not judged": 0,
    }  # fmt: skip
    counts = (judgement.wrong_value, judgement.extra, judgement.missing, judgement.not_a_number)
    assert counts == (1, 1, 1, 1)
    assert (judgement.wrong_triangle, judgement.not_judged) == (0, 0)
    by_verdict = {one.verdict: one for one in judgement.worst}
    value = by_verdict["wrong value"]
    assert (value.x, value.row, value.triangle) == (0, 0, 0)
    (channel,) = value.channels
    assert channel.stored == 0.75
    assert channel.least <= 3 / 7 <= channel.greatest < 0.43
    assert not channel.is_right
    assert by_verdict["extra"].triangle is None
    assert math.isnan(by_verdict["not a number"].channels[0].stored)
    assert by_verdict["not a number"].steps is None


def test_assertions_say_which_pixels(case, picture):
    picture[0, 0] = 0.75
    with pytest.raises(WrongPicture) as raised:
        assert_right(case, picture)
    first, second = str(raised.value).splitlines()
    assert first == "wrong: 1 of 8 pixels of 'judged' (1 wrong value)"
    assert second.startswith("  x 0, row 0: wrong value: Y 0.75, not 0.428571")
    assert raised.value.judgement.wrong == 1
    assert isinstance(raised.value, AssertionError)
    # Of many wrong pixels the message shows eight.
    wide = dataclasses.replace(case, framebuffer=Framebuffer(8, 8), viewport=Viewport(0, 0, 8, 8))
    lines = str(judge(wide, numpy.full((8, 8), -1.0))).splitlines()
    assert (len(lines), lines[-1]) == (10, "  … and 56 more")


def test_a_contract_decides(case, picture):
    picture[0, 0] += 2**-20  # four ULP of the greatest value, which is 2
    assert judge(case, picture).wrong_value == 1
    bounds = {"bounds": {"smooth": {"constant": 8}}}
    assert judge(case, picture, contract=bounds).is_right
    assert judge(case, picture, promised_by="cpu:precision=float32").is_right
    with pytest.raises(BadInput, match="^rastercheck: .*contract.json: /bound: "):
        judge(case, picture, contract={"bound": {}})


def test_nothing_judged_is_not_right(case, picture):
    # One pixel, which the triangle covers; its attribute is below what the contract is about.
    case = dataclasses.replace(case, framebuffer=Framebuffer(1, 1), viewport=Viewport(0, 0, 1, 1))
    picture = picture[:1, :1]
    unpromised = {"numbers": {"least": 16, "greatest": 32}}
    judgement = judge(case, picture, contract=unpromised)
    assert (judgement.verdict, judgement.is_right, judgement.not_judged) == ("not judged", False, 1)
    with pytest.raises(WrongPicture, match="^no pixel of 'judged' could be judged$"):
        assert_right(case, picture, contract=unpromised)


def test_options_are_passed_on(case, picture, tmp_path):
    upside_down = picture[::-1]
    assert not judge(case, upside_down).is_right
    assert judge(case, upside_down, first_row="bottom").is_right
    bytes_ = numpy.zeros((2, 4, 2), numpy.uint8)
    for one in oracle(case):
        bytes_[one.y, one.x] = round(255 * min(1, one.attributes[0].exact)), 255
    channels = {"R": "u", "G": "coverage"}
    html = tmp_path / "judged.html"
    judgement = assert_right(case, bytes_, channels=channels, storage="unorm8", html=html)
    assert judgement.channels == ("R", "G")
    assert "<html" in html.read_text(encoding="utf-8")
    first = numpy.moveaxis(bytes_, 2, 0)
    assert judge(case, first, channels="R=u,G=coverage", chw=True).is_right
    assert judge(case, bytes_, channels=channels, background="0,1").extra == 4


def test_the_case_may_say_what_pictures_show(picture):
    case = u_case(picture=PictureLayout(first_row="bottom"))
    assert judge(case, picture[::-1]).is_right


def test_a_picture_that_does_not_fit_is_refused(case):
    with pytest.raises(BadInput, match="^rastercheck: .*picture.npy: "):
        judge(case, numpy.zeros((3, 3), numpy.float32))


def test_timeouts(case, picture, stand_in):
    stand_in("exec sleep 60")
    with pytest.raises(TimedOut):
        judge(case, picture, timeout=0.1)
