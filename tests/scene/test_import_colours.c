/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Numbers that are read of scenes of pbrt, Mitsuba and glTF, by the cases of colours.txt: eta and k of metals,
 * coefficients of media, factors of daylight, textures within textures. Each form of one value (numbers, pairs,
 * samples at equal or listed wavelengths, textures, the names of Mitsuba 2) gives the same, and what is beyond floats
 * something finite.
 */
#include "render/materials/materials.h"
#include "scene/import.h"
#include "scene_files.h"
#include "texts.h"

static const shared_text shared[] = {
    {"{P}", "Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 WorldBegin "},
    {"{M}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>"},
    {"{B}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"sphere\">"},
    {"{/B}", "</shape></scene>"},
    {"{F}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"><medium type=\"homogeneous\">"},
    {"{/F}", "</medium></sensor><shape type=\"sphere\"/></scene>"},
    {"{C}", "<rgb name=\"color0\" value=\"1 0 .5\"/><rgb name=\"color1\" value=\".5 1 .5\"/>"},
    {NULL, NULL}};

static void check_rgb(const char *text, const double *rgb, const double *expected, double tolerance)
{
    for (int k = 0; k < 3; k++) {
        assert_that(rgb[k] == expected[k] || fabs(rgb[k] - expected[k]) <= tolerance,
                    "%s: %g %g %g, expected %g %g %g", text, rgb[0], rgb[1], rgb[2], expected[0], expected[1],
                    expected[2]);
    }
}

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

/* Finds a quantity of the scene by its name in colours.txt. */
static void find_quantity(const koksma_scene *scene, const char *name, double rgb[3])
{
    const koksma__material *m = scene->n_materials ? &scene->materials[scene->n_materials - 1] : NULL;
    if (!strcmp(name, "reflectance")) {
        reflectance_of(scene, rgb);
        return;
    }
    if (!strcmp(name, "period") || !strcmp(name, "phase")) {
        rgb[0] = rgb[1] = rgb[2] = *name == 'p' && name[1] == 'h' ? scene->medium.phase.values[0] : m->period;
        return;
    }
    const double *found = !strcmp(name, "albedo")       ? m->albedo[0]
                          : !strcmp(name, "other")      ? m->albedo[1]
                          : !strcmp(name, "radiance")   ? scene->lights[0].radiance
                          : !strcmp(name, "normal")     ? scene->lights[0].normal
                          : !strcmp(name, "absorption") ? scene->medium.absorption
                          : !strcmp(name, "scattering") ? scene->medium.scattering
                          : !strcmp(name, "low")        ? scene->medium.low
                          : !strcmp(name, "high")       ? scene->medium.high
                                                        : NULL;
    assert_non_null(found);
    assert_true(strcmp(name, "other") != 0 || (m->checker && !m->image));
    memcpy(rgb, found, 3 * sizeof *rgb);
}

static koksma_scene *opened_text(const char *text)
{
    return opened(*text == '<' ? "a.xml" : *text == '{' ? "a.gltf" : "a.pbrt", text);
}

static void check_case(const char *expected, const char *text)
{
    char first[4096], warning[256] = "";
    const char *said = strstr(expected, "; "), *second = strstr(text, " == ");
    double rgb[3], value[3], tolerance;
    snprintf(first, sizeof first, "%.*s", second ? (int)(second - text) : (int)strlen(text), text);
    if (!can_read(*text == '<' ? "a.xml" : *text == '{' ? "a.gltf" : "a.pbrt")) {
        return;
    }
    koksma_scene *scene = opened_text(first);
    koksma_scene_unknown(scene, 0, warning, sizeof warning);
    assert_that(said ? strstr(warning, said + 2) != NULL : !*warning, "%s: '%s', expected '%s'", text, warning,
                said ? said + 2 : "");
    if (second) {
        koksma_scene *other = opened_text(second + 4);
        reflectance_of(scene, rgb);
        reflectance_of(other, value);
        check_rgb(text, rgb, value, 1e-12);
        koksma_scene_close(other);
    }
    assert_true(scene->medium.is_there == (strstr(expected, "absorption") != NULL));
    for (const char *at = expected; at && !second && strcmp(at, "none") != 0 && (!said || at < said);
         at = strstr(at, ", ")) {
        char name[16];
        at += at == expected ? 0 : 2;
        assert_int_equal(sscanf(at, "%15s %lf %lf %lf +- %lf", name, &value[0], &value[1], &value[2], &tolerance), 5);
        find_quantity(scene, name, rgb);
        check_rgb(text, rgb, value, tolerance);
    }
    koksma_scene_close(scene);
}

static void write_pixels(const char *name, const float *pixels, int height, int channels)
{
    char path[128];
    koksma_image image;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_ok(koksma_image_init(&image, 2, height, channels));
    memcpy(image.pixels, pixels, (size_t)(2 * height * channels) * sizeof *pixels);
    assert_ok(koksma_image_write(path, &image, NULL));
    koksma_image_fini(&image);
}

TEST_CASE(colours_are_those_of_the_table)
{
    write_pixels("grey.pfm", (const float[]){.2f, .6f}, 1, 1);
    write_pixels("two.pfm", (const float[]){1, .5f, .25f, 0, .25f, 0, 9, .5f, .25f, 0, .25f, 0}, 2, 3);
    assert_true(each_text("scene/colours.txt", shared, check_case) > 100);
}
