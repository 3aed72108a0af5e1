/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The best rank-1 lattice (1, z) in two dimensions, without transforms and without memory that grows with n.
 *
 * P_2 of (1, z) is a constant plus 4 pi^4 times the mean of B_2({i/n}) B_2({i z/n}), which is a Dedekind-Rademacher sum.
 * The three-term relation of Hall, Wilson & Zagier (hall1995) for such sums of degree 4 gives it from the steps of Euclid's
 * algorithm. With k > h the two numbers of a step, s(h, k) = (k/4) sum_i B_2({i/k}) B_2({i h/k}), d(h, k) = (1/6) sum_i
 * B_1({i/k}) B_3({i h/k}) and r = k mod h,
 *
 *     s(h, k) = s(r, h) - 2 (h/k) d(r, h) + 1/144 + ((k/h)^2 - 3 (h/k)^2 - 3/(h k)^2) / 720
 *     d(h, k) = -(h/k)^2 d(r, h) + (h/k)/144 - (k/h + 3/(h k^3) + (h/k)^3) / 720
 *
 * with s(0, 1) = 1/144 and d(0, 1) = 0. s is a sum of positive terms, one for each point of the dual lattice off the axes;
 * for every quotient q of Euclid's algorithm the multiples of one dual point, whose |h_1 h_2| is below n/q, contribute at
 * least q^2/720. The sum of the q^2 therefore ends the algorithm early for all but some z.
 */
#include "patterns/lattices/lattices.h"

#include <math.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"

enum { BLOCK = 512, ASK = 1 << 16 };

#define NEAR                                                                                                         \
    1e-12 /* relative difference of s below which sums of all points decide; the rounding of s is below 1e-13 */

typedef struct candidate {
    uint64_t z, numerator;
    double s, sum;
} candidate;

typedef struct candidates {
    candidate *items;
    size_t count, capacity;
} candidates;

/* Returns whether z has a common divisor with n, or is known to have s(z, n) above `most`. */
static bool passed_over(uint32_t n, uint32_t z, double most)
{
    const uint64_t limit = most < 1e9 ? (uint64_t)(most * 721) : UINT64_MAX;
    uint64_t squares = 0;
    while (z) {
        const uint32_t q = n / z, r = n % z;
        squares += (uint64_t)q * q;
        if (squares > limit) {
            return true;
        }
        n = z;
        z = r;
    }
    return n != 1;
}

/* s(h, k), with what the steps so far make of d and s of the next step. */
static double dedekind(uint32_t h, uint32_t k)
{
    double s = 1.0 / 144, share = 0;
    while (h) {
        const double up = (double)k / h, down = (double)h / k, small = 1 / ((double)h * k);
        const double d = down / 144 - (up + 3 * small / ((double)k * k) + down * down * down) / 720;
        s += 1.0 / 144 + (up * up - 3 * (down * down + small * small)) / 720 + share * d;
        share = -down * (2 + share * down);
        const uint32_t r = k % h;
        k = h;
        h = r;
    }
    return s;
}

/* Lists the z <= n/2 whose s is the least, or so near that rounding could hide which is less. */
static koksma_status list_best(const koksma_run *run, size_t n, candidates *list)
{
    double least = HUGE_VAL;
    for (uint64_t z = 1; z <= n / 2; z++) {
        if (z % ASK == 0) {
            KOKSMA__TRY(koksma__ask(run));
        }
        if (passed_over((uint32_t)n, (uint32_t)z, least)) {
            continue;
        }
        const double s = dedekind((uint32_t)z, (uint32_t)n);
        if (s > least * (1 + NEAR)) {
            continue;
        }
        list->count = s < least * (1 - NEAR) ? 0 : list->count;
        least = s < least ? s : least;
        KOKSMA__TRY(koksma__reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items));
        list->items[list->count++] = (candidate){.z = z, .s = s};
    }
    size_t kept = 0;
    for (size_t c = 0; c < list->count; c++) {
        if (list->items[c].s <= least * (1 + NEAR)) {
            list->items[kept++] = list->items[c];
        }
    }
    list->count = kept;
    return KOKSMA_OK;
}

uint64_t koksma__lattice_last(size_t n)
{
    return n % 2 || n == 2 ? n / 2 : n / 2 + (n % 4 ? 2 : 1);
}

/* For few points all z are compared by their sums. */
static koksma_status list_all(size_t n, candidates *list)
{
    for (uint64_t z = 1; z <= koksma__lattice_last(n); z++) {
        if (!passed_over((uint32_t)n, (uint32_t)z, HUGE_VAL)) {
            KOKSMA__TRY(koksma__reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items));
            list->items[list->count++] = (candidate){.z = z};
        }
    }
    return KOKSMA_OK;
}

static double kernel(uint64_t numerator, size_t n)
{
    const double x = (double)numerator / (double)n;
    return 1 + 2 * M_PI * M_PI * (x * (x - 1) + 1.0 / 6);
}

/* Sums up P_2 of each candidate. A multiplier and its inverse, which swaps the axes, have equal errors; sometimes other
   multipliers have the same error, too. The last bit of the sum decides which of them is chosen. The order of summation
   must therefore never change, because the points would change. */
static koksma_status sum_up(const koksma_run *run, size_t n, candidates *list)
{
    double first[BLOCK];
    for (size_t begin = 0; begin < n; begin += BLOCK) {
        const size_t count = n - begin < BLOCK ? n - begin : BLOCK;
        KOKSMA__TRY(koksma__look(run, begin / BLOCK, 0));
        for (size_t i = 0; i < count; i++) {
            first[i] = kernel(begin + i, n);
        }
        for (size_t c = 0; c < list->count; c++) {
            candidate *to = &list->items[c];
            for (size_t i = 0; i < count; i++) {
                to->sum += first[i] * kernel(to->numerator, n);
                to->numerator += to->z - (to->numerator + to->z >= n ? n : 0);
            }
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__lattice_second(const koksma_run *run, size_t n, uint64_t *best)
{
    candidates list = {0};
    koksma_status status = n > KOKSMA__LATTICE_FEW ? list_best(run, n, &list) : list_all(n, &list);
    status = status || list.count == 1 ? status : sum_up(run, n, &list);
    double least = HUGE_VAL;
    for (size_t c = 0; !status && c < list.count; c++) {
        const double value = list.items[c].sum / (double)n - 1;
        if (value < least) {
            least = value;
            *best = list.items[c].z;
        }
    }
    free(list.items);
    return status;
}
