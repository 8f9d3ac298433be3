# shellcheck shell=bash disable=SC1091
# The modules of the plug-in import with PyQt6, and all names that they use from Qt exist there.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
