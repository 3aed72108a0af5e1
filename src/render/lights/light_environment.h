/* SPDX-License-Identifier: Apache-2.0 */
/* The image of an environment as a density over directions. */
#ifndef KOKSMA_RENDER_LIGHTS_LIGHT_ENVIRONMENT_H
#define KOKSMA_RENDER_LIGHTS_LIGHT_ENVIRONMENT_H

#include "render/lanes3.h"
#include "render/lights/lights.h"

enum { KOKSMA__ENVIRONMENT_STEP = 16 }; /* numbers of a cumulative table between coarse ones */

/* The share of samples that are uniform over the sphere. */
#define KOKSMA__ENVIRONMENT_FLOOR 0.01f

typedef struct koksma__environment {
    float radiance[3];       /* scale of the image */
    const float *texels;     /* NULL: the same everywhere; else the image's, `channels` numbers each */
    int32_t channels, green; /* green: of its number in a texel; blue is 2 green */
    int32_t width, height;
    float turn; /* as a part of a full turn */
    float mean;
    /* Cumulative tables, of `height` rows and of `width` columns in each row: row r's at column_cdf + r stride, as the
       rows' own are. Numbers above 1 fill whole strides of 16 and one more. coarse: every 16th number. */
    float *row_cdf, *column_cdf, *row_coarse, *column_coarse;
    size_t stride;
} koksma__environment;

/* Where a direction is in the image, and its sine with the vertical. */
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
    const float y = 2 * koksma__arc_turns(sine, w.y); /* an arc cosine knows no angles below 2^-12 */
    const int32_t column = (int32_t)(x * (float)e->width), row = (int32_t)(y * (float)e->height);
    return (koksma__texel){row < e->height ? row : e->height - 1, column < e->width ? column : e->width - 1, sine};
}

/* The density of the directions in a texel. */
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
    return (koksma__v3){e->radiance[0] * (r > 0 ? r : 0), e->radiance[1] * (g > 0 ? g : 0), /* no negative light */
                        e->radiance[2] * (b > 0 ? b : 0)};
}

/* Tables of the light's image, if it has one; close also after a failure. Errors: MALFORMED (a pixel that is infinite
   or no number), MEMORY. */
koksma_status koksma__environment_open(const koksma__light *light, koksma__environment **out);
void koksma__environment_close(koksma__environment *environment);

/* A direction by importance; its density. */
float koksma__environment_sample(const koksma__environment *environment, const float u[2], float w[3]);
float koksma__environment_pdf(const koksma__environment *environment, const float w[3]);

/* Radiance along w from far away; the mean over all directions, as luminance. */
void koksma__environment_radiance(const koksma__environment *environment, const float w[3], float out[3]);
float koksma__environment_mean(const koksma__environment *environment);

#endif
