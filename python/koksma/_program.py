# SPDX-License-Identifier: Apache-2.0
"""The `koksma` command of an installed wheel: the C program, which lies beside the libraries in the package."""
import os
import subprocess
import sys
from pathlib import Path


def main() -> None:
    """Replaces this process by the program, with its arguments; the exit code is the program's."""
    windows = os.name == "nt"
    program = Path(__file__).parent / "lib" / ("koksma.exe" if windows else "koksma")
    if sys.executable:  # `koksma rank --with mitsuba` runs the interpreter that has this package
        os.environ.setdefault("KOKSMA_PYTHON", sys.executable)
    try:
        if windows:  # where execv returns to the shell at once
            sys.exit(subprocess.call([program, *sys.argv[1:]]))
        os.execv(program, ["koksma", *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"koksma: {program}: {error.strerror}; reinstall the package")
