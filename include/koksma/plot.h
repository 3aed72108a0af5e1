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
 * Every plot function allocates the file's bytes, which the caller frees with free(). Equal arguments give equal
 * bytes. SVG files contain their labels as text and have no id attributes, so that one page can hold several; cairo
 * draws PDF and PNG. Every plot function may return the errors ARGUMENT, UNSUPPORTED (PDF and PNG: this build lacks
 * cairo), MEMORY, SYSTEM (cairo failed).
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

/* A plot's size is 0 for the default or KOKSMA_PLOT_MIN_SIZE to KOKSMA_PLOT_MAX_SIZE; the unit is points in SVG and
   PDF, pixels in PNG. */
enum { KOKSMA_PLOT_MIN_SIZE = 16, KOKSMA_PLOT_MAX_SIZE = 32767, KOKSMA_PLOT_MAX_CELLS = 65536 };

/* Points of more than 2 dimensions are drawn as their projections on all pairs of the first KOKSMA_PLOT_MAX_DIM
   axes. */
enum { KOKSMA_PLOT_MAX_DIM = 8 };

/* Options of a scatter plot. A struct of zeros gives a plain plot. */
typedef struct koksma_scatter_options {
    double size;             /* side of the picture; 0: 320 */
    size_t columns, rows;    /* numbers of columns and rows into which guide lines divide the square, up to
                                KOKSMA_PLOT_MAX_CELLS; 0: no lines */
    bool local_discrepancy;  /* colour the background by koksma_local_discrepancy: orange where the box from the
                                origin has too many points, blue where it has too few. A value of 0 is white; the
                                largest absolute value in the picture has the full colour. Cannot be combined with
                                warp */
    const koksma_warp *warp; /* draw points and guide lines mapped by this warp, with hemispheres seen from above
                                and the sphere in an equal-area projection, its pole z = 1 in the centre; NULL: no
                                warp. Needs points of 2 dimensions and cannot be combined with witness */
    const koksma_witness *witness; /* draw this box, line or disk; a box of more than 2 dimensions is drawn as its
                                      projections. May be NULL */
    const char *caption;           /* a line of text below the picture; may be NULL */
} koksma_scatter_options;

/* Returns the library that draws PDF and PNG, such as "cairo 1.16.0"; NULL: this build has none, and PDF and PNG
   are UNSUPPORTED. */
KOKSMA_API const char *koksma_plot_library(void);

/* Finds the format of a path by its ending: .svg, .pdf or .png. Errors: ARGUMENT (unknown ending). */
KOKSMA_API koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format);

/* Draws points of 2 dimensions in the unit square with y upwards, and points of more dimensions as a scatter
   matrix: the projections on all pairs of the first KOKSMA_PLOT_MAX_DIM axes.
     options  may be NULL
   Errors: ARGUMENT (a size, format or number of cells out of range, no points, a coordinate outside [0,1]), DIM
   (one dimension), and those of every plot function. */
KOKSMA_API koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                             koksma_plot_format format, unsigned char **bytes, size_t *size);

/* A square picture: points, or a power spectrum, with a scale. */
typedef struct koksma_panel {
    const koksma_points *points; /* NULL: draw the spectrum */
    koksma_scatter_options scatter;
    const koksma_spectrum *spectrum; /* the spectrum to draw. Frequency (0, 0) is in the middle, without its power; a
                                        power of 0 is black */
    double white;                    /* power that is drawn white; 0: use 2, so that random points are mid-grey */
    const char *caption;             /* line below the panel; may be NULL */
    const char *title;               /* line above the panel; may be NULL */
    size_t swatch;                   /* 1 + the number of a colour to show beside the title; 0: no colour */
} koksma_panel;

/* A curve of a chart: n points joined by straight lines. A point between two gaps is drawn as a mark. */
typedef struct koksma_curve {
    const char *label; /* name in the legend (NULL: the legend omits the curve) */
    size_t n;
    const double *xs, *ys, *errors; /* arrays of n. `errors`, which may be NULL, has half the lengths of error bars,
                                       or, if `marks` is false, half the widths of a band. A point that is not finite
                                       leaves a gap */
    bool marks;                     /* draw marks at the points */
    bool dashed;                    /* draw the curve as a grey dashed guide, which does not extend the axes */
    size_t colour;                  /* number of a colour and dash style, from koksma_plot_colours */
} koksma_curve;

/* A chart of curves. */
typedef struct koksma_chart {
    const char *x_label, *y_label; /* may be NULL */
    bool log_x, log_y;             /* logarithmic axes; points that are not positive are left out */
    const koksma_curve *curves;
    size_t n_curves;
    bool has_level; /* true: draw a horizontal guide at `level`, such as the value of random points */
    double level;
    const char *title; /* line above the chart; may be NULL */
} koksma_chart;

/* Finds colour numbers for n patterns of one picture. Each family of patterns has its colour: the first pattern of a
   family has it in all pictures, others of the family get colours that no other pattern of the picture has. From the
   ninth pattern on colours repeat with other dashes. The shape of a curve's marks also depends on its number.
     specs    specs or names of patterns; other texts get the remaining colours
     numbers  receives n colour numbers
   Errors: ARGUMENT. */
KOKSMA_API koksma_status koksma_plot_colours(const char *const *specs, size_t n, size_t *numbers);

/* A part of a figure: a panel or a chart. */
typedef struct koksma_cell {
    const koksma_panel *panel;
    const koksma_chart *chart; /* drawn if panel is NULL */
    size_t row;                /* consecutive cells with the same row number are drawn side by side */
} koksma_cell;

/* A figure of panels and charts, in rows from top to bottom. */
typedef struct koksma_figure {
    const char *title; /* line above the figure; may be NULL */
    const koksma_cell *cells;
    size_t n_cells;
    /* size in points or pixels. Width 0: the width of the rows at the cells' default sizes. Height 0: the height that
       follows from the width; another height scales squares and axes to fit */
    double width, height;
    /* true: break a row into several lines if a panel would be less than 128, or a chart less than 300, wide */
    bool wrap;
    bool dark; /* true: draw light lines on a dark background */
} koksma_figure;

/* Draws a figure. run: asked after some thousand points of a panel whether to go on; may be NULL. Errors: those of
   koksma_plot_scatter; also ARGUMENT for a figure without cells, a chart without a point that can be drawn, and a height in
   which the texts leave no space for the cells; and INTERRUPTED. */
KOKSMA_API koksma_status koksma_plot_figure(const koksma_figure *figure, koksma_plot_format format,
                                            const koksma_run *run, unsigned char **bytes, size_t *n_bytes);

/* A cell of a subdivided unit square, with its sample. */
typedef struct koksma_stratum {
    double x, y, width, height; /* position from the upper left corner of the square, and size */
    double at[2];               /* position of the sample */
    double value;               /* grey level: 0 black, 1 white */
    int level;                  /* number of splits from the unit square to this cell */
} koksma_stratum;

/* A cell that was split in four. */
typedef struct koksma_split {
    double x, y, width, height; /* position from the upper left corner of the square, and size */
    int level;                  /* number of splits from the unit square to this cell */
    bool needless;              /* true: the values in the four parts are nearly equal, so the split was not
                                   needed */
} koksma_split;

/* One of several subdivided squares side by side. */
typedef struct koksma_strata_panel {
    const koksma_stratum *strata;
    size_t n;
    const koksma_split *splits; /* array of n_splits; needed and needless splits are drawn differently */
    size_t n_splits;            /* 0: none */
    const char *caption;        /* a line of text below the square; may be NULL */
} koksma_strata_panel;

/* Draws n subdivided squares in a row, with y downwards. Each stratum is filled with the grey of its value and
   shows its sample. If a panel has splits, cells that were split needlessly are black, cells with a needed split
   have a circle, and values range from mid-grey to white.
     size  side of a square; 0: 320
   Errors: ARGUMENT (a size or format out of range, no panels), and those of every plot function. */
KOKSMA_API koksma_status koksma_plot_strata(const koksma_strata_panel *panels, size_t n, double size,
                                            koksma_plot_format format, unsigned char **bytes, size_t *n_bytes);

/* Writes bytes to a file, completely or not at all; "-" is standard output. Errors: IO. */
KOKSMA_API koksma_status koksma_plot_write(const char *path, const unsigned char *bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
