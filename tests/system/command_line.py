#!/usr/bin/env python3
"""The command line as users and scripts meet it: exit codes, messages, pipes, full disks, Ctrl-C."""
import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import time
import zlib

from helpers import BIN, ROOT, check, finish, folder, picture, run

ORBC = BIN / 'orbc'
OCTANT = ROOT / 'tests/scenes/flat/octant.yaml'


def orbc(*words, **options):
    return run([ORBC, *words], **options)


def other_notes(done):
    """Notes but that of clipping: in so small a picture a lamp that is seen is more than a hundredth of it."""
    return [note for note in re.findall(r'note\[([a-z.-]+)\]', done.stderr.decode()) if note != 'render.clipped']


def text(done):
    return done.stdout.decode() + done.stderr.decode()


with folder() as name:
    where = pathlib.Path(name)

    # help, version, man page, completions
    help_text = orbc('--help').stdout.decode()
    for command in ('info', 'enumerate', 'svg', 'new', 'check', 'compile', 'render', 'trace', 'verify'):
        check(command in help_text, f'--help names {command}')
        done = orbc(command, '--help')
        check(done.returncode == 0 and 'Examples' in text(done), f'{command} --help has examples')
    check(orbc('--version').stdout.startswith(b'orbc '), '--version')
    check(orbc().returncode == 0 and b'orbc new' in orbc().stdout, 'without a command: help')
    check(b'.TH ORBC 1' in orbc('man').stdout, 'the man page comes from the same options')
    check(run(['bash', '-n', '/dev/stdin'], input=orbc('completion', 'bash').stdout).returncode == 0, 'bash completion parses')
    check(b'complete -c orbc' in orbc('completion', 'fish').stdout and b'#compdef orbc' in orbc('completion', 'zsh').stdout, 'zsh and fish completion')

    # usage errors are 2, on standard error
    for words in (['inof'], ['info'], ['compile', OCTANT], ['compile', OCTANT, '-o', where / 'x.foo'], ['compile', OCTANT, '-o', '-'], ['render', OCTANT, '-o', 'x.png', '--size', '0x5'],
                  ['compile', OCTANT, '-o', where / 'x.glb', '--max-memory', 'much'], ['info', '*237', '--shape', 'round']):
        done = orbc(*words)
        check(done.returncode == 2 and done.stderr and not done.stdout, f'usage: {" ".join(str(w) for w in words[:3])}')

    done = orbc('chek', OCTANT)
    check(done.returncode == 2 and b'did you mean `check`' in done.stderr, 'a misspelt command is called by its name, with the nearest one')

    lit = where / 'lit.yaml'
    lit.write_text('orbc: 1\norbifold: "*2222"\nlights: [{at: {polar: [0, 0deg], z: 0.8}}]\ncover: {max_bounces: 1}\n')
    done = orbc('verify', lit, '--size', '32x24', '--quality', 'draft', '--threshold', '1')
    check(done.returncode == 1 and b'--within 4' in done.stderr, 'verify tells how to compare a lit scene that differs')

    # what is known of an orbifold
    facts = json.loads(orbc('info', '*237', '--json', '--max-length', '37').stdout)
    check(facts['chi'] == '-1/84' and facts['space'] == 'hyperbolic' and facts['copies_per_length'][37] == 2818 and abs(facts['growth_rate'] - 1.17628081825991750) < 1e-15, 'info *237')
    keys = 'notation canonical space chi area group_order growth_rate copies_per_length sides angles inradius moduli'.split()
    check(all(k in facts for k in keys), 'info has all its keys')
    check(len(facts['corners']) == 3 and len(facts['copies']) == 20 and [copy['word'] for copy in facts['copies'][:4]] == [[], [1], [2], [3]], 'info tells corners and the first copies')
    check(len(json.loads(orbc('info', '*235', '--json', '--copies', '500').stdout)['copies']) == 120, 'and all of a finite group')
    last = json.loads(orbc('info', '*22∞', '--json', '--copies', '9').stdout)['copies'][-1]
    check(3 not in last['word'] and len(last['matrix']) == 3, 'words of the half strip leave its end wall alone')
    facts = json.loads(orbc('info', '*235', '--json').stdout)
    check(facts['group_order'] == 120 and facts['growth_rate'] is None, 'info *235')
    facts = json.loads(orbc('info', '*22222', '--json', '--shape', 'paper', '--cut', '1.4').stdout)
    check(abs(sorted(facts['side_lengths'])[0] - 0.7265551893071904) < 1e-12, 'info --shape paper')
    check(len(json.loads(orbc('info', '*' + '2' * 40, '--json').stdout)['sides']) == 40, 'forty corners')
    check(orbc('info', '*23').returncode == 1 and b'notation.bad-orbifold' in orbc('info', '*23').stderr, 'a bad orbifold is refused with the reason')
    check(b'^' in orbc('new', '22*').stderr, 'with a caret')
    done = orbc('info', '{7,3}', '--json')
    check(done.returncode == 0 and json.loads(done.stdout)['notation'] == '*237' and b'{7,3} is read as *237' in done.stderr, 'another notation is read, and how it was read is told')
    done = orbc('info', 'p4g')
    check(done.returncode == 0 and b'p4g is read as 4*2' in done.stderr and b'glued to side' in done.stdout, 'a group without mirrors alone is told by its name')
    facts = json.loads(orbc('info', '22*', '--json', '--max-length', '20').stdout)
    check(facts['sides'][5] == ['m0', 'mirror'] and facts['partner'] == [1, 0, 3, 2, 6, 5, 4] and facts['counts'][20] == 100 and facts['corners_2pi_over'] == [3, 2, 3, 2, 3, 4, 4],
          f'info 22* tells its polygon {facts}')
    done = orbc('info', '23')
    check(done.returncode == 1 and b'notation.bad-orbifold' in done.stderr and b'2 is not 3' in done.stderr, 'a bad orbifold of cone points is refused with the reason')
    half = json.loads(orbc('info', '*22∞', '--json').stdout)
    check(half['copies_per_length'][:4] == [1, 3, 4, 4] and half['chi'] == '0' and len(half['sides']) == 4, 'info *22∞')

    # a star that the shell has put file names in place of
    globbed = where / 'globbed'
    globbed.mkdir()
    for file in ('a22', 'b22', 'c', 'd'):
        (globbed / file).touch()
    for command in ('info *22', 'info *', 'new *22', 'svg *22'):
        done = run(['bash', '-c', f'cd {globbed} && {ORBC} {command}'])
        check(done.returncode == 2 and b'quote the notation' in done.stderr and b'a22' in done.stderr, f'orbc {command} among files: {done.stderr.decode()[:200]}')
    done = run(['bash', '-c', f'cd {globbed} && {ORBC} info a*'])
    check(done.returncode == 1 and b'quote the notation' in done.stderr, 'a star with one match')
    check(run(['bash', '-c', f"cd {globbed} && {ORBC} info '*22'"]).returncode == 0, 'quoted it is a notation')
    done = orbc('enumerate', '--corners', '3', '--max-order', '8')
    rows = [line.split() for line in done.stdout.decode().splitlines()]
    check(len(rows) == 84 and ['*236', 'euclidean', 'chi', '0'] in rows and ['*237', 'hyperbolic', 'chi', '-1/84'] in rows, 'enumerate is the paper\'s table, one orbifold a line')
    check(done.stderr == b'84 orbifolds with 3 corners of order at most 8\n' and not orbc('enumerate', '--quiet').stderr, 'enumerate says first how many there are')
    done = orbc('enumerate', '--corners', '4', '--max-order', '1000')
    check(done.returncode == 2 and b'124,750,374,750 orbifolds' in done.stderr and b'--all' in done.stderr and not done.stdout, f'enumerate counts before it lists more than a million {done.stderr}')
    done = orbc('enumerate', '--corners', '4', '--max-order', '1000', '--space', 'euclidean')
    check(done.returncode == 0 and done.stdout.split() == [b'*2222', b'euclidean', b'chi', b'0'], 'enumerate --space makes them fewer')
    check(len(json.loads(orbc('enumerate', '--corners', '4', '--max-order', '3', '--json').stdout)) > 3, 'enumerate --json')

    # new, check
    for notation in ('*', '**', '*22∞', '{4,3}', 'p6m', '*22', '*33', '*222', '*235', '*333', '*2222', '*2323', '*22222', '*237', '*244', '*236', '*22(10)', '*23456789(10)(11)', '*' + 20 * '2',
                     '*' + 150 * '2', '*22(120)', '*22(100000)', '*(100000)(100000)', '*(1000)(1000)(1000)'):
        scene = where / 'new.yaml'
        scene.write_bytes(orbc('new', notation).stdout)
        done = orbc('check', scene, '--json')
        check(done.returncode == 0 and json.loads(done.stdout)['ok'], f'new {notation} makes a scene that is all right {text(done)[:200] if done.returncode else ""}')
        if len(notation) < 12:
            done = orbc('render', scene, '-o', where / 'new.png', '--size', '40x30', '--samples', '1', '--max-bounces', '3')
            pixels = picture(where / 'new.png')
            upper, lower = pixels[:15].mean(), pixels[15:].mean()
            check(done.returncode == 0 and not other_notes(done) and pixels.std() > 20 and 50 < upper < 220 and 50 < lower < 220,
                  f'and it is well lit above and below: {upper:.0f}, {lower:.0f}, deviation {pixels.std():.0f}')
    done = orbc('check', '-', input=b'orbc: 1\norbifold: "*2222"\nrom: {}\n')
    check(done.returncode == 1 and b'<stdin>:3:1' in done.stderr and b'room' in done.stderr, 'check reads a pipe and points at the mistake')
    bad = where / 'bad.yaml'
    bad.write_text('orbc: 1\norbifold: "*2222"\nobjects:\n  - mesh: nowhere.obj\ncamera: {at: {polar: [9, 0deg]}}\n')
    done = orbc('compile', bad, '-o', where / 'bad.glb')
    check(done.returncode == 1 and b'mesh.missing-file' in done.stderr and not (where / 'bad.glb').exists(), 'a wrong scene writes nothing')
    check(orbc('compile', where / 'none.yaml', '-o', where / 'x.glb').returncode == 1, 'a missing scene')

    # lights and materials that cannot be: file, line, caret, hint, and nothing written
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

    (where / 'bomb.png').write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 20000, 20000, 8, 2, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(bytes(1000))) + chunk(b'IEND', b''))
    ball = 'objects:\n  - {sphere: {radius: 0.2}, at: {polar: [0, 0deg], z: 0.4}, material: %s}\n'
    for what, part, line, code in (
            ('a lamp without power', 'lights:\n  - {at: centre, power: 0}', 5, 'scene.out-of-range'),
            ('a lamp of negative power', 'lights:\n  - {at: centre, power: -1}', 5, 'scene.out-of-range'),
            ('a lamp of infinite power', 'lights:\n  - {at: centre, power: .inf}', 5, 'scene.not-finite'),
            ('a lamp whose power is no number', 'lights:\n  - {at: centre, power: .nan}', 5, 'scene.not-finite'),
            ('a lamp in a wall', 'lights:\n  - {at: {walls: {1: 0.05, 2: 0.5}}, radius: 0.1}', 5, 'light.lamp-in-wall'),
            ('a lamp through the ceiling', 'lights:\n  - {at: {polar: [0, 0deg], z: 0.95}, radius: 0.1}', 5, 'light.lamp-in-wall'),
            ('a lamp outside of the room', 'lights:\n  - {at: {polar: [5, 0deg]}}', 5, 'place.outside-room'),
            ('a lamp inside of an object', ball % 'coral' + 'lights:\n  - {at: {polar: [0, 0deg], z: 0.6}}', 7, 'light.lamp-inside-object'),
            ('a roughness above 1', ball % '{kind: metal, roughness: 1.5}', 5, 'scene.out-of-range'),
            ('an index below 1', ball % '{kind: glass, index: 0.5}', 5, 'scene.out-of-range'),
            ('a cell of 0', ball % '{preset: marble, cell: 0}', 5, 'scene.out-of-range'),
            ('a texture of 20,000 pixels a side', ball % '{texture: bomb.png}', 5, 'mesh.image-too-big')):
        bad.write_text(f'orbc: 1\norbifold: "*2222"\nroom: {{height: 1}}\n{part}\ncamera: {{at: {{polar: [0.7, 225deg]}}}}\n')
        for command in (['compile', bad, '-o', where / 'bad.pov'], ['trace', bad, '-o', where / 'bad.png'], ['check', bad]):
            done = orbc(*command)
            told = done.stderr.decode()
            check(done.returncode == 1 and f'bad.yaml:{line}:' in told and code in told and '^' in told and not list(where.glob('bad.p*')) and not list(where.glob('bad-*')),
                  f'{command[0]} refuses {what}: {told.splitlines()[0] if told else ""}')

    bad.write_text('orbc: 1\norbifold: "*2222"\nlights:\n  - {at: {polar: [0, 0deg], z: 0.8}}\n')
    done = orbc('compile', bad, '-o', where / 'bad.pov', '--max-bounces', '0', '--max-atlas', '64')
    check(done.returncode == 1 and b'bad.yaml:1:1' in done.stderr and b'light.atlas-too-large' in done.stderr and b'hint' in done.stderr and not list(where.glob('bad*.p*')),
          'baked light beyond --max-atlas is refused, and nothing written')

    # warnings are told by every command that opens a scene
    bad.write_text('orbc: 1\norbifold: "*2222"\nlights:\n  - {at: centre, kind: point, radius: 0.2}\n')
    for command in (['compile', bad, '-o', where / 'warned.glb', '--max-bounces', '1'], ['trace', bad, '-o', where / 'warned.png', '--size', '8x6'], ['check', bad]):
        done = orbc(*command)
        check(done.returncode == 0 and b'warning[scene.no-effect]' in done.stderr, f'{command[0]} prints warnings')
        check(b'warning' not in orbc(*command, '--quiet').stderr, f'{command[0]} --quiet does not')

    # a scene without lights says why it is flat, once, with a line that lights it
    bad.write_text('orbc: 1\norbifold: "*2222"\n')
    for command in (['compile', bad, '-o', where / 'flat.glb', '--max-bounces', '1'], ['trace', bad, '-o', where / 'flat.png', '--size', '8x6'], ['render', bad, '-o', where / 'flat.png', '--size', '8x6']):
        done = orbc(*command)
        told = done.stderr.decode()
        check(done.returncode == 0 and told.count('note[driver.no-lights]') == 1, f'{command[0]} says why a scene without lights looks flat')
        check(b'note' not in orbc(*command, '--quiet').stderr, f'{command[0]} --quiet does not')
    bad.write_text(bad.read_text() + told[told.index('lights: ['):].splitlines()[0] + '\n')
    done = orbc('trace', bad, '-o', where / 'lit.png', '--size', '8x6')
    check(done.returncode == 0 and not other_notes(done), f'and with the line that it offers the scene is lit: {text(done)}')
    check(b'4 samples a pixel' in done.stderr and b'1 samples a pixel' in orbc('trace', bad, '-o', where / 'depth.png', '--size', '8x6', '--pass', 'depth').stderr,
          'pictures take four samples a pixel, other passes one')

    # machine errors are 3 and leave nothing behind
    check(orbc('compile', OCTANT, '-o', where / 'no/such/folder.glb').returncode == 3, 'no such folder')
    check(orbc('compile', OCTANT, '-o', '/dev/full').returncode == 2, 'no ending')
    done = orbc('compile', OCTANT, '-f', 'glb', '-o', '/dev/full')
    check(done.returncode == 3 and b'space' in done.stderr, f'a full disk is told: {done.stderr.decode()[:100]}')
    before = sorted(os.listdir(where))
    done = run(['bash', '-c', f'ulimit -f 100; exec {ORBC} compile {OCTANT} -o {where}/large.glb'])
    check(done.returncode == 3 and sorted(os.listdir(where)) == before, 'a file that grows too large leaves nothing')
    if b'__asan_init' not in ORBC.read_bytes():   # the address sanitizer's shadow memory needs terabytes of addresses
        done = run(['bash', '-c', f'ulimit -v 150000; exec {ORBC} compile {OCTANT} --max-bounces 40 --no-lod -o {where}/large.glb'])
        check(done.returncode == 3 and sorted(os.listdir(where)) == before, f'too little memory is told: {done.stderr.decode()[:100]}')
    done = orbc('compile', OCTANT, '--max-memory', '128MiB', '--max-bounces', '40', '--no-lod', '-o', where / 'x.glb')
    check(done.returncode == 1 and b'max_bounces' in done.stderr, f'the planner refuses, and names what fits: {done.stderr.decode()[:200]}')
    done = run(['bash', '-c', f'{ORBC} compile {OCTANT} -f pov -o - | head -c 10 >/dev/null; exit ${{PIPESTATUS[0]}}'])
    check(done.returncode == 3, 'a closed pipe is an error')

    # quiet, pipes, progress
    done = orbc('compile', OCTANT, '-o', where / 'x.glb', '--quiet')
    check(done.returncode == 0 and not done.stdout and not done.stderr, '--quiet says nothing')
    done = orbc('compile', OCTANT, '-o', where / 'x.glb')
    check(b'\r' not in done.stderr and b'17 copies' in done.stderr, 'no progress bar in a pipe')
    report = json.loads(orbc('compile', OCTANT, '-o', where / 'x.glb', '--quiet', '--report', '-').stdout)
    check(report['copies'] == 17 and report['triangles'] > 1000 and report['error_bound_px'] <= report['tolerance_px'] == 0.5, 'the report: half a pixel is promised, for bent edges and levels of detail together')
    check(json.loads(orbc('compile', OCTANT, '--plan').stdout)['copies'] == 17, 'the plan')

    # the tracer's quality: more paths of passed-on light, less noise
    def noise(quality):
        done = orbc('trace', ROOT / 'examples/colours/scene.yaml', '-o', where / 'noisy.png', '--size', '40x30', '--samples', '4', '--quality', quality)
        return float(re.search(r'noise ([0-9.]+)/255', done.stderr.decode()).group(1))
    check(noise('fine') < 0.6 * noise('draft'), 'trace --quality draft is noisier than fine')

    # Ctrl-C leaves no half file
    before = sorted(os.listdir(where))
    process = subprocess.Popen([ORBC, 'trace', OCTANT, '-o', where / 'long.png', '--samples', '400'], stderr=subprocess.PIPE)
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    process.wait(timeout=20)
    check(process.returncode == 130 and sorted(os.listdir(where)) == before, 'Ctrl-C stops and leaves nothing')
finish()
