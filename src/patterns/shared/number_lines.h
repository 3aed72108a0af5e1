/* SPDX-License-Identifier: Apache-2.0 */
/* Files of parameters that others publish: generating vectors and matrices, one line of whole numbers a dimension. */
#ifndef KOKSMA_PATTERNS_SHARED_NUMBER_LINES_H
#define KOKSMA_PATTERNS_SHARED_NUMBER_LINES_H

#include <koksma/koksma.h>

typedef struct koksma__number_lines {
    char name[KOKSMA_MAX_SPEC + 16]; /* pattern:PATH, for errors */
    char
        kind[16]; /* the word of a first line "# word", "soboljk" of Joe & Kuo's heading "d s a m_i", "" of numbers */
    char *text, *at;
    size_t number; /* of the line that was read last, from 1 */
} koksma__number_lines;

/* Reads the file that a pattern names; koksma__number_lines_close frees. Errors: those of koksma__read_file. */
koksma_status koksma__number_lines_open(const char *pattern, const char *path, koksma__number_lines *lines);
void koksma__number_lines_close(koksma__number_lines *lines);

/* The numbers of the next line that has any; *count is 0 at the end. What follows a # is a comment. Errors: MALFORMED (more
   than `most` numbers, something else than whole numbers below 2^64). */
koksma_status koksma__number_lines_next(koksma__number_lines *lines, size_t most, uint64_t *numbers, size_t *count);

/* The numbers of the next line that has any; it must have `needed` of them, which `what` names in the error. */
koksma_status koksma__number_lines_take(koksma__number_lines *lines, const char *what, size_t needed,
                                        uint64_t *numbers);

#endif
