# shellcheck shell=bash disable=SC1091
# The plug-in uses spellings that are valid in Qt 5 and in Qt 6, and its metadata allow QGIS 3 and 4.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
