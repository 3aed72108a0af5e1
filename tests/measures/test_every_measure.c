/* SPDX-License-Identifier: Apache-2.0 */
/* Walks the table of measures, each with its defaults and with every choice of its parameters, in 1, 2, 3 and 5
   dimensions: values do not depend on the order of points or coordinates, nor on the number of threads, bit for bit;
   bounds enclose the value; the region that a value names gives it when the points in it are counted; known
   inequalities between measures and symmetries hold. */
#include <stdlib.h>
#include <string.h>

#include "sets.h"

static const int dims[] = {1, 2, 3, 5};
static const size_t sizes[] = {4, 16, 27, 64};
static const char *const patterns[] = {"random", "halton:shift=1", "sobol:scramble=owen", "latin-hypercube"};
enum { DIMS = 4, SIZES = 4, PATTERNS = 4, MOST_SPECS = 16 };

/* Calls look for every measure, spec and set; nothing that a measure has no form for. */
typedef void look_at(const koksma_spec *spec, const koksma_points *points, const koksma_value *value);

/* The defaults, and each choice of each parameter. */
static size_t specs_of(const koksma_measure *m, koksma_spec *specs)
{
    size_t count = 1;
    assert_ok(koksma_measure_spec(m->name, &specs[0]));
    for (int k = 0; m->params && m->params[k].name; k++) {
        for (int c = 0; m->params[k].choices && m->params[k].choices[c]; c++) {
            if (c != (int)m->params[k].fallback && count < MOST_SPECS) {
                specs[count] = specs[0];
                specs[count++].params[k] = c;
            }
        }
    }
    return count;
}

static void walk(look_at *look)
{
    const koksma_measure *m;
    for (size_t i = 0; (m = koksma_measure_at(i)); i++) {
        koksma_spec specs[MOST_SPECS];
        size_t looked = 0;
        const size_t n_specs = specs_of(m, specs);
        for (size_t c = 0; c < n_specs * DIMS * SIZES; c++) {
            const koksma_spec *spec = &specs[c / (DIMS * SIZES)];
            const int dim = dims[c / SIZES % DIMS];
            const koksma_run run = {.threads = 1};
            koksma_value value;
            if (dim < m->min_dim || dim > m->max_dim || (dim > 2 && sizes[c % SIZES] > 27)) {
                continue;
            }
            koksma_points points = test_points(patterns[c % PATTERNS], sizes[c % SIZES], dim, 7 + c);
            if (!koksma_evaluate(spec, &points, &run, &value)) {
                look(spec, &points, &value);
                looked++;
            }
            koksma_points_fini(&points);
        }
        assert_that(looked >= SIZES, "%s: %zu sets: %s", m->name, looked, koksma_error_text());
    }
}

#define fail_measure(spec, points, ...)                                                                              \
    do {                                                                                                             \
        char text_[KOKSMA_MAX_SPEC], why_[300];                                                                      \
        koksma_spec_text(spec, text_);                                                                               \
        snprintf(why_, sizeof why_, __VA_ARGS__);                                                                    \
        fail_msg("%s, n = %zu, dim = %d: %s", text_, (points)->n, (points)->dim, why_);                              \
    } while (0)

/* A digit of rounding for exact values; sampled values differ by chance, bounds by their luck. */
static double tolerance(const koksma_spec *spec, const koksma_value *value)
{
    const bool sampled = spec->measure->answer == KOKSMA_ANSWER_SAMPLED;
    return sampled ? 6 * value->standard_error : 1e-11 * fmax(1, fabs(value->value));
}

static koksma_value value_of(const koksma_spec *spec, const koksma_points *points, int threads)
{
    const koksma_run run = {.threads = threads};
    koksma_value value;
    memset(&value, 0, sizeof value);
    assert_ok(koksma_evaluate(spec, points, &run, &value));
    return value;
}

/* Equal bits of all that a value says. */
static bool are_equal(const koksma_value *a, const koksma_value *b)
{
    const koksma_witness *v = &a->witness, *w = &b->witness;
    return !memcmp(&a->value, &b->value, sizeof a->value) && !memcmp(&a->square, &b->square, sizeof a->square) &&
           !memcmp(&a->lower, &b->lower, sizeof a->lower) && !memcmp(&a->upper, &b->upper, sizeof a->upper) &&
           a->exact == b->exact && v->kind == w->kind && v->count == w->count &&
           (v->kind == KOKSMA_WITNESS_NONE ||
            (!memcmp(v->lo, w->lo, (size_t)v->dim * sizeof *v->lo) && v->closed == w->closed &&
             !memcmp(v->hi, w->hi, sizeof *v->hi * (v->kind == KOKSMA_WITNESS_BOX ? (size_t)v->dim : 1))));
}

static void look_at_threads(const koksma_spec *spec, const koksma_points *points, const koksma_value *value)
{
    for (int threads = 2; threads <= 8; threads += 3) {
        const koksma_value other = value_of(spec, points, threads);
        if (!are_equal(value, &other)) {
            fail_measure(spec, points, "%.17g on one thread, %.17g on %d", value->value, other.value, threads);
        }
    }
}

/* Reverses the points, and rotates the order by a third. */
static void look_at_order(const koksma_spec *spec, const koksma_points *points, const koksma_value *value)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    koksma_points other;
    assert_ok(koksma_points_init(&other, n, points->dim));
    for (size_t i = 0; i < n; i++) {
        const size_t j = n - 1 - (i + n / 3) % n;
        memcpy(other.xs + i * dim, points->xs + j * dim, dim * sizeof *other.xs);
    }
    const koksma_value moved = value_of(spec, &other, 1);
    if (value->exact && !(fabs(moved.value - value->value) <= tolerance(spec, value))) {
        fail_measure(spec, points, "%.17g in one order of the points, %.17g in another", value->value, moved.value);
    }
    koksma_points_fini(&other);
}

/* Coordinates in another order. */
static void look_at_coordinates(const koksma_spec *spec, const koksma_points *points, const koksma_value *value)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    koksma_points other;
    assert_ok(koksma_points_init(&other, n, points->dim));
    for (size_t c = 0; c < n * dim; c++) {
        other.xs[c] = points->xs[c / dim * dim + (c % dim + 1) % dim];
    }
    const koksma_value moved = value_of(spec, &other, 1);
    if (value->exact && !(fabs(moved.value - value->value) <= 2 * tolerance(spec, value))) {
        fail_measure(spec, points, "%.17g, and %.17g with the coordinates in another order", value->value,
                     moved.value);
    }
    koksma_points_fini(&other);
}

static void look_at_bounds(const koksma_spec *spec, const koksma_points *points, const koksma_value *value)
{
    const koksma_measure *m = spec->measure;
    if (!(value->value >= 0) ||
        (m->family != KOKSMA_FAMILY_NONE && m->answer == KOKSMA_ANSWER_BOUND && value->value > 1)) {
        fail_measure(spec, points, "the value is %.17g", value->value);
    }
    if (value->exact && m->answer == KOKSMA_ANSWER_EXACT &&
        (value->lower != value->value || value->upper != value->value)) {
        fail_measure(spec, points, "exact, within %.17g and %.17g", value->lower, value->upper);
    }
    if (value->lower > value->value || value->upper < value->value) {
        fail_measure(spec, points, "%.17g is not within %.17g and %.17g", value->value, value->lower, value->upper);
    }
    if (!isnan(value->square) &&
        !(fabs(value->square - value->value * value->value) <= 1e-12 * fmax(1, value->square))) {
        fail_measure(spec, points, "the square of %.17g is %.17g", value->value, value->square);
    }
}

/* ---- Witnesses: counted as the header says, with the region's volume computed here ---------------------------- */

/* -1: inside; 0: on the boundary; 1: outside. Sides at 0 of a box are no boundary: random points are not there. */
static int side_of(const koksma_witness *w, const double *x)
{
    int side = -1;
    if (w->kind == KOKSMA_WITNESS_BOX) {
        for (int k = 0; k < w->dim; k++) {
            const bool anchored = w->lo[k] == 0;
            const int s = x[k] < w->lo[k] || x[k] > w->hi[k]                    ? 1
                          : (x[k] == w->lo[k] && !anchored) || x[k] == w->hi[k] ? 0
                                                                                : -1;
            side = s > side ? s : side;
        }
        return side;
    }
    double sum = 0, bound = w->hi[0];
    if (w->kind == KOKSMA_WITNESS_HALF_PLANE) {
        for (int k = 0; k < w->dim; k++) {
            sum += w->lo[k] * x[k];
        }
    } else {
        for (int k = 0; k < 2; k++) {
            const double d = x[k] - w->lo[k], t = d - floor(d + 0.5);
            sum += t * t;
        }
        bound *= bound;
    }
    return sum < bound ? -1 : sum > bound;
}

/* The part of the unit square where a x + b y <= c: each column's part by the midpoint rule would be rough, so the
   polygon is clipped and its area taken by the shoelace formula. */
static double half_plane_area(const double *w, double c)
{
    static const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double polygon[8][2], area = 0;
    int n = 0;
    for (int i = 0; i < 4; i++) {
        const double *p = corners[i], *q = corners[(i + 1) % 4];
        const double dp = w[0] * p[0] + w[1] * p[1] - c, dq = w[0] * q[0] + w[1] * q[1] - c;
        if (dp <= 0) {
            memcpy(polygon[n++], p, sizeof polygon[0]);
        }
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
            const double t = dp / (dp - dq);
            polygon[n][0] = p[0] + t * (q[0] - p[0]);
            polygon[n++][1] = p[1] + t * (q[1] - p[1]);
        }
    }
    for (int i = 0; i < n; i++) {
        const double *p = polygon[i], *q = polygon[(i + 1) % n];
        area += (p[0] * q[1] - q[0] * p[1]) / 2;
    }
    return area;
}

/* NAN: not computed here. */
static double volume_of(const koksma_witness *w)
{
    double volume = 1;
    if (w->kind == KOKSMA_WITNESS_DISK) {
        return w->hi[0] <= 0.5 ? M_PI * w->hi[0] * w->hi[0] : (double)NAN;
    }
    if (w->kind == KOKSMA_WITNESS_HALF_PLANE) {
        return w->dim == 2 ? half_plane_area(w->lo, w->hi[0]) : (double)NAN;
    }
    for (int k = 0; k < w->dim; k++) {
        volume *= w->hi[k] - w->lo[k];
    }
    return volume;
}

static void look_at_witness(const koksma_spec *spec, const koksma_points *points, const koksma_value *value)
{
    const koksma_witness *w = &value->witness;
    if (w->kind == KOKSMA_WITNESS_NONE) {
        return;
    }
    size_t count = 0;
    for (size_t i = 0; i < points->n; i++) {
        const int side = side_of(w, points->xs + i * (size_t)points->dim);
        count += side < 0 || (side == 0 && w->closed);
    }
    if (count != w->count) {
        fail_measure(spec, points, "the region holds %zu points, not %zu", count, w->count);
    }
    const double volume = volume_of(w), found = fabs((double)count / (double)points->n - w->volume);
    if (!isnan(volume) && !(fabs(volume - w->volume) < 1e-9)) {
        fail_measure(spec, points, "the region's volume is %.17g, not %.17g", volume, w->volume);
    }
    if (!(fabs(found - value->value) < 1e-12)) {
        fail_measure(spec, points, "the region gives %.17g, not %.17g", found, value->value);
    }
}

/* Small sets, and those that are cut into blocks: with the n of a measure here, or 70. */
TEST_CASE(values_do_not_depend_on_threads)
{
    static const struct {
        const char *measure;
        int dim;
        size_t n;
    } sizes_of[] = {{"star", 3, 150},  {"extreme", 2, 200}, {"l2-disk", 2, 777}, {"edge", 3, 40},
                    {"l2-", 2, 40000}, {"l2-", 3, 700},     {"l2-edge", 2, 70},  {"diaphony", 2, 40000}};
    const koksma_measure *m;
    walk(look_at_threads);
    for (size_t i = 0; (m = koksma_measure_at(i)); i++) {
        koksma_spec specs[MOST_SPECS];
        const size_t n_specs = specs_of(m, specs);
        for (size_t c = 0; c < 2 * n_specs; c++) {
            const int dim = c % 2 ? 3 : 2;
            size_t n = dim == 2 ? 70 : 20;
            for (size_t s = 0; s < sizeof sizes_of / sizeof *sizes_of; s++) { /* the last that fits counts */
                const bool fits = !strncmp(m->name, sizes_of[s].measure, strlen(sizes_of[s].measure));
                n = fits && sizes_of[s].dim == dim && (m->family == KOKSMA_FAMILY_BOXES || sizes_of[s].n < 1000)
                        ? sizes_of[s].n
                        : n;
            }
            koksma_points points = test_points("random", n, dim, 4);
            koksma_value value;
            if (dim >= m->min_dim && dim <= m->max_dim &&
                !koksma_evaluate(&specs[c / 2], &points, &(koksma_run){.threads = 1}, &value)) {
                look_at_threads(&specs[c / 2], &points, &value);
            }
            koksma_points_fini(&points);
        }
    }
}

TEST_CASE(values_do_not_depend_on_order)
{
    walk(look_at_order);
}

TEST_CASE(values_do_not_depend_on_the_order_of_coordinates)
{
    walk(look_at_coordinates);
}

TEST_CASE(bounds_enclose_values)
{
    walk(look_at_bounds);
}

TEST_CASE(witnesses_give_their_values)
{
    walk(look_at_witness);
}

/* ---- What theory says of pairs of measures, and of moved points ----------------------------------------------- */

/* left <= factor^dim right, for all points: a root mean square is at most the supremum over the same regions,
   anchored boxes are boxes, and a box is an alternating sum of 2^dim anchored ones. */
TEST_CASE(known_inequalities_hold)
{
    static const struct {
        const char *left, *right;
        double factor;
    } rows[] = {
        {"star", "extreme", 1}, {"extreme", "star", 2},       {"star-lower", "star", 1},
        {"l2-star", "star", 1}, {"l2-extreme", "extreme", 1}, {"l2-star", "l2-modified", 1},
        {"l2-edge", "edge", 1}, {"edge-sampled", "edge", 1},  {"l2-periodic", "l2-wraparound", 1},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        size_t compared = 0;
        for (int t = 0; t < 12; t++) {
            const int dim = 1 + t % 3;
            koksma_points p = test_points(patterns[t % PATTERNS], t % 2 ? 16 : 27, dim, 90 + (uint64_t)t);
            koksma_spec left, right;
            koksma_value a, b;
            assert_ok(koksma_measure_spec(rows[r].left, &left));
            assert_ok(koksma_measure_spec(rows[r].right, &right));
            if (!koksma_evaluate(&left, &p, NULL, &a) && !koksma_evaluate(&right, &p, NULL, &b)) {
                compared++;
                if (!(a.value <= pow(rows[r].factor, dim) * b.value * (1 + 1e-12))) {
                    fail_measure(&left, &p, "%.17g, above that of %s, %.17g", a.value, rows[r].right, b.value);
                }
            }
            koksma_points_fini(&p);
        }
        assert_true(compared > 0);
    }
}

/* Moves that leave a measure as it is. */
TEST_CASE(known_symmetries_hold)
{
    static const struct {
        const char *measure;
        bool shift, reflect; /* on the torus; about 1/2 in the first coordinate */
    } rows[] = {
        {"l2-periodic", true, true},   {"l2-wraparound", true, true},   {"diaphony", true, true},
        {"min-distance", true, true},  {"relative-radius", true, true}, {"l2-centered", false, true},
        {"l2-symmetric", false, true}, {"l2-extreme", false, true},     {"l2-mixture", false, true},
        {"extreme", false, true},      {"edge", false, true},           {"l2-edge", false, true},
        {"disk", true, true},          {"l2-disk", true, true},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        koksma_points p = test_points("jittered", 16, 2, 30 + r), q = test_points("jittered", 16, 2, 30 + r);
        koksma_spec spec;
        assert_ok(koksma_measure_spec(rows[r].measure, &spec));
        const koksma_value before = value_of(&spec, &p, 1);
        for (int move = 0; move < 2; move++) {
            for (size_t c = 0; c < 32; c++) {
                const double x = p.xs[c] + (c % 2 ? 0.3125 : 0.6875);
                q.xs[c] = move == 0 ? x - floor(x) : c % 2 ? p.xs[c] : 1 - p.xs[c];
            }
            const koksma_value after = value_of(&spec, &q, 1);
            if ((move ? rows[r].reflect : rows[r].shift) && !(fabs(after.value - before.value) < 1e-9)) {
                fail_measure(&spec, &p, "%.17g, and %.17g %s", before.value, after.value,
                             move ? "reflected" : "shifted");
            }
        }
        koksma_points_fini(&p);
        koksma_points_fini(&q);
    }
}

/* A measure whose value is the root of a quadratic mean or form of the points (it knows the square) says so in its title:
   others' programs print the square of some of them. */
static void looks_for_the_root(const koksma_spec *spec, const koksma_points *points, const koksma_value *value)
{
    if (!isnan(value->square)) {
        const char *title = spec->measure->title;
        if (!(fabs(value->value - sqrt(value->square)) <= 1e-9 * value->value)) {
            fail_measure(spec, points, "%.17g is not the root of %.17g", value->value, value->square);
        }
        if (!strstr(title, "root")) {
            fail_measure(spec, points, "its title does not say that it is a root: %s", title);
        }
    }
}

TEST_CASE(roots_are_called_so)
{
    walk(looks_for_the_root);
    const koksma_measure *m;
    for (size_t i = 0; (m = koksma_measure_at(i)); i++) {
        if ((!strncmp(m->name, "l2-", 3) || strstr(m->title, "L2 ")) && !strstr(m->title, "root")) {
            fail_msg("%s: its title does not say that it is a root: %s", m->name, m->title);
        }
    }
}
