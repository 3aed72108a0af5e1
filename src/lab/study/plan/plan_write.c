/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the plan of a program that makes plans into a study's folder. The text is checked before anything is written,
   and an existing file is never replaced: it may be a user's own plan. The name is the program's choice, so that a
   link there is not followed (core/files.h). */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <koksma/study.h>

#include "core/files.h"
#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"

static const char file_name[] = "plan.json";

/* Sets *there to whether the file exists. Fails unless it then has exactly this text. */
static koksma_status compare(const char *path, const char *text, bool *there)
{
    struct stat info;
    unsigned char *found = NULL;
    size_t size = 0;
    *there = !lstat(path, &info);
    if (!*there) {
        return errno == ENOENT || errno == ENOTDIR
                   ? KOKSMA_OK
                   : koksma__fail(KOKSMA_IO, "%s: can't be read: %s", path, strerror(errno));
    }
    KOKSMA__FAIL_IF(!S_ISREG(info.st_mode), KOKSMA_ARGUMENT,
                    "%s: it is not a plain file, and is not replaced; use another folder", path);
    bool same = (unsigned long long)info.st_size == strlen(text);
    if (same) {
        KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_PLAN, KOKSMA__BY_FILE, NULL, &found, &size));
        same = size == strlen(text) && !memcmp(found, text, size);
    }
    free(found);
    return same ? KOKSMA_OK
                : koksma__fail(KOKSMA_ARGUMENT,
                               "%s: the folder has another plan, which is not replaced; use another folder", path);
}

koksma_status koksma_plan_write(const char *folder, const char *text, bool *made)
{
    bool here = false;
    if (made) {
        *made = false;
    }
    KOKSMA__REQUIRE(folder, text);
    KOKSMA__FAIL_IF(!*folder, KOKSMA_ARGUMENT, "the folder's name is empty");
    koksma__plan plan;
    bool there;
    const size_t size = strlen(folder) + sizeof file_name + 1;
    char *path = malloc(size);
    KOKSMA__REQUIRE_MEMORY(path, size);
    snprintf(path, size, "%s/%s", folder, file_name);
    koksma_status status = koksma__plan_parse(path, text, strlen(text), NULL, &plan);
    koksma__plan_fini(&plan);
    status = status ? status : compare(path, text, &there);
    if (!status && !there) {
        status = koksma__atomic_folder(folder);
        status = status ? status : koksma__atomic_put_new(folder, file_name, text, strlen(text), &here);
        status = status || here ? status : compare(path, text, &there); /* another process was faster */
    }
    free(path);
    if (made) {
        *made = here;
    }
    return status;
}
