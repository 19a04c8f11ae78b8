"""The blocks of docs/python.md run, one after the other, as in a notebook."""
import contextlib
import io
import os
import re

from helpers import BIN, ROOT, check, finish, folder

os.environ['PATH'] = f'{BIN}{os.pathsep}{os.environ["PATH"]}'
blocks = re.findall(r'```python\n(.*?)```', (ROOT / 'docs/python.md').read_text(), re.S)
check(len(blocks) >= 3 and len(blocks[0].splitlines()) == 5, 'the first block has five lines')
with folder() as where:
    os.chdir(where)
    names = {}
    for number, block in enumerate(blocks, 1):
        printed = io.StringIO()
        try:
            with contextlib.redirect_stdout(printed):
                exec(compile(block, f'docs/python.md, block {number}', 'exec'), names)
            check(bool(printed.getvalue()), f'block {number} prints: {printed.getvalue()[:120]!r}')
        except Exception as error:  # pylint: disable=broad-except
            check(False, f'block {number}: {error!r} {getattr(error, "stderr", b"")[:300]!r}')
    check(names['facts']['copies'][0] | {'matrix': 0} == {'word': [], 'reversing': False, 'moebius': {'a': [1, 0], 'b': [0, 0], 'c': [0, 0], 'd': [1, 0]}, 'matrix': 0}, 'the room itself comes first')
    check(names['picture'].startswith(b'<?xml') and names['glb'][:4] == b'glTF' and names['tiling'].startswith(b'<?xml'), 'bytes through pipes')
finish()
