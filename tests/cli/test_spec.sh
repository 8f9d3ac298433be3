# shellcheck shell=bash disable=SC1091
# --spec: gaps by classes as the sheet says, judged by an independent reader; a sheet with one gap is the same run as the
# options; the command line overrides the sheet; mistakes name their place in the file.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0
worlds() { python3 "$SUNDER_SOURCE/tests/cli/spec_worlds.py" "$@" || fail "spec_worlds.py $1"; }

# ---- Gaps by classes
any=0
for seed in 1 2 3 4; do
    rm -f town.gpkg
    worlds make town.gpkg sheet.json $seed
    expect 0 separate --spec sheet.json result.gpkg --overwrite -q --allow-conflicts --stats stats.json
    read -r pairs near found listed < <(worlds judge result.gpkg town.gpkg sheet.json)
    [ "$near" = "$found" ] && [ "$listed" = "$found" ] || fail "seed $seed: $near of $pairs pairs are too near, $listed are listed"
    any=$((any + near))
    same "$(jq -c '.spec.layers[0].name' stats.json)" '"moved"' 'the sheet in the statistics:'
    # Whoever moved it: the check of the result finds the same pairs, and no move that breaks a rule.
    expect 0 check --spec sheet.json result.gpkg --block-field sunder_blk --allow-conflicts --stats check.json
    same "$(jq -c .conflicts.after stats.json)" "$(jq -c .conflicts check.json)" "seed $seed:"
    expect 0 check --spec sheet.json result.gpkg --block-field sunder_blk --allow-conflicts --before town.gpkg --stats check.json
    same "$(jq -c '.moves | del(.matched) | add' check.json)" 0 "seed $seed, moves:"
done
[ "$any" -gt 0 ] || fail "no pair remained too near, so that the list was not asked"

# ---- In parts: the same bytes, with proofs
for how in whole parts; do
    more=()
    [ $how = parts ] && more=(--max-memory 110M)
    expect 0 separate --spec sheet.json $how.gpkg -q --allow-conflicts --proof $how.jsonl "${more[@]}"
done
expect 0 plan --spec sheet.json plan.dir --shards 2 -q --allow-conflicts --proof shards.jsonl --report merged.html
for k in 1 2; do expect 0 separate --shard $k plan.dir -q; done
mv sheet.json kept.json # a plan does not need it again
expect 0 merge plan.dir shards.gpkg -q --stats merged.json
mv kept.json sheet.json
# The sheet stands in the statistics, in the proof and on the page, of a merge, too, with the options of the run in it.
expect 0 separate --spec sheet.json paged.gpkg -q --allow-conflicts --max-shift 2 --stats paged.json --report paged.html --proof paged.jsonl
expect 0 separate --spec sheet.json --print-spec --max-shift 2
same "$(jq -cS .spec paged.json)" "$(jq -cS . out)" 'the sheet in the statistics:'
same "$(head -1 paged.jsonl | jq -cS .spec)" "$(jq -cS . out)" 'the sheet in the proof:'
same "$(jq -cS .spec merged.json)" "$(head -1 whole.jsonl | jq -cS .spec)" 'the sheet of a merge:'
for page in paged merged; do
    grep -q 'Specification</summary>' $page.html || fail "$page.html lacks the sheet"
done
python3 - paged.html >from_page.json <<'X' || fail "the sheet on the page"
import html, re, sys
print(html.unescape(re.search(r"<summary>Specification</summary>\s*<pre>(.*?)</pre>", open(sys.argv[1], encoding="utf-8").read(), re.S)[1]))
X
same "$(jq -cS . from_page.json)" "$(jq -cS . out)" 'the sheet on the page:'
for how in parts shards; do
    cmp -s whole.gpkg $how.gpkg || fail "$how: other bytes"
    cmp -s whole.jsonl $how.jsonl || fail "$how: another proof"
done
same "$(jq -c '.gaps.class' plan.dir/plan.json)" '{"field":"kind"}' 'the gaps of the plan:'
jq '.gaps[-1].gap += 0.25' < <(sed 1d sheet.json) >other.json
expect 1 plan --spec other.json plan.dir --shards 2 -q --allow-conflicts --proof shards.jsonl --report merged.html
grep -q 'another command line' err || fail "a plan of other gaps: $(cat err)"

# ---- Several layers that move: each as it came, with what its own gaps and rules say
any=0
for seed in $(seq $((4 * ${SUNDER_TEST_SCALE:-1}))); do
    rm -f town2.gpkg
    worlds make town2.gpkg sheet2.json $seed together
    expect 0 separate --spec sheet2.json together.gpkg --overwrite -q --allow-conflicts --stats stats.json --report page.html
    read -r pairs near found listed < <(worlds judge together.gpkg town2.gpkg sheet2.json)
    [ "$near" = "$found" ] && [ "$listed" = "$found" ] || fail "together $seed: $near of $pairs pairs are too near, $listed are listed"
    any=$((any + near))
    worlds kept together.gpkg town2.gpkg sheet2.json
    same "$(jq -c '[.layer, .verified, ([.layers[].features] | add) == .features]' stats.json)" '["sheet2",true,true]' "together $seed:"
    expect 0 check --spec sheet2.json together.gpkg --allow-conflicts --stats check.json --report check.html
    same "$(jq -c .conflicts.after stats.json)" "$(jq -c .conflicts check.json)" "together $seed:"
done
[ "$any" -gt 0 ] || fail "no pair of several layers remained too near, so that the list was not asked"
same "$(ogrinfo -q together.gpkg | sed 's/^[0-9]*: //; s/ (.*//' | tr '\n' ' ')" \
    'marks moved sheds sheet2_displacement sheet2_conflicts sheet2_pushes marks_symbols layer_styles ' 'the layers:'
expect 0 separate --spec sheet2.json named.gpkg -q --allow-conflicts --output-layer all --layers main,conflicts
same "$(ogrinfo -q named.gpkg | sed 's/^[0-9]*: //; s/ (.*//' | tr '\n' ' ')" 'marks moved sheds all_conflicts layer_styles ' 'named layers:'
expect 0 separate --spec sheet2.json named.gpkg -q --allow-conflicts --update --overwrite-layer --layers main
expect 1 separate --spec sheet2.json named.gpkg -q --allow-conflicts --update
grep -q 'has a layer marks already' err || fail "$(cat err)"
expect 1 separate --spec sheet2.json together.shp -q --allow-conflicts
grep -q 'holds one layer a file' err || fail "$(cat err)"

# The numbers of an agency: two layers that move, roads of five widths, what has no room is left out by its class.
cp "$SUNDER_SOURCE/docs/examples/topographic_100000.json" agency.json
any=0
for seed in 1 2; do
    rm -f town.gpkg.kept && mv town.gpkg town.gpkg.kept
    worlds make_agency town.gpkg $seed
    expect 0 separate --spec agency.json agency.gpkg --overwrite -q --allow-conflicts --effort 0.1 --stats stats.json
    read -r pairs near found listed < <(worlds judge agency.gpkg town.gpkg agency.json)
    [ "$near" = "$found" ] && [ "$listed" = "$found" ] || fail "agency $seed: $near of $pairs pairs are too near, $listed are listed"
    [ "$(jq '.conflicts.before | add' stats.json)" -gt 40 ] || fail "agency $seed: hardly a conflict"
    any=$((any + $(jq .hidden.count stats.json)))
    mv town.gpkg.kept town.gpkg
done
[ "$any" -gt 0 ] || fail "nothing was left out"

# Only the layer that says so is hidden. In each of two layers two houses overlap, and can hardly move.
for k in 0 1; do
    printf 'WKT,name\n"POLYGON((%d00 0,%d10 0,%d10 10,%d00 10,%d00 0))",a\n"POLYGON((%d04 0,%d16 0,%d16 10,%d04 10,%d04 0))",b\n' \
        $k $k $k $k $k $k $k $k $k $k | layer pair$k.gpkg pair$k POLYGON
done
cat >pairs.json <<'JSON'
{"defaults": {"gap": 1, "max_shift": 0.1, "no_blocks": true, "contained": "separate"},
 "layers": [{"name": "p0", "source": "pair0.gpkg", "role": "move"}, {"name": "p1", "source": "pair1.gpkg", "role": "move"}]}
JSON
for k in 0 1; do
    jq ".layers[$k] += {hide: true, drop_hidden: true}" pairs.json >hides.json
    expect 0 separate --spec hides.json hidden.gpkg --overwrite -q --allow-conflicts --stats stats.json
    same "$(jq -c '[(.layers[] | select(.hidden) | .name), .hidden.count, .conflicts.after.overlap]' stats.json)" "[\"p$k\",1,1]" "hiding p$k:"
    same "$(for of in p0 p1; do ogrinfo -so hidden.gpkg $of; done | grep -o 'Count: .*' | tr '\n' ' ')" \
        "Count: $((k + 1)) Count: $((2 - k)) " "hiding p$k, features:"
done

# ---- One gap: the same bytes as the options
cat >one.json <<'JSON'
{"scale": "1:10000", // metres of the ground: 0.2 mm are 2 m
 "defaults": {"gap": "0.2mm", "max_shift": 8, "no_blocks": true, "row_stiffness": [4, 0.5]},
 "layers": [{"name": "houses", "source": "town.gpkg", "layer": "houses", "role": "move"},
            {"name": "roads", "source": "town.gpkg", "layer": "roads", "role": "barrier", "width": 4}]}
JSON
options=(--scale 10000 --gap 0.2mm --max-shift 8 --no-blocks --row-stiffness 4,0.5)
expect 0 separate --spec one.json by_sheet.gpkg -q --allow-conflicts
expect 0 separate town.gpkg by_options.gpkg -q --allow-conflicts --input-layer houses --output-layer houses "${options[@]}" \
    --barrier town.gpkg,layer=roads,width=4
cmp -s by_sheet.gpkg by_options.gpkg || fail "a sheet with one gap has other bytes than the options"
# From elsewhere paths are relative to the sheet; options of the command line override it.
mkdir -p there
(cd there && "$SUNDER" separate --spec ../one.json ../by_path.gpkg -q --allow-conflicts) || fail "another directory"
cmp -s by_sheet.gpkg by_path.gpkg || fail "the sheet from another directory has other bytes"
expect 0 separate --spec one.json other.gpkg -q --allow-conflicts --gap 1 --max-shift 3
expect 0 separate town.gpkg other_options.gpkg -q --allow-conflicts --input-layer houses --output-layer houses \
    --scale 10000 --gap 1 --max-shift 3 --no-blocks --row-stiffness 4,0.5 --barrier town.gpkg,layer=roads,width=4
cmp -s other.gpkg other_options.gpkg || fail "options do not override the sheet"
expect 0 separate --spec one.json --print-spec --gap 1 --no-blocks --scale 5000
same "$(jq -c '[.scale, .layers[0].gap, .layers[0].no_blocks, .layers[1].width]' out)" '[5000,"1",true,4]' 'the effective sheet:'
# Rules for smaller and larger shapes are rules for moves, which check without --before passes over.
sed 's|//.*||' one.json | jq '.defaults += {enlarge: true, min_size: "0.2mm", rigid_where: "fid = 1", gap: 0}' >larger.json
expect 0 check --spec larger.json --allow-conflicts -q
"$SUNDER" --spec-schema >schema.json || fail "--spec-schema"
same "$(jq -c '[.required, .properties.gaps.items.required, .properties.layers.items.properties.max_shift.type[0]]' schema.json)" \
    '[["layers"],["between"],"string"]' 'the schema:'
for key in $(sed 's|//.*||' one.json | jq -r '.layers[0] | keys[]'); do
    jq -e --arg k "$key" '.properties.layers.items.properties[$k]' schema.json >/dev/null || fail "the schema lacks $key"
done

# ---- Widths and classes by a field, in formats whose conditions GDAL evaluates
ogr2ogr -q -lco ENCODING=UTF-8 roads.shp town.gpkg roads
jq '.layers[1].source = "roads.shp" | del(.layers[1].layer)' < <(sed 1d sheet.json) >shape.json
expect 0 separate --spec sheet.json from_gpkg.gpkg -q --allow-conflicts --layers main
expect 0 separate --spec shape.json from_shp.gpkg -q --allow-conflicts --layers main
cmp -s from_gpkg.gpkg from_shp.gpkg || fail "roads of a shapefile have other widths or classes"

# ---- What is wrong
wrong() { # WORDS FILTER: of one.json
    sed 's|//.*||' one.json | jq "$2" >wrong.json
    expect 2 separate --spec wrong.json no.gpkg
    grep -qF -- "$1" err || fail "$2: $(cat err)"
    [ ! -e no.gpkg ] || fail "$2: an output"
}
wrong 'layers[0]: there is no key max_shfit, did you mean max-shift?' '.layers[0].max_shfit = 3'
wrong 'defaults.max_shift: --max-shift 3 parsecs' '.defaults.max_shift = "3 parsecs"'
wrong 'layers: none has the role move' 'del(.layers[0])'
wrong 'two layers that move have the name houses' '.layers[2] = .layers[0]'
wrong 'layers[2]: "name" is missing' '.layers[2] = .layers[0] | del(.layers[2].name)'
wrong 'layers[2]: gap holds for all layers that move: put it into "defaults"' \
    '.layers[2] = .layers[0] | .layers[2].name = "more" | .layers[2].gap = 3'
wrong 'not with several layers that move: --enlarge' \
    '.layers[2] = .layers[0] | .layers[2].name = "more" | .layers[2] += {enlarge: true, min_size: 3}'
wrong 'layers[1]: "source" is missing' 'del(.layers[1].source)'
wrong 'layers[1]: "role" must be' '.layers[1].role = "wall"'
wrong 'no layer has the class road; did you mean roads?' '.gaps = [{"between": ["road", "*"], "gap": 1}]'
wrong 'gaps[0]: "between" must be' '.gaps = [{"gap": 1}]'
wrong 'gaps[0].gap: -1' '.gaps = [{"between": ["*", "*"], "gap": -1}]'
wrong 'the least gap, 3, is greater than the gap, 2' '.gaps = [{"between": ["houses", "roads"], "gap": 2, "least": 3}]'
wrong 'gaps: 1024 classes; at most 1023' '.gaps = [range(1024) | {"between": ["k\(.)", "*"], "gap": 1}] | .layers[0].class = {"field": "kind"}'
wrong 'layers[1].width: must be a length' '.layers[1].width = {"by": "class"}'
wrong 'must be true or false' '.defaults.no_blocks = "yes"'
printf '{"layers": [\n1 2]}' >wrong.json
expect 2 separate --spec wrong.json no.gpkg
grep -q 'wrong.json: line 2' err || fail "$(cat err)"
{ cat one.json && echo 'and more'; } >wrong.json
expect 2 separate --spec wrong.json no.gpkg
grep -q 'text after the end' err || fail "$(cat err)"
cp one.json kept.json
expect 2 separate --spec kept.json no.gpkg --stats kept.json
cmp -s one.json kept.json || fail "the statistics replaced the sheet"
expect 1 separate --spec none.json no.gpkg
expect 2 separate --spec one.json town.gpkg no.gpkg
grep -q 'leave out INPUT' err || fail "$(cat err)"
finish
