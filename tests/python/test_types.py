#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Type checkers on the package: `mypy --strict` and pyright find nothing in it, mypy's stubtest finds each annotated name and
signature at run time, and the Python of documents and docstrings passes both checkers, that of the notebooks mypy. Exit code 77
where mypy or pyright are not installed (`pip install mypy pyright`)."""
import doctest
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python" / "koksma"
# Members of the structs are made by ctypes from _fields_, which test_structs compares with the headers; the class of the plug-in
# for Mitsuba is made in a function; functools.lru_cache wraps private functions; SciPy, which has no types, has Engine's base.
NOT_SEEN = r"""koksma\._structs\..*
koksma\.mitsuba\.KoksmaSampler.*
koksma\._library\.(Seed|_paced|core|lab)
koksma\._points\.(_evaluate_array|_generate_array|_Memory.*)
koksma\._signals\._pythons
koksma\._engine\.Engine
"""

if not all(importlib.util.find_spec(name) for name in ("mypy", "pyright")):
    print("skipped: mypy and pyright are not both installed")
    sys.exit(77)


def examples():
    """Pieces of Python in what users read, each by a name."""
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        for i, code in enumerate(re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)):
            yield f"page_{page.stem}_{i}", code
    for module in sorted(PACKAGE.glob("*.py")):
        if module.name == "mitsuba.py":  # its arrays have no type before a variant is set
            continue
        text = module.read_text(encoding="utf-8")
        for i, said in enumerate(re.findall(r'"""(.*?)"""', text, re.S)):
            lines = [example.source for example in doctest.DocTestParser().get_examples(said)]
            if lines:
                yield f"docstring_{module.stem}_{i}", "".join(lines)
    for book in sorted((ROOT / "examples" / "notebooks").glob("*.ipynb")):
        cells = json.loads(book.read_text(encoding="utf-8"))["cells"]
        code = "".join("".join(cell["source"]) + "\n" for cell in cells if cell["cell_type"] == "code")
        yield f"notebook_{book.stem}", re.sub(r"^[%!].*", "", code, flags=re.M)


class Types(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)
        subprocess.run(["cp", "-r", str(PACKAGE), str(self.folder)], check=True)
        (self.folder / "pyrightconfig.json").write_text('{"include": ["."], "exclude": ["notebook_*"], "reportUnusedExpression": "none"}')

    def check(self, *command):
        environment = {**os.environ, "PYTHONPATH": str(self.folder), "MYPYPATH": str(self.folder)}
        done = subprocess.run([sys.executable, "-m", *command], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def pyright(self):
        self.check("pyright", "-p", ".", "--pythonpath", sys.executable)

    def test_package(self):
        self.check("mypy", "--strict", "-p", "koksma")
        self.pyright()

    def test_stubtest(self):
        without = "" if importlib.util.find_spec("mitsuba") else "koksma\\.mitsuba\n"  # cannot be imported then
        (self.folder / "not_seen").write_text(NOT_SEEN + without)
        self.check("mypy.stubtest", "koksma", "--concise", "--allowlist", "not_seen", "--ignore-unused-allowlist")

    def test_examples(self):
        names = []
        for name, code in examples():
            names.append(f"{name.replace('-', '_')}.py")
            (self.folder / names[-1]).write_text(code, encoding="utf-8")
        self.assertGreaterEqual(len(names), 20)
        self.check("mypy", "--ignore-missing-imports", "--scripts-are-modules", *names)
        self.pyright()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
