# shellcheck shell=bash
# Common parts of the tests of the command, sourced by each test. $work is a scratch directory, removed at the end, and
# the current directory of the test.
#
#   run ARGS           runs the program; its exit status is in $status, its stdout and stderr are in `out` and `err`
#   expect N ARGS      the same, and fails the test unless the status is N
#   refused N WORDS ARGS  status N, one line on stderr that is an error and contains WORDS, nothing on stdout, no new file
#   layer FILE NAME TYPE [CRS]  makes a layer from CSV on stdin whose column WKT is the geometry (CRS EPSG:25832; "none")
set -u
command -v ogr2ogr >/dev/null && command -v ogrinfo >/dev/null || { echo "skipped: gdal-bin is not installed"; exit 77; }
# In most tests (CMakeLists.txt lists the others as cold) calls are forks of a process that has loaded GDAL already (warm.c).
if [ "${SUNDER_WARM:-}" = yes ] && [ -x "$SUNDER_BUILD/tests/warm/sunder" ] && [ "$SUNDER" = "$SUNDER_BUILD/sunder" ]; then
    export SUNDER_WARM_OWNER=$$
    SUNDER=$SUNDER_BUILD/tests/warm/sunder PATH=$SUNDER_BUILD/tests/warm:$PATH
fi
work=$(mktemp -d)
trap 'chmod -R u+rwx "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
trouble=0

fail() {
    echo "FAILED: $*"
    [ -s err ] && sed 's/^/  stderr: /' err | head -5
    trouble=1
}

finish() { exit $trouble; }

run() {
    status=0
    "$SUNDER" "$@" >out 2>err || status=$?
    [ "${1:-},$status" != separate,3 ] || demand_upheld "$@"
    case ${1:-},$status in separate,0 | separate,3) demand_rules_kept "$@" ;; esac
}

# After separate IN.gpkg OUT.gpkg ...: check --before finds no broken rule. It is not asked after calls with an option
# that is not listed here.
demand_rules_kept() {
    local input=${2:-} output=${3:-} name= written=
    local -a rules=()
    [ "${input##*.},${output##*.}" = gpkg,gpkg ] || return 0
    shift 3
    while [ $# -gt 0 ]; do
        case $1 in
            --*=*) return 0 ;;
            --input-layer | -l) name=$2 && shift ;;
            --output-layer | -nln) written=$2 && shift ;;
            --gap | --max-shift | --max-shift-field | --barrier | --fixed-where | --ignore-where | --contained | --touch-tolerance | \
                --rows | --symbol | --symbol-field | --scale | --id-field) rules+=("$1" "$2") && shift ;;
            --allow-jumps) rules+=("$1") ;;
            --effort | --weight | --weight-field | --block-field | --ease | --row-stiffness | --threads | --max-memory | --seed | \
                --prefer-dx | --prefer-dy | --previous | --previous-relax | --links | --links-radius | \
                --stats | --report | --proof | --trace | --messages) shift ;;
            --no-blocks | --overwrite | -q | --quiet | --list-inside | --allow-conflicts | --no-styles) ;;
            *) return 0 ;;
        esac
        shift
    done
    [ -z "$written" ] || [ "$written" = "$name" ] || return 0
    [ -z "$name" ] || rules+=(--input-layer "$name")
    "$SUNDER" check "$output" --before "$input" "${rules[@]}" --no-blocks --block-field sunder_blk >broken 2>&1
    awk -F'\t' 'NF > 5 && $7 ~ /^(worse|limit|side|jump|not_a_translate|row|lost)$/ { print; n = 1 }
        /^since / { asked = 1 } END { exit n || !asked }' broken >rules || fail "check --before of $output: $(head -3 rules broken)"
    rm broken rules
}

# After separate IN.gpkg OUT.gpkg ...: no remaining conflict may be worse than before. An independent script compares
# the two layers exactly. The check is skipped for calls that upheld.py does not support: other formats, units, symbols,
# barriers, selections of features or of layers.
moved_pairs=0
demand_upheld() {
    local rule=$SUNDER_BUILD/tests/standing_rule input=${2:-} output=${3:-} name= written= gap=0 word
    local -a same=()
    [ -x "$rule" ] && [ "${input##*.},${output##*.}" = gpkg,gpkg ] && command -v python3 >/dev/null || return 0
    shift 3
    while [ $# -gt 0 ]; do
        word=$1
        case $word in
            --input-layer | -l) name=$2 ;;
            --output-layer | -nln) written=$2 ;;
            --gap) gap=$2 ;;
            --layers | --symbol* | --barrier | --least-gap | --hide | --where | -where | --sql | -sql | --spat | -spat | --input-crs | --open-option | -oo) return 0 ;;
        esac
        case $word in
            --input-layer | -l | --gap | --contained | --touch-tolerance | --block-field) same+=("$word" "$2") && shift ;;
            --no-blocks) same+=("$word") ;;
        esac
        shift
    done
    case $gap in *[!0-9.e+-]*) return 0 ;; esac
    "$SUNDER" check "$input" "${same[@]}" >was_found 2>/dev/null
    python3 "$SUNDER_SOURCE/tests/cli/upheld.py" "$input" "$name" "$output" "$written" "$gap" was_found >pairs ||
        fail "upheld.py: $input, $output"
    "$rule" <pairs >worse || fail "$output, gap $gap: $(head -3 worse)"
    moved_pairs=$((moved_pairs + $(wc -l <pairs)))
    rm was_found pairs worse
}

expect() {
    local wanted=$1
    shift
    run "$@"
    [ "$status" -eq "$wanted" ] || fail "exit status $status, not $wanted: sunder $*"
    in_file err
    [[ $content != *Sanitizer* && $content != *'runtime error'* ]] || fail "sanitizer: sunder $*"
}

# Reads a text file into $content without starting a process, since there are thousands of such reads. A binary file is
# read up to its first NUL.
in_file() { IFS= read -r -d '' content <"$1" || :; }

# Lists all files with their content, except files that the tests make for themselves.
listing() {
    find . -mindepth 1 ! -name out ! -name err ! -name before ! -name after \( -type f -exec cksum {} + -o -print \) | sort
}

refused() {
    local wanted=$1 words=$2
    shift 2
    listing >before
    expect "$wanted" "$@"
    listing >after
    in_file err
    local lines=${content//[!$'\n']/}
    [ "${#lines}" -eq 1 ] || fail "${#lines} lines on stderr: sunder $*"
    [[ $content == 'sunder: error: '??* ]] || fail "no error message: sunder $*"
    [[ ${content,,} == *"${words,,}"* ]] || fail "the message does not say '$words': sunder $*"
    [ ! -s out ] || fail "something on stdout: sunder $*"
    cmp -s before after || fail "files changed: sunder $*"
}

# Does the file contain the words?
says() {
    in_file "$1"
    [[ $content == *"$2"* ]] || fail "$1 does not say '$2'"
}
same() { [ "$1" = "$2" ] || fail "${3:-} '$1' is not '$2'"; }

layer() {
    cat >layer.csv
    local crs=(-a_srs "${4:-EPSG:25832}")
    [ "${4:-}" = none ] && crs=()
    local mode=()
    [ -e "$1" ] && mode=(-update)
    ogr2ogr "${mode[@]}" "$1" layer.csv -nln "$2" -nlt "$3" "${crs[@]}" -oo GEOM_POSSIBLE_NAMES=WKT \
        -oo KEEP_GEOM_COLUMNS=NO -oo AUTODETECT_TYPE=YES || fail "cannot make layer $2"
    rm layer.csv
}

# A layer made from a text with nan may not contain one: GDAL 3.10 writes null instead. Is the value null? is_null FILE
# LAYER FID FIELD
is_null() { [ "$(value "$@")" = '(null)' ]; }

# Prints the value of one field of one feature: value FILE LAYER FID FIELD
value() { ogrinfo -q -ro "$1" "$2" -fid "$3" | sed -n "s/^  $4 (.*) = //p"; }
# Of the feature with this name in the layer houses, a field, and the geometry: house FILE NAME FIELD, house_wkt FILE NAME
house() { ogr2ogr -f CSV /vsistdout/ "$1" houses -where "name = '$2'" -select "$3" -lco STRING_QUOTING=IF_NEEDED | tail -n 1; }
house_wkt() { ogr2ogr -f CSV /vsistdout/ "$1" houses -where "name = '$2'" -select name -lco GEOMETRY=AS_WKT | tail -n 1; }
geometry() { ogrinfo -q -ro "$1" "$2" -fid "$3" | grep -E '^  [A-Z]+ .*\('; }
count() { ogrinfo -ro -so "$1" "$2" | sed -n 's/^Feature Count: //p'; }
# Prints one value of a JSON text: json .result.area FILE
if command -v jq >/dev/null; then
    json() { jq -r "$1" "$2"; }
else
    json() { echo "skipped: jq is not installed"; exit 77; }
fi
