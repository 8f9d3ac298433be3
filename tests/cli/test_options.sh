# shellcheck shell=bash disable=SC1091
# --options-json, from which other programs learn the options, agrees with --help and the parser.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }

expect 0 --options-json
[ ! -s err ] || fail "--options-json writes to stderr"
mv out options.json
refused 2 'unknown option' separate --options-json a b

for command in separate check sum pair buffer route plan merge follow; do "$SUNDER" $command --help >help.$command; done
python3 "$SUNDER_SOURCE/tests/cli/options.py" help <options.json >said || fail "$(cat said)"

# Each option is passed to the parser alone, in all of its spellings, to find out whether it takes a value and whether
# it may be repeated.
python3 "$SUNDER_SOURCE/tests/cli/options.py" calls <options.json >calls || fail "cannot make the list of calls"
[ "$(wc -l <calls)" -ge 300 ] || fail "only $(wc -l <calls) calls"
cut -f 2- calls | tr '\t' ' ' | "$SUNDER_BUILD/tests/calls" >answers || fail "calls ends with $?"
same "$(wc -l <answers)" "$(wc -l <calls)" 'answers to all calls:'
paste calls answers >asked
while IFS=$'\t' read -r words command option status said; do
    [ "$status" -eq 2 ] || fail "$command $option: status $status"
    [[ $said =~ $words ]] || fail "$command $option: not '$words', but '$said'"
done <asked

# Options that only change what another option does: each is refused by itself, and accepted beside any option that it
# needs ("needs" of --options-json, for each command).
json '.commands[] | .name as $command | .options[] | select(.needs != [])
    | [$command, .name, if .kind == "flag" then .name elif .values then .name + "=" + .values[0] else .name + "=1" end] + .needs | @tsv' \
    options.json | grep -v '^plan' >alone
same "$(cut -f 1,2,4- alone | tr '\t' ' ')" "separate --prefer-dx --prefer-dy
separate --prefer-dy --prefer-dx
separate --previous-relax --previous
separate --links-radius --links
separate --hierarchy-field --hide
separate --hide-weight --hide
separate --drop-hidden --hide
separate --trim-keep --trim
separate --min-size --trim --inset --enlarge --symbol-size
separate --enlarge --min-size
separate --rigid-where --trim --inset --enlarge --symbol-size
separate --crossed --hide --trim --inset --enlarge --symbol-size
separate --symbol-size-field --symbol --symbol-field
separate --print-spec --spec
separate --dialect --sql
separate --overwrite-layer --update
check --hierarchy-field --hidden-field
check --trim-keep --trim
check --min-size --trim --inset --enlarge --symbol-size
check --enlarge --min-size
check --rigid-where --trim --inset --enlarge --symbol-size
check --crossed --hidden-field --trim --inset --enlarge --symbol-size
check --symbol-size-field --symbol --symbol-field
check --print-spec --spec
check --dialect --sql
check --overwrite-layer --update
sum --dialect --sql
sum --overwrite-layer --update
pair --dialect --sql
pair --overwrite-layer --update
buffer --dialect --sql
buffer --overwrite-layer --update
route --dialect --sql
route --overwrite-layer --update
follow --dialect --sql
follow --overwrite-layer --update" 'options that need others:'
while IFS=$'\t' read -r command option words needs; do
    operands="a b"
    [ "$command" = follow ] && operands+=" c"
    listed=${needs//$'\t'/, }
    case $listed in *,*) listed="${listed%, *} or ${listed##*, }" ;; esac
    printf '%s\t%s\n' "$option needs $listed" "$command $operands $words"
    for other in $needs; do
        case $other in --hide | --trim | --enlarge | --update) ;; *) other+==1 ;; esac
        printf '!%s needs\t%s\n' "$option" "$command $operands $words $other"
    done
done <alone >tried
cut -f 2 tried | "$SUNDER_BUILD/tests/calls" >answers || fail "calls ends with $?"
same "$(wc -l <answers)" "$(wc -l <tried)" 'answers to all calls:'
paste tried answers >asked
while IFS=$'\t' read -r words call status said; do
    case $words in
    !*) case $said in *"${words#!}"*) fail "$call: $said" ;; esac ;;
    *) case $status,$said in "2,sunder: error: $words "*) ;; *) fail "$call: $status, $said" ;; esac ;;
    esac
done <asked

# If a required option is missing, the message names it and no other.
layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
X
refused 2 'needs INPUT OUTPUT' separate in.gpkg
refused 2 '--shards N is missing' plan in.gpkg in.plan
refused 2 '--shape is missing' buffer in.gpkg out.gpkg
refused 2 '--robot SHAPE is missing' route square:1 --from 5,5 --to 6,6
refused 2 '--from X,Y is missing' route square:1 --robot square:1 --to 6,6
refused 2 '--to X,Y is missing' route square:1 --robot square:1 --from 5,5
same "$(json '[.commands[].options[] | select(.needed) | .name] | sort | join(" ")' options.json)" \
    '--from --robot --shape --shards --to' 'needed:'
same "$(json '[.commands[] | .name + ":" + ([.operands[] | select(.needed) | .name] | join(","))] | join(" ")' options.json)" \
    'separate:INPUT,OUTPUT check:INPUT sum:P,Q pair:P,Q buffer:INPUT,OUTPUT route:OBSTACLES plan:INPUT,PLAN merge:PLAN,OUTPUT follow:MOVED,INPUT,OUTPUT' 'operands:'

# Giving a default explicitly changes nothing.
expect 0 separate in.gpkg plain.gpkg --quiet
mapfile -t typed < <(json '.commands[] | select(.name == "separate") | .options[] | select(.default != null and .needs == []) | .name + "=" + .default' options.json)
[ "${#typed[@]}" -ge 6 ] || fail "only ${#typed[@]} defaults"
expect 0 separate in.gpkg typed.gpkg --quiet "${typed[@]}"
same "$(ogrinfo -q typed.gpkg houses)" "$(ogrinfo -q plain.gpkg houses)" 'typed defaults'
finish
