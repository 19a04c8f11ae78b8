#!/usr/bin/env python3
"""`rays: straight`: the tracer, which follows lines of the chart through real mirrors, against POV-Ray's picture of the scaled chart; and that it is another picture than the curved one."""
import os
import pathlib
import shutil

import numpy as np

from helpers import BIN, check, done, finish, folder, need, picture, run

SCENE = """orbc: 1
orbifold: "ORBIFOLD"
room:
  height: 0.9
  floor: {checker: [ivory, slategray], cell: 0.2}
  ceiling: {color: linen}
  walls: {all: {mirror: {reflectance: 0.94}, frame: {width: 0.03, color: goldenrod}}WALL}
objects:
  - {cylinder: {radius: 0.06, height: 0.2}, at: {polar: [0.14, 80deg]}, color: brown}
  - {sphere: {radius: 0.08}, at: {polar: [0.3, 350deg]}, color: seagreen}
camera: {at: {polar: [0.4, 222deg], z: 0.42}, look_at: {polar: [0.2, 42deg], z: 0.36}, fov: 80deg, size: [240, 180]}
cover: {max_bounces: 4}
"""
TINTED = ', 2: {mirror: {reflectance: 0.94, tint: "#ffc9a8"}}'

with folder() as where:
    def path(name):
        return os.path.join(where, name)

    for name, orbifold, wall in (('h2', '*22222', ''), ('s2', '*222', ''), ('e2', '*333', ''), ('tinted', '*2323', TINTED)):
        pathlib.Path(path(name + '.yaml')).write_text(SCENE.replace('ORBIFOLD', orbifold).replace('WALL', wall))
    for name, least in (('h2', 0.2), ('s2', 0.2)):
        for rays in ('curved', 'straight'):
            done(BIN / 'orbc', 'trace', path(name + '.yaml'), '-o', path(f'{name}-{rays}.png'), '--rays', rays, '-q')
        off = np.abs(picture(path(name + '-curved.png')) - picture(path(name + '-straight.png'))).max(axis=-1)
        check((off > 16).mean() > least, f'{name}: {100 * (off > 16).mean():.1f} % of the pixels differ between curved and straight rays')
    flat = [run([BIN / 'orbc', 'trace', path('e2.yaml'), '-o', path(f'e2-{rays}.png'), '--rays', rays]) for rays in ('curved', 'straight')]
    check(pathlib.Path(path('e2-curved.png')).read_bytes() == pathlib.Path(path('e2-straight.png')).read_bytes(), 'in flat rooms both are the same picture')
    check(b'warning[cli.no-effect] --rays changes nothing here' in flat[1].stderr, 'which is told')
    lens = run([BIN / 'orbc', 'trace', path('h2.yaml'), '-o', path('x.png'), '--rays', 'straight', '--set', 'camera.lens={radius: 0.01, focus_distance: 0.5}', '--size', '16x12'])
    check(b'`camera.lens` changes nothing here: straight rays belong to a pinhole' in lens.stderr and b'few-lens' not in lens.stderr, 'straight rays have no lens, which is told')
    lit = run([BIN / 'orbc', 'trace', path('h2.yaml'), '-v', '-o', path('x.png'), '--rays', 'straight', '--set', 'lights=[{at: {polar: [0, 0deg], z: 0.7}}]', '--set', 'objects.sphere={sphere: {radius: 0.08}, material: gold}', '--size', '16x12'])
    check(lit.returncode == 0 and b'note[driver.straight-light]' in lit.stderr, 'what lit straight pictures leave out is told')
    for name in ('h2', 'e2'):
        both = run([BIN / 'orbc', 'compare', '-', '-o', path('both.png')], input=pathlib.Path(path(name + '.yaml')).read_bytes())
        expected = np.concatenate([picture(path(f'{name}-straight.png')), picture(path(f'{name}-curved.png'))], axis=1)
        check(both.returncode == 0 and np.array_equal(picture(path('both.png')), expected), f'{name}: compare draws straight rays on the left, curved ones on the right {both.stderr.decode()}')
        check((b'warning[cli.same-rays]' in both.stderr) == (name == 'e2'), f'{name}: in flat rooms both are the same, which is told')
    need('povray')
    both = run([BIN / 'orbc', 'compare', path('s2.yaml'), '-o', path('both.png'), '--engine', 'povray', '--size', '64x48', '--json'])
    check(both.returncode == 0 and picture(path('both.png')).shape[:2] == (48, 128) and b'"left": "straight"' in both.stdout, 'compare lets POV-Ray draw both')
    pathlib.Path(path('storeys.yaml')).write_text(pathlib.Path(path('h2.yaml')).read_text().replace('{color: linen}', '{mirror: {reflectance: 0.8}}').replace('max_bounces: 4', 'max_bounces: 3'))
    for name in ('h2', 's2', 'tinted', 'storeys'):
        blender = ['--blender'] if name == 'h2' and shutil.which('blender') else []
        compared = run([BIN / 'orbc', 'verify', path(name + '.yaml'), *blender, '--rays', 'straight', '--within', '4', '--threshold', '0.99', '--off-edge', '1e-3'])
        check(compared.returncode == 0, f'{name}: both roads agree to 4/255 in 99 % of the pixels {compared.stdout.decode()}')
    around = run([BIN / 'orbc', 'verify', path('h2.yaml'), '--rays', 'straight', '--projection', 'panorama', '--size', '320x160', '--within', '4', '--threshold', '0.98', '--off-edge', '1e-3'])
    check(around.returncode == 0, f'so do panoramas, which hold more edges, in 98 % {around.stdout.decode()}')
finish()
