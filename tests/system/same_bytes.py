#!/usr/bin/env python3
"""The same scene gives the same bytes: with any number of threads, any variant of the C library's mathematics and of libjpeg's and zlib's
vector code, in any locale, folder and time zone."""
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys

from PIL import Image

from helpers import BIN, check, finish, folder, run

ORBC = BIN / 'orbc'

PLAIN = {
    # One room of each space, lit, with a picture as texture and what is traced for the eye.
    'spherical': ('*222', '{sphere: {radius: 0.12}, at: {polar: [0.25, 200deg]}, material: glass}'),
    'flat': ('*333', '{torus_knot: {p: 2, q: 3, radius: 0.09, tube: 0.03}, at: {polar: [0.2, 200deg], z: 0.15}, material: gold}'),
    'hyperbolic': ('*22222', '{cylinder: {radius: 0.08, height: 0.3}, at: {polar: [0.25, 200deg]}, material: {marble: ["#241f1d", "#8a6f4a"], cell: 0.1}}'),
}
EVERY_FACTOR = 'hyperbolic'   # the room that tries each factor alone, in pairs and all together
SCENE = '''orbc: 1
orbifold: "%s"
room:
  height: 0.9
  floor: {checker: [ivory, slategray], cell: 0.25}
  walls: {all: {mirror: {reflectance: 0.9}, frame: {width: 0.03, color: goldenrod}}, 1: {mirror: none, texture: wall.jpg, cell: 0.5}}
objects: [%s]
lights: [{kind: sphere, at: {polar: [0.05, 40deg], z: 0.7}, radius: 0.05, power: 4, temperature: 3400}]
camera: {at: {polar: [0.15, 40deg], z: 0.45}, look_at: {polar: [0.25, 200deg], z: 0.15}, fov: 80deg, size: [40, 30]}
cover: {max_bounces: 2}
'''

# The mathematics of glibc for processors without fused multiply-add, and the plain code of libjpeg-turbo.
OTHER_VARIANTS = {'GLIBC_TUNABLES': 'glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX,-ERMS', 'JSIMD_FORCENONE': '1'}


def made_locale(where):
    """A locale with a decimal comma, compiled into a folder of its own; None where localedef or its sources are missing."""
    if shutil.which('localedef') is None:
        return None
    done = run(['localedef', '-i', 'de_DE', '-f', 'UTF-8', where / 'de_DE.UTF-8'])
    return {'LOCPATH': str(where), 'LC_ALL': 'de_DE.UTF-8', 'LANG': 'de_DE.UTF-8'} if (where / 'de_DE.UTF-8').is_dir() else (print(done.stderr.decode()) or None)


def outputs(scene, where, start, threads, environment):
    """Everything that orbc writes of a scene, as file name -> digest. In: the folder it is started in; the scene as it is called there."""
    made = where / 'made'
    shutil.rmtree(made, ignore_errors=True)
    made.mkdir()
    called = scene if start != scene.parent else pathlib.Path(scene.name)
    target = made if start != where else pathlib.Path('made')
    common = ['--threads', threads, '--quiet']
    commands = [['compile', called, '-o', target / 'room.pov', '--report', target / 'report.json', '--quality', 'draft'],
                ['compile', called, '-o', target / 'room.glb', '--quality', 'draft', '--atlas', '16', '--no-highlights'],
                ['compile', called, '-o', target / 'room.gltf', '--quality', 'draft', '--integrator', 'path', '--no-highlights'],
                ['compile', called, '-o', target / 'deep.pov', '--quality', 'draft', '--atlas', 'exr', '--no-highlights'],
                ['compile', called, '-o', target / 'room.svg'],
                ['trace', called, '-o', target / 'room.png', '--samples', '4'],
                ['trace', called, '-o', target / 'room.exr', '--samples', '2'],
                ['trace', called, '-o', target / 'path.exr', '--samples', '2', '--integrator', 'path', '--quality', 'draft']]
    for command in commands:
        done = run([ORBC, *command, *common], cwd=start, env={**os.environ, **environment})
        if done.returncode:
            sys.exit(f'{command}: {done.stderr.decode()}')
    for command in (['info', '*237', '--json'], ['info', '*22222', '--json', '--shape', 'paper'], ['compile', called, '--plan']):
        (made / (command[0] + str(len(command)) + '.json')).write_bytes(run([ORBC, *command], cwd=start, env={**os.environ, **environment}).stdout)
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(made.iterdir())}


def runs_of(here, elsewhere, locale):
    """What changes from run to run: name, folder, threads, environment. Each factor alone, then pairs of them so that every two meet in every
    way, then all."""
    zone = {'TZ': 'Pacific/Kiritimati'}
    return [('two threads', here, 2, {}), ("the C library's other mathematics", here, 1, OTHER_VARIANTS), ('a decimal comma', here, 1, locale),
            ('another folder', elsewhere, 1, {}), ('another time zone', here, 1, zone),
            ('threads, mathematics and comma', here, 2, {**OTHER_VARIANTS, **locale}), ('threads, folder and zone', elsewhere, 2, zone),
            ('mathematics, folder and zone', elsewhere, 1, {**OTHER_VARIANTS, **zone}), ('comma, folder, zone', elsewhere, 1, {**locale, **zone}),
            ('everything', elsewhere, 2, {**OTHER_VARIANTS, **locale, **zone})]


def compare_runs(where, scene, locale):
    elsewhere = where / 'elsewhere' / 'deep'
    elsewhere.mkdir(parents=True, exist_ok=True)
    runs = runs_of(scene.parent, elsewhere, locale)
    # Folders, zones and commas know nothing of the space: one room tries them one by one. Threads and mathematics are tried in every space.
    if scene.stem != EVERY_FACTOR:
        runs = [run for run in runs if run[0] in ('two threads', "the C library's other mathematics", 'everything')]
    first = outputs(scene, where, scene.parent, 1, {'LC_ALL': 'C', 'TZ': 'UTC'})
    check(len(first) >= 14, f'{scene.stem}: {len(first)} files are compared')
    for name, start, threads, environment in runs:
        other = outputs(scene, where, start, threads, environment)
        different = [file for file in first if other.get(file) != first[file]]
        check(not different and set(other) == set(first), f'{scene.stem}: the same bytes with {name} {" ".join(different)}')


def calls_no_library_mathematics():
    """The rooms' own check reads the source; this one sees what templates and libraries bring into the program."""
    if shutil.which('nm') is None:
        return
    listed = run(['nm', '-D', '--undefined-only', ORBC]).stdout.decode()
    names = {line.split()[-1].split('@')[0] for line in listed.splitlines()}
    # cosl and sinl decide by bounds (cover/roots.cpp); fmod, floor and their like are exact. OpenMesh takes the cosine of one constant, and
    # Boost's arcs of 168 bits begin with one of float and are then made better far beyond double.
    allowed = {'cos', 'atanf'}
    forbidden = {name + kind for name in 'sin cos tan sincos asin acos atan atan2 exp exp2 exp10 expm1 log log1p log2 log10 pow sinh cosh tanh asinh acosh atanh '
                 'hypot cbrt fma tgamma lgamma erf cabs cexp clog csqrt cpow'.split() for kind in ('', 'f')} - allowed
    check(not names & forbidden, f'the program takes no mathematics from the C library that depends on the processor: {sorted(names & forbidden)}')


with folder() as name:
    where = pathlib.Path(name)
    Image.radial_gradient('L').convert('RGB').resize((61, 47)).save(where / 'wall.jpg', quality=80)
    (where / 'locales').mkdir()
    locale = made_locale(where / 'locales')
    check(locale is not None, 'a locale with a decimal comma is there to try')
    calls_no_library_mathematics()
    for kind, (orbifold, thing) in PLAIN.items():
        scene = where / f'{kind}.yaml'
        scene.write_text(SCENE % (orbifold, thing))
        compare_runs(where, scene, locale or {})

finish()
