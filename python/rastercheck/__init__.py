"""RasterCheck from Python: the exact answer of a case, pictures judged, rasterizers checked.

    oracle(case)           what must be drawn, as fractions
    judge(case, picture)   which pixels of a picture are wrong
    assert_right(…)        the same, as an assertion for tests
    run(backend)           every property on the corpus and on random cases
    Case, Vertex, …        cases, as the case file has them
    strategies             cases for Hypothesis (a module of its own)

All of it is done by the program rastercheck, which the environment variable RASTERCHECK names, or
which is on PATH.
"""

from ._case import (
    Attribute,
    Camera,
    Case,
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
)
from ._errors import (
    BackendUnavailable,
    BadInput,
    CaseError,
    PictureError,
    ProgramError,
    ProgramNotFound,
    RasterCheckError,
    TimedOut,
)
from ._judge import JudgedChannel, Judgement, WrongPicture, WrongPixel, assert_right, judge
from ._oracle import Details, Fragment, OracleResult, ValueRange, oracle
from ._program import find_program, program_version
from ._run import Cause, Counterexample, PropertyResult, RunResult, Violation, run

__all__ = [
    "Attribute",
    "BackendUnavailable",
    "BadInput",
    "Camera",
    "Case",
    "CaseError",
    "Cause",
    "Channel",
    "Counterexample",
    "DepthBias",
    "Details",
    "Found",
    "Fragment",
    "Framebuffer",
    "JudgedChannel",
    "Judgement",
    "OracleResult",
    "PictureError",
    "PictureLayout",
    "ProgramError",
    "ProgramNotFound",
    "PropertyResult",
    "RasterCheckError",
    "RunResult",
    "Scissor",
    "Snapping",
    "TimedOut",
    "ValueRange",
    "Vertex",
    "Viewport",
    "Violation",
    "WrongPicture",
    "WrongPixel",
    "assert_right",
    "find_program",
    "float32",
    "judge",
    "oracle",
    "program_version",
    "run",
]

# Messages and help name what users import, not the module that it is defined in.
for _name in __all__:
    globals()[_name].__module__ = __name__
del _name
