# The rig of sessions on the lines of a guest of gpio_bed/run, and what its journal says.
# $make_picture is what its camera does after the exposure of $1 seconds, for the picture $0.
make_picture='echo picture $1 200 $0 end >$0'
black=100
saturation=1000

# write_rig NAME WARM_UP_S EXPOSURE_S: the file NAME.rig.toml, of a lamp whose log is NAME.lamp.log
write_rig() {
    cat >"$1.rig.toml" <<END
schema = "tsuya-rig 1"
[lines.lamp]
chip = "board"
name = "lamp"
[lines.shutter]
chip = "board"
name = "shutter"
[lines.interlock]
chip = "board"
name = "interlock"
[lines.estop]
chip = "board"
name = "estop"
[lamp]
kind = "metal-halide"
serial = "T-1"
warm_up_s = $2
restrike_s = 900
min_on_s = 0
hold_s = 600
log = "$1.lamp.log"
[camera]
command = ["/bin/sh", "-c", "sleep \$1; $make_picture", "{file}", "{exposure}"]
exposures_s = [$3]
black = $black
saturation = $saturation
e_per_dn = 2.5
read_noise_e = 4
[white]
rho_std = 0.99
[sample]
drive = "command"
command = ["/bin/true", "{sample}"]
END
    for axis in lamp_theta lamp_phi camera stage; do
        printf '[axes.%s]\ndrive = "command"\ncommand = ["/bin/true", "{axis}", "{deg}"]\n' $axis
    done >>"$1.rig.toml"
}
# Each of the $2 frames of session $1 counts once.
counts_each_once() {
    numbers=$(sed -n 's/.*"kind":"ok","frame":\([0-9]*\),.*/\1/p' "$1/journal.jsonl" | sort -n)
    [ "$(echo "$numbers" | uniq | wc -l)" = "$2" ] && [ -z "$(echo "$numbers" | uniq -d)" ]
}
