/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Curves on a pair of axes. Ticks of a linear axis are at multiples of 1, 2 or 5 times a power of ten. Those of a
 * logarithmic axis are at powers of ten, also at 2 and 5 times these if the axis spans at most two decades, or at the
 * abscissas of the marks if there are few. The layout from top to bottom: title, label of y, axes, ticks and label of
 * x, and the legend, which is below the axes so that it hides no curve.
 */
#include "plot/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/status.h"

enum { MARGIN = 8, TITLE = 13, TEXT = 11, SWATCH = 28, MAX_TICKS = 64, MAX_SIZES = 12, TICK = 32 };

typedef struct axis {
    double low, high; /* range of the values, or of their logarithms to base 10 */
    bool log;
    double from, to; /* range on the canvas */
} axis;

typedef struct axes {
    koksma__canvas *canvas;
    const koksma__theme *theme;
    axis x, y;
    koksma__box box;
} axes;

static double scaled(const axis *a, double value)
{
    return !a->log ? value : value > 0 ? koksma__log10(value) : (double)NAN;
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

static double error_of(const koksma_curve *k, size_t j)
{
    return k->errors && isfinite(k->errors[j]) && k->errors[j] > 0 ? k->errors[j] : 0;
}

static void find_ranges(const koksma_chart *c, axis *x, axis *y)
{
    for (size_t i = 0; i < c->n_curves; i++) {
        const koksma_curve *k = &c->curves[i];
        for (size_t j = 0; j < k->n && !k->dashed; j++) {
            if (isfinite(scaled(x, k->xs[j])) && isfinite(scaled(y, k->ys[j]))) {
                const double low = k->ys[j] - error_of(k, j);
                widen(x, k->xs[j]);
                widen(y, k->ys[j] + error_of(k, j));
                widen(y, low > 0 || !y->log ? low : k->ys[j]);
            }
        }
    }
    if (c->has_level && y->high >= y->low) {
        widen(y, c->level);
    }
}

/* Ranges below this part of the values are rounding noise, or too small for labels of 8 digits to show. */
#define NOISE 1e-6

/* Widens the range of values that differ only by noise: by half the value, or half a decade, at both ends. */
static void widen_noise(axis *a)
{
    const double middle = a->low / 2 + a->high / 2, size = fmax(fabs(a->low), fabs(a->high));
    if (a->high - a->low <= NOISE * (a->log ? 1 / koksma__log(10) : size)) {
        const double half = a->log || size == 0 ? 0.5 : size / 2;
        a->low = middle - half;
        a->high = middle + half;
    }
}

/* Extends the range a little at both ends; a linear axis whose low end is positive and small begins at exactly 0.
   Returns false if the axis has no values. */
static bool settle(axis *a, double room)
{
    if (!(a->high >= a->low)) {
        return false;
    }
    widen_noise(a);
    const double span = a->high - a->low;
    const bool from_zero = !a->log && a->low >= 0 && a->low < 0.3 * a->high;
    a->low = from_zero ? 0 : a->low - room * span;
    a->high += room * span;
    return true;
}

koksma_status koksma__chart_check(const koksma_chart *c)
{
    koksma_status status = koksma__array_check("chart->curves", c->curves, c->n_curves, sizeof *c->curves);
    for (size_t i = 0; i < c->n_curves && !status; i++) {
        const koksma_curve *k = &c->curves[i];
        status = koksma__array_check("curves->xs", k->xs, k->n, sizeof *k->xs);
        status = status ? status : koksma__array_check("curves->ys", k->ys, k->n, sizeof *k->ys);
    }
    axis x = {HUGE_VAL, -HUGE_VAL, c->log_x, 0, 1}, y = {HUGE_VAL, -HUGE_VAL, c->log_y, 0, 1};
    if (!status) {
        find_ranges(c, &x, &y);
    }
    return status || (settle(&x, 0) && settle(&y, 0))
               ? status
               : koksma__fail(KOKSMA_ARGUMENT, "%s: no value can be drawn", c->y_label ? c->y_label : "chart");
}

/* ---- Ticks -------------------------------------------------------------------------------------------- */

static int linear_ticks(double low, double high, double most, double ticks[MAX_TICKS])
{
    int n = 0;
    const double raw = (high - low) / fmax(most, 2), power = koksma__pow(10, floor(koksma__log10(raw))),
                 lead = raw / power;
    const double step = power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
    for (double i = ceil(low / step); i * step <= high + 1e-12 * step && n < MAX_TICKS; i++) {
        ticks[n++] = i * step + 0.0; /* ceil gives -0, too */
    }
    return n;
}

/* Writes the values of the ticks and returns their number. most: the number of labels for which there is space. */
static int find_ticks(const axis *a, double most, double ticks[MAX_TICKS])
{
    if (!a->log) {
        return linear_ticks(a->low, a->high, most, ticks);
    }
    int n = 0;
    const int per_decade = a->high - a->low > 2 ? 1 : 3;
    const double step = fmax(1, ceil((a->high - a->low) / most));
    for (double e = floor(a->low); e <= a->high; e += step) {
        for (int m = 0; m < per_decade; m++) {
            const double value = koksma__pow(10, e) * (m == 0 ? 1 : m == 1 ? 2 : 5);
            if (koksma__log10(value) >= a->low && koksma__log10(value) <= a->high && n < MAX_TICKS) {
                ticks[n++] = value;
            }
        }
    }
    return n > 1 ? n : linear_ticks(koksma__pow(10, a->low), koksma__pow(10, a->high), fmin(most, 4), ticks);
}

/* Writes the abscissas of the marks in ascending order, for ticks, and returns their number, or 0 if there are too
   many. */
static int marked_xs(const koksma_chart *c, const axis *x, double ticks[MAX_TICKS])
{
    int n = 0;
    for (size_t i = 0; i < c->n_curves; i++) {
        for (size_t j = 0; j < c->curves[i].n && c->curves[i].marks; j++) {
            const double value = c->curves[i].xs[j];
            int at = n;
            while (at > 0 && ticks[at - 1] >= value) {
                at--;
            }
            if (isfinite(scaled(x, value)) && (at == n || ticks[at] != value)) {
                if (n == MAX_SIZES) {
                    return 0;
                }
                memmove(ticks + at + 1, ticks + at, (size_t)(n++ - at) * sizeof *ticks);
                ticks[at] = value;
            }
        }
    }
    return n > 1 ? n : 0;
}

/* Formats a value as %g does, but without a plus sign and leading zeros in the exponent. */
static const char *tick_text(double value, char text[TICK])
{
    koksma__snprintf(text, TICK, "%.8g", value);
    char *e = strchr(text, 'e'), *digits = e ? e + 1 : NULL;
    if (e && (*digits == '+' || *digits == '-')) {
        e += *digits++ == '-' ? 2 : 1;
        digits += strspn(digits, "0");
        memmove(e, digits, strlen(digits) + 1);
    }
    return text;
}

static void draw_ticks(const axes *a, const koksma_chart *c)
{
    double ticks[MAX_TICKS], end = -HUGE_VAL;
    char text[TICK];
    const koksma__style line = {0.7, a->theme->grid, KOKSMA__DASH_WHOLE};
    int n = c->log_x ? marked_xs(c, &a->x, ticks) : 0;
    n = n ? n : find_ticks(&a->x, a->box.width / 55, ticks);
    for (int i = 0; i < n; i++) {
        const double at = place(&a->x, ticks[i]), half = koksma__text_width(tick_text(ticks[i], text), TEXT) / 2;
        koksma__canvas_line(a->canvas, at, a->y.from, at, a->y.to, line);
        if (at - half > end + 4 && at + half < a->box.x + a->box.width + MARGIN) {
            koksma__canvas_text(a->canvas, at, a->y.from + 14, TEXT, 0.5, text, a->theme->ink);
            end = at + half;
        }
    }
    end = HUGE_VAL;
    n = find_ticks(&a->y, a->box.height / 34, ticks);
    for (int i = 0; i < n; i++) {
        const double at = place(&a->y, ticks[i]);
        koksma__canvas_line(a->canvas, a->x.from, at, a->x.to, at, line);
        if (at < end - TEXT) {
            koksma__canvas_text(a->canvas, a->x.from - 5, at + 4, TEXT, 1, tick_text(ticks[i], text), a->theme->ink);
            end = at;
        }
    }
}

/* The width of the widest label of y; the ticks of y depend only on the height of the chart. */
static double label_width(const axis *y, double height)
{
    double ticks[MAX_TICKS], widest = 0;
    char text[TICK];
    for (int i = find_ticks(y, height / 34, ticks) - 1; i >= 0; i--) {
        widest = fmax(widest, koksma__text_width(tick_text(ticks[i], text), TEXT));
    }
    return widest + 8;
}

/* ---- Curves ------------------------------------------------------------------------------------------- */

static koksma__style style_of(const koksma__theme *theme, const koksma_curve *k)
{
    return k->dashed ? (koksma__style){1, theme->guide, KOKSMA__DASH_GUIDE}
                     : koksma__curve_style(theme, k->colour, 1.5);
}

/* Draws a mark of a curve. Its shape depends on the curve's colour and dash, so that curves can be distinguished
   without colours: a disk, a square, a triangle, a diamond, a triangle that points down, a plus, a star, a cross. */
static void draw_mark(koksma__canvas *canvas, double x, double y, const koksma_curve *k, koksma__style style)
{
    enum { MOST_CORNERS = 12 };
    static const struct {
        size_t n;
        double at[2 * MOST_CORNERS];
    } shapes[] = {{4, {-1, -1, 1, -1, 1, 1, -1, 1}},
                  {3, {-1.2, 1, 1.2, 1, 0, -1.2}},
                  {4, {0, -1.5, 1.5, 0, 0, 1.5, -1.5, 0}},
                  {3, {-1.2, -1, 1.2, -1, 0, 1.2}},
                  {12, {-0.4, -1.5, 0.4,  -1.5, 0.4,  -0.4, 1.5,  -0.4, 1.5,  0.4,  0.4,  0.4,
                        0.4,  1.5,  -0.4, 1.5,  -0.4, 0.4,  -1.5, 0.4,  -1.5, -0.4, -0.4, -0.4}},
                  {10, {0, -1.7, 0.42, -0.58, 1.62,  -0.53, 0.68,  0.22,  1,     1.38,
                        0, 0.72, -1,   1.38,  -0.68, 0.22,  -1.62, -0.53, -0.42, -0.58}},
                  {12, {-0.78, -1.34, 0, -0.57, 0.78,  -1.34, 1.34,  -0.78, 0.57,  0, 1.34,  0.78,
                        0.78,  1.34,  0, 0.57,  -0.78, 1.34,  -1.34, 0.78,  -0.57, 0, -1.34, -0.78}}};
    const size_t n_shapes = 1 + sizeof shapes / sizeof *shapes;
    const size_t shape = k->dashed ? 0 : (k->colour + k->colour / KOKSMA__COLOURS) % n_shapes;
    double at[2 * MOST_CORNERS];
    style.thickness = 0;
    if (shape == 0) {
        canvas->draw->circle(canvas, x, y, 2.6, style);
        return;
    }
    for (size_t i = 0; i < 2 * shapes[shape - 1].n; i++) {
        at[i] = (i % 2 ? y : x) + 2.4 * shapes[shape - 1].at[i];
    }
    canvas->draw->path(canvas, at, shapes[shape - 1].n, style);
}

/* Draws the standard errors of a run of points that begins at `first`: as bars if the curve has marks, otherwise as a
   band. */
static void draw_errors(const axes *a, const koksma_curve *k, size_t first, size_t n, double *band)
{
    koksma__style style = style_of(a->theme, k);
    bool any = false;
    for (size_t i = 0; i < n; i++) {
        const size_t j = first + i;
        const double x = place(&a->x, k->xs[j]), down = place(&a->y, k->ys[j] - error_of(k, j));
        double *up = band + 2 * i, *back = band + 2 * (2 * n - 1 - i);
        up[0] = back[0] = x;
        up[1] = place(&a->y, k->ys[j] + error_of(k, j));
        back[1] = isfinite(down) ? down : a->y.from;
        any = any || error_of(k, j) > 0;
        if ((k->marks || n == 1) && error_of(k, j) > 0) {
            koksma__canvas_line(a->canvas, x, up[1], x, back[1],
                                (koksma__style){0.8, style.colour, KOKSMA__DASH_WHOLE});
        }
    }
    if (any && !k->marks && n > 1) {
        style.thickness = 0;
        style.colour.a = 0.2;
        a->canvas->draw->path(a->canvas, band, 2 * n, style);
    }
}

/* Draws each run of finite points as a line, and a run of one point as a mark. xys: scratch of 4 numbers for each
   point. */
static void draw_curve(const axes *a, const koksma_curve *k, double *xys)
{
    const koksma__style style = style_of(a->theme, k);
    for (size_t j = 0, n; j < k->n; j += n ? n : 1) {
        for (n = 0; j + n < k->n && isfinite(scaled(&a->x, k->xs[j + n])) && isfinite(scaled(&a->y, k->ys[j + n]));) {
            n++;
        }
        if (k->errors && n) {
            draw_errors(a, k, j, n, xys);
        }
        for (size_t i = 0; i < n; i++) {
            xys[2 * i] = place(&a->x, k->xs[j + i]);
            xys[2 * i + 1] = place(&a->y, k->ys[j + i]);
        }
        if (n > 1) {
            koksma__canvas_path_inside(a->canvas, xys, n, a->box, style);
        }
        for (size_t i = 0; i < n && (k->marks || n == 1); i++) {
            draw_mark(a->canvas, xys[2 * i], xys[2 * i + 1], k, style);
        }
    }
}

/* Draws the legend's entries from left to right, each label once; with a NULL canvas it draws nothing. Returns the
   height. */
static double legend(koksma__canvas *canvas, const koksma__theme *theme, const koksma_chart *c, koksma__box box)
{
    const double line = koksma__line_height(TEXT) + 1, right = box.x + box.width;
    double x = box.x, y = box.y;
    for (size_t i = 0; i < c->n_curves; i++) {
        const koksma_curve *k = &c->curves[i];
        bool again = false;
        for (size_t j = 0; j < i && k->label; j++) {
            again = again || (c->curves[j].label && !strcmp(c->curves[j].label, k->label) && k->dashed);
        }
        if (!k->label || again) {
            continue;
        }
        const double width = SWATCH + koksma__text_width(k->label, TEXT);
        if (y == box.y || x + width > right) {
            x = box.x;
            y += line;
        }
        if (canvas) {
            koksma__style style = style_of(theme, k);
            koksma__canvas_line(canvas, x, y - 4, x + 22, y - 4, style);
            if (k->marks) {
                draw_mark(canvas, x + 11, y - 4, k, style);
            }
        }
        const size_t lines =
            koksma__canvas_lines(canvas, x + SWATCH, y, fmax(right - x - SWATCH, 1), TEXT, 0, k->label, theme->ink);
        y += (double)(lines - 1) * koksma__line_height(TEXT);
        x = lines > 1 ? right : x + width + 14;
    }
    return y - box.y;
}

enum { ABOVE = 8, TICKS = 20, BELOW = 6 };

double koksma__chart_texts(const koksma_chart *c, double width)
{
    const double inner = width - 2 * MARGIN;
    return koksma__lines_height(c->title, inner, TITLE) + koksma__lines_height(c->y_label, inner, TEXT) + ABOVE +
           TICKS + koksma__lines_height(c->x_label, inner, TEXT) +
           legend(NULL, koksma__theme_of(false), c, (koksma__box){.x = MARGIN, .width = inner}) + BELOW + MARGIN;
}

koksma_status koksma__chart_draw(koksma__canvas *canvas, const koksma__theme *theme, const koksma_chart *c,
                                 koksma__box box)
{
    const double left = box.x + MARGIN, inner = box.width - 2 * MARGIN;
    const double height = fmax(box.height - koksma__chart_texts(c, box.width), 1);
    double y = box.y;
    koksma__canvas_lines(canvas, left, y + TITLE + 2, inner, TITLE, 0, c->title, theme->ink);
    y += koksma__lines_height(c->title, inner, TITLE);
    koksma__canvas_lines(canvas, left, y + TEXT + 2, inner, TEXT, 0, c->y_label, theme->ink);
    y += koksma__lines_height(c->y_label, inner, TEXT) + ABOVE;
    axes a = {canvas,
              theme,
              {HUGE_VAL, -HUGE_VAL, c->log_x, 0, 0},
              {HUGE_VAL, -HUGE_VAL, c->log_y, y + height, y},
              {.x = 0}};
    find_ranges(c, &a.x, &a.y);
    settle(&a.x, c->log_x ? 0.04 : 0.01);
    settle(&a.y, 0.05);
    a.x.from = left + label_width(&a.y, height);
    a.x.to = fmax(left + inner - 4, a.x.from + 1);
    a.box = (koksma__box){a.x.from, y, a.x.to - a.x.from, height};
    draw_ticks(&a, c);
    canvas->draw->box(canvas, a.box, (koksma__style){1, theme->frame, KOKSMA__DASH_WHOLE});
    if (c->has_level) {
        const double at = place(&a.y, c->level);
        koksma__canvas_line(canvas, a.x.from, at, a.x.to, at, (koksma__style){1, theme->guide, KOKSMA__DASH_GUIDE});
    }
    size_t longest = 1;
    for (size_t i = 0; i < c->n_curves; i++) {
        longest = c->curves[i].n > longest ? c->curves[i].n : longest;
    }
    double *xys = malloc(4 * longest * sizeof *xys);
    for (size_t i = 0; i < c->n_curves && xys; i++) {
        draw_curve(&a, &c->curves[i], xys);
    }
    free(xys);
    KOKSMA__REQUIRE_MEMORY(xys, 4 * longest * sizeof *xys);
    y += height + TICKS;
    koksma__canvas_lines(canvas, left + inner / 2, y + TEXT, inner, TEXT, 0.5, c->x_label, theme->ink);
    y += koksma__lines_height(c->x_label, inner, TEXT) + BELOW;
    legend(canvas, theme, c, (koksma__box){left, y, inner, 0});
    return KOKSMA_OK;
}
