#!/usr/bin/env bash
# Makes the pictures of the documentation in docs/images: those of meshes with the program itself, the drawings of
# docs/architecture.md with Graphviz.
#
#   tools/pictures.sh [PROGRAM [COLLECTION]]
#
# PROGRAM is the path of lamina [build/release/src/app/lamina]. COLLECTION is the folder with the collection of airfoil
# files; without it the script leaves out the pictures of its sections. The script needs the Debian packages graphviz,
# imagemagick, fonts-dejavu-core and pngquant; pngquant makes the pictures a fifth as large. The script does not make
# pieces-several.png and wake.png.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
lamina=$(readlink -f "${1:-build/release/src/app/lamina}")
images=docs/images
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$images"

# mesh NAME INPUT [options]: meshes INPUT with the layer of the README's example and a far field of 50 chords.
mesh() {
    local name=$1
    shift
    "$lamina" mesh "$@" --first-height 2.5e-5 --growth 1.15 --layers 30 --max-ray-angle 4 --far-field 50 --quiet \
        -o "$scratch/$name.vtu"
}

# picture NAME MESH WINDOW [options]: draws a window of MESH and makes the file small.
picture() {
    local name=$1 mesh=$2 window=$3
    shift 3
    "$lamina" plot "$scratch/$mesh.vtu" -o "$scratch/$name.png" --window "$window" --width 1000 "$@"
    pngquant --force --speed 1 --nofs -o "$images/$name.png" 16 "$scratch/$name.png"
    echo "$images/$name.png"
}

dot -Tsvg "$images/stages.dot" -o "$images/stages.svg"
tools/check_includes.py --dot | dot -Tsvg -o "$images/folders.svg"

mesh sharp naca:0012
mesh blunt naca:0012:200:blunt
mesh pieces naca:0012 --pieces-target 1000
for topology in delaunay layered quads; do
    mesh "tail-$topology" naca:0012 --layer-topology "$topology"
    # This section has so few points that the edges of the layer's outer border are much shorter than the distance
    # between its rays.
    mesh "coarse-$topology" naca:4412:40 --surface keep --layer-topology "$topology"
done
mesh k-rule naca:0012 --pieces-target 1000 --separators k-rule

picture airfoil sharp -0.3,1.3,-0.55,0.55
picture leading-edge sharp -0.02,0.06,-0.03,0.03
picture nose-size sharp -0.06,0.18,-0.09,0.09 --color size
picture trailing-edge sharp 0.96,1.04,-0.03,0.03
picture trailing-edge-tip sharp 0.9992,1.0008,-0.0006,0.0006
picture blunt-trailing-edge blunt 0.995,1.007,-0.0045,0.0045
picture transition sharp 0.30,0.54,0.04,0.22
picture quality sharp -0.6,1.6,-0.75,0.75 --color quality
picture pieces-near pieces -0.8,1.8,-0.9,0.9 --color piece
picture pieces-rings pieces -12,13,-9,9 --color piece
for topology in delaunay layered quads; do
    picture "topology-tail-$topology" "tail-$topology" 0.988,1.012,-0.009,0.009
    picture "topology-coarse-$topology" "coarse-$topology" 0.35,0.75,0.05,0.15
done
picture separators-equidistributed pieces -1.3,0.3,0.1,1.3
picture separators-k-rule k-rule -1.3,0.3,0.1,1.3

"$lamina" mesh naca:0012 --reynolds 6e6 --alpha 10 --quiet -o "$scratch/guided.vtu"
picture flow-wake guided -0.2,1.9,-0.5,0.7
picture flow-tail guided 0.8,1.2,-0.12,0.18
"$lamina" mesh naca:0012:blunt --reynolds 6e6 --alpha 4 --quiet -o "$scratch/guided-base.vtu"
picture flow-base guided-base 0.95,1.07,-0.06,0.06
"$lamina" mesh naca:0012 --reynolds 6e6 --alpha 10 --wake-layers yes --quiet -o "$scratch/wake-layers.vtu"
picture wake-layers wake-layers 0.7,3.2,-0.35,0.75
picture wake-layers-tail wake-layers 0.97,1.06,-0.03,0.04
"$lamina" mesh naca:4412:blunt --reynolds 6e6 --alpha 4 --wake-layers yes --quiet -o "$scratch/wake-layers-base.vtu"
picture wake-layers-base wake-layers-base 0.999,1.012,-0.0045,0.0045

[ -n "${2:-}" ] || exit 0
# Sheets of places round sections, meshed with layers up to isotropy from y+ and nothing else.
while IFS='|' read -r sheet name window input; do
    files=()
    for file in $input; do [[ $file == naca:* ]] && files+=("$file") || files+=("$2/$file"); done
    "$lamina" mesh "${files[@]}" --y-plus 1 --reynolds 5e6 --layers auto --quiet -o "$scratch/place.vtu" 2>/dev/null
    mkdir -p "$scratch/$sheet"
    "$lamina" plot "$scratch/place.vtu" -o "$scratch/$sheet/$name.png" --window "$window" --width 1000
done < <(grep -v '^#' tools/places.txt)
for sheet in noses tails bases high-lift ice; do
    montage -font DejaVu-Sans -label '%t' "$scratch/$sheet"/*.png -geometry '500x420>+4+4' -tile 3x \
        "$scratch/$sheet.png"
    pngquant --force --speed 1 --nofs -o "$images/auto-$sheet.png" 16 "$scratch/$sheet.png"
    echo "$images/auto-$sheet.png"
done

multielement=$2/multielement
# high_lift NAME FILE...: meshes elements of the collection with the default layer.
high_lift() {
    local name=$1
    shift
    "$lamina" mesh "${@/#/$multielement/}" --quiet -o "$scratch/$name.vtu"
}
high_lift 30p30n 30p30n_uiuc.dat
"$lamina" mesh "$multielement"/crmhl2d_{slat,main,flap}.dat --reynolds 5e6 --alpha 16 --quiet -o "$scratch/crmhl.vtu"
picture flow-high-lift crmhl -0.2,2.2,-0.6,0.6
high_lift nlr7301 nlr7301_clean_main.dat nlr7301_clean_flap.dat
picture high-lift-slat 30p30n -0.11,0.07,-0.135,0.02 --color layer
picture high-lift-cove 30p30n 0.70,0.92,-0.045,0.065 --color layer
picture high-lift-slot nlr7301 0.86,1.03,-0.06,0.04 --color layer
picture high-lift-slot-end nlr7301 0.99,1.006,-0.0075,0.0025 --color layer
