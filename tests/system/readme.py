#!/usr/bin/env python3
"""What the README shows works as it stands: its scene is all right and is drawn, and every file that it points to is there."""
import pathlib
import re

from helpers import BIN, ROOT, check, finish, folder, picture, run

text = (ROOT / 'README.md').read_text()
scenes = re.findall(r'^```yaml\n(.*?)^```', text, re.S | re.M)
check(scenes, f'{len(scenes)} scenes in the README')
with folder() as where:
    for i, scene in enumerate(scenes):
        pasted, drawn = pathlib.Path(where) / f'pasted-{i}.yaml', pathlib.Path(where) / f'pasted-{i}.png'
        pasted.write_text(scene)
        done = run([BIN / 'orbc', 'check', pasted, '--quiet', '--verbose'])
        check(done.returncode == 0 and not done.stderr, f'scene {i + 1}: pasted into a file of its own, it is all right {done.stderr.decode()}')
        done = run([BIN / 'orbc', 'render', pasted, '-o', drawn, '--size', '80x60'])
        told = done.stderr.decode()
        check(done.returncode == 0 and 'note' not in told and 'warning' not in told, f'scene {i + 1}: is drawn without a word {told[:300]}')
        if done.returncode == 0:
            pixels = picture(drawn)
            check(pixels.std() > 30 and 60 < pixels.mean() < 200, f'scene {i + 1}: neither dark nor glaring: mean {pixels.mean():.0f}, deviation {pixels.std():.0f}')
missing = [path for path in re.findall(r'\]\(([^)#:]+)\)', text) if not (ROOT / path).exists()]
check(not missing, f'links lead to files {missing}')
missing = [path for path in re.findall(r'\b(?:examples|tests|scripts)/[\w./-]*\w', text) if not (ROOT / path).exists()]
check(not missing, f'files that are named exist {missing}')
finish()
