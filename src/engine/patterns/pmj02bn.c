/* SPDX-License-Identifier: Apache-2.0 */
/*
 * pmj02bn: pmj02 with blue noise: a nested scrambling of pmj02 for which the first 4, 16, 64, .. 4^levels points are
 * far from each other. The points have every property of pmj02 that nested (Owen) scrambling preserves: prefixes of
 * 2^m points, and all aligned blocks of 2^m points, are (0,m,2)-nets, and so are the four classes of points that
 * pmj02.c describes.
 *
 *     x = x' XOR the mask for the first `levels` bits of x', x' from pmj02; y likewise, with other masks
 *     energy of 4^d points = sum over pairs in adjacent cells of max(0, 1 - |p - q|^2 / (1.2 / 2^d)^2)^8
 *
 * Source: the aim, nets that are also blue noise, is that of Christensen, Kensler & Kilpatrick 2018. These authors
 * choose each new point among candidates that preserve the net. But a (0,m,2)-net of 2^m points determines the
 * position of a new point up to 1/2^(m+1). Every box of area 2^-m has one old and one new point, in opposite
 * quadrants. A box of one shape therefore determines the next bit of each coordinate of the new point, these bits
 * determine the box of the next shape, and so on. Only the position in a square of side 1/(2n) is free. Choosing
 * among candidates in this square (Helmer, Christensen & Kensler 2021) has three faults: it improves nothing from
 * about 4,000 points on, the points crowd at the ends of their strata, and the measured error of a step edge was 1.8
 * times that of pmj02. This file uses another freedom: in each of the 2^d strata of an axis a scrambling may flip the
 * bit of weight 2^-(d+1). A flip moves 2^d of 4^d points by half the spacing. The masks are chosen bit by bit, the
 * coarsest first: for d = 1 .. levels a sweep flips each of the 2 * 2^d strata if this lowers the energy of the first
 * 4^d points. Each d has at most SWEEPS sweeps, the last of which may flip nothing. Each cell of side 2^-d always
 * contains one point. Energies are sums of whole numbers and thus the same on all machines.
 *
 * docs/findings/blue-noise.md lists the mean distance to the nearest point over 16 seeds, in units of the densest
 * packing's distance. For any n the time is the time of pmj02 plus a time proportional to 4^levels.
 *
 * A single point is not uniform over seeds, because the masks are chosen: over 6,000 sets of 16 points, the density
 * of points 0, 1, 2, 3 and 15 in 16 bins deviated by 7 to 11 % (root mean square). Averaged over all points of a set
 * of 4^d points, the density is uniform. The pattern therefore does not claim to be unbiased; if few samples must be
 * unbiased, use pmj02.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { MOST_LEVELS = 10, SWEEPS = 2 };

#define RADIUS 1.2F /* distance in cells at which the energy becomes 0 */
#define ONE                                                                                                          \
    0x1p18F /* the whole number that stands for an energy of 1; a line has an energy of at most 7 * 2^10, so
                       sums are below 2^31 */

/* The positions of 4^d points in their cells, in units of a cell, stored twice: by rows, and by columns with the axes
   exchanged. A line (a row or a column) has a spare cell at each end: a copy of the cell at the other end, because
   distances are measured on the torus. */
typedef struct square {
    long side, width; /* number of cells on a side, without and with the spare cells */
    float *across[2]; /* the coordinate that a flip of the line changes: y of rows, x of columns */
    float *along[2];  /* the other coordinate */
} square;

static void put_cell(const square *s, int axis, long line, long t, float across, float along)
{
    const long at[3] = {t + 1, t == s->side - 1 ? 0 : -1, t == 0 ? s->side + 1 : -1};
    for (int i = 0; i < 3; i++) {
        if (at[i] >= 0) {
            s->across[axis][line * s->width + at[i]] = across;
            s->along[axis][line * s->width + at[i]] = along;
        }
    }
}

static void put_point(const square *s, uint32_t x, uint32_t y)
{
    const double u = x * 0x1p-32 * (double)s->side, v = y * 0x1p-32 * (double)s->side;
    const long column = (long)u, row = (long)v;
    const float x_in = (float)(u - (double)column), y_in = (float)(v - (double)row);
    put_cell(s, 0, row, column, y_in, x_in);
    put_cell(s, 1, column, row, x_in, y_in);
}

/* Returns the energy of pairs of points, added over all t: one point is in cell t of a line, the other in cell t + step
   of the line that is `lines` lines further. */
static int32_t energy_of(long side, const float *across, const float *along, const float *others_across,
                         const float *others_along, long lines, long step)
{
    const float up = (float)lines, on = (float)step;
    int32_t sum = 0;
    for (long t = 1; t <= side; t++) {
        const float a = others_across[t + step] + up - across[t], b = others_along[t + step] + on - along[t];
        float w = 1 - (a * a + b * b) * (1 / (RADIUS * RADIUS));
        w = w > 0 ? w : 0;
        w *= w;
        w *= w;
        sum += (int32_t)(w * w * ONE);
    }
    return sum;
}

/* Returns the energy of all pairs that a flip of the line can change. */
static int32_t energy_of_line(const square *s, int axis, long line, const float *across)
{
    const float *along = s->along[axis] + line * s->width;
    int32_t sum = energy_of(s->side, across, along, across, along, 0, 1);
    for (long lines = -1; lines <= 1; lines += 2) {
        const long other = (line + lines + s->side) % s->side * s->width;
        for (long step = -1; step <= 1; step++) {
            sum += energy_of(s->side, across, along, s->across[axis] + other, s->along[axis] + other, lines, step);
        }
    }
    return sum;
}

/* Flips a line if this lowers the energy, and returns whether it did. `flipped` is scratch memory for one line. */
static bool flip_line(const square *s, int axis, long line, float *flipped)
{
    const float *across = s->across[axis] + line * s->width, *along = s->along[axis] + line * s->width;
    for (long t = 0; t < s->width; t++) {
        flipped[t] = across[t] < 0.5F ? across[t] + 0.5F : across[t] - 0.5F;
    }
    if (energy_of_line(s, axis, line, flipped) >= energy_of_line(s, axis, line, across)) {
        return false;
    }
    for (long t = 0; t < s->side; t++) {
        const float v = along[t + 1];
        put_cell(s, axis, line, t, flipped[t + 1], v);
        put_cell(s, !axis, t, line, v, flipped[t + 1]);
    }
    return true;
}

/* Chooses the flips of one level. points[0] has the x, points[1] the y of 4^levels points; flips[k][line] receives
   whether coordinate k is flipped in this stratum. */
static void choose_level(uint32_t *const points[2], int level, float *room, unsigned char *const flips[2])
{
    square s = {.side = 1L << level, .width = (1L << level) + 2};
    for (int axis = 0; axis < 2; axis++) {
        s.across[axis] = room + 2 * axis * s.side * s.width;
        s.along[axis] = s.across[axis] + s.side * s.width;
        memset(flips[axis], 0, (size_t)s.side);
    }
    for (size_t i = 0; i < (size_t)1 << 2 * level; i++) {
        put_point(&s, points[0][i], points[1][i]);
    }
    float *flipped = room + 4 * s.side * s.width;
    bool changed = true;
    for (int sweep = 0; sweep < SWEEPS && changed; sweep++) {
        changed = false;
        for (long line = 0; line < s.side; line++) {
            for (int axis = 0; axis < 2; axis++) {
                const bool flip = flip_line(&s, axis, line, flipped);
                flips[!axis][line] ^= flip; /* flipping a row changes y */
                changed = changed || flip;
            }
        }
    }
}

typedef struct masks {
    int levels;
    uint32_t *points[2]; /* x and y of 4^levels points, with all flips chosen so far */
    uint32_t *of[2];     /* the mask of each stratum of width 2^-levels */
    float *room;
    unsigned char *flips[2];
} masks;

static uint32_t fraction(double x)
{
    return (uint32_t)(x * 0x1p32);
}

/* Computes the masks from the first 2^levels points, one in each stratum: a mask is the exclusive or of a point
   before and after scrambling. */
static void read_masks(const masks *m, const double *plain)
{
    for (size_t i = 0; i < (size_t)1 << m->levels; i++) {
        for (int k = 0; k < 2; k++) {
            const uint32_t v = fraction(plain[2 * i + (size_t)k]);
            m->of[k][v >> (32 - m->levels)] = v ^ m->points[k][i];
        }
    }
}

static koksma_status find_masks(masks *m, const double *plain, const koksma_run *run)
{
    const size_t n = (size_t)1 << 2 * m->levels;
    for (size_t i = 0; i < 2 * n; i++) {
        m->points[i % 2][i / 2] = fraction(plain[i]);
    }
    for (int level = 1; level <= m->levels; level++) {
        choose_level(m->points, level, m->room, m->flips);
        for (int k = 0; k < 2; k++) {
            for (size_t i = 0; i < n; i++) {
                const uint32_t flip = m->flips[k][m->points[k][i] >> (32 - level)];
                m->points[k][i] ^= flip << (31 - level);
            }
        }
        if (!koksma__keep_going(run, ldexp(1, 2 * (level - m->levels - 1)))) {
            return koksma__fail_interrupted();
        }
    }
    read_masks(m, plain);
    return KOKSMA_OK;
}

static void apply(const masks *m, koksma_points *out)
{
    for (size_t i = 0; i < 2 * out->n; i++) {
        const uint32_t v = fraction(out->xs[i]), mask = m->of[i % 2][v >> (32 - m->levels)];
        out->xs[i] += ((double)(v ^ mask) - (double)v) * 0x1p-32;
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    masks m = {.levels = (int)args->params[0]};
    if (m.levels == 0) {
        return koksma__grow(seed, KOKSMA__PURPOSE_POINT, koksma__pmj02_partners, args->run, out);
    }
    const size_t n = (size_t)1 << 2 * m.levels, side = (size_t)1 << m.levels, width = side + 2;
    const size_t floats = 4 * side * width + width, words = 2 * n + 2 * side;
    const size_t bytes = 2 * n * sizeof(double) + floats * sizeof(float) + words * sizeof(uint32_t) + 2 * side;
    double *plain = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(plain, bytes);
    m.room = (float *)(plain + 2 * n);
    m.points[0] = (uint32_t *)(m.room + floats);
    m.points[1] = m.points[0] + n;
    m.of[0] = m.points[1] + n;
    m.of[1] = m.of[0] + side;
    m.flips[0] = (unsigned char *)(m.of[1] + side);
    m.flips[1] = m.flips[0] + side;
    koksma_points first = {.n = n, .dim = 2, .xs = plain};
    koksma_status status = koksma__grow(seed, KOKSMA__PURPOSE_POINT, koksma__pmj02_partners, args->run, &first);
    status = status ? status : find_masks(&m, plain, args->run);
    status = status ? status : koksma__grow(seed, KOKSMA__PURPOSE_POINT, koksma__pmj02_partners, args->run, out);
    if (!status) {
        apply(&m, out);
    }
    free(plain);
    return status;
}

static const koksma_param params[] = {
    {"levels", "blue noise up to 4^levels points", 7, 0, MOST_LEVELS, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_pmj02bn = {
    .name = "pmj02bn",
    .title = "pmj02, scrambled so that its first 4, 16, 64, .. points are far from each other",
    .cite = "christensen2018 helmer2021",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES |
              KOKSMA_CLAIM_CLASSES,
    .params = params,
    .generate = generate,
};
