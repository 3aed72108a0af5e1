/* SPDX-License-Identifier: Apache-2.0 */
/* A study's plan: what to measure and render, and what published numbers and figures to show beside it. */
#ifndef KOKSMA_STUDY_PLAN_PLAN_H
#define KOKSMA_STUDY_PLAN_PLAN_H

#include <koksma/koksma.h>

#include <string.h>

typedef struct koksma__texts {
    size_t n;
    char **at;
} koksma__texts;

typedef struct koksma__wholes {
    size_t n;
    long long *at;
} koksma__wholes;

/* What a block with `skip` leaves out: numbers of points that a pattern does not have. */
typedef struct koksma__left_out {
    bool *is;            /* of each pattern and each of its sizes; NULL: nothing */
    koksma__texts lines; /* for the reader: a pattern, its sizes and the reason */
} koksma__left_out;

/* patterns x n x warps x measures x trials */
typedef struct koksma__discrepancy_block {
    char *id;               /* what questions call it; may be NULL */
    koksma__texts patterns; /* canonical specs */
    koksma__texts measures; /* likewise; behind them integrands, as koksma__integrand_of() knows them */
    koksma__texts warps;    /* names of maps of the square onto a domain; none: the square itself */
    koksma__wholes n;
    koksma__left_out left_out;
    int dim;
    long long trials;
} koksma__discrepancy_block;

/* How a reference image is made: the mean of `replicates` renders. Its own error is estimated from their spread, so
   that is known with 2 or more. */
typedef struct koksma__reference {
    char *name, *pattern;
    long long spp, replicates;
} koksma__reference;

/* scenes x patterns x spp x variants x trials, each compared with every reference */
typedef struct koksma__image_block {
    char *id;
    koksma__texts scenes, patterns;
    koksma__texts variants; /* canonical texts of the options; at least one, "" when the plan names none */
    koksma__wholes spp;
    koksma__left_out left_out;
    int width, height; /* 0: the scene's own */
    long long trials;
    size_t n_references;
    koksma__reference *references;
} koksma__image_block;

/* A number of a paper: NaN and "" where it prints none. */
typedef struct koksma__printed {
    double value, half_digit; /* half a unit of the last printed digit */
    char text[16];            /* as printed */
} koksma__printed;

enum { KOKSMA__TABLE_PRINTED = 8 };

/* A row of a published table: one pattern. */
typedef struct koksma__table_row {
    char *pattern, *label;
    size_t n_published;
    koksma__printed published[KOKSMA__TABLE_PRINTED]; /* mean, SD, max; of a table over several n: the means */
    double rate;                                      /* exponent of n that theory gives; NaN: none is known */
} koksma__table_row;

/* Why a published cell differs from ours. */
typedef struct koksma__note {
    char *pattern; /* NULL: the whole column */
    long long n;   /* of a table over several n: the column; 0: all */
    int statistic; /* 0 mean, 1 SD, 2 max */
    char *reason;
    bool explained; /* the reason is known; else it says what was tried */
} koksma__note;

typedef struct koksma__table {
    char *id, *title;
    size_t part;          /* whose table it is */
    char *scene;          /* an image table */
    char *measure, *also; /* a discrepancy table; `also`: shown beside it, NULL: none */
    koksma__wholes n;     /* numbers of points; several: n are the columns (discrepancy tables only) */
    long long dim;        /* of a discrepancy table */
    bool fitted;          /* the scene was fitted to the printed numbers: agreement with them confirms nothing */
    size_t images;        /* of an image table: the image block that makes all its rows */
    size_t n_rows, n_notes;
    koksma__table_row *rows;
    koksma__note *notes;
} koksma__table;

/* A figure: the points of a pattern, a rendered scene, or random lines. */
typedef struct koksma__figure {
    char *id, *title, *pattern, *scene;
    char *variant;        /* of a scene: variants.h */
    char *adaptive;       /* a method of adaptive sampling, or NULL */
    char *warp;           /* of points: the map that they are shown through, or NULL */
    char *printed;        /* what the paper's text says of it, shown beside ours; or NULL */
    long long n;          /* points, or samples per pixel */
    long long detail[4];  /* x, y, width and height of what is shown; width 0: all */
    long long strata[2];  /* the pixel whose strata are shown; -1: none */
    koksma__texts spaces; /* of strata: names of those that are shown; none: all */
    double exposure;      /* of a scene: the shown values are this times the image's */
    bool cells;           /* draw the cells or rows and columns in */
    bool lines, dual;     /* random lines; as points (slope, intercept) */
} koksma__figure;

/* Members of a question that its kind needs or takes; and whether it is asked by its name alone, not of a plan that
   asks nothing. A kind with none of the first two needs one of `discrepancies` and `images`. */
enum {
    KOKSMA__NEEDS_POINTS = 1, /* discrepancies */
    KOKSMA__NEEDS_IMAGES = 2, /* images */
    KOKSMA__TAKES_GROUPS = 4, /* groups */
    KOKSMA__ASKED_BY_NAME = 8
};

/* A kind of question that the report answers from blocks of the plan: a line of questions.def. */
typedef struct koksma__question_kind {
    const char *name;
    unsigned fields;
    const char *heading, *rows;
} koksma__question_kind;

/* All kinds; the name of the last is NULL (plan_questions.c). */
extern const koksma__question_kind koksma__question_kinds[];

/* Scenes of a question that share what dominates their error. */
typedef struct koksma__scene_group {
    char *title;
    koksma__texts scenes;
} koksma__scene_group;

typedef struct koksma__question {
    char *id, *title;
    size_t part; /* whose question it is */
    const koksma__question_kind *kind;
    char *discrepancies, *images; /* ids of blocks; NULL: none */
    size_t n_groups;
    koksma__scene_group *groups;
} koksma__question;

/* One of the plans that became one: its tables and questions speak of its own blocks, whatever others have. */
typedef struct koksma__plan_part {
    char *title;
    char *about, *order;     /* order: the overall order of the patterns, as printed; both may be NULL */
    bool asks;               /* it has tables or questions */
    size_t discrepancies[2]; /* indices of its blocks: the first, and one past the last */
    size_t images[2];
    size_t figures[2];
} koksma__plan_part;

typedef struct koksma__plan {
    char *name, *title, *about;
    char *order; /* of a plan just parsed; then its part's */
    size_t n_parts, n_discrepancies, n_images, n_tables, n_figures, n_questions;
    koksma__plan_part *parts;
    koksma__question *questions;
    koksma__discrepancy_block *discrepancies;
    koksma__image_block *images;
    koksma__table *tables;
    koksma__figure *figures;
} koksma__plan;

/* What a run may say about a plan's numbers of trials. */
typedef struct koksma__plan_trials {
    long long trials; /* > 0: instead of the plan's */
    bool quick;       /* each block's `quick`, where it has one */
} koksma__plan_trials;

/* Parses a plan; name is what errors call it ("plan 'my.json': line 3: …"). Checks every spec, so that a study does
   not fail in the middle. trials NULL: as the plan says. */
koksma_status koksma__plan_parse(const char *name, const char *text, size_t size, const koksma__plan_trials *trials,
                                 koksma__plan *plan);

/* The text of a plan that ships, or NULL. */
const char *koksma__plan_shipped(const char *name, size_t *size);

/* An integrand stands among the measures of a block, and in results, as "error of SPEC": its value is the absolute error
   of the mean over the points. Returns SPEC; NULL: the text is that of a measure. */
static inline const char *koksma__integrand_of(const char *measure)
{
    static const char head[] = "error of ";
    return strncmp(measure, head, sizeof head - 1) ? NULL : measure + sizeof head - 1;
}

/* Whether size k of `sizes` of pattern p is left out. */
static inline bool koksma__is_left_out(const koksma__left_out *of, size_t p, size_t sizes, size_t k)
{
    return of->is && of->is[p * sizes + k];
}

/* Whether the columns of a table are numbers of points. */
static inline bool koksma__table_is_over_n(const koksma__table *table)
{
    return table->n.n > 1;
}

#endif
