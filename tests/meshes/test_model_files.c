/* SPDX-License-Identifier: Apache-2.0 */
/* What comes of a mesh file however it is written, of its material files, and of what can't be rendered. Without
   Embree the tests of meshes are skipped. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/render.h>

#include "meshes.h"
#include "scene/scene.h"

#define UNIT_VERTICES "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
#define UNIT_PLY(rest)                                                                                               \
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"                \
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n" rest

/* Ways to write the unit square's two triangles, each with the error that it must not be read as another mesh. */
TEST_CASE(ways_to_write_a_mesh_are_one)
{
    static const struct {
        const char *file, *text;
    } ways[] = {
        {"way.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"},
        {"way.obj", "v 0 0 0\n  v 1 0 0\n\tv 1 1 0\nv 0 1 0\nf 1 2 3\n  f 1 3 4\n"},
        {"way.obj",
         "\357\273\277v .0 -.0 0\nv +1 .0 0\nv 1 1 .0 # x\nv 0 1 0\nf 1 2 3 # f 1 2 3\nf 1 3 \\\n 4 # x\n"},
        {"way.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nlod 1\nf 1 2 3 \r\nf\t1 3\t4"},
        {"way.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng a\\ \nf 1 2 3\nf 1 3 4\n"},
        {"way.ply", UNIT_PLY(UNIT_VERTICES "3 0 1 2\n3 0 2 3\n")},
        {"way.ply", UNIT_PLY("\n" UNIT_VERTICES "\n  3  0 1 2\n\t3 0 2 3")},
        {"way.ply", UNIT_PLY("0 0 0\n1e0 0.0 -0\r\n1 +1. 0\n.0 1 0\n3 0 1 2\n3 0 2 3\n")},
    };
    need_meshes();
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        koksma_scene *scene;
        test_write(ways[i].file, ways[i].text);
        assert_that(!koksma_scene_open(ways[i].file, &scene), "way %zu: %s", i, koksma_error_text());
        const koksma__mesh *mesh = scene->meshes;
        assert_int_equal(scene->n_meshes, 1);
        assert_int_equal(mesh->n_triangles, 2);
        for (size_t c = 0; c < 6; c++) {
            static const float corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
            const float *v = mesh->vertices + 3 * (size_t)mesh->indices[c];
            assert_that(v[0] == corners[c][0] && v[1] == corners[c][1] && v[2] == 0,
                        "way %zu: corner %zu is at %g %g %g", i, c, (double)v[0], (double)v[1], (double)v[2]);
        }
        koksma_scene_close(scene);
        unlink(ways[i].file);
    }
    char text[2048] = "";
    for (int i = 0; i < 12; i++) {
        snprintf(text + strlen(text), sizeof text - strlen(text), "v %g %g 0\n", cos(i * M_PI / 6),
                 sin(i * M_PI / 6));
    }
    koksma_scene *scene;
    test_write("way.obj", strcat(text, "f 1 2 3 4 5 6 7 8 9 10 11 12\n"));
    assert_ok(koksma_scene_open("way.obj", &scene));
    assert_int_equal(koksma_scene_count(scene).triangles, 10);
    koksma_scene_close(scene);
    unlink("way.obj");
}

/* The Kd that a material file gives to the material named a, red; or nothing. */
static double first_red(const char *mtl)
{
    koksma_scene *scene;
    test_write("red.mtl", mtl);
    test_write("red.obj", "mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a b\nf 1 2 3\n");
    const koksma_status status = koksma_scene_open("red.obj", &scene);
    char text[64];
    double red = -1;
    if (!status) {
        red = scene->materials[scene->placements[0].material].albedo[0][0];
        assert_false(koksma_scene_warning(scene, 0, text, sizeof text));
        koksma_scene_close(scene);
    }
    unlink("red.obj");
    unlink("red.mtl");
    return red;
}

TEST_CASE(material_files_are_text_of_numbers)
{
    need_meshes();
    assert_near(first_red("newmtl a b\nKd 0.25 0.5 0.5\n"), 0.25, 1e-7);
    assert_near(first_red("\357\273\277newmtl a b \r\n\tKd .25 .5 .5 # x\r\n"), 0.25, 1e-7);
    assert_near(first_red("  newmtl a b\n  Kd 0.25\n"), 0.25, 1e-7);
    static const char *const bad[] = {"Kd nan 0 0", "Ke 1e40 0 0", "Ke", "Kd 0.5 x"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[64];
        snprintf(text, sizeof text, "newmtl a b\n%s\n", bad[i]);
        assert_near(first_red(text), -1, 0);
        assert_non_null(strstr(koksma_error_text(), "red.mtl: line 2: a colour is"));
    }
}

/* A material file is read where it is first named, and once, however often and under whatever names: so the last of two
   different files that define a material counts. */
TEST_CASE(a_material_file_is_read_once)
{
    static const char *const lines[] = {"mtllib a.mtl\nmtllib b.mtl\nmtllib a.mtl\n", "mtllib a.mtl b.mtl a.mtl\n",
                                        "mtllib a.mtl b.mtl ./a.mtl\n", "mtllib a.mtl b.mtl link.mtl\n",
                                        "mtllib once.mtl b.mtl missing.mtl\n"};
    need_meshes();
    test_write("a.mtl", "newmtl m\nKd 0.25\n");
    test_write("b.mtl", "newmtl m\nKd 0.5\n");
    test_write("once.mtl", "newmtl m\nKd 0.25\n");
    assert_int_equal(symlink("a.mtl", "link.mtl"), 0);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        koksma_scene *scene;
        char text[256];
        snprintf(text, sizeof text, "%sv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nf 1 2 3\n", lines[i]);
        test_write("once.obj", text);
        assert_ok(koksma_scene_open("once.obj", &scene));
        assert_near(scene->materials[scene->placements[0].material].albedo[0][0], 0.5, 1e-7);
        koksma_scene_close(scene);
    }
    static const char *const names[] = {"a.mtl", "b.mtl", "once.mtl", "link.mtl", "once.obj"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        unlink(names[i]);
    }
}

/* What can't be rendered is told when the scene is read, and where. */
TEST_CASE(what_render_would_refuse_is_refused_at_once)
{
    static const char *const values[] = {"\0\0\200\177", "\0\0\300\177"};
    static const char *const parts[] = {
        "'materials': [], 'shapes': [],\n'lights': [{'kind': 'environment', 'image': 'bad.pfm'}]",
        "'shapes': [],\n'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': {'image': 'bad.pfm'}}]"};
    for (size_t i = 0; i < 4; i++) {
        char text[512], pfm[16] = "Pf\n1 1\n-1\n";
        koksma_scene *scene;
        FILE *file = fopen("bad.pfm", "wb");
        assert_non_null(file);
        memcpy(pfm + 10, values[i % 2], 4);
        fwrite(pfm, 1, 14, file);
        fclose(file);
        snprintf(text, sizeof text, "{'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 40}, %s}",
                 parts[i / 2]);
        write_json("refused.json", text);
        assert_int_equal(koksma_scene_open("./refused.json", &scene), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "refused.json': line 2: "));
        assert_non_null(strstr(koksma_error_text(), "bad.pfm: pixel 0,0 has the value"));
    }
    unlink("bad.pfm");
    if (koksma_mesh_tracer()) {
        koksma_scene *scene;
        test_write("bad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
        write_json(
            "refused.json",
            "{'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 40},'materials': [], 'shapes':\n[{'kind': "
            "'mesh', 'file': 'bad.obj','emission': 1, 'scale': 1e-6, 'translate': [1000, 1000, 0]}]}");
        assert_int_equal(koksma_scene_open("./refused.json", &scene), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "line 2: shapes[0]: a mesh that emits light has no area"));
        unlink("bad.obj");
    }
    unlink("refused.json");
}
