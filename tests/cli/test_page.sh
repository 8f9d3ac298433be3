# shellcheck shell=bash disable=SC1091
# Tests --report: one page that loads no other file, whatever its content and names; it appears together with the output
# or not at all, and is the same in each run. tests/browser tests how it looks.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=1700000000
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X

# page FILE: the page is complete, has no links to other files, its data are JSON, and the hashes of its content
# security policy match its script and style.
page() {
    python3 - "$1" <<'P' || fail "$1 is not a complete page"
import base64, hashlib, html.parser, json, re, sys
text = open(sys.argv[1], encoding="utf-8", newline="").read()
wrong = []
assert text.startswith("<!doctype html>") and text.endswith("</html>\n"), "not whole"
parts = {"style": [], "script": [], "json": []}

class Reader(html.parser.HTMLParser):
    into = None
    open_tags = []
    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        for name, value in attributes:
            if name.startswith("on") or name == "style": wrong.append(f"{tag} has {name}")
            if name in ("src", "href", "action", "data", "srcset", "xlink:href") and not (value or "").startswith(("#at=", "#after-map")):
                wrong.append(f"{tag} leads to {value}")
        if tag in ("link", "iframe", "img", "object", "embed", "base", "foreignobject"): wrong.append(f"there is a {tag}")
        if tag == "style" or tag == "script":
            self.into = parts["json" if given.get("type") == "application/json" else tag]
            self.into.append("")
        if tag not in ("meta", "input", "br", "path", "rect", "circle"): self.open_tags.append(tag)
    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in ("meta", "input", "br", "path", "rect", "circle"): self.open_tags.pop()
    def handle_endtag(self, tag):
        self.into = None
        if not self.open_tags or self.open_tags.pop() != tag: wrong.append(f"{tag} is closed out of turn")
    def handle_data(self, data):
        if self.into is not None: self.into[-1] += data

reader = Reader()
reader.feed(text)
reader.close()
if reader.open_tags: wrong.append(f"never closed: {reader.open_tags}")
if [len(parts[k]) for k in ("style", "script", "json")] != [1, 1, 1]: wrong.append("elements that are not the page's own")
policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text).group(1)
if "default-src 'none'" not in policy: wrong.append("no policy")
for kind in ("style", "script"):
    hashed = base64.b64encode(hashlib.sha256(parts[kind][0].encode()).digest()).decode()
    if f"{kind}-src 'sha256-{hashed}'" not in policy: wrong.append(f"the policy does not allow the {kind}")
data = json.loads(parts["json"][0])
n = len(data["label"])
if len(data["status"]) != n: wrong.append("columns differ in length")
if re.search(r"url\((?!#)|@import|https?:|//[a-z]", parts["style"][0] + parts["script"][0]): wrong.append("an address in it")
if any(ord(c) < 32 and c not in "\n\t" for c in text): wrong.append("control characters")
if re.search(r"\b(nan|inf|NaN|Infinity)\b", re.sub(r"<script>.*?</script>", "", text, flags=re.S)): wrong.append("numbers that are none")
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
P
}

expect 3 separate "$town" town.gpkg -l buildings --gap 3 --max-shift 5 --fixed-where "kind = 'monument'" --id-field id \
    --report town.html --stats town.json
page town.html
for words in '45 <span class="to">' 'id="blocked"' 'no room' 'moves too short' 'B0000004 (FID 4)' 'class="histogram"' \
    '<code>--max-shift</code>' "kind = &#39;monument&#39;" 'with every corner' '2023-11-14'; do
    says town.html "$words"
done
grep -q -- '--threads\|--report</code>\|peak_rss' town.html && fail "the page contains options or figures that do not affect the result"
[ "$(wc -c <town.html)" -lt 300000 ] || fail "the page of 280 houses has $(wc -c <town.html) bytes"

# A section about rows, the most bent rows in detail, and the two parts of the cost.
expect 3 separate "$town" rows.gpkg -l buildings --gap 3 --max-shift 5 --ease no --report rows.html --stats rows.json
page rows.html
says rows.html "$(jq '.rows.rows' rows.json) rows of neighbours with $(jq '.rows.features' rows.json) houses"
for words in 'Rows of houses' '<path class="row" d="M' 'and of the springs of rows ('; do says rows.html "$words"; done
[ "$(grep -o '<path class="row"' rows.html | wc -l)" -le 8 ] || fail "more than four rows in close-up"

# The page is the same for any number of threads.
mkdir again
(cd again && expect 3 separate "$town" town.gpkg -l buildings --gap 3 --max-shift 5 --fixed-where "kind = 'monument'" \
    --id-field id --report town.html --threads 2 -q)
cmp -s town.html again/town.html || fail "the bytes of the page differ"

# Layers of all kinds.
expect 0 separate "$town" lone.gpkg -l buildings --where 'fid = 1' --gap 3 --report lone.html
page lone.html
says lone.html 'nothing to do'
grep -q 'id="rows"' lone.html && fail "a section about rows, of which there are none"
expect 0 separate "$town" none.gpkg -l buildings --where 'fid < 0' --gap 3 --report none.html
page none.html
says none.html 'nothing to draw'
expect 0 separate in.gpkg degrees.gpkg --input-crs EPSG:4326 --report degrees.html
page degrees.html
says degrees.html '°'
layer points.gpkg shops POINT <<'X'
id,WKT
1,"POINT(0 0)"
2,"POINT(1 0)"
3,
X
expect 0 separate points.gpkg shifted.gpkg --symbol disc:2 --gap 1 --no-blocks --report points.html
page points.html
layer far.gpkg far POLYGON <<'X'
id,WKT
1,"POLYGON((-1e300 -1e300,1e300 -1e300,1e300 1e300,-1e300 -1e300))"
2,"POLYGON((1e-300 0,2e-300 0,2e-300 1e-300,1e-300 0))"
X
expect 0 separate far.gpkg far_out.gpkg --report far.html --allow-conflicts
page far.html
cp out far_out
expect 0 separate in.gpkg /vsistdout/ --of GeoJSON --report beside.html
page beside.html
says out FeatureCollection

# Barriers are drawn, with their width, and named by layer and FID.
expect 3 separate "$town" roads.gpkg -l buildings --where 'fid <= 60' --max-shift 1 --barrier "$town,layer=roads,width=13" \
    --report roads.html -q
page roads.html
for words in '<i class="barrier"></i>' '<bdi>roads:' 'on a barrier' '"barrier": "' 'class="road line" stroke-width="'; do
    says roads.html "$words"
done
grep -q 'class="road' town.html && fail "the page has roads although there are no barriers"

# A large layer is thinned, and the page says so.
"$SUNDER_BUILD/sunder-town" --buildings 140000 --seed 3 large.gpkg >town_said || fail "no large town"
expect 0 separate large.gpkg large_out.gpkg -l buildings --gap 1 --ignore-where 'fid > 500' --report large.html --layers conflicts \
    --allow-conflicts -q
rm large.gpkg
page large.html
says large.html 'the map is thinned'
bytes=$(wc -c <large.html)
[ "$bytes" -lt 10000000 ] && [ "$bytes" -gt 3000000 ] || fail "the page of 140,000 features has $bytes bytes"

# Names that contain markup, a script, or bytes that are not text, and how the page shows them.
python3 - <<'P' || fail "cannot make the names"
import json, sqlite3
square = lambda x: {"type": "Polygon", "coordinates": [[[x, 0], [x + 4, 0], [x + 4, 4], [x, 4], [x, 0]]]}
ids = ["</title></td><img src=x onerror=\"alert(1)\">", "'\" onload='alert(1)' {{title}} \u2028\u202e", "x"]
json.dump({"type": "FeatureCollection", "name": "</script><script>alert(1)</script>\"&'<!--",
           "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
           "features": [{"type": "Feature", "properties": {"id": id}, "geometry": square(x)}
                        for x, id in zip([0, 3, 7.5], ids)]}, open("evil.geojson", "w"))
P
expect 3 separate evil.geojson evil.gpkg --gap 3 --max-shift 0.1 --id-field id --report evil.html --output-layer fine
page evil.html
says evil.html '&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&quot;&amp;&#39;&lt;!--'
says evil.html '\u003c/title\u003e\u003c/td\u003e\u003cimg src=x'
says evil.html '&lt;img src=x onerror=&quot;alert(1)&quot;&gt;'
says evil.html '{{title}}'
grep -q '<img\|<script>alert' evil.html && fail "a name is markup"
python3 - <<'P' || fail "cannot spoil a name"
import sqlite3
d = sqlite3.connect("evil.gpkg")
for name, in d.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall(): d.execute(f'DROP TRIGGER "{name}"')
# Invalid UTF-8: overlong, a surrogate, beyond the last code point, cut off, a stray byte; then a control character and
# a noncharacter.
d.execute("UPDATE fine SET id = CAST(x'C0AF3CEDA080F4908080E28041FF80016FEFBFBF' AS TEXT) WHERE id = 'x'")
d.commit()
P
expect 3 separate evil.gpkg bytes.gpkg -l fine --gap 3 --max-shift 0.1 --id-field id --report bytes.html --touch-tolerance 0
page bytes.html

# Allowed and forbidden destinations of the page.
refused 2 'give its name' separate in.gpkg o.gpkg --report -
refused 2 'that is the output' separate in.gpkg o.gpkg --report ./o.gpkg
refused 2 'that is an input' separate in.gpkg o.gpkg --report in.gpkg
refused 2 'that is the file of --stats' separate in.gpkg o.gpkg --report s.json --stats ./s.json
refused 1 'cannot write to' separate in.gpkg o.gpkg --report nowhere/r.html
refused 1 'is a directory' separate in.gpkg o.gpkg --report again
refused 2 'unknown option' buffer in.gpkg o.gpkg --shape disc:1:8 --report r.html
echo 'of an earlier run' >r.html
expect 0 separate in.gpkg o.gpkg --report r.html -q
page r.html
echo 'of an earlier run' >r.html
echo precious >taken.dbf
refused 1 'taken.dbf' separate in.gpkg taken.shp --report r.html -q
same "$(cat r.html)" 'of an earlier run' "after a failure at the last step:"
finish
