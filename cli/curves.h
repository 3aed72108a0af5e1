/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of curves: measures that are functions, and pictures. A curve is computed row by row into a sink: `curve`
 * prints the rows, `plot` draws two of their columns in a chart (charts.h). A picture that is no chart draws itself.
 */
#ifndef KOKSMA_CLI_CURVES_H
#define KOKSMA_CLI_CURVES_H

#include <koksma/plot.h>
#include <koksma/spectrum.h>

#include "cli.h"

enum { CLI_CURVE_COLUMNS = 4, CLI_MAX_PANELS = 16 };

typedef struct cli_curve cli_curve;

/* A run of `curve` or `plot`: what its options say. */
typedef struct cli_curves {
    const cli_arguments *arguments;
    const cli_curve *curve;
    uint64_t seed, trials, half, bins;
    double r_max;
    koksma_spectrum_method method;
    cli_work work;
    const char *output;   /* a file; NULL: none */
    double width, height; /* of a picture; 0: the default */
    bool dark;
    const char *witness;     /* plot: a measure; NULL: none */
    const koksma_warp *warp; /* plot: NULL: none */
    koksma_plot_format format;
} cli_curves;

/* Takes the rows of one source. */
typedef struct cli_sink {
    double points; /* in each set; known before the first row */
    void (*row)(struct cli_sink *sink, const double *values);
} cli_sink;

struct cli_curve {
    const char *name;
    const char *meaning; /* what it is, for --help */
    const char *cite;    /* keys of docs/references.bib, or "-" */
    /* The rows of a source into the sink; the exit code. What was computed before an interruption is in the rows too.
     */
    int (*compute)(cli_curves *c, const char *source, cli_sink *sink);
    const char *columns[CLI_CURVE_COLUMNS + 1]; /* keys of a row's numbers, ended by NULL */
    struct {
        const char *options; /* of `curve`: those that have an effect, with blanks between; NULL: it isn't printed */
        koksma_status (*write)(cli_curves *c, const koksma_spectrum *spectrum); /* --output; NULL: there is none */
    } print;
    struct {
        const char *options; /* of `plot`: likewise; NULL: it isn't drawn */
        int (*draw)(cli_curves *c);
        const char *title;             /* of a chart, unless --title says another */
        const char *x_label, *y_label; /* of a chart: its axes, its columns, and whether x is divided by sqrt(n) */
        int y, error;                  /* error 0: there are no error bars */
        bool x_per_root;
        double (*level)(const cli_curves *c); /* where random points are, dashed */
        bool of_filters;                      /* the operands are names of pixel filters */
        bool mixes_files;                     /* a file, which is one set, may stand beside means of patterns */
    } plot;
};

#define CURVE(name) extern const cli_curve cli_curve_##name;
#include "curves.def"
#undef CURVE

/* What takes a list of curves: those that are printed, or those that are drawn. */
typedef enum cli_curve_list { CLI_PRINTED, CLI_DRAWN } cli_curve_list;

/* Curve i, NULL past the end; by name, NULL where the list has none of this name. */
const cli_curve *cli_curve_at(size_t i);
const cli_curve *cli_curve_find(cli_curve_list list, const char *name);

/* The names in a list, of all curves or of those that take an option (else NULL), with `comma` between and `last`
   before the last one. Returns text. */
const char *cli_curve_names(cli_curve_list list, const char *option, const char *comma, const char *last, char *text,
                            size_t size);

/* Options of both commands. list: "curve" or "chart", as cli/texts.c has it; a file's word before trials. */
#define CLI_CURVE_OPTIONS(list, default_half)                                                                        \
    {'s', "seed", "S", "seed of patterns (default: 0)"},                                                             \
        {'t', "trials", "T", "{" list ":trials}: the mean over T sets with seeds S, S+1, .., with standard errors"}, \
        {0, "half", "H",                                                                                             \
         "{" list ":half}: frequencies up to H in each coordinate (default: " default_half "; at most 2047)"},       \
        {0, "exact", NULL, "{" list ":exact}: sum over all points at each frequency instead of the fast transform"}, \
        {0, "r-max", "R", "{" list ":r-max}: distances up to R (default: 4 / sqrt(n), at most 1/2)"},                \
    {                                                                                                                \
        0, "bins", "B", "{" list ":bins}: rings of distances (default: 100)"                                         \
    }

enum { CLI_DEFAULT_HALF = KOKSMA_SPECTRUM_MAX_HALF / 2 - 1 }; /* the most that nobody asked for */

/* Reads CLI_CURVE_OPTIONS and CLI_RUN_OPTIONS; false after an error, also for an option that this curve has no use
   for. before: the text before a curve's name on the command line. */
bool cli_curves_begin(const cli_arguments *arguments, const cli_curve *curve, cli_curve_list list, const char *before,
                      cli_curves *c);

/* The mean spectrum over the trials, of frequencies up to per_root sqrt(n), at most CLI_DEFAULT_HALF, where --half
   doesn't say. Returns the exit code; what was done until then is in out, which the caller ends with
   koksma_spectrum_fini. */
int cli_curves_spectrum(cli_curves *c, const char *source, double per_root, koksma_spectrum *out);

/* Calls add for the points of each trial; a set that is not of the plane ends it. Returns the exit code. */
int cli_curves_each_set(cli_curves *c, const char *source,
                        koksma_status (*add)(cli_curves *c, const koksma_points *points, void *context),
                        void *context);

#endif
