/* SPDX-License-Identifier: Apache-2.0 */
/* The interface of the backends that draw a canvas: the few operations that draw all plots. svg.c implements it for
   SVG; the module koksma-cairo.so (cairo.c), which is loaded when the first PDF or PNG is drawn, implements it for
   these two. Backends do not clip: canvas.c clips shapes. */
#ifndef KOKSMA_PLOT_BACKEND_H
#define KOKSMA_PLOT_BACKEND_H

#include <koksma/plot.h>

typedef struct koksma__colour {
    double r, g, b, a;
} koksma__colour;

/* How a line is drawn; the last value is for guide lines. */
typedef enum koksma__dash {
    KOKSMA__DASH_WHOLE,
    KOKSMA__DASH_LONG,
    KOKSMA__DASH_DOTS,
    KOKSMA__DASH_MIXED,
    KOKSMA__DASH_GUIDE
} koksma__dash;

/* How a shape is drawn. A shape of thickness 0 is filled. */
typedef struct koksma__style {
    double thickness;
    koksma__colour colour;
    koksma__dash dash;
} koksma__style;

typedef struct koksma__box {
    double x, y, width, height;
} koksma__box;

/* The first member of every backend's canvas. dashes[dash] lists the lengths of strokes and gaps in turn, and ends
   with 0. */
enum { KOKSMA__MAX_DASHES = 4 };
typedef struct koksma__canvas {
    const struct koksma__canvas_functions *draw;
    const double (*dashes)[KOKSMA__MAX_DASHES + 1];
} koksma__canvas;

/* The functions of a backend. Texts are UTF-8 without control characters; coordinates are in points from the upper
   left corner. */
typedef struct koksma__canvas_functions {
    koksma_status (*open)(koksma_plot_format format, double width, double height, const char *title,
                          koksma__canvas **out);
    /* Draws n positions (x, y) joined by lines; if the style is filled, as a filled polygon. */
    void (*path)(koksma__canvas *canvas, const double *xys, size_t n, koksma__style style);
    void (*box)(koksma__canvas *canvas, koksma__box box, koksma__style style);
    void (*circle)(koksma__canvas *canvas, double x, double y, double radius, koksma__style style);
    koksma_status (*pixels)(koksma__canvas *canvas, koksma__box box, int columns, int rows, const unsigned char *rgb);
    void (*text)(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                 koksma__colour colour);
    /* bytes: NULL drops the picture. */
    koksma_status (*close)(koksma__canvas *canvas, unsigned char **bytes, size_t *size);
    const char *(*library)(void);
} koksma__canvas_functions;

#endif
