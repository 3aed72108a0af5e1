/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The state of a datasheet while it is made: samplers, measures, results, progress, notes and commands.
 * datasheet.c runs the parts in their order, sheet_samplers.c chooses samplers, sizes and seeds; each other file
 * makes one part of the sheet, whose functions are below.
 */
#ifndef KOKSMA_STUDY_SHEET_SHEET_H
#define KOKSMA_STUDY_SHEET_SHEET_H

#include <koksma/datasheet.h>
#include <koksma/series.h>
#include <koksma/study.h>

#include "study/report/document.h"

enum {
    KOKSMA__SHEET_SAMPLERS = KOKSMA_MAX_BESIDE + 1,
    KOKSMA__SHEET_SIZES = 6,
    KOKSMA__SHEET_MEASURES = 64,
    KOKSMA__SHEET_SPP = 3
};

/* A sampler on the sheet; samplers[0] is the sampler that the sheet describes. */
typedef struct koksma__sheet_sampler {
    char text[KOKSMA_MAX_SPEC]; /* canonical text of the spec */
    koksma_spec spec;
    uint64_t seed; /* seed of the sampler's first set */
    size_t sets;   /* number of the sampler's sets with consecutive seeds; SIZE_MAX: no limit */
    bool same;     /* whether the set is the same for every seed */
} koksma__sheet_sampler;

/* A measure in two or more dimensions. */
typedef struct koksma__sheet_measure {
    koksma_spec spec;
    char name[KOKSMA_MAX_SPEC];
    size_t n_bounds; /* number of values that are only bounds, because a search was cut short */
} koksma__sheet_measure;

/* Values of measures at several sizes; tallies[(s * n_measures + m) * n_sizes + i] belongs to sampler s, measure m
   and size i. */
typedef struct koksma__sheet_values {
    int dim;
    size_t n_samplers, n_measures, n_sizes;
    size_t trials[KOKSMA__SHEET_SAMPLERS];
    koksma__sheet_sampler *const *samplers;
    const size_t *sizes;
    koksma__sheet_measure measures[KOKSMA__SHEET_MEASURES];
    koksma_tally *tallies;
    koksma_joint *joints; /* a joint's index is s * n_measures + m */
} koksma__sheet_values;

/* Whether samplers[0] is unbiased over its sets. */
typedef struct koksma__sheet_bias {
    size_t n, sets; /* sets: number of sets of n points that were tested; 0: not tested */
    bool biased;
    char detail[200]; /* of the finding of koksma_verify_sets */
} koksma__sheet_bias;

/* The ranking of the samplers in one scene at one number of samples per pixel. */
typedef struct koksma__sheet_ranking {
    const char *scene;
    int spp;
    koksma_rank_row rows[KOKSMA__SHEET_SAMPLERS];
    koksma_ranking ranking;
} koksma__sheet_ranking;

typedef struct koksma__sheet {
    const koksma_datasheet_options *options;
    const koksma_run *run;
    /* fractions of the whole work: of all parts before the current one, and of the current part */
    double done, share;
    double passed, pass_share, fraction; /* fractions of the current part (koksma__sheet_part) */
    koksma__sheet_sampler all[KOKSMA__SHEET_SAMPLERS];
    koksma__sheet_sampler *samplers[KOKSMA__SHEET_SAMPLERS];
    size_t n_samplers;
    size_t sizes[KOKSMA__SHEET_SIZES], n_sizes;
    int spp[KOKSMA__SHEET_SPP];
    size_t n_spp;
    int max_dim;               /* highest dimension that samplers[0] supports */
    size_t trials;             /* number of sets measured at each size */
    size_t max_trials;         /* largest number of images of each sampler in a scene */
    koksma_metric_spec metric; /* metric of the images' errors */
    char metric_text[KOKSMA_MAX_SPEC];
    const char *const *scenes;
    size_t n_scenes;
    koksma__document notes; /* notes for a list: what is left out, and why */
    size_t n_notes;
    koksma__sheet_bias bias;
    koksma__sheet_values plane;
    koksma__sheet_ranking *rankings; /* index i * n_spp + k: scene i with the k-th number of samples */
} koksma__sheet;

/* Returns the run for the next part, whose work is `share` of the whole. A part may consist of several passes; a new
   pass begins when the reported fraction falls. Each pass accounts for the fraction pass_share of what remained of
   the part before it (1 for a part of one pass). The returned run's context is the sheet. */
koksma_run koksma__sheet_part(koksma__sheet *sheet, double share, double pass_share);

/* Returns the run for work on a single set, on the caller's thread: one thread, which asks whether to go on and counts
   as no progress. */
koksma_run koksma__sheet_one_set(koksma__sheet *sheet);

/* Appends a note: `what`, then the text of this thread's last error, which may begin with `what` itself. */
void koksma__sheet_note_error(koksma__sheet *sheet, const char *what);

/* Writes a text as one word of a command, quoted for a shell if necessary. */
void koksma__sheet_word(const char *text, char *out, size_t size);

/* The operand that names sets of a sampler in a command, as one word: pattern:SPEC@n, followed by @dim unless dim is 2. */
typedef struct koksma__sheet_operand {
    char text[2 * KOKSMA_MAX_SPEC];
} koksma__sheet_operand;
koksma__sheet_operand koksma__sheet_source(const koksma__sheet_sampler *sampler, size_t n, int dim);

/* ---- Samplers, sizes and points -------------------------------------------------------------------------------- */

/* Chooses samplers, sizes, trials and samples per pixel. Errors: those of koksma_datasheet about samplers. */
koksma_status koksma__sheet_choose(koksma__sheet *sheet);

/* Generates the points of a trial; run: of one thread. */
koksma_status koksma__sheet_points(const koksma__sheet_sampler *sampler, size_t n, int dim, size_t trial,
                                   const koksma_run *run, koksma_points *out);

/* The number of sets to measure: `wanted`, or fewer if the sampler has fewer. */
size_t koksma__sheet_trials(const koksma__sheet_sampler *sampler, size_t wanted);

/* The largest of the sheet's sizes up to `most`, or the smallest if all are larger. */
size_t koksma__sheet_size(const koksma__sheet *sheet, size_t most);

/* ---- Measures of samplers at several sizes over several trials ------------------------------------------------- */

/* Evaluates values->measures at all sizes and trials; leaves out measures without a value, with a note. */
koksma_status koksma__sheet_evaluate(koksma__sheet *sheet, koksma__sheet_values *values, const koksma_run *run);
void koksma__sheet_values_fini(koksma__sheet_values *values);
const koksma_tally *koksma__sheet_tally(const koksma__sheet_values *values, size_t s, size_t m, size_t i);

/* Writes a table of all values and the commands that compute them. */
void koksma__sheet_put_values(const koksma__sheet_values *values, const char *name, koksma__document *d);

/* Whether samplers a and b have equal values of measure m at size number i that do not vary between sets. Means of values
   that vary are never called equal. */
bool koksma__sheet_equal(const koksma__sheet_values *values, size_t a, size_t b, size_t m, size_t i);

/* Compares samplers a and b by measure m at size number i. Returns 1 if a is better, -1 if b is better, and 0 if the
   test, whose level is 5 % divided by `tests`, does not decide. */
int koksma__sheet_compare(const koksma__sheet_values *values, size_t a, size_t b, size_t m, size_t i, size_t tests);

/* ---- The parts, in their order (datasheet.c) ------------------------------------------------------------------- */

/* What several sections need: whether samplers[0] is unbiased, from many sets; the measures in the plane, with notes on
   those whose values are only bounds; the rankings of the samplers in scenes. They write nothing. */
koksma_status koksma__sheet_look_for_bias(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_measure_plane(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_rank(koksma__sheet *sheet, koksma__document *d);

/* The sections. */
koksma_status koksma__sheet_verdict(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_draw_points(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_put_rankings(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_put_measures(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_integrals(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_spectra(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_verify(koksma__sheet *sheet, koksma__document *d);
koksma_status koksma__sheet_projections(koksma__sheet *sheet, koksma__document *d);

#endif
