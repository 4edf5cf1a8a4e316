#!/usr/bin/env bash
# Every law on a driver, within the contract that its API makes, known defects aside: a campaign's
# exit code. Of a driver that cannot run here 77, or a failure where RASTERCHECK_REQUIRE_BACKENDS
# (tests/backends/drivers.h) names it.
#   campaign.sh PROGRAM BACKEND CASES
set -uo pipefail
program=$1 backend=$2 cases=$3

output=$(mktemp -d)
trap 'rm -rf "$output"' EXIT
"$program" run --backend "$backend" --cases "$cases" --seed 1 --jobs 2 --shrink-tries 200 \
  --output "$output"
code=$?
[ $code -eq 4 ] || exit $code

required=",${RASTERCHECK_REQUIRE_BACKENDS:-},"
case $required in
  ,all, | *",$backend,"*) exit 4 ;;
esac
exit 77
