/* SPDX-License-Identifier: Apache-2.0 */
/* lattice-file and net-file, from the definitions of the formats (LDData's README): each file is written here, and its
   points are made again by the definition's own sums: multiples modulo n, matrices times digits, division of
   polynomials. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "test.h"

enum { MOST = 4096 };

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
    test_write("prime.txt", "# lattice\n2\n101\n1\n40\n");
    assert_ok(points_of("lattice-file:prime.txt", 101, 2, &points));
    for (uint64_t i = 0; i < 101; i++) {
        assert_near(points.xs[2 * i + 1], (double)(i * 40 % 101) / 101, 1e-15);
    }
    koksma_points_fini(&points);
    assert_int_equal(points_of("lattice-file:prime.txt", 100, 2, &points), KOKSMA_N);
    koksma_points_fini(&points);
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
        assert_ok(points_of("net-file:jk.txt", 5000, 8, &a));
        assert_ok(points_of("sobol", 5000, 8, &b));
        assert_memory_equal(a.xs, b.xs, 5000 * 8 * sizeof *a.xs);
        koksma_points_fini(&a);
        koksma_points_fini(&b);
        assert_int_equal(points_of("net-file:jk.txt", 16, 9, &a), KOKSMA_DIM);
        koksma_points_fini(&a);
    }
}

/* Joe and Kuo's a has the inner coefficients of a polynomial: of degree s, s - 1 bits. */
TEST_CASE(sobol_numbers_have_their_bits)
{
    static const char *const lines[] = {"3 2 3 1 3", "3 2 2 1 3", "3 2 18446744073709551615 1 3", "3 1 1 1"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char text[80];
        koksma_points points;
        snprintf(text, sizeof text, "d s a m_i\n2 1 0 1\n%s # last\n", lines[i]);
        test_write("jk.txt", text);
        assert_int_equal(points_of("net-file:jk.txt", 16, 3, &points), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "line 3: a is "));
        koksma_points_fini(&points);
    }
}

/* LatNet Builder's own output, from its examples (umontreal-simul/latnetbuilder, examples/examples-IO): the program prints
   one net in two or three forms, which have to give the same points: polynomial lattices to the k = 10 digits that it gives
   their matrices. */
static const char polynomial_lattice[] =
    "# Input Command Line: -t lattice -c polynomial -s 2^10 -d 10 -f CU:P2 -q 2 -w product:0.1 -e fast-CBC\n"
    "# Merit: 0.000818148\n# Parameters for a polynomial lattice rule in base 2\n10       # 10 dimensions\n"
    "10      # k = 10, n = 2^10 = 1024 points\n1033   # polynomial modulus\n"
    "# Coordinates of generating vector, starting at j=1\n1\n800\n839\n753\n";
static const char polynomial_net[] =
    "# Input Command Line: -t lattice -c polynomial -s 2^10 -d 10 -f CU:P2 -q 2 -w product:0.1 -e fast-CBC\n"
    "# Merit: 0.000818148\n# Parameters for a digital net in base 2\n10    # 10 dimensions\n"
    "10   # k = 10,  n = 2^10 = 1024 points\n31   # r = 31 binary output digits\n"
    "# Columns of gen. matrices C_1,...,C_s, one matrix per line\n"
    "2097152 4194304 8388608 16777216 33554432 67108864 134217728 270532608 541065216 "
    "1082130432\n"
    "1690304512 1235222528 322961408 645922816 1291845632 436207616 874512384 1749024768 "
    "1350565888 555745280\n"
    "1746927616 1346371584 547356672 1094713344 44040192 88080384 176160768 354418688 "
    "708837376 1419771904\n"
    "1585446912 1023410176 2048917504 1950351360 1755316224 1363148800 580911104 1161822208 "
    "178257920 358612992\n";
static const char sobol_net[] =
    "# Merit: 5\n# Parameters for a digital net in base 2\n10    # 10 dimensions\n"
    "16   # k = 16,  n = 2^16 = 65536 points\n31   # r = 31 binary output digits\n"
    "# Columns of gen. matrices C_1,...,C_s, one matrix per line\n"
    "1073741824 536870912 268435456 134217728 67108864 33554432 16777216 8388608 4194304 "
    "2097152 1048576 524288 262144 131072 65536 32768\n"
    "1073741824 1610612736 1342177280 2013265920 1140850688 1711276032 1426063360 2139095040 "
    "1077936128 1616904192 1347420160 2021130240 1145307136 1717960704 1431633920 2147450880\n"
    "1073741824 536870912 1879048192 1476395008 872415232 2046820352 1124073472 662700032 "
    "1950351360 1512046592 862978048 2144862208 1081344000 542769152 1882390528 1484750848\n"
    "1073741824 1610612736 268435456 671088640 2080374784 973078528 1358954496 1233125376 "
    "1816133632 312475648 753926144 1936195584 1006895104 1510342656 1090584576 1635942400\n"
    "1073741824 536870912 1879048192 939524096 469762048 1644167168 1560281088 1115684864 "
    "750780416 2053111808 816840704 434634752 1824784384 1516371968 1085734912 569081856\n"
    "1073741824 1610612736 268435456 2013265920 603979776 1979711488 1761607680 1535115264 "
    "1346371584 408944640 873463808 242745344 1294204928 771096576 958988288 1136361472\n"
    "1073741824 1610612736 268435456 2013265920 1006632960 1509949440 1258291200 880803840 "
    "188743680 1423966208 458227712 748158976 661389312 1992425472 1814495232 1115062272\n"
    "1073741824 1610612736 805306368 134217728 603979776 1912602624 1795162112 360710144 "
    "2051014656 1310720000 1678770176 303562752 1527513088 495058944 1581842432 1010597888\n"
    "1073741824 536870912 805306368 939524096 201326592 2046820352 754974720 1266679808 "
    "348127232 1205862400 1829765120 1804075008 617349120 2146304000 1628635136 295075840\n"
    "1073741824 1610612736 1879048192 2013265920 738197504 704643072 1191182336 226492416 "
    "985661440 1306525696 1527775232 1066926080 568066048 310247424 182124544 1441955840\n";
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
    static const struct {
        const char *net, *other;
        size_t n;
        int dim;
        double scale; /* 2^digits */
    } pairs[] = {{polynomial_net, polynomial_lattice, 1024, 4, 0x1p10},
                 {sobol_net, sobol_jk, 4096, 10, 0x1p31},
                 {sobol_net, sobol_short, 4096, 10, 0x1p31}};
    for (size_t p = 0; p < sizeof pairs / sizeof *pairs; p++) {
        koksma_points a, b;
        test_write("net.txt", pairs[p].net);
        test_write("other.txt", pairs[p].other);
        assert_ok(points_of("net-file:net.txt", pairs[p].n, pairs[p].dim, &a));
        assert_ok(points_of("net-file:other.txt", pairs[p].n, pairs[p].dim, &b));
        for (size_t i = 0; i < pairs[p].n * (size_t)pairs[p].dim; i++) {
            assert_near(a.xs[i], floor(b.xs[i] * pairs[p].scale) / pairs[p].scale, 0);
        }
        koksma_points_fini(&a);
        koksma_points_fini(&b);
    }
    koksma_points points;
    test_write("net.txt", sobol_short);
    assert_int_equal(points_of("net-file:net.txt", 4, 11, &points), KOKSMA_DIM);
    koksma_points_fini(&points);
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
    assert_ok(points_of("lattice-file:lattice.txt", 4096, 2, &points));
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
    assert_ok(points_of("net-file:net.txt", 1024, 2, &points));
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
    assert_int_equal(points_of("net-file:net.txt", 4, 2, &points), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "5 components, not 2 times 2"));
    koksma_points_fini(&points);
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
        koksma_points points;
        char text[64];
        snprintf(text, sizeof text, "%s:bad.txt", files[f].pattern);
        test_write("bad.txt", files[f].text);
        const koksma_status status = points_of(text, 2, 2, &points);
        assert_that(status == files[f].status && strstr(koksma_error_text(), files[f].says) &&
                        strstr(koksma_error_text(), "bad.txt"),
                    "%s of %s: %d, %s", files[f].pattern, files[f].text, (int)status, koksma_error_text());
        koksma_points_fini(&points);
    }
    koksma_points points;
    assert_int_equal(points_of("net-file:nosuch.txt", 2, 2, &points), KOKSMA_MISSING);
    koksma_points_fini(&points);
}
