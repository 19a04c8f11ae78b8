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
import shutil
import signal
import subprocess
import sys
import tempfile

try:
    import bpy
except ImportError:
    bpy = None


class Failure(Exception):
    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def size(text):
    width, height = (int(part) for part in text.lower().split('x'))
    if not (1 <= width <= 65536 and 1 <= height <= 65536):
        raise ValueError
    return width, height


def positive(text):
    if int(text) < 1:
        raise ValueError
    return int(text)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(prog='render_blender', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('scene', nargs='?', default='-', help='GLB or glTF file; - is standard input')
    parser.add_argument('-o', '--output', default='-', help='PNG to write; - is standard output, fd:N an open file descriptor')
    parser.add_argument('--samples', type=positive, default=1, help='samples a pixel (1: its centre)')
    parser.add_argument('--size', type=size, help='WIDTHxHEIGHT instead of the size in the file')
    parser.add_argument('--threads', type=positive, help='threads of Cycles (default: all)')
    parser.add_argument('--verbose', action='store_true', help='show what Blender prints')
    return parser.parse_args(arguments)


# ---- outside Blender: start it ----------------------------------------------------------------------------------------------

def start_blender(arguments):
    options = parse_arguments(arguments)
    if options.output == '-' and sys.stdout.isatty():
        raise Failure(2, 'the picture would go to the terminal; say -o PICTURE.png')
    if options.scene == '-' and sys.stdin.isatty():
        raise Failure(2, 'no scene: pipe one in or name a file (see --help)')
    passed = list(arguments)
    descriptors = ()
    if options.output == '-':
        # Blender talks on its standard output; the picture takes another way out.
        descriptors = (os.dup(sys.stdout.fileno()),)
        passed += ['-o', f'fd:{descriptors[0]}']
    elif options.output.startswith('fd:'):
        descriptors = (int(options.output[3:]),)
    command = ['blender', '-b', '--factory-startup', '-noaudio', '--python-exit-code', '3', '-P', os.path.abspath(__file__), '--', *passed]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, pass_fds=descriptors, check=False)
    except FileNotFoundError:
        raise Failure(3, 'blender is not installed (Debian: apt-get install blender python3-numpy)') from None
    said = done.stdout.decode('utf-8', 'replace')
    if options.verbose:
        sys.stderr.write(said)
    elif done.returncode:
        lines = said.splitlines()
        plain = [line for line in lines if line.startswith('render_blender:')]
        print('\n'.join(plain or lines[-40:]), file=sys.stderr)
    if done.returncode < 0:
        raise Failure(3, f'Blender was ended by signal {-done.returncode}')
    return done.returncode


# ---- inside Blender -----------------------------------------------------------------------------------------------------------

def local_file(scene, folder):
    """The path of the scene: the importer needs a real file (it cannot read /dev/stdin)."""
    if scene != '-':
        if not os.path.isfile(scene):
            raise Failure(1, f'no such file: {scene}')
        return scene
    path = os.path.join(folder, 'scene.glb')
    with open(path, 'wb') as file:
        shutil.copyfileobj(sys.stdin.buffer, file, 1 << 20)
        if file.tell() == 0:
            raise Failure(1, 'the scene on standard input is empty; did the command before the pipe fail?')
    with open(path, 'rb') as file:
        if file.read(4) == b'glTF':
            return path
    text_path = os.path.join(folder, 'scene.gltf')
    os.rename(path, text_path)
    return text_path


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


# What a PNG needs for its pixels and their colours; the rest are dates, names and notes, with which no two pictures are the same.
KEPT_CHUNKS = (b'IHDR', b'PLTE', b'tRNS', b'gAMA', b'cHRM', b'sRGB', b'iCCP', b'sBIT', b'IDAT', b'IEND')


def strip_dates(picture):
    """Leaves the pixels of a PNG file alone: same scene, same bytes."""
    kept = picture + '.kept'
    with open(picture, 'rb') as source, open(kept, 'wb') as target:
        target.write(source.read(8))
        while True:
            head = source.read(8)
            if len(head) < 8:
                break
            length, kind = int.from_bytes(head[:4], 'big'), head[4:]
            body = source.read(length + 4)
            if kind in KEPT_CHUNKS:
                target.write(head + body)
    os.replace(kept, picture)


def deliver(picture, out):
    if out.startswith('fd:'):
        with open(picture, 'rb') as file, os.fdopen(int(out[3:]), 'wb') as target:
            shutil.copyfileobj(file, target)
        return
    part = os.path.join(os.path.dirname(os.path.abspath(out)), f'.{os.path.basename(out)}.{os.getpid()}.part')
    try:
        shutil.copyfile(picture, part)
        os.replace(part, out)
    finally:
        if os.path.exists(part):
            os.unlink(part)


def draw(arguments):
    options = parse_arguments(arguments)
    if options.output == '-':
        raise Failure(2, 'inside Blender standard output is full of its messages; use -o FILE or -o fd:3 3>FILE')
    if not options.output.startswith('fd:') and not os.path.isdir(os.path.dirname(os.path.abspath(options.output))):
        raise Failure(3, f'no such folder: {os.path.dirname(options.output)}')
    with tempfile.TemporaryDirectory(prefix='render_blender.') as folder:
        camera = load(local_file(options.scene, folder), 'the scene on standard input' if options.scene == '-' else options.scene)
        set_camera(camera)
        scene = bpy.context.scene
        set_background(scene, list(camera.get('orbc_background', (0, 0, 0))))
        set_render(scene, options, options.size or (camera.get('orbc_width', 800), camera.get('orbc_height', 600)))
        scene.render.filepath = os.path.join(folder, 'picture.png')
        bpy.ops.render.render(write_still=True)
        if not os.path.exists(scene.render.filepath):
            raise Failure(3, 'Blender wrote no picture')
        strip_dates(scene.render.filepath)
        deliver(scene.render.filepath, options.output)


def main():
    if bpy is None:
        return start_blender(sys.argv[1:])
    draw(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
    return 0


if __name__ == '__main__':
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(3))
    code = 3
    try:
        code = main()
    except SystemExit as stop:  # argparse
        code = stop.code if isinstance(stop.code, int) else 2
    except Failure as failure:
        print(f'render_blender: {failure}', file=sys.stderr)
        code = failure.code
    except (OSError, MemoryError) as error:
        print(f'render_blender: {error}', file=sys.stderr)
    except KeyboardInterrupt:
        print('render_blender: interrupted', file=sys.stderr)
        code = 130
    sys.stderr.flush()
    sys.stdout.flush()
    if code or bpy is None:
        sys.exit(code)
