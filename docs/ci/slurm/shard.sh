#!/bin/sh
#SBATCH --job-name=rastercheck-shard
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --mem=2G
#SBATCH --requeue
#SBATCH --open-mode=append
# One shard of a campaign, as a task of the array that campaign.sh submits:
#
#   shard.sh FOLDER SHARDS OPTION...    FOLDER/shard-I gets the results of shard I of SHARDS
#
# May be killed and started again at any moment. A shard is finished if FOLDER/shard-I exists: until then it works in a
# folder of another name. If an earlier attempt left a checkpoint there, this one continues from it. Exit code 0 if the
# shard is finished, even if a property is violated, which is for the merge to tell; otherwise that of rastercheck.
set -eu
folder=$1 shards=$2
shift 2
shard=$SLURM_ARRAY_TASK_ID
finished=$folder/shard-$shard
work=$folder/unfinished/$shard

if [ -d "$finished" ]; then exit 0; fi

# Each attempt renames the folder of the one before. If that one is still running, on a node that only lost its network,
# it can then no longer write to this one's files.
mkdir -p "$folder/unfinished"
here=$work.$SLURM_JOB_ID.${SLURM_RESTART_COUNT:-0}
how=starts
for earlier in "$work".*; do
  # An empty checkpoint is what a node can leave that lost its power.
  if [ -s "$earlier/unfinished.json" ] && mv "$earlier" "$here"; then
    set -- --resume
    how=continues
    break
  fi
done
echo "$(date '+%Y-%m-%d %H:%M:%S') shard $shard/$shards $how on ${SLURMD_NODENAME:-a node}"

# Before Slurm kills a task, it sends SIGTERM to all of its processes. rastercheck then saves its checkpoint and ends;
# the shell has to wait for that.
trap : TERM
code=0
rastercheck run "$@" --shard "$shard/$shards" --jobs "${SLURM_CPUS_PER_TASK:-1}" --format json --quiet \
  --output "$here" || code=$?

# A run removes its checkpoint when all is checked and written.
if [ -s "$here/run.json" ] && [ ! -e "$here/unfinished.json" ]; then
  [ -d "$finished" ] || mv "$here" "$finished"
  rm -rf "$work".*
  exit 0
fi
exit "$code"
