/* SPDX-License-Identifier: Apache-2.0 */
#include "core/atomic_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/status.h"

/* Names that end alike stay alike, because libraries choose a format by the ending: out.png -> .koksma-1234-out.png
 */
static char *temporary_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    const size_t folder = slash ? (size_t)(slash - path) + 1 : 0;
    const size_t size = strlen(path) + 40;
    char *name = malloc(size);
    if (name) {
        snprintf(name, size, "%.*s.koksma-%ld-%s", (int)folder, path, (long)getpid(), path + folder);
    }
    return name;
}

koksma_status koksma__atomic_open(const char *path, koksma__atomic_file *file)
{
    *file = (koksma__atomic_file){0};
    if (!strcmp(path, "-")) {
        file->stream = stdout;
        return KOKSMA_OK;
    }
    struct stat info;
    if (!stat(path, &info) && S_ISDIR(info.st_mode)) {
        return koksma__fail(KOKSMA_IO, "%s: can't be written: it is a directory", path);
    }
    /* A device or a pipe is written directly: renaming over it would replace it. */
    const bool special = !stat(path, &info) && !S_ISREG(info.st_mode);
    file->path = strdup(path);
    file->temporary = special ? strdup(path) : temporary_name(path);
    if (!file->path || !file->temporary) {
        koksma__atomic_close(file, false);
        return koksma__fail_memory(strlen(path));
    }
    file->stream = fopen(file->temporary, "wb");
    if (!file->stream) {
        const int reason = errno;
        free(file->path);
        free(file->temporary);
        *file = (koksma__atomic_file){0};
        return koksma__fail(KOKSMA_IO, "%s: can't be written: %s", path, strerror(reason));
    }
    return KOKSMA_OK;
}

koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep)
{
    koksma_status status = KOKSMA_OK;
    const char *name = file->path ? file->path : "standard output";
    errno = 0;
    if (file->stream) {
        bool failed = ferror(file->stream) != 0;
        failed |= fflush(file->stream) != 0;
        if (file->path) {
            failed |= keep && strcmp(file->path, file->temporary) != 0 && fsync(fileno(file->stream)) != 0;
            failed |= fclose(file->stream) != 0;
        }
        if (failed && keep) {
            status = koksma__fail(KOKSMA_IO, "%s: writing failed: %s", name, strerror(errno ? errno : EIO));
        }
    }
    if (file->path && file->temporary && strcmp(file->path, file->temporary) != 0) {
        if (keep && !status && rename(file->temporary, file->path)) {
            status = koksma__fail(KOKSMA_IO, "%s: can't be written: %s", name, strerror(errno));
        }
        if (!keep || status) {
            remove(file->temporary);
        }
    }
    free(file->path);
    free(file->temporary);
    *file = (koksma__atomic_file){0};
    return status;
}
