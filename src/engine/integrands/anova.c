/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sobol' indices of a set u of coordinates (Sobol' 2001). With V(v) = Var(E(f | x_v)) and D = Var(f):
 *
 *     closed      V(u) / D
 *     total       1 - V(not u) / D
 *     component   sum over v within u of (-1)^(|u| - |v|) V(v) / D
 *
 * If the integrand has a closed form of V, the indices are computed from it. Otherwise they are pick-freeze estimates
 * from N pairs of points A, B. With B_v the point B with coordinates v replaced by those of A, so that A and B_v have
 * only x_v in common,
 *
 *     V(v) = mean of f(A) (f(B_v) - f(B))              (Saltelli et al. 2010)
 *     D - V(not u) = mean of (f(A) - f(A_u))^2 / 2     (Jansen 1999), A_u: A with B's coordinates u
 *
 * A and B are the two halves of the coordinates of Owen-scrambled Sobol' points, or of random points if Sobol' points
 * do not have so many dimensions. SETS scramblings give independent estimates; the result is their mean, with an
 * interval by Student's t. The mean of f over A and B is first subtracted from f. This reduces the variance of the
 * estimate of V if the mean is far from 0.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "integrands/integrands.h"

enum { SETS = 16, SAMPLES = 4096, MOST_SAMPLES = 1 << 20 };

typedef struct parts {
    double component, closed, total, variance; /* component, closed and total are fractions of the variance */
} parts;

/* Sets `held` for the coordinates of the subset of u that `bits` describes. */
static void hold(const int *axes, size_t n_axes, unsigned bits, bool others, int dim, bool *held)
{
    for (int i = 0; i < dim; i++) {
        held[i] = others;
    }
    for (size_t k = 0; k < n_axes; k++) {
        held[axes[k]] = bits >> k & 1;
    }
}

/* Returns the sign, +1 or -1, of the term of a subset in the component of u. */
static int sign_of(unsigned bits, size_t n_axes)
{
    size_t missing = n_axes;
    for (; bits; bits &= bits - 1) {
        missing--;
    }
    return missing % 2 ? -1 : 1;
}

static parts exact_parts(const koksma_integral *f, const int *axes, size_t n_axes, bool *held)
{
    const unsigned all = (1u << n_axes) - 1;
    koksma__sum component = {0};
    parts p = {.variance = f->variance};
    for (unsigned bits = 1; bits <= all; bits++) {
        hold(axes, n_axes, bits, false, f->dim, held);
        p.closed = f->explained(f, held) / f->variance;
        koksma__sum_add(&component, sign_of(bits, n_axes) * p.closed);
    }
    hold(axes, n_axes, 0, true, f->dim, held);
    p.total = 1 - f->explained(f, held) / f->variance;
    p.component = koksma__sum_value(&component);
    return p;
}

/* ---- Estimates ---------------------------------------------------------------------------------------------- */

typedef struct job {
    const koksma_integral *f;
    const int *axes;
    size_t n_axes, samples;
    uint64_t seed;
    koksma_spec pattern;
    koksma_run run; /* within a set */
    parts sets[SETS];
} job;

/* Computes f at points whose held coordinates come from the half `from` of the coordinates, and whose other
   coordinates come from the other half. */
static koksma_status values_of(const job *j, const koksma_points *both, bool from_b, const bool *held,
                               koksma_points *mixed, double *values)
{
    const size_t d = (size_t)j->f->dim;
    for (size_t i = 0; i < both->n; i++) {
        for (size_t k = 0; k < d; k++) {
            mixed->xs[i * d + k] = both->xs[i * 2 * d + k + (held[k] == from_b ? d : 0)];
        }
    }
    return koksma_integral_values(j->f, mixed, &j->run, values);
}

/* Subtracts the mean over A and B from the values at A; returns the variance. */
static double centre(size_t n, double *a, const double *b)
{
    koksma__sum sum = {0}, square = {0};
    for (size_t i = 0; i < n; i++) {
        koksma__sum_add(&sum, a[i]);
        koksma__sum_add(&sum, b[i]);
    }
    const double mean = koksma__sum_value(&sum) / (2 * (double)n);
    for (size_t i = 0; i < n; i++) {
        a[i] -= mean;
        koksma__sum_add(&square, a[i] * a[i] + (b[i] - mean) * (b[i] - mean));
    }
    return koksma__sum_value(&square) / (2 * (double)n);
}

/* room: memory for three values of each point. */
static koksma_status estimate(const job *j, const koksma_points *both, koksma_points *mixed, double *room, bool *held,
                              parts *p)
{
    const size_t n = both->n;
    const unsigned all = (1u << j->n_axes) - 1;
    double *a = room, *b = room + n, *c = room + 2 * n;
    koksma__sum component = {0}, apart = {0};
    hold(j->axes, j->n_axes, all, true, j->f->dim, held);
    KOKSMA__TRY(values_of(j, both, false, held, mixed, a));
    KOKSMA__TRY(values_of(j, both, true, held, mixed, b));
    hold(j->axes, j->n_axes, all, false, j->f->dim, held);
    KOKSMA__TRY(values_of(j, both, true, held, mixed, c));
    for (size_t i = 0; i < n; i++) {
        koksma__sum_add(&apart, (a[i] - c[i]) * (a[i] - c[i]) / 2);
    }
    p->variance = centre(n, a, b);
    const double all_variance = p->variance * (double)n;
    p->total = koksma__sum_value(&apart) / all_variance;
    for (unsigned bits = 1; bits <= all; bits++) {
        koksma__sum sum = {0};
        hold(j->axes, j->n_axes, bits, false, j->f->dim, held);
        KOKSMA__TRY(values_of(j, both, false, held, mixed, c));
        for (size_t i = 0; i < n; i++) {
            koksma__sum_add(&sum, a[i] * (c[i] - b[i]));
        }
        p->closed = koksma__sum_value(&sum) / all_variance;
        koksma__sum_add(&component, sign_of(bits, j->n_axes) * p->closed);
    }
    p->component = koksma__sum_value(&component);
    return KOKSMA_OK;
}

static koksma_status estimate_set(void *context, size_t set)
{
    job *j = context;
    koksma_points both = {0}, mixed = {0};
    double *room = malloc(3 * j->samples * sizeof *room);
    bool *held = malloc((size_t)j->f->dim * sizeof *held);
    koksma_status status = room && held ? KOKSMA_OK : koksma__fail_memory(3 * j->samples * sizeof *room);
    status = status ? status : koksma_points_init(&both, j->samples, 2 * j->f->dim);
    status = status ? status : koksma_points_init(&mixed, j->samples, j->f->dim);
    status = status ? status : koksma_generate(&j->pattern, j->seed * SETS + set, &j->run, &both);
    status = status ? status : estimate(j, &both, &mixed, room, held, &j->sets[set]);
    koksma_points_fini(&both);
    koksma_points_fini(&mixed);
    free(room);
    free(held);
    return status;
}

static koksma_share share_of(const parts *sets, size_t offset)
{
    koksma_tally tally = {0};
    for (size_t s = 0; s < SETS; s++) {
        koksma_tally_add(&tally, *(const double *)((const char *)&sets[s] + offset));
    }
    const double half = koksma_tally_interval(&tally);
    return (koksma_share){tally.mean, tally.mean - half, tally.mean + half};
}

/* Small sets are computed at the same time. A large one takes seconds, so that its own blocks are, and ask the caller. */
static koksma_status estimate_sets(job *j, const koksma_run *run)
{
    koksma__phases phases = {0};
    koksma_status status = KOKSMA_OK;
    j->run = (koksma_run){.threads = 1};
    if (j->samples <= SAMPLES) {
        return koksma__parallel(run, SETS, estimate_set, j);
    }
    for (size_t set = 0; set < SETS && !status; set++) {
        j->run = koksma__phase_run(&phases, run, 1.0 / SETS);
        status = estimate_set(j, set);
    }
    return status;
}

static koksma_status estimates(job *j, const koksma_run *run, koksma_sensitivity *out)
{
    const koksma_pattern *sobol = koksma_pattern_find("sobol");
    const int dim = 2 * j->f->dim;
    KOKSMA__FAIL_IF(dim > KOKSMA_MAX_DIM, KOKSMA_DIM, "pick-freeze estimates: they take up to %d dimensions, not %d",
                    KOKSMA_MAX_DIM / 2, j->f->dim);
    KOKSMA__TRY(koksma_pattern_spec(sobol && dim <= sobol->max_dim ? "sobol:scramble=owen" : "random", &j->pattern));
    KOKSMA__TRY(estimate_sets(j, run));
    const koksma_share variance = share_of(j->sets, offsetof(parts, variance));
    KOKSMA__FAIL_IF(!(variance.value > 0) || isinf(variance.value), KOKSMA_ARGUMENT,
                    "pick-freeze estimates: the function has no finite variance above 0");
    *out = (koksma_sensitivity){.component = share_of(j->sets, offsetof(parts, component)),
                                .closed = share_of(j->sets, offsetof(parts, closed)),
                                .total = share_of(j->sets, offsetof(parts, total)),
                                .variance = variance.value};
    return KOKSMA_OK;
}

koksma_status koksma_integral_sensitivity(const koksma_integral *integral, const int *axes, size_t n_axes,
                                          size_t samples, uint64_t seed, const koksma_run *run,
                                          koksma_sensitivity *out)
{
    KOKSMA__REQUIRE(integral, axes, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(n_axes < 1 || n_axes > KOKSMA_MAX_ANOVA_AXES || samples > MOST_SAMPLES, KOKSMA_ARGUMENT,
                    "koksma_integral_sensitivity: n_axes, samples: it takes 1 to %d axes and up to %d samples",
                    KOKSMA_MAX_ANOVA_AXES, MOST_SAMPLES);
    for (size_t k = 0; k < n_axes; k++) {
        bool fresh = axes[k] >= 0 && axes[k] < integral->dim;
        for (size_t i = 0; i < k; i++) {
            fresh = fresh && axes[i] != axes[k];
        }
        KOKSMA__FAIL_IF(!fresh, KOKSMA_ARGUMENT,
                        "koksma_integral_sensitivity: axes: %d: it takes different numbers from 0 to %d", axes[k],
                        integral->dim - 1);
    }
    if (samples || !integral->explained) {
        job j = {.f = integral, .axes = axes, .n_axes = n_axes, .samples = samples ? samples : SAMPLES, .seed = seed};
        return estimates(&j, run, out);
    }
    bool *held = malloc((size_t)integral->dim * sizeof *held);
    KOKSMA__REQUIRE_MEMORY(held, (size_t)integral->dim * sizeof *held);
    const parts p = exact_parts(integral, axes, n_axes, held);
    free(held);
    *out = (koksma_sensitivity){{p.component, p.component, p.component},
                                {p.closed, p.closed, p.closed},
                                {p.total, p.total, p.total},
                                p.variance,
                                true};
    return KOKSMA_OK;
}

/* ---- Components -------------------------------------------------------------------------------------------------- */

/*
 * ANOVA components of products as integrands. The component that belongs to a set u of coordinates of the product
 * offset + scale prod g_i(x_i) is
 *
 *     scale prod_{i in u} (g_i(x_i) - m_i) prod_{i not in u} m_i,      m_i the mean of g_i,
 *
 * with integral 0 and variance scale^2 prod_u (q_i - m_i^2) prod_{not u} m_i^2. The components of all nonempty u add
 * up to the function minus its integral, and their integration errors add up to the function's error: they show which
 * projections of a pattern cause its error.
 */

static double factor_at(const koksma_integral *f, int axis, double x)
{
    return f->factors[axis].at ? f->factors[axis].at(x) : f->factor(f, axis, x);
}

/* Returns the value of the component at x; context points to the component. */
static double at(const double *x, int dim, void *context)
{
    const koksma_integral *f = context, *whole = f->whole;
    double product = whole->scale;
    (void)dim;
    for (int i = 0; i < whole->axes; i++) {
        product *= f->chosen[i] ? factor_at(whole, i, x[i]) - whole->factors[i].mean : whole->factors[i].mean;
    }
    return product;
}

/* Opens a second copy of the integrand, which the component owns. */
static koksma_status open_whole(const koksma_integral *integral, koksma_integral **out)
{
    koksma_integral_facts facts;
    koksma_integral_about(integral, &facts);
    KOKSMA__FAIL_IF(!integral->factors, KOKSMA_UNSUPPORTED,
                    "%s: components are known only for products of functions of one coordinate", facts.text);
    return koksma_integral_open(facts.text, facts.dim, out);
}

koksma_status koksma_integral_component(const koksma_integral *integral, const int *axes, size_t n_axes,
                                        koksma_integral **out)
{
    KOKSMA__REQUIRE(integral, axes, out);
    char name[64] = "component";
    *out = NULL;
    KOKSMA__FAIL_IF(n_axes < 1 || n_axes > KOKSMA_MAX_ANOVA_AXES, KOKSMA_ARGUMENT,
                    "koksma_integral_component: n_axes: it takes 1 to %d axes", KOKSMA_MAX_ANOVA_AXES);
    koksma_integral *whole;
    KOKSMA__TRY(open_whole(integral, &whole));
    for (size_t k = 0; k < n_axes; k++) {
        const size_t used = strlen(name);
        snprintf(name + used, sizeof name - used, "%c%d", k ? ',' : ' ', axes[k]);
    }
    const koksma_function function = {name, whole->dim, whole->dim, at, NULL, 0};
    koksma_status status = koksma_integral_of_function(&function, whole->dim, out);
    if (status) {
        koksma_integral_close(whole);
        return status;
    }
    koksma_integral *f = *out;
    f->whole = whole; /* closed when the component is closed */
    f->function.context = f;
    f->chosen = calloc((size_t)whole->axes, sizeof *f->chosen);
    status = f->chosen ? KOKSMA_OK : koksma__fail_memory((size_t)whole->axes);
    for (size_t k = 0; k < n_axes && !status; k++) {
        if (axes[k] < 0 || axes[k] >= whole->axes || f->chosen[axes[k]]) {
            status = koksma__fail(KOKSMA_ARGUMENT,
                                  "koksma_integral_component: axes: %d: it takes different numbers from 0 to %d",
                                  axes[k], whole->axes - 1);
        } else {
            f->chosen[axes[k]] = true;
        }
    }
    f->variance = whole->scale * whole->scale;
    for (int i = 0; i < whole->axes && !status; i++) {
        const koksma__factor *g = &whole->factors[i];
        f->variance *= f->chosen[i] ? g->square - g->mean * g->mean : g->mean * g->mean;
    }
    if (status) {
        koksma_integral_close(f);
        *out = NULL;
    }
    return status;
}
