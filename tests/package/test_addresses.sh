# shellcheck shell=bash
# Addresses come from one file, gis/package/addresses.cmake. fill_addresses.cmake writes them into README.md and
# SECURITY.md: a given address is in both files, and an address that is set to empty again leaves no trace.
set -eu
work=$SUNDER_BUILD/addresses-test
rm -rf "$work"
mkdir -p "$work/pages"
cp "$SUNDER_SOURCE/README.md" "$SUNDER_SOURCE/SECURITY.md" "$work/pages"
fill() { cmake "$@" -DROOT="$work/pages" -P "$SUNDER_SOURCE/gis/package/fill_addresses.cmake"; }
fail() { echo "FAILED: $*"; exit 1; }
same() { # description of the step
    for page in README.md SECURITY.md; do
        diff "$SUNDER_SOURCE/$page" "$work/pages/$page" || fail "$1: $page differs from what is made of addresses.cmake"
    done
}

fill
same "as they are"
fill -DSUNDER_HOMEPAGE='https://example.net/a;b' -DSUNDER_TRACKER=https://example.net/issues \
    -DSUNDER_REPOSITORY=https://example.net/code.git -DSUNDER_PRIVATE_REPORTS=private@example.net -DSUNDER_EMAIL=who@example.net
for address in 'https://example.net/a;b' https://example.net/issues https://example.net/code.git private@example.net who@example.net; do
    [ "$(grep -cF "<$address>" "$work/pages/README.md")" -eq 1 ] || fail "README.md does not hold $address once"
done
grep -qF '<private@example.net>' "$work/pages/SECURITY.md" || fail "SECURITY.md does not hold the address for private reports"
if grep -q 'No release is published' "$work/pages/SECURITY.md"; then fail "SECURITY.md says that there is no address"; fi
fill -DSUNDER_TRACKER=https://example.net/issues
[ "$(grep -c 'example.net' "$work/pages/README.md")" -eq 1 ] || fail "addresses of before stay in README.md"
fill
same "emptied again"

# No other source contains an address.
for page in README.md SECURITY.md CONTRIBUTING.md .github gis/qgis/sunder/metadata.txt; do
    if grep -rnE 'https?://(www\.)?(github|gitlab|codeberg)\.' "$SUNDER_SOURCE/$page"; then fail "$page names an address"; fi
done
