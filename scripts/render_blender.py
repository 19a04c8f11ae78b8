#!/usr/bin/env python3
"""Draws a GLB or glTF file of orbc with headless Blender (Cycles), in exact colours.

As a program (starts Blender itself):
    orbc compile s.yaml -f glb -o - | scripts/render_blender.py -o s.png
    scripts/render_blender.py s.glb -o s.png [--samples 16] [--size 1600x1200] [--threads 2] [--verbose]
As a script inside Blender (the same, spelt out; `-o fd:3` writes the picture to an open file descriptor):
    orbc compile s.yaml -f glb -o - | blender -b --factory-startup -noaudio --python-exit-code 3 -P scripts/render_blender.py -- -o s.png
    blender -b --factory-startup -noaudio --python-exit-code 3 -P scripts/render_blender.py -- s.glb -o fd:3 3>s.png >/dev/null

Without a file name (or with -) the scene is read from standard input; as a program, -o - (the default) writes to standard output.
Camera, picture size and background come from the file. Perspective and panorama are drawn; a cylinder camera Blender does not have.
Exit code: 0 done, 1 the scene is wrong, 2 usage, 3 the machine (no Blender, cannot write).
"""
import argparse
import os
import re
import signal
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from drawing import Failure, check_output, check_scene, deliver, main_program, private_folder, run, print_message, strip_dates, take_scene

try:
    import bpy
except ImportError:
    bpy = None


def size(text):
    width, height = (int(part) for part in text.lower().split('x'))
    if not (1 <= width <= 65536 and 1 <= height <= 65536):
        raise ValueError
    return width, height


def positive(text):
    if int(text) < 1:
        raise ValueError
    return int(text)


class Parser(argparse.ArgumentParser):
    def print_help(self, file=None):
        print(self.format_help(), end='')   # argparse itself keeps quiet about a full disk


def parse_arguments(arguments):
    parser = Parser(prog='render_blender', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('scene', nargs='?', default='-', help='GLB or glTF file; - is standard input')
    parser.add_argument('-o', '--output', default='-', help='PNG to write; - is standard output, fd:N an open file descriptor')
    parser.add_argument('--samples', type=positive, default=1, help='samples a pixel (1: its centre)')
    parser.add_argument('--size', type=size, help='WIDTHxHEIGHT instead of the size in the file')
    parser.add_argument('--threads', type=positive, help='threads of Cycles (default: all)')
    parser.add_argument('--verbose', action='store_true', help='show what Blender prints')
    return parser.parse_args(arguments)


# ---- outside Blender: start it ----------------------------------------------------------------------------------------------

def local_file(folder):
    """The scene on standard input as a file: the importer needs a real one."""
    path = os.path.join(folder, 'scene.glb')
    take_scene(path)
    with open(path, 'rb') as file:
        if file.read(4) == b'glTF':
            return path
    text_path = os.path.join(folder, 'scene.gltf')
    os.rename(path, text_path)
    return text_path


def plain_path(scene, folder):
    """A name in `folder` that leads to the scene and, for what it names, to its folder. Blender takes a backslash for a slash."""
    folder_of_scene, name = os.path.split(os.path.abspath(scene))
    if scene.lower().endswith('.glb'):   # it names no other files
        os.symlink(os.path.join(folder_of_scene, name), os.path.join(folder, 'scene.glb'))
        return 'scene.glb'
    if '\\' in name:
        raise Failure(1, f'Blender cannot read a name with a backslash: {scene}')
    os.symlink(folder_of_scene, os.path.join(folder, 'beside'))
    return os.path.join('beside', name)


def output_of(options):
    if options.output == '-':
        return None
    return int(options.output[3:]) if re.fullmatch(r'fd:[0-9]+', options.output) else options.output


def start_blender():
    options = parse_arguments(sys.argv[1:])
    given = None if options.scene == '-' else options.scene
    out = output_of(options)
    if given is not None:
        check_scene(given)
    elif os.isatty(0):
        raise Failure(2, 'no scene: pipe one in or name a file (see --help)')
    if not isinstance(out, int):
        check_output(out, given)
    with private_folder('render_blender.') as folder:
        name = os.path.basename(local_file(folder)) if given is None else plain_path(given, folder)
        draw_outside(options, folder, name)
        deliver(os.path.join(folder, 'drawn.png'), out)
    return 0


def draw_outside(options, folder, name):
    """Has Blender draw what `name` in `folder` leads to into drawn.png. Blender sees no names but plain ones, and what it leaves behind goes
    with the folder."""
    os.symlink(os.path.realpath(__file__), os.path.join(folder, 'render_blender.py'))
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    inside = f'/proc/self/fd/{descriptor}'
    words = [f'{inside}/{name}', '-o', f'{inside}/drawn.png', '--samples', str(options.samples)]
    words += ['--size', '{}x{}'.format(*options.size)] if options.size else []
    words += ['--threads', str(options.threads)] if options.threads else []
    command = ['blender', '-b', '--factory-startup', '-noaudio', '--python-exit-code', '3', '-P', f'{inside}/render_blender.py', '--', *words]
    try:
        code, said = run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, pass_fds=(descriptor,), env={**os.environ, 'TMPDIR': inside})
    except FileNotFoundError:
        raise Failure(3, 'blender is not installed (Debian: apt-get install blender python3-numpy)') from None
    finally:
        os.close(descriptor)
    said = said.replace(f'{inside}/{name}', 'the scene on standard input' if options.scene == '-' else options.scene)
    if options.verbose:
        print_message(said)
    elif code:
        lines = said.splitlines()
        print_message('\n'.join([line for line in lines if line.startswith('render_blender:')] or lines[-40:]) + '\n')
    if code < 0:
        raise Failure(3, f'Blender was ended by signal {-code}')
    if code:
        raise SystemExit(code)


# ---- inside Blender -----------------------------------------------------------------------------------------------------------

def load(path, name):
    try:
        import numpy
    except ImportError:
        # Another Python earlier in PATH leads Blender's own away from Debian's packages.
        sys.path.append('/usr/lib/python3/dist-packages')
        try:
            import numpy
        except ImportError:
            raise Failure(3, 'numpy is not installed (Debian: apt-get install python3-numpy)') from None
    if not hasattr(numpy, 'bool'):
        numpy.bool = bool  # Blender 3.4's importer still uses the alias that numpy 1.24 dropped
    import addon_utils
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable('io_scene_gltf2')
    addon_utils.enable('cycles')
    with open(path, 'rb') as file:
        lit = b'"NORMAL"' in file.read()  # only what lamps light has normals
    try:
        result = bpy.ops.import_scene.gltf(filepath=path, import_shading='NORMALS' if lit else 'FLAT')
    except RuntimeError as error:
        raise Failure(1, f'Blender cannot import {name}: {str(error).strip()}') from None
    if result != {'FINISHED'}:
        raise Failure(1, f'Blender cannot import {name}')
    cameras = [thing for thing in bpy.context.scene.objects if thing.type == 'CAMERA']
    if not cameras:
        raise Failure(1, f'{name} has no camera')
    bpy.context.scene.camera = cameras[0]
    for light in bpy.data.lights:
        light.shadow_soft_size = light.get('orbc_radius', 0)  # the importer leaves Blender's quarter of a metre
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.use_nodes else ():
            if node.type == 'BSDF_PRINCIPLED':  # matte; the importer makes a texture of KHR_materials_specular's zero, which is none
                for link in node.inputs['Specular'].links:
                    material.node_tree.links.remove(link)
                node.inputs['Specular'].default_value = 0
    return cameras[0].data


def set_camera(camera):
    projection = camera.get('orbc_projection', 'perspective')
    camera.clip_start, camera.clip_end = 1e-4, 1e6
    if projection == 'panorama':
        camera.type = 'PANO'
        camera.cycles.panorama_type = 'EQUIRECTANGULAR'
    elif projection != 'perspective':
        raise Failure(1, f'Blender has no {projection} camera; use POV-Ray, or a perspective or panorama camera')


def set_background(scene, color):
    scene.world = bpy.data.worlds.new('background')
    scene.world.use_nodes = True
    node = scene.world.node_tree.nodes['Background']
    node.inputs['Color'].default_value = [*color, 1]
    node.inputs['Strength'].default_value = 1


def set_render(scene, options, picture_size):
    render = scene.render
    render.engine = 'CYCLES'
    render.resolution_x, render.resolution_y = picture_size
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.dither_intensity = 0
    render.film_transparent = False
    render.image_settings.file_format = 'PNG'
    render.image_settings.color_mode = 'RGB'
    render.image_settings.color_depth = '8'
    if options.threads:
        render.threads_mode = 'FIXED'
        render.threads = options.threads
    # Standard: linear in, sRGB out, nothing else; the default (Filmic) is up to 34 of 255 off.
    scene.display_settings.display_device = 'sRGB'
    scene.view_settings.view_transform = 'Standard'
    scene.view_settings.look = 'None'
    scene.view_settings.exposure, scene.view_settings.gamma = 0, 1
    cycles = scene.cycles
    cycles.device = 'CPU'
    cycles.samples = options.samples
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.pixel_filter_type = 'BOX'  # with one sample: the pixel's centre
    cycles.max_bounces = 0            # unlit meshes shine by themselves, others by lamps alone
    cycles.light_sampling_threshold = 0  # else dim lamps are asked by chance
    cycles.transparent_max_bounces = 256  # holes behind holes


def draw():
    options = parse_arguments(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
    out = output_of(options)
    if out is None:
        raise Failure(2, 'inside Blender standard output is full of its messages; use -o FILE or -o fd:3 3>FILE')
    given = None if options.scene == '-' else options.scene
    if given is not None:
        check_scene(given)
    if not isinstance(out, int):
        check_output(out, given)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(3))   # leave through `finally`, so that the temporary folder goes too
    with private_folder('render_blender.') as folder:
        camera = load(given or local_file(folder), given or 'the scene on standard input')
        set_camera(camera)
        scene = bpy.context.scene
        set_background(scene, list(camera.get('orbc_background', (0, 0, 0))))
        set_render(scene, options, options.size or (camera.get('orbc_width', 800), camera.get('orbc_height', 600)))
        scene.render.filepath = os.path.join(folder, 'picture.png')
        bpy.ops.render.render(write_still=True)
        if not os.path.exists(scene.render.filepath):
            raise Failure(3, 'Blender wrote no picture')
        strip_dates(scene.render.filepath)
        deliver(scene.render.filepath, out)
    return 0


if __name__ == '__main__':
    main_program('render_blender', start_blender if bpy is None else draw)
