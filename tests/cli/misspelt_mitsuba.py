#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""misspelt_mitsuba.py KOKSMA mitsuba.c: whatever is misspelt in a scene of Mitsuba is named. The scenes below, in which all
plug-ins and parameters occur that mitsuba.c reads without a loss, pass `scene check --unknown refuse`. In each of 80
drawn copies one name (an element's, an attribute's, a parameter's, a type's, an id's) has a letter dropped, doubled, swapped
or changed: each is refused; and where approximation is allowed, the scene either is in error or has a warning with the line
of that name. Exit code 77: the program reads no XML."""
import os
import random
import re
import string
import subprocess
import sys
import tempfile

KOKSMA, SOURCE = sys.argv[1:]
SEED, DRAWS = 20261128, 80
# Parameters that are read, but never without a warning.
LOSSY = set("""base_color roughness metallic eta spec_trans alpha_u alpha_v diffuse_reflectance texture
 crop_width crop_height crop_offset_x crop_offset_y temperature p0 p1""".split())

MODERN = """<?xml version="1.0"?>
<scene version="3.0.0">
<default name="side" value="3"/>
<path value="."/>
<include filename="more.xml"/>
<integrator type="path">
<integer name="max_depth" value="9"/>
<integer name="rr_depth" value="5"/>
<boolean name="hide_emitters" value="true"/>
<boolean name="strict_normals" value="false"/>
</integrator>
<sensor type="thinlens">
<float name="fov" value="40"/>
<string name="fov_axis" value="larger"/>
<float name="aperture_radius" value="0.1"/>
<float name="focus_distance" value="6"/>
<float name="near_clip" value="0.1"/>
<float name="far_clip" value="1000"/>
<float name="shutter_open" value="0"/>
<float name="shutter_close" value="0"/>
<transform name="to_world"><lookat origin="0, 2, 6" target="0, 1, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm">
<integer name="width" value="8"/>
<integer name="height" value="6"/>
<string name="pixel_format" value="rgb"/>
<string name="file_format" value="openexr"/>
<string name="component_format" value="float32"/>
<boolean name="sample_border" value="false"/>
<rfilter type="gaussian"><float name="stddev" value="0.4"/></rfilter>
</film>
<sampler type="independent"><integer name="sample_count" value="4"/><integer name="seed" value="1"/></sampler>
</sensor>
<bsdf type="diffuse" id="stone"><rgb name="reflectance" value="0.5, 0.4, 0.3"/></bsdf>
<alias id="stone" as="grey"/>
<bsdf type="twosided" id="checks"><bsdf type="diffuse">
<texture name="reflectance" type="checkerboard">
<rgb name="color0" value="0.1, 0.2, 0.3"/>
<float name="color1" value="0.5"/>
<transform name="to_uv"><scale x="4" y="4"/></transform>
</texture>
</bsdf></bsdf>
<shape type="rectangle">
<transform name="to_world">
<scale value="$side"/>
<rotate x="1" angle="-90"/>
<translate x="0" y="0.5"/>
</transform>
<ref id="checks"/>
</shape>
<shape type="sphere">
<point name="center" x="0" y="1" z="0"/>
<float name="radius" value="0.5"/>
<boolean name="flip_normals" value="false"/>
<bsdf type="roughconductor">
<string name="distribution" value="ggx"/>
<float name="alpha" value="0.25"/>
<spectrum name="eta" value="400:1.5, 700:1.6"/>
<rgb name="k" value="4 4 4"/>
<rgb name="specular_reflectance" value="0.9"/>
</bsdf>
</shape>
<shape type="sphere"><point name="center" value="2, 1, 0"/><bsdf type="conductor"><string name="material" value="Au"/></bsdf></shape>
<shape type="disk">
<transform name="to_world"><rotate value="0, 1, 0" angle="30"/></transform>
<bsdf type="dielectric"><string name="int_ior" value="water"/><float name="ext_ior" value="1"/></bsdf>
</shape>
<shape type="cube">
<transform name="to_world"><matrix value="0.2 0 0 -3 0 0.2 0 1 0 0 0.2 0 0 0 0 1"/></transform>
<bsdf type="roughdielectric">
<string name="distribution" value="ggx"/>
<float name="alpha" value="0.2"/>
<float name="specular_transmittance" value="1"/>
</bsdf>
</shape>
<shape type="shapegroup" id="group">
<shape type="obj"><string name="filename" value="a.obj"/><boolean name="face_normals" value="true"/><ref id="grey"/></shape>
</shape>
<shape type="instance"><ref id="group"/><transform name="to_world"><translate value="1, 0, 0"/></transform></shape>
<shape type="ply"><string name="filename" value="a.ply"/><boolean name="flip_tex_coords" value="true"/><bsdf type="twosided"><bsdf type="diffuse">
<texture name="reflectance" type="bitmap">
<string name="filename" value="white.pfm"/>
<string name="filter_type" value="nearest"/>
<string name="wrap_mode" value="mirror"/>
<boolean name="raw" value="true"/>
</texture>
</bsdf></bsdf></shape>
<shape type="rectangle">
<emitter type="area"><spectrum name="radiance" value="4"/></emitter>
</shape>
<emitter type="point">
<point name="position" x="0" y="5" z="0"/>
<rgb name="intensity" value="10, 10, 10"/>
<float name="sampling_weight" value="2"/>
</emitter>
<emitter type="spot">
<transform name="to_world"><lookat origin="0, 4, 0" target="0, 0, 0" up="0, 0, 1"/></transform>
<float name="cutoff_angle" value="30"/>
<float name="beam_width" value="20"/>
<spectrum name="intensity" value="400:1, 500:2, 700:1"/>
</emitter>
<emitter type="directional"><vector name="direction" x="0" y="-1" z="0"/><rgb name="irradiance" value="1"/></emitter>
<emitter type="envmap"><string name="filename" value="white.pfm"/><float name="scale" value="2"/></emitter>
</scene>
"""

SPECTRA = """<scene version="3.0.0">
<integrator type="direct"><integer name="emitter_samples" value="1"/><integer name="bsdf_samples" value="1"/></integrator>
<sensor type="perspective"><float name="fov" value="50"/><sampler type="stratified"><boolean name="jitter" value="true"/></sampler></sensor>
<medium type="homogeneous" id="unused"><float name="sigma_t" value="1"/><boolean name="sample_emitters" value="true"/></medium>
<texture type="checkerboard" id="unused too"><float name="color0" value="0.3"/></texture>
<spectrum type="d65" id="day"><float name="scale" value="3"/></spectrum>
<emitter type="point"><ref id="day" name="intensity"/></emitter>
<emitter type="point"><spectrum name="intensity" type="d65"><rgb name="color" value="0.1 0.2 0.3"/></spectrum></emitter>
<emitter type="point">
<spectrum name="intensity" type="d65"><spectrum type="srgb"><rgb name="color" value="1"/><boolean name="unbounded" value="true"/></spectrum></spectrum>
</emitter>
<emitter type="point">
<spectrum name="intensity" type="regular">
<float name="wavelength_min" value="400"/>
<float name="wavelength_max" value="700"/>
<string name="values" value="0.1, 0.2, 0.3"/>
</spectrum>
</emitter>
<shape type="sphere"><bsdf type="diffuse">
<spectrum name="reflectance" type="irregular">
<string name="wavelengths" value="400, 500, 700"/>
<string name="values" value="0.1, 0.2, 0.3"/>
</spectrum>
</bsdf></shape>
<shape type="sphere"><bsdf type="diffuse">
<spectrum name="reflectance" type="uniform"><float name="value" value="0.3"/></spectrum>
</bsdf></shape>
<shape type="rectangle"><bsdf type="null"/></shape>
</scene>
"""

FOG = """<scene version="3.0.0">
<integrator type="volpath"><integer name="max_depth" value="-1"/></integrator>
<sensor type="orthographic">
<transform name="to_world"><scale value="2"/><lookat target="0, 0, 0" origin="0, 0, 5"/></transform>
<ref id="haze"/>
</sensor>
<medium type="homogeneous" id="haze">
<rgb name="albedo" value="0.5, 0.2, 1"/>
<volume name="sigma_t" type="constvolume"><rgb name="value" value="0.01"/></volume>
<float name="scale" value="2"/>
<phase type="hg"><float name="g" value="0.6"/></phase>
</medium>
<shape type="cube">
<transform name="to_world"><scale value="9"/></transform>
<bsdf type="null"/>
<ref name="interior" id="haze"/>
</shape>
<emitter type="constant"><rgb name="radiance" value="0.3"/></emitter>
</scene>
"""

OLDER = """<scene version="0.6.0">
<integrator type="path"><integer name="maxDepth" value="9"/><boolean name="hideEmitters" value="false"/></integrator>
<sensor type="perspective">
<string name="focalLength" value="50mm"/>
<transform name="toWorld"><lookAt origin="0, 2, 6" target="0, 1, 0" up="0, 1, 0"/></transform>
<film type="ldrfilm"><integer name="width" value="8"/><integer name="height" value="6"/><boolean name="banner" value="false"/></film>
</sensor>
<shape type="cube">
<transform name="toWorld"><scale x="1" y="2" z="3"/></transform>
<bsdf type="null"/>
<medium name="interior" type="homogeneous">
<rgb name="sigmaS" value="0.1, 0.1, 0.1"/>
<spectrum name="sigmaA" value="0.2"/>
<phase type="hg"><float name="g" value="-0.2"/></phase>
</medium>
</shape>
<shape type="serialized">
<string name="filename" value="a.serialized"/>
<integer name="shapeIndex" value="0"/>
<bsdf type="diffuse"><srgb name="diffuseReflectance" value="#ff8000"/></bsdf>
</shape>
<shape type="rectangle"><bsdf type="diffuse">
<texture name="reflectance" type="checkerboard">
<float name="uscale" value="8"/>
<float name="vscale" value="8"/>
<float name="uoffset" value="0"/>
<float name="voffset" value="0"/>
</texture>
</bsdf></shape>
</scene>
"""
SCENES = {"modern.xml": MODERN, "spectra.xml": SPECTRA, "fog.xml": FOG, "older.xml": OLDER}
OTHERS = {"more.xml": '<scene version="3.0.0"><shape type="sphere"/></scene>',
          "a.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
          "a.ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float s\n"
                   "property float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
          "white.pfm": b"PF\n1 1\n-1\n" + b"\0\0\x80\x3f" * 3}


def serialized():
    """A triangle of version 3, doubles without normals or texture coordinates."""
    import struct
    import zlib
    corners = (0, 0, 0, 1, 0, 0, 0, 1, 0)
    data = struct.pack("<IQQ9d3I", 0x2000, 3, 1, *corners, 0, 1, 2)
    stream = struct.pack("<HH", 0x041C, 3) + zlib.compress(data)
    return stream + struct.pack("<2I", 0, 1)


def write(name, data):
    with open(name, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())


def check(name, text, *options):
    write(name, text)
    return subprocess.run([KOKSMA, "scene", "check", name, *options], capture_output=True, text=True, check=False)


def names_in(text):
    """The place of each name: of elements, of attributes, and of parameters, types, ids and references."""
    spans = []
    for element in re.finditer(r"<([a-zA-Z]\w*)((?:\s+\w+=\"[^\"]*\")*)\s*/?>", text):
        spans.append(element.span(1))
        for attribute in re.finditer(r"(\w+)=\"([^\"]*)\"", element[2]):
            at = element.start(2)
            spans.append((at + attribute.start(1), at + attribute.end(1)))
            if attribute[1] in ("name", "type", "id", "as", "filename"):
                spans.append((at + attribute.start(2), at + attribute.end(2)))
    return spans


def misspell(word, rng):
    at = rng.randrange(len(word))
    return rng.choice([word[:at] + word[at + 1:], word[:at] + word[at] + word[at:],
                       word[:at] + word[at + 1:at + 2] + word[at] + word[at + 2:],
                       word[:at] + rng.choice(string.ascii_lowercase) + word[at + 1:]])


def draw(text, rng):
    """A text in which one name is misspelt, the line, and both words. A closing tag is misspelt as its element is."""
    start, end = rng.choice(names_in(text))
    word = text[start:end]
    bad = misspell(word, rng)
    if not bad or bad in (word, "rgb") or word.startswith("unused") or (word in "xyz" and bad in "xyz"):  # another name, or no effect
        return draw(text, rng)
    changed = text[:start] + bad + text[end:]
    if text[start - 1] == "<" and text[end:text.index(">", end)][-1:] != "/":
        depth, at = 1, end
        for tag in re.finditer(rf"<(/?){word}\b[^>]*?(/?)>", text[end:]):
            depth += -1 if tag[1] else 0 if tag[2] else 1
            if not depth:
                at = end + tag.start() + 2
                break
        shift = len(bad) - len(word)
        changed = changed[:at + shift] + bad + changed[at + shift + len(word):]
    return changed, text[:start].count("\n") + 1, word, bad


def read_names():
    """The names of parameters that mitsuba.c looks up, and the types of its tables."""
    with open(SOURCE, encoding="utf-8") as file:
        source = file.read()
    calls = r"(?:property|text|choice|number|flag|point|transform|needed|colour|colour_for|index_of|constant|medium_colour)\(r, \w+, \"(\w+)\""
    names = set(re.findall(calls, source))
    return {name for name in names if name not in LOSSY and not name.startswith("lambda")}


def main():
    rng = random.Random(SEED)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, data in {**OTHERS, "a.serialized": serialized()}.items():
            write(name, data)
        every = "".join(SCENES.values())
        camel = {re.sub("([A-Z])", lambda m: "_" + m[1].lower(), name) for name in re.findall(r'name="(\w+)"', every)}
        missing = {name for name in read_names() if name not in camel}
        wrong = [f"parameters that no scene of this test has: {sorted(missing)}"] if missing else []
        for name, text in SCENES.items():
            told = check(name, text, "--unknown", "refuse")
            if told.returncode == 4 or "no expat" in told.stderr:
                return 77
            if told.returncode not in (0, 1):  # 1: other warnings, such as a light that is dark
                wrong.append(f"{name} as it is: {told.stderr}")
        for i in range(DRAWS):
            name = list(SCENES)[i % len(SCENES)]
            text, line, word, bad = draw(SCENES[name], rng)
            told = check("bad.xml", text, "--unknown", "refuse")
            if told.returncode != 3 or "bad.xml:" not in told.stderr:
                wrong.append(f"{name}:{line}: '{bad}' for '{word}': {told.returncode} {told.stderr.strip()}")
            told = check("bad.xml", text)
            if told.returncode != 3 and f"bad.xml:{line}:" not in told.stderr:
                wrong.append(f"{name}:{line}: '{bad}' for '{word}' gives no warning: {told.stderr}")
        print(f"{len(wrong)} faults in {DRAWS} draws", *wrong, sep="\n")
        return 1 if wrong else 0


sys.exit(main())
