/* SPDX-License-Identifier: Apache-2.0 */
/* Long because the table of kinds and its definitions serve every case here. The L2 discrepancies against their
   definitions, integrated cell by cell; their kernels against each other; the two ways to compute them; digits at
   large n against 128-bit sums and a closed form; threads. */
#include <string.h>

#include "measures/l2/l2.h"
#include "sets.h"

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 quad;
#else
typedef long double quad; /* it has 113 bits on aarch64 and s390x */
#endif

#define KINDS(X)                                                                                                     \
    X(STAR, star)                                                                                                    \
    X(EXTREME, extreme)                                                                                              \
    X(PERIODIC, periodic)                                                                                            \
    X(WRAPAROUND, wraparound)                                                                                        \
    X(MODIFIED, modified) X(CENTERED, centered) X(MIXTURE, mixture) X(SYMMETRIC, symmetric)

#define NUMBER(id, name) KOKSMA__L2_##id,
enum { KINDS(NUMBER) KOKSMA__L2_KINDS };

#define DECLARE(id, name) extern const koksma__l2_row koksma__l2_##name;
KINDS(DECLARE)

#define ROW(id, name) &koksma__l2_##name,
static const koksma__l2_row *const rows[KOKSMA__L2_KINDS] = {KINDS(ROW)};

#define NAME(id, name) "l2-" #name,
static const char *const names[KOKSMA__L2_KINDS] = {KINDS(NAME)};

/* The kernels as the literature writes them. */
static double kernel(int kind, double u, double v)
{
    const double t = fabs(u - v), h = fabs(u - 0.5), k = fabs(v - 0.5);
    switch (kind) {
    case KOKSMA__L2_STAR:
        return 1 - fmax(u, v);
    case KOKSMA__L2_EXTREME:
        return (1 - fmax(u, v)) * fmin(u, v);
    case KOKSMA__L2_PERIODIC:
        return 0.5 - t + t * t;
    case KOKSMA__L2_WRAPAROUND:
        return 1.5 - t + t * t;
    case KOKSMA__L2_MODIFIED:
        return 2 - fmax(u, v);
    case KOKSMA__L2_CENTERED:
        return 1 + h / 2 + k / 2 - t / 2;
    case KOKSMA__L2_MIXTURE:
        return 15.0 / 8 - h / 4 - k / 4 - 0.75 * t + t * t / 2;
    default:
        return 2 * (1 - t);
    }
}

/* Simpson's rule is exact on each piece: the kernels are quadratic between their kinks. */
static double integral_of_kernel(int kind, double u)
{
    const double cuts[4] = {0, fmin(u, 0.5), fmax(u, 0.5), 1};
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        const double a = cuts[c], b = cuts[c + 1];
        sum += (b - a) / 6 * (kernel(kind, u, a) + 4 * kernel(kind, u, (a + b) / 2) + kernel(kind, u, b));
    }
    return sum;
}

TEST_CASE(table_is_consistent)
{
    for (int kind = 0; kind < KOKSMA__L2_KINDS; kind++) {
        const koksma__l2_row *row = rows[kind];
        double c = 0;
        for (int i = 0; i <= 64; i++) {
            const double u = i / 64.0, a = koksma__l2_polynomial(row->a24, u) / 24;
            assert_near(a, integral_of_kernel(kind, u), 1e-15);
            c += a * (i == 0 || i == 64 ? 1 : i % 2 ? 4 : 2) / 192;
            for (int j = 0; j <= 64; j++) {
                const double v = j / 64.0, t = fabs(u - v);
                const double k =
                    koksma__l2_polynomial(row->g, u) + koksma__l2_polynomial(row->g, v) + row->q * t + row->r * t * t;
                assert_near(k, kernel(kind, u, v), 1e-15);
            }
        }
        assert_near(c, row->c12 / 12, 4e-15);
    }
}

/* A set of intervals with weights, which integrates quadratics in the ends exactly. */
typedef struct intervals {
    double lo[4096], hi[4096], weight[4096];
    bool outside[4096]; /* the interval wraps around: it is all but [hi, lo) */
    int count;
} intervals;

static const double gauss[2] = {0.21132486540518712, 0.78867513459481288};

static void put(intervals *v, double lo, double hi, bool outside, double weight)
{
    v->lo[v->count] = lo;
    v->hi[v->count] = hi;
    v->outside[v->count] = outside;
    v->weight[v->count++] = weight;
}

/* Kind star: [0, y); extreme: lo < hi; periodic: both ends uniform, wrapping; centered: from the nearest corner. */
static void fill_intervals(intervals *v, int kind, const koksma_points *p, int k)
{
    double cuts[32] = {0, 0.5, 1};
    int n = 3;
    for (size_t i = 0; i < p->n; i++) {
        int at = n++;
        const double x = p->xs[i * (size_t)p->dim + (size_t)k];
        for (; at > 0 && cuts[at - 1] > x; at--) {
            cuts[at] = cuts[at - 1];
        }
        cuts[at] = x;
    }
    v->count = 0;
    for (int a = 0; a + 1 < n; a++) {
        const double at = cuts[a], width = cuts[a + 1] - at;
        for (int s = 0; s < 4 && width > 0; s++) {
            const double y = at + gauss[s % 2] * width;
            if (kind == KOKSMA__L2_STAR && s < 2) {
                put(v, 0, y, false, width / 2);
            } else if (kind == KOKSMA__L2_CENTERED && s < 2) {
                put(v, y > 0.5 ? y : 0, y > 0.5 ? 1 : y, false, width / 2);
            } else if (kind == KOKSMA__L2_EXTREME || kind == KOKSMA__L2_PERIODIC) {
                /* both ends in this cell: the triangle, by (s, s t) */
                const double lo = at + gauss[s % 2] * gauss[s / 2] * width, w = width * width * gauss[s % 2] / 4;
                put(v, lo, y, false, w);
                if (kind == KOKSMA__L2_PERIODIC) {
                    put(v, y, lo, true, w);
                }
                for (int b = a + 1; b + 1 < n; b++) {
                    const double other = cuts[b + 1] - cuts[b], hi = cuts[b] + gauss[s / 2] * other;
                    if (other > 0) {
                        put(v, y, hi, false, width * other / 4);
                        if (kind == KOKSMA__L2_PERIODIC) {
                            put(v, hi, y, true, width * other / 4);
                        }
                    }
                }
            }
        }
    }
}

static bool holds(const intervals *v, int i, double x)
{
    return v->outside[i] ? x < v->hi[i] || x >= v->lo[i] : x >= v->lo[i] && (x < v->hi[i] || v->hi[i] == 1);
}

static double length(const intervals *v, int i)
{
    return v->outside[i] ? 1 - (v->lo[i] - v->hi[i]) : v->hi[i] - v->lo[i];
}

/* The integral of (share - volume)^2 over products of intervals. */
static double square_2d(int kind, const koksma_points *p)
{
    static intervals x, y;
    fill_intervals(&x, kind, p, 0);
    fill_intervals(&y, kind, p, 1);
    double sum = 0;
    for (int a = 0; a < x.count; a++) {
        for (int b = 0; b < y.count; b++) {
            double inside = 0;
            for (size_t i = 0; i < p->n; i++) {
                inside += holds(&x, a, p->xs[2 * i]) && holds(&y, b, p->xs[2 * i + 1]);
            }
            const double deviation = inside / (double)p->n - length(&x, a) * length(&y, b);
            sum += x.weight[a] * y.weight[b] * deviation * deviation;
        }
    }
    return sum;
}

static double square_1d(int kind, const koksma_points *p, int k)
{
    static intervals x;
    fill_intervals(&x, kind, p, k);
    double sum = 0;
    for (int a = 0; a < x.count; a++) {
        double inside = 0;
        for (size_t i = 0; i < p->n; i++) {
            inside += holds(&x, a, p->xs[2 * i + (size_t)k]);
        }
        const double deviation = inside / (double)p->n - length(&x, a);
        sum += x.weight[a] * deviation * deviation;
    }
    return sum;
}

TEST_CASE(values_are_the_integrals)
{
    for (int s = 0; s < test_repeats(180, 36); s++) {
        koksma_points p = sets_points(1 + (size_t)(s / SETS_KINDS) % 5, 2, s % SETS_KINDS, (uint64_t)s);
        const double star = square_2d(KOKSMA__L2_STAR, &p), extreme = square_2d(KOKSMA__L2_EXTREME, &p);
        const double periodic = square_2d(KOKSMA__L2_PERIODIC, &p), centered = square_2d(KOKSMA__L2_CENTERED, &p);
        double modified = star, wrap = periodic, all_centered = centered;
        for (int k = 0; k < 2; k++) {
            modified += square_1d(KOKSMA__L2_STAR, &p, k);
            wrap += square_1d(KOKSMA__L2_PERIODIC, &p, k);
            all_centered += square_1d(KOKSMA__L2_CENTERED, &p, k);
        }
        assert_near(test_measure("l2-star", &p).square, star, 1e-14);
        assert_near(test_measure("l2-extreme", &p).square, extreme, 1e-14);
        assert_near(test_measure("l2-periodic", &p).square, periodic, 1e-14);
        assert_near(test_measure("l2-modified", &p).square, modified, 1e-14);
        assert_near(test_measure("l2-wraparound", &p).square, wrap, 1e-14);
        assert_near(test_measure("l2-centered", &p).square, all_centered, 1e-14);
        double corners = 0;
        for (int corner = 0; corner < 4; corner++) {
            koksma_points q = sets_points(p.n, 2, s % SETS_KINDS, (uint64_t)s);
            for (size_t i = 0; i < 2 * p.n; i++) {
                q.xs[i] = corner >> i % 2 & 1 ? 1 - p.xs[i] : p.xs[i];
            }
            corners += test_measure("l2-star", &q).square;
            koksma_points_fini(&q);
        }
        assert_near(test_measure("l2-symmetric", &p).square, 16 * corners / 4, 1e-14);
        koksma_points_fini(&p);
    }
}

static double diaphonys_kernel(double u, double v)
{
    const double t = fabs(u - v);
    return 1 + 2 * M_PI * M_PI * (1.0 / 6 - t + t * t);
}

/* The formula with the literature's kernels in long double, in any dimension; kind KOKSMA__L2_KINDS is diaphony. */
static long double literal_square(int kind, const koksma_points *p)
{
    const long double n = (long double)p->n;
    long double square = 1, linear = 0, pairs = 0;
    const size_t dim = (size_t)p->dim;
    for (size_t k = 0; k < dim && kind < KOKSMA__L2_KINDS; k++) {
        square *= (long double)rows[kind]->c12 / 12;
    }
    for (size_t i = 0; i < p->n; i++) {
        long double a = 1;
        for (size_t k = 0; k < dim && kind < KOKSMA__L2_KINDS; k++) {
            a *= integral_of_kernel(kind, p->xs[i * dim + k]);
        }
        linear += a;
        for (size_t j = 0; j < p->n; j++) {
            long double product = 1;
            for (size_t k = 0; k < dim; k++) {
                const double u = p->xs[i * dim + k], v = p->xs[j * dim + k];
                product *= kind < KOKSMA__L2_KINDS ? kernel(kind, u, v) : diaphonys_kernel(u, v);
            }
            pairs += product;
        }
    }
    return square - 2 * linear / n + pairs / n / n;
}

TEST_CASE(pairs_and_merging_equal_the_formula)
{
    for (int s = 0; s < 4 * 6 * 8 * 12; s++) {
        const int kind = s % KOKSMA__L2_KINDS, dim = 1 + s / 8 % 4;
        koksma_points p = sets_points(1 + (size_t)s / 190 * 9, dim, s / 32 % SETS_KINDS, (uint64_t)s);
        const double expected = (double)literal_square(kind, &p), bound = 1e-15 * pow(4, dim);
        double square;
        assert_ok(koksma__l2_by_pairs(rows[kind], &p, NULL, &square));
        assert_near(square, expected, bound);
        if (dim <= 2) {
            assert_ok(koksma__l2_by_sorting(rows[kind], &p, NULL, &square));
            assert_near(square, expected, bound);
        }
        koksma_points_fini(&p);
    }
}

static double radical_inverse(unsigned base, unsigned long i)
{
    double numerator = 0, denominator = 1;
    for (; i; i /= base) {
        numerator = numerator * base + (double)(i % base);
        denominator *= base;
    }
    return numerator / denominator;
}

/* Warnock's formula in 128 bits, pair by pair. */
static double quad_star_square(const koksma_points *p)
{
    quad linear = 0, pairs = 0, volume = 1;
    const size_t dim = (size_t)p->dim;
    for (size_t k = 0; k < dim; k++) {
        volume /= 3;
    }
    for (size_t i = 0; i < p->n; i++) {
        quad a = 1;
        for (size_t k = 0; k < dim; k++) {
            a *= (1 - (quad)p->xs[dim * i + k] * p->xs[dim * i + k]) / 2;
        }
        linear += a;
        for (size_t j = 0; j <= i; j++) {
            quad product = j < i ? 2 : 1;
            for (size_t k = 0; k < dim; k++) {
                product *= 1 - (quad)fmax(p->xs[dim * i + k], p->xs[dim * j + k]);
            }
            pairs += product;
        }
    }
    const quad n = (quad)p->n;
    return (double)(volume - 2 * linear / n + pairs / n / n);
}

TEST_CASE(halton_keeps_its_digits)
{
    koksma_points p;
    assert_ok(koksma_points_init(&p, 2500, 2));
    for (size_t i = 0; i < p.n; i++) {
        p.xs[2 * i] = radical_inverse(2, i);
        p.xs[2 * i + 1] = radical_inverse(3, i);
    }
    assert_near(test_measure("l2-star", &p).square / quad_star_square(&p), 1, 2e-11);
    koksma_points_fini(&p);
}

/* Dividing against all pairs, in 3 and 4 dimensions, with ties and repeats; the number of products. */
TEST_CASE(dividing_equals_pairs)
{
    static const int ranks[KOKSMA__L2_KINDS] = {
        [KOKSMA__L2_STAR] = 1,     [KOKSMA__L2_EXTREME] = 1,  [KOKSMA__L2_PERIODIC] = 3, [KOKSMA__L2_WRAPAROUND] = 3,
        [KOKSMA__L2_MODIFIED] = 1, [KOKSMA__L2_CENTERED] = 2, [KOKSMA__L2_MIXTURE] = 3,  [KOKSMA__L2_SYMMETRIC] = 2};
    for (int t = 0; t < test_repeats(24, 6) * SETS_KINDS; t++) {
        const int kind = t % KOKSMA__L2_KINDS;
        const koksma__l2_row *row = rows[kind];
        koksma_points p = sets_points(1 + 7 * (size_t)t % 400, 3 + t / 8 % 2, t / 16 % SETS_KINDS, (uint64_t)t);
        double by_pairs, by_dividing;
        assert_int_equal(koksma__l2_ranks(row), ranks[kind]);
        assert_ok(koksma__l2_by_pairs(row, &p, NULL, &by_pairs));
        assert_ok(koksma__l2_by_dividing(row, &p, NULL, &by_dividing));
        assert_near(by_dividing, by_pairs, 1e-13 * (1 + by_pairs));
        koksma_points_fini(&p);
    }
}

/* 12,000 points in space, in two pieces: bits on any number of threads; digits of the first 2,500 against sums
   of 113 bits. */
TEST_CASE(dividing_keeps_digits)
{
    koksma_points p = test_points("halton", 12000, 3, 0);
    double one, other;
    assert_ok(koksma__l2_by_dividing(rows[KOKSMA__L2_STAR], &p, &(koksma_run){.threads = 1}, &one));
    for (int threads = 2; threads <= 8; threads += 3) {
        const koksma_run run = {.threads = threads};
        assert_ok(koksma__l2_by_dividing(rows[KOKSMA__L2_STAR], &p, &run, &other));
        assert_true(one == other);
    }
    p.n = 2500;
    const double square = quad_star_square(&p);
    assert_ok(koksma__l2_by_dividing(rows[KOKSMA__L2_STAR], &p, NULL, &one));
    assert_near(one, square, 1e-11 * square);
    koksma_points_fini(&p);
}

/* The dimensions are those about which a square, a value or a term leaves the range of doubles. */
TEST_CASE(hundreds_of_dimensions)
{
    static const int dims[] = {150, 388, 389, 475, 900, 997, 1071, 1237, 1705, 2500, 3132, 4096};
    int in_range = 0, beyond = 0;
    for (int kind = 0; kind <= KOKSMA__L2_KINDS && sizeof(long double) > sizeof(double); kind++) {
        const char *name = kind < KOKSMA__L2_KINDS ? names[kind] : "diaphony";
        koksma_spec spec;
        assert_ok(koksma_measure_spec(name, &spec));
        for (int s = 0; s < 24; s++) {
            koksma_points p = sets_points(7, dims[s / 2], s % 2 ? 2 : 0, (uint64_t)s);
            const long double square = literal_square(kind, &p), value = sqrtl(square);
            koksma_value got;
            if (value > 0x1p-1022L && value < 0x1p1023L) {
                assert_ok(koksma_evaluate(&spec, &p, NULL, &got));
                assert_near(got.value / value, 1, 1e-11);
                assert_true(isnan(got.square) || fabsl(got.square / square - 1) < 1e-11L);
                assert_true(isnan(got.square) == (square < 0x1p-1022L || square >= 0x1p1024L));
                in_range++;
            } else {
                assert_int_equal(koksma_evaluate(&spec, &p, NULL, &got), KOKSMA_DIM);
                beyond++;
            }
            koksma_points_fini(&p);
        }
        koksma_points p = sets_points(3, 4096, 0, 1); /* products of the first half alone are beyond all doubles */
        for (size_t c = 0; c < 3 * 4096; c++) {
            p.xs[c] = c % 4096 < 2048 ? 0 : 1;
        }
        koksma_value got;
        const long double value = sqrtl(literal_square(kind, &p));
        const bool told = koksma_evaluate(&spec, &p, NULL, &got) == KOKSMA_DIM;
        assert_true(told || fabsl(got.value / value - 1) < 1e-11L || (value == 0 && got.value == 0));
        koksma_points_fini(&p);
    }
    assert_true(in_range > 100 && beyond > 10);
}

/* A double all the same, 2.75e-239: only the product over the first coordinates is none. */
TEST_CASE(a_product_out_of_range)
{
    koksma_points p;
    koksma_spec spec;
    koksma_value got;
    assert_ok(koksma_points_init(&p, 1, 1000));
    for (size_t c = 0; c < 400; c++) {
        p.xs[c] = 1 - exp2(-4.4);
    }
    assert_ok(koksma_measure_spec("l2-star", &spec));
    assert_int_equal(koksma_evaluate(&spec, &p, NULL, &got), KOKSMA_DIM);
    assert_string_equal(koksma_error_text(), "l2-star: in 1000 dimensions a product over the first coordinates of a "
                                             "point is beyond the range of doubles; another order of the "
                                             "coordinates may work");
    koksma_points_fini(&p);
}
