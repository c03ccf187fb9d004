#!/bin/bash
# Every C++ file of the repository against its .clang-format.
# format_test.sh REPOSITORY
# Versions of clang-format differ, so that one is asked for; skipped (status 77) without it.
set -euo pipefail
cd "$1"

version=14
tool=$(command -v clang-format-$version || command -v clang-format || true)
if [ -z "$tool" ] || ! "$tool" --version | grep -q "version $version\."; then
    echo "tsuya: skipped: no clang-format $version (package clang-format)"
    exit 77
fi
# Negative control: a file that is badly formatted must be found.
if "$tool" --dry-run -Werror --assume-filename="$PWD/bad.cpp" <<<'int  x ;' 2>/dev/null; then
    echo "clang-format finds nothing in a badly formatted file"
    exit 1
fi
# Outside a clone of git: what is there, without what was built
files() {
    git ls-files -z '*.h' '*.cpp' 2>/dev/null ||
        find . \( -name build -o -name out -o -name '.?*' \) -prune -o -name '*.h' -print0 \
            -o -name '*.cpp' -print0
}
files | xargs -0 -P "$(nproc)" -n 40 "$tool" --dry-run -Werror --style=file
