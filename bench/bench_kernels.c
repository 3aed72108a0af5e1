/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Nanoseconds per item of each kernel on one thread, in every instruction set that this machine has, beside the plain
 * twin; then how many times as fast as the twin the fastest is, and which. Each figure is the least of several rounds in
 * processor time. An item is what the kernel's loop runs over: a point, a word, a pair.
 *
 *     bench-kernels [KERNEL]
 */
#include "kernels/kernels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { N = 1024, BIG = 16 * N, ROUNDS = 7 };

static uint32_t words[4 * BIG], found[4 * BIG];
static _Alignas(64) double units[4 * BIG], out[4][4 * BIG + 64]; /* not all at one place of the cache's pages */
static double sorted[N + 8], sums[8][16];
static size_t sink;
static uint64_t counts[208];
static int16_t counts16[N];
static float floats[N];

typedef const koksma__kernel_table *table;

/* Each runs a kernel once, and returns how many items that were. */
#define RUN(name, items, ...)                                                                                        \
    static double run_##name(table t)                                                                                \
    {                                                                                                                \
        __VA_ARGS__;                                                                                                 \
        return items;                                                                                                \
    }

static uint32_t directions[32];
static const uint32_t *const four[4] = {directions, directions, directions, directions};
static double *const digits[2] = {out[2], out[3]};
static const uint32_t runs[8] = {0, 20, 100, 120, 200, 220, 300, 320};

/* Darts into a tile of 32 x 32 cells, of which one in three has a point. */
enum { CELLS = 32, STRIDE = CELLS + 7 };
static uint32_t places[STRIDE * (CELLS + 4)], squares[N];
static const koksma__dart_cells cells = {places, STRIDE, 1, N, squares};

/* 53 digits each, and the nodes of all their first seven. */
static uint64_t whole[N], scrambled[N];
static koksma__nested_node nodes[1 << KOKSMA__NESTED_LEVELS];

RUN(nested_bits, N, memcpy(scrambled, whole, sizeof whole); t->nested_bits(1, 2, nodes, N, scrambled))
RUN(uniform, N, t->uniform(1, 2, 3, 0, N, out[0]))
RUN(words, N, t->words(1, 2, 3, 0, N, found))
RUN(draws, N, t->draws(1, 2, 3, 0, N, found))
RUN(permutation, N, t->permutation(1, 2, N, found))
RUN(quotients, N, t->quotients(N, units, 0.5, 3.1, out[0]))
RUN(steps, N, t->steps(N, 7, 0.5, 3.1, out[0]))
RUN(fractions, N, t->fractions(N, words, out[0]))
RUN(rows_of_columns, N, t->rows_of_columns(N, 4, units, N + 24, false, out[0]))
RUN(fraction_rows, N, t->fraction_rows(N, 4, words, N + 24, false, out[0]))
RUN(digital, N, t->digital(N, directions, 5, found))
RUN(digital_rows, N, t->digital_rows(N, 4, four, words, false, out[0]))
RUN(permute, N, t->permute(3, N, 5000, 77, found))
RUN(owen_hash, N, t->owen_hash(N, words, true, true, 7, found))
RUN(pascal, N, t->pascal(N, words, found))
RUN(digital_at, N, t->digital_at(N, words, directions, found))
RUN(grow, N, t->grow(found, 10, 0, N, 0x15, words))
RUN(nested_digits, 2 * N, t->nested_digits(5, 2, N, 125, sorted, digits))
RUN(l2_pairs, N *(N - 1) / 2.0, t->l2_pairs(0, N, N, 2, units, units + 2 * N, 0.5, -0.5, sums[0]))
RUN(l2_linear, N, t->l2_linear(N, 2, units, N, (const double[]){9, -12, -12, 0}, out[0], out[1]))
RUN(star_sweep, (double)N *N, size_t at[2]; t->star_sweep(N, sorted, words, sorted, out[0], sums[0], at))
RUN(star_extremes, 48 * 32, t->star_extremes(48, units, 32, units + 64, true, out[0]))
RUN(star_pairs, 48 * 32, sink += t->star_pairs(48, units, 32, units + 64, true, 1000, 7))
RUN(far_corners, N, sink += t->far_corners(N, counts16, floats, 1, 1, 1000, found))
RUN(cells_2d, N, t->cells_2d(0, 1, 32, 32, out[2]))
RUN(truncated_normals, 2 * N, memcpy(out[2], units, 2 * N * sizeof(double));
    t->truncated_normals(0.95, 0.35, 2 * N, out[2]))
RUN(rooks_2d, N, t->rooks_2d(1, squares, 0, N, N + 1, out[0]))
RUN(nearest_place, N,
    for (size_t i = 0; i < N; i++) sink += (size_t)t->nearest_place(places + i % 900, STRIDE, words[i]))
RUN(far_darts, N, sink += t->far_darts(&cells, 33000000, N, words, found))
RUN(open_quarters, N, sink += t->open_quarters(&cells, 33000000, found))
RUN(covers, 64, sink += t->covers(64, units, units + N, 0.5, 0.5, 0.02, 0.02, 0.01))
RUN(nearest_offset, 100 * 64, t->nearest_offset(64, units, units + N, 100, units, 0.3, out[0]))
RUN(pair_counts, N, t->pair_counts(N, units, units + N, 0.4, 0.6, 0.09, 600, 200, counts))
RUN(mask_growth, 13 * 16,
    sums[0][0] += (double)t->mask_growth(13, 16, 16, 300, 2, floats, floats, floats, floats + 2))
RUN(gauss_force, 80, t->gauss_force(4, runs, units, units + N, 0.4, 0.6, -48, 0.25, sums[0]))
RUN(extreme_strips, 16 * N, t->extreme_strips(N, units, sorted, (const double (*)[16])(units + N), sums[0], sums[1]))
RUN(extreme_runs, 16 * 900,
    t->extreme_runs(900, units, sorted, (const double (*)[9])units, (const double (*)[16])(units + N), sums[0],
                    sums[1]))
RUN(distances, N, sums[0][0] += t->distances(N, units, units + N, 0.4, 0.6))
RUN(count_below, 16 * N, t->count_below(N, units, units + N, units, units + 16, units + 32, sums[0]))
RUN(outer_sums, 128 * N, t->outer_sums(N, units, units, sums))
RUN(fourier16, 16 * 256, memcpy(out[0], units, 4096 * sizeof(double)); memcpy(out[1], units, 4096 * sizeof(double));
    sink += t->fourier16(256, units, out[0], out[1], out[2], out[3]))
RUN(disk_overlaps, N, sums[0][0] += t->disk_overlaps(1, 0.2, 0.4, 0.6, N, units, units + N))

static const struct {
    const char *name;
    double (*run)(table);
} kernels[] = {
#define KERNEL(result, name, arguments) {#name, run_##name},
#include "kernels/kernels.def"
#undef KERNEL
};

static void prepare(void)
{
    table ref = koksma__kernels_find("ref");
    ref->words(1, 2, 0, 0, BIG, words);
    ref->uniform(3, 4, 0, 0, 2 * BIG, units);
    for (uint32_t i = 0; i < N; i++) {
        whole[i] = (uint64_t)(units[i] * 0x1p53);
        sorted[i] = i / (double)N;
        words[i] %= N;
        squares[i] = koksma__place(words[i] % CELLS << 1, words[i + 1] % CELLS << 1);
    }
    for (int i = 0; i < 8; i++) {
        sorted[N + i] = 1;
    }
    for (uint32_t i = 0; i < STRIDE * (CELLS + 4); i++) {
        const uint32_t x = i % STRIDE - 2, y = i / STRIDE - 2;
        places[i] = words[N + i] % 3 ? koksma__no_place(x, y)
                                     : koksma__place(x * KOKSMA__PLACE_UNITS + words[2 * N + i] % 4096,
                                                     y * KOKSMA__PLACE_UNITS + words[3 * N + i] % 4096);
    }
    memcpy(directions, words + N, sizeof directions);
    memcpy(nodes, units, sizeof nodes);
}

static double now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

/* Least nanoseconds an item over rounds of about a millisecond. */
static double best_ns(table t, double (*run)(table))
{
    double best = HUGE_VAL;
    for (int round = 0; round < ROUNDS; round++) {
        double items = 0, start = now_ns(), ns;
        for (int times = 1; (ns = now_ns() - start) < 1e6; times *= 2) {
            for (int i = 0; i < times; i++) {
                items += run(t);
            }
        }
        ns /= items;
        best = ns < best ? ns : best;
    }
    return best;
}

int main(int argc, char **argv)
{
    static const char *const isas[] = {"ref", "baseline", "avx2", "avx512"};
    prepare();
    printf("%-16s %10s %10s %10s %10s   ns an item; fastest against the plain twin\n", "kernel", isas[0], isas[1],
           isas[2], isas[3]);
    for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++) {
        double plain = 0, least = HUGE_VAL;
        const char *fastest = "";
        if (argc > 1 && strcmp(argv[1], kernels[k].name)) {
            continue;
        }
        printf("%-16s", kernels[k].name);
        for (int i = 0; i < 4; i++) {
            table t = koksma__kernels_find(isas[i]);
            const double ns = t ? best_ns(t, kernels[k].run) : HUGE_VAL;
            plain = i ? plain : ns;
            fastest = ns < least ? isas[i] : fastest;
            least = ns < least ? ns : least;
            t ? printf(" %10.3f", ns) : printf(" %10s", "-");
        }
        printf("   %6.1f x, %s\n", plain / least, fastest);
        fflush(stdout);
    }
    return sink == 42; /* so that nothing is left out */
}
