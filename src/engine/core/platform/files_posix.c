/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A file is written under a temporary name in its target folder, synced, and renamed when it is complete (POSIX
 * rename is atomic), so that readers and later runs see the old file or the new one. Then the folder is synced. After
 * a power failure the file is either the complete old file or the complete new one; it is the new one if the program
 * had ended with success. A power failure can destroy a new folder and its contents if the parent folder was not
 * synced. Therefore this file also syncs the parent of each folder that it makes.
 *
 * The temporary name has 64 random bits, and O_EXCL makes a new file: a file that somebody else placed there under
 * the same name is never opened. A process number in the name would not be unique, because processes in different
 * containers often have equal numbers. All steps use the folder's descriptor, which refers to the same folder even
 * when a folder above it is renamed. A process that is killed while it writes leaves its temporary file, which no later
 * run touches.
 */
#ifndef _WIN32
#define _GNU_SOURCE /* fopencookie, getentropy, O_PATH */
#include "core/files.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>
#ifdef __APPLE__
#include <sys/random.h>
#endif

#include "core/capacity.h"
#include "core/status.h"

/* What macOS lacks or calls otherwise. */
#ifdef __APPLE__
#define O_PATH O_RDONLY
#endif

enum { MOST_LINKS = 40 /* as Linux follows */ };

typedef struct koksma__output {
    char *path, *name; /* path: name of the file in messages; name: its name within the folder */
    char temporary[32];
    int folder; /* descriptor of the folder; -1: the target is not a plain file */
    int descriptor;
    int reason; /* errno of the first write that failed */
} output;

#ifdef __APPLE__
typedef int counted; /* of bytes: funopen's functions */
typedef int count;
#else
typedef ssize_t counted;
typedef size_t count;
#endif

/* Writes bytes and stores errno of the first failure, which stdio would lose. */
static counted put(void *cookie, const char *bytes, count size)
{
    output *o = cookie;
    size_t done = 0;
    while (done < (size_t)size && !o->reason) {
        const ssize_t n = write(o->descriptor, bytes + done, (size_t)size - done);
        done += n > 0 ? (size_t)n : 0;
        o->reason = n < 0 && errno != EINTR ? errno : 0;
    }
    return (counted)done;
}

static FILE *open_stream(output *o)
{
#ifdef __APPLE__
    return funopen(o, NULL, put, NULL, NULL);
#else
    static const cookie_io_functions_t functions = {.write = put};
    return fopencookie(o, "w", functions);
#endif
}

/* fsync of macOS leaves the bytes in the disk's own memory. */
static int sync_file(int descriptor)
{
#ifdef __APPLE__
    return fcntl(descriptor, F_FULLFSYNC) ? fsync(descriptor) : 0;
#else
    return fsync(descriptor);
#endif
}

/* ---- Opening --------------------------------------------------------------------------------------------- */

/* Opens a folder, with O_PATH if the folder may be written but not read. */
static int open_folder(int at, const char *path, int flags)
{
    const int folder = openat(at, path, O_RDONLY | O_DIRECTORY | O_CLOEXEC | flags);
    return folder < 0 && errno == EACCES ? openat(at, path, O_PATH | O_DIRECTORY | O_CLOEXEC | flags) : folder;
}

/* Replaces a descriptor from 0 to 2 by one above 2 for the same file, because other code writes to the standard
   streams even if they were closed. */
static int above_streams(int descriptor)
{
    if (descriptor < 0 || descriptor > STDERR_FILENO) {
        return descriptor;
    }
    const int other = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(descriptor);
    return other;
}

/* Makes a new temporary file. If it fails, it returns false and sets errno. */
static bool make_temporary(output *o)
{
    unsigned long long random = 0;
    if (getentropy(&random, sizeof random)) {
        return false;
    }
    snprintf(o->temporary, sizeof o->temporary, ".koksma-%016llx", random);
    o->descriptor =
        above_streams(openat(o->folder, o->temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    return o->descriptor >= 0;
}

/* Returns the number of the descriptor that a path such as "/dev/stdout" or "/dev/fd/3" names; -1 for any other path.
   Output to such a path uses the open descriptor: if it was redirected to a file, the earlier contents of the file
   remain, and new output is appended. */
static int descriptor_of(const char *path)
{
    int number = -1, used = 0;
    if (!strcmp(path, "-") || !strcmp(path, "/dev/stdout") || !strcmp(path, "/dev/stderr")) {
        return !strcmp(path, "/dev/stderr") ? STDERR_FILENO : STDOUT_FILENO;
    }
    const bool numbered = sscanf(path, "/dev/fd/%9d%n", &number, &used) == 1 ||
                          sscanf(path, "/proc/self/fd/%9d%n", &number, &used) == 1;
    return numbered && used > 0 && !path[used] ? number : -1;
}

/* Returns where a symbolic link leads, one step; NULL for any other path. */
static char *next_target(const char *path)
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

/* The last of a chain of links must not be replaced either. */
char *koksma__atomic_target(const char *path)
{
    char *known = realpath(path, NULL);
    if (known || errno == ELOOP || errno == ENOTDIR) {
        return known;
    }
    char *target = strdup(path);
    for (int links = 0; target; links++) {
        char *next = next_target(target);
        if (!next) {
            return target;
        }
        free(target);
        target = next;
        if (links == MOST_LINKS) {
            free(target);
            errno = ELOOP;
            return NULL;
        }
    }
    return NULL;
}

/* Opens a target that is not a plain file, such as a device or pipe, for writing: a temporary file renamed to its
   name would replace it. Returns false if the target is a plain file or does not exist. */
static bool open_special(const char *path, output *o)
{
    struct stat info;
    const int stream = descriptor_of(path);
    if (stream >= 0) {
        if (stream == STDOUT_FILENO) {
            fflush(stdout);
        }
        o->descriptor = fcntl(stream, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        return true;
    }
    if (stat(path, &info) || S_ISREG(info.st_mode)) {
        return false;
    }
    o->descriptor = above_streams(open(path, O_WRONLY | O_TRUNC | O_CLOEXEC | O_NOCTTY));
    return true;
}

/* Opens a temporary file for `path`, which is relative to the open folder `folder`, following no symbolic links. It takes
   over the descriptor `folder`, also if it fails; it then returns false and sets errno. */
static bool open_within(int folder, const char *path, output *o)
{
    struct stat info;
    for (const char *slash; folder >= 0 && (slash = strchr(path, '/')); path = slash + 1) {
        char *part = strndup(path, (size_t)(slash - path));
        const int next = part ? open_folder(folder, part, O_NOFOLLOW) : -1;
        int reason = errno;
        if (next < 0 && part && !fstatat(folder, part, &info, AT_SYMLINK_NOFOLLOW) && S_ISLNK(info.st_mode)) {
            reason = ELOOP;
        }
        free(part);
        close(folder);
        folder = next;
        errno = reason;
    }
    o->folder = folder;
    o->name = folder < 0 ? NULL : strdup(path);
    if (!o->name || !make_temporary(o)) {
        return false;
    }
    if (!fstatat(folder, path, &info, AT_SYMLINK_NOFOLLOW) && S_ISREG(info.st_mode)) {
        fchmod(o->descriptor, info.st_mode & 0777); /* the new file gets the permissions of the old one */
    }
    return true;
}

static bool open_target(const char *path, output *o)
{
    char *copy = koksma__atomic_target(path);
    char *slash = copy ? strrchr(copy, '/') : NULL;
    bool done = false;
    if (copy) {
        const char *name = slash ? slash + 1 : copy;
        const char first = *name;
        if (slash) {
            *slash = '\0';
        }
        errno = ENOENT;
        done = first && open_within(open_folder(AT_FDCWD, !slash ? "." : *copy ? copy : "/", 0), name, o);
    }
    const int reason = errno;
    free(copy);
    errno = reason;
    return done;
}

static void end(output *o)
{
    if (o->descriptor >= 0) {
        close(o->descriptor);
    }
    if (o->folder >= 0) {
        close(o->folder);
    }
    KOKSMA__FREE(o->name, o->path, o);
}

koksma_status koksma__atomic_open(const char *folder, const char *path, koksma__atomic_file *file)
{
    *file = (koksma__atomic_file){0};
    KOKSMA__FAIL_IF(!folder && !*path, KOKSMA_IO, "the path of the file to write is empty");
    output *o = malloc(sizeof *o);
    if (o) {
        *o = (output){.path = koksma__path_below(folder, strcmp(path, "-") ? path : "standard output"),
                      .folder = -1,
                      .descriptor = -1};
    }
    if (!o || !o->path) {
        free(o);
        return koksma__fail_memory(sizeof *o + strlen(path));
    }
    if (folder) {
        open_within(open_folder(AT_FDCWD, folder, 0), path, o);
    } else if (!open_special(path, o)) {
        open_target(path, o);
    }
    file->stream = o->descriptor >= 0 ? open_stream(o) : NULL;
    if (!file->stream) {
        const int reason = errno;
        if (o->folder >= 0 && o->descriptor >= 0) {
            unlinkat(o->folder, o->temporary, 0);
        }
        koksma__fail(KOKSMA_IO, "%s: can't be written: %s", o->path,
                     reason == EISDIR            ? "it is a directory"
                     : folder && reason == ELOOP ? "its folder is a symbolic link, which is not followed here"
                                                 : strerror(reason));
        end(o);
        return KOKSMA_IO;
    }
    file->output = o;
    return KOKSMA_OK;
}

uint64_t koksma__atomic_space(const koksma__atomic_file *file)
{
    struct statvfs info;
    const output *o = file->output;
    return o->folder < 0 || fstatvfs(o->descriptor, &info) ? UINT64_MAX : (uint64_t)info.f_bavail * info.f_frsize;
}

void koksma__atomic_temporary(const koksma__atomic_file *file, char path[KOKSMA__TEMPORARY_PATH])
{
#ifdef __APPLE__
    char folder[KOKSMA__MAX_PATH] = "."; /* PATH_MAX is 1024 */
    fcntl(file->output->folder, F_GETPATH, folder);
    snprintf(path, KOKSMA__TEMPORARY_PATH, "%s/%s", folder, file->output->temporary);
#else
    snprintf(path, KOKSMA__TEMPORARY_PATH, "/proc/self/fd/%d/%s", file->output->folder, file->output->temporary);
#endif
}

/* ---- Closing --------------------------------------------------------------------------------------------- */

/* Syncs a folder. It is no error if the file system cannot sync folders, or if the folder may not be read. */
static bool sync_folder(int folder)
{
    return !sync_file(folder) || errno == EINVAL || errno == EBADF || errno == ENOTSUP;
}

/* Syncs the folder that holds `path`. If it fails, it returns false and sets errno. */
static bool sync_above(const char *path)
{
    char *copy = strdup(path);
    const int folder = copy ? open_folder(AT_FDCWD, dirname(copy), 0) : -1;
    const bool synced = folder >= 0 && sync_folder(folder);
    const int reason = errno;
    if (folder >= 0) {
        close(folder);
    }
    free(copy);
    errno = reason;
    return synced;
}

koksma_status koksma__atomic_folder(const char *path)
{
    KOKSMA__FAIL_IF(!*path, KOKSMA_IO, "the path of the folder is empty");
    KOKSMA__FAIL_IF(mkdir(path, 0777) && errno != EEXIST, KOKSMA_IO, "%s: can't be made: %s", path, strerror(errno));
    return sync_above(path) ? KOKSMA_OK : koksma__fail(KOKSMA_IO, "%s: can't be synced: %s", path, strerror(errno));
}

koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep)
{
    output *o = file->output;
    koksma_status status = KOKSMA_OK;
    if (!o) {
        return status;
    }
    const char *what = "writing failed";
    bool placed = false;
    if (fclose(file->stream) && !o->reason) {
        o->reason = errno;
    }
    if (o->folder >= 0 && keep && !o->reason) {
        if (sync_file(o->descriptor)) {
            o->reason = errno;
        } else if (renameat(o->folder, o->temporary, o->folder, o->name)) {
            o->reason = errno;
            what = "can't be written";
        } else {
            placed = true;
            o->reason = sync_folder(o->folder) ? 0 : errno;
        }
    }
    if (o->folder >= 0 && !placed) {
        unlinkat(o->folder, o->temporary, 0);
    }
    /* after a successful fsync, close() of a plain file cannot lose data */
    if (o->folder < 0 && close(o->descriptor) && !o->reason) {
        o->reason = errno;
    }
    o->descriptor = o->folder < 0 ? -1 : o->descriptor;
    if (keep && o->reason) {
        status = koksma__fail(KOKSMA_IO, "%s: %s: %s", o->path, what, strerror(o->reason));
    }
    end(o);
    *file = (koksma__atomic_file){0};
    return status;
}

#endif
