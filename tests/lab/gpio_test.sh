#!/bin/bash
# Lamp and shutter on a real GPIO character device, in a small virtual machine.
# gpio_test.sh PROGRAM GUEST_SCRIPT
# TSUYA_GPIOBED names the folder of `run-with-gpio`; without it, or where that cannot run, the test
# is skipped (status 77).
set -euo pipefail

program=$1
guest=$2
if [ -z "${TSUYA_GPIOBED:-}" ]; then
    echo "skipped: TSUYA_GPIOBED does not name the folder of run-with-gpio"
    exit 77
fi
bed=$TSUYA_GPIOBED/run-with-gpio
if ! "$bed" --check; then
    echo "skipped: $bed cannot run here"
    exit 77
fi
"$bed" --warp --lines 8 --name 0=lamp --name 1=shutter --hog 5=held --with "$program=/gpio_pulses" \
    --with "$guest=/gpio_guest.sh" -- sh /gpio_guest.sh /gpio_pulses

# A user outside the device's group is told which group it is.
if said=$("$bed" --lines 2 --name 0=lamp --name 1=shutter --as user -- \
    "$program" gpiochip0 shutter lamp 20 100 1 2>&1); then
    echo "FAIL: a stranger may drive the lines"
    exit 1
fi
echo "$said"
grep -q 'Permission denied; a user of the group' <<<"$said"
