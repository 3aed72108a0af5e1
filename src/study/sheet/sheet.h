/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A datasheet while it is made: the samplers, what is measured, what came out, progress, notes and commands.
 * datasheet.c has the order of work, sheet_samplers.c the sizes and seeds, the other files a part of the sheet each.
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
    KOKSMA__SHEET_SPP = 3,
    KOKSMA__SHEET_COMMAND = 2048,
    KOKSMA__SHEET_COMMANDS = 64
};

/* A sampler: samplers[0] is what the sheet is about. */
typedef struct koksma__sheet_sampler {
    char text[KOKSMA_MAX_SPEC]; /* of its spec */
    koksma_spec spec;
    uint64_t seed; /* of its first set */
    size_t sets;   /* that it has from this seed on; SIZE_MAX: as many as one likes */
    bool same;     /* for every seed */
} koksma__sheet_sampler;

/* A measure of the plane, or of more dimensions. left_out: a sampler has no value at a size, or it is no exact one. */
typedef struct koksma__sheet_measure {
    koksma_spec spec;
    char name[KOKSMA_MAX_SPEC];
    bool left_out;
    size_t n_bounds; /* values that are bounds, as a search was cut short */
} koksma__sheet_measure;

/* Values of measures at sizes: of sampler s, measure m and size i in tallies[(s * n_measures + m) * n_sizes + i]. */
typedef struct koksma__sheet_values {
    int dim;
    size_t n_samplers, n_measures, n_sizes;
    size_t trials[KOKSMA__SHEET_SAMPLERS];
    koksma__sheet_sampler *const *samplers;
    const size_t *sizes;
    koksma__sheet_measure measures[KOKSMA__SHEET_MEASURES];
    koksma_tally *tallies;
    koksma_joint *joints; /* [s * n_measures + m] */
} koksma__sheet_values;

/* The ranking of one scene at one number of samples a pixel. */
typedef struct koksma__sheet_ranking {
    const char *scene;
    int spp;
    koksma_rank_row rows[KOKSMA__SHEET_SAMPLERS];
    koksma_ranking ranking;
} koksma__sheet_ranking;

typedef struct koksma__sheet {
    const koksma_datasheet_options *options;
    const koksma_run *run;
    double done, share;                  /* of the whole: before the part that runs, and of it */
    double passed, pass_share, fraction; /* of that part (koksma__sheet_part) */
    koksma__sheet_sampler all[KOKSMA__SHEET_SAMPLERS];
    koksma__sheet_sampler *samplers[KOKSMA__SHEET_SAMPLERS];
    size_t n_samplers;
    size_t sizes[KOKSMA__SHEET_SIZES], n_sizes;
    int spp[KOKSMA__SHEET_SPP];
    size_t n_spp;
    int max_dim;               /* of samplers[0] */
    size_t trials;             /* sets of each size */
    size_t max_trials;         /* images of each sampler in a scene */
    koksma_metric_spec metric; /* of their errors */
    char metric_text[KOKSMA_MAX_SPEC];
    const char *const *scenes;
    size_t n_scenes;
    char *commands[KOKSMA__SHEET_COMMANDS];
    size_t n_commands;
    koksma__document notes; /* items of a list: what is left out, and why */
    size_t n_notes;
    koksma__sheet_values plane;
    koksma__sheet_ranking *rankings; /* [scene * n_spp + spp] */
    size_t n_rankings;
} koksma__sheet;

/* A run for the next part of the work, which is this share of the whole. Whenever the fraction that is done begins
   again, the pass before counts for pass_share of what was left of the part: 1 for a part of one pass. The inner
   run's context is the sheet. */
koksma_run koksma__sheet_part(koksma__sheet *sheet, double share, double pass_share);

/* An item of the list of notes: words, and then the text of this thread's last error. */
void koksma__sheet_note_error(koksma__sheet *sheet, const char *what);

/* The operand of commands for sets of a sampler, quoted for a shell where it has to be: pattern:SPEC@n, and @dim where
   that is not 2. */
void koksma__sheet_source(const koksma__sheet_sampler *sampler, size_t n, int dim, char *out, size_t size);

/* Command lines for a section, "koksma " before each; koksma__sheet_put_commands writes and empties the list. */
void koksma__sheet_command(koksma__sheet *sheet, const char *format, ...) KOKSMA_PRINTF(2, 3);
void koksma__sheet_put_commands(koksma__sheet *sheet, koksma__document *d);
void koksma__sheet_drop_commands(koksma__sheet *sheet);

#endif
