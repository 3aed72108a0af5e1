/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Studies evaluate all combinations of patterns with measures, and of patterns with scenes, over many trials. The
 * results are in DIR/results.sqlite, the report in DIR/report.html. Part of libkoksma-lab. Long because studies, rankings
 * and searches of scenes share their patterns, references and reasons.
 *
 *     const char *plans[] = {"shirley1991"};
 *     const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = "out"};
 *     koksma_study *study;
 *     if (!koksma_study_open(&options, &study) && !koksma_study_run(study, NULL, NULL))
 *         koksma_study_report(study, NULL);
 *     koksma_study_close(study);
 *
 * A run may be interrupted at any time and in any way; the next run continues, because the database keeps finished
 * results. Results and report do not depend on the number of threads, processes or interruptions.
 */
#ifndef KOKSMA_STUDY_H
#define KOKSMA_STUDY_H

#include <koksma/koksma.h>
#include <koksma/optimise.h>
#include <koksma/render.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An open study. Only one thread at a time may use it. */
typedef struct koksma_study koksma_study;

/* Returns the name of plan i of the library, or NULL past the last plan. */
KOKSMA_API const char *koksma_plan_name_at(size_t i);

/* Tries whether a pattern has a set of n points in dim dimensions, as the reader of a plan does; the set is checked, but
   not generated. Of a family of files, such as file:my_{n}_{seed}.npy, the set with the smallest seed is tried.
   Errors: UNKNOWN, ARGUMENT, N, DIM and others of koksma_pattern_spec and koksma_generate; of a family of files MISSING if
   it has no file, and N if it has files, but none for this n. */
KOKSMA_API koksma_status koksma_plan_try(const char *pattern, size_t n, int dim);

/* Sets *out to question type i of those that a plan may contain, or to section i of the report; returns false past
   the last one. The title is the heading in the report. */
KOKSMA_API bool koksma_question_at(size_t i, koksma_entry *out);
KOKSMA_API bool koksma_report_section_at(size_t i, koksma_entry *out);

/* Returns the path of the module that links MPI (NULL: this build has no MPI). */
KOKSMA_API const char *koksma_study_mpi(void);

/* Returns the MPI rank of this process; 0 without mpirun. Ranks other than 0 open a study with folder NULL; their
   koksma_study_run executes jobs for rank 0 until all jobs are done. */
KOKSMA_API int koksma_study_mpi_rank(void);

/* Options of koksma_study_open. */
typedef struct koksma_study_options {
    /* names of plans in the library; paths of JSON files if the text has a '/' or ends in ".json"; or plans as JSON texts,
       which begin with '{' and then white space, '"' or '}', and whose relative paths start at the current folder. Several
       plans are joined to one plan with the name "a+b" */
    const char *const *plans;
    size_t n_plans;     /* number of plans; 0: use the plan stored in the folder, to which nothing is written before
                           a run. If its paths are relative, the current folder must be that of the run */
    const char *folder; /* folder of the study, which is created if it does not exist; NULL: the plan is
                           checked, and nothing can be run, or under MPI by the other ranks only */
    long long trials;   /* number of trials to use instead of the numbers in the plan; 0: use the numbers in the
                           plan */
    bool quick;         /* true: use the `quick` number of trials of each block of the plan that has one */
} koksma_study_options;

/* Opens or creates a study.
     out  receives the study, which koksma_study_close frees
   Errors: ARGUMENT (a plan is named twice), UNKNOWN, MISSING, MALFORMED (the message names file, line and reason), IO
   (the folder cannot be written, or another run uses it), MEMORY. */
KOKSMA_API koksma_status koksma_study_open(const koksma_study_options *options, koksma_study **out);

/* Writes results that are not yet on disk and frees the study, which may be NULL. Errors: IO (the study is freed
   nevertheless). */
KOKSMA_API koksma_status koksma_study_close(koksma_study *study);

/* Returns line i of the list of combinations without results, or NULL past the last line. First come the combinations
   that blocks of the plan with `skip` leave out, "PATTERN, N = 8, 32: reason" or "MEASURE, N = 8, 32: reason", and the
   numbers of points of which a family of files has fewer files than of others, "PATTERN, N = 16 (1 of 3 trials): reason";
   then the combinations whose jobs failed when they ran, "PATTERN, N = 64 (3 of 100 trials): reason". The string is
   valid until the study runs or is closed. */
KOKSMA_API const char *koksma_study_left_out_at(const koksma_study *study, size_t i);

/* Statistics of a run. */
typedef struct koksma_study_summary {
    size_t jobs, done_before, done_now; /* numbers of jobs: all, done before this run, done by this run. A job is
                                           one point set or one rendering */
    int workers;                        /* number of threads, or of MPI ranks */
    double seconds;                     /* elapsed time */
    double idle_seconds;                /* sum over the workers of the time that they waited for jobs */
    double processor_seconds;           /* processor time, summed over threads and ranks */
    double store_seconds;               /* part of processor_seconds spent in the database */
    bool complete;                      /* false if a time limit ended the run, or a job failed in a block without
                                           `skip` */
} koksma_study_summary;

/* Runs all jobs that are not done.
     run      a time limit ends the run early, without an error
     summary  may be NULL
   A job fails when its pattern finds no set or does not accept the number of points, which opening the study finds where
   that is quick, or when the search of its measure is cut short and finds only bounds.
   All other jobs are done, and koksma_study_left_out_at lists the failed ones.
   Each run and each report look at the files that patterns name anew. Which numbers of points such a pattern lacks is found
   when the study is opened.
   Errors: INTERRUPTED (finished jobs are kept), IMPOSSIBLE (jobs failed in a block without `skip`; the message names
   the first, and the report can be written. A run whose reference image fails ends at once), MISSING (a family of files,
   such as file:my_{n}_{seed}.npy, has no file: each run counts them anew, and a plan with a relative path has its files
   in the process's present directory), IO, and those of koksma_generate, koksma_evaluate and koksma_render. */
KOKSMA_API koksma_status koksma_study_run(koksma_study *study, const koksma_run *run, koksma_study_summary *summary);

/* Reads the list of koksma_study_left_out_at from a study's folder, as the last run wrote it.
     lines  receives one text, in which each line ends with a newline; empty if nothing is left out. The caller frees it
            with free()
   Errors: MISSING, MALFORMED, IO, MEMORY. */
KOKSMA_API koksma_status koksma_study_left_out(const char *folder, char **lines);

/* Formats of exported results. */
typedef enum koksma_export_format {
    KOKSMA_EXPORT_CSV,
    KOKSMA_EXPORT_JSON,
    KOKSMA_EXPORT_SHA256
} koksma_export_format;

/* Writes all results of a study, sorted by key; equal results give equal bytes, however they were computed. The
   function only reads the folder.
     format  CSV; JSON with one object per line; SHA256: one line with the hash of the CSV
     path    file to write; "-" is standard output
   Errors: ARGUMENT (the path leads to the study's results or their log, or into DIR/references), MISSING, MALFORMED (the
   folder has no results of a study, or they are damaged or edited), IO (also if a run is using the folder), MEMORY. */
KOKSMA_API koksma_status koksma_study_export(const char *folder, koksma_export_format format, const char *path);

/* Options of koksma_study_audit. The name of the folder has at most 1000 bytes, as in all functions on studies. */
typedef struct koksma_audit_options {
    const char *folder; /* folder of the study, which is only read */
    long long rows;     /* number of rows to draw at random, each with the same probability; 0: all */
    uint64_t seed; /* seed of the random draw; the bound holds only if nobody who could change the rows knew it */
    /* Called with a line of text for each difference, in which control characters and bytes that are not UTF-8 are
       escaped (koksma_text_escape), by one thread at a time; may be NULL. */
    void (*differs)(void *context, const char *text);
    void *context;
} koksma_audit_options;

/* The result of an audit. A row is a line that koksma_study_export writes. */
typedef struct koksma_audit {
    long long rows;         /* number of rows that the stored plan, the files of now and this version's revisions
                               (koksma_pattern.revision) make */
    long long other_rows;   /* number of all other rows, which are not compared */
    long long drawn, agree; /* number of rows drawn from `rows`; number of these whose recomputed values are equal
                               bit for bit */
    double bound;           /* upper 95 % confidence bound of the fraction of `rows` that is wrong (Clopper &
                               Pearson 1934); if all rows are drawn, the exact fraction */
    size_t references, references_agree; /* number of reference images rendered again; number of these that are
                                            equal */
    size_t references_missing;           /* number of reference images whose files are missing; only the hashes of
                                            their pixels were compared */
    size_t differences;                  /* number of differences found */
    /* Number of rows of this version that are not there, of trials before the last of their series. A run that is
       killed and a job that fails leave such gaps, and nothing tells them from rows that somebody removed: they are
       no differences. Rows that were removed behind the last trial leave none. */
    long long rows_missing;
} koksma_audit;

/* Audits a study: computes rows again by the plan in the store, renders all its reference images again, whichever rows
   are drawn, and compares them with the stored results. The choice of rows depends on the seed and the stored results,
   not on the number of threads. If the plan's paths are relative, the current folder must be that of the run. Under
   mpirun all ranks work and must be able to read the folder; rank 0 gets the result.
   Errors: ARGUMENT (rows below 0, or the folder's name is longer than 1000 bytes), MISSING, MALFORMED (the folder has
   no results of a study, or they are too damaged to read), IO, MEMORY, INTERRUPTED. A difference between stored and
   recomputed results is not an error. */
KOKSMA_API koksma_status koksma_study_audit(const koksma_audit_options *options, const koksma_run *run,
                                            koksma_audit *out);

/* Counts the jobs of a study.
     jobs    receives the number of all jobs
     undone  receives the number of those whose rows the folder lacks, without those that failed: a run ended before
             them, or made rows of other files, scenes or code. koksma_study_run does them
   Errors: ARGUMENT (the study has no folder), those of the store, MEMORY. */
KOKSMA_API koksma_status koksma_study_undone(koksma_study *study, size_t *jobs, size_t *undone);

/* Writes DIR/report.json, which has every number (docs/report-format.md), and DIR/report.html, a page with the same
   report in one file that needs no network. Errors: ARGUMENT (the study has no folder), MALFORMED (the
   results are damaged or edited), IO, MEMORY, INTERRUPTED (the files stay as they were). */
KOKSMA_API koksma_status koksma_study_report(koksma_study *study, const koksma_run *run);

/* Returns the id of published table i of the plan, such as "5.1", or NULL past the last table. The string is valid
   until the study is closed. */
KOKSMA_API const char *koksma_study_table_at(const koksma_study *study, size_t i);

/* Whether our mean agrees with the published one. */
typedef enum koksma_study_verdict {
    KOKSMA_VERDICT_NEW,       /* the paper has no number to compare with */
    KOKSMA_VERDICT_WAITING,   /* there are too few trials so far for a verdict */
    KOKSMA_VERDICT_AGREES,    /* the difference is explained by chance and rounding (|z| < 2.6), or for images at most
                                 25 % */
    KOKSMA_VERDICT_FITTED,    /* the difference is at most 25 %, but the scene was fitted to the published numbers */
    KOKSMA_VERDICT_EXPLAINED, /* the means differ for a known reason */
    KOKSMA_VERDICT_UNEXPLAINED, /* the means differ and the reason is unknown */
    KOKSMA_VERDICT_UNTESTED     /* a note says that the printed number is no test of ours, whatever it is */
} koksma_study_verdict;

/* Returns the word of a verdict, such as "agrees", or NULL for another value. */
KOKSMA_API const char *koksma_study_verdict_name(koksma_study_verdict verdict);

/* A row of a published table with our numbers. NaN marks a missing number. */
typedef struct koksma_study_row {
    const char *pattern, *label;
    long long n;            /* number of points, or of samples per pixel */
    double published[3];    /* published mean, standard deviation and maximum */
    double mean, low, high; /* our mean over the trials and its 95 % interval (NaN with one trial) */
    double sd, max;         /* in image tables: means over the trials of each image's standard deviation and
                               maximum. In discrepancy tables: standard deviation over the sets, and mean of the
                               largest values of blocks of 100 sets (with fewer sets, the largest value of all) */
    double converged;       /* in image tables: mean error against the last reference of the plan */
    size_t trials;
    koksma_study_verdict verdict; /* verdict on the mean */
} koksma_study_row;

/* Computes row i of a published table from the results so far. A table over several numbers of points n has one row
   for each pattern and n.
     id     id of the table, such as "5.1"; if several plans have this id, the table of the first plan
     found  receives false past the last row
   Errors: UNKNOWN (id), IO, MEMORY. */
KOKSMA_API koksma_status koksma_study_table_row(koksma_study *study, const char *id, size_t i, koksma_study_row *row,
                                                bool *found);

/* ---- Ranking patterns for a scene ------------------------------------------------------------------------- */

enum { KOKSMA_MAX_RANK_TRIALS = 65536, KOKSMA_RANK_CHECKS = 2, KOKSMA_RANK_REASON = 256 };

/* An image that a ranking requests from an external renderer. */
typedef struct koksma_rank_picture {
    const char *scene, *pattern; /* texts from koksma_rank_options, which the external renderer interprets */
    int spp;
    int width, height; /* size of the image; 0: the default size of the renderer */
    uint64_t seed;     /* 0 to 2^31 - 1. Images of different seeds must be independent, images of equal seeds
                          equal */
} koksma_rank_picture;

/* The function of an external renderer: allocates *image and sets it to linear light. Up to run->threads threads
   may call it at once. An error MEMORY, IO, SYSTEM or INTERRUPTED ends the ranking; any other error removes the
   pattern from the ranking. */
typedef koksma_status (*koksma_rank_renderer)(void *context, const koksma_rank_picture *picture,
                                              const koksma_run *run, koksma_image *image);

/* Renders by a command line: `context` is a text (const char *) that /bin/sh runs for every image, after quoted
   texts replace {scene}, {pattern}, {spp}, {seed}, {width}, {height} and {out}. {out} is the name of the file to
   write, which ends in .exr; {out.pfm} and {out.png} are names with other endings. The command runs in the current
   folder; its output files are in a temporary folder below $TMPDIR or /tmp, which is removed afterwards. To cancel
   the command, the function sends a signal to its process group.
   Errors: ARGUMENT (unknown words in braces, no {out}), IMPOSSIBLE (the command fails or writes no readable image;
   the message has the last line that it printed), SYSTEM, INTERRUPTED. */
KOKSMA_API koksma_status koksma_rank_by_command(void *context, const koksma_rank_picture *picture,
                                                const koksma_run *run, koksma_image *image);

/* A function that processes the image of a trial, such as a denoiser: allocates *out, of the same size. Up to run->threads
   threads may call it at once. Errors are as those of a koksma_rank_renderer. */
typedef koksma_status (*koksma_rank_process)(void *context, const koksma_image *image, const koksma_run *run,
                                             koksma_image *out);

/* Processes by a command line as koksma_rank_by_command renders by one: {in} is the EXR file of the image, {out} the one to
   write; {in.pfm}, {in.png}, {out.pfm} and {out.png} are files of other formats. Errors: as koksma_rank_by_command. */
KOKSMA_API koksma_status koksma_rank_process_by_command(void *context, const koksma_image *image,
                                                        const koksma_run *run, koksma_image *out);

/* Gets, at most once and in the caller's thread, the error of each pattern of koksma_rank_patterns before the first
   reference is rendered: the root of half the mean squared difference in luminance of two independent images, which is the
   root mean square error without its bias. NaN: not known, as of patterns that are slow or not known to be unbiased, or
   whose images are equal. */
typedef void (*koksma_rank_look)(void *context, const double *errors);

/* Gets, in the caller's thread, what looks like a mistake in a given reference or in what options->process makes of a
   picture, as one line: light times a factor, another scene, or an error that each pattern has in all its pictures, as from
   noise of the reference. */
typedef void (*koksma_rank_doubt)(void *context, const char *line);

/* Options of koksma_rank_patterns. */
typedef struct koksma_rank_options {
    const char *scene;           /* as for koksma_scene_open */
    const char *const *patterns; /* as koksma_render_patterns takes them */
    size_t n_patterns;
    int spp;
    int width, height;                   /* size of the image; 0: the size in the scene, halved until the image has
                                            at most 19,200 pixels */
    const koksma_integrator *integrator; /* NULL: as koksma_render_options_init chooses it for the scene */
    const koksma_filter *filter;         /* NULL: box */
    const char *adaptive;                /* method of adaptive sampling for the images of all patterns, as
                                            koksma_adaptive_parse takes it, with spp as its budget and a quarter of it
                                            in the first round (NULL: spp samples in every pixel). A method that places
                                            its own samples takes one pattern. The reference is never adaptive */
    const koksma_metric_spec *metric;    /* metric of the image error by which patterns are ranked (NULL: mae) */
    double time_limit_s;                 /* time limit in seconds; 0: none. The limit ends the work early and changes
                                            nothing else */
    long long max_trials;        /* largest number of trials per pattern, 8 to KOKSMA_MAX_RANK_TRIALS; 0: 4096 */
    bool one_size;               /* true: leave out the checks at half and twice the image size */
    koksma_rank_renderer render; /* external renderer for all images (NULL: render with this library). For an
                                    external renderer scene and patterns may be any texts, integrator and filter are
                                    not used, and width 0 means the size of the first image, without checks at other
                                    sizes */
    void *render_context;
    const char *reference; /* for an external renderer: pattern of the reference image. Its images must be unbiased
                              and depend on the seed (NULL: the first pattern) */
    const koksma_image
        *reference_image; /* a finished reference, taken as exact: linear light of the size of the images,
                                            which has no checks at other sizes (NULL: references are rendered) */
    koksma_rank_process
        process; /* processes the images of the trials, not those of the reference (NULL: nothing does) */
    void *process_context;
    uint64_t seed; /* key of the random numbers of all images: rankings with different seeds are independent */
    /* further settings of the images, as the options of a study's plan: "scope=image;lights=one;depth=4" (NULL: defaults).
       Unused with an external renderer */
    const char *variant;
    /* a first look at the errors (NULL: none). There is none with an external renderer, a method of adaptive sampling, a
       process or a finished reference, nor of images that together exceed 256 MiB. It changes no result */
    koksma_rank_look look;
    void *look_context;
    koksma_rank_doubt doubt; /* told at most once (NULL: nobody is). It changes no result */
    void *doubt_context;
} koksma_rank_options;

/* Whether a pattern was ranked. */
typedef enum koksma_rank_state {
    KOKSMA_RANK_RANKED,
    KOKSMA_RANK_TOO_SLOW, /* the pattern was too slow for its share of the time limit */
    KOKSMA_RANK_REFUSED,  /* the pattern cannot render this scene with these options; `reason` says why */
} koksma_rank_state;

/* The decision about a pattern in comparison with the pattern of row 0. */
typedef enum koksma_rank_decision {
    KOKSMA_RANK_UNDECIDED,
    KOKSMA_RANK_BEST,  /* the pattern is in row 0, and decided to be better than or equal to all others */
    KOKSMA_RANK_EQUAL, /* the error of the pattern equals that of row 0 within 2 % */
    KOKSMA_RANK_WORSE, /* the error of the pattern is larger than that of row 0 */
} koksma_rank_decision;

/* One pattern of a ranking. Intervals are simultaneous: with 95 % probability those of all means contain the true value,
   and so do those of all relative differences. The intervals include the error of the reference. NaN marks a missing
   number; an interval that is not known is NaN at both ends. */
typedef struct koksma_rank_row {
    size_t pattern;  /* index of the pattern in koksma_rank_options.patterns */
    size_t position; /* 1 + the number of patterns that are decided to have less error; 0: not ranked */
    koksma_rank_state state;
    koksma_rank_decision decision;
    bool
        biased; /* a use has a pattern that is not known to be unbiased (koksma_is_unbiased), or an adaptive method took
                    the samples; false for patterns of another renderer, of which nothing is known */
    long long trials;
    double mean, low, high; /* mean over the trials of the metric, corrected for the error of the reference, and its
                               interval */
    double robust;          /* mean of the metric without the 0.1 % of pixels with the largest error
                               (koksma_metric_value); not corrected */
    double top_share;       /* mean over the trials of the fraction of the error in these 0.1 % of pixels */
    double behind, behind_low, behind_high; /* relative difference of the mean to that of row 0, and its interval */
    koksma_coherence_values coherence;      /* coherence of the errors of the first 8 trials; `images` is 0 with
                                               fewer trials, or if there is no error */
    char reason[KOKSMA_RANK_REASON];        /* the reason why the pattern is not ranked; empty if it is ranked */
} koksma_rank_row;

/* The outcome of checking the best pattern of a ranking at another image size. */
typedef enum koksma_rank_check_state {
    KOKSMA_RANK_UNCHECKED,  /* no check was made: it was left out, no pattern was decided to be best, or the time
                               limit ended the work */
    KOKSMA_RANK_CONFIRMED,  /* the checked pattern is the best, or equal to the best within 2 % */
    KOKSMA_RANK_OVERTURNED, /* another pattern is decided to have less error than the checked one */
    KOKSMA_RANK_UNSETTLED,  /* there were too few trials to decide */
    KOKSMA_RANK_FAILED,     /* there are no pictures of this size, as of another renderer that has one size */
} koksma_rank_check_state;

/* The result of checking whether a pattern is also the best at another image size. */
typedef struct koksma_rank_check_result {
    koksma_rank_check_state state;
    size_t pattern; /* if OVERTURNED: the better pattern, an index into koksma_rank_options.patterns */
    bool coherent;  /* whether the error of the best pattern at this size is coherent */
    double behind, behind_low, behind_high; /* if OVERTURNED: relative difference of the error of the checked
                                               pattern to that of the better one, and its interval */
} koksma_rank_check_result;

/* A check whether the best patterns are also the best at another image size. It compares the first three patterns
   among those whose error is not coherent, and the first three of all patterns. */
typedef struct koksma_rank_check {
    int width, height;
    koksma_rank_check_result advice; /* result for the advised pattern among those whose error is not coherent at
                                        the requested size; if every error is coherent, equal to `first` */
    koksma_rank_check_result first;  /* result for the pattern with the least error, row 0, among all patterns */
    long long trials;
} koksma_rank_check;

/* A pattern whose error surely exceeds that of the best by no more than this part may be used as well. */
#define KOKSMA_RANK_TIE 0.05

/* The result of a ranking. */
typedef struct koksma_ranking {
    size_t n;         /* number of ranked patterns, which are in rows 0 .. n - 1; the other patterns follow */
    size_t n_slow;    /* number of patterns that were too slow */
    bool settled;     /* true: it is decided that the pattern in row 0 is the best of the n ranked ones */
    bool complete;    /* true: every pair of patterns is decided */
    bool cut_short;   /* true: the time limit ended the work */
    long long trials; /* largest number of trials of one pattern */
    /* if not settled: approximate number of trials of each pattern that would decide which is the best; 0: unknown */
    long long needed_trials;
    bool undecidable; /* true: not settled, and by the spread of 256 trials or more not even KOKSMA_MAX_RANK_TRIALS
                         would decide which is the best: the reference is too noisy, or the difference too small */
    double needed_s;  /* seconds that needed_trials would take; 0: unknown */
    int width, height;
    double
        reference_error; /* expected mean absolute error of the last reference (NaN: none was finished, or it was given) */
    koksma_rank_check checks[KOKSMA_RANK_CHECKS]; /* checks at half and at twice the image size */
    double seconds;
    bool advised;       /* true: it is decided which pattern has the least error among those whose error is not
                           coherent */
    size_t advised_row; /* row of that pattern, if `advised` is true */
    size_t n_coherent;  /* number of ranked patterns whose error is coherent */
    size_t
        use_row; /* row of the pattern to use, among those whose error is not coherent, or among all if every error is: the
                    advised one; if there is none, that of the smallest `within`, if this is at most KOKSMA_RANK_TIE; else
                    that with the least error so far */
    /* the most by which the error of the pattern to use exceeds that of any other ranked pattern (without coherent error,
       if its own is not), relative to that error: the largest bound of the intervals of these, which hold together.
       Up to KOKSMA_RANK_TIE it decides which pattern to use although it may not be `settled` which is the best. Infinite:
       not known */
    double within;
    /* true: the errors leave open which pattern to use, but those without the 0.1 % of pixels that err most (`robust` of
       the rows) do not: `use_row` and `within` are of these */
    bool without_few;
    /* how many samples of the pattern random leave as much error as spp samples of the pattern to use, because the error
       of random falls as n^-1/2; with an interval, NaN at both ends if it is not known. NaN: random is not ranked, or the
       metric follows no power law */
    double random_spp, random_spp_low, random_spp_high;
} koksma_ranking;

/* Renders the scene with every pattern, trial by trial, and ranks the patterns by the error of the image: the
   mean over the trials of options->metric, by default the mean absolute error in luminance.

   The sequence of work depends on the options, not on the machine. It has four parts: rounds of 8, 12, 16, 24,
   32, ... trials until the best pattern is decided; further rounds until the best pattern among those whose error is not
   coherent (image.h) is decided; checks of these two patterns at half and twice the image size; further rounds
   until every pair of patterns is decided. A pair is decided after a round if the confidence interval of the ratio
   of its errors excludes 1, or lies within 2 % of 1 (equal). Decisions are final. With 96 % probability all
   decisions at the requested size are correct, and with 99.5 % probability all decisions of a check. A time limit
   ends this sequence early. A longer limit gives the same best pattern, or a best pattern where a shorter limit
   gave none. A pattern whose first round exceeds its part of the time limit is postponed until the other patterns
   are decided; if the limit ends the work before that round is complete, it has no part in the decisions. The trials are
   compared with the mean of 16 independent images, each of spp samples, at least 16; from 24 trials of a pattern on each
   has 4 times as many samples, and from 96 trials 16 times as many. All intervals include the error of these references.
   The trials of a
   pattern are independent of each other and of the trials of other patterns.
     rows  receives options->n_patterns rows
   A pattern that has no set of spp points is not ranked, and its row says why. A pattern whose file is missing or
   malformed, or whose program may not run, is an error before anything is rendered.
   Errors: UNKNOWN, MISSING, MALFORMED, FORBIDDEN (koksma_allow_exec was not called), ARGUMENT (no pattern can render
   this scene, or max_trials is out of range), MEMORY, INTERRUPTED. A time limit is not an error. */
KOKSMA_API koksma_status koksma_rank_patterns(const koksma_rank_options *options, const koksma_run *run,
                                              koksma_rank_row *rows, koksma_ranking *out);

/* What koksma_rank_to_error knows of a pattern. */
typedef enum koksma_target_state {
    KOKSMA_TARGET_CHECKED,      /* spp samples were found, and their error was measured by images of other seeds */
    KOKSMA_TARGET_EXTRAPOLATED, /* the target was not reached; `needed` follows from the rate of the errors */
    KOKSMA_TARGET_UNKNOWN,      /* the target was not reached, and the errors have no rate that leads there */
    KOKSMA_TARGET_REFUSED,      /* the pattern cannot render this scene with these options; `reason` says why */
} koksma_target_state;

/* How many samples a pattern needs for an error. NaN marks a missing number. */
typedef struct koksma_target_row {
    size_t pattern; /* index into koksma_rank_options.patterns */
    koksma_target_state state;
    int spp; /* CHECKED: the samples per pixel, a number that the pattern can make; else 0 */
    double error, low,
        high; /* CHECKED: mean error of images of spp samples, corrected for the error of the reference,
                                and its 95 % interval; else the error at the largest number that was measured */
    double needed, needed_low,
        needed_high; /* samples at which the mean error is the target by the rate, with its 95 %
                                               interval: from that of the error, or if EXTRAPOLATED from that of the rate */
    double rate,
        rate_error;   /* slope of log error against log samples over the last levels, and its standard error (NaN
                                with fewer than three levels) */
    bool coherent;    /* the errors of the last images have bands or another pattern (koksma_coherence_values) */
    long long trials; /* number of images */
    char reason[KOKSMA_RANK_REASON]; /* if REFUSED, or UNKNOWN because the pattern makes no larger numbers */
} koksma_target_row;

typedef struct koksma_target_ranking {
    int width, height; /* size of the images */
    bool cut_short;    /* true: the time limit ended the work */
    double seconds;
} koksma_target_ranking;

/* Finds how many samples per pixel of each pattern leave the error `target` in the scene. Measures the errors of 1, 4,
   16, ... samples, or of the next numbers that the pattern can make, until one is at most the target; narrows the number by
   the power law of the errors; and measures the error of the number found by 8 images of fresh seeds, with an interval.
   Equal options give equal results on any number of threads, unless the time limit ends the work; no pattern changes the
   numbers of another.
     options  as for koksma_rank_patterns; spp, max_trials and one_size are not used
     target   error by options->metric, above 0
     rows     receives options->n_patterns rows, fewest samples first
   Errors: those of koksma_rank_patterns; ARGUMENT (target). A time limit is not an error. */
KOKSMA_API koksma_status koksma_rank_to_error(const koksma_rank_options *options, double target,
                                              const koksma_run *run, koksma_target_row *rows,
                                              koksma_target_ranking *out);

#ifdef __cplusplus
}
#endif

#endif
