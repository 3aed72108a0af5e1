/* SPDX-License-Identifier: Apache-2.0 */
/* Bare glTF files by what they say of a square, its texture and its lights. Without Embree all is skipped.
 */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/render.h>

#include "meshes.h"
#include "meshes/mesh_file.h"
#include "render/lanes.h"
#include "scene/scene.h"

static void write_image(const char *path, int width, const float *pixels)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, width, 1, 1));
    memcpy(image.pixels, pixels, (size_t)width * sizeof *pixels);
    assert_ok(koksma_image_write(path, &image, NULL));
    koksma_image_fini(&image);
}

/* A camera at z = 3 that sees one point of a square of 2 x 2 at z = 0 which faces it. */
typedef struct model {
    const char *nodes;      /* beside the camera, 0 */
    const char *roots;      /* numbers of the scene's nodes */
    const char *material;   /* the inside of the square's */
    const char *attributes; /* of the square beside positions and texture coordinates */
    const char *image;      /* its name */
    const char *lights;
} model;

static const char *const plain = "'pbrMetallicRoughness': {'metallicFactor': 0}";
#define TEXTURED(colour, texture)                                                                                    \
    "'pbrMetallicRoughness': {'metallicFactor': 0, 'baseColorFactor': " colour                                       \
    ", 'baseColorTexture': {'index': 0" texture "}}"
#define LAMP(light) "'extensions': {'KHR_lights_punctual': {'light': " light "}}"
#define LAMP_AT(light, z) "{'name': 'lamp', 'translation': [0, 0, " z "], " LAMP(light) "}"

static void write_model(const char *path, const model *m)
{
    static const float square[44] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, /* positions, then texture coordinates */
                                     0,  1,  1, 1, 1,  0, 0, 0,              /* and colours: red */
                                     1,  0,  0, 1, 1,  0, 0, 1, 1, 0,  0, 1, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0};
    static const uint16_t corners[6] = {0, 1, 2, 0, 2, 3};
    unsigned char bytes[188];
    memcpy(bytes, square, 176);
    memcpy(bytes + 176, corners, 12);
    test_write_bytes("my square.bin", bytes, sizeof bytes);
    char text[8192];
    snprintf(
        text, sizeof text,
        "{'asset': {'version': '2.0'}, 'extensionsUsed': ['KHR_lights_punctual', 'KHR_texture_transform'], 'scene': "
        "0, 'scenes': [{'nodes': [%s]}], 'nodes': [{'camera': 0, 'translation': [0, 0, 3]}, %s], 'extensions': "
        "{'KHR_lights_punctual': {'lights': [%s]}}, 'cameras': [{'type': 'perspective', 'perspective': {'yfov': "
        "0.001, 'znear': 0.1}}], 'materials': [{%s}], 'textures': [{'source': 0}], 'images': [{'uri': '%s'}], "
        "'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1%s}, 'indices': 3, 'material': "
        "0}]}], 'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3', 'min': [-1, -1, "
        "0], 'max': [1, 1, 0]}, {'bufferView': 1, 'componentType': 5126, 'count': 4, 'type': 'VEC2'}, {'bufferView': "
        "2, 'componentType': 5126, 'count': 4, 'type': 'VEC4'}, {'bufferView': 3, 'componentType': 5123, 'count': 6, "
        "'type': 'SCALAR'}], 'bufferViews': [{'buffer': 0, 'byteLength': 48}, {'buffer': 0, 'byteOffset': 48, "
        "'byteLength': 32}, {'buffer': 0, 'byteOffset': 80, 'byteLength': 64}, {'buffer': 0, 'byteOffset': 176, "
        "'byteLength': 12}], 'buffers': [{'byteLength': 188, 'uri': 'my%%20square.bin'}]}",
        m->roots, m->nodes, m->lights ? m->lights : "{'type': 'point', 'intensity': 9}", m->material,
        m->image ? m->image : "texture.pfm", m->attributes ? m->attributes : "");
    write_json(path, text);
}

/* What one sample of the scene sees, and its warnings, each on a line. */
static void look(const char *path, double rgb[3], char *warnings, size_t size)
{
    koksma_scene *scene;
    assert_ok(koksma_scene_open(path, &scene));
    koksma_image image = picture_of(scene, "distribution", "random", 1, 1, 0);
    for (int k = 0; k < 3; k++) {
        rgb[k] = (double)image.pixels[k % image.channels];
    }
    char text[512];
    *warnings = '\0';
    for (size_t i = 0; koksma_scene_warning(scene, i, text, sizeof text); i++) {
        assert_true(strlen(warnings) + strlen(text) + 2 < size);
        strcat(strcat(warnings, text), "\n");
    }
    koksma_image_fini(&image);
    koksma_scene_close(scene);
}

/* What a principled surface of this base colour, no metal and roughness 1 reflects straight up of an irradiance of 1 on a
   plane that faces the light, whose cosine this is, times pi: Schlick from .04, D = 1 / pi, Smith's G with tan = sine /
   cosine. */
static double seen(double colour, double cosine)
{
    const double half = sqrt((1 + cosine) / 2), masking = 1 / (1 + (1 / cosine - 1) / 2);
    const double below = 0.96 * (1 - (0.04 + 0.96 * pow(1 - cosine, 5))) * cosine;
    return colour * below + (0.04 + 0.96 * pow(1 - half, 5)) * masking / 4;
}

#define WHITE_METAL 0.25 /* the same of a white metal: D G / 4 */

/* The square's node and light 0 at z = 3, of irradiance 1, are nodes 1 and 2; what is seen is seen() of the colour, over
   pi. */
static void expect(const char *material, const char *image, const char *attributes, double r, double g, double b,
                   const char *warning)
{
    double rgb[3];
    char warnings[2048];
    write_model("square.gltf", &(model){.nodes = "{'mesh': 0}, " LAMP_AT("0", "3"),
                                        .roots = "0, 1, 2",
                                        .material = material,
                                        .attributes = attributes,
                                        .image = image});
    look("square.gltf", rgb, warnings, sizeof warnings);
    const double wanted[3] = {r, g, b};
    for (int k = 0; k < 3; k++) { /* what glows is metal, the others are not */
        const bool glows = strstr(material, "emissive") && !strstr(material, "pbr");
        assert_near(rgb[k] * M_PI, glows ? wanted[k] + WHITE_METAL : seen(wanted[k], 1), 3e-4);
    }
    if (*warning ? !strstr(warnings, warning) : *warnings) {
        fail_msg("'%s' wanted, and there is: %s", warning, warnings);
    }
    unlink("square.gltf");
    unlink("my square.bin");
}

TEST_CASE(textures_are_multiplied_with_colours)
{
    need_meshes();
    write_image("texture.pfm", 1, (const float[]){0.5f});
    expect(plain, NULL, NULL, 1, 1, 1, "");
    expect(TEXTURED("[1, 1, 1, 1]", ""), NULL, NULL, 0.5, 0.5, 0.5, "");
    expect(TEXTURED("[0.5, 0.5, 0.5, 1]", ""), NULL, NULL, 0.25, 0.25, 0.25, "");
    expect(TEXTURED("[1, 0.5, 0, 1]", ""), NULL, NULL, 0.5, 0.25, 0, "");
    unlink("texture.pfm");
}

TEST_CASE(names_of_files_are_decoded)
{
    need_meshes();
    char path[KOKSMA__MAX_PATH];
    write_image("my texture.pfm", 1, (const float[]){0.5f});
    expect(TEXTURED("[1, 1, 1, 1]", ""), "my%20texture.pfm", NULL, 0.5, 0.5, 0.5, "");
    expect(TEXTURED("[1, 1, 1, 1]", ""), "my%2texture.pfm", NULL, 1, 1, 1, "there is no such file");
    /* a file of the very name goes first */
    write_image("my%20texture.pfm", 1, (const float[]){0.25f});
    expect(TEXTURED("[1, 1, 1, 1]", ""), "my%20texture.pfm", NULL, 0.25, 0.25, 0.25, "");
    unlink("my texture.pfm");
    unlink("my%20texture.pfm");
    /* a zero ends no name; a folder is found, so that opening it says what is wrong */
    assert_int_equal(mkdir("parts", 0777), 0);
    write_image("parts/a b.pfm", 1, (const float[]){0.5f});
    assert_true(koksma__find_named("./m.obj", "parts\\a b.pfm", path));
    assert_string_equal(path, "./parts/a b.pfm");
    assert_true(koksma__find_named("parts/m.obj", "a%20b%2Epfm", path));
    assert_string_equal(path, "parts/a b.pfm");
    assert_false(koksma__find_named("m.obj", "parts/a b.pfm%00x", path));
    assert_true(koksma__find_named("m.obj", "parts", path));
    assert_false(koksma__find_named("parts/m.obj", "", path));
    assert_false(koksma__find_named("m.obj", "%", path));
    unlink("parts/a b.pfm");
    rmdir("parts");
}

TEST_CASE(emission_is_multiplied_with_its_texture)
{
    need_meshes();
#define GLOW "'emissiveFactor': [1, 1, 0.5], 'emissiveTexture': {'index': 0}"
    write_image("texture.pfm", 1, (const float[]){0.25f});
    expect(GLOW, NULL, NULL, M_PI / 4, M_PI / 4, M_PI / 8, "");
    write_image("texture.pfm", 4, (const float[]){0, 0.25f, 0.75f, 1});
    expect(GLOW, NULL, NULL, M_PI / 2, M_PI / 2, M_PI / 4, ""); /* the camera sees its middle */
    write_image("texture.pfm", 1, (const float[]){0});
    expect("'pbrMetallicRoughness': {'metallicFactor': 0}, " GLOW, NULL, NULL, 1, 1, 1, "");
    unlink("texture.pfm");
    expect("'pbrMetallicRoughness': {'metallicFactor': 0}, " GLOW, NULL, NULL, 1, 1, 1,
           "material 0 emits no light, because its emissive texture is missing: texture.pfm: there is no such file");
}

/* The light of an image whose halves add to 1 at every point, sampled from above its middle: half of the solid angle of a
   square (arcsines of its corners), here of area 1/4, and each sample has the density that a ray to its position gets. */
TEST_CASE(glow_is_sampled_by_its_texture)
{
    need_meshes();
    koksma_scene *scene;
    koksma__lights lights;
    write_image("texture.pfm", 4, (const float[]){0, 0, 1, 1});
    write_model("square.gltf", &(model){.nodes = "{'mesh': 0, 'scale': [0.25, 0.25, 1]}, " LAMP_AT("0", "3"),
                                        .roots = "0, 1, 2",
                                        .material = GLOW});
    assert_ok(koksma_scene_open("square.gltf", &scene));
    assert_ok(koksma__lights_init(scene, &lights));
    const koksma__shading_light *light = &lights.lights[0];
    assert_ptr_equal(light->kind, &koksma__light_mesh);
    const float p[3] = {0, 0, 0.5f};
    double sum[3] = {0};
    enum { N = 200 };
    for (int i = 0; i < N * N; i++) {
        const float u[2] = {((float)(i / N) + 0.5f) / N, ((float)(i % N) + 0.5f) / N};
        koksma__beam beam;
        assert_true(light_sample(light, p, u, &beam));
        /* where it meets the square, whose triangles are above and below the diagonal */
        const float x = -2 * beam.w[0] / beam.w[2], y = -2 * beam.w[1] / beam.w[2];
        const float uv[2] = {0.5f + 0.5f * x, 0.5f + 0.5f * y}, t = -0.5f / beam.w[2];
        float radiance[3];
        if (fabsf(x - y) > 1e-4f) {
            const float density = light->kind->met(light, x > y ? 0 : 1, uv, radiance);
            assert_near((double)(t * t * density / -beam.w[2]), (double)beam.pdf, 1e-3 * (double)beam.pdf);
        }
        for (int k = 0; k < 3; k++) {
            sum[k] += (double)beam.value[k] / (N * N);
        }
    }
    assert_near(sum[0], 2 * asin(0.2), 5e-4);
    assert_near(sum[2], asin(0.2), 3e-4);
    koksma__lights_fini(&lights);
    koksma_scene_close(scene);
    unlink("square.gltf");
    unlink("my square.bin");
    unlink("texture.pfm");
}

/* KHR_texture_transform; the camera sees texture coordinates (1/2, 1/2). */
TEST_CASE(textures_are_moved)
{
    need_meshes();
    static const struct {
        const char *how;
        double seen;
    } all[] = {{"'offset': [0.25, 0]", 0.75},
               {"'offset': [-0.25, 0.5]", 0.25},
               {"'scale': [0.5, 9]", 0.25},
               {"'scale': [1.5, 1]", 0.75},
               {"'rotation': 1.57079632679, 'scale': [1, 0.5]", 0.25},
               {"'rotation': -1.57079632679, 'scale': [1, 0.5]", 0.75}, /* u' = -v' = -1/4 */
               {"'rotation': 1.57079632679, 'scale': [1, 1.5]", 0.75}};
    write_image("texture.pfm", 2, (const float[]){0.25f, 0.75f});
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char material[512];
        snprintf(material, sizeof material,
                 TEXTURED("[1, 1, 1, 1]", ", 'extensions': {'KHR_texture_transform': {%s}}"), all[i].how);
        expect(material, NULL, NULL, all[i].seen, all[i].seen, all[i].seen, "");
    }
    unlink("texture.pfm");
}

TEST_CASE(alpha_below_the_cutoff_is_not_there)
{
    need_meshes();
    static const char *const materials[] = {
        TEXTURED("[1, 1, 1, 0.4]", "") ", 'alphaMode': 'MASK'",
        TEXTURED("[1, 1, 1, 0.6]", "") ", 'alphaMode': 'MASK'",
        TEXTURED("[1, 1, 1, 0.6]", "") ", 'alphaMode': 'MASK', 'alphaCutoff': 0.7",
        TEXTURED("[1, 1, 1, 0]", "") ", 'alphaMode': 'BLEND'", TEXTURED("[1, 1, 1, 0.1]", "")};
    static const bool there[] = {false, true, false, false, true};
    write_image("texture.pfm", 1, (const float[]){0.5f});
    for (size_t i = 0; i < sizeof there / sizeof *there; i++) {
        double rgb[3];
        char warnings[2048];
        write_model(
            "square.gltf",
            &(model){.nodes = "{'mesh': 0}, " LAMP_AT("0", "3"), .roots = "0, 1, 2", .material = materials[i]});
        look("square.gltf", rgb, warnings, sizeof warnings);
        assert_near(rgb[0] * M_PI, there[i] ? seen(0.5, 1) : 0, 1e-5);
        assert_string_equal(warnings, "");
    }
    unlink("square.gltf");
    unlink("my square.bin");
    unlink("texture.pfm");
}

TEST_CASE(what_is_not_read_is_said)
{
    need_meshes();
    write_image("texture.pfm", 1, (const float[]){0.5f});
    expect(TEXTURED("[1, 1, 1, 1]", ", 'texCoord': 1"), NULL, ", 'TEXCOORD_1': 1", 0.5, 0.5, 0.5, "");
    expect(TEXTURED("[1, 1, 1, 1]", "") ", 'normalTexture': {'index': 0, 'scale': 0, 'texCoord': 1}", NULL, NULL, 0.5,
           0.5, 0.5, "textures' own texture coordinates (1) are not read");
    expect(TEXTURED("[1, 1, 1, 0.5]", ""), NULL, NULL, 0.5, 0.5, 0.5, "");
    expect(plain, NULL, ", 'COLOR_0': 2", 1, 0, 0, "");
    unlink("texture.pfm");
    expect("'pbrMetallicRoughness': {'metallicFactor': 0, 'metallicRoughnessTexture': {'index': 0}}", NULL, NULL, 1,
           1, 1, "material 0 loses its texture of metal and roughness: texture.pfm: there is no such file");
    expect(TEXTURED("[1, 1, 1, 1]", "") ", 'normalTexture': {'index': 0}", NULL, NULL, 1, 1, 1,
           "material 0 loses its texture of normals: texture.pfm: there is no such file");
}

/* What is seen of the square lit by these nodes, times pi: the irradiance, or of a glowing one the radiance. */
static double lit(const char *nodes, const char *roots, const char *material, const char *lights)
{
    double rgb[3];
    char warnings[2048];
    write_model("lit.gltf", &(model){.nodes = nodes, .roots = roots, .material = material, .lights = lights});
    look("lit.gltf", rgb, warnings, sizeof warnings);
    unlink("lit.gltf");
    unlink("my square.bin");
    return rgb[0] * M_PI;
}

TEST_CASE(every_node_with_a_light_has_one)
{
    need_meshes();
#define SQUARE "{'mesh': 0}, "
#define DARK "{'type': 'directional', 'intensity': 0}" /* so that there is no studio */
    const char *two = "{'type': 'point', 'intensity': 9}, {'type': 'spot', 'spot': {}, 'intensity': 4.5}";
    const char *sun = "{'type': 'directional', 'intensity': 2, 'color': [0.5, 1, 1]}";
    assert_near(lit(SQUARE LAMP_AT("0", "3"), "0, 1, 2", plain, NULL), 1 * seen(1, 1), 1e-5);
    assert_near(lit(SQUARE LAMP_AT("0", "3") ", " LAMP_AT("0", "1.5"), "0, 1, 2, 3", plain, NULL), 5 * seen(1, 1),
                1e-5);
    /* one name for two */
    assert_near(lit(SQUARE LAMP_AT("0", "3") ", " LAMP_AT("1", "1.5"), "0, 1, 2, 3", plain, two), 3 * seen(1, 1),
                1e-5);
    /* not in the scene */
    assert_near(lit(SQUARE LAMP_AT("0", "3") ", " LAMP_AT("0", "1.5"), "0, 1, 2", plain, NULL), 1 * seen(1, 1), 1e-5);
    /* below others: z = 1 + 2 x 1, and turned about y by a half circle */
    assert_near(lit(SQUARE LAMP_AT("0", "1") ", {'children': [2], 'translation': [0, 0, 1], 'scale': [2, 2, 2]}",
                    "0, 1, 3", plain, NULL),
                seen(1, 1), 1e-5);
    assert_near(
        lit(SQUARE LAMP_AT("0", "-1.5") ", {'children': [2], 'rotation': [0, 1, 0, 0]}", "0, 1, 3", plain, NULL),
        4 * seen(1, 1), 1e-5);
    assert_near(lit(SQUARE "{'matrix': [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1.5, 1], " LAMP("0") "}", "0, 1, 2",
                    plain, NULL),
                4 * seen(1, 1), 1e-5);
    /* a spot of 45 degrees whose axis is 30 degrees off, about x: the square of a linear fall in the cosine */
    const double fall = (cos(M_PI / 6) - cos(M_PI / 4)) / (1 - cos(M_PI / 4));
    assert_near(lit(SQUARE "{'translation': [0, 0, 3], 'rotation': [0.25881905, 0, 0, 0.96592583], " LAMP("0") "}",
                    "0, 1, 2", plain, "{'type': 'spot', 'spot': {}, 'intensity': 9}"),
                fall * fall * seen(1, 1), 1e-3); /* the camera sees a pixel */
    /* down the node's -z: from the front, and turned by 60 degrees about x */
    assert_near(lit(SQUARE "{" LAMP("0") "}", "0, 1, 2", plain, sun), seen(1, 1), 1e-5);
    assert_near(lit(SQUARE "{'rotation': [0.5, 0, 0, 0.8660254], " LAMP("0") "}", "0, 1, 2", plain, sun),
                seen(1, 0.5), 1e-5);
    /* and every node with a camera: from the back where the scene has not the one in front */
    const char *behind = SQUARE "{'camera': 0, 'translation': [0, 0, -3], 'rotation': [0, 1, 0, 0]}, {" LAMP("0") "}";
    assert_near(lit(behind, "0, 1, 2, 3", "'emissiveFactor': [1, 1, 1]", DARK), M_PI, 1e-5);
    assert_near(lit(behind, "1, 2, 3", "'emissiveFactor': [1, 1, 1]", DARK), 0, 0);
    /* a light that isn't there */
    koksma_scene *scene;
    write_model("lit.gltf", &(model){.nodes = SQUARE LAMP_AT("1", "3"), .roots = "0, 1, 2", .material = plain});
    assert_int_equal(koksma_scene_open("lit.gltf", &scene), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "light 1 of 1 lights does not exist"));
    unlink("lit.gltf");
    unlink("my square.bin");
}

/* Lights of a real scene, in candela: exposed so that white in the centre, which is 3 away, would be 1. */
TEST_CASE(bright_lights_are_exposed)
{
    need_meshes();
    double rgb[3];
    char warnings[2048];
    write_model("lit.gltf", &(model){.nodes = SQUARE LAMP_AT("0", "3"),
                                     .roots = "0, 1, 2",
                                     .material = plain,
                                     .lights = "{'type': 'point', 'intensity': 90000}"});
    look("lit.gltf", rgb, warnings, sizeof warnings);
    assert_near(rgb[0], seen(1, 1), 1e-4);
    assert_string_equal(warnings, "the lights at nodes are too bright: all are divided by 3183\n");
    unlink("lit.gltf");
    unlink("my square.bin");
}

/* A node that swaps left and right leaves the front in front (glTF 2.0, 3.7.4). */
TEST_CASE(mirrored_squares_glow_in_front)
{
    need_meshes();
    static const char *const scales[] = {"1, 1, 1", "-1, 1, 1", "1, -1, 1", "-1, -1, 1", "1, 1, -1"};
    static const double seen[] = {M_PI, M_PI, M_PI, M_PI, 0};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        char nodes[256], json[512];
        snprintf(nodes, sizeof nodes, "{'mesh': 0, 'scale': [%s]}, {'mesh': 0, 'translation': [8, 0, 0]}, {%s}",
                 scales[i], LAMP("0"));
        assert_near(lit(nodes, "0, 1, 2, 3", "'emissiveFactor': [1, 1, 1]", DARK), seen[i], 1e-5);
        /* the same as a mesh of a scene */
        write_model("lit.gltf", &(model){.nodes = nodes, .roots = "0, 1, 2", .material = plain});
        snprintf(json, sizeof json,
                 "{'camera': {'eye': [0, 0, 3], 'target': [0, 0, 0], 'fov_deg': 0.1}, 'materials': [], 'shapes': "
                 "[{'kind': 'mesh', 'file': 'lit.gltf', 'emission': 1}]}");
        write_json("lit.json", json);
        double rgb[3];
        char warnings[2048];
        look("./lit.json", rgb, warnings, sizeof warnings);
        assert_near(rgb[0] * M_PI, seen[i], 1e-5);
        unlink("lit.json");
        unlink("lit.gltf");
        unlink("my square.bin");
    }
}

/* Without doubleSided only front-facing triangles are seen, with it both sides are (glTF 2.0, section 3.9.6): of a
   square that emits 1, before one lit by a light and whose winding the node's scale, mirroring or not, decides (3.7.4).
   The camera sees through a back to what is behind. As instances of one mesh, and alone. */
TEST_CASE(backs_are_seen_as_the_file_says)
{
    need_meshes();
    static const struct {
        const char *node;
        bool front;
    } nodes[] = {{"", true},
                 {", 'scale': [1, 1, -1]", false},
                 {", 'scale': [-1, 1, -1]", false},
                 {", 'scale': [-1, -1, -1]", false},
                 {", 'rotation': [0, 1, 0, 0]", false},
                 {", 'scale': [-1, 1, 1], 'rotation': [0, 1, 0, 0]", false},
                 {", 'scale': [1, 1, -1], 'rotation': [0, 1, 0, 0]", true},
                 {", 'scale': [-2, 1, 1]", true}};
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++) {
        for (int two = 0; two < 2; two++) {
            const char *material =
                two ? "'emissiveFactor': [1, 1, 1], 'doubleSided': true" : "'emissiveFactor': [1, 1, 1]";
            char text[256];
            snprintf(text, sizeof text, "{'mesh': 0%s}, {" LAMP("0") "}", nodes[i].node);
            assert_near(lit(text, "0, 1, 2", material, DARK), two || nodes[i].front ? M_PI : 0, 1e-5);
            snprintf(text, sizeof text, "{'mesh': 0%s}, {" LAMP("0") "}, {'mesh': 0%s, 'translation': [9, 0, 0]}",
                     nodes[i].node, nodes[i].node);
            assert_near(lit(text, "0, 1, 2, 3", material, DARK), two || nodes[i].front ? M_PI : 0, 1e-5);
        }
    }
    /* the camera, at z = 3, sees a square at 0 through the back of one at 1, which casts its shadow: a light beyond it
       leaves the square at 0 dark, one between them does not */
#define BETWEEN "{'mesh': 0}, {'mesh': 0, 'translation': [0, 0, 1], 'rotation': [0, 1, 0, 0]}, "
    assert_near(lit(BETWEEN LAMP_AT("0", "3"), "0, 1, 2, 3", plain, NULL), 0, 0);
    assert_near(lit(BETWEEN LAMP_AT("0", "0.6"), "0, 1, 2, 3", plain, "{'type': 'point', 'intensity': 0.09}"),
                0.25 * seen(1, 1), 1e-4);
    assert_near(lit(BETWEEN LAMP_AT("0", "3"), "0, 1, 2, 3",
                    "'pbrMetallicRoughness': {'metallicFactor': 0}, 'doubleSided': true", NULL),
                9.0 / 4 * seen(1, 1), 1e-4);
}

/* A material of glTF that emits and is double-sided lights what is behind it as what is before it. */
TEST_CASE(double_sided_glow_lights_both_sides)
{
    need_meshes();
    double got[2][2];
    for (int two = 0; two < 2; two++) {
        for (int turned = 0; turned < 2;
             turned++) { /* the glowing square is beyond the camera, and turned to it or away */
            char nodes[512];
            snprintf(
                nodes, sizeof nodes,
                "{'mesh': 0, 'scale': [0.01, 0.01, 0.01]}, {'mesh': 0, 'translation': [0, 0, 4]%s}, {" LAMP("0") "}",
                turned ? ", 'rotation': [0, 1, 0, 0]" : "");
            got[two][turned] =
                lit(nodes, "0, 1, 2, 3",
                    two ? "'emissiveFactor': [1, 1, 1], 'doubleSided': true" : "'emissiveFactor': [1, 1, 1]", DARK);
        }
    }
    assert_near(got[0][0], M_PI, 1e-5); /* the back gives no light: only what the small square emits */
    assert_true(got[0][1] > M_PI + 0.01);
    assert_true(got[1][0] > M_PI + 0.01);
    assert_true(got[1][1] > M_PI + 0.01);
}

/* Triangles run counterclockwise about their normals, whatever the node's matrix, in a scene of the bare file (where
   the placement mirrors) and as one mesh (where the file's reader does). */
TEST_CASE(mirrored_normals_stay_outside)
{
    need_meshes();
    static const float square[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    test_write_bytes("turn.bin", square, sizeof square);
    for (int i = 0; i < 8; i++) {
        const int x = i & 1 ? -2 : 1, y = i & 2 ? -1 : 3, z = i & 4 ? -1 : 1;
        char text[1024];
        snprintf(
            text, sizeof text,
            "{'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0, 1]}], 'nodes': [{'mesh': 0, 'scale': [%d, %d, "
            "%d], 'translation': [1, 2, 3]}, {'mesh': 0}], 'meshes': [{'primitives': [{'attributes': {'POSITION': 0, "
            "'NORMAL': 1}, 'mode': 5}]}], 'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': "
            "'VEC3'}, {'bufferView': 0, 'byteOffset': 48, 'componentType': 5126, 'count': 4, 'type': 'VEC3'}], "
            "'bufferViews': [{'buffer': 0, 'byteLength': 96}], 'buffers': [{'byteLength': 96, 'uri': 'turn.bin'}]}",
            x, y, z);
        write_json("turn.gltf", text);
        koksma__mesh one = {0};
        koksma_scene *scene;
        assert_ok(koksma__mesh_read("turn.gltf", KOKSMA__BY_FILE, NULL, &one));
        assert_ok(koksma_scene_open("turn.gltf", &scene));
        assert_int_equal(one.n_triangles, 4);
        assert_int_equal(scene->n_placements, 2);
        assert_int_equal(scene->n_meshes, x * y * z < 0 ? 2 : 1);
        for (size_t t = 0; t < 4; t++) {
            static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
            const koksma__placement *p = &scene->placements[t / 2];
            const koksma__mesh *mesh = &scene->meshes[p->mesh];
            float a[9], b[9];
            koksma__placed_triangle(&one, identity, t, a);
            koksma__placed_triangle(mesh, p->matrix, t % 2, b);
            assert_memory_equal(a, b, sizeof a);
            const double turn = (double)((a[3] - a[0]) * (a[7] - a[1]) - (a[4] - a[1]) * (a[6] - a[0]));
            const double outside = t < 2 ? z : 1;
            assert_true(turn * outside > 0);
            assert_near((double)one.normals[3 * one.indices[3 * t] + 2], outside, 0);
            /* by the inverse transposed, whose sign the determinant's goes with */
            double normal[9];
            koksma__normal_matrix(p->matrix, normal);
            assert_true(normal[8] * (double)mesh->normals[3 * mesh->indices[3 * (t % 2)] + 2] * outside > 0);
        }
        koksma_scene_close(scene);
        koksma__mesh_fini(&one);
    }
    unlink("turn.gltf");
    unlink("turn.bin");
}
