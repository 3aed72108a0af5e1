/* SPDX-License-Identifier: Apache-2.0 */
/* Pictures of point sets, power spectra and curves. Part of koksma-lab. */
#ifndef KOKSMA_PLOT_H
#define KOKSMA_PLOT_H

#include <koksma/koksma.h>
#include <koksma/spectrum.h>
#include <koksma/warp.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum koksma_plot_format { KOKSMA_PLOT_SVG, KOKSMA_PLOT_PDF, KOKSMA_PLOT_PNG } koksma_plot_format;

/* Sizes of pictures are 0, for the one that is named, or KOKSMA_PLOT_MIN_SIZE to KOKSMA_PLOT_MAX_SIZE. */
enum { KOKSMA_PLOT_MIN_SIZE = 16, KOKSMA_PLOT_MAX_SIZE = 32767, KOKSMA_PLOT_MAX_CELLS = 65536 };

/* How a scatter plot of 2D points looks. All zero, and NULL, is a plain plot. */
typedef struct koksma_scatter_options {
    double size;             /* side of the picture in points (SVG, PDF) or pixels (PNG); 0: 320 */
    size_t columns, rows;    /* guide lines of a grid of cells, up to KOKSMA_PLOT_MAX_CELLS; 0: none */
    bool local_discrepancy;  /* the square behind the points is coloured by koksma_local_discrepancy: orange where
                                the box from the origin has too many points, blue where it has too few; white
                                is 0, full colour its largest value on a grid. Not with a warp */
    const koksma_warp *warp; /* points and guide lines are drawn through this map, in its domain, hemispheres as
                                seen from above; NULL: in the square. Not with a witness */
    const koksma_witness *witness; /* a box, line or disk to draw in; NULL: none */
    const char *caption;           /* a line below the picture; NULL: none */
} koksma_scatter_options;

/* What draws in this build: "cairo 1.16.0"; NULL: nothing does, and plots are UNSUPPORTED. */
KOKSMA_API const char *koksma_plot_library(void);

/* The format that a path's ending names. Errors: ARGUMENT. */
KOKSMA_API koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format);

/* Draws coordinates 0 and 1 of points in the unit square, y up, into memory that the caller frees. The bytes are the
   same on every run. Errors: ARGUMENT (a size, format or number of cells that can't be, no points, a coordinate
   outside [0,1]), DIM (fewer than 2), UNSUPPORTED (a build that has no plots), MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                             koksma_plot_format format, unsigned char **bytes, size_t *size);

/* One of several square pictures side by side: points, or a power spectrum. */
typedef struct koksma_panel {
    const koksma_points *points; /* NULL: spectrum is drawn */
    koksma_scatter_options scatter;
    const koksma_spectrum *spectrum; /* (0, 0) in the middle, where it is left out; black is 0 */
    double white;                    /* the power that is drawn white; 0: 2, so that random points are mid-grey */
    const char *caption;             /* below, NULL: none */
} koksma_panel;

/* Draws panels of the given side (0: 320) in a row. A spectrum's picture says its scale. Errors: as above. */
KOKSMA_API koksma_status koksma_plot_panels(const koksma_panel *panels, size_t n, double size,
                                            koksma_plot_format format, unsigned char **bytes, size_t *n_bytes);

/* A curve of a chart: straight lines between points, with bars of +- errors. */
typedef struct koksma_curve {
    const char *label; /* NULL: not in the legend */
    size_t n;
    const double *xs, *ys, *errors; /* errors: NULL for none. Points that are not finite leave a gap */
    bool marks;                     /* dots at the points */
    bool dashed;                    /* a guide: grey, dashed, not looked at for the range of the axes */
    size_t colour;                  /* curves of equal number have equal colours */
} koksma_curve;

typedef struct koksma_chart {
    const char *x_label, *y_label; /* NULL: none */
    bool log_x, log_y;             /* points that aren't positive are left out */
    const koksma_curve *curves;
    size_t n_curves;
    bool has_level; /* a horizontal guide at level: what random points give */
    double level;
    double size; /* width in points or pixels; 0: 480 */
} koksma_chart;

/* Errors: ARGUMENT (nothing that can be drawn, a size or format that can't be), UNSUPPORTED, MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_plot_chart(const koksma_chart *chart, koksma_plot_format format,
                                           unsigned char **bytes, size_t *n_bytes);

/* A square of a subdivided unit square, and its sample. */
typedef struct koksma_stratum {
    double x, y, width, height; /* from the upper left corner */
    double at[2];               /* the sample's place */
    double value;               /* grey: 0 black, 1 white */
    int level;                  /* splits that made it */
} koksma_stratum;

/* A square that was split in four. */
typedef struct koksma_split {
    double x, y, width, height; /* from the upper left corner */
    int level;                  /* splits that made it */
    bool needless;              /* its values are alike, so that it need not have been split */
} koksma_split;

/* One of several subdivided squares side by side. */
typedef struct koksma_strata_panel {
    const koksma_stratum *strata;
    size_t n;
    const koksma_split *splits; /* marked as needed or needless */
    size_t n_splits;            /* 0: none is marked */
    const char *caption;        /* below, NULL: none */
} koksma_strata_panel;

/* Draws subdivided squares of the given side (0: 320) in a row, y down: strata in their values' greys, with their
   samples. Where splits are marked, what was split needlessly is black, what had to be split is circled, and the
   range of the panel's values goes from mid-grey to white. Errors: ARGUMENT (a size or format that can't be, no
   panels), UNSUPPORTED, MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_plot_strata(const koksma_strata_panel *panels, size_t n, double size,
                                            koksma_plot_format format, unsigned char **bytes, size_t *n_bytes);

/* Writes bytes to a file whole or not at all; "-" is standard output. Errors: IO. */
KOKSMA_API koksma_status koksma_plot_write(const char *path, const unsigned char *bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
