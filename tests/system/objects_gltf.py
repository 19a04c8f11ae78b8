"""--nodes-per-object: objects are nodes with materials of their own names, of the same triangles as without, and draw the same picture."""
import json
import os
import pathlib
import shutil
import struct

import numpy as np

from helpers import BIN, ROOT, SCRIPTS, check, check_gltf, done, finish, folder, picture, run

SCENE = """orbc: 1
orbifold: "*22222"
room: {height: 0.9, walls: {all: {mirror: {reflectance: 0.9}}, 2: {mirror: {height: [0.2, 0.7], frame: {width: 0.05}}}, 4: {mirror: none}}}
objects:
  - {mesh: MESH, size: 0.25, at: {xy: [0.3, 0]}, name: statue, material: coral}
  - {mesh: MESH, size: 0.2, at: {xy: [-0.2, 0.2]}, name: statue 2, material: MATERIAL}
  - {box: {}, name: floor, at: {xy: [0, -0.3]}}
LIGHTS
camera: {at: {xy: [-0.1, -0.05], z: 0.5}, look_at: statue, size: [160, 120]}
cover: {max_bounces: 3}
bake: {lights: KIND, quality: draft}
"""
LAMP = 'lights: [{kind: point, at: {xy: [0.1, 0.2], z: 0.8}}]'


def read_glb(path):
    data = pathlib.Path(path).read_bytes()
    length = struct.unpack_from('<I', data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def values(glb, number):
    tree, binary = glb
    accessor = tree['accessors'][number]
    view = tree['bufferViews'][accessor['bufferView']]
    kind = {5123: np.uint16, 5125: np.uint32, 5126: np.float32}[accessor['componentType']]
    width = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}[accessor['type']]
    at = view.get('byteOffset', 0) + accessor.get('byteOffset', 0)
    return np.frombuffer(binary, kind, accessor['count'] * width, at).reshape(-1, width)


def triangles(glb, meshes):
    """The triangles of these meshes: positions, colours and places in the atlas of their corners, in an order that depends on them alone."""
    rows = []
    for number in meshes:
        for primitive in glb[0]['meshes'][number]['primitives']:
            columns = [values(glb, primitive['attributes'][name]).astype(np.float64)
                       for name in ('POSITION', 'NORMAL', 'TEXCOORD_0', 'COLOR_0') if name in primitive['attributes']]
            corners = np.hstack(columns)[values(glb, primitive['indices'])[:, 0]]
            rows.append(corners.reshape(-1, 3 * corners.shape[1]))
    rows = np.vstack(rows)
    return rows[np.lexsort(rows.T)]


def compare(where, name, scene):
    def path(end):
        return os.path.join(where, name + end)
    pathlib.Path(path('.yaml')).write_text(scene.replace('MESH', str(ROOT / 'examples/meshes/statue_small.ply')))
    done(BIN / 'orbc', 'compile', path('.yaml'), '-o', path('.glb'), '--report', path('.json'), '-q')
    done(BIN / 'orbc', 'compile', path('.yaml'), '-o', path('-objects.glb'), '--nodes-per-object', '--report', path('-objects.json'), '-q')
    one, parted = read_glb(path('.glb')), read_glb(path('-objects.glb'))
    nodes = [node for node in parted[0]['nodes'] if 'mesh' in node]
    names = [node['name'] for node in nodes]
    check(names[0] == 'floor' and names[-3 if 'lamp 1' not in names else -4:][:3] == ['statue', 'statue 2', 'floor'], f'{name}: nodes are {names}')
    check({'ceiling', 'wall 4', 'frame on wall 2'} <= set(names), f'{name}: the shell and frames have nodes')
    check(all(node['extras']['orbc_object'] == node['name'] and node['extras']['orbc_copies'] > 0 for node in nodes), f'{name}: extras')
    for node in nodes:
        mesh = parted[0]['meshes'][node['mesh']]
        materials = {parted[0]['materials'][primitive['material']]['name'] for primitive in mesh['primitives']}
        check(mesh['name'] == node['name'] and materials == {node['name']}, f"{name}: mesh and material of {node['name']}")
    every = triangles(one, range(len(one[0]['meshes']))), triangles(parted, range(len(parted[0]['meshes'])))
    check(every[0].shape == every[1].shape and (every[0] == every[1]).all(), f'{name}: the same {len(every[0])} triangles')
    reports = [json.loads(pathlib.Path(path(end)).read_text()) for end in ('.json', '-objects.json')]
    check(reports[0] == reports[1], f'{name}: the same report')
    listed = parted[0]['extras']['orbc_copies']
    counted = sum(entry['index_count'] for entry in listed)
    check(counted == 3 * len(every[0]), f'{name}: every triangle belongs to a copy of an object')
    check(len([node for node in parted[0]['nodes'] if node['name'] == 'lamp']) == len([node for node in one[0]['nodes'] if node['name'] == 'lamp']),
          f'{name}: as many lamps')
    check_gltf(path('-objects.glb'), f'{name}: the validator finds nothing')
    return path


with folder() as where:
    plain = compare(where, 'plain', SCENE.replace('LIGHTS', '').replace('MATERIAL', 'ivory').replace('KIND', 'baked'))
    compare(where, 'baked', SCENE.replace('LIGHTS', LAMP).replace('MATERIAL', 'silver').replace('KIND', 'baked'))
    compare(where, 'native', SCENE.replace('LIGHTS', LAMP).replace('MATERIAL', '{kind: emissive, color: gold}').replace('KIND', 'native'))
    if shutil.which('blender'):
        for end in ('', '-objects'):
            done(SCRIPTS / 'render_blender.py', plain(end + '.glb'), '-o', plain(end + '.png'))
        check((picture(plain('.png')) == picture(plain('-objects.png'))).all(), 'Blender draws the same picture')
    both = run([BIN / 'orbc', 'compile', plain('.yaml'), '-o', plain('.glb'), '--nodes-per-object', '--nodes-per-copy'])
    check(both.returncode == 2 and b'choose one' in both.stderr, 'both kinds of nodes are a usage error')
    for end in ('pov', 'svg'):
        other = run([BIN / 'orbc', 'compile', plain('.yaml'), '-o', plain('.' + end), '--nodes-per-object'])
        check(other.returncode == 2 and b'no nodes' in other.stderr and not os.path.exists(plain('.' + end)), f'.{end} has no nodes')
finish()
