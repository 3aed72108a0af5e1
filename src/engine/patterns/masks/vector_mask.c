/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Vector masks (Georgiev & Fajardo 2016): size^2 vectors, one for each pixel of a tile, arranged such that neighbours
 * have distant vectors. The arrangement has a small energy
 *
 *     E = sum over pairs of pixels p != q of exp(-|p - q|^2 / 2.1^2) exp(-|v_p - v_q|^(dim/2))
 *
 * where distances between pixels are measured on the torus, and distances between vectors are not. With distances of
 * vectors on the torus, masks of dim = 2 get worse than white noise for integrands that are not periodic: neighbours
 * come to lie half a torus apart, so that vectors modulo 1/2 vary slowly over the tile (docs/findings/screen-noise.md).
 * Pairs of pixels more than 6 pixels apart along an axis are left out; their first factor is below 3e-4.
 *
 * The vectors are a rank-1 lattice of size^2 points with a random shift; its multipliers are those of lattice-rank1.
 *
 * The search is simulated annealing: it starts from a random permutation and proposes SWAPS swaps of two random pixels
 * for each pixel. A swap that raises the energy by e is made with probability exp(-e / T), where T falls geometrically
 * until practically only improvements are made. A swap changes only the terms of the windows about its two pixels. The
 * second factor is a table over the square of the distance: the upper bits of a float, its exponent and 8 bits of its
 * mantissa, select the entry, so that distances are resolved to 1/512. Both factors are whole multiples of 2^-20, so that
 * sums are exact in any order.
 */
#include <koksma/mask.h>

#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/lattices/lattices.h"

/* The temperature at the beginning and at the end, in units of the second factor's standard deviation. */
static const double HOT = 0.3, COLD = 0.003;

enum {
    SWAPS = 256,
    REACH = 6,
    SPAN = 2 * REACH + 1,
    LANES = 16, /* SPAN rounded up: inner loops of a fixed length are vectorised */
    ONE = 1 << 20,
    STEPS_BETWEEN_CALLS = 4096,
    FLOAT_BITS = 15,                         /* lower bits of a float that do not select an entry */
    FIRST_ENTRY = (127 - 34) << 8,           /* the entry of 2^-34, below the square of every distance */
    ENTRIES = ((127 + 4) << 8) - FIRST_ENTRY /* up to 2^4 > KOKSMA_MASK_MAX_DIM */
};

/* Added to the squares of distances, so that a distance of 0 has an entry, too. The term of a pixel with itself has
   the weight 0. */
static const float LEAST_SQUARE = 0x1p-34f;

typedef struct vectors {
    int size, dim;
    uint32_t n;
    int before, after; /* the window has the offsets -before .. after along each axis */
    int stride;        /* length of a row of pixels with its border */
    int64_t weights[SPAN][SPAN];
    uint64_t z[KOKSMA_MASK_MAX_DIM];
    int32_t kernel[ENTRIES];
    float *coordinates[KOKSMA_MASK_MAX_DIM]; /* coordinate k of each pixel's vector, with the border */
    uint32_t *point;                         /* index of each pixel's point in the lattice; no border */
    double deviation;                        /* standard deviation of the second factor */
} vectors;

static uint32_t entry_of(float square)
{
    uint32_t bits;
    memcpy(&bits, &square, sizeof bits);
    return (bits >> FLOAT_BITS) - FIRST_ENTRY;
}

/* Returns square^(dim/4), which is |d|^(dim/2) for the square of |d|. */
static double power_of(double square, int dim)
{
    double power = dim & 1 ? sqrt(sqrt(square)) : 1;
    power *= dim & 2 ? sqrt(square) : 1;
    for (int k = 4; k <= dim; k += 4) {
        power *= square;
    }
    return power;
}

static void make_tables(vectors *v)
{
    for (uint32_t i = 0; i < ENTRIES; i++) {
        const uint32_t bits =
            (i + FIRST_ENTRY) << FLOAT_BITS | 1u << (FLOAT_BITS - 1); /* the middle of the interval */
        float square;
        memcpy(&square, &bits, sizeof square);
        v->kernel[i] = (int32_t)(koksma__exp(-power_of((double)square, v->dim)) * ONE + 0.5);
    }
    for (int y = -v->before; y <= v->after; y++) {
        for (int x = -v->before; x <= v->after; x++) {
            const double weight = koksma__exp(-(x * x + y * y) / (2.1 * 2.1));
            v->weights[y + v->before][x + v->before] = x || y ? (int64_t)(weight * ONE + 0.5) : 0;
        }
    }
}

/* Returns the shifted coordinate k of a point as a whole multiple of 1/n. */
static uint32_t multiple_of(const vectors *v, uint32_t point, int k, uint64_t seed)
{
    const uint32_t shift = koksma__below(koksma__random(seed, KOKSMA__PURPOSE_SHIFT, (uint64_t)k, 0).w[0], v->n);
    return (uint32_t)((point * v->z[k] + shift) % v->n);
}

/* Sets one coordinate of the vector of a pixel, and of the pixel's copies in the border. */
static void place(vectors *v, uint32_t pixel, int k, float coordinate)
{
    const int x = (int)pixel % v->size, y = (int)pixel / v->size;
    for (int b = (y + v->before) % v->size; b < v->size + v->before + v->after; b += v->size) {
        for (int a = (x + v->before) % v->size; a < v->size + v->before + v->after; a += v->size) {
            v->coordinates[k][b * v->stride + a] = coordinate;
        }
    }
}

static size_t position_of(const vectors *v, uint32_t pixel)
{
    return ((size_t)pixel / (size_t)v->size + (size_t)v->before) * (size_t)v->stride +
           (size_t)pixel % (size_t)v->size + (size_t)v->before;
}

/* Returns the second factor of the vectors of pixels p and q. */
static int32_t factor_of(const vectors *v, uint32_t p, uint32_t q)
{
    float square = LEAST_SQUARE;
    for (int k = 0; k < v->dim; k++) {
        const float d = v->coordinates[k][position_of(v, p)] - v->coordinates[k][position_of(v, q)];
        square += d * d;
    }
    return v->kernel[entry_of(square)];
}

/* Starts from a random permutation. */
static void shuffle(vectors *v, uint64_t seed)
{
    for (uint32_t i = 0; i < v->n; i++) {
        v->point[i] = i;
    }
    for (uint32_t i = v->n; i > 1; i--) {
        const uint32_t other = koksma__below(koksma__random(seed, KOKSMA__PURPOSE_SHUFFLE, i, 0).w[0], i);
        const uint32_t point = v->point[i - 1];
        v->point[i - 1] = v->point[other];
        v->point[other] = point;
    }
    double sum = 0, squares = 0;
    for (uint32_t p = 0; p < v->n; p++) {
        for (int k = 0; k < v->dim; k++) {
            place(v, p, k, (float)multiple_of(v, v->point[p], k, seed) / (float)v->n);
        }
        const double factor = p ? factor_of(v, p, p - 1) : 0;
        sum += factor;
        squares += factor * factor;
    }
    const double mean = sum / (v->n - 1);
    v->deviation = sqrt(fmax(squares / (v->n - 1) - mean * mean, 0));
}

/* Returns by how much the energy of the window of pixel p grows when p gets the vector of q and all others keep theirs. */
static int64_t growth(const vectors *v, uint32_t p, uint32_t q)
{
    const int span = v->before + v->after + 1;
    size_t corner = position_of(v, p) - (size_t)(v->before * (v->stride + 1));
    int64_t sum = 0;
    for (int y = 0; y < span; y++, corner += (size_t)v->stride) {
        float old[LANES], new[LANES];
        uint32_t old_bits[LANES], new_bits[LANES];
        for (int x = 0; x < LANES; x++) {
            old[x] = new[x] = LEAST_SQUARE;
        }
        for (int k = 0; k < v->dim; k++) {
            const float *row = v->coordinates[k] + corner;
            const float from = v->coordinates[k][position_of(v, p)], to = v->coordinates[k][position_of(v, q)];
            for (int x = 0; x < LANES; x++) {
                old[x] += (row[x] - from) * (row[x] - from);
                new[x] += (row[x] - to) * (row[x] - to);
            }
        }
        memcpy(old_bits, old, sizeof old);
        memcpy(new_bits, new, sizeof new);
        for (int x = 0; x < span; x++) {
            sum += v->weights[y][x] * (v->kernel[(new_bits[x] >> FLOAT_BITS) - FIRST_ENTRY] -
                                       v->kernel[(old_bits[x] >> FLOAT_BITS) - FIRST_ENTRY]);
        }
    }
    return sum;
}

/* Returns by how much the energy grows when pixels p and q swap their vectors. The pair's own term does not change,
   but each window counts it as if the other pixel kept its vector. */
static int64_t growth_of_swap(const vectors *v, uint32_t p, uint32_t q)
{
    const int64_t sum = growth(v, p, q) + growth(v, q, p);
    int offset[2] = {(int)q % v->size - (int)p % v->size, (int)q / v->size - (int)p / v->size};
    for (int k = 0; k < 2; k++) {
        offset[k] += offset[k] < -v->before ? v->size : offset[k] > v->after ? -v->size : 0;
        if (offset[k] < -v->before || offset[k] > v->after) {
            return sum;
        }
    }
    return sum - 2 * v->weights[offset[1] + v->before][offset[0] + v->before] *
                     (v->kernel[entry_of(LEAST_SQUARE)] - factor_of(v, p, q));
}

static void swap(vectors *v, uint32_t p, uint32_t q)
{
    const uint32_t point = v->point[p];
    v->point[p] = v->point[q];
    v->point[q] = point;
    for (int k = 0; k < v->dim; k++) {
        const float coordinate = v->coordinates[k][position_of(v, p)];
        place(v, p, k, v->coordinates[k][position_of(v, q)]);
        place(v, q, k, coordinate);
    }
}

static koksma_status anneal(vectors *v, uint64_t seed, const koksma_run *run)
{
    const uint64_t steps = (uint64_t)SWAPS * v->n;
    const double hot = HOT * v->deviation * ONE; /* v->deviation contains one factor ONE, energies contain two */
    double temperature = hot;
    for (uint64_t step = 0; step < steps; step++) {
        if (step % STEPS_BETWEEN_CALLS == 0) {
            const double done = (double)step / (double)steps;
            if (!koksma__keep_going(run, done)) {
                return koksma__fail_interrupted();
            }
            temperature = hot * koksma__exp(done * koksma__log(COLD / HOT));
        }
        const koksma__words random = koksma__random(seed, KOKSMA__PURPOSE_SEARCH, step, 0);
        const uint32_t p = koksma__below(random.w[0], v->n);
        uint32_t q = koksma__below(random.w[1], v->n - 1);
        q += q >= p;
        const double e = (double)growth_of_swap(v, p, q);
        if (e <= 0 || koksma__exp(-e / temperature) > koksma__unit(random.w[2], random.w[3])) {
            swap(v, p, q);
        }
    }
    return KOKSMA_OK;
}

/* Allocates the arrays as one block, which begins with v->coordinates[0]. Loops over LANES read up to LANES numbers from
   the start of the last window, so each array has as many more. */
static koksma_status make_room(vectors *v)
{
    v->before = (v->size - 1) / 2 < REACH ? (v->size - 1) / 2 : REACH;
    v->after = v->size / 2 < REACH ? v->size / 2 : REACH;
    v->stride = v->size + v->before + v->after;
    const size_t each = (size_t)v->stride * (size_t)v->stride + LANES;
    const size_t bytes = (size_t)v->dim * each * sizeof(float) + v->n * sizeof *v->point;
    float *all = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(all, bytes);
    for (int k = 0; k < v->dim; k++) {
        v->coordinates[k] = all + (size_t)k * each;
    }
    v->point = (uint32_t *)(all + (size_t)v->dim * each);
    return KOKSMA_OK;
}

koksma_status koksma_mask_vectors(int size, int dim, uint64_t seed, const koksma_run *run, double *values)
{
    KOKSMA__REQUIRE(values);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(size < KOKSMA_MASK_MIN || size > KOKSMA_MASK_MAX_VECTORS, KOKSMA_ARGUMENT,
                    "vector-mask: a mask of size %d; sizes are %d to %d", size, KOKSMA_MASK_MIN,
                    KOKSMA_MASK_MAX_VECTORS);
    KOKSMA__FAIL_IF(dim < 1 || dim > KOKSMA_MASK_MAX_DIM, KOKSMA_ARGUMENT,
                    "vector-mask: dim = %d; vectors have 1 to %d dimensions", dim, KOKSMA_MASK_MAX_DIM);
    vectors v = {.size = size, .dim = dim, .n = (uint32_t)(size * size)};
    KOKSMA__TRY(make_room(&v));
    /* the search takes a small part of the time: progress is reported from the annealing on */
    koksma_status status = koksma__lattice_find(run, v.n, dim, 0, NULL, 0, v.z);
    if (!status) {
        make_tables(&v);
        shuffle(&v, seed);
        status = anneal(&v, seed, run);
    }
    for (int k = 0; !status && k < dim; k++) {
        const double within = koksma__random(seed, KOKSMA__PURPOSE_SHIFT, (uint64_t)k, 0).w[1] * 0x1p-32;
        for (uint32_t p = 0; p < v.n; p++) {
            values[p * (size_t)dim + (size_t)k] = ((double)multiple_of(&v, v.point[p], k, seed) + within) / v.n;
        }
    }
    free(v.coordinates[0]);
    return status;
}
