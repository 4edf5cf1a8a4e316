"""Prints a case of 144 thin triangles at all angles on 8192 × 8192 pixels, always the same: few
fragments, long edges, and 1.04 billion samples in the triangles' boxes (docs/oracle.md)."""

import json
import random

SIZE = {"width": 8192, "height": 8192}


def float32(x):
    """A number of at most 24 bits near x; not 0."""
    return (round(x * 2**23) or 1) / 2**23


def corners():
    """Two points anywhere, and one beside the line between them."""
    ax, ay, bx, by = (random.uniform(-1, 1) for _ in range(4))
    along, aside = random.random(), 2 ** random.uniform(-12, -3)
    cx = ax + along * (bx - ax) - aside * (by - ay)
    cy = ay + along * (by - ay) + aside * (bx - ax)
    return (ax, ay), (bx, by), (cx, cy)


def vertex(x, y):
    w = float32(random.uniform(0.5, 1))
    return {"position": [float32(x * w), float32(y * w), float32(w * random.random()), w],
            "attributes": [float32(random.random())]}


random.seed(1)
vertices = [vertex(*corner) for _ in range(144) for corner in corners()]
print(json.dumps({
    "format": "rastercheck-case", "version": 1, "rules": "vulkan",
    "framebuffer": {**SIZE, "samples": 1}, "viewport": {"x": 0, "y": 0, **SIZE},
    "attributes": [{"name": "u"}], "vertices": vertices,
    "triangles": [[3 * t, 3 * t + 1, 3 * t + 2] for t in range(144)]}))
