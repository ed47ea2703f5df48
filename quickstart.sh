#!/usr/bin/env bash
# From a fresh clone to a report: installs what is missing, builds, and runs the whole pipeline with simulated observers
# on a real model, into out/quickstart/.
set -euo pipefail
cd "$(dirname "$0")"
out=out/quickstart
step="start"
trap 'echo "quickstart: FAILED while: $step" >&2' ERR

say() { step="$1"; printf '\n== %s\n' "$1"; }

say "installing packages"
.ci/install-packages

say "building"
cmake --preset release -DSTAIRSTEP_TESTS=OFF >build.log 2>&1 || { cat build.log >&2; rm -f build.log; false; }
rm -f build.log
cmake --build --preset release

model=/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf
bin=build/bin
rm -rf "$out"
mkdir -p "$out"
started=$SECONDS

say "1/5 stimuli: what the observers judge"
$bin/stairstep-stimuli --pattern step,stair,line --texel 5,10,20,30 --radius 0,5,10,17.5,25,35,50,70,105 \
    --kernel box --contrast 1,0.5 --out "$out/stimuli" --contact-sheet "$out/contact-sheet.png"

say "2/5 study: ten simulated observers"
$bin/stairstep-study simulate --observers 10 --seed 1 --db "$out/study.sqlite"
$bin/stairstep-study export --db "$out/study.sqlite" --out "$out"

say "3/5 analysis: thresholds and the law"
$bin/stairstep-analyze fit "$out/trials.csv" --out "$out/law.json"

say "4/5 renderer: a truck at 4096 texels and at what the law asks for"
$bin/stairstep-render image "$model" --technique pcf --resolution 4096,auto --law "$out/law.json" \
    --truth --out "$out/truck.png" --stats "$out/stats.json"

say "5/5 report"
$bin/stairstep-analyze report "$out/study.sqlite" --contact-sheet "$out/contact-sheet.png" \
    --renderings "$out/stats.json" --out "$out"

printf '\nquickstart: done, main job %d s: open %s in a browser\n' $((SECONDS - started)) "$out/report.html"
