#!/bin/bash
# The walls of @NAME@ in @OF@ shards on a Slurm cluster.
#
#     bash shards.sh        on a login node: submits the shards that are missing, and a job that merges them
#
# The same command again submits what is missing then. `pirca` must be on the PATH of the nodes.
# What your cluster asks for goes here; a line counts once a single # begins it.
##SBATCH --account=NAME
##SBATCH --partition=NAME
##SBATCH --mem-per-cpu=1G
#SBATCH --cpus-per-task=@THREADS@
set -euo pipefail

out=@OUT@
name=pirca-@NAME@-$(cksum <<<"$out" | cut -d ' ' -f 1)
minutes=@MINUTES@ # limit of a shard; one that is cut off goes on where it was
merge_minutes=60  # limit of the merge
at_once=500       # shards of an array that run at the same time
tries=3           # submissions without one more complete shard before the merge gives up

# Numbers of the shards that are missing, as "0,3-5".
missing() {
    if [ ! -e "$out/shards/work.json" ]; then
        echo "0-@LAST@"
    else
        pirca shards status "$out" --json | sed -n 's/.*"missing": *"\([^"]*\)".*/\1/p'
    fi
}

# How many numbers such a list has.
count() {
    local part sum=0
    for part in ${1//,/ }; do sum=$((sum + ${part#*-} - ${part%-*} + 1)); done
    echo "$sum"
}

# Submits this file itself.
submit() {
    sbatch --parsable --requeue --open-mode=append "$@"
}

# Submits the shards of a list, and the merge behind them. The first argument counts the submissions in vain.
submit_all() {
    local try=$1 list=$2 part from to last block arrays=() jobs="" job
    mkdir -p "$out/shards/log"
    local log=${out//%/%%}/shards/log # % begins a name of Slurm's own
    # Numbers in an array end below MaxArraySize: beyond it, shards are numbered from the start of their block.
    local size
    size=$(scontrol show config | sed -n 's/^MaxArraySize *= *//p')
    size=$((size < 1000 ? size : 1000))
    for part in ${list//,/ }; do
        from=${part%-*} to=${part#*-}
        while [ "$from" -le "$to" ]; do
            block=$((from / size))
            last=$(((block + 1) * size - 1))
            last=$((last < to ? last : to))
            arrays[block]=${arrays[block]:+${arrays[block]},}$((from % size))-$((last % size))
            from=$((last + 1))
        done
    done
    for block in "${!arrays[@]}"; do
        # A cluster that takes no more jobs of one user gets the rest from the merge.
        job=$(submit --job-name="$name" --time="$minutes" --array="${arrays[block]}%$at_once" \
            --output="$log/%A_%a.txt" "$0" shard $((block * size))) || break
        jobs+=:${job%%;*}
    done
    if [ -n "$list" ] && [ -z "$jobs" ]; then exit 1; fi
    if [ -n "$jobs" ]; then echo "shards $list: submitted as ${jobs#:}, logs in $out/shards/log"; fi
    # After any end, as afterok waits forever once a shard has failed.
    job=$(submit --job-name="$name-merge" --time="$merge_minutes" ${jobs:+--dependency=afterany$jobs} \
        --output="$log/merge-%j.txt" "$0" merge "$try" "$(count "$list")")
    echo "merge: submitted as ${job%%;*}"
}

case ${1:-} in
shard)
    # Slurm numbers the elements of an array, $2 is where their block begins.
    @SHARD@ --index $(($2 + SLURM_ARRAY_TASK_ID))
    ;;
merge)
    list=$(missing)
    left=$(count "$list")
    # A shard whose node is lost Slurm starts again; one that was killed, or cut off by its time limit, it does not.
    try=$((left < $3 ? 1 : $2 + 1))
    if [ "$left" -gt 0 ] && [ "$try" -le "$tries" ]; then
        submit_all "$try" "$list"
    else
        pirca shards merge "$out"
    fi
    ;;
"")
    if squeue --noheader --user="$(id -un)" --name="$name" --states=PENDING,RUNNING,SUSPENDED | grep . >&2; then
        echo "these shards are still to come, and the merge then submits what is missing; or first: scancel --name=$name" >&2
        exit 1
    fi
    list=$(missing)
    submit_all 1 "$list"
    ;;
esac
