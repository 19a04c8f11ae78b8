#!/usr/bin/env python3
"""docs/scene.md is what the schema says, and every example in it is accepted without a warning."""
from helpers import BIN, ROOT, check, finish, run

SCRIPT = ROOT / 'scripts/scene_reference.py'
done = run([SCRIPT, '--check'])
check(done.returncode == 0, f'docs/scene.md is made from the schema as it is {done.stderr.decode()}')
done = run([SCRIPT, '--try', BIN / 'orbc'])
check(done.returncode == 0 and b' 0 wrong' in done.stdout, f'every example of docs/scene.md is accepted: {done.stdout.decode()} {done.stderr.decode()}')
finish()
