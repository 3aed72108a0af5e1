/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The code that all backends share: the choice of the backend for a format; clipping of shapes at a box (lines by
 * Liang and Barsky, polygons by Sutherland and Hodgman); and texts. The layout uses an upper bound of the width of
 * each class of characters instead of real widths, so that positions and line breaks are the same with any font.
 */
#include "plot/plot.h"

#include <math.h>
#include <string.h>

#include "core/status.h"
#include "modules/module.h"

static const koksma__module module = {"cairo", "cairo", {koksma__fail, koksma__fail_memory, NULL}};

static koksma_status load(const koksma__canvas_functions **out)
{
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    *out = functions;
    return status;
}

const char *koksma_plot_library(void)
{
    const koksma__canvas_functions *functions;
    return load(&functions) ? NULL : functions->library();
}

koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, const char *title,
                                  koksma__colour paper, koksma__canvas **out)
{
    const koksma__canvas_functions *draw = &koksma__svg_functions;
    char text[KOKSMA_MAX_SPEC];
    static const double dashes[][KOKSMA__MAX_DASHES + 1] = {{0}, {9, 3}, {2, 2}, {9, 3, 2, 3}, {4, 3}};
    *out = NULL;
    koksma_status status = format == KOKSMA_PLOT_SVG ? KOKSMA_OK : load(&draw);
    strncpy(text, title ? title : "", sizeof text - 1);
    text[sizeof text - 1] = '\0';
    koksma_text_escape(text, sizeof text);
    status = status ? status : draw->open(format, width, height, text, out);
    if (!status) {
        (*out)->draw = draw;
        (*out)->dashes = dashes;
        (*out)->draw->box(*out, (koksma__box){0, 0, width, height}, (koksma__style){.colour = paper});
    }
    return status;
}

/* ---- Shapes ------------------------------------------------------------------------------------------- */

void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, koksma__style style)
{
    canvas->draw->path(canvas, (double[]){x0, y0, x1, y1}, 2, style);
}

/* The signed distance of a position from the line through side 0 to 3 of a box, positive inside. */
static double depth(const double *xy, koksma__box b, int side)
{
    const double low = side % 2 ? b.y : b.x, high = low + (side % 2 ? b.height : b.width);
    return side < 2 ? xy[side % 2] - low : high - xy[side % 2];
}

/* Computes the point where the line from a to b crosses a side. */
static void cross(const double *a, const double *b, double depth_a, double depth_b, double *out)
{
    const double t = depth_a / (depth_a - depth_b);
    out[0] = a[0] + t * (b[0] - a[0]);
    out[1] = a[1] + t * (b[1] - a[1]);
}

/* Clips a polygon at the four sides in turn; a side adds at most one corner to a convex polygon. */
static void polygon_inside(koksma__canvas *canvas, const double *xys, size_t n, koksma__box inside,
                           koksma__style style)
{
    double corners[2][2 * (2 * KOKSMA__MAX_CORNERS + 8)];
    memcpy(corners[0], xys, 2 * n * sizeof *xys);
    for (int side = 0; side < 4; side++) {
        const double *from = corners[side % 2];
        double *to = corners[1 - side % 2];
        size_t kept = 0;
        for (size_t i = 0; i < n; i++) {
            const double *a = from + 2 * i, *b = from + 2 * ((i + 1) % n);
            const double at_a = depth(a, inside, side), at_b = depth(b, inside, side);
            if (at_a >= 0) {
                memcpy(to + 2 * kept++, a, 2 * sizeof *a);
            }
            if ((at_a >= 0) != (at_b >= 0)) {
                cross(a, b, at_a, at_b, to + 2 * kept++);
            }
        }
        n = kept;
    }
    if (n > 2) {
        canvas->draw->path(canvas, corners[0], n, style);
    }
}

void koksma__canvas_path_inside(koksma__canvas *canvas, const double *xys, size_t n, koksma__box inside,
                                koksma__style style)
{
    bool cut = false;
    for (size_t i = 0; i < 4 * n; i++) {
        cut = cut || depth(xys + 2 * (i / 4), inside, (int)(i % 4)) < 0;
    }
    if (!cut) {
        canvas->draw->path(canvas, xys, n, style);
    } else if (!(style.thickness > 0)) {
        polygon_inside(canvas, xys, n, inside, style);
    }
    for (size_t i = 1; cut && style.thickness > 0 && i < n; i++) {
        const double *a = xys + 2 * (i - 1), *b = xys + 2 * i;
        double ends[2] = {0, 1};
        for (int side = 0; side < 4; side++) {
            const double at_a = depth(a, inside, side), at_b = depth(b, inside, side), t = at_a / (at_a - at_b);
            ends[0] = at_a < 0 ? (at_b < 0 ? 2 : fmax(ends[0], t)) : ends[0];
            ends[1] = at_a >= 0 && at_b < 0 ? fmin(ends[1], t) : ends[1];
        }
        if (ends[0] < ends[1]) {
            koksma__canvas_line(canvas, a[0] + ends[0] * (b[0] - a[0]), a[1] + ends[0] * (b[1] - a[1]),
                                a[0] + ends[1] * (b[0] - a[0]), a[1] + ends[1] * (b[1] - a[1]), style);
        }
    }
}

/* ---- Texts -------------------------------------------------------------------------------------------- */

enum { MAX_TEXT = 1024, MAX_LINES = 16 };

double koksma__line_height(double height)
{
    return ceil(1.3 * height);
}

/* The largest width of a class of characters in DejaVu Sans, which is wider than Helvetica and Arial, as a multiple
   of the height. */
static double character_width(unsigned char c)
{
    return c >= 0x80 ? ((c & 0xc0) == 0x80 ? 0 : 0.9) /* continuation bytes of UTF-8 have no width */
           : strchr("iljI|.,:;'! `", c)  ? 0.41
           : strchr("fjrt()[]/-\"\\", c) ? 0.47
           : strchr("mwMW@%", c)         ? 1
           : strchr("+=<>~#^&", c)       ? 0.84
           : c >= 'A' && c <= 'Z'        ? 0.79
                                         : 0.64;
}

double koksma__text_width(const char *text, double height)
{
    double width = 0;
    for (; *text; text++) {
        width += character_width((unsigned char)*text);
    }
    return width * height;
}

void koksma__canvas_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                         koksma__colour colour)
{
    char shown[MAX_TEXT] = "";
    strncpy(shown, text, sizeof shown - 1);
    koksma_text_escape(shown, sizeof shown);
    canvas->draw->text(canvas, x, y, height, anchor, shown, colour);
}

/* Whether a line may break before text[at]: after a punctuation mark inside a word, or at a blank unless it belongs
   to an equation such as "n = 16". */
static bool may_break(const char *text, size_t at)
{
    const char last = text[at - 1], before = at > 1 ? text[at - 2] : ' ';
    return last == ' ' ? before != '=' && text[at] != '='
                       : strchr(",:;@/_-=", last) && before != ' ' && text[at] != ' ';
}

/* The number of bytes of the first line, which ends at the last blank or punctuation mark that fits; if there is
   none, as many characters as fit, at least one. */
static size_t line_length(const char *text, double width, double height)
{
    size_t fits = 0, best = 0;
    double used = 0;
    while (text[fits]) {
        size_t step = 1;
        while ((text[fits + step] & 0xc0) == 0x80) {
            step++;
        }
        used += character_width((unsigned char)text[fits]) * height;
        if (used > width && fits > 0) {
            return best > 0 ? best : fits;
        }
        fits += step;
        best = may_break(text, fits) ? fits : best;
    }
    return fits;
}

size_t koksma__canvas_lines(koksma__canvas *canvas, double x, double y, double width, double height, double anchor,
                            const char *text, koksma__colour colour)
{
    char shown[MAX_TEXT] = "", line[MAX_TEXT];
    size_t n = 0;
    strncpy(shown, text ? text : "", sizeof shown - 1);
    koksma_text_escape(shown, sizeof shown);
    for (const char *at = shown; *at && n < MAX_LINES; n++) {
        const size_t length = line_length(at, width, height);
        memcpy(line, at, length);
        line[length] = '\0';
        line[length - (line[length - 1] == ' ' ? 1 : 0)] = '\0';
        at += length;
        if (canvas) {
            canvas->draw->text(canvas, x, y + (double)n * koksma__line_height(height), height, anchor, line, colour);
        }
    }
    return n;
}

double koksma__lines_height(const char *text, double width, double height)
{
    return (double)koksma__canvas_lines(NULL, 0, 0, width, height, 0, text, (koksma__colour){0}) *
           koksma__line_height(height);
}
