#!/usr/bin/env python3
"""What the command line says of itself: usage errors, --set, completion, man page, schema, explained diagnostics."""
import json
import os
import pathlib
import re
import shutil

from helpers import BIN, ROOT, check, finish, folder, run

ORBC = BIN / 'orbc'


def orbc(*words, **options):
    return run([ORBC, *words], **options)


def usage_errors():
    """Every mistake of a command line is told in one voice, with the nearest word, and with exit code 2."""
    table = {
        ('inof',): 'orbc: there is no command `inof`; did you mean `info`?',
        ('--foo',): 'orbc: there is no option --foo',
        ('--quiet', 'render'): 'orbc: --quiet belongs behind a command',
        ('render',): 'orbc render: which scene?',
        ('render', 's.yaml'): 'orbc render: where to? say -o FILE',
        ('info',): 'orbc info: which orbifold?',
        ('completion',): 'orbc completion: shell is missing: bash, zsh or fish',
        ('render', 's.yaml', '-o', 's.png', '--sampels', '4'): 'orbc render: there is no option --sampels; did you mean --samples?',
        ('render', '--sampels', '4', 's.yaml', '-o', 's.png'): 'orbc render: there is no option --sampels; did you mean --samples?',
        ('render', 's.yaml', '-output', 's.png'): 'orbc render: there is no option -output; did you mean --output?',
        ('render', 's.yaml', '-o', 's.png', '-z'): 'orbc render: there is no option -z',
        ('render', 's.yaml', '-o', 's.png', '--fov', '60'): '--set camera.fov=60deg',
        ('trace', 's.yaml', '-o', 's.png', '--blender'): 'orbc trace: there is no option --blender here; orbc verify has it',
        ('render', 's.yaml', '-o', 's.png', '--quality', 'fast'): 'orbc render: --quality takes draft, normal or fine; got fast',
        ('render', 's.yaml', '-o', 's.png', '--quality', 'fin'): 'did you mean fine?',
        ('render', 's.yaml', '-o', 's.png', '--quality=fin'): 'orbc render: --quality takes draft, normal or fine; got fin',
        ('verify', 's.yaml', '--within', '3'): 'orbc verify: --within takes 1, 2, 4 or 8; got 3',
        ('completion', 'bsh'): 'orbc completion: shell takes bash, zsh or fish; got bsh; did you mean bash?',
        ('render', 's.yaml', '-o', 's.png', '--samples', '0'): 'orbc render: --samples takes a whole number from 1 to 65536; got 0',
        ('render', 's.yaml', '-o', 's.png', '--samples', 'many'): 'orbc render: --samples takes a whole number from 1 to 65536; got many',
        ('render', 's.yaml', '-o', 's.png', '--max-bounces', '1.5'): 'orbc render: --max-bounces takes a whole number from 0 to 1000; got 1.5',
        ('compile', 's.yaml', '-o', 's.glb', '--max-triangles', 'abc'): 'orbc compile: --max-triangles takes a whole number; got abc',
        ('compile', 's.yaml', '-o', 's.glb', '--tolerance', 'x'): 'orbc compile: --tolerance takes a number from 0.0001 to 10000; got x',
        ('render', 's.yaml', '-o', 's.png', '--samples'): 'but nothing stands behind it',
        ('render', 's.yaml', '-o', '--samples', '4'): 'orbc render: -o takes FILE, but nothing stands behind it',
        ('render', 's.yaml', '-o', 's.png', '--samples', '1', '--samples', '2'): 'orbc render: --samples is given twice',
        ('render', 's.yaml', '-o', 's.png', '--quiet=maybe'): 'orbc render: --quiet takes no value; got maybe',
        ('render', 's.yaml', 't.yaml', '-o', 's.png'): 'orbc render: it takes one SCENE; t.yaml is one too many',
        ('man', 'x'): 'orbc man: it takes no words behind it; got x',
        ('render', 's.yaml', '-o', 's.png', '--set', 'foo'): 'orbc render: --set takes KEY=VALUE',
        ('compile', 's.yaml'): 'orbc compile: say where to write',
        ('compile', 's.yaml', '-o', 's.foo'): 'orbc compile: cannot tell the format',
        ('explain', 'scene.no-efect'): 'orbc explain: there is no diagnostic scene.no-efect; did you mean scene.no-effect?',
    }
    for words, wanted in table.items():
        done = orbc(*words)
        told = done.stderr.decode()
        check(done.returncode == 2 and wanted in told and not done.stdout and told.count('\n') <= 2, f'usage: orbc {" ".join(words)}: {told.strip()}')


SCENE = '''orbc: 1
orbifold: "*2222"
objects: [{sphere: {radius: 0.1}, name: ball, at: {polar: [0.2, 0deg], z: 0.1}}]
camera: {at: {polar: [0.7, 225deg], z: 0.5}, fov: 80deg, size: [40, 30]}
cover: {max_bounces: 1}
'''


def said_instead(where):
    """--set reaches every command that reads a scene, from a file or a pipe."""
    scene = where / 's.yaml'
    scene.write_text(SCENE)
    wrong = ['--set', 'camera.fov=60deg', '--set', 'camera.fow=60deg']
    for command in (['check', scene], ['compile', scene, '-o', where / 's.glb'], ['render', scene, '-o', where / 's.png'],
                    ['trace', scene, '-o', where / 's.png'], ['verify', scene]):
        done = orbc(*command, *wrong)
        told = done.stderr.decode()
        check(done.returncode == 1 and '<--set 2>:1:8: error[scene.unknown-key]' in told and 'did you mean `fov`?' in told and
              '   1 | camera.fow=60deg\n     |        ^^^\n' in told and not list(where.glob('s.[gp]*')), f'{command[0]} --set points into the argument')
    done = orbc('check', '-', '--set', 'objects.bal.turn=3', input=SCENE.encode())
    check(done.returncode == 1 and b'did you mean `ball`?' in done.stderr, '--set for a scene from a pipe')
    done = orbc('check', scene, '--json', '--set', 'room.walls.9.color=red')
    check(json.loads(done.stdout)['diagnostics'][0]['file'] == '<--set 1>', '--json names the argument')

    def pixels(*words):
        done = orbc('trace', scene, '-o', where / 'p.png', '-q', *words)
        check(done.returncode == 0, f'trace {" ".join(words)} {done.stderr.decode()}')
        return (where / 'p.png').read_bytes()
    plain = pixels()
    check(pixels('--set', 'camera.fov=80deg') == plain, 'the scene\'s own value said again changes nothing')
    check(pixels('--set', 'camera.fov=50deg') != plain, 'another field of view is another picture')
    for option, key in ((['--size', '32x24'], 'camera.size=[32, 24]'), (['--max-bounces', '3'], 'cover.max_bounces=3'),
                        (['--projection', 'cylinder'], 'camera.projection=cylinder'), (['--integrator', 'path'], 'integrator=path'),
                        (['--expected-background'], 'cover.background=expected')):
        check(pixels(*option) == pixels('--set', key), f'{option[0]} is short for {key}')
    check(pixels('--max-bounces', '3', '--set', 'cover.max_bounces=1') == plain, '--set has the last word')
    for option, key in ((['--lights', 'native'], 'bake.lights=native'), (['--atlas', '16'], 'bake.atlas=16'), (['--quality', 'draft'], 'bake.quality=draft')):
        lit = ['--set', 'lights=[{at: {polar: [0, 0deg], z: 0.8}, kind: point}]']
        files = []
        for words in (option, ['--set', key]):
            out = where / 'lit'
            out.mkdir()
            done = orbc('compile', scene, '-o', out / 'l.pov', '-q', *lit, *words)
            files.append((done.returncode, {p.name: p.read_bytes() for p in out.iterdir()}))
            shutil.rmtree(out)
        check(files[0] == files[1] and files[0][0] == 0, f'{option[0]} is short for {key} in exports')
    done = orbc('trace', scene, '-o', where / 'q.png', '--size', '0x5')
    check(done.returncode == 2 and b'--size wants WIDTHxHEIGHT' in done.stderr, '--size keeps its own error')


COMPLETE = r'''
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(( $# - 1 )); COMP_LINE="$*"; COMP_POINT=${#COMP_LINE}; COMPREPLY=()
_orbc 2>/dev/null
printf '%s\n' "${COMPREPLY[@]}"
'''


# A zsh without start-up files runs in a terminal of its own, is given a line and the key that lists its completions, and is listened to
# until the word that is wanted appears, for at most ten seconds.
ASK_ZSH = '''
zmodload zsh/zpty zsh/datetime
zpty shell zsh -f -i
zpty -w shell "PS1=; fpath=($1 \\$fpath); autoload -U compinit; compinit -u -D; bindkey '^I' list-choices; LISTMAX=0; print RE''ADY"
zpty -r shell out '*READY*'
zpty -w -n shell "$2"$'\\t'
local shown= until=$(( EPOCHREALTIME + 10 ))
while (( EPOCHREALTIME < until )) && [[ $shown != *$3* ]]; do
  zpty -r -t shell piece && shown+=$piece || sleep 0.05
done
print -r -- $shown
zpty -d shell
'''


def shown_by_fish(where, line, _):
    done = run(['fish', '--no-config', '-c', 'source $argv[1]; complete -C $argv[2]', where / 'script', line])
    return done.stdout.decode()


def shown_by_zsh(where, line, wanted):
    (where / 'functions').mkdir(exist_ok=True)
    (where / 'functions' / '_orbc').write_bytes((where / 'script').read_bytes())
    return run(['zsh', '-f', '-c', ASK_ZSH, 'zsh', where / 'functions', line, wanted]).stdout.decode(errors='replace')


def completion(where):
    """Completion knows commands, options, choices, scenes, notations and diagnostics."""
    script = where / 'orbc.bash'
    script.write_bytes(orbc('completion', 'bash').stdout)
    tree = where / 'tree'
    (tree / 'sub').mkdir(parents=True)
    for name in ('a.yaml', 'b.txt', 'c d.yaml', '*235'):
        (tree / name).write_text('')

    def complete(*words):
        done = run(['bash', '-c', COMPLETE, 'bash', script, 'orbc', *words], cwd=tree)
        return done.stdout.decode().split('\n')[:-1]
    check(complete('ren') == ['render'] and 'explain' in complete(''), 'bash completes commands')
    check(complete('render', '--sam') == ['--samples'], 'bash completes options')
    check(complete('render', '--quality', '') == ['draft', 'normal', 'fine'], 'bash completes choices')
    check(complete('render', '--quality', '=', 'f') == ['fine'] and complete('render', '--quality', '=') == ['draft', 'normal', 'fine'], 'bash completes choices behind an equal sign')
    check(complete('compile', '-f', 'gl') == ['glb', 'gltf'], 'bash completes choices of short options')
    check(sorted(complete('render', '')) == ['a.yaml', 'c d.yaml', 'sub'], f'bash completes scenes and folders, not other files: {complete("render", "")}')
    check(complete('render', 'a.yaml', '-o', 'b') == ['b.txt'], 'bash completes files where a file is wanted')
    check(complete('info', '\\*22') == ['\\*222', '\\*2222', '\\*22222'] and complete('info', "'*22") == ['*222', '*2222', '*22222'], 'bash completes notations, quoted for the shell')
    check(complete('explain', 'scene.no-ef') == ['scene.no-effect'], 'bash completes diagnostics')
    check(complete('completion', '') == ['bash', 'zsh', 'fish'], 'bash completes the words of a command')
    for shell, flag in (('bash', '-n'), ('zsh', '-n'), ('fish', '--no-execute')):
        text = orbc('completion', shell).stdout
        for word in (b'draft', b'yaml', b'scene.no-effect', b'235'):
            check(word in text, f'{shell} knows {word.decode()}')
        if shutil.which(shell) is None:
            check(os.environ.get('CI') != 'true', f'{shell} is not installed, and nothing may be left out in CI')
            continue
        (where / 'script').write_bytes(text)
        check(run([shell, flag, where / 'script']).returncode == 0, f'{shell} reads its completion')
        ask = {'fish': shown_by_fish, 'zsh': shown_by_zsh}.get(shell)
        for line, wanted in (('orbc ren', 'render'), ('orbc render a.yaml --engine=', 'povray'), ('orbc completion ', 'fish')) if ask else ():
            shown = ask(where, line, wanted)
            check(wanted in shown, f'{shell} completes `{line}` by {wanted}: {shown[-300:]}')


def man_page():
    """The man page has choices, defaults, exit codes, files and examples, and groff has nothing to say of it."""
    page = orbc('man').stdout
    for section in ('NAME', 'SYNOPSIS', 'DESCRIPTION', 'COMMANDS', 'EXIT STATUS', 'FILES', 'ENVIRONMENT', 'EXAMPLES'):
        check(f'.SH {section}\n'.encode() in page, f'the man page has {section}')
    check(b'draft|normal|fine' in page and b'Default: 4GiB' in page and b'From 1 to 65536' in page, 'the man page has choices, defaults and bounds')
    for command in ('info', 'check', 'render', 'explain', 'schema', 'completion', 'man'):
        check(f'.SS orbc {command}\n'.encode() in page, f'the man page has {command}')
    check(all(byte < 0x80 for byte in page), 'the man page is ASCII: every roff reads it')
    if shutil.which('groff'):
        done = run(['groff', '-man', '-Tutf8', '-ww', '-z'], input=page)
        check(done.returncode == 0 and not done.stderr, f'groff reads the man page {done.stderr.decode()[:200]}')
    if shutil.which('mandoc'):
        done = run(['mandoc', '-Tlint', '-Wwarning'], input=page)
        check(done.returncode == 0, f'mandoc reads the man page {done.stdout.decode()[:300]}')
    for command in ('render', 'info', 'compile'):
        text = orbc(command, '--help').stdout.decode()
        check('{' not in text and '|' in text and 'default: ' in text and ' to ' in text, f'{command} --help shows choices, bounds and defaults in words')


def schema_and_explain(where):
    schema = (ROOT / 'schema/orbc-scene.schema.json').read_bytes()
    check(orbc('schema').stdout == schema, 'orbc schema prints the schema byte for byte')
    table = (ROOT / 'schema/diagnostics.md').read_text()
    codes = re.findall(r'^\| `([a-z-]+\.[a-z0-9-]+)` \|', table, re.M)
    listed = [line.split()[0] for line in orbc('explain').stdout.decode().splitlines()]
    check(codes == listed and len(codes) > 100, 'orbc explain lists every diagnostic, one a line')
    done = orbc('explain', 'scene.bad-torus')
    check(b'thicker than its ring' in done.stdout and b'cause:' in done.stdout and b'cure:' in done.stdout, 'orbc explain CODE says what causes and cures it')
    check(json.loads(orbc('explain', 'scene.bad-torus', '--json').stdout)[0]['code'] == 'scene.bad-torus', 'explain --json')
    check(all(line.startswith('notation.') for line in orbc('explain', 'notation').stdout.decode().splitlines()), 'the word before the dot lists its codes')

    # Editors find the schema: that of the installation, or beside the scene. Blanks in the path are written so that the line does not end there.
    first = orbc('new', '*2323').stdout.decode().splitlines()[0]
    match = re.fullmatch(r'# yaml-language-server: \$schema=(\S+)', first)
    check(match and pathlib.Path(match.group(1)).read_bytes() == schema, f'orbc new names a schema that is there: {first}')
    moved = where / 'other place' / 'bin'
    moved.mkdir(parents=True)
    shutil.copy(ORBC, moved / 'orbc')
    first = run([moved / 'orbc', 'new']).stdout.decode().splitlines()[0]
    check(first == '# yaml-language-server: $schema=orbc-scene.schema.json', 'without an installation the schema is looked for beside the scene')
    share = where / 'other place' / 'share' / 'orbc'
    share.mkdir(parents=True)
    shutil.copy(ROOT / 'schema/orbc-scene.schema.json', share)
    first = run([moved / 'orbc', 'new']).stdout.decode().splitlines()[0]
    check(first.startswith('# yaml-language-server: $schema=file:///') and 'other%20place/share/orbc/' in first, f'blanks in the path: {first}')
    check(run([moved / 'orbc', 'schema']).stdout == schema, 'the program brings the schema along')


with folder() as name:
    usage_errors()
    said_instead(pathlib.Path(name))
    completion(pathlib.Path(name))
    man_page()
    schema_and_explain(pathlib.Path(name))
finish()
