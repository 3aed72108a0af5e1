/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes include/koksma/keys_4d_single.def: the keys of koksma_keys_4d with one sample a pixel, by simulated annealing. A
 * program of its own, run by hand; the number is that of proposals a pixel:
 *
 *     cc -O3 -march=native -std=c11 -ffp-contract=off -fno-math-errno -Iinclude tools/make_keys_single.c -lm -o /tmp/make
 *     /tmp/make 20000 > /tmp/keys.def && mv /tmp/keys.def include/koksma/keys_4d_single.def
 *
 * Pixel p of a cell of 64 x 64 takes point key(p) of the first 4,096 of Sobol's sequence in four dimensions, one in each
 * box of 1/8 in every dimension; an exclusive or with random digits moves all points within their boxes. It keeps their
 * distances nearly, as Owen's scrambling does not. The mean square error after the filter over half-spaces, and over boxes
 * at corners of the cube, is in the mean over their positions
 *
 *     E = sum over p, q of g(p - q) K(x_p, x_q),   g(d) = exp(-|d|^2 / 9): the Gaussian of 1.5 pixels with itself
 *     K(x, y) = c(x, y) - c(x) - c(y) + constant,  c(x, y) = product(1 - |x_k - y_k|) - |x - y|,  c(x) = mean of c(x, y)
 *
 * Annealing swaps the keys of two pixels whose points are near on a Z-curve, nearer the colder. c is the mean over two
 * opposite exclusive ors, which change PHASES times. Cells are independent, so only the pairs within the cell count.
 */
#include <koksma/keys.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    SIDE = 64,
    PIXELS = SIDE * SIDE,
    REACH = 8,
    ROW = 24,
    WIDTH = SIDE + ROW,
    BORDERED = (SIDE + 2 * REACH) * WIDTH,
    PHASES = 400,
    COPIES = 2
};

static uint32_t sobol[PIXELS][4];                 /* points as fractions */
static float at[COPIES][4][BORDERED];             /* point of each key */
static float image[COPIES][4][BORDERED];          /* point of each pixel; the border has weight 0 */
static float weights[PIXELS][2 * REACH + 1][ROW]; /* g around each pixel, 0 outside the cell */
static double within[PIXELS], centre[PIXELS];     /* sum of these weights; c(x) of each key */
static int keys[PIXELS], pixel_of[PIXELS], curve[PIXELS], place_of[PIXELS];
static uint64_t counter;

static double uniform(void)
{
    uint32_t w[4];
    koksma_words(2026, KOKSMA_FOR_POINT, counter++, 0, w);
    return (w[0] + 0.5) / 4294967296.0;
}

/* c(x, y), x being one of `points`. */
static inline float correlation(float (*points)[BORDERED], size_t x, const float y[4])
{
    const float a = fabsf(points[0][x] - y[0]), b = fabsf(points[1][x] - y[1]), c = fabsf(points[2][x] - y[2]),
                d = fabsf(points[3][x] - y[3]);
    return (1 - a) * (1 - b) * (1 - c) * (1 - d) - sqrtf(a * a + b * b + c * c + d * d);
}

/* c(x, y) of the points of two keys. */
static double kernel(int a, int b)
{
    double sum = 0;
    for (int c = 0; c < COPIES; c++) {
        float y[4];
        for (int k = 0; k < 4; k++) {
            y[k] = at[c][k][b];
        }
        sum += (double)correlation(at[c], (size_t)a, y) / COPIES;
    }
    return sum;
}

static void put(int pixel, int key)
{
    keys[pixel] = key;
    pixel_of[key] = pixel;
    for (int c = 0; c < COPIES; c++) {
        for (int k = 0; k < 4; k++) {
            image[c][k][(pixel / SIDE + REACH) * WIDTH + pixel % SIDE + REACH] = at[c][k][key];
        }
    }
}

/* Moves all points within their boxes. */
static void move(void)
{
    for (int k = 0; k < 4; k++) {
        const uint32_t digits = (uint32_t)(uniform() * 536870912.0);
        for (int i = 0; i < PIXELS; i++) {
            at[0][k][i] = (float)((sobol[i][k] ^ digits) * 0x1p-32);
            at[1][k][i] = (float)((sobol[i][k] ^ digits ^ 0x1fffffffu) * 0x1p-32);
        }
    }
    for (int p = 0; p < PIXELS; p++) {
        put(p, keys[p]);
    }
}

/* The weighted sum of c(point of key b, x) - c(point of key a, x) over the neighbours x of a pixel. */
static double change(int pixel, int a, int b)
{
    float sums[ROW] = {0};
    for (int c = 0; c < COPIES; c++) {
        float from[4], to[4];
        for (int k = 0; k < 4; k++) {
            from[k] = at[c][k][a];
            to[k] = at[c][k][b];
        }
        for (int v = 0; v <= 2 * REACH; v++) {
            const float *w = weights[pixel][v];
            const size_t first = (size_t)((pixel / SIDE + v) * WIDTH + pixel % SIDE);
            for (int u = 0; u < ROW; u++) {
                const size_t x = first + (size_t)u;
                sums[u] += w[u] * (correlation(image[c], x, to) - correlation(image[c], x, from));
            }
        }
    }
    double sum = 0;
    for (int u = 0; u < ROW; u++) {
        sum += (double)sums[u] / COPIES;
    }
    return sum - within[pixel] * (centre[b] - centre[a]);
}

static int on_curve(const void *a, const void *b)
{
    uint32_t codes[2] = {0, 0};
    for (int bit = 31; bit > 24; bit--) {
        for (int k = 0; k < 4; k++) {
            codes[0] = codes[0] << 1 | (sobol[*(const int *)a][k] >> bit & 1);
            codes[1] = codes[1] << 1 | (sobol[*(const int *)b][k] >> bit & 1);
        }
    }
    return codes[0] != codes[1] ? (codes[0] < codes[1] ? -1 : 1) : *(const int *)a - *(const int *)b;
}

static void prepare(void)
{
    for (int i = 0; i < PIXELS; i++) {
        uint32_t words[4];
        koksma__sobol_quadruple((uint32_t)i, words);
        for (int k = 0; k < 4; k++) {
            sobol[i][k] = koksma_mirror(words[k]);
        }
        curve[i] = keys[i] = i;
        for (int v = -REACH; v <= REACH; v++) {
            for (int u = -REACH; u <= REACH; u++) {
                const int x = i % SIDE + u, y = i / SIDE + v;
                const bool there =
                    x >= 0 && x < SIDE && y >= 0 && y < SIDE && (u || v) && u * u + v * v <= REACH * REACH;
                weights[i][v + REACH][u + REACH] = there ? (float)exp(-(u * u + v * v) / 9.0) : 0;
                within[i] += (double)weights[i][v + REACH][u + REACH];
            }
        }
    }
    qsort(curve, PIXELS, sizeof *curve, on_curve);
    for (int i = 0; i < PIXELS; i++) {
        place_of[curve[i]] = i;
    }
    for (int i = PIXELS - 1; i > 0; i--) {
        const int j = (int)(uniform() * (i + 1)), other = keys[j];
        keys[j] = keys[i];
        keys[i] = other;
    }
    move();
    for (int i = 0; i < PIXELS; i++) {
        for (int j = 0; j < PIXELS; j++) {
            centre[i] += kernel(i, j) / PIXELS;
        }
    }
}

int main(int argc, char **argv)
{
    const double hot = 0.07, cold = 0.001, near = 0.015;
    const long long proposals = (argc > 1 ? atoll(argv[1]) : 20000) * PIXELS, phase = proposals / PHASES;
    prepare();
    for (long long i = 0; i < proposals; i++) {
        const double done = (double)i / (double)proposals, temperature = hot * pow(cold / hot, done);
        const int p = (int)(uniform() * PIXELS), a = keys[p];
        const int step = (int)((2 * uniform() - 1) * (PIXELS * pow(near, done) + 1));
        const int b = curve[(place_of[a] + step + 2 * PIXELS) % PIXELS], q = pixel_of[b];
        const int u = abs(p % SIDE - q % SIDE), v = abs(p / SIDE - q / SIDE);
        if (p == q) {
            continue;
        }
        double growth = change(p, a, b) + change(q, b, a);
        if (u <= REACH && v <= REACH) {
            const double g = (double)weights[p][q / SIDE - p / SIDE + REACH][q % SIDE - p % SIDE + REACH];
            growth += g * (2 * kernel(a, b) - 2);
        }
        if (growth <= 0 || uniform() < exp(-growth / temperature)) {
            put(p, b);
            put(q, a);
        }
        if (i % phase == phase - 1) {
            move();
            fprintf(stderr, "\r%.0f %%", 100 * done);
        }
    }
    puts("/* SPDX-License-Identifier: Apache-2.0 */\n/* The keys of koksma/keys.h for quadruples with one sample a "
         "pixel. Made by "
         "tools/make_keys_single.c. */");
    for (int i = 0; i < PIXELS; i++) {
        printf("%d,%s", keys[i], i % 16 == 15 ? "\n" : " ");
    }
    return 0;
}
