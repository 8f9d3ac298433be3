# shellcheck shell=bash disable=SC1091
# The plug-in is spelt for Qt 5 and for Qt 6, and its metadata for QGIS 3 and 4.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
