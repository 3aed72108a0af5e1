/* SPDX-License-Identifier: Apache-2.0 */
/* Computes certified upper bounds (after Thiemard 2001) from boxes [a, b] that cover all corners. No corner y in [a,
   b] has an excess above #(x <= b)/n - volume(a), or a deficit above volume(b) - #(x < a)/n. The box with the largest
   bound is cut in two until the deadline passes or the memory is full; the largest bound that remains is an upper
   bound of the discrepancy. */
#include "measures/star/star.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/shared/shared.h"

enum { MAX_BOXES = 1 << 19, POINTS_PER_CHECK = 1 << 16 };

typedef struct cover {
    const koksma_points *points;
    size_t dim, size; /* size: count of the numbers that describe a box (its bound, a and b) */
    size_t count, room;
    double *boxes, **heap;
} cover;

static void set_bound(const cover *c, double *box)
{
    const double *a = box + 1, *b = a + c->dim;
    const size_t n = c->points->n;
    size_t below_b = 0, below_a = 0;
    double volume_a = 1, volume_b = 1;
    for (size_t i = 0; i < n; i++) {
        const double *x = c->points->xs + i * c->dim;
        bool in_b = true, in_a = true;
        for (size_t k = 0; k < c->dim && in_b; k++) {
            in_b = x[k] <= b[k];
            in_a = in_a && x[k] < a[k];
        }
        below_b += in_b;
        below_a += in_a && in_b;
    }
    for (size_t k = 0; k < c->dim; k++) {
        volume_a *= a[k];
        volume_b *= b[k];
    }
    box[0] = fmax((double)below_b / (double)n - volume_a, volume_b - (double)below_a / (double)n);
}

static void sift_down(const cover *c)
{
    size_t i = 0;
    for (;;) {
        size_t child = 2 * i + 1;
        if (child >= c->count) {
            return;
        }
        if (child + 1 < c->count && c->heap[child + 1][0] > c->heap[child][0]) {
            child++;
        }
        if (c->heap[i][0] >= c->heap[child][0]) {
            return;
        }
        double *other = c->heap[i];
        c->heap[i] = c->heap[child];
        c->heap[child] = other;
        i = child;
    }
}

static void sift_up(const cover *c, size_t i)
{
    while (i > 0 && c->heap[(i - 1) / 2][0] < c->heap[i][0]) {
        double *other = c->heap[i];
        c->heap[i] = c->heap[(i - 1) / 2];
        c->heap[(i - 1) / 2] = other;
        i = (i - 1) / 2;
    }
}

/* Cuts the box at the top of the heap in two. The side that is cut is the one whose length is largest relative to its
   upper end. */
static void cut(cover *c)
{
    double *box = c->heap[0], *other = c->boxes + c->count * c->size;
    double *a = box + 1, *b = a + c->dim, longest = -1;
    size_t side = 0;
    for (size_t k = 0; k < c->dim; k++) {
        const double length = (b[k] - a[k]) / b[k];
        if (length > longest) {
            longest = length;
            side = k;
        }
    }
    const double middle = (a[side] + b[side]) / 2;
    memcpy(other, box, c->size * sizeof *box);
    b[side] = middle;
    other[1 + side] = middle;
    set_bound(c, box);
    set_bound(c, other);
    sift_down(c);
    c->heap[c->count] = other;
    sift_up(c, c->count++);
}

koksma_status koksma__star_cover(const koksma_points *points, const koksma_run *run, double deadline_s, double lower,
                                 double *upper)
{
    cover c = {.points = points, .dim = (size_t)points->dim, .size = 1 + 2 * (size_t)points->dim, .count = 1};
    c.room = MAX_BOXES / (size_t)points->dim;
    const size_t bytes = c.room * (c.size * sizeof(double) + sizeof(double *));
    c.boxes = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(c.boxes, bytes);
    c.heap = (double **)(c.boxes + c.room * c.size);
    c.heap[0] = c.boxes;
    for (size_t k = 0; k < c.dim; k++) {
        c.boxes[1 + k] = 0;
        c.boxes[1 + c.dim + k] = 1;
    }
    set_bound(&c, c.boxes);
    koksma_status status = KOKSMA_OK;
    const size_t cuts_per_check = 1 + POINTS_PER_CHECK / points->n;
    for (size_t i = 0; c.count < c.room && c.heap[0][0] > lower && !status; i++) {
        if (i % cuts_per_check == 0) {
            if (koksma__now_s() > deadline_s) {
                break;
            }
            status = koksma__keep_going(run, 0.9) ? KOKSMA_OK : koksma__fail_interrupted();
        }
        cut(&c);
    }
    *upper = fmax(c.heap[0][0], lower);
    free(c.boxes);
    return status;
}
