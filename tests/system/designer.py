#!/usr/bin/env python3
"""The designer's page: it is written with its scene, its room is the tracer's, and it can be walked in and changed."""
import pathlib
import shutil

import numpy as np

from helpers import BIN, ROOT, check, done, finish, folder, need, picture, run, skip

SCENE = '''# Five right angles: impossible in the plane
orbc: 1
orbifold: "*22222"
room:
  height: 0.9      # of the room
  floor: {checker: [ivory, slategray], cell: 0.2}
  walls: {all: {mirror: {reflectance: 0.9}, frame: {width: 0.03}}}
objects:
  - sphere: {radius: 0.1}
    name: statue
    at: {polar: [0.14, 95deg]}
    material: coral
cover: {max_bounces: 3}
'''
NASTY = SCENE.replace('statue', '</script><script>document.title=1</script>]]>').replace('name: ', "name: '").replace(']]>', "]]>'")
SIZE = (240, 180)
# Where mirrors differ or are parts of walls, the plane, the sphere, and a scene with a mesh of its own; and the share of pixels that must agree.
# On the sphere frames near the eye, and what stands near the antipode, are not cut as the compiler cuts them.
PICTURES = {'pentagon': 0.99, 'parts': 0.99, 'plane': 0.99, 'sphere': 0.96}
PARTS = SCENE.replace(
    'walls: {all: {mirror: {reflectance: 0.9}, frame: {width: 0.03}}}',
    'walls: {all: {mirror: {reflectance: 0.9}}, 2: {mirror: {reflectance: 0.6, tint: "#ffc9a8"}}, 3: {mirror: none, color: teal}, '
    '4: {mirror: {span: [0.2, 0.8], height: [0.2, 0.7], reflectance: 0.8}}}')
OWN = {'parts': PARTS, 'plane': SCENE.replace('*22222', '*2222'), 'sphere': SCENE.replace('*22222', '*222').replace('bounces: 3', 'bounces: 9')}
EXPORTS = {
    'plain': SCENE,
    'lit': SCENE.replace('coral', 'marble').replace('bounces: 3}', 'bounces: 2}\nbake: {quality: draft}\nlights:\n  - {kind: point, at: {polar: [0.1, 200deg], z: 0.7}, power: 4}'),
    'sphere': OWN['sphere'],
    'plane': OWN['plane'],
}

with folder() as name:
    where = pathlib.Path(name)
    # Without the page the command says which script makes it, and writes nothing.
    lonely = where / 'bin'
    lonely.mkdir()
    shutil.copy(BIN / 'orbc', lonely / 'orbc')
    (where / 's.yaml').write_text(SCENE)
    ended = run([lonely / 'orbc', 'compile', where / 's.yaml', '-o', where / 'none.html'])
    check(ended.returncode == 3 and b'html.no-page' in ended.stderr and b'scripts/web' in ended.stderr, 'without the page: html.no-page')
    check(not (where / 'none.html').exists(), 'and nothing is written')

    if not (BIN.parent / 'share/orbc/designer.html').exists():
        skip("the designer's page has not been built (scripts/web)")
    need('node', 'chromium')
    done(BIN / 'orbc', 'compile', where / 's.yaml', '-o', where / 's.html', '--quiet')
    done(BIN / 'orbc', 'design', '-o', where / 'empty.html', '--no-open', '--quiet')
    text = (where / 's.html').read_text()
    check(len((where / 'empty.html').read_bytes()) < 2_000_000, f"the page has {len((where / 'empty.html').read_bytes()) / 1e6:.2f} MB, less than 2")
    check("default-src 'none'" in text, 'its content security policy begins with nothing')
    (where / 'nasty.yaml').write_text(NASTY)
    done(BIN / 'orbc', 'compile', where / 'nasty.yaml', '-o', where / 'nasty.html', '--quiet')
    check((where / 'nasty.html').read_text().count('</script>') == text.count('</script>'), 'names of a scene cannot end its script')
    ended = run([BIN / 'orbc', 'compile', where / 's.yaml', '-o', where / 'set.html', '--set', 'room.height=2'])
    check(ended.returncode == 2 and not (where / 'set.html').exists(), '--set is refused: the page holds the text')

    node = ['unshare', '-n', 'node'] if run(['unshare', '-n', 'true']).returncode == 0 else ['node']
    arguments = []
    for scene in PICTURES:
        source = ROOT / f'tests/scenes/flat/{scene}.yaml'
        if scene in OWN:
            source = where / f'{scene}.yaml'
            source.write_text(OWN[scene])
        done(BIN / 'orbc', 'compile', source, '-o', where / f'{scene}.html', '--quiet')
        done(BIN / 'orbc', 'trace', source, '-o', where / f'{scene}.png', '--samples', '1', '--size', f'{SIZE[0]}x{SIZE[1]}', '--quiet')
        arguments += [where / f'{scene}.html', where / f'{scene}.rgba']
    drawn = run([*node, ROOT / 'tests/page/pictures.mjs', *SIZE, *arguments], cwd=ROOT, timeout=1500)
    check(drawn.returncode == 0 and not drawn.stdout, f'the pages are drawn without a word {drawn.stdout.decode()[:2000]} {drawn.stderr.decode()[-2000:]}')
    for scene in PICTURES:
        if not (where / f'{scene}.rgba').exists():
            continue
        page = np.frombuffer((where / f'{scene}.rgba').read_bytes(), np.uint8).reshape(SIZE[1], SIZE[0], 4)[:, :, :3].astype(int)
        share = (np.abs(page - picture(where / f'{scene}.png')).max(axis=-1) <= 4).mean()
        least = PICTURES[scene]
        check(share >= least, f'{scene}: {100 * share:.2f} % of the pixels are the tracer\'s to 4/255 (at least {100 * least} %)')

    # What the page exports is what the program does, from reading on.
    arguments = []
    for scene in EXPORTS:
        for place in ('program', 'page'):
            (where / scene / place).mkdir(parents=True)
        (where / scene / 'scene.yaml').write_text(EXPORTS[scene])
        done(BIN / 'orbc', 'compile', where / scene / 'scene.yaml', '-o', where / scene / 'scene.html', '--quiet')
        for ending in ('glb', 'pov', 'svg'):
            done(BIN / 'orbc', 'compile', where / scene / 'scene.yaml', '-o', where / scene / f'program/scene.{ending}', '--quiet')
        arguments += [where / scene / 'scene.html', where / scene / 'page/scene']
    exported = run([*node, ROOT / 'tests/page/exports.mjs', *arguments], cwd=ROOT, timeout=1500)
    check(exported.returncode == 0 and not exported.stdout, f'the pages export without a word {exported.stdout.decode()[:2000]} {exported.stderr.decode()[-2000:]}')
    for scene in EXPORTS:
        for ending in ('glb', 'pov', 'svg'):
            ended = run([BIN / 'orbc', 'diff', '--within', '1e-6', where / scene / f'program/scene.{ending}', where / scene / f'page/scene.{ending}'])
            check(ended.returncode == 0, f'{scene}: the .{ending} of the page is the program\'s {ended.stdout.decode()[:300]}')

    dropped = run([*node, ROOT / 'tests/page/drops.mjs', where / 's.html', where / 'empty.html', where], cwd=ROOT, timeout=600)
    print(dropped.stdout.decode())
    check(dropped.returncode == 0, f'files dropped on the page {dropped.stderr.decode()[-2000:]}')

    trouble = run([*node, ROOT / 'tests/page/trouble.mjs', where / 's.html', where / 'empty.html', where / 'nasty.html'], cwd=ROOT, timeout=600)
    print(trouble.stdout.decode())
    check(trouble.returncode == 0, f'the page in trouble {trouble.stderr.decode()[-2000:]}')

    by_hand = run([*node, ROOT / 'tests/page/designer.mjs', where / 's.html', where / 'empty.html'], cwd=ROOT, timeout=1500)
    print(by_hand.stdout.decode())
    check(by_hand.returncode == 0, f'the page by hand {by_hand.stderr.decode()[-2000:]}')
finish()
