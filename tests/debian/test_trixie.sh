# shellcheck shell=bash
# Packages built from source in a root of Debian 13, which has a newer GDAL, are installed, run and removed in another
# root without sources.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
make_root trixie "$scratch/builder"
build_packages "$scratch/builder" "$scratch/packages"
make_root trixie "$scratch/root"
try_packages "$scratch/root" "$scratch/packages"
