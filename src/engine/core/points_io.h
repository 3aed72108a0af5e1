/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_POINTS_IO_H
#define KOKSMA_CORE_POINTS_IO_H

#include <stdio.h>

#include <koksma/koksma.h>

#include "core/atomic_file.h"
#include "core/read_file.h"
#include "core/visibility.h"

/* Does the same as koksma_points_read; `by` tells who named the file and thus which kinds of files may be opened
   (core/read_file.h). */
koksma_status koksma__points_read(const char *path, koksma__named by, koksma_points *points);

/* A file of n points that is written piece by piece, in the format given by the ending of its name. Coordinates may
   be any numbers. */
typedef struct koksma__points_writer {
    koksma__atomic_file file;
    enum { KOKSMA__POINTS_TEXT, KOKSMA__POINTS_CSV, KOKSMA__POINTS_NPY } format;
    uint64_t n, done;
} koksma__points_writer;

/* Opens the file and writes the header before the points. Errors: IO, MEMORY. */
koksma_status koksma__writer_open(const char *path, uint64_t n, int dim, const char *comment,
                                  koksma__points_writer *writer);

/* Writes more points. After a write has failed, further calls do nothing; koksma__writer_close reports the failure.
   Error: INTERRUPTED if run->keep_going returned false. */
koksma_status koksma__writer_put(koksma__points_writer *writer, const koksma_points *points, const koksma_run *run);

/* Closes the file. If status is OK, the new file takes its final name; otherwise an older file of that name stays.
   Returns status, or IO. */
koksma_status koksma__writer_close(koksma__points_writer *writer, koksma_status status);

/* Writes all rows with one call, like koksma_points_write, but does not check that coordinates are in [0,1]. */
koksma_status koksma__numbers_write(const char *path, const koksma_points *rows, const char *comment,
                                    const koksma_run *run);

#endif
