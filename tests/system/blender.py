"""Blender draws exported GLB files in exact colours and where they should be; scripts/render_blender.py fails loudly."""
import os
import pathlib
import subprocess

import numpy as np

from helpers import SCRIPTS, check, check_balls, encode_srgb, expected_codes, finish, folder, need, picture, run, sample

need('blender')
SCRIPT = SCRIPTS / 'render_blender.py'
INSIDE = ['blender', '-b', '--factory-startup', '-noaudio', '--python-exit-code', '3', '-P', SCRIPT, '--']

with folder() as where:
    def path(name):
        return os.path.join(where, name)

    facts = sample('codes', 'glb', where)
    whole = pathlib.Path(path('codes.glb')).read_bytes()
    done = run([SCRIPT, path('codes.glb'), '-o', path('codes.png')])
    check(done.returncode == 0, 'codes from a file ' + done.stderr.decode())
    off = np.abs(picture(path('codes.png')) - expected_codes(facts))
    check(off[:16].max() < 1e-6, f'weight 1: texels come through unchanged (worst {off[:16].max():.2e})')
    # Blender keeps vertex colours as 8-bit sRGB: half a code of the weight, half a code of the result.
    check(off.max() < 1.6, f'weights in COLOR_0 (worst {off.max():.2f})')
    from_file = picture(path('codes.png'))

    with open(path('stdout.png'), 'wb') as file:
        done = subprocess.run([SCRIPT], input=whole, stdout=file, stderr=subprocess.PIPE, timeout=120, check=False)
    check(done.returncode == 0 and (picture(path('stdout.png')) == from_file).all(), 'from stdin to stdout ' + done.stderr.decode())
    with open(path('fd3.png'), 'wb') as file:
        descriptor = file.fileno()
        done = run([*INSIDE, '-o', f'fd:{descriptor}'], input=whole, pass_fds=[descriptor])
    check(done.returncode == 0 and (picture(path('fd3.png')) == from_file).all(), 'inside Blender, from stdin to a descriptor')

    sample('codes', 'nodes', where)
    done = run([SCRIPT, path('codes.glb'), '-o', path('nodes.png')])
    off = np.abs(picture(path('nodes.png')) - expected_codes(facts))
    # Cycles decodes and encodes by approximations: near ties the rounding may differ.
    check(off.max() < 0.55, f'weights as material factors are exact to the rounding (worst {off.max():.4f} of a code)')

    sample('codes', 'gltf', where)
    done = run([SCRIPT, path('codes.gltf'), '-o', path('text.png')])
    check(done.returncode == 0 and (picture(path('text.png')) == from_file).all(), 'the text form draws the same picture ' + done.stderr.decode())

    for name in ('balls-perspective', 'balls-panorama', 'flat'):
        facts = sample(name, 'glb', where)
        done = run([SCRIPT, path(name + '.glb'), '-o', path(name + '.png')])
        check(done.returncode == 0, f'{name} is drawn {done.stderr.decode()}')
        check_balls(facts, picture(path(name + '.png')), name, 1.5)

    facts = sample('empty', 'glb', where)
    done = run([SCRIPT, path('empty.glb'), '-o', path('empty.png'), '--size', '7x5'])
    check(done.returncode == 0 and (picture(path('empty.png')) == np.round(encode_srgb(facts['background']))).all(), 'the background is exact ' + done.stderr.decode())
    check(picture(path('empty.png')).shape == (5, 7, 3), '--size wins over the file')

    sample('many', 'glb', where)
    done = run([SCRIPT, path('many.glb'), '-o', path('many.png'), '--samples', '4', '--threads', '1'])
    check(done.returncode == 0, 'two thousand copies, four samples ' + done.stderr.decode())

    # World coordinates in Blender are those of the product: z up, nothing turned. (Camera and meshes could be turned together unseen.)
    sample('squares', 'glb', where)
    code = f'''
import sys, numpy, bpy
numpy.bool = bool
bpy.ops.wm.read_factory_settings(use_empty=True)
import addon_utils; addon_utils.enable('io_scene_gltf2')
bpy.ops.import_scene.gltf(filepath={path('squares.glb')!r})
thing = [o for o in bpy.context.scene.objects if o.type == 'MESH'][0]
points = [thing.matrix_world @ v.co for v in thing.data.vertices]
print('CORNERS', sorted(tuple(float(c) for c in p) for p in points)[0], sorted(tuple(float(c) for c in p) for p in points)[-1])
camera = [o for o in bpy.context.scene.objects if o.type == 'CAMERA'][0]
print('CAMERA', *[round(c, 6) + 0.0 for c in camera.matrix_world.translation])
'''
    code = "import sys; sys.path.append('/usr/lib/python3/dist-packages')" + code
    done = run(['blender', '-b', '--factory-startup', '-noaudio', '--python-exit-code', '3', '--python-expr', code])
    said = done.stdout.decode()
    check('CORNERS (2.0, -0.25, 0.0) (3.0, 1.0, 1.5)' in said, 'world coordinates in Blender are those of the product ' + said[-300:] * ('CORNERS (2' not in said))
    check('CAMERA 0.0 0.0 0.5' in said, 'and so is the place of the camera')

    def refused(what, code, words, command, **options):
        done = run(command, **options)
        check(done.returncode == code and words in done.stderr.decode() and len(done.stderr) < 2000,
              f'{what}: {done.returncode} {done.stderr.decode().strip()}')

    sample('balls-cylinder', 'glb', where)
    refused('a cylinder camera', 1, 'no cylinder camera', [SCRIPT, path('balls-cylinder.glb'), '-o', path('x.png')])
    refused('an empty pipe', 1, 'empty', [SCRIPT, '-o', path('x.png')], input=b'')
    refused('a cut file', 1, 'cannot import', [SCRIPT, '-o', path('x.png')], input=whole[:-100])
    refused('no glTF at all', 1, 'cannot import', [SCRIPT, '-o', path('x.png')], input=b'hello')
    refused('a missing file', 1, 'no such file', [SCRIPT, path('none.glb'), '-o', path('x.png')])
    refused('an unknown option', 2, 'unrecognized', [SCRIPT, path('codes.glb'), '--frobnicate', '-o', path('x.png')])
    refused('a folder that is not there', 3, 'no such folder', [SCRIPT, path('empty.glb'), '-o', path('none/x.png')])
    refused('without Blender', 3, 'not installed', ['/usr/bin/python3', SCRIPT, path('empty.glb'), '-o', path('x.png')], env={'PATH': where})
    check(not os.path.exists(path('x.png')), 'failures leave no picture')
    inside = run([*INSIDE, path('none.glb'), '-o', path('x.png')])
    check(inside.returncode == 1 and b'render_blender: no such file' in inside.stderr, 'inside Blender errors are told and counted too')
finish()
