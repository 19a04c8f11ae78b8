#!/usr/bin/env python3
"""Rooms whose cover goes by beams and storeys: `orbc verify` holds the export, drawn by POV-Ray, to the tracer's real mirrors; at the scene's size and as panorama.

At least 99.5 % of the pixels within 2/255, the others on edges. Arguments: folder of the programs, then (optional) names of scenes.
No pixel of the background in a closed room: see tests/unit/bend (watertight wedges) and `closed` below.
"""
import json
import sys

import numpy as np

from helpers import BIN, ROOT, check, finish, folder, need, picture, run

SCENES = ROOT / 'tests/scenes/verify'
CLOSED = ('square-one', 'square-adjacent')  # every path ends at something within the bounces


def verify(scene, *more):
    done = run([BIN / 'orbc', 'verify', '--json', scene, *more], timeout=300)
    try:
        return json.loads(done.stdout)['pictures'][0]
    except (ValueError, LookupError):
        print(done.stderr.decode())
        return None


def closed(scene):
    """Draws the scene with a background that nothing else has; none of it may be seen."""
    with folder() as where:
        text = scene.read_text().replace('background: "#20242c"', 'background: "#ff00ff"')
        copy = f'{where}/scene.yaml'
        with open(copy, 'w') as file:
            file.write(text)
        done = run([BIN / 'orbc', 'render', '--quiet', '--engine', 'povray', '--samples', '1', '--projection', 'panorama', '--size', '1200x600', copy, '-o', f'{where}/out.png'])
        if done.returncode:
            print(done.stderr.decode())
            return -1
        red, green, blue = np.moveaxis(picture(f'{where}/out.png'), 2, 0)
        return int(((green < 8) & (red > 16) & (blue > 16)).sum())  # magenta, whatever mirrors have dimmed it to


def main():
    need('povray')
    wanted = sys.argv[2:]
    for scene in sorted(SCENES.glob('*.yaml')):
        if wanted and scene.stem not in wanted:
            continue
        for view, more in (('picture', ()), ('panorama', ('--projection', 'panorama', '--size', '800x400'))):
            result = verify(scene, *more)
            what = f'{scene.stem} as {view}: the export agrees with the tracer'
            if result:
                what += f' ({100 * result["within_2"]:.3f} % within 2/255, {result["beyond_2_elsewhere"]} pixels off edges)'
            check(result is not None and result['agrees'], what)
        result = verify(scene, '--expected-background', '--size', '400x300')
        check(result is not None and result['agrees'], f'{scene.stem}: what is expected beyond the last mirrors is the same in both')
        if scene.stem in CLOSED:
            seen = closed(scene)
            check(seen == 0, f'{scene.stem}: {seen} background pixels in a closed room')
    finish()


main()
