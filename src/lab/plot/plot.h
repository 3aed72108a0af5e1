/* SPDX-License-Identifier: Apache-2.0 */
/* How plots are drawn: backends, the canvas above them, colours, and the parts of a figure. */
#ifndef KOKSMA_PLOT_PLOT_H
#define KOKSMA_PLOT_PLOT_H

#include <koksma/plot.h>

/* ---- Backends: the few operations that draw all plots ---------------------------------------------------------- */

/* svg.c is the backend for SVG; the module koksma-cairo.so (cairo.c), which is loaded when the first PDF or PNG is
   drawn, is that of these two. Backends do not clip: canvas.c clips shapes. */

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
    /* Fills a box with columns x rows squares, whose colours are bytes of red, green and blue, row by row from the upper
       left corner. Errors: MEMORY, UNSUPPORTED. */
    koksma_status (*pixels)(koksma__canvas *canvas, koksma__box box, int columns, int rows, const unsigned char *rgb);
    void (*text)(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                 koksma__colour colour);
    /* Returns the finished picture, which the caller frees; with bytes = NULL drops it. Releases the canvas, also if it
       fails and returns no picture. */
    koksma_status (*close)(koksma__canvas *canvas, unsigned char **bytes, size_t *size);
    const char *(*library)(void);
} koksma__canvas_functions;

/* The backend for SVG; it needs no outside library. */
extern const koksma__canvas_functions koksma__svg_functions;

/* ---- Canvases: shapes clipped at a box, and texts broken into lines -------------------------------------------- */

/* Opens a canvas. Errors: ARGUMENT (an unknown format), MEMORY, UNSUPPORTED (the module is missing), SYSTEM. */
koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, const char *title,
                                  koksma__colour paper, koksma__canvas **out);

void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, koksma__style style);

/* Draws the part of a path that is inside a box. The path is open, or a filled polygon of at most KOKSMA__MAX_CORNERS
   corners. */
enum { KOKSMA__MAX_CORNERS = 192 };
void koksma__canvas_path_inside(koksma__canvas *canvas, const double *xys, size_t n, koksma__box inside,
                                koksma__style style);

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

/* ---- Colours and dashes, for light and for dark paper ---------------------------------------------------------- */

typedef struct koksma__theme {
    koksma__colour paper, ink, frame, grid, guide, cell, mark, wash;
    bool dark;
} koksma__theme;

const koksma__theme *koksma__theme_of(bool dark);

/* KOKSMA__COLOURS: the number of lines of palette.def. */
enum { KOKSMA__COLOURS = 8, KOKSMA__CURVE_STYLES = KOKSMA__COLOURS * KOKSMA__DASH_GUIDE };

/* Returns the colour of the family of the pattern whose spec this is, or KOKSMA__COLOURS if the text names no
   pattern. */
size_t koksma__colour_of(const char *spec);

/* The style of curve `number` (koksma_curve): successive numbers vary the colour first, then the dash. */
koksma__style koksma__curve_style(const koksma__theme *theme, size_t number, double thickness);

/* ---- Parts of a figure: curves on axes, and panels of points or of a spectrum ---------------------------------- */

/* Checks a chart. Errors: ARGUMENT (invalid arrays, or nothing to draw). */
koksma_status koksma__chart_check(const koksma_chart *chart);

/* The total height of the texts above and below the axes, for a given width. */
double koksma__chart_texts(const koksma_chart *chart, double width);

/* Errors: MEMORY. */
koksma_status koksma__chart_draw(koksma__canvas *canvas, const koksma__theme *theme, const koksma_chart *chart,
                                 koksma__box box);

/* Checks a panel. Errors: those of koksma_plot_scatter. */
koksma_status koksma__panel_check(const koksma_panel *panel);

/* The default side of a panel; it grows with the number of projections. */
double koksma__panel_side(const koksma_panel *panel);

/* Return the height of the texts above the square, and of all texts, for a given width of the panel. */
double koksma__panel_title(const koksma_panel *panel, double width);
double koksma__panel_texts(const koksma_panel *panel, double width);

/* Draws a panel. title: the height reserved for the texts above the square, which is equal for all panels of a row;
   side: the width of the square and its margins. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__panel_draw(koksma__canvas *canvas, const koksma__theme *theme, const koksma_panel *panel,
                                 koksma__box box, double title, double side, const koksma_run *run);

/* Sets *size to the requested width or height, or to the fallback if the request is 0. Errors: ARGUMENT, also for an
   unknown format. */
koksma_status koksma__figure_size(koksma_plot_format format, double asked, double fallback, double *size);

#endif
