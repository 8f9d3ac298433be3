# shellcheck shell=bash disable=SC1091
# The dialogs have the options of the program, with their choices and defaults.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
