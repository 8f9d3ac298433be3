# shellcheck shell=bash disable=SC1091
# A run that is killed between two renames: the next run finds its stage, and puts the old files back.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
strike=$SUNDER_BUILD/tests/strike
[ -x "$strike" ] && "$strike" list 0 true 3>report 2>/dev/null || { echo "skipped: no process can be traced here"; exit 77; }
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" SOURCE_DATE_EPOCH=1700000000

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
mkdir old && expect 0 separate in.gpkg old/o.shp -q --lco DBF_DATE_LAST_UPDATE=2024-01-01
echo mine >old/o_notes.txt
files() { (cd "$1" && find . -name '.sunder-*' -prune -o -type f -print0 | sort -z | xargs -0 cksum); }
again=(separate in.gpkg dir/o.shp -q --lco DBF_DATE_LAST_UPDATE=2024-01-01)

# Each rename of a replaced set of files is tested in a fresh directory; `new` is the result of a run that is not
# killed.
rm -rf dir && cp -a old dir
expect 0 "${again[@]}" --gap 1 --overwrite
new=$(files dir)
halves=0
STRIKE_UNDER=dir
export STRIKE_UNDER
rm -rf dir && cp -a old dir
"$strike" list 0 "$SUNDER" "${again[@]}" --gap 1 --overwrite 3>report 2>/dev/null
read -r calls _ <report
# The renames are among the last calls, before the stage is removed.
for ((place = calls - 75; place <= calls; place += 9)); do
    rm -rf dir && cp -a old dir
    "$strike" kill "$place" "$SUNDER" "${again[@]}" --gap 1 --overwrite 3>report 2>/dev/null
    now=$(files dir)
    [ "$now" != "$new" ] && [ "$now" != "$(files old)" ] || continue
    halves=$((halves + 1))
    cp -al dir half # the same inodes: the next run recognizes the files of the killed run by them
    # The next run may be killed, too, while it restores: then the one after it finishes.
    "$strike" kill 3 "$SUNDER" "${again[@]}" 3>report 2>/dev/null
    run "${again[@]}"
    [ "$status" -eq 1 ] && says err 'exists already'
    [ "$(files dir)" = "$(files old)" ] || fail "place $place: the old files are not brought back"
    [ -z "$(ls -d dir/.sunder-* 2>/dev/null)" ] || fail "place $place: $(ls -d dir/.sunder-*) stays"
    rm -rf dir && mv half dir
    run "${again[@]}" --gap 1 --overwrite --log said
    [ "$status" -eq 0 ] || fail "place $place: --overwrite over what is left"
    says said 'the former files have been restored'
    [ "$(files dir)" = "$new" ] || fail "place $place: --overwrite over what is left did not come to the new files"
done
[ "$halves" -gt 1 ] || fail "only $halves places between two renames were met: the test proves nothing"

# A file of that name that was made later does not belong to the killed run: it stays.
rm -rf dir && mkdir dir
"$strike" list 0 "$SUNDER" "${again[@]}" 3>report 2>/dev/null
read -r calls _ <report
for ((place = calls - 30; place <= calls; place += 3)); do
    rm -rf dir && mkdir dir
    "$strike" kill "$place" "$SUNDER" "${again[@]}" 3>report 2>/dev/null
    [ -e dir/o_displacement.dbf ] && [ ! -e dir/o.shp ] && break
done
[ -e dir/o_displacement.dbf ] && [ ! -e dir/o.shp ] || fail "no kill among the renames of a new set"
rm -f dir/o_displacement.dbf && echo keep >dir/o_displacement.dbf
run separate in.gpkg dir/o.shp -q --layers main
same "$(cat dir/o_displacement.dbf)" keep 'a file that came later'
[ "$status" -eq 0 ] && [ -e dir/o.shp ] || fail "the remains of the killed run make the next one fail"

# If another file has appeared in the place of a replaced one, it is not overwritten: both stay, and a message says so.
rm -rf dir && mkdir -m 700 dir dir/.sunder-abcdef dir/.sunder-abcdef/superseded~
printf 'main o.shp\nold o.shp\nnew 1 o.dbf\n' >dir/.sunder-abcdef/record~
touch dir/.sunder-abcdef/o.dbf
echo former >dir/.sunder-abcdef/superseded~/o.shp && echo later >dir/o.shp
run "${again[@]}" --overwrite
same "$status" 1 "a file that came to the place of one that stepped aside"
says err 'a file of that name has appeared there since'
same "$(cat dir/o.shp dir/.sunder-abcdef/superseded~/o.shp)" $'later\nformer' "a file that appeared in the place of a replaced one"

# A stage of a running process is not touched.
rm -rf dir && mkdir -p -m 700 dir/.sunder-abcdef && chmod 700 dir/.sunder-abcdef && printf 'main o.shp\nold o.shp\nnew 1 o.dbf\n' >dir/.sunder-abcdef/record~
touch dir/.sunder-abcdef/o.dbf
if command -v flock >/dev/null; then
    flock dir/.sunder-abcdef "$SUNDER" "${again[@]}" 2>err || fail "a stage in use makes another run fail"
    [ -e dir/.sunder-abcdef/record~ ] || fail "a stage in use was taken away"
fi
finish
