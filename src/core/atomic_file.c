/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A file is written under a temporary name beside its own and renamed when it is whole (POSIX rename is atomic), so
 * that readers and later runs see the old file or the new one. Standard streams and paths such as /dev/fd/3 are
 * written as they are. fsync before the rename keeps an empty file from surviving a crash.
 */
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

/* The stream that the process has open under such a path already, "/dev/stdout" or "/dev/fd/3": where it leads to a
   file, that has what others wrote, and what they write next goes on behind. -1: another path. */
static int descriptor_of(const char *path)
{
    int number = -1, used = 0;
    if (!strcmp(path, "/dev/stdout") || !strcmp(path, "/dev/stderr")) {
        return path[8] == 'o' ? STDOUT_FILENO : STDERR_FILENO;
    }
    const bool numbered = sscanf(path, "/dev/fd/%9d%n", &number, &used) == 1 ||
                          sscanf(path, "/proc/self/fd/%9d%n", &number, &used) == 1;
    return numbered && used > 0 && !path[used] ? number : -1;
}

/* Where a link leads that leads to no file yet; NULL for what is no such link. */
static char *new_target(const char *path)
{
    char to[4096];
    const ssize_t length = readlink(path, to, sizeof to - 1);
    if (length < 0) {
        return NULL;
    }
    to[length] = '\0';
    const char *slash = strrchr(path, '/');
    const int folder = slash && to[0] != '/' ? (int)(slash + 1 - path) : 0;
    const size_t size = (size_t)folder + (size_t)length + 1;
    char *target = malloc(size);
    if (target) {
        snprintf(target, size, "%.*s%s", folder, path, to);
    }
    return target;
}

koksma_status koksma__atomic_open(const char *path, koksma__atomic_file *file)
{
    *file = (koksma__atomic_file){0};
    const int descriptor = descriptor_of(path);
    if (!strcmp(path, "-") || descriptor == STDOUT_FILENO) {
        file->stream = stdout;
        return KOKSMA_OK;
    }
    struct stat info;
    if (!stat(path, &info) && S_ISDIR(info.st_mode)) {
        return koksma__fail(KOKSMA_IO, "%s: can't be written: it is a directory", path);
    }
    /* A device or a pipe is written directly: renaming over it would replace it. */
    const bool special = descriptor >= 0 || (!stat(path, &info) && !S_ISREG(info.st_mode));
    /* What a link leads to is replaced, not the link. */
    char *target = special ? NULL : realpath(path, NULL);
    file->path = target ? target : special ? strdup(path) : new_target(path);
    file->path = file->path ? file->path : strdup(path);
    file->temporary = special || !file->path ? strdup(path) : temporary_name(file->path);
    if (!file->path || !file->temporary) {
        koksma__atomic_close(file, false);
        return koksma__fail_memory(strlen(path));
    }
    file->stream = descriptor >= 0 ? fdopen(dup(descriptor), "wb") : fopen(file->temporary, "wb");
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
