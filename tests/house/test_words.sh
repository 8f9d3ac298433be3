# shellcheck shell=bash disable=SC1091
# Plain technical English, as far as it can be counted (words.py): words for people in place of things, words in place of a variable's
# name, and sentences of more than 40 words, in comments and in pages.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
told=$(python3 "$root/tests/house/words.py" "$root") || say "$told"
# A page and a comment that break each rule: the script counts all of them.
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
python3 - "$scratch" <<'PY'
import pathlib, sys
root = pathlib.Path(sys.argv[1])
plain = "A house moves along the road and keeps its distance. " * 200
bad = "Nobody knows whom he met. It takes so many steps. A row of which the end moved. " * 9 + (" ".join(["Word"] + ["word"] * 41) + ". ") * 9
root.joinpath("a.c").write_text(f"/* {plain}\n{bad} */\n")
root.joinpath("a.md").write_text(f"{plain}\n\n{bad}\n")
PY
for kind in person "so many" "of which" long; do
    python3 "$root/tests/house/words.py" "$scratch" | grep -c ": $kind: " | grep -qx 2 || say "$kind is not counted in a comment and in a page"
done
finish
