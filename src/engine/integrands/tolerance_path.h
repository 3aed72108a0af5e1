/* SPDX-License-Identifier: Apache-2.0 */
/* The steps of an integration to a tolerance, and the file that keeps them. */
#ifndef KOKSMA_INTEGRANDS_TOLERANCE_PATH_H
#define KOKSMA_INTEGRANDS_TOLERANCE_PATH_H

#include <koksma/estimate.h>

#include "core/sum.h"

typedef struct koksma__search_step {
    uint64_t points;       /* function values so far */
    double least, largest; /* of them */
    double *means;         /* of each set */
} koksma__search_step;

typedef struct koksma__search {
    size_t sets, first_n, n_steps;
    koksma__search_step steps[KOKSMA_MAX_STEPS];
    koksma__sum *sums;              /* of the values of each set, after the last step */
    char head[4 * KOKSMA_MAX_SPEC]; /* what identifies the search: the first lines of its file */
} koksma__search;

/* Sets the head. first: the function's value at the first point. */
void koksma__search_head(koksma__search *path, const char *function, const char *pattern, int dim, uint64_t seed,
                         bool parts, double first);

/* Reads the steps of a file with the same head; none if there is no file. Errors: ARGUMENT (another search), MALFORMED,
   MEMORY. */
koksma_status koksma__search_read(const char *file, koksma__search *path);

/* Writes the file, whole or not at all. Errors: IO, MEMORY. */
koksma_status koksma__search_write(const char *file, const koksma__search *path);

void koksma__search_fini(koksma__search *path);

#endif
