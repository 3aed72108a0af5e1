/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Resamples the images of other renderers' environments; each new pixel is the mean of four points. The largest image
 * that a scene may name gives 2^29 points, so that what a point takes counts: sines and cosines are those of the new
 * image's rows and columns; angles are polynomials without branches, which compilers compute for several points at once;
 * and the new image is made in tiles, whose points lie in few pages of the old one, whatever the rotation.
 */
#include "scene/import.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/status.h"
#include "render/fields.h"

/* FINE: for an image of Mitsuba, which is interpolated, the new pixels are at most .35 degrees high. */
enum { FINE = 512, TILE = 64 };

#ifdef __clang__ /* which finds two points at once too few; gcc does not */
#define VECTORIZE _Pragma("clang loop vectorize(enable)")
#else
#define VECTORIZE
#endif

/* What all points of an image have in common. */
typedef struct sky {
    const koksma_image *from;
    const double *inverse;         /* the inverse of the environment's matrix */
    const double *sines, *cosines; /* of the two points across of each new pixel */
} sky;

/* atan(a / b) for 0 <= a <= b, b > 0, by atan t = pi/8 + atan d with d = (t - c) / (1 + c t) and c = tan(pi/8), which
   bounds |d| by c. The polynomial interpolates atan(d) / d in d^2 at Chebyshev's points; the error is below 1e-15. */
static inline double arc(double a, double b)
{
    const double c = M_SQRT2 - 1, d = (a - c * b) / (b + c * a), z = d * d;
    double sum = -0.02466241993970419;
    sum = sum * z + 0.0497526480161186;
    sum = sum * z - 0.06490418555707293;
    sum = sum * z + 0.07670903094944609;
    sum = sum * z - 0.09089270876560607;
    sum = sum * z + 0.11111033842061874;
    sum = sum * z - 0.1428571216719336;
    sum = sum * z + 0.19999999969937918;
    sum = sum * z - 0.3333333333316042;
    sum = sum * z + 0.999999999999998;
    return M_PI / 8 + d * sum;
}

/* atan2(y, x). */
static inline double angle(double y, double x)
{
    const double across = fabs(x), up = fabs(y), small = across < up ? across : up, large = across < up ? up : across;
    double a = large > 0 ? arc(small, large) : 0;
    a = across < up ? M_PI / 2 - a : a;
    a = x < 0 ? M_PI - a : a;
    return copysign(a, y);
}

/* The point in the square [0, 1]^2 of a direction of any length in the equal-area octahedral map (Clarberg 2008), whose
   pole is z; *u is -1 if it has no length. */
static inline void octahedral_square(double x, double y, double z, double *u, double *v)
{
    const double flat = x * x + y * y, length = sqrt(flat + z * z), high = fabs(z);
    const double r = sqrt(flat / (length * (length + high))); /* the root of 1 - high / length */
    const double across = fabs(x), up = fabs(y), small = across < up ? across : up, large = across < up ? up : across;
    const double near = r * (large > 0 ? arc(small, large) * (2 / M_PI) : 0);
    const double b = across < up ? r - near : near, a = r - b;
    *u = length > 1e-12 ? (copysign(z < 0 ? 1 - b : a, x) + 1) / 2 : -1;
    *v = (copysign(z < 0 ? 1 - a : b, y) + 1) / 2;
}

/* The point of a latitude-longitude image for a direction, with Mitsuba's axes: y is up, column 0 is in direction -z.
   *u is -1 if the direction has no length. */
static inline void latitude_square(double x, double y, double z, double *u, double *v)
{
    const double flat = x * x + z * z, turn = angle(x, -z) * (1 / TURN);
    *u = flat + y * y > 1e-24 ? (turn < 0 ? turn + 1 : turn) : -1;
    *v = angle(sqrt(flat), y) * (1 / M_PI);
}

/* Writes the means of four pixels each to n pixels; at: their numbers, in two rows. */
static inline void mean_nearest(const float *pixels, int channels, int at[2][2 * TILE], int n, float *to)
{
    for (int i = 0; i < n * channels; i++) {
        float sum = 0;
        for (int k = 0; k < 4; k++) {
            const int from = at[k % 2][2 * (i / channels) + k / 2];
            sum += from >= 0 ? (float)(0.25 * (double)pixels[from * channels + i % channels]) : 0;
        }
        to[i] = sum;
    }
}

/* Adds a quarter of the bilinear interpolation at (u, v) of an image of Mitsuba, in which the first and the last row lie
   at the poles and each column in the middle of its strip. */
static inline void add_interpolated(const koksma_image *image, double u, double v, float sums[3])
{
    const int width = image->width, height = image->height, channels = image->channels;
    if (!(u >= 0 && v >= 0)) { /* -1 or NaN */
        return;
    }
    const double at = u * width - 0.5, down = v * (height - 1);
    const int x = (int)floor(at), last = (int)down < height ? (int)down : height - 1;
    const int columns[2] = {x < 0 ? width - 1 : x, x + 1 < width ? x + 1 : 0};
    const int rows[2] = {last, last + 1 < height ? last + 1 : height - 1};
    double weights[4];
    const float *pixels[4];
    for (int i = 0; i < 4; i++) {
        weights[i] = (i % 2 ? at - x : 1 - at + x) * (i / 2 ? down - last : 1 - down + last);
        pixels[i] = image->pixels + (rows[i / 2] * width + columns[i % 2]) * channels;
    }
    for (int k = 0; k < 3 && k < channels; k++) {
        double sum = 0;
        for (int i = 0; i < 4; i++) {
            sum += weights[i] * (double)pixels[i][k];
        }
        sums[k] += (float)(0.25 * sum);
    }
}

/* The points of the old image for n points of a row of the new one, at the polar angle theta, from number `first` on. */
static void find_points(const sky *s, bool octahedral, double theta, int first, int n, double *restrict u,
                        double *restrict v)
{
    const double *m = s->inverse, sine = koksma__sin(theta), cosine = koksma__cos(theta);
    const double *restrict sines = s->sines + first, *restrict cosines = s->cosines + first;
    double x[2 * TILE], y[2 * TILE], z[2 * TILE];
    for (int i = 0; i < n; i++) {
        const double w[3] = {-sine * sines[i], cosine, sine * cosines[i]};
        x[i] = m[0] * w[0] + m[1] * w[1] + m[2] * w[2];
        y[i] = m[4] * w[0] + m[5] * w[1] + m[6] * w[2];
        z[i] = m[8] * w[0] + m[9] * w[1] + m[10] * w[2];
    }
    const int n_flat = octahedral ? n : 0, n_round = n - n_flat;
    VECTORIZE
    for (int i = 0; i < n_flat; i++) {
        octahedral_square(x[i], y[i], z[i], &u[i], &v[i]);
    }
    VECTORIZE
    for (int i = 0; i < n_round; i++) {
        latitude_square(x[i], y[i], z[i], &u[i], &v[i]);
    }
}

/* The numbers of the pixels at n points of an octahedral image, which pbrt does not interpolate; -1 for none. */
static void find_pixels(const koksma_image *image, const double *restrict u, const double *restrict v, int n,
                        int *restrict out)
{
    const double width = image->width, height = image->height;
    VECTORIZE
    for (int i = 0; i < n; i++) {
        const double across = u[i] * width, down = v[i] * height;
        const double column = (int)(across < width ? across : width - 1),
                     row = (int)(down < height ? down : height - 1);
        out[i] = u[i] >= 0 && v[i] >= 0 ? (int)(row * width + column) : -1;
    }
}

/* Makes n pixels of a row, from pixel px on. */
static void turn_pixels(const sky *s, bool octahedral, int px, int py, int n, koksma_image *out)
{
    double u[2][2 * TILE], v[2][2 * TILE];
    int at[2][2 * TILE];
    for (int half = 0; half < 2; half++) {
        find_points(s, octahedral, M_PI * (py + 0.25 + 0.5 * half) / out->height, 2 * px, 2 * n, u[half], v[half]);
        find_pixels(s->from, u[half], v[half], octahedral ? 2 * n : 0, at[half]);
    }
    float *to = out->pixels + (py * out->width + px) * out->channels;
    if (octahedral && out->channels == 1) { /* the compiler knows the number */
        mean_nearest(s->from->pixels, 1, at, n, to);
    } else if (octahedral) {
        mean_nearest(s->from->pixels, 3, at, n, to);
    }
    for (int i = 0; i < n && !octahedral; i++) {
        float sums[3] = {0};
        for (int k = 0; k < 4; k++) {
            add_interpolated(s->from, u[k % 2][2 * i + k / 2], v[k % 2][2 * i + k / 2], sums);
        }
        for (int k = 0; k < 3 && k < out->channels; k++) {
            *to++ = sums[k];
        }
    }
}

static void turn_all(const sky *s, bool octahedral, koksma_image *out)
{
    const int across = (out->width + TILE - 1) / TILE, tiles = across * ((out->height + TILE - 1) / TILE);
    for (int i = 0; i < tiles * TILE; i++) {
        const int tile = i / TILE, px = tile % across * TILE, py = tile / across * TILE + i % TILE;
        if (py < out->height) {
            turn_pixels(s, octahedral, px, py, out->width - px < TILE ? out->width - px : TILE, out);
        }
    }
}

koksma_status koksma__sky_turn(const koksma_image *from, bool octahedral, const double inverse[12], koksma_image *out)
{
    const int own = octahedral ? from->height : (from->width + 1) / 2;
    const int height = octahedral || own > FINE ? own : FINE, width = 2 * height;
    const size_t own_pixels = (size_t)from->width * (size_t)from->height, fine = (size_t)2 * FINE * FINE;
    KOKSMA__FAIL_IF(octahedral && from->width != from->height, KOKSMA_MALFORMED,
                    "an environment of %d x %d pixels is not square, as the octahedral images of pbrt are: imgtool "
                    "makeequiarea makes one of latitudes and longitudes",
                    from->width, from->height);
    KOKSMA__FAIL_IF(!octahedral && (size_t)width * (size_t)height > 2 * (own_pixels > fine ? own_pixels : fine),
                    KOKSMA_MALFORMED, "an environment of %d x %d pixels is more than four times as wide as high",
                    from->width, from->height);
    double *sines = malloc(4 * (size_t)width * sizeof *sines), *cosines = sines + 2 * width;
    KOKSMA__REQUIRE_MEMORY(sines, 4 * (size_t)width * sizeof *sines);
    for (int i = 0; i < 2 * width; i++) {
        const double phi = TURN * (i / 2 + 0.25 + 0.5 * (i % 2)) / width;
        sines[i] = koksma__sin(phi);
        cosines[i] = koksma__cos(phi);
    }
    const koksma_status status = koksma_image_init(out, width, height, from->channels);
    if (!status) {
        turn_all(&(sky){from, inverse, sines, cosines}, octahedral, out);
    }
    free(sines);
    return status;
}
