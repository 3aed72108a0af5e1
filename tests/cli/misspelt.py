#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""misspelt.py KOKSMA SOURCE: a misspelt name in a file is named. Files that `scene check --unknown refuse` (plans:
`study run`) accepts as they are get one misspelling each: a letter left out, doubled, replaced, or two neighbours
swapped, in a name that the format gives: of a directive, kind, parameter, type or value of a closed list (pbrt), a member
or value (glTF, scenes and plans in JSON), a keyword (MTL). Each is refused with exit code 3 and a message that has the
misspelt word. Of Mitsuba these are elements, attributes, parameters, types, files and ids of the corpus of fuzz/, which has
approximations: the misspelling adds an error, or a warning with its line or word. Up to MOST names get one misspelling each, and pbrt,
glTF, MTL and scenes at least DRAWS; of each plan of the library 12 are drawn.

The names of pbrt are those that its format's documentation lists (pbrt.org/fileformat-v4), for each directive and kind
that is read without loss; those of glTF are of section 5 of its specification."""
import glob
import json
import os
import random
import re
import string
import struct
import subprocess
import sys
import tempfile
import zlib

KOKSMA, SOURCE = os.path.abspath(sys.argv[1]), sys.argv[2]
SEED = 20261128
DRAWS, MOST = 40, 100

PBRT = """Option "string rendercoordsys" "cameraworld"
Option "bool disablepixeljitter" false
Option "bool disabletexturefiltering" true
Option "bool disablewavelengthjitter" true
Option "float displacementedgescale" 1
Option "string msereferenceimage" "a.exr"
Option "string msereferenceout" "b.txt"
Option "bool pixelstats" false
Option "bool wavefront" false
Option "integer seed" 3
ColorSpace "srgb"
TransformTimes 0 1
LookAt 0 1 5  0 0 0  0 1 0
Camera "perspective" "float fov" 40 "float lensradius" 0.01 "float focaldistance" 5 "float shutteropen" 0 "float shutterclose" 1
Film "rgb" "integer xresolution" 8 "integer yresolution" 8 "string filename" "x.exr" "float diagonal" 35 "bool savefp16" true
  "float iso" 100 "float cropwindow" [0 1 0 1] "string sensor" "cie1931"
Film "gbuffer" "integer xresolution" 8 "integer yresolution" 8 "integer pixelbounds" [0 8 0 8] "string coordinatesystem" "camera"
Film "spectral" "integer xresolution" 8 "integer yresolution" 8 "integer nbuckets" 16 "float lambdamin" 360 "float lambdamax" 830
Sampler "halton" "integer pixelsamples" 8 "string randomization" "permutedigits" "integer seed" 1
Sampler "paddedsobol" "integer pixelsamples" 8 "string randomization" "none"
Sampler "sobol" "integer pixelsamples" 8 "string randomization" "owen"
Sampler "zsobol" "integer pixelsamples" 8 "string randomization" "fastowen"
Sampler "pmj02bn" "integer pixelsamples" 16
Sampler "independent" "integer pixelsamples" 16
Sampler "stratified" "bool jitter" true "integer xsamples" 4 "integer ysamples" 4
PixelFilter "box" "float xradius" 1 "float yradius" 1
PixelFilter "gaussian" "float xradius" 1 "float sigma" 0.5
PixelFilter "mitchell" "float B" 0.3 "float C" 0.3
PixelFilter "sinc" "float tau" 3
PixelFilter "triangle" "float yradius" 1
Accelerator "bvh" "string splitmethod" "sah" "integer maxnodeprims" 4
Accelerator "kdtree" "integer intersectcost" 5 "integer traversalcost" 1 "float emptybonus" 0.5 "integer maxprims" 1 "integer maxdepth" 9
Integrator "path" "integer maxdepth" 5 "string lightsampler" "bvh" "bool regularize" false
Integrator "volpath" "integer maxdepth" 5 "string lightsampler" "power"
Integrator "simplepath" "bool samplelights" true "bool samplebsdf" true
Integrator "bdpt" "bool visualizestrategies" false "bool visualizeweights" false
Integrator "mlt" "integer bootstrapsamples" 9 "integer chains" 9 "integer mutationsperpixel" 9 "float largestepprobability" 0.3
Integrator "sppm" "integer photonsperiteration" 9 "float radius" 1
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0 0 0] "rgb sigma_s" [0 0 0] "float g" 0 "float scale" 1
WorldBegin
Attribute "shape" "float radius" 1
Attribute "light" "float scale" 1
Attribute "material" "bool remaproughness" true
Attribute "texture" "float uscale" 1
AttributeBegin
  TransformBegin
    Translate 0 3 0
    LightSource "point" "rgb I" [9 9 9] "float power" 30 "float scale" 1 "point3 from" [0 1 0]
    LightSource "spot" "rgb I" [9 9 9] "point3 from" [0 1 0] "point3 to" [0 0 0] "float coneangle" 30 "float conedeltaangle" 5
  TransformEnd
  LightSource "distant" "rgb L" [1 1 1] "float illuminance" 3 "point3 from" [0 1 0] "point3 to" [0 0 0]
  LightSource "infinite" "rgb L" [1 1 1] "float illuminance" 3
  ReverseOrientation
  Material "interface"
  AreaLightSource "diffuse" "blackbody L" 5000 "bool twosided" true "float power" 9
  Shape "bilinearmesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 0] "point2 uv" [0 0 1 0 0 1 1 1] "integer indices" [0 1 2 3]
AttributeEnd
Texture "b" "float" "constant" "float value" 0.5
Texture "c" "spectrum" "constant" "rgb value" [0.5 0.5 0.5]
Texture "k" "spectrum" "checkerboard" "texture tex1" "c" "rgb tex2" [1 0 0] "float uscale" 2 "float vscale" 2 "integer dimension" 2
Texture "i" "spectrum" "imagemap" "string filename" "a.pfm" "string filter" "bilinear" "string wrap" "black" "bool invert" true
  "float scale" 0.5 "string encoding" "linear" "string mapping" "uv" "float udelta" 0 "float vdelta" 0 "float maxanisotropy" 8
Texture "s" "spectrum" "scale" "texture tex" "i" "texture scale" "b"
Texture "m" "spectrum" "mix" "rgb tex1" [0 0 0] "texture tex2" "s" "float amount" 0.5
MakeNamedMaterial "p" "string type" "diffuse" "texture reflectance" "m"
MakeNamedMaterial "q" "string type" "diffuse" "texture reflectance" "k"
NamedMaterial "p"
Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2] "normal N" [0 0 1 0 0 1 0 0 1] "vector3 S" [1 0 0 1 0 0 1 0 0]
  "integer faceIndices" [0]
Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k" "float roughness" 0.1
Shape "sphere" "float radius" 1 "float alpha" 1
Material "conductor" "rgb reflectance" [0.5 0.5 0.5] "float uroughness" 0.1 "float vroughness" 0.1
Scale 1 1 1
Rotate 0 0 0 1
Shape "disk" "float radius" 1 "float height" 0
Material "dielectric" "float eta" 1.5 "float roughness" 0.2 "bool remaproughness" false
ObjectBegin "o"
Shape "loopsubdiv" "integer levels" 1 "string scheme" "loop" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]
Shape "plymesh" "string filename" "a.ply"
ObjectEnd
CoordinateSystem "here"
CoordSysTransform "here"
Identity
Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]
ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]
ActiveTransform All
ObjectInstance "o"
NamedMaterial "q"
MediumInterface "" ""
Material "mix" "string materials" ["p" "p"] "float amount" 0.5
"""

# What fuzz/corpus/model/*.xml, which have all other parameters of Mitsuba that are read, can't have: objects with files.
FILES = """<scene version="3.0.0">
<path value="."/>
<include filename="more.xml"/>
<integrator type="path"><boolean name="hide_emitters" value="true"/><boolean name="strict_normals" value="false"/></integrator>
<sensor type="perspective">
<float name="near_clip" value="0.1"/>
<float name="far_clip" value="1000"/>
<film type="hdrfilm"><string name="pixel_format" value="rgb"/><rfilter type="gaussian"><float name="stddev" value="0.4"/></rfilter></film>
</sensor>
<bsdf type="diffuse" id="grey"/>
<shape type="shapegroup" id="group">
<shape type="obj"><string name="filename" value="a.obj"/><boolean name="face_normals" value="true"/><ref id="grey"/></shape>
</shape>
<shape type="instance"><ref id="group"/><transform name="to_world"><translate value="1, 0, 0"/></transform></shape>
<shape type="serialized"><string name="filename" value="a.serialized"/><integer name="shapeIndex" value="0"/></shape>
<shape type="ply"><string name="filename" value="b.ply"/><boolean name="flip_tex_coords" value="true"/><bsdf type="twosided"><bsdf type="diffuse">
<texture name="reflectance" type="bitmap">
<string name="filename" value="white.pfm"/>
<string name="filter_type" value="nearest"/>
<string name="wrap_mode" value="mirror"/>
<boolean name="raw" value="true"/>
</texture>
</bsdf></bsdf></shape>
<emitter type="envmap"><string name="filename" value="white.pfm"/><float name="scale" value="2"/></emitter>
<emitter type="directional"><vector name="direction" x="0" y="-1" z="0"/><rgb name="irradiance" value="1"/></emitter>
</scene>
"""
OTHERS = {"more.xml": '<scene version="3.0.0"><shape type="sphere"/></scene>',
          "a.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
          "b.ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float s\n"
                   "property float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
          "white.pfm": b"PF\n1 1\n-1\n" + b"\0\0\x80\x3f" * 3}


def serialized():
    """A triangle of version 3, doubles without normals or texture coordinates."""
    corners = (0, 0, 0, 1, 0, 0, 0, 1, 0)
    data = struct.pack("<IQQ9d3I", 0x2000, 3, 1, *corners, 0, 1, 2)
    stream = struct.pack("<HH", 0x041C, 3) + zlib.compress(data)
    return stream + struct.pack("<2I", 0, 1)

GLTF = {
    "asset": {"version": "2.0", "generator": "a test", "copyright": "none", "minVersion": "2.0"},
    "scene": 0, "scenes": [{"name": "s", "nodes": [0, 1, 2]}],
    "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_texture_transform"],
    "nodes": [{"name": "n", "mesh": 0, "translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1], "extras": {"any": 1}},
              {"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 4, 1], "children": [3]},
              {"extensions": {"KHR_lights_punctual": {"light": 0}}}, {"name": "leaf"}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"name": "l", "type": "spot", "color": [1, 1, 1], "intensity": 2, "range": 9,
                                                      "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}},
    "cameras": [{"name": "c", "type": "perspective", "perspective": {"yfov": 0.7, "aspectRatio": 1.3, "znear": 0.1, "zfar": 100}},
                {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 100}}],
    "meshes": [{"name": "m", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "_MINE": 1}, "material": 0, "mode": 4}]}],
    "materials": [{"name": "t", "pbrMetallicRoughness": {
        "baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0.5, "roughnessFactor": 0.5,
        "baseColorTexture": {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform": {
            "offset": [0, 0], "rotation": 0, "scale": [1, 1], "texCoord": 0}}},
        "metallicRoughnessTexture": {"index": 0}},
        "normalTexture": {"index": 0, "scale": 1}, "occlusionTexture": {"index": 0, "strength": 1}, "emissiveTexture": {"index": 0},
        "emissiveFactor": [1, 1, 1], "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True,
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}, "KHR_materials_ior": {"ior": 1.4}}}],
    "textures": [{"name": "x", "source": 0, "sampler": 0}], "images": [{"name": "i", "uri": "a.png"}],
    "samplers": [{"name": "y", "magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497}],
    "accessors": [{"name": "p", "bufferView": 0, "byteOffset": 0, "componentType": 5126, "normalized": False, "count": 3,
                   "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
    "bufferViews": [{"name": "v", "buffer": 0, "byteOffset": 0, "byteLength": 36, "target": 34962},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 24, "byteStride": 8}],
    "buffers": [{"name": "b", "uri": "a.bin", "byteLength": 60}]}
# What must be there for the file to be read, so that its absence has a message of its own; and names that nothing checks.
GLTF_FREE = {"any", "_MINE"}

MTL = """newmtl a
Ka 0 0 0
Kd 0.5 0.5 0.5
Ks 0 0 0
Ke 0 0 0
Ns 10
Ni 1.5
d 1
illum 2
Tf 1 1 1
sharpness 60
map_Kd -clamp on a.png
map_Ks a.png
map_Bump a.png
norm a.png
Pr 0.5
Pm 0
aniso 0
"""

SCENE = {
    "title": "t", "note": "n", "image": {"width": 8, "height": 8},
    "camera": {"eye": [0, 1, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40, "lens_radius": 0.1, "focus_distance": 5,
               "lens_map": "concentric", "lens_blades": 5, "lens_angle_deg": 3, "shutter": [0, 1], "motion": [0, 0, 0]},
    "background": 0.4, "ambient": 0.1, "clamp": 1,
    "medium": {"sigma_a": 0.02, "sigma_s": 0.1, "g": 0.5, "low": [-1, -1, -1], "high": [1, 1, 1]},
    "materials": [{"name": "m0", "kind": "checker", "albedos": [0.1, 0.8], "period": 1, "phase": [0, 0], "angle_deg": 3},
                  {"name": "m1", "kind": "lambert", "albedo": {"image": "a.png"}},
                  {"name": "m2", "kind": "phong", "reflectance": 0.5, "exponent": 20},
                  {"name": "m3", "kind": "ggx", "reflectance": 0.5, "roughness": 0.3},
                  {"name": "m4", "kind": "principled", "albedo": 0.5, "metallic": 1, "roughness": 0.3, "ior": 1.5},
                  {"name": "m5", "kind": "utah", "albedo": 0.5, "reflectance": 0.2, "exponent": 20},
                  {"name": "m6", "kind": "ggx", "reflectance": 0.4, "roughness": 0.3}],
    "shapes": [{"kind": "plane", "centre": [0, -1, 0], "normal": [0, 1, 0], "up": [0, 0, 1], "material": "m0"},
               {"kind": "rectangle", "centre": [0, 0, 0], "normal": [0, 1, 0], "half": [1, 1], "material": "m1"},
               {"kind": "disk", "centre": [0, 0, 0], "normal": [0, 1, 0], "radius": 1, "to": {"rotate_deg": [0, 0, 9]}, "material": "m2"},
               {"kind": "sphere", "centre": [0, 1, 0], "radius": 1, "motion": [1, 0, 0], "material": "m3"},
               {"kind": "box", "centre": [2, 1, 0], "half": [1, 1, 1], "angle_deg": 20, "material": "m4"},
               {"kind": "mesh", "file": "a.ply", "name": "one", "material": "m5", "translate": [0, 0, 0], "rotate_deg": [0, 9, 0],
                "scale": 1, "smooth": True},
               {"kind": "instance", "of": "one", "material": "m6", "translate": [3, 0, 0]},
               {"kind": "mesh", "file": "a.ply", "emission": [1, 1, 1]}],
    "lights": [{"kind": "rectangle", "centre": [0, 5, 0], "facing": [0, 0, 0], "half": [1, 1], "strength": 1, "visible": False},
               {"kind": "disk", "centre": [0, 5, 0], "normal": [0, -1, 0], "radius": 0.5, "radiance": 3},
               {"kind": "point", "centre": [0, 5, 0], "intensity": 10},
               {"kind": "spot", "centre": [0, 5, 0], "direction": [0, -1, 0], "intensity": 10, "angle_deg": 30, "edge": 0.2,
                "falloff": "smooth"},
               {"kind": "directional", "direction": [1, -2, 0], "irradiance": 1}]}


def misspell(word, rng):
    at = rng.randrange(len(word))
    letter = rng.choice(string.ascii_lowercase)
    swapped = word[:at] + word[at + 1:at + 2] + word[at:at + 1] + word[at + 2:]
    return rng.choice([word[:at] + word[at + 1:], word[:at] + word[at] + word[at:], word[:at] + letter + word[at + 1:], swapped])


def draw(word, known, rng):
    """A misspelling that is no other name of the format."""
    while True:
        bad = misspell(word, rng)
        if bad and bad != word and bad not in known and bad.strip() and " " not in bad:
            return bad


def by_word(text, places):
    words = {}
    for start, end in places:
        words.setdefault(text[start:end], []).append((start, end))
    return words


def replace(text, start, end, bad):
    """A closing tag of XML is misspelt as its element is."""
    changed = text[:start] + bad + text[end:]
    if text[start - 1:start] != "<" or text[end:text.index(">", end)][-1:] == "/":
        return changed
    depth = 1
    for tag in re.finditer(rf"<(/?){text[start:end]}\b[^>]*?(/?)>", text[end:]):
        depth += -1 if tag[1] else 0 if tag[2] else 1
        if not depth:
            at = end + tag.start() + 2
            return changed[:at + len(bad) - (end - start)] + bad + text[at + end - start:]
    return changed


class Bench:
    def __init__(self, folder):
        self.folder, self.failures, self.runs = folder, [], 0

    def put(self, name, text):
        mode = "wb" if isinstance(text, bytes) else "w"
        with open(os.path.join(self.folder, name), mode) as file:
            file.write(text)

    def run(self, *arguments):
        self.runs += 1
        return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True, check=False, cwd=self.folder, timeout=120)

    def check_all(self, kind, name, command, text, places, known, extra=None, draws=DRAWS):
        """text: the file; places: (start, end) of each name in it."""
        self.put(name, text)
        for path, content in (extra or {}).items():
            self.put(path, content)
        as_it_is = self.run(*command)
        if as_it_is.returncode not in (0, 1, 4) or "refuse" in as_it_is.stderr:
            sys.exit(f"{kind}: as it is: {as_it_is.returncode}: {as_it_is.stderr}")
        before = as_it_is.stderr.splitlines()
        rng = random.Random(SEED)
        words = list(by_word(text, places).values())
        chosen = [rng.choice(spots) for spots in rng.sample(words, min(len(words), MOST))]
        chosen += [rng.choice(places) for _ in range(draws - len(chosen))]
        for start, end in chosen:
            word = text[start:end]
            bad = draw(word, known, rng)
            line = f"{name}:{text[:start].count(chr(10)) + 1}:"
            if any(line in said for said in before):  # a warning says already what becomes of this line
                continue
            self.put(name, replace(text, start, end, bad))
            run = self.run(*command)
            new = "".join(said for said in run.stderr.splitlines() if said not in before)
            # in an error of XML, what lacks the name may be what is named
            named = bad in new or (name.endswith(".xml") and (line in new or (run.returncode == 3 and f"{name}:" in new)))
            if not named or (run.returncode != 3 and "--unknown" in command):
                self.failures.append(f"{kind}: '{bad}' for '{word}': {run.returncode}: {run.stderr.strip()}")
        self.put(name, text)
        return len(chosen)


def spans(text, pattern, group=1):
    return [m.span(group) for m in re.finditer(pattern, text)]


CLOSED = ("rendercoordsys", "randomization", "lightsampler", "splitmethod", "filter", "wrap", "mapping", "encoding", "sensor",
          "coordinatesystem")


def pbrt_places():
    places = spans(PBRT, r"(?m)^\s*([A-Z]\w+)")
    places += spans(PBRT, r'"(\w+) [\w.]+"') + spans(PBRT, r'"\w+ ([\w.]+)"')
    places += spans(PBRT, r'(?m)^\s*(?:Film|Sampler|PixelFilter|Accelerator|Integrator|Camera|LightSource|AreaLightSource|Shape'
                          r'|Material|Attribute|ColorSpace) "(\w+)"')
    places += spans(PBRT, r'"(?:spectrum|float)" "(\w+)"') + spans(PBRT, r'"string type" "(\w+)"')
    places += spans(PBRT, r'"string (?:' + "|".join(CLOSED) + r')" "(\w+)"')
    known = {PBRT[a:b] for a, b in places} | {"color", "point", "vector", "normal3", "st", "none", "point2", "vector2", "bool"}
    return places, known


def mitsuba_places(text):
    """The place of each name: of elements, of attributes, and of parameters, types, ids and references, but for what has no
    effect ("unused") and <color>, another name of <rgb>."""
    places = []
    for element in re.finditer(r"<([a-zA-Z]\w*)((?:\s+\w+=\"[^\"]*\")*)\s*/?>", text):
        places.append(element.span(1))
        for attribute in re.finditer(r"(\w+)=\"([^\"]*)\"", element[2]):
            at = element.start(2)
            groups = (1, 2) if attribute[1] in ("name", "type", "id", "as", "filename") else (1,)
            places += [(at + attribute.start(k), at + attribute.end(k)) for k in groups]
    return [(a, b) for a, b in places if not text[a:b].startswith("unused")]


def json_places(text, free, closed):
    """Members, but for those that nothing checks, and the values of members with closed lists."""
    places = [span for span in spans(text, r'"([^"\n]+)":') if text[span[0]:span[1]] not in free]
    places += spans(text, r'"(?:' + "|".join(closed) + r')": "(\w+)"')
    return places, {text[a:b] for a, b in places} | {"center", "color"}


def main():
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(folder)
        bench.put("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        bench.put("a.pfm", b"Pf\n1 1\n-1.0\n\x00\x00\x00\x3f")
        bench.put("a.bin", struct.pack("<15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1))
        made = bench.run("generate", "jittered", "-n", "4", "-o", "p.txt")
        if made.returncode:
            sys.exit(made.stderr)
        rendered = bench.run("render", os.path.join(os.path.abspath(SOURCE), "scenes/checker.json"), "--size", "4x4", "-n", "1", "-o", "a.png")
        if rendered.returncode:
            sys.exit(rendered.stderr)
        refuse = ("--unknown", "refuse")
        counts = {}
        places, known = pbrt_places()
        counts["pbrt"] = bench.check_all("pbrt", "a.pbrt", ("scene", "check", "a.pbrt", *refuse), PBRT, places, known)
        for path, content in {**OTHERS, "a.serialized": serialized()}.items():
            bench.put(path, content)
        if "expat" not in bench.run("scene", "check", "more.xml").stderr:
            mitsuba = {"files": FILES}
            for path in glob.glob(os.path.join(SOURCE, "fuzz/corpus/model/*.xml")):
                with open(path) as file:
                    mitsuba[os.path.basename(path)] = file.read().partition("\n")[2]
            for name, text in mitsuba.items():
                counts[name] = bench.check_all(name, "a.xml", ("scene", "check", "a.xml"), text, mitsuba_places(text),
                                               {"rgb", "srgb", "color", "x", "y", "z", "version"}, draws=0)
        gltf = json.dumps(GLTF, indent=1)
        places, known = json_places(gltf, GLTF_FREE, ("alphaMode",))
        places += spans(gltf, r'"type": "(perspective|spot)"')
        counts["glTF"] = bench.check_all("glTF", "a.gltf", ("scene", "check", "a.gltf", *refuse), gltf, places, known)
        keywords = {line.split()[0] for line in MTL.splitlines()} | {"bump", "disp", "Tr", "Km", "Pc", "Ps", "map_Ka", "map_Ke", "map_d",
                                                                    "map_Ns", "map_Pr", "map_Pm", "map_Ps", "map_Pc", "Pcr"}
        obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n"
        places = [span for span in spans(MTL, r"(?m)^(\w+)")] + spans(MTL, r"(-clamp)")
        counts["MTL"] = bench.check_all("MTL", "a.mtl", ("scene", "check", "a.obj", *refuse), MTL, places, keywords, {"a.obj": obj})
        scene = json.dumps(SCENE, indent=1)
        places, known = json_places(scene, set(), ("kind", "lens_map", "falloff"))
        counts["scene"] = bench.check_all("scene", "a.json", ("scene", "check", "./a.json", *refuse), scene, places, known)
        for plan in sorted(os.listdir(os.path.join(SOURCE, "studies"))):
            if plan.endswith(".json"):
                with open(os.path.join(SOURCE, "studies", plan)) as file:
                    text = file.read()
                places, known = json_places(text, set(), ("no_such_list",))
                # a.png is no folder (exit code 4), which is found after all that is wrong with a plan
                places = random.Random(SEED).sample(places, min(len(places), 12))
                counts[plan] = bench.check_all(plan, "plan.json", ("study", "run", "plan.json", "-o", "a.png", "-q"), text, places, known, draws=12)
        for failure in bench.failures:
            print(failure)
        print(f"{sum(counts.values())} misspellings ({', '.join(f'{k} {n}' for k, n in counts.items())}), {len(bench.failures)} not named")
        sys.exit(bool(bench.failures))


main()
