# shellcheck shell=bash disable=SC1091
# The figures in the summaries of the benchmarks are those of their records (records.py), and a summary is one page.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
told=$(python3 "$root/tests/house/records.py" "$root/tests/bench") || say "$told"
[[ $told =~ ^([0-9]+)\ figures && ${BASH_REMATCH[1]} -ge 300 ]] || say "$told"
# The script finds a figure that is in no record, a page that is too long, and a record without a page.
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/sums"
printf 'input,s\na,1.26\n' | tee "$scratch/sums/other.csv" >"$scratch/sums/sums.csv"
page() { printf '# X\n\n## Sums ([sums.csv](sums/sums.csv))\n\n| input | s |\n|---|---|\n| a | %s |\n' "$1" >"$scratch/X.md"; }
page 1.3
seq 150 >>"$scratch/X.md"
[[ $(python3 "$root/tests/house/records.py" "$scratch") == 'X.md has 157 lines
sums/other.csv is linked by no page' ]] || say "a long page and a record without a page are not found"
rm "$scratch/sums/other.csv"
python3 "$root/tests/house/records.py" "$scratch" >/dev/null && say "a long page is not found"
page 1.3
python3 "$root/tests/house/records.py" "$scratch" >/dev/null || say "a rounded figure is not found in its record"
page 1.2
python3 "$root/tests/house/records.py" "$scratch" >/dev/null && say "a figure is not missed in its record"
finish
