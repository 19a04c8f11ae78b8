#!/usr/bin/env python3
"""Names of outputs: links, devices, pipes, folders, what is read, long and strange names. What cannot be written is told before the work."""
import json
import os
import pathlib
import re
import resource
import shutil
import stat
import subprocess
import threading

from helpers import BIN, ROOT, SCRIPTS, check, finish, folder, need, picture, run

need('povray', 'blender')
ORBC = BIN / 'orbc'
SCENE = '''orbc: 1
orbifold: "*2222"
room: {floor: {texture: floor.png}}
objects:
  - {mesh: ball.obj, size: 0.3, at: {polar: [0.2, 80deg]}}
  - {mesh: tri.gltf, size: 0.2, at: {polar: [0.3, 200deg]}, material: {color: coral}}
camera: {at: {polar: [0.3, 225deg]}, look_at: centre, size: [32, 24]}
cover: {max_bounces: 1}
'''
GLTF = {'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}}]}], 'buffers': [{'uri': 'tri.bin', 'byteLength': 36}],
        'bufferViews': [{'buffer': 0, 'byteLength': 36}],
        'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'min': [0, 0, 0], 'max': [1, 1, 0]}]}


def prepare(where):
    from PIL import Image
    Image.new('RGB', (2, 2), (200, 120, 40)).save(where / 'floor.png')
    Image.new('RGB', (2, 2), (90, 120, 140)).save(where / 'skin.png')
    (where / 'ball.mtl').write_text('newmtl m\nmap_Kd skin.png\n')
    (where / 'ball.obj').write_text('mtllib ball.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 3/1 1/2 4/3\n')
    import struct
    (where / 'tri.bin').write_bytes(struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0))
    (where / 'tri.gltf').write_text(json.dumps(GLTF))
    (where / 'scene.yaml').write_text(SCENE)


def orbc(*words, **options):
    return run([ORBC, *words], **options)


def told(done):
    return f'exit code {done.returncode} {done.stderr.decode(errors="replace")[-300:]}'


def mode_of(path):
    return stat.S_IMODE(os.stat(path).st_mode)


def links_and_modes(where):
    scene, target = where / 'scene.yaml', where / 'elsewhere' / 'real.glb'
    target.parent.mkdir()
    target.write_text('old')
    target.chmod(0o600)
    (where / 'link.glb').symlink_to('elsewhere/link2.glb')
    (where / 'elsewhere/link2.glb').symlink_to(target)
    done = orbc('compile', scene, '-o', where / 'link.glb', '-q')
    check(done.returncode == 0 and (where / 'link.glb').is_symlink() and target.read_bytes()[:4] == b'glTF', f'through a chain of links the file at its end is written {told(done)}')
    check(mode_of(target) == 0o600, 'which keeps its mode')
    (where / 'dangling.svg').symlink_to('elsewhere/new.svg')
    done = orbc('compile', scene, '-o', where / 'dangling.svg', '-q')
    check(done.returncode == 0 and (where / 'elsewhere/new.svg').is_file() and not (where / 'elsewhere/new.svg').is_symlink(), f'a link to nothing makes what it names {told(done)}')
    mask = os.umask(0o027)
    done = orbc('svg', '*237', '-o', where / 'fresh.svg', '-q')
    os.umask(mask)
    check(mode_of(where / 'fresh.svg') == 0o640, 'a new file has the mode that the umask leaves')
    (where / 'loop.glb').symlink_to('loop.glb')
    done = orbc('compile', scene, '-o', where / 'loop.glb')
    check(done.returncode == 3 and b'loop.glb' in done.stderr, f'a link to itself is told {told(done)}')
    (where / 'picture.png').write_text('old')
    (where / 'picture.png').chmod(0o604)
    (where / 'picture-link.png').symlink_to('picture.png')
    for command in (['render', scene, '--engine', 'povray', '--samples', '1', '-q'], ['trace', scene, '-q']):
        done = orbc(*command, '-o', where / 'picture-link.png')
        check(done.returncode == 0 and (where / 'picture-link.png').is_symlink() and mode_of(where / 'picture.png') == 0o604, f'{command[0]} does the same {told(done)}')
    for script, form in ((SCRIPTS / 'povray-pipe', 'pov'), (SCRIPTS / 'render_blender.py', 'glb')):
        orbc('compile', scene, '-o', where / f'drawn.{form}', '-q')
        done = run([script, where / f'drawn.{form}', '-o', where / 'picture-link.png'])
        check(done.returncode == 0 and (where / 'picture-link.png').is_symlink() and mode_of(where / 'picture.png') == 0o604, f'so does {script.name} {told(done)}')
        done = run([script, where / f'drawn.{form}', '-o', where / f'drawn.{form}'])
        check(done.returncode == 2 and b'replace' in done.stderr, f'{script.name} does not write over the scene {told(done)}')


def inputs_are_kept(where):
    before = {path.name: path.read_bytes() for path in where.iterdir() if path.is_file()}
    os.link(where / 'scene.yaml', where / 'hard.svg')
    (where / 'soft.svg').symlink_to('scene.yaml')
    for read in ('scene.yaml', 'ball.obj', 'ball.mtl', 'skin.png', 'floor.png', 'tri.gltf', 'tri.bin'):
        done = orbc('compile', where / 'scene.yaml', '-f', 'svg', '-o', where / '.' / '..' / where.name / read)
        check(done.returncode == 2 and read.encode() in done.stderr and b'read' in done.stderr, f'{read} is read and not written over {told(done)}')
    for other in ('hard.svg', 'soft.svg'):
        done = orbc('compile', where / 'scene.yaml', '-o', where / other)
        check(done.returncode == 2 and b'scene.yaml' in done.stderr, f'nor by another name, {other} {told(done)}')
    for words in (['compile', where / 'scene.yaml', '-o', where / 'x.glb', '--report', where / 'tri.gltf'], ['trace', where / 'scene.yaml', '-o', where / 'floor.png'],
                  ['render', where / 'scene.yaml', '--engine', 'povray', '-o', where / 'skin.png'], ['verify', where / 'scene.yaml', '--difference', where / 'floor.png']):
        done = orbc(*words)
        check(done.returncode == 2 and b'which is read' in done.stderr or b'is read:' in done.stderr, f'nor by {words[0]} {told(done)}')
    with open(where / 'scene.yaml', 'rb') as file:
        done = orbc('compile', '-', '-f', 'svg', '-o', where / 'scene.yaml', stdin=file, cwd=where)
    check(done.returncode == 2, f'nor when it comes through standard input {told(done)}')
    (where / 'motif.svg').write_text('<svg><path d="M0 0 L1 0 L0 1 Z"/></svg>')
    done = orbc('svg', '*237', '--motif', where / 'motif.svg', '-o', where / 'motif.svg')
    check(done.returncode == 2 and b'read' in done.stderr, f'nor is a motif {told(done)}')
    done = orbc('compile', where / 'scene.yaml', '-o', where / 'twice.glb', '--report', where / '.' / 'twice.glb')
    check(done.returncode == 2 and b'two outputs' in done.stderr and not (where / 'twice.glb').exists(), f'two outputs of one name are refused {told(done)}')
    check(all((where / name).read_bytes() == data for name, data in before.items()), 'everything that is read is as it was')


def devices_and_pipes(where):
    scene = where / 'scene.yaml'
    devices = set(os.listdir('/dev'))
    for form in ('pov', 'glb', 'svg'):
        check(orbc('compile', scene, '-f', form, '-o', '/dev/null', '-q').returncode == 0, f'{form} to /dev/null')
    done = orbc('compile', scene, '-f', 'gltf', '-o', '/dev/null')
    check(done.returncode == 2 and b'glb' in done.stderr, f'a format of several files goes to no device {told(done)}')
    check(set(os.listdir('/dev')) == devices, 'nothing appears beside a device')
    piped = orbc('compile', scene, '-f', 'pov', '-o', '-', '-q').stdout
    for output in ('/dev/stdout', '/proc/self/fd/1'):
        check(orbc('compile', scene, '-f', 'pov', '-o', output, '-q').stdout == piped, f'{output} is what - is')
    with open(where / 'log', 'wb') as log:
        log.write(b'before\n')
        log.flush()
        run(['true'])
        subprocess.run([ORBC, 'compile', scene, '-f', 'svg', '-o', '/dev/stdout', '-q'], stdout=log, check=True)
    text = (where / 'log').read_bytes()
    check(text.startswith(b'before\n<') or text.startswith(b'before\n'), 'a file that standard output goes to keeps what it has')
    os.mkfifo(where / 'fifo.pov')
    got = []
    reader = threading.Thread(target=lambda: got.append((where / 'fifo.pov').read_bytes()))
    reader.start()
    done = orbc('compile', scene, '-o', where / 'fifo.pov', '-q')
    reader.join(timeout=20)
    check(done.returncode == 0 and got[0].count(b'/* orbc-file ') == 1 and stat.S_ISFIFO(os.stat(where / 'fifo.pov').st_mode), f'through a named pipe an export is a single file {told(done)}')
    (where / 'folder.d').mkdir()
    for form in ('pov', 'gltf', 'glb', 'svg'):
        done = orbc('compile', scene, '-f', form, '-o', where / 'folder.d')
        check(done.returncode == 3 and b'folder.d' in done.stderr, f'{form}: a folder is no output {told(done)}')
    check(not list(where.glob('folder.d?*')) and not os.listdir(where / 'folder.d'), 'nothing is written beside or into it')


def side_files(where):
    at = where / 'sides'
    at.mkdir()

    def made(*words):
        done = orbc('compile', where / 'scene.yaml', '-q', *words)
        check(done.returncode == 0, f'compile {" ".join(map(str, words))} {told(done)}')
        return sorted(os.listdir(at))

    def is_whole(main):
        named = re.findall(r'"([^"]*-[0-9a-f]{12}\.\w+)"', (at / main).read_text())
        return bool(named) and all((at / name).is_file() for name in named)

    first = made('-o', at / 'room.pov')
    again = made('-o', at / 'room.pov')
    check(first == again and len(first) == 2 and is_whole('room.pov'), f'the same export has the same names {first}')
    other = made('-o', at / 'room.pov', '--atlas', '16')
    check(len(other) == 2 and other != first and is_whole('room.pov'), f'another has others, and the old file beside it is gone {other}')
    made('-o', at / 'room.gltf')
    both = made('-o', at / 'room.gltf', '--set', 'room.floor.texture=skin.png')
    check(len(both) == 5 and is_whole('room.pov') and is_whole('room.gltf'), f'formats with one stem leave each other alone {both}')
    strange = at / 'room-atlas-0123456789ab.png'
    strange.write_text('somebody else\'s')
    shutil.copy(where / 'floor.png', at / 'room-mask.png')
    made('-o', at / 'room.pov', '--atlas', '8')
    check(strange.exists() and (at / 'room-mask.png').exists() and is_whole('room.pov'), 'files of others stay, whatever they are called')
    strange.unlink()
    atlas = next(at.glob('room-atlas-*.png'))
    own = re.search(r'"(room-atlas-[0-9a-f]{12}\.png)"', (at / 'room.pov').read_text()).group(1)
    scene = at / 'uses.yaml'
    scene.write_text('orbc: 1\norbifold: "*2222"\nroom: {floor: {texture: %s}}\ncamera: {at: {polar: [0.3, 225deg]}, look_at: centre, size: [32, 24]}\ncover: {max_bounces: 0}\n' % own)
    done = orbc('compile', scene, '-o', at / 'room.pov', '-q')
    check(done.returncode == 0 and (at / own).is_file() and is_whole('room.pov') and atlas.exists(), f'a file beside an old export that the scene reads stays {told(done)}')
    long = at / ('n' * 251 + '.pov')
    made('-o', long)
    check(is_whole(long.name), 'a name of 255 bytes has files beside it')
    done = run([SCRIPTS / 'povray-pipe', long, '-o', at / ('p' * 251 + '.png')])
    check(done.returncode == 0 and (picture(at / ('p' * 251 + '.png')) > 0).any(), f'and is drawn into one of 255 {told(done)}')
    for form in ('glb', 'gltf', 'svg'):
        made('-o', at / ('n' * (254 - len(form)) + f'.{form}'))
    for name in ('n' * 252 + '.pov', 'n' * 252 + '.glb'):
        done = orbc('compile', where / 'scene.yaml', '-o', at / name)
        check(done.returncode == 3 and b'too long' in done.stderr.lower(), f'one of 256 bytes is refused {told(done)[-150:]}')


def strange_folders(where):
    """Nothing of a name is taken for an option, and every engine works in every folder."""
    plain = None
    names = ['q" +GAx +H20 +L"z', "it's", 'back\\slash', 'ä\u2028ü', 'blank  and\ttab', '-o', b'\xff\xfe'.decode('utf-8', 'surrogateescape'), '$(touch x)`touch y`;&|<>*?', '%s%n{}']
    for name in names:
        at = where / 'strange' / name
        (at / 'tmp').mkdir(parents=True)
        for file in ('ball.obj', 'ball.mtl', 'skin.png', 'floor.png', 'tri.gltf', 'tri.bin', 'scene.yaml'):
            shutil.copy(where / file, at / file)
        env = {**os.environ, 'TMPDIR': str(at / 'tmp')}
        shown = name.encode('ascii', 'backslashreplace').decode()
        uses = [('povray', ['render', 'scene.yaml', '--engine', 'povray', '--samples', '1', '-q', '-o', 'p.png'])]
        if name in ('q" +GAx +H20 +L"z', 'back\\slash') or not name.isascii():
            uses.append(('blender', ['render', 'scene.yaml', '--engine', 'blender', '--samples', '1', '-q', '-o', 'b.png']))
        for engine, words in uses:
            done = orbc(*words, cwd=at, env=env)
            ok = done.returncode == 0 and not done.stderr
            check(ok and picture(at / words[-1]).shape == (24, 32, 3), f'{engine} draws in a folder called {shown} {told(done) if not ok else ""}')
        done = orbc('compile', 'scene.yaml', '-f', 'pov', '-o', '-', '-q', cwd=at, env=env)
        drawn = run([SCRIPTS / 'povray-pipe', '-o', 's.png'], input=done.stdout, cwd=at, env=env)
        check(drawn.returncode == 0, f'povray-pipe draws what is piped in {shown} {told(drawn) if drawn.returncode else ""}')
        orbc('compile', 'scene.yaml', '-o', 's.pov', '-q', cwd=at, env=env)
        drawn = run(['bash', '-c', '"$0" -o t.png < s.pov', SCRIPTS / 'povray-pipe'], cwd=at, env=env)
        check(drawn.returncode == 0, f'and finds the atlas beside the caller {told(drawn) if drawn.returncode else ""}')
        pictures = [picture(at / made) for made in ('p.png', 's.png', 't.png')]
        plain = pictures[0] if plain is None else plain
        check(all((shown_picture == plain).all() for shown_picture in pictures), 'all see the same')
        check(os.listdir(at / 'tmp') == [] and not (at / 'x').exists() and not (at / 'y').exists(), 'no temporary file is left, and no command has run')
    at = where / 'strange' / 'back\\slash'
    done = run([SCRIPTS / 'render_blender.py', 'a\\b.gltf', '-o', 'x.png'], cwd=at)
    check(done.returncode == 1 and b'no such file' in done.stderr, 'render_blender names a file that is missing')
    orbc('compile', 'scene.yaml', '-o', 'a\\b.gltf', '-q', cwd=at)
    done = run([SCRIPTS / 'render_blender.py', 'a\\b.gltf', '-o', 'x.png'], cwd=at)
    check(done.returncode == 1 and b'backslash' in done.stderr and not (at / 'x.png').exists(), f'and refuses a .gltf with a backslash in its name {told(done)}')


def told_before_the_work(where):
    """A scene that takes minutes: what cannot be written is told at once."""
    glass = ROOT / 'examples/glass/scene.yaml'
    none, folder_, taken = where / 'none', where / 'a.png', where / 'file'
    folder_.mkdir()
    taken.write_text('')
    heavy = [['compile', glass, '-o', none / 'x.pov'], ['compile', glass, '-f', 'gltf', '-o', folder_], ['compile', glass, '-o', taken / 'x.pov'],
             ['compile', glass, '-o', where / 'x.pov', '--report', none / 'r.json'], ['trace', glass, '--samples', '64', '-o', none / 'x.png'],
             ['render', glass, '--engine', 'povray', '-o', folder_], ['verify', glass, '--difference', none / 'd.png'], ['verify', glass, '--keep', none / 'k']]
    if os.geteuid() != 0:
        (where / 'closed').mkdir(mode=0o500)
        heavy.append(['compile', glass, '-o', where / 'closed/x.pov'])
        (where / 'guarded.pov').write_text('mine')
        (where / 'guarded.pov').chmod(0o400)
        heavy.append(['compile', glass, '-o', where / 'guarded.pov'])
    for words in heavy:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = orbc(*words, timeout=60)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        check(done.returncode == 3 and b'cannot write' in done.stderr and seconds < 2, f'{words[0]} to {words[-1].name}: {seconds:.2f} s of processor time, {told(done)[-120:]}')
    check(not (where / 'x.pov').exists(), 'and nothing was written')
    for temporary in ('', str(none)):
        env = {**os.environ, 'TMPDIR': temporary}
        done = orbc('render', where / 'scene.yaml', '--engine', 'povray', '--samples', '1', '-o', where / 'tmp.png', '-q', env=env)
        check(done.returncode == 0 if not temporary else done.returncode == 3 and temporary.encode() in done.stderr, f'TMPDIR={temporary}: {told(done)}')
        check(orbc('compile', where / 'scene.yaml', '-o', where / 'tmp.glb', '-q', env=env).returncode == 0, 'compile needs none')
    empty = {**os.environ, 'PATH': str(where)}
    done = orbc('render', glass, '--engine', 'povray', '-o', where / 'tmp.png', env=empty)
    check(done.returncode == 3 and b'not installed' in done.stderr, f'so is a renderer that is missing {told(done)}')
    done = orbc('compile', where / 'scene.yaml', '--threads', '7', '-o', where / 'tmp.glb', '-q')
    check(done.returncode == 0 and done.stderr == b'', f'more threads than cores are no reason to talk {told(done)}')
    for script in ('povray-pipe', 'render_blender.py'):
        for redirection in ('<&-', '<&- >&-', '>&- < /dev/null', '<&- >&- 2>&-', '2>&- < /dev/null', '2>/dev/full < /dev/null'):
            done = run(['bash', '-c', f'exec "$0" {redirection}', SCRIPTS / script])
            check(done.returncode in (1, 2, 3) and b'Traceback' not in done.stderr, f'{script} {redirection}: {told(done)}')
        done = run(['bash', '-c', 'exec "$0" --help >/dev/full', SCRIPTS / script])
        check(done.returncode == 3 and b'Traceback' not in done.stderr, f'{script} --help on a full disk: {told(done)}')


with folder() as name:
    base = pathlib.Path(name)
    prepare(base)
    for part in (links_and_modes, inputs_are_kept, devices_and_pipes, side_files, strange_folders, told_before_the_work):
        part(base)
finish()
