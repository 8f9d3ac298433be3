# shellcheck shell=bash
# Packages made on this machine, Debian 12, are installed, run and removed in a root of Debian 12 without this source
# tree.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
grep -q '^VERSION_CODENAME=bookworm$' /etc/os-release || skip "this is not Debian 12"
build_packages / "$scratch/packages"
if ! lintian --fail-on error "$scratch"/packages/*.deb >"$scratch/lintian.log" 2>&1; then
    grep '^E:' "$scratch/lintian.log"
    exit 1
fi
echo "lintian: no errors"
make_root bookworm "$scratch/root"
try_packages "$scratch/root" "$scratch/packages"
