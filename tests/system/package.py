"""The Debian packages: all that belongs to orbc is in them and found from anywhere; others build against what is installed."""
import gzip
import os
import pathlib
import re
import shutil

from helpers import BIN, ROOT, check, done, finish, folder, need, picture, run

need('cpack', 'dpkg-deb', 'dpkg-shlibdeps', 'file', 'povray', 'cmake', 'ninja')
BUILD = BIN.resolve().parent

PROGRAM = ('bin/orbc', 'share/man/man1/orbc.1.gz', 'share/bash-completion/completions/orbc', 'share/zsh/vendor-completions/_orbc',
           'share/fish/vendor_completions.d/orbc.fish', 'share/orbc/povray-pipe', 'share/orbc/render_blender.py', 'share/orbc/drawing.py',
           'share/orbc/orbc-scene.schema.json', 'share/orbc/diagnostics.md', 'share/orbc/examples/lit-pentagon/scene.yaml',
           'share/orbc/examples/meshes/statue.ply', 'share/doc/orbc/copyright', 'share/doc/orbc/THIRD_PARTY.md')
DEVELOPMENT = ('include/orbc/compiler/driver/compile.h', 'include/orbc/exporters/pov/write_pov.h', 'liborbc_driver.a', 'cmake/orbc/orbcConfig.cmake')


def fields_of(package):
    lines = run(['dpkg-deb', '-f', package]).stdout.decode().splitlines()
    return dict(line.split(': ', 1) for line in lines if ': ' in line and not line.startswith(' '))


def make_packages(where):
    """Both packages, made by cpack and unpacked into one root that holds nothing else."""
    done('cpack', '--config', BUILD / 'CPackConfig.cmake', '-G', 'DEB', '-B', where / 'packages')
    packages = {path.name.split('_')[0]: path for path in (where / 'packages').glob('*.deb')}
    check(sorted(packages) == ['liborbc-dev', 'orbc'], f'cpack makes a package of the program and one for developers: {sorted(packages)}')
    root = where / 'root'
    root.mkdir()
    program = root / 'program'
    for name, path in packages.items():
        done('dpkg-deb', '-x', path, root / ('program' if name == 'orbc' else 'development'))
    return packages, program, root / 'development'


def check_contents(packages, program, development):
    fields = fields_of(packages['orbc'])
    check('libc6' in fields['Depends'] and 'libopenmesh1' in fields['Depends'], f"the libraries it needs are found out: {fields['Depends']}")
    check('povray' in fields['Recommends'] and 'blender' in fields['Suggests'], 'POV-Ray is recommended, Blender suggested')
    for path in PROGRAM:
        check((program / 'usr' / path).is_file(), f'the program brings {path}')
    for path in DEVELOPMENT:
        check(any(development.glob(f'usr/{path}')) or any(development.glob(f'usr/lib/**/{path}')), f'the libraries bring {path}')
    strange = [path for path in program.glob('usr/*') if path.name not in ('bin', 'share')]
    check(not strange and [path.name for path in (development / 'usr/include').iterdir()] == ['orbc'], f'headers lie in include/orbc alone: {strange}')
    # Names of source files in messages of our own mistakes may stay; nothing may be looked for in the folder that orbc was built in.
    for path in sorted([*program.rglob('*'), *development.rglob('*')]):
        if path.is_file() and path.suffix != '.a':
            text = re.sub(rb'%s/(compiler|exporters)/[a-z_/]+\.(h|cpp)' % re.escape(bytes(ROOT)), b'', path.read_bytes())
            if bytes(ROOT) + b'/' in text or bytes(BUILD) + b'/' in text:
                check(False, f'{path} names the folder it was built in')
    manual = gzip.decompress((program / 'usr/share/man/man1/orbc.1.gz').read_bytes())
    check(b'.TH ORBC 1' in manual, 'the man page is the program\'s')
    check(run(['bash', '-n', program / 'usr/share/bash-completion/completions/orbc']).returncode == 0, 'bash takes the completions')
    check(b'#compdef orbc' in (program / 'usr/share/zsh/vendor-completions/_orbc').read_bytes(), 'zsh\'s completions')


def check_program(program, where):
    """The installed program, called by its name from a folder of its own."""
    away = where / 'a folder of somebody else'
    away.mkdir()
    environment = {**os.environ, 'PATH': f"{program / 'usr/bin'}:/usr/bin:/bin"}

    def orbc(*words):
        ended = run(['orbc', *words], cwd=away, env=environment)
        check(ended.returncode == 0, f"orbc {' '.join(str(word) for word in words[:3])} {ended.stderr.decode()[-300:] if ended.returncode else ''}")
        return ended.stdout

    (away / 's.yaml').write_bytes(orbc('new', '*2323'))
    orbc('check', 's.yaml')
    orbc('render', 's.yaml', '-o', 's.png', '--engine', 'povray', '--size', '160x120', '--samples', '1', '--max-bounces', '2', '--quality', 'draft')
    check(picture(away / 's.png').std() > 10, 'POV-Ray draws the starter scene')
    example = program / 'usr/share/orbc/examples/lit-pentagon/scene.yaml'
    orbc('render', example, '-o', 'lit.png', '--size', '80x60', '--samples', '1')
    check(picture(away / 'lit.png').std() > 10, 'the tracer draws an installed example')
    if shutil.which('blender'):
        orbc('render', 's.yaml', '-o', 'b.png', '--engine', 'blender', '--size', '80x60', '--samples', '1', '--max-bounces', '1', '--quality', 'draft')
        check(picture(away / 'b.png').std() > 10, 'Blender draws the starter scene')
    # The program finds its scripts when it is called through a link, too.
    (away / 'link').symlink_to(program / 'usr/bin/orbc')
    ended = run(['./link', 'render', 's.yaml', '-o', 'l.png', '--engine', 'povray', '--size', '16x12', '--samples', '1', '--max-bounces', '0',
                 '--quality', 'draft'], cwd=away)
    check(ended.returncode == 0, f'orbc is called through a link {ended.stderr.decode()}')
    moved = where / 'moved'
    moved.mkdir()
    shutil.copy(program / 'usr/bin/orbc', moved / 'orbc')
    ended = run([moved / 'orbc', 'render', away / 's.yaml', '-o', away / 'm.png', '--engine', 'povray', '--size', '16x12', '--samples', '1',
                 '--max-bounces', '0', '--quality', 'draft'])
    check(ended.returncode == 3 and b'share/orbc' in ended.stderr and not (away / 'm.png').exists(), 'without its share/orbc it says what is missing')


def check_prefix(where):
    """cmake --install into another prefix, below a DESTDIR."""
    ended = run(['cmake', '--install', BUILD, '--prefix', '/opt/rooms'], env={**os.environ, 'DESTDIR': str(where / 'staged')})
    check(ended.returncode == 0, f'cmake --install {ended.stderr.decode()}')
    at = where / 'staged/opt/rooms'
    check((at / 'share/zsh/site-functions/_orbc').is_file() and (at / 'share/orbc/povray-pipe').is_file(), 'everything lies below DESTDIR and prefix')
    check([path.name for path in (where / 'staged').iterdir()] == ['opt'], 'and nothing beside them')
    return at


def check_consumer(prefix, where):
    """Somebody else's program by find_package(orbc); every installed header by itself."""
    at = where / 'consumer'
    done('cmake', '-S', ROOT / 'tests/package', '-B', at, '-G', 'Ninja', f'-DCMAKE_PREFIX_PATH={prefix}', '-DCMAKE_BUILD_TYPE=Release')
    done('cmake', '--build', at)
    scene = where / 'consumer.yaml'
    scene.write_text('orbc: 1\norbifold: "*22222"\ncover: {max_bounces: 2}\n')
    ended = run([at / 'consumer', scene])
    check(ended.returncode == 0 and re.match(rb'[1-9]\d+ triangles in [12] files', ended.stdout), f'a program built on it works: {ended.stdout + ended.stderr}')


def main():
    with folder() as name:
        where = pathlib.Path(name).resolve()
        packages, program, development = make_packages(where)
        check_contents(packages, program, development)
        check_program(program, where)
        check_consumer(check_prefix(where), where)
    finish()


main()
