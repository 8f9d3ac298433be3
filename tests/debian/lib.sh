# shellcheck shell=bash
# Root directories of Debian releases, made by debootstrap, for tests of packages. Needs root and a mirror; otherwise
# the test is skipped (77).
#
#   SUNDER_DEBIAN_MIRROR     (http://deb.debian.org/debian)
#   SUNDER_DEBIAN_ROOTS      folder that keeps a plain root of each release from run to run (none)
set -euo pipefail
mirror=${SUNDER_DEBIAN_MIRROR:-http://deb.debian.org/debian}
source=$SUNDER_SOURCE

skip() {
    echo "skipped: $*"
    exit 77
}

[[ $(id -u) == 0 ]] || skip "only root can make a root of Debian"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"
for tool in cmake cpack dpkg-deb lintian; do command -v $tool >/dev/null || skip "$tool is not installed"; done

scratch=$(mktemp -d /var/tmp/sunder-debian.XXXXXX)
roots=()
leave() {
    local root
    for root in ${roots[@]+"${roots[@]}"}; do
        umount "$root/dev" "$root/proc" 2>/dev/null || true
        if mountpoint -q "$root/dev" || mountpoint -q "$root/proc"; then
            echo "$root is left: it is still in use" >&2
            return
        fi
    done
    rm -rf "$scratch"
}
trap leave EXIT

# A plain root of a release: a copy of the kept one, or a new one. No service is started in it.
make_root() { # RELEASE ROOT
    local kept=${SUNDER_DEBIAN_ROOTS:+$SUNDER_DEBIAN_ROOTS/$1}
    if [[ $kept && -e $kept/etc/debian_version ]]; then
        cp -a "$kept" "$2"
    else
        debootstrap --variant=minbase "$1" "$2" "$mirror" >"$scratch/debootstrap.log" 2>&1 ||
            { tail -n 3 "$scratch/debootstrap.log"; skip "no root of $1 could be made"; }
        if [[ $kept ]]; then
            mkdir -p "$SUNDER_DEBIAN_ROOTS"
            cp -a "$2" "$kept"
        fi
    fi
    printf '#!/bin/sh\nexit 101\n' >"$2/usr/sbin/policy-rc.d"
    chmod 755 "$2/usr/sbin/policy-rc.d"
    roots+=("$2")
    mount -t proc proc "$2/proc"
    mount --bind /dev "$2/dev"
}

within() { # ROOT COMMAND...
    local root=$1
    shift
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        QT_QPA_PLATFORM=offscreen "$@"
}

# Makes packages of the present sources, for the release of that root, in a folder. No build files are left in the root.
build_packages() { # ROOT FOLDER; the ROOT / is this machine
    local tree=$1/var/tmp/sunder-source
    [[ $1 != / ]] || tree=$scratch/source
    mkdir -p "$tree" "$2"
    tar -C "$source" --exclude=./build --exclude=./.git -cf - . | tar -C "$tree" -xf -
    if [[ $1 == / ]]; then
        (cd "$tree" && cmake --preset package && cmake --build --preset package -j "$(nproc)" && cd build/package && cpack)
    else
        within "$1" apt-get update
        within "$1" apt-get install -y --no-install-recommends cmake make gcc libc6-dev libgdal-dev libgmp-dev dpkg-dev file
        within "$1" sh -c 'cd /var/tmp/sunder-source && cmake --preset package && cmake --build --preset package -j "$(nproc)" &&
            cd build/package && cpack'
    fi >"$scratch/build.log" 2>&1 || { tail -n 20 "$scratch/build.log"; echo "the packages could not be built"; exit 1; }
    if grep -i "warning:" "$scratch/build.log"; then echo "warnings, building"; exit 1; fi
    cp "$tree"/build/package/*.deb "$2"
    rm -rf "$tree"
}

# Installs the packages in a root without sources, runs their programs, removes them, and lists the files that are left.
try_packages() { # ROOT FOLDER
    local root=$1 name
    mkdir -p "$root/packages"
    cp "$2"/*.deb "$root/packages"
    within "$root" apt-get update >"$scratch/apt.log" 2>&1
    within "$root" sh -c 'apt-get install -y --no-install-recommends /packages/*.deb gcc libc6-dev pkg-config man-db gdal-bin' \
        >>"$scratch/apt.log" 2>&1 || { tail -n 20 "$scratch/apt.log"; echo "the packages could not be installed"; exit 1; }
    rm -r "$root/packages"
    cp "$source/tests/debian/use.sh" "$source/tests/package/sum.c" "$root/tmp"
    within "$root" sh /tmp/use.sh
    names=$(for name in "$2"/*.deb; do dpkg-deb -f "$name" Package; done)
    # shellcheck disable=SC2086 # words
    within "$root" dpkg -L $names | sort -u >"$scratch/ours"
    # shellcheck disable=SC2086
    within "$root" apt-get purge -y $names >>"$scratch/apt.log" 2>&1
    find "$root" -xdev -path "$root/proc" -prune -o \( -name 'sunder*' -o -name 'libsunder*' -o -name 'qgis-plugin-sunder*' \) -not -path "$root/tmp/*" -not -path "$root/root/*" \
        -not -path "$root/var/cache/*" -not -path "$root/var/lib/apt/*" -print >"$scratch/left"
    while read -r name; do
        if [[ -f $root$name ]]; then echo "$name"; fi
    done <"$scratch/ours" >>"$scratch/left"
    if [[ -s $scratch/left ]]; then
        echo "left behind:"
        cat "$scratch/left"
        exit 1
    fi
    echo "removed: nothing is left"
}
