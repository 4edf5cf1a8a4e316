#!/usr/bin/env bash
# The browser tests of report.html, compare.html and the page of a judged picture:
#
#   run_tests.sh NODE_FOLDER RASTERCHECK RUN_JSON
#
# Tests the report of RUN_JSON, and those that RASTERCHECK makes of a short run, of a comparison and
# of a judged picture. NODE_FOLDER receives the packages that npm installs, and the reports. Without
# node, npm or Chromium, skips with exit code 77, or fails if RASTERCHECK_REQUIRE_BACKENDS says that
# everything must be present.
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
folder=$1 rastercheck=$2 run_json=$3
first_triangle=$tests/../../cases/corpus/first-triangle.json

missing() {
  echo "browser tests: $1"
  [ "${RASTERCHECK_REQUIRE_BACKENDS:-}" = all ] && exit 1
  exit 77
}
for program in node npm; do
  command -v "$program" >/dev/null || missing "$program is not installed"
done
[ "$(node --print 'parseInt(process.versions.node) >= 18')" = true ] || missing "node is older than 18"
chromium=${RASTERCHECK_CHROMIUM:-$(command -v chromium || true)}
[ -n "$chromium" ] || missing "chromium is not installed"

# Copies the tests: Node looks for packages beside the files that import them.
mkdir -p "$folder"
rm -f "$folder"/*.js
cp "$tests"/*.js "$tests"/package.json "$tests"/package-lock.json "$folder"
if ! cmp -s "$tests/package-lock.json" "$folder/node_modules/installed-lock.json"; then
  (cd "$folder" && npm ci --prefer-offline --no-audit --no-fund --ignore-scripts --loglevel=error) ||
    missing "npm cannot install playwright-core"
  cp "$tests/package-lock.json" "$folder/node_modules/installed-lock.json"
fi

mkdir -p "$folder/sample"
cp "$run_json" "$folder/sample/run.json"
"$rastercheck" report "$folder/sample" --quiet
# This test does not care whether the laws hold.
"$rastercheck" run --backend method:screen-linear --cases 30 --seed 1 --shrink-tries 20 \
  --output "$folder/run" --quiet || [ $? -eq 1 ]
# Makes a regression: values in float32 instead of double.
for backend in cpu cpu:precision=float32; do
  "$rastercheck" run --backend "$backend" --property "values-stay*" --cases 30 --seed 1 \
    --keep-cases --output "$folder/${backend//[:=]/-}" --quiet
done
"$rastercheck" compare "$folder/cpu" "$folder/cpu-precision-float32" --as cpu \
  --output "$folder/compare" --quiet || [ $? -eq 3 ]
# Makes a picture that is wrong in its values: drawn affinely, judged by what the case asks for.
mkdir -p "$folder/judged"
"$rastercheck" render "$first_triangle" --backend method:screen-linear --channels Y=u \
  --picture "$folder/judged/drawn.npy"
"$rastercheck" judge "$first_triangle" "$folder/judged/drawn.npy" --channels Y=u \
  --html "$folder/judged/judged.html" --quiet || [ $? -eq 1 ]

cd "$folder"
RASTERCHECK_CHROMIUM=$chromium RASTERCHECK_REPORT=$folder/sample/report.html \
  RASTERCHECK_RUN_REPORT=$folder/run/report.html \
  RASTERCHECK_COMPARE=$folder/compare/compare.html \
  RASTERCHECK_JUDGED=$folder/judged/judged.html node --test --test-reporter=spec ./*.test.js
