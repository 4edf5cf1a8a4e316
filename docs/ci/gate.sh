#!/bin/sh
# The regression gate on one machine, without any CI product: from a hook, a timer, or by hand, in the top folder of
# the repository. For a rasterizer of your own as a plugin; `rastercheck` is on PATH.
#
#   ./gate.sh save    takes the baseline, rastercheck-baseline.json: to be looked at, and committed
#   ./gate.sh         builds, checks, compares
#
# Exit code 0: all properties hold, and nothing is less precise than in the baseline. 3: something is;
# rastercheck-out/compare.html has what, where, and by how much. 1: a property is violated; rastercheck-out/report.html.
set -eu

source=.  # the folder of the plugin's CMakeLists.txt
backend=plugin:./build/plugin.so
baseline=rastercheck-baseline.json
output=rastercheck-out

cmake -S "$source" -B build
cmake --build build

case ${1:-} in
  save)
    # The seed and the number of cases are kept in the baseline: this is the one place to choose them.
    rastercheck run --backend "$backend" --seed 1 --cases "${CASES:-100}" --keep-cases --jobs "$(nproc)" \
      --output "$output"
    rastercheck baseline save "$output" --output "$baseline"
    ;;
  "")
    rastercheck run --backend "$backend" --baseline "$baseline" --jobs "$(nproc)" --output "$output"
    ;;
  *)
    echo "usage: $0 [save]" >&2
    exit 2
    ;;
esac
