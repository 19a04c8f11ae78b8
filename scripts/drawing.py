"""What povray-pipe and render_blender.py share: how a renderer is run and ended, and how its picture is handed over."""
import contextlib
import ctypes
import os
import shutil
import signal
import stat
import subprocess
import sys
import tempfile

STOPPING = {signal.SIGINT, signal.SIGTERM, signal.SIGHUP}


class Failure(Exception):
    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


class Stopped(BaseException):
    """A signal has come that ends the program."""
    def __init__(self, number):
        super().__init__(number)
        self.code = 130 if number == signal.SIGINT else 3


def print_message(text):
    """To standard error. Where that is closed or full the text is lost: messages never change what a program does."""
    data = text.encode('utf-8', 'surrogateescape')
    with contextlib.suppress(OSError):
        while data:
            data = data[os.write(2, data):]


def reserve_standard_streams():
    """Closed standard streams get a number that fails as before: no file that is opened later is taken for one."""
    for number, flags in ((0, os.O_WRONLY), (1, os.O_RDONLY), (2, os.O_RDONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, flags)


def hold_signals():
    """Signals wait from now on, but where the program is `stoppable`. Those that are ignored stay so."""
    def stop(number, _):
        signal.pthread_sigmask(signal.SIG_BLOCK, STOPPING)   # what is tidied up is not disturbed by another one
        raise Stopped(number)

    for number in STOPPING:
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, stop)
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPPING)


@contextlib.contextmanager
def stoppable():
    """A signal raises Stopped in here."""
    before = signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPPING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextlib.contextmanager
def private_folder(prefix):
    """A temporary folder, gone in the end. Makes: its path."""
    try:
        folder = tempfile.mkdtemp(prefix=prefix)
    except OSError as error:
        raise Failure(3, f'cannot make a temporary folder: {error}') from None
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def run(command, **options):
    """Runs a renderer; it ends with us, even if we are killed. Makes: its exit code, and what it said where that is a pipe."""
    prctl, parent = ctypes.CDLL(None).prctl, os.getpid()
    death_signal = 1   # PR_SET_PDEATHSIG

    def in_child():
        prctl(death_signal, signal.SIGKILL)
        if os.getppid() != parent:   # it has died before that was said
            os._exit(127)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPPING)

    options.setdefault('stdin', subprocess.DEVNULL)
    child = subprocess.Popen(command, preexec_fn=in_child, **options)   # signals are held: nobody is left behind in between
    try:
        with stoppable():
            out, err = child.communicate()
    except BaseException:
        child.kill()
        child.wait()
        raise
    return child.returncode, (out if out is not None else err or b'').decode('utf-8', 'replace')


def take_scene(path):
    """Copies the scene from standard input to `path`; an empty one is an error here, not a black picture."""
    try:
        with stoppable(), open(0, 'rb', closefd=False) as source, open(path, 'wb') as file:
            shutil.copyfileobj(source, file, 1 << 20)
            size = file.tell()
    except OSError as error:
        raise Failure(3, f'cannot copy the scene from standard input: {error.strerror}') from None
    if size == 0:
        raise Failure(1, 'the scene on standard input is empty; did the command before the pipe fail?')


def check_scene(scene):
    if not os.path.isfile(scene):
        raise Failure(1, f'no such file: {scene}')


def check_output(out, scene):
    """Says before the work what cannot be written. `out`: a name, or None for standard output; `scene`: a name, or None."""
    if out is None:
        if os.isatty(1):
            raise Failure(2, 'the picture would go to the terminal; say -o PICTURE.png')
        return
    if os.path.isdir(out):
        raise Failure(3, f'is a folder: {out}')
    if os.path.exists(out) and not os.path.isfile(out):   # a device, a named pipe
        return
    target = os.path.realpath(out)
    if not os.path.isdir(os.path.dirname(target)):
        raise Failure(3, f'no such folder: {os.path.dirname(out)}')
    if scene is not None and os.path.exists(target) and os.path.samefile(scene, target):
        raise Failure(2, f'the picture would replace the scene {scene}')
    if not os.access(target if os.path.exists(target) else os.path.dirname(target), os.W_OK):
        raise Failure(3, f'cannot write {out}: permission denied')


def deliver(picture, out):
    """Hands the picture over. `out`: a name, an open descriptor, or None for standard output."""
    if out is None or isinstance(out, int) or (os.path.exists(out) and not os.path.isfile(out)):   # not what can be replaced
        with stoppable(), open(picture, 'rb') as source, open(1 if out is None else out, 'wb', closefd=out is not None) as target:
            shutil.copyfileobj(source, target)
        return
    # First beside the target, then renamed: no half picture is ever seen under its name. A link stays, and so does an old file's mode.
    target = os.path.realpath(out)
    part = os.path.join(os.path.dirname(target), f'.orbc.{os.getpid()}.part')
    try:
        shutil.copyfile(picture, part)
        if os.path.exists(target):
            os.chmod(part, stat.S_IMODE(os.stat(target).st_mode))
        os.replace(part, target)
    finally:
        if os.path.exists(part):
            os.unlink(part)


# What a PNG needs for its pixels and their colours; the rest are dates, names and notes, with which no two pictures are the same.
KEPT_CHUNKS = (b'IHDR', b'PLTE', b'tRNS', b'gAMA', b'cHRM', b'sRGB', b'iCCP', b'sBIT', b'IDAT', b'IEND')


def strip_dates(picture):
    """Leaves the pixels of a PNG file alone: same scene, same bytes."""
    kept = picture + '.kept'
    with open(picture, 'rb') as source, open(kept, 'wb') as target:
        target.write(source.read(8))
        while True:
            head = source.read(8)
            if len(head) < 8:
                break
            length, kind = int.from_bytes(head[:4], 'big'), head[4:]
            body = source.read(length + 4)
            if kind in KEPT_CHUNKS:
                target.write(head + body)
    os.replace(kept, picture)


def main_program(name, main):
    """Runs `main` and ends the program with its exit code; every failure is told in one line. Inside Blender, which has signals of its own,
    success goes on to Blender's own end."""
    inside = 'bpy' in sys.modules
    if not inside:
        reserve_standard_streams()
        hold_signals()
    try:
        code = main()
    except SystemExit as stop:  # --help, argparse
        code = stop.code if isinstance(stop.code, int) else 2
    except Failure as failure:
        print_message(f'{name}: {failure}\n')
        code = failure.code
    except (OSError, MemoryError) as error:
        print_message(f'{name}: {error}\n')
        code = 3
    except Stopped as stopped:
        print_message(f'{name}: stopped\n')
        code = stopped.code
    if inside:
        if code:
            sys.exit(code)
        return
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError as error:
        print_message(f'{name}: cannot write standard output: {error.strerror}\n')
        code = code or 3
    os._exit(code)   # what could not be written is not tried once more
