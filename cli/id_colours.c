/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours for the numbers of objects, so that an image of 8 bits shows which pixels see the same object. The colour of
 * number k is point k of the R-sequence in three dimensions (Roberts 2018):
 *     hue frac(k g), saturation 0.45 + 0.5 frac(k g^2), value 0.6 + 0.4 frac(k g^3), where 1 / g is the root of
 *     x^4 = x + 1 above 1
 * For every n the colours of 1 to n are spread evenly, so that objects of nearly the same hue differ in the other two.
 */
#include "id_colours.h"

#include <math.h>
#include <string.h>

#define STEP 0.81917251339616443970

bool cli_has_eight_bits(const char *path)
{
    const char *end = strrchr(path, '.');
    return end && (!strcmp(end, ".png") || !strcmp(end, ".jpg"));
}

static double fraction(double x)
{
    return x - floor(x);
}

/* The linear light that is written as the sRGB level s in [0,1] (IEC 61966-2-1). */
static float linear(double s)
{
    return (float)(s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4));
}

static void colour_of(double id, float rgb[3])
{
    const double hue = fraction(id * STEP), saturation = 0.45 + 0.5 * fraction(id * STEP * STEP),
                 value = id > 0 ? 0.6 + 0.4 * fraction(id * STEP * STEP * STEP) : 0;
    for (int k = 0; k < 3; k++) { /* each channel is a trapezoid over the hues, and the channels are 1/3 apart */
        const double sixths = fabs(6 * fraction(hue - k / 3.0 + 0.5) - 3), full = fmin(fmax(2 - sixths, 0), 1);
        rgb[k] = linear(value * (1 - saturation * (1 - full)));
    }
}

koksma_status cli_write_ids(const char *path, const koksma_image *ids, const char *metadata)
{
    koksma_image colours;
    if (!cli_has_eight_bits(path)) {
        return koksma_image_write(path, ids, metadata);
    }
    koksma_status status = koksma_image_init(&colours, ids->width, ids->height, 3);
    if (!status) {
        for (size_t i = 0; i < (size_t)ids->width * (size_t)ids->height; i++) {
            colour_of((double)ids->pixels[i], &colours.pixels[3 * i]);
        }
        status = koksma_image_write(path, &colours, metadata);
        koksma_image_fini(&colours);
    }
    return status;
}
