# shellcheck shell=bash disable=SC1091
# --trace: what each stage did, one JSON object per line, the same for every number of threads; it does not change the
# result. Each pair that remains has a line with its reason, and each pair that the search gave up has a line that says
# so.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
rules=(--input-layer buildings --gap 2.5 --max-shift 5 --barrier "$town,layer=roads,width=7.5" --allow-conflicts --quiet)

expect 0 separate "${rules[@]}" --threads 1 --trace one.jsonl "$town" traced.gpkg
expect 0 separate "${rules[@]}" --threads 4 --trace four.jsonl "$town" again.gpkg
cmp -s one.jsonl four.jsonl || fail "the trace depends on the number of threads"
expect 0 separate "${rules[@]}" --of FlatGeobuf "$town" plain
expect 0 separate "${rules[@]}" --of FlatGeobuf --trace plain.jsonl "$town" with
diff -r plain with >difference || fail "a result depends on the trace: $(head -1 difference)"

ogr2ogr -f CSV /vsistdout/ traced.gpkg buildings_conflicts -select fid_a,fid_b,barr_fid,reason >remaining
python3 - one.jsonl remaining >lines <<'P' || fail "$(cat lines)"
import csv, json, sys
events = [json.loads(line) for line in open(sys.argv[1])]
known = {"pass", "stage", "round", "scope", "table", "step", "outcome", "features", "barriers", "cost_before", "cost_after"}
assert events and all(set(e) <= known for e in events), "unknown keys"
assert all({"scope", "outcome"} <= set(e) for e in events), "a line without scope or outcome"
assert {e["scope"] for e in events} == {"layer", "cluster", "group", "pair"}, "a scope is missing"
stages = {e.get("stage") for e in events}
assert {"settle", "reconsider", "improve"} <= stages, stages
# The steps of the search within a stage appear with their tables, too.
tables = {(e.get("table"), e.get("step")) for e in events}
for row in (("layer", None), ("search", None), ("settle", "commit"), ("optimise", "take over"), ("cluster", "descend"),
            ("cluster", "give up"), ("retry", "end overlaps"), ("improve", "try places and sides"), ("group", "grow tree")):
    assert row in tables, row
# Each row of the layer of conflicts has its line, with the same reason.
said = sorted((tuple(e["features"]), tuple(b[1] for b in e.get("barriers", [])), e["outcome"])
              for e in events if e.get("step") == "why it remains")
rows = []
for row in csv.DictReader(open(sys.argv[2])):
    features = [int(row["fid_a"])] + ([int(row["fid_b"])] if row["fid_b"] else [])
    barriers = [int(row["barr_fid"])] if row["barr_fid"] else []
    rows.append((tuple(sorted(features)), tuple(barriers), row["reason"]))
assert said == sorted(rows), (said, rows)
# A pair whose reason was not known beforehand was given up by the search.
given_up = {tuple(e["features"]) for e in events if e.get("step") == "give up" and e["scope"] == "pair"}
searched = [r for r in rows if r[2] in ("no_room", "unresolved") and len(r[0]) == 2]
assert searched, "no pair was searched in vain"
for pair, _, reason in searched: assert pair in given_up, (pair, reason)
# A bound proved for a group is given as a number.
assert all("cost_before" in e and "cost_after" in e for e in events if e["scope"] == "group"), "a group without costs"
P

refused 2 'needs the whole layer in memory' separate "${rules[@]}" --max-memory 1G --trace parts.jsonl "$town" parts.gpkg
refused 2 'the trace goes to a file' separate "${rules[@]}" --trace - "$town" parts.gpkg
refused 2 'unknown option' check --trace x.jsonl "$town"
finish
