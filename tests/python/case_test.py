"""Cases: nothing is lost between file, dataclass and file."""

import dataclasses
import json
import math

import pytest
from rastercheck import (
    Attribute,
    Camera,
    Case,
    CaseError,
    Channel,
    DepthBias,
    Found,
    Framebuffer,
    PictureLayout,
    Scissor,
    Snapping,
    Vertex,
    Viewport,
    float32,
    oracle,
    run,
)

SIZE = Framebuffer(4, 2)
TRIANGLE = Case(
    SIZE,
    Viewport.of(SIZE),
    "vulkan",
    [Vertex((-1, -1, 0, 1)), Vertex((1, -1, 0, 1)), Vertex((-1, 1, 0, 1))],
    [(0, 1, 2)],
)

# Members that mean the same as if they were left out (docs/case-format.md), by the name of the
# member that holds them; "" is the case.
DEFAULTS = {
    "": {
        "name": "",
        "coverage": "exact",
        "cull": "none",
        "front_face": "ccw",
        "depth_test": "none",
        "depth_clamp": False,
        "depth_format": "float32",
        "line_width": 1.0,
        "point_size": 1.0,
        "attributes": [],
    },
    "depth_bias": {"constant": 0.0, "slope": 0.0, "clamp": 0.0},
    "framebuffer": {"samples": 1.0},
    "viewport": {"min_depth": 0.0, "max_depth": 1.0},
    "coverage": {"rounding": "nearest_even", "position_error": 0.0},
    "attributes": {"interpolation": "smooth", "location": "sample"},
    "vertices": {"attributes": [], "clip_distances": []},
}


def normal(value, name=""):
    """A document with doubles in place of numbers and hex floats, and without defaults."""
    if isinstance(value, dict):
        members = {key: normal(one, key) for key, one in value.items()}
        defaults = DEFAULTS.get(name, {})
        return {
            key: one
            for key, one in members.items()
            if key not in defaults or repr(defaults[key]) != repr(one)
        }
    if isinstance(value, list):
        return [normal(one, name) for one in value]
    if isinstance(value, str) and value.lstrip("+-").lower().startswith("0x"):
        return float.fromhex(value)
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return float(value)
    return value


def parsed(text):
    return json.loads(text, parse_int=float)  # float("-0") is minus zero


def test_every_case_of_the_corpus_comes_back(corpus):
    files = sorted(corpus.glob("*.json"))
    assert len(files) > 300
    for file in files:
        written = Case.load(file).to_json()
        # As text: equality would not tell -0 from 0.
        assert repr(sorted_members(normal(parsed(written)))) == repr(
            sorted_members(normal(parsed(file.read_text(encoding="utf-8"))))
        ), file.name
        assert Case.from_json(written).to_json() == written


def sorted_members(value):
    if isinstance(value, dict):
        return {name: sorted_members(one) for name, one in sorted(value.items())}
    return [sorted_members(one) for one in value] if isinstance(value, list) else value


def test_the_program_draws_and_judges_the_written_corpus_alike(corpus, tmp_path):
    """Properties take their choices off a hash of the case, so these records differ if a case does."""
    for file in corpus.glob("*.json"):
        Case.load(file).save(tmp_path / file.name)
    splitting = "splitting-a-triangle-changes-nothing-beyond-the-bound"
    before, after = (
        run(properties=splitting, cases=0, seed=1, corpus=folder, power=0).document["records"]
        for folder in (corpus, tmp_path)
    )
    assert sum(one["counts"]["required"] for one in before) > 5000
    assert before == after


def test_all_members_come_back():
    case = Case(
        Framebuffer(8, 4, samples=4),
        Viewport(-0.5, 0.25, 8, -4, min_depth=0.25, max_depth=0.75),
        "opengl",
        [
            Vertex((0, 1, float32(0.1)), [0.5, -0.0], [1]),
            Vertex((1, 0, 0), [1, 2], [-1]),
            Vertex((0, 0, 2.0**-149), [2.0**127, 3], [0]),
        ],
        [(0, 1, 2), (2, 1, 0)],
        name="ünïcode",
        coverage=Snapping(8, "half_up", 0.5),
        basis="unspecified",
        fill_rule="top_left",
        cull="back",
        front_face="cw",
        scissor=Scissor(-1, 0, 4, 4),
        depth_test="less",
        depth_clear=0.5,
        depth_clamp=True,
        depth_bias=DepthBias(-2, 0.5, float32(0.1)),
        depth_format="unorm24",
        attributes=[Attribute("u", "flat", "centroid"), Attribute("v")],
        camera=Camera(projection=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 0]),
        essential=["flat", "samples"],
        choices=2**64 - 1,
        picture=PictureLayout([Channel("R", "u", 0.5)], storage="unorm8", blend="off"),
        found=Found("values", "cpu", seed=2**63, index=3),
    )
    # Of other primitives than triangles, which a case has instead.
    others = ("lines", "points", "line_width", "line_mode", "point_size")
    for one in dataclasses.fields(case):
        if one.name not in ("extra", *others):
            assert getattr(case, one.name) not in (None, one.default), f"{one.name} is not tried"
    written = case.to_json()
    assert repr(Case.from_json(written)) == repr(Case.from_json(written.encode()))
    again = Case.from_json(written)
    assert again == case
    assert hash(again) == hash(case)
    assert math.copysign(1, again.vertices[0].attributes[1]) == -1


@pytest.mark.parametrize(
    "members",
    [
        {"lines": [(0, 1), (1, 0)], "line_width": 2.5, "line_mode": "parallelogram"},
        {"points": [1, 0], "point_size": float32(2.1)},
    ],
)
def test_lines_and_points_come_back(members):
    vertices = [Vertex((0, 1, 0, 1)), Vertex((1, 0, 0, 1))]
    case = Case(Framebuffer(8, 4), Viewport(0, 0, 8, 4), "vulkan", vertices, **members)
    assert "triangles" not in case.to_dict()
    assert Case.from_json(case.to_json()) == case
    assert oracle(case).fragments


def test_a_depth_bias_needs_not_have_all_members():
    for member, bias in (
        ('{"constant": 0}', DepthBias()),
        ('{"slope": 2}', DepthBias(slope=2.0)),
        ('{"clamp": "-0x1p-3", "constant": 1}', DepthBias(1.0, 0.0, -0.125)),
    ):
        text = TRIANGLE.to_json().replace('"rules"', f'"depth_bias": {member}, "rules"', 1)
        case = Case.from_json(text)
        assert case.depth_bias == bias
        assert Case.from_json(case.to_json()) == case
    assert TRIANGLE.depth_bias is None
    assert "depth_bias" not in TRIANGLE.to_json()


def test_minus_zero_keeps_its_sign():
    texts = ["-0", "-0.0", '"-0x0p+0"', "-0e5"]
    for text in texts:
        written = TRIANGLE.to_json().replace('"x": 0', f'"x": {text}')
        assert math.copysign(1, Case.from_json(written).viewport.x) == -1, text
        assert repr(Case.from_json(Case.from_json(written).to_json()).viewport.x) == "-0.0", text


def test_members_of_later_versions_are_kept():
    members = TRIANGLE.to_dict()
    members["new"] = {"a": [1, "0x1p0"]}
    members["viewport"]["newer"] = None
    members["vertices"][1]["newest"] = 0.1
    again = Case.from_dict(members)
    assert again.extra == {"new": {"a": [1, "0x1p0"]}}
    assert again.to_dict() == members
    assert Case.from_json(again.to_json()).to_dict() == members


def test_an_empty_list_is_not_an_absent_one():
    case = dataclasses.replace(TRIANGLE, essential=[])
    assert Case.from_json(case.to_json()).essential == ()
    assert Case.from_json(TRIANGLE.to_json()).essential is None


def test_lists_and_arrays_become_tuples():
    numpy = pytest.importorskip("numpy")
    ours = dataclasses.replace(
        TRIANGLE, vertices=[Vertex(row) for row in numpy.eye(3, 4, dtype=numpy.float32)]
    )
    assert ours.vertices[1] == Vertex((0, 1, 0, 0))
    assert hash(ours) == hash(Case.from_json(ours.to_json()))


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda m: m.pop("viewport"), "/viewport: missing"),
        (lambda m: m["vertices"][2].pop("position"), "/vertices/2/position: missing"),
        (lambda m: m["viewport"].update(x="1.5"), "/viewport/x: not a number: '1.5'"),
        (lambda m: m["viewport"].update(x=True), "/viewport/x: not a number: True"),
        (lambda m: m["framebuffer"].update(width=1.5), "/framebuffer/width: not a whole number: 1"),
        (lambda m: m.update(vertices={}), "/vertices: not a list: {}"),
        (lambda m: m.update(framebuffer=[4, 4]), "/framebuffer: not an object: [4, 4]"),
        (lambda m: m.update(version=2), "/: format 'rastercheck-case', version 2; a case has"),
    ],
)
def test_errors_name_the_place(change, message):
    members = TRIANGLE.to_dict()
    change(members)
    with pytest.raises(CaseError) as raised:
        Case.from_dict(members)
    assert str(raised.value).startswith(message)


@pytest.mark.parametrize(
    "text, message",
    [
        ("{", "not valid JSON: "),
        ("[" * 100000, "not valid JSON: "),
        ('{"a": 1, "a": 2}', "more than one member 'a'"),
        ('{"a": NaN}', "not a finite number: NaN"),
        ("[]", "/: not an object: []"),
    ],
    ids=["open", "deep", "doubled", "NaN", "list"],
)
def test_broken_texts_are_refused(tmp_path, text, message):
    (tmp_path / "broken.json").write_text(text, encoding="utf-8")
    with pytest.raises(CaseError) as raised:
        Case.load(tmp_path / "broken.json")
    assert str(raised.value).startswith(f"{tmp_path}/broken.json: {message}")


def test_what_no_file_can_hold_is_refused():
    case = dataclasses.replace(TRIANGLE, depth_clear=math.nan)
    with pytest.raises(CaseError, match=r"^/depth_clear: not a finite number: nan$"):
        case.to_json()
    case = dataclasses.replace(TRIANGLE, scissor=(0, 0, 1, 1))
    with pytest.raises(CaseError, match=r"^/scissor: not a Scissor: "):
        case.to_json()


def test_float32_is_the_nearest():
    assert float32(0.1) == float.fromhex("0x1.99999ap-4")
    assert float32(1 + 2.0**-24) == 1  # a tie goes to the even one
    with pytest.raises(CaseError):
        float32(1e39)


def test_repr_shows_what_is_not_usual():
    assert repr(Viewport(0, 0, 4, 2, max_depth=0.5)) == (
        "Viewport(x=0, y=0, width=4, height=2, max_depth=0.5)"
    )
    assert eval(repr(TRIANGLE)) == TRIANGLE
