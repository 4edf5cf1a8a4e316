"""Reads draws and writes answers: the part of an exec: program that every rasterizer needs.

Copy this file. docs/exec-protocol.md says what each member means.
"""

import array
import json
import sys
from dataclasses import dataclass

if sys.byteorder != "little":
    raise SystemExit("numbers are exchanged as little-endian, which this file does not convert to")


@dataclass
class Draw:
    """One draw. `state` has the members of its line, the others are its arrays."""

    state: dict
    sample_positions: list  # [samples] of (x, y), within the pixel
    positions: list  # [vertex] of (x, y, z, w), in clip space
    values: list  # [vertex] of the attributes
    clip_distances: list  # [vertex] of the distances
    triangles: list  # [triangle] of three vertices

    def __getattr__(self, name):
        try:
            return self.state[name]
        except KeyError:
            raise AttributeError(name) from None


class Answer:
    """What was drawn, for the pixels min_x <= x < max_x, min_y <= y < max_y."""

    def __init__(self, draw, min_x, min_y, max_x, max_y):
        self.min_x, self.min_y = min_x, min_y
        self.max_x, self.max_y = max(max_x, min_x), max(max_y, min_y)
        self._samples = draw.samples
        self._attributes = draw.attribute_count
        count = (self.max_x - min_x) * (self.max_y - min_y) * draw.samples
        self._seen = array.array("I", bytes(4 * count))
        self._depth = array.array("f", bytes(4 * count))
        self._values = array.array("f", bytes(4 * count * draw.attribute_count))

    def put(self, x, y, sample, triangle, depth, values):
        """Covers a sample."""
        row = (y - self.min_y) * (self.max_x - self.min_x) + x - self.min_x
        at = row * self._samples + sample
        self._seen[at] = triangle + 1
        self._depth[at] = depth
        self._values[at * self._attributes : (at + 1) * self._attributes] = array.array("f", values)

    def write(self, out):
        arrays = self._seen.tobytes() + self._depth.tobytes() + self._values.tobytes()
        _write_line(
            out,
            {
                "status": "ok",
                "min_x": self.min_x,
                "min_y": self.min_y,
                "max_x": self.max_x,
                "max_y": self.max_y,
                "bytes": len(arrays),
            },
        )
        out.write(arrays)


class Unsupported(Exception):
    """Raised by a rasterizer that does not draw this kind of draw."""


def _write_line(out, members):
    out.write(json.dumps(members, separators=(",", ":")).encode() + b"\n")


def _rows(numbers, length):
    return [tuple(numbers[i : i + length]) for i in range(0, len(numbers), length)]


def _read_draw(source, state):
    def take(kind, count):
        return array.array(kind, source.read(4 * count))

    vertices = state["vertex_count"]
    attributes, distances = state["attribute_count"], state["clip_distance_count"]
    places = _rows(take("f", 2 * state["samples"]), 2)
    positions = _rows(take("f", 4 * vertices), 4)
    values = _rows(take("f", vertices * attributes), attributes) if attributes else [()] * vertices
    clips = _rows(take("f", vertices * distances), distances) if distances else [()] * vertices
    triangles = _rows(take("I", 3 * state["triangle_count"]), 3)
    return Draw(state, places, positions, values, clips, triangles)


def serve(draw, **hello):
    """Answers draws until the input ends. draw(Draw) returns an Answer, or raises Unsupported."""
    source, out = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # so that print() does not disturb the answers
    source.readline()
    _write_line(out, {"protocol": 1, **hello})
    out.flush()
    for line in source:
        asked = _read_draw(source, json.loads(line))
        try:
            draw(asked).write(out)
        except Unsupported as why:
            _write_line(out, {"status": "unsupported", "message": str(why)})
        out.flush()
