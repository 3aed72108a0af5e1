/* SPDX-License-Identifier: Apache-2.0 */
/* A canvas in memory: draws shapes, clipped at a box, and texts, broken into lines, through a backend (backend.h). */
#ifndef KOKSMA_PLOT_CANVAS_H
#define KOKSMA_PLOT_CANVAS_H

#include "plot/backend.h"

/* Opens a canvas. Errors: ARGUMENT (an unknown format), MEMORY, UNSUPPORTED (the module is missing), SYSTEM. */
koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, const char *title,
                                  koksma__colour paper, koksma__canvas **out);

void koksma__canvas_path(koksma__canvas *canvas, const double *xys, size_t n, koksma__style style);
void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, koksma__style style);
void koksma__canvas_box(koksma__canvas *canvas, koksma__box box, koksma__style style);
void koksma__canvas_circle(koksma__canvas *canvas, double x, double y, double radius, koksma__style style);

/* Draws the part of a path that is inside a box. The path is open, or a filled polygon of at most KOKSMA__MAX_CORNERS
   corners. */
enum { KOKSMA__MAX_CORNERS = 192 };
void koksma__canvas_path_inside(koksma__canvas *canvas, const double *xys, size_t n, koksma__box inside,
                                koksma__style style);

/* Fills a box with columns x rows squares, whose colours are bytes of red, green and blue, row by row from the upper
   left corner. Errors: MEMORY, UNSUPPORTED. */
koksma_status koksma__canvas_pixels(koksma__canvas *canvas, koksma__box box, int columns, int rows,
                                    const unsigned char *rgb);

/* Writes a text. x is the left end of the text if anchor is 0, its middle if 0.5, its right end if 1. */
void koksma__canvas_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                         koksma__colour colour);

/* An upper bound of a text's width in common sans-serif fonts. */
double koksma__text_width(const char *text, double height);

/* Writes a text in lines of at most a given width, broken after blanks and punctuation marks; y is the base line of
   the first line. Returns the number of lines, 0 for a NULL text. With a NULL canvas it draws nothing and only counts
   the lines. */
size_t koksma__canvas_lines(koksma__canvas *canvas, double x, double y, double width, double height, double anchor,
                            const char *text, koksma__colour colour);

/* The distance between the base lines of successive lines of text. */
double koksma__line_height(double height);

/* The height of the lines that koksma__canvas_lines writes. */
double koksma__lines_height(const char *text, double width, double height);

/* Returns the finished picture, which the caller frees; with bytes = NULL drops it. Releases the canvas, also if it
   fails and returns no picture. */
koksma_status koksma__canvas_close(koksma__canvas *canvas, unsigned char **bytes, size_t *size);

#endif
