/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of curves: measures whose values are functions, such as spectra, and pictures. A curve computes its rows
 * and passes them one by one to a sink: `koksma curve` prints the rows, `koksma plot` draws two of their columns in a
 * chart (curves.c). A curve that is not a chart, such as the points themselves, has its own drawing function.
 */
#ifndef KOKSMA_CLI_CURVES_H
#define KOKSMA_CLI_CURVES_H

#include <koksma/plot.h>
#include <koksma/spectrum.h>

#include "cli.h"

enum { CLI_CURVE_COLUMNS = 5, CLI_MAX_PANELS = 64 };

typedef struct cli_curve cli_curve;

/* The option values of a run of `koksma curve` or `koksma plot`. */
typedef struct cli_curves {
    const cli_args *args;
    const cli_curve *curve;
    uint64_t seed, trials, half, bins;
    double r_max;
    koksma_spectrum_method method;
    cli_work work;
    size_t n_sets;        /* number of sets begun, for the progress line */
    const char *output;   /* the file of --output, or NULL */
    double width, height; /* size of the picture; 0: the default size */
    bool dark;
    const char *witness;     /* plot --witness: the measure, or NULL */
    const koksma_warp *warp; /* plot --warp, or NULL */
    koksma_plot_format format;
} cli_curves;

/* Receives the rows of one source. */
typedef struct cli_sink {
    double points; /* the number of points in each set; set before the first row */
    void (*row)(struct cli_sink *sink, const double *values);
} cli_sink;

struct cli_curve {
    const char *name;
    const char *meaning; /* a description for --help */
    const char *cite;    /* the source in the literature: keys of docs/references.bib, or "-" */
    /* Passes the rows of a source to the sink. Returns the exit code. After an interruption the rows cover the
       completed sets. */
    int (*compute)(cli_curves *c, const char *source, cli_sink *sink);
    const char *columns[CLI_CURVE_COLUMNS + 1]; /* keys of the numbers in a row, ended by NULL */
    struct {
        /* options of `koksma curve` that have an effect on this curve, separated by blanks; NULL: `koksma curve`
           cannot print it */
        const char *options;
        /* writes the file of --output, or NULL if the curve has no such file */
        koksma_status (*write)(cli_curves *c, const koksma_spectrum *spectrum);
    } print;
    struct {
        /* options of `koksma plot` that have an effect on this curve, separated by blanks; NULL: `koksma plot` cannot
           draw it */
        const char *options;
        int (*draw)(cli_curves *c);
        const char *title;             /* heading of a chart, unless --title gives another */
        const char *x_label, *y_label; /* labels of a chart's axes; x_per_root: x is divided by sqrt(n) */
        int y, error;                  /* indices of the columns of y and of its error; error 0: no error bars */
        bool x_per_root;
        double level;    /* the value that random points have, drawn as a dashed line; 0: none; NaN: -10 log10 T */
        bool of_filters; /* the operands are names of pixel filters */
        /* true: one chart may show a file, which is one set, and means over the sets of a pattern */
        bool mixes_files;
    } plot;
};

#define CURVE(name) extern const cli_curve cli_curve_##name;
#include "curves.def"
#undef CURVE

/* Selects the curves that `koksma curve` prints, or those that `koksma plot` draws. */
typedef enum cli_curve_list { CLI_PRINTED, CLI_DRAWN } cli_curve_list;

/* cli_curve_at returns curve i, or NULL past the end. cli_curve_find returns the curve of that name, or NULL if the
   list has none. */
const cli_curve *cli_curve_at(size_t i);
const cli_curve *cli_curve_find(cli_curve_list list, const char *name);
const char *cli_curve_options(const cli_curve *curve, cli_curve_list list); /* NULL: it is not in the list */

/* Writes the names of the curves in a list to `text` and returns it: all curves if `option` is NULL, otherwise those
   that take this option. `comma` is put between the names, and `last` before the last one. */
const char *cli_curve_names(cli_curve_list list, const char *option, const char *comma, const char *last, char *text,
                            size_t size);

/* Defines options of both `koksma curve` and `koksma plot`. list: "curve" or "chart", the first word of
   placeholders such as {curve:trials}, which cli/texts.c replaces by the names of the curves that take this option.
   default_half: the default of --half in the help text; errors: what the means over sets come with. */
#define CLI_CURVE_OPTIONS(list, default_half, errors)                                                                \
    {'s', "seed", "S", "seed of patterns (default: 0)"},                                                             \
        {'t', "trials", "T",                                                                                         \
         "{" list ":trials}: mean over T sets with seeds S, S+1, .. to 2^64 - 1 at most; " errors},                  \
        {0, "half", "H",                                                                                             \
         "{" list ":half}: use frequencies up to H in each coordinate (default: " default_half "; at most 2047)"},   \
        {0, "exact", NULL, "{" list ":exact}: sum over all points at each frequency instead of the fast transform"}, \
        {0, "r-max", "R", "{" list ":r-max}: use distances up to R (default: 4 / sqrt(n), at most 1/2)"},            \
    {                                                                                                                \
        0, "bins", "B", "{" list ":bins}: number of rings of distances (default: 100)"                               \
    }

enum { CLI_DEFAULT_HALF = KOKSMA_SPECTRUM_MAX_HALF / 2 - 1 }; /* the largest default of --half */

/* Reads CLI_CURVE_OPTIONS and CLI_RUN_OPTIONS. Returns false after an error, also for an option that has no effect on
   this curve. before: the text before a curve's name on the command line, for error messages. */
bool cli_curves_begin(const cli_args *args, const cli_curve *curve, cli_curve_list list, const char *before,
                      cli_curves *c);

/* Computes the mean spectrum over the trials. The spectrum has frequencies up to --half; without this option up to
   per_root sqrt(n), and at most CLI_DEFAULT_HALF. Returns the exit code. After a failure *out has the mean over the
   complete sets. The caller frees *out with koksma_spectrum_fini. */
int cli_curves_spectrum(cli_curves *c, const char *source, double per_root, koksma_spectrum *out);

/* Calls `add` for the points of each trial until it fails, for example because the points are not 2-dimensional.
   Returns the exit code. */
int cli_curves_each_set(cli_curves *c, const char *source,
                        koksma_status (*add)(cli_curves *c, const koksma_points *points, void *context),
                        void *context);

/* ---- Charts and panels of `koksma plot` (curves.c) ---------------------------------------------------- */

enum { CLI_CHART_LABEL = 160 };

/* Memory for the curves of a chart: for each curve three arrays of `per` numbers (xs, ys, errors) and a label. */
typedef struct cli_chart_store {
    koksma_curve *curves;
    double *numbers;
    char (*labels)[CLI_CHART_LABEL];
    size_t n, per;
} cli_chart_store;

/* Allocates a store for n curves. Returns false when memory runs out. */
bool cli_open_store(cli_chart_store *s, size_t n, size_t per);
void cli_close_store(cli_chart_store *s);

/* Returns the arrays of the next curve: xs begin at [0], ys at [per], errors at [2 per]. */
double *cli_next_numbers(const cli_chart_store *s);

/* Adds the next curve to the store, with the first n numbers of each of its arrays. */
void cli_push_curve(cli_chart_store *s, size_t n, size_t colour, const char *label);

/* Computes the rows of all operands and makes a chart of them, with the axes of `curve`. The caller must close the
   store, even after a failure. Returns the exit code. */
int cli_chart_open(cli_curves *c, const cli_curve *curve, cli_chart_store *s, koksma_chart *chart);

/* Draws the rows of all operands in one chart, with the axes of the curve c->curve. Returns the exit code. */
int cli_draw_chart(cli_curves *c);

/* The three functions below write a picture to the file --output, headed by --title or else by `title`, which may be
   NULL, and return the exit code. */
int cli_write_figure(const cli_curves *c, const char *title, const koksma_cell *cells, size_t n);
int cli_write_chart(const cli_curves *c, const char *title, const koksma_chart *chart);
int cli_draw_panels(const cli_curves *c, const char *title, const koksma_panel *panels, size_t n);

/* Writes the title of a source to `text` and returns it: "SPEC, n = N" for a pattern, followed by ", d = DIM" above 2
   dimensions; the path for a file. */
const char *cli_title(const char *source, char text[CLI_CHART_LABEL]);

/* Chooses the colours of all operands: numbers[i] is the colour of operand i. */
void cli_colours(const cli_curves *c, size_t numbers[CLI_MAX_PANELS]);

#endif
