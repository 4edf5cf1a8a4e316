#!/usr/bin/env python3
"""Runs the commands of a page of docs/ as a reader would: one after the other, in one shell, in a
copy of the tree.

Usage: commands_test.py SOURCE_DIR BUILD_DIR CC CXX PAGE

declared.py lists the commands that cannot be run as they stand. Every command must end with the
expected exit code and, unless declared.py replaces it by another one, print the lines that the page
shows below it, in that order.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # no traces in the source tree
import declared  # noqa: E402
import page as pages  # noqa: E402


def is_run(command):
    return not any(re.search(pattern, command) for pattern in declared.NOT_RUN)


def as_run(command):
    for pattern, instead, _ in declared.INSTEAD:
        command = re.sub(pattern, instead, command)
    return command


def codes_of(page, history):
    """The exit codes with which the last of these commands of a page may end."""
    codes = [codes for name, pattern, codes, _ in declared.ENDS_WITH
             if name == page and re.search(pattern, "\n".join(history), re.MULTILINE)]
    return codes[0] if codes else (0,)


def planned(page, text):
    """The commands to run for a page: (command as run, permitted exit codes, lines that it must
    print)."""
    plan, history, was_run = [], [], False
    for block in pages.blocks(text):
        commands = pages.commands_of(block)
        for command in commands:
            history.append(command.text)
            was_run = is_run(command.text)
            if was_run:
                ours = as_run(command.text)
                shown = command.shown if ours == command.text else []
                plan.append((ours, codes_of(page, history), shown))
        if not commands and was_run and block[0] in declared.PRINTED.get(page, ()):
            plan[-1][2].extend(block)
    return plan


def tree(source, build, folder):
    """Makes a copy of the source tree in which build/release is the build."""
    ours = {"build", ".git", "rastercheck-out"}
    if build.is_relative_to(source):
        ours.add(build.relative_to(source).parts[0])

    def leave_out(directory, names):
        return ours & set(names) if pathlib.Path(directory) == source else ()
    shutil.copytree(source, folder, ignore=leave_out, symlinks=True)
    (folder / "build").mkdir()
    (folder / "build/release").symlink_to(build)


def environment(folder, cc, cxx):
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("GITHUB_", "RASTERCHECK_"))}
    return kept | {"CC": cc, "CXX": cxx, "HOME": str(folder / "home"),
                   "PATH": f"{folder}/build/release/bin:{kept['PATH']}"}


def script(before, plan, logs):
    """A shell script that runs all commands and writes their output and exit codes to a folder."""
    lines = [f"{{ {before or ':'}\n}} >{logs}/before 2>&1 || exit"]
    for number, (command, _, _) in enumerate(plan):
        lines.append(f"{{ {command}\n}} >{logs}/{number}.out 2>&1\necho $? >{logs}/{number}.code")
    return "\n".join(lines)


def faults(plan, logs):
    """Sentences that say what went differently from the plan."""
    found = []
    for number, (command, codes, shown) in enumerate(plan):
        if not (logs / f"{number}.code").exists():
            return [*found, f"{command}\n  was not reached; {(logs / 'before').read_text(errors='replace')}"]
        code = int((logs / f"{number}.code").read_text())
        printed = (logs / f"{number}.out").read_text(errors="replace")
        missing = pages.lines_not_printed(shown, printed)
        if code not in codes:
            found.append(f"{command}\n  exit code {code}, not {codes}:\n{printed}")
        elif missing:
            found.append(f"{command}\n  does not print, as the page shows, “{missing[0]}” but\n{printed}")
    return found


def run_page(source, build, cc, cxx, page):
    """Runs a page's commands and returns their faults."""
    plan = planned(page.name, page.read_text(encoding="utf-8"))
    if not plan:
        return []
    with tempfile.TemporaryDirectory(prefix="docs-", dir=build) as name:
        folder, logs = pathlib.Path(name) / "tree", pathlib.Path(name) / "logs"
        logs.mkdir()
        tree(source, build, folder)
        subprocess.run(["bash", "-c", script(declared.BEFORE.get(page.name), plan, logs)], cwd=folder,
                       env=environment(folder, cc, cxx), stdin=subprocess.DEVNULL, check=False)
        return faults(plan, logs)


if __name__ == "__main__":
    problems = run_page(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), *sys.argv[3:5],
                        pathlib.Path(sys.argv[5]))
    print("\n".join(problems))
    sys.exit(1 if problems else 0)
