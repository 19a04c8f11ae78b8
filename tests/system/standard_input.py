#!/usr/bin/env python3
"""A scene that can be read only once, from standard input, a process substitution or a named pipe, works for every command and every engine."""
import os
import pathlib
import shutil
import threading

from helpers import BIN, ROOT, check, finish, folder, run

ORBC = BIN / 'orbc'
SCENE = b'''orbc: 1
orbifold: "*2222"
objects:
  - {mesh: ball.obj, size: 0.4, at: {polar: [0.3, 80deg]}, material: {color: coral}}
camera: {at: {polar: [0.6, 225deg]}, look_at: centre, size: [32, 24]}
cover: {max_bounces: 1}
'''
povray, blender = (shutil.which(program) is not None for program in ('povray', 'blender'))

# Every command that reads a scene, with every engine and format: words behind the scene, and the file that is made.
USES = [('check', [], None)]
USES += [('compile', ['-o', f'x.{form}'], f'x.{form}') for form in ('pov', 'glb', 'gltf', 'svg')]
USES += [('compile', ['--plan'], None), ('trace', ['-o', 'x.png'], 'x.png'), ('render', ['-o', 'x.png'], 'x.png')]
if povray:
    USES += [('render', ['-o', 'x.png', '--engine', 'povray'], 'x.png'), ('verify', ['--threshold', '0', '--off-edge', '1', '--difference', 'x.png'], 'x.png')]
if blender:
    USES += [('render', ['-o', 'x.png', '--engine', 'blender'], 'x.png')]

with folder() as name:
    where = pathlib.Path(name)
    (where / 'ball.obj').write_text((ROOT / 'tests/meshes/tetra.obj').read_text())
    (where / 'scene.yaml').write_bytes(SCENE)
    os.mkfifo(where / 'scene.fifo')

    def through_a_pipe(command, words):
        writer = threading.Thread(target=lambda: (where / 'scene.fifo').write_bytes(SCENE))
        writer.start()
        done = run([ORBC, command, where / 'scene.fifo', *words], cwd=where)
        writer.join(timeout=10)
        return done

    WAYS = {
        'standard input': lambda command, words: run([ORBC, command, '-', *words], cwd=where, input=SCENE),
        '/dev/stdin': lambda command, words: run([ORBC, command, '/dev/stdin', *words], cwd=where, input=SCENE),
        'a process substitution': lambda command, words: run(['bash', '-c', '"$0" "$1" <(cat scene.yaml) "${@:2}"', ORBC, command, *words], cwd=where),
        'a named pipe': through_a_pipe,
    }

    for command, words, made in USES:
        shown = ' '.join([command, *words])
        plain = run([ORBC, command, 'scene.yaml', *words], cwd=where)
        wanted = (where / made).read_bytes() if made else plain.stdout
        check(plain.returncode == 0, f'{shown} of a file {plain.stderr.decode()}')
        for way, through in WAYS.items():
            if made:
                (where / made).unlink(missing_ok=True)
            done = through(command, words)
            got = (where / made).read_bytes() if made and (where / made).exists() else done.stdout
            check(done.returncode == 0 and got == wanted, f'{shown} of {way} makes the same {done.stderr.decode()[:300] if done.returncode else ""}')

    for command, words, made in USES:
        done = run([ORBC, command, '-', *words], cwd=where, input=b'')
        check(done.returncode == 1 and b'scene.empty' in done.stderr, f'{command} {" ".join(words)} of nothing says that the scene is empty')
    done = run([ORBC, 'check', '-', '-'], cwd=where, input=SCENE)
    check(done.returncode == 2 and b'once' in done.stderr, 'standard input can be checked once')
    with open(where / 'scene.yaml', 'rb') as file:
        done = run([ORBC, 'check', '/dev/stdin'], cwd=where, stdin=file)
    check(done.returncode == 0, 'a file as /dev/stdin is relative to the current folder, too ' + done.stderr.decode()[:200])
finish()
