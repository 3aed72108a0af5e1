/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The cells and the shrinking cover of dart throwing in 3 to 6 dimensions; darts.h describes the algorithm.
 *
 * Cells are at least d wide, so that the 3^dim cells around a position contain all points within d of it. Every child
 * of a cube has the centre of the cube as a corner. A ball that contains a whole child therefore contains the centre,
 * so only the points within d of the centre are compared with the 2^dim children. These points are found once for each
 * region of 4^dim cubes. On the torus the distance along one axis is at most 1/2. The largest distance from a point to
 * a box is computed axis by axis, and images need not be considered.
 */
#include "patterns/darts/darts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "core/vector.h"

enum { LOOK_EVERY = 1 << 10, CHILDREN = 1 << KOKSMA__BALL_DIMS };

#define NONE UINT32_MAX

/* The largest number of cubes along an axis; free volumes smaller than such a cube are ignored. */
#define FINEST ((uint32_t)1 << 29)

double koksma__balls_per_volume(int dim)
{
    /* the fraction of the volume that the balls fill, for dim = 2, 3, ... */
    static const double filled[] = {0.547067, 0.384131, 0.260078, 0.170776, 0.109302};
    double ball = dim % 2 ? 2 : M_PI;
    for (int k = dim % 2 ? 3 : 4; k <= dim; k += 2) {
        ball *= 2 * M_PI / k;
    }
    return filled[dim - 2] * koksma__pow(2, dim) / ball;
}

/* ---- The cells ------------------------------------------------------------------------------------------- */

static void enter(koksma__balls *s, size_t i)
{
    const size_t cell = koksma__cell_index(s->xs + i * (size_t)s->dim, s->dim, s->side);
    s->next[i] = s->head[cell];
    s->head[cell] = (uint32_t)i;
}

/* Empties the cells and adapts their size to distance d. The new cover is the whole torus, in cubes about d wide. */
static koksma_status make_grid(koksma__balls *s, double d)
{
    size_t cells = 1, cubes = 1;
    s->d = d;
    s->side = 1 / d >= 3 ? (uint32_t)(1 / d) : 1;
    s->along = (uint32_t)ceil(1 / d);
    for (int k = 0; k < s->dim; k++) {
        cells *= s->side;
        cubes *= s->along;
    }
    if (cells > s->head_room) {
        free(s->head);
        s->head = malloc(cells * sizeof *s->head);
        s->head_room = s->head ? cells : 0;
        KOKSMA__REQUIRE_MEMORY(s->head, cells * sizeof *s->head);
    }
    memset(s->head, 0xff, cells * sizeof *s->head);
    if (cubes > s->cube_room) {
        free(s->cubes);
        s->cubes = malloc(cubes * (size_t)s->dim * sizeof *s->cubes);
        s->cube_room = s->cubes ? cubes : 0;
        KOKSMA__REQUIRE_MEMORY(s->cubes, cubes * (size_t)s->dim * sizeof *s->cubes);
    }
    for (size_t c = 0; c < cubes; c++) {
        size_t rest = c;
        for (int k = 0; k < s->dim; k++, rest /= s->along) {
            s->cubes[c * (size_t)s->dim + (size_t)k] = (uint32_t)(rest % s->along);
        }
    }
    s->n_cubes = cubes;
    return KOKSMA_OK;
}

koksma_status koksma__balls_init(koksma__balls *s, uint64_t seed, int dim, double d)
{
    const size_t room = 64 + (size_t)(1.1 * koksma__balls_per_volume(dim) / koksma__pow(d, dim));
    *s = (koksma__balls){.dim = dim, .seed = seed, .room = room};
    s->xs = malloc(room * (size_t)dim * sizeof *s->xs);
    s->next = malloc(room * sizeof *s->next);
    KOKSMA__REQUIRE_MEMORY(s->xs && s->next, room * ((size_t)dim * sizeof *s->xs + sizeof *s->next));
    return make_grid(s, d);
}

void koksma__balls_fini(koksma__balls *s)
{
    KOKSMA__FREE(s->xs, s->next, s->head, s->cubes);
    *s = (koksma__balls){0};
}

static double distance2(const koksma__balls *s, const double *x, const double *y)
{
    double sum = 0;
    for (int k = 0; k < s->dim; k++) {
        const double t = koksma__torus_difference(x[k], y[k]);
        sum += t * t;
    }
    return sum;
}

/* Copies of the points found near a position. If xs is NULL, no points are copied. */
typedef struct near_points {
    double limit2, *xs; /* limit2: limit of the squared distance; xs: dim coordinates for each point */
    size_t n;
} near_points;

/* Finds points nearer to x than the limit in cells at most `reach` away along each axis, by recursion over the axes.
   If points are not to be copied, returns true as soon as one is found. */
static bool look_from(const koksma__balls *s, int k, size_t row, const double *x, uint32_t reach, near_points *near)
{
    const size_t dim = (size_t)s->dim;
    if (k == s->dim) {
        for (uint32_t i = s->head[row]; i != NONE; i = s->next[i]) {
            if (distance2(s, x, s->xs + i * dim) < near->limit2) {
                if (!near->xs) {
                    return true;
                }
                memcpy(near->xs + near->n++ * dim, s->xs + i * dim, dim * sizeof *x);
            }
        }
        return false;
    }
    const bool all = 2 * reach + 1 >= s->side;
    const uint32_t some = all ? s->side : 2 * reach + 1;
    uint32_t cell = all ? 0 : (koksma__cell_along(x[k], s->side) + s->side - reach) % s->side;
    for (uint32_t c = 0; c < some; c++) {
        if (look_from(s, k + 1, row * s->side + cell, x, reach, near)) {
            return true;
        }
        cell = cell + 1 < s->side ? cell + 1 : 0;
    }
    return false;
}

/* ---- Darts ----------------------------------------------------------------------------------------------- */

static koksma_status keep(koksma__balls *s, const double *x)
{
    if (s->n == s->room) {
        const size_t room = 2 * s->room, width = (size_t)s->dim * sizeof *s->xs;
        double *xs = realloc(s->xs, room * width);
        s->xs = xs ? xs : s->xs;
        uint32_t *next = realloc(s->next, room * sizeof *next);
        s->next = next ? next : s->next;
        KOKSMA__REQUIRE_MEMORY(xs && next, room * width);
        s->room = room;
    }
    memcpy(s->xs + s->n * (size_t)s->dim, x, (size_t)s->dim * sizeof *x);
    enter(s, s->n++);
    return KOKSMA_OK;
}

/* Throws a dart at a random cube; words 1 to dim of its random words are the position in the cube. */
static koksma_status throw_dart(koksma__balls *s)
{
    uint32_t words[8];
    for (uint32_t lane = 0; lane < 2; lane++) {
        const koksma__words w = koksma__random(s->seed, KOKSMA__PURPOSE_DART, s->dart, lane);
        memcpy(words + 4 * lane, w.w, sizeof w.w);
    }
    s->dart++;
    const uint32_t *cube = s->cubes + (size_t)koksma__below(words[0], (uint32_t)s->n_cubes) * (size_t)s->dim;
    double x[KOKSMA__BALL_DIMS];
    for (int k = 0; k < s->dim; k++) {
        x[k] = (cube[k] + words[k + 1] * 0x1p-32) / s->along;
        if (!(x[k] < 1)) {
            return KOKSMA_OK; /* rounding put the dart outside of the torus */
        }
    }
    return look_from(s, 0, 0, x, 1, &(near_points){.limit2 = s->d * s->d}) ? KOKSMA_OK : keep(s, x);
}

/* ---- The cover ------------------------------------------------------------------------------------------- */

/* Returns the children among `open` that the ball of radius d about y does not contain; both are bit sets of the
   children of a cube. Bit k of the number of a child tells on which side it is along axis k. half: half of the side
   of a child. */
static uint64_t open_children(const koksma__balls *s, const double *centre, double half, const double *y,
                              uint64_t open)
{
    double sums[CHILDREN] = {0};
    for (int k = 0; k < s->dim; k++) {
        double far[2]; /* for each axis, the squared distances to the far side of the lower and of the upper children
                          */
        for (int side = 0; side < 2; side++) {
            double t = fabs(centre[k] + (side ? half : -half) - y[k]);
            t = t > 0.5 ? fabs(1 - t) : t;
            far[side] = fmin(t + half, 0.5);
            far[side] *= far[side];
        }
        for (int c = 0; c < 1 << k; c++) {
            sums[c + (1 << k)] = sums[c] + far[1];
            sums[c] += far[0];
        }
    }
    uint64_t covered = 0;
    for (int c = 0; c < 1 << s->dim; c++) {
        covered |= (uint64_t)(sums[c] < s->d * s->d) << c;
    }
    return open & ~covered;
}

/* Grows `list` to hold `count` cubes. */
static koksma_status get_room(const koksma__balls *s, uint32_t **list, size_t *room, size_t count)
{
    if (count <= *room) {
        return KOKSMA_OK;
    }
    const size_t width = (size_t)s->dim * sizeof **list, most = KOKSMA__BALL_BYTES / width;
    KOKSMA__FAIL_IF(count > most, KOKSMA_IMPOSSIBLE, "the free volume takes more than %zu cubes", most);
    const size_t wanted = count + count / 2 < most ? count + count / 2 : most;
    uint32_t *more = realloc(*list, wanted * width);
    KOKSMA__REQUIRE_MEMORY(more, wanted * width);
    *list = more;
    *room = wanted;
    return KOKSMA_OK;
}

/* The region of 4^dim cubes around a cube, and the points near it. Its cubes are neighbours in the list. */
typedef struct region {
    uint32_t corner[KOKSMA__BALL_DIMS]; /* position in units of the region's side */
    near_points near;
} region;

/* Moves the region to the position of `cube`: finds all points within d of the centre of any of its cubes. */
static void move_region(const koksma__balls *s, const uint32_t *cube, region *r)
{
    bool same = r->near.limit2 > 0;
    double centre[KOKSMA__BALL_DIMS];
    for (int k = 0; k < s->dim; k++) {
        same = same && r->corner[k] == cube[k] / 4;
        r->corner[k] = cube[k] / 4;
        centre[k] = (4 * r->corner[k] + 2.0) / s->along;
        centre[k] -= centre[k] >= 1; /* the region may extend beyond the torus */
    }
    if (!same) {
        const double limit = s->d + 1.5 * sqrt(s->dim) / s->along;
        r->near.limit2 = limit * limit * (1 + 1e-12);
        r->near.n = 0;
        look_from(s, 0, 0, centre, (uint32_t)ceil(limit * s->side * (1 + 1e-12)), &r->near);
    }
}

/* Appends to `list` the children of a cube that have free volume. */
static koksma_status add_children(const koksma__balls *s, const uint32_t *cube, region *r, uint32_t **list,
                                  size_t *room, size_t *count)
{
    const size_t dim = (size_t)s->dim;
    const double half = 0.25 / s->along;
    double centre[KOKSMA__BALL_DIMS];
    uint64_t open = dim == KOKSMA__BALL_DIMS ? ~(uint64_t)0 : ((uint64_t)1 << (1 << dim)) - 1;
    for (size_t k = 0; k < dim; k++) {
        centre[k] = (cube[k] + 0.5) / s->along;
    }
    move_region(s, cube, r);
    for (size_t i = 0; i < r->near.n && open; i++) {
        const double *y = r->near.xs + i * dim;
        if (distance2(s, centre, y) < s->d * s->d) {
            open = open_children(s, centre, half, y, open);
        }
    }
    KOKSMA__TRY(get_room(s, list, room, *count + CHILDREN));
    for (; open; open &= open - 1) {
        const int child = __builtin_ctzll(open);
        uint32_t *to = *list + (*count)++ * dim;
        for (size_t k = 0; k < dim; k++) {
            to[k] = 2 * cube[k] + ((uint32_t)child >> k & 1);
        }
    }
    return KOKSMA_OK;
}

/* Cuts each cube into 2^dim and keeps those with free volume. */
static koksma_status refine(koksma__balls *s, double done, const koksma_run *run)
{
    const size_t dim = (size_t)s->dim;
    uint32_t *list = NULL;
    size_t room = 0, count = 0;
    region r = {.near.xs = malloc((s->n + 1) * dim * sizeof(double))};
    KOKSMA__REQUIRE_MEMORY(r.near.xs, (s->n + 1) * dim * sizeof(double));
    koksma_status status = KOKSMA_OK;
    for (size_t c = 0; c < s->n_cubes && !status; c++) {
        status = add_children(s, s->cubes + c * dim, &r, &list, &room, &count);
        if (c % LOOK_EVERY == LOOK_EVERY - 1 && !koksma__keep_going(run, done)) {
            status = koksma__fail_interrupted();
        }
    }
    free(r.near.xs);
    free(s->cubes);
    s->cubes = list;
    s->cube_room = room;
    s->n_cubes = count;
    s->most_cubes = count > s->most_cubes ? count : s->most_cubes;
    s->along *= 2;
    return status;
}

koksma_status koksma__balls_fill(koksma__balls *s, size_t n, const koksma_run *run)
{
    koksma_status status = KOKSMA_OK;
    while (s->n < n && s->n_cubes && s->along < FINEST && !status) {
        const double done = n == SIZE_MAX ? 0.5 : (double)s->n / (double)n;
        const size_t darts = s->n_cubes + 4;
        for (size_t i = 0; i < darts && s->n < n && !status; i++) {
            status = throw_dart(s);
            if (i % LOOK_EVERY == LOOK_EVERY - 1 && !koksma__keep_going(run, done)) {
                status = koksma__fail_interrupted();
            }
        }
        if (!status && s->n < n) {
            status = refine(s, done, run);
        }
    }
    return status;
}

koksma_status koksma__balls_shrink(koksma__balls *s, size_t n, double d, const koksma_run *run)
{
    koksma_status status = make_grid(s, d);
    s->n = n;
    for (size_t i = 0; i < n && !status; i++) {
        enter(s, i);
    }
    return status ? status : refine(s, 0.5, run);
}
