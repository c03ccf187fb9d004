#!/bin/bash
# Lamp and shutter on a real GPIO character device, in a small virtual machine.
# gpio_test.sh lines KERNEL ROOT GPIO_PULSES GPIO_WATCH (LAB_PROGRAM)
# gpio_test.sh sessions KERNEL ROOT GPIO_SESSION
#   KERNEL  the folder that gpio_bed/prepare fills; where it could not, the test is skipped (status 77)
#   ROOT    of the system that the programs are from; empty for this one
set -euo pipefail

task=$1 kernel=$2 root=$3
shift 3
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
bed=$here/gpio_bed/run
"$here/gpio_bed/prepare" "$kernel"
for tool in qemu-system-x86_64 cpio; do
    command -v $tool >/dev/null || {
        echo "tsuya: skipped: no $tool (samples/install-packages test)"
        exit 77
    }
done

lines() {
    # A machine that crashes, or a command that fails, is no success.
    local status=0
    "$bed" "$kernel" sh -c 'echo "the guest crashes:"; echo c >/proc/sysrq-trigger' 2>/dev/null || status=$?
    [ "$status" = 125 ]
    status=0
    "$bed" --chip board:2:0=lamp "$kernel" sh -c 'exit 3' || status=$?
    [ "$status" = 3 ]

    "$bed" --warp --chip 'board:8:0=lamp,1=shutter,2=interlock,3=twice,5=!held' \
        --chip spare:4:0=twice,1=spare_lamp --with "$here/gpio_checks.sh=/gpio_checks.sh" \
        --with "$here/gpio_guest.sh=/guest.sh" --root "$root" --with "$1=/gpio_pulses" \
        --with "$2=/gpio_watch" ${3:+--with "$3=/tsuya"} \
        "$kernel" sh /guest.sh /gpio_pulses /gpio_watch ${3:+/tsuya}
}

sessions() {
    "$bed" --warp --chip board:4:0=lamp,1=shutter,2=interlock,3=estop \
        --with "$here/gpio_checks.sh=/gpio_checks.sh" --with "$here/gpio_session_guest.sh=/guest.sh" \
        --root "$root" --with "$1=/gpio_session" "$kernel" sh /guest.sh /gpio_session
}

# Both in virtual time: the load of this computer does not show in the times.
"$task" "$@"
