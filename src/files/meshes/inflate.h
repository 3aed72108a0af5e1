/* SPDX-License-Identifier: Apache-2.0 */
/* Decompresses bytes in memory: zlib and gzip streams (RFC 1950 and 1952). */
#ifndef KOKSMA_MESHES_INFLATE_H
#define KOKSMA_MESHES_INFLATE_H

#include <koksma/koksma.h>

/* The largest ratio that deflate reaches: its longest match, 258 bytes, in two bits. If a header claims more bytes
   than this ratio times the compressed size, it is wrong. */
#define KOKSMA__INFLATE_RATIO 1032

typedef struct koksma__inflate koksma__inflate;

/* Starts to decompress a stream. koksma__inflate_close ends it, also after an error, and accepts NULL. The error
   texts of these functions do not name the file. Errors: UNSUPPORTED (this build lacks zlib), MEMORY. */
koksma_status koksma__inflate_open(const unsigned char *bytes, size_t size, koksma__inflate **out);
void koksma__inflate_close(koksma__inflate *in);

/* Reads the next n decompressed bytes. Errors: MALFORMED (the stream is damaged, or fewer bytes are left), MEMORY. */
koksma_status koksma__inflate_read(koksma__inflate *in, void *to, size_t n);

/* Decompresses a whole gzip file, which has one or several streams, and adds a zero byte; the caller frees *out.
   Memory grows with the bytes that were decompressed. Errors: those above, and MALFORMED (more than `most` bytes). */
koksma_status koksma__inflate_all(const unsigned char *bytes, size_t size, size_t most, unsigned char **out,
                                  size_t *out_size);

#endif
