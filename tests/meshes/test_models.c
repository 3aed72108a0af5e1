/* SPDX-License-Identifier: Apache-2.0 */
/* Luminous meshes, image textures, and bare mesh files with what they bring and what they lack. Without Embree the
 * tests of meshes are skipped. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/render.h>

#include "meshes.h"

/* The mean of a picture of one scene, given as a text or a path; its first channel. */
static double mean(const char *scene_text, const char *path, const char *integrator, int side, int spp)
{
    koksma_scene *scene;
    if (scene_text) {
        write_json("test_models.json", scene_text);
    }
    assert_ok(koksma_scene_open(scene_text ? "./test_models.json" : path, &scene));
    koksma_image image = picture_of(scene, integrator, "jittered", spp, side, 0);
    double sum = 0;
    for (int i = 0; i < side * side; i++) {
        sum += (double)image.pixels[i * image.channels] / (side * side);
    }
    koksma_image_fini(&image);
    koksma_scene_close(scene);
    unlink("test_models.json");
    return sum;
}

#define LIT(light)                                                                                                   \
    "{'camera': {'eye': [5, 1, 9], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', 'kind': "       \
    "'lambert', 'albedo': 0.9}], 'shapes': [" light                                                                  \
    "{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': 'm'}]}"

TEST_CASE(luminous_meshes_have_their_form_factor)
{
    need_meshes();
    /* a rectangle of 2 x 1 of three triangles that face down, of very different areas */
    test_write("lamp.obj",
               "v -1 0 -0.5\nv 1 0 -0.5\nv 1 0 0.5\nv -1 0 0.5\nv -0.9 0 0.5\nf 1 2 5\nf 2 3 5\nf 1 5 4\n");
    const double full = 0.9 * 2 * 4 * corner_factor(0.5, 0.25);
#define LAMP "{'kind': 'mesh', 'file': 'lamp.obj', 'translate': [0, 2, 0], 'emission': 2},"
    static const char *const integrators[] = {"distribution", "path"};
    for (size_t i = 0; i < 2; i++) {
        /* the path tracer also finds it by chance, weighed against choosing it */
        assert_near(mean(LIT(LAMP), NULL, integrators[i], 1, 16384), full, 3e-3);
    }
    /* from behind it is dark */
    assert_near(mean(LIT("{'kind': 'mesh', 'file': 'lamp.obj', 'translate': [0, 2, 0], 'rotate_deg': [180, 0, 0], "
                         "'emission': 2},"),
                     NULL, "path", 1, 64),
                0, 0);
    unlink("lamp.obj");
}

/* Over a large mesh, and far from the origin: the numbers are large, and the lamp is near. */
TEST_CASE(luminous_meshes_light_meshes)
{
    need_meshes();
    test_write("lamp.obj", "v -1 0 -0.5\nv 1 0 -0.5\nv 1 0 0.5\nv -1 0 0.5\nf 1 2 3 4\n");
    test_write("floor.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 4 3 2 1\n");
    const double full = 0.9 * 2 * 4 * corner_factor(0.5, 0.25);
    static const double cases[][2] = {{5, 0}, {50, 0}, {1000, 0}, {5, 1000}, {5, 10000}, {1000, 10000}};
    for (size_t i = 0; i < 12; i++) {
        const double half = cases[i / 2][0], x = cases[i / 2][1];
        char text[1024];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [%.9g, 1, 9], 'target': [%.9g, 0, 0], 'fov_deg': 0.01},'materials': [{'name': "
                 "'m', 'kind': 'lambert', 'albedo': 0.9}], 'shapes': [{'kind': 'mesh', 'file': 'lamp.obj', "
                 "'translate': [%.9g, 2, 0], 'emission': 2},{'kind': 'mesh', 'file': 'floor.obj', 'translate': "
                 "[%.9g, 0, 0], 'scale': [%.9g, 1, %.9g],'material': 'm'}]}",
                 x + 5, x + 0.01, x, x, half, half); /* not on the diagonal of the floor */
        assert_near(mean(text, NULL, i % 2 ? "path" : "distribution", 1, 16384), full, 4e-3);
    }
    unlink("lamp.obj");
    unlink("floor.obj");
}

TEST_CASE(images_are_albedos)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, 2, 2, 1));
    const float values[4] = {0.1f, 0.2f, 0.3f, 0.4f}; /* the upper row first */
    memcpy(image.pixels, values, sizeof values);
    assert_ok(koksma_image_write("texture.pfm", &image, NULL));
    koksma_image_fini(&image);
#define TEXTURED(target, shape)                                                                                      \
    "{'camera': {'eye': [" target ", 5], 'target': [" target                                                         \
    ", 0], 'fov_deg': 0.01}, 'ambient': 1,'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': {'image': "       \
    "'texture.pfm'}}],'shapes': [" shape ", 'material': 'm'}]}"
#define WALL "{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 1], 'half': [1, 1]"
    assert_near(mean(TEXTURED("-0.5, 0.5", WALL), NULL, "distribution", 1, 1), 0.1, 1e-3);
    assert_near(mean(TEXTURED("0.5, 0.5", WALL), NULL, "distribution", 1, 1), 0.2, 1e-3);
    assert_near(mean(TEXTURED("-0.5, -0.5", WALL), NULL, "distribution", 1, 1), 0.3, 1e-3);
    assert_near(mean(TEXTURED("0.5, -0.5", WALL), NULL, "distribution", 1, 1), 0.4, 1e-3);
    assert_near(mean(TEXTURED("0, 0", WALL), NULL, "distribution", 1, 1), 0.25, 1e-3);
    /* a rectangle has the image once: at its edge there is nothing of the opposite one */
    assert_near(mean(TEXTURED("0.9, 0.5", WALL), NULL, "distribution", 1, 1), 0.2, 1e-3);
    assert_near(mean(TEXTURED("-0.5, -0.9", WALL), NULL, "distribution", 1, 1), 0.3, 1e-3);
    if (koksma_mesh_tracer()) {
        test_write("wall.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                               "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
#define MESH_WALL "{'kind': 'mesh', 'file': 'wall.obj'"
        assert_near(mean(TEXTURED("-0.5, 0.5", MESH_WALL), NULL, "distribution", 1, 1), 0.1, 1e-3);
        assert_near(mean(TEXTURED("0.5, -0.5", MESH_WALL), NULL, "distribution", 1, 1), 0.4, 1e-3);
        assert_near(mean(TEXTURED("0.9, 0.5", MESH_WALL), NULL, "distribution", 1, 1), 0.6 * 0.2 + 0.4 * 0.1, 1e-3);
        unlink("wall.obj");
    }
    unlink("texture.pfm");
}

/* On each side of a box an image stands as one sees it from there: upright on the four that do, and with its upper
   edge to the box's own -z on top and bottom. */
TEST_CASE(images_stand_upright_on_boxes)
{
    static const double half[3] = {1, 1.5, 0.5}, values[4] = {0.1, 0.2, 0.3, 0.4};
    const double c = cos(M_PI / 6), s = sin(M_PI / 6), axes[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    koksma_image image;
    assert_ok(koksma_image_init(&image, 2, 2, 1));
    for (int i = 0; i < 4; i++) {
        image.pixels[i] = (float)values[i]; /* the upper row first */
    }
    assert_ok(koksma_image_write("texture.pfm", &image, NULL));
    koksma_image_fini(&image);
    for (int i = 0; i < 24; i++) {
        const int along = i / 8, turn = (i / 4) % 2 ? 1 : -1, corner = i % 4;
        /* Right of who looks at the side is up x the way out. */
        const int right = along == 0 ? 2 : 0, up = along == 1 ? 2 : 1;
        const double way_up = along == 1 ? -1 : 1, way_right = along == 1 || along == 2 ? turn : -turn;
        const double x = (corner % 2 ? 0.5 : -0.5) * way_right * half[right];
        const double y = (corner / 2 ? -0.5 : 0.5) * way_up * half[up];
        double at[3], eye[3];
        for (int k = 0; k < 3; k++) {
            at[k] = turn * half[along] * axes[along][k] + x * axes[right][k] + y * axes[up][k];
            eye[k] = at[k] + turn * axes[along][k];
        }
        char text[1024];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [%.9g, %.9g, %.9g], 'target': [%.9g, %.9g, %.9g], 'up': [%.9g, %.9g, %.9g], "
                 "'fov_deg': 0.01}, 'ambient': 1, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': {'image': "
                 "'texture.pfm'}}], 'shapes': [{'kind': 'box', 'centre': [0, 0, 0], 'half': [%g, %g, %g], "
                 "'angle_deg': 30, 'material': 'm'}]}",
                 eye[0], eye[1], eye[2], at[0], at[1], at[2], axes[up][0], axes[up][1], axes[up][2], half[0], half[1],
                 half[2]);
        assert_near(mean(text, NULL, "distribution", 1, 1), values[corner], 1e-3);
    }
    unlink("texture.pfm");
}

/* A square of 2 x 2 at z = 0 that faces +z. */
#define SQUARE                                                                                                       \
    "'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1, 'material': 0}]}],'accessors': "       \
    "[{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3', 'min': [-1, -1, 0],'max': [1, 1, 0]}, "   \
    "{'bufferView': 1, 'componentType': 5123, 'count': 6, 'type': 'SCALAR'}],'bufferViews': [{'buffer': 0, "         \
    "'byteLength': 48}, {'buffer': 0, 'byteOffset': 48, 'byteLength': 12}],'buffers': [{'byteLength': 60, 'uri': "   \
    "'square.bin'}]}"

/* The square in 0.5 grey; its camera at z = 3, its light of 9 candela at z = 3. */
static const char *const gltf =
    "{'asset': {'version': '2.0'}, 'extensionsUsed': ['KHR_lights_punctual'],'extensions': {'KHR_lights_punctual': "
    "{'lights': [{'type': 'point', 'intensity': 9, 'name': 'lamp'}]}}, 'scene': 0, 'scenes': [{'nodes': [0, 1, 2]}], "
    "'nodes': [{'mesh': 0}, {'camera': 0, 'name': 'eye', 'translation': [0, 0, 3]}, {'name': 'lamp', 'translation': "
    "[0, 0, 3], 'extensions': {'KHR_lights_punctual': {'light': 0}}}],'cameras': [{'type': 'perspective', 'name': "
    "'eye', 'perspective': {'yfov': 0.01, 'aspectRatio': 1, 'znear': 0.1}}], 'materials': [{'pbrMetallicRoughness': "
    "{'baseColorFactor': [0.5, 0.5, 0.5, 1], 'metallicFactor': 0}}]," SQUARE;

/* The square glows with 0.5 x 9 and fills half the height, 2 atan(2 / (3 sqrt 2)), of what a camera at x = z = 3 sees
   that was turned to it. No aspectRatio: yfov is of the height all the same. */
static const char *const glowing =
    "{'asset': {'version': '2.0'}, 'extensionsUsed': ['KHR_materials_emissive_strength'], 'scene': 0,'extensions': "
    "{'KHR_lights_punctual': {'lights': [{'type': 'directional', 'intensity': 0}]}},'scenes': [{'nodes': [0, 1, "
    "2]}], 'nodes': [{'mesh': 0, 'rotation': [0, 0.38268343, 0, 0.92387953]},{'camera': 0, 'name': 'eye', "
    "'translation': [3, 0, 3], 'rotation': [0, 0.38268343, 0, 0.92387953]},{'extensions': {'KHR_lights_punctual': "
    "{'light': 0}}}],'cameras': [{'type': 'perspective', 'perspective': {'yfov': 0.88137359, 'znear': 0.1}}], "
    "'materials':[{'emissiveFactor': [0.5, 0.5, 0.5], 'extensions': {'KHR_materials_emissive_strength': "
    "{'emissiveStrength': 9}}}]," SQUARE;

TEST_CASE(bare_files_bring_or_get_cameras_and_lights)
{
    need_meshes();
    const float corners[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    FILE *file = fopen("square.bin", "wb");
    assert_non_null(file);
    fwrite(corners, sizeof corners, 1, file);
    fwrite(indices, sizeof indices, 1, file);
    fclose(file);
    write_json("square.gltf", gltf);
    /* intensity / distance^2 times base colour below a surface that reflects .04, and that over 4 pi */
    assert_near(mean(NULL, "square.gltf", "distribution", 1, 1), (0.5 * 0.96 * 0.96 + 0.04 / 4) / M_PI * 9 / 9, 1e-3);
    write_json("glowing.gltf", glowing);
    assert_near(mean(NULL, "glowing.gltf", "distribution", 1, 16), 4.5 / 4, 1e-6);
    unlink("glowing.gltf");
    unlink("square.gltf");
    unlink("square.bin");
}

/* A square alone gets a ground, a key light and a sky; a white sky in their place, that half of it sees, shows its albedo,
   and white beside it. */
TEST_CASE(bare_files_without_light_get_a_studio)
{
    need_meshes();
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image;
    test_write("square.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
    assert_ok(koksma_scene_open("square.obj", &scene));
    koksma_scene_counts counts = koksma_scene_count(scene);
    assert_true(counts.lights == 2 && counts.shapes == 1 && counts.placements == 1 && counts.materials == 2);
    const uint64_t hash = koksma_scene_hash(scene);
    assert_int_equal(koksma_scene_set_sky(scene, NULL, -1), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_scene_set_sky(scene, "no.pfm", 1), KOKSMA_MISSING);
    assert_ok(koksma_scene_set_sky(scene, NULL, 1));
    counts = koksma_scene_count(scene);
    assert_true(counts.lights == 1 && counts.shapes == 0 && counts.materials == 1 &&
                hash != koksma_scene_hash(scene));
    koksma_render_options_init(&options, scene);
    options.width = options.height = 32;
    options.spp = 16;
    assert_ok(koksma_pattern_spec("random", &options.pattern));
    assert_ok(koksma_render(scene, &options, NULL, &image));
    double sum = 0;
    for (int i = 0; i < 64; i++) { /* in the middle of the picture */
        sum += (double)image.pixels[(12 + i / 8) * 32 + 12 + i % 8] / 64;
    }
    assert_near((double)image.pixels[0], 1, 1e-6);
    assert_near(sum, 0.6, 0.06);
    koksma_image_fini(&image);
    assert_int_equal(koksma_scene_set_sky(scene, NULL, 1), KOKSMA_ARGUMENT);
    koksma_scene_close(scene);
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
TEST_CASE(hashes_cover_the_files_that_a_scene_names)
{
    need_meshes();
    test_write("part.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
    test_write("part.obj", "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const uint64_t once = hash_of("part.obj");
    assert_true(once == hash_of("part.obj"));
    test_write("part.mtl", "newmtl a\nKd 0.5 0.5 0.25\n");
    assert_true(once != hash_of("part.obj"));
    write_json("textured.json",
               "{'camera': {'eye': [0, 0, 3], 'target': [0, 0, 0], 'fov_deg': 40}, 'ambient': 1, 'materials': "
               "[{'name': 'm', 'kind': 'lambert', 'albedo': {'image': 'one.pfm'}}], 'shapes': [{'kind': 'rectangle', "
               "'centre': [0, 0, 0], 'normal': [0, 0, 1], 'half': [1, 1], 'material': 'm'}]}");
    test_write("one.pfm", "Pf\n1 1\n-1\n\1\1\1\076");
    const uint64_t dark = hash_of("./textured.json");
    assert_true(dark == hash_of("./textured.json"));
    test_write("one.pfm", "Pf\n1 1\n-1\n\1\1\1\077");
    assert_true(dark != hash_of("./textured.json"));
    unlink("part.mtl");
    unlink("part.obj");
    unlink("textured.json");
    unlink("one.pfm");
}

/* A square with a texture looks as one in the texture's colour times the material's; what is no image leaves that. */
TEST_CASE(textures_of_models_are_read)
{
    need_meshes();
#define SQUARE_OBJ(mtl)                                                                                              \
    "mtllib " mtl "\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\n"             \
    "f 1/1 2/2 3/3 4/4\n"
    test_write("plain.obj", SQUARE_OBJ("plain.mtl"));
    test_write("textured.obj", SQUARE_OBJ("textured.mtl"));
    test_write("textured.mtl", "newmtl a\nKd 0.75 0.75 0.75\nmap_Kd texture.pfm\n");
    test_write("texture.pfm", "Pf\n1 1\n-1\n\1\1\1\076"); /* 0.126 */
    test_write("plain.mtl", "newmtl a\nKd 0.094485294 0.094485294 0.094485294\n");
    const uint64_t hash = hash_of("textured.obj");
    assert_near(mean(NULL, "textured.obj", "distribution", 16, 4), mean(NULL, "plain.obj", "distribution", 16, 4),
                1e-6);
    test_write("texture.pfm", "Pf\n1 1\n-1\n\1\1\1\077");
    assert_true(hash != hash_of("textured.obj"));
    test_write("texture.pfm", "no picture");
    test_write("plain.mtl", "newmtl a\nKd 0.75 0.75 0.75\n");
    assert_near(mean(NULL, "textured.obj", "distribution", 16, 4), mean(NULL, "plain.obj", "distribution", 16, 4),
                1e-6);
    unlink("plain.obj");
    unlink("textured.obj");
    unlink("plain.mtl");
    unlink("textured.mtl");
    unlink("texture.pfm");
}
