"""Writes 16 cases into a folder, always the same ones. Each has 26 large triangles in perspective
on 1024 × 1024 pixels; together they have some 110 million fragments (docs/oracle.md)."""

import json
import pathlib
import random
import sys

SIZE = {"width": 1024, "height": 1024}
LEAST_AREA = 0.8  # of the 4 that the target has


def float32(x):
    """A number of few bits near x."""
    return round(x * 2**14) / 2**14


def corners():
    """Three points in the target that are far apart."""
    while True:
        (ax, ay), (bx, by), (cx, cy) = points = [
            (random.uniform(-1, 1), random.uniform(-1, 1)) for _ in range(3)]
        if abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2 > LEAST_AREA:
            return points


def vertex(x, y):
    w = float32(random.uniform(0.5, 4))
    return {"position": [float32(x * w), float32(y * w), float32(random.uniform(-0.9, 0.9) * w), w],
            "attributes": [float32(random.uniform(-3, 3)), float32(random.random())]}


def case(seed):
    random.seed(seed)
    vertices = [vertex(*corner) for _ in range(26) for corner in corners()]
    return {
        "format": "rastercheck-case", "version": 1, "rules": "opengl", "name": f"large {seed}",
        "framebuffer": {**SIZE, "samples": 1}, "viewport": {"x": 0, "y": 0, **SIZE},
        "attributes": [{"name": "a"}, {"name": "b", "interpolation": "noperspective"}],
        "vertices": vertices, "triangles": [[3 * t, 3 * t + 1, 3 * t + 2] for t in range(26)]}


folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
for number in range(16):
    (folder / f"large-{number:02}.json").write_text(json.dumps(case(number)))
