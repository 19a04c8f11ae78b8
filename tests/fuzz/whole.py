#!/usr/bin/env python3
"""Random rooms through the whole program: each scene is compiled, drawn by POV-Ray and by the tracer, and both pictures are compared.

    tests/fuzz/whole.py [--orbc PROGRAM] [--first SEED] [--count N] [--lit] [--keep FOLDER]

A scene that crashes, hangs, dies without a diagnostic, or whose two pictures differ away from edges is told and kept. Not part of the tests:
it is run by hand, as long as one likes. The same seed makes the same scene.
"""
import argparse
import json
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ORBIFOLDS = ['*', '*33', '*22', '*77', '*222', '*223', '*22(11)', '*233', '*234', '*235', '**', '*333', '*244', '*236', '*2222', '*237', '*238',
             '*245', '*334', '*444', '*2223', '*2233', '*22222', '*222222', '*33333', '*2323', '*23456']
NON_ORBIFOLDS = ['*(3/2)(12)(12)', '*(2.5)(2.5)(2.5)(2.5)', '*(5/2)33', '*(2.2)(2.7)(3.1)', '*(2.4)(2.4)(2.4)(2.4)(2.4)']
COLORS = ['ivory', 'slategray', 'coral', 'goldenrod', 'teal', 'white', 'firebrick', 'steelblue', 'olive', 'plum']


def corners(notation):
    inside, count = False, 0
    for letter in notation[1:]:
        inside = letter == '(' or (inside and letter != ')')
        count += letter == ')' or (letter.isdigit() and not inside)
    return count or (2 if notation == '**' else 1)


def mirror(dice, height):
    made = {'reflectance': round(dice.uniform(0.3, 1), 2)}
    if dice.random() < 0.3:
        made['tint'] = dice.choice(COLORS)
    if dice.random() < 0.2:
        low, high = sorted(round(dice.uniform(0, height), 3) for _ in range(2))
        if high - low > 0.1 * height:
            made['height'] = [low, high]
    if dice.random() < 0.25:
        made['frame'] = {'width': round(dice.uniform(0.01, 0.04), 3), 'color': dice.choice(COLORS)}
    return made


def wall(dice, height):
    kind = dice.random()
    if kind < 0.2:
        return {'mirror': 'none', 'color': dice.choice(COLORS)}
    if kind < 0.3:
        return {'mirror': 'none', 'checker': dice.sample(COLORS, 2), 'cell': round(dice.uniform(0.1, 0.4), 2)}
    if kind < 0.4:
        middle, gap = dice.uniform(0.35, 0.65) * height, 0.03
        return {'mirrors': [{'height': [0, round(middle - gap, 3)], 'reflectance': 0.8}, {'height': [round(middle + gap, 3), height], 'reflectance': 0.6}]}
    return {'mirror': mirror(dice, height)}


def surface(dice):
    if dice.random() < 0.15:
        return {'mirror': {'reflectance': round(dice.uniform(0.3, 0.9), 2)}}
    if dice.random() < 0.5:
        return {'checker': dice.sample(COLORS, 2), 'cell': round(dice.uniform(0.08, 0.5), 2)}
    return {'color': dice.choice(COLORS)}


def place(dice, reach, height=None):
    made = {'polar': [round(dice.uniform(0, reach), 3), f'{dice.randrange(360)}deg']}
    if height:
        made['z'] = round(dice.uniform(0.1, 0.9) * height, 3)
    return made


def thing(dice, reach, lit):
    size = round(dice.uniform(0.02, 0.09), 3)
    kind = dice.choice([{'sphere': {'radius': size}}, {'box': {'size': [size, 2 * size, 3 * size]}}, {'torus_knot': {'p': 2, 'q': 3, 'radius': size, 'tube': size / 4}}])
    made = dict(kind, at=place(dice, reach), turn=f'{dice.randrange(360)}deg')
    if lit and dice.random() < 0.5:
        made['material'] = dice.choice(['marble', 'gold', 'porcelain', 'wood', 'plaster', 'granite', 'chrome', 'glass'])
    else:
        made['material'] = {'color': dice.choice(COLORS)}
    return made


def lamp(dice, reach, height):
    kind = dice.choice(['point', 'sphere', 'disk', 'spot'])
    made = {'kind': kind, 'at': place(dice, reach, height), 'power': round(dice.uniform(1, 12), 1)}
    if kind in ('sphere', 'disk'):
        made['radius'] = round(dice.uniform(0.01, 0.05), 3)
    return made


def scene(seed, lit):
    dice = random.Random(seed)
    strange = dice.random() < 0.2
    notation = dice.choice(NON_ORBIFOLDS if strange else ORBIFOLDS)
    height = round(dice.uniform(0.3, 1.5), 2)
    walls = {number + 1: wall(dice, height) for number in range(corners(notation)) if dice.random() < 0.4}
    walls['all'] = {'mirror': mirror(dice, height)}
    reach = 0.12
    made = {'orbc': 1, 'orbifold': notation, 'room': {'height': height, 'floor': surface(dice), 'ceiling': surface(dice), 'walls': walls},
            'objects': [thing(dice, reach, lit) for _ in range(dice.randrange(3))],
            'camera': {'at': place(dice, reach, height), 'look_at': {'azimuth': f'{dice.randrange(360)}deg', 'elevation': f'{dice.randrange(-30, 30)}deg'},
                       'projection': dice.choice(['perspective', 'perspective', 'panorama', 'cylinder']), 'size': [160, 120]},
            'cover': {'max_bounces': dice.randrange(5 if strange or lit else 8)}}
    if made['camera']['projection'] == 'panorama':
        made['camera']['size'] = [200, 100]
    if strange:
        made['allow_non_orbifold'] = True
    if dice.random() < 0.2:
        made['cover']['background'] = dice.choice(COLORS)
    if lit:
        made['lights'] = [lamp(dice, reach, height) for _ in range(dice.randrange(1, 3))]
        made['ambient'] = '#404040'
        if dice.random() < 0.3:
            made['integrator'] = 'path'
        made['bake'] = {'quality': 'draft'}
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--orbc', default=str(ROOT / 'build/bin/orbc'))
    parser.add_argument('--first', type=int, default=1)
    parser.add_argument('--count', type=int, default=100)
    parser.add_argument('--lit', action='store_true')
    parser.add_argument('--keep', type=pathlib.Path, default=pathlib.Path('whole'))
    options = parser.parse_args()
    options.keep.mkdir(parents=True, exist_ok=True)
    told = refused = 0
    for seed in range(options.first, options.first + options.count):
        file = options.keep / f'{seed}.yaml'
        file.write_text(json.dumps(scene(seed, options.lit), indent=1))
        command = [options.orbc, 'verify', str(file), '--json', '--quiet', '--keep', str(options.keep / str(seed)), '--threshold', '0']
        command += ['--within', '4' if options.lit else '2', '--off-edge', '0.02' if options.lit else '0.0005', '--max-memory', '2GiB']
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=300)
        except subprocess.TimeoutExpired:
            told += 1
            print(seed, 'takes more than 300 s', flush=True)
            continue
        if done.returncode == 0:
            for left in options.keep.glob(f'{seed}[.-]*'):
                left.unlink()
            continue
        honest = done.returncode in (1, 2) and 'error[' in done.stderr
        refused += honest
        told += not honest
        said = next((line for line in done.stderr.splitlines() if 'error' in line), done.stderr[-200:]) if done.stderr.strip() else done.stdout[-700:]
        print(seed, 'exit', done.returncode, said, flush=True)
    print(f'{options.count} scenes, {refused} refused with a diagnostic, {told} to look at')
    return 1 if told else 0


sys.exit(main())
