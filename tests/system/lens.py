"""Depth of field: what is said of it, and that the tracer's in a flat room is that of Blender's camera, which was not written here."""
import os
import pathlib

import numpy as np

from helpers import BIN, SCRIPTS, check, done, finish, folder, need, picture, run

RADIUS, FOCUS = 0.05, 1.6
# A narrow view: Blender's focus is a plane, orbc's a sphere around the eye.
SCENE = """orbc: 1
orbifold: "*2222"
room: {height: 2, scale: 2, floor: {checker: [ivory, slategray], cell: 0.25}, ceiling: {color: black}, walls: {all: {mirror: none, color: dimgray}}}
objects:
  - {sphere: {radius: 0.06}, at: {xy: [-0.9, 0.1], z: 0.4}, color: red}
  - {sphere: {radius: 0.2}, at: {xy: [-0.1, 0]}, color: lime}
  - {sphere: {radius: 0.3}, at: {xy: [1.4, -0.5]}, color: cornflowerblue}
camera: {at: {xy: [-1.7, 0], z: 0.5}, look_at: {xy: [1, 0], z: 0.4}, fov: 20deg, roll: 10deg, size: [160, 120]LENS}
"""
# scripts/render_blender.py, with a lens in its camera: aperture_fstop is the focal length over the diameter, the length in mm.
DRAW = f"""
names = {{'__name__': 'render_blender', '__file__': {str(SCRIPTS / 'render_blender.py')!r}}}
exec(compile(open({str(SCRIPTS / 'render_blender.py')!r}).read(), 'render_blender', 'exec'), names)
plain = names['set_render']
def set_render(scene, options, size):
    plain(scene, options, size)
    camera = scene.camera.data
    camera.dof.use_dof, camera.dof.focus_distance = True, {FOCUS}
    camera.dof.aperture_blades, camera.dof.aperture_fstop = 0, camera.lens * 1e-3 / (2 * {RADIUS})
names['set_render'] = set_render
names['draw']()
"""

with folder() as where:
    def path(name):
        return os.path.join(where, name)

    lens = f', lens: {{radius: {RADIUS}, focus_distance: {FOCUS}}}'
    pathlib.Path(path('lens.yaml')).write_text(SCENE.replace('LENS', lens))
    pathlib.Path(path('sharp.yaml')).write_text(SCENE.replace('LENS', ''))
    pathlib.Path(path('draw.py')).write_text(DRAW)
    few = run([BIN / 'orbc', 'trace', path('lens.yaml'), '-o', path('few.png'), '--samples', '4', '--size', '16x12'])
    check(few.returncode == 0 and b'warning[cli.few-lens-samples] 4 samples of a pixel look' in few.stderr, 'few samples of a lens are called so')
    enough = run([BIN / 'orbc', 'trace', path('lens.yaml'), '-o', path('few.png'), '--samples', '16', '--size', '16x12'])
    check(enough.returncode == 0 and b'few-lens-samples' not in enough.stderr, 'sixteen are not')
    export = run([BIN / 'orbc', 'compile', path('lens.yaml'), '-o', path('x.pov')])
    check(export.returncode == 0 and b'warning[driver.no-lens]' in export.stderr, 'an export says that it has no lens')
    around = run([BIN / 'orbc', 'trace', path('lens.yaml'), '-o', path('few.png'), '--projection', 'panorama', '--size', '16x8'])
    check(around.returncode == 0 and around.stderr.count(b'scene.no-effect') >= 2 and b'few-lens' not in around.stderr, 'a panorama has neither lens nor roll, and says so')
    need('blender', 'povray')
    compared = run([BIN / 'orbc', 'verify', path('lens.yaml'), '-v', '--size', '40x30', '--threshold', '0.9', '--off-edge', '1'])
    check(compared.returncode == 0 and b'note[cli.lens-left-out]' in compared.stderr, 'verify compares two pinholes, and says so')
    for name in ('lens', 'sharp'):
        done(BIN / 'orbc', 'trace', path(name + '.yaml'), '-o', path(name + '.png'), '--samples', '256', '-q')
    done(BIN / 'orbc', 'compile', path('sharp.yaml'), '-o', path('room.glb'), '-q')
    done('blender', '-b', '--factory-startup', '-noaudio', '--python-exit-code', '3', '-P', path('draw.py'), '--',
         path('room.glb'), '-o', path('blender.png'), '--samples', '256')
    off = {name: np.abs(picture(path('blender.png')) - picture(path(name + '.png'))).max(axis=-1) for name in ('lens', 'sharp')}
    share = {name: float((of <= 8).mean()) for name, of in off.items()}
    check(share['lens'] > 0.99, f"through a lens {100 * share['lens']:.2f} % of the pixels are Blender's to 8/255, worst {off['lens'].max()}")
    check(share['sharp'] < 0.9, f"through a pinhole {100 * share['sharp']:.2f} % are")
finish()
