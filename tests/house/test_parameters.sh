# shellcheck shell=bash disable=SC1091
# A parameter has one name in a header and in the definition, and every parameter of a prototype has a name.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
compare() { python3 "$SUNDER_SOURCE/tests/house/parameters.py" "$@"; }

said=$(compare "$root" src gis) || say "$said"
[ "$(tail -n 1 <<<"$said" | awk '{print $1}')" -gt 2000 ] || say "hardly any prototype was compared: $said"

# The script finds a name that differs and one that is missing, among valid declarations of several forms.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/src"
cat >"$work/src/made.h" <<'X'
int same(const char *text, double at[2], bool (*go_on)(void *user), const size_t (*pair)[2], ...) __attribute__((x(1, 2)));
int differs(const char *text, size_t n);
int unnamed(const char *, size_t n);
X
cat >"$work/src/made.c" <<'X'
int same(const char *text, double at[2], bool (*go_on)(void *user), const size_t (*pair)[2], ...) { return f(text, n); }
/* A remark (in parentheses); and a string: */
int differs(const char *words, size_t n) { return g("){", words, n); }
int unnamed(const char *text, size_t n) { return 0; }
X
if said=$(compare "$work" src); then say "made to differ, and found to agree"; fi
[ "$(tail -n 1 <<<"$said")" = '3 prototypes compared, 3 differ' ] || say "of a made pair of files: $said"
grep -q 'unnamed(, n) leaves a parameter without a name' <<<"$said" || say "a parameter without a name is not found: $said"
finish
