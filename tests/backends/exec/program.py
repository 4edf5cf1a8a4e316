"""A program that answers draws, rightly or in one of many wrong ways (exec_test.cpp).

Usage: program.py WAY

Covers the pixels of a square whatever it is asked for: tests look at how answers are taken, not at
what they show. Wrong answers are those to draws whose first vertex has a clip y above 0.
"""

import json
import mmap
import os
import signal
import struct
import sys
import time

way = sys.argv[1] if len(sys.argv) > 1 else ""
source, out = sys.stdin.buffer, sys.stdout.buffer

HELLO = {"protocol": 1, "name": "program", "version": "7"}
HELLOS = {
    "no-json": b"Hello!\n",
    "other-protocol": b'{"protocol":2,"name":"program"}\n',
    "unknown-key": b'{"protocol":1,"name":"program","colour":"red"}\n',
    "no-name": b'{"protocol":1}\n',
    "bad-contract": b'{"protocol":1,"name":"program","contract":{"coverage":"exact"}}\n',
    "bad-limits": b'{"protocol":1,"name":"program","limits":{"sample_counts":[3]}}\n',
    "endless-hello": b"x" * 100_000,
}


def line(members):
    return json.dumps(members).encode() + b"\n"


def write(data):
    out.write(data)
    out.flush()


def square(asked):
    """The header and arrays of an answer that covers two by two pixels with values of 0.25."""
    samples, gives = asked["samples"], HELLO.get("gives", "attributes")
    count = 4 * samples
    numbers = {"triangle": 0, "depth": 1, "barycentrics": 4, "attributes": 1 + asked["attribute_count"]}
    arrays = b"\1\0\0\0" * count + b"\0\0\x80\x3e" * (count * numbers[gives])
    header = {"status": "ok", "min_x": 1, "min_y": 1, "max_x": 3, "max_y": 3, "bytes": len(arrays)}
    return header, arrays


def misbehave(header, arrays):
    """Answers in the wrong way; returns the right answer if there is none of that name."""
    if way == "segfault":
        print("last words", file=sys.stderr, flush=True)
        os.kill(os.getpid(), signal.SIGSEGV)
    elif way == "exit":
        sys.exit(3)
    elif way == "silent":
        time.sleep(1000)
    elif way == "garbage":
        return b"triangle 0 is drawn\n"
    elif way == "list":
        return b"[1, 2]\n"
    elif way == "endless-line":
        return b"x" * 100_000
    elif way == "truncated":
        write(line(header) + arrays[:5])
        sys.exit(0)
    elif way == "closes-output":
        write(line(header) + arrays[:5])
        os.close(1)
        time.sleep(1000)
    elif way == "oversized":
        return line({**header, "bytes": 10**15}) + arrays
    elif way == "too-few-bytes":
        return line({**header, "bytes": len(arrays) - 4}) + arrays[:-4]
    elif way == "outside":
        return line({**header, "max_x": 1000}) + arrays
    elif way == "turned-round":
        return line({**header, "min_x": 3, "max_x": 1}) + arrays
    elif way == "says-more":
        return line(header) + arrays + b"and more\n"
    elif way == "wrong-triangle":
        return line(header) + b"\7\0\0\0" + arrays[4:]
    elif way == "unknown-status":
        return line({**header, "status": "fine"}) + arrays
    elif way == "unsupported":
        return line({"status": "unsupported", "message": "not today"})
    elif way == "failed":
        return line({"status": "failed", "message": "no room"})
    elif way == "much-memory":
        blocks = [bytearray(1 << 28) for _ in range(40)]
        return line({"status": "failed", "message": f"{len(blocks)} blocks"})
    elif way == "writes-files":
        try:
            with open(os.path.join(sys.argv[2], "written"), "w"):
                pass
        except OSError as why:
            return line({"status": "failed", "message": why.strerror})
    return line(header) + arrays


def main():
    if way == "exits-at-once":
        print("no such module", file=sys.stderr)
        sys.exit(4)
    if way == "silent-hello":
        time.sleep(1000)
    if way in ("triangle", "depth", "barycentrics"):
        HELLO["gives"] = way
    if way == "shared":
        HELLO["shared_memory"] = True
    if way == "bounded":
        HELLO["limits"] = {"lacks": ["scissor"], "max_size": 4}
    if way == "answers-first":
        write(line(HELLO) + b"x" * 200_000)
        time.sleep(1000)
    source.readline()
    write(HELLOS.get(way, line(HELLO)))
    for text in source:
        asked = json.loads(text)
        header, arrays = square(asked)
        if way == "shared":
            with mmap.mmap(3, asked["memory_size"]) as memory:
                at = asked["answer_at"]
                memory[at : at + len(arrays)] = arrays
            write(line(header))
            continue
        arrays_asked = source.read(asked["bytes"])
        (y,) = struct.unpack_from("<f", arrays_asked, 8 * asked["samples"] + 4)
        write(misbehave(header, arrays) if y > 0 else line(header) + arrays)


main()
