# shellcheck shell=bash
# Every vector driver of GDAL that can create data writes the output of separate, check and buffer for a small layer
# with unusual fields. Either the run succeeds, and its output can be read and all losses were reported, or it is
# refused before the computation with a message that names the cause.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
command -v jq >/dev/null || { echo "skipped: jq is not installed"; exit 77; }

cat >awkward.geojson <<'J'
{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},"features":[
{"type":"Feature","properties":{"name":"a","Name":"A","NAME":"AA","bid":12345678901,"tags":["x","y"],"nums":[1,2],"js":{"k":1},"day":"2020/02/29","when":"2021/03/04 05:06:07.5","yes":true,"h":1.5,"a_name_of_twenty_letters":"one","a_name_of_twenty_letterz":"two"},
 "geometry":{"type":"Polygon","coordinates":[[[500000,5400000],[500010.1,5400000],[500010.1,5400010],[500000,5400010],[500000,5400000]]]}},
{"type":"Feature","properties":{"name":"b","Name":"B","NAME":"BB","bid":12345678902,"tags":["z"],"nums":[3],"js":{"k":2},"day":null,"when":null,"yes":false,"h":null,"a_name_of_twenty_letters":"three","a_name_of_twenty_letterz":"four"},
 "geometry":{"type":"MultiPolygon","coordinates":[[[[500009,5400000],[500019,5400000],[500019,5400010],[500009,5400000]]]]}},
{"type":"Feature","properties":{"name":null,"Name":"C","NAME":null,"bid":null,"tags":null,"nums":null,"js":null,"day":null,"when":null,"yes":null,"h":3,"a_name_of_twenty_letters":null,"a_name_of_twenty_letterz":null},
 "geometry":{"type":"Polygon","coordinates":[[[500100,5400000],[500110,5400000],[500110,5400010],[500100,5400000]]]}}]}
J
fields='name Name NAME bid tags nums js day when yes h a_name_of_twenty_letters a_name_of_twenty_letterz'
ending() {
    case $1 in
        'ESRI Shapefile') echo shp ;;
        'MapInfo File') echo tab ;;
        *) ogrinfo --format "$1" | sed -n 's/^  Extensions*: *\([^ ]*\).*/\1/p' | tail -1 ;;
    esac
}

# The output can be read, and all losses were reported.
written() {
    local driver=$1 command=$2 out=$3 main=$4 names losses wanted=3
    jq -r '.losses[]?' stats.json >losses
    [ -s losses ] || sed -n 's/^sunder: warning: //p' log >losses
    losses=$(cat losses)
    grep -q 'is only written' losses && return
    [ "$command" != check ] || wanted=1
    ogrinfo -ro -so "$out" "$main" >info 2>/dev/null
    same "$(sed -n 's/^Feature Count: //p' info)" $wanted "$driver, $command: features of $out,"
    [ "$command" != check ] || return
    names=$(sed -n 's/^\([^ ].*\): [A-Z][A-Za-z0-9]*\(([^)]*)\)* ([0-9.]*).*/\1/p' info)
    for name in $fields; do
        grep -qx "$name" <<<"$names" || grep -q "^field $name: " <<<"$losses" || fail "$driver, $command: field $name is lost without a message"
    done
    [ "$command" = separate ] || return
    grep -qx sunder_blk <<<"$names" || { grep -q 'sunder_blk' <<<"$losses" || fail "$driver: sunder_blk is lost without a message"; return; }
    grep -q 'has no geometry\|geometries are not written\|changes geometries' losses && return
    # With the blocks that separate wrote, check finds the conflicts that separate reported.
    run check "$out" --input-layer "$main" --no-blocks --gap 1 --block-field sunder_blk --quiet --stats after.json
    same "$(jq -c .conflicts after.json)" "$(jq -c .conflicts.after stats.json)" "$driver: conflicts,"
}

tried=0 succeeded=0 asked=
while read -r driver; do
    end=$(ending "$driver")
    for command in separate check buffer; do
        rm -rf o && mkdir o
        out=o/out.${end:-x}
        case $command in
            separate) words='--gap 1 --max-shift 0.1 --no-blocks' reached=10 ;;
            check) words='--gap 1 --no-blocks' reached=30 ;;
            buffer) words='--shape square:1' reached=10 ;;
        esac
        # shellcheck disable=SC2086
        run $command awkward.geojson "$out" --of "$driver" --stats stats.json --log log --progress=plain $words </dev/null
        tried=$((tried + 1))
        in_file log
        [[ $content != *'is the disk full?'* && $content != *Traceback* ]] || fail "$driver, $command: $content"
        case $status in
            0 | 3)
                succeeded=$((succeeded + 1))
                main=$(ogrinfo -ro -so -al "$out" 2>/dev/null | sed -n 's/^Layer name: //p' | head -1)
                written "$driver" "$command" "$out" "$main"
                ;;
            1 | 2)
                [ "$(grep -c '^sunder: error: ' err)" -eq 1 ] || fail "$driver, $command: not exactly one error"
                [ -z "$(ls -A o)" ] || fail "$driver, $command: something is left in spite of the refusal"
                last=$(grep -E '^[0-9]+$' err | tail -1)
                [ "${last:-0}" -le $reached ] || fail "$driver, $command: refused after the work had begun, at $last percent"
                grep -q "$driver" err || fail "$driver, $command: the message does not name the format"
                asked+=",$driver"
                [ "$status" -ne 2 ] || break # formats that are refused for every layer
                ;;
            *) fail "$driver, $command: exit status $status" ;;
        esac
    done
done < <(ogrinfo --formats | sed -n 's/^  \(.*\) -[a-z, ]*vector[a-z, ]*- (r*w.*/\1/p')
[ $tried -ge 50 ] && [ $succeeded -ge 30 ] || fail "$tried runs, of which $succeeded wrote something: GDAL has hardly any drivers"
echo "$tried runs, $succeeded written; refused:$(tr ',' '\n' <<<"$asked" | sort -u | tr '\n' ',')"
finish
