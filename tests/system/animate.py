"""Films: frames are the pictures of their moments, whoever draws them, in whatever order; a second run draws what is missing or no longer
true, and nothing else."""
import json
import signal
import time

from helpers import *

ORBC = BIN / 'orbc'
FRAMES = 12
SCENE = '''orbc: 1
orbifold: "*2323"
room: {height: 0.8, floor: {checker: [ivory, teal], cell: 0.1}}
objects:
  - {name: avatar, cylinder: {radius: 0.04, height: 0.2}, at: {polar: [0.1, 30deg]}, color: firebrick}
  - {name: post, cylinder: {radius: 0.02, height: 0.3}, at: {polar: [0.05, 200deg]}, color: gold}
camera: {at: {polar: [0.2, 20deg], z: 0.4}, fov: 80deg, size: [64, 48]}
cover: {max_bounces: 3}
animation:
  frames: 12
  set:
    camera.at: {walk: walls, distance: 0.15, z: 0.4}
    camera.look_at: {ahead: {lead: 0.3}}
    MORE
'''


def orbc(*words, **options):
    return run([ORBC, *words], **options)


def result(done):
    return json.loads(done.stdout) if done.returncode == 0 else {}


def frames_of(film):
    return {path.name: path.read_bytes() for path in sorted(film.glob('frame-*.png'))}


with folder() as where:
    where = pathlib.Path(where)
    scene = where / 'walk.yaml'
    scene.write_text(SCENE.replace('MORE', ''))
    moving = where / 'moving.yaml'
    moving.write_text(SCENE.replace('MORE', 'objects.avatar.at: {walk: walls, distance: 0.1, start: corner 2}'))
    check(orbc('check', scene, moving).returncode == 0, 'films are checked')

    for path, what in ((scene, 'a moving eye'), (moving, 'an eye and an object that move')):
        film = where / (path.stem + '-film')
        first = result(orbc('animate', path, '-o', film, '--samples', '1', '--frames', '3-5', '--json'))
        check((first.get('drawn'), first.get('kept')) == (3, 0), f'{what}: a part of the frames is drawn: {first}')
        rest = result(orbc('animate', path, '-o', film, '--samples', '1', '--json'))
        check((rest.get('drawn'), rest.get('kept')) == (FRAMES - 3, 3), f'{what}: the others are drawn, those are kept: {rest}')
        frames = frames_of(film)
        check(len(frames) == FRAMES and len(set(frames.values())) == FRAMES, f'{what}: all frames are there, no two the same')
        for i in (0, 5, 11):
            still = orbc('at', path, '--time', f'{i / FRAMES:.17g}')
            check(still.returncode == 0, f'{what}: the moment of frame {i} is printed: {still.stderr.decode()[:200]}')
            orbc('trace', '-', '--samples', '1', '-o', where / 'still.png', input=still.stdout)
            check((where / 'still.png').read_bytes() == frames[f'frame-{i:04d}.png'], f'{what}: frame {i} is the picture of its moment')
        # A film ends where it begins: its last step is like the others.
        shown = [picture(film / name).astype(float) for name in frames]
        steps = [float(np.mean(np.abs(shown[i] - shown[(i + 1) % FRAMES]))) for i in range(FRAMES)]
        check(0.3 * np.median(steps) < steps[-1] < 3 * np.median(steps), f'{what}: the last step is like the others: {steps[-1]:.2f}, median {np.median(steps):.2f}')

    whole = frames_of(where / 'walk-film')

    # Ends by force: what is missing is drawn by the next run, to the same bytes.
    film = where / 'killed'
    child = subprocess.Popen([ORBC, 'animate', scene, '-o', film, '--samples', '1', '-q'])
    until = time.monotonic() + 60
    while len(frames_of(film)) < 3 and time.monotonic() < until:
        time.sleep(0.005)
    child.kill()
    child.wait()
    left = len(frames_of(film))
    after = result(orbc('animate', scene, '-o', film, '--samples', '1', '--json'))
    check(3 <= left and after.get('kept', 0) >= left - 1 and after.get('drawn', 0) + after.get('kept', 0) == FRAMES, f'after SIGKILL: {left} were there, {after}')
    check(frames_of(film) == whole, 'after SIGKILL the film is the same')

    # Two at once share the frames.
    film = where / 'shared'
    both = [subprocess.Popen([ORBC, 'animate', scene, '-o', film, '--samples', '1', '--json', '-q', '--threads', '1'], stdout=subprocess.PIPE) for _ in range(2)]
    results = [json.loads(one.communicate(timeout=120)[0]) for one in both]
    check(frames_of(film) == whole, f'two processes make the same film: {[r["drawn"] for r in results]}')
    check(sum(r['drawn'] for r in results) == FRAMES and not list(film.glob('*.lock')), 'no frame is drawn twice, no lock is left')

    # What made a frame has changed: it is drawn again.
    again = result(orbc('animate', scene, '-o', film, '--samples', '1', '--json', '--set', 'camera.fov=70deg'))
    check(again.get('drawn') == FRAMES, f'a change of the scene redraws: {again}')
    still_there = result(orbc('animate', scene, '-o', film, '--samples', '1', '--json', '--set', 'camera.fov=70deg'))
    check(still_there.get('kept') == FRAMES, f'and once only: {still_there}')

    by_option = [result(orbc('animate', scene, '-o', film, '--samples', '1', '--frames', '0', '--json', '--set', 'camera.fov=70deg', *more)).get('drawn') for more in (['--no-highlights'], ['--no-highlights'])]
    check(by_option == [1, 0], f'so does an option that changes pictures: {by_option}')

    # Renderers draw frames as well.
    if shutil.which('povray'):
        film = where / 'povray'
        done = orbc('animate', scene, '-o', film, '--engine', 'povray', '--samples', '1', '--frames', '4', '--json')
        close = result(done).get('drawn') == 1
        check(close, f'POV-Ray draws a frame: {done.stderr.decode()[:200]}')
        if close:
            off = np.max(np.abs(picture(film / 'frame-0004.png').astype(int) - picture(where / 'walk-film/frame-0004.png').astype(int)), axis=2)
            check(float(np.mean(off > 4)) < 0.05, f'POV-Ray and the tracer agree on it: {float(np.mean(off > 4)):.4f} of the pixels are off')

    # A video is made by ffmpeg of all frames; a stand-in writes down what it is asked for.
    programs = where / 'programs'
    programs.mkdir()
    (programs / 'ffmpeg').write_text(f'#!/bin/sh\necho "$@" >> {where}/asked\nfor last; do :; done\ncase $last in *.webm) echo video > "$last";; esac\n')
    (programs / 'ffmpeg').chmod(0o755)
    with_ffmpeg = {**os.environ, 'PATH': f'{programs}:{os.environ["PATH"]}'}
    done = orbc('animate', scene, '-o', where / 'walk-film', '--samples', '1', '--video', where / 'walk.webm', env=with_ffmpeg)
    asked = (where / 'asked').read_text() if (where / 'asked').exists() else ''
    check(done.returncode == 0 and (where / 'walk.webm').exists() and 'frame-%04d.png' in asked and 'libvpx-vp9' in asked, f'a video is made: {done.stderr.decode()[:200]}')
    done = orbc('animate', scene, '-o', where / 'few', '--samples', '1', '--frames', '0-1', '--video', where / 'few.mp4', env=with_ffmpeg)
    check(done.returncode == 1 and b'animation.frames-missing' in done.stderr, f'a video of some of the frames is refused: {done.returncode}')
    done = orbc('animate', scene, '-o', where / 'none', '--video', where / 'x.webm', env={'PATH': str(where)})
    check(done.returncode == 2 and b'apt-get install ffmpeg' in done.stderr and not (where / 'none').exists(), f'without ffmpeg it is said how to get it: {done.returncode}')

    # Mistakes are refused before anything is drawn.
    film = where / 'foreign'
    film.mkdir()
    (film / 'frame-0003.png').write_bytes(b'mine')
    done = orbc('animate', scene, '-o', film)
    check(done.returncode == 1 and b'animation.foreign-frame' in done.stderr and os.listdir(film) == ['frame-0003.png'], 'pictures of others are not replaced')
    done = orbc('animate', ROOT / 'examples/pentagon/scene.yaml', '-o', where / 'none')
    check(done.returncode == 1 and b'animation.missing' in done.stderr, 'a scene in which nothing moves')
    for words in (['--frames', '9-12'], ['--frames', '5-4'], ['--frames', 'x'], ['--video', 'film.avi'], ['--format', 'exr', '--video', 'film.webm']):
        done = orbc('animate', scene, '-o', where / 'none', *words)
        check(done.returncode == 2, f'{words} is refused: {done.returncode} {done.stderr.decode()[:100]}')
    done = orbc('animate', scene, '-o', '/proc/film')
    check(done.returncode == 3 and b'/proc/film' in done.stderr, f'a folder that cannot be made: {done.returncode}')
finish()
