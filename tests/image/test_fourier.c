/* SPDX-License-Identifier: Apache-2.0 */
/* The Fourier transform of pictures of any size, against its definition and Parseval's theorem. */
#include <math.h>
#include <stdlib.h>

#include "image/fourier.h"
#include "sets.h"
#include "test.h"

/* Against the definition: powers of two, primes, odd and even, one row, one column, one pixel. */
TEST_CASE(powers_are_the_definition)
{
    static const int sizes[][2] = {{1, 1},  {2, 1},  {1, 2},  {3, 1},   {1, 7},  {16, 8}, {13, 11},
                                   {31, 2}, {12, 9}, {2, 37}, {17, 16}, {64, 1}, {1, 53}, {30, 45}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int width = sizes[s][0], height = sizes[s][1], columns = width / 2 + 1;
        double *values = calloc((size_t)(width * height), sizeof *values);
        double *power = calloc((size_t)(columns * height), sizeof *power);
        double squares = 0;
        for (int i = 0; i < width * height; i++) {
            values[i] = sets_unit(5 + s, (uint64_t)i) - 0.5;
            squares += values[i] * values[i];
        }
        assert_ok(koksma__fourier_power(width, height, values, power));
        for (int v = 0; v < height; v++) {
            for (int u = 0; u < columns; u++) {
                double re = 0, im = 0;
                for (int i = 0; i < width * height; i++) {
                    const double turn =
                        (double)(u * (i % width) % width) / width + (double)(v * (i / width) % height) / height;
                    re += values[i] * cos(2 * M_PI * turn);
                    im -= values[i] * sin(2 * M_PI * turn);
                }
                assert_near(power[v * columns + u], re * re + im * im, 1e-12 * squares * width * height);
            }
        }
        free(values);
        free(power);
    }
}

/* Parseval's theorem where the definition would take too long: large primes beside powers of two. */
TEST_CASE(powers_add_up)
{
    static const int sizes[][2] = {{509, 512}, {4, 20011}, {65536, 3}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const size_t width = (size_t)sizes[s][0], height = (size_t)sizes[s][1], columns = width / 2 + 1;
        double *values = calloc(width * height, sizeof *values), *power = calloc(columns * height, sizeof *power);
        double squares = 0, sum = 0;
        for (size_t i = 0; i < width * height; i++) {
            values[i] = sets_unit(50 + s, i) - 0.5;
            squares += values[i] * values[i];
        }
        assert_ok(koksma__fourier_power((int)width, (int)height, values, power));
        for (size_t i = 0; i < columns * height; i++) {
            const size_t u = i % columns;
            sum += power[i] * (u == 0 || 2 * u == width ? 1 : 2);
        }
        assert_near(sum / (double)(width * height) / squares, 1, 1e-12);
        free(values);
        free(power);
    }
}
