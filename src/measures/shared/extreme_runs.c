/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shortens the points for a set of strips with nearly equal sides. Most points of these strips are in all of them; of
 * a run of such points, next to each other in order of y, a box is bounded with four functions of the strip's width
 * instead of its points (the summary of a maximum subarray: Bentley 1984). Strips with s left and s right sides have
 * at most 2 s other points, so that a pass over their list takes O(s), not O(n), and the list of a subset of strips is
 * made from the list of the set.
 *
 * Each function is a maximum of lines in the width, thus convex. It is kept at a few widths, the knots; between them
 * the chord is an upper bound. The error of a chord is about .1 points: over a set both the range of n width and the
 * number of runs are about 2 s.
 */
#include "measures/shared/extreme_runs.h"

#include <math.h>

enum { KNOTS = KOKSMA__RUN_KNOTS };

static const double none = -1e300; /* finite: chords between two of these must not be NaN */

static void clear(koksma__run *r)
{
    r->count = 0;
    for (int k = 0; k < KNOTS; k++) {
        r->top[k] = r->bottom[k] = r->excess[k] = r->deficit[k] = none;
    }
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Puts the run `above` on top of r. */
static inline void append(koksma__run *r, const koksma__run *above)
{
    for (int k = 0; k < KNOTS; k++) {
        const double top = above->top[k] + r->count, bottom = above->bottom[k] - r->count;
        r->excess[k] = larger(larger(r->excess[k], above->excess[k]), top + r->bottom[k]);
        r->deficit[k] = larger(larger(r->deficit[k], above->deficit[k]), bottom + r->top[k]);
        r->top[k] = larger(r->top[k], top);
        r->bottom[k] = larger(r->bottom[k], bottom);
    }
    r->count += above->count;
}

static inline void append_point(koksma__run *r, const double *knots, double y)
{
    koksma__run point = {.count = 1};
    for (int k = 0; k < KNOTS; k++) {
        point.bottom[k] = knots[k] * y;
        point.top[k] = 1 - point.bottom[k];
        point.excess[k] = 1;
        point.deficit[k] = none;
    }
    append(r, &point);
}

/* Bounds of a run at other knots: left[k] is the knot before knot k, part[k] where it is between that and the next. */
static inline koksma__run at_knots(const koksma__run *r, const int *left, const double *part)
{
    koksma__run to = {.count = r->count};
    for (int k = 0; k < KNOTS; k++) {
        const int i = left[k];
        to.top[k] = r->top[i] + part[k] * (r->top[i + 1] - r->top[i]);
        to.bottom[k] = r->bottom[i] + part[k] * (r->bottom[i + 1] - r->bottom[i]);
        to.excess[k] = r->excess[i] + part[k] * (r->excess[i + 1] - r->excess[i]);
        to.deficit[k] = r->deficit[i] + part[k] * (r->deficit[i + 1] - r->deficit[i]);
    }
    return to;
}

static void set_line(double to[2], const double *values, double narrow, double wide)
{
    to[1] = wide > narrow ? (values[KNOTS - 1] - values[0]) / (wide - narrow) : 0;
    to[0] = values[0] - to[1] * narrow;
}

static void add(koksma__run_list *to, double x, double y, const koksma__run *below)
{
    const size_t i = to->count++;
    const double narrow = to->knots[0], wide = to->knots[KNOTS - 1];
    to->x[i] = x;
    to->y[i] = y;
    to->runs[i] = *below;
    set_line(to->lines[i], below->top, narrow, wide);
    set_line(to->lines[i] + 2, below->bottom, narrow, wide);
    set_line(to->lines[i] + 4, below->excess, narrow, wide);
    set_line(to->lines[i] + 6, below->deficit, narrow, wide);
    to->lines[i][8] = below->count;
}

void koksma__run_list_init(koksma__run_list *list, koksma__run_place *places)
{
    const size_t size = KOKSMA__RUN_CAPACITY;
    *list = (koksma__run_list){.runs = (koksma__run *)places};
    list->x = (double *)(list->runs + size);
    list->y = list->x + size;
    list->lines = (double(*)[KOKSMA__RUN_NUMBERS])(list->y + size);
}

static void set_knots(const koksma__run_list *from, const koksma__strip_set *set, koksma__run_list *to, int *left,
                      double *part)
{
    for (int k = 0, i = 0; k < KNOTS; k++) {
        const double w = to->knots[k] =
            k < KNOTS - 1 ? set->narrow + (set->wide - set->narrow) * k / (KNOTS - 1) : set->wide;
        while (i < KNOTS - 2 && from->knots[i + 1] <= w) {
            i++;
        }
        const double step = from->knots[i + 1] - from->knots[i];
        left[k] = i;
        part[k] = step > 0 ? fmin(fmax((w - from->knots[i]) / step, 0), 1) : 0;
    }
}

_Bool koksma__run_list_narrow(const koksma__run_list *from, const koksma__strip_set *set, koksma__run_list *to)
{
    int left[KNOTS] = {0};
    double part[KNOTS] = {0};
    koksma__run run;
    set_knots(from, set, to, left, part);
    clear(&run);
    to->count = 0;
    for (size_t i = 0; i < from->count; i++) {
        const double x = from->x[i];
        if (from->runs && from->runs[i].count > 0) {
            const koksma__run moved = at_knots(&from->runs[i], left, part);
            append(&run, &moved);
        }
        if (x > set->a2 && x < set->b1) {
            append_point(&run, to->knots, from->y[i]);
        } else if ((x >= set->a1 && x <= set->b2) || i + 1 == from->count) {
            if (to->count == KOKSMA__RUN_CAPACITY) {
                return 0;
            }
            add(to, x, from->y[i], &run);
            clear(&run);
        }
    }
    return 1;
}
