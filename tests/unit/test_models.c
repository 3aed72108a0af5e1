/* SPDX-License-Identifier: Apache-2.0 */
/* Luminous meshes, image textures, and bare mesh files with what they bring and what they lack. Without Embree and
   assimp the tests of meshes are skipped. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/render.h>

#include "scene/scene.h"
#include "test.h"

static void need_meshes(void)
{
    if (!koksma_mesh_tracer() || !koksma_mesh_reader()) {
        skip();
    }
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* The mean of a picture of one scene, given as a text or a path; its first channel. */
static double mean(const char *scene_text, const char *path, const char *integrator, int side, int spp)
{
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image;
    if (scene_text) {
        write_text("test_models.json", scene_text);
    }
    assert_ok(koksma_scene_open(scene_text ? "./test_models.json" : path, &scene));
    koksma_render_options_init(&options, scene);
    options.width = options.height = side;
    options.spp = spp;
    options.integrator = koksma_integrator_find(integrator);
    assert_ok(koksma_pattern_spec("jittered", &options.pattern));
    assert_ok(koksma_render(scene, &options, NULL, &image));
    double sum = 0;
    for (int i = 0; i < side * side; i++) {
        sum += (double)image.pixels[i * image.channels] / (side * side);
    }
    koksma_image_fini(&image);
    koksma_scene_close(scene);
    unlink("test_models.json");
    return sum;
}

/* The form factor from a small patch to a parallel rectangle of a x b at distance 1, one corner above the patch
   (Howell's catalogue, B-3). */
static double corner_factor(double a, double b)
{
    const double p = sqrt(1 + a * a), q = sqrt(1 + b * b);
    return (a / p * atan(b / p) + b / q * atan(a / q)) / (2 * M_PI);
}

#define LIT(light)                                                                                                   \
    "{\"camera\": {\"eye\": [5, 1, 9], \"target\": [0, 0, 0], \"fov_deg\": 0.01},"                                   \
    "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.9}], \"shapes\": [" light                \
    "{\"kind\": \"plane\", \"centre\": [0, 0, 0], \"normal\": [0, 1, 0], \"material\": \"m\"}]}"

static void luminous_meshes_have_their_form_factor(void **state)
{
    (void)state;
    need_meshes();
    /* a rectangle of 2 x 1 of three triangles that face down, of very different areas */
    write_text("lamp.obj",
               "v -1 0 -0.5\nv 1 0 -0.5\nv 1 0 0.5\nv -1 0 0.5\nv -0.9 0 0.5\nf 1 2 5\nf 2 3 5\nf 1 5 4\n");
    const double full = 0.9 * 2 * 4 * corner_factor(0.5, 0.25);
#define LAMP "{\"kind\": \"mesh\", \"file\": \"lamp.obj\", \"translate\": [0, 2, 0], \"emission\": 2},"
    static const char *const integrators[] = {"distribution", "path"};
    for (size_t i = 0; i < 2; i++) {
        /* the path tracer also finds it by chance, weighed against choosing it */
        assert_near(mean(LIT(LAMP), NULL, integrators[i], 1, 16384), full, 3e-3);
    }
    /* from behind it is dark */
    assert_near(mean(LIT("{\"kind\": \"mesh\", \"file\": \"lamp.obj\", \"translate\": [0, 2, 0], \"rotate_deg\": "
                         "[180, 0, 0], \"emission\": 2},"),
                     NULL, "path", 1, 64),
                0, 0);
    unlink("lamp.obj");
}

/* Over a large mesh, and far from the origin: the numbers are large, and the lamp is near. */
static void luminous_meshes_light_meshes(void **state)
{
    (void)state;
    need_meshes();
    write_text("lamp.obj", "v -1 0 -0.5\nv 1 0 -0.5\nv 1 0 0.5\nv -1 0 0.5\nf 1 2 3 4\n");
    write_text("floor.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 4 3 2 1\n");
    const double full = 0.9 * 2 * 4 * corner_factor(0.5, 0.25);
    static const double cases[][2] = {{5, 0}, {50, 0}, {1000, 0}, {5, 1000}, {5, 10000}, {1000, 10000}};
    for (size_t i = 0; i < 12; i++) {
        const double half = cases[i / 2][0], x = cases[i / 2][1];
        char text[1024];
        snprintf(
            text, sizeof text,
            "{\"camera\": {\"eye\": [%.9g, 1, 9], \"target\": [%.9g, 0, 0], \"fov_deg\": 0.01},"
            "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.9}], \"shapes\": ["
            "{\"kind\": \"mesh\", \"file\": \"lamp.obj\", \"translate\": [%.9g, 2, 0], \"emission\": 2},"
            "{\"kind\": \"mesh\", \"file\": \"floor.obj\", \"translate\": [%.9g, 0, 0], \"scale\": [%.9g, 1, %.9g],"
            "\"material\": \"m\"}]}",
            x + 5, x + 0.01, x, x, half, half); /* not on the diagonal of the floor */
        assert_near(mean(text, NULL, i % 2 ? "path" : "distribution", 1, 16384), full, 4e-3);
    }
    unlink("lamp.obj");
    unlink("floor.obj");
}

static void images_are_albedos(void **state)
{
    (void)state;
    koksma_image image;
    assert_ok(koksma_image_init(&image, 2, 2, 1));
    const float values[4] = {0.1f, 0.2f, 0.3f, 0.4f}; /* the upper row first */
    memcpy(image.pixels, values, sizeof values);
    assert_ok(koksma_image_write("texture.pfm", &image, NULL));
    koksma_image_fini(&image);
#define TEXTURED(target, shape)                                                                                      \
    "{\"camera\": {\"eye\": [" target ", 5], \"target\": [" target ", 0], \"fov_deg\": 0.01}, \"ambient\": 1,"       \
    "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": {\"image\": \"texture.pfm\"}}],"           \
    "\"shapes\": [" shape ", \"material\": \"m\"}]}"
#define WALL "{\"kind\": \"rectangle\", \"centre\": [0, 0, 0], \"normal\": [0, 0, 1], \"half\": [1, 1]"
    assert_near(mean(TEXTURED("-0.5, 0.5", WALL), NULL, "distribution", 1, 1), 0.1, 1e-3);
    assert_near(mean(TEXTURED("0.5, 0.5", WALL), NULL, "distribution", 1, 1), 0.2, 1e-3);
    assert_near(mean(TEXTURED("-0.5, -0.5", WALL), NULL, "distribution", 1, 1), 0.3, 1e-3);
    assert_near(mean(TEXTURED("0.5, -0.5", WALL), NULL, "distribution", 1, 1), 0.4, 1e-3);
    assert_near(mean(TEXTURED("0, 0", WALL), NULL, "distribution", 1, 1), 0.25, 1e-3);
    /* a rectangle has the image once: at its edge there is nothing of the opposite one */
    assert_near(mean(TEXTURED("0.9, 0.5", WALL), NULL, "distribution", 1, 1), 0.2, 1e-3);
    assert_near(mean(TEXTURED("-0.5, -0.9", WALL), NULL, "distribution", 1, 1), 0.3, 1e-3);
    if (koksma_mesh_tracer() && koksma_mesh_reader()) {
        write_text("wall.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                               "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
#define MESH_WALL "{\"kind\": \"mesh\", \"file\": \"wall.obj\""
        assert_near(mean(TEXTURED("-0.5, 0.5", MESH_WALL), NULL, "distribution", 1, 1), 0.1, 1e-3);
        assert_near(mean(TEXTURED("0.5, -0.5", MESH_WALL), NULL, "distribution", 1, 1), 0.4, 1e-3);
        assert_near(mean(TEXTURED("0.9, 0.5", MESH_WALL), NULL, "distribution", 1, 1), 0.6 * 0.2 + 0.4 * 0.1, 1e-3);
        unlink("wall.obj");
    }
    unlink("texture.pfm");
}

/* A square of 2 x 2 at z = 0 that faces +z. */
#define SQUARE                                                                                                       \
    "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, \"material\": 0}]}],"        \
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\", \"min\": [-1, "  \
    "-1, 0],"                                                                                                        \
    "\"max\": [1, 1, 0]}, {\"bufferView\": 1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}],"        \
    "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}, {\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": "    \
    "12}],"                                                                                                          \
    "\"buffers\": [{\"byteLength\": 60, \"uri\": \"square.bin\"}]}"

/* The square in 0.5 grey; its camera at z = 3, its light of 9 candela at z = 3. */
static const char *const gltf =
    "{\"asset\": {\"version\": \"2.0\"}, \"extensionsUsed\": [\"KHR_lights_punctual\"],"
    "\"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"point\", \"intensity\": 9, \"name\": "
    "\"lamp\"}]}}, \"scene\": 0, \"scenes\": [{\"nodes\": [0, 1, 2]}], \"nodes\": [{\"mesh\": 0}, {\"camera\": 0, "
    "\"name\": \"eye\", \"translation\": [0, 0, 3]}, {\"name\": \"lamp\", \"translation\": [0, 0, 3], "
    "\"extensions\": "
    "{\"KHR_lights_punctual\": {\"light\": 0}}}],"
    "\"cameras\": [{\"type\": \"perspective\", \"name\": \"eye\", \"perspective\": {\"yfov\": 0.01, \"aspectRatio\": "
    "1, "
    "\"znear\": 0.1}}], \"materials\": [{\"pbrMetallicRoughness\": {\"baseColorFactor\": [0.5, 0.5, 0.5, 1], "
    "\"metallicFactor\": 0}}]," SQUARE;

/* The square glows with 0.5 x 9 and fills half the height, 2 atan(2 / (3 sqrt 2)), of what a camera at x = z = 3 sees
   that was turned to it. No aspectRatio: yfov is of the height all the same. */
static const char *const glowing =
    "{\"asset\": {\"version\": \"2.0\"}, \"extensionsUsed\": [\"KHR_materials_emissive_strength\"], \"scene\": 0,"
    "\"scenes\": [{\"nodes\": [0, 1]}], \"nodes\": [{\"mesh\": 0, \"rotation\": [0, 0.38268343, 0, 0.92387953]},"
    "{\"camera\": 0, \"name\": \"eye\", \"translation\": [3, 0, 3], \"rotation\": [0, 0.38268343, 0, 0.92387953]}],"
    "\"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": 0.88137359, \"znear\": 0.1}}], "
    "\"materials\":"
    "[{\"emissiveFactor\": [0.5, 0.5, 0.5], \"extensions\": {\"KHR_materials_emissive_strength\": "
    "{\"emissiveStrength\": "
    "9}}}]," SQUARE;

static void bare_files_bring_or_get_cameras_and_lights(void **state)
{
    (void)state;
    need_meshes();
    const float corners[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    FILE *file = fopen("square.bin", "wb");
    assert_non_null(file);
    fwrite(corners, sizeof corners, 1, file);
    fwrite(indices, sizeof indices, 1, file);
    fclose(file);
    write_text("square.gltf", gltf);
    /* albedo / pi x intensity / distance^2 */
    assert_near(mean(NULL, "square.gltf", "distribution", 1, 1), 0.5 / M_PI * 9 / 9, 1e-3);
    write_text("glowing.gltf", glowing);
    assert_near(mean(NULL, "glowing.gltf", "distribution", 1, 16), 4.5 / 4, 1e-6);
    unlink("glowing.gltf");
    /* a square alone under a white sky that half of it sees: its albedo, and white beside it */
    write_text("square.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
    const double value = mean(NULL, "square.obj", "distribution", 32, 16);
    assert_true(value > 0.7 && value < 0.98);
    unlink("square.gltf");
    unlink("square.bin");
    unlink("square.obj");
}

static uint64_t hash_of(const char *path)
{
    koksma_scene *scene;
    assert_ok(koksma_scene_open(path, &scene));
    const uint64_t hash = koksma_scene_hash(scene);
    koksma_scene_close(scene);
    return hash;
}

/* Rows of studies go by the scene's hash: another mesh, material or texture behind the same text is another scene. */
static void hashes_cover_the_files_that_a_scene_names(void **state)
{
    (void)state;
    need_meshes();
    write_text("part.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
    write_text("part.obj", "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const uint64_t once = hash_of("part.obj");
    assert_true(once == hash_of("part.obj"));
    write_text("part.mtl", "newmtl a\nKd 0.5 0.5 0.25\n");
    assert_true(once != hash_of("part.obj"));
    write_text("textured.json",
               "{\"camera\": {\"eye\": [0, 0, 3], \"target\": [0, 0, 0], \"fov_deg\": 40}, "
               "\"ambient\": 1, \"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", "
               "\"albedo\": {\"image\": \"one.pfm\"}}], \"shapes\": [{\"kind\": \"rectangle\", "
               "\"centre\": [0, 0, 0], \"normal\": [0, 0, 1], \"half\": [1, 1], \"material\": \"m\"}]}");
    write_text("one.pfm", "Pf\n1 1\n-1\n\1\1\1\076");
    const uint64_t dark = hash_of("./textured.json");
    assert_true(dark == hash_of("./textured.json"));
    write_text("one.pfm", "Pf\n1 1\n-1\n\1\1\1\077");
    assert_true(dark != hash_of("./textured.json"));
    unlink("part.mtl");
    unlink("part.obj");
    unlink("textured.json");
    unlink("one.pfm");
}

/* A square with a texture looks as one in the texture's colour times the material's; what is no image leaves that. */
static void textures_of_models_are_read(void **state)
{
    (void)state;
    need_meshes();
#define SQUARE_OBJ(mtl)                                                                                              \
    "mtllib " mtl "\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\n"             \
    "f 1/1 2/2 3/3 4/4\n"
    write_text("plain.obj", SQUARE_OBJ("plain.mtl"));
    write_text("textured.obj", SQUARE_OBJ("textured.mtl"));
    write_text("textured.mtl", "newmtl a\nKd 0.75 0.75 0.75\nmap_Kd texture.pfm\n");
    write_text("texture.pfm", "Pf\n1 1\n-1\n\1\1\1\076"); /* 0.126 */
    write_text("plain.mtl", "newmtl a\nKd 0.094485294 0.094485294 0.094485294\n");
    const uint64_t hash = hash_of("textured.obj");
    assert_near(mean(NULL, "textured.obj", "distribution", 16, 4), mean(NULL, "plain.obj", "distribution", 16, 4),
                1e-6);
    write_text("texture.pfm", "Pf\n1 1\n-1\n\1\1\1\077");
    assert_true(hash != hash_of("textured.obj"));
    write_text("texture.pfm", "no picture");
    write_text("plain.mtl", "newmtl a\nKd 0.75 0.75 0.75\n");
    assert_near(mean(NULL, "textured.obj", "distribution", 16, 4), mean(NULL, "plain.obj", "distribution", 16, 4),
                1e-6);
    unlink("plain.obj");
    unlink("textured.obj");
    unlink("plain.mtl");
    unlink("textured.mtl");
    unlink("texture.pfm");
}

#define UNIT_VERTICES "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
#define UNIT_PLY(rest)                                                                                               \
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"                \
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n" rest

/* Ways to write the unit square's two triangles, each with the error that it must not be read as another mesh. */
static void ways_to_write_a_mesh_are_one(void **state)
{
    static const struct {
        const char *file, *text;
    } ways[] = {
        {"way.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"},
        {"way.obj", "v 0 0 0\n  v 1 0 0\n\tv 1 1 0\nv 0 1 0\nf 1 2 3\n  f 1 3 4\n"},
        {"way.obj",
         "\357\273\277v .0 -.0 0\nv +1 .0 0\nv 1 1 .0 # x\nv 0 1 0\nf 1 2 3 # f 1 2 3\nf 1 3 \\\n 4 # x\n"},
        {"way.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nlod 1\nf 1 2 3 \r\nf\t1 3\t4"},
        {"way.off", "OFF\n4 2 0\n" UNIT_VERTICES "3 0 1 2\n3 0 2 3\n"},
        {"way.off", "# a\nOFF\n# b\n4 2 0 # c\n" UNIT_VERTICES "# d\n3 0 1 2\n# e\n3 0 2 3\n"},
        {"way.off", "OFF\n4 1 0\n" UNIT_VERTICES "  4 0 1 2 3 # f"},
        {"way.ply", UNIT_PLY(UNIT_VERTICES "3 0 1 2\n3 0 2 3\n")},
        {"way.ply", UNIT_PLY("\n" UNIT_VERTICES "\n  3  0 1 2\n\t3 0 2 3")},
        {"way.ply", UNIT_PLY("0 0 0\n1e0 0.0 -0\r\n1 +1. 0\n.0 1 0\n3 0 1 2\n3 0 2 3\n")},
    };
    (void)state;
    need_meshes();
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        koksma_scene *scene;
        write_text(ways[i].file, ways[i].text);
        if (koksma_scene_open(ways[i].file, &scene)) {
            fail_msg("way %zu: %s", i, koksma_error_text());
        }
        const koksma__mesh *mesh = scene->meshes;
        assert_int_equal(scene->n_meshes, 1);
        assert_int_equal(mesh->n_triangles, 2);
        for (size_t c = 0; c < 6; c++) {
            static const float corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
            const float *v = mesh->vertices + 3 * (size_t)mesh->indices[c];
            if (v[0] != corners[c][0] || v[1] != corners[c][1] || v[2] != 0) {
                fail_msg("way %zu: corner %zu is at %g %g %g", i, c, (double)v[0], (double)v[1], (double)v[2]);
            }
        }
        koksma_scene_close(scene);
        unlink(ways[i].file);
    }
    char text[2048] = "OFF\n12 1 0\n";
    for (int i = 0; i < 12; i++) {
        snprintf(text + strlen(text), sizeof text - strlen(text), "%g %g 0\n", cos(i * M_PI / 6), sin(i * M_PI / 6));
    }
    koksma_scene *scene;
    write_text("way.off", strcat(text, "12 0 1 2 3 4 5 6 7 8 9 10 11\n"));
    assert_ok(koksma_scene_open("way.off", &scene));
    assert_int_equal(koksma_scene_count(scene).triangles, 10);
    koksma_scene_close(scene);
    unlink("way.off");
}

/* The Kd that a material file gives to the material named a, red; or nothing. */
static double first_red(const char *mtl)
{
    koksma_scene *scene;
    write_text("red.mtl", mtl);
    write_text("red.obj", "mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a b\nf 1 2 3\n");
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

static void material_files_are_text_of_numbers(void **state)
{
    (void)state;
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

/* What can't be rendered is told when the scene is read, and where. */
static void what_render_would_refuse_is_refused_at_once(void **state)
{
    (void)state;
    static const char *const values[] = {"\0\0\200\177", "\0\0\300\177"};
    static const char *const parts[] = {
        "\"materials\": [], \"shapes\": [],\n\"lights\": [{\"kind\": \"environment\", \"image\": \"bad.pfm\"}]",
        "\"shapes\": [],\n\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": {\"image\": "
        "\"bad.pfm\"}}]"};
    for (size_t i = 0; i < 4; i++) {
        char text[512], pfm[16] = "Pf\n1 1\n-1\n";
        koksma_scene *scene;
        FILE *file = fopen("bad.pfm", "wb");
        assert_non_null(file);
        memcpy(pfm + 10, values[i % 2], 4);
        fwrite(pfm, 1, 14, file);
        fclose(file);
        snprintf(text, sizeof text, "{\"camera\": {\"eye\": [0, 0, 5], \"target\": [0, 0, 0], \"fov_deg\": 40}, %s}",
                 parts[i / 2]);
        write_text("refused.json", text);
        assert_int_equal(koksma_scene_open("./refused.json", &scene), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "refused.json': line 2: "));
        assert_non_null(strstr(koksma_error_text(), "bad.pfm: pixel 0,0 has the value"));
    }
    unlink("bad.pfm");
    if (koksma_mesh_tracer() && koksma_mesh_reader()) {
        koksma_scene *scene;
        write_text("bad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
        write_text("refused.json", "{\"camera\": {\"eye\": [0, 0, 5], \"target\": [0, 0, 0], \"fov_deg\": 40},"
                                   "\"materials\": [], \"shapes\":\n[{\"kind\": \"mesh\", \"file\": \"bad.obj\","
                                   "\"emission\": 1, \"scale\": 1e-6, \"translate\": [1000, 1000, 0]}]}");
        assert_int_equal(koksma_scene_open("./refused.json", &scene), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "line 2: shapes[0]: a luminous mesh has no area"));
        unlink("bad.obj");
    }
    unlink("refused.json");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(luminous_meshes_have_their_form_factor),
        cmocka_unit_test(luminous_meshes_light_meshes),
        cmocka_unit_test(images_are_albedos),
        cmocka_unit_test(bare_files_bring_or_get_cameras_and_lights),
        cmocka_unit_test(hashes_cover_the_files_that_a_scene_names),
        cmocka_unit_test(textures_of_models_are_read),
        cmocka_unit_test(ways_to_write_a_mesh_are_one),
        cmocka_unit_test(material_files_are_text_of_numbers),
        cmocka_unit_test(what_render_would_refuse_is_refused_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
