/* SPDX-License-Identifier: Apache-2.0 */
#include "study/rho_means.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/room.h"
#include "core/status.h"

/* The sums of a measure; NULL: no memory. */
static koksma__rho_sums *sums_of(koksma__rho_means *s, const char *measure)
{
    for (size_t m = 0; m < s->n; m++) {
        if (!strcmp(s->of[m].measure, measure)) {
            return &s->of[m];
        }
    }
    koksma__rho_sums *of = koksma__room_for_one(s->of, s->n, &s->room, 16, sizeof *of);
    if (!of) {
        return NULL;
    }
    s->of = of;
    of[s->n] = (koksma__rho_sums){.measure = measure, .draws = calloc(KOKSMA__RHO_SAMPLES, sizeof *of->draws)};
    if (!of[s->n].draws) {
        (void)koksma__fail_memory(KOKSMA__RHO_SAMPLES * sizeof *of->draws);
        return NULL;
    }
    return &of[s->n++];
}

static koksma_status index_of_variant(koksma__rho_means *s, const char *variant, size_t *index)
{
    for (*index = 0; *index < s->n_variants; ++*index) {
        if (!strcmp(s->variants[*index], variant)) {
            return KOKSMA_OK;
        }
    }
    const char **variants =
        koksma__room_for_one(s->variants, s->n_variants, &s->room_of_variants, 16, sizeof *variants);
    if (!variants) {
        return KOKSMA_MEMORY;
    }
    s->variants = variants;
    variants[s->n_variants++] = variant;
    return KOKSMA_OK;
}

koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns)
{
    const bool says = n_patterns >= KOKSMA__LEAST_PAIRS && rho->low < rho->high;
    return says ? *rho : (koksma__estimate){rho->value, NAN, NAN};
}

koksma_status koksma__rho_add(koksma__rho_means *s, const char *measure, const char *variant,
                              const koksma__estimate *rho, const double draws[KOKSMA__RHO_SAMPLES], size_t n_patterns)
{
    size_t v;
    koksma__rho_sums *of = sums_of(s, measure);
    const koksma_status status = of ? index_of_variant(s, variant, &v) : KOKSMA_MEMORY;
    if (status) {
        return status;
    }
    of->total += rho->value;
    of->all++;
    of->sure += rho->low > 0 || rho->high < 0;
    of->few += n_patterns < KOKSMA__LEAST_PAIRS;
    of->perfect += n_patterns >= KOKSMA__LEAST_PAIRS && isnan(rho->low);
    for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
        of->draws[i] += draws[i];
    }
    if (v < KOKSMA__RHO_VARIANTS) {
        of->rho[v] += rho->value;
        of->cases[v]++;
    }
    return KOKSMA_OK;
}

static double mean_rho(const koksma__rho_sums *m)
{
    return m->all ? m->total / (double)m->all : (double)NAN;
}

/* The measures, best first: insertion sort, ties by place. */
void koksma__rho_order(koksma__rho_means *s)
{
    for (size_t m = 1; m < s->n; m++) {
        const koksma__rho_sums of = s->of[m];
        size_t at = m;
        for (; at > 0 && fabs(mean_rho(&s->of[at - 1])) < fabs(mean_rho(&of)); at--) {
            s->of[at] = s->of[at - 1];
        }
        s->of[at] = of;
    }
}

/* The mean of a measure less that of another: of magnitudes, as a measure may be better when larger.
   Cases with too few patterns leave it without an interval. */
static koksma_status compare(const koksma__rho_sums *m, const koksma__rho_sums *other, koksma__estimate *out)
{
    const koksma__draws a = {fabs(mean_rho(m)), copysign(1 / (double)m->all, m->total), m->draws};
    const koksma__draws b = {fabs(mean_rho(other)), copysign(1 / (double)other->all, other->total), other->draws};
    const koksma_status status = koksma__bootstrap_difference(&a, &b, KOKSMA__RHO_SAMPLES, out);
    if (m->few || other->few) {
        out->low = out->high = NAN;
    }
    return status;
}

static koksma_status add_untold(koksma__html *h, const koksma__rho_means *s)
{
    koksma_status status = KOKSMA_OK;
    size_t untold = 0;
    for (size_t m = 1; !status && m < s->n; m++) {
        koksma__estimate less;
        status = compare(&s->of[0], &s->of[m], &less);
        if (!status && !(less.low > 0)) {
            koksma__html_add(h, untold++ ? ", <code>" : "; not told apart from it: <code>");
            koksma__html_text(h, s->of[m].measure);
            koksma__html_add(h, "</code> %+.2f", mean_rho(&s->of[m]));
        }
    }
    return status;
}

/* The cases without an interval. */
static void add_without(koksma__html *h, const koksma__rho_sums *of)
{
    if (of->few) {
        koksma__html_add(h, " (%zu have fewer than %d patterns, too few for an interval", of->few,
                         KOKSMA__LEAST_PAIRS);
    }
    if (of->perfect) {
        koksma__html_add(h, "%s%zu are in perfect order, which has none", of->few ? "; " : " (", of->perfect);
    }
    koksma__html_add(h, of->few || of->perfect ? ")" : "");
}

koksma_status koksma__rho_sentence(koksma__html *h, const koksma__rho_means *s)
{
    const koksma__rho_sums *best = &s->of[0], *worst = &s->of[s->n - 1];
    koksma__html_add(h, "<p><strong>Answer.</strong> <code>");
    koksma__html_text(h, best->measure);
    koksma__html_add(h,
                     "</code> orders the patterns most as the error of the images does: mean rank correlation "
                     "(Spearman) %+.2f over %zu cases, in %zu of which its interval excludes 0",
                     mean_rho(best), best->all, best->sure);
    add_without(h, best);
    const koksma_status status = add_untold(h, s);
    if (s->n > 1) {
        koksma__html_add(h, "; last is <code>");
        koksma__html_text(h, worst->measure);
        koksma__html_add(h, "</code> with %+.2f", mean_rho(worst));
    }
    koksma__html_add(h, ". A measure that is better when larger has negative numbers.</p>\n");
    return status;
}

koksma_status koksma__rho_table(koksma__html *h, const char *id, const koksma__rho_means *s)
{
    const size_t n_variants = s->n_variants < KOKSMA__RHO_VARIANTS ? s->n_variants : KOKSMA__RHO_VARIANTS;
    koksma__grid grid;
    char text[KOKSMA__VARIANT_TEXT + 64];
    koksma_status status = KOKSMA_OK;
    snprintf(text, sizeof text, "correlation-%.40s", id);
    koksma__grid_open(&grid, h, text);
    koksma__grid_head(&grid, "measure");
    koksma__grid_head(&grid, "mean Spearman");
    koksma__grid_head_interval(&grid, "less than the first");
    koksma__grid_head(&grid, "cases");
    koksma__grid_head(&grid, "cases that exclude 0");
    for (size_t v = 0; v < n_variants; v++) {
        snprintf(text, sizeof text, "mean, %s", s->variants[v][0] ? s->variants[v] : "defaults");
        koksma__grid_head(&grid, text);
    }
    for (size_t i = 0; !status && i < s->n; i++) {
        const koksma__rho_sums *m = &s->of[i];
        koksma__estimate less = {NAN, NAN, NAN};
        status = i ? compare(&s->of[0], m, &less) : KOKSMA_OK;
        koksma__grid_row(&grid);
        koksma__grid_text(&grid, m->measure);
        koksma__grid_number(&grid, mean_rho(m), 3);
        koksma__grid_interval(&grid, less, 2);
        koksma__grid_number(&grid, (double)m->all, 7);
        koksma__grid_number(&grid, (double)m->sure, 7);
        for (size_t v = 0; v < n_variants; v++) {
            koksma__grid_number(&grid, m->cases[v] ? m->rho[v] / (double)m->cases[v] : (double)NAN, 3);
        }
    }
    koksma__grid_close(&grid);
    return status;
}

void koksma__rho_fini(koksma__rho_means *s)
{
    for (size_t m = 0; m < s->n; m++) {
        free(s->of[m].draws);
    }
    free(s->of);
    free(s->variants);
}
