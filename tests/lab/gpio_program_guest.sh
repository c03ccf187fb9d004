#!/bin/sh
# Runs inside the guest of gpio_bed/run: the program `tsuya` as it is built, with all its libraries.
# $1: tsuya, $2: a plan of 8 frames, whose pictures lie in /pictures. Ends with 0, or with 1.
tsuya=$1
plan=$2
. /gpio_checks.sh
. /gpio_rig.sh

"$tsuya" lab lines >said 2>&1
check "lab lines ends with status 0" [ $? = 0 ]
check "lab lines names a line and its direction" says '^gpiochip0  board  0  .*put  *lamp'

fresh_trace
"$tsuya" lab pulse --line shutter --lamp-line lamp --count 3 >said 2>&1
check "lab pulse ends with status 0" [ $? = 0 ]
check "lab pulse tells the mean width" says 'mean width 20\.0'
check "lab pulse: the shutter moves 3 times" was_driven shutter 0 "0 1 0 1 0 1 0"
check "lab pulse: the lamp goes on once and off" was_driven lamp 0 "0 1 0"

echo pull-up >/gpio/interlock/pull
fresh_trace
"$tsuya" lab run "$plan" -o session </dev/null >said 2>&1
check "lab run ends with status 0" [ $? = 0 ]
cat said
check "lab run has all frames" says '^8 of 8 frames'
check "lab run: each frame counts once" counts_each_once session 8
check "lab run: the lamp is lit once" was_driven lamp 0 "0 1 0"
check "lab run: the shutter is shut" last_driven_off shutter 0
gpio-trace | awk '$2 == "shutter" && $3 == "set" && $4 == 1 { n++ } END { print n + 0 }' >opened
check "lab run: it opened for each frame that is not dark" \
    [ "$(cat opened)" = "$(($(grep -c '"kind":"ok"' session/journal.jsonl) - 2))" ]

# The stop of a second session, while the lamp warms up.
sleep 1000
fresh_trace
setsid "$tsuya" lab run "$plan" -o second </dev/null >said 2>&1 &
program=$!
check "a second session lights the lamp" await_level lamp 1 60
start=$(now)
kill -s INT "$program"
wait "$program"
check "SIGINT of lab run: status 3" [ $? = 3 ]
check "SIGINT of lab run: the lamp is driven off within 0.25 s" within lamp 0 "$start" 0.25

finish_checks "the program"
