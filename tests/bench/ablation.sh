#!/usr/bin/env bash
# What is each stage, and each constant, of the separation worth? Clusters of real layers are separated with a stage
# switched off, or with the constants of a stage halved or doubled; one line of CSV for each variation.
# ablation/README.md explains the columns.
#
#   bash tests/bench/ablation.sh [--corpus FILE] [--csv FILE] [WHAT ...]
#
# WHAT   stages, groups, singles (constants one by one, of the groups that matter); or variations in the words of
#        ablation/tuning.h, such as off:cluster/descend or search.SOFT*2. Default: stages, groups and singles.
# --corpus FILE  made if it does not exist, from the layers in ../shared/data beside the repository, otherwise from synthetic ones.
# --csv FILE     variations that are in it already are not run again.
# SUNDER_BUILD   the build; build/release if not set.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=${SUNDER_BUILD:-$source/build/release}
mkdir -p "$build/ablation"
corpus=$build/ablation/corpus.txt
csv=
what=()
while (($#)); do
    case $1 in
    --corpus) corpus=$2 && shift ;;
    --csv) csv=$2 && shift ;;
    -*) echo "ablation.sh: no option $1" >&2 && exit 2 ;;
    *) what+=("$1") ;;
    esac
    shift
done
csv=${csv:-${corpus%.txt}.csv}
((${#what[@]})) || what=(stages groups singles)
if ! [ -x "$build/run_corpus" ] || ! [ -x "$build/sunder_ablation" ]; then
    echo "ablation.sh: run_corpus and sunder_ablation are not built in $build" >&2
    exit 1
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# ---- The corpus ----
# A cluster is left out if it takes more steps. The 249 that are left take 12 s of processor time.
light=${SUNDER_ABLATION_STEPS:-7000000}
data=$source/../shared/data

draw() { # NAME CLUSTERS INPUT LAYER OPTION ...
    local name=$1 clusters=$2 input=$3 layer=$4
    shift 4
    SUNDER_CORPUS=$work/drawn SUNDER_CORPUS_NAME=$name SUNDER_CORPUS_ITEMS=$clusters nice "$build/sunder_ablation" separate \
        "$input" "$work/out.gpkg" --overwrite -q --input-layer "$layer" --output-layer l "$@"
}
draw_town() { # NAME INPUT LAYER
    local roads=(--max-shift 10 --barrier "$2,layer=roads,width=5")
    draw "$1_roads" 11 "$2" "$3" --gap 3 "${roads[@]}"
    draw "$1_roads_gap0" 6 "$2" "$3" --gap 0 "${roads[@]}"
    draw "$1_free" 9 "$2" "$3" --gap 3
    draw "$1_limits" 5 "$2" "$3" --gap 5 --max-shift 5
    draw "$1_soon" 4 "$2" "$3" --gap 3 --effort 0 "${roads[@]}"
    draw "$1_soon_free" 3 "$2" "$3" --gap 5 --effort 0
}
draw_rules() { # NAME INPUT LAYER: the same with other rules
    draw "$1_jumps" 4 "$2" "$3" --gap 3 --max-shift 20 --allow-jumps --barrier "$2,layer=roads,width=5"
    draw "$1_contained" 4 "$2" "$3" --gap 2 --contained separate --no-blocks
    draw "$1_effort" 4 "$2" "$3" --gap 4 --max-shift 3 --effort 3
}
draw_real() {
    draw_town krems "$data/krems_2013.gpkg" buildings
    draw_rules krems "$data/krems_2013.gpkg" buildings
    draw_town saint_jean "$data/saint_jean_la_poterie.gpkg" buildings
    draw_town neuss "$data/neuss_2026.gpkg" buildings
    draw_town liechtenstein "$data/liechtenstein_2015.gpkg" buildings
    draw_town paris "$data/paris_cite_2014.gpkg" buildings
    draw_town baltimore "/vsizip/$data/baltimore_2015_shp.zip" buildings
    draw_town jakarta "/vsizip/$data/jakarta_2012_shp.zip" structures
    draw germany 12 "$data/geonames_points.gpkg" germany --gap 300 --symbol disc:3000
    draw europe 12 "$data/geonames_points.gpkg" europe --gap 500 --symbol disc:5000
    draw france 12 "$data/geonames_points.gpkg" france --gap 200 --symbol disc:2500 --max-shift 10000
    draw germany_soon 4 "$data/geonames_points.gpkg" germany --gap 300 --symbol disc:3000 --effort 0
}
draw_synthetic() {
    local seed
    for seed in 1 2 3; do
        "$build/sunder-town" --buildings 4000 --seed $seed "$work/town$seed.gpkg"
        draw_town "town$seed" "$work/town$seed.gpkg" buildings
    done
    draw_rules town1 "$work/town1.gpkg" buildings
}

make_corpus() {
    if [ -d "$data" ]; then draw_real; else draw_synthetic; fi
    # Items that end within the limit of steps have eight columns.
    nice "$build/run_corpus" "$work/drawn" --most "$light" | awk -F'\t' 'NF == 8 && n++ < 300 { print $1 }' >"$work/names"
    awk 'NR == FNR { keep[$1] = 1; next } $1 == "cluster" { on = $2 in keep } on' "$work/names" "$work/drawn" >"$corpus.part"
    mv "$corpus.part" "$corpus"
}
[ -s "$corpus" ] || make_corpus

# ---- Variations ----
# Results of the corpus, one line for each cluster. A variation that runs away is stopped.
run() { SUNDER_TUNING=$1 nice "$build/run_corpus" "$corpus" --most $((20 * light)); }

# Prints "NAME,CHANGED,..." as in the heading, from the results without a variation and those with it.
compare() { # VARIATION CHANGES
    awk -F'\t' -v OFS=, -v name="\"$1\"" '
        NR == FNR { digest[$1] = $8; cost[$1] = $4; bound[$1] = $5; next }
        NF != 8 { failed++; next }
        { n++; left += $3; steps += $6; allocations += $7; changed += $8 != digest[$1] }
        cost[$1] > 0 { costs++; dearer += $4 / cost[$1] }
        bound[$1] > 0 { bounds++; better += $5 / bound[$1] }
        END {
            printf "%s,%d,%d,%d,%d,", name, n + failed, changed, failed, left
            printf "%.6f,%.6f,%d,%d\n", costs ? dearer / costs : 1, bounds ? better / bounds : 1, steps, allocations
        }' \
        "$work/plain" "$2"
}
record() { # VARIATION [CHANGES]
    local changes=${2-$1}
    cut -d, -f1 "$csv" | grep -qxF "\"$1\"" && return
    run "$changes" >"$work/varied" || echo "ablation.sh: $1: the program failed" >&2
    compare "$1" "$work/varied" >>"$csv"
    tail -1 "$csv"
}

begin() {
    # also finds out which stages are asked for, and which constants exist
    nice "$build/run_corpus" "$corpus" --list >"$work/listed"
    awk -F'\t' 'NF == 8' "$work/listed" >"$work/plain"
    [ -s "$csv" ] || {
        echo "# $(tail -1 "$work/listed"); corpus $(sha256sum <"$corpus" | cut -c1-16); commit $(git -C "$source" describe --always --dirty 2>/dev/null)"
        echo "variation,clusters,changed,failed,conflicts_left,cost,bound,steps,allocations"
        compare "as it is" "$work/plain"
    } >"$csv"
}

# Constants are lines "room TAB group TAB NAME TAB value".
constants() { awk -F'\t' 'NF == 4 && $1 != "stage"' "$work/listed"; }
vary_group() { # ROOM GROUP FACTOR
    record "$1: $2 *$3" "$(constants | awk -F'\t' -v r="$1" -v g="$2" -v f="$3" '$1 == r && $2 == g { printf "%s.%s*%s ", $1, $3, f }')"
}
vary_stages() {
    local stage
    while read -r stage; do record "off:$stage"; done < <(awk -F'\t' '$1 == "stage" { print $2 }' "$work/listed" | sort)
}
groups() { constants | cut -f1,2 | awk '!seen[$0]++'; }
vary_groups() {
    local room group
    while IFS=$'\t' read -r room group; do
        vary_group "$room" "$group" 0.5
        vary_group "$room" "$group" 2
    done < <(groups)
}
# Does the CSV have a change of a result for this group, in either direction?
matters() { awk -F'",' -v name="\"$1: $2 *" 'index($1, name) == 1 { split($2, c, ","); if (c[2] + c[3] > 0) found = 1 } END { exit !found }' "$csv"; }
vary_singles() {
    local room group name
    while IFS=$'\t' read -r room group name _; do
        matters "$room" "$group" || continue
        record "$room.$name*0.5"
        record "$room.$name*2"
    done < <(constants)
}

begin
for each in "${what[@]}"; do
    case $each in
    stages | groups | singles) "vary_$each" ;;
    *) record "$each" ;;
    esac
done
