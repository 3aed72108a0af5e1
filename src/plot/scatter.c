/* SPDX-License-Identifier: Apache-2.0 */
/* Point sets in the unit square, as in figures 5.13 to 5.27 of Shirley 1991. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/atomic_file.h"
#include "core/status.h"
#include "plot/canvas.h"

static const koksma__colour ink = {0.1, 0.1, 0.12, 1}, frame = {0.35, 0.35, 0.4, 1}, guide = {0.75, 0.78, 0.85, 1},
                            mark = {0.85, 0.25, 0.1, 0.9}, wash = {0.95, 0.5, 0.3, 0.25};

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

static void draw_guides(const plot *p, size_t columns, size_t rows)
{
    for (size_t i = 1; i < columns; i++) {
        const double x = at_x(p, (double)i / (double)columns);
        koksma__canvas_line(p->canvas, x, p->top, x, p->top + p->side, 0.6, guide);
    }
    for (size_t i = 1; i < rows; i++) {
        const double y = at_y(p, (double)i / (double)rows);
        koksma__canvas_line(p->canvas, p->left, y, p->left + p->side, y, 0.6, guide);
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
    } else if (w->kind == KOKSMA_WITNESS_HALF_PLANE) {
        const double a = w->lo[0], b = w->lo[1], norm = hypot(a, b), reach = 2;
        const double x = a * w->hi[0] / (norm * norm), y = b * w->hi[0] / (norm * norm);
        koksma__canvas_line(p->canvas, at_x(p, x - reach * b / norm), at_y(p, y + reach * a / norm),
                            at_x(p, x + reach * b / norm), at_y(p, y - reach * a / norm), 1.2, mark);
    }
}

koksma_status koksma_plot_scatter(const koksma_points *points, const koksma_scatter_options *options,
                                  koksma_plot_format format, unsigned char **bytes, size_t *size)
{
    if (points->dim < 2) {
        return koksma__fail(KOKSMA_DIM, "a scatter plot takes points of 2 or more dimensions");
    }
    const double width = options->size > 0 ? options->size : 320, margin = 6;
    const double caption = options->caption ? 20 : 0;
    const plot p = {koksma__canvas_open(format, width, width + caption), margin, margin, width - 2 * margin};
    if (!p.canvas) {
        return koksma__fail_memory(sizeof(plot));
    }
    koksma__canvas_clip(p.canvas, p.left - 1, p.top - 1, p.side + 2, p.side + 2);
    draw_guides(&p, options->columns, options->rows);
    if (options->witness) {
        draw_witness(&p, options->witness);
    }
    koksma__canvas_box(p.canvas, p.left, p.top, p.side, p.side, 1, frame);
    koksma__canvas_clip(p.canvas, 0, 0, width, width + caption);
    const double radius = fmax(0.6, fmin(4, 0.14 * p.side / sqrt((double)points->n)));
    for (size_t i = 0; i < points->n; i++) {
        const double *x = points->xs + i * (size_t)points->dim;
        koksma__canvas_circle(p.canvas, at_x(&p, x[0]), at_y(&p, x[1]), radius, 0, ink);
    }
    if (options->caption) {
        koksma__canvas_text(p.canvas, width / 2, width + 13, 12, 0.5, options->caption, ink);
    }
    return koksma__canvas_close(p.canvas, bytes, size);
}

koksma_status koksma_plot_format_of(const char *path, koksma_plot_format *format)
{
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
    koksma__atomic_file file;
    const koksma_status status = koksma__atomic_open(path, &file);
    if (status) {
        return status;
    }
    fwrite(bytes, 1, size, file.stream);
    return koksma__atomic_close(&file, true);
}
