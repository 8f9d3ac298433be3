# shellcheck shell=bash disable=SC1091
# Each header that a source of src/ includes is needed there: the source uses something that the header itself declares.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: there is no python3"; exit 77; }
unneeded() { python3 "$root/tests/house/includes.py" "$1"; }
unneeded "$root/src" || say "no source needs the includes above"

# The script finds an include that is not needed, and no other.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/base"
printf '#define WIDE 3\nint wide(void);\n' >"$scratch/base/wide.h"
printf '#include "base/wide.h"\n#include <math.h>\n#include <string.h>\nint wide(void) { return (int)fabs(1.0); }\n' >"$scratch/base/wide.c"
printf '#include "base/wide.h"\nint narrow; /* WIDE */\n' >"$scratch/base/narrow.c"
[ "$(unneeded "$scratch" | sort)" = "base/narrow.c does not need base/wide.h
base/wide.c does not need string.h" ] || say "unneeded includes are not found"
finish
