#!/bin/bash
# Sessions on a disk whose power is cut: what was made lasting is there, and each frame counts once.
# power_cut_test.sh KERNEL POWER_CUT_SESSION DISK_AT_CUT
#   KERNEL  the folder that gpio_bed/prepare fills; where it could not, the test is skipped (status 77)
# One machine runs a whole session, and every write to its disk is logged with the flushes between. From
# the log comes the disk as it was at any moment, without what its own memory had not stored yet. A
# second machine resumes the session on each of those disks.
set -euo pipefail

kernel=$1 session=$2 disk_at_cut=$3
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
cd "$scratch"

# The file system ends before the disk does: behind it are the marks of exposures. It is mounted without
# ext4's habit of storing some new files soon, which other file systems do not have.
marks_at=32768 # sector
truncate -s 17M before
mke2fs -q -t ext4 before 16M
cp --sparse=always before disk
: >log
"$bed" --with "$session=/session" \
    --drive driver=blklogwrites,file.driver=file,file.filename=disk,log.driver=file,log.filename=log \
    "$kernel" sh -euc "mkdir /disk; mount -o noauto_da_alloc /dev/vda /disk; /session run /disk /dev/vda $marks_at"

mapfile -t marks < <("$disk_at_cut" log disk marks $marks_at)
length=${marks[-1]}
unset 'marks[-1]'
echo "${#marks[@]} exposures, $length writes and flushes"
[ ${#marks[@]} -ge 20 ]

# Half of the cuts come while the shutter is open, half at any time after it first opened. Every
# second disk keeps a part of what it had not stored.
RANDOM=1
cuts=()
for i in 0 1 2 3 4 5 6 7 8 9; do
    cuts+=("${marks[i * ${#marks[@]} / 10]}" $((marks[0] + RANDOM * (length - marks[0]) / 32768)))
done
disks=()
for i in ${!cuts[@]}; do
    cp --sparse=always before "cut$i"
    "$disk_at_cut" log "cut$i" cut "${cuts[i]}" $marks_at $((i / 2 % 2 * (i + 1)))
    disks+=(--disk "cut$i")
done
echo "cut after ${cuts[*]}"
"$bed" --with "$session=/session" "${disks[@]}" "$kernel" sh -uc "mkdir /disk
    failed=0
    for letter in a b c d e f g h i j k l m n o p q r s t; do
        echo \"disk \$letter:\"
        mount /dev/vd\$letter /disk && /session resume /disk /dev/vd\$letter $marks_at || failed=1
        umount /disk
    done
    exit \$failed"
