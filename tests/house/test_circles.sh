# shellcheck shell=bash disable=SC1091
# No circle of files: what a file uses of others, read from the objects of this build, leads back to it by none of them.
. "$SUNDER_SOURCE/tests/house/lib.sh" || exit 1
for tool in nm python3; do
    command -v $tool >/dev/null || { echo "skipped: there is no $tool"; exit 77; }
done
exec python3 "$SUNDER_SOURCE/tests/house/circles.py" "$SUNDER_SOURCE" "$SUNDER_BUILD"
