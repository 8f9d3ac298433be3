# shellcheck shell=bash disable=SC1090,SC1091
# Tests the installed completion for bash: it offers what the parser accepts, and names of layers and fields from the
# data.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
script=$SUNDER_BUILD/gis/sunder.bash
[ -f "$script" ] || { echo "skipped: nothing was made from the table of options (cross-compiled)"; exit 77; }

# Prints the sorted completions of the last word. The line is split as readline does it, also at = and : .
cat >ask.sh <<'X'
. "$0" && complete -p sunder | grep -q '_sunder sunder$' || exit 1
COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_sunder 2>&1
[ "${#COMPREPLY[@]}" -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}"
X
offered() { bash --norc -c "$(cat ask.sh)" "$script" "$@" | sort | paste -sd ' '; }

same "$(offered sunder '')" '--help --options-json --version buffer check follow merge pair plan route separate sum' commands
same "$(offered sunder se)" separate 'one command'
for command in separate check sum pair buffer route plan merge follow; do
    "$SUNDER" --options-json | python3 -c '
import json, sys
for command in json.load(sys.stdin)["commands"]:
    if command["name"] == sys.argv[1]:
        print(" ".join(sorted(o["name"] for o in command["options"] if o["group"] != "hidden")))' $command >options
    same "$(offered sunder $command -- | tr ' ' '\n' | LC_ALL=C.UTF-8 sort | paste -sd ' ')" "$(tr ' ' '\n' <options | sort | paste -sd ' ')" "options of $command"
done
same "$(offered sunder separate --gap 3 --ga)" '' 'an option once'
same "$(offered sunder separate --gap=3 --ga)" '' 'an option once'
same "$(offered sunder separate --gap = 3 --ga)" '' 'an option once'
same "$(offered sunder separate -l a --input-l)" '' 'an option once, in another spelling'
same "$(offered sunder separate --barrier a --barr)" --barrier 'one that may come again'
same "$(offered sunder separate --weight '')" '1 area sqrt-area' values
same "$(offered sunder separate --weight = s)" sqrt-area 'a value after ='
same "$(offered sunder separate --layers '')" 'conflicts displacement hidden main pushes rows symbols' 'several values'
same "$(offered sunder separate --layers main,p)" main,pushes 'the second of several values'
same "$(offered sunder pair --weight '')" '' 'a value of another command'
same "$(offered sunder buffer --shape di)" disc: shapes
same "$(offered sunder separate --gap '')" '' 'a length'
touch roads.gpkg 'two words.gpkg'
same "$(offered sunder separate --barrier ro)" roads.gpkg 'a file for an option'
same "$(offered sunder separate ro)" roads.gpkg 'a file for an operand'
same "$(offered sunder separate tw)" 'two words.gpkg' 'a file with a blank'

rm ./*.gpkg
layer in.gpkg houses POLYGON <<'X'
id,width,WKT
1,2.5,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
X
layer in.gpkg 'main roads' LINESTRING <<'X'
name,WKT
a,"LINESTRING(0 0,4 0)"
X
same "$(offered sunder separate in.gpkg out.gpkg -l '')" 'houses main\ roads' layers
same "$(offered sunder separate in.gpkg out.gpkg -l h)" houses 'one layer'
same "$(offered sunder separate in.gpkg out.gpkg -l houses --id-field '')" 'id width' fields
same "$(offered sunder separate --layer = houses in.gpkg out.gpkg --id-field w)" width 'one field'
same "$(offered sunder separate in.gpkg out.gpkg -l 'main\ roads' --id-field '')" name 'fields of a layer in quotes'
cp in.gpkg "two \"words\" \$(touch run).gpkg"
for typed in 'two\ \"words\"\ \$\(touch\ run\).gpkg' '"two \"words\" \$(touch run).gpkg"' "'two \"words\" \$(touch run).gpkg'"; do
    same "$(offered sunder separate "$typed" out.gpkg -l h)" houses "layers of $typed"
done
[ ! -e run ] || fail 'what is typed was run'
same "$(offered sunder separate in.gpkg --of GPK)" GPKG 'a format'
finish
