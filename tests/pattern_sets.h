/* SPDX-License-Identifier: Apache-2.0 */
/* What the tests of several patterns ask of their points. */
#ifndef KOKSMA_TESTS_PATTERN_SETS_H
#define KOKSMA_TESTS_PATTERN_SETS_H

#include "claims/claims.h"

/* The status with which a pattern makes n points, of tests of what it refuses. */
static inline koksma_status status_of(const char *text, size_t n, int dim)
{
    koksma_spec spec;
    koksma_points points;
    assert_ok(koksma_pattern_spec(text, &spec));
    assert_ok(koksma_points_init(&points, n, dim));
    const koksma_status status = koksma_generate(&spec, 0, NULL, &points);
    koksma_points_fini(&points);
    return status;
}

/* The smallest distance on the torus, in 2 to 6 dimensions, in units of that of the densest known packing of as many points
   (hexagonal, fcc, D4, D5, E6): spheres that fill a share `filled` of the volume. */
static inline double relative_radius(const koksma_points *p)
{
    static const double ball[] = {3.14159265358979, 4.18879020478639, 4.93480220054468, 5.26378901391432,
                                  5.16771278004997};
    static const double filled[] = {0.906899682117109, 0.740480489693061, 0.616850275068085, 0.465257613309259,
                                    0.372947545582064};
    const int c = p->dim - 2;
    return smallest_distance(p, true) / (2 * pow(filled[c] / (ball[c] * (double)p->n), 1.0 / p->dim));
}

/* The mean of |sum_j exp(-2 pi i k.x_j)|^2 / n over all k != 0 with |k| < radius; of independent points it is 1. */
static inline double power_within(const koksma_points *p, double radius)
{
    const int most = (int)radius;
    const size_t side = (size_t)(2 * most + 1);
    size_t frequencies = 1;
    double sum = 0, count = 0;
    for (int k = 0; k < p->dim; k++) {
        frequencies *= side;
    }
    for (size_t f = 0; f < frequencies / 2; f++) { /* one of k and -k; the middle one is 0 */
        int k[6], square = 0;
        size_t rest = f;
        for (int d = 0; d < p->dim; d++, rest /= side) {
            k[d] = (int)(rest % side) - most;
            square += k[d] * k[d];
        }
        if (square < radius * radius) {
            double re = 0, im = 0;
            for (size_t i = 0; i < p->n; i++) {
                double turns = 0;
                for (int d = 0; d < p->dim; d++) {
                    turns += k[d] * p->xs[i * (size_t)p->dim + (size_t)d];
                }
                re += cos(2 * M_PI * turns);
                im += sin(2 * M_PI * turns);
            }
            sum += (re * re + im * im) / (double)p->n;
            count++;
        }
    }
    return sum / count;
}

/* Functions of the square with known means, most of them of Christensen, Kensler & Kilpatrick 2018. */
enum { INTEGRANDS = 7 };

static const struct {
    const char *name;
    double mean;
} integrands[INTEGRANDS] = {{"x", 0.5},
                            {"bilinear", 0.25},
                            {"quarter Gaussian", 0.55774628535103},
                            {"quarter disk", 0.5},
                            {"step in x", 0.31830988618379067},
                            {"step in y", 0.31830988618379067},
                            {"triangle", 0.5}};

/* Adds the values of all at a point. */
static inline void add_integrands(const double *xy, double f[INTEGRANDS])
{
    const double square = xy[0] * xy[0] + xy[1] * xy[1];
    f[0] += xy[0];
    f[1] += xy[0] * xy[1];
    f[2] += exp(-square);
    f[3] += square < 0.63661977236758134; /* 2/pi */
    f[4] += xy[0] < 0.31830988618379067;
    f[5] += xy[1] < 0.31830988618379067;
    f[6] += xy[1] < xy[0];
}

/* Writes numbers as an .npy file whose header is `head`. */
static inline void write_npy(const char *path, const char *head, const void *numbers, size_t bytes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "%cNUMPY%c%c%c%c%-117s\n", 0x93, 1, 0, 118, 0, head);
    fwrite(numbers, 1, bytes, file);
    assert_int_equal(fclose(file), 0);
}

#endif
