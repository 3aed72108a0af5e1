/* SPDX-License-Identifier: Apache-2.0 */
/* Checks before a study runs that every pattern can make the numbers of points that the plan gives, and that every
   measure accepts them and supports their dimension, so that the study does not fail halfway. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/integrate.h>
#include <koksma/study.h>

#include "core/capacity.h"
#include "core/points.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "render/samples/samples.h"
#include "study/plan/made_by.h"
#include "study/plan/plan_read.h"
#include "study/plan/variants.h"

/* Larger sets are not tried, because that takes time, and a pattern that supports only some n is found at smaller
   sets. */
enum { MOST_TRIED = 1 << 16 };

/* Measures are tried with sets of at most so many coordinates. */
enum { MOST_MEASURED = 1 << 21 };

/* The trials of a plan have at most MOST_WORK coordinates together. Each trial counts as EACH more or, if it reads a file,
   as FILE_READ; a sample of an image counts as SAMPLE. From the first
   that is too many on, none is made: a size that is refused then shows when its job runs. The limit is a count, not a
   time, because the sizes that `skip` leaves out must be the same on every machine. */
enum { MOST_WORK = 1 << 27, EACH = 1 << 10, FILE_READ = 1 << 17, SAMPLE = 16 };

/* Each takes a byte with `skip`, and some steps. */
enum { MOST_PAIRS = 1 << 25 };

/* Whether the plan has work left to try a pattern or measure with n points. */
static bool has_work(const koksma__plan_trials *trials, bool image, const char *name, long long n, int dim)
{
    const koksma__row_texts row = {image, name, ""};
    const long long left = MOST_WORK - trials->totals->work;
    const long long cost = (koksma__points_read_files(&row) ? FILE_READ : EACH) + n * dim;
    trials->totals->work += cost < left ? cost : left;
    return cost <= left;
}

/* Interrupts a pattern at its first progress call. By then the pattern has checked its arguments, which is all that
   is needed. */
static bool stop_at_once(void *context, double fraction)
{
    (void)context;
    (void)fraction;
    return false;
}

koksma_status koksma_plan_try(const char *pattern, size_t n, int dim)
{
    KOKSMA__REQUIRE(pattern);
    const koksma_run briefly = {.threads = 1, .keep_going = stop_at_once};
    koksma_spec spec;
    koksma_status status = koksma_pattern_spec(pattern, &spec);
    status = status ? status : koksma__try_set(&spec, n, dim, &briefly);
    return status == KOKSMA_INTERRUPTED ? KOKSMA_OK : status;
}

/* Fails unless a pattern can make n points in a block, or a measure accepts n points. */
typedef koksma_status (*set_trial)(const void *block, const char *name, long long n);

static koksma_status try_points(const void *block, const char *pattern, long long n)
{
    return koksma_plan_try(pattern, (size_t)n, ((const koksma__discrepancy_block *)block)->dim);
}

static koksma_status try_image(const void *unused, const char *pattern, long long n)
{
    (void)unused;
    const koksma_run briefly = {.threads = 1, .keep_going = stop_at_once};
    const koksma_status status = koksma__image_pattern_try(pattern, (size_t)n, &briefly);
    return status == KOKSMA_INTERRUPTED ? KOKSMA_OK : status;
}

/* koksma_evaluate refuses a number of points before its first call of keep_going. Other errors are of the points. */
static koksma_status try_measure(const void *block, const char *measure, long long count)
{
    const int dim = ((const koksma__discrepancy_block *)block)->dim;
    const size_t n = (size_t)count;
    if (koksma__integrand_of(measure)) {
        return KOKSMA_OK;
    }
    const koksma_run briefly = {.threads = 1, .keep_going = stop_at_once};
    koksma_spec spec;
    koksma_points points;
    koksma_value value;
    KOKSMA__TRY(koksma_measure_spec(measure, &spec));
    KOKSMA__TRY(koksma__points_fit(n, dim));
    if (n > (size_t)(MOST_MEASURED / dim)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma_points_init(&points, n, dim));
    for (size_t i = 0; i < points.n * (size_t)points.dim; i++) { /* different points, on a line */
        points.xs[i] = i % (size_t)points.dim ? 0.5 : (double)(i / (size_t)points.dim) / (double)n;
    }
    const koksma_status status = koksma_evaluate(&spec, &points, &briefly, &value);
    koksma_points_fini(&points);
    return status == KOKSMA_N || status == KOKSMA_MEMORY ? status : KOKSMA_OK;
}

/* The combinations to try: all patterns, or all measures, with all numbers `n` up to `most`, which are the list `key` of
   the JSON object `node`. */
typedef struct tried {
    const koksma__json_node *node;
    const char *key;
    const void *block;
    set_trial trial;
    const koksma__texts *names;
    koksma__wholes *n;
    long long most;
    int dim; /* coordinates of a point, for has_work */
    const koksma__plan_trials *trials;
} tried;

static koksma_status try_one(const tried *t, size_t p, size_t k)
{
    const char *name = t->names->at[p];
    return has_work(t->trials, t->trial == try_image, name, t->n->at[k], t->dim)
               ? t->trial(t->block, name, t->n->at[k])
               : KOKSMA_OK;
}

/* Whether a failed trial of a name is an error of a plan: in that of a store only if it concerns a file or the system. A
   size that a named file or family of files lacks does: if the files were those of the run, it would have that size, and
   the keys of the rows have another hash. */
static bool is_error(koksma_status status, bool stored, bool image, const char *name)
{
    const koksma__row_texts row = {image, name, ""};
    return status && koksma_status_exit_code(status) > (stored && !koksma__points_read_files(&row) ? 2 : 0);
}

static koksma_status refuse_first(const tried *t)
{
    koksma__json_node list;
    koksma_status status = koksma__json_member(t->node, t->key, &list);
    for (size_t k = 0; !status && k < t->n->n; k++) {
        for (size_t p = 0; !status && p < t->names->n && t->n->at[k] <= t->most; p++) {
            const koksma__json_node item = koksma__json_item(&list, k);
            status = try_one(t, p, k);
            status = is_error(status, t->trials->stored, t->trial == try_image, t->names->at[p])
                         ? koksma__json_fail_in(&item, status)
                         : KOKSMA_OK;
        }
    }
    return status;
}

/* Appends the line "what: reason". */
static koksma_status add_line(const char *what, const char *reason, koksma__texts *lines)
{
    const size_t size = 4 * (strlen(what) + strlen(reason)) + 3; /* every byte of the pattern may become \xNN */
    char *text = malloc(size);
    char **line = text ? koksma__add_one(&lines->at, &lines->n, sizeof *line) : NULL;
    if (!line) {
        free(text);
        return koksma__fail_memory(size);
    }
    snprintf(text, size, "%s: %s", what, reason);
    koksma_text_escape(text, size);
    *line = text;
    return KOKSMA_OK;
}

/* Tries pattern or measure p with all sizes and marks those that it refuses. If there are any, appends the line
   "NAME, N = 8, 32: reason". */
static koksma_status leave_out_of(const tried *t, size_t p, bool *is, koksma__texts *lines)
{
    char line[1024], reason[512] = "";
    int length = snprintf(line, sizeof line, "%s, N = ", t->names->at[p]);
    for (size_t k = 0; k < t->n->n && t->n->at[k] <= t->most; k++) {
        const koksma_status status = try_one(t, p, k);
        if (!status) {
            continue;
        }
        char text[sizeof reason];
        snprintf(text, sizeof text, "%s", koksma_error_text());
        /* the error concerns a file or the system, not this number of points */
        if (koksma_status_exit_code(status) > 2) {
            koksma__fail(status, "%s", text);
            return koksma__json_fail_in(t->node, status);
        }
        if (length < (int)sizeof line) {
            length +=
                snprintf(line + length, sizeof line - (size_t)length, "%s%lld", reason[0] ? ", " : "", t->n->at[k]);
        }
        if (!reason[0]) {
            snprintf(reason, sizeof reason, "%s", text);
        }
        is[p * t->n->n + k] = true;
    }
    if (!reason[0]) {
        return KOKSMA_OK;
    }
    /* the line begins with the name; if the reason begins with it too, it is cut from the reason */
    const size_t name = strcspn(t->names->at[p], ":");
    const bool twice = !strncmp(reason, line, name) && !strncmp(reason + name, ": ", 2);
    return add_line(line, reason + (twice ? name + 2 : 0), lines);
}

/* A family of files has as many trials as files (tasks.c). Where it has fewer files of a size than of another, some may
   be missing, and no job fails that would tell. Appends the line "PATTERN, N = 16 (1 of 3 trials): reason" for sizes that
   have fewer trials than the block, and than the size with most files. */
static koksma_status find_short_sizes(const koksma__discrepancy_block *b, size_t p, const koksma__plan_trials *trials,
                                      koksma__left_out *out)
{
    char line[1024];
    koksma_spec spec;
    koksma__file_set *sets = NULL;
    size_t count = 0, most = 0;
    KOKSMA__TRY(koksma_pattern_spec(b->patterns.at[p], &spec));
    if (!koksma__reads_points(spec.pattern) || !koksma__file_has(spec.path, "{n}") ||
        !koksma__file_has(spec.path, "{seed}") || !has_work(trials, false, b->patterns.at[p], 0, 1) ||
        koksma__file_sets(spec.path, &sets, &count)) {
        return KOKSMA_OK; /* a family without any file is an error of a trial to make a set, or of the run */
    }
    for (size_t i = 0, same = 0; i < count; i++) { /* they are sorted by n */
        same = i && sets[i].n == sets[i - 1].n ? same + 1 : 1;
        most = same > most ? same : most;
    }
    const size_t wanted = (size_t)b->trials < most ? (size_t)b->trials : most;
    const size_t begin = (size_t)snprintf(line, sizeof line, "%s, N =", b->patterns.at[p]);
    size_t length = begin;
    for (size_t k = 0; k < b->n.n && length < sizeof line; k++) {
        size_t has = 0; /* files of this size */
        for (size_t i = 0; i < count; i++) {
            has += sets[i].n == (size_t)b->n.at[k];
        }
        if (has && has < wanted) {
            length += (size_t)snprintf(line + length, sizeof line - length, "%s %lld (%zu of %zu trials)",
                                       length > begin ? "," : "", b->n.at[k], wanted - has, wanted);
        }
    }
    free(sets);
    return length > begin ? add_line(line, "the family has fewer files than for other N", &out->lines) : KOKSMA_OK;
}

/* Tries the patterns (kinds > 0) and the measures (kinds > 1) of a block. Reports the first size that one of them refuses
   as an error; with `skip`, leaves such sizes out instead. */
static koksma_status check(const tried *t, size_t kinds, koksma__left_out *out)
{
    const bool stored = t->trials->stored;
    bool **const is[] = {&out->is, &out->unmeasured};
    bool skip = false, any = false;
    koksma_status status = koksma__json_get_flag(t->node, "skip", false, &skip);
    for (size_t i = 0; i < kinds; i++) {
        t->trials->totals->pairs += (uint64_t)t[i].names->n * t[i].n->n;
    }
    KOKSMA__JSON_FAIL_IF(!status && t->trials->totals->pairs > MOST_PAIRS, t->node,
                         "with it the blocks have more than %d pairs of patterns, or of measures, and sizes",
                         MOST_PAIRS);
    for (size_t i = 0; !status && !skip && i < kinds; i++) {
        status = refuse_first(&t[i]);
    }
    koksma__plan_sort(t->n);
    out->skip = skip;
    if (status || !skip) {
        return status;
    }
    for (size_t i = 0; !status && i < kinds; i++) {
        const size_t n = t[i].names->n * t->n->n;
        *is[i] = calloc(n, sizeof **is[i]);
        status = *is[i] ? KOKSMA_OK : koksma__fail_memory(n);
        for (size_t p = 0; !status && p < t[i].names->n; p++) {
            status = leave_out_of(&t[i], p, *is[i], &out->lines);
        }
    }
    for (size_t k = 0; !status && !any && k < t->n->n; k++) {
        any = true; /* until all names of a kind are left out at this size */
        for (size_t i = 0; i < kinds; i++) {
            size_t p = 0;
            while (p < t[i].names->n && (*is[i])[p * t->n->n + k]) {
                p++;
            }
            any = any && p < t[i].names->n;
        }
    }
    return status || any || stored ? status
                                   : koksma__json_fail(t->node, "'skip' leaves nothing: %s", out->lines.at[0]);
}

koksma_status koksma__plan_check_sets(const koksma__json_node *node, const koksma__plan_trials *trials,
                                      koksma__discrepancy_block *block)
{
    const int dim = block->dim;
    const tried t[] = {
        {node, "n", block, try_points, &block->patterns, &block->n, MOST_TRIED, dim, trials},
        {node, "n", block, try_measure, &block->measures, &block->n, MOST_MEASURED / dim, dim, trials}};
    koksma_status status = check(t, 2, &block->left_out);
    for (size_t p = 0; !status && p < block->patterns.n; p++) {
        status = find_short_sizes(block, p, trials, &block->left_out);
    }
    return status;
}

/* Fails unless a measure or integrand supports the dimension of the point. */
static koksma_status serves(const char *measure, const koksma_points *point)
{
    const koksma_run briefly = {.threads = 1, .keep_going = stop_at_once};
    koksma_integral *integral;
    koksma_spec spec;
    koksma_value value;
    if (koksma__integrand_of(measure)) {
        KOKSMA__TRY(koksma_integral_open(koksma__integrand_of(measure), point->dim, &integral));
        koksma_integral_close(integral);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma_measure_spec(measure, &spec));
    return koksma_evaluate(&spec, point, &briefly, &value) == KOKSMA_DIM ? KOKSMA_DIM : KOKSMA_OK;
}

/* Checks on one point that each measure of the block supports the block's dimension. */
koksma_status koksma__plan_check_measures(const koksma__json_node *node, const koksma__discrepancy_block *block)
{
    koksma_points point;
    koksma_status status = koksma_points_init(&point, 1, block->dim);
    for (int k = 0; !status && k < block->dim; k++) {
        point.xs[k] = 0.5;
    }
    for (size_t m = 0, first = 0; !status && m < block->measures.n; m++) {
        const bool error = koksma__integrand_of(block->measures.at[m]);
        first = error ? first : m + 1; /* index of the first integrand, because integrands follow the measures */
        status = serves(block->measures.at[m], &point);
        if (status) {
            koksma__json_node list;
            const koksma_status found = koksma__json_member(node, error ? "integrands" : "measures", &list);
            if (!found) {
                const koksma__json_node item = koksma__json_item(&list, error ? m - first : m);
                status = koksma__json_fail_in(&item, status);
            }
        }
    }
    koksma_points_fini(&point);
    return status;
}

/* Whether images of a variant need sets of spp points from their patterns. Adaptive methods, and scopes other than
   the pixel, need sets of other sizes; native pairing needs sets of another dimension. */
static bool takes_spp_points(const char *variant)
{
    koksma__variant v = {0};
    return !koksma__variant_apply(variant, false, &v) && v.render.scope == KOKSMA_SCOPE_PIXEL &&
           v.render.pairing != KOKSMA_PAIRING_NATIVE && !v.adaptive.method;
}

/* Rejects separate patterns for single uses or groups together with native pairing or an adaptive method that
   draws its own strata: both need one pattern for all uses. separate: such a pattern of the block, or NULL. */
static koksma_status check_variant(const char *variant, const char *separate)
{
    koksma__variant v = {0};
    const koksma_status status = koksma__variant_apply(variant, false, &v);
    const bool native = v.render.pairing == KOKSMA_PAIRING_NATIVE;
    const bool takes_one = native || (v.adaptive.method && v.adaptive.method->own_samples);
    KOKSMA__FAIL_IF(!status && takes_one && separate, KOKSMA_ARGUMENT, "%s: %s: it needs one pattern for all uses",
                    separate, variant);
    return status;
}

koksma_status koksma__plan_check_spp(const koksma__json_node *node, const koksma__plan_trials *trials,
                                     koksma__image_block *block)
{
    const tried t = {node, "spp", block, try_image, &block->patterns, &block->spp, MOST_TRIED, SAMPLE, trials};
    koksma_status status = KOKSMA_OK;
    bool takes_spp = false;
    size_t p = 0;
    while (p < block->patterns.n && koksma__image_pattern_is_one(block->patterns.at[p])) {
        p++;
    }
    const char *separate = p < block->patterns.n ? block->patterns.at[p] : NULL;
    for (size_t v = 0; !status && v < block->variants.n; v++) {
        takes_spp |= takes_spp_points(block->variants.at[v]);
        status = check_variant(block->variants.at[v], separate);
        status = status ? koksma__json_fail_in(node, status) : KOKSMA_OK;
    }
    return status ? status : check(&t, takes_spp, &block->left_out);
}

koksma_status koksma__plan_check_reference(const koksma__json_node *node, const koksma__plan_trials *trials,
                                           const koksma__reference *reference)
{
    const bool tries =
        reference->spp <= MOST_TRIED && has_work(trials, true, reference->pattern, reference->spp, SAMPLE);
    const koksma_status status = tries ? try_image(NULL, reference->pattern, reference->spp) : KOKSMA_OK;
    return is_error(status, trials->stored, true, reference->pattern) ? koksma__json_fail_in(node, status)
                                                                      : KOKSMA_OK;
}
