"""--max-memory holds in every command, whatever takes the memory: each run keeps its peak below the limit, or is refused and names the
setting. Hostile files end within seconds."""
import json
import math
import os
import random
import struct
import time

from helpers import *

ORBC = BIN / 'orbc'
HEAD = 'orbc: 1\norbifold: "*2222"\nroom: {scale: 0.7, height: 0.9}\n'
EYE = 'camera: {at: {polar: [0.55, 222deg], z: 0.5}, look_at: {azimuth: 42deg, elevation: -10deg}, size: [160, 120]}\n'
COUNTED = b'__asan_init' not in ORBC.read_bytes() and b'__tsan_init' not in ORBC.read_bytes()   # sanitizers keep memory of their own


def spent(words):
    """Runs orbc. Makes: its exit code, what it says, its peak of resident memory in MiB, its processor time in seconds."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.dup2(write, 2)
        os.dup2(os.open('/dev/null', os.O_WRONLY), 1)
        os.closerange(3, 64)
        os.execv(ORBC, [str(word) for word in [ORBC, *words]])
    os.close(write)
    with os.fdopen(read, 'rb') as pipe:
        told = pipe.read()
    _, status, used = os.wait4(child, 0)
    return os.waitstatus_to_exitcode(status), told.decode(errors='replace'), used.ru_maxrss / 1024, used.ru_utime + used.ru_stime


def within(limit, words, what):
    code, told, peak, _ = spent([*words, '--max-memory', f'{limit}MiB'])
    refused = code in (1, 3) and 'max-memory' in told or code == 1 and 'error[' in told
    check(code == 0 or refused, f'{what}, {limit} MiB: done, or refused by name: {code} {"" if code == 0 else told[-200:]}')
    if COUNTED:
        check(peak <= limit, f'{what}, {limit} MiB: peak {peak:.0f} MiB ({"done" if code == 0 else "refused"})')
    return code


def wavy(path, side):
    """An OBJ of 2 side² triangles."""
    with open(path, 'w') as out:
        for i in range(side + 1):
            for j in range(side + 1):
                out.write(f'v {i} {j} {5 * math.sin(i / 3) * math.sin(j / 5):.4f}\n')
        for i in range(side):
            for j in range(side):
                a = i * (side + 1) + j + 1
                out.write(f'f {a} {a + 1} {a + side + 2} {a + side + 1}\n')


def fan(path, corners):
    with open(path, 'w') as out:
        for i in range(corners):
            out.write(f'v {math.cos(2 * math.pi * i / corners):.12g} {math.sin(2 * math.pi * i / corners):.12g} 0\n')
        out.write('f ' + ' '.join(str(i + 1) for i in range(corners)) + '\n')


def ends(most, words, what):
    code, told, _, seconds = spent(words)
    check(code == 0, f'{what} is done: {code} {told[-200:] if code else ""}')
    check(seconds < most, f'{what} takes {seconds:.1f} s of processor time, at most {most}')


with folder() as where:
    where = pathlib.Path(where)
    scene = where / 'scene.yaml'

    # What takes memory: copies and their triangles, levels of detail, light, textures.
    octant = ROOT / 'examples/octant/scene.yaml'
    lit = ROOT / 'examples/lit-triangle/scene.yaml'
    wavy(where / 'wavy.obj', 150)
    mesh = where / 'mesh.yaml'
    mesh.write_text(HEAD + 'objects: [{mesh: wavy.obj, size: 0.4, at: centre}]\n' + EYE + 'cover: {max_bounces: 3}\n')
    painted = where / 'painted.yaml'
    for i in range(4):
        Image.new('1', (4096, 4096), i % 2).save(where / f'p{i}.png')
    painted.write_text(HEAD + 'objects:\n' + ''.join(f'  - {{box: {{size: [0.1, 0.1, 0.1]}}, at: {{xy: [{0.2 * i - 0.3:.1f}, 0.1]}}, material: {{texture: p{i}.png}}}}\n' for i in range(4)) + EYE)
    done = []
    for limit in (48, 160):
        done.append(within(limit, ['compile', octant, '-o', where / 'x.glb', '-q', '--max-bounces', '20'], 'many copies'))
        done.append(within(limit, ['compile', mesh, '-o', where / 'x.pov', '-q'], 'levels of detail'))
        done.append(within(limit, ['trace', mesh, '-o', where / 'x.exr', '-q', '--samples', '1'], 'tracing a mesh'))
        done.append(within(limit, ['compile', lit, '-o', where / 'x.pov', '-q', '--size', '100x75', '--quality', 'draft', '--no-highlights'], 'baked light'))
        done.append(within(limit, ['trace', painted, '-o', where / 'x.png', '-q', '--samples', '1'], 'four large pictures'))
        done.append(within(limit, ['check', painted, '-q'], 'checking them'))
        done.append(within(limit, ['render', mesh, '-o', where / 'x.png', '-q', '--size', '1600x1200', '--samples', '1', '--max-bounces', '1'], 'a larger picture'))
    check(0 in done and len(set(done)) > 1, 'some are done, some are refused')
    code, told, *_ = spent(['trace', mesh, '-o', where / 'x.png', '--json', '--max-memory', '24MiB'])
    check(code == 3 and '--max-memory is reached' in told or not COUNTED, f'cli.max-memory is told: {code} {told[-200:]}')

    # Limits are understood everywhere, before anything is read.
    for words in (['info', '*237'], ['enumerate'], ['check', octant], ['render', octant, '-o', where / 'x.png'], ['verify', octant], ['explain'], ['svg', '*237']):
        code, told, *_ = spent([*words, '--max-memory', 'junk'])
        check(code == 2 and '--max-memory wants' in told, f'{words[0]} refuses a limit that is none: {code} {told[:100]}')
    code, told, *_ = spent(['enumerate', '--corners', '3', '--max-order', '1000000'])
    check(code == 2 and '--max-order' in told and len(told) < 1000, f'a list without end is refused: {code} {told[:200]}')

    # A binary STL says how long it is: 900 MB are refused unread. (The file is sparse: it takes no disk.)
    count = 18_000_000
    with open(where / 'long.stl', 'wb') as out:
        out.write(b' ' * 80 + struct.pack('<I', count))
        out.truncate(84 + 50 * count)
    scene.write_text(HEAD + 'objects: [{mesh: long.stl, size: 0.2, at: centre}]\n' + EYE)
    code, told, peak, seconds = spent(['check', scene])
    check(code == 1 and '--max-memory' in told and (peak < 100 or not COUNTED) and seconds < 5, f'a long STL is refused unread: {code} {peak:.0f} MiB {seconds:.1f} s')

    # Time follows from size.
    scene.write_text(HEAD + 'objects: [{mesh: fan.obj, size: 0.3, up: y, at: centre}]\n' + EYE + 'cover: {max_bounces: 2}\n')
    factor = 1 if COUNTED else 20
    for corners, most in ((16_000, 10), (100_000, 60)):
        fan(where / 'fan.obj', corners)
        ends(factor * most, ['compile', scene, '-o', where / 'x.glb', '-q'], f'a polygon of {corners} corners')
    with open(where / 'fan.obj', 'w') as out:
        out.write('mtllib m.mtl\n')
        for i in range(201):
            for j in range(201):
                out.write(f'v {i} {j} 0\n')
        for i in range(200):
            for j in range(200):
                a = i * 201 + j + 1
                out.write(f'usemtl m{(i + j) % 2}\nf {a} {a + 1} {a + 202}\nusemtl m{(i + j + 1) % 2}\nf {a} {a + 202} {a + 201}\n')
    (where / 'm.mtl').write_text('newmtl m0\nKd 1 0 0\nnewmtl m1\nKd 0 0 1\n')
    ends(factor * 30, ['compile', scene, '-o', where / 'x.glb', '-q'], 'an OBJ that changes its material at every face')
finish()
