#!/usr/bin/env python3
"""`compile --plan` says within a fifth what compiling makes of flat and lit scenes: triangles, vertices and bytes of each format; copies exactly.

Flat and lit, with highlights and without, also where few copies must tell of very many; and a large export says so before it is made, with a setting that helps.
"""
import json
import pathlib
import re
import struct
import sys

from helpers import BIN, ROOT, check, finish, folder, run

ORBC = BIN / 'orbc'
FLAT = sorted((ROOT / 'tests/scenes/flat').glob('*.yaml'))
LIT = [ROOT / f'examples/{name}/scene.yaml' for name in ('lit-pentagon', 'glass')]
HYPERBOLIC = '''orbc: 1
orbifold: "*22222"
objects: [{{mesh: {statue}, size: 0.3, at: {{toward: corner 2, distance: 0.3}}}}]
camera: {{at: {{polar: [0.4, 200deg], z: 0.5}}, look_at: statue}}
cover: {{max_bounces: {bounces}}}
'''
SMALL = ['--size', '200x150']
wanted = sys.argv[2:]


def picture_bytes(glb):
    """What the atlas takes of a GLB."""
    length = struct.unpack('<I', glb[12:16])[0]
    content = json.loads(glb[20:20 + length])
    return sum(content['bufferViews'][image['bufferView']]['byteLength'] for image in content.get('images', []))


def off(planned, made):
    return planned / made - 1 if made else 0


def compare(what, where, scene, *words):
    planned = run([ORBC, 'compile', scene, '--plan', *words])
    made = {form: run([ORBC, 'compile', scene, '-o', where / f'x.{form}', '--json', '--quiet', *words], timeout=900) for form in ('pov', 'glb')}
    if planned.returncode or any(done.returncode for done in made.values()):
        check(False, f'{what} {planned.stderr.decode()[:300]} {[done.stderr.decode()[:300] for done in made.values()]}')
        return
    plan, pov, glb = json.loads(planned.stdout), json.loads(made['pov'].stdout), json.loads(made['glb'].stdout)
    check(plan['copies'] == pov['copies'], f'{what}: {plan["copies"]} copies')
    glb_bytes = glb['bytes'] - picture_bytes((where / 'x.glb').read_bytes())
    pairs = {'triangles': (plan['triangles'], pov['triangles']), 'vertices': (plan['vertices'], pov['vertices']),
             'bytes of .pov': (plan['pov_bytes'], pov['bytes']), 'bytes of .glb': (plan['gltf_bytes'], glb_bytes)}
    for name, (foreseen, real) in pairs.items():
        check(abs(off(foreseen, real)) <= 0.2, f'{what}: {name} {foreseen} foreseen, {real} made ({100 * off(foreseen, real):+.1f} %)')


with folder() as name:
    where = pathlib.Path(name)
    for scene in FLAT:
        if not wanted or scene.stem in wanted:
            compare(scene.stem, where, scene, *SMALL)
    for scene in LIT:
        title = scene.parent.name
        if not wanted or title in wanted:
            compare(f'{title} without highlights', where, scene, *SMALL, '--quality', 'draft', '--no-highlights')
            compare(title, where, scene, '--size', '80x60', '--quality', 'draft')
    if not wanted or 'hyperbolic' in wanted:
        scene = where / 'hyperbolic.yaml'
        statue = ROOT / 'examples/meshes/statue.ply'
        for bounces in (4, 7):
            scene.write_text(HYPERBOLIC.format(statue=statue, bounces=bounces))
            compare(f'hyperbolic, {bounces} bounces', where, scene, '--size', '800x600')

        # Half a gigabyte: told before it is made. Stopped there, since a second is enough to tell.
        scene.write_text(HYPERBOLIC.format(statue=statue, bounces=7))
        planned = json.loads(run([ORBC, 'compile', scene, '--plan', '--no-lod', '--max-memory', '64GiB']).stdout)
        check(planned['pov_bytes'] > 500e6, f'in all detail {planned["pov_bytes"] / 1e9:.2f} GB are foreseen')
        done = run(['bash', '-c', f'ulimit -v 6000000; exec {ORBC} compile {scene} --no-lod --max-memory 64GiB -o {where}/large.pov'], timeout=900)
        told = done.stderr.decode()
        hint = re.search(r'--max-bounces (\d+) would stay below 500 MB; --max-triangles (\d+)', told)
        check('warning[cli.large-export]' in told and hint is not None, f'a large export says so, with settings that would shrink it: {told[:400]}')
        if hint:
            fewer = json.loads(run([ORBC, 'compile', scene, '--plan', '--no-lod', '--max-bounces', hint.group(1)]).stdout)
            check(fewer['pov_bytes'] <= 500e6, f'--max-bounces {hint.group(1)} does: {fewer["pov_bytes"] / 1e6:.0f} MB')
        small = run([ORBC, 'compile', scene, '--max-bounces', '3', '-o', where / 'small.pov'])
        check(small.returncode == 0 and b'large-export' not in small.stderr, 'a small one says nothing')
finish()
