# shellcheck shell=bash
# The documentation can be made (docs/site.sh), no link in it leads nowhere, and what it is to have is there: the guide, the
# manual, every function of the headers with its description.
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
    [ -s "$site/${made/README.html/index.html}" ] || fail "no page of $made"
done
grep -q -- '--max-shift-field' "$site/gis/sunder.1.html" || fail "the manual lacks an option"
for page in ${manual:+"$manual"/sunder-*.1}; do
    [ ! -f "$page" ] || [ -s "$site/manual/$(basename "$page").html" ] || fail "no page of $(basename "$page")"
done
for header in sunder sunder_proof sunder_parts; do
    page=$site/reference/${header//_/__}_8h.html
    python3 "$here/described.py" "$SUNDER_SOURCE/src/$header.h" "$page" || fail "the reference of $header.h lacks these"
done

# A function that the page lacks is found, and one whose description it lacks.
printf '/* Words of none. */\nSUNDER_API int sunder_version(void);\nSUNDER_API int sunder_nowhere(void);\n' >"$work/wrong.h"
if python3 "$here/described.py" "$work/wrong.h" "$site/reference/sunder_8h.html" >"$work/said"; then
    fail "functions that the reference lacks pass"
fi
[ "$(grep -c . "$work/said")" -eq 2 ] || fail "functions that the reference lacks are not named"

# A page that leads nowhere is found out, by its file and by its part.
cp -r "$site" "$work/wrong"
printf '<a href="nowhere.html">x</a><a href="index.html#nowhere">y</a>' >>"$work/wrong/index.html"
if python3 "$here/links.py" "$work/wrong" >"$work/said"; then fail "links that lead nowhere pass"; fi
[ "$(grep -c 'nowhere' "$work/said")" -eq 2 ] || fail "links that lead nowhere are not named"
exit $trouble
