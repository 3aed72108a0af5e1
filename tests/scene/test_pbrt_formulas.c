/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of pbrt-v4 that stand for numbers which its format can also give directly: power and illuminance, the
 * film's sensitivity and exposure, crops, attributes, mixes, levels and wraps of images, and the default texture
 * coordinates. Each is rendered beside a twin with the numbers written out, which follow from pbrt-v4's definitions
 * (lights.cpp, film.cpp, textures.cpp, materials.h, shapes.h), and all pixels are equal.
 */
#include "scene_files.h"
#include "texts.h"

static void render(const koksma_scene *scene, const char *pattern, const char *integrator, koksma_image *out)
{
    koksma_render_options options = options_of(scene, pattern, integrator, 4, scene->width);
    options.height = scene->height;
    options.depth = 2;
    assert_ok(koksma_render(scene, &options, NULL, out));
}

/* Renders both texts; neither has a warning, something is seen, and all pixels agree. */
static void check_twins(const char *text, const char *twin)
{
    const char *const texts[] = {text, twin};
    koksma_image images[2];
    char warning[256];
    double largest = 0, off = 0;
    for (int i = 0; i < 2; i++) {
        koksma_scene *scene = opened("a.pbrt", texts[i]);
        assert_that(!koksma_scene_unknown(scene, 0, warning, sizeof warning), "%s: %s", texts[i], warning);
        render(scene, "sobol", "path", &images[i]);
        koksma_scene_close(scene);
    }
    const size_t n = (size_t)images[0].width * (size_t)images[0].height * (size_t)images[0].channels;
    assert_int_equal(images[0].channels, images[1].channels);
    for (size_t i = 0; i < n; i++) {
        largest = fmax(largest, (double)images[1].pixels[i]);
        off = fmax(off, fabs((double)images[0].pixels[i] - (double)images[1].pixels[i]));
    }
    koksma_image_fini(&images[0]);
    koksma_image_fini(&images[1]);
    assert_that(largest > 1e-3 && off <= 1e-5 * largest, "%s\nis not\n%s: pixels up to %g differ by up to %g", text,
                twin, largest, off);
}

#define SIZE "\"integer xresolution\" 12 \"integer yresolution\" 8"
#define VIEW "LookAt 0 0.5 4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 50 "
#define FILM "Film \"rgb\" " SIZE " "
#define FLOOR                                                                                                        \
    " Material \"diffuse\" \"rgb reflectance\" [0.5 0.7 0.2] AttributeBegin Translate 0 -1 0 Rotate 90 1 0 0 Shape " \
    "\"disk\" \"float radius\" 5 AttributeEnd Shape \"sphere\" \"float radius\" 0.5 "
#define SQUARE "\"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] \"integer indices\" [0 1 2 0 2 3] "
#define SKY "LightSource \"infinite\" \"rgb L\" [1 1 1] "
#define SHOW "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"trianglemesh\" " SQUARE UV
#define UV "\"point2 uv\" [0 0 1 0 1 1 0 1] "
#define IMAGE(name, rest) "Texture \"" name "\" \"spectrum\" \"imagemap\" \"string filename\" " rest " "

static void write_image(const char *name, const koksma_image *image)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_ok(koksma_image_write(path, image, NULL));
}

static void check_case(const char *name, const char *text)
{
    char first[4096];
    const char *second = strstr(text, " == ");
    assert_non_null(second);
    snprintf(first, sizeof first, "%.*s", (int)(second - text), text);
    if (koksma_mesh_tracer() ||
        (strcmp(name, "light") != 0 && strcmp(name, "mix") != 0 && strcmp(name, "mesh") != 0)) {
        check_twins(first, second + 4);
    }
}

TEST_CASE(texts_are_their_twins)
{
#define WORLD VIEW FILM "WorldBegin "
    static const shared_text shared[] = {
        {"{V}", VIEW},
        {"{S}", SIZE},
        {"{W}", WORLD},
        {"{K}", WORLD "LightSource \"infinite\" \"rgb L\" [1 1 1] "},
        {"{F}", FLOOR},
        {"{L}", "AttributeBegin Material \"none\" Translate 0 2 0 Rotate 90 1 0 0 "},
        {"{/L}", " AttributeEnd" FLOOR},
        {"{Q}", SQUARE},
        {"{U}", UV},
        {"{T}", "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"trianglemesh\" " SQUARE UV},
        {NULL, NULL}};
    koksma_image even;
    assert_ok(koksma_image_init(&even, 4, 4, 3));
    for (int i = 0; i < 48; i++) {
        even.pixels[i] = 0.25f;
    }
    write_image("even.pfm", &even);
    koksma_image_fini(&even);
    assert_int_equal(each_text("scene/twins.txt", shared, check_case), 31);
}

/* ---- Images --------------------------------------------------------------------------------------------------- */

enum { SIDE = 2 };

/* An image of SIDE x SIDE pixels with other levels: gain * v + plus, or v^gamma. */
static void write_levels(const char *name, const float *levels, double gain, double plus, double gamma)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, SIDE, SIDE, 3));
    for (int i = 0; i < 3 * SIDE * SIDE; i++) {
        image.pixels[i] = (float)(gain * pow((double)levels[i], gamma) + plus);
    }
    write_image(name, &image);
    koksma_image_fini(&image);
}

/* The same within a frame of its own size in all directions, of one level. */
static void write_framed(const char *name, const float *levels, float frame, double gain, double plus)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, 3 * SIDE, 3 * SIDE, 3));
    for (int i = 0; i < 27 * SIDE * SIDE; i++) {
        const int k = i % 3, x = i / 3 % (3 * SIDE) - SIDE, y = i / 3 / (3 * SIDE) - SIDE;
        const bool inside = x >= 0 && x < SIDE && y >= 0 && y < SIDE;
        image.pixels[i] = inside ? (float)(gain * (double)levels[3 * (SIDE * y + x) + k] + plus) : frame;
    }
    write_image(name, &image);
    koksma_image_fini(&image);
}

static double to_linear(double level)
{
    return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4);
}

TEST_CASE(images_have_their_levels)
{
    static const unsigned char coded[3 * SIDE * SIDE] = {20, 200, 128, 255, 0, 64, 90, 180, 30, 10, 250, 140};
#define TWIN "\"twin.pfm\" \"string wrap\" \"clamp\""
#define MIX(rest) "Texture \"t\" \"spectrum\" \"mix\" " rest " "
#define FAR_AWAY_OF(file) file " \"float uscale\" 3 \"float vscale\" 3 \"float udelta\" -1 \"float vdelta\" -1 "
    static const struct {
        const char *texture;
        enum { LEVELS, FRAMED } kind;
        bool linear; /* of a PNG, the levels themselves, not what they mean in sRGB */
        double gain, plus, gamma;
    } all[] = {
        {IMAGE("t", "\"base.pfm\" \"string wrap\" \"clamp\" \"float scale\" 0.5"), LEVELS, false, 0.5, 0, 1},
        {IMAGE("t", "\"base.pfm\" \"string wrap\" \"clamp\" \"bool invert\" true"), LEVELS, false, -1, 1, 1},
        {IMAGE("t", "\"base.pfm\" \"string wrap\" \"clamp\" \"bool invert\" true \"float scale\" 0.5"), LEVELS, false,
         -.5, 1, 1},
        {IMAGE("t", "\"base.png\" \"string wrap\" \"clamp\""), LEVELS, false, 1, 0, 1},
        {IMAGE("t", "\"base.png\" \"string wrap\" \"clamp\" \"string encoding\" \"sRGB\""), LEVELS, false, 1, 0, 1},
        {IMAGE("t", "\"base.png\" \"string wrap\" \"clamp\" \"string encoding\" \"linear\""), LEVELS, true, 1, 0, 1},
        {IMAGE("t", "\"base.png\" \"string wrap\" \"clamp\" \"string encoding\" \"gamma 1.5\""), LEVELS, true, 1, 0,
         1.5},
        {IMAGE("t", "\"base.pfm\" \"string wrap\" \"clamp\" \"string encoding\" \"linear\""), LEVELS, false, 1, 0, 1},
        {IMAGE("t", FAR_AWAY_OF("\"base.pfm\"") "\"string wrap\" \"black\""), FRAMED, false, 1, 0, 1},
        {IMAGE("t", FAR_AWAY_OF("\"base.pfm\"") "\"string wrap\" \"black\" \"bool invert\" true"), FRAMED, false, -1,
         1, 1},
        {IMAGE("i",
               "\"base.pfm\" \"string wrap\" \"clamp\"") "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"i\" "
                                                         "\"float scale\" 0.25 ",
         LEVELS, false, 0.25, 0, 1},
        {IMAGE("i", "\"base.pfm\" \"string wrap\" \"clamp\"")
             MIX("\"texture tex1\" \"i\" \"rgb tex2\" [0.4 0.4 0.4] \"float amount\" 0.25"),
         LEVELS, false, 0.75, 0.1, 1},
        {IMAGE("i", "\"base.pfm\" \"string wrap\" \"clamp\"")
             MIX("\"texture tex2\" \"i\" \"rgb tex1\" [0.4 0.4 0.4] \"float amount\" 0.25"),
         LEVELS, false, 0.25, 0.3, 1}};
    float linear[3 * SIDE * SIDE], levels[3 * SIDE * SIDE];
    for (int i = 0; i < 3 * SIDE * SIDE; i++) {
        levels[i] = (float)coded[i] / 255;
        linear[i] = (float)to_linear((double)levels[i]);
    }
    write_levels("base.pfm", linear, 1, 0, 1);
    write_levels("base.png", linear, 1, 0, 1);
    for (size_t i = 0; koksma_mesh_tracer() && i < sizeof all / sizeof *all; i++) {
        char text[2048];
        if (all[i].kind == FRAMED) {
            write_framed("twin.pfm", linear, (float)all[i].plus, all[i].gain, all[i].plus);
        } else {
            write_levels("twin.pfm", all[i].linear ? levels : linear, all[i].gain, all[i].plus, all[i].gamma);
        }
        snprintf(text, sizeof text, VIEW FILM " WorldBegin\n" SKY "%s" SHOW, all[i].texture);
        check_twins(text, VIEW FILM " WorldBegin\n" SKY IMAGE("t", TWIN) SHOW);
    }
}

/* ---- Crops ---------------------------------------------------------------------------------------------------- */

/* A crop is that part of the whole picture: of the sensor, of an off-centre window, of parallel rays, of a lens, which
   does not blur a disk at its distance of focus. */
TEST_CASE(crops_are_parts)
{
    static const struct {
        const char *camera, *crop, *world;
        int from[2], to[2];
    } all[] = {{"\"perspective\" \"float fov\" 50", "\"integer pixelbounds\" [2 9 1 5]", FLOOR, {2, 1}, {9, 5}},
               {"\"perspective\" \"float fov\" 50", "\"float cropwindow\" [0.25 0.75 0.5 1]", FLOOR, {3, 4}, {9, 8}},
               {"\"perspective\" \"float fov\" 50", "\"float cropwindow\" [0.2 0.7 0.6 1]", FLOOR, {3, 5}, {9, 8}},
               {"\"perspective\" \"float fov\" 50", "\"integer pixelbounds\" [-3 90 6 9]", FLOOR, {0, 6}, {12, 8}},
               {"\"perspective\" \"float fov\" 50 \"float lensradius\" 0.1 \"float focaldistance\" 4",
                "\"integer pixelbounds\" [2 9 1 5]",
                "Material \"diffuse\" Shape \"disk\"",
                {2, 1},
                {9, 5}},
               {"\"perspective\" \"float fov\" 50 \"float screenwindow\" [-1 2 -0.7 1.3]",
                "\"integer pixelbounds\" [2 9 1 5]",
                FLOOR,
                {2, 1},
                {9, 5}},
               {"\"orthographic\" \"float screenwindow\" [-3 3 -2 2]",
                "\"integer pixelbounds\" [2 9 1 5]",
                FLOOR,
                {2, 1},
                {9, 5}}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        koksma_image images[2];
        for (int k = 0; k < 2; k++) {
            char text[2048];
            snprintf(text, sizeof text,
                     "LookAt 0 0 4  0 0 0  0 1 0 Camera %s Film \"rgb\" " SIZE " %s WorldBegin LightSource "
                     "\"point\" \"rgb I\" [9 9 9] \"point3 from\" [1 2 2] %s",
                     all[i].camera, k ? all[i].crop : "", all[i].world);
            koksma_scene *scene = opened("a.pbrt", text);
            assert_int_equal(scene->n_unknown, 0);
            render(scene, "regular", "direct", &images[k]);
            koksma_scene_close(scene);
        }
        const int *from = all[i].from, *to = all[i].to;
        assert_int_equal(images[1].width, to[0] - from[0]);
        assert_int_equal(images[1].height, to[1] - from[1]);
        double seen = 0;
        for (int y = from[1]; y < to[1]; y++) {
            for (int x = from[0]; x < to[0]; x++) {
                const int channels = images[0].channels;
                const float *whole = images[0].pixels + channels * (y * 12 + x);
                const float *part = images[1].pixels + channels * ((y - from[1]) * (to[0] - from[0]) + x - from[0]);
                seen += (double)whole[0];
                assert_that(fabs((double)part[0] - (double)whole[0]) <= 1e-4, "%s %s: pixel %d, %d is %g, not %g",
                            all[i].camera, all[i].crop, x, y, (double)part[0], (double)whole[0]);
            }
        }
        assert_true(seen > 0.1);
        koksma_image_fini(&images[0]);
        koksma_image_fini(&images[1]);
    }
}

/* Off-centre windows of a perspective camera show that part of the image plane: the middle of the window [1, 3] x
   [-1, 1] at 90 degrees is seen along (2, 0, 1), 45 degrees times 2 to the right. */
TEST_CASE(windows_may_be_off_centre)
{
    static const char *const places[] = {"4 0 2", "-4 0 2", "0 0 2"};
    for (int i = 0; i < 3; i++) {
        char whole[1024];
        koksma_layers layers;
        snprintf(
            whole, sizeof whole,
            "LookAt 0 0 0  0 0 1  0 1 0 Camera \"perspective\" \"float fov\" 90 \"float screenwindow\" [1 3 -1 1] "
            "Film \"rgb\" \"integer xresolution\" 9 \"integer yresolution\" 9 WorldBegin " SKY
            "Material \"diffuse\" Translate %s Shape \"sphere\" \"float radius\" 0.4",
            places[i]);
        koksma_scene *scene = opened("a.pbrt", whole);
        koksma_render_options options = options_of(scene, "regular", "utah", 1, 9);
        options.height = 9;
        assert_ok(koksma_render_layers(scene, &options, NULL, &layers));
        /* the distance of the sphere at (4, 0, 2), whose centre is seen by the pixel in the middle */
        const double depth = (double)layers.depth.pixels[4 * 9 + 4];
        assert_int_equal(depth > 0 && depth < 100, i == 0);
        koksma_layers_fini(&layers);
        koksma_scene_close(scene);
    }
}
