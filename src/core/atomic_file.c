/* SPDX-License-Identifier: Apache-2.0 */
#include "core/atomic_file.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/status.h"

enum { MOST_OF_NAME = 100 };

/* Names that end alike stay alike, because libraries choose a format by the ending: out.png ->
   .koksma-1234-0-out.png. Two threads that write one path have two of them. */
static char *temporary_name(const char *path)
{
    static atomic_uint count;
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const int folder = (int)(name - path);
    const size_t length = strlen(name), size = strlen(path) + 60;
    char *temporary = malloc(size);
    if (temporary) {
        snprintf(temporary, size, "%.*s.koksma-%ld-%u-%s", folder, path, (long)getpid(), atomic_fetch_add(&count, 1),
                 name + (length > MOST_OF_NAME ? length - MOST_OF_NAME : 0));
    }
    return temporary;
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
    /* What a link leads to is replaced, not the link. */
    char *target = special ? NULL : realpath(path, NULL);
    file->path = target ? target : strdup(path);
    file->temporary = special || !file->path ? strdup(path) : temporary_name(file->path);
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
    if (target) {
        fchmod(fileno(file->stream), info.st_mode & 07777); /* a private file stays private */
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
