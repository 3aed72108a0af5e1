/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the files of a report share: the report that is being written, the means that it reads from the store, published
 * tables, and the sections, questions and conclusions that it consists of. rho.h has the ranking of measures.
 *
 * A report has one status. Readers return values; after the first failure they return nothing (n = 0, NaN) at once, what is
 * written is dropped, and the status tells why. So only loops over much work ask koksma__report_goes_on.
 */
#ifndef KOKSMA_STUDY_REPORT_REPORT_H
#define KOKSMA_STUDY_REPORT_REPORT_H

#include "core/parallel.h"
#include "stats/stats.h"
#include "study/report/document.h"
#include "study/run/study.h"
#include "study/run/tasks.h"

typedef struct koksma__report {
    koksma_study *study;
    const koksma_run *all, *run;    /* of the report; of the section that is being written. May be NULL */
    koksma__phases phases;          /* the progress of the report, */
    double share;                   /* of which a section has this share */
    koksma_status status;           /* of the first failure */
    size_t part;                    /* index of the plan that a section of each plan is about */
    char rows[KOKSMA__SHA256_TEXT]; /* SHA-256 of all rows of the store */
    size_t n_memory;
    void **memory;                                 /* of koksma__report_memory */
    struct koksma__coherences *coherences;         /* known so far (pictures.c) */
    const struct koksma_adaptive_report *adaptive; /* of each figure; in the section of figures alone */
} koksma__report;

/* Whether to go on: nothing failed yet, and the caller of the report agrees. */
bool koksma__report_goes_on(koksma__report *r);

/* Keeps a status, unless an earlier one was a failure. Returns whether nothing failed yet. */
bool koksma__report_keep(koksma__report *r, koksma_status status);

/* Memory for n zeroed items, which the end of the question or section frees; NULL after a failure, which may be of this
   memory. */
void *koksma__report_memory(koksma__report *r, size_t n, size_t size);

/* Adds a zeroed item to a list of *n items in such memory, which may move; returns it, or NULL after a failure. items: the
   address of the list. */
void *koksma__report_add(koksma__report *r, void *items, size_t *n, size_t size);
void koksma__report_release(koksma__report *r);

/* SHA-256 of the bytes that koksma_study_export writes as CSV. run: asked whether to go on, always with the fraction 0; may
   be NULL. Errors: those of the store, MEMORY, INTERRUPTED. */
koksma_status koksma__rows_sha256(koksma__store *store, const koksma_run *run, char text[KOKSMA__SHA256_TEXT]);

/* ---- Means ------------------------------------------------------------------------------------------------- */

enum { KOKSMA__RESULT_STRIDE = sizeof(koksma__result) / sizeof(double) };

/* What means are about: a measure of points (through a warp), or the error of the images of a scene with its options by
   a metric, for the patterns and the numbers of points or samples of a block. */
typedef struct koksma__subject {
    const koksma__discrepancy_block *points; /* NULL: of images */
    const koksma__image_block *images;       /* NULL: of points */
    const char *measure, *warp;              /* of points; warp "": none */
    const char *scene, *variant, *metric;    /* of images */
    const koksma__reference *reference;      /* that images are compared with; the block's last one at first */
    const koksma__texts *patterns;
    const koksma__wholes *n;
    bool larger;                          /* whether larger means are better */
    char name[KOKSMA__VARIANT_TEXT + 64]; /* "l2-star, 3D", "checker, filter=tent" */
} koksma__subject;

koksma__subject koksma__subject_of_points(const koksma__discrepancy_block *block, const char *measure,
                                          const char *warp);
koksma__subject koksma__subject_of_images(const koksma__image_block *block, const char *scene, const char *variant,
                                          const char *metric);

/* Reads the results of a series for trials below `trials`. The caller frees them; NULL after a failure. */
koksma__result *koksma__read_results(koksma__report *r, const koksma__series *series, long long trials, size_t *n);

/* The mean over the trials of a pattern with n points or samples; exact for the points of a deterministic pattern, which
   has only one set. Unless `results` is NULL, *results gets them, the value
   first in each; the caller frees them. */
koksma__summary koksma__read_mean(koksma__report *r, const koksma__subject *s, const char *pattern, long long n,
                                  koksma__result **results);

/* The means of all patterns and sizes: [pattern * sizes + size], in the report's memory. */
koksma__summary *koksma__read_means(koksma__report *r, const koksma__subject *s);

/* Means above 0, which have logarithms, by their numbers of points or samples, in the report's memory for `most` of them.
   koksma__curve_add leaves others out. */
typedef struct koksma__curve {
    size_t n;
    double *x;
    koksma__summary *y;
} koksma__curve;
koksma__curve koksma__curve_of(koksma__report *r, size_t most);
void koksma__curve_add(koksma__curve *curve, long long n, koksma__summary mean);

/* Means of the members of koksma_metric_value over images. A summary's n is 0 if the store has no rows for it. */
typedef struct koksma__metric_means {
    koksma__summary value, robust, top_share;
} koksma__metric_means;
koksma__metric_means koksma__read_metric(koksma__report *r, const koksma__subject *s, const char *pattern,
                                         long long n, const char *metric);

/* The mean error of the last reference of a subject's images itself; NaN: unknown. */
double koksma__reference_error(koksma__report *r, const koksma__subject *s);

/* The mean of a summary and its interval. */
koksma__estimate koksma__estimate_of(const koksma__summary *summary);

/* Writes the name of a scene with its options, such as "checker, filter=tent". */
void koksma__case_name(const char *scene, const char *variant, char *text, size_t size);

/* Orders n values, `stride` apart: the least first (descending: the largest), those that koksma__compare finds equal as
   they come, and unknown ones (NaN) last. Returns the number of those that are known. */
size_t koksma__order_means(const double *values, size_t stride, size_t n, bool descending, size_t *order);

/* ---- Pictures and their coherence -------------------------------------------------------------------------- */

/*
 * Whether the images of a pattern have visible bands: the coherence of the mean spectrum of the errors of its first
 * trials (koksma_coherence), which is the one rule of a report, as of `koksma compare` and `koksma rank`. Averages show
 * weaker waves than single images do. The store has coherences of single images only, so the images are rendered again,
 * once for each report, as far as all of them have rows.
 */

/* The number of trials whose errors' spectra are averaged for a coherence. */
enum { KOKSMA__SPECTRUM_TRIALS = 8 };

/* The coherence of the errors of a subject's images with n samples of a pattern. images is 0 where it is not known: where
   rows or the reference are missing, and where a report would have to render more than 2^28 samples for coherences. */
koksma_coherence_values koksma__mean_coherence(koksma__report *r, const koksma__subject *s, const char *pattern,
                                               long long n);
void koksma__mean_coherence_forget(koksma__report *r);

/* ---- Published tables -------------------------------------------------------------------------------------- */

/* The mean, SD and maximum of one cell of a table. */
typedef struct koksma__cell {
    koksma__summary mean; /* mean of the trials' mean errors (images) or of the values (discrepancies) */
    double sd;            /* mean of the trials' SDs (images) or SD of the values (discrepancies) */
    double max,
        max_sd; /* mean and SD of the trials' maxima (images) or of the largest of 100 values (discrepancies) */
} koksma__cell;

/* The images of an image table. */
koksma__subject koksma__table_images(const koksma_study *study, const koksma__table *table);

/* Read a cell of a discrepancy table; of an image table against one reference; and of either, by the table's measure or
   against its first reference, at column k. */
koksma__cell koksma__points_cell(koksma__report *r, const koksma__table *table, const char *measure,
                                 const char *pattern, long long n);
koksma__cell koksma__image_cell(koksma__report *r, const koksma__table *table, const koksma__reference *reference,
                                const char *pattern);
koksma__cell koksma__table_cell(koksma__report *r, const koksma__table *table, const char *pattern, size_t k);

/* A published mean of discrepancies, which was taken over 100 sets, agrees if |z| is below this limit. */
static const double KOKSMA__AGREEMENT_Z = 2.6;

/* The largest relative difference at which our mean of image errors agrees with the published one; the limit is
   large because our scenes only approximate the paper's. */
static const double KOKSMA__IMAGE_TOLERANCE = 0.25;

typedef struct koksma__verdict {
    koksma_study_verdict kind;
    double z;     /* for discrepancies: (published - ours) / (standard error of both + half of the last digit) */
    double ratio; /* images: ours / published - 1 */
    size_t note;  /* number of the note on the cell, from 1; 0: none */
} koksma__verdict;

/* Judges a published mean of the row. column: the index of n in a table over several n; otherwise 0. */
koksma__verdict koksma__table_judge(const koksma__table *table, const koksma__table_row *row, size_t column,
                                    const koksma__cell *cell);

/* The number of the note on a cell, from 1; 0: no note. n: the column's number of points in a table over several n,
   otherwise 0. */
size_t koksma__table_note(const koksma__table *table, const char *pattern, long long n, int statistic);

/* Sums over the z-values of a table. Chance may explain each z alone but not all of them together, for example if all
   have the same sign or all are large. Whether a cell counts does not depend on its z: all count but those of one set and
   those that a note leaves out. */
typedef struct koksma__z_sums {
    size_t count;
    size_t one_set,
        untested; /* number of cells without chance, and of those that are no test (KOKSMA_VERDICT_UNTESTED) */
    double sum, squares;
} koksma__z_sums;

/* Adds the z-value of a cell of a table to the sums, or counts it as left out. */
void koksma__z_add(koksma__z_sums *sums, const koksma__verdict *verdict, const koksma__cell *cell);

/* Whether the means deviate to one side (the sum of z over the root of their number), and whether they spread too far
   (the sum of squares), each at the level alpha. */
bool koksma__z_deviates(const koksma__z_sums *sums, double alpha);
bool koksma__z_spreads(const koksma__z_sums *sums, double alpha);

/* ---- Sections, questions and conclusions ------------------------------------------------------------------- */

/* A section of the report; each is a line of sections.def. It writes its content, below its heading; a section without
   content is left out. */
typedef struct koksma__section {
    const char *heading;
    bool of_each_plan; /* the section is written once for every plan of the study */
    void (*write)(koksma__report *r, koksma__document *d);
} koksma__section;

#define SECTION(name) extern const koksma__section koksma__section_##name;
#include "study/report/sections.def"
#undef SECTION

/* Writes of each conclusion of the plan whether it holds, and the evidence: of those on figures, which follow the
   figures, or of all others. */
void koksma__conclude(koksma__report *r, koksma__document *d, bool on_figures);

/* A question of a plan with its blocks. */
typedef struct koksma__topic {
    const char *id;                                  /* id of the question, part of the names of its tables */
    const koksma__discrepancy_block **discrepancies; /* has capacity for all blocks of the plan */
    const koksma__image_block **images;
    size_t n_discrepancies, n_images;
    const char *metric; /* canonical spec of the metric by which images are compared */
    size_t n_groups;    /* number of the question's groups of scenes */
    const koksma__scene_group *groups;
} koksma__topic;

/* Subject number i of a topic: first each measure of points with each warp, then each scene with its options. by_warp:
   the warps of a measure follow each other; otherwise the measures of a warp do. Returns false at the end. */
bool koksma__topic_subject(const koksma__topic *topic, size_t i, bool by_warp, koksma__subject *out);

/* Declares the function that appends the answer to a kind of question; it appends nothing if the blocks lack what
   the answer needs. */
#define QUESTION(name, fields, heading, rows)                                                                        \
    void koksma__answer_##name(koksma__report *r, koksma__document *d, const koksma__topic *topic);
#include "study/plan/questions.def"
#undef QUESTION

#endif
