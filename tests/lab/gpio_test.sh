#!/bin/bash
# Lamp and shutter on a real GPIO character device, in a small virtual machine.
# gpio_test.sh lines KERNEL ROOT GPIO_PULSES GPIO_WATCH (LAB_PROGRAM)
# gpio_test.sh sessions KERNEL ROOT GPIO_SESSION
# gpio_test.sh reboot KERNEL ROOT GPIO_SESSION
# gpio_test.sh program KERNEL ROOT TSUYA MODULE
#   KERNEL  the folder that gpio_bed/prepare fills; where it could not, the test is skipped (status 77)
#   ROOT    of the system that the programs are from; empty for this one
set -euo pipefail

task=$1 kernel=$2 root=$3
shift 3
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
bed=$here/gpio_bed/run
"$here/gpio_bed/prepare" "$kernel"
for tool in qemu-system-x86_64 cpio mke2fs; do
    command -v $tool >/dev/null || {
        echo "tsuya: skipped: no $tool (samples/install-packages test)"
        exit 77
    }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

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
        --with "$here/gpio_checks.sh=/gpio_checks.sh" --with "$here/gpio_rig.sh=/gpio_rig.sh" \
        --with "$here/gpio_session_guest.sh=/guest.sh" --root "$root" --with "$1=/gpio_session" \
        "$kernel" sh /guest.sh /gpio_session
}

# The computer is started again and again; its disk has the log of the lamp.
reboot() {
    local session=$1 off
    truncate -s 16M "$scratch/disk"
    mke2fs -q -t ext4 "$scratch/disk"
    start() { # start TIME OPTION... TASK: the time of day then
        "$bed" --clock "$1" "${@:2:$#-2}" --disk "$scratch/disk" \
            --chip board:4:0=lamp,1=shutter,2=interlock,3=estop \
            --with "$here/gpio_checks.sh=/gpio_checks.sh" --with "$here/gpio_rig.sh=/gpio_rig.sh" \
            --with "$here/gpio_reboot_guest.sh=/guest.sh" --root "$root" \
            --with "$session=/gpio_session" "$kernel" sh /guest.sh /gpio_session "${@: -1}"
    }
    after() { date -u -d "@$((off + $1))" +%Y-%m-%dT%H:%M:%S; } # after SECONDS

    start 2026-01-31T12:00:00 --warp stopped | tee "$scratch/said"
    off=$(sed -n 's/^off at //p' "$scratch/said")
    # The clock of a computer without a battery goes back: then the whole time counts.
    start 2026-01-31T11:00:00 '15 min 0 s'
    start "$(after 600)" '[345] min [0-9]* s'
    start "$(after 1000)" --warp cut
    # Since when the lamp has been off, nobody knows.
    start "$(after 3000)" '15 min 0 s'
}

# The pictures of the guest's camera are those of a dry run here; it has none while the lamp is off.
program() {
    local tsuya=$1 pictures=()
    . "$here/gpio_rig.sh"
    make_picture='grep -q 1 /gpio/lamp/value && cp /pictures/$(basename $0) $0'
    black=512 saturation=15800
    (cd "$scratch" && write_rig bed 60 1)
    "$tsuya" lab plan "$scratch/bed.rig.toml" --views few:45 --symmetry orthotropic -o "$scratch/plan.jsonl"
    "$tsuya" lab run "$scratch/plan.jsonl" -o "$scratch/dry" --dry-run
    for picture in "$scratch"/dry/frames/*; do pictures+=(--with "$picture=/pictures/${picture##*/}"); done
    "$bed" --warp --memory 1400 --chip board:4:0=lamp,1=shutter,2=interlock,3=estop \
        --with "$here/gpio_checks.sh=/gpio_checks.sh" --with "$here/gpio_rig.sh=/gpio_rig.sh" \
        --with "$here/gpio_program_guest.sh=/guest.sh" --with "$scratch/bed.rig.toml=$scratch/bed.rig.toml" \
        --with "$scratch/plan.jsonl=/plan.jsonl" "${pictures[@]}" --with "$tsuya=/tsuya" --with "$2=$2" \
        "$kernel" sh /guest.sh /tsuya /plan.jsonl
}

# In virtual time, where times are looked at: the load of this computer does not show in them.
"$task" "$@"
