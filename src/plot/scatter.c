/* SPDX-License-Identifier: Apache-2.0 */
/* Point sets in the unit square, as in figures 5.13 to 5.27 of Shirley 1991, or through a map with the borders of its
   cells, as in figure 5.34, and power spectra, one beside another. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/atomic_file.h"
#include "core/c_locale.h"
#include "core/points_io.h"
#include "core/status.h"
#include "measures/shared/spectrum.h"
#include "plot/canvas.h"

static const koksma__colour ink = {0.1, 0.1, 0.12, 1}, frame = {0.35, 0.35, 0.4, 1}, guide = {0.5, 0.58, 0.74, 1},
                            mark = {0.85, 0.25, 0.1, 0.9}, wash = {0.95, 0.5, 0.3, 0.25};

enum { MARGIN = 6, LINE = 20, FAR = 100, CURVE = 96, LOCAL = 256 };

typedef struct plot {
    koksma__canvas *canvas;
    double left, top, side;
} plot;

static double at_x(const plot *p, double x)
{
    return p->left + x * p->side;
}

static double at_y(const plot *p, double y)
{
    return p->top + (1 - y) * p->side;
}

/* Where a point of the square is in the picture: as it is, or through a map, whose domain fills the picture's square.
   Hemispheres are seen from above. */
static void position(const plot *p, const koksma_warp *warp, const double in[2], double out[2])
{
    double at[3] = {in[0], in[1], 0};
    if (warp) {
        warp->map(in, at);
        if (warp->domain != KOKSMA_DOMAIN_TRIANGLE) { /* the disk of radius 1 */
            at[0] = 0.5 + 0.5 * at[0];
            at[1] = 0.5 + 0.5 * at[1];
        }
    }
    out[0] = at_x(p, at[0]);
    out[1] = at_y(p, at[1]);
}

/* The line where coordinate `fixed` is `value`; through a map it is drawn in short pieces. */
static void draw_guide(const plot *p, const koksma_warp *warp, int fixed, double value)
{
    const int pieces = warp ? CURVE : 1;
    double from[2], to[2], in[2];
    in[fixed] = value;
    in[1 - fixed] = 0;
    position(p, warp, in, from);
    for (int i = 1; i <= pieces; i++) {
        in[1 - fixed] = (double)i / pieces;
        position(p, warp, in, to);
        koksma__canvas_line(p->canvas, from[0], from[1], to[0], to[1], 0.8, guide);
        from[0] = to[0];
        from[1] = to[1];
    }
}

/* The borders between cells. With a warp also the border of the square, which in a disk is the line where it is cut
   open. */
static void draw_guides(const plot *p, const koksma_scatter_options *o)
{
    const size_t counts[2] = {o->columns, o->rows};
    for (int k = 0; k < 2; k++) {
        for (size_t i = o->warp ? 0 : 1; i < counts[k]; i++) {
            draw_guide(p, o->warp, k, (double)i / (double)counts[k]);
        }
    }
}

static void draw_frame(const plot *p, const koksma_warp *warp)
{
    const double right = p->left + p->side, bottom = p->top + p->side;
    if (!warp) {
        koksma__canvas_box(p->canvas, p->left, p->top, p->side, p->side, 1, frame);
    } else if (warp->domain == KOKSMA_DOMAIN_TRIANGLE) {
        koksma__canvas_line(p->canvas, p->left, p->top, p->left, bottom, 1, frame);
        koksma__canvas_line(p->canvas, p->left, bottom, right, bottom, 1, frame);
        koksma__canvas_line(p->canvas, p->left, p->top, right, bottom, 1, frame);
    } else {
        koksma__canvas_circle(p->canvas, p->left + p->side / 2, p->top + p->side / 2, p->side / 2, 1, frame);
    }
}

static void draw_witness(const plot *p, const koksma_witness *w)
{
    if (w->kind == KOKSMA_WITNESS_BOX && w->dim >= 2) {
        const double x = at_x(p, w->lo[0]), y = at_y(p, w->hi[1]);
        const double width = (w->hi[0] - w->lo[0]) * p->side, height = (w->hi[1] - w->lo[1]) * p->side;
        koksma__canvas_box(p->canvas, x, y, width, height, 0, wash);
        koksma__canvas_box(p->canvas, x, y, width, height, 1.2, mark);
    } else if (w->kind == KOKSMA_WITNESS_DISK) {
        for (int i = -1; i <= 1; i++) {
            for (int j = -1; j <= 1; j++) { /* the torus' copies; the clip leaves what is in the square */
                const double x = at_x(p, w->lo[0] + i), y = at_y(p, w->lo[1] + j);
                koksma__canvas_circle(p->canvas, x, y, w->hi[0] * p->side, 0, wash);
                koksma__canvas_circle(p->canvas, x, y, w->hi[0] * p->side, 1.2, mark);
            }
        }
    } else if (w->kind == KOKSMA_WITNESS_HALF_PLANE && w->dim == 2) {
        const double a = w->lo[0], b = w->lo[1], norm = hypot(a, b), reach = 2;
        const double x = a * w->hi[0] / (norm * norm), y = b * w->hi[0] / (norm * norm);
        /* the half-plane: a band as wide as `reach`, inwards from the line */
        const double in_x = x - reach / 2 * a / norm, in_y = y - reach / 2 * b / norm;
        koksma__canvas_line(p->canvas, at_x(p, in_x - reach * b / norm), at_y(p, in_y + reach * a / norm),
                            at_x(p, in_x + reach * b / norm), at_y(p, in_y - reach * a / norm), reach * p->side,
                            wash);
        koksma__canvas_line(p->canvas, at_x(p, x - reach * b / norm), at_y(p, y + reach * a / norm),
                            at_x(p, x + reach * b / norm), at_y(p, y - reach * a / norm), 1.2, mark);
    }
}

/* White for 0, towards orange for 1 and towards blue for -1. */
static void paint(double share, unsigned char rgb[3])
{
    static const double full[2][3] = {{0.13, 0.4, 0.72}, {0.9, 0.38, 0.05}};
    for (int c = 0; c < 3; c++) {
        rgb[c] = (unsigned char)(255 * (1 + fabs(share) * (full[share > 0][c] - 1)) + 0.5);
    }
}

/* Colours the square by the local discrepancy; *scale gets the largest value, which has full colour. */
static koksma_status draw_local(const plot *p, const koksma_points *points, double *scale)
{
    const size_t n = (size_t)LOCAL * LOCAL;
    double *values = malloc(n * sizeof *values);
    unsigned char *rgb = malloc(3 * n);
    koksma_status status = values && rgb ? koksma_local_discrepancy_grid(points, LOCAL, values)
                                         : koksma__fail_memory(n * (3 + sizeof *values));
    *scale = 0;
    for (size_t i = 0; !status && i < n; i++) {
        *scale = fmax(*scale, fabs(values[i]));
    }
    koksma__canvas_clip(p->canvas, p->left, p->top, p->side, p->side);
    for (size_t row = 0; !status && row < LOCAL; row++) {
        for (size_t column = 0; column < LOCAL; column++) {
            paint(*scale > 0 ? values[(LOCAL - 1 - row) * LOCAL + column] / *scale : 0,
                  rgb + 3 * (row * LOCAL + column));
        }
    }
    if (!status && !koksma__canvas_pixels(p->canvas, p->left, p->top, p->side, p->side, LOCAL, LOCAL, rgb)) {
        status = koksma__fail_memory(4 * n);
    }
    free(values);
    free(rgb);
    return status;
}

static void draw_points(const plot *p, const koksma_points *points, const koksma_scatter_options *options)
{
    koksma__canvas_clip(p->canvas, p->left - 1, p->top - 1, p->side + 2, p->side + 2);
    draw_guides(p, options);
    if (options->witness) {
        draw_witness(p, options->witness);
    }
    draw_frame(p, options->warp);
    koksma__canvas_clip(p->canvas, p->left - MARGIN, p->top - MARGIN, p->side + 2 * MARGIN, p->side + 2 * MARGIN);
    const double radius = fmax(0.6, fmin(4, 0.14 * p->side / sqrt((double)points->n)));
    for (size_t i = 0; i < points->n; i++) {
        double at[2];
        position(p, options->warp, points->xs + i * (size_t)points->dim, at);
        koksma__canvas_circle(p->canvas, at[0], at[1], radius, 0, ink);
    }
}

static koksma_status draw_spectrum(const plot *p, const koksma_spectrum *s, double white)
{
    const int half = s->half, side = 2 * half + 1;
    unsigned char *rgb = malloc(3 * (size_t)side * (size_t)side);
    if (!rgb) {
        return koksma__fail_memory(3 * (size_t)side * (size_t)side);
    }
    for (int ky = -half; ky <= half; ky++) {
        for (int kx = -half; kx <= half; kx++) {
            const double power = kx || ky ? koksma_spectrum_power(s, kx, ky) : 0; /* at 0 it is n for all points */
            memset(rgb + 3 * ((size_t)(half - ky) * (size_t)side + (size_t)(kx + half)),
                   (unsigned char)(255 * fmin(power / white, 1) + 0.5), 3);
        }
    }
    koksma__canvas_clip(p->canvas, p->left - 1, p->top - 1, p->side + 2, p->side + 2);
    const bool drawn = koksma__canvas_pixels(p->canvas, p->left, p->top, p->side, p->side, side, side, rgb);
    free(rgb);
    koksma__canvas_box(p->canvas, p->left, p->top, p->side, p->side, 1, frame);
    return drawn ? KOKSMA_OK : koksma__fail_memory((size_t)side * (size_t)side * 4);
}

static koksma_status draw_panel(koksma__canvas *canvas, const koksma_panel *panel, double left, double size,
                                bool scale)
{
    const plot p = {canvas, left + MARGIN, MARGIN, size - 2 * MARGIN};
    koksma_status status = KOKSMA_OK;
    double line = size + 13;
    const double white = panel->white > 0 ? panel->white : 2;
    double largest = 0;
    if (panel->points) {
        status = panel->scatter.local_discrepancy ? draw_local(&p, panel->points, &largest) : KOKSMA_OK;
        draw_points(&p, panel->points, &panel->scatter);
    } else {
        status = draw_spectrum(&p, panel->spectrum, white);
    }
    koksma__canvas_clip(canvas, left, 0, size, size + 2 * LINE);
    if (panel->caption) {
        koksma__canvas_text(canvas, left + size / 2, line, 12, 0.5, panel->caption, ink);
        line += LINE;
    }
    if (scale && panel->spectrum) {
        char text[128];
        koksma__snprintf(text, sizeof text, "power 0 (black) to %g (white), frequencies to %d", white,
                         panel->spectrum->half);
        koksma__canvas_text(canvas, left + size / 2, line, 11, 0.5, text, ink);
    } else if (scale && panel->scatter.local_discrepancy) {
        char text[128];
        koksma__snprintf(text, sizeof text, "local discrepancy -%.3g (blue) to %.3g (orange)", largest, largest);
        koksma__canvas_text(canvas, left + size / 2, line, 11, 0.5, text, ink);
    }
    return status;
}

static koksma_status check_panel(const koksma_panel *panel)
{
    const koksma_scatter_options *o = &panel->scatter;
    if (!panel->points) {
        return panel->spectrum ? koksma__spectrum_check(panel->spectrum)
                               : koksma__fail(KOKSMA_ARGUMENT, "a panel has neither points nor a spectrum");
    }
    if (panel->points->dim < 2) {
        return koksma__fail(KOKSMA_DIM, "a scatter plot takes points of 2 or more dimensions");
    }
    if (o->columns > KOKSMA_PLOT_MAX_CELLS || o->rows > KOKSMA_PLOT_MAX_CELLS) {
        return koksma__fail(KOKSMA_ARGUMENT, "a grid of %zu columns and %zu rows: each is up to %d", o->columns,
                            o->rows, KOKSMA_PLOT_MAX_CELLS);
    }
    if (o->local_discrepancy && (o->warp || panel->points->dim != 2)) {
        return koksma__fail(KOKSMA_ARGUMENT, "the local discrepancy is drawn of points of the square, 2 dimensions");
    }
    if (o->warp && o->witness) {
        return koksma__fail(KOKSMA_ARGUMENT, "a witness is drawn in the square, not through a map");
    }
    if (o->witness && (unsigned)o->witness->kind > KOKSMA_WITNESS_DISK) {
        return koksma__fail(KOKSMA_ARGUMENT, "%d is no kind of witness", (int)o->witness->kind);
    }
    for (int k = 0; o->witness && k < 2; k++) {
        if (!(fabs(o->witness->lo[k]) <= FAR && fabs(o->witness->hi[k]) <= FAR)) {
            return koksma__fail(KOKSMA_ARGUMENT, "a witness whose bounds are not within %d of 0", FAR);
        }
    }
    return koksma__points_check(panel->points);
}

koksma_status koksma__canvas_size(koksma_plot_format format, double asked, double fallback, double *size)
{
    if (format != KOKSMA_PLOT_SVG && format != KOKSMA_PLOT_PDF && format != KOKSMA_PLOT_PNG) {
        return koksma__fail(KOKSMA_ARGUMENT, "%d is no format of a plot", (int)format);
    }
    *size = asked == 0 ? fallback : asked;
    return *size >= KOKSMA_PLOT_MIN_SIZE && *size <= KOKSMA_PLOT_MAX_SIZE
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_ARGUMENT, "a picture of size %g: it takes %d to %d", asked, KOKSMA_PLOT_MIN_SIZE,
                              KOKSMA_PLOT_MAX_SIZE);
}

koksma_status koksma_plot_panels(const koksma_panel *panels, size_t n, double size, koksma_plot_format format,
                                 unsigned char **bytes, size_t *n_bytes)
{
    KOKSMA__REQUIRE(panels, bytes, n_bytes);
    bool captions = false, scales = false;
    double side = 0; /* gcc does not see that a failure leaves before it is used */
    const koksma_status sized = koksma__canvas_size(format, size, 320, &side);
    if (sized) {
        return sized;
    }
    if (n == 0 || side * (double)n > KOKSMA_PLOT_MAX_SIZE) {
        return koksma__fail(KOKSMA_ARGUMENT, "%zu panels of side %g: a picture is 1 to %d wide", n, side,
                            KOKSMA_PLOT_MAX_SIZE);
    }
    for (size_t i = 0; i < n; i++) {
        const koksma_status checked = check_panel(&panels[i]);
        if (checked) {
            return checked;
        }
        captions = captions || panels[i].caption;
        scales = scales || !panels[i].points || panels[i].scatter.local_discrepancy;
    }
    koksma__canvas *canvas;
    const koksma_status opened =
        koksma__canvas_open(format, side * (double)n, side + LINE * ((captions ? 1 : 0) + (scales ? 1 : 0)), &canvas);
    if (opened) {
        return opened;
    }
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status; i++) {
        status = draw_panel(canvas, &panels[i], side * (double)i, side, scales);
    }
    const koksma_status closed = koksma__canvas_close(canvas, bytes, n_bytes);
    if (status && !closed) {
        free(*bytes);
    }
    return status ? status : closed;
}

koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                  koksma_plot_format format, unsigned char **bytes, size_t *size)
{
    KOKSMA__REQUIRE(points, bytes, size);
    static const koksma_scatter_options plain = {0};
    options = options ? options : &plain;
    const koksma_panel panel = {.points = points, .scatter = *options, .caption = options->caption};
    return koksma_plot_panels(&panel, 1, options->size, format, bytes, size);
}

koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format)
{
    KOKSMA__REQUIRE(path, format);
    static const char *const endings[] = {".svg", ".pdf", ".png"};
    const size_t length = strlen(path);
    for (int i = 0; i < 3; i++) {
        if (length > 4 && !strcmp(path + length - 4, endings[i])) {
            *format = (koksma_plot_format)i;
            return KOKSMA_OK;
        }
    }
    return koksma__fail(KOKSMA_ARGUMENT, "%s: a picture's name ends in .svg, .pdf or .png", path);
}

koksma_status koksma_plot_write(const char *path, const unsigned char *bytes, size_t size)
{
    KOKSMA__REQUIRE(path, bytes);
    const koksma_status status = koksma__array_check("bytes", bytes, size, 1);
    return status ? status : koksma__atomic_put(NULL, path, bytes, size);
}
