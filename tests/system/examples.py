#!/usr/bin/env python3
"""Every example is checked, compiled to each format, validated, drawn by POV-Ray, and agrees with the tracer; two are drawn by Blender."""
import json
import pathlib
import sys
import time

from helpers import BIN, ROOT, SCRIPTS, check, finish, folder, need, picture, run

need('povray', 'blender', 'node')
EXAMPLES = sorted((ROOT / 'examples').glob('*/scene.yaml'))
SIZE = '400x300'   # of Blender's pictures
check(len(EXAMPLES) >= 8, f'{len(EXAMPLES)} examples')


def orbc(*words):
    return run([BIN / 'orbc', *words], timeout=600)


def agrees(name, scene):
    """Both roads, pixel by pixel: flat colours exactly, at the scene's size; light, which is baked at texels, in a small picture.

    There much is glass and edges; chance (paths) and what glass and metals mirror in a pixel want many samples.
    """
    text = scene.read_text()
    paths, lit = 'integrator: path' in text, has_lamps(text)
    samples = '64' if 'material: gold' in text else '4'
    words = ('--size', '64x48', '--samples', '64') if paths else ('--size', '120x90', '--samples', samples) if lit else ()
    words += ('--quality', 'normal') if lit else ()
    done = orbc('verify', scene, '--json', *words)
    verdict = json.loads(done.stdout)['pictures'][0] if done.returncode < 2 and done.stdout else {}
    if lit:
        least4, least8 = (0.92, 0.985) if paths else (0.93, 0.95)
        check(verdict and verdict['within_4'] >= least4 and verdict['within_8'] >= least8,
              f'{name}: lit, both pictures agree: {100 * verdict.get("within_4", 0):.3f} % within 4/255, {100 * verdict.get("within_8", 0):.3f} % within 8/255')
    else:
        check(done.returncode == 0 and verdict['within_2'] >= 0.995 and verdict['beyond_2_elsewhere'] == 0,
              f'{name}: POV-Ray\'s picture of the export and the tracer\'s agree: {100 * verdict.get("within_2", 0):.3f} % within 2/255 {done.stderr.decode()[:300]}')


def has_lamps(text):
    return '\nlights:' in text


with folder() as where:
    where = pathlib.Path(where)
    for scene in EXAMPLES:
        name = scene.parent.name
        start = time.monotonic()
        check(orbc('check', scene).returncode == 0, f'{name}: check')
        check((scene.parent / 'README.md').exists(), f'{name}: says what to see')
        text = scene.read_text()
        glb, svg = where / f'{name}.glb', where / f'{name}.svg'
        # Light as coarse as it gets: here it matters that the file is right. What glass shows is in one file, examples/glass.
        coarse = ('--size', '120x90', '--quality', 'draft', *(() if name == 'glass' else ('--no-highlights',))) if has_lamps(text) else ()
        done = orbc('compile', scene, '-o', glb, '--quiet', *coarse)
        check(done.returncode == 0, f'{name}: glb {done.stderr.decode()[:300]}')
        valid = run(['node', SCRIPTS / 'validate_gltf.mjs', glb])
        check(valid.returncode == 0, f'{name}: the Khronos validator finds nothing {valid.stdout.decode()[:300] if valid.returncode else ""}')
        check(orbc('compile', scene, '-o', svg, '--quiet').returncode == 0 and b'<svg' in svg.read_bytes()[:400], f'{name}: svg')
        agrees(name, scene)
        if '\n#+lights:' in text:
            with_lamp = where / f'{name}.yaml'
            with_lamp.write_text(text.replace('\n#+', '\n').replace('../meshes', str(ROOT / 'examples/meshes')))
            check(orbc('check', with_lamp).returncode == 0, f'{name}: all right with its lamp, too')
        print(f'        {name}: {time.monotonic() - start:.0f} s')
    for name in ('octant', 'decagon'):
        png, traced = where / f'{name}.png', where / f'{name}-traced.png'
        done = orbc('render', ROOT / 'examples' / name / 'scene.yaml', '-o', png, '--engine', 'blender', '--size', SIZE, '--quiet')
        check(done.returncode == 0, f'{name}: drawn by Blender {done.stderr.decode()[:300]}')
        orbc('trace', ROOT / 'examples' / name / 'scene.yaml', '-o', traced, '--size', SIZE, '--quiet')
        difference = abs(picture(png) - picture(traced)).max(axis=2)
        check((difference <= 2).mean() >= 0.98, f'{name}: Blender agrees with the tracer: {100 * (difference <= 2).mean():.3f} % within 2/255')
    # Same bytes: one and two threads, twice, through a file and through a pipe.
    scene = ROOT / 'examples/octant/scene.yaml'
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
