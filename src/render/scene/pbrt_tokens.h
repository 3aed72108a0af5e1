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
    const char *directive; /* the one that is read, for messages; or NULL */
} koksma__pbrt_source;

/* A parameter: its type and name, and its values: numbers or texts, of which the first is kept (for booleans "true" or
   "false"). There is at least one value, and each is of the parameter's type. */
typedef struct koksma__pbrt_parameter {
    char type[24], name[40], text[1024];
    char second[256]; /* the second text; "": there is none */
    double *numbers;
    size_t n, n_texts;
    unsigned long line;
} koksma__pbrt_parameter;

/* A parameter that an Attribute directive gives to all directives of this target ("shape", "light", ...) that follow. */
typedef struct koksma__pbrt_attribute {
    char target[16];
    koksma__pbrt_parameter parameter;
} koksma__pbrt_attribute;

/* The first parameter that is read as something that its type is not. */
typedef struct koksma__pbrt_mistake {
    const koksma__pbrt_parameter *at; /* NULL: none */
    const char *expected;
} koksma__pbrt_mistake;

typedef struct koksma__pbrt_parameters {
    koksma__pbrt_parameter items[KOKSMA__MAX_PBRT_PARAMETERS];
    size_t n, n_inherited; /* the first n_inherited come from Attribute directives */
    const koksma__pbrt_attribute *attributes;
    size_t n_attributes;
    const char *target; /* "": the directive inherits no attributes */
    bool *used;         /* for each parameter, whether koksma__pbrt_find has found it; or NULL */
    koksma__pbrt_mistake *mistake;
    /* judges the parameters as soon as they are read, before anything uses them; or NULL */
    koksma_status (*judge)(void *reader);
    void *reader;
    koksma__text_place place;
} koksma__pbrt_parameters;

koksma_status koksma__pbrt_token_next(koksma__pbrt_source *source, koksma__pbrt_token *out);

/* Reads the next token without consuming it. */
koksma_status koksma__pbrt_token_peek(koksma__pbrt_source *source, koksma__pbrt_token *out);

/* Read the next token, which must be a text (of less than `size` bytes), or n numbers. */
koksma_status koksma__pbrt_text(koksma__pbrt_source *source, char *out, size_t size);
koksma_status koksma__pbrt_numbers(koksma__pbrt_source *source, size_t n, double *out);

/* Reads all parameters up to the next directive, after those that the directive inherits. Errors: MALFORMED (an unknown
   type, no value, a value of another type,
   not three numbers for each point, ...). Call koksma__pbrt_parameters_fini even after an error. */
koksma_status koksma__pbrt_parameters_read(koksma__pbrt_source *source, koksma__pbrt_parameters *out);

/* Copies a parameter with its numbers. Error: MEMORY. */
koksma_status koksma__pbrt_parameter_copy(const koksma__pbrt_parameter *from, koksma__pbrt_parameter *out);
void koksma__pbrt_parameters_fini(koksma__pbrt_parameters *parameters);

/* Finds a parameter by its name; NULL if there is none. Of two with one name the last one counts, as in pbrt. */
const koksma__pbrt_parameter *koksma__pbrt_find(const koksma__pbrt_parameters *p, const char *name);

/* Whether the parameter's type is one of those in the list, as in "point3 vector3". */
bool koksma__pbrt_is(const koksma__pbrt_parameter *parameter, const char *types);

/* The same as koksma__pbrt_find for a parameter with one of these types; one of another type is a mistake. */
const koksma__pbrt_parameter *koksma__pbrt_find_typed(const koksma__pbrt_parameters *p, const char *name,
                                                      const char *types);

/* The only number, whole number, text or flag of a parameter; `otherwise` if it is missing. A parameter of another type,
   or with several values, is a mistake. A number may also be a texture or spectrum, which is not read: then the
   parameter stays unused, and the result is `otherwise`. */
double koksma__pbrt_number(const koksma__pbrt_parameters *p, const char *name, double otherwise);
double koksma__pbrt_whole(const koksma__pbrt_parameters *p, const char *name, double otherwise);
const char *koksma__pbrt_word(const koksma__pbrt_parameters *p, const char *name, const char *otherwise);
bool koksma__pbrt_flag(const koksma__pbrt_parameters *p, const char *name, bool otherwise);

/* Reads a point or vector; without it, *out stays as it is. */
void koksma__pbrt_point(const koksma__pbrt_parameters *p, const char *name, double out[3]);

/* Returns `status` or, if there was a mistake, MALFORMED with a text that names the parameter, whatever else failed. */
koksma_status koksma__pbrt_end(const koksma__pbrt_parameters *p, koksma_status status);

#endif
