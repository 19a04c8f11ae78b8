#!/usr/bin/env python3
"""A picture is what its name says, whoever draws it: its first bytes are those of its format, and the same scene gives the same bytes on another day."""
import io
import json
import pathlib
import shutil
import signal
import subprocess
import time

import numpy as np
from PIL import Image

from helpers import BIN, SCRIPTS, check, finish, folder, picture, run

ORBC = BIN / 'orbc'
MAGIC = {'png': b'\x89PNG\r\n\x1a\n', 'PNG': b'\x89PNG\r\n\x1a\n', 'jpg': b'\xff\xd8\xff', 'jpeg': b'\xff\xd8\xff', 'exr': b'\x76\x2f\x31\x01'}
SCENE = '''orbc: 1
orbifold: "*2222"
camera: {at: {polar: [0.6, 225deg]}, look_at: centre, size: [64, 48]}
cover: {max_bounces: 1}
'''
ENGINES = ['tracer'] + [engine for engine in ('povray', 'blender') if shutil.which(engine)]


def chunks(data):
    """Names of the chunks of a PNG file, in order, each once."""
    names, at = [], 8
    while at + 8 <= len(data):
        length, kind = int.from_bytes(data[at:at + 4], 'big'), data[at + 4:at + 8].decode()
        if kind not in names:
            names.append(kind)
        at += 12 + length
    return names


with folder() as name:
    where = pathlib.Path(name)
    scene = where / 'scene.yaml'
    scene.write_text(SCENE)

    def drawings():
        """Each command that writes a picture, to the file it is given."""
        for engine in ENGINES:
            yield f'render --engine {engine}', lambda file, engine=engine: run([ORBC, 'render', scene, '--engine', engine, '-o', file], cwd=where)
        yield 'trace', lambda file: run([ORBC, 'trace', scene, '-o', file], cwd=where)
        if 'povray' in ENGINES:
            yield 'verify --difference', lambda file: run([ORBC, 'verify', scene, '--difference', file], cwd=where)

    for what, draw in drawings():
        exr = what in ('render --engine tracer', 'trace')
        for ending, magic in MAGIC.items():
            done = draw(f'x.{ending}')
            if ending == 'exr' and not exr:
                check(done.returncode == 2 and b'.png or .jpg' in done.stderr and not (where / 'x.exr').exists(), f'{what} refuses .exr, and says what it writes')
                continue
            file = where / f'x.{ending}'
            check(done.returncode == 0 and file.read_bytes()[:len(magic)] == magic, f'{what} to .{ending} writes that {done.stderr.decode()[:200] if done.returncode else ""}')
            if ending == 'jpg':
                off = np.abs(picture(file) - picture(where / 'x.png'))
                check(off.mean() < 2.5 and Image.open(file).size == (64, 48), f'{what}: the JPEG shows the same picture (mean difference {off.mean():.2f})')
                check(draw('y.jpeg').returncode == 0 and (where / 'y.jpeg').read_bytes() == file.read_bytes(), f'{what}: same JPEG, same bytes')
            if ending != 'png':
                file.unlink()
        for bad in ('x.tif', 'x', 'x.webp', 'x.png.', 'x.exr.gif'):
            done = draw(bad)
            check(done.returncode == 2 and b'.png, .jpg' in done.stderr and not (where / bad).exists(), f'{what} to {bad} is refused, and says what there is')
        if what.startswith('verify'):
            check(draw('-').returncode == 2, f'{what} to standard output is refused: the table goes there')
            continue
        done = draw('-')
        shown = np.asarray(Image.open(io.BytesIO(done.stdout)).convert('RGB')).astype(int)
        check(done.returncode == 0 and done.stdout[:8] == MAGIC['png'] and (draw('x.png').returncode == 0 and (shown == picture(where / 'x.png')).all()), f'{what} to standard output is the PNG')

    if 'povray' in ENGINES:
        for stem, files in (('kept', ('kept-export.png', 'kept-tracer.png')), ('shot.jpg', ('shot-export.jpg', 'shot-tracer.jpg'))):
            run([ORBC, 'verify', scene, '--keep', stem], cwd=where)
            check(all((where / file).read_bytes().startswith(MAGIC[file[-3:]]) for file in files), f'verify --keep {stem} writes {" and ".join(files)}')

    # Dates: what renderers write into their pictures does not come through.
    plain = {'IHDR', 'PLTE', 'tRNS', 'gAMA', 'cHRM', 'sRGB', 'iCCP', 'sBIT', 'IDAT', 'IEND'}
    run([ORBC, 'compile', scene, '-o', 'x.pov'], cwd=where)
    run([ORBC, 'compile', scene, '-o', 'x.glb'], cwd=where)
    WAYS = [(f'render --engine {engine}', [ORBC, 'render', scene, '--engine', engine]) for engine in ENGINES]
    WAYS += [('render --engine povray --samples 4', [ORBC, 'render', scene, '--engine', 'povray', '--samples', '4'])] if 'povray' in ENGINES else []
    WAYS += [('povray-pipe', [SCRIPTS / 'povray-pipe', 'x.pov'])] if 'povray' in ENGINES else []
    WAYS += [('render_blender.py', [SCRIPTS / 'render_blender.py', 'x.glb'])] if 'blender' in ENGINES else []
    first = {}
    for what, command in WAYS:
        run([*command, '-o', 'first.png'], cwd=where)
        first[what] = (where / 'first.png').read_bytes()
    time.sleep(1.1)   # chunks of dates count seconds
    for what, command in WAYS:
        run([*command, '-o', 'second.png'], cwd=where)
        second = (where / 'second.png').read_bytes()
        check(set(chunks(second)) <= plain, f'{what}: its picture says nothing but the picture ({" ".join(chunks(second))})')
        check(second == first[what], f'{what}: the same scene gives the same bytes a second later')

    # A picture that is refined can be stopped at any time: what has been written last is whole.
    slow = where / 'slow.yaml'
    slow.write_text(SCENE.replace('max_bounces: 1', 'max_bounces: 12').replace('[64, 48]', '[320, 240]'))
    going = subprocess.Popen([ORBC, 'trace', slow, '-o', where / 'refined.png', '--noise', '0.0001', '--samples', '65536'], stderr=subprocess.PIPE)
    deadline = time.monotonic() + 60
    while not (where / 'refined.png').exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    going.send_signal(signal.SIGINT)
    message = going.communicate(timeout=60)[1].decode()
    stopped = (where / 'refined.png').exists() and picture(where / 'refined.png')
    check(going.returncode == 130 and stopped is not False and stopped.shape[:2] == (240, 320), f'a stopped picture is whole: {going.returncode} {message}')
    check(not [file for file in where.iterdir() if file.name not in ('refined.png', 'slow.yaml', 'scene.yaml') and 'refined' in file.name], 'and nothing else is left')
    told = json.loads(run([ORBC, 'trace', scene, '-o', where / 'smooth.png', '--noise', '8/255', '--json']).stdout)
    check(told['unsettled'] < 0.05 and told['mean_samples'] < told['samples'] and abs(told['noise_target'] - 8 / 255) < 1e-12, f'--noise tells what it took {told}')
    for words in (['--noise', '0'], ['--noise', '2'], ['--noise', '1/0'], ['--noise', 'little'], ['--noise', '1/255/2'], ['--noise', '1/255', '--pass', 'depth']):
        done = run([ORBC, 'trace', scene, '-o', where / 'never.png', *words])
        check(done.returncode == 2 and not (where / 'never.png').exists(), f'{" ".join(words)} is refused: {done.stderr.decode().strip()}')
    # What is above white is told of, once: with more than 1 % of the pixels, in pictures of 8 bits.
    bright = where / 'bright.yaml'
    bright.write_text(SCENE + 'lights: [{kind: point, at: {z: 0.5}, power: 400}]\n')
    for output, exposure, told in (('bright.png', '1', 1), ('bright.png', '0.0001', 0), ('bright.exr', '1', 0)):
        done = run([ORBC, 'trace', bright, '-o', where / output, '--set', f'exposure={exposure}'])
        check(done.returncode == 0 and done.stderr.decode().count('render.clipped') == told, f'{output} at exposure {exposure}: {told} notes of what is cut off {done.stderr.decode()}')
finish()
