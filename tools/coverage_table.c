/* SPDX-License-Identifier: Apache-2.0 */
/*
 * coverage_table PATTERN N DIM RUNS REPLICATES: the error of each estimator of integrals and the coverage of each
 * interval (koksma/estimate.h), over integrands whose truth is known. One JSON object a line; docs/findings/coverage.md
 * has what tools/coverage_page.py makes of them. Built as build/clang/tests/coverage_table.
 *
 * RUNS REPLICATES independent sets are made with the seeds 0, 1, ..; every REPLICATES of them in order are a run. An
 * interval covers if it holds the truth, or misses it by no more than rounding, 1e-14 of the root of the mean square of
 * the integrand; the bootstrap's are counted in the first 1,000 runs. The width is relative to this root; that of an
 * interval that fails (too few replicates) is null.
 */
#include <koksma/estimate.h>
#include <koksma/integrate.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct function {
    const char *kind, *spec;
    int max_dim;
} function;

enum { MOST = 64 };

static function functions[MOST] = {
    {"smooth", "exp", 2},
    {"smooth", "sum-exp", 32},
    {"smooth", "genz-oscillatory", 32},
    {"smooth", "genz-product-peak", 32},
    {"smooth", "genz-corner-peak", 32},
    {"smooth", "genz-gaussian", 32},
    {"smooth", "ridge:kind=smooth", 32},
    {"kink", "genz-continuous", 32},
    {"kink", "ridge:kind=kink", 32},
    {"kink", "asian", 32},
    {"jump", "genz-discontinuous", 32},
    {"jump", "ridge:kind=jump", 32},
    {"jump", "corner", 2},
    {"jump", "disk", 2},
};
static size_t n_functions = 14;

/* The other integrands of the table, in two dimensions only: of the kind "other", with which the page checks the proved. */
static void add_others(void)
{
    const koksma_integrand *f;
    for (size_t i = 0; (f = koksma_integrand_at(i)); i++) {
        bool known = false;
        for (size_t k = 0; k < n_functions; k++) {
            known = known || !strncmp(functions[k].spec, f->name, strlen(f->name));
        }
        if (!known && n_functions < MOST) {
            functions[n_functions++] = (function){"other", f->name, 2};
        }
    }
}

static void must(koksma_status status)
{
    if (status) {
        fprintf(stderr, "coverage_table: %s\n", koksma_error_text());
        exit(koksma_status_exit_code(status));
    }
}

/* The mean of n values, whose range grows that of *least and *largest. */
static double mean_of(const double *values, size_t n, double *least, double *largest)
{
    double sum = 0, lost = 0; /* compensated (Kahan) */
    for (size_t i = 0; i < n; i++) {
        const double next = values[i] - lost, total = sum + next;
        lost = (total - sum) - next;
        sum = total;
        *least = fmin(*least, values[i]);
        *largest = fmax(*largest, values[i]);
    }
    return sum / (double)n;
}

/* The estimates of all functions by all sets, estimates[f * sets + s], and of each function what a point may change one by:
   the range of all values, divided by n. */
static void integrate(const koksma_spec *pattern, size_t n, int dim, size_t sets, koksma_integral *const *integrals,
                      double *estimates, double *shares)
{
    koksma_points points;
    double least[MOST], largest[MOST], *values = malloc(n * sizeof *values);
    must(koksma_points_init(&points, n, dim));
    for (size_t f = 0; f < n_functions; f++) {
        least[f] = HUGE_VAL;
        largest[f] = -HUGE_VAL;
    }
    if (!values) {
        exit(4);
    }
    for (size_t s = 0; s < sets; s++) {
        must(koksma_generate(pattern, s, &(koksma_run){.threads = 1}, &points));
        for (size_t f = 0; f < n_functions; f++) {
            if (integrals[f]) {
                must(koksma_integral_values(integrals[f], &points, &(koksma_run){.threads = 1}, values));
                estimates[f * sets + s] = mean_of(values, n, &least[f], &largest[f]);
            }
        }
    }
    for (size_t f = 0; f < n_functions; f++) {
        shares[f] = integrals[f] ? (largest[f] - least[f]) / (double)n : 0;
    }
    koksma_points_fini(&points);
    free(values);
}

static void put_number(const char *key, double value)
{
    printf(isfinite(value) ? ",\"%s\":%.6g" : ",\"%s\":null", key, value);
}

/* Wilson's 95 % interval of a share that was seen in `count` runs: NAME_low and NAME_high. */
static void put_wilson(const char *name, double share, double count)
{
    const double z = 1.959964, middle = (share + z * z / (2 * count)) / (1 + z * z / count),
                 half = z * sqrt(share * (1 - share) / count + z * z / (4 * count * count)) / (1 + z * z / count);
    char key[64];
    snprintf(key, sizeof key, "%s_low", name);
    put_number(key, middle - half);
    snprintf(key, sizeof key, "%s_high", name);
    put_number(key, middle + half);
}

static void put_rows(const koksma_integral *integral, const double *estimates, double share, size_t runs,
                     size_t replicates)
{
    koksma_integral_facts facts;
    koksma_integral_about(integral, &facts);
    const double root = sqrt(facts.variance + facts.value * facts.value);
    for (size_t i = 0; koksma_estimator_at(i); i++) {
        double square = 0;
        koksma_estimate_options o = {.estimator = koksma_estimator_at(i)->name, .interval = "student"};
        for (size_t run = 0; run < runs; run++) {
            koksma_integral_estimate e;
            must(koksma_estimate_integral(&o, estimates + run * replicates, replicates, NULL, &e));
            square += (e.value - facts.value) * (e.value - facts.value) / (double)runs;
        }
        printf(",\"%s\":%.6g", o.estimator, sqrt(square) / root);
    }
    for (size_t i = 0; koksma_interval_at(i); i++) {
        const koksma_interval *interval = koksma_interval_at(i);
        koksma_estimate_options o = {.interval = interval->name, .share = share};
        const bool bounded = isfinite(facts.lowest) && isfinite(facts.highest);
        o.lowest = bounded ? facts.lowest : 0;
        o.highest = bounded ? facts.highest : 0;
        double covered = 0, width = 0, square = 0;
        const size_t few = strcmp(interval->name, "bootstrap") != 0 || runs < 1000 ? runs : 1000;
        for (size_t run = 0; run < few && (bounded || !interval->bounded); run++) {
            koksma_integral_estimate e;
            must(koksma_estimate_integral(&o, estimates + run * replicates, replicates, NULL, &e));
            covered += facts.value >= e.low - 1e-14 * root && facts.value <= e.high + 1e-14 * root;
            width += (e.high - e.low) / root;
            square += (e.value - facts.value) * (e.value - facts.value);
        }
        const double count = bounded || !interval->bounded ? (double)few : (double)NAN;
        char key[64];
        snprintf(key, sizeof key, "%s_width", interval->name);
        put_number(interval->name, covered / count);
        put_number(key, width / count);
        put_wilson(interval->name, covered / count, count);
        if (!interval->estimator) {
            snprintf(key, sizeof key, "%s_rmse", interval->name);
            put_number(key, sqrt(square / count) / root);
        }
    }
}

int main(int count, char **arguments)
{
    koksma_spec pattern;
    koksma_integral *integrals[MOST] = {0};
    double shares[MOST];
    const long n = count == 6 ? atol(arguments[2]) : 0, dim = n ? atol(arguments[3]) : 0,
               runs = n ? atol(arguments[4]) : 0, replicates = n ? atol(arguments[5]) : 0;
    if (n < 1 || dim < 1 || dim > KOKSMA_MAX_DIM || runs < 1 || replicates < 2) {
        fprintf(stderr, "usage: coverage_table PATTERN N DIM RUNS REPLICATES\n");
        return 2;
    }
    const size_t sets = (size_t)(runs * replicates);
    add_others();
    double *estimates = calloc(n_functions * sets, sizeof *estimates);
    if (!estimates) {
        return 4;
    }
    must(koksma_pattern_spec(arguments[1], &pattern));
    for (size_t f = 0; f < n_functions; f++) {
        const koksma_status status = dim <= functions[f].max_dim
                                         ? koksma_integral_open(functions[f].spec, (int)dim, &integrals[f])
                                         : KOKSMA_DIM;
        must(status == KOKSMA_DIM ? KOKSMA_OK : status);
    }
    integrate(&pattern, (size_t)n, (int)dim, sets, integrals, estimates, shares);
    for (size_t f = 0; f < n_functions; f++) {
        if (integrals[f]) {
            printf("{\"kind\":\"%s\",\"integrand\":\"%s\",\"pattern\":\"%s\",\"n\":%ld,\"dim\":%ld,\"runs\":%ld,"
                   "\"replicates\":%ld",
                   functions[f].kind, functions[f].spec, arguments[1], n, dim, runs, replicates);
            put_rows(integrals[f], estimates + f * sets, shares[f], (size_t)runs, (size_t)replicates);
            puts("}");
        }
        koksma_integral_close(integrals[f]);
    }
    free(estimates);
    return 0;
}
