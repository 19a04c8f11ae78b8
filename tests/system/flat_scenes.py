#!/usr/bin/env python3
"""Every scene in flat colours is checked, compiled to each format, validated, drawn by POV-Ray, and agrees with the tracer to the pixel, at the
scene's own size; two are drawn by Blender. The same scene gives the same bytes."""
import json
import pathlib
import time

from helpers import BIN, ROOT, check, check_gltf, finish, folder, need, picture, run

need('povray', 'blender', 'node')
FLAT = ROOT / 'tests/scenes/flat'
SIZE = '400x300'   # of Blender's pictures


def orbc(*words):
    return run([BIN / 'orbc', *words], timeout=600)


scenes = sorted(FLAT.glob('*.yaml'))
check(len(scenes) >= 9, f'{len(scenes)} flat scenes')
with folder() as where:
    where = pathlib.Path(where)
    for scene in scenes:
        name = scene.stem
        start = time.monotonic()
        check(orbc('check', scene).returncode == 0, f'{name}: check')
        glb, svg = where / f'{name}.glb', where / f'{name}.svg'
        done = orbc('compile', scene, '-o', glb, '--quiet')
        check(done.returncode == 0, f'{name}: glb {done.stderr.decode()[:300]}')
        check_gltf(glb, f'{name}: the Khronos validator finds nothing')
        check(orbc('compile', scene, '-o', svg, '--quiet').returncode == 0 and b'<svg' in svg.read_bytes()[:400], f'{name}: svg')
        done = orbc('verify', scene, '--json')
        verdict = json.loads(done.stdout)['pictures'][0] if done.returncode < 2 and done.stdout else {}
        check(done.returncode == 0 and verdict['within_2'] >= 0.995 and verdict['beyond_2_elsewhere'] == 0,
              f'{name}: POV-Ray\'s picture of the export and the tracer\'s agree: {100 * verdict.get("within_2", 0):.3f} % within 2/255 {done.stderr.decode()[:300]}')
        print(f'        {name}: {time.monotonic() - start:.0f} s')
    for name in ('octant', 'decagon'):
        png, traced = where / f'{name}.png', where / f'{name}-traced.png'
        done = orbc('render', FLAT / f'{name}.yaml', '-o', png, '--engine', 'blender', '--size', SIZE, '--samples', '1', '--quiet')
        check(done.returncode == 0, f'{name}: drawn by Blender {done.stderr.decode()[:300]}')
        orbc('trace', FLAT / f'{name}.yaml', '-o', traced, '--size', SIZE, '--samples', '1', '--quiet')
        difference = abs(picture(png) - picture(traced)).max(axis=2)
        check((difference <= 2).mean() >= 0.98, f'{name}: Blender agrees with the tracer: {100 * (difference <= 2).mean():.3f} % within 2/255')
    # Same bytes: one and two threads, twice, through a file and through a pipe.
    scene = FLAT / 'octant.yaml'
    first = orbc('compile', scene, '-f', 'glb', '-o', '-', '--threads', '1').stdout
    orbc('compile', scene, '-o', where / 'scene.glb', '--threads', '2')
    check(first == (where / 'scene.glb').read_bytes(), 'same GLB at 1 and 2 threads, in a file and through a pipe')
    a = orbc('compile', scene, '-f', 'pov', '-o', '-', '--threads', '1').stdout
    b = orbc('compile', scene, '-f', 'pov', '-o', '-', '--threads', '2').stdout
    check(len(a) > 100000 and a == b, 'same POV at 1 and 2 threads and from run to run')
    orbc('trace', scene, '-o', where / 't1.exr', '--size', '200x150', '--threads', '1')
    orbc('trace', scene, '-o', where / 't2.exr', '--size', '200x150', '--threads', '2')
    check((where / 't1.exr').read_bytes() == (where / 't2.exr').read_bytes(), 'same traced film, byte by byte, at 1 and 2 threads')
finish()
