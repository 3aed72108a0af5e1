/* SPDX-License-Identifier: Apache-2.0 */
/* Reads a file or a pipe whole into memory, with a limit on its size; a 0 follows the last byte. */
#include "core/read_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/status.h"

/* Reads to the end; capacity doubles, because a pipe does not tell its length. */
static koksma_status read_all(FILE *stream, const char *path, size_t max, unsigned char **bytes, size_t *size)
{
    size_t capacity = 1 << 14, used = 0;
    unsigned char *data = NULL;
    for (;;) {
        unsigned char *more = realloc(data, capacity + 1);
        if (!more) {
            free(data);
            return koksma__fail_memory(capacity);
        }
        data = more;
        used += fread(data + used, 1, capacity - used, stream);
        if (used < capacity || used > max) {
            break;
        }
        capacity *= 2;
    }
    if (ferror(stream) || used > max) {
        free(data);
        return used > max ? koksma__fail(KOKSMA_MALFORMED, "%s: longer than %zu bytes", path, max)
                          : koksma__fail(KOKSMA_MISSING, "%s: can't be read: %s", path, strerror(errno));
    }
    data[used] = 0;
    *bytes = data;
    *size = used;
    return KOKSMA_OK;
}

koksma_status koksma__read_file(const char *path, size_t max, unsigned char **bytes, size_t *size)
{
    *bytes = NULL;
    *size = 0;
    if (!strcmp(path, "-")) {
        return read_all(stdin, "standard input", max, bytes, size);
    }
    struct stat info;
    if (!stat(path, &info) && S_ISDIR(info.st_mode)) {
        return koksma__fail(KOKSMA_MISSING, "%s: can't be read: it is a directory", path);
    }
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        return koksma__fail(KOKSMA_MISSING, "%s: can't be read: %s", path, strerror(errno));
    }
    const koksma_status status = read_all(stream, path, max, bytes, size);
    fclose(stream);
    return status;
}

bool koksma__path_beside(const char *name, const char *path, char out[KOKSMA__MAX_PATH])
{
    const char *slash = strrchr(name, '/');
    const int folder = *path == '/' || !slash ? 0 : (int)(slash - name) + 1;
    return (size_t)snprintf(out, KOKSMA__MAX_PATH, "%.*s%s", folder, name, path) < KOKSMA__MAX_PATH;
}
