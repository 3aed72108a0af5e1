/* SPDX-License-Identifier: Apache-2.0 */
/* Malformed scene, glTF, OBJ and PLY files: each gives an error of one line that names the file and the
   reason, and none does harm (the sanitizers look on). */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/render.h>

#include "meshes.h"

#define CAMERA "'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 40}"
#define MATERIAL "'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0.5}]"
#define SHAPE(text) "{" CAMERA "," MATERIAL ", 'shapes': [" text "]}"
#define LIGHT(text) "{" CAMERA "," MATERIAL ", 'shapes': [], 'lights': [" text "]}"
#define MADE(text) "{" CAMERA ", 'materials': [" text "], 'shapes': []}"

/* glTF: what comes before the accessors, and everything. */
#define GLTF(text) "{'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], " text "}"
#define BUFFER "'buffers': [{'byteLength': 36, 'uri': 'data:application/octet-stream;base64,AAAA'}]"
#define VIEW "'bufferViews': [{'buffer': 0, 'byteLength': 36}]"
#define ACCESSOR "'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3'}]"
#define MESH "'meshes': [{'primitives': [{'attributes': {'POSITION': 0}}]}]"
#define NODE "'nodes': [{'mesh': 0}]"

#define PLY(vertices, faces, rest)                                                                                   \
    "ply\nformat ascii 1.0\nelement vertex " vertices "\nproperty float x\nproperty float y\nproperty float z\n"     \
    "element face " faces "\nproperty list uchar int vertex_indices\nend_header\n" rest

#define BINARY_PLY(face)                                                                                             \
    "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"    \
    "element face 1\nproperty list uchar uchar vertex_index\nend_header\n"                                           \
    "?111?222?333?444?555?666?777?888?999" face

static const struct {
    const char *file, *text, *reason; /* reason: a part of the error; "" for what a library words */
} cases[] = {
    /* scenes */
    {"a.json", "", "line 1"},
    {"a.json", "{", "line 1"},
    {"a.json", "[]", "object"},
    {"a.json", "{'camera': 5}", "camera"},
    {"a.json", "{" CAMERA "}", "materials"},
    {"a.json", "{" CAMERA "," CAMERA "}", "line 1"},
    {"a.json", SHAPE("{'kind': 'cone', 'material': 'm'}"), "no kind 'cone'"},
    {"a.json", SHAPE("{'kind': 'sphere', 'centre': [0, 0], 'radius': 1, 'material': 'm'}"), "3 numbers"},
    {"a.json", SHAPE("{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 0, 'material': 'm'}"), "zero radius"},
    {"a.json", SHAPE("{'kind': 'sphere', 'centre': [0, 0, 1e999], 'radius': 1, 'material': 'm'}"), ""},
    {"a.json", SHAPE("{'kind': 'sphere', 'centre': [0, 0, NaN], 'radius': 1, 'material': 'm'}"), "line 1"},
    {"a.json", SHAPE("{'kind': 'mesh', 'material': 'm'}"), "'file' is missing"},
    {"a.json", SHAPE("{'kind': 'mesh', 'file': 'none.obj', 'material': 'm'}"), "none.obj"},
    {"a.json", SHAPE("{'kind': 'mesh', 'file': 'a.txt', 'material': 'm'}"), "a.txt"},
    {"a.json", SHAPE("{'kind': 'mesh', 'file': '.', 'material': 'm'}"), ""},
    {"a.json", SHAPE("{'kind': 'mesh', 'file': '/dev/zero', 'material': 'm'}"), "/dev/zero"},
    {"a.json", SHAPE("{'kind': 'instance', 'of': 'x', 'material': 'm'}"), "no mesh named 'x'"},
    {"a.json",
     LIGHT("{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'half': [0, 1], 'radiance': 1}"),
     "zero area"},
    {"a.json", LIGHT("{'kind': 'environment', 'image': 'none.exr'}"), "none.exr"},
    {"a.json",
     LIGHT("{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 0], 'half': [1, 1], 'radiance': 1}"),
     "length 0"},
    {"a.json", MADE("{'name': 'm', 'kind': 'lambert', 'albedo': {'image': 'none.png'}}"), "none.png"},
    {"a.json", MADE("{'name': 'm', 'kind': 'lambert', 'albedo': {'imagine': 1}}"), "unknown field"},
    {"a.json", MADE("{'name': 'm', 'kind': 'lambert', 'albedo': 1.5}"), "not in 0 to 1"},
    /* glTF */
    {"a.gltf", "", "empty"},
    {"a.gltf", "{'asset'", "line 1"},
    {"a.gltf", "{}", "asset"},
    {"a.gltf", "{'asset': {'version': '1.0'}}", "only glTF 2"},
    {"a.gltf", GLTF(BUFFER "," VIEW "," ACCESSOR "," MESH), "node"},
    {"a.gltf", GLTF("'buffers': [{'byteLength': 12, 'uri': 'x.bin'}]," VIEW "," ACCESSOR "," MESH "," NODE),
     "beyond the end of a buffer"},
    {"a.gltf", GLTF("'buffers': [{'byteLength': 36, 'uri': 'none.bin'}]," VIEW "," ACCESSOR "," MESH "," NODE), ""},
    {"a.gltf",
     GLTF(BUFFER "," VIEW
                 ", 'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 1000000, 'type': 'VEC3'}]," MESH
                 "," NODE),
     "beyond a view"},
    {"a.gltf",
     GLTF(BUFFER "," VIEW ", 'accessors': [{'componentType': 5126, 'count': 99999999999, 'type': 'VEC3'}]," MESH
                 "," NODE),
     "count"},
    {"a.gltf", GLTF(BUFFER "," VIEW "," ACCESSOR "," MESH ", 'nodes': [{'children': [1]}, {'children': [0]}]"),
     "has a parent"},
    {"a.gltf", GLTF(BUFFER "," VIEW "," ACCESSOR "," MESH ", 'nodes': [{'children': [7]}]"), "not in 0 to 0"},
    {"a.gltf", GLTF(BUFFER "," VIEW "," ACCESSOR "," MESH "," NODE ", 'extensionsRequired': ['EXT_none']"),
     "extension 'EXT_none'"},
    {"a.glb", "glTF\2", "cut short"},
    {"a.glb", "glTF\2...\377\377\377\377\377\377\377\377JSON", ""},
    /* OBJ */
    {"a.obj", "", "empty"},
    {"a.obj", "nothing of use\n", ""},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ""},
    {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\nf 1 2 1\n", "bad_a.obj: line 3: a corner names vertex 9, but there are 2"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n", "line 4"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/2\n",
     "line 5: a corner names texture vertex 2, but there are 1"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n", "line 4: a corner names normal 1, but there are 0"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2 3\n", "line 5"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/2/3/4 2 3\n", "line 4"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf\n", "without a corner"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 99999999999999999999 1 2\n", "line 4"},
    {"a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "line 2"},
    {"a.obj", "v 0 0 0\nv 0x1p3 0 0\nv 0 1 0\nf 1 2 3\n", "line 2"},
    {"a.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\", "backslash"},
    {"a.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n", "1e6"},
    {"a.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "area"},
    /* PLY */
    {"a.ply", "ply\n", "line 2"},
    {"a.ply", "not a ply\n", "line 1: the file does not begin with 'ply'"},
    {"a.ply", "ply\nformat ascii 2.0\n", "line 2: the format is not"},
    {"a.ply", "ply\nformat ascii 1.0\nproperty float x\n", "line 3: a property comes before any element"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty vec3 x\n",
     "line 4: the property has an unknown type"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\np.property float x\n", "line 4: expected an element"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "line 4: the file ends"},
    {"a.ply",
     "ply\nformat binary_big_endian 1.0\nelement vertex 99999999999999999999\nproperty double x\nend_header\n",
     "bytes at least"},
    {"a.ply", PLY("3", "0", "0 0 0\n1 0 0\n0 1 0\n"), ""},
    {"a.ply", PLY("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"), "line 13: face 0 names vertex 7, but there are 3"},
    {"a.ply", PLY("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), "line 13: face 0 names vertex -1, but there are 3"},
    {"a.ply", PLY("4", "2", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n"), "line 15: the file ends"},
    {"a.ply", PLY("4", "2", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2"), "line 15: the line has fewer numbers"},
    {"a.ply", PLY("3", "1", "0.0 0.0 0.0\n1 0\n0 1 0\n3 0 1 2\n"), "line 11: the line has fewer numbers"},
    {"a.ply", PLY("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 2\n"), "line 13: the line has more numbers"},
    {"a.ply", PLY("3", "1", "0 0 0 1 0 0\n0 1 0\n3 0 1 2\n"), "line 10: the line has more numbers"},
    {"a.ply", PLY("3", "1", "0 0 0\n1 0x1 0\n0 1 0\n3 0 1 2\n"), "line 11: expected a number"},
    {"a.ply", PLY("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2.0\n"), "line 13: expected a whole number"},
    {"a.ply", PLY("3", "1", "0 0 0\n1 0 0\n0 1 0\n99999999999999999999 0 1 2\n"),
     "line 13: the line has fewer numbers"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n0 0 0\n1 0 0\n0 1 0\n", "has no properties"},
    {"a.ply", BINARY_PLY("\3\1\2\11"), "face 0 names vertex 9, but there are 3"},
    {"a.ply", BINARY_PLY("\3\1\2"), "the file ends within element 'face' number 0 of 1"},
    {"a.ply", PLY("300", "1", "0 0 0\n1 0 0\n"), "its elements take 1802 bytes at least"},
    {"a.ply", PLY("3", "1", "0 0 0\ninf 0 0\n0 1 0\n3 0 1 2\n"), ""},
};

static void look_at_error(const char *name, koksma_status status, const char *reason)
{
    const char *text = koksma_error_text();
    assert_that(status != KOKSMA_OK && status != KOKSMA_MEMORY && koksma_status_exit_code(status) != 4,
                "case %s: status %d, '%s'", name, (int)status, text);
    assert_that(*text && !strchr(text, '\n') && strstr(text, reason), "case %s: '%s' does not say '%s' in one line",
                name, text, reason);
}

TEST_CASE(malformed_scenes_and_meshes)
{
    assert_true(sizeof cases / sizeof *cases >= 50);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[32], name[64];
        koksma_scene *scene = NULL;
        snprintf(path, sizeof path, "./bad_%s", cases[i].file);
        snprintf(name, sizeof name, "%zu (%s)", i, cases[i].file);
        write_json(path, cases[i].text);
        const koksma_status status = koksma_scene_open(path, &scene);
        look_at_error(name, status, cases[i].reason);
        unlink(path);
    }
}
