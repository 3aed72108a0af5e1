/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Decompresses with zlib, which finds out by itself whether a stream is zlib's or gzip's (32 is added to its
 * parameter windowBits). zlib counts bytes in 32 bits, so that longer blocks are passed in pieces. A stream is
 * decompressed only as far as the caller asks, so that a file that would decompress to more than it claims costs
 * nothing.
 */
#include "meshes/readers.h"

#include <stdlib.h>

#include "core/status.h"

#ifdef KOKSMA_ZLIB
#include <zlib.h>

enum { PIECE = 1 << 30, ANY_HEADER = 32 };

struct koksma__inflate {
    z_stream z;
    size_t left; /* compressed bytes that zlib has not been given yet */
};

koksma_status koksma__inflate_open(const unsigned char *bytes, size_t size, koksma__inflate **out)
{
    koksma__inflate *in = calloc(1, sizeof *in);
    *out = in;
    KOKSMA__REQUIRE_MEMORY(in, sizeof *in);
    in->z.next_in = (z_const Bytef *)bytes;
    in->left = size;
    if (inflateInit2(&in->z, MAX_WBITS + ANY_HEADER) != Z_OK) {
        free(in);
        *out = NULL;
        return koksma__fail_memory(sizeof *in);
    }
    return KOKSMA_OK;
}

void koksma__inflate_close(koksma__inflate *in)
{
    if (in) {
        inflateEnd(&in->z);
        free(in);
    }
}

/* Decompresses up to n bytes; *got is less than n where the stream ends. */
static koksma_status take(koksma__inflate *in, unsigned char *to, size_t n, size_t *got)
{
    int result = Z_OK;
    in->z.next_out = to;
    *got = 0;
    while (*got < n && result != Z_STREAM_END) {
        if (!in->z.avail_in) {
            in->z.avail_in = in->left < PIECE ? (uInt)in->left : PIECE;
            in->left -= in->z.avail_in;
        }
        const uInt asked = n - *got < PIECE ? (uInt)(n - *got) : PIECE;
        in->z.avail_out = asked;
        result = inflate(&in->z, Z_NO_FLUSH);
        *got += asked - in->z.avail_out;
        KOKSMA__FAIL_IF(result == Z_MEM_ERROR, KOKSMA_MEMORY, "out of memory while decompressing");
        KOKSMA__FAIL_IF(result != Z_OK && result != Z_STREAM_END, KOKSMA_MALFORMED, "its compressed data is %s",
                        result == Z_BUF_ERROR ? "cut short" : "damaged");
    }
    return KOKSMA_OK;
}

koksma_status koksma__inflate_read(koksma__inflate *in, void *to, size_t n)
{
    size_t got = 0;
    KOKSMA__TRY(take(in, to, n, &got));
    KOKSMA__FAIL_IF(got < n, KOKSMA_MALFORMED, "its compressed data holds less than its header claims");
    return KOKSMA_OK;
}

/* Goes on to the next stream of a gzip file (RFC 1952, section 2.2); returns false if there is none. */
static bool next_stream(koksma__inflate *in)
{
    return in->z.avail_in + in->left > 0 && inflateReset(&in->z) == Z_OK;
}

koksma_status koksma__inflate_all(const unsigned char *bytes, size_t size, size_t most, unsigned char **out,
                                  size_t *out_size)
{
    koksma__inflate *in = NULL;
    size_t capacity = 0, n = 0, got = 0;
    koksma_status status = koksma__inflate_open(bytes, size, &in);
    *out = NULL;
    while (!status) {
        if (n == capacity) {
            capacity = capacity ? 2 * capacity : 65536;
            capacity = capacity < most + 1 ? capacity : most + 1;
            unsigned char *more = realloc(*out, capacity + 1);
            status = more ? KOKSMA_OK : koksma__fail_memory(capacity + 1);
            *out = more ? more : *out;
        }
        status = status ? status : take(in, *out + n, capacity - n, &got);
        n += got;
        if (!status && n > most) {
            status = koksma__fail(KOKSMA_MALFORMED, "it decompresses to more than %zu bytes", most);
        } else if (!status && n < capacity && !next_stream(in)) {
            break;
        }
    }
    koksma__inflate_close(in);
    if (status) {
        free(*out);
        *out = NULL;
        return status;
    }
    (*out)[n] = 0;
    *out_size = n;
    return KOKSMA_OK;
}

#else

koksma_status koksma__inflate_open(const unsigned char *bytes, size_t size, koksma__inflate **out)
{
    (void)bytes, (void)size;
    *out = NULL;
    return koksma__fail(KOKSMA_UNSUPPORTED, "compressed models are not read: the build has no zlib");
}

void koksma__inflate_close(koksma__inflate *in)
{
    (void)in;
}

koksma_status koksma__inflate_read(koksma__inflate *in, void *to, size_t n)
{
    (void)to, (void)n;
    return koksma__inflate_open(NULL, 0, &in);
}

koksma_status koksma__inflate_all(const unsigned char *bytes, size_t size, size_t most, unsigned char **out,
                                  size_t *out_size)
{
    koksma__inflate *in;
    (void)most;
    *out = NULL;
    *out_size = 0;
    return koksma__inflate_open(bytes, size, &in);
}

#endif
