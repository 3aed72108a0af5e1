/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of pbrt-v4 that stand for numbers which its format can also give directly: power and illuminance, the
 * film's sensitivity and exposure, crops, attributes, mixes, levels and wraps of images, and the default texture
 * coordinates. Each is rendered beside a twin with the numbers written out, which follow from pbrt-v4's definitions
 * (lights.cpp, film.cpp, textures.cpp, materials.h, shapes.h), and all pixels are equal.
 */
#include "scene_files.h"

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
#define PATCH "\"point3 P\" [-1 -1 0  1 -1 0  -1 1 0  1 1 0] "
/* Two triangles of the square without shared corners, with pbrt's default coordinates. */
#define APART                                                                                                        \
    "\"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 -1 0  1 1 0  -1 1 0] \"integer indices\" [0 1 2 3 4 5] \"point2 uv\" " \
    "[0 0 1 0 1 1  0 0 1 0 1 1] "
#define SKY "LightSource \"infinite\" \"rgb L\" [1 1 1] "
#define SHOW "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"trianglemesh\" " SQUARE UV
#define UV "\"point2 uv\" [0 0 1 0 1 1 0 1] "
#define LIT(light) "AttributeBegin Material \"none\" Translate 0 2 0 Rotate 90 1 0 0 " light " AttributeEnd" FLOOR
#define IMAGE(name, rest) "Texture \"" name "\" \"spectrum\" \"imagemap\" \"string filename\" " rest " "
#define CHECKS(name, first, second)                                                                                  \
    "Texture \"" name "\" \"spectrum\" \"checkerboard\" \"rgb tex1\" " first " \"rgb tex2\" " second                 \
    " \"float uscale\" 4 \"float vscale\" 4 "

/* Two scenes. */
typedef struct twins {
    const char *head, *world, *twin_head, *twin_world;
    double number[3]; /* the numbers that the twin's %.9g stand for */
} twins;

static void check_all(const twins *all, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        char text[2048], world[1024], twin[2048];
        snprintf(text, sizeof text, "%s WorldBegin\n%s", all[i].head, all[i].world);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
        snprintf(world, sizeof world, all[i].twin_world, all[i].number[0], all[i].number[1], all[i].number[2]);
#pragma GCC diagnostic pop
        snprintf(twin, sizeof twin, "%s WorldBegin\n%s", all[i].twin_head, world);
        check_twins(text, twin);
    }
}

TEST_CASE(lights_have_their_power)
{
    const double inner = 25 * M_PI / 180, outer = 40 * M_PI / 180;
    const double cone = 2 * M_PI * ((1 - cos(inner)) + (cos(inner) - cos(outer)) / 2), pi2 = M_PI * M_PI;
    const twins all[] = {
#define WORLD(text, twin, ...)                                                                                       \
    {                                                                                                                \
        VIEW FILM, text, VIEW FILM, twin,                                                                            \
        {                                                                                                            \
            __VA_ARGS__                                                                                              \
        }                                                                                                            \
    }
        WORLD("LightSource \"point\" \"rgb I\" [1 2 3] \"float power\" 50 \"float scale\" 0.5 \"point3 from\" [1 2 "
              "2]" FLOOR,
              "LightSource \"point\" \"rgb I\" [%.9g %.9g %.9g] \"point3 from\" [1 2 2]" FLOOR, 25 / (4 * M_PI),
              50 / (4 * M_PI), 75 / (4 * M_PI)),
        WORLD(
            "LightSource \"spot\" \"rgb I\" [1 1 1] \"float power\" 30 \"point3 from\" [0 2 1] \"point3 to\" [0 0 0] "
            "\"float coneangle\" 40 \"float conedeltaangle\" 15" FLOOR,
            "LightSource \"spot\" \"rgb I\" [%.9g %.9g %.9g] \"point3 from\" [0 2 1] \"point3 to\" [0 0 0] \"float "
            "coneangle\" 40 \"float conedeltaangle\" 15" FLOOR,
            30 / cone, 30 / cone, 30 / cone),
        WORLD("LightSource \"distant\" \"rgb L\" [1 1 2] \"float illuminance\" 3 \"point3 from\" [1 1 1]" FLOOR,
              "LightSource \"distant\" \"rgb L\" [%.9g %.9g %.9g] \"point3 from\" [1 1 1]" FLOOR, 3, 3, 6),
        WORLD("LightSource \"infinite\" \"rgb L\" [1 1 2] \"float illuminance\" 3" FLOOR,
              "LightSource \"infinite\" \"rgb L\" [%.9g %.9g %.9g]" FLOOR, 3 / M_PI, 3 / M_PI, 6 / M_PI),
        /* 4 x 4 pixels of .25; in 4 of them z is 3/4, in the others at most 0 */
        WORLD("LightSource \"infinite\" \"string filename\" \"even.pfm\" \"float illuminance\" 3" FLOOR,
              "LightSource \"infinite\" \"string filename\" \"even.pfm\" \"float scale\" %.9g" FLOOR,
              3 / (2 * M_PI * 3 / 16 * 0.25), 0, 0),
        WORLD(LIT("AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"float power\" 9 Shape \"sphere\" \"float radius\" "
                  "0.4"),
              LIT("AreaLightSource \"diffuse\" \"rgb L\" [%.9g %.9g %.9g] Shape \"sphere\" \"float radius\" 0.4"),
              9 / (4 * pi2 * 0.16), 9 / (4 * pi2 * 0.16), 9 / (4 * pi2 * 0.16)),
        WORLD(LIT("AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"float power\" 9 Shape \"disk\" \"float radius\" "
                  "0.4"),
              LIT("AreaLightSource \"diffuse\" \"rgb L\" [%.9g %.9g %.9g] Shape \"disk\" \"float radius\" 0.4"),
              9 / (pi2 * 0.16), 9 / (pi2 * 0.16), 9 / (pi2 * 0.16)),
        /* each of the triangles has the power; with two sides, both together */
        WORLD(LIT("AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"float power\" 9 Shape \"trianglemesh\" " SQUARE),
              LIT("AreaLightSource \"diffuse\" \"rgb L\" [%.9g %.9g %.9g] Shape \"trianglemesh\" " SQUARE),
              9 / (2 * M_PI), 9 / (2 * M_PI), 9 / (2 * M_PI)),
        WORLD(LIT("AreaLightSource \"diffuse\" \"bool twosided\" true \"rgb L\" [1 1 1] \"float power\" 9 Shape "
                  "\"bilinearmesh\" " PATCH),
              LIT("AreaLightSource \"diffuse\" \"bool twosided\" true \"rgb L\" [%.9g %.9g %.9g] Shape "
                  "\"bilinearmesh\" " PATCH),
              9 / (8 * M_PI), 9 / (8 * M_PI), 9 / (8 * M_PI)),
        /* the radius counts before the matrix */
        WORLD(LIT("Scale 2 2 2 AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"float power\" 9 Shape \"sphere\" "
                  "\"float "
                  "radius\" 0.2"),
              LIT("Scale 2 2 2 AreaLightSource \"diffuse\" \"rgb L\" [%.9g %.9g %.9g] Shape \"sphere\" \"float "
                  "radius\" "
                  "0.2"),
              9 / (4 * pi2 * 0.04), 9 / (4 * pi2 * 0.04), 9 / (4 * pi2 * 0.04)),
    };
    koksma_image even;
    char path[128];
    snprintf(path, sizeof path, "%s/even.pfm", folder);
    assert_ok(koksma_image_init(&even, 4, 4, 3));
    for (int i = 0; i < 48; i++) {
        even.pixels[i] = 0.25f;
    }
    assert_ok(koksma_image_write(path, &even, NULL));
    koksma_image_fini(&even);
    check_all(all, koksma_mesh_tracer() ? sizeof all / sizeof *all : 0);
    unlink(path);
}

TEST_CASE(films_have_their_exposure)
{
#define EXPOSED(camera, film, factor)                                                                                \
    {                                                                                                                \
        VIEW camera "Film \"rgb\" " SIZE film,                                                                       \
            "LightSource \"point\" \"rgb I\" [9 9 9] \"point3 from\" [1 2 2]" FLOOR, VIEW FILM,                      \
            "LightSource \"point\" \"rgb I\" [%.9g %.9g %.9g] \"point3 from\" [1 2 2]" FLOOR,                        \
        {                                                                                                            \
            9 * (factor), 9 * (factor), 9 * (factor)                                                                 \
        }                                                                                                            \
    }
    static const twins all[] = {EXPOSED("", " \"float iso\" 250", 2.5),
                                EXPOSED("", " \"float iso\" 200 \"float exposuretime\" 0.25", 0.5),
                                EXPOSED("\"float shutteropen\" 0.5 \"float shutterclose\" 0.75 ", "", 0.25),
                                EXPOSED("\"float shutterclose\" 2 ", " \"float iso\" 300", 6)};
    check_all(all, sizeof all / sizeof *all);
}

/* Attributes are parameters that directives have unless they give their own, until the AttributeEnd. */
TEST_CASE(attributes_are_parameters)
{
#define SAME(text, twin)                                                                                             \
    {                                                                                                                \
        VIEW FILM, SKY text, VIEW FILM, SKY twin,                                                                    \
        {                                                                                                            \
            0                                                                                                        \
        }                                                                                                            \
    }
    static const twins all[] = {
        SAME("AttributeBegin Attribute \"shape\" \"float radius\" 0.4 Shape \"sphere\" AttributeEnd",
             "Shape \"sphere\" \"float radius\" 0.4"),
        SAME("Attribute \"shape\" \"float radius\" 0.4 \"float height\" 1 Shape \"sphere\" \"float radius\" 0.7",
             "Shape \"sphere\" \"float radius\" 0.7"),
        SAME("Attribute \"shape\" \"float radius\" 0.4 Attribute \"shape\" \"float radius\" 0.7 Shape \"sphere\"",
             "Shape \"sphere\" \"float radius\" 0.7"),
        SAME("AttributeBegin Attribute \"shape\" \"float radius\" 0.4 AttributeEnd Shape \"sphere\"",
             "Shape \"sphere\" \"float radius\" 1"),
        SAME("Attribute \"material\" \"rgb reflectance\" [0.1 0.2 0.3] Material \"diffuse\" Shape \"sphere\"",
             "Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3] Shape \"sphere\""),
        SAME("Attribute \"material\" \"rgb reflectance\" [0.1 0.2 0.3] MakeNamedMaterial \"m\" \"string type\" "
             "\"diffuse\" NamedMaterial \"m\" Shape \"sphere\"",
             "Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3] Shape \"sphere\""),
        SAME("Attribute \"light\" \"float scale\" 3 LightSource \"point\" \"point3 from\" [1 2 2]" FLOOR,
             "LightSource \"point\" \"float scale\" 3 \"point3 from\" [1 2 2]" FLOOR),
        SAME("Attribute \"texture\" \"rgb value\" [0.1 0.7 0.3] Texture \"t\" \"spectrum\" \"constant\" Material "
             "\"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\"",
             "Material \"diffuse\" \"rgb reflectance\" [0.1 0.7 0.3] Shape \"sphere\"")};
    check_all(all, sizeof all / sizeof *all);
}

/* (1 - amount) first + amount second, of materials and of textures. */
TEST_CASE(mixes_are_means)
{
#define NAMED(name, rest) "MakeNamedMaterial \"" name "\" \"string type\" " rest " "
#define MIXED(amount) "Material \"mix\" \"string materials\" [\"a\" \"b\"] " amount " Shape \"sphere\""
#define TWO(first, second) NAMED("a", first) NAMED("b", second)
#define METAL(r) "\"conductor\" \"rgb reflectance\" " r " \"float roughness\" 0.3"
#define MIX(rest) "Texture \"t\" \"spectrum\" \"mix\" " rest " "
    static const twins all[] = {
        SAME(TWO("\"diffuse\" \"rgb reflectance\" [0.1 0.2 0.9]", "\"diffuse\" \"rgb reflectance\" [0.5 0.2 0.1]")
                 MIXED("\"float amount\" 0.25"),
             "Material \"diffuse\" \"rgb reflectance\" [0.2 0.2 0.7] Shape \"sphere\""),
        SAME(TWO("\"diffuse\" \"rgb reflectance\" [0.1 0.2 0.9]", "\"diffuse\" \"rgb reflectance\" [0.5 0.2 0.1]")
                 MIXED(""),
             "Material \"diffuse\" \"rgb reflectance\" [0.3 0.2 0.5] Shape \"sphere\""),
        SAME(TWO(METAL("[0.2 0.4 0.6]"), METAL("[1 0.8 0.6]")) MIXED("\"float amount\" 0.25"),
             "Material " METAL("[0.4 0.5 0.6]") " Shape \"sphere\""),
        SAME(TWO(METAL("[0.2 0.4 0.6]"), "\"diffuse\" \"rgb reflectance\" [0.1 0.2 0.9]") MIXED("\"float amount\" 1"),
             "Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.9] Shape \"sphere\""),
        SAME(MIX("\"rgb tex1\" [0.1 0.2 0.9] \"rgb tex2\" [0.5 0.2 0.1] \"float amount\" 0.25") SHOW,
             "Material \"diffuse\" \"rgb reflectance\" [0.2 0.2 0.7] Shape \"trianglemesh\" " SQUARE UV),
        SAME(CHECKS("c", "[0.1 0.2 0.9]", "[0.9 0.2 0.1]")
                 MIX("\"texture tex1\" \"c\" \"rgb tex2\" [0.5 0.2 0.1] \"float amount\" 0.25") SHOW,
             CHECKS("t", "[0.2 0.2 0.7]", "[0.8 0.2 0.1]") SHOW),
        SAME("Texture \"c\" \"float\" \"checkerboard\" \"float uscale\" 4 \"float vscale\" 4 " MIX(
                 "\"rgb tex1\" [0.1 0.2 0.9] \"rgb tex2\" [0.5 0.2 0.1] \"texture amount\" \"c\"") SHOW,
             CHECKS("t", "[0.5 0.2 0.1]", "[0.1 0.2 0.9]") SHOW)};
    check_all(all, koksma_mesh_tracer() ? sizeof all / sizeof *all : 0);
}

/* ---- Images --------------------------------------------------------------------------------------------------- */

enum { SIDE = 2 };

static void write_image(const char *name, const koksma_image *image)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_ok(koksma_image_write(path, image, NULL));
}

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

/* A mesh without uv has (0, 0), (1, 0), (1, 1) at each triangle, a patch (0, 0), (1, 0), (0, 1), (1, 1). */
TEST_CASE(meshes_have_default_coordinates)
{
#define TEXTURED(shape)                                                                                              \
    CHECKS("t", "[0.9 0.2 0.1]", "[0.1 0.2 0.9]") "Material \"diffuse\" \"texture reflectance\" \"t\" " shape
    static const twins all[] = {
        SAME(TEXTURED("Shape \"trianglemesh\" " SQUARE), TEXTURED("Shape \"trianglemesh\" " APART)),
        SAME(TEXTURED("Shape \"bilinearmesh\" " PATCH),
             TEXTURED("Shape \"bilinearmesh\" " PATCH "\"point2 uv\" [0 0  1 0  0 1  1 1]"))};
    check_all(all, koksma_mesh_tracer() ? sizeof all / sizeof *all : 0);
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
