# shellcheck shell=bash
# Sourced by the tests of the plug-in that do not need QGIS: runs the Python file of the same name, with the plug-in on
# its path.
python=$(command -v /usr/bin/python3 || command -v python3) || { echo "skipped: there is no python3"; exit 77; }
export PYTHONPATH=$SUNDER_SOURCE/gis/qgis PYTHONDONTWRITEBYTECODE=1
exec "$python" "$(dirname "$0")/$(basename "$0" .sh).py" -v
