/* SPDX-License-Identifier: Apache-2.0 */
/* A canvas in memory: strokes on a backend, shapes that are cut at a box, and texts in lines. */
#ifndef KOKSMA_PLOT_CANVAS_H
#define KOKSMA_PLOT_CANVAS_H

#include "plot/backend.h"

/* Errors: ARGUMENT (a format that is none), MEMORY, UNSUPPORTED (the module is missing), SYSTEM. */
koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, const char *title,
                                  koksma__colour paper, koksma__canvas **out);

void koksma__canvas_path(koksma__canvas *canvas, const double *xys, size_t n, koksma__style style);
void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, koksma__style style);
void koksma__canvas_box(koksma__canvas *canvas, koksma__box box, koksma__style style);
void koksma__canvas_circle(koksma__canvas *canvas, double x, double y, double radius, koksma__style style);

/* The part inside a box of an open path, or of a polygon of at most KOKSMA__MAX_CORNERS corners, which is filled. */
enum { KOKSMA__MAX_CORNERS = 192 };
void koksma__canvas_path_inside(koksma__canvas *canvas, const double *xys, size_t n, koksma__box inside,
                                koksma__style style);

/* columns x rows squares of red, green and blue bytes, from the upper left corner. Errors: MEMORY, UNSUPPORTED. */
koksma_status koksma__canvas_pixels(koksma__canvas *canvas, koksma__box box, int columns, int rows,
                                    const unsigned char *rgb);

/* Writes text. anchor 0: x is the left end, 0.5: the middle, 1: the right end. */
void koksma__canvas_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                         koksma__colour colour);

/* An upper bound of a text's width in the sans-serif fonts in use. */
double koksma__text_width(const char *text, double height);

/* Writes a text into lines of at most a width, the first with its base line at y, broken after blanks and signs; with a
   NULL canvas nothing. Returns the number of lines, 0 of NULL. */
size_t koksma__canvas_lines(koksma__canvas *canvas, double x, double y, double width, double height, double anchor,
                            const char *text, koksma__colour colour);

/* From the base line of a line of text to that of the next. */
double koksma__line_height(double height);

/* The finished picture, which the caller frees. Releases the canvas, also on failure. */
koksma_status koksma__canvas_close(koksma__canvas *canvas, unsigned char **bytes, size_t *size);

#endif
