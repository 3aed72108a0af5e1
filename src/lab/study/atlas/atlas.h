/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of the atlas: atlas_build.c runs the commands, atlas_page.c writes the pages. */
#ifndef KOKSMA_STUDY_ATLAS_ATLAS_H
#define KOKSMA_STUDY_ATLAS_ATLAS_H

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

/* Writes index.html and all pages from the results. Errors: MALFORMED (the questions ask for what the rows lack), IO,
   MEMORY. */
koksma_status koksma__atlas_write(const koksma__atlas *a, size_t *written);

#endif
