#!/bin/sh
# The pictures of README.md and of the theory pages, made by the product: `make pictures`. BIN is the folder of synth.
set -eu
cd "$(dirname "$0")/.."
synth="${BIN:+$BIN/}synth"
mkdir -p docs/pictures

"${BIN:+$BIN/}python" docs/overview.py
"${BIN:+$BIN/}python" docs/rooms.py
"${BIN:+$BIN/}python" docs/growth.py
"${BIN:+$BIN/}python" docs/drawings/pages.py

"$synth" draw data/patterns/bird-base.fold --graph --colour centres --force -o docs/pictures/bird-base-centres.svg
"$synth" draw data/patterns/bird-base.fold --colour branch --branch 1 --force -o docs/pictures/bird-base-branch.svg
"$synth" fold data/patterns/bird-base.fold --all --frames 11 --force -o docs/pictures/bird-base-folding.svg
"$synth" draw data/wiener/fortune-teller.json --force -o docs/pictures/fortune-teller.svg
"$synth" draw data/wiener/eight-bar.json --as chain --force -o docs/pictures/eight-bar.svg
"$synth" cone behaviour data/surfaces/fig11-stephenson.json --force -o docs/pictures/stephenson-cone.svg
"$synth" draw data/linkages/kaleidocycle-8.json --force -o docs/pictures/kaleidocycle.svg
"$synth" cone map --angles 60,70,80,50,90 --force -o docs/pictures/loop-sums.svg
"$synth" draw data/orientations/tipparthi.json --force -o docs/pictures/order-map.svg
