"""What the tests that run real renderers share: samples, programs, pictures."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCRIPTS = ROOT / 'scripts'
BIN = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / 'build/bin')
SKIP = 77
failures = []


def skip(why):
    """Ends a test that cannot run here: skipped on a developer's machine, failed in CI, where everything must be there."""
    if os.environ.get('CI') == 'true':
        print('FAILED  nothing may be skipped in CI: ' + why)
        sys.exit(1)
    print('skipped: ' + why)
    sys.exit(SKIP)


def need(*programs):
    missing = [program for program in programs if shutil.which(program) is None]
    if missing:
        skip('not installed: ' + ', '.join(missing))


def check_gltf(file, what):
    """Holds a glTF file to the Khronos validator. Where that could not be installed, this is left out; in CI it fails."""
    if not (ROOT / 'node_modules/gltf-validator').is_dir() and os.environ.get('CI') != 'true':
        print('left out (npm ci has not been run): ' + what)
        return
    report = run(['node', SCRIPTS / 'validate_gltf.mjs', file])
    check(report.returncode == 0, what + ('' if report.returncode == 0 else ' ' + (report.stdout or report.stderr).decode()[:2000]))


def check(condition, what):
    print(('ok      ' if condition else 'FAILED  ') + what)
    if not condition:
        failures.append(what)


def finish():
    print(f'{len(failures)} failed' if failures else 'all passed')
    sys.exit(1 if failures else 0)


def folder():
    return tempfile.TemporaryDirectory(prefix='orbc-test.')


def sample(name, form, where):
    """Writes a sample product; returns what is known of it."""
    done = subprocess.run([BIN / 'sample_products', name, form, where], stdout=subprocess.PIPE, check=True, timeout=60)
    return json.loads(done.stdout)


def run(command, **options):
    options.setdefault('timeout', 240)
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, **options)


def done(*command):
    """Runs what must succeed."""
    ended = run(command)
    if ended.returncode:
        sys.exit(f"{' '.join(str(word) for word in command)}\n{ended.stderr.decode()}")


def picture(path):
    return np.asarray(Image.open(path).convert('RGB')).astype(int)


def decode_srgb(code):
    v = np.asarray(code, dtype=float) / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def encode_srgb(linear):
    v = np.clip(np.asarray(linear, dtype=float), 0, 1)
    return 255 * np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def expected_codes(facts):
    """The picture of the sample `codes`: texel x, row by row, times the weight of each band, computed in linear light."""
    x, y = np.meshgrid(np.arange(256), np.arange(16))
    texels = np.stack([x, (x * 7 + y * 16) % 256, 255 - x], axis=-1)
    return np.concatenate([encode_srgb(decode_srgb(texels) * np.array(tint)) for tint in facts['tints']])


def predicted_pixel(facts, at):
    """Where the ball at `at` must appear: place/eye.h's definition of the cameras, inverted. None behind the camera."""
    d = np.array(at) - np.array(facts['location'])
    f, r, u = (float(np.dot(d, facts[axis])) for axis in ('forward', 'right', 'up'))
    w, h, fov = facts['width'], facts['height'], facts['fov']
    if facts['projection'] == 0:
        if f <= 0:
            return None
        half = math.tan(fov / 2)
        return w / 2 * (1 + r / f / half), h / 2 * (1 - u / f / (half * h / w))
    azimuth = math.atan2(r, f)
    if facts['projection'] == 1:
        return w * (azimuth / (2 * math.pi) + 0.5), h * (0.5 - math.atan2(u, math.hypot(f, r)) / math.pi)
    return w * (azimuth / fov + 0.5), h / 2 * (1 - u / math.hypot(f, r) / (h / w * fov / 2))


def ball_errors(facts, pixels):
    """Distance in pixels between predicted and drawn centre of every ball wholly inside the picture."""
    errors = []
    for ball in facts['balls']:
        place = predicted_pixel(facts, ball['at'])
        if place is None:
            continue
        ys, xs = np.nonzero(np.abs(pixels - np.array(ball['color'])).max(axis=-1) <= 1)
        inside = 40 < place[0] < facts['width'] - 40 and 40 < place[1] < facts['height'] - 40
        if not inside:
            continue
        if len(xs) == 0:
            errors.append((math.inf, ball))
            continue
        # The outline's middle, not the mean of the pixels: perspective stretches balls away from the axis.
        centre = ((xs.min() + xs.max() + 1) / 2, (ys.min() + ys.max() + 1) / 2)
        errors.append((math.dist(centre, place), ball))
    return errors


def check_balls(facts, pixels, what, bound):
    errors = [error for error, _ in ball_errors(facts, pixels)]
    check(len(errors) >= 10, f'{what}: {len(errors)} balls in the picture')
    check(max(errors) < bound, f'{what}: worst {max(errors):.2f} px, median {sorted(errors)[len(errors) // 2]:.2f} px')
