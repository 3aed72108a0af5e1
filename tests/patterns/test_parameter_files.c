/* SPDX-License-Identifier: Apache-2.0 */
/* lattice-file and net-file, from the definitions of the formats (LDData's README): each file is written here, and its
   points are made again by the definition's own sums: multiples modulo n, matrices times digits, division of
   polynomials. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pattern_sets.h"

enum { MOST = 4096 };

static int compare_points(const void *a, const void *b)
{
    const double *x = a, *y = b;
    const int k = x[0] == y[0];
    return (x[k] > y[k]) - (x[k] < y[k]);
}

/* The first n = b^k points of a lattice sequence are {i z / n}; the numbers of points in a file without a head are 2^k. */
TEST_CASE(lattices_are_their_multiples)
{
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
        test_write("lattice.txt", files[f].text);
        for (uint64_t n = 1; n <= files[f].most; n *= files[f].base) {
            koksma_points points;
            double expected[MOST][2];
            points = test_points("lattice-file:lattice.txt", n, 2, 1);
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
    test_write("prime.txt", "# lattice\n2\n101\n1\n40\n");
    points = test_points("lattice-file:prime.txt", 101, 2, 1);
    for (uint64_t i = 0; i < 101; i++) {
        assert_near(points.xs[2 * i + 1], (double)(i * 40 % 101) / 101, 1e-15);
    }
    koksma_points_fini(&points);
    assert_int_equal(status_of("lattice-file:prime.txt", 100, 2), KOKSMA_N);
}

/* u = b^-r sum_l b^(r-l) (sum_c C[l][c] a_c mod b) for random matrices: the definition, digit by digit. */
TEST_CASE(nets_are_matrices_times_digits)
{
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
        points = test_points("net-file:net.txt", n, 3, 1);
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
        assert_int_equal(status_of("net-file:net.txt", (size_t)points_in_file + 1, 3), KOKSMA_N);
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

TEST_CASE(polynomial_lattices_are_quotients)
{
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
        test_write("plattice.txt", text);
        coefficients(rules[f].modulus, b, modulus);
        for (int c = 0; c < rules[f].m; c++) {
            n *= b;
        }
        koksma_points points;
        points = test_points("net-file:plattice.txt", n, 3, 1);
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
TEST_CASE(sobol_numbers_give_sobol_points)
{
    static const char lines[] =
        "2 1 0 1\n3 2 1 1 3\n4 3 1 1 3 1\n5 3 2 1 1 1\n6 4 1 1 1 3 3\n7 4 4 1 3 5 13\n8 5 2 1 1 5 5 17\n";
    static const char *const heads[] = {"d       s       a       m_i\n", "# soboljk\n# c_j p_j m_j,c\n"};
    for (size_t h = 0; h < 2; h++) {
        char text[400];
        koksma_points a, b;
        snprintf(text, sizeof text, "%s%s", heads[h], lines);
        test_write("jk.txt", text);
        a = test_points("net-file:jk.txt", 5000, 8, 1);
        b = test_points("sobol", 5000, 8, 1);
        assert_memory_equal(a.xs, b.xs, 5000 * 8 * sizeof *a.xs);
        koksma_points_fini(&a);
        koksma_points_fini(&b);
        assert_int_equal(status_of("net-file:jk.txt", 16, 9), KOKSMA_DIM);
    }
}

/* Joe and Kuo's a has the inner coefficients of a polynomial: of degree s, s - 1 bits. */
TEST_CASE(sobol_numbers_have_their_bits)
{
    static const char *const lines[] = {"3 2 3 1 3", "3 2 2 1 3", "3 2 18446744073709551615 1 3", "3 1 1 1"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char text[80];
        snprintf(text, sizeof text, "d s a m_i\n2 1 0 1\n%s # last\n", lines[i]);
        test_write("jk.txt", text);
        assert_int_equal(status_of("net-file:jk.txt", 16, 3), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "line 3: a is "));
    }
}

/* LatNet Builder's own output, from its examples (umontreal-simul/latnetbuilder, examples/examples-IO): the program prints
   one net with the polynomials or without. test_published_files.c has polynomial lattices and t of these nets. */
static const char sobol_jk[] =
    "# Merit: 5\n# Parameters for Sobol points, in JK format\n10    # 10 dimensions\n#  d  a  m_{j,c}\n2  1  0  1\n"
    "3  2  1  1 1\n4  3  1  1 3 1\n5  3  2  1 1 7\n6  4  1  1 3 1 15\n7  4  4  1 3 1 15\n8  5  2  1 3 3 1 9\n"
    "9  5  4  1 1 3 7 3\n10  5  7  1 3 7 15 11\n";
static const char sobol_short[] =
    "# Merit: 5\n# Parameters m_{j,c} for Sobol points\n10    # 10 dimensions\n"
    "# m_{j,c}, starting from the second coordinate\n1\n1 1\n1 3 1\n1 1 7\n1 3 1 15\n1 3 1 15\n1 3 3 1 9\n1 1 3 7 3\n"
    "1 3 7 15 11";

TEST_CASE(latnet_builders_forms_agree)
{
    koksma_points a, b;
    test_write("jk.txt", sobol_jk);
    test_write("short.txt", sobol_short);
    a = test_points("net-file:jk.txt", 4096, 10, 1);
    b = test_points("net-file:short.txt", 4096, 10, 1);
    assert_memory_equal(a.xs, b.xs, 4096 * 10 * sizeof *a.xs);
    koksma_points_fini(&a);
    koksma_points_fini(&b);
    assert_int_equal(status_of("net-file:short.txt", 4, 11), KOKSMA_DIM);
}

/* Its ordinary lattices are the multiples of the vector, embedded or not. */
TEST_CASE(latnet_builders_lattices_are_read)
{
    koksma_points points;
    test_write(
        "lattice.txt",
        "# Input Command Line: -t lattice -c ordinary -s 2^16 -d 100 -f CU:P2 -q 2 --multilevel true\n"
        "# Merit: 4.49877e+12\n# Parameters for a lattice rule, embedded from 2 to 16\n100    # 100 dimensions\n"
        "65536    # modulus = n = 65536 points\n# Coordinates of generating vector, starting at j=1\n1\n25811\n");
    points = test_points("lattice-file:lattice.txt", 4096, 2, 1);
    for (size_t i = 0; i < 4096; i++) { /* x = j / 4096, y = {25811 j / 4096} */
        const uint64_t j = (uint64_t)(points.xs[2 * i] * 4096);
        assert_near(points.xs[2 * i + 1], (double)(j * 25811 % 4096) / 4096, 1e-15);
    }
    koksma_points_fini(&points);
}

/* The digits of an interlaced coordinate are those of its components in turn (Dick 2008): its example of a net of two
   dimensions with the factor 2. */
TEST_CASE(latnet_builders_interlaced_nets_are_interlaced)
{
    static const char text[] =
        "# Merit: 37.2087\n# Parameters for a digital net in base 2\n2    # 2 dimensions\n2    # Interlacing factor\n"
        "4    # Number of components = interlacing factor x dimension\n10   # k = 10,  n = 2^10 = 1024 points\n"
        "31   # r = 31 binary output digits\n# Columns of gen. matrices C_1,...,C_{ds}, one matrix per line\n";
    static const uint32_t columns[4][10] = {{1073741824, 536870912, 268435456, 1476395008, 1543503872, 1644167168,
                                             1728053248, 511705088, 180355072, 1625292800},
                                            {1073741824, 1610612736, 1879048192, 134217728, 1543503872, 503316480,
                                             1325400064, 2021654528, 71303168, 1839202304},
                                            {1073741824, 1610612736, 805306368, 134217728, 1811939328, 369098752,
                                             1828716544, 1753219072, 943718400, 568328192},
                                            {1073741824, 536870912, 1879048192, 134217728, 1811939328, 167772160,
                                             1795162112, 595591168, 809500672, 828375040}};
    FILE *file = fopen("net.txt", "w");
    assert_non_null(file);
    fputs(text, file);
    for (int j = 0; j < 4; j++) {
        for (int c = 0; c < 10; c++) {
            fprintf(file, "%u%c", columns[j][c], c < 9 ? ' ' : '\n');
        }
    }
    assert_int_equal(fclose(file), 0);
    koksma_points points;
    points = test_points("net-file:net.txt", 1024, 2, 1);
    for (uint32_t i = 0; i < 1024; i++) {
        for (int k = 0; k < 2; k++) {
            uint32_t y[2] = {0, 0};
            double x = 0;
            for (int c = 0; c < 10; c++) {
                y[0] ^= i >> c & 1 ? columns[2 * k][c] : 0;
                y[1] ^= i >> c & 1 ? columns[2 * k + 1][c] : 0;
            }
            for (int digit = 0; digit < 53;
                 digit++) { /* digit 1, 3, .. of the first component, 2, 4, .. of the second */
                x += (y[digit % 2] >> (30 - digit / 2) & 1) * pow(2, -digit - 1);
            }
            assert_near(points.xs[2 * i + (uint32_t)k], x, 0);
        }
    }
    koksma_points_fini(&points);
    test_write("net.txt", "# Parameters for a digital net in base 2\n2\n2 # Interlacing factor\n5\n2\n2\n");
    assert_int_equal(status_of("net-file:net.txt", 4, 2), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "5 components, not 2 times 2"));
}

/* Each file is refused, and the message names the file, the line and what is wrong. */
TEST_CASE(bad_files_are_refused)
{
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
        char text[64];
        snprintf(text, sizeof text, "%s:bad.txt", files[f].pattern);
        test_write("bad.txt", files[f].text);
        const koksma_status status = status_of(text, 2, 2);
        assert_that(status == files[f].status && strstr(koksma_error_text(), files[f].says) &&
                        strstr(koksma_error_text(), "bad.txt"),
                    "%s of %s: %d, %s", files[f].pattern, files[f].text, (int)status, koksma_error_text());
    }
    assert_int_equal(status_of("net-file:nosuch.txt", 2, 2), KOKSMA_MISSING);
}
