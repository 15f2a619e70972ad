#!/usr/bin/env bash
# A study on the cores of one machine, or of several (`--sshlogin`), by GNU parallel:
# parallel.sh PROGRAM DIR SHARDS
set -euo pipefail
program=$1 out=$2 shards=$3
# A worker that is killed is started again, and goes on where it was.
parallel --jobs "${JOBS:-100%}" --retries 3 "$program" run --shard "{}/$shards" --threads 1 --out "$out" \
    ::: $(seq "$shards")
"$program" merge "$out"
