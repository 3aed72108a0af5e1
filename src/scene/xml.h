/* SPDX-License-Identifier: Apache-2.0 */
/* An XML text as a tree of elements, for Mitsuba's scenes: with its includes in their places and $names replaced. */
#ifndef KOKSMA_SCENE_XML_H
#define KOKSMA_SCENE_XML_H

#include "scene/import.h"

typedef struct koksma__xml_node {
    char *tag;
    char **attributes; /* name, value, name, value, NULL */
    koksma__text_place place;
    int first, last, next; /* children; the next one of the same parent; -1: none */
} koksma__xml_node;

typedef struct koksma__xml {
    koksma__xml_node *nodes; /* the first one is the root */
    char **files;            /* names of includes */
    struct koksma__xml_default *defaults;
    size_t n, n_files, n_defaults;
} koksma__xml;

/* Errors: MALFORMED (no well-formed XML; a document type, whose entities could grow without end; too deep; too many),
   UNSUPPORTED (this build lacks expat), MEMORY. fini whatever comes of it. */
koksma_status koksma__xml_read(koksma__import *im, const char *text, size_t size, koksma__xml *out);
void koksma__xml_fini(koksma__xml *xml);

/* The value of an attribute; NULL: it isn't there. */
const char *koksma__xml_attribute(const koksma__xml_node *node, const char *name);

/* Whether two names are one: case and '_' don't count (toWorld, to_world). */
bool koksma__xml_alike(const char *a, const char *b);

#endif
