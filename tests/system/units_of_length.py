"""The unit of length changes nothing in flat rooms: the same room in kilometres, metres and millimetres gives the same picture, the same
export, for the same work. Powers of lamps grow with the square of lengths, as irradiance is power over area."""
import json
import math
import resource

from helpers import *

ORBC = BIN / 'orbc'


def room(s, lamp, more=''):
    """A mirrored triangle with objects, a frame, a beam and a checker; all lengths times s."""
    def n(length):
        return f'{length * s:.17g}'
    return f'''orbc: 1
orbifold: "*333"
room:
  scale: {n(0.6)}
  height: {n(0.9)}
  floor: {{checker: [ivory, teal], cell: {n(0.2)}}}
  walls:
    all: {{mirror: {{reflectance: 0.8, frame: {{width: {n(0.03)}, color: coral}}}}}}
    2: {{mirror: none, color: "#a0b0c0"}}
objects:
  - {{sphere: {{radius: {n(0.11)}}}, at: {{polar: [{n(0.2)}, 100deg], z: {n(0.12)}}}, material: {{pattern: marble, second: "#303840", cell: {n(0.05)}}}}}
  - {{torus_knot: {{p: 2, q: 3, radius: {n(0.1)}, tube: {n(0.025)}}}, at: {{xy: [{n(-0.2)}, {n(0.1)}], z: {n(0.3)}}}, color: goldenrod}}
  - {{beam: {{from: {{xy: [{n(-0.1)}, {n(-0.2)}], z: {n(0.6)}}}, to: {{xy: [{n(0.2)}, {n(0.1)}], z: {n(0.7)}}}, width: {n(0.03)}}}, color: firebrick}}
lights:
  - {lamp(s)}
camera: {{at: {{polar: [{n(0.35)}, 222deg], z: {n(0.45)}}}, look_at: {{azimuth: 42deg, elevation: -10deg}}, fov: 85deg, size: [96, 72]}}
cover: {{max_bounces: 3}}
bake: {{quality: draft}}
{more}'''


def point(s):
    return f'{{kind: point, at: {{xy: [{0.05 * s:.17g}, 0], z: {0.7 * s:.17g}}}, power: {6 * s * s:.17g}}}'


def sphere(s):
    return f'{{kind: sphere, radius: {0.04 * s:.17g}, at: {{xy: [{0.05 * s:.17g}, 0], z: {0.7 * s:.17g}}}, power: {6 * s * s:.17g}}}'


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measured(words):
    before = processor_seconds()
    done = run([ORBC, *words])
    check(done.returncode == 0, f'{words[0]} is done: {done.stderr.decode()[:300]}')
    return done, processor_seconds() - before


def differs(a, b):
    """The share of pixels that differ by more than 1/255."""
    return float(np.mean(np.max(np.abs(a.astype(int) - b.astype(int)), axis=2) > 1))


def close(a, b):
    """Within one per cent: where edges have equal lengths but for rounding, the last bits choose how their triangles share texels."""
    return abs(a - b) <= 0.01 * max(a, b)


povray = shutil.which('povray')
with folder() as where:
    where = pathlib.Path(where)
    for kind, lamp, more, most in (('direct light of a point', point, '', 0.001), ('paths of a sphere', sphere, 'integrator: path\n', 0.01)):
        traced, drawn, reports, texels, seconds = {}, {}, {}, {}, {}
        for s in (1, 1000, 0.001):
            scene = where / 'scene.yaml'
            scene.write_text(room(s, lamp, more))
            _, tracing = measured(['trace', scene, '-o', where / 'x.png', '-q', '--samples', '1', '--threads', '1'])
            traced[s] = picture(where / 'x.png')
            for old in where.glob('x-*.png'):
                old.unlink()
            done, compiling = measured(['compile', scene, '-o', where / 'x.pov', '--json', '-q', '--threads', '1'])
            reports[s] = json.loads(done.stdout)
            atlas = picture(next(where.glob('x-*.png')))
            texels[s] = atlas.shape[0] * atlas.shape[1]
            seconds[s] = tracing + compiling
            if povray:
                run([SCRIPTS / 'povray-pipe', where / 'x.pov', '-o', where / 'drawn.png'])
                drawn[s] = picture(where / 'drawn.png')
        check(traced[1].mean() > 20, f'{kind}: there is light')
        for s in (1000, 0.001):
            check(differs(traced[1], traced[s]) <= most, f'{kind}: the tracer sees the same at {s}: {differs(traced[1], traced[s]):.5f} of the pixels differ')
            if povray:
                check(differs(drawn[1], drawn[s]) <= most, f'{kind}: POV-Ray draws the same at {s}: {differs(drawn[1], drawn[s]):.5f} of the pixels differ')
            check(reports[1]['copies'] == reports[s]['copies'], f'{kind}: as many copies at {s}')
            for key in ('triangles', 'vertices'):
                check(close(reports[1][key], reports[s][key]), f'{kind}: as many {key} at {s}: {reports[1][key]} {reports[s][key]}')
            check(abs(texels[1] - texels[s]) <= 0.05 * texels[1], f'{kind}: as many texels at {s}: {texels[1]} {texels[s]}')
            ratio = seconds[s] / seconds[1]
            check(0.7 < ratio < 1.4, f'{kind}: the work is the same at {s}: {ratio:.3f} of the processor time')
finish()
