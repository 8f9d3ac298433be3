# shellcheck shell=bash disable=SC1091
# Finding, running, ending the program, and its messages in plain words.
. "$SUNDER_SOURCE/tests/plugin/lib.sh"
