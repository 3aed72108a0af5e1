/* SPDX-License-Identifier: Apache-2.0 */
/* Reads files of published parameters, generating vectors and matrices: lines of whole numbers, one for each dimension.
 */
#ifndef KOKSMA_PATTERNS_SHARED_NUMBER_LINES_H
#define KOKSMA_PATTERNS_SHARED_NUMBER_LINES_H

#include <koksma/koksma.h>

typedef struct koksma__number_lines {
    char name[KOKSMA_MAX_SPEC + 16]; /* "pattern:PATH", for error messages */
    /* The kind of the file's contents, by the first rule that applies. If its comments have a heading of LatNet
       Builder: "lattice", "plattice", "dnet", "soboljk" or "sobol", as the heading says. If its first line is a
       comment "# word": the word. If the file begins with Joe & Kuo's header "d s a m_i": "soboljk". Otherwise "". */
    char kind[16];
    uint64_t base; /* the base that LatNet Builder's output has in its heading; 0 for other files */
    char *text, *at;
    size_t number; /* number of the line read last, from 1 */
} koksma__number_lines;

/* Reads the file that a pattern names; koksma__number_lines_close frees. Errors: those of koksma__read_file. */
koksma_status koksma__number_lines_open(const char *pattern, const char *path, koksma__number_lines *lines);
void koksma__number_lines_close(koksma__number_lines *lines);

/* Reads the next line that has numbers; *count is 0 at the end of the file. Text after a # is a comment. Errors:
   MALFORMED (more than `most` numbers, or text that is not a whole number below 2^64). */
koksma_status koksma__number_lines_next(koksma__number_lines *lines, size_t most, uint64_t *numbers, size_t *count);

/* Reads the next line that has numbers; it must have `needed` of them. Error messages call them `what`. */
koksma_status koksma__number_lines_take(koksma__number_lines *lines, const char *what, size_t needed,
                                        uint64_t *numbers);

#endif
