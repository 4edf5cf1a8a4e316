from hypothesis import given, settings

from mine import draw
from rastercheck import Case, assert_right, strategies

CORPUS = "../../../cases/corpus/"
SMOOTH = strategies.attributes(["smooth"], most=1)


def test_a_case_of_the_corpus():
    case = Case.load(CORPUS + "diagonal-rising.json")
    assert_right(case, draw(case))


@settings(deadline=None, max_examples=30)
@given(strategies.triangles(rules=["vulkan"], max_size=4, attributes=SMOOTH))
def test_random_triangles(case):
    assert_right(case, draw(case))
