# shellcheck shell=bash
# The documentation can be built (docs/site.sh), its links are not broken, and it contains the guide, the manual, and
# every function of the headers with its description.
set -eu
for tool in pandoc doxygen python3; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
here=$SUNDER_SOURCE/tests/docs
trouble=0
fail() { echo "FAILED: $*"; trouble=1; }

manual=$SUNDER_BUILD/gis/manual
[ -d "$manual" ] || manual=
bash "$SUNDER_SOURCE/docs/site.sh" "$work/site" ${manual:+"$manual"} >/dev/null
site=$work/site
python3 "$here/links.py" "$site" || fail "links that lead nowhere"

for page in "$SUNDER_SOURCE"/docs/*.md "$SUNDER_SOURCE"/docs/guide/*.md; do
    made=${page#"$SUNDER_SOURCE"/} made=${made%.md}.html
    [ -s "$site/${made/README.html/index.html}" ] || fail "the page $made is missing"
done
grep -q -- '--max-shift-field' "$site/gis/sunder.1.html" || fail "the manual lacks an option"
for page in ${manual:+"$manual"/sunder-*.1}; do
    [ ! -f "$page" ] || [ -s "$site/manual/$(basename "$page").html" ] || fail "no page of $(basename "$page")"
done
for header in $(cd "$SUNDER_SOURCE/src" && printf '%s\n' sunder_*.h); do
    header=${header%.h}
    page=$site/reference/${header//_/__}_8h.html
    python3 "$here/described.py" "$SUNDER_SOURCE/src/$header.h" "$page" || fail "the reference of $header.h lacks these"
done

# described.py finds a function that the page lacks, and one whose description it lacks.
printf '/* Words of none. */\nSUNDER_API int sunder_version(void);\nSUNDER_API int sunder_nowhere(void);\n' >"$work/wrong.h"
if python3 "$here/described.py" "$work/wrong.h" "$site/reference/sunder__base_8h.html" >"$work/said"; then
    fail "described.py accepts functions that the reference lacks"
fi
[ "$(grep -c . "$work/said")" -eq 2 ] || fail "described.py does not name the functions that the reference lacks"

# links.py finds a broken link to a file, and one to a part of a page.
cp -r "$site" "$work/wrong"
printf '<a href="nowhere.html">x</a><a href="index.html#nowhere">y</a>' >>"$work/wrong/index.html"
if python3 "$here/links.py" "$work/wrong" >"$work/said"; then fail "links.py accepts broken links"; fi
[ "$(grep -c 'nowhere' "$work/said")" -eq 2 ] || fail "links.py does not name the broken links"
exit $trouble
