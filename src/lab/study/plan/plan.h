/* SPDX-License-Identifier: Apache-2.0 */
/* A study's plan: what to measure and render, and which published numbers and figures to show beside the results. */
#ifndef KOKSMA_STUDY_PLAN_PLAN_H
#define KOKSMA_STUDY_PLAN_PLAN_H

#include <string.h>

#include <koksma/koksma.h>
#include <koksma/render.h>
#include <koksma/study.h>

/* A scene that the plan uses; `name` is its spelling in the plan. */
typedef struct koksma__study_scene {
    const char *name;
    koksma_scene *scene;
    char hash[24];
    int width, height;
    koksma_rank_renderer render; /* a function that calls another renderer, or NULL for this library's */
    void *render_context;
} koksma__study_scene;

/* The scenes that were opened, each once in whatever blocks plans name it; zeroed at first. */
typedef struct koksma__scene_files {
    void *tree;                 /* of tsearch(3) */
    uint64_t bytes, file_bytes; /* what all scenes take, and the files that they are from */
} koksma__scene_files;

/* Opens the scene of this name or path, which a plan names. All scenes may take 4 GiB together or, if that is more, 64
   times their files. Errors: those of koksma_scene_open; MALFORMED for more. */
koksma_status koksma__scene_files_open(koksma__scene_files *files, const char *name);

/* The open scene of this name; NULL if there is none. */
const koksma__study_scene *koksma__scene_files_find(const koksma__scene_files *files, const char *name);

void koksma__scene_files_fini(koksma__scene_files *files);

typedef struct koksma__texts {
    size_t n;
    char **at;
} koksma__texts;

typedef struct koksma__wholes {
    size_t n;
    long long *at;
} koksma__wholes;

/* The sizes that a block with `skip` leaves out: numbers of points that a pattern cannot make, or that a measure does not
   accept. Of any block, `lines` also names the sizes of which a family of files lacks some trials. */
typedef struct koksma__left_out {
    bool skip;           /* whether the block has `skip` */
    bool *is;            /* a flag for each pattern and size, true if left out, or NULL if no size is left out */
    bool *unmeasured;    /* the same for each measure and size */
    koksma__texts lines; /* messages: a pattern or measure, its sizes and the reason */
} koksma__left_out;

/* A block of discrepancies: every combination of patterns, n, warps, measures and trials. */
typedef struct koksma__discrepancy_block {
    char *id;               /* the name by which questions refer to the block, or NULL */
    koksma__texts patterns; /* canonical specs of patterns */
    /* canonical specs of measures, then integrands as "error of SPEC" (koksma__integrand_of) */
    koksma__texts measures;
    koksma__texts warps; /* names of maps from the square onto a domain; if empty, points stay in the square */
    koksma__wholes n;
    koksma__left_out left_out;
    int dim;
    long long trials;
} koksma__discrepancy_block;

/* Maximum number of trials of a block: larger trial numbers in a store are damage. */
enum { KOKSMA__MOST_TRIALS = 100000000 };

/* How a reference image is made: the mean of `replicates` renders. With 2 or more replicates, their spread gives an
   estimate of the reference's own error. */
typedef struct koksma__reference {
    char *name, *pattern;
    long long spp, replicates;
} koksma__reference;

/* A block of images: every combination of scenes, patterns, spp, variants and trials; each image is compared with
   every reference. */
typedef struct koksma__image_block {
    char *id;
    koksma__texts scenes, patterns;
    /* canonical texts of the variants (variants.h); a plan that names no options has one, which is "" */
    koksma__texts variants;
    koksma__wholes spp;
    koksma__left_out left_out;
    int width, height; /* size of the images; 0: the scene's size */
    long long trials;
    size_t n_references;
    koksma__reference *references;
    /* canonical specs of the metrics by which every image is compared with the last reference: the metrics that all
       studies evaluate, then those that the plan names */
    koksma__texts metrics;
} koksma__image_block;

/* Maximum number of metrics of a block. */
enum { KOKSMA__MOST_METRICS = 32 };

/* The metric that ranks patterns unless a plan names another. Every store has it, because it is the value of rows of
   kind "image". */
#define KOKSMA__DEFAULT_METRIC "mae"

/* A number printed in a paper; NaN and "" where the paper prints none. */
typedef struct koksma__printed {
    double value, half_digit; /* half_digit: half a unit of the last printed digit */
    char text[16];            /* the number as printed */
} koksma__printed;

enum { KOKSMA__TABLE_PRINTED = 8 };

/* A row of a published table: one pattern. */
typedef struct koksma__table_row {
    char *pattern, *label;
    size_t n_published;
    /* printed mean, SD and maximum; in a table over several n, the mean for each n */
    koksma__printed published[KOKSMA__TABLE_PRINTED];
    /* exponent of n that theory predicts for the row's pattern, and the factor by which its mean is then that of random
       points; NaN: unknown */
    double rate, of_random;
} koksma__table_row;

/* A note on why a published cell differs from the computed one. */
typedef struct koksma__note {
    char *pattern; /* pattern of the cell that differs, or NULL for all rows of the column */
    long long n;   /* in a table over several n: the n of the cell's column, or 0 for all columns */
    int statistic; /* the statistic that differs: 0 mean, 1 SD, 2 maximum */
    char *reason;
    /* whether `reason` explains the difference; otherwise it lists the explanations that were tried */
    bool explained;
    /* the printed numbers are no test: no means of trials, or of another procedure than ours, or our procedure was chosen
       by them; of all rows (pattern NULL): another procedure */
    bool untested;
} koksma__note;

typedef struct koksma__table {
    char *id, *title;
    char *symbol;         /* of the measure in the paper, such as T; or NULL */
    size_t part;          /* index of the part (of a joined plan) that has this table */
    char *scene;          /* scene of an image table; NULL: a discrepancy table */
    char *measure, *also; /* measures of a discrepancy table; `also` (or NULL) is shown beside `measure` */
    koksma__wholes n;     /* numbers of points; with several, each is a column (discrepancy tables only) */
    long long dim;        /* dimension, in a discrepancy table */
    /* whether the scene was fitted to the printed numbers, so that agreement with them confirms nothing */
    bool fitted;
    size_t images; /* in an image table: index of the image block that makes all its rows */
    size_t n_rows, n_notes;
    koksma__table_row *rows;
    koksma__note *notes;
} koksma__table;

/* A figure: the points of a pattern, a rendered scene, or random lines. */
typedef struct koksma__figure {
    char *id, *title, *pattern, *scene;
    char *variant;        /* options of a scene's render (variants.h) */
    char *adaptive;       /* adaptive sampling method, or NULL */
    char *warp;           /* map applied to points before they are drawn, or NULL */
    char *printed;        /* what the paper's text says about the figure, shown beside it; or NULL */
    long long n;          /* number of points, or samples per pixel */
    long long detail[4];  /* x, y, width and height of the part of the image that is shown; width 0: all of it */
    long long strata[2];  /* the pixel whose strata are shown; -1: none */
    koksma__texts spaces; /* names of the sample spaces whose strata are shown; if empty, all of them */
    double exposure;      /* in a figure of a scene: factor by which the image's values are multiplied */
    bool cells;           /* whether to draw the grid cells, or the rows and columns, of the pattern */
    bool lines, dual;     /* lines: show random lines; dual: show each as its point (slope, intercept) */
} koksma__figure;

/* Flags of a kind of question: which members it needs or takes. A kind with neither NEEDS_POINTS nor NEEDS_IMAGES
   needs `discrepancies` or `images`. */
enum {
    KOKSMA__NEEDS_POINTS = 1, /* the question needs `discrepancies` */
    KOKSMA__NEEDS_IMAGES = 2, /* the question needs `images` */
    KOKSMA__TAKES_GROUPS = 4  /* the question takes `groups` */
};

/* Flags of a kind of conclusion, beside the first two above: which further members it needs. */
enum {
    KOKSMA__NEEDS_TABLES = 16,
    KOKSMA__NEEDS_BY = 32,
    KOKSMA__NEEDS_AGAINST = 64,
    KOKSMA__NEEDS_METRIC = 128,
    KOKSMA__NEEDS_SIZES = 256, /* tables over several n; a pattern may lack a row in some of them */
    KOKSMA__NEEDS_FIGURES = 512
};

/* A kind of question that the report answers from blocks of the plan, or of conclusion: a line of questions.def, or of
   conclusions.def, which has no heading and rows. */
typedef struct koksma__plan_kind {
    const char *name;
    unsigned fields;
    const char *heading, *rows;
} koksma__plan_kind;

/* All kinds, each list ended by an entry whose name is NULL (plan_questions.c). */
extern const koksma__plan_kind koksma__question_kinds[], koksma__conclusion_kinds[];

/* Scenes of a question that have the same main source of error. */
typedef struct koksma__scene_group {
    char *title;
    koksma__texts scenes;
} koksma__scene_group;

typedef struct koksma__question {
    char *id, *title;
    size_t part; /* index of the part (of a joined plan) that has this question */
    const koksma__plan_kind *kind;
    char *discrepancies, *images; /* ids of the question's blocks; NULL: none */
    char *metric;                 /* canonical spec of the metric that ranks patterns; NULL: that of the plan */
    size_t n_groups;
    koksma__scene_group *groups;
} koksma__question;

/* What a paper concludes, and where its test is. studies/README.md has the meaning of the members by kind. */
typedef struct koksma__conclusion {
    size_t part;  /* index of the part (of a joined plan) that has this conclusion */
    char *says;   /* the conclusion in words */
    char *remark; /* words that follow the result, or NULL */
    const koksma__plan_kind *kind;
    koksma__texts tables, by, than, figures; /* ids; than: tables whose measures stand beside those of `by` */
    koksma__texts patterns, against, beside; /* canonical specs; beside: shown without a test */
    char *images, *discrepancies;            /* ids of blocks, or NULL */
    char *metric;                            /* canonical spec, or NULL */
} koksma__conclusion;

/* One of the plans that were joined into one. Its tables and questions refer only to its own blocks. */
typedef struct koksma__plan_part {
    char *title;
    char *about;             /* may be NULL */
    char *metric;            /* canonical spec of the metric that ranks patterns */
    bool asks;               /* whether the part's plan has tables or questions */
    size_t discrepancies[2]; /* indices of the part's blocks: the index of the first, and 1 + the index of the last */
    size_t images[2];
    size_t figures[2];
} koksma__plan_part;

typedef struct koksma__plan {
    char *name, *title, *about;
    char *metric;          /* that ranks the patterns; set while the plan is parsed and then moved to its part */
    koksma__texts metrics; /* further metrics that the plan names; used only while the plan is parsed */
    size_t n_parts, n_discrepancies, n_images, n_tables, n_figures, n_questions, n_conclusions;
    koksma__plan_part *parts;
    koksma__question *questions;
    koksma__conclusion *conclusions;
    koksma__discrepancy_block *discrepancies;
    koksma__image_block *images;
    koksma__table *tables;
    koksma__figure *figures;
} koksma__plan;

/* What all plans of a study ask for together, each within a limit (docs/files.md): a plan of kilobytes names any amount of
   work, and a store any number of plans. Zeroed at first. */
typedef struct koksma__plan_totals {
    koksma__scene_files scenes;
    long long work;  /* coordinates of the trials of sets (plan_sets.c) */
    uint64_t pairs;  /* patterns and measures x sizes, of all blocks */
    size_t variants; /* combinations of options, of all blocks of images */
} koksma__plan_totals;

/* Options of a run that change a plan's numbers of trials, and where the plan comes from. */
typedef struct koksma__plan_trials {
    long long trials; /* if > 0, replaces the plan's numbers of trials */
    bool quick;       /* whether blocks that have the member `quick` use its number of trials */
    /* the plan of a store, which an older version may have accepted: that a pattern or measure refuses a number of points
       is no error, so that the rows stay readable */
    bool stored;
    bool of_images;              /* whether the patterns of a table's rows and notes are those of images */
    koksma__plan_totals *totals; /* of the study; NULL: this plan is alone */
} koksma__plan_trials;

/* Among the measures of a block and of results, the text "error of SPEC" stands for an integrand: the value is the
   absolute error of its mean over the points. Returns SPEC, or NULL if the text is that of a measure. */
static inline const char *koksma__integrand_of(const char *measure)
{
    static const char head[] = "error of ";
    return strncmp(measure, head, sizeof head - 1) ? NULL : measure + sizeof head - 1;
}

/* Whether size number k is left out for pattern number p. sizes: the number of sizes of the block. */
static inline bool koksma__is_left_out(const koksma__left_out *of, size_t p, size_t sizes, size_t k)
{
    return of->is && of->is[p * sizes + k];
}

/* The same for measure number m. */
static inline bool koksma__is_unmeasured(const koksma__left_out *of, size_t m, size_t sizes, size_t k)
{
    return of->unmeasured && of->unmeasured[m * sizes + k];
}

/* Whether a table has several numbers of points, each of which is a column. */
static inline bool koksma__table_is_over_n(const koksma__table *table)
{
    return table->n.n > 1;
}

/* ---- Joining and freeing plans, and searching their lists -------------------------------------------------- */

/* Makes a newly read plan consist of one part, which gets the plan's title, text and all its blocks. Errors:
   MEMORY. */
koksma_status koksma__plan_own(koksma__plan *plan);

/* Moves everything in `from` to the end of `plan`, and joins the names as "a+b"; `from` is empty afterwards. */
koksma_status koksma__plan_append(koksma__plan *plan, koksma__plan *from);

/* Frees everything that a plan owns. */
void koksma__plan_fini(koksma__plan *plan);

/* Frees a list of texts. */
void koksma__texts_fini(koksma__texts *texts);

/* Appends a copy of the text. Errors: MEMORY. */
koksma_status koksma__texts_add(koksma__texts *texts, const char *text);

/* Whether a list contains a text, or a number; the sizes of blocks are sorted. */
bool koksma__texts_have(const koksma__texts *texts, const char *text);
bool koksma__wholes_have(const koksma__wholes *sorted, long long value);

/* The table and the figure of a part with this id, and the row of a table with this pattern; NULL: none. */
const koksma__table *koksma__plan_table_of(const koksma__plan *plan, size_t part, const char *id);
const koksma__figure *koksma__plan_figure_of(const koksma__plan *plan, size_t part, const char *id);
const koksma__table_row *koksma__plan_row_of(const koksma__table *table, const char *pattern);

/* Whether the block evaluates this measure on n points of this pattern in dim dimensions, without a warp. */
bool koksma__plan_block_makes(const koksma__discrepancy_block *block, const char *measure, const char *pattern,
                              long long n, long long dim);

/* Returns the position in a pattern's text, after `from`, at which the next path begins: after the colon of a pattern whose
   operand is a file, a program or a library, as in "exec:PATH" or in a group of uses, "jittered;lens=net-file:PATH". A
   plan's relative paths start at the folder of the plan.
     text  a pattern, or the patterns of several uses as koksma_render_patterns reads them. The text of a set of points has
           at most one path, the first: ';' and '=' may be part of its name
     from  number of characters to skip at the beginning of `text`
   Returns 0 if no path begins after `from`. */
size_t koksma__plan_path(const char *text, size_t from);

#endif
