#!/bin/sh
#SBATCH --job-name=rastercheck-hunts
#SBATCH --ntasks=1
#SBATCH --time=01:00:00
#SBATCH --mem=2G
#SBATCH --requeue
#SBATCH --open-mode=append
# A hunt on a Slurm cluster: many at a time, in rounds. All hunts of a round start from the worst cases that all hunts
# of the round before found. Copy hunt.sh and hunt-task.sh to a folder that all nodes share, fill in the settings below
# (and the limits of time and memory at the top of both files), and type in that folder
#
#   ./hunt.sh
#
# This submits the first round as an array, and this script once more as a job that follows the array. That job submits
# what is not finished of the round, at most $tries times in all, and then the next round. After the last round it
# checks the worst cases of that round once more, together: the outcome is its table in $folder/logs/hunt.log, the cases
# in $folder/all/worst, and counterexamples in the folders of single hunts, which it lists. The same settings give the
# same outcome, whatever failed on the way.
#
# After the last try, or if jobs may not submit jobs, type ./hunt.sh again.
#
# The last job ends with the exit code of `rastercheck hunt`: 1 means that a property is violated; 2, that hunts are
# missing.
set -eu
followed=${1:-1} try=${2:-1}  # the round that this job follows, and the number of its next try

folder=hunts  # for the results; other settings need a new one
rounds=4
tasks=16      # hunts in each round
steps=100000  # of each hunt
seed=1        # of the first hunt of the first round; the others count up from there
tries=3
# More options of `rastercheck hunt`.
set -- --backend plugin:./plugin.so

mkdir -p "$folder/logs"

# Two tasks for one hunt would be a waste. The job that follows an array no longer finds it in the queue.
if [ -e "$folder/array" ]; then
  array=$(cat "$folder/array")
  if [ -n "$(squeue --noheader --jobs "$array" 2>/dev/null)" ]; then
    echo "$0: array $array of $folder has not ended; try again when it has, or end it with scancel $array" >&2
    exit 2
  fi
fi

# The first round that is not finished, and what is not finished of it.
unfinished=
for round in $(seq "$rounds"); do
  for task in $(seq "$tasks"); do
    [ -d "$folder/round-$round/hunt-$task" ] || unfinished=$unfinished${unfinished:+,}$task
  done
  [ -z "$unfinished" ] || break
done

if [ -z "$unfinished" ]; then
  # Checks each of these cases, and none besides: as many steps as cases.
  cases=0
  for task in $(seq "$tasks"); do
    hunt=$folder/round-$rounds/hunt-$task
    found=$(find "$hunt" -path '*/worst/*.json' | wc -l)
    [ "$found" -eq 0 ] || set -- "$@" --start "$hunt"
    cases=$((cases + found))
  done
  code=0
  [ "$cases" -eq 0 ] || rastercheck hunt "$@" --steps "$cases" --seed "$seed" --output "$folder/all" || code=$?
  violated=$(find "$folder"/round-* -path '*/counterexamples/*.json')
  [ -n "$violated" ] || exit "$code"
  printf 'Counterexamples of single hunts:\n%s\n' "$violated"
  exit 1
fi
if [ "$round" -ne "$followed" ]; then try=1; fi
if [ "$try" -gt "$tries" ]; then
  echo "$0: after $tries tries, these hunts of round $round are not finished: $unfinished; $folder/logs says why" >&2
  exit 2
fi

# A seed of its own for each hunt.
array=$(sbatch --parsable --array="$unfinished" --output="$folder/logs/round-$round-hunt-%a.log" \
  hunt-task.sh "$folder" "$round" "$tasks" $((seed + (round - 1) * tasks)) --steps "$steps" "$@")
array=${array%;*}  # without the cluster's name, which some clusters add
echo "$array" >"$folder/array"
sbatch --dependency="afterany:$array" --output="$folder/logs/hunt.log" hunt.sh "$round" $((try + 1))
