#!/bin/sh
# Runs inside the guest of gpio_bed/run: lamp and shutter of a real kernel device.
# $1: the program gpio_pulses, $2: gpio_watch, $3: tsuya, may be left out. Ends with 0 and "gpio: all N checks passed", or with 1.
pulses=$1
watch=$2
tsuya=$3
. /gpio_checks.sh

run() { "$pulses" "$@" >said 2>&1; }
start_long_pulse() { # a pulse of ten minutes in the background, as $program with the worker $worker
    echo >/sys/kernel/tracing/trace # a short trace is read quickly
    since=0
    setsid "$pulses" gpiochip0 shutter lamp 600000 700000 5 >said 2>&1 &
    program=$!
    sleep 0.3 # looking at once would take time of the opening on the one processor
    await_level shutter 1
    worker=$(children_of "$program")
}

# A normal train. The request drives off first; the guard and the line's destructor once more.
since=$(trace_length)
run gpiochip0 shutter lamp 20 100 3
check "a train ends with status 0" [ $? = 0 ]
cat said
check "the report names 3 pulses" says '^3 pulses'
check "the shutter moved 3 times" was_driven shutter "$since" "0 1 0 1 0 1 0"
check "the lamp went on once and off" was_driven lamp "$since" "0 1 0"
check "the lamp is off" is_level lamp 0
check "the shutter is closed" is_level shutter 0
gpio-trace | tail -n +$((since + 1)) | awk '
    $2 == "shutter" && $3 == "set" && $4 != last {
        if (last == 1) { width = 1000 * ($1 - on); print "     width " width " ms"
                         bad += width < 19.9 || width > 20.1; n++ }
        last = $4; on = $1 }
    END { exit bad > 0 || n != 3 }'
check "each pulse is 20.0 ms wide within 0.1 ms" [ $? = 0 ]

# A signal in the middle of a pulse of ten minutes.
for signal in TERM INT HUP QUIT; do
    start_long_pulse
    check "the shutter opens before SIG$signal" is_level shutter 1
    check "the lamp is lit before SIG$signal" is_level lamp 1
    "$pulses" gpiochip0 shutter lamp 20 100 1 >second 2>&1
    check "a second program learns who holds the line" grep -q "busy.*held by 'tsuya'" second
    kill -s "$signal" "$program"
    wait "$program"
    check "SIG$signal ends with status 3" [ $? = 3 ]
    check "SIG$signal: the message" says 'stopped after 0 of 5'
    check "SIG$signal: the lamp is off" is_level lamp 0
    check "SIG$signal: the shutter is closed" is_level shutter 0
    check "SIG$signal: the lamp was driven off, not only let go" last_driven_off lamp "$since"
    check "SIG$signal: the shutter was driven off" last_driven_off shutter "$since"
done

# A second signal while the first is dealt with kills nothing.
twice_off=0
for try in $(seq 50); do
    start_long_pulse
    kill -s INT "$program"
    kill -s INT "$program"
    wait "$program"
    [ $? = 3 ] && last_driven_off lamp "$since" && last_driven_off shutter "$since" &&
        twice_off=$((twice_off + 1))
done
check "SIGINT twice leaves all off with status 3, 50 times" [ "$twice_off" = 50 ]

# The worker dies or hangs: the supervisor, which holds the lines, drives them off.
for signal in KILL STOP SEGV; do
    start_long_pulse
    check "there is one worker" [ "$(echo $worker | wc -w)" = 1 ]
    start=$(now)
    kill -s "$signal" "$worker"
    wait "$program"
    check "SIG$signal of the worker ends with status 1" [ $? = 1 ]
    check "SIG$signal of the worker: the lamp is driven off within 0.25 s" within lamp "$since" "$start" 0.25
    check "SIG$signal of the worker: the shutter, too" within shutter "$since" "$start" 0.25
    check "SIG$signal of the worker is told" says 'supervisor: the work \(hung\|was killed\)'
    check "SIG$signal: no worker is left" [ ! -e "/proc/$worker" ]
done

# The supervisor dies: the worker ends by itself.
start_long_pulse
start=$(now)
kill -s KILL "$program"
wait "$program"
check "a worker without supervisor drives off" await_level lamp 0
check "within 0.25 s" within lamp "$since" "$start" 0.25

# Commands that are executed inherit no line.
start_long_pulse
open=0
held=0
for descriptor in /proc/"$worker"/fd/*; do
    case $(readlink "$descriptor") in *gpio*)
        held=$((held + 1))
        grep -q '^flags:[[:space:]]*0*[0-7]*[2367][0-7]\{6\}$' "/proc/$worker/fdinfo/${descriptor##*/}" ||
            open=$((open + 1)) ;;
    esac
done
check "the worker holds lines" [ "$held" -ge 2 ]
check "each is closed on execution" [ "$open" = 0 ]
kill "$program"
wait "$program"

# Nobody reads what the program says.
mkfifo full
sleep 100000 <full &
reader=$!
head -c 65536 /dev/zero >full
since=$(trace_length)
"$pulses" gpiochip0 shutter lamp 20 100 5 >out 2>full &
program=$!
sleep 5 # looking in between would take the pulses' time on the one processor
check "a full pipe holds up no pulse" was_driven shutter "$since" "0 1 0 1 0 1 0 1 0 1 0"
check "a full pipe holds no lit lamp" was_driven lamp "$since" "0 1 0"
kill "$reader"
wait "$reader"
wait "$program"
check "when the reader is gone the program ends with status 0" [ $? = 0 ]
since=$(trace_length)
"$pulses" gpiochip0 shutter lamp 20 100 3 >out 2>&-
check "a closed stderr is no error" [ $? = 0 ]
check "all pulses are done without stderr" was_driven shutter "$since" "0 1 0 1 0 1 0"

# Inputs: the kernel stamps the edges.
"$watch" gpiochip0 interlock 3 >watched 2>&1 &
program=$!
sleep 1
start=$(now)
echo pull-up >/gpio/interlock/pull
sleep 0.1
echo pull-down >/gpio/interlock/pull
wait "$program"
check "watching ends with status 0" [ $? = 0 ]
check "an edge has its time" awk -v start="$start" '
    NR == 1 && !/inactive/ { exit 1 }
    NR == 2 { d = $1 - start; if ($2 != "active" || d < -0.02 || d > 0.05) exit 1 }
    NR == 3 { d = $1 - start; if ($2 != "inactive" || d < 0.09 || d > 0.2) exit 1 }
    END { if (NR != 3) exit 1 }' watched
"$watch" gpiochip0 interlock 1 low >watched
check "active low: the low level is active" grep -q "is active" watched

# Errors say what, where and what would be accepted.
run gpiochip0 shuter lamp 20 100 1
check "a wrong name ends with status 1" [ $? = 1 ]
check "a wrong name gets a suggestion" says "gpiochip0: there is no GPIO line 'shuter'.*did you mean shutter"
run gpiochip7 shutter lamp 20 100 1
check "a wrong chip is named with those that exist" says 'gpiochip7: there is no such GPIO chip.*gpiochip0'
run gpiochip0 5 lamp 20 100 1
check "a line that the kernel holds is busy" says "gpiochip0:5: .*busy.*held by 'held'"
run "" nosuchline lamp 20 100 1
check "every chip is searched without a chip" says "there is no GPIO line 'nosuchline'"
run "" shutter lamp 20 100 1
check "a name is enough" says '^1 pulses'
run gpiochip0 1 0 20 100 1
check "offsets work" says '^1 pulses'
run gpiochip0 99 0 20 100 1
check "an offset beyond the chip is no line" says "there is no GPIO line '99'"

run board shutter lamp 20 100 1
check "a chip's label works" says '^1 pulses'
run 0 shutter lamp 20 100 1
check "a chip's number works" says '^1 pulses'
run /dev/gpiochip0 shutter lamp 20 100 1
check "a chip's path works" says '^1 pulses'
run "" twice lamp 20 100 1
check "an ambiguous name is refused" says "2 GPIO lines are named 'twice'"
since=$(trace_length)
run 0 lamp 0 20 100 1
check "one line under two names is refused" says 'lamp: is the same line as shutter'
check "and was not taken" was_driven lamp "$since" ""

# Active low: off is the high level, and the request itself already drives it.
since=$(trace_length)
run gpiochip0 shutter lamp 20 100 1 low
check "active low: off is 1 on the wire" was_driven lamp "$since" "1 0 1"

# The commands of the program.
check_commands() {
    "$tsuya" lab lines >said 2>&1
    check "lab lines ends with status 0" [ $? = 0 ]
    cat said
    check "lab lines names a line and its direction" says '^gpiochip0  board  0  .*put  *lamp'
    check "lab lines names who holds a line" says '^gpiochip0 .* held$'
    "$tsuya" lab lines --json >said
    check "lab lines --json names the other chip" says '"label": "spare"'
    since=$(trace_length)
    "$tsuya" lab pulse --line shutter --lamp-line lamp --lamp-active-low --count 3 >said 2>&1
    check "lab pulse ends with status 0" [ $? = 0 ]
    check "lab pulse tells the mean width" says 'mean width 20\.0'
    check "lab pulse: each line has its own level" was_driven lamp "$since" "1 0 1"
    check "lab pulse: the shutter, too" was_driven shutter "$since" "0 1 0 1 0 1 0"
    twice_off=0
    for signal in INT TERM HUP QUIT TSTP INT INT INT INT INT; do
        echo >/sys/kernel/tracing/trace
        since=0
        setsid "$tsuya" lab pulse --line shutter --lamp-line lamp --width-ms 600000 \
            --period-ms 700000 >said 2>&1 &
        program=$!
        sleep 0.5
        await_level shutter 1
        kill -s "$signal" "$program"
        kill -s INT "$program"
        wait "$program"
        [ $? = 3 ] && says 'stopped after 0 of 5' && last_driven_off lamp "$since" &&
            last_driven_off shutter "$since" && twice_off=$((twice_off + 1))
    done
    check "lab pulse: two signals leave all off with status 3, 10 times" [ "$twice_off" = 10 ]
    mkfifo progress
    sleep 100000 <progress &
    reader=$!
    head -c 65536 /dev/zero >progress
    since=$(trace_length)
    "$tsuya" --progress plain lab pulse --line shutter --lamp-line lamp --count 5 >out 2>progress &
    program=$!
    sleep 5
    check "lab pulse: a full pipe holds up no pulse" was_driven shutter "$since" "0 1 0 1 0 1 0 1 0 1 0"
    check "lab pulse: a full pipe holds no lit lamp" was_driven lamp "$since" "0 1 0"
    kill -s INT "$program"
    wait "$program"
    check "lab pulse: a signal ends it when the lines are let go" [ $? = 3 ]
    kill "$reader"
    wait "$reader"
    "$tsuya" --progress plain lab pulse --line shutter --count 3 >said 2>&-
    check "lab pulse: a closed stderr is no error" [ $? = 0 ]
    su stranger -s /bin/sh -c "$tsuya lab lines" >said 2>&1
    check "a stranger may not see the lines" [ $? != 0 ]
    check "a stranger is told the rule" says 'SUBSYSTEM=="gpio"'
}
[ -z "$tsuya" ] || check_commands

# A user outside the device's group is told which group it is.
su stranger -s /bin/sh -c "cd /tmp; $pulses gpiochip0 shutter lamp 20 100 1" >said 2>&1
check "a stranger may not drive the lines" [ $? = 1 ]
check "a stranger is told the group" says 'Permission denied; a user of the group'

# The chip is unplugged: noticed at once, not at the next edge.
"$watch" gpiochip1 twice 100000 >watched 2>&1 &
watcher=$!
"$pulses" gpiochip1 2 spare_lamp 600000 700000 5 >said 2>&1 &
program=$!
sleep 1
check "the lamp on the other chip is lit" is_level spare_lamp 1
start=$(now)
for live in /sys/kernel/config/gpio-sim/*/live; do
    grep -q spare "${live%/live}"/*/label && echo 0 >"$live"
done
wait "$program"
status=$?
end=$(now)
cat said
check "an unplugged chip ends with status 1" [ "$status" = 1 ]
check "an unplugged chip is noticed within 1 s" awk -v a="$start" -v b="$end" 'BEGIN { exit !(b - a < 1) }'
check "and told" says 'gpiochip1:spare_lamp: the GPIO line is gone: No such device'
wait "$watcher"
check "who waits for an input is told, too" grep -q 'gpiochip1:twice: .*No such device' watched

finish_checks gpio
