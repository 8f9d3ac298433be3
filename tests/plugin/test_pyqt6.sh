# shellcheck shell=bash disable=SC1091
# The modules of the plug-in import with PyQt6, and what they take from Qt is there.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
