/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Files of points. When reading, the first byte distinguishes NumPy's format (points_npy.c) from text
 * (points_text.c); when writing, the ending of the file's name chooses the format.
 */
#include "core/point_files.h"

#include <math.h>
#include <string.h>

#include "core/points.h"
#include "core/status.h"

koksma_status koksma__points_read(const char *path, koksma__named by, bool mapped, koksma_points *points)
{
    FILE *stream;
    *points = (koksma_points){0};
    KOKSMA__TRY(koksma__file_open(path, KOKSMA__FILE_POINTS, by, &stream));
    const char *name = stream == stdin ? "standard input" : path;
    const int first = getc(stream); /* first byte of "\x93NUMPY"; no text file begins with this byte */
    ungetc(first, stream);
    const koksma_status status = first == 0x93 ? koksma__points_read_npy(stream, name, mapped, points)
                                               : koksma__points_read_text(stream, name, mapped, points);
    koksma__file_close(stream);
    return status;
}

koksma_status koksma_points_read(const char *path, koksma_points *points)
{
    KOKSMA__REQUIRE(path, points);
    return koksma__points_read(path, KOKSMA__BY_USER, false, points);
}

koksma_status koksma_points_read_mapped(const char *path, koksma_points *points)
{
    KOKSMA__REQUIRE(path, points);
    return koksma__points_read(path, KOKSMA__BY_USER, true, points);
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

koksma_status koksma__writer_open(const char *path, uint64_t n, int dim, const char *comment,
                                  koksma__points_writer *writer)
{
    *writer = (koksma__points_writer){.format = ends_with(path, ".npy")   ? KOKSMA__POINTS_NPY
                                                : ends_with(path, ".csv") ? KOKSMA__POINTS_CSV
                                                                          : KOKSMA__POINTS_TEXT,
                                      .n = n};
    KOKSMA__TRY(koksma__atomic_open(NULL, path, &writer->file));
    const uint64_t least = writer->format == KOKSMA__POINTS_NPY ? sizeof(double) : 2; /* bytes a coordinate: "0 " */
    const double needed = (double)n * (double)dim * (double)least;
    const double left = (double)koksma__atomic_space(&writer->file);
    if (needed > left) {
        koksma__atomic_close(&writer->file, false);
        return koksma__fail(KOKSMA_IO, "%s: can't be written: it needs at least %.3g GB, and the disk has %.3g GB",
                            path, needed / 1e9, left / 1e9);
    }
    if (writer->format == KOKSMA__POINTS_NPY) {
        char shape[64];
        snprintf(shape, sizeof shape, "(%llu, %d)", (unsigned long long)n, dim);
        koksma__npy_put_header(writer->file.stream, "'<f8'", shape);
    } else if (writer->format == KOKSMA__POINTS_CSV) {
        for (int k = 0; k < dim; k++) {
            fprintf(writer->file.stream, "x%d%c", k, k + 1 < dim ? ',' : '\n');
        }
    } else {
        koksma__points_begin_text(writer->file.stream, n, dim, comment);
    }
    return KOKSMA_OK;
}

koksma_status koksma__writer_put(koksma__points_writer *writer, const koksma_points *points, const koksma_run *run)
{
    const double n = (double)writer->n;
    const koksma__progress progress = {run, (double)writer->done / n, (double)points->n / n};
    writer->done += points->n;
    return writer->format == KOKSMA__POINTS_NPY
               ? koksma__points_put_npy(writer->file.stream, points, progress)
               : koksma__points_put_rows(writer->file.stream, points,
                                         writer->format == KOKSMA__POINTS_CSV ? ',' : ' ', progress);
}

koksma_status koksma__writer_close(koksma__points_writer *writer, koksma_status status)
{
    const koksma_status closed = koksma__atomic_close(&writer->file, !status);
    return status ? status : closed;
}

koksma_status koksma__numbers_write(const char *path, const koksma_points *points, const char *comment,
                                    const koksma_run *run)
{
    koksma__points_writer writer;
    KOKSMA__TRY(koksma__writer_open(path, points->n, points->dim, comment, &writer));
    return koksma__writer_close(&writer, koksma__writer_put(&writer, points, run));
}
