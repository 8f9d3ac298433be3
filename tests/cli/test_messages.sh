# shellcheck shell=bash disable=SC1091,SC2016
# Messages of long runs: they name layer and FID, many of one kind are summed up, a log contains all of them, JSON has
# their parts as separate keys; progress is shown on terminals only, and --quiet prints nothing.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }

# 25 invalid rings, far apart, and one valid one.
{
    echo id,WKT
    for i in $(seq 1 25); do echo "k$i,\"POLYGON(($((10 * i)) 0,$((10 * i + 4)) 4,$((10 * i + 4)) 0,$((10 * i)) 4,$((10 * i)) 0))\""; done
    echo 'k26,"POLYGON((0 50,4 50,4 54,0 54,0 50))"'
} | layer in.gpkg houses POLYGON
layer sound.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
X

expect 0 check in.gpkg
same "$(wc -l <err)" 11 'ten warnings and their sum:'
same "$(grep -c '^sunder: warning: layer houses, FID [0-9]*: ' err)" 10 'warnings that name layer and FID:'
says err 'sunder: warning: 15 more like these, the first of them: layer houses, FID 11: '
says err '--log FILE keeps all'
expect 0 check --where "id <> 'k1'" in.gpkg --bbox 0,0,104,99 # the ten invalid ones in the box, without the first
same "$(wc -l <err)" 9 'few warnings:'
expect 0 buffer in.gpkg out.gpkg --shape square:1
same "$(wc -l <err)" 11 'of buffer:'
expect 0 route in.gpkg --robot square:1 --from 0,-9 --to 400,-9
same "$(wc -l <err)" 11 'of route:'
expect 0 check --barrier in.gpkg,gap=20 --where "id = 'k26'" in.gpkg --ignore-where "id = 'k26'"
expect 3 separate --barrier in.gpkg --gap 300 --max-shift 0 sound.gpkg out.gpkg --overwrite
same "$(grep -c 'barrier in.gpkg, layer houses, FID' err)" 11 'of a barrier:'
# Messages about one layer do not suppress those about another.
expect 0 separate --barrier in.gpkg,width=1 --where "id = 'k1'" in.gpkg out.gpkg --overwrite
same "$(grep -c 'warning: layer houses' err) $(grep -c 'barrier in.gpkg, layer houses, FID' err)" '1 11' 'of a layer and a barrier:'
expect 0 separate --barrier in.gpkg,width=1,gap=1 in.gpkg out.gpkg --overwrite --contained ignore --max-shift 0 --allow-conflicts
same "$(grep -c 'warning: layer houses' err)" 10 'of the layer:'
same "$(grep -c 'barrier in.gpkg, layer houses, FID' err)" 11 'of the barrier, too:'
same "$(grep -c '15 more like these' err)" 2 'a sum each:'
# An error comes last, after the sum.
expect 1 separate in.gpkg no/such/out.gpkg
same "$(wc -l <err)" 12 'with an error:'
tail -n 1 err | grep -q '^sunder: error: ' || fail 'the error is not the last line'
# A missing option or field is reported before any message about features.
for option in --id-field --block-field --max-shift-field --weight-field; do
    expect 1 separate in.gpkg never.gpkg $option nowhere
    same "$(wc -l <err)" 1 "lines about $option:"
    says err "sunder: error: $option: layer houses has no field nowhere"
done

# --quiet.
expect 0 separate in.gpkg quiet.gpkg --quiet
[ ! -s out ] && [ ! -s err ] || fail "--quiet says: $(cat out err | head -3)"
expect 0 separate in.gpkg quiet.gpkg --quiet --progress --overwrite --log all.log
[ ! -s out ] && [ ! -s err ] || fail "--quiet --progress says: $(cat out err | head -3)"
same "$(grep -c '^sunder: warning: layer houses, FID [0-9]*: ' all.log)" 25 'warnings in the log:'
same "$(wc -l <all.log)" 25 'lines of the log:'
expect 1 separate in.gpkg quiet.gpkg --quiet
says err 'sunder: error: '

# The log contains all messages, also the one that ended the run; it never replaces another file.
expect 0 check in.gpkg --log all.log --id-field id
says err 'all are in the log'
same "$(wc -l <err)" 11 'with a log:'
same "$(sed -n 12p all.log | cut -d: -f1-3)" 'sunder: warning: layer houses, FID 12 (id k12)' 'a line of the log:'
expect 1 separate in.gpkg out.gpkg --log all.log
same "$(tail -n 1 all.log)" "$(tail -n 1 err)" 'the error in the log:'
tail -n 1 all.log | grep -q '^sunder: error: ' || fail 'the log does not hold the error'
expect 0 check sound.gpkg --log all.log
[ -f all.log ] && [ ! -s all.log ] || fail 'a log of nothing is not empty'
echo 'sunder: important' >notes.txt
refused 2 'is not a log' check sound.gpkg --log notes.txt
refused 2 'has another use in this run' check sound.gpkg --log sound.gpkg
refused 2 'has another use in this run' separate sound.gpkg new.gpkg --log ./new.gpkg
refused 2 'has another use in this run' separate sound.gpkg new.gpkg --stats all.log --log all.log
refused 2 'has another use in this run' separate sound.gpkg new.gpkg --barrier in.gpkg,width=2 --log in.gpkg
refused 1 'cannot write no/such/a.log' check sound.gpkg --log no/such/a.log
if [ -w /dev/full ]; then
    expect 1 check in.gpkg --log /dev/full -q
    says err '--log: cannot write /dev/full'
fi
# A message to a closed stream is dropped; it is not written into a file that got the stream's number.
status=0
"$SUNDER" check in.gpkg --log closed.log >&- 2>&- || status=$?
same "$status $(grep -c '^sunder: ' closed.log) $(wc -l <closed.log)" '1 26 26' 'a log when streams are closed:'
status=0
"$SUNDER" separate in.gpkg closed.geojson --of GeoJSON --log closed.log -q <&- >&- 2>&- || status=$?
[ $status -eq 0 ] && ogrinfo -q -al -so closed.geojson >said 2>&1 || fail "an output when streams are closed: $status"
expect 0 check in.gpkg --log /dev/stdout -q
same "$(wc -l <out)" 25 'a log on standard output:'

# JSON: each line is an object with the same keys, features are given by layer and FID.
expect 0 check in.gpkg --messages json --id-field id
python3 - <<'X' || fail 'JSON of warnings'
import json
lines = [json.loads(line) for line in open("err")]
keys = ["level", "kind", "layer", "fid", "id", "count", "message"]
assert len(lines) == 11 and all(list(line) == keys for line in lines), lines
for i, line in enumerate(lines[:10]):
    assert (line["level"], line["kind"], line["layer"], line["fid"], line["id"], line["count"]) == \
        ("warning", "invalid", "houses", i + 1, "k%d" % (i + 1), 1), line
assert lines[10]["count"] == 15 and lines[10]["kind"] == "invalid" and lines[10]["fid"] is None, lines[10]
X
json_error() { # KIND STATUS WORDS ARGS: the run prints one line, an error
    local kind=$1 wanted=$2 words=$3
    shift 3
    expect "$wanted" "$@"
    same "$(json '[.level, .kind, .exit_status, .count] | join(" ")' err)" "error $kind $wanted 1" "sunder $*"
    says err "$words"
}
json_error usage 2 'did you mean' chek in.gpkg --messages json
json_error usage 2 'unknown option' check --messages=json in.gpkg --nonsense
json_error usage 2 'must be one of' check in.gpkg --messages json --contained maybe
json_error failed 1 'no such file' check none.gpkg --messages json
json_error failed 1 'FID 1' check in.gpkg --invalid fail --messages json
same "$(json '[.layer, .fid] | join(" ")' err)" 'houses 1' 'the feature of an error:'
expect 0 check in.gpkg --messages json --log all.log -q
[ "$(json .message all.log | wc -l)" -eq 25 ] || fail 'the log is not JSON'
expect 0 check in.gpkg --log all.log -q # replaces a log in the other form
printf 'id,WKT\n1,"POLYGON((0 0,4 4,4 0,0 4,0 0))"\n' >$'a\xffb.csv'
ogr2ogr broken.gpkg $'a\xffb.csv' -nln x -oo GEOM_POSSIBLE_NAMES=WKT -nlt POLYGON 2>/dev/null
expect 1 check $'none\xff.gpkg' --messages json
json .message err >said || fail 'no JSON where a name is not UTF-8'

# Unusual names: with line breaks, cut in the middle of a character, invalid in UTF-8.
odd_name() { # PYTHON: an expression for the name of the layer and the key
    python3 - "$1" <<'X' || fail "JSON with $1"
import json, os, subprocess, sys
name = eval(sys.argv[1])
with open("odd.csv", "wb") as file:
    file.write(b'id,WKT\n"' + name + b'","POLYGON((0 0,4 4,4 0,0 4,0 0))"\n')
if os.path.exists("odd.gpkg"):
    os.remove("odd.gpkg")
subprocess.run(["ogr2ogr", "odd.gpkg", "odd.csv", "-oo", "GEOM_POSSIBLE_NAMES=WKT", "-nlt", "POLYGON", "-nln", b"l" + name],
               check=True, stderr=subprocess.DEVNULL)
call = [os.environ["SUNDER"], "check", "odd.gpkg", "--id-field", "id", "--messages", "json", "--stats", "odd.json"]
said = subprocess.run(call, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, check=True).stderr.decode("utf-8")
line = json.loads(said)
whole = name.decode("utf-8")
assert line["fid"] == 1 and (line["layer"] == "l" + whole or len(name) > 400), line
assert line["id"] == whole or (len(name) > 400 and whole.startswith(line["id"][:200])), line
json.load(open("odd.json", encoding="utf-8"))
X
}
odd_name 'b"a\nb\tc"'
odd_name '"\u00e9\U0001f3e0".encode()'
odd_name '("\u00e9" * 600).encode()'
odd_name '("a" + "\u00e9" * 600).encode()'
printf 'id,WKT\nk\xff\xed\xa0\x80,"POLYGON((0 0,4 4,4 0,0 4,0 0))"\n' >$'odd\xfe.csv'
expect 0 check $'odd\xfe.csv' --oo GEOM_POSSIBLE_NAMES=WKT --id-field id --messages json
python3 - <<'X' || fail 'JSON with bytes that are no UTF-8'
import json
line = json.loads(open("err", encoding="utf-8").read())
assert (line["layer"], line["fid"], line["id"]) == ("odd\ufffd", 1, "k" + 4 * "\ufffd"), line
X

# Messages of GDAL that differ only in numbers are of one kind. (GDAL 3.10 does not print this one.)
{
    echo id,n,WKT
    for i in $(seq 1 25); do echo "$i,12345678901234567890123$i,\"POLYGON(($((10 * i)) 0,$((10 * i + 4)) 0,$((10 * i + 4)) 4,$((10 * i)) 0))\""; done
} >wide.csv
echo 'Integer64,Integer64,WKT' | sed 's/[^,]*/"&"/g' >wide.csvt
expect 0 check wide.csv --oo GEOM_POSSIBLE_NAMES=WKT
if ogrinfo -ro -al -q wide.csv -oo GEOM_POSSIBLE_NAMES=WKT 2>&1 | grep -q overflow; then
    same "$(grep -c overflow err)" 11 "of GDAL's own:"
    same "$(tail -n 1 err | cut -d' ' -f3-8)" '15 more like these, the first' "the sum of GDAL's own:"
fi

# A progress bar is printed if stderr is a terminal; there is no other difference.
on_terminal() {
    python3 - "$SUNDER" "$@" <<'X'
import os, pty, subprocess, sys
outer, inner = pty.openpty()
run = subprocess.Popen(sys.argv[1:], stdout=open("out", "wb"), stderr=inner, stdin=subprocess.DEVNULL)
os.close(inner)
said = b""
while True:
    try:
        some = os.read(outer, 65536)
    except OSError:
        break
    if not some:
        break
    said += some
open("err", "wb").write(said.replace(b"\r\n", b"\n"))
sys.exit(run.wait())
X
}
# A root directory without devices has no pseudo-terminals.
if python3 -c 'import pty; pty.openpty()' 2>/dev/null; then
    on_terminal check sound.gpkg || fail 'on a terminal'
    same "$(cat err)" '0...10...20...30...40...50...60...70...80...90...100 - done.' 'a bar on a terminal:'
    on_terminal check sound.gpkg -q || fail 'on a terminal'
    same "$(cat err)" '' 'quiet on a terminal:'
    on_terminal check sound.gpkg --messages json || fail 'on a terminal'
    same "$(cat err)" '' 'JSON on a terminal:'
    on_terminal check sound.gpkg --progress=plain || fail 'on a terminal'
    same "$(wc -l <err)" 101 'plain on a terminal:'
    on_terminal sum square:1 square:1 || fail 'on a terminal'
    same "$(cat err)" '' 'no layer, no bar:'
    on_terminal check in.gpkg || fail 'on a terminal'
    same "$(grep -c '^sunder: warning: ' err)" 11 'warnings begin lines on a terminal:'
fi
expect 0 check sound.gpkg
[ ! -s err ] || fail 'a progress bar without a terminal'
expect 0 check sound.gpkg --progress
same "$(cat err)" '0...10...20...30...40...50...60...70...80...90...100 - done.' '--progress without a terminal:'
finish
