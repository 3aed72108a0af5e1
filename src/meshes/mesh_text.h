/* SPDX-License-Identifier: Apache-2.0 */
/* A mesh file as text: lines with their numbers, words within a line, numbers. Nothing is copied: lines and words are
   spans of the file, behind whose end is a zero byte (koksma__read_file puts it there). */
#ifndef KOKSMA_MESHES_MESH_TEXT_H
#define KOKSMA_MESHES_MESH_TEXT_H

#include <string.h>

#include "core/status.h"

typedef struct koksma__text {
    const char *path;
    const char *next, *end; /* the lines that are still to be read */
    const char *at, *stop;  /* what is left of the current line */
    size_t number;          /* of the current line, from 1 on */
} koksma__text;

/* Starts before the first line, and skips a UTF-8 byte order mark. */
koksma__text koksma__text_open(const char *path, const unsigned char *file, size_t size);

/* Goes to the next line, without its end (LF or CR LF); false: there is none. */
bool koksma__text_line(koksma__text *t);

/* Goes to the next line that has something before the first character `comment`, where it is cut. Errors: MALFORMED
   (there is none). */
koksma_status koksma__text_full_line(koksma__text *t, char comment);

/* "PATH: line N: REASON", MALFORMED. */
koksma_status koksma__text_wrong(const koksma__text *t, const char *reason);

/* Takes the next word of the line, which ends at a blank; false: there is none. */
bool koksma__text_word(koksma__text *t, const char **word, size_t *length);

/* Whether the span is this word. */
static inline bool koksma__text_is(const char *word, size_t length, const char *wanted)
{
    return length == strlen(wanted) && !memcmp(word, wanted, length);
}

/* The line's rest without blanks at either end, as a span; its length. */
size_t koksma__text_rest(koksma__text *t, const char **rest);

/* Takes a decimal number at `*at`: digits with at most one point among them, maybe a sign and an exponent. It is
   rounded once, to the nearest float, whatever the number of digits; beyond the largest float it is infinite. false:
   there is none. Reads bytes before `end`; the byte at `end` must be one that can't
   continue a number. */
bool koksma__text_float(const char **at, const char *end, float *out);

/* Takes digits; above 2^62 the number is cut to that. false: there is none. */
bool koksma__text_whole(const char **at, const char *end, long long *out);

#endif
