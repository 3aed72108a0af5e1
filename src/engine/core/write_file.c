/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A file is written under a temporary name in its target folder, synced, and renamed when it is complete, so that readers
 * and later runs see the old file or the new one. Then the folder is synced: after a power failure the file is either the
 * complete old file or the complete new one; it is the new one if the program had ended with success.
 *
 * The temporary name has 64 random bits, and O_EXCL makes a new file: a file or link that somebody else placed there under
 * the same name is never opened. A process that is killed while it writes leaves its temporary file, which no later run
 * touches.
 */
#define _DEFAULT_SOURCE /* getentropy */
#include "core/files.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __APPLE__
#include <sys/random.h>
#endif
#ifndef _WIN32
#include <sys/statvfs.h>
#endif

#include "core/capacity.h"
#include "core/platform/system.h"
#include "core/status.h"

typedef struct koksma__output {
    char *path;               /* in messages */
    char *target, *temporary; /* of a plain file; temporary is NULL: a stream or device, written in place */
    int descriptor;
    char buffer[1 << 16]; /* of the stream: the default of 4096 bytes makes text a sixth slower */
} output;

/* ---- Opening --------------------------------------------------------------------------------------------- */

/* Replaces a descriptor from 0 to 2 by one above 2 for the same file, because other code writes to the standard
   streams even if they were closed. */
static int above_streams(int descriptor)
{
    if (descriptor < 0 || descriptor > STDERR_FILENO) {
        return descriptor;
    }
    const int other = above_streams(dup(descriptor));
    close(descriptor);
    return other;
}

char *koksma__atomic_target(const char *path)
{
    char to[KOKSMA__MAX_PATH], next[KOKSMA__MAX_PATH];
    char *known = realpath(path, NULL);
    if (known || errno == ELOOP || errno == ENOTDIR) {
        return known;
    }
    const ssize_t length = readlink(path, to, sizeof to - 1);
    if (length < 0) {
        return strdup(path);
    }
    to[length] = '\0'; /* a link to nothing, or to such a link */
    return koksma__path_beside(path, to, next) ? koksma__atomic_target(next) : NULL;
}

/* Whether a folder within `path`, which the program chose below `folder`, is a link. */
static bool leads_away(const char *folder, const char *path)
{
    struct stat info;
    bool is_link = false;
    for (const char *slash = strchr(path, '/'); slash && !is_link; slash = strchr(slash + 1, '/')) {
        char *part = strndup(path, (size_t)(slash - path)), *whole = part ? koksma__path_below(folder, part) : NULL;
        is_link = !whole || (!lstat(whole, &info) && S_ISLNK(info.st_mode));
        KOKSMA__FREE(part, whole);
    }
    return is_link;
}

/* Opens a target that is not a plain file, such as a device or pipe: a temporary file renamed to its name would replace
   it. A stream that is open, such as /dev/fd/3, is written from where it is. Returns false if the target is a plain file
   or does not exist. */
static bool open_special(const char *path, int *descriptor)
{
    struct stat info;
    int stream = !strcmp(path, "-") || !strcmp(path, "/dev/stdout") ? STDOUT_FILENO
                 : !strcmp(path, "/dev/stderr")                     ? STDERR_FILENO
                                                                    : -1;
    if (stream >= 0 || sscanf(path, "/dev/fd/%9d", &stream) == 1 || sscanf(path, "/proc/self/fd/%9d", &stream) == 1) {
        fflush(stdout);
        *descriptor = above_streams(dup(stream));
        return true;
    }
    if (stat(path, &info) || S_ISREG(info.st_mode) || S_ISDIR(info.st_mode)) {
        return false;
    }
    *descriptor = above_streams(open(path, O_WRONLY | O_TRUNC | O_CLOEXEC | O_NOCTTY));
    return true;
}

/* Opens a temporary file beside o->target, with the permissions of an older file there. Returns -1 and sets errno if it
   fails. */
static int open_temporary(output *o)
{
    struct stat info;
    uint64_t random;
    const bool exists = o->target && !lstat(o->target, &info);
    errno = exists && S_ISDIR(info.st_mode) ? EISDIR : errno;
    if (!o->target || (exists && S_ISDIR(info.st_mode)) || getentropy(&random, sizeof random)) {
        return -1;
    }
    const char *slash = koksma__last_slash(o->target);
    const size_t size = strlen(o->target) + 32;
    o->temporary = malloc(size);
    if (!o->temporary) {
        return -1;
    }
    snprintf(o->temporary, size, "%.*s.koksma-%016llx", slash ? (int)(slash + 1 - o->target) : 0, o->target,
             (unsigned long long)random);
    const int descriptor = above_streams(open(o->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (descriptor >= 0 && exists && S_ISREG(info.st_mode)) {
        fchmod(descriptor, info.st_mode & 0777);
    }
    return descriptor;
}

static void end(output *o)
{
    KOKSMA__FREE(o->path, o->target, o->temporary, o);
}

koksma_status koksma__atomic_open(const char *folder, const char *path, koksma__atomic_file *file)
{
    *file = (koksma__atomic_file){0};
    KOKSMA__FAIL_IF(!folder && !*path, KOKSMA_IO, "the path of the file to write is empty");
    output *o = calloc(1, sizeof *o);
    KOKSMA__REQUIRE_MEMORY(o, sizeof *o);
    o->descriptor = -1;
    o->path = koksma__path_below(folder, strcmp(path, "-") ? path : "standard output");
    if (o->path && folder && leads_away(folder, path)) {
        errno = ELOOP;
    } else if (o->path && (folder || !open_special(path, &o->descriptor))) {
        o->target = folder ? strdup(o->path) : koksma__atomic_target(path);
        o->descriptor = open_temporary(o);
    }
    if (o->descriptor >= 0) {
        fcntl(o->descriptor, F_SETFD, FD_CLOEXEC);
        file->stream = fdopen(o->descriptor, "wb");
    }
    if (!file->stream) {
        const int reason = o->path ? errno : ENOMEM;
        if (o->descriptor >= 0) {
            close(o->descriptor);
            unlink(o->temporary ? o->temporary : "");
        }
        koksma__fail(KOKSMA_IO, "%s: can't be written: %s", o->path ? o->path : path,
                     reason == EISDIR            ? "it is a directory"
                     : folder && reason == ELOOP ? "its folder is a symbolic link, which is not followed here"
                                                 : strerror(reason));
        end(o);
        return KOKSMA_IO;
    }
    setvbuf(file->stream, o->buffer, _IOFBF, sizeof o->buffer);
    file->output = o;
    return KOKSMA_OK;
}

uint64_t koksma__atomic_space(const koksma__atomic_file *file)
{
#ifndef _WIN32
    struct statvfs info;
    if (file->output->temporary && !fstatvfs(file->output->descriptor, &info)) {
        return (uint64_t)info.f_bavail * info.f_frsize;
    }
#endif
    (void)file;
    return UINT64_MAX;
}

/* ---- Closing --------------------------------------------------------------------------------------------- */

/* Syncs the folder of a path, if the system can. Returns errno of a disk that failed, or 0. */
static int sync_above(const char *path)
{
    const char *slash = koksma__last_slash(path);
    char *folder = slash ? strndup(path, (size_t)(slash - path + 1)) : strdup(".");
    const int descriptor = folder ? open(folder, O_RDONLY | O_CLOEXEC) : -1;
    const int reason = descriptor >= 0 && fsync(descriptor) && errno == EIO ? EIO : 0;
    if (descriptor >= 0) {
        close(descriptor);
    }
    free(folder);
    return reason;
}

koksma_status koksma__atomic_folder(const char *path)
{
    KOKSMA__FAIL_IF(!*path, KOKSMA_IO, "the path of the folder is empty");
    KOKSMA__FAIL_IF(mkdir(path, 0777) && errno != EEXIST, KOKSMA_IO, "%s: can't be made: %s", path, strerror(errno));
    const int reason = sync_above(path);
    return reason ? koksma__fail(KOKSMA_IO, "%s: can't be synced: %s", path, strerror(reason)) : KOKSMA_OK;
}

/* Returns why writing to a stream failed, or 0. If stdio has lost the reason, another byte tells it. */
static int write_error(FILE *stream)
{
    errno = 0;
    if (!fflush(stream) && !ferror(stream)) {
        return 0;
    }
    if (!errno) {
        putc('\n', stream);
        fflush(stream);
    }
    return errno ? errno : EIO;
}

koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep)
{
    output *o = file->output;
    koksma_status status = KOKSMA_OK;
    if (!o) {
        return status;
    }
    const char *what = "writing failed";
    int reason = write_error(file->stream);
    bool placed = false;
    if (o->temporary && keep && !reason && fsync(o->descriptor)) {
        reason = errno;
    }
    reason = fclose(file->stream) && !reason ? errno : reason;
    if (o->temporary && keep && !reason) {
        placed = !rename(o->temporary, o->target);
        what = placed ? what : "can't be written";
        reason = placed ? sync_above(o->target) : errno;
    }
    if (o->temporary && !placed) {
        unlink(o->temporary);
    }
    if (keep && reason) {
        status = koksma__fail(KOKSMA_IO, "%s: %s: %s", o->path, what, strerror(reason));
    }
    end(o);
    *file = (koksma__atomic_file){0};
    return status;
}

koksma_status koksma__atomic_put(const char *folder, const char *path, const void *bytes, size_t size)
{
    koksma__atomic_file file;
    KOKSMA__TRY(koksma__atomic_open(folder, path, &file));
    fwrite(bytes, 1, size, file.stream);
    return koksma__atomic_close(&file, true);
}
