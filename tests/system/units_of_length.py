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


def same(a, b):
    return a.shape == b.shape and bool(np.all(a == b))


povray = shutil.which('povray')
with folder() as where:
    where = pathlib.Path(where)
    for kind, lamp, more, units in (('direct light of a point', point, '', (1, 1000, 0.001)), ('paths of a sphere', sphere, 'integrator: path\n', (1, 1000))):
        traced, drawn, reports, texels, seconds = {}, {}, {}, {}, {}
        for s in units:
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
        for s in units[1:]:
            check(same(traced[1], traced[s]), f'{kind}: the tracer sees the same at {s}')
            if povray:
                # The file's coordinates are rounded to single precision in the author's unit, so that a ray may meet a texel an ulp beside.
                off = np.abs(drawn[1].astype(int) - drawn[s].astype(int)).max()
                check(drawn[1].shape == drawn[s].shape and off <= 1, f'{kind}: POV-Ray draws the same at {s}, within 1/255: {off}')
            for key in ('copies', 'triangles', 'vertices'):
                check(reports[1][key] == reports[s][key], f'{kind}: as many {key} at {s}: {reports[1][key]} {reports[s][key]}')
            check(texels[1] == texels[s], f'{kind}: as many texels at {s}: {texels[1]} {texels[s]}')
            ratio = seconds[s] / seconds[1]
            check(0.7 < ratio < 1.4, f'{kind}: the work is the same at {s}: {ratio:.3f} of the processor time')
finish()
