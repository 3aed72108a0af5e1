/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Output files on Windows: a temporary file beside the target, flushed to the disk, then renamed by MoveFileEx, which
 * replaces a file in one step within a volume. A folder has no entry of its own to flush. The temporary name has 64 random
 * bits, and only a new file is opened. Standard output is written in place.
 */
#ifdef _WIN32
#include "core/files.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#include "core/platform/system.h"
#include "core/platform/windows.h"
#include "core/status.h"

enum { TRIES = 20, PAUSE_MS = 20 };

typedef struct koksma__output {
    char *path;      /* in messages; NULL after "-" */
    char *temporary; /* NULL: the target is a stream or device, written in place */
} output;

/* The path that a link at `path` leads to, as far as it exists. */
char *koksma__atomic_target(const char *path)
{
    struct stat info;
    char *real = !lstat(path, &info) && S_ISLNK(info.st_mode) ? realpath(path, NULL) : NULL;
    return real ? real : _strdup(path);
}

static FILE *open_temporary(output *o)
{
    unsigned random[2];
    const char *slash = koksma__last_slash(o->path);
    const size_t size = strlen(o->path) + 32;
    o->temporary = malloc(size);
    if (!o->temporary || rand_s(&random[0]) || rand_s(&random[1])) {
        return NULL;
    }
    snprintf(o->temporary, size, "%.*s.koksma-%08x%08x", slash ? (int)(slash + 1 - o->path) : 0, o->path, random[0],
             random[1]);
    const int descriptor = open(o->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return descriptor < 0 ? NULL : fdopen(descriptor, "wb");
}

/* Whether a folder within `path`, which the program chose below `folder`, is a link. */
static bool leads_away(const char *folder, const char *path)
{
    struct stat info;
    bool is_link = false;
    for (const char *slash = strchr(path, '/'); folder && slash && !is_link; slash = strchr(slash + 1, '/')) {
        char *part = strndup(path, (size_t)(slash - path)), *whole = part ? koksma__path_below(folder, part) : NULL;
        is_link = !whole || (!lstat(whole, &info) && S_ISLNK(info.st_mode));
        free(part);
        free(whole);
    }
    return is_link;
}

/* Opens standard output, or a device or pipe that the user named. */
static FILE *open_special(const char *path, output *o, bool *special)
{
    struct stat info;
    *special = !strcmp(o->path, "-");
    if (*special) {
        fflush(stdout);
        const int copy = _dup(_fileno(stdout));
        return copy < 0 ? NULL : fdopen(copy, "wb");
    }
    *special = !stat(path, &info) && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
    return *special ? fopen(path, "wb") : NULL;
}

static void end(output *o)
{
    free(o->temporary);
    free(o->path);
    free(o);
}

koksma_status koksma__atomic_open(const char *folder, const char *path, koksma__atomic_file *file)
{
    struct stat info;
    bool special = false;
    *file = (koksma__atomic_file){0};
    KOKSMA__FAIL_IF(!folder && !*path, KOKSMA_IO, "the path of the file to write is empty");
    output *o = calloc(1, sizeof *o);
    KOKSMA__REQUIRE_MEMORY(o, sizeof *o);
    char *whole = koksma__path_below(folder, path);
    o->path = whole && !folder && strcmp(path, "-") != 0 ? koksma__atomic_target(whole) : whole;
    if (o->path != whole) {
        free(whole);
    }
    if (!o->path) {
        free(o);
        return koksma__fail_memory(sizeof *o + strlen(path));
    }
    if (leads_away(folder, path)) {
        end(o);
        return koksma__fail(KOKSMA_IO,
                            "%s/%s: can't be written: its folder is a symbolic link, which is not followed here",
                            folder, path);
    }
    const bool is_folder = !stat(o->path, &info) && S_ISDIR(info.st_mode);
    file->stream = folder ? NULL : open_special(path, o, &special);
    file->stream = special || is_folder ? file->stream : open_temporary(o);
    if (!file->stream) {
        koksma__fail(KOKSMA_IO, "%s: can't be written: %s", strcmp(o->path, "-") ? o->path : "standard output",
                     is_folder ? "it is a directory" : strerror(errno));
        end(o);
        return KOKSMA_IO;
    }
    file->output = o;
    return KOKSMA_OK;
}

uint64_t koksma__atomic_space(const koksma__atomic_file *file)
{
    ULARGE_INTEGER left = {.QuadPart = UINT64_MAX};
    char *slash = file->output->temporary ? strrchr(file->output->temporary, '/') : NULL;
    if (slash) {
        *slash = '\0';
    }
    wchar_t *folder = koksma__wide_path(slash ? file->output->temporary : ".");
    if (slash) {
        *slash = '/';
    }
    const bool known = file->output->temporary && folder && GetDiskFreeSpaceExW(folder, &left, NULL, NULL);
    free(folder);
    return known ? left.QuadPart : UINT64_MAX;
}

void koksma__atomic_temporary(const koksma__atomic_file *file, char path[KOKSMA__TEMPORARY_PATH])
{
    snprintf(path, KOKSMA__TEMPORARY_PATH, "%s", file->output->temporary);
}

/* Renames the temporary file. Other programs, such as virus scanners, may hold a new file open for a moment. */
static int place(const output *o)
{
    wchar_t *from = koksma__wide_path(o->temporary), *to = koksma__wide_path(o->path);
    bool placed = false;
    for (int i = 0; from && to && !placed && i < TRIES; i++) {
        placed = MoveFileExW(from, to, MOVEFILE_WRITE_THROUGH | MOVEFILE_REPLACE_EXISTING);
        if (!placed && GetLastError() != ERROR_ACCESS_DENIED && GetLastError() != ERROR_SHARING_VIOLATION) {
            break;
        }
        if (!placed) {
            Sleep(PAUSE_MS);
        }
    }
    const int code = placed ? 0 : from && to ? koksma__set_errno() : -1;
    free(from);
    free(to);
    return code;
}

koksma_status koksma__atomic_close(koksma__atomic_file *file, bool keep)
{
    output *o = file->output;
    koksma_status status = KOKSMA_OK;
    if (!o) {
        return status;
    }
    const char *what = "writing failed";
    int reason = 0;
    errno = 0;
    if (fflush(file->stream) || ferror(file->stream) || (o->temporary && keep && _commit(_fileno(file->stream)))) {
        reason = errno ? errno : EIO;
    }
    reason = fclose(file->stream) && !reason ? errno : reason;
    bool placed = false;
    if (o->temporary && keep && !reason) {
        placed = !place(o);
        reason = placed ? 0 : errno;
        what = "can't be written";
    }
    if (o->temporary && !placed) {
        unlink(o->temporary);
    }
    if (keep && reason) {
        status = koksma__fail(KOKSMA_IO, "%s: %s: %s", strcmp(o->path, "-") ? o->path : "standard output", what,
                              strerror(reason));
    }
    end(o);
    *file = (koksma__atomic_file){0};
    return status;
}

koksma_status koksma__atomic_folder(const char *path)
{
    KOKSMA__FAIL_IF(!*path, KOKSMA_IO, "the path of the folder is empty");
    KOKSMA__FAIL_IF(mkdir(path, 0777) && errno != EEXIST, KOKSMA_IO, "%s: can't be made: %s", path, strerror(errno));
    return KOKSMA_OK;
}

#endif
