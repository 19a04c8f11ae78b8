"""What a clone's own scripts do: install_packages asks for what is missing alone; quickstart and test share one build folder; nothing is skipped in CI."""
import json
import os
import pathlib
import shutil
import subprocess

from helpers import ROOT, SCRIPTS, check, finish, folder, need, run

need('cmake', 'ninja', 'git')
PACKAGES = [line for line in (SCRIPTS / 'packages.txt').read_text().splitlines() if line and line[0] not in '#[']


def stand_ins(where, installed, apt='exit 0'):
    """A folder of programs that stand in for Debian's: they write down how they were called."""
    programs = where / 'programs'
    programs.mkdir(exist_ok=True)
    for path in programs.iterdir():
        path.unlink()
    texts = {
        'dpkg-query': 'printf "%s"' + ''.join(f" 'installed {name}\n'" for name in installed).replace("' '", ''),
        'apt-get': f'echo "apt-get $*" >> "{where}/calls"; {apt}',
        'dpkg-deb': f'echo "dpkg-deb $*" >> "{where}/calls"; mkdir -p tree/usr/include/OpenMesh',
        'node': 'exit 0',
        'npm': 'exit 0',
        'id': 'echo 0',
    }
    for name, text in texts.items():
        (programs / name).write_text(f'#!/bin/sh\n{text}\n')
        (programs / name).chmod(0o755)
    for name in ('bash', 'sh', 'sed', 'tr', 'dirname', 'mktemp', 'rm', 'mkdir', 'mv', 'find', 'head', 'tail', 'env'):
        (programs / name).symlink_to(shutil.which(name))
    return programs


def install(where, programs, which='build'):
    calls = where / 'calls'
    calls.write_text('')
    done = run([where / 'scripts/install_packages', which], env={'PATH': str(programs), 'TMPDIR': str(where)}, stdin=subprocess.DEVNULL)
    return done, calls.read_text()


def check_install_packages(where):
    (where / 'scripts').mkdir()
    for name in ('install_packages', 'packages.txt'):
        shutil.copy(SCRIPTS / name, where / 'scripts' / name)
    everything = stand_ins(where, [*PACKAGES, 'libopenmesh-dev'])
    for _ in range(2):
        done, calls = install(where, everything, 'test')
        check(done.returncode == 0 and not calls and not done.stderr, f'nothing is missing: nothing is asked for {calls}{done.stderr.decode()}')
    done, calls = install(where, everything, 'all of it')
    check(done.returncode == 2, 'a set that does not exist')

    done, calls = install(where, stand_ins(where, [name for name in PACKAGES if name not in ('cmake', 'blender')]))
    check(done.returncode == 0 and 'install -y --no-install-recommends cmake\n' in calls, f'what is missing alone is installed: {calls}')
    check('download libopenmesh-dev' in calls and 'install' not in calls.split('download')[1], 'OpenMesh\'s headers are unpacked, not installed')
    check((where / '.packages/usr/include/OpenMesh').is_dir() and not list((where / '.packages').glob('new.*')), 'into .packages/, with nothing left over')
    done, calls = install(where, stand_ins(where, [name for name in PACKAGES if name != 'blender']))
    check(done.returncode == 0 and not calls, f'the second time they are there, and Blender is no package of this set: {calls}')
    done, calls = install(where, stand_ins(where, [name for name in PACKAGES if name != 'blender']), 'test')
    check(done.returncode == 0 and 'blender' in calls, 'it is one of the tests\'')

    programs = stand_ins(where, [name for name in PACKAGES if name != 'cmake'])
    (programs / 'id').write_text('#!/bin/sh\necho 1000\n')
    done, calls = install(where, programs)
    check(done.returncode == 3 and b'root' in done.stderr and b'cmake' in done.stderr and not calls, f'without root it says what to install: {done.stderr.decode()}')
    done, calls = install(where, stand_ins(where, [name for name in PACKAGES if name != 'cmake'], apt='echo no route >&2; exit 100'))
    check(done.returncode == 3 and b'network' in done.stderr and b'no route' in done.stderr, f'without a network it says so: {done.stderr.decode()}')
    (programs / 'apt-get').unlink()
    done, calls = install(where, programs)
    check(done.returncode == 3 and b'no Debian' in done.stderr, 'elsewhere than on Debian it says so')


def commands(build):
    """How each file of the program itself is compiled."""
    entries = json.loads((build / 'compile_commands.json').read_text())
    return {entry['file']: entry['command'] for entry in entries if 'orbc_test' not in entry['command'] and '/test' not in entry['command'].split(' -o ')[1]}


def check_configure(where):
    """In a clone, without compiling: what quickstart and test configure, in any order."""
    clone = where / 'clone'
    clone.mkdir()
    listed = run(['git', '-C', ROOT, 'ls-files', '-co', '--exclude-standard', '-z']).stdout.decode().split('\0')
    for name in listed:
        if name and (ROOT / name).is_file():
            (clone / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, clone / name)
    if (ROOT / '.packages').is_dir():
        (clone / '.packages').symlink_to(ROOT / '.packages')
    build = clone / 'build'

    def configure(*options):
        done = run([clone / 'scripts/configure', 'build', *options], cwd=clone)
        check(done.returncode == 0, f"configure {' '.join(options)} {done.stderr.decode()}")
        return done.stderr.decode()

    def tests():
        return 'ORBC_TESTS:BOOL=ON' in (build / 'CMakeCache.txt').read_text()

    check(configure() == '' and not tests(), 'quickstart configures without tests')
    first = commands(build)
    check(any(name.endswith('main.cpp') for name in first), f'{len(first)} files')
    check(run(['ctest', '--test-dir', build, '--no-tests=error']).returncode != 0, 'a run of no test is a failure')
    configure('-DORBC_TESTS=ON')
    second = commands(build)
    check(tests() and all(second.get(name) == command for name, command in first.items()), 'scripts/test compiles with the same commands: it uses what is there')
    check(run(['ctest', '--test-dir', build, '--no-tests=error', '-N']).stdout.count(b'Test ') > 30, 'and the tests are there')
    check(configure() == '' and tests() and commands(build) == second, 'quickstart after it leaves the tests on')

    # Folders that were made otherwise.
    shutil.rmtree(build)
    done = run(['cmake', '-S', clone, '-B', build, '-G', 'Unix Makefiles', '-DORBC_TESTS=OFF', '-DORBC_BENCH=OFF'])
    check(done.returncode == 0 and 'Unix Makefiles' in configure() and (build / 'build.ninja').exists(), 'a folder for another generator is told and configured again')
    moved = where / 'moved'
    clone.rename(moved)
    done = run([moved / 'scripts/configure', 'build'], cwd=moved)
    check(done.returncode == 0 and str(clone).encode() in done.stderr and str(clone) not in (moved / 'build/build.ninja').read_text(),
          f'so is the folder of a clone that was moved: {done.stderr.decode()}')


def check_skips():
    text = 'import sys; sys.argv = [""]; sys.path.insert(0, "tests/system"); import helpers; helpers.need("no-such-renderer")'
    for ci, code in (('true', 1), ('', 77)):
        done = run(['/usr/bin/python3', '-c', text], cwd=ROOT, env={**os.environ, 'CI': ci})
        check(done.returncode == code, f'a program that is missing: exit code {code} with CI={ci}')


with folder() as name:
    where = pathlib.Path(name).resolve()
    check_install_packages(where)
    check_configure(where)
    check_skips()
finish()
