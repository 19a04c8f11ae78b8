#!/usr/bin/env python3
"""Traces a small room for every named material and pastes them on one sheet, each with its name.

    scripts/material_sheet.py ORBC OUT.png
"""
import pathlib
import subprocess
import sys
import tempfile

from PIL import Image, ImageDraw, ImageFont

# What an author writes after `material:`, as it stands in the sheet.
MATERIALS = [
    'marble', 'granite', 'wood', 'porcelain',
    'gold', 'copper', 'silver', 'chrome',
    'mirror', 'glass', 'plaster', 'coral',
    '{kind: glossy, color: coral}', '{kind: metal, color: steelblue}', '{kind: emissive, color: gold, emission: 0.9}', '{checker: [ivory, brown], cell: 0.06}',
]
SIZE, COLUMNS, LABEL, GAP = (176, 132), 4, 18, 6

SCENE = """orbc: 1
orbifold: "*2222"
room:
  scale: 0.8
  height: 1.3
  floor:   {{checker: [lightgray, dimgray], cell: 0.2}}
  ceiling: {{color: "#f4f2ee"}}
  walls:
    all: {{mirror: none, color: "#b8c4cc"}}
    1: {{mirror: {{reflectance: 0.85}}, frame: {{width: 0.04, color: peru}}}}
    3: {{mirror: none, color: "#c9a58c"}}
objects:
  - torus_knot: {{p: 2, q: 3, radius: 0.13, tube: 0.045}}
    name: knot
    at: {{polar: [0.2, 140deg], z: 0.02}}
    turn: 20deg
    material: {material}
  - sphere: {{radius: 0.17}}
    name: ball
    at: {{polar: [0.22, 325deg]}}
    material: {material}
lights:
  - {{kind: sphere, at: {{polar: [0.5, 250deg], z: 1.15}}, radius: 0.08, power: 20}}
  - {{kind: sphere, at: {{polar: [0.5, 100deg], z: 1.0}}, radius: 0.05, power: 5, color: "#dce8ff"}}
ambient: "#5a5a60"
bake: {{mirrors: 1}}
camera: {{at: {{polar: [0.74, 240deg], z: 0.55}}, look_at: {{polar: [0.02, 60deg], z: 0.16}}, fov: 58deg, size: [{width}, {height}]}}
cover: {{max_bounces: 4}}
"""


def thumbnail(orbc, material, folder):
    scene, picture = folder / 'scene.yaml', folder / 'picture.png'
    scene.write_text(SCENE.format(material=material, width=SIZE[0], height=SIZE[1]))
    subprocess.run([orbc, 'trace', scene, '-o', picture, '--samples', '16', '--quiet'], check=True)
    return Image.open(picture).convert('RGB')


def main():
    orbc, out = sys.argv[1:]
    rows = -(-len(MATERIALS) // COLUMNS)
    sheet = Image.new('RGB', (COLUMNS * (SIZE[0] + GAP) - GAP, rows * (SIZE[1] + LABEL + GAP) - GAP), 'white')
    pen = ImageDraw.Draw(sheet)
    try:
        font = ImageFont.truetype('DejaVuSans.ttf', 10)
    except OSError:
        font = ImageFont.load_default()
    with tempfile.TemporaryDirectory() as folder:
        for i, material in enumerate(MATERIALS):
            x, y = i % COLUMNS * (SIZE[0] + GAP), i // COLUMNS * (SIZE[1] + LABEL + GAP)
            sheet.paste(thumbnail(orbc, material, pathlib.Path(folder)), (x, y))
            text = material.strip('{}').replace(', cell: 0.06', '').replace(', emission: 0.9', '')
            pen.text((x + SIZE[0] / 2 - pen.textlength(text, font=font) / 2, y + SIZE[1] + 2), text, fill='black', font=font)
    sheet.save(out, optimize=True)


main()
