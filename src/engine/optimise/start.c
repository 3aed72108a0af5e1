/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The sets from which a search without a first set can start. A search begins with the best of them, so that its result
 * is never worse than a listed pattern. The table of patterns is walked with the patterns' default parameters. A pattern
 * that refuses this n or dim is left out, as are those that read files or run code. `record` has a set for each of some
 * measures. Lattices and nets are quickly made and mostly the best; some random patterns take long.
 *
 * A structure that the search preserves is one of the first set. Latin: each axis has one coordinate in each interval
 * of length 1/n; such a set is also tried with its coordinates moved to the middles of these intervals. Net: in the
 * plane the patterns that claim (0,m,2)-nets, in other dimensions Sobol' points. Sequence: what the points show.
 */
#include "optimise/search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

koksma_status koksma__search_default(const koksma_optimise_options *o, const koksma_run *run, koksma_points *points)
{
    koksma_spec spec;
    KOKSMA__TRY(koksma_pattern_spec(o->keep == KOKSMA_KEEP_NET || o->keep == KOKSMA_KEEP_SEQUENCE ? "sobol"
                                    : o->power && o->keep == KOKSMA_KEEP_NONE ? "gaussian-blue-noise"
                                                                              : "latin-hypercube",
                                    &spec));
    return koksma_generate(&spec, o->seed, run, points);
}

/* Returns whether each axis has one coordinate in each interval of length 1/n. `seen` has n flags. */
static bool is_latin(const koksma_points *points, char *seen)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    for (size_t k = 0; k < dim; k++) {
        memset(seen, 0, n);
        for (size_t i = 0; i < n; i++) {
            char *at = seen + (size_t)fmin(points->xs[i * dim + k] * (double)n, (double)n - 1);
            if (*at) {
                return false;
            }
            *at = 1;
        }
    }
    return true;
}

/* Moves the coordinates to the middles of their intervals of length 1/n. */
static void centre(koksma_points *points)
{
    const double n = (double)points->n;
    for (size_t c = 0; c < points->n * (size_t)points->dim; c++) {
        points->xs[c] = (fmin(floor(points->xs[c] * n), n - 1) + 0.5) / n;
    }
}

/* Returns whether the set of a pattern has the structure that the search preserves. */
static bool has_structure(const koksma_optimise_options *o, const koksma_pattern *p, const koksma_points *points,
                          char *seen)
{
    switch (o->keep) {
    case KOKSMA_KEEP_LATIN:
        return is_latin(points, seen);
    case KOKSMA_KEEP_NET:
        return o->dim == 2 && (o->n & (o->n - 1)) == 0 && p->claims & KOKSMA_CLAIM_NET2;
    case KOKSMA_KEEP_SEQUENCE:
        return p->claims & KOKSMA_CLAIM_SEQUENCE && !koksma__sequence_check(points);
    default:
        return true;
    }
}

typedef struct walk {
    const koksma_spec *measure;
    const koksma_optimise_options *options;
    const koksma_run *run;
    koksma_points points;
    char *seen;
} walk;

static koksma_status try_spec(walk *w, const koksma_spec *spec, koksma__start_function f, void *context)
{
    koksma_status status = koksma_generate(spec, w->options->seed, w->run, &w->points);
    if (status == KOKSMA_INTERRUPTED) {
        return f(context, NULL);
    }
    if (status == KOKSMA_MEMORY) {
        return status;
    }
    if (status || !has_structure(w->options, spec->pattern, &w->points, w->seen)) {
        return KOKSMA_OK; /* the pattern refuses this n or dim, or is of another structure */
    }
    status = f(context, &w->points);
    if (!status && w->options->keep == KOKSMA_KEEP_LATIN) {
        centre(&w->points);
        status = f(context, &w->points);
    }
    return status;
}

/* Tries a pattern with its default parameters and, if it has a set for each of some measures, with this measure. */
static koksma_status try_pattern(walk *w, const koksma_pattern *p, koksma__start_function f, void *context)
{
    koksma_spec spec;
    char text[KOKSMA_MAX_SPEC];
    koksma_status status = KOKSMA_OK;
    if (p->operand || p->alias_of || (w->options->keep != KOKSMA_KEEP_NONE && p->claims & KOKSMA_CLAIM_BLUE)) {
        return KOKSMA_OK; /* blue noise, which may take long, has none of the structures */
    }
    snprintf(text, sizeof text, "%s:measure=%s", p->name, w->measure->measure->name);
    if (p->params && !strcmp(p->params->name, "measure") && !koksma_pattern_spec(text, &spec)) {
        status = try_spec(w, &spec, f, context);
    }
    KOKSMA__TRY(status);
    KOKSMA__TRY(koksma_pattern_spec(p->name, &spec));
    return try_spec(w, &spec, f, context);
}

koksma_status koksma__search_starts(const koksma_spec *measure, const koksma_optimise_options *o, bool random,
                                    const koksma_run *run, koksma__start_function f, void *context)
{
    walk w = {measure, o, run, {0}, NULL};
    koksma_status status = koksma_points_init(&w.points, o->n, o->dim);
    w.seen = status ? NULL : malloc(o->n);
    status = status || w.seen ? status : koksma__fail_memory(o->n);
    const koksma_pattern *p;
    for (size_t i = 0; !status && (p = koksma_pattern_at(i)); i++) {
        const bool fixed = p->claims & KOKSMA_CLAIM_DETERMINISTIC;
        status = fixed != random ? try_pattern(&w, p, f, context) : KOKSMA_OK;
    }
    free(w.seen);
    koksma_points_fini(&w.points);
    return status;
}
