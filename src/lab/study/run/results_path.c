/* SPDX-License-Identifier: Apache-2.0 */
/* The path of a study's results, and the limit on the length of its folder's name. */
#include "study/run/results_path.h"

#include <stdio.h>
#include <string.h>

#include "core/status.h"

/* Other paths in the folder add up to 30 bytes, so that all fit into KOKSMA__PATH and nearly all systems accept them. */
enum { LONGEST_FOLDER = 1000 };

koksma_status koksma__results_path(const char *folder, char path[KOKSMA__PATH])
{
    KOKSMA__FAIL_IF(strlen(folder) > LONGEST_FOLDER, KOKSMA_ARGUMENT,
                    "the name of a study's folder is longer than %d bytes: %.40s...", LONGEST_FOLDER, folder);
    KOKSMA__FAIL_IF(!*folder, KOKSMA_ARGUMENT, "the name of a study's folder is empty");
    snprintf(path, KOKSMA__PATH, "%s/results.sqlite", folder);
    return KOKSMA_OK;
}
