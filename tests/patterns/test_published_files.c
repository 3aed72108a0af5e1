/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-file and net-file beside the numbers that were published with the files' lattices and nets: the figures of merit
 * that LatNet Builder prints in the head of its files, and the quality t of Niederreiter-Xing, Sobol' and Faure
 * matrices. The figures are computed here from the points that the patterns make of the files, by the definitions of the
 * papers.
 */
#include <stdlib.h>
#include <string.h>

#include "claims/claims.h"

/* ---- Lattices ---------------------------------------------------------------------------------------------- */

/* P_2 with product weights 0.7 of three lattices, as Lattice Builder prints it (umontreal-simul/latnetbuilder: its
   tests, and the output of the tutorial's FilteredRCBC): the mean of prod_k (1 + 0.7 2 pi^2 B_2(x_k)), less 1. 256
   points are a lattice sequence in the file, 257 are not. */
TEST_CASE(lattices_have_the_printed_merits)
{
    static const struct {
        const char *file;
        size_t n;
        int dim;
        double merit, digit;
    } lattices[] = {{"# lattice\n3\n256\n1\n99\n27\n", 256, 3, 0.0239383, 5.1e-8},
                    {"1 1\n2 99\n3 27\n", 256, 3, 0.0239383, 5.1e-8},
                    {"# lattice\n3\n257\n1\n76\n96\n", 257, 2, 0.00125208, 5.1e-9},
                    {"# lattice\n3\n257\n1\n76\n96\n", 257, 1, 3.48667e-05, 5.1e-11}};
    const double weight = 0.7 * 2 * acos(-1) * acos(-1);
    for (size_t t = 0; t < sizeof lattices / sizeof *lattices; t++) {
        double mean = 0;
        test_write("published.txt", lattices[t].file);
        koksma_points points = test_points("lattice-file:published.txt", lattices[t].n, lattices[t].dim, 0);
        for (size_t i = 0; i < points.n; i++) {
            double product = 1;
            for (int k = 0; k < points.dim; k++) {
                const double x = points.xs[i * (size_t)points.dim + (size_t)k];
                product *= 1 + weight * (x * x - x + 1.0 / 6);
            }
            mean += product / (double)points.n;
        }
        koksma_points_fini(&points);
        assert_near(mean - 1, lattices[t].merit, lattices[t].digit);
    }
}

/* LatNet Builder's examples/examples-IO/test_l_polynomial_lat: -t lattice -c polynomial -s 2^10 -d 10 -f CU:P2 -q 2 -w
   product:0.1. For digital nets in base 2 P_2 has 12 (1/6 - 2^(e-1)), 2^e <= x < 2^(e+1), in place of 2 pi^2 B_2(x); 2
   for x = 0 (Dick, Kuo, Pillichshammer & Sloan 2005). */
TEST_CASE(polynomial_lattices_have_the_printed_merit)
{
    test_write("published.txt", "# Merit: 0.000818148\n# Parameters for a polynomial lattice rule in base 2\n"
                                "10       # 10 dimensions\n10      # k = 10, n = 2^10 = 1024 points\n"
                                "1033   # polynomial modulus\n1\n800\n839\n753\n622\n150\n827\n676\n108\n970\n");
    koksma_points points = test_points("net-file:published.txt", 1024, 10, 0);
    double mean = 0;
    for (size_t i = 0; i < 1024; i++) {
        double product = 1;
        for (size_t k = 0; k < 10; k++) {
            int e;
            (void)frexp(points.xs[10 * i + k], &e); /* x = f 2^e, 1/2 <= f < 1 */
            product *= 1 + 0.1 * 12 * (1.0 / 6 - (points.xs[10 * i + k] > 0 ? ldexp(1, e - 2) : 0));
        }
        mean += product / 1024;
    }
    koksma_points_fini(&points);
    assert_near(mean - 1, 0.000818148, 5.1e-10);
}

/* ---- The quality t of nets in base 2 --------------------------------------------------------------------------- */

enum { MOST_ROWS = 16, MOST_DIM = 10 };

/* rows[k][l]: row l + 1 of the matrix of coordinate k; bit c is its entry in column c. */
typedef struct net {
    int m, dim;
    uint32_t rows[MOST_DIM][MOST_ROWS];
} net;

/* Reads the matrices off the first 2^m points: column c is point 2^c. */
static net net_of(const char *spec, int m, int dim)
{
    net a = {.m = m, .dim = dim};
    koksma_points points = test_points(spec, ((size_t)1 << (m - 1)) + 1, dim, 0);
    for (int k = 0; k < dim; k++) {
        for (int c = 0; c < m; c++) {
            const uint32_t column = (uint32_t)ldexp(points.xs[((size_t)dim << c) + (size_t)k], m);
            for (int l = 0; l < m; l++) {
                a.rows[k][l] |= (column >> (m - 1 - l) & 1) << c;
            }
        }
    }
    koksma_points_fini(&points);
    return a;
}

/* Adds a vector to a set of independent ones, kept by their highest bits; false if it depends on them. */
static bool add_vector(uint32_t basis[32], uint32_t v)
{
    for (int bit = 31; bit >= 0 && v; bit--) {
        if (!(v >> bit & 1)) {
            continue;
        }
        if (!basis[bit]) {
            basis[bit] = v;
            return true;
        }
        v ^= basis[bit];
    }
    return false;
}

/* Whether, for all ways of taking `left` rows from the coordinates use[0], use[1], ..., the first rows of each, these are
   independent of each other and of the basis. */
static bool all_independent(const net *a, const int *use, int count, int left, const uint32_t *basis)
{
    uint32_t own[32];
    memcpy(own, basis, sizeof own);
    for (int taken = 0; taken <= left; taken++) {
        if (taken && !add_vector(own, a->rows[*use][taken - 1])) {
            return false;
        }
        if (count > 1 && !all_independent(a, use + 1, count - 1, left - taken, own)) {
            return false;
        }
    }
    return true;
}

/* The quality of a projection: the smallest t for which any m - t rows are independent (Niederreiter 1987). */
static int quality_of(const net *a, const int *use, int count)
{
    static const uint32_t none[32];
    int t = 0;
    while (!all_independent(a, use, count, a->m - t, none)) {
        t++;
    }
    return t;
}

/* The largest t of projections to two and three coordinates. */
static int largest_quality(const net *a)
{
    int largest = 0;
    for (int i = 0; i < a->dim; i++) {
        for (int j = 0; j < i; j++) {
            for (int k = -1; k < j; k++) {
                const int use[3] = {i, j, k}, t = quality_of(a, use, k < 0 ? 2 : 3);
                largest = t > largest ? t : largest;
            }
        }
    }
    return largest;
}

/* LatNet Builder's examples/examples-IO/test_sobol_sob and test_n_polynomial_lat: -s 2^16 -d 10 -f projdep:t-value -q
   inf -w order-dependent:0:0,1,1. */
TEST_CASE(nets_have_the_printed_t_values)
{
    test_write("published.txt", "# Merit: 5\n# Parameters m_{j,c} for Sobol points\n10    # 10 dimensions\n1\n1 1\n"
                                "1 3 1\n1 1 7\n1 3 1 15\n1 3 1 15\n1 3 3 1 9\n1 1 3 7 3\n1 3 7 15 11\n");
    const net sobol = net_of("net-file:published.txt", 16, 10);
    assert_int_equal(largest_quality(&sobol), 5);
    test_write(
        "published.txt",
        "# Merit: 6\n# Parameters for a polynomial lattice rule in base 2\n10       # 10 dimensions\n"
        "16      # k = 16, n = 2^16 = 65536 points\n66525   # polynomial modulus\n1\n52453\n29874\n12667\n26826\n"
        "34163\n23637\n39782\n33727\n25042\n");
    const net polynomial = net_of("net-file:published.txt", 16, 10);
    assert_int_equal(largest_quality(&polynomial), 6);
}

/* The first 16 columns of matrices of Niederreiter-Xing sequences (Pirsic 2002; Nuyens's Magic Point Shop, in QMCSoftware's
   LDData: mps.nx_b2_m30_s4_Cs and s5). Sequences in s dimensions from a curve of genus g with s + 1 rational points have
   t = g (Niederreiter & Xing 1996): 1 for s = 4 and 2 for s = 5, where Sobol' sequences have 3 and 5. */
static const uint32_t xing_4[4][16] = {
    {939524096, 771751936, 729808896, 182452224, 582483968, 145620992, 573276160, 143319040, 35829760, 8957440,
     539110272, 134777568, 33694392, 8423598, 538976811, 134744202},
    {1010580540, 698984873, 501358050, 723004184, 463969191, 571187723, 132511770, 185808928, 465315712, 573148032,
     127769215, 195797171, 437911997, 538968619, 8386661, 11745427},
    {757935405, 151587081, 835596750, 582689467, 53347118, 34275851, 1007535090, 722055824, 842080028, 539109675,
     3944946, 2826896, 3277596, 2097707, 1069548493, 699400889},
    {469762048, 721420288, 230686720, 162529280, 823918592, 573243392, 63815680, 45723648, 53287936, 34155264,
     1007553984, 722143664, 842150172, 538976811, 4178893, 2732729}};
static const uint32_t xing_5[5][16] = {
    {713031680, 1028653056, 276430848, 620052480, 854321152, 1063687424, 832587680, 1045106516, 468108990, 593634153,
     455302564, 588966884, 831404242, 508908875, 570011537, 447011402},
    {469762048, 301989888, 897581056, 37748736, 556793856, 872939520, 43384832, 558432256, 339001344, 370679808,
     924604416, 51127296, 563352320, 340279424, 371599712, 922817680},
    {444180378, 582771426, 386103319, 820878768, 768469037, 464323199, 540534784, 147816993, 431574890, 613378415,
     440641348, 585935378, 231724032, 321626113, 957130649, 762735301},
    {874725940, 276345168, 1005962939, 404842328, 44797378, 390406220, 719975565, 573261292, 995508545, 418874694,
     907865252, 322234891, 226350248, 200248046, 996057078, 201936327},
    {1010287484, 387092183, 210512716, 885098740, 230022349, 551664607, 58382349, 737801095, 851645666, 472257767,
     20236143, 1039091209, 58775360, 44000576, 1061407804, 1021417497}};

static net xing_net(const uint32_t (*columns)[16], int dim, int m)
{
    FILE *file = fopen("published.txt", "w");
    assert_non_null(file);
    fprintf(file, "# dnet\n2 # base\n%d # dimensions\n65536\n30\n", dim);
    for (int k = 0; k < dim; k++) {
        for (int c = 0; c < 16; c++) {
            fprintf(file, "%u%c", columns[k][c], c < 15 ? ' ' : '\n');
        }
    }
    assert_int_equal(fclose(file), 0);
    return net_of("net-file:published.txt", m, dim);
}

/* t of a sequence is the largest of those of its first 2^m points. */
static int largest_of(int of_points, int t)
{
    return t > of_points ? t : of_points;
}

TEST_CASE(sequences_have_the_published_t_values)
{
    static const int use[] = {0, 1, 2, 3, 4, 5, 6}, sobol[] = {0, 0, 1, 3, 5, 8, 11};
    int t[2] = {0, 0};
    for (int m = 2; m <= 16; m++) {
        const net four = xing_net(xing_4, 4, m), five = xing_net(xing_5, 5, m);
        t[0] = largest_of(t[0], quality_of(&four, use, 4));
        t[1] = largest_of(t[1], quality_of(&five, use, 5));
    }
    assert_int_equal(t[0], 1);
    assert_int_equal(t[1], 2);
    /* Sobol' sequences have t = sum of (degree - 1) of their polynomials (Sobol' 1967; Dick & Niederreiter 2008), which
       the first 2^13 points attain in up to 5 dimensions: Joe & Kuo's numbers. */
    test_write("published.txt", "d       s       a       m_i\n2 1 0 1\n3 2 1 1 3\n4 3 1 1 3 1\n5 3 2 1 1 1\n"
                                "6 4 1 1 1 3 3\n7 4 4 1 3 5 13\n");
    for (int dim = 1; dim <= 7; dim++) {
        int largest = 0;
        for (int m = 2; m <= (dim <= 5 ? 13 : test_repeats(11, 9)); m++) {
            const net a = net_of("net-file:published.txt", m, dim);
            largest = largest_of(largest, quality_of(&a, use, dim));
        }
        assert_true(dim <= 5 ? largest == sobol[dim - 1] : largest <= sobol[dim - 1]);
    }
}

/* Powers of Pascal's matrix modulo a prime b give sequences with t = 0 in b dimensions (Faure 1982): entry (r, c) of
   power k is binomial(c, r) k^(c - r). */
TEST_CASE(faures_matrices_give_nets)
{
    static const struct {
        uint64_t base;
        int columns;
    } files[] = {{3, 5}, {5, 3}, {7, 2}};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        const uint64_t b = files[f].base;
        const int columns = files[f].columns;
        FILE *file = fopen("published.txt", "w");
        assert_non_null(file);
        fprintf(file, "# dnet\n%d # base\n%d\n%d\n%d\n", (int)b, (int)b, columns, columns);
        size_t n = 1;
        for (uint64_t k = 0; k < b; k++) {
            uint64_t binomials[8] = {1}; /* of c */
            n = 1;
            for (int c = 0; c < columns; c++) {
                uint64_t number = 0;
                for (int r = 0; r < columns; r++) {
                    uint64_t entry = r <= c ? binomials[r] % b : 0;
                    for (int e = r; e < c; e++) {
                        entry = entry * k % b;
                    }
                    number = number * b + entry;
                }
                fprintf(file, "%d%c", (int)number, c + 1 < columns ? ' ' : '\n');
                for (int r = c + 1; r > 0; r--) {
                    binomials[r] += binomials[r - 1];
                }
                n *= b;
            }
        }
        assert_int_equal(fclose(file), 0);
        koksma_points points = test_points("net-file:published.txt", n, (int)b, 0);
        for (size_t first = b; first <= n; first *= b) {
            assert_true(is_net_in_base(&points, first, b));
        }
        koksma_points_fini(&points);
    }
}
