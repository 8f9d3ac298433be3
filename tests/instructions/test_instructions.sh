#!/usr/bin/env bash
# Does any part of the program need more instructions than recorded? callgrind counts them on inputs that are made here:
# sums of the families, a file of pairs, a route, buffers and separated towns. Unlike times, these counts do not vary
# from run to run.
#
#   test_instructions.sh             fails if a count is more than 5 % above RECORD
#   test_instructions.sh --record    counts, and replaces the part of RECORD for this machine; the commit gives the reason
#
# Counts depend on the compiler, on flags, on libraries and, since libraries choose code by the features of the
# processor, on the processor. So RECORD has a part for each kind of machine, of two paragraphs: the properties that
# counts depend on, and counts. On a machine that is not one of these the test is skipped.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=${SUNDER_BUILD:-$root/build/release}
record=$root/tests/instructions/RECORD
renew="bash tests/instructions/test_instructions.sh --record"
most=1.05
skip() { echo "skipped: $1"; exit 77; }

command -v valgrind >/dev/null || skip "valgrind is not installed"
command -v ogr2ogr >/dev/null || skip "gdal-bin is not installed"
for program in sunder sunder-families sunder-town bench_sum bench_pair; do
    [[ -x $build/$program ]] || skip "no $build/$program"
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# ---- Conditions on which counts depend ----
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt" | head -n 1; }
processor() { sed -n "s/^$1[[:space:]]*: //p" /proc/cpuinfo | head -n 1; }
libraries() { # the libraries that are loaded: their file names contain versions
    ldd "$build/sunder" | sed -n 's/.* => \([^ ]*\) .*/\1/p' | xargs -n 1 readlink -f | sed 's#.*/##' |
        grep -E '^lib(gmp|gdal|sqlite3|proj|geos|geos_c)[.-]' | LC_ALL=C sort | paste -sd' '
}
conditions() {
    echo "processor: $(processor 'model name'), family $(processor 'cpu family'), model $(processor model)"
    # the compiler's name may be cc, gcc-12 and so on for the same program
    echo "compiler: $("$(cached CMAKE_C_COMPILER)" --version | sed '1s/^[a-z0-9_-]*cc[-0-9]* (/gcc (/;q')"
    echo "build: $(for name in CMAKE_BUILD_TYPE CMAKE_C_FLAGS_RELEASE CMAKE_C_FLAGS SUNDER_SANITIZE; do cached $name; done | paste -sd' ' | sed 's/ *$//')"
    echo "libraries: $(getconf GNU_LIBC_VERSION) $(libraries)"
    echo "valgrind: $(valgrind --version)"
}

# ---- Counts ----
count() { # NAME FUNCTION COMMAND...: instructions within calls of the function
    local name=$1 function=$2 counted status=0
    shift 2
    SUNDER_BENCH_RUNS=1 valgrind --tool=callgrind --toggle-collect="$function" --callgrind-out-file=/dev/null "$@" >out 2>err || status=$?
    counted=$(sed -n 's/^==[0-9]*== Collected : \([0-9]*\)$/\1/p' err)
    if [[ $status -ne 0 && $status -ne 3 || ${counted:-0} -eq 0 ]]; then
        echo "FAILED: $name: status $status, nothing counted" >&2
        tail -n 5 err >&2
        exit 1
    fi
    echo "$name $counted"
}
family() { # NAME FAMILY OPTIONS...
    "$build/sunder-families" "${@:2}" >"$1"
    count "$1" bench_once "$build/bench_sum" "$1"
}
town() { "$build/sunder-town" --buildings "$1" --seed 7 "$2" >/dev/null; }
counts() {
    family comb comb --size 200
    family fork fork --size 50
    family slanted-fork slanted-fork --size 50
    family star star --size 100
    family random random --size 100
    family robot robot --size 30 --size-q 500
    family fat-grid fat-grid --size 100
    family buildings buildings --size 2000 --size-q 32
    "$build/sunder-families" overlap --count 500 >pairs
    count pairs bench_once "$build/bench_pair" pairs
    "$build/sunder-families" robot --size 12 --size-q 600 >scene
    sed -n 2p scene >obstacles
    sed -n 1p scene >robot
    count route main "$build/sunder" route --quiet @obstacles --robot @robot --from=-300000,-300000 --to 2300000,2300000
    town 600 town.gpkg
    count buffer main "$build/sunder" buffer --quiet --threads 1 --shape disc:5:32 --input-layer buildings town.gpkg grown.gpkg
    count separate main "$build/sunder" separate --quiet --threads 1 --effort 0 --gap 3 --input-layer buildings town.gpkg apart.gpkg
}

above() { # COUNTS RECORD: a line for each count that is above, or is missing in either
    awk -v most="$most" 'NR == FNR { old[$1] = $2; next }
        !($1 in old) { print $1 ": not on record" }
        $1 in old { if ($2 > most * old[$1]) printf "%s: %d instructions, %.1f %% above the %d on record\n", $1, $2, 100 * ($2 / old[$1] - 1), old[$1]
                    delete old[$1] }
        END { for (name in old) print name ": on record, not counted" }' "$2" "$1"
}

# Prints paragraphs of RECORD: the counts for machines like this one, or the paragraphs for all others.
like_this() { awk -v RS= 'NR == FNR { here = $0; next } FNR % 2 { mine = $0 == here; next } mine' here "$record"; }
others() { awk -v RS= 'NR == FNR { here = $0; next } FNR % 2 { there = $0; next } there != here { print there "\n\n" $0 "\n" }' here "$record"; }

conditions >here
if [[ ${1:-} == --record ]]; then
    counts >counted
    { [[ ! -r $record ]] || others; cat here; echo; cat counted; } >written
    cp written "$record"
    cat here counted
    exit
fi
[[ -r $record ]] || skip "no $record"
like_this >recorded
if [[ ! -s recorded ]]; then
    grep : "$record" | sed 's/^/on record  /'
    sed 's/^/here       /' here
    skip "there is no record of a machine, compiler, build and libraries like these; for one: $renew"
fi
counts >counted
join <(LC_ALL=C sort recorded) <(LC_ALL=C sort counted) | awk '{ printf "%-14s %12d on record %12d now %+6.1f %%\n", $1, $2, $3, 100 * ($3 / $2 - 1) }'
# Can the check fail? If the recorded counts are lowered by a tenth, every line must be reported.
awk '{ print $1, int(0.9 * $2) }' counted >lowered
[[ $(above counted lowered | wc -l) -eq $(wc -l <counted) ]] || { echo "FAILED: counts a tenth above are not found"; exit 1; }
above counted recorded >found
[[ -s found ]] || exit 0
sed 's/^/FAILED: /' found
echo "If the additional instructions are intended, record the counts again and give the reason in the commit: $renew"
exit 1
