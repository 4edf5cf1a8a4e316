#!/usr/bin/env python3
"""Compares the text of the pages with the facts: links, options, commands, counts.

Usage: text_test.py SOURCE_DIR RASTERCHECK
"""

import functools
import json
import pathlib
import re
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True  # no traces in the source tree
import commands_test  # noqa: E402
import declared  # noqa: E402
import page as pages  # noqa: E402

SOURCE, RASTERCHECK = pathlib.Path(), ""

# Pages about other things: the projects that `rastercheck plugin new` makes, and the source of some
# test cases.
ELSEWHERE = ("docs/examples/plugin/starter/README.md", "docs/examples/plugin/image/README.md",
             "docs/examples/exec/image/README.md",
             *(f"docs/examples/exec/starter/{language}/README.md" for language in ("python", "javascript", "rust")),
             "tests/oracle/vectors/README.md")
# Numbers that pages write as words.
WORDS = {"six": 6, "nine": 9, "ten": 10, "twelve": 12, "thirteen": 13, "fourteen": 14, "seventeen": 17, "forty": 40, "fifty": 50, "sixty": 60, "seventy": 70, "eighty": 80}


def texts():
    """All pages of the tree, with their texts."""
    paths = [*SOURCE.glob("*.md"), *SOURCE.glob("docs/**/*.md"), *SOURCE.glob("tests/**/*.md")]
    return {path.relative_to(SOURCE).as_posix(): path.read_text(encoding="utf-8") for path in sorted(paths)}


def said(*words):
    done = subprocess.run([RASTERCHECK, *words], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else None


@functools.lru_cache(maxsize=None)
def options_of(*words):
    """The options that the help of a command lists; None if the command does not exist."""
    text = said(*words, "--help") or ""
    is_its_own = f"Usage: {' '.join(['rastercheck', *words])} " in text
    return set(re.findall(r"^  (?:-\w, )?(--[\w-]+)", text, re.MULTILINE)) if is_its_own else None


@functools.lru_cache(maxsize=None)
def subcommands(*words):
    text = said(*words, "--help") or ""
    return re.findall(r"^  (\w+)", text.partition("\nCommands:\n")[2].partition("\n\n")[0], re.MULTILINE)


def command_fault(words):
    """A text that says what is wrong with the words after `rastercheck`, or None."""
    words = words.split(" -- ")[0].split(" | ")[0].split()
    place = []
    while words and subcommands(*place):
        if words[0] not in subcommands(*place):
            is_hidden = words[0].startswith(("-", "…")) or options_of(*place, words[0])
            return None if is_hidden else f"there is no {' '.join([*place, words[0]])}"
        place.append(words.pop(0))
    known = options_of(*place)
    return next((f"{' '.join(place)} has no {word.split('=')[0]}" for word in words
                 if re.fullmatch(r"--[a-z][\w-]*(=.*)?", word) and word.split("=")[0] not in known), None)


def option_faults(text):
    """The commands and options that a page names but the program does not have."""
    everywhere = set().union(*(options_of(name) for name in subcommands()),
                             *(options_of(name, inner) for name in subcommands() for inner in subcommands(name)),
                             options_of())
    named = [command.text for command in pages.commands(text)] + pages.code_spans(text)
    faults = []
    for words in named:
        program = re.match(r"(?:\S*/)?rastercheck (.*)", words)
        if program or words.split()[0] in subcommands() and " -" in words:
            faults.append(command_fault(program[1] if program else words))
        elif words.startswith("--"):
            faults += [f"there is no {word}" for word in re.findall(r"--[a-z][\w-]*", words) if word not in everywhere]
    return [fault for fault in faults if fault]


def link_faults(place, text, all_texts):
    """The links of a page that lead nowhere."""
    faults = []
    for target in pages.links(text):
        path, _, anchor = target.partition("#")
        there = (SOURCE / place).parent / path if path else SOURCE / place
        if not there.exists():
            faults.append(target)
        elif anchor and anchor not in pages.anchors(all_texts[there.resolve().relative_to(SOURCE).as_posix()]
                                                    if path else text):
            faults.append(target)
    return faults


def number(word):
    """The value of a number in digits or in words (WORDS); −1, which no count equals, for other
    words."""
    return int(word.replace(",", "")) if word[0].isdigit() else WORDS.get(word, -1)


def listed(kind):
    return len(json.loads(said("list", kind, "--json"))[kind])


def of_files(pattern, words=""):
    return sum(words in path.read_text(encoding="utf-8") for path in SOURCE.glob(pattern))


def known(driver):
    return len(json.loads((SOURCE / f"backends/{driver}/known.json").read_text(encoding="utf-8"))["entries"])


def defects(drivers):
    text = (SOURCE / "docs/findings.md").read_text(encoding="utf-8")
    sections = re.findall(r"^## [a-z0-9-]+\n\n\*([^*]*)\*", text, re.MULTILINE)
    return sum(len(set(re.findall(drivers, section))) for section in sections) if drivers else len(sections)


def sensitivity(pattern):
    """A figure from docs/gate-sensitivity.md, which a script writes."""
    return int(re.search(pattern, (SOURCE / "docs/gate-sensitivity.md").read_text(encoding="utf-8"))[1])


# Page, pattern of a text with its number in a group, actual count. “More than” means up to a fifth
# more, “some” within a twentieth.
FIGURES = [
    ("README.md", r"\[(More than \w+)\]\(docs/properties.md\)", lambda: listed("properties")),
    ("README.md", r"on a \[corpus\]\(cases/corpus\) of (more than \d+) cases",
     lambda: of_files("cases/corpus/*.json")),
    ("README.md", r"of the rasterizer, (more than \d+), each", lambda: of_files("tests/mutants/*.patch")),
    ("README.md", r"\[(\d+) defects\]", lambda: defects("")),
    ("docs/what-it-does.md", r"\[(more than \w+)\]\(properties.md\)", lambda: listed("properties")),
    ("docs/what-it-does.md", r"corpus\]\(../cases/corpus\) of (more than \d+) cases",
     lambda: of_files("cases/corpus/*.json")),
    ("docs/what-it-does.md", r"of the rasterizer, (more than \d+), each", lambda: of_files("tests/mutants/*.patch")),
    ("docs/what-it-does.md", r"\[(\w+) small changes\]", lambda: of_files("tests/gate/*.patch")),
    ("docs/what-it-does.md", r"it flags (\d+),", lambda: sensitivity(r"(\d+) are flagged")),
    ("docs/case-format.md", r"holds (more than \d+)", lambda: of_files("cases/corpus/*.json")),
    ("docs/judge-your-rasterizer.md", r"checks (some \d+) properties", lambda: listed("properties")),
    ("docs/oracle.md", r"(\d+) cases with the answers of an independent",
     lambda: of_files("tests/oracle/vectors/*.json")),
    ("docs/oracle.md", r"(Some \w+) mutants of the rasterizer say",
     lambda: of_files("tests/mutants/*.patch", "Attributed to:")),
    ("docs/regression-gate.md", r"\[(\w+) small changes\]", lambda: of_files("tests/gate/*.patch")),
    ("docs/regression-gate.md", r"- (\d+) are flagged,", lambda: sensitivity(r"(\d+) are flagged")),
    ("docs/regression-gate.md", r"flagged, (\d+) of which violate no property",
     lambda: sensitivity(r"of which (\d+) violate")),
    ("docs/regression-gate.md", r"- (\d+) alter no bit", lambda: of_files("tests/gate/*.patch", "Neutral:")),
    ("docs/regression-gate.md", r"the other (\d+) alter bits", lambda: of_files("tests/gate/*.patch", "Unseen:")),
    ("docs/findings.md", r"These are (\w+) defects", lambda: defects("")),
    ("docs/findings.md", r"and (\w+) with each driver", lambda: defects("llvmpipe|softpipe|lavapipe|swiftshader")),
    *(("docs/findings.md", rf"^\| {name} \|.*\| (\d+) \|$", lambda name=name: known(name.lower()))
      for name in ("llvmpipe", "softpipe", "lavapipe", "SwiftShader")),
]


def figure_fault(text, pattern, count):
    found = re.search(pattern.replace(" ", r"\s+"), text, re.MULTILINE)
    if not found:
        return f"does not say “{pattern}”"
    *how, said_number = found[1].lower().split()
    least = number(said_number)
    if how == ["more", "than"]:
        is_right = least < count <= 1.2 * least
    elif how == ["some"]:
        is_right = abs(count - least) <= 0.05 * least
    else:
        is_right = count == least
    return None if is_right else f"says “{found[0]}”, and there are {count}"


class Pages(unittest.TestCase):
    def test_links_lead_somewhere(self):
        all_texts = texts()
        self.assertGreater(len(all_texts), 25)
        for place, text in all_texts.items():
            if place not in ELSEWHERE:
                with self.subTest(place):
                    self.assertEqual(link_faults(place, text, all_texts), [])
        self.assertEqual(link_faults("docs/rules.md", "## A `b`!\n[a](#a-b) [b](#c) [c](README.md) "
                                     "[d](rules.md#5-errors-and-their-units) [d](rules.md#no)", all_texts),
                         ["#c", "README.md", "rules.md#no"])

    def test_findings_have_the_sections_that_their_entries_name(self):
        page = (SOURCE / "docs/findings.md").read_text(encoding="utf-8")
        for path in SOURCE.glob("backends/*/known.json"):
            for entry in json.loads(path.read_text(encoding="utf-8"))["entries"]:
                self.assertIn(entry["finding"], pages.anchors(page), entry["id"])
                self.assertIn(entry["id"].split("-")[0], page.split(f"## {entry['finding']}\n")[1].split("## ")[0])

    def test_commands_and_options_are_known(self):
        for place, text in texts().items():
            if place not in ELSEWHERE:
                with self.subTest(place):
                    self.assertEqual(option_faults(text), [])
        for wrong in ["`rastercheck runs`", "`rastercheck run --propery x`", "`--keep-case`", "`run --cases 1 --as B`",
                      "`rastercheck baseline store`", "a\n\n    rastercheck list --cases 1\n"]:
            self.assertEqual(len(option_faults(wrong)), 1, wrong)
        for right in ["`rastercheck run --cases 1`", "`rastercheck bisect A B -- make --all`", "`--json --details`",
                      "`baseline approve --reason TEXT`", "`run`", "`rastercheck --version`"]:
            self.assertEqual(option_faults(right), [], right)

    def test_figures_are_counts(self):
        all_texts = texts()
        for place, pattern, count in FIGURES:
            with self.subTest(place=place, pattern=pattern):
                self.assertIsNone(figure_fault(all_texts[place], pattern, count()))
        for text, is_right in [("12 are", True), ("13 are", False), ("more than 11 are", True),
                               ("more than 12 are", False), ("more than 9 are", False), ("some 12 are", True),
                               ("some 14 are", False), ("umpteen are", False), ("are", False)]:
            fault = figure_fault(text, r"((?:more than |some )?\w+) are", 12)
            self.assertEqual(fault is None, is_right, text)


class Commands(unittest.TestCase):
    def every(self):
        """For every command of all pages: the page, its commands up to this one, and the
        command."""
        for path in [*SOURCE.glob("*.md"), *SOURCE.glob("docs/*.md")]:
            found = [command.text for command in pages.commands(path.read_text(encoding="utf-8"))]
            for i, command in enumerate(found):
                yield path.name, found[:i + 1], command

    def test_what_is_declared_is_there(self):
        every = list(self.every())
        self.assertGreater(len(every), 50)
        for pattern in declared.NOT_RUN:
            self.assertTrue(any(re.search(pattern, command) for _, _, command in every), pattern)
        run = [command for _, _, command in every if commands_test.is_run(command)]
        for pattern, instead, _ in declared.INSTEAD:  # each sees what those before it made
            self.assertTrue(any(re.search(pattern, command) for command in run), pattern)
            run = [re.sub(pattern, instead, command) for command in run]
        for place, pattern, _, _ in declared.ENDS_WITH:
            self.assertTrue(any(place == name and re.search(pattern, "\n".join(history), re.MULTILINE)
                                for name, history, _ in every), pattern)
        for place in {*declared.BEFORE, *declared.PRINTED}:
            blocks = pages.blocks((SOURCE / "docs" / place).read_text(encoding="utf-8"))
            for line in declared.PRINTED.get(place, []):
                self.assertIn(line, [block[0] for block in blocks])
            self.assertTrue(any(place == name for name, _, _ in every), place)

    def test_are_found(self):
        text = ("# A\n\n    $ rastercheck list\n    laws: 3\n\n    a b\n    c\n\nAnd\n\n"
                "    X=1 cmake a \\\n      b  # c\n    ./scripts/run\n\n    laws: 3\n\n- a\n    rastercheck no\n\n"
                "```sh\nctest\n```\n```cpp\ngit\n```\n")
        found = pages.commands(text)
        self.assertEqual([c.text for c in found], ["rastercheck list", "X=1 cmake a b", "./scripts/run", "ctest"])
        self.assertEqual([c.shown for c in found], [["laws: 3", "", "a b", "c"], [], ["", "laws: 3"], []])
        self.assertEqual(pages.blocks(text)[0][-1], "c")

    def test_faults_are_seen(self):
        for shown, printed, missing in [
                (["a", "c"], "a\nb\nc\n", []),
                (["c", "a"], "a\nb\nc\n", ["a"]),
                (["a … c 1.5 s"], "a b c 20.25 s", []),
                (["a … c 1.5 s"], "a b c 20.25", ["a … c 1.5 s"]),
                (["… and more"], "", ["… and more"]),
                (["…", ""], "", []),
                (["1.5 (b)"], "125 (b)", ["1.5 (b)"])]:
            self.assertEqual(pages.lines_not_printed(shown, printed), missing, (shown, printed))


if __name__ == "__main__":
    SOURCE, RASTERCHECK = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    unittest.main(argv=sys.argv[:1])
