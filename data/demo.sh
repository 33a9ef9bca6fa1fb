#!/bin/sh
# What `make demo` shows. BIN is the folder of the synth command.
set -eu
cd "$(dirname "$0")/.."
synth="${BIN:+$BIN/}synth"

say() { printf '\n\033[1m%s\033[0m\n' "$1"; }
show() { printf '$ synth %s\n' "$*"; "$synth" "$@"; }

say "The mechanisms of Wiener's thesis: which class, how many freedoms M?"
show mobility --no-exact data/wiener/[a-z]*-*bar*.json data/wiener/table3-*.json data/wiener/watt*.json \
  data/wiener/stephenson*.json data/wiener/fortune-teller.json data/wiener/concentric-loops.json data/wiener/three-link-chain.json

say "One of them in full: a spherical six-bar with a spatial chain across it. Which formulas hold, and why not the others?"
show mobility --no-exact data/wiener/hybrid-ten-bar.json

say "A crease pattern (FOLD): the bird base of the origami crane"
show mobility --no-exact data/patterns/bird-base.fold

say "A six-bar with a centre that its links do not reach, reconstructed vertex by vertex"
show reconstruct data/wiener/table3-row3.json

say "The fortune teller without its ride-alongs"
show reduce data/wiener/fortune-teller.json

say "A spherical four-bar: on which cones can it lie, and which way do its links move there?"
show cone map --angles 120,95,45,85
show cone behaviour --angles 120,95,45,85

say "All chains of panels with six creases between two bodies"
show enumerate strings --dof 6
