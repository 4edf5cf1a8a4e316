#!/usr/bin/env bash
# Judges a driver by every law, within the contract of its API and apart from known defects; exits
# with the campaign's code. If the driver cannot run here, exits with 77, or fails if
# RASTERCHECK_REQUIRE_BACKENDS (tests/backends/drivers.h) names it.
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
