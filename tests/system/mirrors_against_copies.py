#!/usr/bin/env python3
"""Euclidean rooms drawn twice by POV-Ray: with its own mirrors, and unfolded by orbc. At least 99.8 % of the pixels agree within 2/255."""
import pathlib

import numpy as np
from helpers import BIN, SCRIPTS, check, done, finish, folder, picture

SCENE = """orbc: 1
orbifold: "{notation}"
room:
  scale: {scale}
  height: 0.9
  floor:   {{checker: [ivory, slategray], cell: 0.2}}
  ceiling: {{checker: ["#dfe6f0", "#c9d4e4"], cell: 0.3}}
  walls:
    all: {{color: peru, mirror: {{reflectance: 0.5, tint: "#ffeedd", height: [0.1, 0.8]}}, frame: {{width: 0.03, color: goldenrod}}}}
objects:
  - torus_knot: {{p: 2, q: 3, radius: 0.12, tube: 0.03}}
    name: knot
    at: {{polar: [0.12, 70deg], z: 0.2}}
    material: {{color: coral}}
  - box: {{size: [0.1, 0.16, 0.2]}}
    at: {{polar: [0.3, 300deg]}}
    turn: 25deg
    material: {{color: steelblue}}
camera: {{at: {{polar: [0.33, 190deg], z: 0.45}}, look_at: knot, fov: 90deg, size: [800, 600]}}
cover: {{max_bounces: 14, background: black}}
"""


for notation, scale in (("*2222", 0.6), ("*333", 0.6), ("*244", 0.55), ("*236", 0.5)):
    with folder() as where:
        where = pathlib.Path(where)
        (where / "room.yaml").write_text(SCENE.format(notation=notation, scale=scale))
        done(BIN / "mirror_room", where / "room.yaml", where / "mirrors.pov")
        done(SCRIPTS / "povray-pipe", where / "mirrors.pov", "-o", where / "mirrors.png")
        done(BIN / "orbc", "render", "--quiet", where / "room.yaml", "-o", where / "copies.png", "--engine", "povray", "--samples", "1")
        done(BIN / "orbc", "trace", "--quiet", "--samples", "1", where / "room.yaml", "-o", where / "traced.png")
        mirrors = picture(where / "mirrors.png")
        for name, wanted in (("copies", 0.998), ("traced", 0.999)):
            difference = np.abs(mirrors - picture(where / f"{name}.png")).max(axis=2)
            share = (difference <= 2).mean()
            check(share >= wanted and mirrors.std() >= 20,
                  f"{notation:6} POV-Ray's mirrors against {name}: {100 * share:.3f} % within 2/255, largest {difference.max()}")
finish()
