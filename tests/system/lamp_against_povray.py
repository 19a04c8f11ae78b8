#!/usr/bin/env python3
"""Euclidean rooms under a point lamp: POV-Ray's own lamp (fade_power 2), shadows and mirrors against orbc's tracer, which follows
geodesics and lamp light by its own formulas. Direct light only. At least 99.5 % of the pixels agree within 4/255, in every room. What
differs is the rim of the knot's own shadow: POV-Ray takes it from the flat triangles, orbc from the smooth surface."""
import pathlib
import sys

import numpy as np
from helpers import BIN, SCRIPTS, check, done, finish, folder, picture
from PIL import Image

keep = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None  # a folder for the pictures

SCENE = """orbc: 1
orbifold: "{notation}"
room:
  scale: 0.6
  height: 0.9
  floor:   {{checker: [ivory, slategray], cell: 0.2}}
  ceiling: {{color: "#dfe6f0"}}
  walls:
    all: {{color: peru, mirror: {{reflectance: 0.8, tint: "#ffeedd", height: [0.1, 0.8]}}, frame: {{width: 0.03, color: goldenrod}}}}
objects:
  - torus_knot: {{p: 2, q: 3, radius: 0.12, tube: 0.03}}
    name: knot
    at: {{polar: [0.14, 70deg], z: 0.2}}
    material: {{color: coral}}
  - box: {{size: [0.1, 0.16, 0.2]}}
    at: {{polar: [0.3, 300deg]}}
    turn: 25deg
    material: {{color: steelblue}}
  - beam:
      from: {{polar: [0.25, 130deg], z: 0}}
      to: {{polar: [0.25, 130deg], z: 0.6}}
      width: 0.03
    material: {{color: seagreen}}
lights:
  - {{kind: point, at: {{polar: [0.05, 200deg], z: 0.62}}, power: 3, color: "#fff1e0"}}
ambient: "#303338"
bake: {{mirrors: 0}}
camera: {{at: {{polar: [0.33, 190deg], z: 0.45}}, look_at: knot, fov: 90deg, size: [400, 300]}}
cover: {{max_bounces: 30, background: black}}
"""


for notation in ("*2222", "*333"):
    with folder() as where:
        where = pathlib.Path(where)
        (where / "room.yaml").write_text(SCENE.format(notation=notation))
        done(BIN / "mirror_room", where / "room.yaml", where / "povray.pov")
        done(SCRIPTS / "povray-pipe", where / "povray.pov", "-o", where / "povray.png")
        done(BIN / "orbc", "trace", "--quiet", "--samples", "1", where / "room.yaml", "-o", where / "traced.png")
        povray, traced = picture(where / "povray.png"), picture(where / "traced.png")
        difference = np.abs(povray - traced).max(axis=2)
        if keep:
            name = notation.strip("*")
            for kind in ("povray", "traced"):
                Image.open(where / f"{kind}.png").save(keep / f"{name}-{kind}.png")
            Image.fromarray(np.minimum(difference * 16, 255).astype("uint8")).save(keep / f"{name}-difference.png")
        share = (difference <= 4).mean()
        check(share >= 0.995 and povray.std() >= 20,
              f"{notation:6} POV-Ray's lamp against orbc's: {100 * share:.3f} % within 4/255, "
              f"{100 * (difference <= 1).mean():.3f} % within 1/255, largest {difference.max()}, mean {difference.mean():.3f}")
finish()
