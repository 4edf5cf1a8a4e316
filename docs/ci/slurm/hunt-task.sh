#!/bin/sh
#SBATCH --job-name=rastercheck-hunt
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --mem=2G
#SBATCH --requeue
#SBATCH --open-mode=append
# One hunt, as a task of the array that hunt.sh submits:
#
#   hunt-task.sh FOLDER ROUND TASKS SEED OPTION...    FOLDER/round-ROUND/hunt-I gets the results of hunt I
#
# SEED is that of the round's first hunt; hunt I has SEED + I - 1. May be killed and started again at any moment: a hunt
# has no checkpoint, begins anew, and finds the same. It is finished if its folder exists; until then it works in one of
# another name. Exit code 0 if the hunt is finished, even if a property is violated; otherwise that of rastercheck.
set -eu
folder=$1 round=$2 tasks=$3 seed=$4
shift 4
hunt=$SLURM_ARRAY_TASK_ID
finished=$folder/round-$round/hunt-$hunt
work=$folder/unfinished/$round-$hunt

if [ -d "$finished" ]; then exit 0; fi

# The hunts to start from: those of the round before that found something.
if [ "$round" -gt 1 ]; then
  for task in $(seq "$tasks"); do
    before=$folder/round-$((round - 1))/hunt-$task
    if [ -n "$(find "$before" -path '*/worst/*.json')" ]; then set -- "$@" --start "$before"; fi
  done
fi

mkdir -p "$folder/round-$round" "$folder/unfinished"
here=$work.$SLURM_JOB_ID.${SLURM_RESTART_COUNT:-0}
mkdir -p "$here"
echo "$(date '+%Y-%m-%d %H:%M:%S') hunt $hunt of round $round starts on ${SLURMD_NODENAME:-a node}"

# A hunt that is ended early, by SIGTERM, writes what it found until then. That is not the whole.
was_ended=
trap 'was_ended=yes' TERM
code=0
rastercheck hunt "$@" --seed $((seed + hunt - 1)) --jobs "${SLURM_CPUS_PER_TASK:-1}" --quiet --output "$here" || code=$?
if [ -n "$was_ended" ]; then exit 130; fi

# 1: a property is violated. 5: no error was measured. Both are results.
case $code in
  0 | 1 | 5)
    [ -d "$finished" ] || mv "$here" "$finished"
    echo "$here is now $finished"
    rm -rf "$work".*
    exit 0
    ;;
esac
exit "$code"
