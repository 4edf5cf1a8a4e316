#!/bin/sh
#SBATCH --job-name=rastercheck-campaign
#SBATCH --ntasks=1
#SBATCH --time=00:30:00
#SBATCH --mem=2G
#SBATCH --requeue
#SBATCH --open-mode=append
# A campaign on a Slurm cluster, in shards. Copy campaign.sh and shard.sh to a folder that all nodes share, fill in the
# settings below (and the limits of time and memory at the top of both files), and type in that folder
#
#   ./campaign.sh
#
# This submits an array with a task for each shard that is not finished, and this script once more as a job that follows
# the array. That job looks again: if all shards are finished, it merges them into $folder/merged; if not, it submits
# the rest, at most $tries times in all.
#
# Slurm itself starts a task again if its node failed or if it was preempted, but not if it was killed or ran out of
# time or memory. The job that follows the array does. In either case the shard continues from its checkpoint and loses
# about a second of work. After the last try, or if jobs may not submit jobs, type ./campaign.sh again.
#
# The last job ends with the exit code of `rastercheck merge`: 1 means that a property is violated; 2, that shards are
# missing.
set -eu
try=${1:-1}

folder=campaign  # for the results; every campaign needs a new one
shards=64        # at most 1000 on clusters with Slurm's default MaxArraySize
tries=3
# The options of `rastercheck run`. Shards need a seed.
set -- --backend plugin:./plugin.so --seed 1 --cases 100000

mkdir -p "$folder/logs"

# Two tasks for one shard would be a waste. The job that follows an array no longer finds it in the queue.
if [ -e "$folder/array" ]; then
  array=$(cat "$folder/array")
  if [ -n "$(squeue --noheader --jobs "$array" 2>/dev/null)" ]; then
    echo "$0: array $array of $folder has not ended; try again when it has, or end it with scancel $array" >&2
    exit 2
  fi
fi

unfinished=
for shard in $(seq "$shards"); do
  [ -d "$folder/shard-$shard" ] || unfinished=$unfinished${unfinished:+,}$shard
done

if [ -z "$unfinished" ]; then
  exec rastercheck merge "$folder"/shard-* --output "$folder/merged"
fi
if [ "$try" -gt "$tries" ]; then
  echo "$0: after $tries tries, these shards are not finished: $unfinished; $folder/logs says why" >&2
  exit 2
fi

array=$(sbatch --parsable --array="$unfinished" --output="$folder/logs/shard-%a.log" \
  shard.sh "$folder" "$shards" "$@")
array=${array%;*}  # without the cluster's name, which some clusters add
echo "$array" >"$folder/array"
sbatch --dependency="afterany:$array" --output="$folder/logs/campaign.log" campaign.sh $((try + 1))
