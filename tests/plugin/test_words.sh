# shellcheck shell=bash disable=SC1091
# Values of the dialogs become the right arguments of the program.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
