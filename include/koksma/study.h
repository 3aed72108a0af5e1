/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Studies: patterns x measures and patterns x scenes, over many trials, with the results in DIR/results.sqlite and a
 * report in DIR/report.html. Part of koksma-lab.
 *
 *     const char *plans[] = {"shirley1991"};
 *     const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = "out"};
 *     koksma_study *study;
 *     if (!koksma_study_open(&options, &study) && !koksma_study_run(study, NULL, NULL))
 *         koksma_study_report(study, NULL);
 *     koksma_study_close(study);
 *
 * A run that was interrupted, in whatever way, goes on where it was: results that are in the store are kept. The rows
 * and the report are the same for any number of threads and interruptions.
 */
#ifndef KOKSMA_STUDY_H
#define KOKSMA_STUDY_H

#include <koksma/koksma.h>
#include <koksma/render.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_study koksma_study;

/* The name of shipped plan i, NULL past the end. */
KOKSMA_API const char *koksma_plan_name_at(size_t i);

/* The path of the module that speaks MPI; NULL: there is none. */
KOKSMA_API const char *koksma_study_mpi(void);

/* This process's rank among those that mpirun started; 0 without it. Ranks but 0 open a study with folder NULL; its
   koksma_study_run does jobs for rank 0 until all are done. */
KOKSMA_API int koksma_study_rank(void);

typedef struct koksma_study_options {
    const char *const *plans; /* shipped names, or JSON files when the text has a '/' or ends in ".json". Several
                                 become one plan, "a+b" */
    size_t n_plans;           /* 0: the plan that the folder's results were made with */
    const char *folder;       /* made when it does not exist; NULL: for koksma_study_estimate only */
    long long trials;         /* > 0: instead of the plan's numbers of trials */
    bool quick;               /* each block's `quick` number of trials, where it has one */
} koksma_study_options;

/* Errors: ARGUMENT (a plan stands twice), UNKNOWN, MISSING, MALFORMED (with file, line and reason), IO (the folder
   can't be written, another run holds it), MEMORY. */
KOKSMA_API koksma_status koksma_study_open(const koksma_study_options *options, koksma_study **out);

/* Commits what is not yet on disk. Takes NULL. Errors: IO. */
KOKSMA_API koksma_status koksma_study_close(koksma_study *study);

typedef struct koksma_study_summary {
    size_t jobs, done_before, done_now; /* a job is one point set or one render */
    int workers;                        /* threads, or MPI ranks */
    double seconds;
    double idle_seconds;      /* of all workers together, without a job in hand */
    double processor_seconds; /* of all threads and ranks */
    double store_seconds;     /* of processor_seconds in the database */
    bool complete;            /* false when the time was up, or a job is impossible */
} koksma_study_summary;

/* Does the jobs that are not done, until run->time_limit_s. run and summary may be NULL.
   Errors: INTERRUPTED (what is done is kept), IMPOSSIBLE (a pattern found no set for one or more jobs, or a search
   ended with bounds: the text names the first, all other jobs are done, and the report can be written; for a
   reference: that ends the run), IO, and what generating, measuring or rendering says. */
KOKSMA_API koksma_status koksma_study_run(koksma_study *study, const koksma_run *run, koksma_study_summary *summary);

typedef struct koksma_study_cost {
    size_t jobs, references;  /* point sets and renders; reference images */
    uint64_t rows;            /* of the table of results */
    double seconds;           /* on one thread, from measured samples */
    double reference_seconds; /* of them for the references */
    double bytes;             /* on disk */
} koksma_study_cost;

/* What the whole study would cost, without its report: from jobs of those tasks whose cost is the largest and the
   least certain, as many as fit in run->time_limit_s (0: 5 s), but one of every block and scene; the rest is
   extrapolated from them by the number of points or samples. */
KOKSMA_API koksma_status koksma_study_estimate(koksma_study *study, const koksma_run *run, koksma_study_cost *out);

typedef enum koksma_export_format { KOKSMA_EXPORT_CSV, KOKSMA_EXPORT_JSON, KOKSMA_EXPORT_NPY } koksma_export_format;

/* Writes all results of a folder, sorted by their keys: the same bytes however they were made. Path "-" is standard
   output. JSON is an object a line; NPY is an array of records with byte strings. */
KOKSMA_API koksma_status koksma_study_export(const char *folder, koksma_export_format format, const char *path);

/* Writes DIR/report.json, which has every number (docs/report-format.md), and DIR/report.html, which shows it: one
   file that needs no network. Errors: ARGUMENT (the study has no folder), IO. */
KOKSMA_API koksma_status koksma_study_report(koksma_study *study, const koksma_run *run);

/* The id of table i of the plan, NULL past the end. */
KOKSMA_API const char *koksma_study_table_at(const koksma_study *study, size_t i);

/* How a printed mean goes with ours. */
typedef enum koksma_study_verdict {
    KOKSMA_VERDICT_NEW,        /* nothing is printed */
    KOKSMA_VERDICT_WAITING,    /* too few trials yet */
    KOKSMA_VERDICT_AGREES,     /* the difference is within chance and rounding (|z| < 2.6); images: within 25 % */
    KOKSMA_VERDICT_FITTED,     /* within 25 %, in a scene that was fitted to the printed numbers */
    KOKSMA_VERDICT_EXPLAINED,  /* it differs for a reason that is known */
    KOKSMA_VERDICT_UNEXPLAINED /* it differs, and no reason is known */
} koksma_study_verdict;

/* "agrees", "fitted", ...; NULL of what is none. */
KOKSMA_API const char *koksma_study_verdict_name(koksma_study_verdict verdict);

/* A row of a published table beside ours. NaN where there is no number. */
typedef struct koksma_study_row {
    const char *pattern, *label;
    long long n;            /* points, or samples per pixel */
    double published[3];    /* mean, SD, max */
    double mean, low, high; /* our mean over the trials and its 95 % interval (NaN of one) */
    double sd, max;         /* image tables: means over the trials; discrepancies: SD over the sets, mean of the
                               largest of 100 (of fewer sets: of all) */
    double converged;       /* image tables: the mean against the last reference of the plan */
    size_t trials;
    koksma_study_verdict verdict; /* of the mean */
} koksma_study_row;

/* Row i of the published table `id` ("5.1"), from what the store has; where several plans have one of that id, of the
   first that does. A table over several n has a row for each pattern and n. *found is false past the end. */
KOKSMA_API koksma_status koksma_study_table_row(koksma_study *study, const char *id, size_t i, koksma_study_row *row,
                                                bool *found);

/* ---- Images from elsewhere -------------------------------------------------------------------------------- */

enum { KOKSMA_IMAGES_GROUP = 256 };

/* The images that differ only in {trial}. */
typedef struct koksma_images_row {
    char group[KOKSMA_IMAGES_GROUP]; /* the other places' texts, "pattern=halton scene=ball"; may be empty */
    long long spp;                   /* the number at {spp}; 0 without it */
    size_t trials;
    double mean, low, high; /* mean over the trials of the mean absolute error, with its 95 % interval (NaN of one) */
    double sd, max, rmse;   /* means over the trials */
    double slope, slope_low, slope_high; /* of the group's mean in log-log over {spp}; NaN below 2 numbers */
    koksma_coherence_values coherence;   /* of the errors of all trials, in their order */
} koksma_images_row;

/* Compares all images whose paths fit `places`, such as "out_{spp}_{trial}.exr", with a reference: rows sorted by
   group and spp, which the caller frees. {spp} and {trial} take digits, other names any text without '/'. Every image
   is read twice, for its error and for the coherence of its row. Errors: ARGUMENT (a place that is not closed),
   MISSING (no such file), MALFORMED (a pixel that is not a finite number), what reading an image says, MEMORY. */
KOKSMA_API koksma_status koksma_study_images(const char *places, const char *reference, const koksma_run *run,
                                             koksma_images_row **rows, size_t *n);

/* ---- Ranking patterns for a scene ------------------------------------------------------------------------- */

enum { KOKSMA_MAX_RANK_TRIALS = 65536, KOKSMA_RANK_CHECKS = 2, KOKSMA_RANK_REASON = 256 };

typedef struct koksma_rank_options {
    const char *scene;           /* a name or a file */
    const char *const *patterns; /* as koksma_render_patterns takes them */
    size_t n_patterns;
    int spp;
    int width, height; /* of the picture; 0: the scene's, halved until it has 19,200 pixels at most */
    const koksma_integrator *integrator; /* NULL: distribution */
    const koksma_filter *filter;         /* NULL: box */
    double time_limit_s;                 /* 0: none. It cuts the sequence of work short and changes nothing else */
    long long max_trials;                /* of a pattern, 8 to KOKSMA_MAX_RANK_TRIALS; 0: 4096 */
    bool one_size;                       /* leave out the checks at half and twice the size */
} koksma_rank_options;

typedef enum koksma_rank_state {
    KOKSMA_RANK_RANKED,
    KOKSMA_RANK_TOO_SLOW, /* no interval in its share of the time limit */
    KOKSMA_RANK_REFUSED,  /* it cannot serve; `reason` says why */
} koksma_rank_state;

/* What is decided about a pattern and the pattern of row 0. */
typedef enum koksma_rank_decision {
    KOKSMA_RANK_UNDECIDED,
    KOKSMA_RANK_BEST,  /* row 0, once it is decided against all others */
    KOKSMA_RANK_EQUAL, /* to row 0, within 2 % */
    KOKSMA_RANK_WORSE, /* than row 0 */
} koksma_rank_decision;

/* One pattern of a ranking. Intervals are simultaneous: of all patterns, pairs and rounds of the ranking together 95
   % hold, and they include the reference's own error. NaN: none. */
typedef struct koksma_rank_row {
    size_t pattern;  /* index into the options' patterns */
    size_t position; /* 1 + the number of patterns that are decided to leave less error; 0: not ranked */
    koksma_rank_state state;
    koksma_rank_decision decision;
    long long trials;
    double mean, low, high; /* of the mean absolute error of the image, without what the reference's error adds */
    double behind, behind_low, behind_high; /* relative difference to the mean of row 0 */
    koksma_coherence_values coherence;      /* of the errors of its first 8 trials, however many it has; images is 0
                                               where it has fewer, and where it has no error */
    char reason[KOKSMA_RANK_REASON];        /* why it is not ranked; empty when it is */
} koksma_rank_row;

typedef enum koksma_rank_check_state {
    KOKSMA_RANK_UNCHECKED,  /* left out, not settled at the size itself, or the time was up */
    KOKSMA_RANK_CONFIRMED,  /* the checked pattern is the best there, or equal to the best within 2 % */
    KOKSMA_RANK_OVERTURNED, /* another pattern is decided to leave less error there */
    KOKSMA_RANK_UNSETTLED,  /* the trials were too few to decide */
} koksma_rank_check_state;

/* The first patterns, three at most, at another size: of those whose error is not coherent, or
   of all where every error is. */
typedef struct koksma_rank_check {
    int width, height;
    koksma_rank_check_state state;
    size_t pattern; /* of a row: OVERTURNED by this one, an index into the options' patterns */
    bool coherent;  /* the error of what is the best there is: of the checked one or, OVERTURNED, of `pattern` */
    double behind, behind_low, behind_high; /* OVERTURNED: of the checked pattern against that one */
    long long trials;
} koksma_rank_check;

typedef struct koksma_ranking {
    size_t n;                /* ranked patterns: rows 0 .. n - 1; the others follow */
    size_t n_slow;           /* of the others */
    bool settled;            /* the best pattern is decided: row 0 */
    bool complete;           /* every pair is decided */
    bool cut_short;          /* the time limit ended the work */
    long long trials;        /* of the pattern that has the most */
    long long needed_trials; /* not settled: of each pattern, about so many would decide; 0: not known, or no number
                                would, because the reference is too noisy */
    double needed_s;         /* and the time limit for them; 0: not known */
    int width, height;
    double reference_error; /* the reference's own expected mean absolute error; NaN: it was not finished */
    koksma_rank_check checks[KOKSMA_RANK_CHECKS]; /* at half and at twice the size */
    double seconds;
    bool advised;       /* of the patterns whose error is not coherent, it is decided which leaves the least */
    size_t advised_row; /* that one's row, where `advised` */
    size_t n_coherent;  /* ranked patterns whose error is coherent */
} koksma_ranking;

/* Renders the scene with every pattern, trial by trial, and ranks the patterns by the mean absolute error of the
   image.

   The sequence of work depends on the options alone, not on the machine: rounds of 8, 16, 32, ... trials until the
   best pattern is decided, further ones until the best of those is whose error is not coherent (image.h), the checks
   at half and twice the size, then further rounds until every pair is decided. A pair is decided after a round when
   the interval of the quotient of its errors excludes 1, or lies within 2 % of 1 (equal); a decision is not revoked.
   All decisions at a size hold together with 96 % probability, those of each check with 99.5 %. A time limit only
   cuts the sequence short: a longer one names the same best pattern, or one where there was none. A pattern whose
   first round takes more than its share of the time limit is put off until the others are decided, and no best
   pattern is named while one is left.

   rows has room for n_patterns. The trials of a pattern are independent of each other and of every other pattern's.
   Errors: UNKNOWN, MISSING, MALFORMED, ARGUMENT (no pattern can serve, or max_trials), MEMORY, INTERRUPTED. A time
   limit is no error, however short. */
KOKSMA_API koksma_status koksma_rank_patterns(const koksma_rank_options *options, const koksma_run *run,
                                              koksma_rank_row *rows, koksma_ranking *out);

#ifdef __cplusplus
}
#endif

#endif
