#!/usr/bin/env bash
# A study as an array of HyperQueue, inside whatever allocation its workers have: hyperqueue.sh PROGRAM DIR SHARDS
set -euo pipefail
program=$1 out=$2 shards=$3
# Tasks whose worker is lost are started again by themselves.
hq submit --wait --array "1-$shards" --cpus 4 -- \
    bash -c '"$0" run --shard "$HQ_TASK_ID/$1" --threads 4 --out "$2"' "$program" "$shards" "$out"
"$program" merge "$out"
