/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Files of points: the first byte tells NumPy's format (points_npy.c) from text (points_text.c) when reading, the
 * ending of the name when writing.
 */
#include "core/points_io.h"

#include <math.h>
#include <string.h>

#include "core/atomic_file.h"
#include "core/status.h"

koksma_status koksma__points_read(const char *path, koksma__named by, koksma_points *points)
{
    FILE *stream;
    *points = (koksma_points){0};
    KOKSMA__TRY(koksma__file_open(path, KOKSMA__FILE_POINTS, by, &stream));
    const char *name = stream == stdin ? "standard input" : path;
    const int first = getc(stream); /* the first byte of "\x93NUMPY"; no text begins with it */
    ungetc(first, stream);
    const koksma_status status = first == 0x93 ? koksma__points_read_npy(stream, name, points)
                                               : koksma__points_read_text(stream, name, points);
    koksma__file_close(stream);
    return status;
}

koksma_status koksma_points_read(const char *path, koksma_points *points)
{
    KOKSMA__REQUIRE(path, points);
    return koksma__points_read(path, KOKSMA__BY_USER, points);
}

static bool ends_with(const char *text, const char *end)
{
    const size_t n = strlen(text), m = strlen(end);
    return n >= m && !strcmp(text + n - m, end);
}

koksma_status koksma_points_write(const char *path, const koksma_points *points, const char *comment,
                                  const koksma_run *run)
{
    KOKSMA__REQUIRE(path, points);
    KOKSMA__REQUIRE_RUN(run);
    const koksma_status status = koksma__points_check(points);
    return status ? status : koksma__numbers_write(path, points, comment, run);
}

koksma_status koksma_points_write_mapped(const char *path, const koksma_points *points, const char *comment,
                                         const koksma_run *run)
{
    KOKSMA__REQUIRE(path, points);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!points->xs || points->n == 0, KOKSMA_ARGUMENT, "there are no points to write");
    KOKSMA__TRY(koksma__points_fit(points->n, points->dim));
    for (size_t i = 0; i < points->n * (size_t)points->dim; i++) {
        KOKSMA__FAIL_IF(!isfinite(points->xs[i]), KOKSMA_ARGUMENT, "point %zu: a coordinate is not finite",
                        i / (size_t)points->dim);
    }
    return koksma__numbers_write(path, points, comment, run);
}

koksma_status koksma__numbers_write(const char *path, const koksma_points *points, const char *comment,
                                    const koksma_run *run)
{
    koksma__atomic_file file;
    KOKSMA__TRY(koksma__atomic_open(NULL, path, &file));
    koksma_status status = KOKSMA_OK;
    if (ends_with(path, ".npy")) {
        status = koksma__points_write_npy(file.stream, points, run);
    } else if (ends_with(path, ".csv")) {
        status = koksma__points_write_csv(file.stream, points, run);
    } else {
        status = koksma__points_write_text(file.stream, points, comment, run);
    }
    const koksma_status closed = koksma__atomic_close(&file, !status);
    return status ? status : closed;
}
