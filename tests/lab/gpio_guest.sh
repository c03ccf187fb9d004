#!/bin/sh
# Runs inside the guest of run-with-gpio: lamp and shutter of a real kernel device.
# $1: the program gpio_pulses. Ends with 0 and "gpio: all N checks passed", or with 1.
pulses=$1
failed=0
checks=0

check() { # check WHAT COMMAND...
    what=$1
    shift
    checks=$((checks + 1))
    if "$@"; then echo "ok   $what"; else echo "FAIL $what"; failed=$((failed + 1)); fi
}
level() { cat "/gpio/$1/value"; }
is_level() { [ "$(level "$1")" = "$2" ]; }
says() { grep -q "$1" said; }
run() { "$pulses" "$@" >said 2>&1; }
await_level() { # the level of line $1 becomes $2 within 30 s
    tries=0
    until is_level "$1" "$2"; do
        tries=$((tries + 1))
        [ "$tries" -lt 300 ] || return 1
        sleep 0.1
    done
}
# What was driven on line $1 since trace line $2, such as "0 1 0 0".
driven() {
    gpio-trace | tail -n +$(($2 + 1)) | awk -v line="$1" '$2 == line && $3 == "set" { print $4 }' |
        tr '\n' ' ' | sed 's/ $//'
}
trace_length() { gpio-trace | wc -l; }
was_driven() { # was_driven LINE SINCE VALUES
    got=$(driven "$1" "$2")
    [ "$got" = "$3" ] || { echo "     $1 was driven: $got; expected: $3"; return 1; }
}
# Letting go of a line leaves no trace: its last command since trace line $2 was off.
last_driven_off() { got=$(driven "$1" "$2"); [ "${got##* }" = 0 ]; }

# A normal train. The request drives off first; the guard and the line's destructor once more.
since=$(trace_length)
run gpiochip0 shutter lamp 20 100 3
check "a train ends with status 0" [ $? = 0 ]
cat said
check "the report names 3 pulses" says '^3 pulses'
check "the shutter moved 3 times" was_driven shutter "$since" "0 1 0 1 0 1 0 0 0"
check "the lamp went on once and off" was_driven lamp "$since" "0 1 0 0"
check "the lamp is off" is_level lamp 0
check "the shutter is closed" is_level shutter 0

# A signal in the middle of a pulse of ten minutes.
for signal in TERM INT HUP QUIT; do
    since=$(trace_length)
    setsid "$pulses" gpiochip0 shutter lamp 600000 700000 5 >said 2>&1 &
    program=$!
    check "the shutter opens before SIG$signal" await_level shutter 1
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

# Active low: off is the high level, and the request itself already drives it.
since=$(trace_length)
run gpiochip0 shutter lamp 20 100 1 low
check "active low: off is 1 on the wire" was_driven lamp "$since" "1 0 1 1"

[ "$failed" = 0 ] && echo "gpio: all $checks checks passed"
[ "$failed" = 0 ]
