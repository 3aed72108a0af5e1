/* SPDX-License-Identifier: Apache-2.0 */
/* Pictures of point sets. Part of koksma-lab. */
#ifndef KOKSMA_PLOT_H
#define KOKSMA_PLOT_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum koksma_plot_format { KOKSMA_PLOT_SVG, KOKSMA_PLOT_PDF, KOKSMA_PLOT_PNG } koksma_plot_format;

/* How a scatter plot of 2D points looks. All zero is a plain plot. */
typedef struct koksma_scatter_options {
    double size;                   /* side of the picture in points (SVG, PDF) or pixels (PNG); 0: 320 */
    size_t columns, rows;          /* guide lines of a grid of cells; 0: none */
    const koksma_witness *witness; /* a box, line or disk to draw in; NULL: none */
    const char *caption;           /* a line below the picture; NULL: none */
} koksma_scatter_options;

/* The format that a path's ending names. Errors: ARGUMENT. */
KOKSMA_API koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format);

/* Draws coordinates 0 and 1 of points in the unit square, y up, into memory that the caller frees. The bytes are the
   same on every run. Errors: DIM (fewer than 2), MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                             koksma_plot_format format, unsigned char **bytes, size_t *size);

/* Writes bytes to a file whole or not at all; "-" is standard output. Errors: IO. */
KOKSMA_API koksma_status koksma_plot_write(const char *path, const unsigned char *bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
