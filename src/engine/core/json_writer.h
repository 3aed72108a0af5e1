/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The only writer of JSON text (RFC 8259): a buffer that grows, with commas, quotes and escapes in the right places.
 *
 *     koksma__json_writer w = {0};
 *     koksma__json_begin_object(&w, NULL);
 *     koksma__json_write_text(&w, "name", name);
 *     koksma__json_begin_array(&w, "values");
 *     koksma__json_write_number(&w, NULL, 0.25);
 *     koksma__json_end(&w);
 *     koksma__json_end(&w);
 *     status = koksma__json_finish(&w, &text, &size);
 *
 * gives {"name":"…","values":[0.25]}. Every value takes a key: its name in an object, NULL in an array and at the top.
 * Calls after a failure do nothing, so that only koksma__json_finish needs a check of the status.
 */
#ifndef KOKSMA_CORE_JSON_WRITER_H
#define KOKSMA_CORE_JSON_WRITER_H

#include <koksma/koksma.h>

#include <stdint.h>
#include <stdio.h>

#include "core/visibility.h"

enum { KOKSMA__JSON_DEPTH = 32 };

typedef struct koksma__json_writer {
    char *text; /* ends with '\0' once anything is written */
    size_t size, capacity;
    bool in_html; /* set by the caller: write < > & as \u003c and so on, for text inside <script> */
    bool comma;   /* the next value needs a comma before it */
    int depth;
    char ends[KOKSMA__JSON_DEPTH]; /* closing brackets of the open objects and arrays */
    koksma_status status;          /* status of the first failure; koksma_error_text() has its text */
} koksma__json_writer;

/* Begins an object or an array, which koksma__json_end ends. */
KOKSMA__LAB void koksma__json_begin_object(koksma__json_writer *w, const char *key);
KOKSMA__LAB void koksma__json_begin_array(koksma__json_writer *w, const char *key);

/* Ends the innermost object or array. */
KOKSMA__LAB void koksma__json_end(koksma__json_writer *w);

/* Writes a text, or null for NULL; each byte that is not part of valid UTF-8 becomes U+FFFD, so that every reader
   accepts the result. */
KOKSMA__LAB void koksma__json_write_text(koksma__json_writer *w, const char *key, const char *text);

/* Writes a text in any number of pieces between begin and end; bytes that are not valid UTF-8 become U+FFFD in each
   piece. */
KOKSMA__LAB void koksma__json_begin_text(koksma__json_writer *w, const char *key);
KOKSMA__LAB void koksma__json_add_text(koksma__json_writer *w, const char *piece);
KOKSMA__LAB void koksma__json_end_text(koksma__json_writer *w);

/* Writes bytes as a text in base 64 (RFC 4648). */
KOKSMA__LAB void koksma__json_write_bytes(koksma__json_writer *w, const char *key, const void *bytes, size_t size);

/* Writes a number with 17 digits, which reads back as the same double; NaN and infinities, which JSON lacks, become
   null. */
KOKSMA__LAB void koksma__json_write_number(koksma__json_writer *w, const char *key, double value);

/* Writes a number with the given number of significant digits (1 to 17). */
KOKSMA__LAB void koksma__json_write_rounded(koksma__json_writer *w, const char *key, double value, int digits);

/* Writes an integer. Many readers convert JSON numbers to doubles, which lose digits above 2^53: write seeds and
   hashes as text. */
KOKSMA__LAB void koksma__json_write_whole(koksma__json_writer *w, const char *key, int64_t value);

/* Writes true or false. */
KOKSMA__LAB void koksma__json_write_flag(koksma__json_writer *w, const char *key, bool value);

/* Writes a value that is JSON text already. */
KOKSMA__LAB void koksma__json_write_json(koksma__json_writer *w, const char *key, const char *json);

/* Begins a new line before the next value. */
KOKSMA__LAB void koksma__json_break(koksma__json_writer *w);

/* Writes the buffer and a newline to the stream, empties the buffer and returns the status; for files with one value
   per line. */
KOKSMA__LAB koksma_status koksma__json_line(koksma__json_writer *w, FILE *stream);

/* Gives the text to the caller, who frees it; after a failure it frees the text and returns the status. In both cases
   the writer is then empty. */
KOKSMA__LAB koksma_status koksma__json_finish(koksma__json_writer *w, char **text, size_t *size);

/* Frees the buffer of a writer that is not finished. */
KOKSMA__LAB void koksma__json_writer_fini(koksma__json_writer *w);

#endif
