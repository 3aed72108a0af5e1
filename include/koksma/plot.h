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
 * run. Errors of all of them: ARGUMENT, UNSUPPORTED (this build lacks cairo), MEMORY, SYSTEM (cairo failed).
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

/* How a scatter plot of 2D points looks. All zero is a plain plot. */
typedef struct koksma_scatter_options {
    double size;             /* side of the picture; 0: 320 */
    size_t columns, rows;    /* draw guide lines of that many cells, 0 (none) to KOKSMA_PLOT_MAX_CELLS */
    bool local_discrepancy;  /* colour the background by koksma_local_discrepancy: orange where the box from the
                                origin has too many points, blue where too few; white is 0, full colour the largest
                                value on a grid. Not together with warp */
    const koksma_warp *warp; /* draw points and guide lines mapped by this warp, hemispheres seen from above; NULL:
                                not mapped. Not together with witness */
    const koksma_witness *witness; /* draw this box, line or disk; may be NULL */
    const char *caption;           /* a line below the picture; may be NULL */
} koksma_scatter_options;

/* Returns the drawing library of this build, such as "cairo 1.16.0"; NULL: there is none, all plots are
   UNSUPPORTED. */
KOKSMA_API const char *koksma_plot_library(void);

/* Finds the format that the ending of a path names: .svg, .pdf or .png. Errors: ARGUMENT (another ending). */
KOKSMA_API koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format);

/* Draws coordinates 0 and 1 of points in the unit square, y upwards.
     options  may be NULL
   Errors: ARGUMENT (a size, format or number of cells out of range, no points, a coordinate outside [0,1]), DIM (one
   dimension), and those above. */
KOKSMA_API koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                             koksma_plot_format format, unsigned char **bytes, size_t *size);

/* One of several square pictures in a row: points, or a power spectrum. */
typedef struct koksma_panel {
    const koksma_points *points; /* NULL: draw the spectrum */
    koksma_scatter_options scatter;
    const koksma_spectrum *spectrum; /* drawn with frequency (0, 0) in the middle, which is left out; black is 0 */
    double white;                    /* the power that is white; 0: 2, so that random points are mid-grey */
    const char *caption;             /* a line below; may be NULL */
} koksma_panel;

/* Draws n panels in a row; spectra have a scale.
     size  side of a panel; 0: 320
   Errors: those of koksma_plot_scatter; ARGUMENT also for no panels. */
KOKSMA_API koksma_status koksma_plot_panels(const koksma_panel *panels, size_t n, double size,
                                            koksma_plot_format format, unsigned char **bytes, size_t *n_bytes);

/* A curve of a chart: n points joined by straight lines, with error bars. */
typedef struct koksma_curve {
    const char *label; /* in the legend; NULL: not there */
    size_t n;
    const double *xs, *ys, *errors; /* n each; errors (half lengths of bars) may be NULL. A point that is not finite
                                       leaves a gap */
    bool marks;                     /* draw dots at the points */
    bool dashed;                    /* a grey, dashed guide; the axes need not contain it */
    size_t colour;                  /* number of a colour; equal numbers give equal colours */
} koksma_curve;

/* A chart of curves. */
typedef struct koksma_chart {
    const char *x_label, *y_label; /* may be NULL */
    bool log_x, log_y;             /* logarithmic axes; points that are not positive are left out */
    const koksma_curve *curves;
    size_t n_curves;
    bool has_level; /* draw a horizontal guide at `level`, such as the value of random points */
    double level;
    double size; /* width in points or pixels; 0: 480 */
} koksma_chart;

/* Draws a chart. Errors: ARGUMENT (no point that can be drawn, a size or format out of range), and those above. */
KOKSMA_API koksma_status koksma_plot_chart(const koksma_chart *chart, koksma_plot_format format,
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
