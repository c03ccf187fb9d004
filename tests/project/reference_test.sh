#!/bin/bash
# The API reference is made without a warning.
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
# make SETTING...: the reference with further settings
make() {
    (
        cat sdk/docs/Doxyfile
        printf '%s\n' "OUTPUT_DIRECTORY = $scratch" "$@"
    ) | doxygen -
}
# Negative control: a comment about a parameter that is not there must be found.
printf '%s\n' '/// \file' '' '/// Does it.' '/// \param y none' 'void f(int x);' >"$scratch/bad.h"
if make "INPUT = $scratch/bad.h" >/dev/null 2>&1; then
    echo "doxygen finds nothing in a comment about a parameter that is not there"
    exit 1
fi
make
# The landing page has what it is to have
for text in 'The layers' 'tryon_8h.html' 'try_on'; do
    grep -q "$text" "$scratch/html/index.html"
done
