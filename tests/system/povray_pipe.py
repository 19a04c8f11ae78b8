"""scripts/povray-pipe: the picture through a pipe is the picture from files; every failure is loud."""
import os
import pathlib
import signal
import subprocess
import tempfile
import time

import numpy as np

from helpers import SCRIPTS, check, expected_codes, finish, folder, need, picture, run, sample

need('povray')
PIPE = SCRIPTS / 'povray-pipe'


def piped(text, *arguments, **options):
    return run([PIPE, *arguments], input=text, **options)


with folder() as where, folder() as temporary, folder() as away:
    os.environ['TMPDIR'] = temporary
    tempfile.tempdir = None
    facts = sample('codes', 'pipe', where)
    scene = pathlib.Path(where, 'codes.pov').read_bytes()
    check(sorted(os.listdir(where)) == ['codes.pov'], 'a scene for a pipe is one file')
    out = os.path.join(away, 'codes.png')
    done = piped(scene, '-o', out)
    check(done.returncode == 0 and done.stdout == b'' and done.stderr == b'', f'from stdin to a file, silently {done.stderr.decode()}')
    check(np.abs(picture(out) - expected_codes(facts)).max() < 0.5 + 1e-3, 'the atlas came through the pipe, exactly, in the size of the head')
    done = piped(scene)
    pathlib.Path(away, 'stdout.png').write_bytes(done.stdout)
    check(done.returncode == 0 and (picture(os.path.join(away, 'stdout.png')) == picture(out)).all(), 'from stdin to stdout')
    done = piped(scene, '-o', 'relative.png', cwd=away)
    check(done.returncode == 0 and os.path.exists(os.path.join(away, 'relative.png')), 'relative names are those of the caller')
    blank = os.path.join(away, 'with blanks and ü')
    os.mkdir(blank)
    done = run([PIPE, '-o', 'my picture.png'], input=scene, cwd=blank, env={**os.environ, 'TMPDIR': blank})
    check(done.returncode == 0 and os.listdir(blank) == ['my picture.png'], 'names with blanks are whole ' + done.stderr.decode())
    sample('codes', 'pov', blank)
    os.rename(os.path.join(blank, 'codes.pov'), os.path.join(blank, 'mü codes.pov'))
    done = run([PIPE, os.path.join(blank, 'mü codes.pov'), '-o', out])
    check(done.returncode == 0, 'also those of scene files ' + done.stderr.decode())
    done = piped(scene, '+W64', '+H20', '-o', out)
    check(done.returncode == 0 and picture(out).shape == (20, 64, 3), '+W and +H win over the head')
    done = piped(scene, '--antialias', '+WT1', '-o', out)
    check(done.returncode == 0, 'antialiased ' + done.stderr.decode())
    check(os.listdir(temporary) == [], 'no temporary file is left')

    empty = piped(b'')
    check(empty.returncode == 1 and b'empty' in empty.stderr, 'an empty scene is an error: ' + empty.stderr.decode().strip())
    nothing = piped(b'#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n', '-o', out + 'x')
    check(nothing.returncode == 1 and b'nothing to draw' in nothing.stderr, 'a scene without objects is an error: ' + nothing.stderr.decode().strip())
    check(not os.path.exists(out + 'x'), 'and leaves no picture')
    mirrors = piped(b'// orbc: *222, 1 copies, 0 triangles\n#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\nbackground { rgb <0,1,0> }\n', '-o', out)
    check(mirrors.returncode == 0 and (picture(out) == [0, 255, 0]).all(), 'a room of mirrors alone shows its background ' + mirrors.stderr.decode())
    wrong = piped(b'#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\nsphere { <0,0,0>, }\n', '-o', out)
    check(wrong.returncode == 1 and b"line 3: Parse Error: Expected 'numeric expression'" in wrong.stderr and wrong.stderr.count(b'\n') < 8, "a parse error shows povray's words:\n" + wrong.stderr.decode())
    cut = piped(scene[:-200], '-o', out)
    check(cut.returncode == 1 and b'cut off' in cut.stderr, 'a cut scene is an error: ' + cut.stderr.decode().strip())
    evil = piped(scene.replace(b'orbc-file codes-atlas.png', b'orbc-file ../evil.png'), '-o', out)
    check(evil.returncode == 1 and not os.path.exists(os.path.join(temporary, 'evil.png')), 'a scene cannot write elsewhere')
    check(piped(scene, '-o', os.path.join(away, 'none/x.png')).returncode == 3, 'a missing folder is 3')
    check(piped(scene, '--frobnicate').returncode == 2, 'an unknown option is 2')
    check(piped(scene, '+Ox.png').returncode == 2, '+O is 2')
    refused = piped(scene, '+WTxyz', '-o', out)
    check(refused.returncode != 0 and len(refused.stderr) < 1000, "an option that povray refuses is told: " + refused.stderr.decode())
    check(piped(scene, '-o').returncode == 2, '-o without a name is 2')
    check(run([PIPE, '--help']).returncode == 0, '--help is 0')
    check(run([PIPE, os.path.join(away, 'missing.pov'), '-o', out]).returncode == 1, 'a missing scene file is 1')
    no_povray = run(['/usr/bin/python3', PIPE, '-o', out], input=scene, env={'PATH': away, 'TMPDIR': temporary})
    check(no_povray.returncode == 3 and b'not installed' in no_povray.stderr, 'without povray: ' + no_povray.stderr.decode().strip())

    slow = subprocess.Popen([PIPE, '+W8000', '+H8000', '+A0.0', '+AM1', '+R9', '-o', out], stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    slow.stdin.write(scene)
    slow.stdin.close()
    deadline = time.monotonic() + 60   # it has begun when its temporary folder holds files
    while not any(files for _, _, files in os.walk(temporary)) and time.monotonic() < deadline:
        time.sleep(0.05)
    slow.send_signal(signal.SIGTERM)
    check(slow.wait(timeout=20) == 3, 'it ends when told to')
    check(os.listdir(temporary) == [], 'and cleans up then too')
finish()
