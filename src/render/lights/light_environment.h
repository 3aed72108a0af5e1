/* SPDX-License-Identifier: Apache-2.0 */
/* Importance sampling of directions by the image of an environment. */
#ifndef KOKSMA_RENDER_LIGHTS_LIGHT_ENVIRONMENT_H
#define KOKSMA_RENDER_LIGHTS_LIGHT_ENVIRONMENT_H

#include "render/lanes3.h"
#include "render/lights/lights.h"

enum { KOKSMA__ENVIRONMENT_STEP = 16 }; /* the coarse table of a cumulative table has every 16th entry */

/* The fraction of samples that are uniform over the sphere. */
#define KOKSMA__ENVIRONMENT_FLOOR 0.01f

typedef struct koksma__environment {
    float radiance[3];       /* multiplies the image */
    const float *texels;     /* the image, with `channels` numbers for each pixel; NULL: constant radiance */
    int32_t channels, green; /* green is the offset of the green number in a texel; blue is at 2 * green */
    int32_t width, height;
    float turn; /* rotation, as a fraction of a full turn */
    float mean;
    /* Cumulative tables, of `height` entries over the rows and of `width` over the columns of each row; row r's table
       begins at column_cdf + r stride. Each table is padded with values above 1 to a multiple of 16 numbers, and then
       by 16 more. row_coarse and column_coarse hold every 16th entry and are searched first. */
    float *row_cdf, *column_cdf, *row_coarse, *column_coarse;
    size_t stride;
} koksma__environment;

/* The texel of a direction, and the sine of the angle between the direction and the vertical. */
typedef struct koksma__texel {
    int32_t row, column;
    float sine;
} koksma__texel;

KOKSMA__INLINE koksma__v3 koksma__environment_direction(const koksma__environment *e, float x, float y, float *sine)
{
    float s, c, up;
    koksma__sine_cosine_turns(x - e->turn, &s, &c);
    koksma__sine_cosine_turns(0.5f * y, sine, &up);
    return (koksma__v3){-*sine * s, up, *sine * c};
}

KOKSMA__INLINE koksma__texel koksma__environment_texel(const koksma__environment *e, koksma__v3 w)
{
    const float sine = sqrtf(w.x * w.x + w.z * w.z);
    const float turns = koksma__arc_turns(-w.x, w.z) + e->turn + 2, x = turns - (float)(int32_t)turns;
    /* an arc cosine in floats cannot resolve angles below 2^-12 */
    const float y = 2 * koksma__arc_turns(sine, w.y);
    const int32_t column = (int32_t)(x * (float)e->width), row = (int32_t)(y * (float)e->height);
    return (koksma__texel){row < e->height ? row : e->height - 1, column < e->width ? column : e->width - 1, sine};
}

/* The density of sampling the directions in a texel. */
KOKSMA__INLINE float koksma__environment_texel_pdf(const koksma__environment *e, koksma__texel t)
{
    const float *columns = e->column_cdf + (size_t)t.row * e->stride + (size_t)t.column, *rows = e->row_cdf + t.row;
    const float cell = (rows[1] - rows[0]) * (columns[1] - columns[0]) * ((float)e->width * (float)e->height);
    const float image = cell / (2 * 3.14159265358979f * 3.14159265358979f * (t.sine > 1e-6f ? t.sine : 1e-6f));
    return KOKSMA__ENVIRONMENT_FLOOR * (0.25f / 3.14159265358979f) + (1 - KOKSMA__ENVIRONMENT_FLOOR) * image;
}

KOKSMA__INLINE koksma__v3 koksma__environment_texel_radiance(const koksma__environment *e, koksma__texel t)
{
    const float *texel = e->texels + ((size_t)t.row * (size_t)e->width + (size_t)t.column) * (size_t)e->channels;
    const float r = texel[0], g = texel[e->green], b = texel[2 * e->green];
    /* clamps negative values to 0 */
    return (koksma__v3){e->radiance[0] * (r > 0 ? r : 0), e->radiance[1] * (g > 0 ? g : 0),
                        e->radiance[2] * (b > 0 ? b : 0)};
}

/* Makes the tables for the light's image, if it has one; the caller must call close even after a failure. Errors:
   MALFORMED (a pixel is infinite or NaN), MEMORY. */
koksma_status koksma__environment_open(const koksma__light *light, koksma__environment **out);
void koksma__environment_close(koksma__environment *environment);

/* Samples a direction by importance; returns its density. */
float koksma__environment_sample(const koksma__environment *environment, const float u[2], float w[3]);
float koksma__environment_pdf(const koksma__environment *environment, const float w[3]);

/* koksma__environment_radiance: the radiance along w from far away. koksma__environment_mean: the luminance, averaged
   over all directions. */
void koksma__environment_radiance(const koksma__environment *environment, const float w[3], float out[3]);
float koksma__environment_mean(const koksma__environment *environment);

#endif
