#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The structs of python/koksma/_structs.py are those of the headers: sizes and places of all members, and limits."""
import ctypes
import os
import re
import subprocess
import sys
import tempfile
import unittest

from koksma import _library, _structs

INCLUDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "include")


class Structs(unittest.TestCase):
    def test_layouts(self):
        lines, ours = [], []
        for header, name, cls in _structs.LAYOUTS:
            ours.append(f"{name} {ctypes.sizeof(cls)}")
            lines.append(f'printf("{name} %zu\\n", sizeof({name}));')
            for field, _ in cls._fields_:
                ours.append(f"{name}.{field} {getattr(cls, field).offset}")
                lines.append(f'printf("{name}.{field} %zu\\n", offsetof({name}, {field}));')
        for _header, name, value in _structs.CONSTANTS:
            ours.append(f"{name} {value}")
            lines.append(f'printf("{name} %llu\\n", (unsigned long long){name});')
        includes = "".join(f"#include <{h if '/' in h else f'koksma/{h}'}>\n" for h in sorted({h for h, _, _ in _structs.LAYOUTS + _structs.CONSTANTS}))
        source = f"#include <limits.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <stdio.h>\n{includes}int main(void) {{ {' '.join(lines)} return 0; }}\n"
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "layouts")
            subprocess.run(["cc", "-x", "c", "-", "-I", INCLUDE, "-I", os.path.join(INCLUDE, "..", "src", "engine"), "-o", program], input=source, text=True, check=True)
            theirs = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(theirs, ours, "a struct of the headers changed: mend python/koksma/_structs.py")

    def test_julia(self):
        """examples/julia has room for the structs, and reads the value as the first member."""
        with open(os.path.join(INCLUDE, "..", "examples", "julia", "koksma.jl"), encoding="utf-8") as file:
            room = [8 * int(n) for n in re.findall(r"zeros\((?:UInt64, )?(\d+)\)", file.read())]
        self.assertEqual(len(room), 3)
        for cls, size in zip((_structs.Spec, _structs.Spec, _structs.Value), room):
            self.assertLessEqual(ctypes.sizeof(cls), size)
        self.assertEqual((_structs.Value.value.offset, _structs.Value.value.size), (0, 8))

    def test_statuses(self):
        with open(os.path.join(INCLUDE, "koksma", "status.def"), encoding="utf-8") as file:
            numbers = dict(re.findall(r"^KOKSMA_STATUS\((\w+), (\d+),", file.read(), re.M))
        names = sorted(numbers, key=lambda name: int(numbers[name]))
        self.assertEqual(len(names), len(_library._CLASSES))
        self.assertIs(_library._CLASSES[names.index("INTERRUPTED")], KeyboardInterrupt)
        self.assertIs(_library._CLASSES[names.index("MALFORMED")], _library.MalformedError)
        self.assertIs(_library._CLASSES[names.index("UNSUPPORTED")], _library.UnsupportedError)
        self.assertIs(_library._CLASSES[names.index("FORBIDDEN")], _library.ForbiddenError)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
