/* SPDX-License-Identifier: Apache-2.0 */
/* Curves on a pair of axes. Ticks are at 1, 2 or 5 times powers of ten; on a logarithmic axis at powers of ten, and
   at 2 and 5 times these where the axis spans less than two decades. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "plot/canvas.h"

enum { LEFT = 58, RIGHT = 14, TOP = 28, BOTTOM = 40, LINE = 15, TEXT = 11, N_COLOURS = 6, MAX_TICKS = 64 };

static const koksma__colour ink = {0.1, 0.1, 0.12, 1}, frame = {0.35, 0.35, 0.4, 1}, grid = {0.88, 0.89, 0.92, 1},
                            guide = {0.45, 0.45, 0.5, 1};
/* After Wong 2011 (Nature Methods 8, 441): told apart with any colour vision. */
static const koksma__colour colours[N_COLOURS] = {{0.00, 0.45, 0.70, 1}, {0.84, 0.37, 0.00, 1},
                                                  {0.00, 0.62, 0.45, 1}, {0.80, 0.47, 0.65, 1},
                                                  {0.34, 0.71, 0.91, 1}, {0.90, 0.62, 0.00, 1}};

typedef struct axis {
    double low, high; /* of the values, or of their logarithms to base 10 */
    bool log;
    double from, to; /* on the canvas */
} axis;

static double scaled(const axis *a, double value)
{
    return !a->log ? value : value > 0 ? log10(value) : (double)NAN;
}

static double place(const axis *a, double value)
{
    return a->from + (scaled(a, value) - a->low) / (a->high - a->low) * (a->to - a->from);
}

static void widen(axis *a, double value)
{
    const double v = scaled(a, value);
    if (isfinite(v)) {
        a->low = fmin(a->low, v);
        a->high = fmax(a->high, v);
    }
}

static koksma_status check_curves(const koksma_chart *c)
{
    koksma_status status = koksma__array_check("chart->curves", c->curves, c->n_curves, sizeof *c->curves);
    for (size_t i = 0; i < c->n_curves && !status; i++) {
        const koksma_curve *k = &c->curves[i];
        status = koksma__array_check("curves->xs", k->xs, k->n, sizeof *k->xs);
        status = status ? status : koksma__array_check("curves->ys", k->ys, k->n, sizeof *k->ys);
    }
    return status;
}

static void find_ranges(const koksma_chart *c, axis *x, axis *y)
{
    for (size_t i = 0; i < c->n_curves; i++) {
        const koksma_curve *k = &c->curves[i];
        for (size_t j = 0; j < k->n && !k->dashed; j++) {
            if (isfinite(scaled(x, k->xs[j])) && isfinite(scaled(y, k->ys[j]))) {
                const double error = k->errors && isfinite(k->errors[j]) ? k->errors[j] : 0;
                widen(x, k->xs[j]);
                widen(y, k->ys[j] + error);
                widen(y, k->ys[j] - error > 0 || !y->log ? k->ys[j] - error : k->ys[j]);
            }
        }
    }
    if (c->has_level && y->high >= y->low) {
        widen(y, c->level);
    }
}

/* A little room at the ends, none below 0 where 0 is the end; false when there is nothing. */
static bool settle(axis *a, double room)
{
    if (!(a->high >= a->low)) {
        return false;
    }
    const double span = a->high > a->low ? a->high - a->low : fmax(fabs(a->high), 1) * 0.5;
    const bool from_zero = !a->log && a->low >= 0 && a->low < 0.3 * a->high;
    a->low = from_zero ? 0 : a->low - room * span;
    a->high += room * span;
    return true;
}

static int find_ticks(const axis *a, double ticks[MAX_TICKS])
{
    int n = 0;
    if (a->log) {
        const bool many = a->high - a->low > 2;
        const double step = fmax(1, ceil((a->high - a->low) / 8));
        for (double e = floor(a->low); e <= a->high; e += step) {
            for (int m = 0; m < (many ? 1 : 3); m++) {
                const double value = pow(10, e) * (m == 0 ? 1 : m == 1 ? 2 : 5);
                if (log10(value) >= a->low && log10(value) <= a->high && n < MAX_TICKS) {
                    ticks[n++] = value;
                }
            }
        }
        return n;
    }
    const double raw = (a->high - a->low) / 6, power = pow(10, floor(log10(raw))), lead = raw / power;
    const double step = power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
    for (double i = ceil(a->low / step); i * step <= a->high * (1 + 1e-12) && n < MAX_TICKS; i++) {
        ticks[n++] = i * step;
    }
    return n;
}

static void draw_axes(koksma__canvas *canvas, const koksma_chart *c, const axis *x, const axis *y)
{
    double ticks[MAX_TICKS];
    char text[32];
    int n = find_ticks(x, ticks);
    for (int i = 0; i < n; i++) {
        const double at = place(x, ticks[i]);
        koksma__canvas_line(canvas, at, y->from, at, y->to, 0.7, grid);
        koksma__snprintf(text, sizeof text, "%g", ticks[i]);
        koksma__canvas_text(canvas, at, y->from + 14, TEXT, 0.5, text, ink);
    }
    n = find_ticks(y, ticks);
    for (int i = 0; i < n; i++) {
        const double at = place(y, ticks[i]);
        koksma__canvas_line(canvas, x->from, at, x->to, at, 0.7, grid);
        koksma__snprintf(text, sizeof text, "%g", ticks[i]);
        koksma__canvas_text(canvas, x->from - 5, at + 4, TEXT, 1, text, ink);
    }
    koksma__canvas_box(canvas, x->from, y->to, x->to - x->from, y->from - y->to, 1, frame);
    if (c->x_label) {
        koksma__canvas_text(canvas, (x->from + x->to) / 2, y->from + 32, TEXT + 1, 0.5, c->x_label, ink);
    }
    if (c->y_label) {
        koksma__canvas_text(canvas, x->from, y->to - 9, TEXT + 1, 0, c->y_label, ink);
    }
}

/* Colours repeat after N_COLOURS curves, with other dashes. */
static koksma__dash dash_of(const koksma_curve *k)
{
    return k->dashed ? KOKSMA__DASH_GUIDE : (koksma__dash)(k->colour / N_COLOURS % KOKSMA__DASH_GUIDE);
}

static void draw_curve(koksma__canvas *canvas, const koksma_curve *k, const axis *x, const axis *y)
{
    const koksma__colour colour = k->dashed ? guide : colours[k->colour % N_COLOURS];
    double last_x = NAN, last_y = NAN, along = 0;
    for (size_t j = 0; j < k->n; j++) {
        const double at_x = place(x, k->xs[j]), at_y = place(y, k->ys[j]);
        const bool shown = isfinite(at_x) && isfinite(at_y);
        if (shown && isfinite(last_x)) {
            koksma__canvas_dash(canvas, dash_of(k), along);
            koksma__canvas_line(canvas, last_x, last_y, at_x, at_y, k->dashed ? 1 : 1.4, colour);
            koksma__canvas_dash(canvas, KOKSMA__DASH_WHOLE, 0);
            along += hypot(at_x - last_x, at_y - last_y);
        }
        if (shown && k->marks) {
            koksma__canvas_circle(canvas, at_x, at_y, 2.6, 0, colour);
        }
        if (shown && k->errors && k->errors[j] > 0) {
            const double up = place(y, k->ys[j] + k->errors[j]), down = place(y, k->ys[j] - k->errors[j]);
            koksma__canvas_line(canvas, at_x, up, at_x, isfinite(down) ? down : y->from, 0.8, colour);
        }
        last_x = shown ? at_x : (double)NAN;
        last_y = at_y;
    }
}

static size_t legend_lines(const koksma_chart *c)
{
    size_t lines = 0;
    for (size_t i = 0; i < c->n_curves; i++) {
        lines += c->curves[i].label != NULL;
    }
    return lines;
}

/* Below the axes, where it hides nothing. */
static void draw_legend(koksma__canvas *canvas, const koksma_chart *c, double left, double top)
{
    for (size_t i = 0; i < c->n_curves; i++) {
        const koksma_curve *k = &c->curves[i];
        if (k->label) {
            koksma__canvas_dash(canvas, dash_of(k), 0);
            koksma__canvas_line(canvas, left, top - 4, left + 22, top - 4, k->dashed ? 1 : 1.8,
                                k->dashed ? guide : colours[k->colour % N_COLOURS]);
            koksma__canvas_dash(canvas, KOKSMA__DASH_WHOLE, 0);
            koksma__canvas_text(canvas, left + 28, top, TEXT, 0, k->label, ink);
            top += LINE;
        }
    }
}

koksma_status koksma_plot_chart(const koksma_chart *chart, koksma_plot_format format, unsigned char **bytes,
                                size_t *n_bytes)
{
    KOKSMA__REQUIRE(chart, bytes, n_bytes);
    double width;
    koksma_status sized = koksma__canvas_size(format, chart->size, 480, &width);
    sized = sized ? sized : check_curves(chart);
    if (sized) {
        return sized;
    }
    const double height = fmax(0.62 * width, TOP + BOTTOM + 40);
    axis x = {HUGE_VAL, -HUGE_VAL, chart->log_x, LEFT, fmax(width - RIGHT, LEFT + 40)};
    axis y = {HUGE_VAL, -HUGE_VAL, chart->log_y, height - BOTTOM, TOP};
    find_ranges(chart, &x, &y);
    if (!settle(&x, chart->log_x ? 0.04 : 0.01) || !settle(&y, 0.05)) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: there is no value that can be drawn",
                            chart->y_label ? chart->y_label : "chart");
    }
    const size_t lines = legend_lines(chart);
    koksma__canvas *canvas;
    const koksma_status opened = koksma__canvas_open(format, fmax(width, LEFT + 40 + RIGHT),
                                                     height + (double)lines * LINE + (lines ? 8 : 0), &canvas);
    if (opened) {
        return opened;
    }
    draw_axes(canvas, chart, &x, &y);
    koksma__canvas_clip(canvas, x.from, y.to, x.to - x.from, y.from - y.to);
    if (chart->has_level) {
        const double at = place(&y, chart->level);
        koksma__canvas_dash(canvas, KOKSMA__DASH_GUIDE, 0);
        koksma__canvas_line(canvas, x.from, at, x.to, at, 1, guide);
        koksma__canvas_dash(canvas, KOKSMA__DASH_WHOLE, 0);
    }
    for (size_t i = 0; i < chart->n_curves; i++) {
        draw_curve(canvas, &chart->curves[i], &x, &y);
    }
    koksma__canvas_clip(canvas, 0, 0, width, height + (double)lines * LINE + 8);
    draw_legend(canvas, chart, LEFT, height + 6);
    return koksma__canvas_close(canvas, bytes, n_bytes);
}
