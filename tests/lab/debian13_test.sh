#!/bin/bash
# The rig on Debian 13, which has libgpiod 2: configured, built and tested in a root of its own.
# debian13_test.sh SOURCE SCRATCH KERNEL
#   SCRATCH  gets the root of Debian 13 (300 MB to download, 1.2 GB), which is kept, and the build
#   KERNEL   what gpio_bed/prepare made: then the programs also drive lines of a kernel device
# Skipped (status 77) where the root cannot be made.
set -euo pipefail

source=$1 scratch=$2 kernel=$3
suite=trixie
packages=g++,cmake,ninja-build,pkg-config,libtomlplusplus-dev,libglm-dev,libeigen3-dev,nlohmann-json3-dev,libgpiod-dev,libgtest-dev
skip() {
    echo "tsuya: skipped: $*"
    exit 77
}
[ "$(id -u)" = 0 ] || skip "not root, so no root of Debian 13 can be made"
command -v debootstrap >/dev/null || skip "no debootstrap (samples/install-packages test)"
unshare -m true 2>/dev/null || skip "nothing may be mounted here"
mkdir -p "$scratch"
scratch=$(realpath "$scratch")
root=$scratch/root

if [ ! -e "$root/complete" ]; then
    rm -rf "$root"
    # From the mirror that apt uses here
    made=
    for mirror in $(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | sort -u |
        grep 'debian/*$'); do
        debootstrap --variant=minbase "--include=$packages" "$suite" "$root" "$mirror" && made=yes && break
    done
    [ -n "$made" ] || skip "no mirror of apt gives a root of Debian 13"
    touch "$root/complete"
fi

# in_root COMMAND...: the mounts end with the command.
in_root() {
    unshare -m sh -euc 'root=$1; shift
        mount --make-rprivate /
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        exec chroot "$root" "$@"' sh "$root" env -i PATH=/usr/bin:/usr/sbin:/bin HOME=/ "$@"
}
rm -rf "$root/tsuya"
mkdir "$root/tsuya"
(cd "$source" && tar -c --exclude=./build --exclude=./out --exclude=./.git --exclude=./.cache .) |
    tar -x --no-same-owner -C "$root/tsuya"
in_root cmake -S /tsuya -B /build -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release \
    -DTSUYA_RIG_ONLY=ON -DTSUYA_RIG_TESTS=ON -DTSUYA_WARNINGS_AS_ERRORS=ON
in_root cmake --build /build
in_root sh -c 'cd /build && ctest --output-on-failure --no-tests=error'
in_root pkg-config --atleast-version=2 libgpiod
in_root ldd /build/tests/lab/gpio_pulses | grep libgpiod

if [ ! -s "$kernel/release" ]; then
    echo "the lines of a kernel device were not driven: no kernel in $kernel"
    exit 0
fi
programs=/build/tests/lab
bed=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/gpio_test.sh
"$bed" lines "$kernel" "$root" $programs/gpio_pulses $programs/gpio_watch
"$bed" sessions "$kernel" "$root" $programs/gpio_session
