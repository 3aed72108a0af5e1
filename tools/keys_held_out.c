/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Prints the tables of docs/findings/screen-noise.md: errors of koksma/keys.h and of z-sampler on integrands that took no
 * part in the design of the keys, in units of those of independently scrambled pixels. A program of its own:
 *
 *     cc -O3 -ffast-math -march=native -std=gnu11 -Iinclude tools/keys_held_out.c -lm -o /tmp/keys_held_out
 *     /tmp/keys_held_out plain|blue|prefix [samples a pixel ...]
 *
 * Seven families of DRAWS integrands on the unit square, drawn once: Heaviside steps of random direction through a random
 * point (Heitz & others 2019) and the six families of Genz (1984) with random u and with a scaled to his difficulties in
 * two dimensions. Integrals are exact (closed forms; for steps the area of the clipped square). Each seed gives an image
 * of 64 x 64 pixels, and a mean square of its errors for each integrand. All intervals come from the spread of these
 * from image to image, because the pixels of one image depend on each other. `prefix` is `blue` with the keys for 64
 * samples a pixel.
 */
#include <koksma/keys.h>

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 64, PIXELS = SIZE * SIZE, DRAWS = 16, FAMILIES = 7, ALL = FAMILIES * DRAWS, KINDS = 3, MOST = 128 };
enum { KEYS, Z_SAMPLER, INDEPENDENT };
enum { STEP, OSCILLATORY, PRODUCT_PEAK, CORNER_PEAK, GAUSSIAN, CONTINUOUS, DISCONTINUOUS };

static const double difficulty[FAMILIES] = {0, 9, 7.25, 1.85, 7.03, 20.4, 4.3};
static const double pi = 3.141592653589793;

typedef struct integrand {
    int family;
    double a[2], u[2], mean;
} integrand;

static integrand all[ALL];

/* Adds the values at n points, s to a pixel, to the sums of the pixels. One loop a family, for compilers that vectorise. */
static void add_values(const integrand *f, int n, int s, const double *xs, const double *ys, double *sums)
{
    static double values[PIXELS * MOST];
    const double u = f->u[0], v = f->u[1], a = f->a[0], b = f->a[1];
    switch (f->family) {
#define EACH(expression)                                                                                             \
    for (int i = 0; i < n; i++) {                                                                                    \
        const double x = xs[i], y = ys[i], dx = x - u, dy = y - v;                                                   \
        (void)x, (void)y, (void)dx, (void)dy;                                                                        \
        values[i] = (expression);                                                                                    \
    }                                                                                                                \
    break
    case STEP:
        EACH(a * dx + b * dy < 0 ? 1.0 : 0.0);
    case OSCILLATORY:
        EACH(cos(2 * pi * u + a * x + b * y));
    case PRODUCT_PEAK:
        EACH(1 / ((1 / (a * a) + dx * dx) * (1 / (b * b) + dy * dy)));
    case CORNER_PEAK:
        EACH(1 / ((1 + a * x + b * y) * (1 + a * x + b * y) * (1 + a * x + b * y)));
    case GAUSSIAN:
        EACH(exp(-a * a * dx * dx - b * b * dy * dy));
    case CONTINUOUS:
        EACH(exp(-a * fabs(dx) - b * fabs(dy)));
    default:
        EACH(dx > 0 || dy > 0 ? 0 : exp(a * x + b * y));
    }
#undef EACH
    for (int i = 0; i < n; i++) {
        sums[i / s] += values[i];
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
static uint32_t planned; /* the number of samples that the keys are for, if it is above the number drawn */

static void make_errors(int kind, uint64_t seed, uint32_t spp)
{
    static double xs[PIXELS * MOST], ys[PIXELS * MOST];
    for (uint32_t p = 0; p < PIXELS; p++) {
        const uint32_t x = p % SIZE, y = p / SIZE;
        const koksma_keys keys = koksma_keys_of(seed, x, y, 0, planned > spp ? planned : spp);
        const koksma_domain image = {seed};
        const koksma_domain domain = kind == Z_SAMPLER ? image : koksma_domain_of_pixel(seed, x, y);
        const uint32_t first = kind == Z_SAMPLER ? koksma_z_rank(image, x, y, 6) * spp : 0;
        for (uint32_t s = 0; s < spp; s++) {
            double xy[2];
            if (kind == KEYS) {
                koksma_keys_2d(&keys, s, xy);
            } else {
                koksma_sobol_2d(domain, first + s, xy);
            }
            xs[p * spp + s] = xy[0];
            ys[p * spp + s] = xy[1];
        }
    }
    memset(errors, 0, sizeof errors);
    for (int i = 0; i < ALL; i++) {
        add_values(&all[i], (int)(PIXELS * spp), (int)spp, xs, ys, errors[i]);
        for (int p = 0; p < PIXELS; p++) {
            errors[i][p] = errors[i][p] / spp - all[i].mean;
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

/* ---- Plain errors ------------------------------------------------------------------------------------------ */

enum { IMAGES = 64 };

static double squares[KINDS][IMAGES][ALL]; /* the mean square of an image */

/* The mean over integrands first .. end - 1 of the ratios of mean squares to those of independent pixels, and its
   standard error. Integrands of one image share its points, so the images are the independent units. */
static double ratio_of(int kind, int first, int end, double *error)
{
    double ratio = 0, variance = 0, deviation[KINDS][IMAGES] = {{0}};
    for (int i = first; i < end; i++) {
        double mean[KINDS] = {0};
        for (int k = kind; k < KINDS; k += INDEPENDENT - kind) {
            for (int t = 0; t < IMAGES; t++) {
                mean[k] += squares[k][t][i] / IMAGES;
            }
        }
        const double one = mean[kind] / mean[INDEPENDENT];
        ratio += one / (end - first);
        for (int k = kind; k < KINDS; k += INDEPENDENT - kind) {
            for (int t = 0; t < IMAGES; t++) {
                deviation[k][t] += one * (squares[k][t][i] / mean[k] - 1) / (end - first);
            }
        }
    }
    for (int k = kind; k < KINDS; k += INDEPENDENT - kind) {
        for (int t = 0; t < IMAGES; t++) {
            variance += deviation[k][t] * deviation[k][t] / IMAGES / (IMAGES - 1);
        }
    }
    *error = sqrt(variance);
    return ratio;
}

/* The standard deviation of an image's root mean square error, in units of its mean: mean over the integrands. */
static double spread_of(int kind)
{
    double sum = 0;
    for (int i = 0; i < ALL; i++) {
        double mean = 0, square = 0;
        for (int t = 0; t < IMAGES; t++) {
            mean += sqrt(squares[kind][t][i]) / IMAGES;
            square += squares[kind][t][i] / IMAGES;
        }
        sum += sqrt(fmax(square / (mean * mean) - 1, 0)) / ALL;
    }
    return sum;
}

/* Prints ratios of RMS errors, with a star where one is above 1 by two standard errors. */
static void print_ratio(int kind, int first, int end)
{
    double error;
    const double ratio = ratio_of(kind, first, end, &error);
    printf(" %.3f ± %.3f%s |", sqrt(ratio), error / (2 * sqrt(ratio)), ratio > 1 + 2 * error ? " *" : "");
}

static void print_row(uint32_t spp, int kind)
{
    double largest = 0;
    int above = 0, below = 0, far = 0;
    printf("| %u | %s |", spp, kind == KEYS ? "`ranking-keys`" : "`z-sampler`");
    for (int f = 0; f < FAMILIES; f++) {
        print_ratio(kind, f * DRAWS, (f + 1) * DRAWS);
    }
    print_ratio(kind, 0, ALL);
    for (int i = 0; i < ALL; i++) {
        double error;
        const double ratio = ratio_of(kind, i, i + 1, &error);
        above += ratio > 1 + 2 * error;
        below += ratio < 1 - 2 * error;
        far += ratio > 1 + 3 * error;
        largest = fmax(largest, ratio);
    }
    printf(" %.2f; %d, %d; %d | %.3f (independent %.3f) |\n", sqrt(largest), above, below, far, spread_of(kind),
           spread_of(INDEPENDENT));
}

static void plain(uint32_t spp)
{
    for (int kind = 0; kind < KINDS; kind++) {
        for (int t = 0; t < IMAGES; t++) {
            make_errors(kind, 100 + (uint64_t)t, spp);
            for (int i = 0; i < ALL; i++) {
                squares[kind][t][i] = mean_square(errors[i]);
            }
        }
    }
    for (int kind = 0; kind < INDEPENDENT; kind++) {
        print_row(spp, kind);
    }
}

/* ---- Spectra ----------------------------------------------------------------------------------------------- */

/* The mean power at frequencies |k| < SIZE / 4 with k = 0, and at those above, and the mean square after a blur by a
   Gaussian of standard deviation 1.5 pixels. */
static void power(const double *e, double out[3])
{
    static double complex table[SIZE], rows[SIZE][SIZE];
    double sums[2] = {0, 0}, count[2] = {0, 0};
    out[2] = 0;
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
            const double square = creal(sum * conj(sum)) / PIXELS;
            sums[part] += square;
            count[part] += 1;
            out[2] += square / PIXELS * exp(-4 * pi * pi * 1.5 * 1.5 * (u * u + v * v) / PIXELS);
        }
    }
    out[0] = sums[0] / count[0];
    out[1] = sums[1] / count[1];
}

/* The share of white noise that the blur lets pass. */
static double passed(void)
{
    static double delta[PIXELS];
    double out[3];
    delta[0] = 1;
    power(delta, out);
    return out[2] * PIXELS;
}

/* Mean power of a family below and above a quarter of the sampling rate in units of the mean square error of
   independent pixels, whose spectrum is flat; and the RMS error after the blur in units of theirs. */
static void blue(uint32_t spp)
{
    enum { EVERY = 4, SOME = 16 };
    static double square[ALL];
    const double white = passed();
    memset(square, 0, sizeof square);
    for (int kind = INDEPENDENT; kind >= 0; kind--) {
        double sums[FAMILIES][3] = {{0}}, all_low = 0, all_blurred = 0, largest = 0, lows[ALL] = {0};
        for (int t = 0; t < SOME; t++) {
            make_errors(kind, 100 + (uint64_t)t, spp);
            for (int i = 0; i < ALL; i++) {
                double out[3];
                if (kind == INDEPENDENT) {
                    square[i] += mean_square(errors[i]) / SOME;
                } else if (i % EVERY == 0) {
                    power(errors[i], out);
                    for (int c = 0; c < 3; c++) {
                        sums[i / DRAWS][c] += out[c] / square[i] * EVERY / DRAWS / SOME;
                    }
                    lows[i] += out[0] / square[i] / SOME;
                    all_low += out[0] / square[i] * EVERY / ALL / SOME;
                    all_blurred += out[2] / square[i] / white * EVERY / ALL / SOME;
                }
            }
        }
        for (int i = 0; i < ALL; i++) {
            largest = fmax(largest, lows[i]);
        }
        if (kind != INDEPENDENT) {
            printf("| %u | %s |", spp, kind == KEYS ? "`ranking-keys`" : "`z-sampler`");
            for (int f = 0; f < FAMILIES; f++) {
                printf(" %.2f, %.2f, %.2f |", sums[f][0], sums[f][1], sqrt(sums[f][2] / white));
            }
            printf(" %.3f, %.3f; %.2f |\n", all_low, sqrt(all_blurred), largest);
        }
    }
}

int main(int argc, char **argv)
{
    static const char *const usual[] = {"1",  "2",  "3",  "4",  "5",  "6",  "7",  "8",  "9",
                                        "12", "16", "20", "24", "32", "48", "64", "100"};
    const int named = argc > 2, n = named ? argc - 2 : (int)(sizeof usual / sizeof *usual);
    make_integrands();
    for (int i = 0; i < n; i++) {
        const int spp = atoi(named ? argv[2 + i] : usual[i]);
        if (argc < 2 || spp < 1 || spp > MOST) {
            fprintf(stderr, "usage: keys_held_out plain|blue|prefix [samples a pixel, 1 to %d ...]\n", MOST);
            return 2;
        }
        planned = strcmp(argv[1], "prefix") ? 0 : 64;
        (strcmp(argv[1], "plain") ? blue : plain)((uint32_t)spp);
        fflush(stdout);
    }
    return 0;
}
