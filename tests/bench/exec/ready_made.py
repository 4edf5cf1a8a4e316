"""A program whose drawing takes no time: it gives the same answer to every draw of one size, which
covers the samples above the diagonal.

Usage: ready_made.py FOLDER_OF_DRAWS_PY
"""

import sys

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import draws  # noqa: E402

answers = {}


def draw(asked):
    size = (asked.width, asked.height, asked.attribute_count)
    if size not in answers:
        answer = answers[size] = draws.Answer(asked, 0, 0, asked.width, asked.height)
        for y in range(asked.height):
            for x in range(max(asked.width - y, 0)):
                answer.put(x, y, 0, 0, 0.0, [0.0] * asked.attribute_count)
    return answers[size]


draws.serve(draw, name="ready made")
