# shellcheck shell=bash disable=SC1091
# The end of a run: either the output, the file of --stats and standard output are all complete, or no file has changed.
# Failures occur here after all computation is done.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
echo 'of an earlier run' >s.json
echo precious >taken.dbf

# failed WORDS STDOUT ARGS: requires status 1, one line on stderr, and unchanged files.
failed() {
    local words=$1 to=$2 status=0
    shift 2
    listing >before
    "$SUNDER" "$@" >"$to" 2>err || status=$?
    listing >after
    [ "$status" -eq 1 ] || fail "exit status $status, not 1: sunder $*"
    [ "$(wc -l <err)" -eq 1 ] && grep -q '^sunder: error: ..' err || fail "not one line: sunder $*"
    says err "$words"
    cmp -s before after || fail "files changed: sunder $* $(diff before after)"
}

if [ -w /dev/full ]; then
    full='No space left on device'
    for stats in "" "--stats s.json" "--stats new.json" "--stats -"; do
        for command in "separate in.gpkg o.gpkg" "separate in.gpkg o.shp" "check in.gpkg" "check in.gpkg o.gpkg" \
            "sum square:1 square:1" "pair square:1 square:1"; do
            # shellcheck disable=SC2086 # words
            failed "$full" /dev/full $command $stats
        done
    done
    failed "$full" /dev/full sum square:1 square:1 o.gpkg --stats -
    failed "$full" /dev/full pair square:1 square:1 o.gpkg --stats -
    failed "$full" /dev/full separate in.gpkg /vsistdout/ --of GeoJSON --stats s.json
    for command in "separate in.gpkg o.gpkg" "separate in.gpkg o.shp" "check in.gpkg o.gpkg" "sum square:1 square:1 o.gpkg" \
        "pair square:1 square:1 o.gpkg" "check in.gpkg" "sum square:1 square:1" "pair square:1 square:1"; do
        # shellcheck disable=SC2086 # words
        failed "--stats: cannot write /dev/full: $full" out $command --stats /dev/full
        [ ! -s out ] || fail "something on stdout: $command"
    done
    failed "--report: cannot write /dev/full: $full" out separate in.gpkg o.gpkg --report /dev/full
    failed "--proof: cannot write /dev/full: $full" out separate in.gpkg o.gpkg --proof /dev/full --stats new.json
    failed "$full" /dev/full separate in.gpkg o.gpkg --stats new.json --report new.html --proof new.jsonl
    expect 0 separate in.gpkg kept.gpkg -q
    failed "$full" /dev/full separate in.gpkg kept.gpkg --overwrite
    failed "$full" /dev/full separate in.gpkg kept.gpkg --update --output-layer other
else
    echo "not tried: there is no /dev/full"
fi

# A file that the output would replace is found only in the last step, when the statistics are already in place: they
# are removed again.
failed 'taken.dbf' out separate in.gpkg taken.shp --stats s.json --quiet
failed 'taken.dbf' out separate in.gpkg taken.shp --stats new.json --quiet --report new.html --proof new.jsonl

refused 1 '--stats' separate in.gpkg o.gpkg --stats /proc/nothing.json
refused 2 'that is the output' separate in.gpkg o.gpkg --stats ./o.gpkg
refused 2 'that is an input' separate in.gpkg o.gpkg --stats ./in.gpkg
refused 2 'that is an input' check in.gpkg --stats in.gpkg
ogr2ogr parts.shp in.gpkg
for command in "separate parts.shp o.gpkg" "check parts.shp" "buffer parts.shp o.gpkg --shape disc:1"; do
    # shellcheck disable=SC2086 # words
    refused 2 'that is a part of the input' $command --stats parts.dbf
done
refused 2 'that is a part of the input' separate parts.shp o.gpkg --report parts.shx
refused 2 'that is a part of the input' separate parts.shp o.gpkg --proof parts.shx
echo 'POLYGON((0 0,1 0,0 1))' >p.wkt
refused 2 'that is an input' sum @p.wkt square:1 --stats p.wkt
chmod 444 s.json
[ -w s.json ] || refused 1 's.json' separate in.gpkg o.gpkg --stats s.json # (root can write every file)
chmod 644 s.json

# A successful run replaces the statistics. If the path is a symbolic link, its target is replaced and the link stays.
# No other file remains.
ln -s s.json link.json
listing | awk '{ print $NF }' | sort >before
expect 0 sum @p.wkt square:1 --stats link.json
listing | awk '{ print $NF }' | sort >after
cmp -s before after || fail "files differ from those before: $(diff before after)"
[ -L link.json ] || fail "the link was replaced"
same "$(json .command s.json)" sum "the statistics"
finish
