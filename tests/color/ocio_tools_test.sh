#!/bin/bash
# The program's OpenColorIO config before other programs: ociocheck accepts it, and oiiotool makes of linear
# light the picture that the program makes, to one code of 16 bits.
# ocio_tools_test.sh TSUYA FOLDER
# Skipped (status 77) without the packages opencolorio-tools and openimageio-tools.
set -euo pipefail
tsuya=$1 folder=$2
for tool in ociocheck oiiotool; do
    if ! command -v $tool >/dev/null; then
        echo "tsuya: skipped: no $tool (packages opencolorio-tools, openimageio-tools)"
        exit 77
    fi
done
unset OCIO
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
"$tsuya" list config -o tsuya.ocio
ociocheck --iconfig tsuya.ocio >checked.txt || {
    cat checked.txt
    exit 1
}
# Negative control: a look of an unknown space is found.
sed 's/process_space: CIE XYZ D65/process_space: nowhere/' tsuya.ocio >wrong.ocio
if ociocheck --iconfig wrong.ocio >wrong.txt 2>&1; then
    echo "ociocheck finds nothing wrong in a wrong config"
    exit 1
fi

cat >cloth.obj <<'OBJ'
v -0.5 0 0
v 0.5 0 0
v 0.5 1 0.2
v -0.5 1 0.2
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
OBJ
cat >cloth.scene.toml <<'SCENE'
[camera]
width = 60
height = 50
[fabrics.silk]
dye = "crimson"
[garments.cloth]
mesh = "cloth.obj"
fabric = "silk"
[lights.key]
centre = [-1, 1, 2]
target = [0, 0.3, 0]
[environment]
radiance = 0.2
group = "fill"
[render]
samples_per_pixel = 4
SCENE
"$tsuya" render cloth.scene.toml -o transport.exr --progress off
"$tsuya" relight transport.exr --lamp HP4 -o linear.exr
# within NAME LIMIT A B: fails where two pictures cannot be compared or differ by more than LIMIT
within() {
    local report
    report=$(oiiotool "$3" "$4" --fail "$2" --failpercent 0 --hardfail "$2" --warn "$2" --diff 2>&1) &&
        grep -qx PASS <<<"$report" && return
    echo "$1: not within $2"
    echo "$report"
    return 1
}
for display in sRGB "Display P3" Rec.709 Rec.2020; do
    for view in Plain Soft; do
        "$tsuya" relight transport.exr --lamp HP4 -o ours.png --bits 16 --adapt cat02 \
            --display "$display" --view $view
        oiiotool --colorconfig tsuya.ocio linear.exr \
            --ociolook:from="Linear Rec.709":to="Linear Rec.709" "HP4 cat02" \
            --ociodisplay:from="Linear Rec.709" "$display" $view --clamp:min=0:max=1 \
            -d uint16 -o theirs.png
        within "$display, $view" 0.0000155 ours.png theirs.png
    done
done
# A config of one's own, and the variable of the environment
"$tsuya" relight transport.exr --lamp HP4 -o named.png --bits 16 --ocio tsuya.ocio \
    --display "Display P3" --view Soft
OCIO=tsuya.ocio "$tsuya" relight transport.exr --lamp HP4 -o variable.png --bits 16 \
    --display "Display P3" --view Soft
"$tsuya" relight transport.exr --lamp HP4 -o inside.png --bits 16 --display "Display P3" --view Soft
within "--ocio" 0.0001 named.png inside.png
within "OCIO" 0 variable.png named.png
# Negative control: pictures under two lamps
"$tsuya" relight transport.exr --lamp A -o other.png --bits 16 --display "Display P3" --view Soft
if within control 0.0001 other.png named.png >control.txt; then
    echo "the comparison finds nothing"
    exit 1
fi
