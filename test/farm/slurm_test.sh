#!/usr/bin/env bash
# Two nodes of Slurm on the loopback bake meshes, one node dies in the middle, and the results are compared, byte by byte, with
# those of one process:
#   slurm_test.sh ABUT FOLDER [COUNT]
# Needs root, and Debian's slurm-wlm, munge and parallel; ends with 77 without. Nothing of it remains running.
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
abut=$(realpath "$1") folder=$2 count=${3:-2000}
for program in slurmctld slurmd sbatch munged parallel unshare; do
    command -v "$program" >/dev/null || { echo "skipped: there is no $program"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: this needs root"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
folder=$(realpath "$folder")
export ABUT=$abut SLURM_CONF=$folder/slurm.conf

# --- what is to be ended -------------------------------------------------------------------------------------------------

started=()
finish() {
    status=$?
    for pid in "${started[@]}"; do kill "$pid" 2>/dev/null || true; done
    sleep 1
    for pid in "${started[@]}"; do kill -9 "$pid" 2>/dev/null || true; done
    [ $status -eq 0 ] || { tail -n 5 "$folder"/*.log "$folder"/*.out 2>/dev/null | tail -n 60; echo "FAILED, see $folder"; }
}
trap finish EXIT
# Starts a daemon in the foreground, by itself in a process namespace: if its pid is killed, all that it started ends too, as
# if a machine lost its power.
daemon() {
    unshare --pid --fork --kill-child --mount-proc "$@" >>"$folder/daemons.log" 2>&1 &
    started+=($!)
}
until_true() {  # seconds, command
    local left=$1
    shift
    until "$@"; do
        left=$((left - 1))
        [ "$left" -gt 0 ] || { echo "timed out: $*"; exit 1; }
        sleep 1
    done
}

# --- one process ---------------------------------------------------------------------------------------------------------

python3 "$here/make_meshes.py" "$count" "$folder/meshes"
list=$folder/meshes/list.txt
bake=("$list" --verb decompose)
with=(-- --parts 8)
echo "one process bakes $count meshes"
start=$(date +%s)
"$abut" bake "${bake[@]}" --cache "$folder/one" "${with[@]}"
echo "  in $(($(date +%s) - start)) s"

# --- GNU parallel --------------------------------------------------------------------------------------------------------

"$here/../../packaging/farm/bake_parallel.sh" 4 "${bake[@]}" --cache "$folder/parallel" "${with[@]}" </dev/null
diff -r "$folder/one" "$folder/parallel"
echo "GNU parallel: the same bytes"

# --- a farm --------------------------------------------------------------------------------------------------------------

name=$(hostname -s)
cat >"$SLURM_CONF" <<CONF
ClusterName=abut
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=16817
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool_%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd_%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd_%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SlurmdTimeout=5
SlurmctldTimeout=5
MinJobAge=3600
ReturnToService=1
NodeName=one NodeHostname=$name NodeAddr=127.0.0.1 Port=17001 CPUs=2 RealMemory=500
NodeName=two NodeHostname=$name NodeAddr=127.0.0.1 Port=17002 CPUs=2 RealMemory=500
PartitionName=all Nodes=ALL Default=YES State=UP
CONF
mkdir "$folder/state" "$folder/spool_one" "$folder/spool_two"
dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none
chmod 600 "$folder/munge.key"
daemon munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munged.pid" --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
until_true 20 test -S "$folder/munge.socket"
daemon slurmctld -D
daemon slurmd -D -N one
daemon slurmd -D -N two
second_node=${started[-1]}
both_idle() { [ "$(sinfo --noheader --format '%T %D' 2>/dev/null)" = "idle 2" ]; }
until_true 60 both_idle

echo "two nodes bake $count meshes in 8 tasks"
# 3 of 4 cores at once, so that some tasks wait while one node dies.
job=$(sbatch --parsable --array=1-8 --output "$folder/task_%a.out" "$here/../../packaging/farm/bake_slurm.sh" \
    "${bake[@]}" --cache "$folder/farm" "${with[@]}")
made() { find "$folder/farm" -name '*.json' 2>/dev/null | wc -l; }
half_made() { [ "$(made)" -ge $((count / 3)) ]; }
until_true 1200 half_made
echo "  node two dies after $(made) results, with $(squeue --noheader --nodelist two --states running | wc -l) tasks on it"
kill -9 "$second_node"
is_down() { sinfo --noheader --nodes two --format %T | grep -q down; }
until_true 120 is_down
echo "  Slurm knows after $(made) results"
is_done() { [ -z "$(squeue --noheader --job "$job" 2>/dev/null)" ]; }
until_true 2400 is_done
restarted=$(grep -c "requeue" "$folder/slurmctld.log" || true)
echo "  done; $restarted lines of the log tell of tasks that start again"
[ "$restarted" -gt 0 ]
# What was being written when the node died is not a result.
find "$folder/farm" -name '*.part*' -delete
diff -r "$folder/one" "$folder/farm"
echo "the farm: the same bytes"
"$abut" bake "${bake[@]}" --cache "$folder/farm" --report "${with[@]}"
"$abut" bake "${bake[@]}" --cache "$folder/farm" --audit 2 "${with[@]}"
echo "passed"
