/* SPDX-License-Identifier: Apache-2.0 */
/* Point files as text and CSV. */
#ifndef KOKSMA_CORE_POINTS_TEXT_H
#define KOKSMA_CORE_POINTS_TEXT_H

#include <koksma/koksma.h>
#include <stdio.h>

/* The progress of a file that is written in several calls: `done` is the fraction of its points that was written
   before this call, `share` the fraction that this call writes. */
typedef struct koksma__progress {
    const koksma_run *run;
    double done, share;
} koksma__progress;

/* Reads points. Error messages call the stream `name`. On failure points is left empty. */
koksma_status koksma__points_read_text(FILE *stream, const char *name, koksma_points *points);

/* Writes the header, which is before the points. */
void koksma__points_begin_text(FILE *stream, uint64_t n, int dim, const char *comment);

/* Writes points, one in each line. Errors: INTERRUPTED. */
koksma_status koksma__points_put_rows(FILE *stream, const koksma_points *points, char separator,
                                      koksma__progress progress);

#endif
