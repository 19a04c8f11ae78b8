#!/usr/bin/env python3
"""However a command ends, nothing is half done: ended by signals at twenty moments, on full disks, with closed and full streams, and by two
at once under one name. What was there stays as it was, or all of it is new; no temporary file and no renderer is left."""
import concurrent.futures
import itertools
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

from helpers import BIN, check, finish, folder, need, run

ORBC = BIN / 'orbc'
MOMENTS = 20
SIGNALS = {'TERM': signal.SIGTERM, 'INT': signal.SIGINT, 'HUP': signal.SIGHUP, 'KILL': signal.SIGKILL}
SCENE = '''orbc: 1
orbifold: "*333"
room: {floor: {checker: [ivory, %s], cell: 0.2}}
objects:
  - {mesh: ball.obj, size: 0.3, at: {polar: [0.2, 80deg]}, material: {color: coral}}
camera: {at: {polar: [0.3, 225deg]}, look_at: centre, size: [48, 36]}
cover: {max_bounces: 3}
'''
BALL = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n'


def prepare(where):
    (where / 'ball.obj').write_text(BALL)
    (where / 'a.yaml').write_text(SCENE % 'slategray')
    (where / 'b.yaml').write_text(SCENE % 'brown')
    (where / 'left.pov').write_bytes(b''.join(b'<%d.5, 2>\n' % i for i in range(100000)))


# name: words of the command, and the output that it writes, or None for one that prints.
def commands(where):
    a = where / 'a.yaml'
    uses = {f'compile {form}': (['compile', a, '-q'], f'out.{form}') for form in ('pov', 'glb', 'gltf', 'svg')}
    uses |= {f'trace {form}': (['trace', a, '-q', '--samples', '9'], f'out.{form}') for form in ('png', 'exr')}
    uses |= {f'render {engine}': (['render', a, '-q', '--samples', '1', '--engine', engine], 'out.png') for engine in ('povray', 'blender')}
    uses['svg'] = (['svg', '*237', '-q', '--smallest', '4'], 'out.svg')
    uses['verify'] = (['verify', a, '-q', '--threshold', '0', '--off-edge', '1', '--difference'], 'out.png')
    for words in (['info', '*23456789(10)(11)', '--max-length', '40'], ['enumerate', '--corners', '4', '--max-order', '12'], ['new', '*2323'], ['check', a],
                  ['diff', where / 'left.pov', where / 'left.pov'], ['explain'], ['schema'], ['completion', 'zsh'], ['man'], ['compile', a, '--plan']):
        uses[' '.join(words[:1] + words[2:] if words[0] == 'compile' else words[:1])] = (words, None)
    return uses


def full_command(use, out):
    words, output = use
    if output is None:
        return [ORBC, *words]
    return [ORBC, *words, out / output] if words[-1] == '--difference' else [ORBC, *words, '-o', out / output]


def contents(at):
    return {path.name: path.read_bytes() for path in sorted(at.iterdir())}


def fill(at, files):
    for path in at.iterdir():
        path.unlink()
    for name, data in files.items():
        (at / name).write_bytes(data)


def main_files(files):
    return {name: data for name, data in files.items() if not re.search(r'-[0-9a-f]{12}\.\w+$', name)}


def complete(files, whole_sets):
    """Whether the main outputs are those of one of the sets, with all that belongs to it."""
    return any(main_files(files) == main_files(whole) and all(files.get(name) == data for name, data in whole.items()) for whole in whole_sets)


def still_running(mark):
    """Processes that carry a mark in their environment."""
    found = []
    for process in pathlib.Path('/proc').glob('[0-9]*'):
        try:
            if mark in (process / 'environ').read_bytes() and (process / 'stat').read_text().rsplit(')', 1)[1].split()[0] != 'Z':
                found.append((process / 'cmdline').read_bytes().replace(b'\0', b' ').decode(errors='replace')[:80])
        except OSError:
            pass
    return found


class Place:
    """A folder for outputs and one for temporary files, and what is known of a use's outputs."""
    numbers = itertools.count()

    def __init__(self, where):
        self.number = next(Place.numbers)
        self.out, self.temporary = where / f'out{self.number}', where / f'tmp{self.number}'
        self.out.mkdir()
        self.temporary.mkdir()
        self.mark = f'ORBC_TEST_MARK={os.getpid()}.{self.number}.'.encode()

    def environment(self):
        name, value = self.mark.decode().split('=')
        return {**os.environ, 'TMPDIR': str(self.temporary), name: value}


def whole_outputs(where, use):
    """What the command makes of scene a, and of scene b, if it is left alone; and how long it takes."""
    sets = []
    for scene in ('a.yaml', 'b.yaml'):
        place = Place(where)
        words = [where / scene if word == where / 'a.yaml' else '*334' if (word, scene) == ('*237', 'b.yaml') else word for word in use[0]]
        begin = time.monotonic()
        done = run(full_command((words, use[1]), place.out), env=place.environment(), timeout=300)
        seconds = time.monotonic() - begin
        if done.returncode:
            check(False, f'{" ".join(map(str, words))} runs: {done.stderr.decode()[:300]}')
        sets.append(contents(place.out))
    return sets, seconds


def end(place, command, number, delay, twice=False):
    """Ends a command by a signal. Makes: its exit code and what it said."""
    process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=place.environment(),
                               start_new_session=True)
    time.sleep(delay)
    for _ in range(2 if twice else 1):
        try:
            (os.killpg if twice else os.kill)(process.pid, number)
        except ProcessLookupError:
            break
        time.sleep(0.02 if twice else 0)
    try:
        _, said = process.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        process.kill()
        return 'it does not end', b''
    return process.returncode, said


def wrong_after(place, sets, ended, number, use):
    """What is wrong with what a run has left; nothing if all is right."""
    code, said = ended
    killed = number == signal.SIGKILL
    if code not in ((0, -number) if killed else (0, 130, -number)):  # before the first line of the program a signal does what it always does
        return f'exit code {code} {said[-200:]}'
    if code == 130 and b'stopped' not in said:
        return f'it does not say that it was stopped: {said[-200:]}'
    deadline = time.monotonic() + 10
    while (left := still_running(place.mark)) and time.monotonic() < deadline:
        time.sleep(0.02)
    if left:
        return f'still running: {left}'
    found = {name: data for name, data in contents(place.out).items() if not (killed and name.startswith('.orbc.'))}
    new, old = sets
    if not (complete(found, sets) if killed else found in (new, old)):
        return f'the output is neither old nor new: {sorted(found)}'
    if use[1] and code == 0 and not killed and found != new:
        return 'it says that it is done, and the output is old'
    litter = [name for name in os.listdir(place.temporary) if not (killed and name.startswith('orbc.'))]
    if litter:
        return f'temporary files stay: {litter}'
    for name in os.listdir(place.temporary):
        shutil.rmtree(place.temporary / name)
    return None


def ended_at_all_moments(where, name, use):
    sets, seconds = whole_outputs(where, use)
    place = Place(where)
    wrong, stopped = [], 0
    for signal_name, number in SIGNALS.items():
        for moment in range(MOMENTS):
            fill(place.out, sets[1])
            delay = seconds * (moment + 0.5) / MOMENTS
            ended = end(place, full_command(use, place.out), number, delay)
            stopped += ended[0] != 0
            if why := wrong_after(place, sets, ended, number, use):
                wrong.append(f'{signal_name} after {delay:.3f} s: {why}')
                fill(place.temporary, {})
    if name.startswith('render'):  # Ctrl-C twice, to the whole group, as a terminal does it
        for moment in range(0, MOMENTS, 4):
            fill(place.out, sets[1])
            ended = end(place, full_command(use, place.out), signal.SIGINT, seconds * (moment + 0.5) / MOMENTS, twice=True)
            if why := wrong_after(place, sets, ended, signal.SIGINT, use):
                wrong.append(f'INT twice: {why}')
    return name, seconds, stopped, wrong


def signals(where):
    uses = commands(where)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        longest_first = sorted(uses.items(), key=lambda item: not item[0].startswith(('render blender', 'verify')))
        for name, seconds, stopped, wrong in pool.map(lambda item: ended_at_all_moments(where, *item), longest_first):
            check(not wrong and stopped > 0, f'{name} ({seconds:.2f} s), {stopped} of {4 * MOMENTS} runs ended early: {wrong[:3] if wrong else "all is old or all is new"}')


def with_streams(env, redirection, command):
    return run(['bash', '-c', f'exec "$@" {redirection}', 'bash', *command], env=env)


def lost_streams(where, name, use):
    """What is wrong with a command whose messages are lost, or whose output is."""
    place = Place(where)
    env = place.environment()
    command = full_command(([word for word in use[0] if word != '-q'], use[1]), place.out)
    whole = run(command, env=env)
    made = contents(place.out)
    wrong = [] if whole.returncode == 0 else [f'it fails: {whole.stderr.decode()[-200:]}']
    for redirection in ('2>/dev/full', '2>&-', '<&- 2>&-'):
        fill(place.out, {})
        done = with_streams(env, redirection, command)
        if done.returncode or done.stdout != whole.stdout:
            wrong.append(f'{redirection}: exit code {done.returncode}')
        if contents(place.out) != made:
            wrong.append(f'{redirection}: its files are others')
    for redirection in ('>/dev/full', '>&-', '<&- >&- 2>&-', '>/dev/full 2>/dev/full'):
        fill(place.out, {})
        done = with_streams(env, redirection, command)
        told = b'cannot write standard output' in done.stderr or '2>' in redirection
        if done.returncode != (3 if whole.stdout else 0) or (whole.stdout and not told):
            wrong.append(f'{redirection}: exit code {done.returncode} {done.stderr.decode()[-100:]}')
        if contents(place.out) != made:
            wrong.append(f'{redirection}: its files are others')
    if os.listdir(place.temporary):
        wrong.append('temporary files stay')
    return name, wrong


def streams(where):
    """Closed and full streams. Messages that are lost change nothing; output that is lost is an error."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for name, wrong in pool.map(lambda item: lost_streams(where, *item), commands(where).items()):
            check(not wrong, f'{name} with closed and full streams: {wrong or "does what it does else, or tells that it cannot"}')
    env = dict(os.environ)

    def shell(redirection, command):
        return with_streams(env, redirection, command)

    for words in (['--help'], ['--version'], ['compile', '--help'], ['info', '*237', '--json'], []):
        for redirection in ('>/dev/full', '>&-'):
            done = shell(redirection, [ORBC, *words])
            check(done.returncode == 3 and b'cannot write standard output' in done.stderr, f'orbc {" ".join(words)} {redirection}: {done.returncode} {done.stderr.decode()[:100]}')
    for words, code in ((['info', '*23'], 1), (['compil'], 2), (['check', where / 'none.yaml'], 1), (['compile', where / 'a.yaml', '-o', where / 'none/x.glb'], 3)):
        for redirection in ('2>/dev/full', '2>&-', '>&- 2>&-'):
            done = shell(redirection, [ORBC, *words])
            check(done.returncode == code, f'orbc {" ".join(map(str, words))} {redirection}: {done.returncode}')
    done = shell('<&-', [ORBC, 'check', '-'])
    check(done.returncode == 1 and b'scene.cannot-read' in done.stderr, f'a closed standard input cannot be read: {done.stderr.decode()[:150]}')
    done = shell('< .', [ORBC, 'check', '-'])
    check(done.returncode == 1 and b'scene.cannot-read' in done.stderr and b'directory' in done.stderr, f'neither can a folder: {done.stderr.decode()[:150]}')


def full_disks(where, at, limit):
    """Exports on a disk that has room for less and less. `limit(bytes)` makes an empty disk at `at`, and words to put before a command."""
    for form in ('pov', 'gltf', 'glb', 'svg', 'png', 'exr'):
        words = ['trace' if form in ('png', 'exr') else 'compile', where / 'a.yaml', '-q']
        report = [] if form in ('png', 'exr', 'svg') else ['--report', at / 'out.json']
        sets, _ = whole_outputs(where, (words, f'out.{form}'))
        new, old = sets
        sizes = [sum(-(-len(data) // 4096) * 4096 for data in files.values()) for files in (new, old)]
        written = set()
        for part in range(7):
            before = limit(sizes[1] + (sizes[0] + 16384) * part // 6, max(map(len, new.values())) * part // 6)
            fill(at, old)
            done = run([*before, ORBC, *words, '-o', at / f'out.{form}', *report])
            found = contents(at)
            written.add(done.returncode)
            if done.returncode == 0:
                check({name: data for name, data in found.items() if name != 'out.json'} == new and bool(report) == ('out.json' in found), f'{form}: what fits is written, with its report')
            else:
                check(done.returncode == 3 and b'cannot write' in done.stderr and found == old, f'{form} on a full disk: nothing is touched {done.returncode} {done.stderr.decode()[:100]} {sorted(found)}')
        check(written == {0, 3}, f'{form}: some disks were full, some not: {written}')


def small_tmpfs(where):
    """In a mount namespace of its own (this script, run again under unshare)."""
    at = where / 'disk'
    at.mkdir()

    def limit(disk_bytes, _):
        run(['umount', at])
        mounted = run(['mount', '-t', 'tmpfs', '-o', f'size={disk_bytes}', 'tmpfs', at])
        if mounted.returncode:
            sys.exit(f'cannot mount: {mounted.stderr.decode()}')
        return []

    full_disks(where, at, limit)


def disks(where):
    for unshare in (['unshare', '-m'], ['unshare', '-r', '-m']):
        if run([*unshare, 'mount', '-t', 'tmpfs', 'tmpfs', where]).returncode == 0:
            done = run([*unshare, sys.executable, __file__, BIN, '--on-tmpfs'], timeout=600)
            print(done.stdout.decode(), end='')
            check(done.returncode == 0, f'full disks, each a tmpfs of its own {done.stderr.decode()[-300:]}')
            return
    print('no file system may be mounted here: files of limited size stand for full disks')
    check(os.environ.get('CI') != 'true', 'CI mounts a tmpfs')


def two_at_once(where):
    """Two runs under one name: in the end all files are those of one of them, and each run says that it has done its work."""
    for form in ('pov', 'gltf'):
        sets, seconds = whole_outputs(where, (['compile', where / 'a.yaml', '-q'], f'out.{form}'))
        place = Place(where)
        winners = set()
        for turn in range(12):
            both = []
            for number, scene in enumerate(('a.yaml', 'b.yaml')):
                if number == turn % 2 and turn > 3:
                    time.sleep(seconds * turn / 60)
                both.append(subprocess.Popen([ORBC, 'compile', where / scene, '-q', '-o', place.out / f'out.{form}'], stderr=subprocess.PIPE))
            said = [process.communicate(timeout=60)[1] for process in both]
            found = contents(place.out)
            winners.add(sets.index(found) if found in sets else f'mixed: {sorted(found)}')
            if any(process.returncode for process in both):
                winners.add(f'failed: {said}')
        check(winners <= {0, 1}, f'two exports at once under the name out.{form}: {winners}')


def between_renames(where):
    """Killed while its files take their names: before each of them. What is there is old or new as a whole, with all that belongs to it."""
    for form in ('pov', 'gltf'):
        use = (['compile', where / 'a.yaml', '-q'], f'out.{form}')
        sets, _ = whole_outputs(where, use)
        place = Place(where)
        killed = 0
        for when in range(1, 9):
            fill(place.out, sets[1])
            command = ['strace', '-f', '-qq', '-o', '/dev/null', '-e', 'trace=rename,renameat,renameat2,link,linkat',
                       '-e', f'inject=rename,renameat,renameat2,link,linkat:signal=SIGKILL:when={when}', *full_command(use, place.out)]
            done = run(command, env=place.environment())
            found = {name: data for name, data in contents(place.out).items() if not name.startswith('.orbc.')}
            check(complete(found, sets), f'{form}, killed before renaming file {when}: {sorted(found)}')
            killed += done.returncode != 0
        check(2 <= killed < 8, f'{form}: {killed} of 8 runs were killed while files took their names')


def limited_files(where):
    """Files that may not grow (RLIMIT_FSIZE) stand for full disks where nothing can be mounted."""
    at = where / 'limited'
    at.mkdir()
    full_disks(where, at, lambda _, file_bytes: ['prlimit', f'--fsize={file_bytes}'])


with folder() as name:
    base = pathlib.Path(name)
    prepare(base)
    if '--on-tmpfs' in sys.argv:
        small_tmpfs(base)
        run(['umount', base / 'disk'])
        finish()
    need('povray', 'blender', 'strace')
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    parts = {part.__name__: part for part in (streams, disks, limited_files, between_renames, two_at_once, signals)}
    for part in [parts[name] for name in sys.argv[2:]] or parts.values():
        begin = time.monotonic()
        part(base)
        print(f'{part.__name__}: {time.monotonic() - begin:.0f} s', flush=True)
finish()
