/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Million points a second of each pattern, on one thread, beside the fastest public code of its kind. A bar is the
 * best median that was measured for that program on one core of a server processor with AVX-512 (GCC 12, -O3
 * -march=native, points in memory, no text, whole runs repeated): a reference, not this machine. Each figure here is
 * found likewise: the best of as many medians as there are rounds, which go through the whole table; "least" is the
 * worst of them, and tells how quiet the machine was. Where GSL or scipy has the same points and is installed, the
 * faster one of them is timed in the same rounds, and the last columns say how many times as fast as it we are: that
 * is fair on any machine.
 *
 *     bench-patterns [PART OF A PATTERN'S SPEC]
 */
#include <koksma/koksma.h>
#include <koksma/sampler.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef HAVE_GSL
#include <gsl/gsl_qrng.h>
#endif

typedef struct bar {
    const char *pattern;
    int dim;
    size_t n; /* 0: as many as the pattern has by itself */
    double million_per_s;
    double goal; /* times the bar */
    const char *source;
} bar;

static const bar bars[] = {
    {"random", 2, 1024, 53, 1, "UTK Whitenoise"},
    {"random", 2, 65536, 210, 1, "UTK Whitenoise"},
    {"random", 2, 1048576, 222, 1, "UTK Whitenoise"},
    {"jittered", 2, 1024, 41, 1, "UTK Stratified"},
    {"jittered", 2, 65536, 174, 1, "UTK Stratified"},
    {"jittered", 2, 1048576, 149, 1, "UTK Stratified"},
    {"n-rooks", 2, 1024, 51, 2, "UTK NRooks"},
    {"n-rooks", 2, 65536, 193, 2, "UTK NRooks"},
    {"n-rooks", 2, 1048576, 31, 2, "UTK NRooks"},
    {"hammersley", 2, 1024, 591, 1, "UTK Hammersley"},
    {"hammersley", 2, 65536, 446, 1, "UTK Hammersley"},
    {"hammersley", 2, 1048576, 563, 1, "UTK Hammersley"},
    {"halton", 2, 1024, 138, 2, "UTK Halton"},
    {"halton", 2, 65536, 81, 2, "UTK Halton"},
    {"halton", 2, 1048576, 44, 2, "UTK Halton"},
    {"halton", 4, 1048576, 15.7, 2, "UTK Halton"},
    {"halton:scramble=owen", 2, 1024, 67, 2, "Helmer, stochastic Halton (correlated swaps; nested: 17)"},
    {"halton:scramble=owen", 2, 65536, 66, 2, "Helmer, stochastic Halton (correlated swaps; nested: 15.6)"},
    {"halton:scramble=owen", 2, 1048576, 57, 2, "Helmer, stochastic Halton (correlated swaps; nested: 15.6)"},
    {"halton:scramble=owen", 4, 1048576, 31, 2, "Helmer, stochastic Halton (correlated swaps)"},
    {"halton:scramble=affine", 2, 1024, 67, 2, "Helmer, stochastic Halton (correlated swaps)"},
    {"halton:scramble=affine", 2, 65536, 66, 2, "Helmer, stochastic Halton (correlated swaps)"},
    {"halton:scramble=affine", 2, 1048576, 57, 2, "Helmer, stochastic Halton (correlated swaps)"},
    {"halton:scramble=affine", 4, 1048576, 31, 2, "Helmer, stochastic Halton (correlated swaps)"},
    {"sobol", 2, 65536, 266, 2, "scipy 1.10"},
    {"sobol", 2, 1048576, 192, 2, "GSL 2.7"},
    {"sobol", 4, 65536, 218, 2, "scipy 1.10"},
    {"sobol", 4, 1048576, 239, 2, "GSL 2.7"},
    {"sobol:scramble=owen", 2, 1024, 176, 2, "Helmer, stochastic Sobol'"},
    {"sobol:scramble=owen", 2, 65536, 176, 2, "Helmer, stochastic Sobol'"},
    {"sobol:scramble=owen", 2, 1048576, 149, 2, "Helmer, stochastic Sobol'"},
    {"sobol:scramble=owen", 4, 65536, 94, 2, "Helmer, stochastic Sobol'"},
    {"sobol:scramble=owen", 4, 1048576, 49, 2, "Helmer, stochastic Sobol'"},
    {"sobol:scramble=hash-owen,shuffle=1", 2, 65536, 86, 2, "OpenQMC Sobol', AVX"},
    {"sobol:scramble=hash-owen,shuffle=1", 2, 1048576, 83, 2, "OpenQMC Sobol', AVX"},
    {"sobol:scramble=hash-owen,shuffle=1", 4, 65536, 40, 2, "OpenQMC Sobol', AVX"},
    {"sobol:scramble=hash-owen,shuffle=1", 4, 1048576, 41, 2, "OpenQMC Sobol', AVX"},
    {"pmj02", 2, 1024, 323, 1, "Helmer, stochastic PMJ02"},
    {"pmj02", 2, 65536, 325, 1, "Helmer, stochastic PMJ02"},
    {"pmj02", 2, 1048576, 171, 1, "Helmer, stochastic PMJ02"},
    {"pmj02bn", 2, 4096, 0.32, 1, "Helmer, stochastic PMJ02BN, 100 candidates"},
    {"dart-throwing", 2, 1024, 0.033, 2, "UTK Dart throwing, relaxed (f = 0.675)"},
    {"dart-throwing", 2, 4096, 0.0088, 2, "UTK Dart throwing, relaxed"},
    {"dart-throwing", 2, 16384, 0.0030, 2, "UTK Dart throwing, relaxed"},
    {"poisson-disk-maximal:d=0.0223", 2, 0, 1.1, 2, "BoundarySampler (biased), 1,400 points"},
    {"poisson-disk-maximal:d=0.00276", 2, 0, 1.0, 2, "BoundarySampler (biased), 91,000 points"},
    {"poisson-disk-maximal:d=0.00137", 2, 0, 0.96, 2, "BoundarySampler (biased), 370,000 points"},
    {"poisson-disk-maximal", 2, 1000, 0.2, 1, "the goal for an exact number of points"},
    {"poisson-disk-maximal", 2, 1048576, 0, 1, "-"},
    {"best-candidate", 2, 1024, 0, 1, "-"},
    {"gaussian-blue-noise", 2, 1024, 0, 1, "-"},
    {"sample-elimination", 2, 1024, 0, 1, "-"},
    {"correlated-multi-jittered", 2, 65536, 0, 1, "-"},
    {"r-sequence", 2, 65536, 0, 1, "-"},
    {"zaremba", 2, 65536, 0, 1, "-"},
    {"sobol:scramble=owen", 2, 16, 0, 1, "-"},
    {"random", 2, 16, 0, 1, "-"},
};

/* The time of the processor: of one thread it is the time of a quiet machine. */
static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum { ROUNDS = 3, REPEATS = 9, SLOW_S = 1 };

static double median(double *values)
{
    qsort(values, REPEATS, sizeof *values, compare);
    return values[REPEATS / 2];
}

/* Seconds for one set; sets that take less than a millisecond are made in batches. */
static double time_pattern(const koksma_spec *spec, koksma_points *points, size_t n, int dim)
{
    const koksma_run run = {.threads = 1};
    double values[REPEATS];
    size_t batch = 1;
    for (int r = -1; r < REPEATS; r++) {
        const double start = now_s();
        for (size_t b = 0; b < batch; b++) {
            koksma_status status;
            if (n) {
                status = koksma_generate(spec, (uint64_t)(r + 1) * 1000 + b, &run, points);
            } else {
                koksma_points_fini(points);
                status = koksma_generate_whole(spec, (uint64_t)(r + 1), &run, dim, points);
            }
            if (status) {
                fprintf(stderr, "%s\n", koksma_error_text());
                exit(1);
            }
        }
        const double seconds = (now_s() - start) / (double)batch;
        if (r < 0) {
            batch = seconds < 1e-3 ? (size_t)(1e-3 / seconds) + 1 : 1;
        } else {
            values[r] = seconds;
        }
        if (seconds > 1.5) {
            return seconds;
        }
    }
    return median(values);
}

/* A peer that makes the same points. */
typedef struct peer {
    const char *name;
    double million_per_s; /* 0: none */
} peer;

/* What the rounds found of one row. */
typedef struct result {
    size_t n;
    double best, least; /* million points a second */
    peer here;          /* at its best */
} result;

static void add(double rate, const peer *p, result *r)
{
    r->least = r->best > 0 && r->least < rate ? r->least : rate;
    r->best = r->best < rate ? rate : r->best;
    if (p->million_per_s > r->here.million_per_s) {
        r->here = *p;
    }
}

static void put(const char *what, int dim, const result *r, const bar *b)
{
    char mark[32] = "", against[32] = "-", here[32] = "-", ratio[32] = "";
    if (b->million_per_s > 0) {
        const double times = r->best / b->million_per_s;
        snprintf(against, sizeof against, "%.4g", b->million_per_s);
        snprintf(mark, sizeof mark, "%.2fx%s", times, times < 1 ? " BEHIND" : times < b->goal ? " below goal" : "");
    }
    if (r->here.million_per_s > 0) {
        snprintf(here, sizeof here, "%.4g", r->here.million_per_s);
        snprintf(ratio, sizeof ratio, "%.1fx %s", r->best / r->here.million_per_s, r->here.name);
    }
    printf("%-36s %dD %8zu %10.4g %8.4g %8s  %-16s %8s  %-11s %s\n", what, dim, r->n, r->best, r->least, against,
           mark, here, ratio, b->source);
}

#ifdef HAVE_GSL
static double rate_of_gsl(const gsl_qrng_type *type, int dim, size_t n)
{
    double values[REPEATS], *xs = malloc(n * (size_t)dim * sizeof *xs);
    gsl_qrng *q = gsl_qrng_alloc(type, (unsigned)dim);
    const size_t batch = 1 + 65536 / n;
    for (int r = 0; r < REPEATS && xs && q; r++) {
        const double start = now_s();
        for (size_t i = 0; i < batch; i++) {
            gsl_qrng_init(q);
            for (size_t j = 0; j < n; j++) {
                gsl_qrng_get(q, xs + j * (size_t)dim);
            }
        }
        values[r] = (now_s() - start) / (double)batch;
    }
    const double rate = xs && q ? (double)n / median(values) * 1e-6 : 0;
    gsl_qrng_free(q);
    free(xs);
    return rate;
}
#endif

/* What bench_scipy.py printed; empty without scipy. */
static char scipy_rows[8192];

static void time_scipy(void)
{
    FILE *rows = popen("/usr/bin/python3 " BENCH_DIR "/bench_scipy.py 2>/dev/null", "r");
    if (rows) {
        scipy_rows[fread(scipy_rows, 1, sizeof scipy_rows - 1, rows)] = 0;
        pclose(rows);
    }
}

static double rate_of_scipy(const char *pattern, int dim, size_t n)
{
    char wanted[64];
    double rate = 0;
    snprintf(wanted, sizeof wanted, "%s %d %zu ", pattern, dim, n);
    for (const char *row = scipy_rows; row && *row; row = strchr(row, '\n') ? strchr(row, '\n') + 1 : NULL) {
        if (!strncmp(row, wanted, strlen(wanted))) {
            rate = atof(row + strlen(wanted));
        }
    }
    return rate;
}

/* The faster of GSL and scipy, where one of them has this pattern. */
static peer time_peer(const bar *b)
{
    peer p = {"scipy", rate_of_scipy(b->pattern, b->dim, b->n)};
#ifdef HAVE_GSL
    const gsl_qrng_type *type = !strcmp(b->pattern, "sobol")    ? gsl_qrng_sobol
                                : !strcmp(b->pattern, "halton") ? gsl_qrng_halton
                                                                : NULL;
    const double rate = type ? rate_of_gsl(type, b->dim, b->n) : 0;
    if (rate > p.million_per_s) {
        p = (peer){"GSL", rate};
    }
#endif
    return p;
}

/* Random access by sampler.h: one pixel's domain, many indices. */
static double rate_of_sampler(void)
{
    enum { N = 65536 };
    static double xs[2 * N];
    double values[REPEATS];
    for (int r = 0; r < REPEATS; r++) {
        const double start = now_s();
        const koksma_sobol sequence = koksma_sobol_of(koksma_domain_of_pixel(1, (uint32_t)r, 7));
        for (uint32_t i = 0; i < N; i++) {
            koksma_sobol_at_2d(&sequence, i * 2654435761u, xs + 2 * (size_t)i);
        }
        values[r] = now_s() - start;
    }
    return N / median(values) * 1e-6;
}

static void time_row(const bar *b, result *r)
{
    koksma_spec spec;
    koksma_points points = {0};
    if (koksma_pattern_spec(b->pattern, &spec) || (b->n && koksma_points_init(&points, b->n, b->dim))) {
        fprintf(stderr, "%s\n", koksma_error_text());
        exit(1);
    }
    const double seconds = time_pattern(&spec, &points, b->n, b->dim);
    const peer p = time_peer(b);
    r->n = points.n;
    add((double)points.n / seconds * 1e-6, &p, r);
    koksma_points_fini(&points);
}

static const bar of_sampler = {
    .million_per_s = 86, .goal = 2, .source = "OpenQMC Sobol', AVX (this: random access, plain C, -march=native)"};

int main(int argc, char **argv)
{
    enum { ROWS = sizeof bars / sizeof *bars };
    static result results[ROWS], sampler = {.n = 65536};
    for (int round = 0; round < ROUNDS; round++) {
        fprintf(stderr, "round %d of %d\n", round + 1, ROUNDS);
        time_scipy();
        for (size_t i = 0; i < ROWS; i++) {
            const result *r = &results[i];
            const bool slow = r->best > 0 && (double)r->n > r->best * 1e6 * SLOW_S;
            if (!slow && (argc < 2 || strstr(bars[i].pattern, argv[1]))) {
                time_row(&bars[i], &results[i]);
            }
        }
        add(rate_of_sampler(), &(peer){0}, &sampler);
    }
    printf("%-36s %3s %8s %10s %8s %8s  %-16s %8s  %-11s %s\n", "pattern", "dim", "n", "Mpoints/s", "least", "bar",
           "", "here", "", "bar is");
    for (size_t i = 0; i < ROWS; i++) {
        if (results[i].n) {
            put(bars[i].pattern, bars[i].dim, &results[i], &bars[i]);
        }
    }
    put("sampler.h koksma_sobol_at_2d", 2, &sampler, &of_sampler);
    return 0;
}
