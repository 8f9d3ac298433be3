# shellcheck shell=bash disable=SC1091
# There are no circles of files: no file uses symbols of another file that uses, directly or not, symbols of the first.
# Symbols are read from the objects of this build.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
for tool in nm python3; do
    command -v $tool >/dev/null || { echo "skipped: there is no $tool"; exit 77; }
done
exec python3 "$SUNDER_SOURCE/tests/house/circles.py" "$SUNDER_SOURCE" "$SUNDER_BUILD"
