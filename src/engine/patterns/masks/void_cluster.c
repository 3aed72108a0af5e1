/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Void and cluster (Ulichney 1993), for masks and for masks in space and time: the energy of a pixel is the sum of
 * Gaussians (standard deviation 1.5 pixels, on the torus, cut off at 9 pixels along each axis, or 4 in space and time)
 * about the pixels that are set. A tenth of the pixels is set at random; then the pixel in the tightest cluster is moved
 * to the largest void, until this changes nothing. Removing the pixel in the tightest cluster again and again gives the
 * ranks of these pixels; filling the largest void again and again gives the other ranks. On the torus the largest void of
 * the set pixels is the tightest cluster of the unset pixels.
 *
 * A change of one pixel changes the energies of up to 19 x 19 pixels, or 9^3, around it. The largest void and the
 * tightest cluster are the roots of two trees: a node of level 1 has the best of 8 x 8 pixels (4^3 in space and time), a
 * node of level l + 1 the best of as many nodes of level l. A change updates a bounded number of nodes of each level, so
 * that a mask of n pixels takes O(n log n) time. Energies are sums of doubles in a fixed order, and ties go to the pixel
 * with the lowest index: the ranks do not depend on the instruction set.
 */
#include <koksma/mask.h>

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"

enum { REACH = 9, REACH_3D = 4, SPAN = 2 * REACH + 1 };                  /* REACH is six standard deviations */
enum { FAN_BITS = 3, FAN_BITS_3D = 2, FAN = 1 << FAN_BITS, LEVELS = 4 }; /* FAN^LEVELS >= KOKSMA_MASK_MAX */
enum { VOIDS, CLUSTERS };

/* The best pixel of a kind is the one with the least value: the energy of an unset pixel (VOIDS), minus the energy of a set
   one (CLUSTERS), INFINITY of other pixels, which no change of energies alters. */
typedef struct mask {
    int sides[3]; /* along x, y and time */
    int levels, reach;
    int bits;                     /* a node has 2^bits children along each axis */
    size_t n, steps;              /* steps: the most moves of clusters to voids */
    double *trees[2][LEVELS + 1]; /* level 0: the pixels */
    bool maintained[2];
    double *gauss; /* the weight of an offset, SPAN numbers for each step along an axis */
} mask;

static const double NONE = (double)INFINITY; /* the value of a pixel of the other kind */

static int side_of(const mask *m, int level, int axis)
{
    return (m->sides[axis] + (1 << m->bits * level) - 1) >> m->bits * level;
}

/* The index of a node of a level; of a pixel for level 0. */
static size_t index_of(const mask *m, int level, const int at[3])
{
    return ((size_t)at[2] * (size_t)side_of(m, level, 1) + (size_t)at[1]) * (size_t)side_of(m, level, 0) +
           (size_t)at[0];
}

/* A range of pixels or nodes along each axis, both ends included. */
typedef struct box {
    int from[3], to[3];
} box;

/* The children of a node, of which there are fewer at the last sides. */
static box children_of(const mask *m, int level, const int at[3])
{
    box b;
    for (int k = 0; k < 3; k++) {
        const int last = side_of(m, level - 1, k) - 1;
        b.from[k] = at[k] << m->bits;
        b.to[k] = ((at[k] + 1) << m->bits) - 1 < last ? ((at[k] + 1) << m->bits) - 1 : last;
    }
    return b;
}

static void renew_node(mask *m, int kind, int level, const int at[3])
{
    const box b = children_of(m, level, at);
    const int columns = b.to[0] - b.from[0] + 1;
    double least[FAN];
    for (int c = 0; c < FAN; c++) {
        least[c] = NONE;
    }
    for (int child[3] = {b.from[0], 0, b.from[2]}; child[2] <= b.to[2]; child[2]++) {
        child[1] = b.from[1];
        const double *row = m->trees[kind][level - 1] + index_of(m, level - 1, child);
        for (; child[1] <= b.to[1]; child[1]++, row += side_of(m, level - 1, 0)) {
            if (columns == FAN) { /* in lanes */
                for (int c = 0; c < FAN; c++) {
                    least[c] = row[c] < least[c] ? row[c] : least[c];
                }
            } else {
                for (int c = 0; c < columns; c++) {
                    least[c] = row[c] < least[c] ? row[c] : least[c];
                }
            }
        }
    }
    for (int c = 1; c < FAN; c++) {
        least[0] = least[c] < least[0] ? least[c] : least[0];
    }
    m->trees[kind][level][index_of(m, level, at)] = least[0];
}

/* Updates the nodes above a box of pixels. */
static void renew(mask *m, int kind, const box *b)
{
    for (int level = 1, at[3]; level <= m->levels; level++) {
        const int shift = m->bits * level;
        for (at[2] = b->from[2] >> shift; at[2] <= b->to[2] >> shift; at[2]++) {
            for (at[1] = b->from[1] >> shift; at[1] <= b->to[1] >> shift; at[1]++) {
                for (at[0] = b->from[0] >> shift; at[0] <= b->to[0] >> shift; at[0]++) {
                    renew_node(m, kind, level, at);
                }
            }
        }
    }
}

static void renew_all(mask *m, int kind)
{
    renew(m, kind, &(box){.to = {m->sides[0] - 1, m->sides[1] - 1, m->sides[2] - 1}});
}

/* The first pixel below a node that has the value of the root. */
static size_t first_best(const mask *m, int kind, int level, const int at[3])
{
    if (!level) {
        return index_of(m, 0, at);
    }
    const box b = children_of(m, level, at);
    size_t best = SIZE_MAX;
    int child[3];
    for (child[2] = b.from[2]; child[2] <= b.to[2]; child[2]++) {
        for (child[1] = b.from[1]; child[1] <= b.to[1]; child[1]++) {
            for (child[0] = b.from[0]; child[0] <= b.to[0]; child[0]++) {
                if (m->trees[kind][level - 1][index_of(m, level - 1, child)] == *m->trees[kind][m->levels]) {
                    const size_t found = first_best(m, kind, level - 1, child);
                    best = found < best ? found : best;
                }
            }
        }
    }
    return best;
}

static size_t extreme(const mask *m, int kind)
{
    return first_best(m, kind, m->levels, (const int[3]){0});
}

/* Cuts the range from .. to of a ring of `size` pixels into one part, or into two parts if it wraps around. */
static int unwrap(int from, int to, int size, int parts[2][2])
{
    if (from >= 0 && to < size) {
        parts[0][0] = from;
        parts[0][1] = to;
        return 1;
    }
    parts[0][0] = 0;
    parts[0][1] = to < size ? to : to - size;
    parts[1][0] = from < 0 ? from + size : from;
    parts[1][1] = size - 1;
    return 2;
}

/* Adds the weights about a pixel to the energies of a kind in a box, times sign. */
static void add_weights(mask *m, int kind, const int at[3], double sign, const box *b)
{
    const int width = b->to[0] - b->from[0] + 1;
    int offset[3], pixel[3] = {b->from[0]};
    for (pixel[2] = b->from[2]; pixel[2] <= b->to[2]; pixel[2]++) {
        for (pixel[1] = b->from[1]; pixel[1] <= b->to[1]; pixel[1]++) {
            for (int k = 0; k < 3; k++) {
                const int d = pixel[k] - at[k], half = m->sides[k] / 2 < m->reach ? m->sides[k] / 2 : m->reach;
                offset[k] = d > half ? d - m->sides[k] : d < -half ? d + m->sides[k] : d;
            }
            double *row = m->trees[kind][0] + index_of(m, 0, pixel);
            const double *weights =
                m->gauss + ((offset[2] + m->reach) * SPAN + offset[1] + m->reach) * SPAN + m->reach;
            for (int i = 0; i < width; i++) {
                row[i] += sign * weights[offset[0] + i];
            }
        }
    }
}

/* Sets or unsets a pixel, in the trees that are maintained; their nodes, too, if `nodes`. */
static void change(mask *m, size_t pixel, bool on, bool nodes)
{
    int at[3], parts[3][2][2], counts[3];
    size_t rest = pixel;
    for (int k = 0; k < 3; k++) {
        /* On a small torus each pixel is visited only once, at its shortest distance. */
        const int side = m->sides[k], before = (side - 1) / 2 < m->reach ? (side - 1) / 2 : m->reach;
        const int after = side / 2 < m->reach ? side / 2 : m->reach;
        at[k] = (int)(rest % (size_t)side);
        rest /= (size_t)side;
        counts[k] = unwrap(at[k] - before, at[k] + after, side, parts[k]);
    }
    double *of[2] = {m->trees[VOIDS][0] + pixel, m->trees[CLUSTERS][0] + pixel};
    const double energy = on ? *of[VOIDS] : -*of[CLUSTERS];
    *of[VOIDS] = on ? NONE : energy;
    *of[CLUSTERS] = on ? -energy : NONE;
    for (int i = 0, n = counts[0] * counts[1] * counts[2]; i < n; i++) {
        const int which[3] = {i % counts[0], i / counts[0] % counts[1], i / counts[0] / counts[1]};
        box b;
        for (int k = 0; k < 3; k++) {
            b.from[k] = parts[k][which[k]][0];
            b.to[k] = parts[k][which[k]][1];
        }
        for (int kind = VOIDS; kind <= CLUSTERS; kind++) {
            if (m->maintained[kind]) {
                add_weights(m, kind, at, on == (kind == VOIDS) ? 1 : -1, &b);
            }
            if (m->maintained[kind] && nodes) {
                renew(m, kind, &b);
            }
        }
    }
}

/* Computes the tree of one kind. After this call a change of a pixel updates only this tree. */
static void maintain_only(mask *m, int kind)
{
    m->maintained[1 - kind] = false;
    m->maintained[kind] = true;
    renew_all(m, kind);
}

/* Unsets all pixels. */
static void clear(mask *m)
{
    for (size_t i = 0; i < m->n; i++) {
        m->trees[VOIDS][0][i] = 0;
        m->trees[CLUSTERS][0][i] = NONE;
    }
}

static koksma_status begin(mask *m, uint64_t seed, const koksma_run *run, size_t *count)
{
    *count = m->n / 10 ? m->n / 10 : 1;
    clear(m);
    m->maintained[VOIDS] = m->maintained[CLUSTERS] = true;
    for (size_t placed = 0, i = 0; placed < *count; i++) {
        const uint32_t word = koksma__random(seed, KOKSMA__PURPOSE_DART, i, m->reach == REACH ? 0 : 3).w[0];
        const size_t at = koksma__below(word, (uint32_t)m->n);
        if (m->trees[CLUSTERS][0][at] == NONE) {
            change(m, at, true, false);
            placed++;
        }
    }
    renew_all(m, VOIDS);
    renew_all(m, CLUSTERS);
    for (size_t step = 0; step < m->steps; step++) {
        const size_t cluster = extreme(m, CLUSTERS);
        change(m, cluster, false, true);
        const size_t hole = extreme(m, VOIDS);
        change(m, hole, true, true);
        if (hole == cluster) {
            break;
        }
        KOKSMA__TRY(step % 256 == 255 ? koksma__ask(run) : KOKSMA_OK);
    }
    return KOKSMA_OK;
}

/* Computes the ranks of the `count` pixels that are set, by removing them one by one; then sets these pixels again. */
static void rank_first(mask *m, size_t count, uint32_t *ranks)
{
    for (size_t i = 0; i < m->n; i++) {
        ranks[i] = UINT32_MAX;
    }
    maintain_only(m, CLUSTERS);
    for (size_t left = count; left > 0; left--) {
        const size_t at = extreme(m, CLUSTERS);
        change(m, at, false, true);
        ranks[at] = (uint32_t)left - 1;
    }
    clear(m);
    m->maintained[VOIDS] = true;
    m->maintained[CLUSTERS] = false;
    for (size_t i = 0; i < m->n; i++) {
        if (ranks[i] < count) {
            change(m, i, true, false);
        }
    }
}

static koksma_status fill_voids(mask *m, size_t count, const koksma_run *run, uint32_t *ranks)
{
    maintain_only(m, VOIDS);
    for (; count < m->n; count++) {
        const size_t at = extreme(m, VOIDS);
        change(m, at, true, true);
        ranks[at] = (uint32_t)count;
        if (count % 256 == 0 && !koksma__keep_going(run, (double)count / (double)m->n)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

static size_t nodes_of(const mask *m, int level)
{
    return (size_t)side_of(m, level, 0) * (size_t)side_of(m, level, 1) * (size_t)side_of(m, level, 2);
}

/* Allocates all memory of the mask as one block, which begins with m->gauss. */
static koksma_status make_room(mask *m)
{
    const size_t weights = (size_t)(2 * m->reach + 1) * SPAN * SPAN;
    size_t values = m->n;
    for (m->levels = 0; nodes_of(m, m->levels) > 1;) {
        values += nodes_of(m, ++m->levels);
    }
    const size_t bytes = (weights + 2 * values) * sizeof *m->gauss;
    m->gauss = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(m->gauss, bytes);
    double *at = m->gauss + weights;
    for (int i = 0; i <= 2 * m->levels + 1; i++) {
        m->trees[i % 2][i / 2] = at;
        at += nodes_of(m, i / 2);
    }
    return KOKSMA_OK;
}

static koksma_status rank_pixels(mask *m, uint64_t seed, const koksma_run *run, uint32_t *ranks)
{
    KOKSMA__TRY(make_room(m));
    const double spread = 2 * 1.5 * 1.5;
    for (int w = -m->reach; w <= m->reach; w++) {
        for (int v = -m->reach; v <= m->reach; v++) {
            for (int u = -m->reach; u <= m->reach; u++) {
                m->gauss[((w + m->reach) * SPAN + v + m->reach) * SPAN + u + m->reach] =
                    m->sides[2] > 1 ? koksma__exp(-(u * u) / spread) * koksma__exp(-(v * v) / spread) *
                                          koksma__exp(-(w * w) / spread)
                                    : koksma__exp(-(u * u + v * v) / spread);
            }
        }
    }
    size_t count;
    koksma_status status = begin(m, seed, run, &count);
    if (!status) {
        rank_first(m, count, ranks);
        status = fill_voids(m, count, run, ranks);
    }
    free(m->gauss);
    return status;
}

koksma_status koksma_mask_void_and_cluster(int size, uint64_t seed, const koksma_run *run, uint32_t *ranks)
{
    KOKSMA__REQUIRE(ranks);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(size < KOKSMA_MASK_MIN || size > KOKSMA_MASK_MAX, KOKSMA_ARGUMENT,
                    "void-and-cluster: a mask of size %d; sizes are %d to %d", size, KOKSMA_MASK_MIN,
                    KOKSMA_MASK_MAX);
    const size_t n = (size_t)size * (size_t)size;
    return rank_pixels(&(mask){.sides = {size, size, 1}, .reach = REACH, .bits = FAN_BITS, .n = n, .steps = 16 * n},
                       seed, run, ranks);
}

koksma_status koksma_mask_void_and_cluster_3d(int size, int frames, uint64_t seed, const koksma_run *run,
                                              uint32_t *ranks)
{
    KOKSMA__REQUIRE(ranks);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(size < KOKSMA_MASK_MIN || size > KOKSMA_MASK_MAX_3D, KOKSMA_ARGUMENT,
                    "void-and-cluster-3d: a mask of size %d; sizes are %d to %d", size, KOKSMA_MASK_MIN,
                    KOKSMA_MASK_MAX_3D);
    KOKSMA__FAIL_IF(frames < KOKSMA_MASK_MIN || frames > KOKSMA_MASK_MAX_3D, KOKSMA_ARGUMENT,
                    "void-and-cluster-3d: a mask of %d frames; frames are %d to %d", frames, KOKSMA_MASK_MIN,
                    KOKSMA_MASK_MAX_3D);
    const size_t n = (size_t)size * (size_t)size * (size_t)frames, few = n / 10 ? n / 10 : 1;
    return rank_pixels(
        &(mask){.sides = {size, size, frames}, .reach = REACH_3D, .bits = FAN_BITS_3D, .n = n, .steps = 4 * few},
        seed, run, ranks);
}
