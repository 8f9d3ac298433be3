# shellcheck shell=bash
# The programs of docs/examples compile without warnings against the built library, as C and, if a C++ compiler is
# there, as C++; each prints what the comment at its top says.
set -eu
if grep -q '^SUNDER_SANITIZE:STRING=.' "$SUNDER_BUILD/CMakeCache.txt"; then
    echo "skipped: the build carries a sanitizer"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cc=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$SUNDER_BUILD/CMakeCache.txt")
library=$(find "$SUNDER_BUILD" -maxdepth 2 -name libsunder.a | head -n 1)
trouble=0 run=0
for example in "$SUNDER_SOURCE"/docs/examples/*.c; do
    name=$(basename "$example")
    # The indented lines below "Prints:" in the first comment.
    awk '/^ \*\// { exit } printing && /^ \*     / { print substr($0, 8) } /^ \* Prints:$/ { printing = 1 }' "$example" >"$work/expected"
    [ -s "$work/expected" ] || { echo "FAILED: $name does not say what it prints"; trouble=1; }
    "$cc" -std=c17 -Wall -Wextra -Wpedantic -Werror "-I$SUNDER_SOURCE/src" "$example" "$library" -lgmp -lm -pthread -o "$work/example"
    "$work/example" >"$work/printed"
    diff "$work/expected" "$work/printed" || { echo "FAILED: $name prints something else"; trouble=1; }
    run=$((run + 1))
done
[ "$run" -ge 3 ] || { echo "FAILED: only $run examples were found"; trouble=1; }
exit $trouble
