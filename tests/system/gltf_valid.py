"""The Khronos validator finds no error and no warning in anything the exporter writes, and finds both where they are."""
import json
import os
import pathlib

from helpers import ROOT, SCRIPTS, check, finish, folder, need, run, sample, skip

need('node')
if not (ROOT / 'node_modules/gltf-validator').is_dir():
    skip('npm install has not been run')
VALIDATE = ['node', SCRIPTS / 'validate_gltf.mjs']

with folder() as where:
    for name in ('squares', 'one-texel', 'codes', 'empty', 'hollow', 'many', 'huge', 'balls-perspective', 'balls-panorama', 'balls-cylinder', 'flat'):
        for form, extension in (('glb', 'glb'), ('nodes', 'glb'), ('gltf', 'gltf')):
            sample(name, form, where)
            path = os.path.join(where, f'{name}.{extension}')
            done = run([*VALIDATE, path])
            report = json.loads(done.stdout) if done.stdout else {}
            issues = report.get('issues', {})
            told = [message['code'] for message in issues.get('messages', []) if message['severity'] < 2]
            check(done.returncode == 0, f"{name} as {form}: {issues.get('numErrors')} errors, {issues.get('numWarnings')} warnings {told}{done.stderr.decode()}")
    sample('squares', 'glb', where)
    whole = pathlib.Path(where, 'squares.glb').read_bytes()
    check(run([*VALIDATE, '-'], input=whole).returncode == 0, 'from standard input')
    check(run([*VALIDATE, '-'], input=whole[:-8]).returncode == 1, 'a cut file is 1')
    check(run([*VALIDATE, '-'], input=b'').returncode == 1, 'an empty file is 1')
    check(run([*VALIDATE, '-'], input=whole.replace(b'"componentType":5123,"count":12', b'"componentType":5125,"count":12')).returncode == 1, 'a wrong accessor is 1')
    check(run([*VALIDATE, os.path.join(where, 'none.glb')]).returncode == 3, 'a missing file is 3')
    check(run(VALIDATE).returncode == 2, 'no file is 2')
finish()
