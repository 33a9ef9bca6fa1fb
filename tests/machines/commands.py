"""The commands whose answers are the same on every machine: over the project's data, and generated patterns.

They run in this order in one folder: files that the first ones write are read by later ones.
"""

from __future__ import annotations

__all__ = ["COMMANDS", "QUICK"]

_QUICK = """
generate miura --rows 3 --columns 3 -o miura-flat.fold
generate miura --rows 3 --columns 3 --fold 60 -o miura.fold
generate miura-tube -o tube.fold
generate yoshimura -o yoshimura.fold
generate waterbomb -o waterbomb.fold
generate waterbomb --fold 60 -o waterbomb-60.fold
generate resch -o resch.fold
generate square-twist -o square-twist.fold
generate hexagon-twist -o hexagon-twist.fold
generate huffman-grid -o huffman.fold
generate huffman-grid --fold 30 -o huffman-30.fold
generate kresling -o kresling.fold
generate deployable-cylinder --pleats 3 -o cylinder.fold
generate map -o map.fold
generate chickenwire -o chickenwire.fold
generate chickenwire --fold 40 -o chickenwire-40.fold
generate waterbomb-base -o waterbomb-base.fold
generate waterbomb-base --fold 30 -o waterbomb-base-30.fold
generate preliminary-base -o preliminary-base.fold
generate preliminary-base --fold 90 -o preliminary-base-90.fold
generate bird-base -o bird.fold
generate sarrus -o sarrus.fold
generate bennett -o bennett.json
generate goldberg -o goldberg.json
generate myard -o myard.json
generate bricard-line-symmetric -o bricard-line.json
generate bricard-plane-symmetric -o bricard-plane.json
generate bricard-trihedral -o bricard-trihedral.json
generate kaleidocycle --solids 6 -o kaleidocycle-6.json
generate kaleidocycle --solids 7 -o kaleidocycle-7.json
generate kaleidocycle --solids 8 -o kaleidocycle-8.json
generate kaleidocycle --solids 9 -o kaleidocycle-9.json
generate four-bar -o four-bar.json
generate five-bar -o five-bar.json
generate six-bar -o six-bar.json
generate parallel-pop-up -o parallel.json
generate angle-pop-up -o angle.json
generate box-pop-up -o box.fold
generate slit-array -o slits.fold
generate webbed-tray -o tray.fold
generate webbed-tray --fold 60 -o tray-60.fold
generate crash-lock -o crash.fold
generate stewart -o stewart.json
generate 6-sps -o 6-sps.json
generate 6-rus -o 6-rus.json
generate 6-uuu -o 6-uuu.json
generate 3-rps -o 3-rps.json
generate 3-upu -o 3-upu.json
generate 3-uuu -o 3-uuu.json
mobility miura-flat.fold
mobility yoshimura.fold
mobility square-twist.fold
mobility huffman-30.fold
mobility map.fold
mobility waterbomb-base.fold
mobility sarrus.fold
mobility myard.json
mobility bricard-trihedral.json
mobility kaleidocycle-8.json
fold miura-flat.fold --branches
fold yoshimura.fold --branches
fold waterbomb.fold --branches
fold square-twist.fold --branches
fold huffman.fold --branches
fold preliminary-base.fold --branches
fold tray.fold --branches
fold data/patterns/bird-base.fold --branches
fold miura-flat.fold --all --frames 6
fold waterbomb.fold --all --frames 6
fold square-twist.fold --all --frames 6
fold huffman.fold --all --frames 6
fold waterbomb-base.fold --all --frames 6
fold bird.fold --all --frames 6
fold data/patterns/bird-base.fold --all --frames 6
fold miura-flat.fold --all --frames 4 -o posed-miura-flat.fold
fold resch.fold --all --frames 4 -o posed-resch.fold
fold huffman.fold --all --frames 4 -o posed-huffman.fold
fold bricard-line.json --frames 5
fold bricard-plane.json --frames 5
fold kaleidocycle-7.json --frames 5
fold data/linkages/kaleidocycle-7.json --frames 5
explain miura-flat.fold
explain yoshimura.fold
explain hexagon-twist.fold
explain cylinder.fold
explain waterbomb-base.fold
limits cylinder.fold
limits slits.fold
limits data/linkages/wampler-fig1-open.fold
states tube.fold --joint 0
states waterbomb.fold --joint 0
states resch.fold --joint 0
states waterbomb-base.fold --joint 0
states preliminary-base.fold --joint 0
states data/realised/creased-four-bar.fold --joint 0
advise miura-flat.fold --freedoms 0 --limit 5
advise waterbomb.fold --freedoms 0 --limit 5
advise huffman-30.fold --freedoms 0 --limit 5
advise waterbomb-base.fold --freedoms 0 --limit 5
advise yoshimura.fold --freedoms 2 --size 1 --limit 5
advise hexagon-twist.fold --freedoms 2 --size 1 --limit 5
advise map.fold --freedoms 2 --size 1 --limit 5
advise sarrus.fold --freedoms 2 --size 1 --limit 5
realise data/wampler/fig1.json -o made-fig1.fold
realise data/wampler/two-centres.json --as space -o space-two-centres.fold
realise data/wiener/eight-bar.json -o made-eight-bar.fold
realise data/wiener/mesh-4x4-inner-creases.json --as space -o space-mesh-4x4-inner-creases.fold
realise data/wiener/remote-6-bar.json --as cone -o cone-remote-6-bar.json
realise data/wiener/ride-along.json --as space -o space-ride-along.fold
realise data/wiener/six-bar.json -o made-six-bar.fold
realise data/wiener/table3-row2.json -o made-table3-row2.fold
positions four-bar.json --drive 0=10
positions data/patterns/four-bar-vertex.fold --drive 0=40
positions data/realised/fig1.fold --drive 0=40
positions data/realised/fig12-scd.fold --drive 0=40
positions data/realised/ride-along.fold --drive 0=40
cone map --angles 120,95,45,85
cone behaviour --angles 120,95,45,85
cone move --angles 120,95,45,85 --at 5,20
cone map --angles 70,80,120,40
cone behaviour --angles 70,80,120,40
cone move --angles 70,80,120,40 --at 5,20
cone map --angles 120,50,120,50
cone move --angles 120,50,120,50 --at 5,20
cylinder map --lengths 4,3,5,1
dyads --orientations data/orientations/tipparthi.json
fourbar --orientations data/orientations/tipparthi.json --best 6
fourbar --orientations data/orientations/tipparthi.json --usable --cones
order --orientations data/orientations/tipparthi.json --axis=-0.349,-0.144,0.926 --direction cw
order --orientations data/orientations/tipparthi.json --axis=1,2,3
dyads --orientations data/orientations/tipparthi-as-printed.json
realise 'RR-R-RRR' --mode D
realise 'm1:a-b.ac-.b-de.cef.d-g.fg-'  --as space
realise 'k1:E`hW'
realise data/wiener/miura-2x2.fold --flat-foldable
fold data/wiener/square-twist.fold --branch 3 --all --frames 5
"""

_OTHERS = """
mobility five-bar.json
mobility slits.fold
mobility stewart.json
mobility 6-uuu.json
mobility 3-uuu.json
mobility data/hyatt/spherical-four-bar.json
mobility data/linkages/sarrus.json
mobility data/linkages/wampler-fig1-folded.fold
mobility data/patterns/four-bar-vertex.fold
mobility data/realised/double-strip.fold
mobility data/realised/fig12-open.fold
mobility data/realised/held-ride-along.fold
mobility data/realised/nine-bar-mesh.fold
mobility data/realised/remote-7-bar.fold
mobility data/realised/six-bar-loop-planar.fold
mobility data/realised/stephenson-planar.fold
mobility data/realised/table3-row4.fold
mobility data/realised/watt-planar.fold
mobility data/wampler/cube-unlocked.json
mobility data/wampler/fig12-open.json
mobility data/wampler/fig2.json
mobility data/wampler/fig5.json
mobility data/wampler/fig8.json
mobility data/wampler/spherical-scissors-5.json
mobility data/wampler/tetrahedron-locked.json
mobility data/wiener/adjunct-chain.json
mobility data/wiener/double-strip.json
mobility data/wiener/held-ride-along.json
mobility data/wiener/mesh-4x4-inner-creases.json
mobility data/wiener/miura-4x4.fold
mobility data/wiener/remote-5-bar.json
mobility data/wiener/remote-8-bar.json
mobility data/wiener/six-bar-loop-planar.json
mobility data/wiener/six-bar-with-chain.json
mobility data/wiener/stephenson-planar.json
fold miura.fold --branches
fold huffman-30.fold --branches
fold cylinder.fold --branches
fold chickenwire.fold --branches
fold chickenwire-40.fold --branches
fold sarrus.fold --branches
fold box.fold --branches
fold data/linkages/wampler-fig1-coplanar.fold --branches
fold data/linkages/wampler-fig1-folded.fold --branches
fold data/realised/adjunct-chain.fold --branches
fold data/realised/creased-four-bar.fold --branches
fold data/realised/eight-bar.fold --branches
fold data/realised/fig12-open.fold --branches
fold data/realised/fig12-scd.fold --branches
fold data/realised/hybrid-ten-bar.fold --branches
fold data/realised/mesh-4x4-inner-creases.fold --branches
fold data/realised/remote-5-bar.fold --branches
fold data/realised/remote-7-bar.fold --branches
fold data/realised/remote-8-bar.fold --branches
fold data/realised/six-bar-loop-planar.fold --branches
fold data/realised/six-bar-with-chain.fold --branches
fold data/realised/six-bar.fold --branches
fold data/realised/stephenson.fold --branches
fold data/realised/table3-row3.fold --branches
fold data/realised/table3-row4.fold --branches
fold data/realised/two-centres.fold --branches
fold data/realised/ups-chain-4-5.fold --branches
fold data/realised/ups-chain-6-3.fold --branches
fold data/wiener/miura-2x2.fold --branches
fold data/wiener/miura-3x3.fold --branches
fold data/wiener/miura-3x4.fold --branches
fold data/wiener/miura-5x5.fold --branches
fold tube.fold --all --frames 6
fold cylinder.fold --all --frames 6
fold chickenwire.fold --all --frames 6
fold box.fold --all --frames 6
fold crash.fold --all --frames 6
fold data/linkages/wampler-fig1-folded.fold --all --frames 6
fold data/realised/adjunct-chain.fold --all --frames 6
fold data/realised/double-strip.fold --all --frames 6
fold data/realised/fig12-open.fold --all --frames 6
fold data/realised/fortune-teller.fold --all --frames 6
fold data/realised/mesh-4x4-inner-creases.fold --all --frames 6
fold data/realised/remote-5-bar.fold --all --frames 6
fold data/realised/remote-7-bar.fold --all --frames 6
fold data/realised/six-bar-loop-planar.fold --all --frames 6
fold data/realised/six-bar-with-chain.fold --all --frames 6
fold data/realised/stephenson-planar.fold --all --frames 6
fold data/realised/table3-row1.fold --all --frames 6
fold data/realised/table3-row4.fold --all --frames 6
fold data/realised/ups-chain-3-3.fold --all --frames 6
fold data/realised/ups-chain-6-3.fold --all --frames 6
fold data/wiener/miura-2x2.fold --all --frames 6
fold data/wiener/miura-3x3.fold --all --frames 6
fold data/wiener/miura-4x4.fold --all --frames 6
fold tube.fold --all --frames 4 -o posed-tube.fold
fold cylinder.fold --all --frames 4 -o posed-cylinder.fold
fold chickenwire-40.fold --all --frames 4 -o posed-chickenwire-40.fold
fold bird.fold --all --frames 4 -o posed-bird.fold
fold slits.fold --all --frames 4 -o posed-slits.fold
fold data/linkages/sarrus-panels.fold --all --frames 4 -o posed-sarrus-panels.fold
fold data/linkages/wampler-fig1-folded.fold --all --frames 4 -o posed-wampler-fig1-folded.fold
fold data/patterns/four-bar-vertex.fold --all --frames 4 -o posed-four-bar-vertex.fold
fold data/realised/double-strip.fold --all --frames 4 -o posed-double-strip.fold
fold data/realised/fig12-open.fold --all --frames 4 -o posed-fig12-open.fold
fold data/realised/hybrid-ten-bar.fold --all --frames 4 -o posed-hybrid-ten-bar.fold
fold data/realised/remote-5-bar.fold --all --frames 4 -o posed-remote-5-bar.fold
fold data/realised/remote-8-bar.fold --all --frames 4 -o posed-remote-8-bar.fold
fold data/realised/six-bar-loop-spherical.fold --all --frames 4 -o posed-six-bar-loop-spherical.fold
fold data/realised/six-bar.fold --all --frames 4 -o posed-six-bar.fold
fold data/realised/table3-row1.fold --all --frames 4 -o posed-table3-row1.fold
fold data/realised/table3-row4.fold --all --frames 4 -o posed-table3-row4.fold
fold data/realised/ups-chain-3-3.fold --all --frames 4 -o posed-ups-chain-3-3.fold
fold data/realised/watt-planar.fold --all --frames 4 -o posed-watt-planar.fold
fold data/wiener/miura-2x3.fold --all --frames 4 -o posed-miura-2x3.fold
fold data/wiener/miura-4x4.fold --all --frames 4 -o posed-miura-4x4.fold
fold bennett.json --frames 5
fold goldberg.json --frames 5
fold myard.json --frames 5
fold bricard-trihedral.json --frames 5
fold kaleidocycle-6.json --frames 5
fold kaleidocycle-8.json --frames 5
fold kaleidocycle-9.json --frames 5
fold four-bar.json --frames 5
fold five-bar.json --frames 5
fold six-bar.json --frames 5
fold stewart.json --frames 5
fold 6-sps.json --frames 5
fold 6-rus.json --frames 5
fold 6-uuu.json --frames 5
fold 3-rps.json --frames 5
fold 3-upu.json --frames 5
fold 3-uuu.json --frames 5
fold data/linkages/bennett.json --frames 5
fold data/linkages/kaleidocycle-6.json --frames 5
fold data/linkages/kaleidocycle-8.json --frames 5
fold data/linkages/sarrus.json --frames 5
fold data/linkages/stewart.json --frames 5
explain bennett.json
explain bricard-plane.json
explain kaleidocycle-7.json
explain slits.fold
explain data/linkages/kaleidocycle-6.json
explain data/linkages/wampler-fig1-coplanar.fold
explain data/realised/double-strip.fold
explain data/realised/fortune-teller.fold
explain data/realised/mesh-4x4-inner-creases.fold
explain data/realised/remote-7-bar.fold
explain data/realised/six-bar-loop-spherical.fold
explain data/realised/stephenson.fold
explain data/wiener/miura-3x4.fold
limits data/realised/double-strip.fold
limits data/realised/fortune-teller.fold
limits data/realised/ride-along.fold
limits data/realised/table3-row3.fold
limits data/realised/two-centres.fold
states data/realised/fig12-open.fold --joint 0
states data/realised/held-ride-along.fold --joint 0
states data/realised/sarrus.fold --joint 0
states data/realised/three-link-chain.fold --joint 0
states data/realised/ups-chain-3-3.fold --joint 0
advise slits.fold --freedoms 0 --limit 5
advise data/linkages/wampler-fig1-folded.fold --freedoms 0 --limit 5
advise data/realised/creased-four-bar.fold --freedoms 0 --limit 5
advise data/realised/fig12-scd.fold --freedoms 0 --limit 5
advise data/realised/nine-bar-mesh.fold --freedoms 0 --limit 5
advise data/realised/ride-along.fold --freedoms 0 --limit 5
advise data/realised/six-bar.fold --freedoms 0 --limit 5
advise data/realised/table3-row4.fold --freedoms 0 --limit 5
advise data/wiener/miura-2x2.fold --freedoms 0 --limit 5
advise data/wiener/miura-5x5.fold --freedoms 0 --limit 5
advise data/linkages/wampler-fig1-folded.fold --freedoms 2 --size 1 --limit 5
advise data/realised/double-strip.fold --freedoms 2 --size 1 --limit 5
advise data/realised/fortune-teller.fold --freedoms 2 --size 1 --limit 5
advise data/realised/remote-8-bar.fold --freedoms 2 --size 1 --limit 5
advise data/realised/stephenson.fold --freedoms 2 --size 1 --limit 5
advise data/wiener/miura-2x3.fold --freedoms 2 --size 1 --limit 5
states 6-sps.json --joint 0
states 6-rus.json --joint 0
states 3-rps.json --joint 0
states data/linkages/wampler-cube-locked.json --joint 0
realise data/wampler/fig1.json --as space -o space-fig1.fold
realise data/wampler/fig12-open.json --as space -o space-fig12-open.fold
realise data/wampler/fig12-scd.json --as space -o space-fig12-scd.fold
realise data/wampler/fig12-scd.json --as cone -o cone-fig12-scd.json
realise data/wiener/adjunct-chain.json --as space -o space-adjunct-chain.fold
realise data/wiener/creased-four-bar.json -o made-creased-four-bar.fold
realise data/wiener/creased-four-bar.json --as cone -o cone-creased-four-bar.json
realise data/wiener/double-strip.json --as space -o space-double-strip.fold
realise data/wiener/fortune-teller.json -o made-fortune-teller.fold
realise data/wiener/held-ride-along.json -o made-held-ride-along.fold
realise data/wiener/held-ride-along.json --as space -o space-held-ride-along.fold
realise data/wiener/hybrid-ten-bar.json --as space -o space-hybrid-ten-bar.fold
realise data/wiener/nine-bar-mesh.json -o made-nine-bar-mesh.fold
realise data/wiener/remote-5-bar.json -o made-remote-5-bar.fold
realise data/wiener/remote-5-bar.json --as cone -o cone-remote-5-bar.json
realise data/wiener/remote-6-bar.json -o made-remote-6-bar.fold
realise data/wiener/remote-7-bar.json --as space -o space-remote-7-bar.fold
realise data/wiener/remote-7-bar.json --as cone -o cone-remote-7-bar.json
realise data/wiener/remote-8-bar.json --as space -o space-remote-8-bar.fold
realise data/wiener/ride-along.json -o made-ride-along.fold
realise data/wiener/sarrus.json --as space -o space-sarrus.fold
realise data/wiener/six-bar-loop-spherical.json -o made-six-bar-loop-spherical.fold
realise data/wiener/six-bar-loop-spherical.json --as space -o space-six-bar-loop-spherical.fold
realise data/wiener/six-bar-with-chain.json -o made-six-bar-with-chain.fold
realise data/wiener/six-bar.json --as space -o space-six-bar.fold
realise data/wiener/stephenson.json -o made-stephenson.fold
realise data/wiener/stephenson.json --as cone -o cone-stephenson.json
realise data/wiener/table3-row1.json -o made-table3-row1.fold
realise data/wiener/table3-row3.json -o made-table3-row3.fold
realise data/wiener/table3-row3.json --as space -o space-table3-row3.fold
realise data/wiener/three-link-chain.json -o made-three-link-chain.fold
realise data/wiener/watt.json -o made-watt.fold
positions data/realised/eight-bar.fold --drive 0=40
positions data/realised/six-bar.fold --drive 0=40
positions data/realised/stephenson.fold --drive 0=40
positions data/realised/table3-row1.fold --drive 0=40
positions data/realised/table3-row3.fold --drive 0=40
positions data/realised/two-centres.fold --drive 0=40
positions data/patterns/four-bar-vertex.fold --drive 2=90
cone behaviour --angles 120,50,120,50
cone map --angles 60,70,80,50,90
cone behaviour --angles 60,70,80,50,90
cone map --angles 90,90,90,90
cone behaviour --angles 90,90,90,90
cone map --angles 60,60,60,60
cone behaviour --angles 60,60,60,60
cone move --angles 60,60,60,60 --at 5,20
cone map --angles 30,50,70,90,40
cone behaviour --angles 30,50,70,90,40
cone map --angles 40,50,60,70,80,60
cone behaviour --angles 40,50,60,70,80,60
cone map data/surfaces/fig11-stephenson.json
cone behaviour data/surfaces/fig11-stephenson.json
cone behaviour data/surfaces/fig11-stephenson.json --ground 2
cone move data/surfaces/fig11-stephenson.json --at 0.1
cylinder behaviour data/surfaces/fig10-four-bar.json --ground 2
cylinder move data/surfaces/fig10-four-bar.json --at 10 --point 3,115,0 --axes 1,3
cone behaviour --steps 40,50,50 --ground 2
cylinder map --lengths 4,3,5,1,2
cylinder map --lengths 2,2,2,2
cylinder map --lengths 3,4,5
cylinder map --lengths 1,2,3,4,5,6
cylinder map --lengths 4,4,2,2
fourbar --orientations data/orientations/tipparthi-as-printed.json --best 6
order --orientations data/orientations/tipparthi-as-printed.json --axis=-0.349,-0.144,0.926 --direction cw
order --orientations data/orientations/tipparthi-as-printed.json --axis=1,2,3
dyads --orientations data/orientations/crank-rocker.json
fourbar --orientations data/orientations/crank-rocker.json --best 6
fourbar --orientations data/orientations/crank-rocker.json --usable --cones
order --orientations data/orientations/crank-rocker.json --axis=-0.349,-0.144,0.926 --direction cw
realise 'RR-R-RRR' --mode D --as space
realise 'm1:a-b.ac-.b-d.cd-'
realise 'm1:a-b.ac-.b-d.cd-'  --as space
realise 'm1:a-b.ac-.b-de.cef.d-g.fg-'
realise 'k1:Cr'
realise 'k1:Cr'  --as space
realise 'k1:DqK'
realise 'k1:DqK'  --as space
realise 'k1:E`hW'  --as space
realise 'k1:E@zO'
realise 'k1:E@zO'  --as space
realise data/wiener/fortune-teller.json --flat-foldable
realise data/wiener/eight-bar.json --symmetric
fold bird.fold --drive 0=60 --frames 5
fold bird.fold --branch 5 --all --frames 4
fold bird.fold --branch 1 --drive 0=20 --frames 4
fold data/patterns/four-bar-vertex.fold --drive 2=60 --frames 10
fold data/patterns/four-bar-vertex.fold --drive 2=60 --json --frames 3
fold miura-flat.fold --branch 2 --all --frames 4
fold huffman.fold --all --frames 4 --collisions
states four-bar.json --joint 0 --joint 2
positions four-bar.json --drive 0=25 --json
fold bird.fold --branches --json
mobility --pose 3 posed-miura-flat.fold
explain posed-miura-flat.fold
mobility --pose 3 posed-tube.fold
explain posed-tube.fold
mobility --pose 3 posed-resch.fold
explain posed-resch.fold
mobility --pose 3 posed-huffman.fold
explain posed-huffman.fold
mobility --pose 3 posed-cylinder.fold
explain posed-cylinder.fold
mobility --pose 3 posed-chickenwire-40.fold
explain posed-chickenwire-40.fold
mobility --pose 2 posed-bird.fold
mobility --pose 2 posed-slits.fold
mobility --pose 2 posed-sarrus-panels.fold
mobility --pose 2 posed-wampler-fig1-folded.fold
mobility --pose 2 posed-four-bar-vertex.fold
mobility --pose 2 posed-double-strip.fold
"""


def _listed(text: str) -> tuple[str, ...]:
    return tuple(text.strip().splitlines())


QUICK = _listed(_QUICK)
"""Some ten seconds of processor time."""

COMMANDS = QUICK + _listed(_OTHERS)
"""Half a minute."""
