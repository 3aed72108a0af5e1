#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_inputs.py PROGRAM: what scenes, plans, models and the command line may point at.

Each place that names a file is pointed at devices, fifos without a writer, sockets, folders, links to them, sparse files
beyond the limit of the kind (src/engine/core/file_kinds.def), and sparse files within it whose first bytes are wrong. Whatever
it is, the program must end, in the memory of an ordinary run, with exit code 3 and one line that names the file and says
why. What the user names may be a pipe, which must give what the file gives, and is read up to the limit; the first signal
ends the wait for it.
"""
import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import files

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.dirname(os.path.dirname(HERE))
SPARSE = 10 << 30
# Images that are left out if they are malformed, of which `scene check` warns: exit code 1. What is refused is an error.
LEFT_OUT = ("map_Kd", "glTF image", "pbrt texture", "pbrt sky", "Mitsuba texture", "Mitsuba sky")


def limits():
    """Bytes and words of each kind; a kind without a case below is a failure."""
    with open(os.path.join(SOURCE, "src/engine/core/file_kinds.def"), encoding="utf-8") as stream:
        rows = re.findall(r'^FILE_KIND\((\w+), (\d+), "([^"]+)"\)', stream.read(), re.M)
    return {name: (int(mib) << 20, text) for name, mib, text in rows}


def put(path, value):
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(value if isinstance(value, str) else json.dumps(value))
    return path


def scene(shape=None, albedo=0.5, light=None):
    return {"image": {"width": 4, "height": 4}, "camera": {"eye": [0, 0, 5], "target": [0, 0, 0], "fov_deg": 40},
            "materials": [{"name": "m", "kind": "lambert", "albedo": albedo}],
            "shapes": [shape or {"kind": "rectangle", "centre": [0, 0, 0], "normal": [0, 0, 1], "half": [1, 1],
                                 "material": "m"}],
            "lights": [light or {"kind": "environment", "radiance": 1}]}


def plan(pattern="random", scenes=None):
    made = {"name": "p", "title": "p",
            "discrepancies": [{"patterns": [pattern], "n": [1], "measures": ["l2-star"], "trials": 1}]}
    if scenes:
        made["images"] = [{"scenes": scenes, "size": [4, 4], "patterns": ["random"], "spp": [1], "trials": 1,
                           "references": [{"name": "r", "pattern": "random", "spp": 1}]}]
    return made


def gltf(uri="square.bin", image=None):
    with open(os.path.join(SOURCE, "tests/faults/inputs/square.gltf"), encoding="utf-8") as stream:
        model = json.load(stream)
    model["buffers"][0]["uri"] = uri
    if image:
        model["images"], model["textures"] = [{"uri": image}], [{"source": 0}]
        model["materials"] = [{"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}]
        model["accessors"].append({"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"})
        model["bufferViews"].append({"buffer": 0, "byteLength": 32})
        model["meshes"][0]["primitives"][0].update({"material": 0})
        model["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2
    return model


SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3 4/4\n"


def obj(folder, name):
    put(os.path.join(folder, "model.mtl"), f"newmtl red\nKd 1 1 1\nmap_Kd {name}\n")
    return put(os.path.join(folder, "model.obj"), "mtllib model.mtl\n" + SQUARE)


def model(folder, made):
    with open(os.path.join(SOURCE, "tests/faults/inputs/square.bin"), "rb") as stream:
        data = stream.read()
    with open(os.path.join(folder, "square.bin"), "wb") as stream:
        stream.write(data)
    return put(os.path.join(folder, "model.gltf"), made)


PBRT = {"include": 'Include "%s"\n', "mesh": 'Shape "plymesh" "string filename" "%s"\n',
        "texture": 'Texture "t" "spectrum" "imagemap" "string filename" "%s"\n'
                   'Material "diffuse" "texture reflectance" "t"\nShape "sphere"\n',
        "sky": 'LightSource "infinite" "string filename" "%s"\nShape "sphere"\n'}
MITSUBA = {"include": '<include filename="%s"/>',
           "mesh": '<shape type="obj"><string name="filename" value="%s"/></shape>',
           "texture": '<shape type="sphere"><bsdf type="diffuse"><texture name="reflectance" type="bitmap">'
                      '<string name="filename" value="%s"/></texture></bsdf></shape>',
           "sky": '<emitter type="envmap"><string name="filename" value="%s"/></emitter><shape type="sphere"/>'}


def named_by_files(folder):
    """(kind, ending, what names the file, arguments): one for each way in which a file names a file."""
    def in_pbrt(what):
        return lambda name: ["scene", "check", put(os.path.join(folder, "scene.pbrt"),
                                                   'Camera "perspective"\nWorldBegin\nLightSource "point"\n' + PBRT[what] % name)]

    def in_mitsuba(what):
        return lambda name: ["scene", "check", put(os.path.join(folder, "scene.xml"), '<scene version="3.0.0">'
                                                   '<sensor type="perspective"/><emitter type="point"/>'
                                                   f'{MITSUBA[what] % name}</scene>')]

    def in_scene(**how):
        return ["scene", "check", put(os.path.join(folder, "scene.json"), scene(**how))]

    def in_plan(**how):
        return ["study", "run", put(os.path.join(folder, "plan.json"), plan(**how)), "-q", "-o", "out"]

    return [
        ("TEXTURE", ".png", "albedo", lambda name: in_scene(albedo={"image": name})),
        ("TEXTURE", ".exr", "environment", lambda name: in_scene(light={"kind": "environment", "image": name})),
        ("TEXTURE", ".pfm", "map_Kd", lambda name: ["scene", "check", obj(folder, name)]),
        ("TEXTURE", ".png", "glTF image", lambda name: ["scene", "check", model(folder, gltf(image=name))]),
        ("MESH", ".obj", "mesh", lambda name: in_scene(shape={"kind": "mesh", "file": name, "material": "m"})),
        ("MESH", ".ply", "mesh", lambda name: in_scene(shape={"kind": "mesh", "file": name, "material": "m"})),
        ("MESH", ".gltf", "mesh", lambda name: in_scene(shape={"kind": "mesh", "file": name, "material": "m"})),
        ("MESH", ".glb", "mesh", lambda name: in_scene(shape={"kind": "mesh", "file": name, "material": "m"})),
        ("MATERIALS", ".mtl", "mtllib",
         lambda name: ["scene", "check", put(os.path.join(folder, "other.obj"), f"mtllib {name}\n" + SQUARE)]),
        ("BUFFER", ".bin", "buffer", lambda name: ["scene", "check", model(folder, gltf(uri=name))]),
        ("SCENE", ".json", "scene of a plan", lambda name: in_plan(scenes=["./" + name])),
        ("MESH", ".obj", "model of a plan", lambda name: in_plan(scenes=["./" + name])),
        ("POINTS", ".txt", "pattern of a plan", lambda name: in_plan(pattern="file:" + name)),
        ("POINTS", ".npy", "pattern of a plan", lambda name: in_plan(pattern="file:" + name)),
        ("PARAMETERS", ".txt", "net of a plan", lambda name: in_plan(pattern="net-file:" + name)),
        ("PARAMETERS", ".txt", "lattice of a plan", lambda name: in_plan(pattern="lattice-file:" + name)),
        ("SCENE", ".pbrt", "pbrt include", in_pbrt("include")),
        ("MESH", ".ply", "pbrt mesh", in_pbrt("mesh")),
        ("TEXTURE", ".png", "pbrt texture", in_pbrt("texture")),
        ("TEXTURE", ".exr", "pbrt sky", in_pbrt("sky")),
        ("SCENE", ".xml", "Mitsuba include", in_mitsuba("include")),
        ("MESH", ".obj", "Mitsuba mesh", in_mitsuba("mesh")),
        ("TEXTURE", ".jpg", "Mitsuba texture", in_mitsuba("texture")),
        ("TEXTURE", ".exr", "Mitsuba sky", in_mitsuba("sky")),
    ]


def named_by_user():
    return [
        ("IMAGE", ".png", "compare", lambda name: ["compare", name, name]),
        ("IMAGE", ".exr", "reference", lambda name: ["compare", "good_4.pfm", "-r", name]),
        ("SCENE", ".json", "scene", lambda name: ["scene", "check", "./" + name]),
        ("MESH", ".obj", "model", lambda name: ["scene", "check", "./" + name]),
        ("MESH", ".glb", "model", lambda name: ["scene", "check", "./" + name]),
        ("SCENE", ".pbrt", "pbrt scene", lambda name: ["scene", "check", "./" + name]),
        ("SCENE", ".xml", "Mitsuba scene", lambda name: ["scene", "check", "./" + name]),
        ("PARAMETERS", ".txt", "radial power",
         lambda name: ["optimise", "--power", name, "-n", "4", "--steps", "1", "-q", "-o", "set.txt"]),
        ("PLAN", ".json", "plan", lambda name: ["study", "run", "-o", "q", "./" + name]),
        ("POINTS", ".csv", "points", lambda name: ["measure", name, "-m", "l2-star"]),
        ("POINTS", ".npy", "points", lambda name: ["measure", name, "-m", "l2-star"]),
    ]


class Things:
    """Makes hostile things in a folder, under names of any ending, and the words that must be said of them."""

    def __init__(self, folder):
        self.folder, self.sockets = folder, []

    def path(self, kind, ending):
        name = f"{kind}{ending}"
        if os.path.lexists(os.path.join(self.folder, name)):
            os.remove(os.path.join(self.folder, name))
        return name, os.path.join(self.folder, name)

    def device(self, ending):
        name, path = self.path("device", ending)
        os.symlink("/dev/zero", path)
        return name, "it is a device"

    def null(self, ending):
        name, path = self.path("null", ending)
        os.symlink("/dev/null", path)
        return name, "it is a device"

    def fifo(self, ending):
        name, path = self.path("fifo", ending)
        os.mkfifo(path)
        return name, "it is a pipe or socket"

    def directory(self, ending):
        name = f"directory{ending}"
        os.makedirs(os.path.join(self.folder, name), exist_ok=True)
        return name, "it is a directory"

    def socket(self, ending):
        name, path = self.path("socket", ending)
        made = socket.socket(socket.AF_UNIX)
        made.bind(path)
        self.sockets.append(made)
        return name, "it is a pipe or socket"

    def sparse(self, ending, size=SPARSE):
        name, path = self.path("sparse", ending)
        with open(path, "wb") as stream:
            stream.truncate(size)
        return name, None


def check_named_by_files(checks, program, folder, kinds):
    """All places open files by one function: each kind of thing stands at the first place of each kind of file, and at one
    place in five of the others, in turn. Long files, of which a reader must see the beginning, are made once for each reader."""
    things = Things(folder)
    seen, read = set(), set()
    makers = (things.device, things.null, things.fifo, things.socket, things.directory)
    for i, (kind, ending, what, arguments) in enumerate(named_by_files(folder)):
        most, words = kinds[kind]
        code = 1 if what in LEFT_OUT else 3
        for make in [makers[i % len(makers)]] if kind in seen else makers:
            name, reason = make(ending)
            if "include" in what and reason == "it is a device":
                reason = "not below the scene's own folder"  # where the link leads
            done = files.run(program, *arguments(name), cwd=folder)
            checks.refused(f"{what} {make.__name__}", done, 3, name, reason)
        name, _ = things.sparse(ending)
        checks.refused(f"{what} of 10 GiB", files.run(program, *arguments(name), cwd=folder), 3, name,
                       f"longer than {most >> 20} MiB, the limit of {words}")
        if kind != "BUFFER":  # whose bytes are numbers, that the rest of the model needs
            # A plan's points are hashed whole before they are read: 8 GiB, which check_named_by_user has for the readers.
            name, _ = things.sparse(ending, files.MIB if (kind, ending) in read or kind == "POINTS" else most)
            checks.refused(f"{what} of zeros up to the limit", files.run(program, *arguments(name), cwd=folder), code,
                           name)
        seen.add(kind)
        read.add((kind, ending))
        if kind == "TEXTURE":
            name = put(os.path.join(folder, "wide" + ending), "Pf\n8193 8193\n-1\n")
            checks.refused(f"{what} of 8193 x 8193", files.run(program, *arguments(os.path.basename(name)), cwd=folder), 3,
                           os.path.basename(name), "at most 67108864")
    for made in things.sockets:
        made.close()
    return seen


def feed(path, data, endless=False):
    """Writes into a fifo as soon as a reader is there."""
    def write():
        try:
            with open(path, "wb", buffering=0) as stream:
                stream.write(data)
                while endless:
                    stream.write(data)
        except BrokenPipeError:
            pass
    thread = threading.Thread(target=write, daemon=True)
    thread.start()
    return thread


def check_named_by_user(checks, program, folder, kinds):
    things = Things(folder)
    seen = set()
    files.run(program, "render", "ball", "-n", "1", "--size", "4x4", "-q", "-o", "good_1.pfm", cwd=folder)
    for kind, ending, what, arguments in named_by_user():
        most, words = kinds[kind]
        seen.add(kind)
        for make in (things.device, things.null):
            name, reason = make(ending)
            checks.refused(f"{what} {make.__name__}", files.run(program, *arguments(name), cwd=folder), 3, name, reason)
        name, _ = things.sparse(ending)
        checks.refused(f"{what} of 10 GiB", files.run(program, *arguments(name), cwd=folder), 3, name,
                       f"longer than {most >> 20} MiB, the limit of {words}")
        name, _ = things.sparse(ending, most)
        checks.refused(f"{what} of zeros up to the limit", files.run(program, *arguments(name), cwd=folder), 3, name)
        name, _ = things.fifo(ending)
        thread = feed(os.path.join(folder, name), bytes(1 << 16), endless=True)
        checks.refused(f"{what}: endless zeros in a fifo", files.run(program, *arguments(name), cwd=folder), 3, name)
        thread.join(files.SECONDS)
        checks.check(not thread.is_alive(), f"{what}: the fifo was not read")
    return seen


def is_waiting(process):
    """Whether the process has slept through three tenths of a second without using a processor, or has ended."""
    seen = set()
    for _ in range(4):
        with open(f"/proc/{process.pid}/stat", encoding="utf-8") as stream:
            fields = stream.read().rpartition(")")[2].split()
        seen.add((fields[0], fields[11], fields[12]))
        if process.poll() is not None:
            return True
        time.sleep(0.1)
    return len(seen) == 1 and fields[0] == "S"


def check_signals(checks, program, folder):
    """The first SIGINT or SIGTERM ends a command that waits for a fifo's writer, for more from it, or for standard input."""
    ways = [(what, ending, arguments) for _, ending, what, arguments in named_by_user()]
    ways += [("optimise --from", ".txt", lambda name: ["optimise", "star", "--from", name, "--steps", "1", "-o", "best.txt"]),
             ("verify", ".txt", lambda name: ["verify", name]), ("plot", ".txt", lambda name: ["plot", name, "-o", "p.svg"]),
             ("curve", ".txt", lambda name: ["curve", "rings", name]), ("integrate", ".txt", lambda name: ["integrate", "disk", name])]
    started = []
    for i, (what, ending, arguments) in enumerate(ways):
        hows = ["no writer", "a writer"] + ["standard input"] * (ending == ".txt")  # scenes and plans take none
        for k, how in enumerate(hows):
            if what != "verify" and k != i % len(hows):
                continue
            fifo = os.path.join(folder, f"waiting{len(started)}{ending}")
            os.mkfifo(fifo)
            writer = os.open(fifo, os.O_RDWR) if how == "a writer" else None
            name = "-" if how == "standard input" else os.path.basename(fifo)
            started.append((what, how, writer, (signal.SIGTERM, signal.SIGINT)[i // 2 % 2], subprocess.Popen(
                [program, *arguments(name)], cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)))
    for what, how, writer, number, process in started:  # all wait at once
        while not is_waiting(process):
            pass
        process.send_signal(number)
        try:
            code = process.wait(files.SECONDS / 10)
        except subprocess.TimeoutExpired:
            code = "none"
            process.kill()
        checks.check(code in (130, -number), f"{what}, {how}: exit code {code} after signal {number}: {process.stderr.read()}")
        process.communicate()
        if writer is not None:
            os.close(writer)


def check_pipes(checks, program, folder):
    """What the user names may be a pipe, and gives what the file gives."""
    put(os.path.join(folder, "p.txt"), "0.5 0.25\n0.75 0.5\n")
    put(os.path.join(folder, "s.json"), scene())
    put(os.path.join(folder, "q.json"), plan())
    put(os.path.join(folder, "m.obj"), SQUARE)
    files.run(program, "render", "ball", "-n", "1", "--size", "4x4", "-q", "-o", "i.pfm", cwd=folder)
    ways = [("p.txt", ["measure", "%", "-m", "l2-star"]), ("s.json", ["scene", "check", "%"]),
            ("m.obj", ["scene", "check", "%"]), ("i.pfm", ["compare", "i.pfm", "%"]),
            ("i.pfm", ["compare", "%", "i.pfm"])]
    for name, arguments in ways:
        with open(os.path.join(folder, name), "rb") as stream:
            data = stream.read()
        good = files.run(program, *[word.replace("%", "./" + name) for word in arguments], cwd=folder)
        fifo = "pipe" + os.path.splitext(name)[1]
        os.mkfifo(os.path.join(folder, fifo))
        thread = feed(os.path.join(folder, fifo), data)
        done = files.run(program, *[word.replace("%", "./" + fifo) for word in arguments], cwd=folder)
        thread.join(files.SECONDS)
        os.remove(os.path.join(folder, fifo))
        checks.check(done and done.code == good.code < 2 and done.out.replace(fifo.encode(), name.encode()).split() ==
                     good.out.split(), f"{arguments}: a fifo gives something else: {done and (done.out, done.err)}")
    for way in ("-", "/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"):
        for data, how in ((b"0.5 0.25\n0.75 0.5\n", "pipe"), (b"", "file")):
            stdin = subprocess.PIPE
            if how == "file":
                stdin = open(os.path.join(folder, "p.txt"), "rb")  # pylint: disable=consider-using-with
            done = subprocess.run([program, "measure", way, "-m", "l2-star", "--json"], stdin=None if how == "pipe" else stdin,
                                  input=data if how == "pipe" else None, capture_output=True, cwd=folder, check=False,
                                  timeout=files.SECONDS)
            checks.check(done.returncode == 0 and b'"n":2' in done.stdout, f"measure {way} of a {how}: {done}")
            if how == "file":
                stdin.close()
    done = files.run(program, "measure", "-", "-m", "l2-star", cwd=folder, stdin=open("/dev/zero", "rb"))
    checks.refused("endless standard input", done, 3, "standard input")
    done = files.run(program, "compare", "-", "i.pfm", cwd=folder, stdin=open("/dev/zero", "rb"))
    checks.refused("endless standard input as an image", done, 3, "standard input")
    put(os.path.join(folder, "dash.json"), scene(albedo={"image": "-"}))
    done = files.run(program, "scene", "check", "dash.json", cwd=folder, stdin=open("/dev/zero", "rb"))
    checks.refused("a scene that names '-'", done, 3, "-: can't be read: No such file")


def main():
    program = os.path.abspath(sys.argv[1])
    checks, kinds = files.Checks(), limits()
    with tempfile.TemporaryDirectory() as folder:
        seen = check_named_by_files(checks, program, folder, kinds)
        seen |= check_named_by_user(checks, program, folder, kinds)
        check_pipes(checks, program, folder)
        check_signals(checks, program, folder)
    with open(os.path.join(SOURCE, "docs/files.md"), encoding="utf-8") as stream:
        rows = re.findall(r"^\| ([^|]+) \| (\d+) MiB \|", stream.read(), re.M)
    checks.check({(text, int(mib) << 20) for text, mib in rows} == {(text, most) for most, text in kinds.values()},
                 f"docs/files.md has another table: {rows}")
    with open(os.path.join(SOURCE, "SECURITY.md"), encoding="utf-8") as stream:
        table = re.search(r"## Files from outside\n(.*?)\nLimits", stream.read(), re.S)[1]
    for _, text in kinds.values():  # its table joins kinds: their first words are there
        word = re.split(r"[ ,]", text.replace("files of ", ""))[0]
        checks.check(word in table, f"SECURITY.md does not name {text}")
    checks.check(seen == set(kinds), f"kinds of file without a case: {set(kinds) - seen}")
    checks.end()


if __name__ == "__main__":
    main()
