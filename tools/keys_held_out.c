/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Prints the tables of docs/findings/ranking-keys.md: errors of koksma/keys.h and of z-sampler on integrands that took no
 * part in the design of the keys, in units of those of independently scrambled pixels. A program of its own:
 *
 *     cc -O3 -std=gnu11 -Iinclude tools/keys_held_out.c -lm -o /tmp/keys_held_out && /tmp/keys_held_out [plain|spectrum]
 *
 * Seven families of DRAWS integrands on the unit square, drawn once: Heaviside steps of random direction through a random
 * point (Heitz & others 2019) and the six families of Genz (1984) with random u and with a scaled to his difficulties in
 * two dimensions. Integrals are exact (closed forms; for steps the area of the clipped square). Each of TILES seeds gives
 * an image of 64 x 64 pixels; the mean square over tiles has a standard error from the tiles' spread.
 */
#include <koksma/keys.h>

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIZE = 64, PIXELS = SIZE * SIZE, DRAWS = 16, FAMILIES = 7, ALL = FAMILIES * DRAWS, TILES = 8, KINDS = 3 };
enum { KEYS, Z_SAMPLER, INDEPENDENT };
enum { STEP, OSCILLATORY, PRODUCT_PEAK, CORNER_PEAK, GAUSSIAN, CONTINUOUS, DISCONTINUOUS };

static const char *const names[FAMILIES] = {
    "step",          "genz-oscillatory", "genz-product-peak", "genz-corner-peak",
    "genz-gaussian", "genz-continuous",  "genz-discontinuous"};
static const double difficulty[FAMILIES] = {0, 9, 7.25, 1.85, 7.03, 20.4, 4.3};
static const double pi = 3.141592653589793;

typedef struct integrand {
    int family;
    double a[2], u[2], mean;
} integrand;

static integrand all[ALL];

static double value(const integrand *f, double x, double y)
{
    const double dx = x - f->u[0], dy = y - f->u[1], a = f->a[0], b = f->a[1];
    switch (f->family) {
    case STEP:
        return a * dx + b * dy < 0;
    case OSCILLATORY:
        return cos(2 * pi * f->u[0] + a * x + b * y);
    case PRODUCT_PEAK:
        return 1 / ((1 / (a * a) + dx * dx) * (1 / (b * b) + dy * dy));
    case CORNER_PEAK:
        return pow(1 + a * x + b * y, -3);
    case GAUSSIAN:
        return exp(-a * a * dx * dx - b * b * dy * dy);
    case CONTINUOUS:
        return exp(-a * fabs(dx) - b * fabs(dy));
    default:
        return dx > 0 || dy > 0 ? 0 : exp(a * x + b * y);
    }
}

/* The area of the part of the unit square where a (x - u) + b (y - v) < 0: the square clipped, and its shoelace formula. */
static double clipped_area(const integrand *f)
{
    static const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double out[8][2], area = 0;
    int n = 0;
    for (int i = 0; i < 4; i++) {
        const double *p = corners[i], *q = corners[(i + 1) % 4];
        const double s = f->a[0] * (p[0] - f->u[0]) + f->a[1] * (p[1] - f->u[1]);
        const double t = f->a[0] * (q[0] - f->u[0]) + f->a[1] * (q[1] - f->u[1]);
        if (s < 0) {
            memcpy(out[n++], p, sizeof out[0]);
        }
        if ((s < 0) != (t < 0)) {
            out[n][0] = p[0] + (q[0] - p[0]) * s / (s - t);
            out[n++][1] = p[1] + (q[1] - p[1]) * s / (s - t);
        }
    }
    for (int i = 0; i < n; i++) {
        const double *p = out[i], *q = out[(i + 1) % n];
        area += (p[0] * q[1] - q[0] * p[1]) / 2;
    }
    return area;
}

/* The integral over one coordinate of the factor of a product. */
static double factor(int family, double a, double u)
{
    switch (family) {
    case PRODUCT_PEAK:
        return a * (atan(a * (1 - u)) + atan(a * u));
    case GAUSSIAN:
        return sqrt(pi) / (2 * a) * (erf(a * (1 - u)) + erf(a * u));
    case CONTINUOUS:
        return (2 - exp(-a * u) - exp(-a * (1 - u))) / a;
    default:
        return (exp(a * u) - 1) / a;
    }
}

static double mean_of(const integrand *f)
{
    const double a = f->a[0], b = f->a[1];
    switch (f->family) {
    case STEP:
        return clipped_area(f);
    case OSCILLATORY:
        return creal(cexp(2 * pi * I * f->u[0]) * (cexp(I * a) - 1) / (I * a) * (cexp(I * b) - 1) / (I * b));
    case CORNER_PEAK:
        return (1 - 1 / (1 + a) - 1 / (1 + b) + 1 / (1 + a + b)) / (2 * a * b);
    default:
        return factor(f->family, a, f->u[0]) * factor(f->family, b, f->u[1]);
    }
}

static void make_integrands(void)
{
    const koksma_domain fresh = {0x20261123};
    for (int i = 0; i < ALL; i++) {
        integrand *f = &all[i];
        double x[4];
        for (int c = 0; c < 4; c++) {
            uint32_t w[4];
            koksma_words(fresh.key, KOKSMA_FOR_POINT, (uint64_t)i, (uint32_t)c, w);
            x[c] = (w[0] + 0.5) / 4294967296.0;
        }
        f->family = i / DRAWS;
        f->u[0] = x[0];
        f->u[1] = x[1];
        f->a[0] = f->family ? difficulty[f->family] * x[2] / (x[2] + x[3]) : cos(2 * pi * x[2]);
        f->a[1] = f->family ? difficulty[f->family] * x[3] / (x[2] + x[3]) : sin(2 * pi * x[2]);
        f->mean = mean_of(f);
    }
}

static double errors[ALL][PIXELS];

static void make_errors(int kind, uint64_t seed, uint32_t spp, uint32_t pair)
{
    for (uint32_t p = 0; p < PIXELS; p++) {
        const uint32_t x = p % SIZE, y = p / SIZE;
        const koksma_keys keys = koksma_keys_of(seed, x, y, pair, spp);
        const koksma_domain image = {seed};
        const koksma_domain domain = kind == Z_SAMPLER ? image : koksma_domain_of_pixel(seed, x, y);
        const uint32_t first = kind == Z_SAMPLER ? koksma_z_rank(image, x, y, 6) * spp : 0;
        for (int i = 0; i < ALL; i++) {
            errors[i][p] = -all[i].mean;
        }
        for (uint32_t s = 0; s < spp; s++) {
            double xy[2];
            if (kind == KEYS) {
                koksma_keys_2d(&keys, s, xy);
            } else {
                koksma_sobol_2d(domain, first + s, xy);
            }
            for (int i = 0; i < ALL; i++) {
                errors[i][p] += value(&all[i], xy[0], xy[1]) / spp;
            }
        }
    }
}

static double mean_square(const double *e)
{
    double sum = 0;
    for (int p = 0; p < PIXELS; p++) {
        sum += e[p] * e[p] / PIXELS;
    }
    return sum;
}

/* Prints a mean of ratios as a ratio of RMS errors, with a star where it is above 1 by two standard errors. */
static void print_ratio(double ratio, double variance)
{
    printf(" %.3f ± %.3f%s |", sqrt(ratio), sqrt(variance) / (2 * sqrt(ratio)),
           ratio > 1 + 2 * sqrt(variance) ? " *" : "");
}

static void print_row(uint32_t spp, int kind, double sums[KINDS][ALL], double squares[KINDS][ALL])
{
    double worst = 0, total = 0, total_variance = 0;
    int at = 0, above = 0;
    printf("| %u | %s |", spp, kind == KEYS ? "`ranking-keys`" : "`z-sampler`");
    for (int f = 0; f < FAMILIES; f++) {
        double ratio = 0, variance = 0;
        for (int i = f * DRAWS; i < (f + 1) * DRAWS; i++) {
            const double one = sums[kind][i] / sums[INDEPENDENT][i];
            double own = 0;
            for (int k = kind; k < KINDS; k += INDEPENDENT - kind) {
                const double relative = squares[k][i] / (sums[k][i] * sums[k][i]) - 1;
                own += one * one * fmax(relative, 0) / (TILES - 1);
            }
            ratio += one / DRAWS;
            variance += own / DRAWS / DRAWS;
            above += one > 1 + 2 * sqrt(own);
            if (one > worst) {
                worst = one;
                at = i;
            }
        }
        print_ratio(ratio, variance);
        total += ratio / FAMILIES;
        total_variance += variance / FAMILIES / FAMILIES;
    }
    print_ratio(total, total_variance);
    printf(" %.2f (%s), %d of %d |\n", sqrt(worst), names[at / DRAWS], above, ALL);
}

/* Sums: the mean over tiles of the mean squares; squares: that of their squares. */
static void plain(const uint32_t *spps, int n)
{
    static double sums[KINDS][ALL], squares[KINDS][ALL];
    printf("| samples | pattern |");
    for (int f = 0; f < FAMILIES; f++) {
        printf(" %s |", names[f]);
    }
    printf(" all | worst one, and how many are worse |\n");
    for (int t = 0; t < n; t++) {
        memset(sums, 0, sizeof sums);
        memset(squares, 0, sizeof squares);
        for (int kind = 0; kind < KINDS; kind++) {
            for (uint64_t tile = 0; tile < TILES; tile++) {
                make_errors(kind, 100 + tile, spps[t], 0);
                for (int i = 0; i < ALL; i++) {
                    const double square = mean_square(errors[i]);
                    sums[kind][i] += square / TILES;
                    squares[kind][i] += square * square / TILES;
                }
            }
        }
        for (int kind = 0; kind < INDEPENDENT; kind++) {
            print_row(spps[t], kind, sums, squares);
        }
        fflush(stdout);
    }
}

/* ---- Spectra ----------------------------------------------------------------------------------------------- */

/* The power at |k| < SIZE / 4, and at the frequencies above, with k = 0 in the first. */
static void power(const double *e, double *low, double *high)
{
    static double complex table[SIZE], rows[SIZE][SIZE];
    double sums[2] = {0, 0}, count[2] = {0, 0};
    for (int k = 0; k < SIZE; k++) {
        table[k] = cexp(-2 * pi * I * k / SIZE);
    }
    for (int y = 0; y < SIZE; y++) {
        for (int k = 0; k < SIZE; k++) {
            rows[y][k] = 0;
            for (int x = 0; x < SIZE; x++) {
                rows[y][k] += e[y * SIZE + x] * table[k * x % SIZE];
            }
        }
    }
    for (int k = 0; k < SIZE; k++) {
        for (int l = 0; l < SIZE; l++) {
            const int u = k < SIZE / 2 ? k : k - SIZE, v = l < SIZE / 2 ? l : l - SIZE;
            const int part = 16 * (u * u + v * v) >= SIZE * SIZE;
            double complex sum = 0;
            for (int y = 0; y < SIZE; y++) {
                sum += rows[y][k] * table[l * y % SIZE];
            }
            sums[part] += creal(sum * conj(sum)) / PIXELS;
            count[part] += 1;
        }
    }
    *low = sums[0] / count[0];
    *high = sums[1] / count[1];
}

/* Mean power of a family below and above a quarter of the sampling rate, in units of the mean square error of independent
   pixels, whose spectrum is flat. */
static void spectrum(const uint32_t *spps, int n)
{
    enum { EVERY = 4, SOME = 3 };
    static double square[ALL], low[KINDS][FAMILIES], high[KINDS][FAMILIES];
    for (int t = 0; t < n; t++) {
        memset(low, 0, sizeof low);
        memset(high, 0, sizeof high);
        memset(square, 0, sizeof square);
        for (int kind = INDEPENDENT; kind >= 0; kind--) {
            for (uint64_t tile = 0; tile < SOME; tile++) {
                make_errors(kind, 100 + tile, spps[t], 0);
                for (int i = 0; i < ALL && kind == INDEPENDENT; i++) {
                    square[i] += mean_square(errors[i]) / SOME;
                }
                for (int i = 0; i < ALL && kind != INDEPENDENT; i += EVERY) {
                    double below, above;
                    power(errors[i], &below, &above);
                    low[kind][i / DRAWS] += below / square[i] * EVERY / DRAWS / SOME;
                    high[kind][i / DRAWS] += above / square[i] * EVERY / DRAWS / SOME;
                }
            }
        }
        for (int kind = 0; kind < INDEPENDENT; kind++) {
            printf("| %u | %s |", spps[t], kind == KEYS ? "`ranking-keys`" : "`z-sampler`");
            for (int f = 0; f < FAMILIES; f++) {
                printf(" %.2f, %.2f |", low[kind][f], high[kind][f]);
            }
            printf("\n");
        }
        fflush(stdout);
    }
}

int main(int argc, char **argv)
{
    static const uint32_t plains[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48, 64, 100};
    static const uint32_t spectra[] = {1, 2, 3, 4, 6, 8, 12, 16, 32, 64};
    make_integrands();
    if (argc < 2 || !strcmp(argv[1], "plain")) {
        plain(plains, sizeof plains / sizeof *plains);
    }
    if (argc < 2 || !strcmp(argv[1], "spectrum")) {
        spectrum(spectra, sizeof spectra / sizeof *spectra);
    }
    return 0;
}
