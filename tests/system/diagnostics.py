#!/usr/bin/env python3
"""Diagnostics that only the whole program raises, or that need large or odd input: each by the smallest scene that shows it."""
import os
import pathlib
import signal
import subprocess
import time

from helpers import BIN, ROOT, check, finish, folder, run

ORBC = BIN / 'orbc'
LENS = 'camera: {at: {polar: [0.5, 200deg]}, lens: {radius: 0.02, focus_distance: 0.5}}\ncover: {max_bounces: 1}'
STEREO = 'camera: {projection: stereo, eye_separation: 0.03, at: {polar: [0.5, 200deg]}, size: [40, 40]}'
HEAD = 'orbc: 1\norbifold: "*2222"\n'


def many_materials(where, count):
    """An OBJ file of `count` triangles, each of another material."""
    lines = []
    (where / f'many-{count}.mtl').write_text(''.join(f'newmtl m{i}\nKd {i / count} 0.5 0.5\n' for i in range(count)))
    for i in range(count):
        lines += [f'v {i % 16} {i // 16} 0', f'v {i % 16 + 0.5} {i // 16} 0', f'v {i % 16} {i // 16 + 0.5} 0.5', f'usemtl m{i}', 'f -3 -2 -1']
    name = f'many-{count}.obj'
    (where / name).write_text(f'mtllib many-{count}.mtl\n' + '\n'.join(lines) + '\n')
    return name


def with_bumps(where):
    """An OBJ file whose material has a bump map."""
    (where / 'bumps.mtl').write_text('newmtl rough\nKd 0.5 0.5 0.5\nmap_Bump leaf.png\n')
    (where / 'bumps.obj').write_text('mtllib bumps.mtl\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0.1\nusemtl rough\nf 1 2 3\n')
    return 'bumps.obj'


with folder() as name:
    where = pathlib.Path(name)
    (where / 'statue.ply').write_bytes((ROOT / 'examples/meshes/statue_small.ply').read_bytes())
    (where / 'leaf.png').write_bytes((ROOT / 'docs/pictures/materials.png').read_bytes())
    most = many_materials(where, 65_600)
    full = many_materials(where, 255)
    glb = ['-f', 'glb', '-o', where / 'out.glb']
    cases = [
        ('mesh.too-many-looks', 0, f'objects: [{{mesh: {most}, size: 0.2}}]', ['check']),
        ('place.too-many-looks', 1, 'objects:\n' + f'  - {{mesh: {full}, size: 0.2}}\n' * 258, ['check']),
        ('mesh.ignored', 0, f'objects: [{{mesh: {with_bumps(where)}, size: 0.2}}]', ['check']),
        ('place.no-uv', 0, 'objects: [{mesh: statue.ply, size: 0.2, material: {texture: leaf.png}}]', ['check']),
        ('place.masked-shell', 1, 'room: {floor: {color: red, opacity_mask: leaf.png}}', ['check']),
        ('driver.glowing-mirror', 1, 'room: {walls: {all: {mirror: {glow: gray}}}}', ['compile', *glb]),
        ('driver.no-curtains', 0, 'cover: {max_bounces: 6}\nobjects: [{mesh: statue.ply, size: 0.3}]\ncamera: {at: {polar: [0.5, 200deg]}}',
         ['compile', *glb, '--max-triangles', '{least}']),
        ('cover.stacked-mirrors', 1, 'room: {walls: {1: {mirrors: [{height: [0, 0.4]}, {height: [0.4, 1], reflectance: 0.5}]}}}\ncover: {max_bounces: 2}',
         ['compile', *glb, '--view', 'disk']),
        ('driver.stereo-export', 1, STEREO, ['compile', *glb]),
        ('place.stereo-eye', 1, STEREO.replace('0.03', '1.2'), ['check']),
        ('driver.no-lens', 0, LENS, ['compile', *glb]),
        ('cli.few-lens-samples', 0, LENS, ['trace', '-o', where / 'out.png', '--size', '8x6', '--samples', '1']),
        ('cli.lens-left-out', None, LENS, ['verify', '--size', '8x6', '--verbose']),
    ]
    for code, exit_code, text, (command, *words) in cases:
        scene = where / 'scene.yaml'
        scene.write_text(HEAD + text + '\n')
        if '{least}' in words:   # the fewest triangles that are not refused
            low, high = 1, 200000
            while low < high:
                middle = (low + high) // 2
                done = run([ORBC, command, scene, *[middle if word == '{least}' else word for word in words]])
                low, high = (low, middle) if done.returncode == 0 else (middle + 1, high)
            words = [low if word == '{least}' else word for word in words]
        done = run([ORBC, command, scene, *words])
        told = done.stderr.decode()
        check(exit_code in (None, done.returncode) and f'[{code}]' in told, f'{code} is told: {done.returncode} {told[:300] if f"[{code}]" not in told else ""}')

    # What the machine refuses, and what the program says of itself
    scene.write_text(HEAD + 'cover: {max_bounces: 2}\n')
    nowhere = dict(os.environ, PATH=str(where))
    done = run([ORBC, 'render', scene, '-o', where / 'p.png', '--size', '8x6', '--engine', 'blender'], env=nowhere)
    check(done.returncode == 3 and b'[cli.not-drawn]' in done.stderr, f'cli.not-drawn is told: {done.returncode} {done.stderr.decode()[:200]}')
    done = run([ORBC, 'new', '*(3/2)(12)(12)'])
    check(done.returncode == 0 and b'[notation.non-orbifold-room]' in done.stderr, 'notation.non-orbifold-room is told')
    process = subprocess.Popen([ORBC, 'trace', scene, '-o', where / 'long.png', '--samples', '4000', '--json'], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=20)
    check(process.returncode == 130 and b'"cli.stopped"' in out and not (where / 'long.png').exists(), f'cli.stopped is told as JSON: {out.decode()[:200]}')
    if b'__asan_init' not in ORBC.read_bytes():   # the address sanitizer's shadow memory needs terabytes of addresses
        octant = ROOT / 'tests/scenes/flat/octant.yaml'
        done = run(['bash', '-c', f'ulimit -v 150000; exec {ORBC} compile {octant} --max-bounces 40 --no-lod --json -o {where}/large.glb'])
        check(done.returncode == 3 and b'"cli.out-of-memory"' in done.stdout, f'cli.out-of-memory is told as JSON: {done.stdout.decode()[:200]}')
    # Told before the export is made: the program is stopped once it is
    scene.write_text('orbc: 1\norbifold: "*22222"\nobjects: [{mesh: statue.ply, size: 0.3, at: centre}]\ncamera: {at: {polar: [0.4, 200deg]}}\ncover: {max_bounces: 9}\n')
    process = subprocess.Popen([ORBC, 'compile', scene, *map(str, glb), '--no-lod', '--max-memory', '60GiB'], stderr=subprocess.PIPE)
    told = b''
    while b'[cli.large-export]' not in told:
        line = process.stderr.readline()
        if not line:
            break
        told += line
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=120)
    check(b'[cli.large-export]' in told, f'cli.large-export is told: {told.decode()[:300]}')
finish()
