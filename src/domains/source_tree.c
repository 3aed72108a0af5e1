/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A quadtree or octree of sources, rebuilt in every step of a descent: sources are sorted by the interleaved bits of
 * their coordinates (Morton 1966) with a radix sort, so that a box is a range of them. A sum descends to the boxes that
 * the wider of both widths can reach. Pairs are cut off by a rule that is the same for both, so that their forces stay
 * those of an energy. Time: building n, a sum about log n and the sources in reach. The order of a sum depends on the
 * sources alone.
 */
#include "domains/source_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"

enum { LEAF = 8, DEEPEST = 16 };

/* The weight exp(-d^2 / v) - exp(-CUT2) is 0 at the cut-off d^2 = CUT2 v. Without the second term it would jump there,
   and points would bounce off the jump. */
#define CUT2 12.0
#define AT_CUT 0x1.9c54c3b43bc8bp-18 /* exp(-CUT2) */

koksma_status koksma__source_tree_init(koksma__source_tree *t, int dim, bool torus, size_t n)
{
    const size_t bytes = n * (sizeof *t->sources + 2 * sizeof *t->keys + sizeof *t->order);
    *t = (koksma__source_tree){.dim = dim, .torus = torus, .n = n};
    t->sources = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(t->sources, bytes);
    t->keys = (uint64_t *)(t->sources + n);
    t->spare = t->keys + n;
    t->order = (uint32_t *)(t->spare + n);
    return KOKSMA_OK;
}

void koksma__source_tree_fini(koksma__source_tree *t)
{
    free(t->sources);
    free(t->boxes);
    *t = (koksma__source_tree){0};
}

/* Returns the interleaved bits of the coordinates: the first DEEPEST bits of each in the plane, the first 10 in
   space. */
static uint32_t key_of(const double *x, int dim)
{
    const int bits = dim == 2 ? DEEPEST : 10;
    uint32_t key = 0, cells[3];
    for (int k = 0; k < dim; k++) {
        cells[k] = (uint32_t)ldexp(x[k], bits);
    }
    for (int bit = bits - 1; bit >= 0; bit--) {
        for (int k = 0; k < dim; k++) {
            key = key << 1 | (cells[k] >> bit & 1);
        }
    }
    return key;
}

/* Sorts the keys: the upper half of each has the interleaved bits, the lower half the number of the source. */
static void sort_keys(koksma__source_tree *t)
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
            t->spare[start[t->keys[i] >> shift & 255]++] = t->keys[i];
        }
        uint64_t *swapped = t->keys;
        t->keys = t->spare;
        t->spare = swapped;
    }
}

static koksma_status add_boxes(koksma__source_tree *t, size_t n)
{
    if (t->n_boxes + n > t->capacity) {
        const size_t more = 2 * t->capacity + 1024;
        koksma__source_box *grown = realloc(t->boxes, more * sizeof *grown);
        KOKSMA__REQUIRE_MEMORY(grown, more * sizeof *grown);
        t->boxes = grown;
        t->capacity = more;
    }
    t->n_boxes += n;
    return KOKSMA_OK;
}

/* Divides box number b, at a depth, as far as it has many sources. */
static koksma_status divide(koksma__source_tree *t, size_t b, int depth)
{
    const int bits = t->dim == 2 ? DEEPEST : 10, ways = 1 << t->dim, shift = 32 + (bits - 1 - depth) * t->dim;
    const koksma__source_box box = t->boxes[b];
    double square = 0;
    for (size_t i = box.first; i < box.end && (box.end - box.first <= LEAF || depth == bits); i++) {
        square = fmax(square, t->sources[i].square);
    }
    t->boxes[b].square = square;
    if (box.end - box.first <= LEAF || depth == bits) {
        return KOKSMA_OK;
    }
    const size_t child = t->n_boxes;
    KOKSMA__TRY(add_boxes(t, (size_t)ways));
    t->boxes[b].child = (uint32_t)child;
    uint32_t n = 0, at = box.first;
    for (int w = 0; w < ways; w++) {
        uint32_t end = at;
        while (end < box.end && (int)(t->keys[end] >> shift & (uint64_t)(ways - 1)) == w) {
            end++;
        }
        if (end > at) {
            koksma__source_box *c = &t->boxes[child + n++];
            *c = (koksma__source_box){.side = box.side / 2, .first = at, .end = end};
            for (int k = 0; k < t->dim; k++) {
                c->low[k] = box.low[k] + (w >> (t->dim - 1 - k) & 1 ? c->side : 0);
            }
        }
        at = end;
    }
    t->boxes[b].children = n;
    for (uint32_t i = 0; i < n; i++) {
        KOKSMA__TRY(divide(t, child + i, depth + 1));
        square = fmax(square, t->boxes[child + i].square);
    }
    t->boxes[b].square = square;
    return KOKSMA_OK;
}

koksma_status koksma__source_tree_build(koksma__source_tree *t,
                                        koksma__field_node (*source)(const void *context, size_t i),
                                        const void *context)
{
    for (size_t i = 0; i < t->n; i++) {
        const koksma__field_node node = source(context, i);
        t->keys[i] = (uint64_t)key_of(node.x, t->dim) << 32 | i;
    }
    sort_keys(t);
    for (size_t i = 0; i < t->n; i++) {
        t->order[i] = (uint32_t)t->keys[i];
        t->sources[i] = source(context, t->order[i]);
    }
    t->n_boxes = 0;
    KOKSMA__TRY(add_boxes(t, 1));
    t->boxes[0] = (koksma__source_box){.side = 1, .end = (uint32_t)t->n};
    return divide(t, 0, 0);
}

/* A sum at x, of the sources' image that is visited. */
typedef struct sum {
    const koksma__source_tree *t;
    double x[3], square, force[3];
} sum;

static void add_leaf(sum *s, const koksma__source_box *box)
{
    const int dim = s->t->dim;
    for (uint32_t j = box->first; j < box->end; j++) {
        const koksma__field_node *source = &s->t->sources[j];
        double t[3] = {0}, distance = 0;
        for (int k = 0; k < dim && k < 3; k++) {
            t[k] = s->x[k] - source->x[k];
            distance += t[k] * t[k];
        }
        const double v = s->square + source->square;
        if (distance < CUT2 * v) {
            const double inverse = 1 / v, ratio = 2 * s->square * inverse;
            const double w = source->mass * ratio * ratio * (koksma__exp(-distance * inverse) - AT_CUT);
            for (int k = 0; k < 3; k++) {
                s->force[k] += w * t[k];
            }
        }
    }
}

static void visit(sum *s, const koksma__source_box *box)
{
    double distance = 0;
    for (int k = 0; k < s->t->dim && k < 3; k++) {
        const double below = box->low[k] - s->x[k], above = -below - box->side;
        const double gap = below > 0 ? below : above > 0 ? above : 0;
        distance += gap * gap;
    }
    if (distance > CUT2 * (s->square + box->square)) {
        return;
    }
    if (!box->children) {
        add_leaf(s, box);
    }
    for (uint32_t i = 0; i < box->children; i++) {
        visit(s, &s->t->boxes[box->child + i]);
    }
}

void koksma__source_force(const koksma__source_tree *t, const double *x, double square, double force[3])
{
    sum s = {.t = t, .square = square};
    const double reach = sqrt(CUT2 * (square + t->boxes[0].square));
    const int images = t->torus ? (int)ceil(fmax(reach, 0.5) - 0.5) + 1 : 0;
    for (int i = -images; i <= images; i++) {
        for (int j = -images; j <= images; j++) {
            s.x[0] = x[0] + i;
            s.x[1] = x[1] + j;
            s.x[2] = t->dim > 2 ? x[2] : 0;
            visit(&s, &t->boxes[0]);
        }
    }
    memcpy(force, s.force, sizeof s.force);
}
