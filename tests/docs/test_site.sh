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
    for name in $(grep -E '^(SUNDER_API|SUNDER_EXPERIMENTAL|static inline) ' "$SUNDER_SOURCE/src/$header.h" |
        grep -o 'sunder_[a-z_]*(' | tr -d '('); do
        grep -q "[\";>]$name</a>\|>$name<\| $name " "$page" || fail "the reference of $header.h lacks $name"
    done
done
grep -q 'Separates the features at little cost' "$site/reference/sunder_8h.html" || fail "the reference has no descriptions"

# A page that leads nowhere is found out, by its file and by its part.
cp -r "$site" "$work/wrong"
printf '<a href="nowhere.html">x</a><a href="index.html#nowhere">y</a>' >>"$work/wrong/index.html"
if python3 "$here/links.py" "$work/wrong" >"$work/said"; then fail "links that lead nowhere pass"; fi
[ "$(grep -c 'nowhere' "$work/said")" -eq 2 ] || fail "links that lead nowhere are not named"
exit $trouble
