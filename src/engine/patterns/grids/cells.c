/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Helpers of patterns with one point in each cell of a grid: they factor n into m^dim cells or into columns and rows,
 * and put a uniform random point into each cell. Error messages name the nearest n that is possible.
 */
#include "patterns/grids/grids.h"

#include <math.h>
#include <stdio.h>

#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"

/* Returns m^dim, or SIZE_MAX if that overflows. */
static size_t power(size_t m, int dim)
{
    size_t product = 1;
    for (int k = 0; k < dim; k++) {
        if (product > SIZE_MAX / m) {
            return SIZE_MAX;
        }
        product *= m;
    }
    return product;
}

koksma_status koksma__divisors(const char *name, size_t n, double wanted, size_t *columns, size_t *rows)
{
    size_t c = (size_t)wanted;
    if (c == 0) {
        c = (size_t)sqrt((double)n);
        while (n % c) {
            c--;
        }
    }
    KOKSMA__FAIL_IF(n < c, KOKSMA_N, "%s: columns=%zu does not divide n = %zu; n = %zu would do", name, c, n, c);
    KOKSMA__FAIL_IF(n % c, KOKSMA_N, "%s: columns=%zu does not divide n = %zu; n = %zu or %zu would do", name, c, n,
                    n / c * c, (n / c + 1) * c);
    *columns = c;
    *rows = n / c;
    return KOKSMA_OK;
}

koksma_status koksma__cells(const char *name, const koksma_points *out, double columns, size_t *along_x,
                            size_t *along_rest)
{
    const size_t n = out->n;
    if (columns > 0) {
        KOKSMA__FAIL_IF(out->dim != 2, KOKSMA_ARGUMENT, "%s: columns can be used only in dim = 2", name);
        return koksma__divisors(name, n, columns, along_x, along_rest);
    }
    size_t m = (size_t)(out->dim == 2 ? sqrt((double)n) : koksma__pow((double)n, 1.0 / out->dim));
    while (power(m + 1, out->dim) <= n) {
        m++;
    }
    while (m > 1 && power(m, out->dim) > n) {
        m--;
    }
    if (power(m, out->dim) == n) {
        *along_x = *along_rest = m;
        return KOKSMA_OK;
    }
    const size_t next = power(m + 1, out->dim);
    char more[64] = "";
    if (next <= KOKSMA_MAX_COORDINATES / (size_t)out->dim) {
        snprintf(more, sizeof more, " or %zu", next);
    }
    return koksma__fail(KOKSMA_N, "%s: n = %zu is not m^%d; n = %zu%s would do%s", name, n, out->dim,
                        power(m, out->dim), more, out->dim == 2 ? ", or columns=C with C a divisor of n" : "");
}

void koksma__place_in_cells(const koksma_args *args, double start, double width, size_t along_x, size_t along_rest,
                            koksma_points *out)
{
    const double m_x = (double)along_x, m_rest = (double)along_rest;
    double *x = out->xs;
    if (out->dim == 2 && out->n == args->n) {
        koksma__kernels()->cells_2d(start, width, along_x, along_rest, x);
        return;
    }
    size_t cell[KOKSMA_MAX_DIM];
    uint64_t rest = args->first;
    for (int k = out->dim - 1; k >= 0; k--) {
        cell[k] = (size_t)(k ? rest % along_rest : rest);
        rest /= along_rest;
    }
    for (size_t i = 0; i < out->n; i++) {
        x[0] = koksma__in_cell((double)cell[0], start + width * x[0], m_x);
        for (int k = 1; k < out->dim; k++) {
            x[k] = koksma__in_cell((double)cell[k], start + width * x[k], m_rest);
        }
        x += out->dim;
        for (int k = out->dim - 1; k >= 0 && ++cell[k] == (k ? along_rest : along_x); k--) {
            cell[k] = 0;
        }
    }
}

koksma_status koksma__fill_cells(const char *name, uint64_t seed, const koksma_args *args, double width,
                                 koksma_points *out)
{
    size_t along_x, along_rest;
    const koksma_points whole = {(size_t)args->n, out->dim, NULL};
    const size_t count = out->n * (size_t)out->dim;
    koksma_status status = koksma__cells(name, &whole, args->params[0], &along_x, &along_rest);
    if (!status && width > 0) {
        status = koksma__range_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, args->first * (uint64_t)out->dim,
                                       count, out->xs);
    }
    if (status) {
        return status;
    }
    for (size_t i = 0; i < count && width == 0; i++) {
        out->xs[i] = 0;
    }
    koksma__place_in_cells(args, (1 - width) / 2, width, along_x, along_rest, out);
    return KOKSMA_OK;
}
