/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A quadtree of sources, rebuilt in every step of a descent: a radix sort orders the sources by the
 * interleaved bits of their coordinates (Morton 1966), so that the sources of a box are a range of the sorted array.
 * Neighbouring points share one walk down the tree: they form a group, the sources of a box with at most 32 sources
 * whose parent has more. The walk collects the ranges of those leaves that are in reach of the bounding box of the
 * group's points, and the kernel source_force sums over these ranges for each point. The kernel's cut-off distance is
 * the same for both points of a pair, so that the forces are the gradient of an energy. Building the tree takes O(n);
 * the forces on a point take about O(log n + number of sources in reach). The order in which forces are added depends
 * only on the sources.
 */
#include "domains/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { LEAF = 8, DEEPEST = 16, PADDING = 8 };

/* RUNS: the largest number of ranges for one call of the kernel. GAP: two ranges at most this many sources apart
   become one range, because the kernel takes eight sources at a time; the sources between them are out of reach and
   add 0. */
enum { RUNS = 128, GAP = 8 };

/* The weight exp(-d^2 / v) - exp(-CUT2) is 0 at the cut-off d^2 = CUT2 v. Without the second term it would jump there,
   and points would bounce off the jump. */
#define CUT2 12.0
#define AT_CUT 0x1.9c54c3b43bc8bp-18 /* exp(-CUT2) */

koksma_status koksma__source_tree_init(koksma__source_tree *t, const koksma__point_domain *domain, size_t n)
{
    const size_t length = n + PADDING; /* the kernel reads beyond the last source */
    const size_t bytes =
        4 * length * sizeof(double) + n * (2 * sizeof *t->keys + 2 * sizeof *t->order) + sizeof *t->order;
    *t = (koksma__source_tree){.lengths = {domain->lengths[0], domain->lengths[1]}, .n = n};
    t->columns[0] = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(t->columns[0], bytes);
    for (int c = 1; c < 4; c++) {
        t->columns[c] = t->columns[c - 1] + length;
    }
    t->keys = (uint64_t *)(t->columns[3] + length);
    t->spare = t->keys + n;
    t->order = (uint32_t *)(t->spare + n);
    t->groups = t->order + n;
    return KOKSMA_OK;
}

void koksma__source_tree_fini(koksma__source_tree *t)
{
    free(t->columns[0]);
    free(t->boxes);
    *t = (koksma__source_tree){0};
}

/* Returns the interleaved first DEEPEST bits of both coordinates. */
static uint32_t key_of(const double x[2])
{
    const uint32_t i = (uint32_t)ldexp(x[0], DEEPEST), j = (uint32_t)ldexp(x[1], DEEPEST);
    uint32_t key = 0;
    for (int bit = DEEPEST - 1; bit >= 0; bit--) {
        key = key << 2 | (i >> bit & 1) << 1 | (j >> bit & 1);
    }
    return key;
}

/* Sorts the keys: the upper half of each has the interleaved bits, the lower half the number of the source. */
static koksma_status sort_keys(koksma__source_tree *t, const koksma_run *run)
{
    for (int shift = 32; shift < 64; shift += 8) {
        size_t start[257] = {0};
        for (size_t i = 0; i < t->n; i++) {
            start[(t->keys[i] >> shift & 255) + 1]++;
        }
        for (int b = 0; b < 256; b++) {
            start[b + 1] += start[b];
        }
        for (size_t i = 0; i < t->n; i++) {
            KOKSMA__TRY(koksma__look(run, i, 0));
            t->spare[start[t->keys[i] >> shift & 255]++] = t->keys[i];
        }
        uint64_t *swapped = t->keys;
        t->keys = t->spare;
        t->spare = swapped;
    }
    return KOKSMA_OK;
}

static koksma_status add_boxes(koksma__source_tree *t, size_t n)
{
    KOKSMA__TRY(koksma__reserve(&t->boxes, &t->capacity, t->n_boxes + n, sizeof *t->boxes));
    t->n_boxes += n;
    return KOKSMA_OK;
}

/* Makes the box of sources first .. end - 1 without bounds; extend_by_sources() sets these. */
static koksma__source_box empty_box(size_t first, size_t end)
{
    const double least = -INFINITY, most = INFINITY;
    return (koksma__source_box){
        .low = {most, most}, .high = {least, least}, .first = (uint32_t)first, .end = (uint32_t)end};
}

/* Extends the bounds of a box so that they contain those of another box. */
static void extend(koksma__source_box *box, const koksma__source_box *by)
{
    for (int k = 0; k < 2; k++) {
        box->low[k] = by->low[k] < box->low[k] ? by->low[k] : box->low[k];
        box->high[k] = by->high[k] > box->high[k] ? by->high[k] : box->high[k];
    }
    box->square = by->square > box->square ? by->square : box->square;
}

static void extend_by_sources(const koksma__source_tree *t, koksma__source_box *box)
{
    for (size_t i = box->first; i < box->end; i++) {
        const double x = t->columns[0][i], y = t->columns[1][i];
        extend(box, &(koksma__source_box){.low = {x, y}, .high = {x, y}, .square = t->columns[2][i]});
    }
}

/* Divides box number b, at this depth of the tree, until its boxes have at most LEAF sources or the greatest
   depth. */
static koksma_status divide(koksma__source_tree *t, size_t b, int depth, const koksma_run *run)
{
    KOKSMA__TRY(koksma__look(run, b, 0));
    const int shift = 32 + (DEEPEST - 1 - depth) * 2;
    koksma__source_box box = t->boxes[b];
    if (box.end - box.first <= LEAF || depth == DEEPEST) {
        extend_by_sources(t, &t->boxes[b]);
        return KOKSMA_OK;
    }
    box.child = (uint32_t)t->n_boxes;
    KOKSMA__TRY(add_boxes(t, 4));
    uint32_t at = box.first;
    for (unsigned w = 0; w < 4; w++) {
        uint32_t end = at;
        while (end < box.end && (t->keys[end] >> shift & 3) == w) {
            end++;
        }
        if (end > at) {
            t->boxes[box.child + box.children++] = empty_box(at, end);
        }
        at = end;
    }
    for (uint32_t i = 0; i < box.children; i++) {
        KOKSMA__TRY(divide(t, box.child + i, depth + 1, run));
        extend(&box, &t->boxes[box.child + i]);
    }
    t->boxes[b] = box;
    return KOKSMA_OK;
}

/* Makes groups of the sources of a box. A leaf with more sources than fit into a group, which are nearly at one
   position, is split into several groups. */
static void add_groups(koksma__source_tree *t, const koksma__source_box *box)
{
    if (box->end - box->first <= KOKSMA__SOURCE_GROUP || !box->children) {
        for (uint32_t at = box->first; at < box->end; at += KOKSMA__SOURCE_GROUP) {
            t->groups[t->n_groups++] = at;
        }
        return;
    }
    for (uint32_t i = 0; i < box->children; i++) {
        add_groups(t, &t->boxes[box->child + i]);
    }
}

koksma_status koksma__source_tree_build(koksma__source_tree *t,
                                        koksma__field_node (*source)(const void *context, size_t i),
                                        const void *context, const koksma_run *run)
{
    for (size_t i = 0; i < t->n; i++) {
        KOKSMA__TRY(koksma__look(run, i, 0));
        const koksma__field_node node = source(context, i);
        t->keys[i] = (uint64_t)key_of(node.x) << 32 | i;
    }
    KOKSMA__TRY(sort_keys(t, run));
    for (size_t i = 0; i < t->n; i++) {
        KOKSMA__TRY(koksma__look(run, i, 0));
        t->order[i] = (uint32_t)t->keys[i];
        const koksma__field_node node = source(context, t->order[i]);
        t->columns[0][i] = node.x[0] * t->lengths[0];
        t->columns[1][i] = node.x[1] * t->lengths[1];
        t->columns[2][i] = node.square;
        t->columns[3][i] = node.mass;
    }
    t->n_boxes = 0;
    KOKSMA__TRY(add_boxes(t, 1));
    t->boxes[0] = empty_box(0, t->n);
    KOKSMA__TRY(divide(t, 0, 0, run));
    t->n_groups = 0;
    add_groups(t, &t->boxes[0]);
    t->groups[t->n_groups] = (uint32_t)t->n;
    return KOKSMA_OK;
}

/* The walk of a group down the tree. low, high: bounding box of the group's points; from, to: this box moved by
   `offset`, a period of the torus; square: largest squared width of the points; runs: ranges of sources that were
   found and are not summed yet. */
typedef struct walk {
    const koksma__source_tree *t;
    size_t count;
    uint32_t points[KOKSMA__SOURCE_GROUP], start; /* numbers in the sorted array; start: of the first source */
    double low[2], high[2], square, offset[2], from[2], to[2];
    size_t n_runs;
    uint32_t runs[2 * RUNS];
    double (*force)[2];
} walk;

/* Adds the forces of the sources in the ranges to those on the group's points, and empties the list of ranges. */
static void sum_runs(walk *w)
{
    for (size_t i = 0; i < w->count && w->n_runs; i++) {
        const uint32_t at = w->points[i];
        double part[2], *force = w->force[at - w->start];
        const double x[2] = {w->t->columns[0][at] + w->offset[0], w->t->columns[1][at] + w->offset[1]};
        koksma__kernels()->source_force(w->n_runs, w->runs, (const double *const *)w->t->columns, x,
                                        w->t->columns[2][at], CUT2, AT_CUT, part);
        force[0] += part[0];
        force[1] += part[1];
    }
    w->n_runs = 0;
}

static void add_run(walk *w, uint32_t first, uint32_t end)
{
    uint32_t *last = w->runs + 2 * (w->n_runs - 1);
    if (w->n_runs && first - last[1] <= GAP) { /* boxes are visited in the order of their sources */
        last[1] = end;
        return;
    }
    if (w->n_runs == RUNS) {
        sum_runs(w);
    }
    w->runs[2 * w->n_runs] = first;
    w->runs[2 * w->n_runs + 1] = end;
    w->n_runs++;
}

/* Returns the distance between two intervals; 0 if they overlap. */
static double gap(double low, double high, double from, double to)
{
    const double below = from - high, above = low - to, most = below > above ? below : above;
    return most > 0 ? most : 0;
}

/* Adds the leaves below a box that are in reach of the group. */
static void visit(walk *w, const koksma__source_box *box)
{
    const double x = gap(w->from[0], w->to[0], box->low[0], box->high[0]);
    const double y = gap(w->from[1], w->to[1], box->low[1], box->high[1]);
    if (x * x + y * y > CUT2 * (w->square + box->square)) {
        return;
    }
    if (!box->children) {
        add_run(w, box->first, box->end);
    }
    const koksma__source_box *child = w->t->boxes + box->child;
    for (uint32_t i = 0; i < box->children; i++) {
        visit(w, &child[i]);
    }
}

/* Collects the sources of a group that are points, whose numbers before sorting are at least `first`. */
static void gather(walk *w, size_t group, size_t first)
{
    const koksma__source_tree *t = w->t;
    for (uint32_t at = w->start; at < t->groups[group + 1]; at++) {
        if (t->order[at] < first) {
            continue;
        }
        for (int k = 0; k < 2; k++) {
            const double x = t->columns[k][at];
            w->low[k] = w->count && w->low[k] < x ? w->low[k] : x;
            w->high[k] = w->count && w->high[k] > x ? w->high[k] : x;
            w->force[at - w->start][k] = 0;
        }
        w->square = fmax(w->square, t->columns[2][at]);
        w->points[w->count++] = at;
    }
}

void koksma__source_forces(const koksma__source_tree *t, size_t group, size_t first,
                           double force[KOKSMA__SOURCE_GROUP][2])
{
    walk w = {.t = t, .start = t->groups[group], .force = force};
    gather(&w, group, first);
    const double reach = sqrt(CUT2 * (w.square + t->boxes[0].square));
    int images[2];
    for (int k = 0; k < 2; k++) {
        images[k] = (int)ceil(fmax(reach / t->lengths[k], 0.5) - 0.5) + 1;
    }
    for (int i = -images[0]; i <= images[0] && w.count; i++) {
        for (int j = -images[1]; j <= images[1]; j++) {
            w.offset[0] = i * t->lengths[0];
            w.offset[1] = j * t->lengths[1];
            for (int k = 0; k < 2; k++) {
                w.from[k] = w.low[k] + w.offset[k];
                w.to[k] = w.high[k] + w.offset[k];
            }
            visit(&w, &t->boxes[0]);
            sum_runs(&w);
        }
    }
}
