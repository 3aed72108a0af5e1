/* SPDX-License-Identifier: Apache-2.0 */
/*
 * environment: light from far away, constant or given by an image in latitude and longitude. Row 0 is straight up;
 * the columns run from the direction +z through -x to -z in the middle of the image, then through +x back to +z, so
 * that a viewer who looks along -z sees the image unmirrored. Directions are chosen with a density that is constant
 * on each pixel and in proportion to its luminance times the sine of its row's angle from the vertical (Pharr, Jakob
 * & Humphreys 2016, section 14.2.4), by two binary searches; 1 % of the samples are uniform over the sphere, so that
 * rounding cannot give any light the density 0.
 */
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/status.h"
#include "image/formats.h"
#include "image/image.h"
#include "render/lights/beams.h"

static void pixel(const koksma_image *image, size_t i, float rgb[3])
{
    for (int k = 0; k < 3; k++) {
        const float value = image->pixels[i * (size_t)image->channels + (size_t)(image->channels == 3 ? k : 0)];
        rgb[k] = value > 0 ? value : 0; /* clamps negative values to 0 */
    }
}

static float row_sine(const koksma_image *image, size_t y)
{
    return (float)koksma__sin((double)(KOKSMA__PI_F * ((float)y + 0.5f) / (float)image->height));
}

/* Writes the cumulative sums of n weights, scaled to end at 1; returns the total. */
static double accumulate(const float *weights, size_t n, float *cdf)
{
    double total = 0, sum = 0;
    for (size_t i = 0; i < n; i++) {
        total += (double)weights[i];
    }
    for (size_t i = 0; i < n; i++) {
        cdf[i] = total > 0 ? (float)(sum / total) : (float)i / (float)n;
        sum += (double)weights[i];
    }
    cdf[n] = 1;
    return total;
}

/* The length of a cumulative table of n + 1 numbers with its padding: n + 1 rounded up to a multiple of
   KOKSMA__ENVIRONMENT_STEP, and another KOKSMA__ENVIRONMENT_STEP. */
static size_t padded(size_t n)
{
    return (n / KOKSMA__ENVIRONMENT_STEP + 2) * KOKSMA__ENVIRONMENT_STEP;
}

/* Pads a cumulative table after its n + 1 numbers, and copies every 16th number to `coarse`. */
static void finish(float *cdf, size_t n, float *coarse)
{
    for (size_t i = n + 1; i < padded(n); i++) {
        cdf[i] = 2;
    }
    for (size_t i = 0; i < padded(n) / KOKSMA__ENVIRONMENT_STEP; i++) {
        coarse[i] = cdf[i * KOKSMA__ENVIRONMENT_STEP];
    }
}

static koksma_status tabulate(const koksma_image *image, koksma__environment *e)
{
    const size_t width = (size_t)image->width, height = (size_t)image->height, stride = padded(width);
    float *weights = malloc((width + height) * sizeof *weights), *rows = weights ? weights + width : NULL;
    e->stride = stride;
    e->row_cdf = malloc(padded(height) * sizeof *e->row_cdf);
    e->row_coarse = malloc(padded(height) / KOKSMA__ENVIRONMENT_STEP * sizeof *e->row_coarse);
    e->column_cdf = malloc(height * stride * sizeof *e->column_cdf);
    e->column_coarse = malloc(height * stride / KOKSMA__ENVIRONMENT_STEP * sizeof *e->column_coarse);
    if (!weights || !e->row_cdf || !e->row_coarse || !e->column_cdf || !e->column_coarse) {
        free(weights);
        return koksma__fail_memory(height * stride * sizeof *e->column_cdf);
    }
    double sines = 0;
    for (size_t y = 0; y < height; y++) {
        float *columns = e->column_cdf + y * stride;
        for (size_t x = 0; x < width; x++) {
            float rgb[3];
            pixel(image, y * width + x, rgb);
            weights[x] = koksma__luminance3(rgb);
        }
        rows[y] = (float)(accumulate(weights, width, columns) * (double)row_sine(image, y));
        finish(columns, width, e->column_coarse + y * stride / KOKSMA__ENVIRONMENT_STEP);
        sines += (double)row_sine(image, y);
    }
    const double total = accumulate(rows, height, e->row_cdf);
    finish(e->row_cdf, height, e->row_coarse);
    e->mean = (float)(total / (sines * (double)width)) * koksma__luminance3(e->radiance);
    free(weights);
    return KOKSMA_OK;
}

static koksma_status open_environment(const koksma__light *from, koksma__environment *e)
{
    for (int k = 0; k < 3; k++) {
        e->radiance[k] = (float)from->radiance[k];
    }
    e->turn = (float)(from->angle_rad / (2 * M_PI));
    e->mean = koksma__luminance3(e->radiance);
    const koksma_image *image = from->image;
    const koksma_status status = image ? koksma__image_check(image, "the environment's image") : KOKSMA_OK;
    if (status || !image) {
        return status;
    }
    e->texels = image->pixels;
    e->channels = image->channels;
    e->green = image->channels == 3;
    e->width = image->width;
    e->height = image->height;
    return tabulate(image, e);
}

/* ---- Light ------------------------------------------------------------------------------------------------------ */

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    koksma__environment *e = calloc(1, sizeof *e);
    (void)scene;
    light->data = e;
    KOKSMA__REQUIRE_MEMORY(e, sizeof *e);
    const koksma_status status = open_environment(from, e);
    light->power = status ? 0 : e->mean;
    return status;
}

static void close_light(void *data)
{
    koksma__environment *e = data;
    KOKSMA__FREE(e->row_cdf, e->row_coarse, e->column_cdf, e->column_coarse, e);
}

static void radiance(const koksma__shading_light *light, const float w[3], float out[3])
{
    const koksma__environment *e = light->data;
    if (e->texels) {
        const koksma__texel texel = koksma__environment_texel(e, koksma__v3_of(w));
        koksma__v3_to(koksma__environment_texel_radiance(e, texel), out);
    } else {
        memcpy(out, e->radiance, sizeof e->radiance);
    }
}

static float pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t, const float n[3])
{
    const koksma__environment *e = light->data;
    (void)p, (void)t, (void)n;
    return e->texels ? koksma__environment_texel_pdf(e, koksma__environment_texel(e, koksma__v3_of(w)))
                     : 0.25f / KOKSMA__PI_F;
}

/* ---- Fields ----------------------------------------------------------------------------------------------------- */

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__light *light)
{
    const char *path = NULL;
    double angle_deg = 0, scale = 1;
    for (size_t i = 0; i + 1 < scene->n_lights; i++) {
        KOKSMA__JSON_FAIL_IF(scene->lights[i].kind == light->kind, f, "a second environment");
    }
    const bool image = koksma__json_has(f, "image");
    KOKSMA__JSON_FAIL_IF(image && koksma__json_has(f, "radiance"), f, "it takes one of 'radiance' and 'image'");
    KOKSMA__JSON_FAIL_IF(!image && (koksma__json_has(f, "scale") || koksma__json_has(f, "angle_deg")), f,
                         "'scale' and 'angle_deg' need 'image'");
    koksma_status status = koksma__json_get_text(f, "image", false, &path);
    if (!status && !path) {
        return koksma__parse_colour(f, "radiance", true, BRIGHT, light->radiance);
    }
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    status = status ? status : koksma__json_get_number(f, "scale", false, 0, BRIGHT, &scale);
    light->angle_rad = angle_deg * TURN / 360;
    light->radiance[0] = light->radiance[1] = light->radiance[2] = scale;
    return status ? status : koksma__parse_image(scene, name, f, path, &light->image);
}

static const koksma__parameter parameters[] = {
    {"visible", KOKSMA__FLAG, .optional = true, .fallback = 1, .at = offsetof(koksma__light, visible)}, {0}};

/* centre() is NULL: the integrators whitted and utah, which treat lights as points, use ambient light instead. */
const koksma__light_kind koksma__light_environment = {
    .kind = {.name = "environment",
             .title = "light from all directions in which rays hit nothing: constant, or from an image",
             .cite = "pharr2016",
             .parameters = parameters,
             .keys = (const char *const[]){"image", "scale", "angle_deg", "radiance", NULL},
             .example = "\"radiance\": [0.2, 0.3, 0.4]"},
    .distance = KOKSMA__LIGHT_AROUND,
    .form = KOKSMA__BEAMS_AROUND,
    .parse = parse,
    .open = open_light,
    .close = close_light,
    .pdf = pdf,
    .radiance = radiance,
};
