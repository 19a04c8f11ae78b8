#!/usr/bin/env python3
"""Draws the figures of examples/paper into docs/pictures/paper: scripts/paper_figures.py ORBC [FIGURE…]

A folder's file `panels` holds one command of orbc a line, without its output and size. Their pictures stand side by side in the figure.
"""
import pathlib
import shlex
import subprocess
import sys
import tempfile

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEIGHT = 300      # of a panel in pixels
GAP = 8
LARGEST = 160_000  # bytes of a figure


def drawn(orbc, words, folder, where):
    """The picture of one command."""
    target = where / ('panel.svg' if words[1] == 'svg' else 'panel.png')
    size = [] if words[1] == 'svg' else ['--quiet', '--samples', '9', '--size', '800x400' if 'panorama' in folder.name else '400x300']
    subprocess.run([orbc, *words[1:], '-o', target, *size, *(['--quiet'] if words[1] == 'svg' else [])], cwd=folder, check=True)
    if words[1] == 'svg':
        subprocess.run(['rsvg-convert', '-h', str(HEIGHT), target, '-o', where / 'panel.png'], check=True)
    with Image.open(where / 'panel.png') as picture:
        picture = picture.convert('RGB')
    return picture.resize((round(picture.width * HEIGHT / picture.height), HEIGHT), Image.LANCZOS)


def figure(panels):
    image = Image.new('RGB', (sum(panel.width + GAP for panel in panels) - GAP, HEIGHT), 'white')
    left = 0
    for panel in panels:
        image.paste(panel, (left, 0))
        left += panel.width + GAP
    return image


def main(orbc, *names):
    out = ROOT / 'docs/pictures/paper'
    out.mkdir(parents=True, exist_ok=True)
    for panels in sorted((ROOT / 'examples/paper').glob('*/panels')):
        folder = panels.parent
        if names and folder.name not in names:
            continue
        print(folder.name, file=sys.stderr)
        with tempfile.TemporaryDirectory() as name:
            commands = [shlex.split(line) for line in panels.read_text().splitlines()]
            image = figure([drawn(orbc, words, folder, pathlib.Path(name)) for words in commands])
        for quality in (88, 80, 70, 60):
            image.save(out / f'{folder.name}.jpg', quality=quality, optimize=True)
            if (out / f'{folder.name}.jpg').stat().st_size <= LARGEST:
                break


main(str(pathlib.Path(sys.argv[1]).resolve()), *sys.argv[2:])
