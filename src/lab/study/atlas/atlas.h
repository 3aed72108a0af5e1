/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of the atlas: atlas_build.c runs the commands, atlas_page.c writes the pages, atlas_text.c their texts. */
#ifndef KOKSMA_STUDY_ATLAS_ATLAS_H
#define KOKSMA_STUDY_ATLAS_ATLAS_H

#include <stdio.h>

#include <koksma/atlas.h>

#include "core/hash.h"
#include "json/json.h"

enum { KOKSMA__ATLAS_PAGE_JOBS = 16 };

/* A command, and the file below the folder that has its result: rows/DIGEST.json, or sheets/NAME-DIGEST.html. */
typedef struct koksma__atlas_job {
    char *command;
    char file[KOKSMA_MAX_SPEC + KOKSMA__SHA256_TEXT];
    const char *id;     /* of the command in its question; of a datasheet the pattern's name */
    const char *output; /* the word after -o in `command`: a file in files/ that it makes; NULL: none */
    const char *stored; /* rows that the library carries: the command is shown, not run; NULL: none */
    char failure[256];  /* why the pattern of a datasheet has none; empty: it has one */
} koksma__atlas_job;

/* A page: a question, or one of the pages that follow the questions, and its commands. */
typedef struct koksma__atlas_page {
    koksma__json_node node;
    const char *id, *title;
    size_t number; /* of a question, from 1; 0: none */
    koksma__atlas_job *jobs;
    size_t n_jobs;
} koksma__atlas_page;

typedef struct koksma__atlas {
    const koksma_atlas_options *options;
    koksma__json *document;
    koksma__atlas_page *pages;
    size_t n_pages;
    koksma__atlas_job *jobs; /* of all pages, then n_sheets of datasheets */
    size_t n_jobs, n_sheets;
} koksma__atlas;

/* ---- atlas_text.c ---- */

/* Returns a text that the library carries, a document or stored rows, by its file's name without folder and ending;
   NULL: there is none. */
const char *koksma__atlas_text(const char *name, size_t *size);

/* Writes HTML to a page, with the special characters of its arguments escaped. The conversions are %s, %.*s and %zu. */
void koksma__atlas_print(FILE *f, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Finds the list `key` of a node and its length, 0 if there is none. Errors: MALFORMED (no list, or longer than `most`). */
koksma_status koksma__atlas_list(const koksma__json_node *node, const char *key, size_t most, koksma__json_node *list,
                                 size_t *n);

/* Writes a page up to its content. */
void koksma__atlas_put_head(FILE *f, const char *title);

/* Writes the beginning of a link if the text up to a '`' is a page of the atlas, or a document that the library carries, of
   which it writes a copy. Errors: IO, MEMORY. */
koksma_status koksma__atlas_begin_link(FILE *out, const char *folder, const char *path, bool *is_link);

/* Closes a page that was written to memory, and puts it into the folder unless `status` is an error, which it returns.
   Frees the text. Errors: IO, MEMORY. */
koksma_status koksma__atlas_close(FILE *f, const char *folder, const char *name, char **text, koksma_status status);

/* ---- atlas_page.c ---- */

/* Writes index.html and all pages from the results. Errors: MALFORMED (the questions ask for what the rows lack), IO,
   MEMORY. */
koksma_status koksma__atlas_write(const koksma__atlas *a, size_t *written);

#endif
