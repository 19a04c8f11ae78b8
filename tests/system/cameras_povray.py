"""Every camera of POV-Ray shows things where place/eye.h says: balls around a tilted head, predicted against drawn pixel."""
import os

from helpers import SCRIPTS, check, check_balls, finish, folder, need, picture, run, sample

need('povray')
with folder() as where:
    for name in ('balls-perspective', 'balls-panorama', 'balls-cylinder', 'flat'):
        facts = sample(name, 'pov', where)
        done = run([SCRIPTS / 'povray-pipe', os.path.join(where, name + '.pov'), '-o', os.path.join(where, name + '.png')])
        check(done.returncode == 0, f'{name} is drawn {done.stderr.decode()}')
        # The drawn outline is rounded to whole pixels on both sides, and an octahedron is not a ball: about half a pixel each.
        check_balls(facts, picture(os.path.join(where, name + '.png')), name, 1.5)
finish()
