/* SPDX-License-Identifier: Apache-2.0 */
/* Mitsuba's rules for meshes, each in every format of a mesh: what has no normals is smooth over the vertices that the file
   shares, or has facets with face_normals; the texture coordinate v is turned round in OBJ only, or as flip_tex_coords
   says. The mesh is a tetrahedron whose smooth normals are those that Mitsuba 3.9.1 gives (its vertex_normals). */
#include "meshes/mesh.h"
#include "scene_files.h"

static const float places[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const uint32_t sides[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
static const double smooth[4][3] = {{-0.57735026, -0.57735026, -0.57735026},
                                    {0.92102444, -0.27542147, -0.27542147},
                                    {-0.27542147, 0.92102444, -0.27542147},
                                    {-0.27542147, -0.27542147, 0.92102444}};

/* Writes t.obj; each vertex has the texture coordinates (x, y). seam: the last side has texture vertices of its own. */
static void write_obj(bool groups, bool seam)
{
    char text[1024] = "";
    for (int i = 0; i < 4; i++) {
        const float *p = places[i];
        snprintf(text + strlen(text), sizeof text - strlen(text), "v %g %g %g\nvt %g %g\nvt %g %g\n", (double)p[0],
                 (double)p[1], (double)p[2], (double)p[0], (double)p[1], (double)p[0], (double)p[1]);
    }
    for (unsigned t = 0; t < 4; t++) {
        const uint32_t *c = sides[t], other = seam && t == 3 ? 0 : 1;
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%.0u\nf %u/%u %u/%u %u/%u\n",
                 groups ? "g " : "#", t + 1, c[0] + 1, 2 * c[0] + 1 + other, c[1] + 1, 2 * c[1] + 1 + other, c[2] + 1,
                 2 * c[2] + 1 + other);
    }
    write_bytes("t.obj", text, strlen(text));
}

static void write_ply(void)
{
    char text[1024] =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property float s\nproperty float t\nelement face 4\nproperty list uchar int vertex_indices\n"
        "end_header\n";
    for (int i = 0; i < 4; i++) {
        const double x = (double)places[i][0], y = (double)places[i][1], z = (double)places[i][2];
        snprintf(text + strlen(text), sizeof text - strlen(text), "%g %g %g %g %g\n", x, y, z, x, y);
    }
    for (int t = 0; t < 4; t++) {
        snprintf(text + strlen(text), sizeof text - strlen(text), "3 %u %u %u\n", sides[t][0], sides[t][1],
                 sides[t][2]);
    }
    write_bytes("t.ply", text, strlen(text));
}

/* Writes t.serialized, of version 3: a zlib stream of one stored block. The machine has little-endian order. */
static void write_serialized(void)
{
    unsigned char data[512], file[512] = {0x1c, 0x04, 3, 0, 0x78, 0x01, 1};
    const uint32_t flags = 0x1002,
                   ends[2] = {0, 1}; /* single precision, texture coordinates; where the mesh begins; how many */
    const uint64_t counts[2] = {4, 4};
    size_t n = 0;
    memcpy(data, &flags, 4);
    memcpy(data + 4, counts, 16);
    memcpy(data + 20, places, sizeof places);
    n = 20 + sizeof places;
    for (int i = 0; i < 4; i++, n += 8) {
        memcpy(data + n, places[i], 8);
    }
    memcpy(data + n, sides, sizeof sides);
    n += sizeof sides;
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < n; i++) { /* Adler's checksum */
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    const unsigned char length[4] = {n & 255, n >> 8 & 255, ~n & 255, ~n >> 8 & 255},
                        sum[4] = {b >> 8 & 255, b & 255, a >> 8 & 255, a & 255};
    memcpy(file + 7, length, 4);
    memcpy(file + 11, data, n);
    memcpy(file + 11 + n, sum, 4);
    memcpy(file + 15 + n, ends, sizeof ends);
    write_bytes("t.serialized", file, 15 + n + sizeof ends);
}

static koksma_scene *shown(const char *format, const char *rules, size_t warnings)
{
    char text[512];
    snprintf(text, sizeof text,
             "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"%s\"><string name=\"filename\" "
             "value=\"t.%s\"/>%s<bsdf type=\"diffuse\"/></shape></scene>",
             format, format, rules);
    koksma_scene *scene = opened("t.xml", text);
    assert_int_equal(scene->n_unknown, warnings);
    return scene;
}

static bool reads_them(void)
{
    return can_read("t.xml") && *(const unsigned char *)&(const uint32_t){1} == 1;
}

/* Checks the normals of all corners. seam: the corners of the last side have their own, which are those of that side. */
static void check_normals(const koksma_scene *scene, bool seam)
{
    const koksma__mesh *mesh = &scene->meshes[0];
    assert_int_equal(mesh->n_triangles, 4);
    assert_non_null(mesh->normals);
    for (size_t i = 0; i < 12; i++) {
        const uint32_t corner = sides[i / 3][i % 3];
        double alone[3] = {0}; /* without the last side a right angle is there between two sides: of equal weight */
        for (size_t k = 0; k < 3; k++) {
            alone[k] = i / 3 == 3 ? sqrt(1.0 / 3) : corner == 0 ? -sqrt(1.0 / 3) : k + 1 == corner ? 0 : -sqrt(0.5);
            assert_float_equal((double)mesh->normals[3 * mesh->indices[i] + k], seam ? alone[k] : smooth[corner][k],
                               1e-6);
        }
    }
}

static const char *const formats[] = {"obj", "ply", "serialized"};

TEST_CASE(files_are_written)
{
    write_ply();
    write_serialized();
}

TEST_CASE(meshes_without_normals_are_smooth)
{
    for (int i = 0; reads_them() && i < 5; i++) {
        const bool seam = i == 3 || i == 4;
        write_obj(i == 1 || i == 4, seam);
        for (size_t f = 0; f < (i ? 1 : 3); f++) {
            koksma_scene *scene = shown(formats[f], "", 0);
            check_normals(scene, seam);
            koksma_scene_close(scene);
        }
    }
}

TEST_CASE(facets_have_no_normals)
{
    write_obj(false, false);
    for (size_t f = 0; reads_them() && f < 3; f++) {
        koksma_scene *scene = shown(formats[f], "<boolean name=\"face_normals\" value=\"true\"/>", 0);
        assert_null(scene->meshes[0].normals);
        koksma_scene_close(scene);
    }
}

/* Mitsuba's lights follow the interpolated normals, ours the triangles, which is said where these differ. */
TEST_CASE(smooth_lights_are_named)
{
    static const char *const rules[] = {"<emitter type=\"area\"/><boolean name=\"face_normals\" value=\"true\"/>",
                                        "<emitter type=\"area\"/>"};
    write_obj(false, false);
    for (size_t i = 0; reads_them() && i < 6; i++) {
        koksma_scene *scene = shown(formats[i % 3], rules[i / 3], i / 3);
        koksma_scene_close(scene);
    }
}

TEST_CASE(texture_coordinates_are_turned)
{
    static const char *const rules[] = {"", "<boolean name=\"flip_tex_coords\" value=\"true\"/>",
                                        "<boolean name=\"flipTexCoords\" value=\"false\"/>"};
    for (size_t i = 0; reads_them() && i < 9; i++) {
        const bool turned = i / 3 == 0 ? i % 3 == 0 : i / 3 == 1;
        koksma_scene *scene = shown(formats[i % 3], rules[i / 3], 0);
        const koksma__mesh *mesh = &scene->meshes[0];
        for (size_t k = 0; k < 12; k++) {
            const float *uv = mesh->uvs + 2 * mesh->indices[k], *p = places[sides[k / 3][k % 3]];
            assert_float_equal((double)uv[0], (double)p[0], 1e-6);
            assert_float_equal((double)uv[1], (double)(turned ? 1 - p[1] : p[1]), 1e-6);
        }
        koksma_scene_close(scene);
    }
}
