/* SPDX-License-Identifier: Apache-2.0 */
/*
 * For tests that walk the tables of materials, lights and shapes: fields of scene files with values drawn from the
 * ranges that a kind declares, chi-square limits, and a tree of cells that is fine where samples fall. A kind is
 * under test as soon as it has a line in its table; nothing here knows a kind by name.
 */
#ifndef KOKSMA_TESTS_KINDS_H
#define KOKSMA_TESTS_KINDS_H

#include "core/random.h"
#include "render/fields.h"
#include "rendering.h"

/* Number `index` of the stream, in [0,1). */
static inline double draw(uint64_t stream, uint64_t index)
{
    double pair[2];
    koksma__random_pair(stream, KOKSMA__PURPOSE_TEST, index, 0, pair);
    return pair[0];
}

/* A number of the range: each end in one of eight cases, else log-uniform above low or 1e-3 of the range. */
static inline double number_within(double low, double high, double u, double v)
{
    const double least = low > 0 ? low : fmin(1e-3, 1e-3 * high);
    return u < 0.125 ? low : u < 0.25 ? high : fmin(least * pow(high / least, v), high);
}

/* The kind's parameters and example as members of a JSON object. Positions are within 1 of the origin, lengths within
   0.1 to 0.6, so that what is drawn fits into one small scene. Optional fields are left out in half of the cases. */
static inline void kind_fields(const koksma__kind *kind, uint64_t stream, char *text, size_t size)
{
    *text = 0;
    uint64_t i = 0;
    for (const koksma__parameter *p = kind->parameters; p && p->name; p++, i += 8) {
        const size_t used = strlen(text);
        double u[8], c[3];
        for (uint64_t k = 0; k < 8; k++) {
            u[k] = draw(stream, i + k);
        }
        if (p->optional && u[7] < 0.5) {
            continue;
        }
        for (int k = 0; k < 3; k++) { /* colours: a quarter of them as high as they may be */
            c[k] = u[0] < 0.25 ? fmin(p->high, 10) : fmin(p->high, 10) * u[k + 1];
        }
        snprintf(text + used, size - used, ", \"%s\": ", p->name);
        const size_t at = strlen(text);
        switch (p->type) {
        case KOKSMA__NUMBER:
            snprintf(text + at, size - at, "%.17g", number_within(p->low, p->high, u[0], u[1]));
            break;
        case KOKSMA__COLOUR:
            snprintf(text + at, size - at, "[%.17g, %.17g, %.17g]", c[0], c[1], c[2]);
            break;
        case KOKSMA__POINT:
        case KOKSMA__DIRECTION:
            snprintf(text + at, size - at, "[%.17g, %.17g, %.17g]", 2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1);
            break;
        case KOKSMA__FLAG:
            snprintf(text + at, size - at, u[0] < 0.5 ? "false" : "true");
            break;
        case KOKSMA__RADIUS:
            snprintf(text + at, size - at, "%.17g", 0.1 + 0.5 * u[0]);
            break;
        case KOKSMA__HALF:
            snprintf(text + at, size - at, "[%.17g, %.17g]", 0.1 + 0.5 * u[0], 0.1 + 0.5 * u[1]);
            break;
        }
    }
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", kind->example ? ", " : "", kind->example ? kind->example : "");
}

/* The value that a chi-square variable of that many degrees of freedom exceeds with probability 1e-6 (Wilson &
   Hilferty 1931). */
static inline double chi_square_limit(double freedom)
{
    const double a = 2 / (9 * freedom), z = 1 - a + 4.753 * sqrt(a);
    return freedom * z * z * z;
}

/* A unit vector, uniform over the sphere. */
static inline void draw_unit(uint64_t stream, uint64_t index, float w[3])
{
    const double z = 2 * draw(stream, 2 * index) - 1, turn = 2 * M_PI * draw(stream, 2 * index + 1);
    const double r = sqrt(1 - z * z);
    w[0] = (float)(r * cos(turn));
    w[1] = (float)(r * sin(turn));
    w[2] = (float)z;
}

/* ---- Cells of the sphere of directions --------------------------------------------------------------------- */

/* Directions about an axis, as (x, y) in the unit square: z = 2 x - 1 along the axis, y the azimuth in turns; equal
   areas are equal solid angles, 4 pi in all. Cells are halved along their longer side until each has at most
   `most` of the directions that the tree was made of. */
typedef struct cell {
    double x, y, width, height;
    size_t halves;        /* the number of its lower half, which the upper one follows; 0: it is a leaf */
    double expected, got; /* of leaves, for the caller */
} cell;

typedef struct sphere_cells {
    float axis[3], u[3], v[3];
    cell *cells;
    size_t n, capacity;
} sphere_cells;

static inline void to_square(const sphere_cells *t, const float w[3], double *x, double *y)
{
    double p[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        p[0] += (double)t->u[k] * (double)w[k];
        p[1] += (double)t->v[k] * (double)w[k];
        p[2] += (double)t->axis[k] * (double)w[k];
    }
    const double turn = atan2(p[1], p[0]) / (2 * M_PI);
    *x = fmin(fmax((p[2] + 1) / 2, 0), 1 - 1e-12);
    *y = fmin(turn < 0 ? turn + 1 : turn, 1 - 1e-12);
}

static inline void from_square(const sphere_cells *t, double x, double y, float w[3])
{
    const double z = 2 * x - 1, r = sqrt(fmax(1 - z * z, 0)), c = r * cos(2 * M_PI * y), s = r * sin(2 * M_PI * y);
    for (int k = 0; k < 3; k++) {
        w[k] = (float)(c * (double)t->u[k] + s * (double)t->v[k] + z * (double)t->axis[k]);
    }
}

/* Adds two cells; where the first of them is. */
static inline size_t add_halves(sphere_cells *t, cell low, cell high)
{
    if (t->n + 2 > t->capacity) {
        t->capacity = 2 * t->capacity + 256;
        t->cells = realloc(t->cells, t->capacity * sizeof *t->cells);
        assert_non_null(t->cells);
    }
    t->cells[t->n++] = low;
    t->cells[t->n++] = high;
    return t->n - 2;
}

static inline void split_cell(sphere_cells *t, size_t i, double (*points)[2], size_t n, size_t most, int depth)
{
    const cell c = t->cells[i];
    if (n <= most || !depth) {
        return;
    }
    const int along = c.height > c.width;
    const double middle = along ? c.y + c.height / 2 : c.x + c.width / 2;
    size_t below = 0;
    for (size_t k = 0; k < n; k++) {
        if (points[k][along] < middle) {
            const double x = points[k][0], y = points[k][1];
            memcpy(points[k], points[below], sizeof points[k]);
            points[below][0] = x;
            points[below++][1] = y;
        }
    }
    cell low = c, high = c;
    *(along ? &low.height : &low.width) /= 2;
    *(along ? &high.height : &high.width) /= 2;
    *(along ? &high.y : &high.x) = middle;
    const size_t halves = add_halves(t, low, high);
    t->cells[i].halves = halves;
    split_cell(t, halves, points, below, most, depth - 1);
    split_cell(t, halves + 1, points + below, n - below, most, depth - 1);
}

/* The tree of these pairs in the unit square, which are reordered. */
static inline void make_cells(sphere_cells *t, double (*points)[2], size_t n, size_t most)
{
    const cell all = {.width = 1, .height = 1};
    t->n = 0;
    add_halves(t, all, all);
    t->n = 1;
    split_cell(t, 0, points, n, most, 24);
}

/* Adds a direction to the leaf that it is in. */
static inline void count_direction(sphere_cells *t, const float w[3])
{
    double x, y;
    size_t i = 0;
    to_square(t, w, &x, &y);
    while (t->cells[i].halves) {
        const cell *high = &t->cells[t->cells[i].halves + 1];
        i = t->cells[i].halves + (x >= high->x && y >= high->y);
    }
    t->cells[i].got++;
}

/* The positions and weights of Gauss-Legendre quadrature of 5 points on (0, 1). */
static const double gauss5[5][2] = {{0.04691007703066800, 0.11846344252809454},
                                    {0.23076534494715845, 0.23931433524968324},
                                    {0.5, 0.28444444444444444},
                                    {0.76923465505284155, 0.23931433524968324},
                                    {0.95308992296933200, 0.11846344252809454}};

/* Chi-square of the counts, cells of few expected ones together; its limit at probability 1e-6. */
static inline double chi_square(const sphere_cells *t, double *limit)
{
    double sum = 0, expected = 0, got = 0, freedom = -1;
    for (size_t i = 0; i < t->n; i++) {
        expected += t->cells[i].expected;
        got += t->cells[i].got;
        if (expected > 10 || (i + 1 == t->n && expected > 0)) {
            sum += (got - expected) * (got - expected) / expected;
            freedom++;
            expected = got = 0;
        }
    }
    *limit = chi_square_limit(freedom > 1 ? freedom : 1);
    return sum;
}

/* Two axes that make an orthonormal frame with the unit vector n (Duff et al. 2017). */
static inline void frame3(const float n[3], float u[3], float v[3])
{
    const float sign = copysignf(1, n[2]), a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    u[0] = 1 + sign * n[0] * n[0] * a;
    u[1] = sign * b;
    u[2] = -sign * n[0];
    v[0] = b;
    v[1] = sign + n[1] * n[1] * a;
    v[2] = -n[1];
}

#endif
