# shellcheck shell=bash disable=SC1091
# The names of the stages of a separation: computing reasons, requirements and bounds is `explain`, exact checks are
# `verify`. They appear in the seconds of --stats, in the bar of --progress and in the report, for a layer in memory and
# for one in parts.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
names='read solve explain verify write'

# Many conflicts remain, and for each the program computes what would resolve it.
# (tests/unit/displacement/test_separate_layer_stages.c tests by counting steps that this happens in the stage
# `explain`; no verdict may depend on time.)
expect 3 separate "$town" o.gpkg -l buildings --gap 3 --max-shift 1 --effort 3 --stats s.json --progress --report r.html
same "$(jq -r '.seconds | keys_unsorted | join(" ")' s.json)" "$names total" 'stages of --stats:'
jq -e '.seconds | .explain > 0 and .verify > 0 and .solve > 0' s.json >/dev/null || fail "a stage took no time: $(jq -c .seconds s.json)"
jq -e '.seconds | .total >= .read + .solve + .explain + .verify + .write - 1e-6' s.json >/dev/null ||
    fail "the stages overlap: $(jq -c .seconds s.json)"
same "$(tr -cd 'a-z ' <err | xargs)" "$names done" 'stages in the bar:'
same "$(tr -d 'a-z ' <err)" '0...10...20...30...40...50...60...70...80...90...100-.' 'the bar without them:'
same "$(grep -o '<dt>seconds</dt><dd>.*</dd>' r.html | sed 's/<[^>]*>//g' | tr -cd 'a-z ' | xargs)" "seconds$names" 'the report:'
SOURCE_DATE_EPOCH=1 "$SUNDER" separate "$town" same.gpkg -l buildings --gap 3 --max-shift 1 --report same.html -q --allow-conflicts
grep -q '<dt>seconds</dt>' same.html && fail 'seconds on a page that has to be the same for each run'

# The format of percentages for programs has not changed.
expect 3 separate "$town" plain.gpkg -l buildings --gap 3 --max-shift 1 --effort 0 --progress=plain
cmp -s err <(seq 0 100) || fail 'percents, a line each'

expect 3 separate "$town" parts.gpkg -l buildings --gap 3 --max-shift 1 --max-memory 200M --stats p.json -q
jq -e '.seconds | .explain > 0 and .verify > 0 and .solve > 0' s.json >/dev/null || fail "a stage took no time: $(jq -c .seconds s.json)"
finish
