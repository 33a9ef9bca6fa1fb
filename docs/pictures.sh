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

"$synth" fold data/patterns/bird-base.fold --all --frames 11 --force -o docs/pictures/bird-base-folding.svg
"${BIN:+$BIN/}python" docs/gallery.py
