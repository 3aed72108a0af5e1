/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_POINTS_IO_H
#define KOKSMA_CORE_POINTS_IO_H

#include <stdio.h>

#include <koksma/koksma.h>

#include "core/atomic_file.h"
#include "core/read_file.h"
#include "core/visibility.h"

/* An error unless dim is a number of dimensions and n points of so many fit into one set. Errors: ARGUMENT, DIM. */
koksma_status koksma__points_fit(size_t n, int dim);

/* An error unless there are points, they fit, and each coordinate is in [0,1] (NaN is not): what every public
   function that takes points and has no other rule asks first. Errors: ARGUMENT, DIM. */
KOKSMA__LAB koksma_status koksma__points_check(const koksma_points *points);

/* koksma_points_read, and who named the file. */
koksma_status koksma__points_read(const char *path, koksma__named by, koksma_points *points);

/* Readers by format. `name` is what errors call the source. On failure points is left empty. */
koksma_status koksma__points_read_text(FILE *stream, const char *name, koksma_points *points);
koksma_status koksma__points_read_npy(FILE *stream, const char *name, koksma_points *points);

/* A file of n points that is written piece by piece, by the ending of its name. Any numbers are accepted. */
typedef struct koksma__points_writer {
    koksma__atomic_file file;
    enum { KOKSMA__POINTS_TEXT, KOKSMA__POINTS_CSV, KOKSMA__POINTS_NPY } format;
    uint64_t n, done;
} koksma__points_writer;

/* Opens the file and writes what comes before the points. Errors: IO, MEMORY. */
koksma_status koksma__writer_open(const char *path, uint64_t n, int dim, const char *comment,
                                  koksma__points_writer *writer);

/* Adds points, until writing fails, which closing reports. Error: INTERRUPTED, when run's progress function says so. */
koksma_status koksma__writer_put(koksma__points_writer *writer, const koksma_points *points, const koksma_run *run);

/* Puts the file in its place if status is OK; else leaves what was there. Returns status, or IO. */
koksma_status koksma__writer_close(koksma__points_writer *writer, koksma_status status);

/* All of it at once: koksma_points_write without the check for points outside [0,1]. */
koksma_status koksma__numbers_write(const char *path, const koksma_points *rows, const char *comment,
                                    const koksma_run *run);

/* The parts of the formats: what comes before the points, and points. `progress` is the share of all that was done
   before these points, and `share` is theirs. */
typedef struct koksma__progress {
    const koksma_run *run;
    double done, share;
} koksma__progress;

void koksma__points_begin_text(FILE *stream, uint64_t n, int dim, const char *comment);
koksma_status koksma__points_put_rows(FILE *stream, const koksma_points *points, char separator,
                                      koksma__progress progress);
koksma_status koksma__points_put_npy(FILE *stream, const koksma_points *points, koksma__progress progress);

#endif
