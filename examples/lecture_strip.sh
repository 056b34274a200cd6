#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lecture_strip.sh FOLDER [PIXELS [SAMPLES]]
# Pictures for a lecture on roughness: copper spheres from nearly smooth to very rough, simulated above and
# Cook-Torrance below, in FOLDER/strip.png, and their lobes at 30 degrees in FOLDER/lobes.svg. Each sphere
# is PIXELS wide (300), of SAMPLES per pixel (96). Needs asperity on the PATH; two minutes on two cores.
set -euo pipefail
(($# >= 1)) || { sed -n '3,6s/^# //p' "$0" >&2; exit 2; }
folder=$1 pixels=${2:-300} samples=${3:-96}
mkdir -p "$folder"
cd "$folder"

# Thesis roughness is the square root of alpha.
alphas=(0.05 0.1 0.2 0.4 0.6)
roughnesses=(0.2236 0.3162 0.4472 0.6325 0.7746)
sphere() {
    asperity render --model sphere --brdf "$1" --camera-distance 3.2 --sun-elevation 50 --sun-azimuth 60 \
        --sun-diameter 4 --background 0.02/0.02/0.025 --depth 1 --spp "$samples" --width "$pixels" \
        --height "$pixels" --quiet -o "$2"
}

simulated=() models=() results=()
for k in "${!alphas[@]}"; do
    alpha=${alphas[k]}
    # Eight surfaces stand for the class: one alone would show its own speckle.
    asperity simulate --surface gaussian --alpha "$alpha" --correlation-length 8 --size 256 --surfaces 8 \
        --isotropic --material Cu --layers 15 --seed 1 --quiet -o "copper-$alpha.asperity"
    sphere "copper-$alpha.asperity" "simulated-$alpha.exr"
    sphere "cook-torrance:roughness=${roughnesses[k]},metallic=1,albedo=0.94/0.62/0.54" "model-$alpha.exr"
    results+=("copper-$alpha.asperity")
    simulated+=("simulated-$alpha.exr")
    models+=("model-$alpha.exr")
done

many() { printf ",$1%.0s" "${alphas[@]}"; }
labels=$(many simulated)$(many Cook-Torrance)
asperity sheet "${simulated[@]}" "${models[@]}" --columns "${#alphas[@]}" \
    --heads "alpha $(IFS=,; echo "${alphas[*]}")" --labels "${labels:1}" --tonemap aces -o strip.png
asperity plot "${results[@]}" --kind lobe --theta 30 --scale log --labels "$(IFS=,; echo "${alphas[*]}")" \
    --title "Copper, alpha 0.05 to 0.6" -o lobes.svg
