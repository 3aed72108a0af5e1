/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Milliseconds of each measure, on one thread, beside its bar: either the goal that was set for it, or the fastest
 * public code that computes the same, as measured on one core of a server processor with AVX-512 (GCC 12, -O3
 * -march=native). Each figure is the median of several repeats in processor time. Then the digits of l2-star against
 * 128-bit sums.
 */
#include <koksma/koksma.h>
#include <koksma/spectrum.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct bar {
    const char *measure, *pattern;
    size_t n;
    int dim;
    double bar_ms;
    const char *source;
} bar;

static const bar bars[] = {
    {"star", "random", 100, 2, 0.083, "dandy, DEM"},
    {"star", "random", 1000, 2, 2.6, "dandy, DEM"},
    {"star", "random", 10000, 2, 76, "dandy, DEM"},
    {"star", "random", 100000, 2, 500, "goal; dandy 5591"},
    {"star", "hammersley", 100000, 2, 500, "goal; dandy 5591"},
    {"star", "random", 1048576, 2, 5000, "goal"},
    {"star", "random", 50, 3, 0.23, "dandy, DEM"},
    {"star", "random", 200, 3, 3.0, "dandy, DEM"},
    {"star", "random", 500, 3, 18, "dandy, DEM"},
    {"star", "random", 1000, 3, 73, "goal; dandy 73"},
    {"star", "random", 50, 4, 1.36, "dandy, DEM"},
    {"star", "random", 200, 4, 36, "dandy, DEM"},
    {"l2-star", "random", 1000, 2, 0.41, "UTK"},
    {"l2-star", "random", 10000, 2, 5, "goal; UTK 48"},
    {"l2-star", "random", 100000, 2, 60, "goal; UTK 7075, SciPy 16053"},
    {"l2-star", "random", 1000000, 2, 1000, "goal"},
    {"l2-star", "random", 10000, 4, 132, "UTK"},
    {"l2-extreme", "random", 10000, 2, 5, "goal; UTK 79"},
    {"l2-periodic", "random", 10000, 2, 5, "goal"},
    {"l2-wraparound", "random", 10000, 2, 5, "goal; SciPy 196"},
    {"l2-modified", "random", 10000, 2, 5, "goal; UTK 54"},
    {"l2-centered", "random", 10000, 2, 5, "goal; UTK 100"},
    {"l2-mixture", "random", 10000, 2, 5, "goal; SciPy 385"},
    {"l2-symmetric", "random", 10000, 2, 5, "goal"},
    {"extreme", "random", 1024, 2, 3000, "goal; nobody else"},
    {"extreme", "jittered", 1024, 2, 3000, "goal; nobody else"},
    {"extreme", "n-rooks", 1024, 2, 3000, "goal; nobody else"},
    {"extreme", "hammersley", 1024, 2, 3000, "goal; nobody else"},
    {"extreme", "hammersley", 4096, 2, 60000, "goal; nobody else"},
    {"edge", "random", 1600, 2, 500, "goal; nobody else"},
    {"edge", "jittered", 1600, 2, 500, "goal; nobody else"},
    {"l2-edge", "jittered", 1600, 2, 500, "no bar"},
    {"edge-sampled", "jittered", 1600, 2, 20, "goal; UTK 85"},
};

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool make_points(const char *pattern, size_t n, int dim, koksma_points *points)
{
    koksma_spec spec;
    return !koksma_pattern_spec(pattern, &spec) && !koksma_points_init(points, n, dim) &&
           !koksma_generate(&spec, 1, NULL, points);
}

static const koksma_run one_thread = {.threads = 1};

static bool time_bar(const bar *b)
{
    koksma_points points;
    koksma_spec spec;
    koksma_value value;
    double times[9];
    int repeats = 0;
    if (koksma_measure_spec(b->measure, &spec) || !make_points(b->pattern, b->n, b->dim, &points)) {
        fprintf(stderr, "%s\n", koksma_error_text());
        return false;
    }
    while (repeats < 9 && (repeats < 1 || times[0] * repeats < 3000)) {
        const double start = now_ms();
        if (koksma_evaluate(&spec, &points, &one_thread, &value)) {
            fprintf(stderr, "%s\n", koksma_error_text());
            return false;
        }
        times[repeats++] = now_ms() - start;
    }
    qsort(times, (size_t)repeats, sizeof *times, compare);
    const double median = times[repeats / 2];
    printf("%-14s %-11s %8zu %2d %12.3f %10.3f %7.1f  %s\n", b->measure, b->pattern, b->n, b->dim, median, b->bar_ms,
           b->bar_ms / median, b->source);
    fflush(stdout);
    koksma_points_fini(&points);
    return true;
}

static void time_curves(void)
{
    koksma_points points;
    double values[200], times[3][5];
    if (!make_points("random", 4096, 2, &points)) {
        return;
    }
    for (int i = 0; i < 5; i++) {
        for (int method = 0; method < 3; method++) {
            koksma_spectrum spectrum;
            koksma_spectrum_init(&spectrum, 319);
            const double start = now_ms();
            if (method < 2) {
                koksma_spectrum_add(&spectrum, &points, (koksma_spectrum_method)method, &one_thread);
            } else {
                koksma_pair_correlation(&points, 0.1, 200, NULL, values);
            }
            times[method][i] = now_ms() - start;
            koksma_spectrum_fini(&spectrum);
        }
    }
    static const char *const names[] = {"power, exact", "power, fast", "pairs"};
    static const char *const sources[] = {"goal, 639 x 639; UTK 49607", "goal, 639 x 639; UTK (wrong) 35",
                                          "goal, 200 bins to 0.1; UTK 46900"};
    static const double goals[] = {250, 35, 20};
    for (int method = 0; method < 3; method++) {
        qsort(times[method], 5, sizeof(double), compare);
        printf("%-14s %-11s %8d %2d %12.3f %10.3f %7.1f  %s\n", names[method], "random", 4096, 2, times[method][2],
               goals[method], goals[method] / times[method][2], sources[method]);
    }
    koksma_points_fini(&points);
}

__extension__ typedef __float128 quad;

/* Warnock's formula in 128 bits by Fenwick trees over the ranks of y; points have i-th x i-th in order. */
static double quad_star(const koksma_points *p)
{
    const size_t n = p->n;
    quad *sums = calloc(n + 1, sizeof *sums), linear = 0, pairs = 0, total = 0;
    double *ys = malloc(n * sizeof *ys), *counts = calloc(n + 1, sizeof *counts);
    for (size_t i = 0; i < n && ys; i++) {
        ys[i] = p->xs[2 * i + 1];
    }
    qsort(ys, n, sizeof *ys, compare);
    for (size_t i = 0; i < n; i++) {
        const double x = p->xs[2 * i], y = p->xs[2 * i + 1];
        size_t low = 0, high = n;
        while (low < high) {
            const size_t middle = (low + high) / 2;
            if (ys[middle] < y) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        quad below = 0, count = 0;
        for (size_t k = low + 1; k > 0; k &= k - 1) {
            below += sums[k];
            count += (quad)counts[k];
        }
        const quad cx = 1 - (quad)x, cy = 1 - (quad)y;
        pairs += cx * (2 * (count * cy + total - below) + cy);
        linear += (1 - (quad)x * x) * (1 - (quad)y * y);
        total += cy;
        for (size_t k = low + 1; k <= n; k += k & -k) {
            sums[k] += cy;
            counts[k] += 1;
        }
    }
    free(sums);
    free(ys);
    free(counts);
    return sqrt((double)((quad)1 / 9 - linear / (2 * (quad)n) + pairs / ((quad)n * (quad)n)));
}

static void check_digits(const char *pattern, size_t n)
{
    koksma_points points;
    koksma_spec spec;
    koksma_value value;
    if (koksma_measure_spec("l2-star", &spec) || !make_points(pattern, n, 2, &points)) {
        return;
    }
    for (size_t i = 1; i < n; i++) {
        if (points.xs[2 * i] < points.xs[2 * i - 2]) {
            return;
        }
    }
    koksma_evaluate(&spec, &points, NULL, &value);
    const double exact = quad_star(&points);
    printf("l2-star of %s %zu: %.17g, in 128 bits %.17g, relative error %.1e (goal 1e-9)\n", pattern, n, value.value,
           exact, fabs(value.value / exact - 1));
    koksma_points_fini(&points);
}

int main(int argc, char **argv)
{
    printf("%-14s %-11s %8s %2s %12s %10s %7s  %s\n", "measure", "pattern", "n", "d", "ms", "bar, ms", "ratio",
           "bar");
    for (size_t i = 0; i < sizeof bars / sizeof *bars; i++) {
        if ((argc < 2 || !strcmp(argv[1], bars[i].measure)) && !time_bar(&bars[i])) {
            return 4;
        }
    }
    if (argc < 2) {
        time_curves();
        check_digits("hammersley", 65536);
        check_digits("hammersley", 1000000);
        check_digits("regular", 1000000);
    }
    return 0;
}
