#!/busybox sh
# The first process of the guest: simulated GPIO chips as /chips says, then the command in /command.
# The status of the command, plus one, goes to the host by the port of QEMU's device isa-debug-exit.
#   /gpio/NAME, /gpio/LABEL/OFFSET  folders of a line: `value` is its level, `pull` what drives an input
#   gpio-trace                      what was driven so far: seconds line set value
/busybox mkdir -p /bin /proc /sys /dev /tmp /gpio
/busybox --install -s /bin
export PATH=/bin HOME=/tmp LC_ALL=C
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs dev /dev
ln -s /proc/self/fd /dev/fd
mkdir /dev/shm
stty -F /dev/ttyS1 raw
exec </dev/null >/dev/ttyS1 2>&1

finish() { # finish STATUS
    sync
    printf "\\$(printf %03o $(($1 + 1)))" | dd of=/dev/port bs=1 seek=$((0xf4)) 2>/dev/null
    reboot -f
}
fail() {
    echo "gpio_bed: $*"
    finish 125
}

modprobe gpio-sim || fail "the simulator cannot be loaded"
mount -t configfs configfs /sys/kernel/config
mount -t tracefs tracefs /sys/kernel/tracing

# The chips. A line of /chips: `chip LABEL LINES`, then `line OFFSET NAME` or `held OFFSET NAME`.
simulated=/sys/kernel/config/gpio-sim
while read -r what first second; do
    case $what in
    chip)
        bank=$simulated/$first/bank
        mkdir -p "$bank"
        echo "$second" >"$bank/num_lines"
        echo "$first" >"$bank/label"
        ;;
    line)
        mkdir -p "$bank/line$first"
        echo "$second" >"$bank/line$first/name"
        ;;
    held)
        mkdir -p "$bank/line$first/hog"
        echo "$second" >"$bank/line$first/hog/name"
        echo output-low >"$bank/line$first/hog/direction"
        ;;
    esac
done </chips

grep ^chip /chips | while read -r _ label _; do
    echo 1 >"$simulated/$label/live" || fail "the chip $label does not start"
    device=/sys/devices/platform/$(cat "$simulated/$label/dev_name")
    chip=$(cat "$simulated/$label/bank/chip_name")
    base=$(cat "$device"/gpio/gpiochip*/base)
    mkdir -p "/gpio/$label"
    for line in "$device/$chip"/sim_gpio*; do
        offset=${line##*sim_gpio}
        ln -s "$line" "/gpio/$label/$offset"
        name=$(cat "$simulated/$label/bank/line$offset/name" 2>/dev/null)
        [ -z "$name" ] || ln -s "$line" "/gpio/$name" 2>/dev/null # of two lines of a name the first
        echo "$((base + offset)) ${name:-$label:$offset}" >>/numbers
    done
    # As after the rule SUBSYSTEM=="gpio", GROUP="gpio", MODE="0660"
    chgrp gpio "/dev/$chip"
    chmod 660 "/dev/$chip"
done

# The kernel's own record of what lines were driven to, on the monotonic clock
cd /sys/kernel/tracing
echo mono >trace_clock
echo 4096 >buffer_size_kb
echo 'get == 0' >events/gpio/gpio_value/filter # a session reads its interlock often
echo 1 >events/gpio/gpio_value/enable
cd /tmp
cat >/bin/gpio-trace <<'END'
#!/busybox sh
exec awk 'FILENAME == "/numbers" { name[$1] = $2; next }
    /: gpio_value: / { sub(":", "", $4); print $4, name[$6], $7, $8 }' /numbers /sys/kernel/tracing/trace
END
chmod +x /bin/gpio-trace

# Programs of the host run in its own tree, which nothing here can change.
if grep -q host /options; then
    modprobe -a 9p virtio_pci 9pnet_virtio || fail "the tree of the host cannot be shared"
    mkdir /host
    mount -t 9p -o trans=virtio,version=9p2000.L,ro,cache=loose,msize=524288 host /host ||
        fail "the tree of the host is not there"
    mount -t tmpfs tmp /host/tmp
    for shared in dev proc sys; do mount --bind "/$shared" "/host/$shared"; done
fi
if grep -q disk /options; then
    modprobe -a virtio_pci virtio_blk crc32c_generic ext4 || fail "disks cannot be used"
fi

# Timers are as coarse as a tick until the kernel trusts its clock.
until grep -q 'hres_active *: 1' /proc/timer_list; do sleep 0.1; done
chmod 1777 /tmp
setsid sh /command
status=$?
[ "$status" -lt 125 ] || status=124
finish "$status"
