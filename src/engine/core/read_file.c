/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Opens input files, for every reader. A scene, plan or model from an untrusted source may name an endless device, a
 * fifo without a writer, or a sparse file of any size. Therefore a file named by another file is opened only if it is
 * a plain file, and is read only up to the limit of its kind (file_kinds.def), after a check of its first bytes.
 * stat() is called before open(), because opening alone makes some devices act; fstat() then checks the file that was
 * opened. With O_NONBLOCK, open() does not wait for a file of /proc, or for a fifo that replaced the file after
 * stat(). A fifo that the user names is opened without O_NONBLOCK; otherwise reading would end before another program
 * has begun to write.
 */
#include "core/files.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/hash.h"
#include "core/platform/system.h"
#include "core/status.h"

static const struct {
    uint64_t most;
    const char *text;
} kinds[] = {
#define FILE_KIND(name, mib, text) {(uint64_t)(mib) << 20, text},
#include "core/file_kinds.def"
#undef FILE_KIND
};

uint64_t koksma__file_most(koksma__file_kind kind)
{
    const uint64_t most = kinds[kind].most;
    return most < SIZE_MAX / 4 ? most : SIZE_MAX / 4;
}

koksma_status koksma__file_too_long(const char *name, koksma__file_kind kind)
{
    return koksma__refused(koksma__fail(KOKSMA_MALFORMED, "%s: longer than %llu MiB, the limit of %s", name,
                                        (unsigned long long)(koksma__file_most(kind) >> 20), kinds[kind].text));
}

static koksma_status fail_read(const char *name, int reason)
{
    const bool exhausted = reason == EMFILE || reason == ENFILE || reason == ENOMEM;
    return koksma__fail(exhausted ? KOKSMA_SYSTEM : KOKSMA_MISSING, "%s: can't be read: %s", name, strerror(reason));
}

/* Fails if the path is not a readable file, or if the file is too long. */
static koksma_status check_file(const char *path, const struct stat *info, koksma__file_kind kind, koksma__named by,
                                bool terminal)
{
    KOKSMA__FAIL_IF(S_ISDIR(info->st_mode), KOKSMA_MISSING, "%s: can't be read: it is a directory", path);
    if (S_ISCHR(info->st_mode) || S_ISBLK(info->st_mode)) {
        return terminal && by == KOKSMA__BY_USER
                   ? KOKSMA_OK
                   : koksma__fail(KOKSMA_MISSING, "%s: can't be read: it is a device", path);
    }
    if (!S_ISREG(info->st_mode)) {
        return by == KOKSMA__BY_USER
                   ? KOKSMA_OK
                   : koksma__fail(KOKSMA_MISSING,
                                  "%s: can't be read: it is a pipe or socket, but only plain files are accepted here",
                                  path);
    }
    return (uint64_t)info->st_size > koksma__file_most(kind) ? koksma__file_too_long(path, kind) : KOKSMA_OK;
}

/* Opens a path; *descriptor is -1 after an error. */
static koksma_status open_path(const char *path, koksma__file_kind kind, koksma__named by, int *descriptor)
{
    enum { FLAGS = O_RDONLY | O_CLOEXEC | O_NOCTTY };
    struct stat info;
    *descriptor = -1;
    KOKSMA__FAIL_IF(!*path, KOKSMA_MISSING, "the path of the file to read is empty");
    if (stat(path, &info)) {
        return fail_read(path, errno);
    }
    KOKSMA__TRY(check_file(path, &info, kind, by, true));
    koksma_status status = KOKSMA_OK;
    *descriptor = open(path, S_ISFIFO(info.st_mode) ? FLAGS : FLAGS | O_NONBLOCK);
    if (*descriptor < 0 || fstat(*descriptor, &info)) {
        status = fail_read(path, errno);
    }
    status = status ? status : check_file(path, &info, kind, by, isatty(*descriptor));
    if (!status && !S_ISREG(info.st_mode)) {
        fcntl(*descriptor, F_SETFL, fcntl(*descriptor, F_GETFL) & ~O_NONBLOCK);
    }
    if (status && *descriptor >= 0) {
        close(*descriptor);
        *descriptor = -1;
    }
    return status;
}

/* Fails if a file is a pointer of Git LFS, the text that stands for a file that was not fetched. Every kind of file may be
   one, and to each reader it would be damaged in another way. */
static koksma_status check_pointer(const char *path, int descriptor)
{
    static const char start[] = "version https://git-lfs.github.com/spec/";
    char bytes[sizeof start - 1];
    const bool is_pointer =
        pread(descriptor, bytes, sizeof bytes, 0) == (ssize_t)sizeof bytes && !memcmp(bytes, start, sizeof bytes);
    return is_pointer
               ? koksma__fail(KOKSMA_MISSING,
                              "%s: it is a Git LFS pointer, not the file itself: 'git lfs pull' fetches that", path)
               : KOKSMA_OK;
}

koksma_status koksma__file_open(const char *path, koksma__file_kind kind, koksma__named by, FILE **stream)
{
    int descriptor;
    *stream = by == KOKSMA__BY_USER && !strcmp(path, "-") ? stdin : NULL;
    koksma_status status = *stream ? KOKSMA_OK : open_path(path, kind, by, &descriptor);
    if (!status && !*stream && (status = check_pointer(path, descriptor))) {
        close(descriptor);
    }
    if (!status && !*stream && !(*stream = fdopen(descriptor, "rb"))) {
        status = koksma__fail(KOKSMA_SYSTEM, "%s: can't be read: %s", path, strerror(errno));
        close(descriptor);
    }
    return status;
}

void koksma__file_close(FILE *stream)
{
    if (stream && stream != stdin) {
        fclose(stream);
    }
}

koksma_status koksma__check_text(const unsigned char *bytes, size_t size)
{
    return memchr(bytes, 0, size) ? koksma__fail(KOKSMA_MALFORMED, "not a UTF-8 text: it has a zero byte")
                                  : KOKSMA_OK;
}

/* Returns the number of bytes to allocate before reading: for a plain file its length plus 1, to detect the end; for
   a pipe 0.
   */
static size_t length_of(FILE *stream, size_t most)
{
    struct stat info;
    const bool plain = !fstat(fileno(stream), &info) && S_ISREG(info.st_mode) && info.st_size >= 0;
    return !plain ? 0 : (uint64_t)info.st_size < most ? (size_t)info.st_size + 1 : most + 1;
}

/* Reads to the end, or up to the limit. The capacity doubles for files without a known length, such as pipes. */
static koksma_status read_all(FILE *stream, const char *name, size_t most, koksma__check_start *check,
                              unsigned char **bytes, size_t *size)
{
    size_t capacity = KOKSMA__FILE_START, used = 0;
    for (;;) {
        unsigned char *more = realloc(*bytes, capacity + 1);
        KOKSMA__REQUIRE_MEMORY(more, capacity);
        *bytes = more;
        const size_t got = fread(more + used, 1, capacity - used, stream);
        const int reason = errno;
        const bool first = used == 0;
        used += got;
        if (used < capacity && ferror(stream)) {
            return fail_read(name, reason);
        }
        const koksma_status status = first && check ? check(more, used) : KOKSMA_OK;
        if (status) {
            return koksma__fail_in(status, name);
        }
        if (used < capacity || used > most) {
            break;
        }
        const size_t length = length_of(stream, most), twice = 2 * capacity <= most ? 2 * capacity : most + 1;
        capacity = length > capacity ? length : twice;
    }
    (*bytes)[used] = 0;
    *size = used;
    return KOKSMA_OK;
}

koksma_status koksma__read_file(const char *path, koksma__file_kind kind, koksma__named by,
                                koksma__check_start *check, unsigned char **bytes, size_t *size)
{
    FILE *stream;
    const size_t most = (size_t)koksma__file_most(kind);
    *bytes = NULL;
    *size = 0;
    KOKSMA__TRY(koksma__file_open(path, kind, by, &stream));
    const char *name = stream == stdin ? "standard input" : path;
    koksma_status status = read_all(stream, name, most, check, bytes, size);
    koksma__file_close(stream);
    status = !status && *size > most ? koksma__file_too_long(name, kind) : status;
    if (status) {
        free(*bytes);
        *bytes = NULL;
        *size = 0;
    }
    return status;
}

koksma_status koksma__hash_file(const char *path, uint64_t *hash)
{
    unsigned char bytes[1 << 14];
    FILE *stream;
    KOKSMA__TRY(koksma__file_open(path, KOKSMA__FILE_POINTS, KOKSMA__BY_FILE, &stream));
    *hash = KOKSMA__HASH_START;
    for (size_t n; (n = fread(bytes, 1, sizeof bytes, stream));) {
        *hash = koksma__hash_more(*hash, bytes, n);
    }
    *hash = koksma__hash_end(*hash);
    koksma__file_close(stream);
    return KOKSMA_OK;
}

char *koksma__path_below(const char *folder, const char *path)
{
    const size_t size = strlen(path) + (folder ? strlen(folder) : 0) + 2;
    char *whole = malloc(size);
    if (whole) {
        snprintf(whole, size, "%s%s%s", folder ? folder : "", folder ? "/" : "", path);
    }
    return whole;
}

bool koksma__path_beside(const char *name, const char *path, char out[KOKSMA__MAX_PATH])
{
    const char *slash = koksma__last_slash(name);
    const int folder = koksma__path_is_absolute(path) || !slash ? 0 : (int)(slash - name) + 1;
    return (size_t)snprintf(out, KOKSMA__MAX_PATH, "%.*s%s", folder, name, path) < KOKSMA__MAX_PATH;
}
