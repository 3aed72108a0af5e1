/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-file: the rank-1 lattice of a generating vector that is read from a file; the spec is lattice-file:PATH.
 *
 *     x_i,k = {phi_b(i) z_k},   phi_b the radical inverse in base b
 *
 * The file has one of three formats. The format `lattice` of LDData has a line "# lattice", the number of dimensions,
 * the number of points N, and z_1, z_2, ... on one line each; comments follow a #. LatNet Builder's output has the
 * heading "# Parameters for a lattice rule" in place of the first line, below other comments. Kuo's format has no
 * header, and one line "k z_k" (or only z_k) for each dimension. If N = b^m with b prime and m > 1, the points are a
 * lattice sequence: for any power n of b the first n points are the lattice {i z / n}, and more points can follow.
 * Without a header b is 2 and N is 2^32. For any other N, n has to be N: the points are {i z / N}. A vector should be
 * used only with the numbers of points listed in the comments of its file.
 *
 * Sources: Hickernell, Hong, L'Ecuyer & Lemieux 2000 for the order of an extensible lattice, Cools, Kuo & Nuyens 2006
 * for embedded lattices, and L'Ecuyer, Marion, Godin & Puchhammer 2022 for the formats. With the modifiers
 * shift=1,tent=1 the integration error falls nearly as n^-2 for smooth functions that are not periodic (Hickernell
 * 2002).
 */
#include <koksma/sampler.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

typedef struct vector {
    uint64_t base, points; /* points = base^m */
    const uint64_t *z;
} vector;

/* Returns the number j for which point i is j z / N: the m digits of i in base b, in reverse order. */
static uint64_t mirrored(const vector *v, uint64_t i)
{
    uint64_t place = v->points, at = 0;
    for (; i; i /= v->base) {
        place /= v->base;
        at += i % v->base * place;
    }
    return at;
}

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const vector *v = context;
    if (v->base == 2) { /* computes the same coordinates as the general case, but without divisions */
        const int unused = 32 - (int)round(koksma__log2((double)v->points));
        const double scale = 1 / (double)v->points;
        for (size_t i = 0; i < count; i++) {
            const uint64_t at = (uint64_t)koksma_mirror((uint32_t)(first + i)) >> unused;
            xs[i] = (double)(at * v->z[k] & (v->points - 1)) * scale;
        }
        return;
    }
    for (size_t i = 0; i < count; i++) { /* no overflow: both factors are at most 2^32 */
        xs[i] = (double)(mirrored(v, first + i) * v->z[k] % v->points) / (double)v->points;
    }
}

/* Returns the prime b if `points` is b^m with m > 1. Otherwise it returns `points`; point i is then i z / N. */
static uint64_t base_of(uint64_t points)
{
    uint64_t base = 2, left = points;
    while (base * base <= points && points % base) {
        base++;
    }
    while (base * base <= points && left % base == 0) {
        left /= base;
    }
    return left == 1 ? base : points;
}

static koksma_status read_head(koksma__number_lines *lines, int dim, vector *v)
{
    uint64_t dims = KOKSMA_MAX_DIM;
    v->points = UINT64_C(1) << 32;
    if (*lines->kind) {
        KOKSMA__FAIL_IF(strcmp(lines->kind, "lattice") != 0, KOKSMA_MALFORMED,
                        "%s: the file is of the kind '%s'; this pattern reads '# lattice', and net-file reads nets",
                        lines->name, lines->kind);
        KOKSMA__TRY(koksma__number_lines_take(lines, "the number of dimensions", 1, &dims));
        KOKSMA__TRY(koksma__number_lines_take(lines, "the number of points", 1, &v->points));
        KOKSMA__FAIL_IF(v->points < 1 || v->points > UINT64_C(1) << 32, KOKSMA_MALFORMED,
                        "%s: line %zu: %llu points; a lattice has 1 to 2^32", lines->name, lines->number,
                        (unsigned long long)v->points);
    }
    KOKSMA__TRY(koksma__number_lines_dims(lines, dims, dim));
    v->base = base_of(v->points);
    return KOKSMA_OK;
}

static koksma_status read_vector(koksma__number_lines *lines, int dim, vector *v, uint64_t *z)
{
    KOKSMA__TRY(read_head(lines, dim, v));
    for (int k = 0; k < dim; k++) {
        uint64_t line[2] = {0};
        size_t count;
        KOKSMA__TRY(koksma__number_lines_next(lines, *lines->kind ? 1 : 2, line, &count));
        KOKSMA__TRY(!count && k && !*lines->kind ? koksma__number_lines_dims(lines, (uint64_t)k, dim) : KOKSMA_OK);
        KOKSMA__FAIL_IF(!count, KOKSMA_MALFORMED, "%s: it ends before coordinate %d of its vector", lines->name,
                        k + 1);
        KOKSMA__FAIL_IF(count == 2 && line[0] != (uint64_t)k + 1, KOKSMA_MALFORMED,
                        "%s: line %zu: dimension %llu, but dimension %d is expected", lines->name, lines->number,
                        (unsigned long long)line[0], k + 1);
        z[k] = line[count - 1] % v->points;
    }
    v->z = z;
    return KOKSMA_OK;
}

static koksma_status check_count(const koksma__number_lines *lines, const vector *v, uint64_t n)
{
    KOKSMA__FAIL_IF(n > v->points, KOKSMA_N, "%s: it has %llu points, not %llu", lines->name,
                    (unsigned long long)v->points, (unsigned long long)n);
    KOKSMA__FAIL_IF(v->base == v->points && n < v->points, KOKSMA_N,
                    "%s: its %llu points are not a sequence, because their number is not b^m with a prime b and m > "
                    "1; n = %llu would do",
                    lines->name, (unsigned long long)v->points, (unsigned long long)v->points);
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    uint64_t *z = malloc((size_t)out->dim * sizeof *z);
    koksma__number_lines lines;
    vector v = {0};
    KOKSMA__REQUIRE_MEMORY(z, (size_t)out->dim * sizeof *z);
    koksma_status status = koksma__number_lines_open("lattice-file", args->path, &lines);
    status = status ? status : read_vector(&lines, out->dim, &v, z);
    status = status ? status : check_count(&lines, &v, args->first + out->n);
    status = status ? status : koksma__range_columns(args, out, column, &v);
    koksma__number_lines_close(&lines);
    free(z);
    return status;
}

const koksma_pattern koksma__pattern_lattice_file = {
    .name = "lattice-file",
    .title = "rank-1 lattice whose generating vector is read from a file: lattice-file:PATH (LatNet Builder's and "
             "Kuo's formats)",
    .cite = "hickernell2000 lecuyer2022 cools2006",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE,
    .generate = generate,
    .operand = "PATH",
    .ranges = koksma__ranges_always,
};
