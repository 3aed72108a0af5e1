/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Summarises the points of a set of strips with nearly equal sides. Most points are in all of these strips. A run is
 * a sequence of such points that are adjacent in order of y. To find the best box of a strip, four functions of w
 * replace the points of a run; w is n times the width of the strip. (They are the summary in Bentley's algorithm for
 * the maximum subarray, 1984.) With i and j numbering the points of the run from 1:
 *
 *     top = max j - w y_j,   bottom = max w y_i - (i - 1),
 *     excess = max j - i + 1 - w (y_j - y_i) over i <= j,   deficit = max w (y_j - y_i) - (j - i - 1) over i < j.
 *
 * A set of strips is stored as a list in order of y: the points that are not in runs, and between two of them the
 * summary of a run. A set with s left and s right sides has at most 2 s points that are not in runs, so a pass over its
 * list takes O(s), not O(n). The list of a subset of the strips is made from the list of the whole set, not from all
 * points.
 *
 * Each function is a maximum of lines, thus convex: the chord between its values at the narrowest and at the widest
 * strip is an upper bound, and only the chord is stored. Both the range of w and the number of runs are about 2 s, so
 * that chords are too high only by some tenths of a point. If all strips have equal widths, the chords are exact.
 */
#include "measures/extreme/extreme.h"

enum {
    TOP = 0,
    BOTTOM = 2,
    EXCESS = 4,
    DEFICIT = 6,
    COUNT = 8
}; /* indices into the numbers of a run in a list; TOP to DEFICIT are lines, each with an offset and a slope */

/* The functions of a run at the narrowest and at the widest strip. */
typedef struct ends {
    double count, top[2], bottom[2], excess[2], deficit[2];
} ends;

#define NONE (-1e300) /* not infinite, because the chord between two such values must not be NaN */

static const ends no_points = {0, {NONE, NONE}, {NONE, NONE}, {NONE, NONE}, {NONE, NONE}};

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Appends to the run e the run `above`, which follows it in order of y. */
static inline void append(ends *e, ends above)
{
    for (int k = 0; k < 2; k++) {
        const double top = above.top[k] + e->count, bottom = above.bottom[k] - e->count;
        e->excess[k] = larger(larger(e->excess[k], above.excess[k]), top + e->bottom[k]);
        e->deficit[k] = larger(larger(e->deficit[k], above.deficit[k]), bottom + e->top[k]);
        e->top[k] = larger(e->top[k], top);
        e->bottom[k] = larger(e->bottom[k], bottom);
    }
    e->count += above.count;
}

static inline void append_point(ends *e, const double w[2], double y)
{
    const double low = w[0] * y, high = w[1] * y;
    append(e, (ends){1, {1 - low, 1 - high}, {low, high}, {1, 1}, {NONE, NONE}});
}

static inline void append_run(ends *e, const double w[2], const double *run)
{
    ends above = {.count = run[COUNT]};
    for (int k = 0; k < 2; k++) {
        above.top[k] = run[TOP] + run[TOP + 1] * w[k];
        above.bottom[k] = run[BOTTOM] + run[BOTTOM + 1] * w[k];
        above.excess[k] = run[EXCESS] + run[EXCESS + 1] * w[k];
        above.deficit[k] = run[DEFICIT] + run[DEFICIT + 1] * w[k];
    }
    append(e, above);
}

static inline void set_chord(double line[2], const double values[2], double narrow, double scale)
{
    line[1] = (values[1] - values[0]) * scale;
    line[0] = values[0] - line[1] * narrow;
}

void koksma__run_list_init(koksma__run_list *list, koksma__run_place *places)
{
    list->runs = (double(*)[KOKSMA__RUN_NUMBERS])places;
    list->x = (double *)(list->runs + KOKSMA__RUN_CAPACITY);
    list->y = list->x + KOKSMA__RUN_CAPACITY;
}

bool koksma__run_list_narrow(const koksma__run_list *from, const koksma__strip_set *set, koksma__run_list *to)
{
    const double w[2] = {set->narrow, set->wide},
                 scale = w[1] - w[0] > 1e-13 ? 1 / (w[1] - w[0]) : 0; /* slopes <= 1 */
    ends e = no_points;
    to->count = 0;
    for (size_t i = 0; i < from->count; i++) {
        const double x = from->x[i];
        if (from->runs && from->runs[i][COUNT] > 0) {
            append_run(&e, w, from->runs[i]);
        }
        if (x > set->a2 && x < set->b1) {
            append_point(&e, w, from->y[i]);
        } else if ((x >= set->a1 && x <= set->b2) || i + 1 == from->count) {
            if (to->count == KOKSMA__RUN_CAPACITY) {
                return false;
            }
            double *run = to->runs[to->count];
            to->x[to->count] = x;
            to->y[to->count++] = from->y[i];
            set_chord(run + TOP, e.top, w[0], scale);
            set_chord(run + BOTTOM, e.bottom, w[0], scale);
            set_chord(run + EXCESS, e.excess, w[0], scale);
            set_chord(run + DEFICIT, e.deficit, w[0], scale);
            run[COUNT] = e.count;
            e = no_points;
        }
    }
    return true;
}
