# SPDX-License-Identifier: Apache-2.0
"""What the tests of attacks on stores share: the program, whose path is their first argument, and the problems found."""
import contextlib
import os
import subprocess
import sys
import tempfile

KOKSMA = os.path.abspath(sys.argv[1])
problems = 0


def check(right, what):
    global problems
    if not right:
        problems += 1
        print("wrong:", what)


def koksma(*arguments, prefix=()):
    return subprocess.run([*prefix, KOKSMA, *arguments], capture_output=True, text=True, timeout=1800)


@contextlib.contextmanager
def own_folder():
    """The current folder is a new one, which is removed at the end."""
    with tempfile.TemporaryDirectory(prefix="koksma-stores-") as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir("/")


def end():
    print(f"{problems} problems")
    sys.exit(problems > 0)
