/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Digital sequences in base 2. 2^m points are the first points of a digital sequence if and only if point 0 is the
 * origin and, for every c < m and 0 < r < 2^c, the digits of point 2^c + r are the sums modulo 2 of the digits of
 * points 2^c and r (Niederreiter 1992). The digits of coordinate k of point 2^c are then column c of the generator
 * matrix of coordinate k. So searches exchange only points; the matrices can be recovered from the points.
 */
#include "optimise/search.h"

#include <inttypes.h>
#include <string.h>

#include "core/files.h"
#include "core/point_files.h"
#include "core/points.h"
#include "core/status.h"

static uint64_t digits_of(double x)
{
    return (uint64_t)(x * 0x1p53);
}

koksma_status koksma__sequence_check(const koksma_points *points)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    KOKSMA__FAIL_IF(n < 2 || (n & (n - 1)) != 0, KOKSMA_N,
                    "n = %zu: a sequence takes a power of 2 from 2 on, such as 256", n);
    for (size_t i = 0, high = 0; i < n; i++) {
        high = (i & (i - 1)) == 0 ? i : high;
        for (size_t k = 0; k < dim; k++) {
            const uint64_t sum = digits_of(points->xs[high * dim + k]) ^ digits_of(points->xs[(i - high) * dim + k]);
            KOKSMA__FAIL_IF(points->xs[i * dim + k] != (double)sum * 0x1p-53, KOKSMA_ARGUMENT,
                            "point %zu: the points are not the first points of a digital sequence in base 2, such as "
                            "sobol or net-file",
                            i);
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma_net_write(const char *path, const koksma_points *points, const char *comment)
{
    KOKSMA__REQUIRE(path, points);
    KOKSMA__TRY(koksma__points_check(points));
    KOKSMA__TRY(koksma__sequence_check(points));
    koksma__atomic_file file;
    int columns = 0;
    for (size_t n = points->n; n > 1; n /= 2) {
        columns++;
    }
    KOKSMA__TRY(koksma__atomic_open(NULL, path, &file));
    fputs("# dnet\n", file.stream);
    for (const char *line = comment; line && *line;) {
        const size_t length = strcspn(line, "\n");
        fprintf(file.stream, "# %.*s\n", (int)length, line);
        line += length + (line[length] == '\n');
    }
    fprintf(file.stream, "2 # base\n%d # dimensions\n%d # columns: 2^%d points\n%d # digits\n", points->dim, columns,
            columns, KOKSMA__SEQUENCE_DIGITS);
    for (size_t k = 0; k < (size_t)points->dim; k++) {
        for (int c = 0; c < columns; c++) {
            const double x = points->xs[((size_t)1 << c) * (size_t)points->dim + k];
            fprintf(file.stream, "%" PRIu64 "%c", digits_of(x), c + 1 < columns ? ' ' : '\n');
        }
    }
    return koksma__atomic_close(&file, true);
}
