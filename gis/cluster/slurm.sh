#!/usr/bin/env bash
# Separates a layer on a cluster with Slurm:
#
#   slurm.sh [--plan DIRECTORY] [--at-once JOBS] [--cpus N] [--wait] INPUT OUTPUT N [-- OPTIONS OF separate]
#
# Three jobs: one plans the layer in N shards, and then sends off an array of N and, after all of it, the merge. What the
# array and the merge ask for of memory and time is what plan.json estimates, with room. A node that goes away has its shards
# done elsewhere. All nodes must see this folder, the program and DIRECTORY (OUTPUT.plan unless said); the plan's and the
# merge's also INPUT and OUTPUT. If something fails, the same command does what is missing.
#
#   SUNDER            the program, if it is not on the PATH
#   SUNDER_SBATCH     further words for each sbatch: "--partition=night --account=maps"
#   SUNDER_PLAN_MB, SUNDER_PLAN_MINUTES   asked for by the plan: 1500 and 240 unless said
#   SUNDER_SLOW       how much slower a node may be than estimated: 4 unless said
usage() {
    echo "usage: ${0##*/} [--plan DIRECTORY] [--at-once JOBS] [--cpus N] [--wait] INPUT OUTPUT N [-- OPTIONS OF separate]"
}

at_once='' cpus=1 wait='' step=''
option() {
    case $1 in
        --at-once | --cpus)
            case ${2-} in '' | *[!0-9]* | 0*) return 1 ;; esac
            if [ "$1" = --cpus ]; then cpus=$2; else at_once=$2; fi
            took=2
            ;;
        --wait) wait=yes took=1 ;;
        *) return 1 ;;
    esac
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
if [ "${1-}" = --step ]; then # within a job, whose script is a copy that stands elsewhere
    step=$2 here=$3
    shift 3
fi
words=("$@")
# shellcheck source=lib.sh
. "$here/lib.sh" || exit 1
cluster_arguments "$here/slurm.sh" "$@"

# A job that does the step, with what it asks for. Leaves its number in `job`.
submit() {
    local next=$1
    shift
    # shellcheck disable=SC2086 # words
    if ! job=$(sbatch --parsable --requeue --open-mode=append --nodes=1 --ntasks=1 --job-name="sunder $next" --comment="$output" \
        "$@" ${SUNDER_SBATCH-} "$here/slurm.sh" --step "$next" "$here" "${words[@]}"); then
        cluster_again "Slurm did not take the job: $next"
        exit 1
    fi
    job=${job%%;*} # of several clusters its name follows
}

# The estimates with a margin for other machines, in whole megabytes and whole minutes.
megabytes() { awk -v bytes="$1" 'BEGIN { printf "%d", bytes / 1048576 * 1.25 + 64 }'; }
minutes() { awk -v s="$1" -v slow="${SUNDER_SLOW:-4}" 'BEGIN { printf "%d", s * slow / 60 + 10 }'; }

# 1,2,3,7 as 1-3,7
ranges() {
    awk '{ if (n && $1 == last + 1) last = $1
           else { put(); first = last = $1; n = 1 } }
         function put() { if (n) { printf "%s%s", sep, (first == last ? first : first "-" last); sep = "," } }
         END { put() }'
}

case $step in
    '') # where it was called
        command -v sbatch >/dev/null || cluster_refuse 1 "there is no sbatch here; parallel.sh and make.sh do without Slurm"
        export SUNDER=$sunder
        rm -f "$log/jobs" "$log/merge.status"
        submit plan --cpus-per-task=1 --mem="${SUNDER_PLAN_MB:-1500}M" --time="${SUNDER_PLAN_MINUTES:-240}" \
            --output="$log/plan.out"
        echo "job $job plans; what all say goes to $log"
        [ -n "$wait" ] || exit 0
        # The last job is known when the plan is made. Slurm may be away for a while: only what it says counts.
        while :; do
            sleep "${SUNDER_POLL:-10}"
            if [ -f "$log/jobs" ]; then job=$(tail -n 1 "$log/jobs"); fi
            queue=$(squeue --noheader --format=%i --jobs="$job" 2>&1) || case $queue in *nvalid\ job*) queue= ;; *) continue ;; esac
            [ -z "$queue" ] || continue
            [ ! -f "$log/jobs" ] || [ "$job" = "$(tail -n 1 "$log/jobs")" ] || continue
            break
        done
        if [ -f "$log/merge.status" ]; then
            cat "$log/merge.out" >&2
            exit "$(cat "$log/merge.status")"
        fi
        missing=$(cluster_missing | ranges)
        if [ ! -f "$log/jobs" ]; then
            cat "$log/plan.out" >&2
            cluster_again "there is no plan"
        else
            cluster_again "${missing:+shards $missing are missing, }there was no merge"
        fi
        exit 1
        ;;
    plan)
        cluster_plan || { status=$?; cluster_again "the plan failed (status $status)"; exit "$status"; }
        after=()
        missing=$(cluster_missing | ranges)
        : >"$log/jobs.part"
        if [ -n "$missing" ]; then
            submit shard --array="$missing${at_once:+%$at_once}" --cpus-per-task="$cpus" \
                --mem="$(megabytes "$(cluster_most memory_bytes)")M" --time="$(minutes "$(cluster_most seconds)")" \
                --output="$log/shard-%a.out"
            after=(--dependency="afterok:$job" --kill-on-invalid-dep=yes)
            echo "job $job makes shards $missing"
            echo "$job" >>"$log/jobs.part"
        fi
        submit merge ${after[@]+"${after[@]}"} --cpus-per-task=1 --mem="$(megabytes "$(cluster_of_merge memory_bytes)")M" \
            --time="$(minutes "$(cluster_of_merge seconds)")" --output="$log/merge.out"
        echo "job $job merges"
        echo "$job" >>"$log/jobs.part"
        mv "$log/jobs.part" "$log/jobs"
        ;;
    shard)
        k=${SLURM_ARRAY_TASK_ID:?}
        echo "shard $k on $(hostname)${SLURM_RESTART_COUNT:+, again ($SLURM_RESTART_COUNT)}"
        cluster_shard "$k" "${SLURM_CPUS_PER_TASK:-1}" ||
            { status=$?; cluster_again "shard $k failed (status $status)"; exit "$status"; }
        ;;
    merge)
        status=0
        cluster_merge "${SLURM_CPUS_PER_TASK:-1}" || status=$?
        echo "$status" >"$log/merge.status"
        exit "$status"
        ;;
    *) cluster_refuse 2 "there is no step $step" ;;
esac
