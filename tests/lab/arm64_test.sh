#!/bin/bash
# The lab on 64-bit ARM, the rig's own computer, by the cross compiler of Debian.
# arm64_test.sh compile|link SOURCE SCRATCH TOMLPLUSPLUS_DIR
#   compile  builds values, rig and session (TSUYA_RIG_ONLY) and checks the other sources of the lab
#   link     links a program that pulses lines; needs what `compile` built, and libgpiod for ARM,
#            which is fetched from Debian into SCRATCH
# Skipped (status 77) where the compiler or the packages cannot be had.
set -euo pipefail

task=$1 source=$2 scratch=$3 tomlplusplus=$4
compiler=aarch64-linux-gnu-g++
skip() {
    echo "tsuya: skipped: $*"
    exit 77
}
command -v $compiler >/dev/null || skip "no $compiler (package g++-aarch64-linux-gnu)"
mkdir -p "$scratch"

compile() {
    # Only headers of other libraries are used here, and they are the same for every processor.
    cmake -S "$source" -B "$scratch/build" -G Ninja --log-level=WARNING \
        -DTSUYA_RIG_ONLY=ON -DTSUYA_WARNINGS_AS_ERRORS=ON \
        "-DCMAKE_CXX_COMPILER_LAUNCHER=${TSUYA_COMPILER_LAUNCHER:-}" \
        -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
        -DCMAKE_CXX_COMPILER=$compiler "-Dtomlplusplus_DIR=$tomlplusplus"
    cmake --build "$scratch/build"
    for layer in weave goniometer; do
        printf '%s\n' "$source/lab/$layer/src/"*.cpp
    done | xargs -P "$(nproc)" -n 4 $compiler -std=c++20 -fsyntax-only \
        -Wall -Wextra -Wconversion -Wshadow -Werror -I"$source/sdk/values/include" \
        -I"$source/lab/weave/include" -I"$source/lab/weave/src" \
        -I"$source/lab/goniometer/include" -I"$source/lab/goniometer/src"
}

# Debian's packages libgpiod-dev and libgpiod2 for ARM, unpacked in $scratch/root. The system's own
# lists of packages are left alone.
fetch() {
    [ ! -e "$scratch/root/complete" ] || return 0
    command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || return 1
    local suite
    suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    mkdir -p "$scratch"/apt/{lists/partial,archives/partial,none} "$scratch/root"
    : >"$scratch/apt/status"
    echo "deb [arch=arm64] http://deb.debian.org/debian $suite main" >"$scratch/apt/sources.list"
    local apt=(apt-get -q -o APT::Architecture=arm64 -o APT::Architectures::=arm64
        -o Acquire::Languages=none -o Acquire::Retries=1 -o Acquire::http::Timeout=20
        -o "Dir::State::Lists=$scratch/apt/lists" -o "Dir::State::status=$scratch/apt/status"
        -o "Dir::Cache=$scratch/apt" -o "Dir::Etc::sourceparts=$scratch/apt/none"
        -o "Dir::Etc::sourcelist=$scratch/apt/sources.list" -o "APT::Sandbox::User=$(id -un)")
    (cd "$scratch/apt" && "${apt[@]}" update && "${apt[@]}" download libgpiod-dev libgpiod2) ||
        return 1
    local package
    for package in "$scratch"/apt/*.deb; do
        dpkg-deb -x "$package" "$scratch/root"
    done
    rm -r "$scratch/apt"
    touch "$scratch/root/complete"
}

link() {
    fetch || skip "libgpiod for arm64 cannot be fetched from Debian"
    local program=$scratch/gpio_pulses
    $compiler -std=c++20 -I"$source/sdk/values/include" -I"$source/lab/rig/include" \
        "$source/tests/lab/gpio_pulses.cpp" -o "$program" \
        "$scratch/build/lab/rig/libtsuya_rig.a" "$scratch/build/sdk/values/libtsuya_values.a" \
        -L"$scratch/root/usr/lib/aarch64-linux-gnu" -lgpiodcxx -lgpiod
    # The machine of an ELF file is at bytes 18 and 19; 183 is AArch64.
    [ "$(od -An -tu2 -j18 -N2 "$program" | tr -d ' ')" = 183 ]
    ! aarch64-linux-gnu-readelf -d "$program" | grep NEEDED | grep -E 'tbb|embree'
}

case $task in
compile) compile ;;
link) link ;;
*) exit 2 ;;
esac
