/* SPDX-License-Identifier: Apache-2.0 */
/* Files that are written in one go, above the part of each system (platform/files_posix.c, files_windows.c). */
#include "core/files.h"

#include <stdio.h>

#include "core/status.h"

static koksma_status put_file(const char *folder, const char *path, const void *bytes, size_t size, bool *made)
{
    koksma__atomic_file file;
    const koksma_status status = koksma__atomic_open(folder, path, &file);
    if (!status) {
        koksma__atomic_keep_old(&file, made);
        fwrite(bytes, 1, size, file.stream);
    }
    return status ? status : koksma__atomic_close(&file, true);
}

koksma_status koksma__atomic_put(const char *folder, const char *path, const void *bytes, size_t size)
{
    return put_file(folder, path, bytes, size, NULL);
}

koksma_status koksma__atomic_put_new(const char *folder, const char *path, const void *bytes, size_t size, bool *made)
{
    *made = false;
    return put_file(folder, path, bytes, size, made);
}
