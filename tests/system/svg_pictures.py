"""Tilings as SVG are well-formed XML that holds what it should, and show each copy's colour where the copy is."""
import os
import shutil
import xml.etree.ElementTree as xml

import numpy as np

from helpers import check, finish, folder, picture, run, sample

SVG = '{http://www.w3.org/2000/svg}'

with folder() as where:
    for notation, form in (('*237', 'svg'), ('*22222', 'svg'), ('*235', 'svg'), ('*22', 'svg'), ('*', 'svg'), ('*333', 'svg'), ('*2222', 'svg'), ('**', 'svg'),
                           ('*23456789(10)(11)', 'svg'), ('*22222', 'klein'), ('*235', 'klein'), ('*', 'klein')):
        facts = sample(notation, form, where)
        path = os.path.join(where, 'tiling.svg')
        root = xml.parse(path).getroot()
        check(root.tag == SVG + 'svg' and root.find(SVG + 'title').text == notation and root.find(SVG + 'desc') is not None, f'{notation} as {form} is titled and described')
        if shutil.which('rsvg-convert') is None:
            continue
        done = run(['rsvg-convert', path, '-o', os.path.join(where, 'tiling.png')])
        pixels = picture(os.path.join(where, 'tiling.png'))
        wrong = [centre for centre in facts['centres']
                 if np.abs(pixels[int(centre[1]), int(centre[0])] - [int(centre[2][i:i + 2], 16) for i in (1, 3, 5)]).max() > 2]
        check(done.returncode == 0 and len(facts['centres']) > 0 and not wrong, f"{notation} as {form}: {len(facts['centres'])} copies where they should be, {len(wrong)} not {wrong[:3]}")
finish()
