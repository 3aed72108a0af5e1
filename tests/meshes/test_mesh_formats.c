/* SPDX-License-Identifier: Apache-2.0 */
/* Triangles, normals and texture coordinates that the formats' specifications say a file has: Wavefront's "Advanced
   Visualizer Manual" (OBJ), Turk's "The PLY Polygon File Format", Khronos' glTF 2.0, Mitsuba's
   documentation of its plug-in "serialized". Numbers are exact: those of the files are few bits long.
   Long because it has the files of all formats. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "meshes.h"
#include "meshes/mesh_file.h"
#include "meshes/mesh_text.h"

/* The mesh of a file whose corners, in their order, are at these places. */
static koksma__mesh read_mesh(const char *path, size_t n_corners, const float (*places)[3])
{
    koksma__mesh mesh = {0};
    assert_that(!koksma__mesh_read(path, KOKSMA__BY_FILE, NULL, &mesh), "%s", koksma_error_text());
    assert_int_equal(3 * mesh.n_triangles, n_corners);
    for (size_t i = 0; i < n_corners; i++) {
        const float *v = mesh.vertices + 3 * mesh.indices[i];
        assert_that(memcmp(v, places[i], sizeof places[i]) == 0, "%s: corner %zu is at %g %g %g", path, i,
                    (double)v[0], (double)v[1], (double)v[2]);
    }
    unlink(path);
    return mesh;
}

/* The cube of 2 x 2 x 2 of the OBJ manual and the unit cube of Turk's paper, as corners of their fans. */
static void fan_out(const float (*places)[3], const int (*faces)[4], size_t n, float (*out)[3])
{
    for (size_t i = 0; i < 6 * n; i++) {
        static const int order[6] = {0, 1, 2, 0, 2, 3};
        memcpy(out[i], places[faces[i / 6][order[i % 6]]], sizeof *out);
    }
}

/* Appendix B1, "Cube" and "Cube with negative reference numbers". */
TEST_CASE(the_cubes_of_the_obj_manual)
{
    static const float places[8][3] = {{0, 2, 2}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                                       {0, 2, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}};
    static const int faces[6][4] = {{0, 1, 2, 3}, {7, 6, 5, 4}, {3, 2, 6, 7},
                                    {4, 0, 3, 7}, {4, 5, 1, 0}, {1, 5, 6, 2}};
    float corners[36][3];
    char text[4096] = "";
    fan_out(places, faces, 6, corners);
    for (int i = 0; i < 8; i++) {
        snprintf(text + strlen(text), 64, "v %.6f %.6f %.6f\n", (double)places[i][0], (double)places[i][1],
                 (double)places[i][2]);
    }
    const size_t length = strlen(text);
    for (int i = 0; i < 6; i++) {
        snprintf(text + strlen(text), 64, "f %d %d %d %d\n", faces[i][0] + 1, faces[i][1] + 1, faces[i][2] + 1,
                 faces[i][3] + 1);
    }
    test_write("cube.obj", text);
    koksma__mesh mesh = read_mesh("cube.obj", 36, corners);
    assert_null(mesh.normals);
    assert_null(mesh.uvs);
    koksma__mesh_fini(&mesh);
    text[length] = '\0';
    for (int i = 0; i < 6; i++) {
        snprintf(text + strlen(text), 64, "f %d %d \\\n %d %d\r\n", faces[i][0] - 8, faces[i][1] - 8, faces[i][2] - 8,
                 faces[i][3] - 8);
    }
    test_write("cube.obj", text);
    mesh = read_mesh("cube.obj", 36, corners);
    koksma__mesh_fini(&mesh);
}

/* v/vt/vn in all four forms; numbers may point forward; weights divide; a mesh ends where a group or a material does.
 */
TEST_CASE(corners_of_obj_name_three_things)
{
    static const float places[12][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0},
                                        {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0.5f, 0.25f, 1}};
    static const float uvs[12][2] = {{0.25f, 0.5f}, {0.75f, 0}, {0.5f, 1}, {0, 0}, {0, 0}, {0, 0},
                                     {0.25f, 0.5f}, {0.75f, 0}, {0.5f, 1}, {0, 0}, {0, 0}, {0, 0}};
    test_write("three.obj",
               "f 1/1/1 2/2/1 3/3/2 # forward\nv 0 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 1 1 1\nvt .25 .5 9\nvt .75\n"
               "vt 5e-1 1\nvn 0 0 2\nvn 0 0 -1\nf 2//1 3//1 1//2\nf -1/-3 -3/-2 -2/-1\nl 1 2\np 3\n"
               "s 1\nv 1 .5 2 2\nf 1 2 4\n");
    koksma__mesh mesh = read_mesh("three.obj", 12, places);
    for (size_t i = 0; i < 12; i++) {
        const float *uv = mesh.uvs + 2 * mesh.indices[i], *normal = mesh.normals + 3 * mesh.indices[i];
        const float z = i == 2 || i == 5 ? -1 : i < 6 ? 1 : 0;
        assert_memory_equal(uv, uvs[i], sizeof uvs[i]);
        assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == z);
    }
    koksma__mesh_fini(&mesh);
    koksma__mesh_file file;
    test_write("parts.mtl", "newmtl a\nKd 1 0.5\nPm 0.75\nPr 0.25\nmap_Kd -s 2 -o 1 1 1 -clamp on a b.png\n"
                            "newmtl b\nd 0.5\nKe 2 3 4\nmap_ke 1.png\nnewmtl c\nTr 0\n");
    test_write("parts.obj", "mtllib parts.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl b\nf 1 2 3\nf 2 3 1\ng x\n"
                            "f 3 1 2\ng x\nusemtl a\nusemtl b\nf 1 2 3\nusemtl nobody\nf 1 2 3\n");
    assert_ok(koksma__mesh_file_read("parts.obj", KOKSMA__BY_USER, &file));
    static const size_t materials[4] = {0, 2, 2, 4}, triangles[4] = {1, 2, 2, 1};
    assert_int_equal(file.meshes.n, 4);
    assert_int_equal(file.placements.n, 4);
    assert_int_equal(file.materials.n, 5);
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(koksma__file_mesh_at(&file, i)->material, materials[i]);
        assert_int_equal(koksma__file_mesh_at(&file, i)->mesh.n_triangles, triangles[i]);
    }
    const koksma__file_material *a = koksma__file_material_at(&file, 1), *b = a + 1, *c = a + 2;
    assert_true(a->colour[0] == 1 && a->colour[1] == 0.5f && a->colour[2] == 1); /* the missing one is as the first */
    assert_true(a->metallic == 0.75f && a->roughness == 0.25f && !a->see_through);
    assert_string_equal(a->colour_map.name, "a b.png");
    assert_true(b->see_through && b->glow[0] == 2 && b->glow[2] == 4 && b->colour[0] == 0.6f && b->roughness == 1);
    assert_string_equal(b->glow_map.name, "1.png");
    assert_false(c->see_through);
    assert_int_equal(file.unread.materials, 1);
    assert_string_equal(file.unread.material, "nobody");
    koksma__mesh_file_fini(&file);
    unlink("parts.mtl");
    unlink("parts.obj");
}

/* Appends one number of a type of PLY: b, s, i, f or d, in upper case unsigned. */
static size_t put(unsigned char *to, char type, double value, bool big)
{
    unsigned char bytes[8] = {0};
    const float narrow = (float)value;
    const long long whole = (long long)value;
    const size_t n = strchr("bB", type) ? 1 : strchr("sS", type) ? 2 : type == 'd' ? 8 : 4;
    if (type == 'd') {
        memcpy(bytes, &value, 8);
    } else if (type == 'f') {
        memcpy(bytes, &narrow, 4);
    } else {
        memcpy(bytes, &whole, n); /* tests run on little-endian machines, too */
    }
    const uint16_t one = 1;
    const bool here_big = *(const unsigned char *)&one == 0;
    if (here_big && strchr("bBsSiI", type)) {
        memcpy(bytes, (const unsigned char *)&whole + sizeof whole - n, n);
    }
    for (size_t i = 0; i < n; i++) {
        to[i] = bytes[big != here_big ? n - 1 - i : i];
    }
    return n;
}

/* The cube of Turk's paper, whose faces are of more properties here, as text and binary in both byte orders. */
TEST_CASE(the_cube_of_turk)
{
    static const float places[8][3] = {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0},
                                       {1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}};
    static const int faces[6][4] = {{0, 1, 2, 3}, {7, 6, 5, 4}, {0, 4, 5, 1},
                                    {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    float corners[36][3];
    fan_out(places, faces, 6, corners);
    for (int format = 0; format < 3; format++) {
        unsigned char file[8192];
        char *text = (char *)file;
        size_t n = (size_t)sprintf(text,
                                   "ply\nformat %s 1.0\ncomment made by hand\nobj_info 1\nelement vertex 8\n"
                                   "property uchar flag\nproperty double x\nproperty list uchar short extra\n"
                                   "property float y\nproperty short z\nproperty float nx\nproperty float ny\n"
                                   "property float nz\nproperty float s\nproperty float t\nelement edge 1\n"
                                   "property int a\nelement face 6\nproperty list ushort uint vertex_indices\n"
                                   "property char last\nend_header\n",
                                   formats[format]);
        for (int i = 0; i < 8; i++) {
            const double x = (double)places[i][0], y = (double)places[i][1], z = (double)places[i][2];
            const char types[] = "BdBssfsfffff";
            const double values[] = {200, x, 2, -5, 6, y, z, 2 * x - 1, 0, 0, 0.25 + x / 2, y};
            for (int k = 0; k < 12; k++) {
                n += format ? put(file + n, types[k], values[k], format == 2)
                            : (size_t)sprintf(text + n, "%g%c", values[k], k < 11 ? ' ' : '\n');
            }
        }
        n += format ? put(file + n, 'i', -7, format == 2) : (size_t)sprintf(text + n, "-7\n\n");
        for (int i = 0; i < 6; i++) {
            const char types[] = "SIIIIb";
            const double values[] = {4, faces[i][0], faces[i][1], faces[i][2], faces[i][3], -1};
            for (int k = 0; k < 6; k++) {
                n += format ? put(file + n, types[k], values[k], format == 2)
                            : (size_t)sprintf(text + n, "%g%s", values[k], k < 5 ? " \t" : "\r\n");
            }
        }
        test_write_bytes("turk.ply", file, n);
        koksma__mesh mesh = read_mesh("turk.ply", 36, corners);
        assert_int_equal(mesh.n_vertices, 8); /* shared, as in the file */
        for (size_t i = 0; i < 8; i++) {
            const float x = places[i][0];
            assert_true(mesh.normals[3 * i] == 2 * x - 1 && mesh.normals[3 * i + 1] == 0);
            assert_true(mesh.uvs[2 * i] == 0.25f + x / 2 && mesh.uvs[2 * i + 1] == places[i][1]);
        }
        koksma__mesh_fini(&mesh);
    }
}

/* A binary file of many blocks of vertices and runs of triangles, with quadrilaterals and an edge among them; `bad` is
   the number of the corner that names a vertex that is not there. Returns its length. */
enum { MANY_VERTICES = 1300, MANY_FACES = 9000 };
static size_t write_many(bool big, const char *index_type, size_t bad, unsigned char *file, float (*corners)[3],
                         size_t *n_corners)
{
    size_t n = (size_t)sprintf((char *)file,
                               "ply\nformat binary_%s_endian 1.0\nelement vertex %d\nproperty uchar flag\n"
                               "property float x\nproperty double y\nproperty short z\nproperty float weight\n"
                               "element face %d\nproperty list uchar %s vertex_indices\nend_header\n",
                               big ? "big" : "little", MANY_VERTICES, MANY_FACES, index_type);
    for (int i = 0; i < MANY_VERTICES; i++) {
        n += put(file + n, 'B', i % 256, big);
        n += put(file + n, 'f', i + 0.25, big);
        n += put(file + n, 'd', i * 700, big);
        n += put(file + n, 's', i % 700 - 350, big);
        n += put(file + n, 'f', -1, big);
    }
    *n_corners = 0;
    for (int face = 0, corner = 0; face < MANY_FACES; face++) {
        const int sides = face % 4500 == 4499 ? 4 : face == 7 ? 2 : 3;
        n += put(file + n, 'B', sides, big);
        for (int k = 0; k < sides; k++, corner++) {
            const int vertex = (size_t)corner == bad ? MANY_VERTICES : (face * 7 + k * k * 11) % MANY_VERTICES;
            n += put(file + n, *index_type == 'i' ? 'i' : 'I', vertex, big);
        }
        for (int k = 0; k < 3 * (sides - 2); k++) { /* of a quadrilateral 0 1 2 and 0 2 3 */
            const int of = k == 3 ? 0 : k > 3 ? k - 2 : k, i = (face * 7 + of * of * 11) % MANY_VERTICES;
            const float place[3] = {(float)i + 0.25f, (float)(i * 700), (float)(i % 700 - 350)};
            memcpy(corners[(*n_corners)++], place, sizeof place);
        }
    }
    return n;
}

TEST_CASE(many_faces_of_binary_ply)
{
    static unsigned char file[1 << 18];
    static float corners[3 * MANY_FACES + 64][3];
    size_t n_corners;
    for (int form = 0; form < 4; form++) {
        const size_t n = write_many(form & 1, form & 2 ? "int" : "uint", SIZE_MAX, file, corners, &n_corners);
        test_write_bytes("many.ply", file, n);
        koksma__mesh mesh = read_mesh("many.ply", n_corners, corners);
        assert_int_equal(mesh.n_vertices, MANY_VERTICES);
        koksma__mesh_fini(&mesh);
        test_write_bytes("many.ply", file, n - 5);
        assert_int_equal(koksma__mesh_read("many.ply", KOKSMA__BY_FILE, NULL, &mesh), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "the file ends within element 'face' number 8999 of 9000"));
        test_write_bytes("many.ply", file, write_many(form & 1, "int", 18000, file, corners, &n_corners));
        assert_int_equal(koksma__mesh_read("many.ply", KOKSMA__BY_FILE, NULL, &mesh), KOKSMA_MALFORMED);
        assert_non_null(
            strstr(koksma_error_text(), "face 6000 names vertex 1300, but there are 1300, numbered from 0"));
    }
    unlink("many.ply");
}

/* The header's counts fit the file, but a face takes more of it than it must. */
TEST_CASE(a_ply_that_ends_among_its_vertices)
{
    static const char text[] = "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar int "
                               "vertex_index\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n\3\0\0\0\0\1\0\0\0\2\0\0\0";
    static const char no_vertex[] = "ply\nformat binary_little_endian 1.0\nelement vertex 0\nelement face 1\n"
                                    "property list uchar int vertex_index\nend_header\n\2\0\0\0";
    unsigned char file[sizeof text + 36] = {0};
    koksma__mesh mesh = {0};
    test_write_bytes("short.ply", no_vertex, sizeof no_vertex - 1);
    assert_int_equal(koksma__mesh_read("short.ply", KOKSMA__BY_FILE, NULL, &mesh), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "the file ends within element 'face' number 0 of 1"));
    memcpy(file, text, sizeof text - 1);
    test_write_bytes("short.ply", file, sizeof text - 1 + 35);
    assert_int_equal(koksma__mesh_read("short.ply", KOKSMA__BY_FILE, NULL, &mesh), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "the file ends within element 'vertex' number 2 of 3"));
    unlink("short.ply");
}

/* MeshLab's texture coordinates of corners, and the texture's name. */
TEST_CASE(wedges_of_ply_are_of_vertices)
{
    koksma__mesh_file file;
    test_write("wedge.ply",
               "ply\nformat ascii 1.0\ncomment TextureFile my wood.png\nelement vertex 3\nproperty float x\n"
               "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 2 0 1 6 0 1 .25 .5 1 0\n");
    assert_ok(koksma__mesh_file_read("wedge.ply", KOKSMA__BY_USER, &file));
    const float wanted[6] = {0.25f, 0.5f, 1, 0, 0, 1};
    assert_memory_equal(koksma__file_mesh_at(&file, 0)->mesh.uvs, wanted, sizeof wanted);
    assert_string_equal(koksma__file_material_at(&file, 0)->colour_map.name, "my wood.png");
    koksma__mesh_file_fini(&file);
    unlink("wedge.ply");
}

/* Numbers of text are the nearest floats: beside libc's strtof, which is exact, at random and halfway between two. */
TEST_CASE(decimals_are_the_nearest_floats)
{
    /* The last four are nearest to a double halfway between two floats, on the side of the odd one. */
    static const char *const hard[] = {"0",
                                       "-0.0",
                                       "1.",
                                       ".5",
                                       "+3",
                                       "16777217",
                                       "16777217.0000000000000000001",
                                       "16777219",
                                       "33554434.999999999999999999",
                                       "1.00000005960464477539062500",
                                       "1.000000059604644775390625000000000000001",
                                       "1.0000000596046447753906249999",
                                       "0.1",
                                       "0.30000001192092895507812",
                                       "3.4028235e38",
                                       "3.4028236e38",
                                       "1e39",
                                       "-1e400",
                                       "1e-46",
                                       "7.0064923216240853e-46",
                                       "7.0064923216240854e-46",
                                       "1.17549435e-38",
                                       "1.1754942807573642e-38",
                                       "123456789012345678901234567890e-20",
                                       "0.000000000000000000000000000000000000011754943508",
                                       "9007199254740993",
                                       "1e22",
                                       "1e23",
                                       "8.5e-23",
                                       "0.007627759361639619",
                                       "0.1626541092991829",
                                       "0.03392431326210499",
                                       "0.000207741824851837"};
    for (size_t i = 0; i < 200000 + sizeof hard / sizeof *hard; i++) {
        char text[80];
        const char *at = text, *given = i < 200000 ? NULL : hard[i - 200000];
        float value = -1;
        if (given) {
            strcpy(text, given);
        } else { /* digits and an exponent at random; every fourth the decimals of a tie between two floats */
            const uint64_t bits = (uint64_t)i * 0x9e3779b97f4a7c15u, low = bits >> 40 | 1;
            const int digits = 1 + (int)(bits % 17);
            if (i % 4) {
                snprintf(text, sizeof text, "%.*f%s", digits, (double)(bits >> 11) * 0x1p-40,
                         (const char *[]){"", "e-9", "E+7", "e-21", "e20"}[bits % 5]);
            } else {
                snprintf(text, sizeof text, "%.20g", ldexp((double)(2 * low + 1), (int)(bits % 24) - 30));
            }
        }
        const float wanted = strtof(text, NULL);
        assert_true(koksma__text_float(&at, text + strlen(text), &value));
        if (*at || memcmp(&value, &wanted, sizeof value) != 0) {
            fail_msg("%s: %a, the nearest is %a, and '%s' is left", text, (double)value, (double)wanted, at);
        }
    }
    static const char *const none[] = {"", ".", "-", "e5", "+.e1", "x1", "nan", "inf"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        const char *at = none[i];
        float value;
        assert_false(koksma__text_float(&at, none[i] + strlen(none[i]), &value));
    }
    const char *at = "1e+"; /* a number, and then something else */
    float value;
    assert_true(koksma__text_float(&at, at + 3, &value) && value == 1 && !strcmp(at, "e+"));
}

/* ---- glTF --------------------------------------------------------------------------------------------------- */

/* A file of one buffer, "format.bin". */
static void write_gltf(const void *bytes, size_t size, const char *nodes, const char *primitive,
                       const char *accessors, const char *views)
{
    char text[4096];
    snprintf(
        text, sizeof text,
        "{'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0]}], 'nodes': [%s], 'meshes': [{'primitives': "
        "[{%s}]}], 'accessors': [%s], 'bufferViews': [%s], 'buffers': [{'byteLength': %zu, 'uri': 'format.bin'}]}",
        nodes, primitive, accessors, views, size);
    test_write_bytes("format.bin", bytes, size);
    write_json("format.gltf", text);
}

#define POSITIONS "{'bufferView': 0, 'componentType': 5126, 'count': 5, 'type': 'VEC3'}"
#define VIEWS "{'buffer': 0, 'byteLength': 60}, {'buffer': 0, 'byteOffset': 60, 'byteLength': 24}"

/* Section 3.7.2.1: which vertices make triangles, for each mode and type of index, and without indices. */
TEST_CASE(modes_of_gltf)
{
    static const float places[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 1}};
    static const int given[6] = {4, 0, 1, 2, 3, 3};
    static const struct {
        int mode, n;
        int triangles[12]; /* places in the list of indices */
    } modes[] = {{4, 6, {0, 1, 2, 3, 4, 5}},
                 {5, 12, {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5}},
                 {6, 12, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5}}};
    static const int types[] = {5121, 5123, 5125, 0};
    for (size_t i = 0; i < 12; i++) {
        const int type = types[i % 4], width = type == 5121 ? 1 : type == 5123 ? 2 : 4, mode = modes[i / 4].mode;
        unsigned char bytes[84] = {0};
        char primitive[128], accessors[256];
        float wanted[12][3];
        int n = 0;
        memcpy(bytes, places, sizeof places);
        for (int k = 0; k < 6; k++) {
            bytes[60 + k * width] = (unsigned char)given[k];
        }
        snprintf(primitive, sizeof primitive, "'attributes': {'POSITION': 0}, %s'mode': %d",
                 type ? "'indices': 1, " : "", mode);
        snprintf(accessors, sizeof accessors,
                 POSITIONS ", {'bufferView': 1, 'componentType': %d, 'count': 6, 'type': 'SCALAR'}",
                 type ? type : 5121);
        for (int k = 0; k < modes[i / 4].n; k++) {
            const int at = modes[i / 4].triangles[k];
            if (type || 5 > modes[i / 4].triangles[k - k % 3 + 2]) { /* without indices there are five vertices */
                memcpy(wanted[n++], places[type ? given[at] : at], sizeof *wanted);
            }
        }
        write_gltf(bytes, sizeof bytes, "{'mesh': 0}", primitive, accessors, VIEWS);
        koksma__mesh mesh = read_mesh("format.gltf", (size_t)n, (const float(*)[3])wanted);
        koksma__mesh_fini(&mesh);
    }
    unlink("format.bin");
}

/* Sections 3.6.2.2 and 3.6.2.4: elements byteStride apart, and texture coordinates of integers; v goes down in glTF.
 */
TEST_CASE(strided_and_normalised_accessors)
{
    static const float places[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                       normals[3][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    for (int type = 5121; type <= 5123; type += 2) {
        unsigned char bytes[96] = {0};
        char accessors[640];
        for (int i = 0; i < 3; i++) {
            memcpy(bytes + 32 * i, places[i], 12);
            memcpy(bytes + 32 * i + 12, normals[i], 12);
            memset(bytes + 32 * i + 24, i == 1 ? 0xff : 0, type == 5121 ? 1 : 2); /* u is 1 at the second corner */
            bytes[32 * i + (type == 5121 ? 25 : 26)] = 51;
            bytes[32 * i + 27] = 51; /* v is 51 / 255 = 13107 / 65535 */
        }
        snprintf(accessors, sizeof accessors,
                 "{'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3'}, {'bufferView': 0, "
                 "'byteOffset': 12, 'componentType': 5126, 'count': 3, 'type': 'VEC3'}, {'bufferView': 0, "
                 "'byteOffset': 24, 'componentType': %d, 'normalized': true, 'count': 3, 'type': 'VEC2'}",
                 type);
        write_gltf(bytes, sizeof bytes, "{'mesh': 0}", "'attributes': {'POSITION': 0, 'NORMAL': 1, 'TEXCOORD_0': 2}",
                   accessors, "{'buffer': 0, 'byteLength': 96, 'byteStride': 32}");
        koksma__mesh mesh = read_mesh("format.gltf", 3, places);
        assert_memory_equal(mesh.normals, normals, sizeof normals);
        for (size_t i = 0; i < 3; i++) {
            assert_true(mesh.uvs[2 * i] == (i == 1 ? 1 : 0));
            assert_near((double)mesh.uvs[2 * i + 1], 1 - 0.2, 1e-7);
        }
        koksma__mesh_fini(&mesh);
    }
    unlink("format.bin");
}

/* Section 3.5: a matrix by columns; translation, rotation by a quaternion, scale; children after their parents. A
   node that mirrors turns the corners round. */
TEST_CASE(nodes_of_gltf_place_meshes)
{
    static const float places[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 1}};
    /* a quarter turn about z, (x, y) -> (-y, x), of twice the size along x, moved by (1, 2, 3); then mirrored in z */
    static const char *const nodes[] = {
        "{'mesh': 0, 'translation': [1, 2, 3], 'rotation': [0, 0, 1, 0], 'scale': [2, 1, 1]}",
        "{'mesh': 0, 'matrix': [-2, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]}",
        ("{'children': [1], 'translation': [1, 2, 3]}, {'children': [2], 'rotation': [0, 0, 1, 0]}, {'mesh': 0, "
         "'scale': [2, 1, 1]}"),
        "{'mesh': 0, 'matrix': [-2, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 1, 2, 3, 1]}"};
    for (int i = 0; i < 4; i++) {
        float wanted[3][3];
        for (int k = 0; k < 3; k++) {
            const float *v = places[i == 3 && k ? 3 - k : k];
            wanted[k][0] = 1 - 2 * v[0];
            wanted[k][1] = 2 - v[1];
            wanted[k][2] = 3 + (i == 3 ? -v[2] : v[2]);
        }
        write_gltf(places, sizeof places, nodes[i], "'attributes': {'POSITION': 0}", POSITIONS,
                   "{'buffer': 0, 'byteLength': 60}");
        koksma__mesh mesh = read_mesh("format.gltf", 3, (const float(*)[3])wanted);
        koksma__mesh_fini(&mesh);
    }
    unlink("format.bin");
}

/* One mesh more than all of a file's together may be: a short file that names an accessor often ends there. */
TEST_CASE(meshes_of_a_file_are_limited_together)
{
    koksma__mesh_file file = {.path = "large.gltf", .n_vertices = KOKSMA__MAX_VERTICES - 3};
    koksma__mesh mesh = {0};
    assert_ok(koksma__mesh_init(3, 1, false, false, &mesh));
    assert_ok(koksma__file_take_mesh(&file, &mesh, 0));
    assert_ok(koksma__mesh_init(1, 1, false, false, &mesh));
    assert_int_equal(koksma__file_take_mesh(&file, &mesh, 0), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(),
                           "large.gltf: all its meshes together have more than 67108864 vertices or triangles"));
    koksma__mesh_file_fini(&file);
}

/* A .serialized file of two triangles, each in a zlib stream (RFC 1950) of one stored block (RFC 1951), at z = 0 and 1,
   behind vertices that none names. */
enum { SPARE = 400, BODY = 69 + 12 * SPARE };
static size_t put_serialized(unsigned char *file)
{
    uint32_t at[2];
    size_t size = 0;
    for (uint32_t k = 0; k < 2; k++) {
        static const unsigned char start[] = {0x1C, 4, 4, 0, 0x78, 1, 1}, flags[] = {0, 0x10, 0, 0, 0};
        unsigned char body[BODY] = {0};
        const float places[9] = {0, 0, (float)k, 1, 0, (float)k, 0, 1, (float)k};
        const uint64_t counts[2] = {SPARE + 3, 1};
        const uint32_t corners[3] = {SPARE, SPARE + 1, SPARE + 2};
        const uint16_t lengths[2] = {sizeof body, (uint16_t) ~sizeof body};
        memcpy(body, flags, 5);
        memcpy(body + 5, counts, 16);
        memcpy(body + BODY - 48, places, 36);
        memcpy(body + BODY - 12, corners, 12);
        uint32_t a = 1, b = 0; /* Adler-32, whose bytes come largest first */
        for (size_t i = 0; i < sizeof body; i++) {
            a = (a + body[i]) % 65521;
            b = (b + a) % 65521;
        }
        const unsigned char sum[4] = {(unsigned char)(b >> 8), (unsigned char)b, (unsigned char)(a >> 8),
                                      (unsigned char)a};
        at[k] = (uint32_t)size;
        memcpy(file + size, start, sizeof start);
        memcpy(file + size + 7, lengths, 4);
        memcpy(file + size + 11, body, sizeof body);
        memcpy(file + size + 11 + BODY, sum, 4);
        size += 15 + BODY;
    }
    const uint32_t end[5] = {at[0], 0, at[1], 0, 2};
    memcpy(file + size, end, sizeof end);
    return size + sizeof end;
}

/* Each mesh of a file is its own triangle. */
TEST_CASE(meshes_of_one_file_stay_apart)
{
    unsigned char bytes[3 * BODY];
    koksma__mesh_file file = {0};
    test_write_bytes("two.serialized", bytes, put_serialized(bytes));
    const koksma_status status = koksma__mesh_file_read("two.serialized", KOKSMA__BY_USER, &file);
    unlink("two.serialized");
    if (status == KOKSMA_UNSUPPORTED) {
        skip(); /* this build has no zlib */
    }
    assert_ok(status);
    assert_int_equal(file.meshes.n, 2);
    for (size_t i = 0; i < 2; i++) {
        const koksma__mesh *mesh = &koksma__file_mesh_at(&file, i)->mesh;
        assert_int_equal(mesh->n_triangles, 1);
        for (size_t v = 0; v < 3; v++) {
            assert_int_equal(mesh->indices[v], SPARE + v);
            assert_true(mesh->vertices[3 * mesh->indices[v] + 2] == (float)i);
        }
    }
    koksma__mesh_file_fini(&file);
}
