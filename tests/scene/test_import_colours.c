/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours of pbrt's and Mitsuba's scenes that may be above 1: eta and k of metals, coefficients of media, factors of
 * daylight. Each form of one value (numbers, pairs, samples at equal or listed wavelengths, textures, the names of
 * Mitsuba 2) gives the same colour. Indices of refraction and directions of any size give finite pictures.
 */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "render/materials/materials.h"
#include "rendering.h"
#include "scene/import.h"

static char folder[64];

static koksma_status open_as(const char *name, const char *text, koksma_scene **out)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    const koksma_status status = koksma_scene_open(path, out);
    unlink(path);
    return status;
}

static koksma_scene *opened(const char *name, const char *text)
{
    koksma_scene *scene = NULL;
    if (open_as(name, text, &scene)) {
        fail_msg("%s: %s", text, koksma_error_text());
    }
    return scene;
}

/* A build without expat reads no XML. */
static bool can_read(const char *name)
{
    koksma_scene *scene = NULL;
    const koksma_status status = open_as(name, "<scene version=\"3.0.0\"/>", &scene);
    koksma_scene_close(scene);
    return status != KOKSMA_UNSUPPORTED;
}

#define PBRT(head, world)                                                                                            \
    "LookAt 0 0 5  0 0 0  0 1 0\n" head " Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 "            \
    "\"integer yresolution\" 8 WorldBegin " world " Shape \"sphere\""
#define MITSUBA(sensor, rest)                                                                                        \
    "<scene version=\"3.0.0\"><sensor type=\"perspective\">" sensor "</sensor>" rest "</scene>"
#define BALL(bsdf) MITSUBA("", "<shape type=\"sphere\">" bsdf "</shape>")

#define IRREGULAR(name, wavelengths, values)                                                                         \
    "<spectrum " name " type=\"irregular\"><string name=\"wavelengths\" value=\"" wavelengths                        \
    "\"/><string name=\"values\" value=\"" values "\"/></spectrum>"
#define REGULAR(name, kind, low, high, values)                                                                       \
    "<spectrum " name " type=\"regular\"><float name=\"" kind "_min\" value=\"" low "\"/><float name=\"" kind        \
    "_max\" value=\"" high "\"/><string name=\"values\" value=\"" values "\"/></spectrum>"

static void check_rgb(const char *text, const double *rgb, const double *expected, double tolerance)
{
    for (int k = 0; k < 3; k++) {
        if (!(fabs(rgb[k] - expected[k]) <= tolerance)) {
            fail_msg("%s: %g %g %g, expected %g %g %g", text, rgb[0], rgb[1], rgb[2], expected[0], expected[1],
                     expected[2]);
        }
    }
}

/* ---- Metals -------------------------------------------------------------------------------------------------- */

static void fresnel(const double *eta, const double *k, double *rgb)
{
    for (int i = 0; i < 3; i++) {
        rgb[i] = ((eta[i] - 1) * (eta[i] - 1) + k[i] * k[i]) / ((eta[i] + 1) * (eta[i] + 1) + k[i] * k[i]);
    }
}

#define ETA(colon, comma)                                                                                            \
    "400" colon "1.66" comma "450" colon "1.5" comma "500" colon "0.916" comma "550" colon "0.43" comma "600" colon  \
    "0.25" comma "650" colon "0.166" comma "700" colon "0.16"
#define K(colon, comma)                                                                                              \
    "400" colon "1.96" comma "450" colon "1.88" comma "500" colon "1.84" comma "550" colon "2.455" comma "600" colon \
    "3.07" comma "650" colon "3.66" comma "700" colon "4.35"
#define WAVELENGTHS "400 450 500 550 600 650 700"
#define ETAS "1.66 1.5 .916 .43 .25 .166 .16"
#define KS "1.96 1.88 1.84 2.455 3.07 3.66 4.35"
#define METAL(inside) BALL("<bsdf type=\"conductor\">" inside "</bsdf>")
#define PBRT_METAL(before, parameters) PBRT("", before " Material \"conductor\" " parameters " \"float roughness\" 0")

/* Mitsuba 3.9.1 gives these samples of gold the colours below (traverse() in scalar_rgb); the fit of the observer is off by
   up to 1.2 % of the largest channel. */
static void metals_are_the_same_in_all_forms(void **state)
{
    static const struct {
        const char *name, *text;
        bool is_rounded; /* one form of those three numbers, so that the colour is exact */
    } cases[] = {
        {"a.xml",
         METAL(
             "<spectrum name=\"eta\" value=\"" ETA(":", ",") "\"/><spectrum name=\"k\" value=\"" K(":", ",") "\"/>"),
         false},
        {"a.xml", METAL(IRREGULAR("name=\"eta\"", WAVELENGTHS, ETAS) IRREGULAR("name=\"k\"", WAVELENGTHS, KS)),
         false},
        {"a.xml",
         METAL(REGULAR("name=\"eta\"", "wavelength", "400", "700", ETAS)
                   REGULAR("name=\"k\"", "wavelength", "400", "700", KS)),
         false},
        {"a.xml",
         METAL(REGULAR("name=\"eta\"", "lambda", "400", "700", ETAS)
                   REGULAR("name=\"k\"", "lambda", "400", "700", KS)),
         false},
        {"a.xml",
         METAL("<spectrum name=\"eta\" type=\"irregular\"><spectrum name=\"value\" value=\"" ETA(
             ":", ",") "\"/></spectrum><spectrum name=\"k\" value=\"" K(":", ",") "\"/>"),
         false},
        {"a.pbrt", PBRT_METAL("", "\"spectrum eta\" [" ETA(" ", " ") "] \"spectrum k\" [" K(" ", " ") "]"), false},
        {"a.pbrt",
         PBRT_METAL("Texture \"e\" \"spectrum\" \"constant\" \"spectrum value\" [" ETA(" ", " ") "]",
                    "\"texture eta\" \"e\" \"spectrum k\" [" K(" ", " ") "]"),
         false},
        {"a.xml",
         METAL("<rgb name=\"eta\" value=\"0.0759351 0.517804 1.50785\"/><rgb name=\"k\" value=\"3.60454 2.31725 "
               "1.78986\"/>"),
         true},
        {"a.pbrt", PBRT_METAL("", "\"rgb eta\" [0.0759351 0.517804 1.50785] \"rgb k\" [3.60454 2.31725 1.78986]"),
         true},
        {"a.pbrt",
         PBRT_METAL("Texture \"e\" \"spectrum\" \"constant\" \"rgb value\" [0.0759351 0.517804 1.50785]",
                    "\"texture eta\" \"e\" \"rgb k\" [3.60454 2.31725 1.78986]"),
         true},
        {"a.pbrt",
         PBRT_METAL("Texture \"k\" \"spectrum\" \"constant\" \"rgb value\" [3.60454 2.31725 1.78986]",
                    "\"rgb eta\" [0.0759351 0.517804 1.50785] \"texture k\" \"k\""),
         true}};
    static const double eta[] = {0.0759351, 0.517804, 1.50785}, k[] = {3.60454, 2.31725, 1.78986};
    double expected[3];
    (void)state;
    fresnel(eta, k, expected);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (can_read(cases[i].name)) {
            koksma_scene *scene = opened(cases[i].name, cases[i].text);
            assert_int_equal(scene->n_unknown, 0);
            check_rgb(cases[i].text, koksma__material_value(&scene->materials[scene->n_materials - 1], "reflectance"),
                      expected, cases[i].is_rounded ? 1e-6 : 0.012);
            koksma_scene_close(scene);
        }
    }
}

/* The reflectance of eta or k of any size: it tends to 1. */
static void extreme_metals_are_mirrors(void **state)
{
    static const char *const texts[] = {METAL("<float name=\"eta\" value=\"1e300\"/>"),
                                        METAL("<float name=\"eta\" value=\"1\"/><float name=\"k\" value=\"1e300\"/>"),
                                        METAL("<float name=\"eta\" value=\"0\"/><float name=\"k\" value=\"0\"/>")};
    (void)state;
    for (size_t i = 0; can_read("a.xml") && i < sizeof texts / sizeof *texts; i++) {
        koksma_scene *scene = opened("a.xml", texts[i]);
        check_rgb(texts[i], koksma__material_value(&scene->materials[scene->n_materials - 1], "reflectance"),
                  (double[]){1, 1, 1}, 1e-5);
        koksma_scene_close(scene);
    }
}

/* ---- Media --------------------------------------------------------------------------------------------------- */

#define FOG(inside) MITSUBA("<medium type=\"homogeneous\">" inside "</medium>", "<shape type=\"sphere\"/>")
#define PBRT_FOG(parameters)                                                                                         \
    PBRT("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" " parameters " MediumInterface \"\" \"m\"", "")

/* The absorption 2 in all forms, without scattering. */
static void media_are_the_same_in_all_forms(void **state)
{
    static const struct {
        const char *name, *text;
    } cases[] = {
        {"a.xml", FOG("<float name=\"albedo\" value=\"0\"/><float name=\"sigma_t\" value=\"2\"/>")},
        {"a.xml", FOG("<float name=\"albedo\" value=\"0\"/><rgb name=\"sigma_t\" value=\"2\"/>")},
        {"a.xml", FOG("<float name=\"albedo\" value=\"0\"/><spectrum name=\"sigma_t\" value=\"360:2,830:2\"/>")},
        {"a.xml", FOG("<spectrum name=\"sigma_a\" value=\"360:2,830:2\"/>")},
        {"a.xml",
         FOG("<float name=\"albedo\" value=\"0\"/>" REGULAR("name=\"sigma_t\"", "wavelength", "360", "830", "2 2"))},
        {"a.xml",
         FOG("<float name=\"albedo\" value=\"0\"/>" REGULAR("name=\"sigma_t\"", "lambda", "360", "830", "2 2"))},
        {"a.xml", FOG("<float name=\"albedo\" value=\"0\"/><volume name=\"sigma_t\" type=\"constvolume\"><spectrum "
                      "name=\"value\" value=\"360:2,830:2\"/></volume>")},
        {"a.xml", FOG("<float name=\"albedo\" value=\"0\"/><volume name=\"sigma_t\" type=\"constvolume\"><spectrum "
                      "name=\"color\" value=\"360:2,830:2\"/></volume>")}, /* Mitsuba 2 */
        {"a.xml", FOG("<float name=\"scale\" value=\"4\"/><float name=\"albedo\" value=\"0\"/><spectrum "
                      "name=\"sigma_t\" value=\"360:.5,830:.5\"/>")},
        {"a.pbrt", PBRT_FOG("\"rgb sigma_s\" [0 0 0] \"rgb sigma_a\" [2 2 2]")},
        {"a.pbrt", PBRT_FOG("\"rgb sigma_s\" [0 0 0] \"spectrum sigma_a\" [360 2 830 2]")},
        {"a.pbrt",
         PBRT_FOG("\"spectrum sigma_s\" [360 0 830 0] \"spectrum sigma_a\" [360 .1 830 .1] \"float scale\" 20")},
        {"a.pbrt", PBRT_FOG("\"rgb sigma_s\" [0 0 0] \"float scale\" 2")}, /* without sigma_a it is 1 */
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (can_read(cases[i].name)) {
            koksma_scene *scene = opened(cases[i].name, cases[i].text);
            const koksma__medium *m = &scene->medium;
            assert_int_equal(scene->n_unknown, 0);
            assert_true(m->is_there);
            for (int k = 0; k < 3; k++) {
                if (!(fabs(m->absorption[k] - 2) <= 1e-6 && fabs(m->scattering[k]) <= 1e-6)) {
                    fail_msg("%s: %g %g", cases[i].text, m->absorption[k], m->scattering[k]);
                }
            }
            koksma_scene_close(scene);
        }
    }
}

/* A negative coefficient, which pbrt refuses, is none here; a huge one is as large as numbers of scenes may be. */
static void coefficients_are_finite(void **state)
{
    static const char *const bad[] = {PBRT_FOG("\"rgb sigma_a\" [-1 0 0]"), PBRT_FOG("\"rgb sigma_s\" [0 0 -1]"),
                                      PBRT_FOG("\"float scale\" -1")};
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        koksma_scene *scene = NULL;
        const koksma_status status = open_as("a.pbrt", bad[i], &scene);
        assert_int_equal(koksma_status_exit_code(status), 3);
        assert_non_null(strstr(koksma_error_text(), "a.pbrt:2: sigma_"));
        assert_non_null(strstr(koksma_error_text(), ": a coefficient of -1; it must be 0 or more"));
    }
    koksma_scene *scene = opened("a.pbrt", PBRT_FOG("\"rgb sigma_a\" [1e38 1 1] \"float scale\" 1e38"));
    assert_true(scene->medium.absorption[0] == 1e6);
    koksma_scene_close(scene);
}

/* ---- Light --------------------------------------------------------------------------------------------------- */

/* Daylight is white. Samples within it are its factors: those of 3 everywhere make it three times as bright. Outside it
   the same samples are an emission, whose luminance is 3. */
static void daylight_is_white(void **state)
{
#define LIGHT(spectrum) MITSUBA("", "<emitter type=\"constant\">" spectrum "</emitter>")
#define DAYLIGHT(inside) LIGHT("<spectrum type=\"d65\" name=\"radiance\">" inside "</spectrum>")
    static const char *const whites[] = {
        DAYLIGHT("<rgb name=\"color\" value=\"3\"/>"),
        DAYLIGHT("<float name=\"scale\" value=\"3\"/>"),
        DAYLIGHT("<spectrum name=\"color\" value=\"360:3,830:3\"/>"),
        DAYLIGHT("<spectrum name=\"color\" value=\"360:.5,830:.5\"/><float name=\"scale\" value=\"6\"/>"),
        DAYLIGHT(IRREGULAR("name=\"color\"", "360 830", "3 3")),
        DAYLIGHT(IRREGULAR("", "360 830", "3 3")),
        DAYLIGHT(REGULAR("", "wavelength", "360", "830", "3 3")),
        DAYLIGHT("<spectrum type=\"d65\">" IRREGULAR("", "360 830", "3 3") "</spectrum>"),
        DAYLIGHT("<spectrum type=\"uniform\"><float name=\"value\" value=\"3\"/></spectrum>"),
        LIGHT("<spectrum type=\"srgb\" name=\"radiance\"><rgb name=\"color\" value=\"3\"/></spectrum>"),
        LIGHT("<spectrum type=\"srgb\" name=\"radiance\"><spectrum name=\"color\" "
              "value=\"360:3,830:3\"/></spectrum>"),
        LIGHT("<spectrum type=\"srgb_d65\" name=\"radiance\"><rgb name=\"color\" "
              "value=\"3\"/></spectrum>"), /* Mitsuba 2 */
    };
    static const char *const reddish[] = {LIGHT("<spectrum name=\"radiance\" value=\"360:3,830:3\"/>"),
                                          LIGHT(IRREGULAR("name=\"radiance\"", "360 830", "3 3")),
                                          LIGHT(REGULAR("name=\"radiance\"", "lambda", "360", "830", "3 3"))};
    (void)state;
    if (!can_read("a.xml")) {
        return;
    }
    for (size_t i = 0; i < sizeof whites / sizeof *whites; i++) {
        koksma_scene *scene = opened("a.xml", whites[i]);
        assert_int_equal(scene->n_unknown, 0);
        check_rgb(whites[i], scene->lights[0].radiance, (double[]){3, 3, 3}, 1e-6);
        koksma_scene_close(scene);
    }
    for (size_t i = 0; i < sizeof reddish / sizeof *reddish; i++) {
        koksma_scene *scene = opened("a.xml", reddish[i]);
        /* by Mitsuba 3.9.1: 6.0240, 4.7415, 4.5446 for an emission of 5 */
        check_rgb(reddish[i], scene->lights[0].radiance, (double[]){3.6144, 2.8449, 2.72676}, 0.012 * 3.6144);
        koksma_scene_close(scene);
    }
}

/* A light turned about y from (0, 0, -1) to (.6, 0, -.8), below six nodes with this scale. */
#define GLTF(scale)                                                                                                  \
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{"                 \
    "\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"directional\"}]}},\"scenes\":[{\"nodes\":[0,1]}],"             \
    "\"nodes\":[{\"mesh\":0}," NODE(scale, "2") NODE(scale, "3") NODE(scale, "4") NODE(scale, "5") NODE(scale, "6")  \
        NODE(scale, "7") "{\"rotation\":[0,-0.31622776601683794,0,0.9486832980505138],\"extensions\":{"              \
                         "\"KHR_lights_punctual\":{\"light\":0}}}],\"meshes\":[{\"primitives\":[{\"attributes\":{"   \
                         "\"POSITION\":0}}]}],\"buffers\":[{\"uri\":\"data:application/octet-stream;base64,"         \
                         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\",\"byteLength\":36}],"                   \
                         "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,"      \
                         "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]}"
#define NODE(scale, child) "{\"scale\":" scale ",\"children\":[" child "]},"

/* A direction is the same at any length. */
static void directions_have_no_length(void **state)
{
    static const struct {
        const char *name, *text;
    } cases[] = {
        {"a.xml",
         MITSUBA("",
                 "<emitter type=\"directional\"><vector name=\"direction\" value=\"3e300,0,-4e300\"/></emitter>")},
        {"a.xml",
         MITSUBA("", "<emitter type=\"directional\"><vector name=\"direction\" value=\"3e-9,0,-4e-9\"/></emitter>")},
        {"a.xml", MITSUBA("", "<emitter type=\"directional\"><transform name=\"to_world\"><lookat origin=\"0,0,0\" "
                              "target=\"3e300,0,-4e300\" up=\"0,1e300,0\"/></transform></emitter>")},
        {"a.xml", MITSUBA("", "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"0,0,0\" "
                              "target=\"3e200,0,-4e200\" up=\"0,1e300,0\"/></transform></emitter>")},
        {"a.pbrt", PBRT("", "LightSource \"distant\" \"point3 to\" [3e37 0 -4e37]")},
        {"a.pbrt", PBRT("", "Scale 1e38 1e38 1e38 Scale 1e38 1e38 1e38 Scale 1e38 1e38 1e38 Scale 1e38 1e38 1e38 "
                            "LightSource \"distant\" \"point3 to\" [3e37 0 -4e37] Identity")},
        {"a.gltf", GLTF("[1,1,1]")},
        {"a.gltf", GLTF("[1e30,1e30,1e30]")}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (can_read(cases[i].name)) {
            koksma_scene *scene = opened(cases[i].name, cases[i].text);
            check_rgb(cases[i].text, scene->lights[0].normal, (double[]){.6, 0, -.8}, 1e-6);
            koksma_scene_close(scene);
        }
    }
}

/* ---- Coats --------------------------------------------------------------------------------------------------- */

/* A coat reflects ((n - 1) / (n + 1))^2 along the normal: the same for n and 1 / n, and at most that of n = 10. */
static void coats_are_finite(void **state)
{
    static const struct {
        const char *name, *text;
        double reflectance; /* below 0: refused */
    } cases[] = {
#define COAT(eta) PBRT("", "Material \"coateddiffuse\" \"float eta\" " eta)
#define PLASTIC(inner, outer)                                                                                        \
    BALL("<bsdf type=\"plastic\"><float name=\"int_ior\" value=\"" inner                                             \
         "\"/><float name=\"ext_ior\" value=\"" outer "\"/></bsdf>")
        {"a.pbrt", COAT("1.5"), 0.04},
        {"a.pbrt", COAT("1"), 0},
        {"a.pbrt", COAT("1e38"), 81. / 121},
        {"a.pbrt", COAT("0"), 0}, /* which pbrt takes for 1 */
        {"a.pbrt", COAT("-1"), -1},
        {"a.pbrt", COAT("-1e30"), -1},
        {"a.pbrt", PBRT("", "Material \"dielectric\" \"float eta\" -1"), -1},
        {"a.xml", PLASTIC("1.5", "1"), 0.04},
        {"a.xml", PLASTIC("1", "1.5"), 0.04},
        {"a.xml", PLASTIC("1e300", "1e-300"), 81. / 121},
        {"a.xml", PLASTIC("1e-300", "1e300"), 81. / 121},
        {"a.xml", PLASTIC("-1", "1"), -1},
        {"a.xml", PLASTIC("-1", "-1"), -1},
        {"a.xml", PLASTIC("0", "0"), -1},
        {"a.xml", PLASTIC("1", "0"), -1},
        {"a.xml", BALL("<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"-1\"/></bsdf>"), -1},
        {"a.xml", BALL("<bsdf type=\"principled\"><float name=\"eta\" value=\"-1\"/></bsdf>"), -1}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_scene *scene = NULL;
        if (!can_read(cases[i].name)) {
            continue;
        }
        const koksma_status status = open_as(cases[i].name, cases[i].text, &scene);
        if (cases[i].reflectance < 0) {
            if (koksma_status_exit_code(status) != 3 || !strstr(koksma_error_text(), "it must be above 0")) {
                fail_msg("%s: '%s'", cases[i].text, status ? koksma_error_text() : "");
            }
        } else {
            assert_ok(status);
            const double share = cases[i].reflectance, rest = (1 - share) / 2;
            check_rgb(cases[i].text, koksma__material_value(&scene->materials[scene->n_materials - 1], "reflectance"),
                      (double[]){share, share, share}, 1e-7);
            check_rgb(cases[i].text, scene->materials[scene->n_materials - 1].albedo[0], (double[]){rest, rest, rest},
                      1e-7);
            koksma_scene_close(scene);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(metals_are_the_same_in_all_forms),
                                       cmocka_unit_test(extreme_metals_are_mirrors),
                                       cmocka_unit_test(media_are_the_same_in_all_forms),
                                       cmocka_unit_test(coefficients_are_finite),
                                       cmocka_unit_test(daylight_is_white),
                                       cmocka_unit_test(directions_have_no_length),
                                       cmocka_unit_test(coats_are_finite)};
    strcpy(folder, "/tmp/koksma-colours-XXXXXX");
    if (!mkdtemp(folder)) {
        return 1;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    rmdir(folder);
    return failed;
}
