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

/* Writes DIR/report.html: one file that needs no network. Errors: ARGUMENT (the study has no folder), IO. */
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
} koksma_images_row;

/* Compares all images whose paths fit `places`, such as "out_{spp}_{trial}.exr", with a reference: rows sorted by
   group and spp, which the caller frees. {spp} and {trial} take digits, other names any text without '/'. Errors:
   ARGUMENT (a place that is not closed), MISSING (no such file), MALFORMED (a pixel that is not a finite number),
   what reading an image says, MEMORY. */
KOKSMA_API koksma_status koksma_study_images(const char *places, const char *reference, const koksma_run *run,
                                             koksma_images_row **rows, size_t *n);

/* ---- Ranking patterns for a scene ------------------------------------------------------------------------- */

enum { KOKSMA_MAX_RANK_TRIALS = 65536 };

typedef struct koksma_rank_options {
    const char *scene;           /* a name or a file */
    const char *const *patterns; /* as koksma_render_patterns takes them */
    size_t n_patterns;
    int spp;
    int width, height;                   /* 0: the scene's, halved until a ranking fits into the time limit */
    const koksma_integrator *integrator; /* NULL: distribution */
    const koksma_filter *filter;         /* NULL: box */
    double time_limit_s;                 /* 0: until the ranking is clear, or max_trials */
    long long max_trials;                /* 8 to KOKSMA_MAX_RANK_TRIALS; 0: 4096 */
} koksma_rank_options;

/* One pattern of a ranking. */
typedef struct koksma_rank_row {
    size_t pattern;         /* index into the options' patterns */
    size_t place;           /* from 1; shared by those that can't be told apart from the first of them */
    double mean, low, high; /* of the mean absolute error of the image over the trials, with its 95 % interval */
    double behind, behind_low, behind_high; /* relative difference to the best's mean */
    char reason[256];                       /* not empty: why the pattern can't serve; it comes last, with place 0 */
} koksma_rank_row;

typedef struct koksma_ranking {
    size_t n; /* patterns in the ranking */
    long long trials;
    int width, height;      /* of the picture that was ranked by */
    double reference_error; /* the reference's own mean absolute error */
    bool clear;             /* every neighbours in the ranking are different, or equal to 2 % */
    bool cut_short;         /* not clear, and the time limit is why: else all max_trials were made */
    double seconds;
} koksma_ranking;

/* Renders the scene with every pattern, trial by trial, and ranks them by error. Stops when the ranking is clear:
   rounds of doubling numbers of trials, each judged with intervals of 99.5 %, because it is judged several times.
   The trials of a pattern are independent of each other and of every other pattern's. rows has room for n_patterns.
   Errors: UNKNOWN, MISSING, MALFORMED, ARGUMENT (no pattern can serve, or max_trials), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_rank(const koksma_rank_options *options, const koksma_run *run, koksma_rank_row *rows,
                                     koksma_ranking *out);

#ifdef __cplusplus
}
#endif

#endif
