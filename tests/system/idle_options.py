#!/usr/bin/env python3
"""Options and keys that change nothing are told, and only those: every option of every drawing command, with every engine and format.

What is told is true: with and without the option the same bytes are made. What is not told is looked at where a small scene shows it.
"""
import pathlib
import re
import shutil
import sys

from helpers import BIN, check, finish, folder, run

ORBC = BIN / 'orbc'
LIT = '''orbc: 1
orbifold: "*2222"
integrator: path
lights: [{at: {polar: [0, 0deg], z: 0.8}}]
objects: [{sphere: {radius: 0.1}, at: {polar: [0.2, 0deg]}, material: gold}]
camera: {at: {polar: [0.6, 225deg]}, look_at: centre, size: [24, 18]}
cover: {max_bounces: 1}
bake: {quality: draft, samples: 2}
'''
PLAIN = '''orbc: 1
orbifold: "*2222"
camera: {at: {polar: [0.6, 225deg]}, look_at: centre, size: [24, 18]}
cover: {max_bounces: 1}
'''
CURVED = PLAIN.replace('*2222', '*22222')
povray, blender = (shutil.which(program) is not None for program in ('povray', 'blender'))

TRACED = [('trace', 'x.png', []), ('render', 'x.png', [])]
POV = [('compile', 'x.pov', [])] + ([('render', 'x.png', ['--engine', 'povray'])] if povray else [])
GLTF = [('compile', 'x.glb', [])] + ([('render', 'x.png', ['--engine', 'blender'])] if blender else [])
SVG = [('compile', 'x.svg', [])]
EVERYWHERE = TRACED + POV + GLTF + SVG
PICTURES = TRACED + POV + GLTF

# option, an argument that is not the default, where it is told to change nothing: in a lit scene with gold, in a plain flat one.
TABLE = [
    ('--size', '40x20', SVG, SVG),
    ('--max-bounces', '2', [], []),
    ('--projection', 'panorama', SVG, SVG),
    ('--rays', 'straight', EVERYWHERE, EVERYWHERE),   # both rooms are flat
    ('--expected-background', None, SVG, SVG),
    ('--integrator', 'direct', SVG, SVG),
    ('--quality', 'normal', SVG, EVERYWHERE),
    ('--atlas', '16', TRACED + SVG, TRACED + SVG),
    ('--lights', 'native', TRACED + SVG, EVERYWHERE),
    ('--tolerance', '0.1', TRACED + SVG, TRACED + SVG),
    ('--max-triangles', '500', TRACED + SVG, TRACED + SVG),
    ('--no-lod', None, TRACED + SVG, TRACED + SVG),
    ('--no-highlights', None, TRACED + SVG, EVERYWHERE),
    ('--max-atlas', '8192', TRACED + SVG, TRACED + SVG),
    ('--pass', 'depth', POV + GLTF, POV + GLTF),
    ('--exact', None, POV + GLTF, PICTURES),
    ('--noise', '20/255', POV + GLTF, POV + GLTF),
    ('--view', 'disk', SVG, SVG),
    ('--report', 'report.json', SVG, SVG),
    ('--nodes-per-copy', None, [POV[0]] + SVG, [POV[0]] + SVG),
    ('--model', 'klein', POV + GLTF + SVG, POV + GLTF + SVG),
    ('--colour', 'length', POV + GLTF, POV + GLTF),
    ('--samples', '4', [], []),
]
SEEN_IN_PICTURES = {'--pass', '--exact', '--noise', '--atlas', '--samples'}
# Neither what is made, nor where: how the program runs, what it prints, which command it is.
ABOUT_RUNNING = {'--help', '--quiet', '--verbose', '--json', '--threads', '--max-memory', '--output', '--format', '--engine', '--plan', '--set', '--nodes-per-object'}
VERIFY_ALONE = {'--blender', '--within', '--threshold', '--off-edge', '--difference', '--keep'}


def words_of(option, argument):
    return [option] if argument is None else [option, argument]


def told(done):
    return re.findall(r'warning\[cli.no-effect\] (--[a-z-]+) changes nothing', done.stderr.decode())


def keys_told(done):
    return re.findall(r'warning\[scene.no-effect\] `([a-z_.]+)` changes nothing', done.stderr.decode())


with folder() as name:
    where = pathlib.Path(name)
    scenes = {'lit': LIT, 'plain': PLAIN, 'curved': CURVED}
    for stem, text in scenes.items():
        (where / f'{stem}.yaml').write_text(text)
    listed = {command: set(re.findall(r'(--[a-z][a-z-]*)', ' '.join(line.split('  ')[1 if line.startswith('  -') else 0] if line.startswith('  -') else '' for line in run([ORBC, command, '--help']).stdout.decode().splitlines())))
              for command in ('compile', 'render', 'trace', 'verify')}
    known = {row[0] for row in TABLE} | ABOUT_RUNNING | VERIFY_ALONE
    for command, options in listed.items():
        check(len(options) > 8 and options <= known, f'{command}: this test knows every option {" ".join(sorted(options - known))}')

    made = {}

    def make(stem, use, more=()):
        command, output, engine = use
        if (stem, output, tuple(engine), command, tuple(more)) not in made:
            done = run([ORBC, command, f'{stem}.yaml', '-o', output, *engine, *more], cwd=where)
            files = b''.join(file.read_bytes() for file in sorted(where.glob('x[.-]*')))
            for file in where.glob('x[.-]*'):
                file.unlink()
            made[stem, output, tuple(engine), command, tuple(more)] = done, files
        return made[stem, output, tuple(engine), command, tuple(more)]

    for option, argument, idle_lit, idle_plain in TABLE:
        for stem, idle in (('lit', idle_lit), ('plain', idle_plain)) if 'keys' not in sys.argv[2:] else ():
            for use in EVERYWHERE:
                command, output, engine = use
                if option not in listed[command] or engine and (stem == 'lit' or option not in SEEN_IN_PICTURES):
                    continue   # other programs are slow, and what exports hold is seen in exports
                done, files = make(stem, use, words_of(option, argument))
                shown = f'{" ".join(words_of(option, argument))} of {command} {" ".join(engine)} to {output}, {stem}'
                check(done.returncode == 0, f'{shown} is no error {done.stderr.decode()[:300] if done.returncode else ""}')
                check((told(done) == [option]) == (use in idle), f'{shown}: {"told to have no effect" if use in idle else "silent"}')
                if use in idle:
                    check(files == make(stem, use)[1], f'{shown}: it has none, the bytes are the same')

    # Where it depends on more than the format.
    done, files = make('curved', SVG[0], ['--model', 'klein'])
    check(told(done) == [] and files != make('curved', SVG[0])[1], 'models of curved spaces differ')
    for use in PICTURES[:4]:
        done, files = make('curved', use, ['--rays', 'straight'])
        check(told(done) == [] and files != make('curved', use)[1], f'straight rays differ in curved rooms: {use[0]} to {use[1]}')
    for option in ('--no-lod', '--expected-background', '--no-highlights'):
        done, files = make('curved', ('compile', 'x.glb', ['--rays', 'straight']), [option])
        check(told(done) == [option] and files == make('curved', ('compile', 'x.glb', ['--rays', 'straight']))[1], f'{option} with straight rays')
    done, files = make('plain', ('trace', 'x.exr', []), ['--pass', 'depth'])
    check(told(done) == ['--pass'] and files == make('plain', ('trace', 'x.exr', []))[1], 'an .exr holds all passes')
    for option in ('--no-lod', '--expected-background', '--no-highlights', '--tolerance=0.1'):
        done, files = make('lit', ('compile', 'x.glb', ['--view', 'disk']), [option])
        check(told(done) == [option.split('=')[0]] and files == make('lit', ('compile', 'x.glb', ['--view', 'disk']))[1], f'{option} with --view disk')
    done = run([ORBC, 'compile', 'plain.yaml', '--plan', '-o', 'never.glb', '--report', 'never.json', '--atlas', '16'], cwd=where)
    check(sorted(told(done)) == ['--atlas', '--output', '--report'] and not list(where.glob('never*')), '--plan writes nothing')
    if povray:
        done = run([ORBC, 'verify', 'plain.yaml', '--samples', '4', '--off-edge', '0.1', '--atlas', '16', '--tolerance', '0.2'], cwd=where)
        check(told(done) == ['--off-edge'], 'verify takes both roads: what belongs to one of them is silent')

    # Keys of the scene.
    def keys(text, command, *words):
        (where / 'keys.yaml').write_text(text)
        return keys_told(run([ORBC, command, 'keys.yaml', *words], cwd=where))

    small = PLAIN.replace('max_bounces: 1', 'max_bounces: 1, min_pixels: 2')
    check(keys(small, 'trace', '-o', 'x.png') == ['cover.min_pixels'], 'min_pixels: the tracer merges no copies')
    check(keys(small, 'compile', '-o', 'x.glb') == [] and keys(small, 'check') == [], 'min_pixels: exports do')
    check(keys(PLAIN + 'bake: {quality: fine, atlas: 16, mirrors: 3, lights: native}\n', 'check') == ['bake.quality', 'bake.mirrors', 'bake.lights'], 'light of a scene without light')
    check(keys(PLAIN + 'ambient: [0.1, 0.1, 0.1]\n', 'check') == ['ambient'], 'ambient light of a scene without lamps')
    direct = LIT.replace('integrator: path', 'integrator: direct')
    check(sorted(keys(direct, 'trace', '-o', 'x.png')) == ['bake.quality', 'samples'], 'quality and samples of a tracer without paths')
    for material, idle in (('{kind: glass, roughness: 0.2}', ['roughness']), ('{kind: matte, index: 1.3}', ['index']), ('{color: red, emission: 3}', ['emission']), ('{color: red, cell: 0.1}', ['cell']),
                           ('{kind: metal, roughness: 0.2}', []), ('{kind: glass, index: 1.3}', []), ('{checker: [red, blue], cell: 0.1}', []), ('{preset: marble, second: red, cell: 0.1}', [])):
        check(keys(LIT.replace('material: gold', f'material: {material}'), 'check') == idle, f'material: {material}: {" ".join(idle) or "nothing"} is idle')
    for lamp, idle in (('kind: point, visible: true', ['visible']), ('kind: point, radius: 0.1', ['radius']), ('kind: sphere, visible: false', [])):
        check(keys(LIT.replace('lights: [{', f'lights: [{{{lamp}, '), 'check') == idle, f'a lamp with {lamp}: {" ".join(idle) or "nothing"} is idle')

    # Stretched pictures, whoever says it.
    for words, stretched in ((['--projection', 'panorama'], True), (['--projection', 'panorama', '--size', '40x20'], False), (['--projection', 'cylinder'], False), (['--size', '40x20'], False)):
        done = run([ORBC, 'trace', 'plain.yaml', '-o', 'x.png', *words], cwd=where)
        check((b'scene.stretched' in done.stderr) == stretched, f'{" ".join(words)} {"stretches, which is told" if stretched else "does not stretch"}')
    (where / 'pano.yaml').write_text(PLAIN.replace('look_at', 'projection: panorama, look_at'))
    for words, stretched in (([], True), (['--size', '40x20'], False), (['--projection', 'perspective'], False)):
        done = run([ORBC, 'trace', 'pano.yaml', '-o', 'x.png', *words], cwd=where)
        check((b'scene.stretched' in done.stderr) == stretched, f'a panorama {" ".join(words)} {"stretches" if stretched else "does not stretch"}')
    (where / 'fov.yaml').write_text(PLAIN.replace('look_at', 'fov: 90deg, look_at'))
    check(keys_told(run([ORBC, 'trace', 'fov.yaml', '-o', 'x.png', '--projection', 'panorama', '--size', '40x20'], cwd=where)) == ['fov'], 'a panorama has no fov')
finish()
