"""orbc svg draws tilings without a scene: valid XML, every copy in its color where the isometries of `orbc info` take the room, print sizes, motifs."""
import json
import pathlib
import shutil
import xml.etree.ElementTree as xml

import numpy as np

from helpers import BIN, check, finish, folder, picture, run

ORBC = BIN / 'orbc'
SVG = '{http://www.w3.org/2000/svg}'


def image_of(copy, z):
    a, b, c, d = (complex(*copy['moebius'][k]) for k in 'abcd')
    z = z.conjugate() if copy['reversing'] else z
    return (a * z + b) / (c * z + d) if c * z + d else complex(np.inf)   # the antipode of the centre has no place in the chart


def on_page(space, model, z, size):
    """Where a point of the disk chart lies on a page without labels."""
    margin = 16 * size / 1000
    if model == 'half-plane':
        return None
    if model == 'klein':
        z = 2 * z / (1 + abs(z) ** 2) if space == 'hyperbolic' else 2 * z / (1 - abs(z) ** 2)
    frame = 1 if space == 'hyperbolic' else 2 if model == 'klein' else 1.8
    scale = (size / 2 - margin) / frame
    return size / 2 + scale * z.real, size / 2 - scale * z.imag


with folder() as name:
    where = pathlib.Path(name)
    target = where / 'tiling.svg'

    def svg(*words, code=0):
        target.unlink(missing_ok=True)
        done = run([ORBC, 'svg', *words, '-o', target])
        check(done.returncode == code and target.exists() == (code == 0), f'orbc svg {" ".join(map(str, words))}: {done.stderr.decode()[:300]}')
        if code == 0 and shutil.which('xmllint'):
            valid = run(['xmllint', '--noout', target])
            check(valid.returncode == 0, f'xmllint {words[0]}: {valid.stderr.decode()[:200]}')
        return done

    def pixels():
        drawn = run(['rsvg-convert', target, '-o', where / 'tiling.png'])
        check(drawn.returncode == 0, 'rsvg-convert draws it')
        return picture(where / 'tiling.png').astype(int)

    # copies where the isometries take the centre of the room, in both colors
    for notation in ('*237', '*22222', '*2323', '*23456789(10)(11)', '*235', '*222', '*'):
        facts = json.loads(run([ORBC, 'info', notation, '--json', '--copies', '60']).stdout)
        for model in ('disk', 'klein'):
            svg(notation, '--model', model, '--no-labels', '--colors', 'red,blue', '--lines', '0', '--size', '500')
            if not shutil.which('rsvg-convert'):
                continue
            shown, wrong, image = 0, 0, pixels()
            for copy in facts['copies']:
                z = image_of(copy, 0)
                if not np.isfinite(z) or (facts['space'] == 'spherical' and model == 'klein' and abs(z) > 0.6):
                    continue
                x, y = on_page(facts['space'], model, z, 500)
                if abs(complex(x - 250, y - 250)) > 215:
                    continue
                shown += 1
                wrong += np.abs(image[int(y), int(x)] - ([0, 0, 255] if copy['reversing'] else [255, 0, 0])).max() > 60
            check(shown > 0 and wrong == 0, f'{notation} {model}: {shown} copies in their colors, {wrong} not')

    # a filled page: nothing but the two colors
    for notation in ('*333', '*244', '*236', '*2222'):
        svg(notation, '--no-labels', '--colors', 'red,blue', '--lines', '0', '--size', '400x300')
        if shutil.which('rsvg-convert'):
            image = pixels()
            near = np.minimum(np.abs(image - [255, 0, 0]).max(axis=2), np.abs(image - [0, 0, 255]).max(axis=2))
            check(image.shape[:2] == (300, 400) and (near < 4).mean() > 0.9 and image[:, :, 1].max() < 130, f'{notation} covers the page in two colors')
    # beyond a pixel: the disk of *237 is full of copies until just before its rim
    svg('*237', '--no-labels', '--colors', 'white,black', '--lines', '0', '--size', '600')
    if shutil.which('rsvg-convert'):
        image, (y, x) = pixels(), np.mgrid[0:600, 0:600]
        ring = np.abs(np.hypot(x - 299.5, y - 299.5) / 290.4 - 0.9) < 0.03
        check(image[ring].std() > 60, f'copies are told apart near the rim {image[ring].std()}')

    # all rooms and models, with labels, a motif and cuts
    for notation in ('*', '*55', '*235', '*333', '*2222', '**', '*22∞', 'p6m', '{7,3}', '*22222'):
        svg(notation, '--motif', 'F')
        svg(notation, '--model', 'klein', '--motif', 'M0 0L2 0L2 1L1 1Z')
    svg('*237', '--model', 'half-plane', '--motif', 'R')
    svg('*333', '--model', 'plane')
    done = svg('*2223', '--shape', 'paper', '--cut', '1.2', '--cuts', '--size', '200mm')
    root = xml.parse(target).getroot()
    check(root.get('width') == '200mm' and root.get('height').endswith('mm') and root.get('viewBox').startswith('0 0 755.906 '), 'print sizes')
    check('cut of walls 2 and 4' in target.read_text(), 'the cut is drawn')
    check(b'svg.no-cuts' in svg('*333', '--cuts').stderr, 'what has no cuts is told')
    motif = where / 'motif.svg'
    motif.write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C1 2 3 2 4 0Z"/></svg>')
    svg('*22222', '--motif', motif)
    check('svg.copies-left-out' in svg('*237', '--max-copies', '50').stderr.decode() and target.read_text().count('<path') < 200, 'limits are told')

    # mirror images of a letter are mirrored: a tile and its image in one mirror of the square, pixel by pixel
    if shutil.which('rsvg-convert'):
        svg('*2222', '--no-labels', '--motif', 'F', '--colors', 'white,white', '--lines', '0', '--size', '400')
        image = pixels().sum(axis=2)
        side = 400 / (4.2 * np.sqrt(2))
        low, high = 200 - side / 2, 200 + side / 2
        here = image[round(low):round(low) + 60, round(low):round(low) + 60]
        inner = image[int(low) + 2:int(high) - 2, int(low) + 2:int(high) - 2]
        beside = image[int(low) + 2:int(high) - 2, int(high) + 3:int(2 * high - low) - 1][:, ::-1]
        n = min(inner.shape[1], beside.shape[1])
        agree = (np.abs(inner[:, -n:] - beside[:, -n:]) < 200).mean()
        flipped = (np.abs(inner - inner[:, ::-1]) < 200).mean()
        check(agree > 0.93 and flipped < 0.9 and inner.min() < 200, f'F is mirrored in the next tile: {agree:.3f} against {flipped:.3f}')

    # bytes through a pipe, the same every time and for any number of threads
    first = run([ORBC, 'svg', '*237']).stdout
    check(first.startswith(b'<?xml') and first == run([ORBC, 'svg', '*237', '-o', '-', '--threads', '1']).stdout, 'svg -o - gives bytes')
    told = json.loads(run([ORBC, 'svg', '*237', '-o', target, '--json']).stdout)
    check(told['notation'] == '*237' and told['copies'] > 1000, 'svg --json')

    # orbifolds that are not closed by mirrors alone
    for notation, model in (('22*', 'disk'), ('oo', 'disk'), ('oo', 'klein'), ('23x', 'half-plane'), ('o', 'plane'), ('532', 'disk'), ('x', 'klein')):
        svg(notation, '--model', model, '--motif', 'F')
    told = json.loads(run([ORBC, 'svg', '332', '-o', target, '--json', '--smallest', '0.1']).stdout)
    check(told['notation'] == '332' and told['copies'] == 12, 'svg 332 draws the whole group')
    for words in (['o', '--model', 'half-plane'], ['22*', '--cuts'], ['oo', '--model', 'hyperboloid'], ['oo', '--model', 'plane'], ['22*', '--shape', 'paper']):
        svg(*words, code=2)

    # mistakes
    for words in (['*237', '--size', 'big'], ['*237', '--size', '0'], ['*237', '--size', '800x'], ['*237', '--colors', 'red'], ['*237', '--colors', 'red,nocolor'],
                  ['*235', '--model', 'half-plane'], ['*235', '--model', 'plane'], ['*237', '--model', 'cube'], ['*237', '--lines', '-1'],
                  ['*235', '--model', 'hyperboloid'], ['*237', '--geodesic', '0,0,1'], ['*237', '--geodesic', '0,0,0.5,1'], ['*237', '--geodesic', '0.1,0,0.1,0'],
                  ['*235', '--geodesic', '1,0,-1,0'], ['*235', '--geodesic', '0,0,nan,1'], ['*235', '--geodesic', '0,0,1,1,1']):
        svg(*words, code=2)
    check(b'known' not in svg('*23', code=1).stderr, 'a bad orbifold')
    for words in (['*237', '--motif', '?'], ['*237', '--motif', 'M0 0'], ['*333', '--aspect', '2'], ['23'], ['22q']):
        check(b'error[' in svg(*words, code=1).stderr, f'{words} is refused')
finish()
