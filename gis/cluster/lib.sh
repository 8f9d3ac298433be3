# shellcheck shell=bash
# Sourced by slurm.sh, parallel.sh and make.sh: their arguments, and what plan.json and the directory of a plan tell.
#
#   cluster_arguments SCRIPT ARGS  INPUT OUTPUT N [-- OPTIONS]; a word before these that begins with - is handed, with what
#                           follows, to the script's own option(), which sets `took` to the number of words that it took, or fails
#   input output shards plan log options=()   what became of them
#   cluster_plan            makes the plan, if it is not there
#   cluster_missing         the numbers of the shards that are not there yet, a line each
#   cluster_most KEY [K]    the largest KEY of the shards of plan.json, or that of shard K, as it stands there
#   cluster_of_merge KEY    that of the merge
#   cluster_shard K THREADS makes a shard; once more if it was killed, for what kills is not always in the shard
#   cluster_merge THREADS   makes the output
#   cluster_again WHAT      what failed, and how to go on
set -u

sunder=${SUNDER:-sunder}
input='' output='' shards='' plan='' log='' options=() again=''

cluster_refuse() { # status, words
    echo "${0##*/}: $2" >&2
    exit "$1"
}

cluster_arguments() {
    local word found
    for word in "$@"; do again+="${again:+ }$(printf %q "$word")"; done
    shift
    while [ $# -gt 0 ]; do
        case $1 in
            --plan)
                [ $# -gt 1 ] || cluster_refuse 2 "--plan wants a directory"
                plan=$2
                shift 2
                ;;
            --help | -h)
                usage
                exit 0
                ;;
            --) break ;;
            -*)
                took=0
                option "$@" || cluster_refuse 2 "there is no option $1, or not so; options of separate come after --"
                shift "$took"
                ;;
            *) break ;;
        esac
    done
    [ $# -ge 3 ] || { usage >&2; exit 2; }
    input=$1 output=$2 shards=$3
    shift 3
    case $shards in '' | *[!0-9]* | 0*) cluster_refuse 2 "N is to be a number of shards, not $shards" ;; esac
    if [ $# -gt 0 ]; then
        [ "$1" = -- ] || cluster_refuse 2 "options of separate come after --, not $1"
        shift
        options=("$@")
    fi
    if [ -z "$plan" ]; then
        case $output in *:*) cluster_refuse 2 "$output is no file: say where the plan goes by --plan DIRECTORY" ;; esac
        plan=$output.plan
    fi
    log=$plan.log
    found=$(command -v "$sunder") || cluster_refuse 1 "there is no $sunder: put it on the PATH, or say SUNDER=/path/to/sunder"
    case $found in /*) ;; *) found=$PWD/$found ;; esac
    sunder=$found
    mkdir -p "$log" || exit 1
}

cluster_plan() { "$sunder" plan ${options[@]+"${options[@]}"} --shards "$shards" "$input" "$plan"; }

cluster_missing() {
    local k
    for ((k = 1; k <= shards; k++)); do
        [ -e "$plan/shard-$k" ] || echo "$k"
    done
}

# plan.json has an object of one line for each shard, and one for the merge.
cluster_most() {
    awk -v key="\"$1\":" -v only="${2-}" '
        match($0, /"shard": *[0-9]+/) {
            k = substr($0, RSTART, RLENGTH); sub(/.*[: ]/, "", k)
            at = index($0, key)
            if (at && (only == "" || k == only)) { value = substr($0, at + length(key)) + 0; if (value > most) most = value }
        }
        END { printf "%.3f\n", most }' "$plan/plan.json"
}

cluster_of_merge() {
    awk -v key="\"$1\":" '
        /"merge": *{/ { at = index($0, key); if (at) value = substr($0, at + length(key)) + 0 }
        END { printf "%.3f\n", value }' "$plan/plan.json"
}

cluster_shard() { # K, threads
    local k=$1 status=0
    "$sunder" separate --shard "$k" --threads "$2" "$plan" || status=$?
    if [ "$status" -gt 128 ]; then
        echo "shard $k was killed (status $status): once more" >&2
        status=0
        "$sunder" separate --shard "$k" --threads "$2" "$plan" || status=$?
    fi
    return "$status"
}

# A merge that ends with 3 is done: conflicts remain.
cluster_merge() { # threads
    local status=0
    "$sunder" merge --threads "$1" "$plan" "$output" || status=$?
    case $status in
        0 | 3) echo "$output is written; $plan and $log may be deleted" >&2 ;;
        *) cluster_again "the merge failed (status $status)" ;;
    esac
    return "$status"
}

cluster_again() { # what failed
    cat >&2 <<EOF
${0##*/}: $1.
What was said stands above, or in $log. When the reason is mended, the same command does what is missing, and only that:
  $again
EOF
}
