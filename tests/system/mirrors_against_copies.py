#!/usr/bin/env python3
"""Euclidean rooms drawn twice by POV-Ray: with its own mirrors, and unfolded by orbc. At least 99.8 % of the pixels agree within 2/255."""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

programs = pathlib.Path(sys.argv[1])
root = pathlib.Path(__file__).resolve().parents[2]

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


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(str(c) for c in command)}\n{done.stderr}")


def pixels(path):
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


def main():
    failures = 0
    for notation, scale in (("*2222", 0.6), ("*333", 0.6), ("*244", 0.55), ("*236", 0.5)):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "room.yaml").write_text(SCENE.format(notation=notation, scale=scale))
            run(programs / "mirror_room", folder / "room.yaml", folder / "mirrors.pov")
            run(root / "scripts/povray-pipe", folder / "mirrors.pov", "-o", folder / "mirrors.png")
            run(programs / "orbc", "render", "--quiet", folder / "room.yaml", "-o", folder / "copies.png", "--engine", "povray")
            run(programs / "orbc", "trace", "--quiet", folder / "room.yaml", "-o", folder / "traced.png")
            mirrors = pixels(folder / "mirrors.png")
            for name, wanted in (("copies", 0.998), ("traced", 0.999)):
                difference = np.abs(mirrors - pixels(folder / f"{name}.png")).max(axis=2)
                share = (difference <= 2).mean()
                print(f"{notation:6} POV-Ray's mirrors against {name}: {100 * share:.3f} % within 2/255, largest {difference.max()}")
                if share < wanted or mirrors.std() < 20:
                    failures += 1
    return 1 if failures else 0


sys.exit(main())
