/* SPDX-License-Identifier: Apache-2.0 */
/* Materials against their formulas in double precision. */
#include <complex.h>

#include "render/materials/materials.h"

#include "rendering.h"

/* D / (4 n.out) and no more, seen straight on, of a facet whose slope is within twice the roughness: relative errors
   in the mean. Walter et al. 2007, equation 33. */
TEST_CASE(sharp_highlights_have_their_height)
{
    static const struct {
        double roughness, error;
    } cases[] = {{0.001, 0.05}, {0.003, 5e-3}, {0.01, 5e-4}, {0.0125, 3e-4}, {0.03, 1e-4}, {0.1, 1e-5}, {0.7, 2e-6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        enum { TRIES = 2000 };
        const double a = cases[i].roughness * cases[i].roughness;
        koksma__material rough = {.bsdf = &koksma__bsdf_ggx};
        for (int k = 0; k < 3; k++) {
            koksma__material_value(&rough, "reflectance")[k] = 1;
        }
        *koksma__material_value(&rough, "roughness") = cases[i].roughness;
        const koksma__shading_material material = koksma__shading_material_of(&rough);
        double sum = 0;
        for (int k = 0; k < TRIES; k++) {
            /* n is any, and out = n: the facet's normal is halfway between n and w */
            double n[3], x[3], length = 0;
            for (int j = 0; j < 3; j++) {
                n[j] = uniform(-1, 1);
                length += n[j] * n[j];
            }
            for (int j = 0; j < 3; j++) {
                n[j] /= sqrt(length);
            }
            x[0] = n[1] - n[2];
            x[1] = n[2] - n[0];
            x[2] = n[0] - n[1];
            const double size = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), angle = atan(a * uniform(0, 2));
            koksma__surface s = {.material = &material};
            float w[3], value[3] = {0, 0, 0};
            for (int j = 0; j < 3; j++) {
                s.n[j] = s.out[j] = (float)n[j];
                w[j] = (float)(cos(2 * angle) * n[j] + sin(2 * angle) * x[j] / size);
            }
            const double cosine = cos(angle), sine = sin(angle), t = cosine * cosine * a * a + sine * sine;
            const double tangent = tan(2 * angle), g2 = 1 / (1 + (sqrt(1 + a * a * tangent * tangent) - 1) / 2);
            material.bsdf->value(&s, w, KOKSMA__LOBE_GLOSSY, value);
            sum += fabs((double)value[0] / (a * a / (M_PI * t * t) * g2 / 4) - 1);
        }
        assert_that(sum / TRIES <= cases[i].error, "roughness %g: off by %g in the mean", cases[i].roughness,
                    sum / TRIES);
    }
}

/* Fresnel's amplitudes with a complex index N and the complex cosine C inside: rs = (c - N C) / (c + N C), rp = (N c - C) /
   (N c + C); the reflectance is the mean of their squares. */
TEST_CASE(conductors_reflect_by_fresnels_equations)
{
    static const double cosines[] = {1, 0.9, 0.5, 1.0 / 7, 0.01};
    for (size_t i = 0; i < 500; i++) {
        koksma__material smooth = {.bsdf = &koksma__bsdf_conductor};
        for (int k = 0; k < 3; k++) {
            koksma__material_value(&smooth, "eta")[k] = uniform(0.01, i % 2 ? 1 : 8);
            koksma__material_value(&smooth, "k")[k] = i % 5 ? uniform(0, 10) : 0;
            koksma__material_value(&smooth, "tint")[k] = uniform(0, 1);
        }
        const koksma__shading_material material = koksma__shading_material_of(&smooth);
        const double c = cosines[i % 5];
        const koksma__surface s = {
            .material = &material, .n = {0, 0, 1}, .out = {(float)sqrt(1 - c * c), 0, (float)c}};
        koksma__scatter to;
        assert_true(material.bsdf->sample(&s, KOKSMA__LOBE_SPECULAR, (const float[2]){0, 0}, 0, &to));
        for (int k = 0; k < 3; k++) {
            const double eta = koksma__material_value(&smooth, "eta")[k],
                         absorbed = koksma__material_value(&smooth, "k")[k];
            const double complex n = eta + absorbed * (double complex)I;
            const double complex inside = csqrt(1 - (1 - c * c) / (n * n));
            const double rs = cabs((c - n * inside) / (c + n * inside)),
                         rp = cabs((n * c - inside) / (n * c + inside));
            const double expected = koksma__material_value(&smooth, "tint")[k] * (rs * rs + rp * rp) / 2;
            assert_near((double)to.weight[k], expected, 2e-5);
        }
    }
}

/* A point light on the mirrored way, at 45 degrees: D = 1 / (pi a^2), G2 = 1 / (2 lambda + 1). The geometry is exact
   in floats but for the camera's rounding, and the middle of the pixel is its only sample. */
TEST_CASE(pictures_of_highlights)
{
    static const double roughness[] = {0.02, 0.03, 0.05, 0.3};
    for (size_t i = 0; i < 4; i++) {
        char text[1024];
        const double a = roughness[i] * roughness[i];
        snprintf(
            text, sizeof text,
            "{'camera': {'eye': [0, 1, 1], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', 'kind': "
            "'ggx', 'reflectance': 1, 'roughness': %g}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': "
            "[0, 1, 0], 'material': 'm'}],'lights': [{'kind': 'point', 'centre': [0, 1, -1], 'intensity': 2}]}",
            roughness[i]);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "regular", "path", 1, 1);
        const double expected = 1 / (M_PI * a * a) / sqrt(1 + a * a) / (4 * sqrt(0.5));
        assert_near(mean_of(scene, &options, NULL), expected, 2e-3 * expected);
        koksma_scene_close(scene);
    }
}

/* Every roughness that is accepted gives finite pixels; in a white world no more than 1. */
TEST_CASE(every_roughness_is_finite)
{
    static const double roughness[] = {0.001, 0.003, 0.01, 0.0125, 0.02, 0.03};
    for (size_t i = 0; i < 12; i++) {
        char text[1024];
        snprintf(
            text, sizeof text,
            "{'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 20},'materials': [{'name': 'm', 'kind': "
            "'ggx', 'reflectance': 1, 'roughness': %g}],'shapes': [{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': "
            "1, 'material': 'm'}],'lights': [{'kind': 'environment', 'radiance': 1, 'visible': true}]}",
            roughness[i / 2]);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "random", i % 2 ? "path" : "distribution", 16, 16);
        double error;
        const double mean = mean_of(scene, &options, &error); /* facets that are this steep lose nothing */
        assert_mean(mean, error, 1);
        koksma_scene_close(scene);
    }
}
