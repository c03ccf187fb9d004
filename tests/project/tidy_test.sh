#!/bin/bash
# clang-tidy by the checks of .clang-tidy, which fail on findings.
# tidy_test.sh REPOSITORY BUILD [all]
#   BUILD  has compile_commands.json
#   all    every source that the build compiles of the libraries and the program, not the central ones alone
# Versions of clang-tidy differ, so that one is asked for; skipped (status 77) without it.
set -euo pipefail
cd "$1"
build=$2

# Where each layer does its main work: a list, so that every run looks at the same
central=(
    sdk/values/src/document.cpp
    sdk/reflectance/src/fabric/fabric.cpp
    sdk/reflectance/src/models/yarn.cpp
    sdk/render/src/path_tracer.cpp
    sdk/render/src/render.cpp
    garment/src/garment.cpp
    color/src/relight.cpp
    lab/rig/src/pulse.cpp
    lab/goniometer/src/goniometer.cpp
    samples/scene/src/tryon.cpp
)

version=14
tool=$(command -v clang-tidy-$version || command -v clang-tidy || true)
if [ -z "$tool" ] || ! "$tool" --version | grep -q "version $version\."; then
    echo "tsuya: skipped: no clang-tidy $version (package clang-tidy)"
    exit 77
fi
# Negative control: what a check is for must be found.
bad=$(mktemp --suffix=.cpp)
trap 'rm -f "$bad"' EXIT
echo 'double half(int x) { return x / 2; }' >"$bad"
if "$tool" --quiet --config-file=.clang-tidy "$bad" -- -std=c++20 >/dev/null 2>&1; then
    echo "clang-tidy finds no integer division"
    exit 1
fi
# The headers that g++ compiled before are nothing to clang.
commands=$(mktemp -d)
trap 'rm -rf "$bad" "$commands"' EXIT
sed -E 's/ -Winvalid-pch -include [^ ]*cmake_pch\.hxx//' "$build/compile_commands.json" \
    >"$commands/compile_commands.json"
files=("${central[@]}")
if [ "${3:-}" = all ]; then
    # Those that this build compiles: of two versions of a library one
    mapfile -t files < <(sed -nE 's#^ *"file": "'"$1"'/((sdk|color|garment|lab|samples)/.*\.cpp)",?$#\1#p' \
        "$build/compile_commands.json" | sort -u)
fi
# The compiler's flags name a warning that clang does not know.
printf '%s\0' "${files[@]}" | xargs -0 -P "$(nproc)" -n 1 \
    "$tool" --quiet -p "$commands" --extra-arg=-Wno-unknown-warning-option 2> >(grep -v ' generated\.$')
