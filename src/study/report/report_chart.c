/* SPDX-License-Identifier: Apache-2.0 */
#include "study/report/report_chart.h"

#include <math.h>
#include <stdio.h>

enum { WIDTH = 620, HEIGHT = 380, LEFT = 70, RIGHT = 230, TOP = 14, BOTTOM = 48, COLOURS = 8, SHAPES = 3 };

typedef struct axis {
    double low, high;
    bool is_log;
    double from, to; /* in the picture */
} axis;

static double place(const axis *a, double value)
{
    const double v = a->is_log ? log10(value) : value;
    return a->from + (a->to - a->from) * (v - a->low) / (a->high - a->low);
}

static bool fits(const axis *a, double value)
{
    return isfinite(value) && (!a->is_log || value > 0);
}

static void widen(axis *a, double value)
{
    if (fits(a, value)) {
        const double v = a->is_log ? log10(value) : value;
        a->low = fmin(a->low, v);
        a->high = fmax(a->high, v);
    }
}

/* What a bar takes beyond the means: no more than they span themselves, at least a third of a decade or of the value.
 */
static void widen_for_bars(axis *a, const koksma__chart *c)
{
    const double span = a->high - a->low, room = fmax(span, a->is_log ? 0.33 : 0.33 * fabs(a->high));
    axis bars = *a;
    for (size_t s = 0; s < c->n; s++) {
        for (size_t i = 0; i < c->series[s].n; i++) {
            widen(&bars, c->series[s].low[i]);
            widen(&bars, c->series[s].high[i]);
        }
    }
    if (isfinite(room)) {
        a->low = fmax(bars.low, a->low - room);
        a->high = fmin(bars.high, a->high + room);
    }
}

static void settle(axis *a)
{
    if (!(a->high > a->low)) {
        const double middle = isfinite(a->low) ? a->low : 0;
        a->low = middle - 0.5;
        a->high = middle + 0.5;
    }
    const double margin = 0.05 * (a->high - a->low);
    a->low -= margin;
    a->high += margin;
}

static void add_tick(koksma__html *h, const axis *a, bool horizontal, double value)
{
    const double at = place(a, value);
    if (horizontal) {
        koksma__html_add(h,
                         "<path class=\"tick\" d=\"M%.1f %dV%d\"/><text x=\"%.1f\" y=\"%d\" "
                         "text-anchor=\"middle\">%.4g</text>",
                         at, TOP, HEIGHT - BOTTOM, at, HEIGHT - BOTTOM + 17, value);
    } else {
        koksma__html_add(h,
                         "<path class=\"tick\" d=\"M%d %.1fH%d\"/><text x=\"%d\" y=\"%.1f\" "
                         "text-anchor=\"end\">%.4g</text>",
                         LEFT, at, WIDTH - RIGHT, LEFT - 6, at + 4, value);
    }
}

/* 1, 2 or 5 times a power of ten apart, from low to high. */
static void add_even_ticks(koksma__html *h, const axis *a, bool horizontal, double low, double high)
{
    const double raw = (high - low) / 5, power = pow(10, floor(log10(raw)));
    const double step = raw / power < 1.5 ? power : raw / power < 3.5 ? 2 * power : 5 * power;
    for (double v = ceil(low / step); v * step <= high; v++) {
        add_tick(h, a, horizontal, v * step + 0.0); /* no -0 */
    }
}

/* Decades with 2 and 5 where there is room. Of less than a decade those would be too few. */
static void add_ticks(koksma__html *h, const axis *a, bool horizontal)
{
    const double decades = a->high - a->low;
    if (!a->is_log) {
        add_even_ticks(h, a, horizontal, a->low, a->high);
    } else if (decades < 0.9) {
        add_even_ticks(h, a, horizontal, pow(10, a->low), pow(10, a->high));
    } else {
        for (double d = floor(a->low); d <= ceil(a->high); d++) {
            static const double steps[] = {1, 2, 5};
            for (int k = 0; k < (decades < 2.5 ? 3 : 1); k++) {
                const double value = steps[k] * pow(10, d);
                if (log10(value) >= a->low && log10(value) <= a->high && (decades < 8 || fmod(d, 2) == 0)) {
                    add_tick(h, a, horizontal, value);
                }
            }
        }
    }
}

/* A bar's end. One that goes on beyond the axis, as to 0 on a logarithmic one, ends with it in an arrowhead. */
static void add_bar_end(koksma__html *h, const axis *y, double at_x, double value)
{
    const double at = fits(y, value) ? place(y, value) : y->from + (y->from - y->to);
    if (at > y->from || at < y->to) {
        const double end = at > y->from ? y->from : y->to, back = at > y->from ? -4 : 4;
        koksma__html_add(h, "V%.1fM%.1f %.1fl3 %.0fM%.1f %.1fl-3 %.0fM%.1f %.1f", end, at_x, end, back, at_x, end,
                         back, at_x, end);
    } else {
        koksma__html_add(h, "V%.1f", at);
    }
}

/* A dot, a square or a triangle in turn: with as many colours no two of 24 series look alike, and without colours
   neighbours don't. */
static void add_shape(koksma__html *h, size_t index, double x, double y, bool large)
{
    const double r = large ? 5 : 3, wide = r * 4 / 3;
    if (index % SHAPES == 0) {
        koksma__html_add(h, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.0f\">", x, y, r);
    } else if (index % SHAPES == 1) {
        koksma__html_add(h, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.0f\" height=\"%.0f\">", x - r, y - r, 2 * r,
                         2 * r);
    } else {
        koksma__html_add(h, "<polygon points=\"%.1f,%.1f %.1f,%.1f %.1f,%.1f\">", x - wide, y + r, x + wide, y + r, x,
                         y - wide);
    }
}

static size_t style_of(const koksma__chart *c, size_t s)
{
    return c->series[s].like ? c->series[s].like - 1 : s;
}

static const char *end_of_shape(size_t index)
{
    return index % SHAPES == 0 ? "</circle>" : index % SHAPES == 1 ? "</rect>" : "</polygon>";
}

static void add_mark(koksma__html *h, const axis *x, const axis *y, const koksma__chart_series *s, size_t i,
                     size_t index)
{
    const double at_x = place(x, s->x[i]), at_y = place(y, s->y[i]);
    if (s->low[i] < s->high[i]) {
        koksma__html_add(h, "<path d=\"M%.1f %.1f", at_x, at_y);
        add_bar_end(h, y, at_x, s->low[i]);
        add_bar_end(h, y, at_x, s->high[i]);
        koksma__html_add(h, "\"/>");
    }
    add_shape(h, index, at_x, at_y, s->hollow);
    koksma__html_add(h, "<title>");
    koksma__html_text(h, s->label);
    koksma__html_add(h, ": %.6g, %.6g</title>%s", s->x[i], s->y[i], end_of_shape(index));
}

static void add_series(koksma__html *h, const axis *x, const axis *y, const koksma__chart_series *s, size_t index)
{
    koksma__html_add(h, "<g class=\"%s s%zu\">",
                     s->theory   ? "theory"
                     : s->hollow ? "series hollow"
                                 : "series",
                     index % COLOURS);
    bool begun = false;
    for (size_t i = 0; i < s->n && (s->line || s->theory); i++) {
        if (fits(x, s->x[i]) && fits(y, s->y[i])) {
            koksma__html_add(h, begun ? "L%.1f %.1f" : "<path class=\"line\" d=\"M%.1f %.1f", place(x, s->x[i]),
                             place(y, s->y[i]));
            begun = true;
        }
    }
    koksma__html_add(h, "%s", begun ? "\"/>" : "");
    for (size_t i = 0; i < s->n && !s->theory; i++) {
        if (fits(x, s->x[i]) && fits(y, s->y[i])) {
            add_mark(h, x, y, s, i, index);
        }
    }
    koksma__html_add(h, "</g>\n");
}

static void add_legend(koksma__html *h, const koksma__chart *c)
{
    double at = TOP + 12;
    for (size_t s = 0; s < c->n; s++) {
        if (c->series[s].hollow) {
            continue;
        }
        koksma__html_add(h, "<g class=\"%s s%zu\">", c->series[s].theory ? "theory" : "series",
                         style_of(c, s) % COLOURS);
        if (c->series[s].line || c->series[s].theory) {
            koksma__html_add(h, "<path class=\"line\" d=\"M%d %.1fh18\"/>", WIDTH - RIGHT + 8, at - 4);
        }
        if (!c->series[s].theory) {
            add_shape(h, style_of(c, s), WIDTH - RIGHT + 17, at - 4, false);
            koksma__html_add(h, "%s", end_of_shape(style_of(c, s)));
        }
        koksma__html_add(h, "</g><text x=\"%d\" y=\"%.1f\">", WIDTH - RIGHT + 30, at);
        koksma__html_text(h, c->series[s].label);
        koksma__html_add(h, "</text>");
        at += 15;
    }
}

void koksma__html_chart(koksma__html *h, const koksma__chart *c)
{
    axis x = {INFINITY, -INFINITY, c->log_x, LEFT, WIDTH - RIGHT};
    axis y = {INFINITY, -INFINITY, c->log_y, HEIGHT - BOTTOM, TOP};
    for (size_t s = 0; s < c->n; s++) {
        for (size_t i = 0; i < c->series[s].n; i++) {
            widen(&x, c->series[s].x[i]);
            widen(&y, c->series[s].y[i]);
        }
    }
    widen_for_bars(&y, c);
    settle(&x);
    settle(&y);
    koksma__html_add(h, "<figure class=\"chart\"><svg viewBox=\"0 0 %d %d\" width=\"%d\" role=\"img\" aria-label=\"",
                     WIDTH, HEIGHT, WIDTH);
    koksma__html_text(h, c->title);
    koksma__html_add(h, "\">\n");
    add_ticks(h, &x, true);
    add_ticks(h, &y, false);
    koksma__html_add(h, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">", (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8);
    koksma__html_text(h, c->x_title);
    koksma__html_add(h, "</text><text transform=\"translate(14 %d) rotate(-90)\" text-anchor=\"middle\">",
                     (TOP + HEIGHT - BOTTOM) / 2);
    koksma__html_text(h, c->y_title);
    koksma__html_add(h, "</text>\n");
    for (size_t s = 0; s < c->n; s++) {
        add_series(h, &x, &y, &c->series[s], style_of(c, s));
    }
    add_legend(h, c);
    koksma__html_add(h, "</svg><figcaption>");
    koksma__html_text(h, c->title);
    if (c->left_out) {
        koksma__html_add(h, ". %zu more are not in this picture.", c->left_out);
    }
    koksma__html_add(h, "</figcaption></figure>\n");
}
