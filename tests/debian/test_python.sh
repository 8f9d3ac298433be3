# shellcheck shell=bash
# On a clean Debian 12, from an empty home directory: the two commands of gis/python/README.md lead to a moved
# GeoDataFrame. Then the package is removed, and nothing is left.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
make_root bookworm "$scratch/root"
root=$scratch/root
mkdir "$root/root/sunder"
tar -C "$source" --exclude=./build --exclude=./.git -cf - . | tar -C "$root/root/sunder" -xf -
sed -n '/^## Install/,/^Elsewhere/p' "$source/gis/python/README.md" | sed -n 's/^    //p' >"$root/root/commands.sh"
[[ $(wc -l <"$root/root/commands.sh") == 2 ]] || { echo "the page does not have two commands"; exit 1; }
cat >"$root/root/user.sh" <<'SH'
cd /root/sunder
export HOME=/root/home
mkdir "$HOME"
. /root/commands.sh
test -s moved.gpkg
[ -z "$(ls -A "$HOME" | grep -v '^\.cache$')" ] || { ls -A "$HOME"; exit 1; }
SH
if ! within "$root" bash -eu /root/user.sh >"$scratch/user.log" 2>&1; then
    tail -n 40 "$scratch/user.log"
    exit 1
fi
tail -n 14 "$scratch/user.log"
grep -q 'features moved, cost .* verified: True' "$scratch/user.log"
within "$root" dpkg -L python3-sunder >"$scratch/ours"
within "$root" apt-get purge -y python3-sunder >"$scratch/apt.log" 2>&1
while read -r name; do
    [[ ! -f $root$name ]] || { echo "left behind: $name"; exit 1; }
done <"$scratch/ours"
[[ ! -e $root/usr/lib/python3/dist-packages/sunder ]] || { echo "left behind: the folder of the package"; exit 1; }
echo "removed: nothing is left"
