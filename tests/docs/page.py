"""Reads a page of Markdown: commands with the output shown for them, words in backticks, links."""

import re

# Patterns of the programs with which a block of commands may begin, after environment settings and
# `./`. A block that begins with another word does not count as commands.
PROGRAMS = ("rastercheck", "rastercheck-bench", r"build/[\w/-]+", r"scripts/[\w-]+",
            "apt", "apt-get", "bash", "cat", "cc", "cd", "clang-format", "cmake", "cp", "cpack", "ctest", "curl",
            "docker", "dpkg", "export", r"g\+\+", "gcc", "git", "make", "mkdir", "mv", "npm", "python3", "rm", "sed",
            "sh", "sudo", "tar", "wget", "xargs")
COMMAND = re.compile(r"\$ |[A-Z]+=\S+$|([A-Z_]+=(\"[^\"]*\"|\S+) )*(\./)?(" + "|".join(PROGRAMS) + r")( |$)")
FENCE = re.compile(r" *```(\w*)")
# The languages of fenced blocks that hold commands; blocks in other languages are code.
SHELLS = ("", "bash", "console", "sh", "shell")


class Command:
    def __init__(self, text):
        self.text = re.sub(r" +#.*", "", text)
        self.shown = []  # lines of output

    def __repr__(self):
        return self.text


def blocks(text):
    """The blocks of code of a page, each as a list of lines without the block's indentation."""
    lines, found, i, was_blank = text.splitlines(), [], 0, True
    while i < len(lines):
        fence = FENCE.match(lines[i])
        if fence:
            end = next(j for j in range(i + 1, len(lines)) if lines[j].strip() == "```")
            if fence[1] in SHELLS:
                found.append(lines[i + 1:end])
            i = end + 1
        elif was_blank and lines[i].startswith("    ") and lines[i].strip():
            begin = i
            while i < len(lines) and (lines[i].startswith("    ") or not lines[i].strip()):
                i += 1
            block = "\n".join(lines[begin:i]).rstrip().split("\n")
            indent = len(block[0]) - len(block[0].lstrip())
            found.append([line[indent:] for line in block])
        else:
            was_blank = not lines[i].strip()
            i += 1
    return found


def commands_of(block):
    """The commands of a block: the lines that begin with `$`, or else all lines up to a blank one,
    after which output follows. Empty if the block holds no commands."""
    if not block or not COMMAND.match(block[0]):
        return []
    found, has_prompt, are_over = [], block[0].startswith("$ "), False
    for line in re.sub(r"\\\n\s*", "", "\n".join(block)).split("\n"):
        are_over |= not line
        if has_prompt and line.startswith("$ "):
            found.append(Command(line[2:]))
        elif has_prompt or are_over:
            found[-1].shown.append(line)
        else:
            found.append(Command(line))
    return found


def commands(text):
    return [command for block in blocks(text) for command in commands_of(block)]


def prose(text):
    """A page without its blocks of code."""
    text = re.sub(r"^ *```.*?^ *```$", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"(?<=\n\n)(    .*\n|\n)+", "", text)


def code_spans(text):
    """The texts in backticks, each joined into one line."""
    return [" ".join(span.split()) for span in re.findall(r"(?<!`)`([^`]+)`(?!`)", prose(text))]


def links(text):
    """The targets, within this tree, of a page's links and pictures."""
    targets = re.findall(r"\]\(([^()\s]+)\)", re.sub(r"`[^`]*`", "", prose(text)))
    return [target for target in targets if not re.match(r"[a-z]+:", target)]


def anchors(text):
    """The anchors of a page's headings, as GitHub makes them."""
    found = {}
    for heading in re.findall(r"^#+ (.*)$", prose(text), re.MULTILINE):
        words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        found[anchor] = found.get(anchor, -1) + 1
        if found[anchor]:
            found[f"{anchor}-{found[anchor]}"] = 0
    return set(found)


def line_pattern(line):
    """A shown line as a pattern: … matches anything, and a time matches any other time."""
    parts = [re.escape(part.strip()) for part in line.split("…")]
    pattern = r"\s*" + ".*".join(parts) + r"\s*"
    return re.sub(r"\d+(\\\.\d+)?\\ (m?s)\b", r"[\\d.]+ \2", pattern)


def lines_not_printed(shown, printed):
    """The lines shown below a command that are not printed, or not in that order."""
    rest, missing = iter(printed.splitlines()), []
    for line in shown:
        if line.strip(" …"):
            pattern = re.compile(line_pattern(line))
            if not any(pattern.fullmatch(candidate) for candidate in rest):
                missing.append(line)
                rest = iter(())
    return missing
