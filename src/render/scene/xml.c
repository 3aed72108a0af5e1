/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parses XML with expat. Elements become nodes in the order of the text. <default name value> sets $name unless
 * it was set before; <include filename> is replaced by the children of that file's <scene>, or by the object that is
 * its root; <path value> names a folder to search for files. Nothing else is loaded or expanded: a document type
 * declaration stops the parser before any entity is declared. Readers mark what they use, so that
 * koksma__xml_name_unread() finds everything that no reader knows: misspelt names above all.
 */
#include "scene/mitsuba.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"

#ifdef KOKSMA_EXPAT
#include <expat.h>
#endif

void koksma__xml_fini(koksma__xml *xml)
{
    for (size_t i = 0; i < xml->n; i++) {
        free(xml->nodes[i].attributes);
    }
    for (size_t i = 0; i < xml->n_files; i++) {
        free(xml->files[i]);
    }
    for (size_t i = 0; i < xml->n_defaults; i++) {
        free(xml->defaults[i]);
    }
    KOKSMA__FREE(xml->nodes, xml->files, xml->defaults);
    koksma__names_fini(&xml->default_names);
}

const char *koksma__xml_attribute(const koksma__xml_node *node, const char *name)
{
    for (size_t i = 0; node->attributes[i]; i += 2) {
        if (!strcmp(node->attributes[i], name)) {
            node->marks[1 + i / 2] = 1;
            return node->attributes[i + 1];
        }
    }
    return NULL;
}

/* Warns about an element that no reader has taken. */
static koksma_status name_element(koksma__import *im, const koksma__xml_node *parent, const koksma__xml_node *n,
                                  const char *meant)
{
    const char *name = koksma__xml_attribute(n, "name"), *type = koksma__xml_attribute(parent, "type");
    char what[80], where[136];
    snprintf(what, sizeof what, name ? "'%.60s' of" : "<%.60s> in", name ? name : n->tag);
    snprintf(where, sizeof where, type ? "%.60s '%.60s'" : "%.60s", parent->tag, type);
    return koksma__import_unknown(im, n->place, "%s %s is ignored%s", what, where, meant);
}

/* Warns about the attributes of an element that no reader has looked up; all elements may have a name and an id. */
static koksma_status name_attributes(koksma__import *im, const koksma__xml_node *n)
{
    for (size_t i = 0; n->attributes[i]; i += 2) {
        const char *name = n->attributes[i];
        if (!n->marks[1 + i / 2] && strcmp(name, "name") != 0 && strcmp(name, "id") != 0) {
            KOKSMA__TRY(
                koksma__import_unknown(im, n->place, "attribute '%.60s' of <%.60s> is ignored", name, n->tag));
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__xml_name_unread(koksma__import *im, const koksma__xml *xml, koksma__xml_meant *meant,
                                      const void *context)
{
    char text[KOKSMA__OR_MEANT];
    /* parents precede their children, so that marks go down the tree in one pass */
    for (size_t i = 0; i < xml->n && !koksma__import_is_full(im); i++) {
        const koksma__xml_node *n = &xml->nodes[i];
        const bool covered = n->marks[0] & KOKSMA__XML_COVERED;
        KOKSMA__TRY(koksma__import_spend(im, n->place, 1));
        KOKSMA__TRY(covered ? KOKSMA_OK : name_attributes(im, n));
        for (int c = n->first; c >= 0 && !koksma__import_is_full(im); c = xml->nodes[c].next) {
            const koksma__xml_node *child = &xml->nodes[c];
            KOKSMA__TRY(covered || child->marks[0] & KOKSMA__XML_TAKEN
                            ? KOKSMA_OK
                            : name_element(im, n, child, meant(context, n, child, text)));
            koksma__xml_mark(child, covered || !(child->marks[0] & KOKSMA__XML_TAKEN) ? KOKSMA__XML_COVERED : 0);
        }
    }
    return KOKSMA_OK;
}

bool koksma__xml_alike(const char *text, const char *name, size_t length)
{
    const char *end = name + length;
    for (bool in_capitals = false; *text; text++, name++) {
        const bool capital = isupper((unsigned char)*text);
        if (capital && name < end && *name == '_') {
            name++;
        } else if (capital && !in_capitals) {
            return false;
        }
        if (name >= end || tolower((unsigned char)*text) != *name) {
            return false;
        }
        in_capitals = capital;
    }
    return name == end;
}

#ifdef KOKSMA_EXPAT

enum { MOST_DEPTH = 64, MOST_INCLUDED = 16, MOST_NODES = 1 << 20, MOST_VALUE = 1 << 16 };

/* What the C library and the readers take for each node beside its texts. */
enum { HELD_WITH_NODE = 64 + sizeof(koksma__xml_node) };

/* The state while one file is parsed. */
typedef struct reading {
    koksma__import *im;
    koksma__xml *xml;
    XML_Parser parser;
    const char *file;
    koksma_status status;
    /* for each depth, the node to which children are added; -1: no node, at the root of the scene's own file */
    int open[MOST_DEPTH + 1];
    int depth, included;
    char *texts; /* the tag and the attributes of the element that is read, each ended by a zero byte */
    size_t n_texts, texts_capacity;
} reading;

static koksma_status read_text(koksma__import *im, koksma__xml *xml, const char *file, const char *text, size_t size,
                               int parent, int included);

static koksma__text_place here(const reading *r)
{
    return (koksma__text_place){r->file, XML_GetCurrentLineNumber(r->parser)};
}

static void stop(reading *r, koksma_status status)
{
    if (status && !r->status) {
        r->status = status;
        XML_StopParser(r->parser, XML_FALSE);
    }
}

static void fail_memory(reading *r)
{
    stop(r, r->status ? r->status : koksma__fail_memory(MOST_VALUE));
}

/* Adds a text to r->texts, with the values of $names in place of the names; sets r->status after an error. */
static void add_text(reading *r, const char *value)
{
    size_t used = 0, surplus = 0, index;
    while (*value) {
        const char *from = value;
        size_t length = strcspn(value, "$"), taken = length;
        if (*value == '$') {
            taken = 1 + strspn(value + 1, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_");
            from = koksma__names_find(&r->xml->default_names, value + 1, taken - 1, &index) ? r->xml->defaults[index]
                                                                                            : NULL;
            length = from ? strlen(from) : 0;
            surplus += length;
        }
        if (!from || used + length > MOST_VALUE) {
            stop(r, from ? koksma__import_fail(here(r), "a value is longer than %d characters", MOST_VALUE)
                         : koksma__import_fail(here(r), "no default for '%.*s'", (int)taken, value));
            return;
        }
        stop(r, koksma__reserve(&r->texts, &r->texts_capacity, r->n_texts + length + 1, 1));
        if (r->status) {
            return;
        }
        memcpy(r->texts + r->n_texts, from, length);
        r->n_texts += length;
        used += length;
        value += taken;
    }
    stop(r, koksma__import_spend(r->im, here(r), surplus / KOKSMA__STEP_TEXT));
    stop(r, koksma__reserve(&r->texts, &r->texts_capacity, r->n_texts + 1, 1));
    if (!r->status) {
        r->texts[r->n_texts++] = 0;
    }
}

static void add_default(reading *r, const koksma__xml_node *node)
{
    const char *name = koksma__xml_attribute(node, "name"), *value = koksma__xml_attribute(node, "value");
    size_t index;
    if (!name || !value || koksma__names_find(&r->xml->default_names, name, strlen(name), &index)) {
        return;
    }
    stop(r, koksma__import_hold(r->im, node->place, strlen(value) + KOKSMA__HELD_WITH_NAME));
    if (r->status) {
        return;
    }
    char **to = koksma__add_one(&r->xml->defaults, &r->xml->n_defaults, sizeof *to);
    if (to) {
        *to = strdup(value);
    }
    if (!to || !*to || koksma__names_put(&r->xml->default_names, name, strlen(name), r->xml->n_defaults - 1)) {
        fail_memory(r);
    }
}

static void include(reading *r, const koksma__xml_node *node, int parent)
{
    const char *name = koksma__xml_attribute(node, "filename");
    const koksma__text_place place = node->place;
    char *bytes = NULL, *kept = name ? strdup(name) : NULL;
    size_t size = 0;
    if (!name || r->included == MOST_INCLUDED) {
        free(kept);
        stop(r, name ? koksma__import_fail(place, "files include each other more than %d deep", MOST_INCLUDED)
                     : koksma__import_fail(place, "<include> without filename"));
        return;
    }
    char **file = koksma__add_one(&r->xml->files, &r->xml->n_files, sizeof *file);
    if (!kept || !file) {
        free(kept);
        r->xml->n_files -= file != NULL;
        fail_memory(r);
        return;
    }
    *file = kept;
    koksma_status status = koksma__import_text(r->im, place, kept, &bytes, &size);
    status = status ? status : read_text(r->im, r->xml, kept, bytes, size, parent, r->included + 1);
    koksma__import_text_close(r->im, bytes, size);
    stop(r, status);
}

/* Makes the block of memory that has a node's attributes, its tag and their texts, from those in r->texts. */
static void set_texts(reading *r, koksma__xml_node *node, size_t n)
{
    const size_t texts = (n + 1) * sizeof *node->attributes, size = texts + r->n_texts + 1 + n / 2;
    stop(r, koksma__import_hold(r->im, node->place, HELD_WITH_NODE + size));
    node->attributes = r->status ? NULL : malloc(size);
    if (!node->attributes) {
        fail_memory(r);
        return;
    }
    char *at = memcpy(node->attributes + n + 1, r->texts, r->n_texts);
    node->tag = at;
    for (size_t i = 0; i < n; i++) {
        at += strlen(at) + 1;
        node->attributes[i] = at;
        node->length += strlen(at);
    }
    node->attributes[n] = NULL;
    node->marks = memset((char *)node->attributes + texts + r->n_texts, 0, 1 + n / 2);
}

/* Adds a node for an element to the children of its parent. */
static int add_node(reading *r, const char *tag, const char **attributes, int parent)
{
    size_t n = 0;
    if (r->xml->n == MOST_NODES) {
        stop(r, koksma__import_fail(here(r), "more than %d elements", MOST_NODES));
        return -1;
    }
    koksma__xml_node *node = koksma__add_one(&r->xml->nodes, &r->xml->n, sizeof *node);
    if (!node) {
        fail_memory(r);
        return -1;
    }
    *node = (koksma__xml_node){.place = here(r), .first = -1, .last = -1, .next = -1};
    r->n_texts = 0;
    add_text(r, tag);
    for (; attributes[n] && !r->status; n++) {
        add_text(r, attributes[n]);
    }
    if (!r->status) {
        set_texts(r, node, n);
    }
    const int self = (int)r->xml->n - 1;
    if (parent >= 0 && !r->status) {
        koksma__xml_node *above = &r->xml->nodes[parent];
        *(above->last < 0 ? &above->first : &r->xml->nodes[above->last].next) = self;
        above->last = self;
    }
    return self;
}

static void start_element(void *data, const char *tag, const char **attributes)
{
    reading *r = data;
    if (r->status) {
        return;
    }
    if (r->depth == MOST_DEPTH) {
        stop(r, koksma__import_fail(here(r), "elements are nested more than %d deep", MOST_DEPTH));
        return;
    }
    const int parent = r->open[r->depth];
    const bool is_included_root = r->depth == 0 && r->included;
    /* the children of an included scene go to the including element's parent, and any other object goes there itself */
    if (is_included_root && !strcmp(tag, "scene")) {
        r->open[++r->depth] = parent;
        return;
    }
    const int node = add_node(r, tag, attributes, parent);
    r->open[++r->depth] = node;
    if (!r->status && is_included_root) {
        (void)koksma__xml_attribute(&r->xml->nodes[node], "version");
    }
    if (!r->status && is_included_root && !koksma__xml_attribute(&r->xml->nodes[node], "type")) {
        stop(r, koksma__import_fail(
                    here(r), "an included file is a <%.60s>; it must be a <scene> or an object with a 'type'", tag));
    }
    if (!r->status && !strcmp(tag, "default")) {
        add_default(r, &r->xml->nodes[node]);
    } else if (!r->status && !strcmp(tag, "include")) {
        const koksma__xml_node copy = r->xml->nodes[node]; /* including a file may move the array */
        include(r, &copy, parent);
    } else if (!r->status && !strcmp(tag, "path")) {
        const char *folder = koksma__xml_attribute(&r->xml->nodes[node], "value");
        stop(r, folder ? koksma__import_folder(r->im, here(r), folder)
                       : koksma__import_fail(here(r), "<path> without value"));
    }
}

static void end_element(void *data, const char *tag)
{
    reading *r = data;
    (void)tag;
    r->depth--;
}

static void refuse_doctype(void *data, const char *name, const char *system, const char *public, int internal)
{
    reading *r = data;
    (void)name, (void)system, (void)public, (void)internal;
    stop(r, koksma__import_fail(here(r), "a document type declaration is not allowed in a scene"));
}

/* The memory of expat, which has dozens of bytes for each name and attribute of a text. Its functions have no context, so
   that the parsers of a thread, which are those of texts that include one another, share the sum. */
enum { MOST_PARSER = 128 << 20 };
static _Thread_local size_t parser_bytes;
static _Thread_local bool is_too_much;

typedef union block {
    size_t size;
    max_align_t aligned;
} block;

static void *parser_realloc(void *old, size_t size)
{
    block *b = old ? (block *)old - 1 : NULL;
    const size_t others = parser_bytes - (b ? b->size : 0);
    if (size > MOST_PARSER || others > MOST_PARSER - size) {
        is_too_much = true;
        return NULL;
    }
    b = realloc(b, sizeof *b + size);
    if (!b) {
        return NULL;
    }
    b->size = size;
    parser_bytes = others + size;
    return b + 1;
}

static void *parser_malloc(size_t size)
{
    return parser_realloc(NULL, size);
}

static void parser_free(void *old)
{
    if (old) {
        parser_bytes -= ((block *)old - 1)->size;
        free((block *)old - 1);
    }
}

/* The failure of a parser that did not get the memory it asked for. */
static koksma_status fail_parser_memory(koksma__text_place place, size_t size)
{
    return is_too_much ? koksma__import_fail(place, "the names and attributes up to here take more than %d MiB",
                                             MOST_PARSER >> 20)
                       : koksma__fail_memory(size);
}

static koksma_status fail_parser(reading *r, size_t size)
{
    const enum XML_Error error = XML_GetErrorCode(r->parser);
    return error == XML_ERROR_NO_MEMORY ? fail_parser_memory(here(r), size)
                                        : koksma__import_fail(here(r), "%s", XML_ErrorString(error));
}

static koksma_status read_text(koksma__import *im, koksma__xml *xml, const char *file, const char *text, size_t size,
                               int parent, int included)
{
    static const XML_Memory_Handling_Suite memory = {parser_malloc, parser_realloc, parser_free};
    is_too_much = false;
    reading r = {
        .im = im, .xml = xml, .file = file, .parser = XML_ParserCreate_MM(NULL, &memory, NULL), .included = included};
    if (!r.parser) {
        return fail_parser_memory((koksma__text_place){file, 1}, size);
    }
    r.open[0] = parent;
    XML_SetUserData(r.parser, &r);
    XML_SetElementHandler(r.parser, start_element, end_element);
    XML_SetStartDoctypeDeclHandler(r.parser, refuse_doctype);
    if (XML_Parse(r.parser, text, (int)size, 1) == XML_STATUS_ERROR && !r.status) {
        r.status = fail_parser(&r, size);
    }
    XML_ParserFree(r.parser);
    free(r.texts);
    return r.status;
}

koksma_status koksma__xml_read(koksma__import *im, const char *text, size_t size, koksma__xml *out)
{
    return read_text(im, out, im->path, text, size, -1, 0);
}

#else

koksma_status koksma__xml_read(koksma__import *im, const char *text, size_t size, koksma__xml *out)
{
    (void)text, (void)size, (void)out;
    return koksma__fail(KOKSMA_UNSUPPORTED, "%s: this build has no expat, which reads XML", im->path);
}

#endif
