"""Finding and running the program: what goes wrong is an exception that says why."""

import time

import pytest
import rastercheck
from case_test import TRIANGLE


def test_it_is_found_and_says_its_version():
    major, minor, patch = map(int, rastercheck.program_version().split("."))
    assert (major, minor, patch) >= (0, 1, 0)


def test_it_is_found_on_the_path(stand_in, monkeypatch):
    program = stand_in("echo rastercheck 9.8.7")
    program = program.rename(program.with_name("rastercheck"))
    monkeypatch.delenv("RASTERCHECK")
    monkeypatch.setenv("PATH", f"{program.parent}")
    assert rastercheck.find_program() == str(program)
    assert rastercheck.program_version() == "9.8.7"
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(rastercheck.ProgramNotFound, match="^rastercheck is not on PATH; install"):
        rastercheck.oracle(TRIANGLE)


def test_a_wrong_variable_is_named(monkeypatch):
    monkeypatch.setenv("RASTERCHECK", "/nowhere/rastercheck")
    with pytest.raises(rastercheck.ProgramNotFound, match="^RASTERCHECK is '/nowhere/rastercheck'"):
        rastercheck.program_version()


def test_another_program_is_not_taken_for_it(stand_in):
    stand_in("echo something else")
    with pytest.raises(rastercheck.ProgramNotFound, match="--version printed 'something else'"):
        rastercheck.program_version()


def test_a_program_that_cannot_start_is_named(stand_in):
    program = stand_in("")
    program.write_text("#!/no/such/interpreter\n", encoding="utf-8")
    with pytest.raises(rastercheck.ProgramNotFound, match="stand-in cannot be started: No such"):
        rastercheck.program_version()


def test_its_own_line_is_the_message():
    with pytest.raises(rastercheck.BadInput) as raised:
        rastercheck.oracle("/nowhere/case.json")
    assert str(raised.value).startswith("rastercheck: /nowhere/case.json: ")
    assert raised.value.exit_code == 2
    assert raised.value.command[1:] == ("oracle", "/nowhere/case.json", "--json")


@pytest.mark.parametrize(
    "script, kind, message",
    [
        ("echo more >&2; echo 'rastercheck: no GPU' >&2; exit 4",
         rastercheck.BackendUnavailable, "rastercheck: no GPU"),
        ("echo 'rastercheck: self-check' >&2; exit 70",
         rastercheck.ProgramError, "rastercheck: self-check"),
        ("echo killed >&2; exit 99", rastercheck.ProgramError,
         "rastercheck oracle ended with exit code 99: killed"),
        ("kill -9 $$", rastercheck.ProgramError, "rastercheck oracle was ended by signal 9"),
    ],
)  # fmt: skip
def test_exit_codes_are_exceptions(stand_in, script, kind, message):
    stand_in(script)
    with pytest.raises(rastercheck.ProgramError) as raised:
        rastercheck.oracle(TRIANGLE)
    assert type(raised.value) is kind
    assert str(raised.value) == message


def test_a_later_version_is_not_misread(stand_in):
    stand_in("""echo '{"format": "rastercheck-oracle", "version": 2}'""")
    with pytest.raises(rastercheck.ProgramError, match="wrote rastercheck-oracle, version 2; this"):
        rastercheck.oracle(TRIANGLE)


def test_a_timeout_ends_the_program(stand_in, tmp_path):
    # It may tidy up: its trap runs, because it is asked to end before it is killed.
    stand_in(f"trap 'echo tidy >{tmp_path}/log; exit 1' TERM; while :; do sleep 0.05; done")
    begin = time.monotonic()
    with pytest.raises(rastercheck.TimedOut, match="^rastercheck oracle did not end within 0.2 s"):
        rastercheck.oracle(TRIANGLE, timeout=0.2)
    assert (tmp_path / "log").read_text(encoding="utf-8") == "tidy\n"
    assert time.monotonic() - begin >= 0.2


def test_a_timeout_of_a_run_is_one(corpus):
    with pytest.raises(TimeoutError):
        rastercheck.run(cases=10**6, seed=1, timeout=0.5)
