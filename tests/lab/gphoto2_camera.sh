#!/bin/sh
# A camera with a card: pictures are found on it and downloaded by gphoto2.
# gphoto2_camera.sh VIRTUAL_CAMERA RIG.toml STATE FILE EXPOSURE_S
# The card is a folder that gphoto2's own driver shows as a camera. Debian's build has no camera that
# exposes without hardware, so the virtual one does that.
set -eu

camera=$1 rig=$2 state=$3 file=$4 exposure=$5
card=$state/card
picture=$(basename "$file")
mkdir -p "$card"
"$camera" "$rig" "$state" "$card/$picture" "$exposure"

number=$(gphoto2 --camera "Directory Browse" --port "disk:$card" --list-files |
    awk -v picture="$picture" '$2 == picture { print substr($1, 2) }')
[ -n "$number" ] || {
    echo "gphoto2 does not list $picture" >&2
    exit 1
}
gphoto2 --quiet --camera "Directory Browse" --port "disk:$card" --get-file "$number" --filename "$file"
