# shellcheck shell=bash disable=SC2016,SC1091
# Version, help, and wrong usage: one line, exit status 2, no other effect.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

expect 0 --version
same "$(sed -n 1p out)" "sunder $(sed -n 's/^#define SUNDER_VERSION "\(.*\)"/\1/p' "$SUNDER_SOURCE/src/sunder.h")" version
same "$(sed -n 2p out)" "$(ogr2ogr --version | sed 's/,.*//')" 'version of GDAL'
sed -n '3p' out | grep -qE '^GMP [0-9]+\.[0-9]+\.[0-9]+$' || fail "--version says $(cat out)"
same "$(wc -l <out)" 3 'lines of --version'
expect 0 --help
mv out commands
for command in separate check sum pair buffer route plan merge follow; do
    says commands "  $command "
    expect 0 $command --help
    [ ! -s err ] || fail "$command --help writes to stderr"
    [ "$(wc -l <out)" -le 45 ] || fail "$command --help does not fit a screen: $(wc -l <out) lines"
    [ "$(awk 'length > w { w = length } END { print w }' out)" -le 120 ] || fail "$command --help is too wide"
    says out "Usage: sunder $command"
    says out "Example: sunder $command"
done
expect 0 separate --help
for words in '--gap LENGTH' '[gap / 10]' '[repair]' '[0]' 'units of the layer' '0 done, 1 failed, 2 wrong usage, 3 conflicts'; do
    says out "$words"
done
rm commands
for size in 0 -3 2X 2GB G; do refused 2 'not a size' separate a b "--max-memory=$size"; done
for option in --algorithm --decomposition --order --seed --planar-map; do refused 2 "unknown option" pair square:1 square:1 $option; done
refused 2 'must be one of' sum square:1 square:1 --algorithm quickest
refused 2 'unknown command' dissolve a b
refused 2 'a command is missing'
refused 2 'unknown option' --nonsense
for option in --lco --co --oo; do refused 2 "$option X: expected K=V" separate a b $option X; done

# A misspelt option gets a suggestion, an unrelated word does not.
refused 2 'did you mean separate?' seperate a b
refused 2 'did you mean --overwrite?' separate a b --overwite
refused 2 'did you mean --gap?' separate a b -gap 3
refused 2 'did you mean --gap?' separate a b --gpa=3
refused 2 'did you mean --touch-tolerance?' separate a b --tolerance 3
refused 2 'did you mean --exact?' sum square:1 square:1 --EXACT
refused 2 'belongs to other commands' check a --weight area
refused 2 'unknown option --zzz; `sunder' check a --zzz

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
expect 0 separate in.gpkg earlier.gpkg --quiet
# Every value that --help lists for an option is accepted by its parser.
words_tried=0
for command in separate check sum pair buffer route plan merge follow; do
    case $command in
    check) operands=(in.gpkg --before in.gpkg) ;;
    sum | pair) operands=(square:1 square:1) ;;
    buffer) operands=(in.gpkg o.gpkg --shape square:1) ;;
    route) operands=(square:1 --robot square:1 --from '5,5' --to '6,6') ;;
    plan) operands=(in.gpkg in.plan --shards 2) ;;
    merge | follow) continue ;; # their options have no lists of values
    *) operands=(in.gpkg o.gpkg) ;;
    esac
    "$SUNDER" $command --help | grep -oE -- '--[a-z-]+ [a-z0-9-]+(\|[a-z0-9-]+)+' >choices
    while read -r option words; do
        case $command,$option in
        separate,--hide-weight | separate,--crossed | plan,--hide-weight | plan,--crossed)
            with=(--hide) ;; # without that they are refused: test_options.sh
        check,--crossed) with=(--inset 1) ;;
        separate,--previous-relax) with=(--previous earlier.gpkg) ;;
        *) with=() ;;
        esac
        for word in ${words//|/ }; do
            run $command "${operands[@]}" "$option" "$word" --overwrite "${with[@]}" </dev/null
            [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$command $option $word: $status"
            rm -rf in.plan
            words_tried=$((words_tried + 1))
        done
    done <choices
done
[ "$words_tried" -ge 40 ] || fail "only $words_tried words of choices were tried"
rm -f choices o.gpkg
refused 2 'needs INPUT OUTPUT' separate in.gpkg
refused 2 'one operand too many' separate in.gpkg a.gpkg b.gpkg
refused 2 'operand is empty' separate in.gpkg ''
refused 2 'unknown option --gaap' separate in.gpkg o.gpkg --gaap 3
refused 2 'needs a value' separate in.gpkg o.gpkg --gap
refused 2 'takes no value' separate in.gpkg o.gpkg --quiet=yes
refused 2 'given twice' separate in.gpkg o.gpkg --gap 1 --gap 2
refused 2 'negative' separate in.gpkg o.gpkg --gap -3
refused 2 'negative' separate in.gpkg o.gpkg --gap=-3m
refused 2 'negative' separate in.gpkg o.gpkg --gap 3 --touch-tolerance -1
refused 2 'negative' separate in.gpkg o.gpkg --max-shift -1
for gap in nan inf infinity 1e999 0x10 3x '' 3furlong ,3 '3 m'; do refused 2 '--gap' separate in.gpkg o.gpkg --gap "$gap"; done
refused 2 'touch-tolerance' separate in.gpkg o.gpkg --gap 3 --touch-tolerance inf
refused 2 'less than the gap' separate in.gpkg o.gpkg --gap 3 --touch-tolerance 3
for scale in 0 -1 1:0 nan a ''; do refused 2 '--scale' separate in.gpkg o.gpkg --scale "$scale" --gap 0.2mm; done
refused 2 'must be one of 1|area|sqrt-area' separate in.gpkg o.gpkg --weight 0
refused 2 'must be one of block|ignore|separate' check in.gpkg --contained maybe
refused 2 'must be one of repair|skip|fail' check in.gpkg --invalid perhaps
refused 2 'whole number' separate in.gpkg o.gpkg --threads -1
refused 2 'whole number' separate in.gpkg o.gpkg --threads 1.5
refused 2 'four finite numbers' check in.gpkg --bbox 1,2,3
refused 2 'four finite numbers' check in.gpkg --bbox 1,2,3,nan
refused 2 'four finite numbers' check in.gpkg -spat 1 2 3
refused 2 'greater than its maximum' check in.gpkg --bbox 5,0,1,1
refused 2 'none of main' separate in.gpkg o.gpkg --layers main,nonsense
refused 2 'none of these applies' separate in.gpkg o.gpkg --layers symbols
refused 2 'must be one of text|json' check in.gpkg --messages xml
refused 2 'cannot be given together' check in.gpkg --sql 'SELECT * FROM houses' --input-layer houses
refused 2 'needs --update' separate in.gpkg o.gpkg --overwrite-layer
refused 2 '--overwrite replaces' separate in.gpkg o.gpkg --overwrite --update
refused 2 'share standard output' separate in.gpkg /vsistdout/ --of GeoJSON --stats -
refused 2 'OUTPUT is given twice' check in.gpkg a.gpkg --output b.gpkg
refused 2 'neither P nor Q is one' sum square:1 square:1 --where 'a = 1'
refused 2 'expected K=V' check in.gpkg --config NAME
refused 2 'is empty' check in.gpkg --where ''
refused 1 'no field idd; did you mean id?' separate in.gpkg o.gpkg --id-field idd
refused 1 'no field idd; did you mean id? its fields are id' check in.gpkg --id-field idd
refused 1 'no field wait; its fields are id' check in.gpkg --block-field wait
refused 1 'is a directory' separate in.gpkg o.gpkg --stats .
refused 1 '--stats' separate in.gpkg o.gpkg --stats no/such/dir.json

# Spellings of ogr2ogr, values after '=', options after operands, and -- before operands that look like options.
expect 3 check -l houses -where 'id < 3' -spat 0 0 9 9 --config CPL_DEBUG OFF --config=GDAL_CACHEMAX=64 in.gpkg
expect 0 check in.gpkg --where="id = 1"
expect 0 separate -f GPKG -nln moved -lco SPATIAL_INDEX=NO -dsco VERSION=1.2 -q in.gpkg o.gpkg
[ ! -s out ] || fail "--quiet prints a summary"
same "$(count o.gpkg moved)" 2 features
expect 0 separate -overwrite -nln moved in.gpkg o.gpkg
expect 0 check --input-layer moved -- o.gpkg
expect 3 check -sql 'SELECT * FROM houses' -dialect sqlite in.gpkg
refused 2 'needs INPUT' check -- 
refused 1 'no such file' check -- --gap
finish
