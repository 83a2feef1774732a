#!/usr/bin/env bash
# Bakes a list with GNU parallel, on the cores of one machine:
#   bake_parallel.sh WORKERS LIST --verb VERB --cache DIR [-- OPTION...]
# The exit status is that of `abut bake` for the whole list. ABUT names the tool; default: the one on the PATH.
set -euo pipefail

workers=${1:?"the number of workers, then the arguments of abut bake"}
shift
abut=${ABUT:-abut}

# A worker that finds something, or dies, stops no other. The run below has the last word.
seq "$workers" | parallel --jobs "$workers" --quote "$abut" bake --shard "{}/$workers" --quiet "$@" || true
exec "$abut" bake "$@"
