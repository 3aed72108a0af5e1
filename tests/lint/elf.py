#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""elf.py COMPILER DIR...: what cmake/hardening.cmake asks for is in every program and shared library below the folders.

readelf says of each file: no executable stack, no segment both writable and executable, addresses read-only after the start
and all of them bound then, a program at a random address, no text relocations, and no list of library folders with a part
that depends on the current folder. The program and the two libraries must call the stack protector and checked functions of
the C library, too; a small test program may have nothing to protect. The objects in static libraries for x86-64 mark the
targets of branches; what is linked of them is marked where the system's own objects are, which Debian 12's are not.
First a program is built that does everything wrong: every rule must object to it. Exit code 1: a file breaks a rule.
"""
import os
import re
import subprocess
import sys
import tempfile


def readelf(path):
    """What readelf prints of a file's header, segments, dynamic section, notes and dynamic symbols."""
    environment = dict(os.environ, LC_ALL="C")
    return subprocess.run(["readelf", "-W", "-h", "-l", "-d", "-n", "--dyn-syms", path], capture_output=True, text=True,
                          check=True, env=environment).stdout


def problems_of(path, whole):
    """The rules that a file breaks; `whole`: it has so much code that all rules hold for it."""
    text = readelf(path)
    program = re.search(r"^\s+INTERP\s", text, re.M)
    segments = re.findall(r"^\s+(\w+)\s+0x\S+ 0x\S+ 0x\S+ 0x\S+ 0x\S+ (.{3}) ", text, re.M)
    folders = re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", text)
    symbols = set(re.findall(r" UND (\w+)", text))
    rules = {
        "its stack is executable": ("GNU_STACK", "RW ") not in segments,
        "a segment is writable and executable": any("W" in flags and "E" in flags for _, flags in segments),
        "no segment is read-only after relocation": not any(kind == "GNU_RELRO" for kind, _ in segments),
        "functions are bound at their first call": not re.search(r"\(FLAGS(_1)?\).*\b(BIND_)?NOW\b", text),
        "it is a program at a fixed address": program and not re.search(r"\(FLAGS_1\).*\bPIE\b", text),
        "its code is relocated": "(TEXTREL)" in text,
        f"libraries are looked for in the current folder: {folders}":
            any(not re.match(r"/|\$ORIGIN(/|$)", part) for folder in folders for part in folder.split(":")),
    }
    if whole:
        rules["no function has a stack protector"] = "__stack_chk_fail" not in symbols
        rules["no call is checked by the C library"] = not any(re.fullmatch(r"__\w+_chk", name) for name in symbols)
    return [rule for rule, broken in rules.items() if broken], len(rules)


def is_linked_elf(path):
    """Whether a file is an ELF program or shared library, not an object file."""
    with open(path, "rb") as file:
        head = file.read(18)
    order = "little" if head[5:6] == b"\1" else "big"
    return head[:4] == b"\x7fELF" and int.from_bytes(head[16:18], order) in (2, 3)


def unmarked(path):
    """The objects of a static library for x86-64 whose targets of branches are not marked."""
    text = subprocess.run(["readelf", "-W", "-h", "-n", path], capture_output=True, text=True,
                          check=True, env=dict(os.environ, LC_ALL="C")).stdout
    objects = re.split(r"^File: ", text, flags=re.M)[1:]
    return [o.split("\n")[0] for o in objects if "X86-64" in o and not re.search(r"x86 feature: .*IBT.*SHSTK", o)]


def check_rules(compiler):
    """Ends the lint if a rule accepts a program that breaks it."""
    with tempfile.TemporaryDirectory() as folder:
        source, program = os.path.join(folder, "bad.c"), os.path.join(folder, "bad")
        with open(source, "w", encoding="ascii") as file:
            file.write("int main(void) { return 0; }\n")
        flags = ["-fno-stack-protector", "-no-pie", "-Wl,-z,execstack,-z,norelro,-z,lazy", "-Wl,-rpath,/usr/lib:"]
        subprocess.run([compiler, *flags, source, "-o", program], check=True, stderr=subprocess.DEVNULL)
        found, rules = problems_of(program, True)
        accepted = rules - len(found)
        if accepted > 1:  # a program of this size has no text relocations
            sys.exit(f"elf.py: {accepted} rules accept a program that breaks them; these object: {found}")


check_rules(sys.argv[1])
files = sorted(os.path.join(folder, name) for top in sys.argv[2:] for folder, _, names in os.walk(top)
               if "CMakeFiles" not in folder for name in names if not os.path.islink(os.path.join(folder, name)))
archives = [path for path in files if path.endswith(".a")]
files = [path for path in files if is_linked_elf(path)]
code = 0
for path in archives:
    for problem in unmarked(path):
        print(f"{problem}: targets of branches are not marked")
        code = 1
for path in files:
    whole = re.fullmatch(r"koksma|libkoksma(-lab)?\.so\..*", os.path.basename(path))
    for problem in problems_of(path, whole)[0]:
        print(f"{path}: {problem}")
        code = 1
if not files:
    sys.exit(f"elf.py: no program or library below {sys.argv[2:]}")
print(f"{len(files)} programs and libraries")
sys.exit(code)
