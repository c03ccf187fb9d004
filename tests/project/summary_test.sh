#!/bin/bash
# tests/summary on a log with every kind of ending.
# summary_test.sh SUMMARY
set -euo pipefail

# entry NAME VERDICT OUTPUT, as ctest logs it
entry() {
    printf '%s\n' "1/9 Testing: $1" "1/9 Test: $1" "Command: \"x\"" "\"$1\" start time: Nov 28" \
        "Output:" "----------" "$3" "<end of output>" "Test time =   0.21 sec" "----------" \
        "Test $2." "\"$1\" end time: Nov 28" "----------" ""
}
log() {
    entry program Passed "[ RUN      ] A.Good
[       OK ] A.Good (3 ms)
[ RUN      ] A.NeedsData
a_test.cpp:7: Skipped
no data here

[  SKIPPED ] A.NeedsData (0 ms)
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] A.NeedsData"
    entry wrong Failed "[  FAILED  ] B.Bad/0, where GetParam() = 1 (2 ms)
[       OK ] B.Good (0 ms)
[  FAILED  ] B.Bad/0, where GetParam() = 1"
    entry crash Failed "[ RUN      ] C.Ends"
    entry script Passed "all is well"
    entry bed Passed "tsuya: skipped: no bed"
    entry last Passed "still well"
}
expected='skipped: program A.NeedsData: no data here
skipped: bed: no bed
4 passed, 2 failed, 2 skipped'
got=$("$1" <(log))
if [ "$got" != "$expected" ]; then
    diff <(echo "$expected") <(echo "$got")
    exit 1
fi
