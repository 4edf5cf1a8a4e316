"""`rastercheck run`: every property on the corpus and on random cases."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Optional, Union

from . import _program
from ._case import Case

# Exit codes with which a run has results, and what they mean.
_MEANINGS = {
    0: "every property held, or was violated in known ways only",
    1: "a property was violated",
    3: "a property is worse than the baseline",
    5: "nothing was checked, or too little",
    130: "the run was interrupted before anything was violated",
}
# Causes that str() of a result shows.
_MOST_SHOWN = 5


@dataclass(frozen=True)
class Violation:
    """One wrong fragment of a counterexample. `exact` and `actual` are texts for people."""

    triangle: int
    x: int
    y: int
    sample: int
    verdict: str  # "missing", "extra", "beyond bound", …
    kind: str  # of value, or "coverage"
    exact: str
    actual: str
    note: str

    def __str__(self) -> str:
        return (
            f"pixel ({self.x}, {self.y}), sample {self.sample} of triangle {self.triangle}: "
            f"{self.kind} {self.verdict}: exactly {self.exact}, drawn {self.actual}"
        )


@dataclass(frozen=True)
class Counterexample:
    """A case that violates a property, shrunk. `close_up` shows the pixels around the first
    violation, in lines of text; `case.found` says where the case comes from."""

    property: str  # its id
    backend: str
    case: Case
    violations: tuple[Violation, ...]
    close_up: tuple[str, ...]


@dataclass(frozen=True)
class Cause:
    """A fault that some counterexamples have in common, found by experiment."""

    backend: str
    sentence: str
    hint: Optional[str]  # a simple change that makes the wrong drawings right
    counterexamples: tuple[Counterexample, ...]


@dataclass(frozen=True)
class PropertyResult:
    """What became of one property on one backend.

    checked         cases that were checked, and not_applicable cases that were not
    not_judged      fragments and values that could be anything, by reason
    worst_ulp       the largest error of a value against the exact triangle, in scale ULP, as two
                    doubles that enclose it; None without values
    beyond_contract the same, beyond what the contract leaves open
    """

    id: str
    backend: str
    verdict: Literal["held", "violated", "known", "thin", "not checked"]
    checked: int
    not_applicable: int
    violations: int
    known: int
    fragments: int
    values: int
    not_judged: Mapping[str, Any]
    not_applicable_because: Mapping[str, int]
    worst_ulp: Optional[tuple[float, float]]
    beyond_contract: Optional[tuple[float, float]]


@dataclass(frozen=True)
class RunResult:
    """The results of a run. `document` is all of its run.json."""

    exit_code: int
    seed: int
    properties: tuple[PropertyResult, ...]
    causes: tuple[Cause, ...]
    counterexamples: tuple[Counterexample, ...]
    document: Mapping[str, Any]

    @property
    def is_right(self) -> bool:
        """True if every property held, or was violated in known ways only (exit code 0)."""
        return self.exit_code == 0

    @property
    def meaning(self) -> str:
        """What the exit code means."""
        return _MEANINGS[self.exit_code]

    def with_verdict(self, verdict: str) -> tuple[PropertyResult, ...]:
        """The properties with this verdict."""
        return tuple(one for one in self.properties if one.verdict == verdict)

    def __str__(self) -> str:
        """The verdict, and each cause with its smallest counterexample."""
        lines = [f"{self.meaning} (seed {self.seed})"]
        for backend in dict.fromkeys(one.backend for one in self.properties):
            rows = [one for one in self.properties if one.backend == backend]
            counts = {verdict: 0 for verdict in ("held", "thin", "known", "violated")}
            for one in rows:
                counts[one.verdict] = counts.get(one.verdict, 0) + 1
            words = ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count)
            lines.append(f"{backend}: {words}")
        for cause in self.causes[:_MOST_SHOWN]:
            lines.append(f"cause: {cause.sentence}")
            if cause.hint:
                lines.append(f"  hint: {cause.hint}")
            first = cause.counterexamples[0]
            lines.append(f"  {first.property}")
            if first.violations:
                lines.append(f"  {first.violations[0]}")
        if len(self.causes) > _MOST_SHOWN:
            lines.append(f"… and {len(self.causes) - _MOST_SHOWN} more causes")
        return "\n".join(lines)


def run(
    backend: Union[str, Sequence[str]] = "cpu",
    *,
    properties: Union[str, Sequence[str], None] = None,
    cases: Optional[int] = None,
    seed: Optional[int] = None,
    jobs: Optional[int] = None,
    scene: Optional[_program.PathLike] = None,
    contract: Union[_program.PathLike, Mapping[str, Any], None] = None,
    promise: Optional[Literal["spec", "conformance", "ieee"]] = None,
    corpus: Optional[_program.PathLike] = None,
    known: Union[_program.PathLike, Sequence[_program.PathLike], None] = None,
    no_known: bool = False,
    baseline: Optional[_program.PathLike] = None,
    policy: Optional[_program.PathLike] = None,
    shrink_tries: Optional[int] = None,
    power: Optional[int] = None,
    require_cases: Optional[int] = None,
    fail_fast: bool = False,
    max_time: Optional[float] = None,
    draw_timeout: Optional[float] = None,
    output: Optional[_program.PathLike] = None,
    formats: Optional[str] = None,
    timeout: Optional[float] = None,
) -> RunResult:
    """Checks every property on the corpus and on random cases: `rastercheck run --json`.

    backend       one backend, or several, to see them side by side: "cpu", "gl:llvmpipe",
                  "plugin:./mine.so", "exec:python3 mine.py", …
    properties    patterns of the ids of the properties to check, such as "*edge*"; default: all
    cases         random cases per property, in addition to the corpus
    seed          of the random cases; by default a new one, which the result has
    draw_timeout  seconds that a backend may draw without a sign of progress (--timeout)
    max_time      seconds after which the program stops checking and reports what was found
    output        a folder for the reports, counterexamples and run.json; by default these are not
                  kept
    formats       the reports to write into `output`, separated by commas
    timeout       seconds; TimedOut is raised after them, and what was found is only in `output`

    The other arguments are the options of the same names. Raises BadInput and BackendUnavailable.
    """
    __tracebackhide__ = True
    with tempfile.TemporaryDirectory(prefix="rastercheck-") as folder:
        written = os.fspath(output) if output is not None else os.path.join(folder, "out")
        words = ["run", "--json", "--quiet"]
        for name, value in (
            ("--backend", backend),
            ("--property", properties),
            ("--cases", cases),
            ("--seed", seed),
            ("--jobs", jobs),
            ("--scene", scene),
            ("--contract", _program.contract_file(contract, folder)),
            ("--promise", promise),
            ("--corpus", corpus),
            ("--known", known),
            ("--no-known", no_known),
            ("--baseline", baseline),
            ("--policy", policy),
            ("--shrink-tries", shrink_tries),
            ("--power", power),
            ("--require-cases", require_cases),
            ("--fail-fast", fail_fast),
            ("--max-time", max_time),
            ("--timeout", draw_timeout),
            ("--output", written),
            ("--format", formats or (None if output is not None else "json")),
        ):
            _program.add_option(words, name, value)
        ended = _program.call(words, expected=_MEANINGS, timeout=timeout)
        text = (Path(written) / "run.json").read_text(encoding="utf-8")
    document = _program.read_document(text, "rastercheck-run", 3)
    return _result(json.loads(ended.output), document, ended.exit_code)


def _violation(members: dict[str, Any]) -> Violation:
    return Violation(
        triangle=members["triangle"],
        x=members["x"],
        y=members["y"],
        sample=members["sample"],
        verdict=members["class"],
        kind=members["kind"],
        exact=members["exact"],
        actual=members["actual"],
        note=members.get("note", ""),
    )


def _counterexample(members: dict[str, Any]) -> Counterexample:
    case = Case.from_dict(members["case"])
    return Counterexample(
        property=(case.found and case.found.property) or "",
        backend=(case.found and case.found.backend) or "",
        case=case,
        violations=tuple(map(_violation, members["violations"])),
        close_up=tuple(members["close_up"]),
    )


def _cause(members: dict[str, Any], every: tuple[Counterexample, ...]) -> Cause:
    hint = members.get("hint")
    return Cause(
        backend=members["backend"],
        sentence=members["sentence"],
        hint=hint and hint["change"],
        counterexamples=tuple(every[i] for i in members["counterexamples"]),
    )


def _worst(members: dict[str, Any]) -> Optional[tuple[float, float]]:
    """An enclosure, whose ends are "inf" where they are infinite."""
    worst = members["worst"]
    return None if worst is None else (float(worst[0]), float(worst[1]))


def _property(members: dict[str, Any]) -> PropertyResult:
    judged = members["judged"]
    return PropertyResult(
        id=members["property"],
        backend=members["backend"],
        verdict=members["verdict"],
        checked=members["checked"],
        not_applicable=members["not_applicable"],
        violations=members["violations"],
        known=members["known"],
        fragments=judged["fragments"],
        values=judged["values"],
        not_judged=judged["not_judged"],
        not_applicable_because=members["not_applicable_because"],
        worst_ulp=_worst(members["ideal_error"]),
        beyond_contract=_worst(members["beyond_contract"]),
    )


def _result(table: dict[str, Any], document: dict[str, Any], exit_code: int) -> RunResult:
    every = tuple(map(_counterexample, document["counterexamples"]))
    return RunResult(
        exit_code=exit_code,
        seed=table["seed"],
        properties=tuple(map(_property, table["properties"])),
        causes=tuple(_cause(one, every) for one in document.get("causes", [])),
        counterexamples=every,
        document=document,
    )
