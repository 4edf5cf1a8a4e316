#!/usr/bin/env bash
# A driver from a root draws the same as this system's, if the root is this system: a folder with a
# link to /usr. Also, a folder that is no root is refused.
#   root.sh PROGRAM BACKEND
set -euo pipefail
program=$1 backend=$2

output=$(mktemp -d)
trap 'rm -rf "$output"' EXIT
mkdir "$output/root" "$output/empty"
ln -s /usr "$output/root/usr"

case_file=$(dirname "$0")/../../cases/corpus/behind-the-eye.json
if ! "$program" render "$case_file" --backend "$backend" --json >"$output/ours" 2>"$output/why"; then
  case ",${RASTERCHECK_REQUIRE_BACKENDS:-}," in
    ,all, | *",$backend,"*) cat "$output/why"; exit 4 ;;
  esac
  exit 77
fi
"$program" render "$case_file" --backend "$backend@$output/root" --json >"$output/rooted"
grep -q "\"triangle\"" "$output/ours"
diff <(sed "s|@$output/root||" "$output/rooted") "$output/ours"

if "$program" render "$case_file" --backend "$backend@$output/empty" 2>"$output/why"; then
  echo "a folder without a system was taken for a root"
  exit 1
fi
grep -q "is no unpacked system: no usr/lib/\*/ld-linux" "$output/why"
