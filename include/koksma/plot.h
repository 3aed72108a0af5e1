/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Pictures of point sets, power spectra and curves as SVG, PDF or PNG in memory. Part of libkoksma-lab.
 *
 *     unsigned char *bytes;
 *     size_t size;
 *     if (!koksma_plot_scatter(&points, NULL, KOKSMA_PLOT_SVG, &bytes, &size)) {
 *         koksma_plot_write("points.svg", bytes, size);
 *         free(bytes);
 *     }
 *
 * Every plot function allocates the file's bytes, which the caller frees with free(). The bytes are the same on every
 * run and in every call. SVG has its texts as text and no ids; PDF and PNG are drawn by cairo. Errors of all of them:
 * ARGUMENT, UNSUPPORTED (PDF and PNG: this build lacks cairo), MEMORY, SYSTEM (cairo failed).
 */
#ifndef KOKSMA_PLOT_H
#define KOKSMA_PLOT_H

#include <koksma/koksma.h>
#include <koksma/spectrum.h>
#include <koksma/warp.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum koksma_plot_format { KOKSMA_PLOT_SVG, KOKSMA_PLOT_PDF, KOKSMA_PLOT_PNG } koksma_plot_format;

/* A size is 0, for the default, or KOKSMA_PLOT_MIN_SIZE to KOKSMA_PLOT_MAX_SIZE: points in SVG and PDF, pixels in
   PNG. */
enum { KOKSMA_PLOT_MIN_SIZE = 16, KOKSMA_PLOT_MAX_SIZE = 32767, KOKSMA_PLOT_MAX_CELLS = 65536 };

/* Points of more dimensions are drawn as their projections on all pairs of the first so many. */
enum { KOKSMA_PLOT_MAX_DIM = 8 };

/* How a scatter plot looks. All zero is a plain plot. */
typedef struct koksma_scatter_options {
    double size;             /* side of the picture; 0: 320 */
    size_t columns, rows;    /* draw guide lines of that many cells, 0 (none) to KOKSMA_PLOT_MAX_CELLS */
    bool local_discrepancy;  /* colour the background by koksma_local_discrepancy: orange where the box from the
                                origin has too many points, blue where too few; white is 0, full colour the largest
                                value on a grid. Not together with warp */
    const koksma_warp *warp; /* draw points and guide lines mapped by this warp, hemispheres seen from above; NULL:
                                not mapped. Points of 2 dimensions, not together with witness */
    const koksma_witness *witness; /* draw this box, line or disk; of more dimensions the box's projections. May be
                                      NULL */
    const char *caption;           /* a line below the picture; may be NULL */
} koksma_scatter_options;

/* Returns the library that draws PDF and PNG, such as "cairo 1.16.0"; NULL: there is none, and these are UNSUPPORTED.
 */
KOKSMA_API const char *koksma_plot_library(void);

/* Finds the format that the ending of a path names: .svg, .pdf or .png. Errors: ARGUMENT (another ending). */
KOKSMA_API koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format);

/* Draws points of 2 dimensions in the unit square, y upwards, and of more as a scatter matrix: the projections on all
   pairs of the first KOKSMA_PLOT_MAX_DIM axes.
     options  may be NULL
   Errors: ARGUMENT (a size, format or number of cells out of range, no points, a coordinate outside [0,1]), DIM (one
   dimension), and those above. */
KOKSMA_API koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                             koksma_plot_format format, unsigned char **bytes, size_t *size);

/* A square picture: points, or a power spectrum. */
typedef struct koksma_panel {
    const koksma_points *points; /* NULL: draw the spectrum */
    koksma_scatter_options scatter;
    const koksma_spectrum *spectrum; /* drawn with frequency (0, 0) in the middle, which is left out; black is 0 */
    double white;                    /* the power that is white; 0: 2, so that random points are mid-grey */
    const char *caption;             /* below; may be NULL */
    const char *title;               /* above; may be NULL */
    size_t swatch;                   /* 1 + the number of a colour, shown beside the title; 0: none */
} koksma_panel;

/* Draws n panels in a row; spectra have a scale.
     size  side of a panel; 0: 320, more for points of more than 3 dimensions
   Errors: those of koksma_plot_scatter; ARGUMENT also for no panels. */
KOKSMA_API koksma_status koksma_plot_panels(const koksma_panel *panels, size_t n, double size,
                                            koksma_plot_format format, unsigned char **bytes, size_t *n_bytes);

/* A curve of a chart: n points joined by straight lines. A point without neighbours has a mark. */
typedef struct koksma_curve {
    const char *label; /* in the legend; NULL: not there */
    size_t n;
    const double *xs, *ys, *errors; /* n each; errors (half lengths of bars at marks, else of a band) may be NULL. A
                                       point that is not finite leaves a gap */
    bool marks;                     /* draw marks at the points */
    bool dashed;                    /* a grey, dashed guide; the axes need not contain it */
    size_t colour;                  /* number of a colour with dashes, as koksma_plot_colours gives them */
} koksma_curve;

/* A chart of curves. */
typedef struct koksma_chart {
    const char *x_label, *y_label; /* may be NULL */
    bool log_x, log_y;             /* logarithmic axes; points that are not positive are left out */
    const koksma_curve *curves;
    size_t n_curves;
    bool has_level; /* draw a horizontal guide at `level`, such as the value of random points */
    double level;
    double size;       /* width in points or pixels; 0: 480. A figure has its own */
    const char *title; /* above; may be NULL */
} koksma_chart;

/* Draws a chart. Errors: ARGUMENT (no point that can be drawn, a size or format out of range), and those above. */
KOKSMA_API koksma_status koksma_plot_chart(const koksma_chart *chart, koksma_plot_format format,
                                           unsigned char **bytes, size_t *n_bytes);

/* Gives n patterns of one picture the colours that they have in all pictures: each family of patterns has one, and its
   members in a picture differ in dashes and marks.
     specs    specs or names of patterns; others get what is left
     numbers  receives n
   Errors: ARGUMENT. */
KOKSMA_API koksma_status koksma_plot_colours(const char *const *specs, size_t n, size_t *numbers);

/* A part of a figure: a panel or a chart. */
typedef struct koksma_cell {
    const koksma_panel *panel;
    const koksma_chart *chart; /* instead of a panel; else NULL */
    size_t row;                /* cells that follow each other with the same number stand side by side */
} koksma_cell;

/* Panels and charts in rows, top down. */
typedef struct koksma_figure {
    const char *title; /* may be NULL */
    const koksma_cell *cells;
    size_t n_cells;
    double width,
        height; /* points or pixels; width 0: what the cells have alone. height 0: as the width demands; else
                             squares and axes become smaller, or axes higher */
    bool wrap;  /* rows become several lines where a cell would be less than 128 (charts 300) wide */
    bool dark;  /* light on dark */
} koksma_figure;

/* Draws a figure. Errors: those of koksma_plot_scatter and koksma_plot_chart; ARGUMENT also for no cells and for a height
   that its texts leave no room in. */
KOKSMA_API koksma_status koksma_plot_figure(const koksma_figure *figure, koksma_plot_format format,
                                            unsigned char **bytes, size_t *n_bytes);

/* A cell of a subdivided unit square, with its sample. */
typedef struct koksma_stratum {
    double x, y, width, height; /* from the upper left corner */
    double at[2];               /* position of the sample */
    double value;               /* grey: 0 black, 1 white */
    int level;                  /* number of splits from the unit square to this cell */
} koksma_stratum;

/* A cell that was split in four. */
typedef struct koksma_split {
    double x, y, width, height; /* from the upper left corner */
    int level;                  /* number of splits from the unit square to this cell */
    bool needless;              /* its values are nearly equal: the split was not needed */
} koksma_split;

/* One of several subdivided squares side by side. */
typedef struct koksma_strata_panel {
    const koksma_stratum *strata;
    size_t n;
    const koksma_split *splits; /* n_splits; drawn as needed or needless */
    size_t n_splits;            /* 0: none */
    const char *caption;        /* a line below; may be NULL */
} koksma_strata_panel;

/* Draws n subdivided squares in a row, y downwards: strata as greys of their values, with their samples. If a panel
   has splits, cells that were split needlessly are black, the others have a circle, and values range from mid-grey
   to white.
     size  side of a square; 0: 320
   Errors: ARGUMENT (a size or format out of range, no panels), and those above. */
KOKSMA_API koksma_status koksma_plot_strata(const koksma_strata_panel *panels, size_t n, double size,
                                            koksma_plot_format format, unsigned char **bytes, size_t *n_bytes);

/* Writes bytes to a file, completely or not at all; "-" is standard output. Errors: IO. */
KOKSMA_API koksma_status koksma_plot_write(const char *path, const unsigned char *bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
