/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_generate_density and koksma_generate_rectangle: points in a rectangle, whose density may follow an image. A
 * candidate is a uniform point in a pixel that is drawn with probability proportional to its luminance, by bisection in
 * the running sums of the luminance. Where the luminance is p times its mean, distances are proportional to 1 / sqrt p:
 * the unit of distance there is 1 / sqrt p. A rectangle without an image is one of equal pixels that are about square.
 *
 * Positions of choose.c are in [0,1)^2; `lengths` makes distances those of the rectangle, in units of its height.
 */
#include <koksma/density.h>

#include <math.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/random.h"
#include "core/status.h"
#include "core/vector.h"
#include "domains/field.h"
#include "image/image.h"
#include "patterns/grids/grids.h"

/* A density on a rectangle, in coordinates of [0,1)^2, that an image gives: it is constant in each pixel, in proportion to
   the luminance of the pixel. Pixels are numbered row by row, the top row first. */
typedef struct density {
    size_t width, height;
    double *sums; /* sums[i]: the summed luminance of pixels 0 to i */
} density;

/* Returns the luminance of a pixel. */
static double share(const void *data, size_t pixel)
{
    const density *m = data;
    return m->sums[pixel] - (pixel ? m->sums[pixel - 1] : 0);
}

static void place(const void *data, const koksma__domain_point *point, double *x)
{
    const density *m = data;
    x[0] = koksma__in_cell((double)(point->part % m->width), point->at[0], (double)m->width);
    x[1] = koksma__in_cell((double)(m->height - 1 - point->part / m->width), point->at[1], (double)m->height);
}

/* ---- The field ---- */

enum { DEEPEST = 26, LEAST_POINTS = 4, ROOTS = 8 };

typedef struct density_field {
    const density *m;
    const double *lengths; /* of the axes (domain.h); other positions and sides here are coordinates in [0,1) */
    double *table;         /* (height + 1) rows of width + 1: number of points left of and below each pixel corner */
    double n, sigma;
    size_t capacity;
    koksma__field *field;
    const koksma_run *run; /* only while the field is opened */
} density_field;

/* Returns the number of points that the density puts into [0,u] x [0,v], for u and v in [0,1]. */
static double inside(const density_field *f, double u, double v)
{
    const size_t w = f->m->width, h = f->m->height;
    const double x = u * (double)w, y = v * (double)h;
    const size_t i = x < (double)w ? (size_t)x : w - 1, j = y < (double)h ? (size_t)y : h - 1;
    const double a = x - (double)i, b = y - (double)j, *low = f->table + j * (w + 1) + i, *high = low + w + 1;
    return (1 - b) * ((1 - a) * low[0] + a * low[1]) + b * ((1 - a) * high[0] + a * high[1]);
}

/* Returns the number of points in [0,u] x [0,v] for any u and v >= 0, where the image is repeated over the plane; for
   negative ones the number has the sign of u v. */
static double repeated(const density_field *f, double u, double v)
{
    const double i = floor(u), j = floor(v);
    return inside(f, u - i, v - j) + (i == 0 ? 0 : i * inside(f, 1, v - j)) + (j == 0 ? 0 : j * inside(f, u - i, 1)) +
           i * j * f->n;
}

static double points_in(const density_field *f, double x0, double y0, double x1, double y1)
{
    return fmax(repeated(f, x1, y1) - repeated(f, x0, y1) - repeated(f, x1, y0) + repeated(f, x0, y0), 0);
}

/* Returns the number of points in the square about x whose half side measures h. */
static double points_about(const density_field *f, const double *x, double h)
{
    const double a = h / f->lengths[0], b = h / f->lengths[1];
    return points_in(f, x[0] - a, x[1] - b, x[0] + a, x[1] + b);
}

static double width(const void *data, const double *x)
{
    const density_field *f = data;
    if (f->n <= LEAST_POINTS) {
        return f->sigma * sqrt(f->lengths[0] * f->lengths[1] / f->n);
    }
    const double root = sqrt(LEAST_POINTS);
    double low = 0, high = 0.5 * fmax(f->lengths[0], f->lengths[1]), at_low = -root, h = high;
    double at_high = sqrt(points_about(f, x, high)) - root;
    for (int i = 0, last = 0; i < 60 && high - low > 1e-6 * high; i++) {
        h = (low * at_high - high * at_low) / (at_high - at_low);
        const double value = sqrt(points_about(f, x, h)) - root;
        if (fabs(value) < 1e-6) {
            break;
        }
        if (value < 0) {
            low = h;
            at_low = value;
            at_high = last < 0 ? at_high / 2 : at_high;
            last = -1;
        } else {
            high = h;
            at_high = value;
            at_low = last > 0 ? at_low / 2 : at_low;
            last = 1;
        }
    }
    return f->sigma * h;
}

static bool settle(const void *data, double *x, koksma__domain_point *point)
{
    const density *m = ((const density_field *)data)->m;
    uint32_t cell[2];
    koksma__domain_point to;
    const uint32_t cells[2] = {(uint32_t)m->width, (uint32_t)m->height};
    for (int k = 0; k < 2; k++) {
        x[k] -= floor(x[k]);
        x[k] = x[k] < 1 ? x[k] : 0;
        cell[k] = koksma__cell_along(x[k], cells[k]);
        to.at[k] = fmin(fmax(x[k] * cells[k] - cell[k], 0), 1 - 0x1p-53);
    }
    to.part = (cells[1] - 1 - cell[1]) * cells[0] + cell[0];
    if (!(share(m, to.part) > 0)) {
        return false;
    }
    *point = to;
    place(m, point, x);
    return true;
}

static void close_field(void *data)
{
    density_field *f = data;
    free(f->table);
    free(f);
}

/* Adds the node of a box of the quadtree. */
static koksma_status add_node(density_field *f, const double low[2], const double side[2], double mass, double s)
{
    KOKSMA__TRY(koksma__look(f->run, f->field->n_nodes, 0));
    const double u = side[0] * f->lengths[0], v = side[1] * f->lengths[1];
    koksma__field_node node = {.mass = mass, .square = s * s + (u * u + v * v) / 12};
    const double part[2] = {side[0] / 4, side[1] / 4};
    double sum = 0;
    for (int i = 0; i < 16; i++) {
        const double x = low[0] + part[0] * (i % 4), y = low[1] + part[1] * (double)(i / 4);
        const double points = points_in(f, x, y, x + part[0], y + part[1]);
        sum += points;
        node.x[0] += points * (x + part[0] / 2);
        node.x[1] += points * (y + part[1] / 2);
    }
    for (int k = 0; k < 2; k++) {
        node.x[k] = sum > 0 ? node.x[k] / sum : low[k] + side[k] / 2;
        node.x[k] = fmin(node.x[k], 1 - 0x1p-53);
    }
    KOKSMA__TRY(koksma__reserve(&f->field->nodes, &f->capacity, f->field->n_nodes + 1, sizeof node));
    f->field->nodes[f->field->n_nodes++] = node;
    return KOKSMA_OK;
}

static koksma_status add_box(density_field *f, const double low[2], const double side[2], int depth)
{
    const double half[2] = {side[0] / 2, side[1] / 2}, centre[2] = {low[0] + half[0], low[1] + half[1]};
    const double mass = points_in(f, low[0], low[1], low[0] + side[0], low[1] + side[1]);
    if (!(mass > 0)) {
        return KOKSMA_OK;
    }
    const double s = width(f, centre);
    const double longer = fmax(side[0] * f->lengths[0], side[1] * f->lengths[1]);
    if (longer <= KOKSMA__NODE_WIDTHS * s || depth == DEEPEST) {
        return add_node(f, low, side, mass, s);
    }
    for (int quarter = 0; quarter < 4; quarter++) {
        const double corner[2] = {quarter & 1 ? centre[0] : low[0], quarter & 2 ? centre[1] : low[1]};
        KOKSMA__TRY(add_box(f, corner, half, depth + 1));
    }
    return KOKSMA_OK;
}

/* Covers the rectangle by quadtrees whose boxes are as near to squares as up to ROOTS of them along the shorter side
   allow: the variance of a node is the same along both axes. */
static koksma_status add_boxes(density_field *f)
{
    const int longer = f->lengths[1] > f->lengths[0];
    const double ratio = f->lengths[longer] / f->lengths[!longer];
    int best = 1;
    double off = INFINITY;
    for (int rows = 1; rows <= ROOTS; rows++) {
        const double found = fabs(koksma__log(round(ratio * rows) / rows / ratio));
        best = found < off ? rows : best;
        off = fmin(found, off);
    }
    double side[2], low[2];
    const int across = (int)round(ratio * best);
    side[longer] = 1.0 / across;
    side[!longer] = 1.0 / best;
    for (int i = 0; i < across; i++) {
        for (int j = 0; j < best; j++) {
            low[longer] = i * side[longer];
            low[!longer] = j * side[!longer];
            KOKSMA__TRY(add_box(f, low, side, 0));
        }
    }
    return KOKSMA_OK;
}

static void sum_points(density_field *f)
{
    const size_t w = f->m->width, h = f->m->height;
    const double scale = f->n / f->m->sums[w * h - 1];
    for (size_t i = 0; i <= w; i++) {
        f->table[i] = 0;
    }
    for (size_t j = 0; j < h; j++) {
        double row = 0;
        const double *below = f->table + j * (w + 1);
        double *here = f->table + (j + 1) * (w + 1);
        here[0] = 0;
        for (size_t i = 0; i < w; i++) {
            row += scale * share(f->m, (h - 1 - j) * w + i);
            here[i + 1] = below[i + 1] + row;
        }
    }
}

static koksma_status open_field(const koksma__point_domain *domain, size_t n, double sigma, const koksma_run *run,
                                koksma__field *field)
{
    const density *m = domain->data;
    const size_t bytes = (m->width + 1) * (m->height + 1) * sizeof(double);
    density_field *f = malloc(sizeof *f);
    KOKSMA__REQUIRE_MEMORY(f, sizeof *f);
    *f = (density_field){.m = m,
                         .lengths = domain->lengths,
                         .table = malloc(bytes),
                         .n = (double)n,
                         .sigma = sigma,
                         .field = field,
                         .run = run};
    *field = (koksma__field){.data = f, .width = width, .settle = settle, .close = close_field};
    KOKSMA__REQUIRE_MEMORY(f->table, bytes); /* the caller closes the field, also after an error */
    sum_points(f);
    return add_boxes(f);
}

/* ---- The domain ---- */

enum { LONGEST = 10000 };

static void draw(const void *data, uint64_t seed, uint64_t i, koksma__domain_point *point)
{
    const density *m = data;
    const size_t pixels = m->width * m->height;
    double which[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 0, which);
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 1, point->at);
    point->part = (uint32_t)koksma__domain_find(m->sums, pixels, which[0] * m->sums[pixels - 1]);
}

static double unit_of(const void *data, size_t part)
{
    const density *m = data;
    const size_t pixels = m->width * m->height;
    return sqrt(m->sums[pixels - 1] / ((double)pixels * share(data, part)));
}

static koksma_status sum_up(const koksma_image *map, density *m)
{
    double sum = 0;
    for (size_t i = 0; i < m->width * m->height; i++) {
        const double value = koksma__luminance(map, i);
        KOKSMA__FAIL_IF(!(value >= 0), KOKSMA_MALFORMED,
                        "the density has a negative value in pixel (%zu, %zu); 0 or more would do", i % m->width,
                        i / m->width);
        m->sums[i] = sum += value;
    }
    KOKSMA__FAIL_IF(!(sum > 0), KOKSMA_MALFORMED, "the density is 0 everywhere");
    return KOKSMA_OK;
}

/* Makes the pixels of a rectangle without an image. */
static void make_even(density *m)
{
    for (size_t i = 0; i < m->width * m->height; i++) {
        m->sums[i] = (double)(i + 1);
    }
}

/* Makes points of a rectangle and writes them to `out`, with the sides `scale`. */
static koksma_status choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                            const double scale[2], const koksma_run *run, koksma_points *out)
{
    size_t n = out->n;
    koksma__domain_point *points = NULL;
    koksma_status status = koksma__domain_choose(domain, spec, seed, run, &n, &points);
    if (!status && !out->n) {
        status = koksma_points_init(out, n, 2);
    }
    for (size_t i = 0; i < out->n && !status; i++) {
        double *x = out->xs + 2 * i;
        place(domain->data, &points[i], x);
        x[0] *= scale[0];
        x[1] *= scale[1];
    }
    free(points);
    return status;
}

/* Makes points in a rectangle of the sides `size`, with the density `map`, which may be NULL. The coordinates are written
   in units of the sides over `scale`. */
static koksma_status generate(const koksma_spec *spec, uint64_t seed, const double size[2], const koksma_image *map,
                              const double scale[2], const koksma_run *run, koksma_points *out)
{
    const double ratio = size[0] / size[1];
    density m = {1, 1, NULL};
    if (map) {
        m.width = (size_t)map->width;
        m.height = (size_t)map->height;
    } else {
        m.width = (size_t)fmax(round(ratio), 1);
        m.height = (size_t)fmax(round(1 / ratio), 1);
    }
    const size_t pixels = m.width * m.height;
    m.sums = malloc(pixels * sizeof *m.sums);
    KOKSMA__REQUIRE_MEMORY(m.sums, pixels * sizeof *m.sums);
    const koksma__point_domain domain = {.what = map ? "with a density" : "in a rectangle",
                                         .dim = 2,
                                         .lengths = {ratio, 1, 1},
                                         .corners = 4,
                                         .torus = true,
                                         .varies = map != NULL,
                                         .area = ratio,
                                         .unit = 1 / size[1],
                                         .n_parts = pixels,
                                         .data = &m,
                                         .draw = draw,
                                         .place = place,
                                         .share = share,
                                         .unit_of = unit_of,
                                         .open_field = open_field};
    koksma_status status = KOKSMA_OK;
    if (map) {
        status = sum_up(map, &m);
    } else {
        make_even(&m);
    }
    status = status ? status : choose(&domain, spec, seed, scale, run, out);
    free(m.sums);
    return status;
}

/* Checks where the points are to be written: n points in 2 dimensions, or none, for a set whose d decides. */
static koksma_status check_points(const char *caller, const koksma_points *out)
{
    KOKSMA__FAIL_IF(!out->xs != !out->n, KOKSMA_ARGUMENT, "%s: it takes initialised points, or n = 0 and xs = NULL",
                    caller);
    KOKSMA__FAIL_IF(out->dim != 2, KOKSMA_DIM, "points in a rectangle or with a density are in 2 dimensions, not %d",
                    out->dim);
    return out->n ? koksma__points_fit(out->n, 2) : KOKSMA_OK;
}

koksma_status koksma_generate_density(const koksma_spec *spec, uint64_t seed, const koksma_image *map,
                                      const koksma_run *run, koksma_points *out)
{
    KOKSMA__REQUIRE(spec, map, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check_points(__func__, out));
    KOKSMA__TRY(koksma_image_check_finite(map, "the density"));
    const double size[2] = {(double)map->width / (double)map->height, 1}, scale[2] = {1, 1};
    return generate(spec, seed, size, map, scale, run, out);
}

koksma_status koksma_generate_rectangle(const koksma_spec *spec, uint64_t seed, double width, double height,
                                        const koksma_image *map, const koksma_run *run, koksma_points *out)
{
    KOKSMA__REQUIRE(spec, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check_points(__func__, out));
    const double least = fmin(width, height), most = fmax(width, height);
    KOKSMA__FAIL_IF(!(width > 0 && height > 0 && least >= 1e-100 && most <= 1e100 && most <= LONGEST * least),
                    KOKSMA_ARGUMENT,
                    "a rectangle of %g x %g: width and height are above 0, and one is at most %d times the other",
                    width, height, LONGEST);
    KOKSMA__TRY(map ? koksma_image_check_finite(map, "the density") : KOKSMA_OK);
    const double size[2] = {width, height};
    return generate(spec, seed, size, map, size, run, out);
}
