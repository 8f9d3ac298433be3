# shellcheck shell=bash
# Runs a test of the Python package with the system's Python: run.sh FILE. The package is used in the build tree.
set -eu
python=/usr/bin/python3
[ -x "$python" ] || { echo "skipped: there is no $python"; exit 77; }
compgen -G "$SUNDER_BUILD/python/sunder/_sunder*.so" >/dev/null ||
    { echo "skipped: the Python package was not built (python3-dev is missing, or SUNDER_PYTHON is off)"; exit 77; }
if grep -q '^SUNDER_SANITIZE:STRING=.' "$SUNDER_BUILD/CMakeCache.txt"; then
    echo "skipped: the build carries a sanitizer, which Python does not load"
    exit 77
fi
PYTHONPATH=$SUNDER_BUILD/python:$SUNDER_SOURCE/tests/python exec "$python" -X dev -W error::ResourceWarning "$1"
