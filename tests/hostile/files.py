# SPDX-License-Identifier: Apache-2.0
"""What the tests of files and stores share: runs of the program that must end, within memory, with a code and one line."""
import contextlib
import os
import resource
import subprocess
import sys
import tempfile
import threading

KOKSMA = os.path.abspath(sys.argv[1])
SANITIZED = os.environ.get("KOKSMA_SANITIZED") == "1"  # tests/CMakeLists.txt: repeat little
SECONDS = 1800  # a run takes tenths of one; this finds those that never end, on machines under any load
MIB = 1 << 20
OTHER = 400  # MiB that the program and its sanitizers take beside a file


class Done:
    def __init__(self, code, out, err, mib):
        self.code, self.out, self.err, self.mib = code, out, err, mib


class Checks:
    """Counts checks, and tells which failed."""

    def __init__(self):
        self.n, self.bad = 0, 0

    def check(self, holds, text):
        self.n += 1
        if not holds:
            self.bad += 1
            print("FAILED:", text)
        return holds

    def refused(self, what, done, code, *words, most=OTHER):
        """Ended with the code and one line of UTF-8 that has the words, and took at most so many MiB."""
        if done is None:
            return self.check(False, f"{what}: did not end")
        line = done.err.decode("utf-8", "strict") if is_utf8(done.err) else repr(done.err)
        self.check(is_utf8(done.err), f"{what}: not UTF-8: {done.err!r}")
        self.check(done.mib < most, f"{what}: took {done.mib:.0f} MiB")
        return self.check(done.code == code and line.count("\n") == 1 and all(word in line for word in words),
                          f"{what}: exit code {done.code} for {code}, without {words}: {line}")

    def end(self):
        print(f"{self.n} checks, {self.bad} failed")
        sys.exit(1 if self.bad or not self.n else 0)


def each(rows, columns):
    """Every pair of a row and a column; with sanitizers each row once and each column, where there are as many rows."""
    rows, columns = list(rows), list(columns)
    for i, row in enumerate(rows):
        for column in [columns[i % len(columns)]] if SANITIZED else columns:
            yield row, column


def is_utf8(text):
    try:
        text.decode("utf-8")
        return True
    except UnicodeDecodeError:
        return False


def run(program, *arguments, cwd=None, stdin=subprocess.DEVNULL, env=None, processor=None):
    """Done, or None where it did not end. processor: seconds of processor time after which a signal ends it. wait4 tells the
    memory of this run alone."""
    limit = (lambda: resource.setrlimit(resource.RLIMIT_CPU, (processor, processor))) if processor else None
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen([program, *arguments], cwd=cwd, stdin=stdin, stdout=out, stderr=err,
                                   env=dict(os.environ, **(env or {})), preexec_fn=limit)
        timer = threading.Timer(SECONDS, process.kill)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if not timer.is_alive():
            return None
        timer.cancel()
        out.seek(0)
        err.seek(0)
        return Done(process.returncode, out.read(), err.read(), usage.ru_maxrss / 1024)


class Bench:
    """A folder with files, the program, and checks; `how` is for each run."""

    def __init__(self, program, folder, **how):
        self.program, self.folder, self.how, self.checks = program, folder, how, Checks()

    def put(self, name, data):
        with open(os.path.join(self.folder, name), "wb") as stream:
            stream.write(data if isinstance(data, bytes) else data.encode())
        return name

    def run(self, *arguments):
        return run(self.program, *arguments, cwd=self.folder, **self.how)


def koksma(*arguments):
    """A run of the program, as texts."""
    return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True, timeout=SECONDS, check=False)


@contextlib.contextmanager
def own_folder():
    """The current folder is a new one, which is removed at the end."""
    with tempfile.TemporaryDirectory(prefix="koksma-stores-") as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir("/")
