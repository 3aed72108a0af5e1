/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parses XML with expat. Elements become nodes in the order of the text. <default name value> sets $name unless
 * it was set before; <include filename> is replaced by the children of that file's <scene>, or by the object that is
 * its root; <path value> names a folder to search for files. Nothing else is loaded or expanded: a document type
 * declaration stops the parser before any entity is declared. Readers mark what they use, so that
 * koksma__xml_name_unread() finds everything that no reader knows: misspelt names above all.
 */
#include "scene/mitsuba_reader.h"

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
    for (size_t i = 0; i < xml->n_defaults; i++) {
        free(xml->defaults[i]);
    }
    KOKSMA__FREE(xml->nodes, xml->defaults);
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
static void name_element(const koksma__xml_node *parent, const koksma__xml_node *n, const char *meant)
{
    const char *name = koksma__xml_attribute(n, "name"), *type = koksma__xml_attribute(parent, "type");
    char what[80], where[136];
    snprintf(what, sizeof what, name ? "'%.60s' of" : "<%.60s> in", name ? name : n->tag);
    snprintf(where, sizeof where, type ? "%.60s '%.60s'" : "%.60s", parent->tag, type);
    koksma__import_unknown(n->place, "%s %s is ignored%s", what, where, meant);
}

/* Warns about the attributes of an element that no reader has looked up; all elements may have a name and an id. */
static void name_attributes(const koksma__xml_node *n)
{
    for (size_t i = 0; n->attributes[i]; i += 2) {
        const char *name = n->attributes[i];
        koksma__import_unknown_if(!n->marks[1 + i / 2] && strcmp(name, "name") != 0 && strcmp(name, "id") != 0,
                                  n->place, "attribute '%.60s' of <%.60s> is ignored", name, n->tag);
    }
}

void koksma__xml_name_unread(koksma__import *im, const koksma__xml *xml, koksma__xml_meant *meant,
                             const void *context)
{
    char text[KOKSMA__OR_MEANT];
    /* parents precede their children, so that marks go down the tree in one pass */
    for (size_t i = 0; i < xml->n && !koksma__import_is_full(im); i++) {
        const koksma__xml_node *n = &xml->nodes[i];
        const bool covered = n->marks[0] & KOKSMA__XML_COVERED;
        koksma__import_spend(n->place, 1);
        if (!covered) {
            name_attributes(n);
        }
        for (int c = n->first; c >= 0 && !koksma__import_is_full(im); c = xml->nodes[c].next) {
            const koksma__xml_node *child = &xml->nodes[c];
            const bool taken = child->marks[0] & KOKSMA__XML_TAKEN;
            if (!covered && !taken) {
                name_element(n, child, meant(context, n, child, text));
            }
            koksma__xml_mark(child, covered || !taken ? KOKSMA__XML_COVERED : 0);
        }
    }
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

/* The state while one file is parsed. Functions that expat calls do not jump out of it: a failure within them stops the
   parser. */
typedef struct reading {
    koksma__import *im;
    koksma__xml *xml;
    XML_Parser parser;
    const char *file;
    koksma_status status;
    const char *tag, **attributes; /* of the element that is read, at this place */
    koksma__text_place place;
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
    return (koksma__text_place){r->im, r->file, XML_GetCurrentLineNumber(r->parser)};
}

/* Adds a text to r->texts, with the values of $names in place of the names. */
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
            koksma__import_fail_if(!from, r->place, "no default for '%.*s'", (int)taken, value);
            length = strlen(from);
            surplus += length;
        }
        koksma__import_fail_if(used + length > MOST_VALUE, r->place, "a value is longer than %d characters",
                               MOST_VALUE);
        koksma__import_pass(r->place, koksma__reserve(&r->texts, &r->texts_capacity, r->n_texts + length + 1, 1));
        memcpy(r->texts + r->n_texts, from, length);
        r->n_texts += length;
        used += length;
        value += taken;
    }
    koksma__import_spend(r->place, surplus / KOKSMA__STEP_TEXT);
    koksma__import_pass(r->place, koksma__reserve(&r->texts, &r->texts_capacity, r->n_texts + 1, 1));
    r->texts[r->n_texts++] = 0;
}

static void add_default(reading *r, const koksma__xml_node *node)
{
    const char *name = koksma__xml_attribute(node, "name"), *value = koksma__xml_attribute(node, "value");
    koksma__xml *to = r->xml;
    size_t index;
    if (name && value && !koksma__names_find(&to->default_names, name, strlen(name), &index)) {
        koksma__import_hold(node->place, strlen(value) + KOKSMA__HELD_WITH_NAME);
        char **kept = koksma__import_add(node->place, &to->defaults, &to->n_defaults, sizeof *kept);
        *kept = strdup(value);
        koksma__import_pass(node->place, *kept ? KOKSMA_OK : koksma__fail_memory(strlen(value)));
        koksma__import_put_name(node->place, &to->default_names, name, to->n_defaults - 1);
    }
}

static void include(reading *r, const koksma__xml_node *node, int parent)
{
    const char *name = koksma__xml_attribute(node, "filename");
    koksma__import_fail_if(!name, node->place, "<include> without filename");
    koksma__import_fail_if(r->included == MOST_INCLUDED, node->place, "files include each other more than %d deep",
                           MOST_INCLUDED);
    const koksma__open_text text = koksma__import_text(node->place, name);
    koksma__import_pass(node->place,
                        read_text(r->im, r->xml, text.name, text.bytes, text.size, parent, r->included + 1));
    koksma__import_text_close(r->im);
}

static void add_folder(koksma__text_place place, const char *name)
{
    koksma__import *im = place.im;
    char with_slash[KOKSMA__MAX_PATH];
    koksma__import_fail_if(!name, place, "<path> without value");
    koksma__import_fail_if(im->n_folders == sizeof im->folders / sizeof *im->folders, place, "more than %zu paths",
                           im->n_folders);
    koksma__import_fail_if((size_t)snprintf(with_slash, sizeof with_slash, "%s/", name) >= sizeof with_slash ||
                               !koksma__path_beside(im->path, with_slash, im->folders[im->n_folders++]),
                           place, "the path is too long");
}

/* Makes the block of memory that has a node's attributes, its tag and their texts, from those in r->texts. */
static void set_texts(reading *r, koksma__xml_node *node, size_t n)
{
    const size_t texts = (n + 1) * sizeof *node->attributes, size = texts + r->n_texts + 1 + n / 2;
    koksma__import_hold(node->place, HELD_WITH_NODE + size);
    node->attributes = malloc(size);
    koksma__import_pass(node->place, node->attributes ? KOKSMA_OK : koksma__fail_memory(size));
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

/* Adds a node for the element that is read to the children of its parent. */
static int add_node(reading *r, int parent)
{
    koksma__xml *to = r->xml;
    size_t n = 0;
    koksma__import_fail_if(to->n == MOST_NODES, r->place, "more than %d elements", MOST_NODES);
    koksma__xml_node *node = koksma__import_add(r->place, &to->nodes, &to->n, sizeof *node);
    *node = (koksma__xml_node){.place = r->place, .first = -1, .last = -1, .next = -1};
    r->n_texts = 0;
    add_text(r, r->tag);
    for (; r->attributes[n]; n++) {
        add_text(r, r->attributes[n]);
    }
    set_texts(r, node, n);
    const int self = (int)to->n - 1;
    if (parent >= 0) {
        koksma__xml_node *above = &to->nodes[parent];
        *(above->last < 0 ? &above->first : &to->nodes[above->last].next) = self;
        above->last = self;
    }
    return self;
}

static void read_element(void *data)
{
    reading *r = data;
    koksma__import_fail_if(r->depth == MOST_DEPTH, r->place, "elements are nested more than %d deep", MOST_DEPTH);
    const int parent = r->open[r->depth];
    const bool is_included_root = r->depth == 0 && r->included;
    /* the children of an included scene go to the including element's parent, and any other object goes there itself */
    if (is_included_root && !strcmp(r->tag, "scene")) {
        r->open[++r->depth] = parent;
        return;
    }
    const char *tag = r->tag;
    const int number = add_node(r, parent);
    r->open[++r->depth] = number;
    const koksma__xml_node node = r->xml->nodes[number]; /* including a file may move the array */
    if (is_included_root) {
        (void)koksma__xml_attribute(&node, "version");
        koksma__import_fail_if(!koksma__xml_attribute(&node, "type"), node.place,
                               "an included file is a <%.60s>; it must be a <scene> or an object with a 'type'", tag);
    }
    if (!strcmp(tag, "default")) {
        add_default(r, &node);
    } else if (!strcmp(tag, "include")) {
        include(r, &node, parent);
    } else if (!strcmp(tag, "path")) {
        add_folder(node.place, koksma__xml_attribute(&node, "value"));
    }
}

static void stop(reading *r, koksma_status status)
{
    if (status) {
        r->status = status;
        XML_StopParser(r->parser, XML_FALSE);
    }
}

static void start_element(void *data, const char *tag, const char **attributes)
{
    reading *r = data;
    r->tag = tag;
    r->attributes = attributes;
    r->place = here(r);
    if (!r->status) {
        stop(r, koksma__import_try(r->im, read_element, r));
    }
}

static void end_element(void *data, const char *tag)
{
    reading *r = data;
    (void)tag;
    r->depth--;
}

static void refuse(void *data)
{
    koksma__import_fail(here(data), "a document type declaration is not allowed in a scene");
}

static void refuse_doctype(void *data, const char *name, const char *system, const char *public, int internal)
{
    reading *r = data;
    (void)name, (void)system, (void)public, (void)internal;
    stop(r, koksma__import_try(r->im, refuse, r));
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

/* The failure of a parser that has stopped or could not be made. */
static koksma_status fail_parser(koksma__text_place place, enum XML_Error error, size_t size)
{
    KOKSMA__FAIL_IF(error != XML_ERROR_NO_MEMORY, KOKSMA_MALFORMED, "%s:%lu: %s", place.file, place.line,
                    XML_ErrorString(error));
    KOKSMA__FAIL_IF(is_too_much, KOKSMA_MALFORMED,
                    "%s:%lu: the names and attributes up to here take more than %d MiB", place.file, place.line,
                    MOST_PARSER >> 20);
    return koksma__fail_memory(size);
}

static koksma_status read_text(koksma__import *im, koksma__xml *xml, const char *file, const char *text, size_t size,
                               int parent, int included)
{
    static const XML_Memory_Handling_Suite memory = {parser_malloc, parser_realloc, parser_free};
    is_too_much = false;
    reading r = {
        .im = im, .xml = xml, .file = file, .parser = XML_ParserCreate_MM(NULL, &memory, NULL), .included = included};
    if (!r.parser) {
        return fail_parser((koksma__text_place){im, file, 1}, XML_ERROR_NO_MEMORY, size);
    }
    r.open[0] = parent;
    XML_SetUserData(r.parser, &r);
    XML_SetElementHandler(r.parser, start_element, end_element);
    XML_SetStartDoctypeDeclHandler(r.parser, refuse_doctype);
    if (XML_Parse(r.parser, text, (int)size, 1) == XML_STATUS_ERROR && !r.status) {
        r.status = fail_parser(here(&r), XML_GetErrorCode(r.parser), size);
    }
    XML_ParserFree(r.parser);
    free(r.texts);
    return r.status;
}

void koksma__xml_read(koksma__import *im, const char *text, size_t size, koksma__xml *out)
{
    koksma__import_pass((koksma__text_place){.im = im}, read_text(im, out, im->path, text, size, -1, 0));
}

#else

void koksma__xml_read(koksma__import *im, const char *text, size_t size, koksma__xml *out)
{
    (void)text, (void)size, (void)out;
    koksma__import_pass((koksma__text_place){.im = im},
                        koksma__fail(KOKSMA_UNSUPPORTED, "%s: this build has no expat, which reads XML", im->path));
}

#endif
