#!/bin/bash
# Lamp and shutter on a real GPIO character device, in a small virtual machine.
# gpio_test.sh GPIO_PULSES GPIO_WATCH LAB_PROGRAM GUEST_SCRIPT
# TSUYA_GPIOBED names the folder of `run-with-gpio`; without it, or where that cannot run, the test
# is skipped (status 77).
set -euo pipefail

program=$1
watch=$2
tsuya=$3
guest=$4
if [ -z "${TSUYA_GPIOBED:-}" ]; then
    echo "tsuya: skipped: TSUYA_GPIOBED does not name the folder of run-with-gpio"
    exit 77
fi
bed=$TSUYA_GPIOBED/run-with-gpio
if ! "$bed" --check; then
    echo "tsuya: skipped: $bed cannot run here"
    exit 77
fi
# Virtual time: load on this computer does not show in the times.
"$bed" --warp --timeout 300 --lines 8 --label board --name 0=lamp --name 1=shutter \
    --name 2=interlock --name 3=twice --hog 5=held --chip spare:4:0=twice,1=spare_lamp --with "$program=/gpio_pulses" \
    --with "$watch=/gpio_watch" --with "$tsuya=/tsuya" --with "$guest=/gpio_guest.sh" -- \
    sh /gpio_guest.sh /gpio_pulses /gpio_watch /tsuya

# A user outside the device's group is told which group it is.
if said=$("$bed" --warp --lines 2 --name 0=lamp --name 1=shutter --as user -- \
    "$program" gpiochip0 shutter lamp 20 100 1 2>&1); then
    echo "FAIL: a stranger may drive the lines"
    exit 1
fi
echo "$said"
grep -q 'Permission denied; a user of the group' <<<"$said"
if said=$("$bed" --warp --lines 2 --as user -- "$tsuya" lab lines 2>&1); then
    echo "FAIL: a stranger may see the lines"
    exit 1
fi
echo "$said"
grep -q 'SUBSYSTEM=="gpio"' <<<"$said"
