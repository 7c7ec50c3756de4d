#!/bin/bash
# The walls of @NAME@ in @OF@ shards by GNU parallel, and their merge.
#
#     bash shards.sh                                 on the processors of this machine
#     bash shards.sh --sshloginfile HOSTS --bar      on machines that see the same folders; any options of parallel
#
# The same command again computes what is missing then.
set -euo pipefail

out=@OUT@

# Numbers of the shards that are missing, one a line.
missing() {
    local part list=0-@LAST@
    if [ -e "$out/shards/work.json" ]; then
        list=$(pirca shards status "$out" --json | sed -n 's/.*"missing": *"\([^"]*\)".*/\1/p')
    fi
    for part in ${list//,/ }; do seq "${part%-*}" "${part#*-}"; done
}

mkdir -p "$out/shards/log"
# What is left to do the folder knows. parallel's own --resume goes by the place in the list, which is another list every time.
missing | parallel --quote --retries 3 --joblog "$out/shards/log/parallel.txt" "$@" \
    @SHARD@ --quiet --index {} ||
    echo "some shards failed: $out/shards/log/parallel.txt says which" >&2
pirca shards merge "$out"
