/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Studies: all combinations of patterns with measures, and of patterns with scenes, over many trials. Results are in
 * DIR/results.sqlite, the report is in DIR/report.html. Part of libkoksma-lab.
 *
 *     const char *plans[] = {"shirley1991"};
 *     const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = "out"};
 *     koksma_study *study;
 *     if (!koksma_study_open(&options, &study) && !koksma_study_run(study, NULL, NULL))
 *         koksma_study_report(study, NULL);
 *     koksma_study_close(study);
 *
 * A run may be interrupted at any time and in any way; the next one continues, because finished results are in the
 * database. Results and report do not depend on the number of threads, processes or interruptions.
 */
#ifndef KOKSMA_STUDY_H
#define KOKSMA_STUDY_H

#include <koksma/koksma.h>
#include <koksma/optimise.h>
#include <koksma/render.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A study that is open. One thread at a time may use it. */
typedef struct koksma_study koksma_study;

/* Returns the name of plan i of those in the library; NULL past the end. */
KOKSMA_API const char *koksma_plan_name_at(size_t i);

/* Sets *out to kind i of the questions that a plan may ask, or to section i of the report; returns false past the
   end. The title is the heading in the report. */
KOKSMA_API bool koksma_question_at(size_t i, koksma_entry *out);
KOKSMA_API bool koksma_report_section_at(size_t i, koksma_entry *out);

/* Returns the path of the module that links MPI; NULL: this build has none. */
KOKSMA_API const char *koksma_study_mpi(void);

/* Returns the MPI rank of this process; 0 without mpirun. Ranks other than 0 open a study with folder NULL; their
   koksma_study_run works for rank 0 until all jobs are done. */
KOKSMA_API int koksma_study_mpi_rank(void);

/* The ranks of this run as processes that share a search: for koksma_optimise_options.processes. Without mpirun it is one.
   Errors: UNSUPPORTED (mpirun started this process, and this build has no MPI). */
KOKSMA_API koksma_status koksma_study_mpi_processes(koksma_processes *out);

/* Which study to open. */
typedef struct koksma_study_options {
    const char *const
        *plans;         /* names of plans in the library, or JSON files if the text has a '/' or ends in ".json".
                                 Several are joined to one plan called "a+b" */
    size_t n_plans;     /* 0: use the plan stored in the folder, which is only read until a run */
    const char *folder; /* created if it does not exist; NULL: only koksma_study_estimate can be called */
    long long trials;   /* replaces the numbers of trials in the plan; 0: does not */
    bool quick;         /* use the `quick` number of trials of each block that has one */
} koksma_study_options;

/* Opens or creates a study.
     out  to be closed by koksma_study_close
   Errors: ARGUMENT (a plan is named twice), UNKNOWN, MISSING, MALFORMED (the message names file, line and reason), IO
   (the folder cannot be written, or another run uses it), MEMORY. */
KOKSMA_API koksma_status koksma_study_open(const koksma_study_options *options, koksma_study **out);

/* Writes results that are not yet on disk and frees the study; it may be NULL. Errors: IO; the study is freed all the
   same. */
KOKSMA_API koksma_status koksma_study_close(koksma_study *study);

/* Returns line i of what the plan's blocks with `skip` leave out, "PATTERN, N = 8, 32: why"; NULL past the end. Valid
   until the study is closed. */
KOKSMA_API const char *koksma_study_left_out_at(const koksma_study *study, size_t i);

/* What a run did. */
typedef struct koksma_study_summary {
    size_t jobs, done_before, done_now; /* a job is one point set or one rendering */
    int workers;                        /* threads, or MPI ranks */
    double seconds;                     /* elapsed */
    double idle_seconds;                /* sum over the workers of the time without a job */
    double processor_seconds;           /* sum over threads and ranks */
    double store_seconds;               /* part of processor_seconds spent in the database */
    bool complete;                      /* false after a time limit, or if a job is impossible */
} koksma_study_summary;

/* Runs all jobs that are not done.
     run      a time limit ends the run early, without an error
     summary  may be NULL
   Errors: INTERRUPTED (finished jobs are kept), IMPOSSIBLE (a pattern found no set for one or more jobs, or a search
   ended with bounds; the message names the first, all other jobs are done and the report can be written. If it
   happens for a reference image, the run ends), IO, and those of koksma_generate, koksma_evaluate and
   koksma_render. */
KOKSMA_API koksma_status koksma_study_run(koksma_study *study, const koksma_run *run, koksma_study_summary *summary);

/* The estimated cost of a study. */
typedef struct koksma_study_cost {
    size_t jobs, references;  /* point sets and renderings; reference images */
    uint64_t rows;            /* in the table of results */
    double seconds;           /* on one thread */
    double reference_seconds; /* part of seconds for the reference images */
    double bytes;             /* on disk */
} koksma_study_cost;

/* Estimates what the whole study costs, without the report. It runs jobs for run->time_limit_s seconds (0: 5 s),
   first one of every block and scene, then those whose cost is large and uncertain, and extrapolates by the number
   of points or samples. Stores nothing. Errors: those of koksma_study_run. */
KOKSMA_API koksma_status koksma_study_estimate(koksma_study *study, const koksma_run *run, koksma_study_cost *out);

/* Formats of exported results. */
typedef enum koksma_export_format {
    KOKSMA_EXPORT_CSV,
    KOKSMA_EXPORT_JSON,
    KOKSMA_EXPORT_NPY,
    KOKSMA_EXPORT_SHA256
} koksma_export_format;

/* Writes all results of a study's folder, sorted by key; equal results give equal bytes, however they were made. The
   folder is only read.
     format  CSV; JSON with one object a line; NPY with one record a row, whose texts are byte strings; SHA256: one line,
             the hash of the CSV
     path    "-" is standard output
   Errors: MISSING, MALFORMED (no results of a study; damaged or changed by hand), IO (also while a run uses the
   folder), MEMORY. */
KOKSMA_API koksma_status koksma_study_export(const char *folder, koksma_export_format format, const char *path);

/* What an audit compares. */
typedef struct koksma_audit_options {
    const char *folder; /* of a study; it is only read */
    long long rows;     /* to draw at random, each with the same probability; 0: all */
    uint64_t seed;      /* of the draw */
    /* Is called with a line for each thing that differs, by one thread at a time; NULL: is not. */
    void (*differs)(void *context, const char *text);
    void *context;
} koksma_audit_options;

/* What an audit found. A row is a line of koksma_study_export. */
typedef struct koksma_audit {
    long long rows;         /* that the generators of this program made, by their revisions (koksma_pattern) */
    long long other_rows;   /* that others made: they cannot be compared here */
    long long drawn, agree; /* of `rows`; those that are equal, bit for bit, when they are made again */
    double bound;           /* with 95 % confidence a smaller part of `rows` is wrong (Clopper & Pearson 1934); the
                               part that is, if all are drawn */
    size_t references, references_agree; /* reference images that rows are compared with: made again; equal */
    size_t references_missing;           /* whose files are not there */
    size_t differences;                  /* things that differ; 0: none */
    char other[128];                     /* revisions of one of other_rows and of this program; empty: none */
} koksma_audit;

/* Makes rows of a study again from their keys, and all its reference images, and compares them with what is stored. The
   rows depend on the seed and on the store, not on the number of threads; under mpirun all ranks work, which must be
   able to read the folder, and rank 0 has the result.
   Errors: ARGUMENT (rows below 0), MISSING, MALFORMED (no results of a study, or damaged beyond reading), IO,
   MEMORY, INTERRUPTED. What differs is no error. */
KOKSMA_API koksma_status koksma_study_audit(const koksma_audit_options *options, const koksma_run *run,
                                            koksma_audit *out);

/* Writes DIR/report.json, which has every number (docs/report-format.md), and DIR/report.html, which shows it: one
   file that needs no network. Errors: ARGUMENT (the study has no folder), IO. */
KOKSMA_API koksma_status koksma_study_report(koksma_study *study, const koksma_run *run);

/* Returns the id of published table i of the plan, such as "5.1"; NULL past the end. Valid until the study is
   closed. */
KOKSMA_API const char *koksma_study_table_at(const koksma_study *study, size_t i);

/* Whether our mean agrees with the published one. */
typedef enum koksma_study_verdict {
    KOKSMA_VERDICT_NEW,     /* the paper has no number */
    KOKSMA_VERDICT_WAITING, /* too few trials so far */
    KOKSMA_VERDICT_AGREES,  /* the difference is within chance and rounding (|z| < 2.6), or for images within 25 % */
    KOKSMA_VERDICT_FITTED,  /* within 25 %, but the scene was fitted to the published numbers */
    KOKSMA_VERDICT_EXPLAINED,  /* differs for a known reason */
    KOKSMA_VERDICT_UNEXPLAINED /* differs; the reason is unknown */
} koksma_study_verdict;

/* Returns the word of a verdict, such as "agrees"; NULL for another value. */
KOKSMA_API const char *koksma_study_verdict_name(koksma_study_verdict verdict);

/* A row of a published table with our numbers. NaN: there is no number. */
typedef struct koksma_study_row {
    const char *pattern, *label;
    long long n;            /* points, or samples per pixel */
    double published[3];    /* mean, standard deviation, maximum */
    double mean, low, high; /* our mean over the trials and its 95 % interval (NaN with one trial) */
    double sd, max;         /* image tables: means over the trials. Discrepancies: standard deviation over the sets,
                               mean of the largest of 100 (of all, with fewer sets) */
    double converged;       /* image tables: mean error against the last reference of the plan */
    size_t trials;
    koksma_study_verdict verdict; /* of the mean */
} koksma_study_row;

/* Computes row i of a published table from the results so far. A table over several n has one row for each pattern
   and n.
     id     such as "5.1"; if several plans have it, that of the first
     found  receives false past the last row
   Errors: UNKNOWN (id), IO, MEMORY. */
KOKSMA_API koksma_status koksma_study_table_row(koksma_study *study, const char *id, size_t i, koksma_study_row *row,
                                                bool *found);

/* ---- Images from elsewhere -------------------------------------------------------------------------------- */

enum { KOKSMA_IMAGES_GROUP = 256 };

/* A group of images whose paths differ only in {trial}. */
typedef struct koksma_images_row {
    char group[KOKSMA_IMAGES_GROUP]; /* the other names in {} with their texts: "pattern=halton scene=ball" */
    long long spp;                   /* number at {spp}; 0 without it */
    size_t trials;
    double mean, low, high;   /* mean over the trials of the metric, and its 95 % interval (NaN with one) */
    double robust, top_share; /* means over the trials of what koksma_metric_value has beside */
    double sd, max, rmse;     /* means over the trials, of the absolute error whatever the metric */
    double slope, slope_low, slope_high;    /* log-log slope of the group's mean over {spp}; NaN with one number */
    koksma_coherence_values coherence;      /* of the errors of all trials, in their order */
    size_t position;                        /* among the groups with this spp, by the mean: 1 has the least */
    double behind, behind_low, behind_high; /* how much larger the mean is than the first's, over that: 0.1 is 10 %;
                                               its 95 % interval is of the differences of images with equal {trial},
                                               NaN where the two groups have other trials */
} koksma_images_row;

/* Compares all images whose paths match a template with a reference image.
     places     the template, such as "out_{spp}_{trial}.exr": {spp} and {trial} match digits, other names any text
                without '/'
     reference  path of the reference image
     metric     of the error; NULL: mae
     folder     gets report.json and report.html, a page with all numbers (docs/report-format.md); NULL: neither
     rows, n    receive the rows, sorted by group and spp; the caller frees *rows with free()
   Each image is read twice: for its error and for the coherence of its row.
   Errors: ARGUMENT (a brace that is not closed), MISSING (no file matches), MALFORMED (a pixel that is not a finite
   number), those of koksma_image_read, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_study_images(const char *places, const char *reference,
                                             const koksma_metric_spec *metric, const char *folder,
                                             const koksma_run *run, koksma_images_row **rows, size_t *n);

/* ---- Ranking patterns for a scene ------------------------------------------------------------------------- */

enum { KOKSMA_MAX_RANK_TRIALS = 65536, KOKSMA_RANK_CHECKS = 2, KOKSMA_RANK_REASON = 256 };

/* A picture that a ranking asks of another renderer. */
typedef struct koksma_rank_picture {
    const char *scene, *pattern; /* as in the options: what they mean is the renderer's affair */
    int spp;
    int width, height; /* 0: the renderer's own */
    uint64_t seed;     /* 0 to 2^31 - 1. Pictures of different seeds are independent; of equal seeds they are equal */
} koksma_rank_picture;

/* Another renderer: allocates *image with linear light. May be called by run->threads threads at once. A failure with
   MEMORY, IO, SYSTEM or INTERRUPTED ends the ranking, any other one takes the pattern out of it. */
typedef koksma_status (*koksma_rank_renderer)(void *context, const koksma_rank_picture *picture,
                                              const koksma_run *run, koksma_image *image);

/* Renders by a command line, the context: a text that /bin/sh runs for every picture, after putting quoted texts for
   {scene}, {pattern}, {spp}, {seed}, {width}, {height} and {out}, the name of the file to write, which ends in .exr;
   {out.pfm} and {out.png} are names with other endings. It runs in the current folder; files lie in a folder of their
   own below $TMPDIR or /tmp, which is removed. It is stopped by a signal to its process group.
   Errors: ARGUMENT (unknown words in {}, no {out}), IMPOSSIBLE (it fails, or writes no readable picture; with the last
   line that it printed), SYSTEM, INTERRUPTED. */
KOKSMA_API koksma_status koksma_rank_by_command(void *context, const koksma_rank_picture *picture,
                                                const koksma_run *run, koksma_image *image);

/* What to rank. */
typedef struct koksma_rank_options {
    const char *scene;           /* as for koksma_scene_open */
    const char *const *patterns; /* as koksma_render_patterns takes them */
    size_t n_patterns;
    int spp;
    int width, height;                   /* of the image; 0: the scene's, halved until it has at most 19,200 pixels */
    const koksma_integrator *integrator; /* NULL: distribution */
    const koksma_filter *filter;         /* NULL: box */
    const koksma_metric_spec *metric;    /* of the error of an image, by which patterns are ranked; NULL: mae */
    double time_limit_s;         /* seconds; 0: none. It ends the sequence of work early and changes nothing else */
    long long max_trials;        /* for each pattern, 8 to KOKSMA_MAX_RANK_TRIALS; 0: 4096 */
    bool one_size;               /* leave out the checks at half and twice the size */
    koksma_rank_renderer render; /* makes all pictures; NULL: this library. With it scenes and patterns are any texts,
                                    integrator and filter are not used, and width 0 is the size of a first picture,
                                    without checks at other sizes */
    void *render_context;
    const char *reference; /* with `render`: the pattern of the reference, whose pictures have the true mean and
                              depend on their seed; NULL: the first pattern */
    bool
        best_only; /* end when the pattern with the least error is decided: without advice, checks at other sizes, and the order
                       of the others */
} koksma_rank_options;

/* Whether a pattern was ranked. */
typedef enum koksma_rank_state {
    KOKSMA_RANK_RANKED,
    KOKSMA_RANK_TOO_SLOW, /* it was too slow for its part of the time limit */
    KOKSMA_RANK_REFUSED,  /* it cannot render this; `reason` says why */
} koksma_rank_state;

/* What is decided about a pattern in comparison with the pattern of row 0. */
typedef enum koksma_rank_decision {
    KOKSMA_RANK_UNDECIDED,
    KOKSMA_RANK_BEST,  /* this is row 0, and it is decided against all others */
    KOKSMA_RANK_EQUAL, /* its error equals that of row 0 within 2 % */
    KOKSMA_RANK_WORSE, /* its error is larger than that of row 0 */
} koksma_rank_decision;

/* One pattern of a ranking. Intervals are simultaneous: with 95 % probability all of them, over all patterns, pairs
   and rounds, contain the true value. They include the error of the reference. NaN: there is no number. */
typedef struct koksma_rank_row {
    size_t pattern;  /* index into the options' patterns */
    size_t position; /* 1 + number of patterns that are decided to have less error; 0: not ranked */
    koksma_rank_state state;
    koksma_rank_decision decision;
    long long trials;
    double mean, low, high; /* the mean over the trials of the metric, corrected for the error of the reference */
    double robust;    /* the same without the 0.1 % of pixels of largest error (koksma_metric_value); not corrected */
    double top_share; /* the share of the error that these carry, mean over the trials */
    double behind, behind_low, behind_high; /* relative difference to the mean of row 0 */
    koksma_coherence_values coherence;      /* of the errors of its first 8 trials; images is 0 with fewer trials, and
                                               without any error */
    char reason[KOKSMA_RANK_REASON];        /* why it is not ranked; empty when it is */
} koksma_rank_row;

/* The result of a check at another size. */
typedef enum koksma_rank_check_state {
    KOKSMA_RANK_UNCHECKED,  /* no check: left out, or no best pattern, or the time limit ended the work */
    KOKSMA_RANK_CONFIRMED,  /* the checked pattern is the best, or equal to the best within 2 % */
    KOKSMA_RANK_OVERTURNED, /* another pattern is decided to have less error */
    KOKSMA_RANK_UNSETTLED,  /* too few trials to decide */
} koksma_rank_check_state;

/* Whether one pattern is the best at another size, too. */
typedef struct koksma_rank_check_result {
    koksma_rank_check_state state;
    size_t pattern; /* if OVERTURNED: the better pattern, an index into the options' patterns */
    bool coherent;  /* whether the error of the best pattern at this size is coherent */
    double behind, behind_low, behind_high; /* if OVERTURNED: relative difference of the checked pattern to it */
} koksma_rank_check_result;

/* A check whether the best patterns are the best at another image size, too. It compares the first three patterns
   among those whose error is not coherent, and the first three of all. */
typedef struct koksma_rank_check {
    int width, height;
    koksma_rank_check_result advice; /* of the advised pattern, among those whose error is not coherent at the size
                                        asked for; if every error is, the same as first */
    koksma_rank_check_result first;  /* of the pattern with the least error, row 0, among all */
    long long trials;
} koksma_rank_check;

/* The result of a ranking. */
typedef struct koksma_ranking {
    size_t n;         /* ranked patterns, in rows 0 .. n - 1; the others follow */
    size_t n_slow;    /* patterns that were too slow */
    bool settled;     /* the best pattern is decided; it is in row 0 */
    bool complete;    /* every pair is decided */
    bool cut_short;   /* the time limit ended the work */
    long long trials; /* of the pattern with the most trials */
    long long
        needed_trials; /* if not settled: about how many trials of each pattern would decide; 0: unknown, or none
                                would because the reference is too noisy */
    double needed_s;   /* seconds that these would take; 0: unknown */
    int width, height;
    double reference_error; /* expected mean absolute error of the reference; NaN: it was not finished */
    koksma_rank_check checks[KOKSMA_RANK_CHECKS]; /* at half and at twice the size */
    double seconds;
    bool advised;       /* it is decided which pattern has the least error among those whose error is not coherent */
    size_t advised_row; /* the row of that pattern, if advised */
    size_t n_coherent;  /* ranked patterns whose error is coherent */
} koksma_ranking;

/* Renders the scene with every pattern, trial by trial, and ranks the patterns by the error of the image: the
   mean over the trials of options->metric, by default the mean absolute error in luminance.

   The sequence of work depends on the options, not on the machine. It is: rounds of 8, 16, 32, ... trials until the
   best pattern is decided; further rounds until the best of those whose error is not coherent (image.h) is decided;
   the checks of both at half and twice the size; further rounds until every pair is decided. A pair is decided after a round
   if the confidence interval of the ratio of its errors excludes 1, or lies within 2 % of 1 (equal). Decisions are
   final. All decisions at one size hold together with 96 % probability, those of each check with 99.5 %.
   A time limit ends this sequence early: a longer limit names the same best pattern, or one where there was none. A
   pattern whose first round exceeds its part of the time limit is put off until the others are decided, and no best
   pattern is named while one is put off.
   Trials of a pattern are independent of each other and of those of other patterns.
     rows  receives options->n_patterns rows
   Errors: UNKNOWN, MISSING, MALFORMED, ARGUMENT (no pattern can render this, or max_trials is out of range), MEMORY,
   INTERRUPTED. A time limit is no error. */
KOKSMA_API koksma_status koksma_rank_patterns(const koksma_rank_options *options, const koksma_run *run,
                                              koksma_rank_row *rows, koksma_ranking *out);

#ifdef __cplusplus
}
#endif

#endif
