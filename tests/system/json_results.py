#!/usr/bin/env python3
"""--json: every command prints its result as one JSON value on standard output, and every failure as an object with diagnostics; docs/json.md lists the keys."""
import json
import pathlib
import re
import shutil

from helpers import BIN, ROOT, check, finish, folder, run

ORBC = BIN / 'orbc'
SCENE = '''orbc: 1
orbifold: "*2222"
integrator: path
lights: [{at: {polar: [0, 0deg], z: 0.8}}]
camera: {at: {polar: [0.6, 225deg]}, look_at: centre, size: [32, 24]}
cover: {max_bounces: 1}
bake: {quality: draft, samples: 4}
'''
DOCUMENTED = (ROOT / 'docs/json.md').read_text()


def documented(section):
    """The keys that docs/json.md names for a command."""
    part = re.search(rf'^## {re.escape(section)}$(.*?)(?=^## |\Z)', DOCUMENTED, re.M | re.S)
    first_cells = re.findall(r'^\|([^|]*)\|', part.group(1), re.M) if part else []
    return {key for cell in first_cells for key in re.findall(r'`([a-z0-9_]+)`', cell)}


with folder() as name:
    where = pathlib.Path(name)
    scene = where / 'scene.yaml'
    scene.write_text(SCENE)

    # command line → the section of docs/json.md that tells its keys
    RESULTS = [
        (['info', '*237'], 'info'), (['enumerate', '--corners', '3', '--max-order', '4'], None), (['new', '*2323'], 'new'), (['check', scene], 'check'), (['check', '-v', scene], 'check'),
        (['compile', scene, '--plan'], 'compile --plan'), (['compile', scene, '-o', where / 'x.svg'], 'compile to SVG'),
        *((['compile', scene, '-o', where / f'x.{form}'], 'compile') for form in ('pov', 'glb', 'gltf')),
        (['trace', scene, '-o', where / 'x.png'], 'render, trace'), (['trace', scene, '-o', where / 'x.exr'], 'render, trace'),
        (['render', scene, '-o', where / 'x.jpg'], 'render, trace'),
    ]
    if shutil.which('povray'):
        RESULTS += [(['render', scene, '-o', where / 'x.png', '--engine', 'povray'], 'render, trace'), (['verify', scene, '--threshold', '0', '--off-edge', '1'], 'verify')]
    if shutil.which('blender'):
        RESULTS += [(['render', scene, '-o', where / 'x.png', '--engine', 'blender'], 'render, trace')]

    for words, section in RESULTS:
        shown = ' '.join(str(word) for word in words)
        done = run([ORBC, *words, '--json'])
        try:
            result = json.loads(done.stdout)
        except ValueError as error:
            check(False, f'{shown} --json prints JSON: {error} {done.stdout[:100]} {done.stderr[:300]}')
            continue
        check(done.returncode == 0, f'{shown} --json prints a result')
        if section is None:
            continue
        unknown = set(result) - documented(section)
        check(isinstance(result, dict) and not unknown, f'{shown}: docs/json.md tells each of its keys {" ".join(sorted(unknown))}')
        again = run([ORBC, *words, '--json', '--threads', '1'])
        check(again.stdout == done.stdout, f'{shown}: the same result again, there is no clock in it')
        if words[0] != 'info' and '--plan' not in words:
            check('diagnostics' in result, f'{shown} says what was told')

    related = ROOT / 'tests/scenes/good/length-relations.yaml'
    told = json.loads(run([ORBC, 'check', '-v', '--json', related]).stdout)['scenes'][0]
    lengths = told['side_lengths']
    check(abs(lengths[1] - 1.5 * lengths[4]) < 1e-14 and lengths[2] == lengths[0] == 1.2, f'check -v tells the lengths that relations made {lengths}')
    check([relation['residual'] < 1e-14 for relation in told['relations']] == [True, True], 'check -v tells how exactly relations hold')
    told = json.loads(run([ORBC, 'check', '-v', '--json', ROOT / 'examples/pentagon/scene.yaml', '--set', 'objects.1.embedding=exponential']).stdout)['scenes'][0]
    check(told['objects'] and all(o['largest_scale'] > 1 and o['angle'] > 0 for o in told['objects'][:1]), 'check -v tells how embeddings distort')

    warned = where / 'warned.yaml'
    warned.write_text(SCENE.replace('polar: [0, 0deg], z: 0.8}', 'polar: [0, 0deg], z: 0.8}, cone: 30deg'))
    for words in (['trace', warned, '-o', where / 'x.png'], ['compile', warned, '-o', where / 'x.glb']):
        told = json.loads(run([ORBC, *words, '--json', '--quiet']).stdout)['diagnostics']
        check([(d['severity'], d['code'], d['line']) for d in told if d['code'] == 'scene.no-effect'] == [('warning', 'scene.no-effect', 4)], f'{words[0]} --json tells warnings, too')

    # failures: the scene's, usage, the machine's
    bad = where / 'bad.yaml'
    bad.write_text('orbc: 1\norbifold: "*2222"\nrom: {}\n')
    SCENE_COMMANDS = [['compile', '-o', where / 'y.glb'], ['compile', '--plan'], ['compile', '-o', where / 'y.svg'], ['trace', '-o', where / 'y.png'], ['render', '-o', where / 'y.png'], ['verify'], ['check']]
    FAILURES = [([command, bad, *rest], 1, 'scene.unknown-key') for command, *rest in SCENE_COMMANDS]
    FAILURES += [(['info', '*23'], 1, 'notation.bad-orbifold'), (['new', '*23'], 1, 'notation.bad-orbifold'),
                 (['trace', scene, '-o', where / 'y.tif'], 2, 'cli.usage'), (['trace', scene, '-o', '-'], 2, 'cli.usage'), (['render', scene, '-o', '-'], 2, 'cli.usage'),
                 (['compile', scene, '-o', '-', '-f', 'pov'], 2, 'cli.usage'), (['compile', scene, '-o', where / 'y.glb', '--report', '-'], 2, 'cli.usage'),
                 (['trace', scene], 2, 'cli.usage'), (['trac', scene], 2, 'cli.usage'), (['verify', scene, '--within', '3'], 2, 'cli.usage'),
                 (['trace', scene, '-o', where / 'no/such/folder.png'], 3, 'cli.machine'), (['compile', scene, '-o', where / 'no/such/folder.glb'], 3, 'cli.machine')]
    for words, code, expected in FAILURES:
        done = run([ORBC, *words, '--json'])
        shown = ' '.join(str(word) for word in words)
        try:
            found = json.loads(done.stdout)['diagnostics']
        except (ValueError, KeyError) as error:
            check(False, f'{shown} --json fails as JSON: {error!r} {done.stdout[:200]}')
            continue
        check(done.returncode == code and any(d['severity'] == 'error' and d['code'] == expected for d in found), f'{shown} --json fails with {code} and {expected}')
        check(done.stderr != b'' or words[0] == 'check', f'{shown} --json tells it on standard error as well')
    check(not list(where.glob('y.*')), 'failures leave no file')
finish()
