#!/usr/bin/env python3
"""`lights: native`: in flat rooms POV-Ray's own lamps, one set for every copy, give the light that the tracer follows through real mirrors,
shadows and mirrored light included: at least 98 % of the pixels within 4/255. Elsewhere, and in glTF, orbc says that it is an approximation."""
import json
import pathlib
import shutil
import sys

from helpers import BIN, check, check_gltf, done, finish, folder, picture, run

keep = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None  # a folder for the pictures

ROOM = """orbc: 1
orbifold: "{notation}"
room:
  scale: 0.6
  height: 0.9
  floor:   {{checker: [ivory, slategray], cell: 0.2}}
  ceiling: {{color: "#dfe6f0"}}
  walls:
    all: {{color: peru, mirror: {mirror}}}
objects:
  - torus_knot: {{p: 2, q: 3, radius: 0.12, tube: 0.03}}
    name: knot
    at: {{polar: [0.14, 70deg], z: 0.2}}
    material: {{color: coral}}
  - box: {{size: [0.1, 0.16, 0.2]}}
    at: {{polar: [0.3, 300deg]}}
    turn: 25deg
    material: {{color: steelblue}}
  - sphere: {{radius: 0.05}}
    at: {{polar: [0.3, 130deg], z: 0.1}}
    material: {{kind: emissive, color: seagreen}}
lights: {lights}
ambient: "#303338"
bake: {{mirrors: 1, lights: native}}
camera: {{at: {{polar: [0.33, 190deg], z: 0.45}}, look_at: knot, fov: 90deg, size: [240, 180]}}
cover: {{max_bounces: {bounces}}}
"""
GLASS = '{reflectance: 0.8, tint: "#ffeedd", height: [0.1, 0.8], frame: {width: 0.03, color: goldenrod}}'
POINT = '[{kind: point, at: {polar: [0.05, 200deg], z: 0.62}, power: 3, color: "#fff1e0"}]'
OTHERS = """
  - {kind: sphere, at: {polar: [0.05, 200deg], z: 0.7}, radius: 0.05, power: 1.5}
  - {kind: spot, at: {polar: [0.2, 20deg], z: 0.8}, to: {polar: [0.3, 300deg], z: 0}, cone: 60deg, power: 0.5, color: skyblue}
  - {kind: rectangle, at: {polar: [0.3, 100deg], z: 0.85}, size: [0.2, 0.1], power: 1}
  - {kind: disk, at: {polar: [0.3, 240deg], z: 0.85}, radius: 0.08, power: 0.5, color: gold}"""


def scene(where, **words):
    path = pathlib.Path(where) / 'room.yaml'
    path.write_text(ROOM.format(**{'notation': '*2222', 'mirror': GLASS, 'lights': POINT, 'bounces': 4, **words}))
    return path


def verified(path, threshold, name):
    more = ['--keep', keep / name] if keep else []
    ended = run([BIN / 'orbc', 'verify', path, '--within', '4', '--threshold', '0', '--off-edge', '1', '--json', *more])
    if ended.returncode:
        sys.exit(ended.stderr.decode())
    got = json.loads(ended.stdout)['pictures'][0]
    check(got['within_4'] >= threshold, f"{name}: {100 * got['within_4']:.2f} % within 4/255, mean {got['mean']:.3f}, largest {got['largest']}")


with folder() as where:
    for notation in ('*2222', '*333'):
        verified(scene(where, notation=notation), 0.98, f'point-{notation[1:]}')
    verified(scene(where, lights=OTHERS, bounces=2), 0.96, 'others')

    ended = run([BIN / 'orbc', 'compile', scene(where), '-o', pathlib.Path(where) / 'room.glb'])
    said = ended.stderr.decode()
    check(ended.returncode == 0 and 'gltf.native-lights-shared' in said and 'driver.native-lights-approximate' not in said, 'glTF says that its lamps are shared')
    check_gltf(pathlib.Path(where) / 'room.glb', 'and is valid')
    said = run([BIN / 'orbc', 'compile', scene(where, notation='*22222', bounces=1), '-o', pathlib.Path(where) / 'room.pov']).stderr.decode()
    check('driver.native-lights-approximate' in said and 'curves' in said, 'curved rooms say that they are approximate')
    ended = run([BIN / 'orbc', 'compile', scene(where, bounces=80), '-o', pathlib.Path(where) / 'many.pov'])
    check(ended.returncode == 1 and b'driver.too-many-lamps' in ended.stderr and not (pathlib.Path(where) / 'many.pov').exists(), 'too many lamps are refused, nothing is written')
    ended = run([BIN / 'orbc', 'compile', scene(where), '--view', 'disk', '-o', pathlib.Path(where) / 'disk.pov'])
    check(ended.returncode == 1 and b'driver.native-view' in ended.stderr, '--view disk has no lamps')

    if shutil.which('blender'):  # units: a room without mirrors under one lamp
        path = scene(where, mirror='none')
        path.write_text(path.read_text().replace('#303338', 'black'))
        done(BIN / 'orbc', 'trace', '--quiet', '--samples', '1', path, '-o', pathlib.Path(where) / 'traced.png')
        done(BIN / 'orbc', 'render', '--quiet', path, '--engine', 'blender', '--samples', '16', '-o', pathlib.Path(where) / 'blender.png')
        traced, drawn = picture(pathlib.Path(where) / 'traced.png'), picture(pathlib.Path(where) / 'blender.png')
        if keep:
            shutil.copy(pathlib.Path(where) / 'blender.png', keep / 'blender.png')
            shutil.copy(pathlib.Path(where) / 'traced.png', keep / 'blender-traced.png')
        lit = traced.max(axis=2) > 90
        ratio = drawn[lit].mean() / traced[lit].mean()
        check(0.98 < ratio < 1.02, f'Blender shows lamps as bright as orbc: {ratio:.3f}')
finish()
