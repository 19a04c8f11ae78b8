#!/usr/bin/env python3
"""Opacity masks: a leaf with holes is the same in the tracer and in exports, seen, in its shadow, and in mirrors; by POV-Ray and by Blender,
lit and unlit, from a mask of its own and from glTF's alphaMode MASK. And the atlas in 16 bits and as EXR shows the same picture."""
import json
import pathlib
import shutil
import sys

import numpy as np
from helpers import BIN, SCRIPTS, check, check_gltf, finish, folder, run
from PIL import Image

keep = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None  # a folder for the pictures

LEAF = "v -0.5 0 0\nv 0.5 0 0\nv 0.5 0 1\nv -0.5 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"
SCENE = """orbc: 1
orbifold: "{notation}"
room:
  height: 0.9
  floor: {{checker: [ivory, slategray], cell: 0.25}}
  ceiling: {{color: "#dfe6f0"}}
  walls: {{all: {{mirror: {{reflectance: 0.8}}}}}}
objects:
  - mesh: leaf.obj
    size: 0.4
    at: {{polar: [0.1, 30deg]}}
    turn: 60deg
    material: {{color: olivedrab, opacity_mask: leaf.png}}
  - sphere: {{radius: 0.08}}
    at: {{polar: [0.28, 20deg]}}
    material: {{color: coral}}
{lights}
camera: {{at: {{polar: [0.3, 220deg], z: 0.5}}, look_at: leaf, fov: 80deg, size: [240, 180]}}
cover: {{max_bounces: 2}}
"""
LAMP = "lights: [{kind: point, at: {polar: [0.15, 330deg], z: 0.75}, power: 6}]\nambient: '#404040'\nbake: {mirrors: 1}"


def holes(size):
    y, x = np.mgrid[0:size, 0:size] / size * 2 - 1
    ring = np.hypot(x, y)
    return np.where((ring < 0.95) & (np.sin(3 * np.arctan2(y, x)) * 0.35 + ring > 0.35), 255, 0).astype('uint8')


def verified(path, threshold, name, *more):
    kept = ['--keep', keep / name] if keep else []
    ended = run([BIN / 'orbc', 'verify', path, '--within', '4', '--threshold', '0', '--off-edge', '1', '--json', *more, *kept], timeout=400)
    if ended.returncode:
        sys.exit(ended.stderr.decode())
    for got in json.loads(ended.stdout)['pictures']:
        off = got['beyond_2_elsewhere'] / got['pixels']   # what differs lies on edges: of things, of holes, of their shadows
        check(off <= 0.01 and got['within_4'] >= threshold, f"{name}: {got['engine']} {100 * got['within_4']:.2f} % within 4/255, {100 * off:.2f} % beyond 2/255 off edges, mean {got['mean']:.3f}")


with folder() as where:
    where = pathlib.Path(where)
    (where / 'leaf.obj').write_text(LEAF)
    Image.fromarray(holes(48)).save(where / 'leaf.png')
    blender = ['--blender'] if shutil.which('blender') else []

    def scene(notation, lights=''):
        path = where / 'room.yaml'
        path.write_text(SCENE.format(notation=notation, lights=lights))
        return path

    verified(scene('*2222'), 0.999, 'unlit-2222', *blender)
    verified(scene('*22222'), 0.997, 'unlit-22222')
    for notation in ('*222', '*333', '*22222'):
        verified(scene(notation, LAMP), 0.97, f'lit-{notation[1:]}')
    front = scene('*2222', LAMP)   # renderers light the side that is seen, orbc the front of what has two
    front.write_text(front.read_text().replace('turn: 60deg', 'turn: 300deg'))
    verified(front, 0.98, 'native', '--lights', 'native')
    verified(scene('*333', LAMP), 0.97, 'sixteen', '--atlas', '16', *blender)
    verified(scene('*333', LAMP), 0.97, 'exr', '--atlas', 'exr')

    for depth in ('8', '16'):
        done = run([BIN / 'orbc', 'compile', '--quiet', scene('*2222', LAMP), '-o', where / 'room.glb', '--atlas', depth])
        check(done.returncode == 0, f'glTF with a mask and {depth} bits is written')
        check_gltf(where / 'room.glb', f'glTF with a mask and {depth} bits is valid')
    ended = run([BIN / 'orbc', 'compile', scene('*2222'), '-o', where / 'none.glb', '--atlas', 'exr'])
    check(ended.returncode == 1 and b'gltf.no-exr' in ended.stderr and not (where / 'none.glb').exists(), 'glTF refuses EXR, nothing is written')
    piped = run([BIN / 'orbc', 'compile', '--quiet', scene('*2222'), '-f', 'pov', '-o', '-'])
    drawn = run([SCRIPTS / 'povray-pipe', '-o', where / 'piped.png'], input=piped.stdout)
    file = run([BIN / 'orbc', 'render', '--quiet', '--samples', '1', scene('*2222'), '--engine', 'povray', '-o', where / 'file.png'])
    check(drawn.returncode == 0 and file.returncode == 0 and (np.asarray(Image.open(where / 'piped.png')) == np.asarray(Image.open(where / 'file.png'))).all(),
          'through a pipe atlas and mask ride along ' + drawn.stderr.decode())
finish()
