# shellcheck shell=bash
# The steps of a first user, on a clean Debian 12 with QGIS: clone, the commands of the README's "Install", the zip, and
# the separation of the town from its roads in QGIS.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
git -C "$source" rev-parse --git-dir >/dev/null 2>&1 || skip "the sources are no clone of a repository"
make_root bookworm "$scratch/root"
git clone -q --bare "$source" "$scratch/root/root/sunder.git"
sed -n '/^## Install/,/^## /p' "$source/README.md" | sed -n '/^```sh$/,/^```$/p' | grep -v '^```' |
    sed 's|<address of the repository>|/root/sunder.git|' >"$scratch/root/root/install.sh"
grep -q 'gis/demo.sh' "$scratch/root/root/install.sh"
cp "$source/tests/debian/first_user.sh" "$scratch/root/root"
within "$scratch/root" sh -c 'apt-get update && apt-get install -y --no-install-recommends git ca-certificates qgis unzip' \
    >"$scratch/apt.log" 2>&1 || { tail -n 20 "$scratch/apt.log"; skip "QGIS could not be installed"; }
if ! within "$scratch/root" bash -eu /root/first_user.sh >"$scratch/user.log" 2>&1; then
    tail -n 40 "$scratch/user.log"
    exit 1
fi
grep '^step: ' "$scratch/user.log"
