# shellcheck shell=bash disable=SC1091
# The values of each tuning.h are those of its version: a record that names the version (tests/bench/ablation.sh)
# thereby names all of them. The file TUNING has the digest of the values of each version. After a change of a value
# raise the version in the header, and record it:
#
#   SUNDER_SOURCE=. bash tests/house/test_tuning.sh --record
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1

# "version digest" of one header: the digest of its definitions, each on one line, without comments and spacing.
stamp() {
    awk '/^#define/ { on = 1 } on { sub(/\/\*.*/, ""); gsub(/[ \t]+/, " "); sub(/ $/, ""); print } !/\\$/ { on = 0 }' "$1" >"$work"
    echo "$(sed -n 's/^#define SUNDER_I_[A-Z]*_TUNING_VERSION //p' "$work") $(grep -v '_TUNING_VERSION ' "$work" | sha256sum | cut -c1-16)"
}

record=$root/tests/house/TUNING
work=$(mktemp)
trap 'rm -f "$work"' EXIT
found=$(cd "$root/src" && find . -name tuning.h | sed 's#^\./##' | sort | while read -r file; do echo "$file $(stamp "$file")"; done)
[ "${1:-}" != --record ] || { echo "$found" >"$record"; exit 0; }
while read -r file version digest; do
    read -r was_version was_digest < <(sed -n "s#^$file ##p" "$record")
    [ -n "$version" ] || say "src/$file has no version"
    [ "$digest" = "${was_digest:-}" ] && [ "$version" = "${was_version:-}" ] && continue
    [ "$digest" = "${was_digest:-}" ] && say "src/$file: the version changed, but no value"
    [ "$version" = "${was_version:-}" ] && say "src/$file: a value changed, the version did not"
    say "src/$file is not as recorded in tests/house/TUNING"
done <<<"$found"
[ "$(wc -l <<<"$found")" -ge 10 ] || say "hardly any tuning.h was found"
finish
