#!/usr/bin/env python3
"""Every figure of the paper: its commands run, docs/paper.md shows it, and both roads agree on each of its scenes."""
import json
import pathlib
import re
import shlex

from helpers import BIN, ROOT, check, finish, folder, need, run

need('povray')
FIGURES = sorted((ROOT / 'examples/paper').glob('*/panels'))
PAGE = (ROOT / 'docs/paper.md').read_text()
check(len(FIGURES) >= 14, f'{len(FIGURES)} figures')

with folder() as name:
    where = pathlib.Path(name)
    for panels in FIGURES:
        figure = panels.parent.name
        check(f'pictures/paper/{figure}.jpg' in PAGE and f'](../examples/paper/{figure})' in PAGE, f'{figure}: docs/paper.md shows it')
        check((ROOT / f'docs/pictures/paper/{figure}.jpg').is_file(), f'{figure}: its picture is there')
        drawn = set()
        for line in panels.read_text().splitlines():
            words = shlex.split(line)
            if words[:2] == ['orbc', 'trace']:
                drawn.add((panels.parent / words[2]).resolve())
                continue
            coarse = [] if '--smallest' in words else ['--smallest', '20']
            done = run([BIN / 'orbc', *words[1:], '-o', where / 'x.svg', '--quiet', *coarse], cwd=panels.parent)
            check(words[0] == 'orbc' and done.returncode == 0, f'{figure}: {line} {done.stderr.decode()[:300]}')
        left_over = set(panels.parent.glob('*.yaml')) - drawn
        check(not left_over, f'{figure}: each of its scenes is drawn {left_over or ""}')
        for scene in sorted(path for path in drawn if path.parent == panels.parent):
            done = run([BIN / 'orbc', 'verify', scene, '--json', '--size', '80x40' if figure == 'panorama' else '64x48', '--samples', '4', '--set', 'bake.quality=normal'], timeout=600)
            verdict = json.loads(done.stdout)['pictures'][0] if done.returncode < 2 and done.stdout else {}
            check(bool(verdict) and verdict['within_4'] >= 0.93 and verdict['within_8'] >= 0.95,
                  f'{figure}/{scene.name}: both roads agree: {100 * verdict.get("within_4", 0):.2f} % within 4/255, {100 * verdict.get("within_8", 0):.2f} % within 8/255 '
                  f'{done.stderr.decode()[:300]}')
    for target in re.findall(r'\]\(\.\./(examples/[^)]*)\)', PAGE):
        check((ROOT / target).exists(), f'docs/paper.md leads to {target}')
finish()
