#!/usr/bin/env python3
"""Metals of every roughness mirror the room, in the tracer and, traced for the eye, in exports: both agree, in all three spaces.

And what the tracer shows of them does not depend on how many samples a pixel has.
"""
import json
import pathlib
import sys

from helpers import BIN, check, finish, folder, need, picture, run

need('povray')
SCENE = """orbc: 1
orbifold: "{notation}"
room:
  scale: 1
  height: 0.9
  floor: {{color: "#203040"}}
  ceiling: {{color: "#f0f0f0"}}
  walls:
    all: {{mirror: none, color: "#60a0ff"}}
    1: {{mirror: {{reflectance: 0.8}}}}
    2: {{mirror: none, color: "#ff6020"}}
objects:
  - sphere: {{radius: 0.25}}
    name: ball
    at: {{polar: [0, 0deg], z: 0.1}}
    material: {material}
lights:
  - {{kind: sphere, at: {{polar: [0.3, 90deg], z: 0.75}}, radius: 0.05, power: 3}}
ambient: "#707070"
camera: {{at: {{polar: [0.45, 270deg], z: 0.45}}, look_at: ball, fov: 60deg, size: [64, 48]}}
cover: {{max_bounces: 2}}
"""
ROOMS = (
    ('*222', 'gold'), ('*222', '{kind: metal, color: white, roughness: 0.8}'),
    ('*2222', 'chrome'), ('*2222', '{kind: metal, color: "#fff0e0", roughness: 0.3}'),
    ('*22222', 'copper'), ('*22222', '{kind: metal, color: "#fff0e0", roughness: 0.5}'),
)


def main():
    with folder() as where:
        where = pathlib.Path(where)
        path = where / 'scene.yaml'
        for notation, material in ROOMS:
            path.write_text(SCENE.format(notation=notation, material=material))
            done = run([BIN / 'orbc', 'verify', path, '--samples', '16', '--quality', 'normal', '--json', '--off-edge', '1'], timeout=300)
            if not done.stdout:
                sys.exit(done.stderr.decode())
            got = json.loads(done.stdout)['pictures'][0]
            check(got['within_4'] >= 0.95 and got['within_8'] >= 0.98,
                  f'{notation}, {material}: {100 * got["within_4"]:.2f} % within 4/255, {100 * got["within_8"]:.2f} % within 8/255')
            means = []
            for samples in (1, 16):
                picture_path = where / f'{samples}.png'
                run([BIN / 'orbc', 'trace', path, '-o', picture_path, '--samples', str(samples), '--quiet'])
                means.append(picture(picture_path)[16:32, 22:42].mean())
            check(abs(means[0] - means[1]) <= 2, f'{notation}, {material}: as bright by 1 sample as by 16: {means[0]:.2f}, {means[1]:.2f}')
    finish()


main()
