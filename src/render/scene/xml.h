/* SPDX-License-Identifier: Apache-2.0 */
/* An XML text as a tree of elements, for Mitsuba's scenes, with included files inserted and $names replaced. */
#ifndef KOKSMA_SCENE_XML_H
#define KOKSMA_SCENE_XML_H

#include "meshes/names.h"
#include "scene/import.h"

/* Marks of an element: TAKEN: a reader has taken it for what its parent may contain; COVERED: a warning says already what
   becomes of all that it contains. */
enum { KOKSMA__XML_TAKEN = 1, KOKSMA__XML_COVERED = 2 };

typedef struct koksma__xml_node {
    const char *tag;
    char **
        attributes; /* names and values in turn, ended by NULL; their texts, the tag and `marks` are in the same block */
    unsigned char *marks; /* those of the element; then, for each attribute, whether it was looked up */
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

/* The value of an attribute, which is marked as looked up; NULL if the node does not have it. */
const char *koksma__xml_attribute(const koksma__xml_node *node, const char *name);

/* Marks a node. */
static inline void koksma__xml_mark(const koksma__xml_node *node, unsigned char marks)
{
    node->marks[0] |= marks;
}

/* Warns about each element that no reader has taken, and each attribute that none has looked up, in the whole tree but for
   what is covered. Errors: MEMORY, MALFORMED (koksma__import_spend). */
koksma_status koksma__xml_name_unread(koksma__import *im, const koksma__xml *xml);

/* Whether a text has this name, as it is or in the form of Mitsuba 0.6: a capital is in place of '_' (toWorld, intIOR). */
bool koksma__xml_alike(const char *text, const char *name);

#endif
