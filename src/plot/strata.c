/* SPDX-License-Identifier: Apache-2.0 */
/* Subdivided squares, as in figures 5.35 and 5.36 of Shirley 1991. */
#include "core/status.h"
#include "plot/canvas.h"

static const koksma__colour line = {0.2, 0.35, 0.75, 1}, dot = {0.85, 0.25, 0.1, 1}, ink = {0.1, 0.1, 0.12, 1};

enum { MARGIN = 6, CAPTION = 18 };

koksma_status koksma_plot_strata(const koksma_stratum *strata, size_t n, double size, const char *caption,
                                 koksma_plot_format format, unsigned char **bytes, size_t *n_bytes)
{
    double whole;
    const koksma_status sized = koksma__canvas_size(format, size, 320, &whole);
    if (sized) {
        return sized;
    }
    const double side = whole - 2 * MARGIN;
    koksma__canvas *canvas;
    const koksma_status opened = koksma__canvas_open(format, whole, whole + (caption ? CAPTION : 0), &canvas);
    if (opened) {
        return opened;
    }
    for (size_t i = 0; i < n; i++) {
        const koksma_stratum *s = &strata[i];
        const double grey = s->value > 1 ? 1 : s->value > 0 ? s->value : 0; /* NaN is black */
        const koksma__colour colour = {grey, grey, grey, 1};
        const double x = MARGIN + s->x * side, y = MARGIN + s->y * side;
        koksma__canvas_box(canvas, x, y, s->width * side, s->height * side, 0, colour);
        koksma__canvas_box(canvas, x, y, s->width * side, s->height * side, 0.6, line);
        koksma__canvas_circle(canvas, MARGIN + s->at[0] * side, MARGIN + s->at[1] * side, s->level ? 1.5 : 2.2, 0,
                              dot);
    }
    if (caption) {
        koksma__canvas_text(canvas, whole / 2, whole + 8, 11, 0.5, caption, ink);
    }
    return koksma__canvas_close(canvas, bytes, n_bytes);
}
