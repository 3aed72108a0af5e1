/* SPDX-License-Identifier: Apache-2.0 */
/* Words, texts and parameter lists of pbrt-v4's scene files, with their lines. */
#ifndef KOKSMA_SCENE_PBRT_TOKENS_H
#define KOKSMA_SCENE_PBRT_TOKENS_H

#include "scene/import.h"

enum { KOKSMA__MAX_PBRT_PARAMETERS = 64 };

typedef enum koksma__pbrt_kind {
    KOKSMA__PBRT_END,
    KOKSMA__PBRT_WORD,
    KOKSMA__PBRT_TEXT,
    KOKSMA__PBRT_BRACKET
} koksma__pbrt_kind;

/* A token, which refers to the text of the file; a text comes without its quotation marks. */
typedef struct koksma__pbrt_token {
    koksma__pbrt_kind kind;
    const char *at;
    size_t length;
} koksma__pbrt_token;

typedef struct koksma__pbrt_source {
    const char *at, *end; /* the text ends with a zero byte */
    koksma__text_place place;
} koksma__pbrt_source;

/* A parameter: its type and name, and its values, which are numbers, or its first text (for booleans "true" or
   "false"). */
typedef struct koksma__pbrt_parameter {
    char type[24], name[40], text[1024];
    double *numbers;
    size_t n, n_texts;
} koksma__pbrt_parameter;

typedef struct koksma__pbrt_parameters {
    koksma__pbrt_parameter items[KOKSMA__MAX_PBRT_PARAMETERS];
    size_t n;
    bool *used; /* for each parameter, whether koksma__pbrt_find has found it; or NULL */
    koksma__text_place place;
} koksma__pbrt_parameters;

koksma_status koksma__pbrt_token_next(koksma__pbrt_source *source, koksma__pbrt_token *out);

/* Reads the next token without consuming it. */
koksma_status koksma__pbrt_token_peek(koksma__pbrt_source *source, koksma__pbrt_token *out);

/* Read the next token, which must be a text (of less than `size` bytes), or n numbers. */
koksma_status koksma__pbrt_text(koksma__pbrt_source *source, char *out, size_t size);
koksma_status koksma__pbrt_numbers(koksma__pbrt_source *source, size_t n, double *out);

/* Reads all parameters up to the next directive. Call koksma__pbrt_parameters_fini even after an error. */
koksma_status koksma__pbrt_parameters_read(koksma__pbrt_source *source, koksma__pbrt_parameters *out);
void koksma__pbrt_parameters_fini(koksma__pbrt_parameters *parameters);

/* Find a parameter by its name; return the parameter itself, or its number, text or flag. If the parameter is
   missing, return NULL or `otherwise`. */
const koksma__pbrt_parameter *koksma__pbrt_find(const koksma__pbrt_parameters *p, const char *name);
double koksma__pbrt_number(const koksma__pbrt_parameters *p, const char *name, double otherwise);
const char *koksma__pbrt_word(const koksma__pbrt_parameters *p, const char *name, const char *otherwise);
bool koksma__pbrt_flag(const koksma__pbrt_parameters *p, const char *name, bool otherwise);

#endif
