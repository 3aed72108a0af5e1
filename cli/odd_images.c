/* SPDX-License-Identifier: Apache-2.0 */
/* What in a reference, or in a picture beside it, looks like a mistake, but can be compared. */
#include <string.h>

#include "rendering.h"

enum { LEAST = 256 }; /* pixels, below which nothing is said of noise */

bool cli_has_8_bits(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (!strcmp(dot, ".png") || !strcmp(dot, ".jpg") || !strcmp(dot, ".jpeg"));
}

/* Sums over pixels of the first channels, x of an image and y of its reference: squared roughness (the difference
   between a pixel and the mean of its neighbours at the left and right) of x, y and x - y, and of the numbers
   themselves. */
typedef struct sums {
    double rough_x, rough_y, rough_d, d, y, yy;
    size_t inner, n;
} sums;

static sums sums_of(const koksma_image *image, const koksma_image *reference)
{
    const size_t width = (size_t)image->width, a = (size_t)image->channels, b = (size_t)reference->channels;
    sums s = {.n = width * (size_t)image->height};
    for (size_t p = 0; p < s.n; p++) {
        const float *x = image->pixels + p * a, *y = reference->pixels + p * b;
        const double dx = (double)*x - (double)*y;
        s.d += dx * dx;
        s.y += (double)*y;
        s.yy += (double)*y * (double)*y;
        if (p % width && (p + 1) % width) {
            const double rough_x = (double)*x - ((double)*(x - a) + (double)*(x + a)) / 2;
            const double rough_y = (double)*y - ((double)*(y - b) + (double)*(y + b)) / 2;
            s.rough_x += rough_x * rough_x;
            s.rough_y += rough_y * rough_y;
            s.rough_d += (rough_x - rough_y) * (rough_x - rough_y);
            s.inner++;
        }
    }
    return s;
}

/* If only the reference has noise, independent of the picture, rough_y = rough_x + rough_d; if only the image has noise,
   rough_x = rough_y + rough_d. Half way between, (rough_y - rough_x) / rough_d = 1/2, the reference has 3 times the
   image's variance. An image is another if what noise leaves of the mean square difference (the roughness of white noise
   has 3/2 of its variance) is above half of the reference's variance. */
cli_likeness cli_compare_noise(const koksma_image *image, const koksma_image *reference)
{
    const sums s = sums_of(image, reference);
    const double n = (double)s.n, noise = s.inner ? s.rough_d / (1.5 * (double)s.inner) : 0;
    return (cli_likeness){
        .less_noise = s.n >= LEAST && 2 * (s.rough_y - s.rough_x) > s.rough_d,
        .another = s.n >= LEAST && s.d / n - noise > (s.yy / n - s.y / n * (s.y / n)) / 2,
    };
}
