/* SPDX-License-Identifier: Apache-2.0 */
/* A canvas in memory: the few strokes that the plots are made of. canvas.c passes them on to the module koksma-cairo.so
   (cairo.c), which the first canvas loads. */
#ifndef KOKSMA_PLOT_CANVAS_H
#define KOKSMA_PLOT_CANVAS_H

#include <koksma/plot.h>

typedef struct koksma__canvas koksma__canvas;

typedef struct koksma__colour {
    double r, g, b, a;
} koksma__colour;

/* The size that is asked for, or the fallback for 0. Errors: ARGUMENT, also for a format that is none. */
koksma_status koksma__canvas_size(koksma_plot_format format, double asked, double fallback, double *size);

/* Units are points from the upper left corner. Errors: MEMORY, UNSUPPORTED (the module is missing), SYSTEM. */
koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, koksma__canvas **out);

void koksma__canvas_clip(koksma__canvas *canvas, double x, double y, double width, double height);
void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, double thickness,
                         koksma__colour colour);
void koksma__canvas_box(koksma__canvas *canvas, double x, double y, double width, double height, double thickness,
                        koksma__colour colour); /* thickness 0: filled */
void koksma__canvas_circle(koksma__canvas *canvas, double x, double y, double radius, double thickness,
                           koksma__colour colour); /* thickness 0: filled */
/* How lines are drawn from here on; `along`: how much of the dashes is behind a line where it begins, so that a curve
   of many lines has even dashes. */
typedef enum koksma__dash {
    KOKSMA__DASH_WHOLE,
    KOKSMA__DASH_LONG,
    KOKSMA__DASH_DOTS,
    KOKSMA__DASH_GUIDE
} koksma__dash;
void koksma__canvas_dash(koksma__canvas *canvas, koksma__dash dash, double along);
/* columns x rows squares of red, green and blue bytes, from the upper left corner; false when memory runs out. */
bool koksma__canvas_pixels(koksma__canvas *canvas, double x, double y, double width, double height, int columns,
                           int rows, const unsigned char *rgb);
/* anchor 0: x is the left end, 0.5: the middle, 1: the right end. */
void koksma__canvas_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                         koksma__colour colour);

/* The finished picture, which the caller frees. Releases the canvas, also on failure. */
koksma_status koksma__canvas_close(koksma__canvas *canvas, unsigned char **bytes, size_t *size);

/* What the module brings: the functions above, and koksma_plot_library. */
typedef struct koksma__canvas_functions {
    koksma_status (*open)(koksma_plot_format format, double width, double height, koksma__canvas **out);
    void (*clip)(koksma__canvas *canvas, double x, double y, double width, double height);
    void (*line)(koksma__canvas *canvas, double x0, double y0, double x1, double y1, double thickness,
                 koksma__colour colour);
    void (*box)(koksma__canvas *canvas, double x, double y, double width, double height, double thickness,
                koksma__colour colour);
    void (*circle)(koksma__canvas *canvas, double x, double y, double radius, double thickness,
                   koksma__colour colour);
    void (*dash)(koksma__canvas *canvas, koksma__dash dash, double along);
    bool (*pixels)(koksma__canvas *canvas, double x, double y, double width, double height, int columns, int rows,
                   const unsigned char *rgb);
    void (*text)(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                 koksma__colour colour);
    koksma_status (*close)(koksma__canvas *canvas, unsigned char **bytes, size_t *size);
    const char *(*library)(void);
} koksma__canvas_functions;

#endif
