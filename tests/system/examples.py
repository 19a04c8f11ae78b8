#!/usr/bin/env python3
"""Every example is lit, checked, compiled to each format, validated, drawn by POV-Ray, and agrees with the tracer as well as baked light can."""
import json
import pathlib
import time

from helpers import BIN, ROOT, check, check_gltf, finish, folder, need, run

need('povray', 'node')
EXAMPLES = sorted((ROOT / 'examples').glob('*/scene.yaml'))
check(len(EXAMPLES) >= 14, f'{len(EXAMPLES)} examples')


def orbc(*words):
    return run([BIN / 'orbc', *words], timeout=600)


def agrees(name, text, scene):
    """Both roads in a small picture, where much is glass and edges and light is baked at few texels; flat colours are compared exactly in
    flat_scenes.py. Chance (paths) and what glass and metals mirror in a pixel want many samples.
    """
    paths = 'integrator: path' in text
    # A painted vase in 120 pixels is nothing but edges of its pattern, which the atlas holds as finely as the quality says.
    painted = 'vase.glb' in text
    samples = '64' if 'material: gold' in text else '16' if painted else '4'
    words = ('--size', '64x48', '--samples', '64') if paths else ('--size', '120x90', '--samples', samples)
    done = orbc('verify', scene, '--json', '--quality', 'fine' if painted else 'normal', *words)
    verdict = json.loads(done.stdout)['pictures'][0] if done.returncode < 2 and done.stdout else {}
    least4, least8 = (0.92, 0.985) if paths else (0.93, 0.95)
    check(verdict and verdict['within_4'] >= least4 and verdict['within_8'] >= least8,
          f'{name}: both pictures agree: {100 * verdict.get("within_4", 0):.3f} % within 4/255, {100 * verdict.get("within_8", 0):.3f} % within 8/255'
          f'{done.stderr.decode()[:300]}')


with folder() as where:
    where = pathlib.Path(where)
    for scene in EXAMPLES:
        name = scene.parent.name
        start = time.monotonic()
        done = orbc('check', scene)
        check(done.returncode == 0 and b'warning' not in done.stderr, f'{name}: check {done.stderr.decode()[:300]}')
        check((scene.parent / 'README.md').exists(), f'{name}: says what to see')
        text = scene.read_text()
        check('\nlights:' in text, f'{name}: is lit')
        glb, svg = where / f'{name}.glb', where / f'{name}.svg'
        # Light as coarse as it gets: here it matters that the file is right. What glass shows is in one file, examples/glass.
        coarse = ('--size', '120x90', '--quality', 'draft', *(() if name == 'glass' else ('--no-highlights',)))
        done = orbc('compile', scene, '-o', glb, '--quiet', *coarse)
        check(done.returncode == 0, f'{name}: glb {done.stderr.decode()[:300]}')
        check_gltf(glb, f'{name}: the Khronos validator finds nothing')
        check(orbc('compile', scene, '-o', svg, '--quiet').returncode == 0 and b'<svg' in svg.read_bytes()[:400], f'{name}: svg')
        agrees(name, text, scene)
        print(f'        {name}: {time.monotonic() - start:.0f} s')
finish()
