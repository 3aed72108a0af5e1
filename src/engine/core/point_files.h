/* SPDX-License-Identifier: Apache-2.0 */
/* Files of points, and NumPy's format .npy, of which this is the only writer: the header, and numbers as little-endian
   bytes on any machine. */
#ifndef KOKSMA_CORE_POINT_FILES_H
#define KOKSMA_CORE_POINT_FILES_H

#include <koksma/koksma.h>

#include <stdint.h>
#include <stdio.h>

#include "core/files.h"
#include "core/visibility.h"

/* Does the same as koksma_points_read or, if mapped, koksma_points_read_mapped; `by` tells who named the file and
   thus which kinds of files may be opened (core/files.h). */
koksma_status koksma__points_read(const char *path, koksma__named by, bool mapped, koksma_points *points);

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

/* ---- Text and CSV ---- */

/* The progress of a file that is written in several calls: `done` is the fraction of its points that was written
   before this call, `share` the fraction that this call writes. */
typedef struct koksma__progress {
    const koksma_run *run;
    double done, share;
} koksma__progress;

/* Reads points. Error messages call the stream `name`. mapped: coordinates may be any finite numbers, not only those in
   [0,1]. On failure points is left empty. */
koksma_status koksma__points_read_text(FILE *stream, const char *name, bool mapped, koksma_points *points);

/* Writes the header, which is before the points. */
void koksma__points_begin_text(FILE *stream, uint64_t n, int dim, const char *comment);

/* Writes points, one in each line. Errors: INTERRUPTED. */
koksma_status koksma__points_put_rows(FILE *stream, const koksma_points *points, char separator,
                                      koksma__progress progress);

/* ---- NumPy's .npy ---- */

/* Reads points. Error messages call the stream `name`. mapped: coordinates may be any finite numbers, not only those in
   [0,1]. On failure points is left empty. */
koksma_status koksma__points_read_npy(FILE *stream, const char *name, bool mapped, koksma_points *points);

/* Reads a mask: an array of shape (height, width) or (height, width, numbers), of up to `most` pixels a side and 4 numbers;
   shape[2] is 1 for the first. An unsigned integer of b bits becomes the middle of its interval, (k + 1/2) / 2^b. The
   caller frees *numbers. Errors: MISSING, MALFORMED, MEMORY, SYSTEM. */
KOKSMA__LAB koksma_status koksma__npy_read_mask(const char *path, koksma__named by, size_t most, size_t shape[3],
                                                float **numbers);

/* Writes the points that follow the header. Errors: INTERRUPTED. */
koksma_status koksma__points_put_npy(FILE *stream, const koksma_points *points, koksma__progress progress);

enum { KOKSMA__NPY_HEADER = 1024 }; /* longest dictionary */

/* Writes the header (version 1.0) of an array in C order: descr and shape are Python literals, such as "'<f8'" and
   "(10, 2)". Together these two texts may have at most KOKSMA__NPY_HEADER - 64 characters. */
KOKSMA__LAB void koksma__npy_put_header(FILE *stream, const char *descr, const char *shape);

/* Stores a 64-bit word in 8 bytes, lowest byte first. */
static inline void koksma__npy_set_word(unsigned char bytes[8], uint64_t word)
{
    for (int i = 0; i < 8; i++) {
        bytes[i] = (unsigned char)(word >> (8 * i));
    }
}

#endif
