/* SPDX-License-Identifier: Apache-2.0 */
/* The path of a study's results. */
#ifndef KOKSMA_STUDY_RUN_RESULTS_PATH_H
#define KOKSMA_STUDY_RUN_RESULTS_PATH_H

#include <koksma/koksma.h>

/* The capacity for paths in a study's folder. */
enum { KOKSMA__PATH = 1200 };

/* Writes the path of the results in a study's folder. Errors: ARGUMENT (the folder's name is too long). */
koksma_status koksma__results_path(const char *folder, char path[KOKSMA__PATH]);

#endif
