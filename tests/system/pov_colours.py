"""POV-Ray draws exported colours exactly: every texel code, times every weight, read back from the picture."""
import os

import numpy as np

from helpers import SCRIPTS, check, encode_srgb, expected_codes, finish, folder, need, picture, run, sample

need('povray')
with folder() as where:
    facts = sample('codes', 'pov', where)
    # An unmodified povray, started in the scene's folder, finds the atlas beside the scene.
    done = run(['povray', '+Icodes.pov', '+W256', '+H64', '-D', '-A', '+FN8', '+Ocodes.png'], cwd=where)
    check(done.returncode == 0, 'povray draws the scene from its folder')
    wanted = expected_codes(facts)
    off = np.abs(picture(os.path.join(where, 'codes.png')) - wanted)
    check(off[:16].max() < 1e-6, f'weight 1: texels come through unchanged (worst {off[:16].max():.2e})')
    # Rounded to the nearest code; exact ties may go either way.
    check(off.max() < 0.5 + 1e-3, f'weights multiply in linear light (worst {off.max():.4f} of a code)')

    facts = sample('squares', 'pov', where)
    done = run([SCRIPTS / 'povray-pipe', os.path.join(where, 'squares.pov'), '-o', os.path.join(where, 'squares.png')])
    check(done.returncode == 0, 'povray-pipe draws a scene file too ' + done.stderr.decode())
    pixels = picture(os.path.join(where, 'squares.png'))
    check(pixels.shape == (60, 80, 3), 'with the size in its head')
    check((pixels[0, 0] == np.round(encode_srgb(facts['background']))).all(), f'the background is exact ({pixels[0, 0]})')
    check((pixels[30, 40] == [255, 128, 0]).all(), f'the nearer square hides the farther one ({pixels[30, 40]})')

    facts = sample('huge', 'pov', where)
    done = run([SCRIPTS / 'povray-pipe', os.path.join(where, 'huge.pov'), '-o', os.path.join(where, 'huge.png')])
    check(done.returncode == 0, 'huge and tiny numbers parse ' + done.stderr.decode())
    check(picture(os.path.join(where, 'huge.png')).shape == (997, 1, 3), 'odd sizes are kept')
finish()
