#!/bin/sh
# Runs inside the guest of gpio_bed/run, at one start of several on the same disk: a lamp that was lit
# before the computer was started again. Ends with 0, or with 1.
# $1: the program gpio_session; $2: what is to be seen:
#   stopped           the lamp is lit, and a signal ends the session: prints `off at` SECONDS SINCE 1970
#   cut               the lamp is lit, and still is when the computer is switched off
#   PATTERN           a time for which the lamp may not be lit again
session=$1
task=$2
. /gpio_checks.sh
. /gpio_rig.sh

# While a program waits for the disk, much virtual time may pass: it works beside the disk.
mkdir /disk /beside
copy() { # copy FROM TO: one of the two is the disk
    mount /dev/vda /disk && cp -r "$1/." "$2" && umount /disk || exit 1
}
copy /disk /beside
cd /beside
echo pull-up >/gpio/interlock/pull
if [ ! -d session ]; then
    write_rig bed 60 5
    "$session" create bed.rig.toml session
fi

case $task in
stopped | cut)
    setsid "$session" run session >said 2>&1 &
    program=$!
    check "$task: the shutter opens" await_level shutter 1 120
    check "$task: the lamp is lit" is_level lamp 1
    if [ "$task" = stopped ]; then
        kill -s INT "$program"
        wait "$program"
        check "$task: status 3" [ $? = 3 ]
        echo "off at $(date +%s)"
    fi
    ;;
*)
    "$session" run session >said 2>&1
    check "at $(date), the session ends with status 1" [ $? = 1 ]
    cat said
    check "the lamp may not be lit again for $task" says "may not be lit again for $task"
    check "it was not lit" was_driven lamp 0 "0"
    ;;
esac
copy /beside /disk
finish_checks "a start of the computer"
