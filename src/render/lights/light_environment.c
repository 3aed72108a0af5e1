/* SPDX-License-Identifier: Apache-2.0 */
/*
 * environment: light from far away, the same everywhere or an image of latitude and longitude: row 0 is straight up,
 * columns go round from +z over -x to -z, in the middle, and +x: who looks along -z sees the image as it is, not
 * mirrored. Directions are chosen with a density that is constant on each pixel and in proportion to its luminance
 * times the sine of its row (Pharr, Jakob & Humphreys 2016, section 14.2.4), by two binary searches; a hundredth of
 * the samples is uniform over the sphere, so that no light is missed by rounding.
 */
#include "render/lights/light_environment.h"

#include <stdlib.h>

#include "core/status.h"
#include "image/formats.h"
#include "render/lights/surface_lights.h"

#define FLOOR 0.01f

struct koksma__environment {
    float radiance[3]; /* scale of the image */
    const koksma_image *image;
    float turn; /* as a part of a full turn */
    float mean;
    float *row_cdf, *column_cdf; /* height + 1; height rows of width + 1 */
};

static void pixel(const koksma_image *image, size_t i, float rgb[3])
{
    for (int k = 0; k < 3; k++) {
        const float value = image->pixels[i * (size_t)image->channels + (size_t)(image->channels == 3 ? k : 0)];
        rgb[k] = value > 0 ? value : 0; /* no negative light */
    }
}

static float row_sine(const koksma_image *image, size_t y)
{
    return sinf(KOKSMA__PI_F * ((float)y + 0.5f) / (float)image->height);
}

/* Cumulative sums of n weights, scaled to end at 1; the total. */
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

static koksma_status tabulate(koksma__environment *e)
{
    const size_t width = (size_t)e->image->width, height = (size_t)e->image->height;
    float *weights = malloc((width + height) * sizeof *weights), *rows = weights ? weights + width : NULL;
    e->row_cdf = malloc((height + 1) * sizeof *e->row_cdf);
    e->column_cdf = malloc(height * (width + 1) * sizeof *e->column_cdf);
    if (!weights || !e->row_cdf || !e->column_cdf) {
        free(weights);
        return koksma__fail_memory(height * (width + 1) * sizeof *e->column_cdf);
    }
    double sines = 0;
    for (size_t y = 0; y < height; y++) {
        for (size_t x = 0; x < width; x++) {
            float rgb[3];
            pixel(e->image, y * width + x, rgb);
            weights[x] = koksma__luminance3(rgb);
        }
        rows[y] =
            (float)(accumulate(weights, width, e->column_cdf + y * (width + 1)) * (double)row_sine(e->image, y));
        sines += (double)row_sine(e->image, y);
    }
    const double total = accumulate(rows, height, e->row_cdf);
    e->mean = (float)(total / (sines * (double)width)) * koksma__luminance3(e->radiance);
    free(weights);
    return KOKSMA_OK;
}

koksma_status koksma__environment_open(const koksma__light *light, koksma__environment **out)
{
    koksma__environment *e = calloc(1, sizeof *e);
    *out = e;
    KOKSMA__REQUIRE_MEMORY(e, sizeof *e);
    for (int k = 0; k < 3; k++) {
        e->radiance[k] = (float)light->radiance[k];
    }
    e->image = light->image;
    e->turn = (float)(light->angle_rad / (2 * M_PI));
    e->mean = koksma__luminance3(e->radiance);
    const koksma_status status = e->image ? koksma__image_check(e->image, "the environment's image") : KOKSMA_OK;
    return status || !e->image ? status : tabulate(e);
}

void koksma__environment_close(koksma__environment *e)
{
    if (e) {
        free(e->row_cdf);
        free(e->column_cdf);
        free(e);
    }
}

/* The cell of a cumulative table that holds u, and where in it. */
static size_t find(const float *cdf, size_t n, float u, float *within)
{
    size_t low = 0, high = n;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (cdf[middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const float size = cdf[low + 1] - cdf[low];
    const float part = size > 0 ? (u - cdf[low]) / size : 0.5f;
    *within = part < 1 ? part : 1 - 0x1p-24f;
    return low;
}

static void direction_of(const koksma__environment *e, float x, float y, float w[3])
{
    const float azimuth = 2 * KOKSMA__PI_F * (x - e->turn), polar = KOKSMA__PI_F * y;
    w[0] = -sinf(polar) * sinf(azimuth);
    w[1] = cosf(polar);
    w[2] = sinf(polar) * cosf(azimuth);
}

/* The position of w in the image, both in [0,1). */
static void position_of(const koksma__environment *e, const float w[3], float *x, float *y)
{
    const float turns = atan2f(-w[0], w[2]) / (2 * KOKSMA__PI_F) + e->turn;
    *x = turns - floorf(turns);
    *x = *x < 1 ? *x : 0;
    *y =
        atan2f(sqrtf(w[0] * w[0] + w[2] * w[2]), w[1]) / KOKSMA__PI_F; /* an arc cosine knows no angles below 2^-12 */
    *y = *y < 1 ? *y : 1 - 0x1p-24f;
}

float koksma__environment_sample(const koksma__environment *e, const float u[2], float w[3])
{
    float x = u[0], y = u[1];
    if (!e->image || y < FLOOR) { /* all directions alike */
        y = e->image ? y / FLOOR : y;
        const float up = 1 - 2 * y;
        direction_of(e, x, acosf(up) / KOKSMA__PI_F, w);
    } else {
        const size_t width = (size_t)e->image->width;
        float in_row, in_column;
        const size_t row = find(e->row_cdf, (size_t)e->image->height, (y - FLOOR) / (1 - FLOOR), &in_row);
        const size_t column = find(e->column_cdf + row * (width + 1), width, x, &in_column);
        direction_of(e, ((float)column + in_column) / (float)width, ((float)row + in_row) / (float)e->image->height,
                     w);
    }
    return koksma__environment_pdf(e, w);
}

float koksma__environment_pdf(const koksma__environment *e, const float w[3])
{
    const float alike = 1 / (4 * KOKSMA__PI_F);
    if (!e->image) {
        return alike;
    }
    float x, y;
    position_of(e, w, &x, &y);
    const size_t width = (size_t)e->image->width, height = (size_t)e->image->height;
    const size_t column = (size_t)(x * (float)width), row = (size_t)(y * (float)height);
    const float *cdf = e->column_cdf + row * (width + 1);
    const float cell =
        (e->row_cdf[row + 1] - e->row_cdf[row]) * (cdf[column + 1] - cdf[column]) * (float)(width * height);
    const float sine = sqrtf(w[0] * w[0] + w[2] * w[2]);
    const float image = cell / (2 * KOKSMA__PI_F * KOKSMA__PI_F * (sine > 1e-6f ? sine : 1e-6f));
    return FLOOR * alike + (1 - FLOOR) * image;
}

void koksma__environment_radiance(const koksma__environment *e, const float w[3], float out[3])
{
    float rgb[3] = {1, 1, 1};
    if (e->image) {
        float x, y;
        position_of(e, w, &x, &y);
        const size_t column = (size_t)(x * (float)e->image->width), row = (size_t)(y * (float)e->image->height);
        pixel(e->image, row * (size_t)e->image->width + column, rgb);
    }
    for (int k = 0; k < 3; k++) {
        out[k] = e->radiance[k] * rgb[k];
    }
}

float koksma__environment_mean(const koksma__environment *e)
{
    return e->mean;
}

/* ---- The kind of light ------------------------------------------------------------------------------------- */

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
    return status ? status : koksma__parse_image(name, f, path, &light->image);
}

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    (void)scene;
    koksma__environment *e = NULL;
    const koksma_status status = koksma__environment_open(from, &e);
    light->data = e;
    light->power = status ? 0 : e->mean;
    return status;
}

static void close_light(void *data)
{
    koksma__environment_close(data);
}

static bool sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    (void)p;
    out->pdf = koksma__environment_sample(light->data, u, out->w);
    koksma__environment_radiance(light->data, out->w, out->value);
    for (int k = 0; k < 3; k++) {
        out->d[k] = KOKSMA__AWAY * out->w[k];
        out->value[k] /= out->pdf;
    }
    return koksma__max3(out->value) > 0;
}

static float pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t, const float n[3])
{
    (void)p, (void)t, (void)n;
    return koksma__environment_pdf(light->data, w);
}

static void radiance(const koksma__shading_light *light, const float w[3], float out[3])
{
    koksma__environment_radiance(light->data, w, out);
}

static const koksma__parameter parameters[] = {
    {"visible", KOKSMA__FLAG, .optional = true, .fallback = 1, .at = offsetof(koksma__light, visible)}, {0}};

/* It has no centre(): the integrators whitted and utah, which take lights as points, use ambient light instead. */
const koksma__light_kind koksma__light_environment = {
    .kind = {.name = "environment",
             .title = "light from all directions that hit nothing, the same or an image",
             .cite = "pharr2016",
             .parameters = parameters,
             .keys = (const char *const[]){"image", "scale", "angle_deg", "radiance", NULL},
             .example = "\"radiance\": [0.2, 0.3, 0.4]"},
    .distance = KOKSMA__LIGHT_AROUND,
    .parse = parse,
    .open = open_light,
    .close = close_light,
    .sample = sample,
    .pdf = pdf,
    .radiance = radiance,
};
