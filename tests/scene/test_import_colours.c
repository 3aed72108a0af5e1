/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours of pbrt's and Mitsuba's scenes that may be above 1: eta and k of metals, coefficients of media, factors of
 * daylight. Each form of one value (numbers, pairs, samples at equal or listed wavelengths, textures, the names of
 * Mitsuba 2) gives the same colour, also within textures of pbrt. Indices of refraction and directions of any size give
 * finite pictures. Long because all of them share the scenes and the checks.
 */
#include "render/materials/materials.h"
#include "scene/import.h"
#include "scene_files.h"

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

/* The reflectance along the normal of the last material, a metal of any kind. */
static void reflectance_of(const koksma_scene *scene, double rgb[3])
{
    koksma__material *m = &scene->materials[scene->n_materials - 1];
    const char *name = m->bsdf->kind.name;
    if (strcmp(name, "conductor") != 0 && strcmp(name, "rough-conductor") != 0) {
        memcpy(rgb, koksma__material_value(m, "reflectance"), 3 * sizeof *rgb);
        return;
    }
    fresnel(koksma__material_value(m, "eta"), koksma__material_value(m, "k"), rgb);
    for (int i = 0; i < 3; i++) {
        rgb[i] *= koksma__material_value(m, "tint")[i];
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
TEST_CASE(metals_are_the_same_in_all_forms)
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
    double expected[3], rgb[3];
    fresnel(eta, k, expected);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (can_read(cases[i].name)) {
            koksma_scene *scene = opened(cases[i].name, cases[i].text);
            assert_int_equal(scene->n_unknown, 0);
            reflectance_of(scene, rgb);
            check_rgb(cases[i].text, rgb, expected, cases[i].is_rounded ? 1e-6 : 0.012);
            koksma_scene_close(scene);
        }
    }
}

/* The reflectance of eta or k of any size: it tends to 1. */
TEST_CASE(extreme_metals_are_mirrors)
{
    static const char *const texts[] = {METAL("<float name=\"eta\" value=\"1e300\"/>"),
                                        METAL("<float name=\"eta\" value=\"1\"/><float name=\"k\" value=\"1e300\"/>"),
                                        METAL("<float name=\"eta\" value=\"0\"/><float name=\"k\" value=\"0\"/>")};
    for (size_t i = 0; can_read("a.xml") && i < sizeof texts / sizeof *texts; i++) {
        koksma_scene *scene = opened("a.xml", texts[i]);
        double rgb[3];
        reflectance_of(scene, rgb);
        check_rgb(texts[i], rgb, (double[]){1, 1, 1}, 1e-5);
        koksma_scene_close(scene);
    }
}

/* A texture on a metal shows as its mean, which a metal's own reflectance multiplies. */
TEST_CASE(textured_metals_have_their_mean)
{
#define SQUARES(name)                                                                                                \
    "<texture type=\"checkerboard\" name=\"" name "\"><rgb name=\"color0\" value=\"1 0 .5\"/>"                       \
    "<rgb name=\"color1\" value=\".5 1 .5\"/></texture>"
#define MEAN_OF_SQUARES(name) "<rgb name=\"" name "\" value=\".75 .5 .5\"/>"
#define METALLIC(inside) BALL("<bsdf type=\"principled\"><float name=\"metallic\" value=\"1\"/>" inside "</bsdf>")
    static const char *const gold = "<string name=\"material\" value=\"Au\"/>";
    static const char *const forms[][2] = {
        {METAL(SQUARES("specular_reflectance") "%s"), METAL(MEAN_OF_SQUARES("specular_reflectance") "%s")},
        {METALLIC(SQUARES("base_color") "%.0s"), METALLIC(MEAN_OF_SQUARES("base_color") "%.0s")}};
    for (size_t i = 0; can_read("a.xml") && i < 4; i++) {
        double reflectances[2][3];
        koksma_scene *scenes[2];
        char text[1024];
        for (int k = 0; k < 2; k++) {
            snprintf(text, sizeof text, forms[i / 2][k], i % 2 ? gold : "");
            scenes[k] = opened("a.xml", text);
            reflectance_of(scenes[k], reflectances[k]);
        }
        assert_true(scenes[0]->n_unknown == scenes[1]->n_unknown + 1);
        check_rgb(text, reflectances[0], reflectances[1], 1e-12);
        koksma_scene_close(scenes[0]);
        koksma_scene_close(scenes[1]);
    }
}

/* So does one of a light. */
TEST_CASE(textured_lights_have_their_mean)
{
    static const char *const text = MITSUBA(
        "", "<shape type=\"rectangle\"><emitter type=\"area\"><texture type=\"checkerboard\" "
            "name=\"radiance\"><rgb name=\"color0\" value=\"1 0 .5\"/><rgb name=\"color1\" value=\".5 1 .5\"/>"
            "</texture></emitter></shape>");
    if (can_read("a.xml")) {
        koksma_scene *scene = opened("a.xml", text);
        assert_int_equal(scene->n_unknown, 1);
        check_rgb(text, scene->lights[0].radiance, (double[]){.75, .5, .5}, 1e-12);
        koksma_scene_close(scene);
    }
}

/* ---- Media --------------------------------------------------------------------------------------------------- */

#define FOG(inside) MITSUBA("<medium type=\"homogeneous\">" inside "</medium>", "<shape type=\"sphere\"/>")
#define PBRT_FOG(parameters)                                                                                         \
    PBRT("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" " parameters " MediumInterface \"\" \"m\"", "")

/* The absorption 2 in all forms, without scattering. */
TEST_CASE(media_are_the_same_in_all_forms)
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
TEST_CASE(coefficients_are_finite)
{
    static const char *const bad[] = {PBRT_FOG("\"rgb sigma_a\" [-1 0 0]"), PBRT_FOG("\"rgb sigma_s\" [0 0 -1]"),
                                      PBRT_FOG("\"float scale\" -1")};
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
TEST_CASE(daylight_is_white)
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
TEST_CASE(directions_have_no_length)
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
TEST_CASE(coats_are_finite)
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

/* ---- Textures and names of spectra of pbrt ------------------------------------------------------------------- */

#define IMAGE "Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"grey.pfm\" " /* pixels .2 and .6 */
#define CHECKS(type, name, first, second)                                                                            \
    "Texture \"" name "\" \"" type "\" \"checkerboard\" " first " " second " \"float uscale\" 4 \"float vscale\" 4 "
#define CONSTANT(type, name, value) "Texture \"" name "\" \"" type "\" \"constant\" " value " "
#define SHOWN "Material \"diffuse\" \"texture reflectance\" \"t\""
#define MEAN "a texture within another is replaced by its mean colour"

/* The first warning has the words `said`; NULL: there is none. */
static void check_said(const koksma_scene *scene, const char *text, const char *said)
{
    char warning[256] = "";
    koksma_scene_unknown(scene, 0, warning, sizeof warning);
    if (said ? !strstr(warning, said) : *warning != 0) {
        fail_msg("%s: '%s', expected '%s'", text, warning, said ? said : "");
    }
}

/* Textures of spectra and of numbers have separate names. A product is that of the colours, in either order; where a
   texture within another leaves space for one colour only, it is the mean. */
TEST_CASE(textures_combine)
{
    static const struct {
        const char *text;
        double first[3], second[3]; /* of a checkerboard; both are the same of a colour */
        const char *said;           /* the first warning; NULL: none */
    } cases[] = {
        {CONSTANT("spectrum", "t", "\"rgb value\" [.9 0 .2]") CONSTANT("float", "t", "\"float value\" .1") SHOWN,
         {.9, 0, .2},
         {.9, 0, .2},
         NULL},
        {CONSTANT("float", "t", "\"float value\" .1") CONSTANT("spectrum", "t", "\"rgb value\" [.9 0 .2]") SHOWN,
         {.9, 0, .2},
         {.9, 0, .2},
         NULL},
        {CONSTANT("float", "a", "\"float value\" .5")
             CONSTANT("spectrum", "a", "\"rgb value\" [.8 0 .2]") "Texture \"t\" \"spectrum\" \"scale\" \"texture "
                                                                  "tex\" \"a\" \"texture scale\" \"a\" " SHOWN,
         {.4, 0, .1},
         {.4, 0, .1},
         NULL},
        {CONSTANT("float", "t", "\"float value\" .1") SHOWN,
         {.1, .1, .1},
         {.1, .1, .1},
         "reflectance: the float texture 't' stands for a spectrum texture"},
        {CONSTANT("spectrum", "t", "\"spectrum value\" \"\"") SHOWN,
         {1, 1, 1},
         {1, 1, 1},
         "spectrum '' is replaced by white"},
        {CHECKS("float", "c", "\"float tex1\" 1",
                "\"float tex2\" .5") "Texture \"t\" \"spectrum\" \"scale\" \"rgb tex\" [.8 0 .2] \"texture scale\" "
                                     "\"c\" " SHOWN,
         {.8, 0, .2},
         {.4, 0, .1},
         NULL},
        {CHECKS("spectrum", "c", "\"rgb tex1\" [.8 0 .2]",
                "\"rgb tex2\" [.4 0 .1]") "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"c\" \"float "
                                          "scale\" .5 " SHOWN,
         {.4, 0, .1},
         {.2, 0, .05},
         NULL},
        {CHECKS("spectrum", "c", "\"rgb tex1\" [.8 0 .2]", "\"rgb tex2\" [.4 0 .1]") CHECKS(
             "float", "d", "\"float tex1\" 1", "\"float tex2\" 0") "Texture \"t\" \"spectrum\" \"scale\" \"texture "
                                                                   "tex\" \"c\" \"texture scale\" \"d\" " SHOWN,
         {.4, 0, .1},
         {.2, 0, .05},
         "the scale of a texture is replaced by its mean colour"},
        {IMAGE CHECKS("spectrum", "t", "\"texture tex1\" \"i\"", "\"rgb tex2\" [0 0 .9]") SHOWN,
         {.4, .4, .4},
         {0, 0, .9},
         MEAN},
        {IMAGE CHECKS("spectrum", "t", "\"rgb tex1\" [0 0 .9]", "\"texture tex2\" \"i\"") SHOWN,
         {0, 0, .9},
         {.4, .4, .4},
         MEAN},
        {CHECKS("spectrum", "c", "\"rgb tex1\" [1 0 0]", "\"rgb tex2\" [0 1 0]")
             CHECKS("spectrum", "t", "\"texture tex1\" \"c\"", "\"rgb tex2\" [0 0 .9]") SHOWN,
         {.5, .5, 0},
         {0, 0, .9},
         MEAN},
        {IMAGE "Texture \"t\" \"spectrum\" \"mix\" \"texture tex1\" \"i\" \"rgb tex2\" [.2 .2 .2] " SHOWN,
         {.3, .3, .3},
         {.3, .3, .3},
         NULL},
        {"Texture \"i\" \"float\" \"imagemap\" \"string filename\" \"grey.pfm\" Texture \"t\" \"spectrum\" \"scale\" "
         "\"rgb tex\" [.5 0 1] \"texture scale\" \"i\" " SHOWN,
         {.2, 0, .4},
         {.2, 0, .4},
         NULL},
        {"Texture \"i\" \"float\" \"imagemap\" \"string filename\" \"grey.pfm\" Texture \"t\" \"spectrum\" \"scale\" "
         "\"rgb tex\" [1 1 1] \"texture scale\" \"i\" " SHOWN,
         {.4, .4, .4},
         {.4, .4, .4},
         NULL},
        {IMAGE "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"i\" \"float scale\" 1 " SHOWN,
         {.4, .4, .4},
         {.4, .4, .4},
         NULL}, /* the image; this is its mean */
        {IMAGE "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"i\" \"float scale\" .5 " SHOWN,
         {.2, .2, .2},
         {.2, .2, .2},
         NULL}};
    char path[128];
    koksma_image grey;
    snprintf(path, sizeof path, "%s/grey.pfm", folder);
    assert_ok(koksma_image_init(&grey, 2, 1, 1));
    grey.pixels[0] = .2f;
    grey.pixels[1] = .6f;
    assert_ok(koksma_image_write(path, &grey, NULL));
    koksma_image_fini(&grey);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        snprintf(text, sizeof text, "Camera \"perspective\" WorldBegin %s", cases[i].text);
        koksma_scene *scene = opened("a.pbrt", text);
        const koksma__material *m = &scene->materials[scene->n_materials - 1];
        const bool is_checker = memcmp(cases[i].first, cases[i].second, sizeof cases[i].first) != 0;
        check_rgb(text, m->albedo[0], cases[i].first, 1e-6);
        check_rgb(text, m->albedo[is_checker], cases[i].second, 1e-6);
        assert_true(m->checker == is_checker && (!is_checker || m->period == .25));
        check_said(scene, text, cases[i].said);
        koksma_scene_close(scene);
    }
    unlink(path);
}

/* A texture whose value is the name of a spectrum is that spectrum; a metal has no textures. The CIE's illuminant A has
   the chromaticity .44757, .40745 (CIE 15), which is 1.845, .826, .233 in linear sRGB of luminance 1, and is a black body
   of 2856 K. */
TEST_CASE(names_of_spectra_are_read)
{
#define NAMED(name) CONSTANT("spectrum", "t", "\"spectrum value\" \"" name "\"")
#define GOLD_K "\"spectrum k\" \"metal-Au-k\""
    static const struct {
        const char *metal, *same; /* two materials that are the same */
        const char *said;         /* of the first */
    } metals[] = {
        {NAMED("metal-Au-eta") "Material \"conductor\" \"texture eta\" \"t\" " GOLD_K,
         "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" " GOLD_K, NULL},
        {NAMED("metal-Au-k") "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"texture k\" \"t\"",
         "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" " GOLD_K, NULL},
        {NAMED("metal-Cu-eta") "Material \"conductor\" \"texture eta\" \"t\"", "Material \"conductor\"", NULL},
        {NAMED("metal-Ag-eta") "Material \"conductor\" \"texture eta\" \"t\" " GOLD_K,
         "Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\"",
         "eta and k of a metal"},
        {NAMED("metal-Au-eta") "Material \"conductor\" \"texture reflectance\" \"t\"",
         "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" " GOLD_K,
         "spectrum 'metal-Au-eta' is replaced by the metal's reflectance"},
        {CHECKS("spectrum", "t", "\"rgb tex1\" [1 0 .5]",
                "\"rgb tex2\" [.5 1 .5]") "Material \"conductor\" \"texture reflectance\" \"t\"",
         "Material \"conductor\" \"rgb reflectance\" [.75 .5 .5]",
         "a metal's texture is replaced by its mean colour"}};
    static const struct {
        const char *light;
        double rgb[3];
        const char *said;
    } lights[] = {{"\"spectrum L\" \"stdillum-A\"", {1.845, .826, .233}, NULL},
                  {"\"blackbody L\" 2856", {1.845, .826, .233}, NULL},
                  {"\"spectrum L\" \"stdillum-D65\"", {1, 1, 1}, NULL},
                  {"\"spectrum L\" \"stdillum-F1\"", {1, 1, 1}, "spectrum 'stdillum-F1' is replaced by white"}};
    char text[1024];
    for (size_t i = 0; i < sizeof metals / sizeof *metals; i++) {
        koksma_scene *scenes[2];
        for (int k = 0; k < 2; k++) {
            snprintf(text, sizeof text, PBRT("", "%s"), k ? metals[i].same : metals[i].metal);
            scenes[k] = opened("a.pbrt", text);
        }
        check_said(scenes[0], metals[i].metal, metals[i].said);
        check_rgb(metals[i].metal,
                  koksma__material_value(&scenes[0]->materials[scenes[0]->n_materials - 1], "reflectance"),
                  koksma__material_value(&scenes[1]->materials[scenes[1]->n_materials - 1], "reflectance"), 0);
        koksma_scene_close(scenes[0]);
        koksma_scene_close(scenes[1]);
    }
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        snprintf(text, sizeof text, PBRT("", "LightSource \"infinite\" %s"), lights[i].light);
        koksma_scene *scene = opened("a.pbrt", text);
        check_rgb(text, scene->lights[0].radiance, lights[i].rgb, 0.02);
        check_said(scene, text, lights[i].said);
        koksma_scene_close(scene);
    }
}
