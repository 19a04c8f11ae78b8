#!/usr/bin/env python3
"""Writes docs/scene.md from schema/orbc-scene.schema.json: every key of a scene with its meaning, unit, bounds, default and an example.

  scripts/scene_reference.py                  writes docs/scene.md
  scripts/scene_reference.py --check          exit code 1 when docs/scene.md is not what it would write
  scripts/scene_reference.py --try PROGRAM    every example through `orbc check`, in a scene where it has an effect: no error, no warning
"""
import argparse
import json
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCHEMA = json.loads((ROOT / 'schema/orbc-scene.schema.json').read_text(encoding='utf-8'))
PAGE = ROOT / 'docs/scene.md'

BALL = 'objects=[{sphere: {radius: 0.1}, at: {polar: [0.1, 0deg], z: 0.1}}]'
STATUE = 'objects=[{mesh: meshes/statue.ply, size: 0.2, at: centre}]'
FLAG = 'objects=[{mesh: flag.obj, size: 0.2, at: {polar: [0.3, 90deg]}}]'  # with texture coordinates
LAMP = 'lights=[{at: {polar: [0, 0deg], z: 0.8}}]'
PLAIN_WALL = 'room.walls.1.mirror={span: [0.1, 0.4]}'

# Title, anchor, where in the schema, the path that leads there, and what must stand in the scene for its keys to have an effect.
SECTIONS = [
    ('The scene', '', '', []),
    ('The room', 'properties/room', 'room', []),
    ('Walls', '$defs/wall', 'room.walls.1', [PLAIN_WALL]),
    ('Mirrors', '$defs/wall_mirror', 'room.walls.1.mirror', []),
    ('Frames', '$defs/frame/anyOf/1', 'room.walls.1.frame', []),
    ('Floor and ceiling', '$defs/surface/anyOf/2', 'room.floor', []),
    ('Mirrors on floor and ceiling', '$defs/surface/anyOf/2/properties/mirror/anyOf/1', 'room.floor.mirror', []),
    ('Objects', 'properties/objects/items', 'objects.1', [BALL]),
    ('Spheres', 'properties/objects/items/properties/sphere', 'objects.1.sphere', []),
    ('Cylinders', 'properties/objects/items/properties/cylinder', 'objects.1.cylinder', []),
    ('Boxes', 'properties/objects/items/properties/box', 'objects.1.box', []),
    ('Rings', 'properties/objects/items/properties/torus', 'objects.1.torus', []),
    ('Knots', 'properties/objects/items/properties/torus_knot', 'objects.1.torus_knot', []),
    ('Beams', 'properties/objects/items/properties/beam', 'objects.1.beam',
     ['objects=[{beam: {from: {polar: [0.3, 10deg], z: 0.2}, to: {polar: [0.3, 200deg], z: 0.2}}}]']),
    ('Materials', '$defs/material_map', 'objects.1.material', [BALL]),
    ('Places', '$defs/place_map', 'objects.1.at', [BALL, 'objects.1.at={}', 'objects.1.sphere.radius=0.05']),
    ('Lights', 'properties/lights/items', 'lights.1', [LAMP]),
    ('Baked light', 'properties/bake', 'bake', [LAMP]),
    ('The camera', 'properties/camera', 'camera', []),
    ('Directions of view', 'properties/camera/properties/look_at/anyOf/2', 'camera.look_at', []),
    ('A lens', 'properties/camera/properties/lens', 'camera.lens', ['camera.at={polar: [0.3, 40deg], z: 0.5}']),
    ('How far mirrors are followed', 'properties/cover', 'cover', []),
    ('Films', 'properties/animation', 'animation', ['animation.set={camera.fov: {from: 60deg, to: 90deg}}']),
    ('Between two values', '$defs/motion/anyOf/1', 'animation.set."camera.fov"', ['animation.set={camera.fov: {from: 60deg, to: 90deg}}']),
    ('Keyframes', '$defs/motion/anyOf/2', 'animation.set."room.walls.1.mirror.reflectance"', ['animation.set={room.walls.1.mirror.reflectance: {keys: [[0, 0.5]]}}']),
    ('Walks', '$defs/motion/anyOf/3', 'animation.set."camera.at"', ['animation.set={camera.at: {walk: walls}}']),
    ('Curves', '$defs/motion/anyOf/4', 'animation.set."camera.at"', ['animation.set={camera.at: {path: [{polar: [0.1, 0deg]}, {polar: [0.1, 90deg]}, {polar: [0.1, 180deg]}]}}']),
    ('Ahead', '$defs/motion/anyOf/5/properties/ahead', 'animation.set."camera.look_at".ahead',
     ['animation.set={camera.at: {walk: walls}, camera.look_at: {ahead: {}}}']),
]

# What more must stand beside a key, said before it.
BESIDE = {
    'room.cut': ['room.shape=paper'],
    'room.cuts': ['room.shape=paper'],
    'room.lengths': ['room.shape=lengths'],
    'room.scale': ['orbifold=*333'],
    'room.aspect': ['orbifold=*2222'],
    'room.length': ['orbifold=**'],
    'camera.eye_separation': ['camera.projection=stereo', 'camera.size=[64, 64]'],
    'rays': ['orbifold=*237'],
    'white': [LAMP],
    'ambient': [LAMP],
    'bake': [LAMP],
    'bake.bounces': ['integrator=path'],
    'bake.samples': ['integrator=path'],
    'bake.seed': ['integrator=path'],
    'bake.lights': ['orbifold=*333'],
    'room.walls.1.mirrors': ['room.walls.1.mirror='],
    'room.walls.1.frame': ['room.walls.1.mirror={span: [0.1, 0.4]}'],
    'objects.1.material.second': ['objects.1.material={pattern: checker}'],
    'objects.1.material.cell': ['objects.1.material={pattern: checker}'],
    'objects.1.material.roughness': ['objects.1.material={kind: metal}'],
    'objects.1.material.index': ['objects.1.material={kind: glass}'],
    'objects.1.material.emission': ['objects.1.material={kind: emissive}'],
    'objects.1.material.texture': [FLAG],
    'objects.1.material.opacity_mask': [FLAG],
    'objects.1.material.cutoff': [FLAG, 'objects.1.material.opacity_mask=leaf.png'],
    'objects.1.mesh': ['objects=[{size: 0.2}]'],
    'objects.1.up': [STATUE],
    'objects.1.size': [STATUE, 'camera.at={polar: [0.4, 200deg], z: 0.5}'],
    'objects.1.embedding': [STATUE],
    'objects.1.at.toward': ['objects.1.at={distance: 0.2}'],
    'objects.1.at.distance': ['objects.1.at={toward: corner 2}'],
    'lights.1.to': ['lights.1.kind=spot'],
    'lights.1.cone': ['lights.1.kind=spot'],
    'lights.1.size': ['lights.1.kind=rectangle'],
    'camera.look_at': ['objects=[{mesh: meshes/statue.ply, size: 0.2, at: centre}]', 'camera.at={polar: [0.3, 40deg], z: 0.5}'],
    'camera.lens': ['objects=[{mesh: meshes/statue.ply, size: 0.2, at: centre}]', 'camera.at={polar: [0.3, 40deg], z: 0.5}'],
    'camera.lens.focus': ['objects=[{mesh: meshes/statue.ply, size: 0.2, at: centre}]'],
    'camera.lens.radius': ['camera.lens={focus_distance: 0.5}'],
}
BESIDE.update({f'objects.1.{shape}': ['objects=[{at: {polar: [0, 0deg], z: 0.05}}]'] for shape in ('sphere', 'cylinder', 'box', 'torus', 'torus_knot')})
BESIDE['objects.1.beam'] = ['objects=[{}]']


def at(pointer):
    part = SCHEMA
    for step in pointer.split('/') if pointer else []:
        part = part[int(step)] if isinstance(part, list) else part[step]
    return part


def flow(value):
    """A value as YAML writes it on one line."""
    if isinstance(value, bool):
        return 'true' if value else 'false'
    if isinstance(value, dict):
        return '{' + ', '.join(f'{k}: {flow(v)}' for k, v in value.items()) + '}'
    if isinstance(value, list):
        return '[' + ', '.join(flow(v) for v in value) + ']'
    if isinstance(value, str):
        plain = value and value[0] not in '#*&!%@`{[-' and ': ' not in value and value not in ('true', 'false', 'null') and not value[0].isdigit() or value.endswith(('deg', 'rad'))
        return value if plain else json.dumps(value, ensure_ascii=False)
    return f'{value:g}' if isinstance(value, float) else str(value)


def reference(part):
    return part['$ref'].rsplit('/', 1)[1] if isinstance(part, dict) and '$ref' in part else ''


def bounds(part):
    if not isinstance(part, dict):
        return ''
    low = part.get('minimum', part.get('exclusiveMinimum'))
    high = part.get('maximum')
    if low is None:
        return ''
    whole = 'whole number ' if part.get('type') == 'integer' else ''
    return f'{whole}{"over " if "exclusiveMinimum" in part else ""}{low:.10g} to {high:.10g}'


NAMED = {'color': '[colour](#colours-and-angles)', 'angle': '[angle](#colours-and-angles)', 'place': '[place](#places)', 'place_map': '[place](#places)',
         'material': '[material](#materials)', 'two_colors': 'two colours', 'wall': '[wall](#walls)', 'mirror': '[mirror](#mirrors), or none',
         'wall_mirror': '[mirror](#mirrors)', 'frame': '[frame](#frames), or none', 'surface': '[surface](#floor-and-ceiling)',
         'material_name': 'name of a material', 'motion': '[motion](#between-two-values)', 'material_map': '[material](#materials)'}


def takes(part):
    """Type, unit and bounds in words."""
    unit = part.get('x-unit', '')
    if reference(part):
        return NAMED[reference(part)]
    if 'const' in part:
        return flow(part['const'])
    if 'enum' in part:
        return ', '.join(dict.fromkeys(flow(v).strip('"') for v in part['enum']))
    if 'anyOf' in part:
        return unit or ' or '.join(dict.fromkeys(takes(choice) for choice in part['anyOf']))
    kind = part.get('type')
    if kind in ('number', 'integer'):
        return ', '.join(word for word in (unit, bounds(part)) if word)
    if kind == 'array':
        count = part.get('minItems')
        if count and count == part.get('maxItems', count):
            items = part.get('items', {})
            inside = takes(items) if reference(items) else ', '.join(word for word in (unit, bounds(items)) if word)
            return 'a length and an angle' if 'prefixItems' in part else f'{count} × ({inside})'
        return 'list'
    if kind == 'object':
        return 'map' if 'propertyNames' not in part else f'map from wall numbers to {unit}s'
    return {'string': 'text', 'boolean': 'true or false'}.get(kind, '')


def example(part):
    if 'examples' in part:
        return part['examples'][0]
    if reference(part) and 'examples' in SCHEMA['$defs'][reference(part)]:
        return SCHEMA['$defs'][reference(part)]['examples'][0]
    if 'default' in part:
        return part['default']
    return None


def described(part):
    return part.get('description') or SCHEMA['$defs'].get(reference(part), {}).get('description', '')


def cell(text):
    return text.replace('|', '\\|').replace('\n', ' ')


def keys_of(pointer):
    """The keys of a part; those of a material stand in their own section."""
    properties = at(pointer).get('properties', {})
    material = at('$defs/material_map')['properties']
    if pointer == '$defs/material_map' or 'material' not in properties or 'preset' not in properties:
        return properties, False
    return {key: part for key, part in properties.items() if key not in material}, True


def page():
    lines = ['# Scenes, key by key', '',
             'This page is made from `schema/orbc-scene.schema.json` by `scripts/scene_reference.py`; every example is checked by the tests. '
             '`orbc schema` prints the schema, `orbc new` writes a scene to start from. Any key can be said on the command line instead: '
             '`--set camera.fov=60deg`.', '',
             'Lengths are radii of curvature on the sphere and in the hyperbolic plane, and in flat rooms what `room.scale` makes of them. '
             '"over 0" means that 0 itself is not allowed. A scene is YAML 1.2 without anchors and tags, or JSON.', '']
    for title, pointer, path, _ in SECTIONS:
        part = at(pointer)
        lines += [f'## {title}', '']
        if path:
            lines += [f'`{path}`' + (f': {described(part)}' if described(part) else ''), '']
        keys, material = keys_of(pointer)
        lines += ['| key | what it is | takes | default | example |', '|---|---|---|---|---|']
        for key, spec in keys.items():
            default = '**required**' if key in part.get('required', []) else f'`{flow(spec["default"])}`' if 'default' in spec else ''
            lines.append(f'| `{key}` | {cell(described(spec))} | {cell(takes(spec))} | {default} | `{cell(f"{key}: {flow(example(spec))}")}` |')
        lines.append('')
        if material:
            lines += ['And the keys of a [material](#materials).', '']
        if pointer == '$defs/place_map':
            lines += ['`centre` alone is a place, too. One of `disk`, `polar`, `toward` and `walls`; `z` beside it.', '']
    lines += ['## Colours and angles', '',
              f'A colour: {at("$defs/color")["description"]} Examples: ' + ', '.join(f'`{flow(e)}`' for e in at('$defs/color')['examples']) + '.', '',
              f'{at("$defs/angle")["description"]} Examples: ' + ', '.join(f'`{flow(e)}`' for e in at('$defs/angle')['examples']) + '.', '',
              'Named materials: ' + ', '.join(f'`{name}`' for name in at('$defs/material_name')['enum']) + '.', '']
    return '\n'.join(lines)


def white_picture():
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + b'\xff' * 24 for _ in range(8))
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 8, 8, 8, 2, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b'')


def try_examples(program):
    """Errors and warnings of examples: each in a scene of the two lines every scene has, and what must stand beside it."""
    failed = count = 0
    with tempfile.TemporaryDirectory(prefix='orbc-test.') as folder:
        (Path(folder) / 'meshes').symlink_to(ROOT / 'examples/meshes')
        for name in ('tiles.png', 'leaf.png'):
            (Path(folder) / name).write_bytes(white_picture())
        corners = ((0, 0), (1, 0), (1, 1), (0, 1))
        points = ''.join(f'v {x} 0 {z}\nvt {x} {z}\n' for x, z in corners)
        (Path(folder) / 'flag.obj').write_text(points + 'f 1/1 2/2 3/3 4/4\n')
        for _, pointer, path, context in SECTIONS:
            for key, spec in keys_of(pointer)[0].items():
                where = f'{path}.{key}' if path else key
                value = example(spec)
                beside = BESIDE.get(where, [])
                said = [] if key in ('orbc', 'orbifold') else context
                words = [word for change in [*said, *beside, f'{where}={flow(value)}'] for word in ('--set', change)]
                done = subprocess.run([program, 'check', '-', *words], input=b'orbc: 1\norbifold: "*22222"\n', capture_output=True, cwd=folder, timeout=60, check=False)
                told = done.stderr.decode()
                count += 1
                if value is None or done.returncode != 0 or 'warning[' in told:
                    failed += 1
                    print(f'{where}: {flow(value)}: {told}', file=sys.stderr)
    print(f'{count} examples, {failed} wrong')
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--check', action='store_true')
    parser.add_argument('--try', dest='program')
    arguments = parser.parse_args()
    if arguments.program:
        return try_examples(Path(arguments.program).resolve())
    if not arguments.check:
        PAGE.write_text(page(), encoding='utf-8')
        return 0
    if PAGE.exists() and PAGE.read_text(encoding='utf-8') == page():
        return 0
    print('docs/scene.md is not what the schema says: run scripts/scene_reference.py', file=sys.stderr)
    return 1


if __name__ == '__main__':
    sys.exit(main())
