# shellcheck shell=bash disable=SC1091
# Files that another user may have put beside an output, or into a directory that all users may write to, and that look
# like files of the program: stages and lists of killed runs (planted.py makes them with every owner, mode, kind and
# choice of names), abandoned files, symbolic links in place of files to be written, journals beside databases, plans.
# The program may not read, replace or remove any file because of them. Files of another user can be made by root only.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
root=$([ "$(id -u)" -eq 0 ] && echo yes)
[ -n "$root" ] || echo "not root: files of another user cannot be made; that part is left out"

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X

# ---- stages, also empty ones
made=$(python3 "$SUNDER_SOURCE/tests/cli/planted.py" make planted) || fail "planted.py"
[ "$made" -gt 20 ] || fail "only $made stages were planted: the test proves nothing"
expect 0 separate in.gpkg planted/out.gpkg --gap 1
wrong=$(python3 "$SUNDER_SOURCE/tests/cli/planted.py" judge planted) || fail "planted.py"
[ -z "$wrong" ] || fail "$wrong"
[ -e planted/out.gpkg ] || fail "the run among the planted files wrote no output"

# An empty stage that is locked belongs to a run that has not filled it yet.
if command -v flock >/dev/null; then
    mkdir -m 700 .sunder-locked
    flock .sunder-locked "$SUNDER" separate in.gpkg locked.gpkg -q 2>err || fail "an empty stage in use makes another run fail"
    [ -d .sunder-locked ] || fail "an empty stage in use was swept"
    rmdir .sunder-locked
fi

# ---- abandoned plans and shards
for kind in marked nothin unmark opened; do mkdir -m 700 .x.plan.sunder-$kind; done
touch .x.plan.sunder-{marked,opened}/being-made~ .x.plan.sunder-marked/cells .x.plan.sunder-unmark/mine
chmod 755 .x.plan.sunder-opened
mkdir -m 700 real && touch real/being-made~ real/mine && ln -s real .x.plan.sunder-alinks
[ -z "$root" ] || { mkdir -m 700 .x.plan.sunder-nobody && touch .x.plan.sunder-nobody/being-made~ && chown -R 65534 .x.plan.sunder-nobody; }
expect 0 plan in.gpkg x.plan --gap 1 --shards 2
for gone in marked nothin; do [ ! -e .x.plan.sunder-$gone ] || fail "an abandoned plan stays: $gone"; done
for kept in unmark/mine opened/being-made~ alinks ${root:+nobody/being-made~}; do
    [ -e .x.plan.sunder-$kept ] || fail "a file that is not an abandoned plan was removed: $kept"
done
[ -e real/mine ] || fail "a link with the name of an abandoned plan was followed"
[ ! -e x.plan/being-made~ ] || fail "a plan that is complete says that it is being made"
echo mine >victim
ln -s ../victim x.plan/shard-1.sunder-alinks && echo begun >x.plan/shard-1.sunder-abcdef
expect 0 separate --shard 1 x.plan
[ -L x.plan/shard-1.sunder-alinks ] && [ ! -e x.plan/shard-1.sunder-abcdef ] || fail "shards: $(ls -A x.plan)"
expect 0 separate --shard 2 x.plan
same "$(cat victim)" mine "what a planted link leads to"

# ---- a plan of another user, or one that all users may write to, is not trusted
chmod o+w x.plan
refused 1 'all users may write into it' merge x.plan o.gpkg
refused 1 'all users may write into it' separate --shard 1 x.plan
chmod o-w x.plan
if [ -n "$root" ]; then
    chown 65534 x.plan
    refused 1 'belongs to another user' merge x.plan o.gpkg
    chown 0 x.plan
fi
expect 0 merge x.plan o.gpkg
rm -rf x.plan .x.plan.* .sunder-*

# ---- links and journals in a directory that all users may write to, where only owners may rename
mkdir -m 1777 all
chmod 1777 all
mkdir own
targets() { echo "the victim's own" >own/victim; "$SUNDER" separate in.gpkg own/db.gpkg -q --overwrite; }
links() {
    rm -f all/*
    for name in o.gpkg o.shp o.fgb; do ln -s ../own/db.gpkg all/$name; done
    for name in s.json r.html p.jsonl l.txt; do ln -s ../own/victim all/$name; done
    [ -z "${1:-}" ] || chown -h "$1" all/*
}
if [ -n "$root" ]; then
    targets
    before=$(cksum own/*)
    links 65534
    for output in all/o.gpkg all/o.shp all/o.fgb; do
        refused 1 'another user (65534)' separate in.gpkg $output --overwrite
        [ $output != all/o.gpkg ] || refused 1 'another user (65534)' separate in.gpkg $output --update --output-layer more
    done
    for option in --stats=all/s.json --report=all/r.html --proof=all/p.jsonl --log=all/l.txt; do
        refused 1 'another user (65534)' separate in.gpkg other.gpkg $option
    done
    same "$(cksum own/*)" "$before" "a target of another user's link"
    # A journal, or a write-ahead log, that SQLite would apply to a database of ours.
    for ending in -journal -wal; do
        rm -f all/* && cp own/db.gpkg all/db.gpkg && cp own/db.gpkg all/db.gpkg$ending && chown 65534 all/db.gpkg$ending
        before=$(cksum all/db.gpkg)
        refused 1 'belongs to another user' separate all/db.gpkg other.gpkg
        refused 1 'belongs to another user' separate in.gpkg all/db.gpkg --update --output-layer more
        refused 1 'belongs to another user' separate in.gpkg all/db.gpkg --overwrite
        same "$(cksum all/db.gpkg)" "$before" "a database beside another user's $ending"
    done
fi
# Symbolic links of the user are followed.
targets
links
expect 0 separate in.gpkg all/o.gpkg --overwrite --gap 1 --stats all/s.json
[ -L all/o.gpkg ] && [ -L all/s.json ] || fail "links of one's own were replaced"
grep -q '"command"' own/victim || fail "a link of one's own was not followed"
finish
