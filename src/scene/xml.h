/* SPDX-License-Identifier: Apache-2.0 */
/* An XML text as a tree of elements, for Mitsuba's scenes, with included files inserted and $names replaced. */
#ifndef KOKSMA_SCENE_XML_H
#define KOKSMA_SCENE_XML_H

#include "meshes/names.h"
#include "scene/import.h"

typedef struct koksma__xml_node {
    const char *tag;
    char **attributes; /* names and values in turn, ended by NULL; their texts and the tag are in the same block */
    koksma__text_place place;
    size_t length;         /* characters of the attributes */
    int first, last, next; /* first and last child; next child of the same parent; -1: none */
} koksma__xml_node;

typedef struct koksma__xml {
    koksma__xml_node *nodes; /* the first node is the root */
    char **files;            /* names of the included files, to which the nodes' `place` points */
    char **defaults;         /* values of the $names */
    koksma__names default_names;
    size_t n, n_files, n_defaults;
} koksma__xml;

/* Parses an XML text. Errors: MALFORMED (not well-formed; a document type declaration, whose entities could grow
   without limit; nested too deep; too many elements; more text made from $names than import_text.h allows),
   UNSUPPORTED (this build lacks expat), MEMORY. Call koksma__xml_fini even after an error. */
koksma_status koksma__xml_read(koksma__import *im, const char *text, size_t size, koksma__xml *out);
void koksma__xml_fini(koksma__xml *xml);

/* The value of an attribute; NULL if the node does not have it. */
const char *koksma__xml_attribute(const koksma__xml_node *node, const char *name);

/* Whether two names are equal, ignoring case and '_' (toWorld, to_world). */
bool koksma__xml_alike(const char *a, const char *b);

#endif
