#!/usr/bin/env python3
"""What newcomers meet at the edges: defaults of two-line scenes, starters of unusual rooms, rooms that are tiny or huge, an eye close to a wall, a background in dark mirrors.

Pictures are drawn by POV-Ray, and by Blender where it is installed, and held to the tracer's.
"""
import json
import pathlib
import shutil

import numpy as np

from helpers import BIN, check, finish, folder, need, picture, run

ORBC = BIN / 'orbc'
STARTERS = ('*', '**', '*22(120)', '*235', '*(3/2)(12)(12)', '*(2.5)(2.5)(2.5)(2.5)(2.5)')
COPIES = {'*22222': 166, '*237': 198, '*235': 121, '*333': 235}   # what scenes of two lines plan

FURNISHED = '''orbc: 1
orbifold: "{notation}"
room:
  {shape}
  height: {height}
  floor: {{checker: [ivory, slategray], cell: {cell}}}
  walls: {{all: {{mirror: {{reflectance: 0.9}}, frame: {{width: {frame}, color: goldenrod}}}}}}
objects:
  - box: {{size: [{side}, {side}, {side}]}}
    at: {{polar: [{aside}, 70deg]}}
    color: coral
camera: {{at: {{polar: [{eye}, {bearing}deg], z: {eye_z}}}, look_at: {{azimuth: {look}deg, elevation: -10deg}}, fov: 80deg, size: [320, 240]}}
cover: {{max_bounces: 6, background: "#405060"}}
'''


def furnished(notation, size, **more):
    """A room of that size: everything in it is proportional to it."""
    values = {'notation': notation, 'shape': f'scale: {size}', 'height': size, 'cell': 0.4 * size, 'frame': 0.05 * size, 'side': 0.3 * size,
              'aside': 0.4 * size, 'eye': 0.35 * size, 'eye_z': 0.5 * size, 'bearing': '200', 'look': '30'}
    values.update({key: value if isinstance(value, str) else value * size for key, value in more.items()})
    return FURNISHED.format(**values)


def plans(where):
    for notation, copies in COPIES.items():
        scene = where / 'two-lines.yaml'
        scene.write_text(f'orbc: 1\norbifold: "{notation}"\n')
        done = run([ORBC, 'compile', '--plan', scene])
        planned = json.loads(done.stdout)['copies'] if done.returncode == 0 else done.stderr.decode()
        check(planned == copies, f'a scene of two lines with {notation} plans {copies} copies: {planned}')


def starters(where):
    for notation in STARTERS:
        fresh = run([ORBC, 'new', notation])
        scene = where / 'new.yaml'
        scene.write_bytes(fresh.stdout)
        steps = [['check', scene], ['compile', '-q', scene, '-o', where / 'new.glb', '--size', '64x48', '--quality', 'draft', '--no-highlights'],
                 ['trace', '-q', scene, '-o', where / 'new.png', '--size', '64x48', '--samples', '1']]
        told = [step[0] + ': ' + done.stderr.decode() for step in steps for done in [run([ORBC, *step])] if done.returncode]
        check(fresh.returncode == 0 and not told, f'orbc new {notation}: its scene is checked, compiled and drawn {told or ""}')


def told_settings():
    """A hint names a setting that the same command takes."""
    refused = run([ORBC, 'info', '*(3/2)44'])
    flag = [word for word in refused.stderr.decode().split() if word.startswith('--')]
    check(refused.returncode == 1 and len(flag) == 1, f'orbc info refuses real corners and names a flag: {flag}')
    taken = run([ORBC, 'info', '*(3/2)44', *flag])
    check(taken.returncode == 0, 'orbc info takes it ' + taken.stderr.decode())


def agrees(where, text, what, *more):
    scene = where / 'scene.yaml'
    scene.write_text(text)
    done = run([ORBC, 'verify', '--json', scene, *more], timeout=300)
    try:
        results = json.loads(done.stdout)['pictures']
    except (ValueError, KeyError):
        results = []
        print(done.stdout.decode(), done.stderr.decode())
    shares = ', '.join(f'{100 * result["within_2"]:.2f} %' for result in results if 'within_2' in result)
    check(bool(results) and all(result.get('agrees') for result in results), f'{what}: exports and tracer agree ({shares} within 2/255)')


def sizes(where):
    blender = ('--blender',) if shutil.which('blender') else ()
    for size in (1e-4, 1e-7, 900):
        agrees(where, furnished('*2222', size), f'a room of size {size:g}', *blender)
    size = 1e-4
    lamp = f'lights: [{{at: {{polar: [{0.3 * size}, 10deg], z: {0.8 * size}}}, radius: {0.05 * size}, power: {10 * size * size}}}]\nambient: "#333"\n'
    agrees(where, furnished('*2222', size) + lamp, 'a lit room of size 0.0001', '--samples', '16', '--within', '4', '--threshold', '0.99')
    # Blender filters edges by a filter of its own, so that a tenth of these pixels differ by more than 4 steps at any size of the room.
    if blender:
        agrees(where, furnished('*2222', size) + lamp, 'a lit room of size 0.0001, by Blender', '--blender', '--samples', '16', '--within', '8', '--threshold', '0.97')
    for look in ('0', '120'):   # away from the wall, and into it
        agrees(where, furnished('*333', 1, eye=1 - 1e-5, bearing='180', look=look), f'an eye 1e-5 from a wall, looking to {look} degrees', *blender)
    agrees(where, furnished('*2222', 1, eye_z=1e-5), 'an eye 1e-5 above the floor', *blender)
    agrees(where, furnished('*22222', 0.3, shape='shape: tangential', eye_z=1 - 1e-4), 'an eye 3e-5 below the ceiling of a hyperbolic room', *blender)
    agrees(where, furnished('*2222', 1e-3, eye_z=1e-2), 'an eye 1e-5 above the floor of a small room', *blender)


def backgrounds(where):
    """In mirrors of reflectance 0.1 a white background is seen at 0.1 after one of them."""
    text = ('orbc: 1\norbifold: "*2222"\nroom: {floor: {color: black}, ceiling: {color: black}, walls: {all: {mirror: {reflectance: 0.1}}}}\n'
            'camera: {at: {polar: [0.1, 20deg]}, size: [160, 120], look_at: {azimuth: 35deg, elevation: 0deg}}\n'
            'cover: {max_bounces: 1, background: white}\n')
    scene = where / 'dark.yaml'
    scene.write_text(text)
    for engine in ('tracer', 'povray'):
        done = run([ORBC, 'render', '-q', scene, '--engine', engine, '--samples', '1', '-o', where / 'dark.png'])
        middle = picture(where / 'dark.png')[60, 80] if done.returncode == 0 else np.zeros(3)
        check(np.abs(middle - 89).max() <= 1, f'{engine}: white seen in one mirror of reflectance 0.1 is sRGB 89: {middle}')   # 0.1 in linear light
    agrees(where, text, 'a white background in dark mirrors')


def main():
    need('povray')
    with folder() as name:
        where = pathlib.Path(name)
        plans(where)
        starters(where)
        told_settings()
        sizes(where)
        backgrounds(where)
    finish()


main()
