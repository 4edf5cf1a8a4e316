"""Runs: what held, what did not, and why."""

import json
import sys
from pathlib import Path

import pytest
import rastercheck
from rastercheck import run

VALUES = "values-stay-within-the-bound"
# A quarter of an ULP, which rounding alone exceeds.
QUARTER = {"bounds": {"smooth": {"constant": 0.25}}}


def test_a_right_rasterizer_holds():
    result = run(properties="a-shared-edge-covers-*", cases=3, seed=1)
    assert (result.exit_code, result.is_right, result.seed) == (0, True, 1)
    (edges,) = result.properties
    assert (edges.id, edges.backend) == ("a-shared-edge-covers-each-sample-once", "cpu")
    assert edges.verdict == "held"
    assert edges.checked + edges.not_applicable == 3 + len(corpus_files())
    assert edges.fragments > 1000
    assert result.with_verdict("held") == (edges,)
    assert result.counterexamples == result.causes == ()
    assert str(result).splitlines() == [
        "every property held, or was violated in known ways only (seed 1)", "cpu: 1 held",
    ]  # fmt: skip


def corpus_files():
    return list((Path(__file__).resolve().parents[2] / "cases/corpus").glob("*.json"))


def test_counterexamples_are_cases(tmp_path):
    result = run(properties=VALUES, contract=QUARTER, cases=3, seed=1, output=tmp_path / "out")
    assert (result.exit_code, result.is_right) == (1, False)
    assert result.meaning == "a property was violated"
    (values,) = result.properties
    assert values.verdict == "violated" and values.violations > 0
    least, greatest = values.worst_ulp
    assert 0.25 < least <= greatest < 0.51
    for one in result.counterexamples:
        assert (one.property, one.backend) == (VALUES, "cpu")
        first = one.violations[0]
        assert first.verdict == "beyond bound"
        assert first.exact and first.actual and one.close_up
        assert one.case.found.verdict == "beyond bound"
    assert {one for cause in result.causes for one in cause.counterexamples} == set(
        result.counterexamples
    )
    assert result.causes[0].sentence in str(result)
    assert str(result.causes[0].counterexamples[0].violations[0]) in str(result)
    # The files in the folder are the same cases, and the program takes what is saved of them.
    saved = [rastercheck.Case.load(file) for file in (tmp_path / "out").glob("count*/*.json")]
    found = [one.case for one in result.counterexamples]
    assert {case.to_json() for case in saved} == {case.to_json() for case in found}
    assert (tmp_path / "out/report.html").exists()
    case = result.counterexamples[0].case
    assert rastercheck.oracle(case).fragments
    black = [[[0.0] * len(case.attributes)] * case.framebuffer.width] * case.framebuffer.height
    assert rastercheck.judge(case, black).verdict in ("right", "wrong")


def test_a_program_in_python_is_judged():
    examples = Path(__file__).resolve().parents[2] / "docs/examples/exec/python"
    result = run(
        f"exec:{sys.executable} {examples}/little.py",
        properties="constants-stay-constant", cases=1, seed=1, fail_fast=True,
    )  # fmt: skip
    assert result.is_right, str(result)


def test_backends_side_by_side():
    backends = ["cpu", "method:rational-linear"]
    result = run(backends, properties=[VALUES, "what-is-degenerate-*"], cases=1, seed=1)
    assert [(one.id, one.backend) for one in result.properties] == [
        (VALUES, "cpu"), (VALUES, "method:rational-linear"),
        ("what-is-degenerate-covers-nothing", "cpu"),
        ("what-is-degenerate-covers-nothing", "method:rational-linear"),
    ]  # fmt: skip


def test_what_was_not_checked_is_told():
    result = run("method:screen-linear", properties="filtered-colours-*", cases=1, seed=1)
    (colours,) = result.properties
    assert (result.exit_code, colours.verdict, colours.checked) == (5, "not checked", 0)
    assert sum(colours.not_applicable_because.values()) == colours.not_applicable
    assert not result.is_right
    assert colours.worst_ulp is None


def test_the_document_is_all_of_run_json(tmp_path):
    result = run(properties="a-shared-edge-covers-*", cases=0, seed=7, output=tmp_path, formats="json")
    assert result.document == json.loads((tmp_path / "run.json").read_text(encoding="utf-8"))
    assert not (tmp_path / "report.html").exists()


def test_wrong_options_and_missing_backends():
    with pytest.raises(rastercheck.BadInput, match="^rastercheck: .*no-such-property"):
        run(properties="no-such-property")
    with pytest.raises(rastercheck.BadInput, match="^rastercheck: plugin:/nowhere.so: no such"):
        run("plugin:/nowhere.so")

