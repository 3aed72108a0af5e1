/* SPDX-License-Identifier: Apache-2.0 */
/* lattice-file and net-file, from the definitions of the formats (LDData's README): each file is written here, and its points are
   made again by the definition's own sums: multiples modulo n, matrices times digits, division of polynomials. */
#include <stdlib.h>
#include <string.h>

#include "test.h"

enum { MOST = 4096 };

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static koksma_status points_of(const char *text, size_t n, int dim, koksma_points *points)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(text, &spec));
    assert_ok(koksma_points_init(points, n, dim));
    return koksma_generate(&spec, 1, NULL, points);
}

static int compare_points(const void *a, const void *b)
{
    const double *x = a, *y = b;
    const int k = x[0] == y[0];
    return (x[k] > y[k]) - (x[k] < y[k]);
}

/* The first n = b^k points of a lattice sequence are {i z / n}; the numbers of points in a file without a head are 2^k. */
static void lattices_are_their_multiples(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint64_t z[2], base, most;
    } files[] = {
        {"# lattice\n# made up\n3 # dimensions\n4096\n# vector\n1\n 1571 # a comment\n77\n", {1, 1571}, 2, 4096},
        {"# lattice\n2\n729\n2\n182\n", {2, 182}, 3, 729},
        {"1 1\n2 182667\n3 469891\n", {1, 182667}, 2, 4096}, /* Kuo's lattice-32001-1024-1048576.3600 begins so */
        {"5\r\n 433\r\n", {5, 433}, 2, 4096},
    };
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        write_file("lattice.txt", files[f].text);
        for (uint64_t n = 1; n <= files[f].most; n *= files[f].base) {
            koksma_points points;
            double expected[MOST][2];
            assert_ok(points_of("lattice-file:lattice.txt", n, 2, &points));
            for (uint64_t i = 0; i < n; i++) {
                expected[i][0] = (double)(i * files[f].z[0] % n) / (double)n;
                expected[i][1] = (double)(i * files[f].z[1] % n) / (double)n;
            }
            qsort(points.xs, n, 2 * sizeof *points.xs, compare_points);
            qsort(expected, n, sizeof *expected, compare_points);
            for (uint64_t i = 0; i < 2 * n; i++) {
                assert_near(points.xs[i], expected[i / 2][i % 2], 1e-15);
            }
            koksma_points_fini(&points);
        }
    }
    koksma_points points;
    write_file("prime.txt", "# lattice\n2\n101\n1\n40\n");
    assert_ok(points_of("lattice-file:prime.txt", 101, 2, &points));
    for (uint64_t i = 0; i < 101; i++) {
        assert_near(points.xs[2 * i + 1], (double)(i * 40 % 101) / 101, 1e-15);
    }
    koksma_points_fini(&points);
    assert_int_equal(points_of("lattice-file:prime.txt", 100, 2, &points), KOKSMA_N);
    koksma_points_fini(&points);
}

/* u = b^-r sum_l b^(r-l) (sum_c C[l][c] a_c mod b) for random matrices: the definition, digit by digit. */
static void nets_are_matrices_times_digits(void **state)
{
    (void)state;
    static const struct {
        uint64_t base;
        int columns, rows;
    } kinds[] = {{2, 10, 31}, {2, 12, 12}, {2, 8, 64}, {3, 6, 20}, {5, 4, 22}, {7, 3, 5}, {4, 5, 26}, {251, 1, 6}};
    srand(7);
    for (size_t f = 0; f < sizeof kinds / sizeof *kinds; f++) {
        const uint64_t b = kinds[f].base;
        const int columns = kinds[f].columns, rows = kinds[f].rows;
        uint64_t digit[3][12][64], points_in_file = 1;
        FILE *file = fopen("net.txt", "w");
        assert_non_null(file);
        for (int c = 0; c < columns; c++) {
            points_in_file *= b;
        }
        fprintf(file, "# dnet\n# random\n%llu # base\n3\n", (unsigned long long)b);
        fprintf(file, "%llu\n%d # digits\n",
                (unsigned long long)(f % 2 && points_in_file > 64 ? points_in_file : (uint64_t)columns), rows);
        for (int k = 0; k < 3; k++) {
            for (int c = 0; c < columns; c++) {
                uint64_t number = 0;
                for (int l = 0; l < rows; l++) {
                    digit[k][c][l] = (uint64_t)rand() % b;
                    number = number * b + digit[k][c][l];
                }
                fprintf(file, "%llu%s", (unsigned long long)number, c + 1 < columns ? " " : "\n");
            }
        }
        fclose(file);
        const size_t n = points_in_file < 1000 ? points_in_file : 1000;
        koksma_points points;
        assert_ok(points_of("net-file:net.txt", n, 3, &points));
        for (size_t i = 0; i < n; i++) {
            for (int k = 0; k < 3; k++) {
                long double x = 0, place = 1;
                for (int l = 0; l < rows; l++) {
                    uint64_t y = 0, a = i;
                    for (int c = 0; c < columns; c++, a /= b) {
                        y = (y + digit[k][c][l] * (a % b)) % b;
                    }
                    place /= b;
                    x += place * y;
                }
                assert_near(points.xs[3 * i + (size_t)k], (double)x,
                            2e-15); /* digits below those of a double are cut off */
            }
        }
        koksma_points_fini(&points);
        assert_int_equal(points_of("net-file:net.txt", (size_t)points_in_file + 1, 3, &points), KOKSMA_N);
        koksma_points_fini(&points);
    }
}

/* Polynomials over Z_b as arrays of coefficients: the digits of z^-1, z^-2, ... of h q / Q by long division. */
static long double quotient(uint64_t b, const uint64_t *numerator, int degree, const uint64_t *modulus, int m)
{
    uint64_t rest[128] = {0};
    long double x = 0, place = 1;
    enum { DIGITS = 40 };
    for (int d = 0; d <= degree; d++) {
        rest[d + DIGITS] = numerator[d]; /* times z^DIGITS */
    }
    uint64_t inverse = 1;
    while (inverse * modulus[m] % b != 1) {
        inverse++;
    }
    for (int d = degree + DIGITS; d >= m; d--) {
        const uint64_t digit = rest[d] * inverse % b; /* the coefficient of z^(d-m), before z^DIGITS is taken away */
        for (int j = 0; j <= m; j++) {
            rest[d - m + j] = (rest[d - m + j] + (b - digit) * modulus[j]) % b;
        }
        if (d - m < DIGITS) {
            place /= b;
            x += place * digit;
        }
    }
    return x;
}

static void coefficients(uint64_t value, uint64_t b, uint64_t *out)
{
    for (int d = 0; d < 32; d++, value /= b) {
        out[d] = value % b;
    }
}

static void polynomial_lattices_are_quotients(void **state)
{
    (void)state;
    static const struct {
        uint64_t b;
        int m;
        uint64_t modulus, q[3];
    } rules[] = {{2, 8, 285, {1, 113, 203}},
                 {2, 6, 64, {1, 37, 21}},
                 {3, 4, 81 + 2 * 3 + 2, {1, 50, 77}},
                 {5, 3, 2 * 125 + 31, {3, 99, 124}}};
    for (size_t f = 0; f < sizeof rules / sizeof *rules; f++) {
        const uint64_t b = rules[f].b;
        char text[200];
        uint64_t modulus[32], n = 1;
        snprintf(text, sizeof text, "# plattice\n%llu\n3\n%d\n%llu\n%llu\n%llu\n%llu\n", (unsigned long long)b,
                 rules[f].m, (unsigned long long)rules[f].modulus, (unsigned long long)rules[f].q[0],
                 (unsigned long long)rules[f].q[1], (unsigned long long)rules[f].q[2]);
        write_file("plattice.txt", text);
        coefficients(rules[f].modulus, b, modulus);
        for (int c = 0; c < rules[f].m; c++) {
            n *= b;
        }
        koksma_points points;
        assert_ok(points_of("net-file:plattice.txt", n, 3, &points));
        for (uint64_t i = 0; i < n; i++) {
            uint64_t h[32], q[32], product[64];
            coefficients(i, b, h);
            for (int k = 0; k < 3; k++) {
                coefficients(rules[f].q[k], b, q);
                memset(product, 0, sizeof product);
                for (int s = 0; s < 32; s++) {
                    for (int t = 0; t < 32; t++) {
                        product[s + t] = (product[s + t] + h[s] * q[t]) % b;
                    }
                }
                const long double x = quotient(b, product, 2 * rules[f].m, modulus, rules[f].m);
                const double off = (double)((long double)points.xs[3 * i + (uint64_t)k] - x);
                assert_near(off - floor(off + 0.5), 0, 4e-12); /* 40 digits; what rounds to 1 is cut to less */
            }
        }
        koksma_points_fini(&points);
    }
}

/* The first dimensions of Joe and Kuo's new-joe-kuo-6.21201, in both forms, are those of `sobol`. */
static void sobol_numbers_give_sobol_points(void **state)
{
    (void)state;
    static const char lines[] =
        "2 1 0 1\n3 2 1 1 3\n4 3 1 1 3 1\n5 3 2 1 1 1\n6 4 1 1 1 3 3\n7 4 4 1 3 5 13\n8 5 2 1 1 5 5 17\n";
    static const char *const heads[] = {"d       s       a       m_i\n", "# soboljk\n# c_j p_j m_j,c\n"};
    for (size_t h = 0; h < 2; h++) {
        char text[400];
        koksma_points a, b;
        snprintf(text, sizeof text, "%s%s", heads[h], lines);
        write_file("jk.txt", text);
        assert_ok(points_of("net-file:jk.txt", 5000, 8, &a));
        assert_ok(points_of("sobol", 5000, 8, &b));
        assert_memory_equal(a.xs, b.xs, 5000 * 8 * sizeof *a.xs);
        koksma_points_fini(&a);
        koksma_points_fini(&b);
        assert_int_equal(points_of("net-file:jk.txt", 16, 9, &a), KOKSMA_DIM);
        koksma_points_fini(&a);
    }
}

/* Each file is refused, and the message names the file, the line and what is wrong. */
static void bad_files_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *pattern, *text, *says;
        koksma_status status;
    } files[] = {
        {"lattice-file", "", "ends before", KOKSMA_MALFORMED},
        {"lattice-file", "# dnet\n2\n", "dnet", KOKSMA_MALFORMED},
        {"lattice-file", "# lattice\n2\n", "number of points", KOKSMA_MALFORMED},
        {"lattice-file", "# lattice\n2\n0\n1\n1\n", "line 3", KOKSMA_MALFORMED},
        {"lattice-file", "# lattice\n2\n64\n1\n-5\n", "line 5", KOKSMA_MALFORMED},
        {"lattice-file", "# lattice\n2\n64\n1\n", "ends before", KOKSMA_MALFORMED},
        {"lattice-file", "# lattice\n1\n64\n1\n", "1 dimensions", KOKSMA_DIM},
        {"lattice-file", "1 1\n3 5\n", "line 2", KOKSMA_MALFORMED},
        {"lattice-file", "1 1 1\n", "line 1", KOKSMA_MALFORMED},
        {"lattice-file", "1 1\n", "1 dimensions", KOKSMA_DIM},
        {"lattice-file", "99999999999999999999 1\n", "line 1", KOKSMA_MALFORMED},
        {"net-file", "", "first line", KOKSMA_MALFORMED},
        {"net-file", "# lattice\n2\n64\n1\n5\n", "lattice-file", KOKSMA_MALFORMED},
        {"net-file", "# dnet\n1\n", "base", KOKSMA_MALFORMED},
        {"net-file", "# dnet\n300\n", "base", KOKSMA_MALFORMED},
        {"net-file", "# dnet\n2\n2\n3\n3\n4 2 1\n", "ends before", KOKSMA_MALFORMED},
        {"net-file", "# dnet\n2\n2\n3\n3\n4 2 1\n4 2\n", "line 7", KOKSMA_MALFORMED},
        {"net-file", "# dnet\n2\n2\n3\n3\n4 2 1\n8 2 1\n", "digits", KOKSMA_MALFORMED},
        {"net-file", "# dnet\n2\n2\n100\n3\n4 2 1\n4 2 1\n", "power", KOKSMA_MALFORMED},
        {"net-file", "# dnet\n2\n2\n3\n3\n4 2 x\n4 2 1\n", "'x'", KOKSMA_MALFORMED},
        {"net-file", "# plattice\n4\n2\n3\n64\n1\n1\n", "a prime", KOKSMA_MALFORMED},
        {"net-file", "# plattice\n2\n2\n3\n7\n1\n1\n", "degree", KOKSMA_MALFORMED},
        {"net-file", "# plattice\n2\n2\n3\n11\n1\n9\n", "line 7", KOKSMA_MALFORMED},
        {"net-file", "d s a m_i\n2 1 0 2\n", "odd", KOKSMA_MALFORMED},
        {"net-file", "d s a m_i\n2 2 1 1\n", "line 2", KOKSMA_MALFORMED},
        {"net-file", "d s a m_i\n3 1 0 1\n", "line 2", KOKSMA_MALFORMED},
        {"net-file", "d s a m_i\n2 1\n", "line 2", KOKSMA_MALFORMED},
    };
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        koksma_points points;
        char text[64];
        snprintf(text, sizeof text, "%s:bad.txt", files[f].pattern);
        write_file("bad.txt", files[f].text);
        const koksma_status status = points_of(text, 2, 2, &points);
        if (status != files[f].status || !strstr(koksma_error_text(), files[f].says) ||
            !strstr(koksma_error_text(), "bad.txt")) {
            fail_msg("%s of %s: %d, %s", files[f].pattern, files[f].text, (int)status, koksma_error_text());
        }
        koksma_points_fini(&points);
    }
    koksma_points points;
    assert_int_equal(points_of("net-file:nosuch.txt", 2, 2, &points), KOKSMA_MISSING);
    koksma_points_fini(&points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattices_are_their_multiples),
        cmocka_unit_test(nets_are_matrices_times_digits),
        cmocka_unit_test(polynomial_lattices_are_quotients),
        cmocka_unit_test(sobol_numbers_give_sobol_points),
        cmocka_unit_test(bad_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
