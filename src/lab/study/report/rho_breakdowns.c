/* SPDX-License-Identifier: Apache-2.0 */
/* Tables of the measures' mean rank correlations over parts of the cases: the cases of one scene, of a group of
   scenes that the plan names, or of one number of samples. A row has the mean of every measure, the best measure,
   and the measures that are significantly worse than the best, by Holm's method over the pairs of measures in that
   row. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/report/rho_breakdowns.h"

/* A part of the cases, which is a row of a table. */
typedef struct part {
    char name[160];
    bool *scenes;  /* which scenes the part has; NULL: all */
    long long spp; /* 0: all numbers of samples */
} part;

/* Appends `between` and `more` to a text of limited size, or nothing if they do not fit. */
static void append(char *text, size_t size, const char *between, const char *more)
{
    const size_t used = strlen(text);
    if (used + strlen(between) + strlen(more) + 1 < size) {
        snprintf(text + used, size - used, "%s%s", used ? between : "", more);
    }
}

static void add_heads(koksma__document *d, const koksma__rho_means *s, const char *what)
{
    koksma__doc_head(d, what);
    koksma__doc_head_number(d, "cases", 7);
    koksma__doc_head(d, "best");
    koksma__doc_head(d, "significantly worse than the best");
    for (size_t m = 0; m < s->n; m++) {
        koksma__doc_head_interval(d, s->of[m].measure, 2);
    }
}

static koksma_status add_row(koksma__document *d, const koksma__rho_means *s, const part *of)
{
    koksma__rho_ranking r;
    const koksma_status status = koksma__rho_rank(s, &(koksma__rho_subset){of->scenes, of->spp}, &r);
    if (status || !r.n) {
        koksma__rho_ranking_fini(&r);
        return status;
    }
    char worse[512] = "";
    for (size_t i = 1; i < r.n; i++) {
        if (koksma__rho_is_better(&r, r.at[0].measure, r.at[i].measure)) {
            append(worse, sizeof worse, ", ", s->of[r.at[i].measure].measure);
        }
    }
    koksma__doc_row(d);
    koksma__doc_text(d, of->name);
    koksma__doc_number(d, (double)r.at[0].cases);
    koksma__doc_text(d, s->of[r.at[0].measure].measure);
    koksma__doc_text(d, worse[0] ? worse : "none");
    for (size_t m = 0; m < s->n; m++) {
        koksma__estimate mean = {NAN, NAN, NAN};
        for (size_t i = 0; i < r.n; i++) {
            mean = r.at[i].measure == m ? r.at[i].mean : mean;
        }
        koksma__doc_interval(d, mean);
    }
    koksma__rho_ranking_fini(&r);
    return KOKSMA_OK;
}

static koksma_status add_table(koksma__document *d, const koksma__rho_means *s, const char *name, const char *id,
                               const char *title, const part *parts, size_t n)
{
    char file[64];
    koksma_status status = KOKSMA_OK;
    snprintf(file, sizeof file, "correlation-%.10s-%.40s", name, id);
    koksma__doc_section(d, NULL, title);
    koksma__doc_table_begin(d, file);
    add_heads(d, s, name);
    for (size_t i = 0; !status && i < n; i++) {
        status = add_row(d, s, &parts[i]);
    }
    koksma__doc_table_end(d);
    koksma__doc_end(d);
    return status;
}

/* Fills in the parts: one for each scene, each group of scenes and each number of samples. masks: storage for the
   scenes of the parts. */
static void set_parts(const koksma__topic *topic, const koksma__rho_means *s, part *parts, bool *masks)
{
    part *at = parts;
    for (size_t i = 0; i < s->n_scenes; i++, at++, masks += s->n_scenes) {
        snprintf(at->name, sizeof at->name, "%.150s", s->scenes[i]);
        at->scenes = masks;
        masks[i] = true;
    }
    for (size_t g = 0; g < topic->n_groups; g++, at++, masks += s->n_scenes) {
        char names[256] = "";
        at->scenes = masks;
        for (size_t i = 0; i < s->n_scenes; i++) {
            masks[i] = koksma__texts_have(&topic->groups[g].scenes, s->scenes[i]);
            if (masks[i]) {
                append(names, sizeof names, ", ", s->scenes[i]);
            }
        }
        snprintf(at->name, sizeof at->name, "%.70s (%.80s)", topic->groups[g].title, names);
    }
    for (size_t k = 0; k < s->n_sizes; k++, at++) {
        snprintf(at->name, sizeof at->name, "%lld", s->sizes[k]);
        at->spp = s->sizes[k];
    }
}

koksma_status koksma__rho_breakdowns(koksma__document *d, const koksma__topic *topic, const koksma__rho_means *s)
{
    const size_t n = s->n_scenes + topic->n_groups + s->n_sizes;
    part *parts = calloc(n + 1, sizeof *parts);
    bool *masks = calloc((s->n_scenes + topic->n_groups + 1) * (s->n_scenes + 1), sizeof *masks);
    koksma_status status = parts && masks ? KOKSMA_OK : koksma__fail_memory(n * sizeof *parts);
    if (!status) {
        set_parts(topic, s, parts, masks);
    }
    if (!status && topic->n_groups) {
        status = add_table(d, s, "group", topic->id, "By what dominates the scenes' error", parts + s->n_scenes,
                           topic->n_groups);
    }
    if (!status && s->n_scenes > 1) {
        status = add_table(d, s, "scene", topic->id, "By scene", parts, s->n_scenes);
    }
    if (!status && s->n_sizes > 1) {
        status = add_table(d, s, "samples", topic->id, "By number of samples", parts + s->n_scenes + topic->n_groups,
                           s->n_sizes);
    }
    free(masks);
    free(parts);
    return status;
}
