# shellcheck shell=bash disable=SC1091
# The dialogs ask what the program has: its options, their choices, their defaults.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
