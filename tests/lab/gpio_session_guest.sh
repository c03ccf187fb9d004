#!/bin/sh
# Runs inside the guest of gpio_bed/run: sessions with lamp, shutter, interlock and emergency stop on a
# real kernel device, in virtual time. $1: the program gpio_session. Ends with 0, or with 1.
session=$1
. /gpio_checks.sh
. /gpio_rig.sh

run() { "$session" run "$1" >said 2>&1; }
start_run() { # run session $1 in the background, as $program, until the shutter is open after $2 s
    fresh_trace
    setsid "$session" run "$1" >said 2>&1 &
    program=$!
    sleep "$2" # the lamp is warm after 60 s, and steady after 190
    check "the shutter opens" await_level shutter 1 60
    worker=$(children_of "$program")
    start=$(now)
}

echo pull-up >/gpio/interlock/pull

# A warm-up of a quarter of an hour, then every frame.
write_rig slow 900 1
"$session" create slow.rig.toml slow
fresh_trace
run slow
check "a session ends with status 0" [ $? = 0 ]
cat said
check "it has all frames" says '^8 of 8 frames'
check "each frame counts once" counts_each_once slow 8
check "the lamp was lit once" was_driven lamp 0 "0 1 0"
check "the shutter is shut" last_driven_off shutter 0
gpio-trace | awk '$3 == "set" && $4 == 1 { if ($2 == "lamp") lit = $1; if ($2 == "shutter" && !open) open = $1 }
    END { print "     the shutter opened " open - lit " s after the lamp was lit"
          exit !(open - lit >= 900 && open - lit < 905) }'
check "the lamp warmed up for 900 s" [ $? = 0 ]

# A hot lamp is not lit: by another program, a while later, after another start of the computer, and where
# its clock was set back.
"$session" create slow.rig.toml later
fresh_trace
refused() { # refused PATTERN
    run later
    [ $? = 1 ] && says "may not be lit again for $1" || { cat said; return 1; }
}
check "a hot lamp is not lit again" refused '1[45] min'
sleep 600
check "after 10 minutes it is hot" refused '\(5 min 0\|4 min 5[0-9]\) s'
cat /proc/sys/kernel/random/uuid >other_boot
mount --bind other_boot /proc/sys/kernel/random/boot_id
check "another start of the computer changes nothing" refused '\(5 min 0\|4 min 5[0-9]\) s'
date -s "@$(($(date +%s) - 3600))" >/dev/null
check "nor does a clock that was set back: all of the time counts" refused '15 min 0 s'
date -s "@$(($(date +%s) + 3600))" >/dev/null
umount /proc/sys/kernel/random/boot_id
check "the lamp was not lit" was_driven lamp 0 "0"

# The housing is opened, or the emergency stop pressed, in the middle of an exposure.
write_rig fast 60 5
"$session" create fast.rig.toml fast
for line in interlock estop; do
    start_run fast $([ $line = estop ] && echo 55 || echo 195)
    sleep 2
    before=$(grep -c '"kind":"ok"' fast/journal.jsonl)
    start=$(now)
    case $line in
    interlock) echo pull-down >/gpio/interlock/pull ;;
    estop) echo pull-up >/gpio/estop/pull ;;
    esac
    wait "$program"
    check "$line: status 1" [ $? = 1 ]
    cat said
    check "$line: the lamp is driven off within 0.25 s" within lamp 0 "$start" 0.25
    check "$line: the shutter, too" within shutter 0 "$start" 0.25
    check "$line: is named" says "gpiochip0:$line: "
    check "$line: the picture does not count" [ "$(grep -c '"kind":"ok"' fast/journal.jsonl)" = "$before" ]
    echo pull-up >/gpio/interlock/pull
    echo pull-down >/gpio/estop/pull
    sleep 1000
    fresh_trace
    run fast
    check "$line: the fault stays" says 'was not acknowledged yet'
    check "$line: no lamp is lit meanwhile" was_driven lamp 0 "0"
    "$session" reset fast.rig.toml "tried"
done

# The work with a lit lamp dies or hangs; a signal ends a session.
for signal in KILL STOP SEGV; do
    start_run fast $([ $signal = SEGV ] && echo 55 || echo 195)
    before=$(grep -c '"kind":"ok"' fast/journal.jsonl)
    kill -s "$signal" "$worker"
    wait "$program"
    check "SIG$signal of the worker: status 1" [ $? = 1 ]
    check "SIG$signal of the worker: the lamp is driven off within 0.25 s" within lamp 0 "$start" 0.25
    check "SIG$signal of the worker: the shutter, too" within shutter 0 "$start" 0.25
    check "SIG$signal of the worker: it is gone" [ ! -e "/proc/$worker" ]
    check "SIG$signal of the worker: is told" says 'supervisor: the work \(hung\|was killed\)'
    check "SIG$signal of the worker: the picture does not count" \
        [ "$(grep -c '"kind":"ok"' fast/journal.jsonl)" = "$before" ]
    sleep 1000
    fresh_trace
    run fast # since when it has been off, nobody knows
    check "SIG$signal of the worker: the whole time counts from now" says 'again for 15 min 0 s'
    check "SIG$signal of the worker: no lamp is lit meanwhile" was_driven lamp 0 "0"
    sleep 1000
done
for signal in TERM INT HUP QUIT; do
    start_run fast 55
    kill -s "$signal" "$program"
    wait "$program"
    check "SIG$signal: status 3" [ $? = 3 ]
    check "SIG$signal: the lamp is driven off within 0.25 s" within lamp 0 "$start" 0.25
    check "SIG$signal: the shutter, too" within shutter 0 "$start" 0.25
    sleep 1000
done
check "the log tells of lamps that were lit when a program was killed" \
    [ "$(grep -c 'the program ended while the lamp was lit' fast.lamp.log)" = 3 ]
run fast
check "the session is finished in the end" [ $? = 0 ]
cat said
check "each frame counts once after all" counts_each_once fast 8

finish_checks "sessions on lines"
