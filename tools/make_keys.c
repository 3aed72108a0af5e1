/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes include/koksma/keys.def and keys_4d.def: the keys of koksma/keys.h, by simulated annealing. A program of its
 * own, run by hand; the first number is that of the coordinates of a key, the second that of proposals a start:
 *
 *     cc -O3 -std=c11 -ffp-contract=off -Iinclude tools/make_keys.c -lm -o /tmp/make_keys
 *     /tmp/make_keys 2 > /tmp/keys.def && mv /tmp/keys.def include/koksma/
 *     /tmp/make_keys 4 3000000 > /tmp/keys_4d.def && mv /tmp/keys_4d.def include/koksma/
 *
 * Pixel p of a cell takes the samples sequence(key(p) XOR i), i < n, of one Owen-scrambled (0,2)-sequence. Owen scrambling
 * makes the covariance of the errors of two pixels, in the mean over scramblings, a function of key(p) XOR key(q) alone.
 * For each table of 2^m samples:
 * 1. Covariances: SCRAMBLINGS sequences, FUNCTIONS training integrands (half of them Heaviside steps of random direction
 *    through a random point, half smooth), n = 1, 2, 4 ... 2^m and 3, 6, 12 ... The errors e(k) of all 2^(10+m) keys k
 *    have the autocorrelation g(d) = mean over k of e(k) e(k XOR d), which a Walsh-Hadamard transform gives. The table g
 *    that follows is the mean over integrands, each in units of its g(0), and the weighted sum over n.
 * 2. Annealing of E = sum over p, q of g(key(p) XOR key(q)) exp(-|p - q|^2 / (2 s^2)), s = 1.8 pixels: the expected
 *    power of the errors at the frequencies that this Gaussian lets pass. It starts at a Z-curve (Ahmed & Wonka 2020). A
 *    proposal swaps the blocks of two pixels or changes the ranking bits of one. Other cells are independent, so only
 *    the pairs within a cell count. Of STARTS runs the one with the smallest E is kept.
 */
#include <koksma/keys.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = KOKSMA_KEYS_SIZE, PIXELS = SIZE * SIZE, BLOCK_BITS = 10, TABLES = KOKSMA_KEYS_TABLES };
enum { FUNCTIONS = 64, STEPS = FUNCTIONS / 2, SCRAMBLINGS = 64, STARTS = 2 };
enum { KEYS = 1 << (BLOCK_BITS + TABLES - 1) };

static uint64_t counter;

static uint32_t draw(void)
{
    uint32_t w[4];
    koksma_words(2019, KOKSMA_FOR_POINT, counter++, 0, w);
    return w[0];
}

static double uniform(void)
{
    return (draw() + 0.5) / 4294967296.0;
}

/* ---- Training integrands ----------------------------------------------------------------------------------- */

typedef struct integrand {
    int kind;
    double a[4], u[4], c, mean; /* a: 0 for coordinates that have no effect */
} integrand;

static integrand functions[FUNCTIONS];

/* A step, a wave, an exponential or a Gaussian. */
static double value(const integrand *f, const double x[4])
{
    double sum = f->kind == 3 ? 0 : f->a[0] * x[0];
    for (int k = f->kind == 3 ? 0 : 1; k < 4; k++) {
        sum += f->kind == 3 ? f->a[k] * (x[k] - f->u[k]) * (x[k] - f->u[k]) : f->a[k] * x[k];
    }
    switch (f->kind) {
    case 0:
        return sum < f->c;
    case 1:
        return cos(sum + f->c);
    case 2:
        return exp(sum);
    default:
        return exp(-f->c * sum);
    }
}

/* Functions of two coordinates. A quarter of the steps is parallel to an axis. */
static void make_functions(void)
{
    enum { SIDE = 1024 };
    const double pi = 3.141592653589793;
    for (int t = 0; t < FUNCTIONS; t++) {
        integrand *f = &functions[t];
        const double u = uniform(), v = uniform(), w = uniform();
        f->kind = t < STEPS ? 0 : 1 + t % 3;
        if (f->kind == 0) {
            const double angle = pi / 2 * (t % 4 ? 4 * w : t / 4 % 4);
            *f = (integrand){0, {cos(angle), sin(angle)}, {0}, cos(angle) * u + sin(angle) * v, 0};
        } else if (f->kind == 1) {
            *f = (integrand){1, {2 * pi * u, 2 * pi * (2 * v - 1)}, {0}, 2 * pi * w, 0};
        } else if (f->kind == 2) {
            *f = (integrand){2, {4 * u - 2, 4 * v - 2}, {0}, 0, 0};
        } else {
            *f = (integrand){3, {1, 1}, {u, v}, 2 + 20 * w * w, 0};
        }
        for (int i = 0; i < SIDE * SIDE; i++) {
            const double x[4] = {(i % SIDE + 0.5) / SIDE, (i / SIDE + 0.5) / SIDE};
            f->mean += value(f, x) / (SIDE * SIDE);
        }
    }
}

/* A normal random number. */
static double normal(void)
{
    const double radius = sqrt(-2 * log(uniform()));
    return radius * cos(2 * 3.141592653589793 * uniform());
}

/* Functions of 1, 2, 3 or 4 of the four coordinates: a quarter each, which ones is random. */
static void make_functions_4d(void)
{
    enum { POINTS = 1 << 20 };
    const koksma_keys sequence = {{1, 2, 3, 4}, 0, 0, 0};
    for (int t = 0; t < FUNCTIONS; t++) {
        integrand *f = &functions[t];
        int left = 1 + t % 4;
        *f = (integrand){t / 4 % 2 ? 1 + t / 8 % 3 : 0, {0}, {0}, 0, 0};
        for (int k = 0; k < 4; k++) {
            f->u[k] = uniform();
            if (uniform() * (4 - k) < left) {
                left--;
                f->a[k] = f->kind == 0   ? normal()
                          : f->kind == 1 ? 3 * normal()
                          : f->kind == 2 ? 4 * uniform() - 2
                                         : 1;
                f->c += f->kind == 0 ? f->a[k] * f->u[k] : 0;
            }
        }
        f->c = f->kind == 1 ? 6.283185307179586 * uniform() : f->kind == 3 ? 1 + 9 * uniform() : f->c;
        for (uint32_t i = 0; i < POINTS; i++) {
            double x[4];
            koksma_keys_4d(&sequence, i, x);
            f->mean += value(f, x) / POINTS;
        }
    }
}

/* ---- Covariances ------------------------------------------------------------------------------------------- */

static void walsh_hadamard(double *a, uint32_t n)
{
    for (uint32_t h = 1; h < n; h *= 2) {
        for (uint32_t i = 0; i < n; i += 2 * h) {
            for (uint32_t j = i; j < i + h; j++) {
                const double u = a[j], v = a[j + h];
                a[j] = u + v;
                a[j + h] = u - v;
            }
        }
    }
}

/* Spectra of the errors of one integrand with 2^j samples, and with 3 2^j; keys that differ in the last j bits have equal
   errors. */
static double power[2][TABLES][KEYS];

/* Adds the powers of the errors whose block means are in `blocks`: blocks[j][b] for the keys b 2^j .. (b + 1) 2^j - 1. */
static void add_powers(uint32_t m, double blocks[TABLES][KEYS])
{
    static double e[KEYS];
    for (uint32_t j = 0; j <= m; j++) {
        const uint32_t n = 1u << (BLOCK_BITS + m - j);
        for (int three = 0; three < (j + 2 <= m ? 2 : 1); three++) {
            for (uint32_t b = 0; b < n; b++) {
                e[b] = three ? (4 * blocks[j + 2][b >> 2] - blocks[j][b ^ 3]) / 3 : blocks[j][b];
            }
            walsh_hadamard(e, n);
            for (uint32_t b = 0; b < n; b++) {
                power[three][j][b] += e[b] * e[b];
            }
        }
    }
}

static void add_scrambling(const integrand *f, uint32_t m, uint64_t seed, int dims)
{
    static double blocks[TABLES][KEYS];
    const uint32_t keys = 1u << (BLOCK_BITS + m);
    const koksma_keys sequence = {
        {koksma_seed_of(seed, 0), koksma_seed_of(seed, 1), koksma_seed_of(seed, 3), koksma_seed_of(seed, 4)},
        koksma_seed_of(seed, 2),
        0,
        0};
    for (uint32_t i = 0; i < keys; i++) {
        double x[4] = {0};
        (dims == 2 ? koksma_keys_2d : koksma_keys_4d)(&sequence, i, x);
        blocks[0][i] = value(f, x) - f->mean;
    }
    for (uint32_t j = 1; j <= m; j++) {
        for (uint32_t b = 0; b < keys >> j; b++) {
            blocks[j][b] = (blocks[j - 1][2 * b] + blocks[j - 1][2 * b + 1]) / 2;
        }
    }
    add_powers(m, blocks);
}

static float g[KEYS];

/* Weights: 1 for 2^m samples, 0.02 for each smaller power of two and for each three quarters of a power of two. */
static void make_covariances(uint32_t m, int dims)
{
    memset(g, 0, sizeof g);
    for (int t = 0; t < FUNCTIONS; t++) {
        memset(power, 0, sizeof power);
        for (uint64_t s = 0; s < SCRAMBLINGS; s++) {
            add_scrambling(&functions[t], m, 1000 * (m + 1) + s, dims);
        }
        for (uint32_t j = 0; j <= m; j++) {
            for (int three = 0; three < (j + 2 <= m ? 2 : 1); three++) {
                const double weight = three || j < m ? 0.02 : 1;
                double *a = power[three][j];
                walsh_hadamard(a, 1u << (BLOCK_BITS + m - j));
                for (uint32_t d = 0; d < 1u << (BLOCK_BITS + m); d++) {
                    g[d] += (float)(weight * a[d >> j] / a[0] / FUNCTIONS);
                }
            }
        }
    }
}

/* ---- Annealing --------------------------------------------------------------------------------------------- */

enum { REACH = 7 };

static float gauss[2 * REACH + 1][2 * REACH + 1];

static void make_gauss(double s)
{
    for (int v = -REACH; v <= REACH; v++) {
        for (int u = -REACH; u <= REACH; u++) {
            gauss[v + REACH][u + REACH] = u || v ? (float)exp(-(u * u + v * v) / (2 * s * s)) : 0;
        }
    }
}

/* The terms of E of a pixel with a key and all other pixels but one. */
static double pull(const uint16_t *keys, int p, uint32_t key, int except)
{
    const int x = p % SIZE, y = p / SIZE;
    const int left = x > REACH ? x - REACH : 0, right = x + REACH < SIZE ? x + REACH : SIZE - 1;
    const int top = y > REACH ? y - REACH : 0, bottom = y + REACH < SIZE ? y + REACH : SIZE - 1;
    double sum = 0;
    for (int v = top; v <= bottom; v++) {
        const float *weights = &gauss[v - y + REACH][left - x + REACH];
        const uint16_t *row = keys + v * SIZE + left;
        for (int u = 0; u <= right - left; u++) {
            sum += (double)(weights[u] * g[row[u] ^ key]);
        }
    }
    if (except >= 0) {
        const int u = except % SIZE - x, v = except / SIZE - y;
        if (abs(u) <= REACH && abs(v) <= REACH) {
            sum -= (double)(gauss[v + REACH][u + REACH] * g[keys[except] ^ key]);
        }
    }
    return sum;
}

static double energy(const uint16_t *keys)
{
    double sum = 0;
    for (int p = 0; p < PIXELS; p++) {
        sum += pull(keys, p, keys[p], -1) / PIXELS;
    }
    return sum;
}

static int accepted(double loss, double temperature)
{
    return loss <= 0 || (loss < 20 * temperature && uniform() < exp(-loss / temperature));
}

/* Swaps the blocks of two pixels, which keep their ranking bits, or flips ranking bits of a pixel. */
static void propose(uint16_t *keys, uint32_t m, double temperature)
{
    const uint32_t word = draw(), ranks = (1u << m) - 1;
    const int p = (int)(word % PIXELS), q = (int)(word / PIXELS % PIXELS);
    if (word >> 31 && m) {
        const uint32_t key = keys[p] ^ (1u << (word >> 10) % m);
        if (accepted(pull(keys, p, key, -1) - pull(keys, p, keys[p], -1), temperature)) {
            keys[p] = (uint16_t)key;
        }
    } else if (p != q) {
        const uint32_t flip = (keys[p] ^ keys[q]) & (word >> 30 & 1 ? ~ranks : ~0u);
        const uint32_t at_p = keys[p] ^ flip, at_q = keys[q] ^ flip;
        const double loss =
            pull(keys, p, at_p, q) + pull(keys, q, at_q, p) - pull(keys, p, keys[p], q) - pull(keys, q, keys[q], p);
        if (accepted(loss, temperature)) {
            keys[p] = (uint16_t)at_p;
            keys[q] = (uint16_t)at_q;
        }
    }
}

static double anneal(uint16_t *keys, uint32_t m, long proposals)
{
    for (uint32_t p = 0; p < PIXELS; p++) {
        uint32_t z = 0;
        for (uint32_t b = 0; b < BLOCK_BITS / 2; b++) {
            z |= (p >> b & 1) << 2 * b | (p >> (BLOCK_BITS / 2 + b) & 1) << (2 * b + 1);
        }
        keys[p] = (uint16_t)(z << m | (draw() & ((1u << m) - 1)));
    }
    for (long i = 0; i < proposals; i++) {
        propose(keys, m, 0.1 * pow(0.005, (double)i / (double)proposals));
    }
    return energy(keys);
}

int main(int argc, char **argv)
{
    static uint16_t keys[TABLES][PIXELS], tried[PIXELS];
    const int dims = argc > 1 && !strcmp(argv[1], "4") ? 4 : 2;
    const long proposals = argc > 2 ? atol(argv[2]) : 12000000;
    (dims == 2 ? make_functions : make_functions_4d)();
    make_gauss(dims == 2 ? 1.8 : 2.12);
    for (uint32_t m = 0; m < TABLES; m++) {
        double least = HUGE_VAL;
        make_covariances(m, dims);
        for (int start = 0; start < STARTS; start++) {
            const double found = anneal(tried, m, proposals);
            fprintf(stderr, "%u samples: energy %.4f\n", 1u << m, found);
            if (found < least) {
                least = found;
                memcpy(keys[m], tried, sizeof tried);
            }
        }
    }
    printf("/* SPDX-License-Identifier: Apache-2.0 */\n"
           "/* The keys of koksma/keys.h for %s ... 64 samples a pixel. Made by tools/make_keys.c. */\n",
           dims == 2 ? "pairs, for 1, 2, 4" : "quadruples, for 2 and 8");
    for (int m = dims == 2 ? 0 : 1; m < TABLES;
         m += dims == 4 && m == 1 ? 2 : 1) { /* make_keys_tile.c makes 1 and 4 */
        for (int p = 0; p < PIXELS; p++) {
            printf("%s%d", p % 20 ? ", " : p ? ",\n" : "{", keys[m][p]);
        }
        printf(m < TABLES - 1 ? "},\n" : "}\n");
    }
    return 0;
}
