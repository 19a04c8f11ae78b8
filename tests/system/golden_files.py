#!/usr/bin/env python3
"""`orbc diff` on real files, and docs/golden-files.md: what it shows is tried, word for word."""
import json
import os
import pathlib
import re
import shutil

from PIL import Image

from helpers import BIN, ROOT, check, finish, folder, run

ORBC = BIN / 'orbc'
TEXT = (ROOT / 'docs/golden-files.md').read_text()
PATH = {**os.environ, 'PATH': f'{BIN}:{os.environ["PATH"]}'}


def orbc(*words, **options):
    return run([ORBC, *words], **options)


def block(kind, name):
    """What the page shows as a file, or as a command to run."""
    return re.search(rf'<!-- {kind}: {re.escape(name)} -->\n```\w+\n(.*?)```', TEXT, re.S).group(1)


def diff(*words):
    done = orbc('diff', *words)
    return done.returncode, (done.stdout + done.stderr).decode()


def made(where, name):
    target = where / name
    done = orbc('compile', where / 'room.yaml', '-o', target, '--report', target.with_suffix('.json'), '--quiet')
    check(done.returncode == 0, f'{name} is made')
    return target


def moved(path, old, new, count=1):
    """A copy of a text file with something else in it; what it names lies beside it."""
    text = path.read_text()
    check(old in text, f'{path.name} has {old}')
    other = path.with_name('moved' + path.suffix)
    other.write_text(text.replace(old, new, count).replace(path.stem + '-', 'moved-'))
    for beside in path.parent.glob(path.stem + '-*'):
        shutil.copy(beside, path.with_name(beside.name.replace(path.stem, 'moved', 1)))
    return other


def beside(path, kind):
    """The file beside an export that it names."""
    return path.with_name(re.search(rf'"({path.stem}{kind}-[0-9a-f]{{12}}\.\w+)"', path.read_text()).group(1))


def compares_every_form(where):
    for ending in ('pov', 'glb', 'gltf', 'svg'):
        one, other = made(where, f'one.{ending}'), made(where, f'other.{ending}')
        code, told = diff(one, other)
        check(code == 0 and 'agree' in told, f'{ending}: the same scene under two names agrees exactly {told if code else ""}')
    code, told = diff(where / 'one.json', where / 'other.json')
    check(code == 0, 'reports agree')

    pov = where / 'one.pov'
    number = re.search(r'<(-?0\.\d{4,}),', pov.read_text()).group(1)
    other = moved(pov, number, repr(float(number) + 3e-7))
    code, told = diff(pov, other, '--within', '1e-6')
    check(code == 0 and 'the largest by 3e-07 at' in told, 'a POV number within the bound agrees, and how far it is off is told')
    code, told = diff(pov, other)
    line = pov.read_text().split(number)[0].count('\n') + 1
    check(code == 1 and f'first at {line}:' in told and number in told, 'beyond the bound it differs, with line and both numbers')
    result = json.loads(orbc('diff', pov, other, '--json').stdout)
    check(result['agree'] is False and result['numbers_beyond'] == 1 and result['first']['at'].startswith(f'{line}:') and abs(result['largest'] - 3e-7) < 1e-12, '--json says the same')
    code, told = diff(pov, moved(pov, 'mesh2', 'mesh3'))
    check(code == 1 and 'mesh2 against mesh3' in told, 'structure differs: which token')

    atlas = beside(where / 'other.pov', '-atlas')
    pixels = Image.open(atlas).convert('RGB')
    shifted = pixels.copy()
    shifted.putpixel((3, 2), tuple(min(255, c + 2) if c < 254 else c - 2 for c in pixels.getpixel((3, 2))))
    shifted.save(atlas)
    code, told = diff(pov, where / 'other.pov', '--pixels', '1')
    check(code == 1 and 'pixel (3, 2)' in told and '2/255' in told, 'a pixel of the atlas is two steps off: which')
    check(diff(pov, where / 'other.pov', '--pixels', '2')[0] == 0, '--pixels 2 lets it pass')
    pixels.save(atlas)
    check(diff(pov, where / 'other.pov')[0] == 0, 'compressed otherwise, the same pixels agree')

    gltf = where / 'one.gltf'
    buffer = beside(where / 'other.gltf', '')
    data = bytearray(buffer.read_bytes())
    data[-4] ^= 1
    buffer.write_bytes(data)
    code, told = diff(gltf, where / 'other.gltf')
    check(code == 1 and 'accessor' in told, 'a bit of the .bin differs: which accessor')
    tree = json.loads(gltf.read_text())
    del tree['nodes'][0]
    (where / 'other.gltf').write_text(json.dumps(tree))
    code, told = diff(gltf, where / 'other.gltf')
    check(code == 1 and '$.nodes' in told, 'a node is missing: the JSON path')
    report = json.loads((where / 'one.json').read_text())
    report['copies'] += 1
    (where / 'other.json').write_text(json.dumps(report))
    code, told = diff(where / 'one.json', where / 'other.json', '--within', '0.5')
    check(code == 1 and '$.copies' in told, 'a count may not differ, whatever the bound')

    piped = [orbc('compile', where / 'room.yaml', '-f', 'pov', '-o', '-', '--quiet').stdout for _ in range(2)]
    for name, text in zip(('piped.pov', 'piped2.pov'), piped):
        (where / name).write_bytes(text)
    code, told = diff(where / 'piped.pov', where / 'piped2.pov')
    check(code == 0 and 'pixels: 0 of' in told, 'an atlas inlined for a pipe is compared as pixels')


def refuses(where):
    pov, glb = where / 'one.pov', where / 'one.glb'
    check(diff(pov, glb)[0] == 2 and 'different kinds' in diff(pov, glb)[1], 'two kinds of files are a usage error')
    check(diff(pov, where / 'room.yaml')[0] == 2, 'so is a file of no known kind')
    check(diff(pov)[0] == 2 and diff(pov, pov, '--within', '-1')[0] == 2, 'and a missing file or a wrong bound')
    code, told = diff(pov, where / 'nothing.pov')
    check(code == 3 and 'diff.cannot-read' in told, 'a file that is not there is 3')
    whole = glb.read_bytes()
    for name, data in {'cut.glb': whole[:len(whole) // 2], 'empty.glb': b'', 'longer.glb': whole + b'x', 'other.glb': b'glTF' + os.urandom(100)}.items():
        (where / name).write_bytes(data)
        code, told = diff(glb, where / name)
        check(code == 3 and 'diff.bad-file' in told, f'{name} is refused with the reason')
    missing = beside(where / 'moved.pov', '-atlas')
    os.remove(missing)
    code, told = diff(where / 'moved.pov', pov)
    check(code == 3 and missing.name in told, 'a picture that is missing is named')
    deep = where / 'deep.json'
    deep.write_text('[' * 1000000)
    check(diff(deep, deep)[0] == 3, 'a million brackets are refused')


def page_holds(where):
    for name in ('room.yaml', 'CMakeLists.txt', 'check-golden.sh'):
        (where / name).write_text(block('file', name))
    check(run(['sh', '-e', '-c', block('run', 'golden')], cwd=where, env=PATH).returncode == 0, 'the golden files are made as the page says')
    if shutil.which('cmake') and shutil.which('ctest'):
        configured = run(['cmake', '-S', '.', '-B', 'build'], cwd=where, env=PATH)
        check(configured.returncode == 0, f'its CMakeLists.txt configures {configured.stderr.decode()}')
        tested = run(['ctest', '--test-dir', 'build', '--no-tests=error'], cwd=where, env=PATH)
        check(tested.returncode == 0 and b'100% tests passed, 0 tests failed out of 3' in tested.stdout, 'its CTest example passes')
    check(run(['sh', 'check-golden.sh'], cwd=where, env=PATH).returncode == 0, 'its CI example passes')
    scene = where / 'room.yaml'
    scene.write_text(scene.read_text().replace('radius: 0.12', 'radius: 0.121'))
    tested = run(['sh', 'check-golden.sh'], cwd=where, env=PATH)
    check(tested.returncode == 1 and b'room.pov differ, first at' in tested.stdout, 'and fails, with the place, when the scene has changed')
    if shutil.which('ctest'):
        tested = run(['ctest', '--test-dir', 'build', '--output-on-failure'], cwd=where, env=PATH)
        check(tested.returncode != 0 and b'differ, first at' in tested.stdout, 'so does the CTest example')
    shown = re.findall(r'^orbc (diff .*?)(?: +#.*)?$', TEXT, re.M)
    check(len(shown) == 3, 'the page shows three ways to compare')
    for line in shown:
        command = line.split()
        if command[1].endswith('.glb'):
            for target in ('golden/room.glb', 'room.glb'):
                orbc('compile', 'room.yaml', '-o', target, '--quiet', cwd=where)
        elif command[1].endswith('.pov'):
            orbc('compile', 'room.yaml', '-o', 'golden/room.pov', '--report', 'golden/room.json', '--quiet', cwd=where)
            orbc('compile', 'room.yaml', '-o', 'room.pov', '--report', 'room.json', '--quiet', cwd=where)
        check(orbc(*command, cwd=where).returncode == 0, f'orbc {line}')


with folder() as name:
    where = pathlib.Path(name)
    (where / 'page').mkdir()
    (where / 'room.yaml').write_text(block('file', 'room.yaml'))
    compares_every_form(where)
    refuses(where)
    page_holds(where / 'page')

finish()
