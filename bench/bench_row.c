/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The time of one row of bench/speed.py, which compiles this against the library, against an older one, and with peers:
 * seconds, the median, least and largest of some repeats in this process after one that does not count; then the value
 * of what computes one. Processor time; by the clock where THREADS ends in c: 1c, 2c.
 *
 *     bench-row THREADS generate SPEC N DIM
 *     bench-row THREADS measure SPEC PATTERN N DIM
 *     bench-row THREADS exact|fast PATTERN N HALF      the power spectrum of (2 HALF + 1)^2 frequencies
 *     bench-row THREADS pairs PATTERN N                the pair correlation, 200 bins up to 0.1
 *     bench-row THREADS read|write FILE                points as text; write first reads FILE and writes FILE.out
 *     bench-row THREADS scene FILE                     opens it; of -DWITH_LAB
 *     bench-row THREADS stores|fma                     16 MiB of streaming stores; 2^26 vectors multiplied and added
 *     bench-row THREADS dandy PATTERN N DIM            star discrepancy by dandy's DEM; of -DWITH_DANDY
 *     bench-row THREADS gsl NAME N DIM                 sobol or halton points by GSL; of -DWITH_GSL
 *     bench-row THREADS helmer NAME N DIM              owen or pmj02 points by Helmer's program; of -DWITH_HELMER
 *     bench-row THREADS memory PROGRAM ARGUMENT...     not a time: MiB that it held at most, without standard output
 */
#include <koksma/koksma.h>
#include <koksma/spectrum.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#ifdef WITH_LAB
#include <koksma/render.h>
#endif
#ifdef WITH_GSL
#include <gsl/gsl_qrng.h>
#endif
#ifdef WITH_DANDY
double oydiscr(double **pointset, int dim, int npoints, double *lower);
#endif
#ifdef WITH_HELMER
void helmer_points(const char *name, int n, int dim, double *xs);
#endif
#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum { MOST = 15 };
static const double ENOUGH_S = 0.3;

typedef struct job {
    const char *texts[2]; /* the arguments that are words */
    size_t n;
    int dim;
    koksma_run run;
    koksma_points points;
    double value;
} job;

static void check(koksma_status status)
{
    if (status) {
        fprintf(stderr, "bench-row: %s\n", koksma_error_text());
        exit(2);
    }
}

static void make(const char *pattern, job *j)
{
    koksma_spec spec;
    check(koksma_pattern_spec(pattern, &spec));
    if (!j->points.xs) {
        check(koksma_points_init(&j->points, j->n, j->dim));
    }
    check(koksma_generate(&spec, 1, &j->run, &j->points));
}

static void generate(job *j)
{
    make(j->texts[0], j);
}

static void points_first(job *j)
{
    make(j->texts[1] ? j->texts[1] : j->texts[0], j);
}

static void measure(job *j)
{
    koksma_spec spec;
    koksma_value value;
    check(koksma_measure_spec(j->texts[0], &spec));
    check(koksma_evaluate(&spec, &j->points, &j->run, &value));
    j->value = value.value;
}

static void plane_first(job *j)
{
    const int half = j->dim;
    j->dim = 2;
    points_first(j);
    j->dim = half;
}

static void add_spectrum(job *j, koksma_spectrum_method method)
{
    koksma_spectrum spectrum;
    check(koksma_spectrum_init(&spectrum, j->dim));
    check(koksma_spectrum_add(&spectrum, &j->points, method, &j->run));
    koksma_spectrum_fini(&spectrum);
}

static void exact(job *j)
{
    add_spectrum(j, KOKSMA_SPECTRUM_EXACT);
}

static void fast(job *j)
{
    add_spectrum(j, KOKSMA_SPECTRUM_FAST);
}

static void pairs(job *j)
{
    double values[200];
    check(koksma_pair_correlation(&j->points, 0.1, 200, &j->run, values));
}

static void read_points(job *j)
{
    koksma_points_fini(&j->points);
    check(koksma_points_read(j->texts[0], &j->points));
}

static void write_points(job *j)
{
    char path[4096];
    snprintf(path, sizeof path, "%s.out", j->texts[0]);
    check(koksma_points_write(path, &j->points, NULL, &j->run));
}

static void store(job *j)
{
    static _Alignas(64) char block[1 << 24];
    (void)j;
#ifdef __SSE2__
    for (size_t i = 0; i < sizeof block; i += 16) {
        _mm_stream_si128((__m128i *)(void *)(block + i), _mm_set1_epi8(1));
    }
    _mm_sfence();
#else
    memset(block, 1, sizeof block);
#endif
    __asm__ volatile("" : : "r"(block) : "memory");
}

/* Eight chains, so that the sums do not wait for each other; speed.py compiles with contraction to fused operations. */
static void multiply_and_add(job *j)
{
#if defined __AVX512F__
    typedef double lanes __attribute__((vector_size(64)));
#elif defined __AVX__
    typedef double lanes __attribute__((vector_size(32)));
#else
    typedef double lanes __attribute__((vector_size(16)));
#endif
    const lanes zero = {0}, factor = zero + 0.5, more = zero + 1;
    lanes a = zero, b = zero, c = zero, d = zero, e = zero, f = zero, g = zero, h = zero;
    for (int i = 0; i < 1 << 23; i++) {
        a = a * factor + more, b = b * factor + more, c = c * factor + more, d = d * factor + more;
        e = e * factor + more, f = f * factor + more, g = g * factor + more, h = h * factor + more;
    }
    a += b + c + d + e + f + g + h;
    j->value = a[0] + (double)sizeof(lanes) / 8 * 1000; /* lanes a vector times 1000 */
}

#ifdef WITH_LAB
static void open_scene(job *j)
{
    koksma_scene *scene;
    check(koksma_scene_open(j->texts[0], &scene));
    koksma_scene_close(scene);
}
#endif

#ifdef WITH_DANDY
static void dandy(job *j)
{
    double lower, **rows = malloc(j->n * sizeof *rows), *copy = malloc(j->n * (size_t)j->dim * sizeof *copy);
    memcpy(copy, j->points.xs, j->n * (size_t)j->dim * sizeof *copy); /* it sorts them */
    for (size_t i = 0; i < j->n; i++) {
        rows[i] = copy + i * (size_t)j->dim;
    }
    j->value = oydiscr(rows, j->dim, (int)j->n, &lower);
    free(rows);
    free(copy);
}
#endif

#ifdef WITH_GSL
static void gsl(job *j)
{
    gsl_qrng *q = gsl_qrng_alloc(strcmp(j->texts[0], "sobol") ? gsl_qrng_halton : gsl_qrng_sobol, (unsigned)j->dim);
    for (size_t i = 0; i < j->n; i++) {
        gsl_qrng_get(q, j->points.xs + i * (size_t)j->dim);
    }
    gsl_qrng_free(q);
}
#endif

#ifdef WITH_HELMER
static void helmer(job *j)
{
    helmer_points(j->texts[0], (int)j->n, j->dim, j->points.xs);
}
#endif

#if defined WITH_GSL || defined WITH_HELMER
static void room_first(job *j)
{
    check(koksma_points_init(&j->points, j->n, j->dim));
}
#endif

static const struct mode {
    const char *name;
    int texts, numbers;
    void (*prepare)(job *);
    void (*once)(job *);
} modes[] = {
    {"generate", 1, 2, NULL, generate},
    {"measure", 2, 2, points_first, measure},
    {"exact", 1, 2, plane_first, exact},
    {"fast", 1, 2, plane_first, fast},
    {"pairs", 1, 1, points_first, pairs},
    {"read", 1, 0, NULL, read_points},
    {"write", 1, 0, read_points, write_points},
    {"stores", 0, 0, NULL, store},
    {"fma", 0, 0, NULL, multiply_and_add},
#ifdef WITH_LAB
    {"scene", 1, 0, NULL, open_scene},
#endif
#ifdef WITH_DANDY
    {"dandy", 1, 2, points_first, dandy},
#endif
#ifdef WITH_GSL
    {"gsl", 1, 2, room_first, gsl},
#endif
#ifdef WITH_HELMER
    {"helmer", 1, 2, room_first, helmer},
#endif
};

static double now_s(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void time_mode(const struct mode *m, job *j, clockid_t clock)
{
    double times[MOST + 1], sum = 0;
    int n = 0;
    if (m->prepare) {
        m->prepare(j);
    }
    while (n <= MOST && (n < 2 || sum < ENOUGH_S)) { /* what takes long has one repeat, which counts */
        const double start = now_s(clock);
        m->once(j);
        times[n] = now_s(clock) - start;
        sum += times[n++];
        if (times[0] > 2) {
            break;
        }
    }
    double *first = times + (n > 1);
    n -= n > 1;
    qsort(first, (size_t)n, sizeof *first, compare);
    printf("%.9g %.9g %.9g %.17g\n", first[n / 2], first[0], first[n - 1], j->value);
}

/* A process counts what its parent held when it was forked, so that the parent has to be small. */
static int print_memory(char **command)
{
    struct rusage used;
    int status = 1;
    const pid_t child = fork();
    if (!child) {
        if (freopen("/dev/null", "w", stdout)) {
            execv(*command, command);
        }
        _exit(2);
    }
    if (child < 0 || waitpid(child, &status, 0) < 0 || status || getrusage(RUSAGE_CHILDREN, &used)) {
        fprintf(stderr, "bench-row: %s failed\n", *command);
        return 2;
    }
    printf("%.3f 0 0 0\n", (double)used.ru_maxrss / 1024);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 3 && !strcmp(argv[2], "memory")) {
        return print_memory(argv + 3);
    }
    for (size_t i = 0; argc > 2 && i < sizeof modes / sizeof *modes; i++) {
        const struct mode *m = &modes[i];
        if (!strcmp(argv[2], m->name) && argc == 3 + m->texts + m->numbers) {
            job j = {.run = {.threads = atoi(argv[1])}, .dim = 2, .value = NAN};
            for (int k = 0; k < m->texts; k++) {
                j.texts[k] = argv[3 + k];
            }
            j.n = m->numbers > 0 ? (size_t)atof(argv[3 + m->texts]) : 0;
            j.dim = m->numbers > 1 ? atoi(argv[4 + m->texts]) : 2;
            time_mode(m, &j, strchr(argv[1], 'c') ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID);
            koksma_points_fini(&j.points);
            return 0;
        }
    }
    fprintf(stderr, "bench-row: no such row; the head of bench/bench_row.c has them\n");
    return 2;
}
