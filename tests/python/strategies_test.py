"""Random cases: the program takes them, they reach what they are for, and they shrink."""

import itertools
import sys
from pathlib import Path

from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st
from rastercheck import Case, Framebuffer, WrongPicture, assert_right, oracle, strategies

EXAMPLES = Path(__file__).resolve().parents[2] / "docs/examples/python"
sys.path.insert(0, str(EXAMPLES))
import mine  # noqa: E402

FINDING = settings(derandomize=True, database=None, deadline=None, max_examples=2000)


BEHIND_THE_EYE = strategies.positions(w=strategies.float32s(-16, 16))


@given(strategies.cases(samples=(1, 4), positions=BEHIND_THE_EYE))
def test_the_program_takes_them(case):
    oracle(case)
    assert Case.from_json(case.to_json()) == case


@given(strategies.triangles(positions=st.tuples(*[strategies.float32s()] * 4), max_size=4))
def test_any_floats_are_taken(case):
    oracle(case)
    assert case.triangles == ((0, 1, 2),)


def test_they_reach_what_they_are_for():
    """Within some examples: each rule, several triangles, common vertices, attributes of all kinds,
    vertices exactly on samples, and different w."""
    rules, kinds, seen = set(), set(), set()

    @settings(derandomize=True, database=None, deadline=None, max_examples=60)
    @given(strategies.cases())
    def look(case):
        rules.add(case.rules)
        kinds.update(one.interpolation for one in case.attributes)
        used = list(itertools.chain(*case.triangles))
        seen.update(
            name
            for name, is_seen in {
                "several triangles": len(case.triangles) > 1,
                "common vertices": len(set(used)) < len(used),
                "different w": len({one.position[3] for one in case.vertices}) > 1,
                "no attributes": not case.attributes,
            }.items()
            if is_seen
        )

    look()
    assert rules == {"vulkan", "opengl", "d3d"}
    assert kinds == {"smooth", "noperspective", "flat"}
    assert len(seen) == 4, seen


def test_they_shrink_to_one_triangle_on_one_pixel():
    def area(case):
        (ax, ay), (bx, by), (cx, cy) = (case.vertices[i].position[:2] for i in case.triangles[0])
        return (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)

    some = strategies.cases(max_triangles=2, attributes=strategies.attributes(most=1))
    least = find(some, lambda case: area(case) != 0, settings=FINDING)
    assert least.framebuffer == Framebuffer(1, 1)
    assert (len(least.triangles), len(least.attributes), least.rules) == (1, 0, "vulkan")
    assert len(least.vertices) == 3
    assert all(one.position[2:] == (0, 1) for one in least.vertices)


def test_a_wrong_rasterizer_is_found(monkeypatch):
    monkeypatch.setattr(mine, "owns_ties", lambda *edge: True)
    narrow = strategies.triangles(rules=["vulkan"], max_size=2, attributes=st.just(()))

    def is_wrong(case):
        try:
            assert_right(case, mine.draw(case))
        except WrongPicture as wrong:
            return wrong.judgement.extra > 0
        return False

    # Without shrinking, which takes the program hundreds of times.
    first = find(narrow, is_wrong, settings=settings(FINDING, phases=[Phase.generate]))
    assert len(oracle(first)) < mine.draw(first).sum()
