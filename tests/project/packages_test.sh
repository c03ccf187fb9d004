#!/bin/bash
# Every program that a test looks for comes with a package that samples/install-packages installs.
# packages_test.sh REPOSITORY
set -euo pipefail
cd "$1"

# The package of each program, where that is not apt's or dpkg's
declare -A package=(
    [aarch64-linux-gnu-g++]=g++-aarch64-linux-gnu
    [busybox]=busybox-static
    [clang++]=clang
    [clang-format]=clang-format
    [clang-tidy]=clang-tidy
    [cpio]=cpio
    [debootstrap]=debootstrap
    [doxygen]=doxygen
    [gcc-12]=gcc
    [gnuplot]=gnuplot-nox
    [gphoto2]=gphoto2
    [make]=make
    [mke2fs]=e2fsprogs
    [ociocheck]=opencolorio-tools
    [oiiotool]=openimageio-tools
    [qemu-system-x86_64]=qemu-system-x86
    [xz]=xz-utils
)
# Of Debian itself; ccache is used where it is there, and nothing is skipped without it; the benchmark
# that needs blender says how to install it
known=' apt-get apt-cache dpkg-deb ccache blender '

words() {
    sed -n '/^packages=(/,/^esac/p' samples/install-packages | sed 's/#.*//' | tr -s ' ()+=' '\n'
    # the names with a plus sign
    sed -n '/^packages=(/,/^esac/p' samples/install-packages | sed 's/#.*//' | tr -s ' ()' '\n'
}
installed=$(words | sort -u)
sought=$(grep -rhoE 'command -v +[a-z][a-z0-9_+-]*|for tool in [^;$]*|^compiler=[a-z0-9+-]*|CMAKE_CXX_COMPILER=[a-z+]+' \
    tests --include='*.sh' --include='*.cpp' --include=run --include=prepare --exclude=packages_test.sh |
    sed -E 's/^(command -v +|for tool in |compiler=|CMAKE_CXX_COMPILER=)//' | tr ' ' '\n' |
    sed 's/-$//' | sort -u)
status=0
found=0
for program in $sought; do
    case $known in *" $program "*) continue ;; esac
    found=$((found + 1))
    name=${package[$program]:-}
    if [ -z "$name" ]; then
        echo "a test looks for $program: this script does not say in which package it is"
        status=1
    elif ! grep -qxF -- "$name" <<<"$installed"; then
        echo "a test looks for $program: samples/install-packages does not install $name"
        status=1
    fi
done
echo "$found programs"
[ "$found" -ge ${#package[@]} ] || {
    echo "the tests look for fewer programs than this script knows: $sought"
    status=1
}
# libFuzzer and the sanitizers of clang are in a package of their own
grep -qxF libclang-rt-dev <<<"$installed" || {
    echo "tests/fuzz/run needs libclang-rt-dev"
    status=1
}
exit $status
