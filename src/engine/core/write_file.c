/* SPDX-License-Identifier: Apache-2.0 */
/* Files that are written in one go, above the part of each system (platform/files_posix.c, files_windows.c). */
#include "core/files.h"

#include <stdio.h>

#include "core/status.h"

koksma_status koksma__atomic_put(const char *folder, const char *path, const void *bytes, size_t size)
{
    koksma__atomic_file file;
    KOKSMA__TRY(koksma__atomic_open(folder, path, &file));
    fwrite(bytes, 1, size, file.stream);
    return koksma__atomic_close(&file, true);
}
