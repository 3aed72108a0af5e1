#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""misuse.py INCLUDE LIBKOKSMA LIBKOKSMA-LAB: calls every function that the headers declare with nothing, in processes of their own.

All arguments are NULL and 0; then each pointer alone is NULL and the others lead to zeros, with numbers that are 0, negative and
huge. No call crashes or takes long. With NULL for everything a function that returns a status refuses, in a line that names an
argument, and one that returns a pointer returns none. Argument by argument the values are in tests/api/test_arguments.c,
test_descriptors.c and tests/python/test_wrong_arguments.py.
"""
import ctypes
import glob
import os
import re
import signal
import sys

INCLUDE, *LIBRARIES = sys.argv[1:]
# Functions that take nothing for an answer: of an error's text, and what NULL leaves as it is.
TAKES_NULL = {"koksma_study_close"}
OPAQUE = r"(const )?koksma_(scene|integral|study) \*\w"  # the library alone makes these: they are NULL
NUMBERS = (0, -1, 1 << 62)
SECONDS = 60


class Struct(ctypes.Structure):
    """What comes back in memory, of any size."""
    _fields_ = [("bytes", ctypes.c_char * 4096)]


def declared():
    """(result, name, types of the parameters) of each function."""
    for path in sorted(glob.glob(os.path.join(INCLUDE, "koksma", "*.h"))):
        with open(path, encoding="utf-8") as file:
            text = re.sub(r"/\*.*?\*/|^#.*?(?<!\\)$", "", file.read(), flags=re.S | re.M)
        for result, name, parameters in re.findall(r"KOKSMA_API ([^;(]*?)\b(koksma_\w+)\(([^;]*)\);", text):
            parameters = re.sub(r"\(\*\w+\)\([^)]*\)", "*f", " ".join(parameters.split()))
            yield result.strip(), name, [] if parameters == "void" else [p.strip() for p in parameters.split(",")]


def argument(parameter, number, zeros):
    if re.match(OPAQUE, parameter):
        return ctypes.c_void_p(None)
    if "*" in parameter or "[" in parameter or re.match(r"koksma_(name_at|values_of) ", parameter):
        return ctypes.c_void_p(zeros)
    if re.match(r"(double|float) ", parameter):
        return ctypes.c_double(number) if parameter.startswith("double") else ctypes.c_float(number)
    return ctypes.c_int64(number)


def call(libraries, result, name, arguments):
    """In this process, which then ends: 0, or 1 and a line of what is wrong."""
    function = next(getattr(library, name) for library in libraries if hasattr(library, name))
    function.restype = (ctypes.c_void_p if "*" in result else None if result == "void" else ctypes.c_int
                        if result == "koksma_status" or not result.startswith("koksma_") else Struct)
    answer = function(*arguments)
    if all(a.value in (None, 0) for a in arguments) and arguments and name not in TAKES_NULL:
        text = libraries[0].koksma_error_text().decode()
        if result == "koksma_status" and (not answer or not re.match(r"[^\n]{8,}$", text)):
            print(f"{name}(NULL, ..) returns {answer}: '{text}'", flush=True)
            os._exit(1)
        if "*" in result and "const char" not in result and answer and not name.endswith(("_at", "_default")):
            print(f"{name}(NULL, ..) returns a pointer", flush=True)
            os._exit(1)
    os._exit(0)


def main():
    libraries = [ctypes.CDLL(path) for path in LIBRARIES]
    libraries[0].koksma_error_text.restype = ctypes.c_char_p
    room = ctypes.create_string_buffer(1 << 16)
    functions, calls, bad = list(declared()), 0, 0
    for result, name, parameters in functions:
        pointers = [i for i, p in enumerate(parameters) if "*" in p]
        ways = [[argument(p, 0, None) for p in parameters]]
        ways += [[argument(p, number, None if i == null else ctypes.addressof(room)) for i, p in enumerate(parameters)]
                 for number in NUMBERS for null in [*pointers, None]]
        for k, arguments in enumerate(ways):
            calls += 1
            child = os.fork()
            if not child:
                signal.alarm(SECONDS)
                null = os.open(os.devnull, os.O_RDWR)
                os.dup2(null, 0)
                os.dup2(null, 2)
                call(libraries, result, name, arguments)
            status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
            if status:
                bad += 1
                print(f"{name}: way {k}: {[a.value for a in arguments]}: {status}", flush=True)
    print(f"{calls} calls of {len(functions)} functions, {bad} wrong")
    return bad > 0 or len(functions) < 150


sys.exit(main())
