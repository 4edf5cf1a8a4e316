"""Commands of the pages that cannot be run as they stand: what is done instead, and why.

Keys are patterns of commands. Each must match a command of some page (docs.text)."""

# Commands that are not run at all.
NOT_RUN = {
    r"^\./scripts/(run|test)$": "installs packages, builds everything",
    r"^(apt|apt-get|curl|docker|dpkg|git clone|npm|sudo|wget)\b": "needs root or a network",
    r"^cmake (--preset |--build --preset |--build build/release\b)": "builds this project, which takes minutes",
    r"\bclang-format -i$": "a program for developers, which rewrites sources",
    r"build/(rasterizer|examples)\b": "test consumer.installed builds and runs that",
    r"\bcpack -G DEB\b": "writes to the build; test packaging.contents looks at what it makes",
    r"^scripts/(kill-matrix|fuzz)\b": "builds all mutants, or runs for hours",
    r"^rastercheck known (add|expect)\b": "writes lists; tests of cli add to them, and read them",
    r"--known softpipe-fails\.txt": "the list is the reader's own",
    r"\bscene\.json$": "takes six minutes",
    r"--corpus large\b": "judges 110 million fragments",
    r"^scripts/image-defects\b": "takes minutes, and needs ImageMagick",
    r"^(python3 -m venv|environment/bin/pip) ": "test python.package installs with pip, without a network",
    r"\brdc2case\.py\b|\bevent-29\.json\b": "needs a capture; tests captures.* make and convert some",
    r"^valgrind ": "stops at an instruction that libhwy uses (RDTSCP) where the processor is said to lack it",
    r"^scripts/bench-table ": "wants what minutes of rastercheck-bench have written",
}

# Commands that are changed before they are run: a pattern, its replacement, the reason.
INSTEAD = [
    (r"\bCASE\b", "cases/corpus/behind-the-eye.json", "the reader's own case"),
    (r"\bX,Y\b", "4,4", "a pixel of it"),
    (r"--backend (BACKEND|B)\b", "--backend cpu", "any backend"),
    (r"\bmethod:NAME\b", "method:screen-linear", "any method"),
    (r"--seed S$", "--seed 1", "any seed"),
    (r"^build/asan-ubsan/bin/fuzz_case FILE", "build/release/bin/fuzz_case cases/corpus/behind-the-eye.json",
     "that build is not this one"),
    (r"^((?:build/release/bin/)?rastercheck run (?!.*--(?:cases|baseline|resume)).*)", r"\1 --cases 1000",
     "the default, for the next line"),
    (r"^((?:build/release/bin/)?rastercheck run .*--cases) \d+", r"\1 5", "takes minutes; the corpus is run as well"),
    (r"^(rastercheck hunt .*--steps) \d+", r"\1 64", "takes minutes"),
    (r"(--shard \d)/1000\b", r"\1/10", "copies of a thousand shards take minutes"),
    (r"^(rastercheck cases --out .*)", r"mkdir none && \1 --corpus none", "with the corpus 60 MB"),
    (r"^(rastercheck run --backend 'exec:.*)", r"\1 --property values-stay-within-the-bound",
     "a rasterizer in Python takes minutes for all properties"),
    (r"^cc ", "$CC ", "the compiler of this build"),
    (r"^(rastercheck bisect )", r"\1--cases 5 ", "takes minutes"),
    (r"(second_opinion_test.py .*--cases) 5000", r"\1 20", "takes minutes"),
    (r"(rastercheck-sensitivity) 25$", r"\1 1", "takes minutes"),
    (r"(max_success)=3000", r"\1=30", "takes a minute"),
    (r"^(rastercheck run .*)--shard 2/7 --output shard-2$",
     r"for i in 1 2 3 4 5 6 7; do \1--shard $i/7 --output shard-$i || break; done", "all the jobs"),
    (r"^UPDATE_APPROVED=1 (.*)", r"\1 --gtest_list_tests | grep '^ '", "writes to the sources; there are such tests"),
    (r"^ctest --preset (?:[\w-]+) (.*)", r"ctest -N --preset release \1 | grep 'Total Tests: [1-9]'",
     "runs tests; there are such tests"),
    (r"^(.*\brastercheck-bench .*)", r"\1 --benchmark_list_tests | grep /", "takes minutes; there are such lines"),
]

# Commands with exit codes other than 0: page, pattern of the page's commands up to this one, codes,
# reason.
ENDS_WITH = [
    ("findings.md", r"^rastercheck replay .*\Z", (0, 4), "4 where the machine has no such driver"),
    ("from-formula-to-property.md", r"rastercheck_with_mutants .*\Z", (1,), "mutants"),
    ("image-tests.md", r"^rastercheck deqp .*\Z", (1,), "two verdicts of the log are wrong"),
    ("judge-a-driver.md", r"^\./bug llvmpipe\Z", (1,), "a driver's defect"),
    ("judge-a-driver.md", r"^rastercheck (run|replay) .*(--no-known|quarter\.json).*\Z", (1,), "a driver's defects"),
    ("many-machines.md", r"^/usr/bin/time .* rastercheck merge .*\Z", (5,), "five cases for each property are few"),
    ("python.md", r"^python3 -m pytest .*-k random\Z", (1,), "the rasterizer made wrong"),
    ("judge-your-rasterizer.md", r"^sed .*\n.*\nrastercheck run .*\Z", (1,), "the division is gone"),
    ("regression-gate.md", r'"A reciprocal in float32"\nrastercheck run .*\Z', (3,), "made less precise"),
    ("using-in-googletest.md", r"^ctest .*\Z", (8,), "the page's other suite, a careless rasterizer's, is in it"),
    ("when-it-fails.md", r"mutant:right-end-included.*\Z", (1,), "a mutant"),
]

LITTLE = """mkdir -p include/rastercheck && cp backends/plugin/plugin.h include/rastercheck &&
    $CC -O1 -shared -fPIC -Iinclude docs/examples/plugin/little.c -o little.so -lm"""
# Shell commands that make the files that a page assumes.
BEFORE = {
    "accuracy.md": LITTLE,
    "drawn-elsewhere.md": LITTLE,
    "image-tests.md": """rastercheck import /usr/share/glmark2/models/bunny.obj --width 64 --height 64 --output scene.json &&
        rastercheck render scene.json --channels R=x,G=y,B=0 --storage unorm8 --picture scene.png &&
        sed -n '/^    import array/,/^    sys.exit/s/^    //p' docs/image-tests.md >within.py""",
    "judge-a-driver.md": """cat >quarter.json <<END
{"format": "rastercheck-contract", "version": 1, "bounds": {"smooth": {"constant": 0.25}}}
END""",
    "probing.md": LITTLE,
    # Debian's Python, for which scripts/setup installs pytest, Hypothesis and NumPy.
    "python.md": "PATH=$PWD/build/release/bin:/usr/bin:$PATH && unset RASTERCHECK PYTHONPATH",
    "using-in-googletest.md": """mkdir own && cp tests/consumer/testing/* own && mkdir own/build &&
        ln -s ../../build/release own/build/release && cd own""",
    "regression-gate.md": """rastercheck plugin new own && cd own && cmake -S . -B build && cmake --build build &&
        mkdir .ci && cp ../.ci/baseline.json .ci && ln -s ../../build/release build/release &&
        git init -q . && git config user.name Somebody && git config user.email somebody@example.com &&
        git add CMakeLists.txt plugin.c rastercheck && git commit -q -m good""",
}

# Separate blocks that show the output of the command before them, given by their first lines.
PRINTED = {
    "judge-your-rasterizer.md": ["… counterexamples, 1 cause:"],
    "when-it-fails.md": ["a-shared-edge-covers-each-sample-once"],
}
