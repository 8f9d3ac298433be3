# shellcheck shell=bash disable=SC1091
# Every function of src/ that files share is used: its name occurs more often than in its declaration and its definition.
# Tests count as use.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1

# Lines "name file" of functions that nothing uses below the folders src and tests of a root.
unused() {
    (cd "$1" && find src tests -name '*.[ch]' -print0 | xargs -0 awk '
        {
            line = $0
            sub(/^ *(\/\*|\*( |$)).*/, "", line) # removes comments
            first = 1
            while (match(line, /sunder_i_[a-z0-9_]+/)) {
                name = substr(line, RSTART, RLENGTH)
                before = substr(line, 1, RSTART - 1)
                line = substr(line, RSTART + RLENGTH)
                n[name]++
                # A name declared or defined here: the first name of the line after a type.
                if (first && line ~ /^\(/ && before ~ /^[a-z][a-z0-9_ *]*[ *]$/ && FILENAME ~ /^src\//) {
                    declared[name]++
                    at[name] = FILENAME
                }
                if (line ~ /^\(/) first = 0
            }
        }
        END { for (name in declared) if (n[name] == declared[name]) print name, at[name] }')
}
while read -r name file; do
    say "nothing uses $name() of $file"
done < <(unused "$root" | sort)

# It finds a function that is declared and defined but unused, also an inline one; it does not list one that is used.
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/src" "$scratch/tests"
printf 'void sunder_i_idle(int a);\nvoid sunder_i_busy(void);\nstatic inline int sunder_i_short(void) { return 1; }\n' >"$scratch/src/a.h"
printf 'void sunder_i_idle(int a)\n{\n}\nvoid sunder_i_busy(void)\n{\n}\n' >"$scratch/src/a.c"
printf '    sunder_i_busy();\n' >"$scratch/tests/b.c"
[ "$(unused "$scratch" | cut -d' ' -f1 | sort | tr '\n' ' ')" = "sunder_i_idle sunder_i_short " ] || say "what is unused is not found"
finish
