#!/bin/bash
# The API reference is made without a warning, and every public type and function has a comment.
# reference_test.sh REPOSITORY SCRATCH
# Skipped (status 77) without doxygen.
set -euo pipefail
cd "$1"
scratch=$2

if ! command -v doxygen >/dev/null; then
    echo "tsuya: skipped: no doxygen (package doxygen)"
    exit 77
fi
mkdir -p "$scratch"
# findings SETTING...: makes the reference with further settings, prints what is wrong with it. No
# comment is needed by a comparison, a defaulted function, and a variable or value whose name says all.
findings() {
    {
        cat sdk/docs/Doxyfile
        printf '%s\n' "OUTPUT_DIRECTORY = $scratch" "$@"
    } | doxygen - 2>&1 >/dev/null |
        grep -vE '\((variable|enumvalue)\) of .* is not documented|(operator==|=default)\(?.* is not documented' || true
}
# Negative controls: a comment about a parameter that is not there, a type and a function without one
printf '%s\n' '/// \file' '' '/// Does it.' '/// \param y none' 'void f(int x);' >"$scratch/parameter.h"
printf '%s\n' '/// \file' 'struct S {' '    int x;' '};' >"$scratch/type.h"
printf '%s\n' '/// \file' 'void f(int x);' >"$scratch/function.h"
printf '%s\n' '/// \file' '' '/// Is one.' 'struct S {' '    int x;' \
    '    bool operator==(const S &) const = default;' '};' >"$scratch/good.h"
for bad in parameter type function; do
    if [ -z "$(findings "INPUT = $scratch/$bad.h")" ]; then
        echo "nothing is found in $bad.h, whose comments are wrong"
        exit 1
    fi
done
for headers in */include */*/include; do
    if [ "$(grep -cE "(^| )$headers( |$)" sdk/docs/Doxyfile)" != 2 ]; then
        echo "sdk/docs/Doxyfile: $headers is to stand in INPUT and in STRIP_FROM_INC_PATH"
        exit 1
    fi
done
for sources in "INPUT = $scratch/good.h" ""; do
    if [ -n "$(findings "$sources" | tee /dev/stderr)" ]; then
        exit 1
    fi
done
# The landing page has what it is to have
for text in 'The layers' 'tryon_8h.html' 'try_on'; do
    grep -q "$text" "$scratch/html/index.html"
done
