# SPDX-License-Identifier: Apache-2.0
"""What a program writes to a terminal, for the tests of tables and bars: the program gets one end of a pseudo terminal."""
import fcntl
import os
import pty
import struct
import subprocess
import termios
import threading


def shown(command, width=80, environment=None, stdout=None, stderr=subprocess.DEVNULL):
    """Runs a command, and returns what it wrote to a terminal of a width, and its exit code. Its stdout is the terminal unless
    it is given; its stderr when it is subprocess.STDOUT or, with stdout elsewhere, always."""
    text = b""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=slave if stdout is None else stdout,
                          stderr=stderr if stdout is None else slave, env=environment) as process:
        # What was written last may be lost where the last writer closes the terminal while it is being read: so this end stays
        # open, and a byte that no program here writes follows the rest.
        threading.Thread(target=lambda: (process.wait(), os.write(slave, b"\0"))).start()
        while not text.endswith(b"\0"):
            text += os.read(master, 1 << 16)
    os.close(slave)
    os.close(master)
    return text[:-1].decode().replace("\r\n", "\n"), process.returncode
