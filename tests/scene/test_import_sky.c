/* SPDX-License-Identifier: Apache-2.0 */
/* The images of other renderers' environments, against the same maps by libm's functions, pixel by pixel. */
#include <math.h>

#include "core/vector.h"
#include "render/fields.h"
#include "scene/import.h"
#include "test.h"

/* The point in the square [0, 1]^2 of a direction in the equal-area octahedral map (Clarberg 2008), whose pole is
   z. */
static void octahedral_square(const double w[3], double uv[2])
{
    const double x = fabs(w[0]), y = fabs(w[1]), z = fabs(w[2]), r = sqrt(fmax(0, 1 - z));
    double v = r * (x > 0 || y > 0 ? atan2(fmin(x, y), fmax(x, y)) * 2 / M_PI : 0);
    v = x < y ? r - v : v;
    double u = r - v;
    if (w[2] < 0) {
        const double swapped = 1 - v;
        v = 1 - u;
        u = swapped;
    }
    uv[0] = (copysign(u, w[0]) + 1) / 2;
    uv[1] = (copysign(v, w[1]) + 1) / 2;
}

/* The point of a latitude-longitude image for a direction, with Mitsuba's axes: y is up, column 0 is in direction
   -z. */
static void latitude_square(const double w[3], double uv[2])
{
    const double turn = atan2(w[0], -w[2]) / TURN;
    uv[0] = turn - floor(turn);
    uv[1] = acos(fmin(fmax(w[1], -1), 1)) / M_PI;
}

/* Channel k of an environment's image at (u, v): in an octahedral image of pbrt the nearest pixel; in an image of
   Mitsuba the bilinear interpolation, in which the first and the last row lie at the poles and each column in the
   middle of its strip. */
static double value_at(const koksma_image *image, bool octahedral, const double uv[2], int k)
{
    const int width = image->width, height = image->height;
    if (octahedral) {
        const int x = (int)fmin(uv[0] * width, width - 1), y = (int)fmin(uv[1] * height, height - 1);
        return (double)image->pixels[(y * width + x) * image->channels + k];
    }
    const double at = uv[0] * width - 0.5, down = uv[1] * (height - 1);
    const int x = (int)floor(at), y = (int)fmin(down, height - 1);
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const int column = (x + i % 2 + width) % width, row = y + i / 2 < height ? y + i / 2 : height - 1;
        const double weight = (i % 2 ? at - x : 1 - at + x) * (i / 2 ? down - y : 1 - down + y);
        sum += weight * (double)image->pixels[(row * width + column) * image->channels + k];
    }
    return sum;
}

/* The mean of four points of a new pixel. */
static double expected(const koksma_image *from, bool octahedral, const double inverse[12], const koksma_image *to,
                       int px, int py, int k)
{
    float sum = 0;
    for (int i = 0; i < 4; i++) {
        const double theta = M_PI * (py + 0.25 + 0.5 * (i % 2)) / to->height;
        const double phi = TURN * (px + 0.25 + 0.5 * (i / 2)) / to->width;
        const double w[3] = {-sin(theta) * sin(phi), cos(theta), sin(theta) * cos(phi)};
        double local[3], uv[2];
        for (int r = 0; r < 3; r++) {
            local[r] = koksma__dot(inverse + 4 * r, w);
        }
        assert_true(koksma__normalise(local));
        (octahedral ? octahedral_square : latitude_square)(local, uv);
        sum += (float)(0.25 * value_at(from, octahedral, uv, k));
    }
    return (double)sum;
}

/* 70 and 600 are no multiples of a tile's side. The second matrix rotates, mirrors and scales. */
TEST_CASE(environments_are_turned)
{
    static const double matrices[][12] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                                          {0.6, 0.8, 0, 1, -1.6, 1.2, 0.5, 2, 0, 0.3, -0.7, 3}};
    static const int sizes[][3] = {{70, 70, 1}, {70, 70, 3}, {1200, 600, 1}, {40, 20, 3}};
    for (size_t i = 0; i < 8; i++) {
        const int *size = sizes[i / 2];
        const bool octahedral = size[0] == size[1];
        koksma_image from, to;
        assert_ok(koksma_image_init(&from, size[0], size[1], size[2]));
        for (int p = 0; p < size[0] * size[1] * size[2]; p++) {
            from.pixels[p] = (float)(p % 1009 * 7 % 1009) / 1009;
        }
        assert_ok(koksma__sky_turn(&from, octahedral, matrices[i % 2], &to));
        assert_int_equal(to.height, octahedral ? 70 : size[0] > 40 ? 600 : 512);
        int n_off = 0;
        for (int p = 0; p < to.width * to.height * to.channels; p++) {
            const int pixel = p / to.channels;
            const double wanted = expected(&from, octahedral, matrices[i % 2], &to, pixel % to.width,
                                           pixel / to.width, p % to.channels);
            n_off += fabs((double)to.pixels[p] - wanted) > 1e-6;
        }
        assert_int_equal(n_off, 0);
        koksma_image_fini(&from);
        koksma_image_fini(&to);
    }
}
