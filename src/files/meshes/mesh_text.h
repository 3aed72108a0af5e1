/* SPDX-License-Identifier: Apache-2.0 */
/* A mesh file as text: lines, words within a line, and numbers. Nothing is copied: lines and words are spans of the
   file in memory, which ends with a zero byte (koksma__read_file adds it). */
#ifndef KOKSMA_MESHES_MESH_TEXT_H
#define KOKSMA_MESHES_MESH_TEXT_H

#include <string.h>

#include "core/status.h"

typedef struct koksma__text {
    const char *path;
    const char *next, *end; /* the lines not read yet */
    const char *at, *stop;  /* the rest of the current line */
    size_t number;          /* number of the current line, from 1 on */
} koksma__text;

/* Starts before the first line, and skips a UTF-8 byte order mark. */
koksma__text koksma__text_open(const char *path, const unsigned char *file, size_t size);

/* Goes to the next line, whose end (LF or CR LF) is not part of it; returns false if there is none. */
bool koksma__text_line(koksma__text *t);

/* Goes to the next line that is not empty. Errors: MALFORMED (there is none). */
koksma_status koksma__text_full_line(koksma__text *t);

/* Fails with MALFORMED and the text "PATH: line N: REASON". */
koksma_status koksma__text_wrong(const koksma__text *t, const char *reason);

/* Reads the next word of the line, which ends at a blank; returns false if there is none. */
bool koksma__text_word(koksma__text *t, const char **word, size_t *length);

/* Whether the span equals the word `wanted`. */
static inline bool koksma__text_is(const char *word, size_t length, const char *wanted)
{
    return length == strlen(wanted) && !memcmp(word, wanted, length);
}

/* The rest of the line without blanks at either end, as a span; returns its length. */
size_t koksma__text_rest(koksma__text *t, const char **rest);

/* Reads a decimal number at `*at`: digits with at most one point, perhaps with a sign and an exponent. The result is
   the nearest float, for any number of digits; beyond the largest float it is infinite. Returns false if there is no
   number. The byte at `end` must not be one that can continue a number, such as a digit. */
bool koksma__text_float(const char **at, const char *end, float *out);

/* Reads digits as an integer; a value above 2^62 becomes 2^62. Returns false if there is no digit. */
bool koksma__text_whole(const char **at, const char *end, long long *out);

#endif
