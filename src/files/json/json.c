/* SPDX-License-Identifier: Apache-2.0 */
/* Reads JSON files with jansson and reports errors with file, line and path. jansson does not store the lines of
   values; after an error a small scanner therefore reads the text again to find the line of a node. */
#include "json/json.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/status.h"

struct koksma__json {
    json_t *root;
    char *kind, *name, *text;
    size_t size;
};

/* ---- Finding the line of a node ----------------------------------------------------------------------- */

typedef struct walker {
    const char *at, *end;
} walker;

static void skip_space(walker *w)
{
    while (w->at < w->end && strchr(" \t\r\n", *w->at)) {
        w->at++;
    }
}

static void skip_string(walker *w)
{
    for (w->at++; w->at < w->end && *w->at != '"'; w->at++) {
        w->at += *w->at == '\\';
    }
    w->at++;
}

/* Skips one value of a text that is known to be JSON. */
static void skip_value(walker *w)
{
    int depth = 0;
    skip_space(w);
    do {
        if (w->at < w->end && *w->at == '"') {
            skip_string(w);
        } else if (w->at < w->end && strchr("[{", *w->at)) {
            depth++;
            w->at++;
        } else if (w->at < w->end && strchr("]}", *w->at)) {
            depth--;
            w->at++;
        } else if (depth) {
            w->at++;
        } else {
            while (w->at < w->end && !strchr(",]} \t\r\n", *w->at)) {
                w->at++;
            }
        }
    } while (depth && w->at < w->end);
}

/* Moves from the start of a list or object to the start of its item or member number `index`. */
static bool enter(walker *w, size_t index)
{
    const bool object = w->at < w->end && *w->at == '{';
    w->at++;
    for (size_t i = 0; w->at < w->end; i++) {
        skip_space(w);
        if (object) {
            skip_string(w);
            skip_space(w);
            w->at++; /* skip the colon */
            skip_space(w);
        }
        if (i == index) {
            return w->at < w->end;
        }
        skip_value(w);
        skip_space(w);
        w->at++; /* skip the comma */
    }
    return false;
}

/* Returns the index of the member with this key in the text; jansson keeps members in the text's order. */
static size_t number_of(const json_t *object, const char *key)
{
    size_t number = 0;
    for (void *i = json_object_iter((json_t *)(uintptr_t)object); i && json_object_iter_key(i) != key;
         i = json_object_iter_next((json_t *)(uintptr_t)object, i)) {
        number++;
    }
    return number;
}

size_t koksma__json_line_of(const koksma__json_node *node)
{
    const char *text = node->document->text;
    const json_t *value = node->document->root;
    walker w = {text, text + node->document->size};
    skip_space(&w);
    for (int i = 0; i < node->n_steps; i++) {
        const koksma__json_step step = node->steps[i];
        const walker before = w;
        if (!enter(&w, step.key ? number_of(value, step.key) : step.item)) {
            w = before;
            break;
        }
        value = step.key ? json_object_get(value, step.key) : json_array_get(value, step.item);
    }
    size_t line = 1;
    for (const char *c = text; c < w.at && c < w.end; c++) {
        line += *c == '\n';
    }
    return line;
}

const char *koksma__json_document(const koksma__json_node *node)
{
    return node->document->name;
}

koksma_status koksma__json_fail(const koksma__json_node *node, const char *format, ...)
{
    char reason[512];
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    const koksma__json *d = node->document;
    return koksma__fail(KOKSMA_MALFORMED, "%s '%s': line %zu: %s%s%s", d->kind, d->name, koksma__json_line_of(node),
                        node->path, *node->path ? ": " : "", reason);
}

koksma_status koksma__json_fail_in(const koksma__json_node *node, koksma_status status)
{
    koksma__json_fail(node, "%s", koksma_error_text());
    return koksma_status_exit_code(status) == koksma_status_exit_code(KOKSMA_SYSTEM) ? status : KOKSMA_MALFORMED;
}

/* ---- Documents and nodes --------------------------------------------------------------------------------- */

/* Parses the text. It first checks that twice the memory of the longest possible string is free, because jansson 2.14
   ignores a failed allocation for a longer string and writes past the end of the old memory (lex_save() in its
   load.c). */
static koksma_status read_text(koksma__json *d, json_error_t *error)
{
    const size_t room = 4 * d->size + 4096;
    char *volatile there = malloc(room); /* volatile, because otherwise the compiler may remove an allocation that is
                                            only freed */
    KOKSMA__REQUIRE_MEMORY(there, room);
    memset(there, 1, room); /* write to the memory, because malloc may succeed although there is not enough */
    free(there);
    d->root = json_loadb(d->text, d->size, JSON_REJECT_DUPLICATES, error);
    return KOKSMA_OK;
}

enum { REASON = 2 * JSON_ERROR_TEXT_LENGTH };

/* The reason of a malformed text. Where jansson's names a constant or a limit of its own, it is in words of JSON. */
static const char *reason_of(const json_error_t *error, char out[REASON])
{
    static const struct {
        const char *theirs, *ours;
    } words[] = {
        {"\\u0000 is not allowed without JSON_ALLOW_NUL", "a text must not contain the zero character \\u0000"},
        {"NUL byte in object key not supported", "a key must not contain the zero character \\u0000"}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const size_t length = strlen(words[i].theirs);
        if (!strncmp(error->text, words[i].theirs, length)) {
            snprintf(out, REASON, "%s%s", words[i].ours, error->text + length);
            return out;
        }
    }
    static const struct {
        const char *near, *hint;
    } hints[] = {{"'[' or '{' expected near", "JSON begins so, and has no comments"},
                 {" near '/", "JSON has no comments"},
                 {" near '#", "JSON has no comments"},
                 {" near '''", "texts stand in double quotes"},
                 {" near '}'", "a comma before it is one too many"},
                 {" near ']'", "a comma before it is one too many"}};
    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++) {
        if (strstr(error->text, hints[i].near)) {
            snprintf(out, REASON, "%s; %s", error->text, hints[i].hint);
            return out;
        }
    }
    return error->text;
}

/* Parses the document. After an error it parses a second time, because jansson may report a malformed text when
   memory runs out. */
static koksma_status load(koksma__json *d)
{
    json_error_t error;
    char reason[REASON];
    for (int i = 0; i < 2 && !d->root; i++) {
        KOKSMA__TRY(read_text(d, &error));
    }
    return d->root ? KOKSMA_OK
                   : koksma__fail(KOKSMA_MALFORMED, "%s '%s': line %d: %s", d->kind, d->name,
                                  error.line > 0 ? error.line : 1, reason_of(&error, reason));
}

koksma_status koksma__json_open(const char *kind, const char *name, const char *text, size_t size, koksma__json **out)
{
    koksma__json *d = calloc(1, sizeof *d);
    *out = NULL;
    if (d) {
        *d = (koksma__json){.kind = strdup(kind), .name = strdup(name), .text = malloc(size + 1), .size = size};
    }
    if (!d || !d->kind || !d->name || !d->text) {
        koksma__json_close(d);
        return koksma__fail_memory(size);
    }
    const size_t mark =
        size >= 3 && !memcmp(text, "\xef\xbb\xbf", 3) ? 3 : 0; /* of UTF-8, as editors of Windows put it */
    d->size = size - mark;
    memcpy(d->text, text + mark, d->size);
    d->text[d->size] = '\0';
    const koksma_status status = load(d);
    if (status) {
        koksma__json_close(d);
        return status;
    }
    *out = d;
    return KOKSMA_OK;
}

void koksma__json_close(koksma__json *document)
{
    if (document) {
        json_decref(document->root);
        KOKSMA__FREE(document->kind, document->name, document->text, document);
    }
}

koksma__json_node koksma__json_root(const koksma__json *document)
{
    return (koksma__json_node){.document = document, .value = document->root};
}

/* Writes the other spelling of a key: "centre" and "colour" are British, "center" and "color" American, also
   within a longer key. Returns false if the key has only one spelling. Only this function accepts both spellings
   in files. */
static bool other_spelling(const char *key, char *other, size_t size)
{
    static const char *const spellings[][2] = {{"centre", "center"}, {"colour", "color"}};
    for (size_t i = 0; i < 2; i++) {
        for (int american = 0; american < 2; american++) {
            const char *from = spellings[i][american], *at = strstr(key, from);
            if (at) {
                snprintf(other, size, "%.*s%s%s", (int)(at - key), key, spellings[i][1 - american],
                         at + strlen(from));
                return true;
            }
        }
    }
    return false;
}

/* The key of an object's member in the given spelling, British or American, or the other one, which is written to `other`;
   NULL if there is none. */
static const char *spelt(const json_t *object, const char *key, char other[KOKSMA__JSON_PATH])
{
    if (json_object_get(object, key)) {
        return key;
    }
    return other_spelling(key, other, KOKSMA__JSON_PATH) && json_object_get(object, other) ? other : NULL;
}

/* Finds the member in either spelling; NULL if there is none. */
static const json_t *find(const json_t *object, const char *key)
{
    char other[KOKSMA__JSON_PATH];
    const char *found = spelt(object, key, other);
    return found ? json_object_get(object, found) : NULL;
}

static const char *key_at(const void *keys, size_t i)
{
    return ((const char *const *)keys)[i];
}

static koksma_status fail_unknown_field(const koksma__json_node *member, const char *key, const char *const *keys)
{
    static const char *const foreign[][3] = {{"position", "eye"},
                                             {"origin", "eye"},
                                             {"from", "eye"},
                                             {"look_at", "target"},
                                             {"lookat", "target"},
                                             {"to", "target"},
                                             {"position", "centre"},
                                             {"origin", "centre"},
                                             {"location", "centre"},
                                             {"translate", "centre"},
                                             {"diffuse", "albedo"},
                                             {"color", "albedo"},
                                             {"colour", "albedo"},
                                             {"power", "intensity", " A point of power P has P / (4 pi)"},
                                             {"power", "radiance", " A surface of power P has P / (pi area)"},
                                             {"intensity", "radiance"},
                                             {"type", "kind"},
                                             {"emission", "radiance"}};
    const char *closest = koksma_closest_name(key, key_at, keys), *note = NULL;
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) { /* names of other renderers */
        for (size_t k = 0; keys[k] && !strcmp(key, foreign[i][0]); k++) {
            note = strcmp(keys[k], foreign[i][1]) ? note : foreign[i][2];
            closest = strcmp(keys[k], foreign[i][1]) ? closest : keys[k];
        }
    }
    if (closest) {
        return koksma__json_fail(member, "unknown field; did you mean '%s'?%s", closest, note ? note : "");
    }
    char known[512] = "";
    for (size_t i = 0; keys[i]; i++) {
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", keys[i]);
    }
    return koksma__json_fail(member, "unknown field; it has %s", known);
}

koksma_status koksma__json_only(const koksma__json_node *node, const char *const *keys)
{
    KOKSMA__JSON_FAIL_IF(!json_is_object((const json_t *)node->value), node, "it takes an object, {…}");
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)node->value, key, value)
    {
        char other[KOKSMA__JSON_PATH] = "";
        const bool two = other_spelling(key, other, sizeof other);
        int i = 0;
        while (keys[i] && strcmp(keys[i], key) != 0 && (!two || strcmp(keys[i], other) != 0)) {
            i++;
        }
        const bool twice = two && json_object_get(node->value, other);
        if (!keys[i] || twice) {
            koksma__json_node member = *node;
            if (koksma__json_member(node, key, &member)) {
                return KOKSMA_MALFORMED;
            }
            return twice ? koksma__json_fail(
                               &member, "'%s' is the same field in the other spelling; remove one of them", other)
                         : fail_unknown_field(&member, key, keys);
        }
    }
    return KOKSMA_OK;
}

bool koksma__json_is_object(const koksma__json_node *node)
{
    return json_is_object((const json_t *)node->value);
}

bool koksma__json_is_array(const koksma__json_node *node)
{
    return json_is_array((const json_t *)node->value);
}

bool koksma__json_is_text(const koksma__json_node *node)
{
    return json_is_string((const json_t *)node->value);
}

bool koksma__json_is_object_at(const koksma__json_node *node, const char *key)
{
    return json_is_object(find(node->value, key));
}

bool koksma__json_has(const koksma__json_node *node, const char *key)
{
    return find(node->value, key) != NULL;
}

/* Makes the node of a member or item of `parent`, without its path, which the caller writes. */
static koksma__json_node below(const koksma__json_node *parent, const json_t *value, const char *key, size_t item)
{
    koksma__json_node out = *parent;
    out.value = value;
    if (out.n_steps < KOKSMA__JSON_STEPS) {
        out.steps[out.n_steps++] = (koksma__json_step){key, item};
    }
    return out;
}

bool koksma__json_next(const koksma__json_node *object, void **at, const char **key, koksma__json_node *member)
{
    json_t *from = (json_t *)(uintptr_t)object->value;
    *at = *at ? json_object_iter_next(from, *at) : json_object_iter(from);
    if (!*at) {
        return false;
    }
    *key = json_object_iter_key(*at);
    *member = below(object, json_object_iter_value(*at), *key, 0);
    return true;
}

/* Key i of an object, or NULL past the end, for suggestions; only the first keys count, because finding one takes time. */
static const char *member_key_at(const void *object, size_t i)
{
    json_t *from = (json_t *)(uintptr_t)object;
    void *at = json_object_iter(from);
    for (size_t k = 0; at && k < i; k++) {
        at = json_object_iter_next(from, at);
    }
    return at && i < 64 ? json_object_iter_key(at) : NULL;
}

koksma_status koksma__json_member(const koksma__json_node *node, const char *key, koksma__json_node *out)
{
    char other[KOKSMA__JSON_PATH];
    const char *found = spelt(node->value, key, other);
    KOKSMA__JSON_FAIL_IF(!json_is_object((const json_t *)node->value), node, "it takes an object, {…}");
    if (!found) {
        const char *closest = koksma_closest_name(key, member_key_at, node->value);
        return closest ? koksma__json_fail(node, "field '%s' is missing; is '%s' meant?", key, closest)
                       : koksma__json_fail(node, "field '%s' is missing", key);
    }
    const koksma__json_node parent = *node;
    void *here = json_object_iter_at((json_t *)(uintptr_t)parent.value, found);
    *out = below(&parent, json_object_iter_value(here), json_object_iter_key(here), 0);
    snprintf(out->path, sizeof out->path, "%.90s%s%.32s", parent.path, *parent.path ? "." : "", found);
    return KOKSMA_OK;
}

koksma_status koksma__json_length(const koksma__json_node *node, size_t max, size_t *length)
{
    KOKSMA__JSON_FAIL_IF(!json_is_array((const json_t *)node->value), node, "it takes a list, […]");
    *length = json_array_size(node->value);
    return *length <= max ? KOKSMA_OK
                          : koksma__json_fail(node, "it has %zu items; at most %zu are accepted", *length, max);
}

koksma__json_node koksma__json_item(const koksma__json_node *node, size_t i)
{
    koksma__json_node out = below(node, json_array_get(node->value, i), NULL, i);
    snprintf(out.path, sizeof out.path, "%.100s[%zu]", node->path, i);
    return out;
}

koksma_status koksma__json_number(const koksma__json_node *node, double min, double max, double *out)
{
    const json_t *value = node->value;
    KOKSMA__JSON_FAIL_IF(!json_is_number(value), node, "it takes a number");
    const double number = json_number_value(value);
    KOKSMA__JSON_FAIL_IF(!(number >= min && number <= max), node, "%.9g is not in %.9g to %.9g", number, min, max);
    *out = number;
    return KOKSMA_OK;
}

koksma_status koksma__json_whole(const koksma__json_node *node, long long min, long long max, long long *out)
{
    const json_t *value = node->value;
    KOKSMA__JSON_FAIL_IF(!json_is_integer(value), node, "it takes a whole number");
    const long long whole = json_integer_value(value);
    KOKSMA__JSON_FAIL_IF(whole < min || whole > max, node, "%lld is not in %lld to %lld", whole, min, max);
    *out = whole;
    return KOKSMA_OK;
}

koksma_status koksma__json_flag(const koksma__json_node *node, bool *out)
{
    const json_t *value = node->value;
    KOKSMA__JSON_FAIL_IF(!json_is_boolean(value), node, "it takes true or false");
    *out = json_is_true(value);
    return KOKSMA_OK;
}

koksma_status koksma__json_text(const koksma__json_node *node, const char **out)
{
    const char *text = json_string_value(node->value);
    KOKSMA__JSON_FAIL_IF(!text, node, "it takes a text, \"…\"");
    *out = text;
    return KOKSMA_OK;
}

koksma_status koksma__json_numbers(const koksma__json_node *node, double min, double max, size_t n, double *out)
{
    size_t length = 0;
    KOKSMA__TRY(koksma__json_length(node, SIZE_MAX, &length));
    KOKSMA__JSON_FAIL_IF(length != n, node, "it takes %zu numbers, but has %zu items", n, length);
    for (size_t i = 0; i < n; i++) {
        const koksma__json_node item = koksma__json_item(node, i);
        KOKSMA__TRY(koksma__json_number(&item, min, max, &out[i]));
    }
    return KOKSMA_OK;
}

/* ---- Members --------------------------------------------------------------------------------------------- */

/* Returns whether the member is absent or has an error, so that it cannot be read. *status is OK if the member is
   absent and optional. */
static bool absent(const koksma__json_node *node, const char *key, bool needed, koksma__json_node *member,
                   koksma_status *status)
{
    *status = KOKSMA_OK;
    if (!needed && !koksma__json_has(node, key)) {
        return true;
    }
    *status = koksma__json_member(node, key, member);
    return *status != KOKSMA_OK;
}

koksma_status koksma__json_get_number(const koksma__json_node *node, const char *key, bool needed, double min,
                                      double max, double *out)
{
    koksma__json_node member;
    koksma_status status;
    return absent(node, key, needed, &member, &status) ? status : koksma__json_number(&member, min, max, out);
}

koksma_status koksma__json_get_whole(const koksma__json_node *node, const char *key, bool needed, long long min,
                                     long long max, long long *out)
{
    koksma__json_node member;
    koksma_status status;
    return absent(node, key, needed, &member, &status) ? status : koksma__json_whole(&member, min, max, out);
}

koksma_status koksma__json_get_flag(const koksma__json_node *node, const char *key, bool needed, bool *out)
{
    koksma__json_node member;
    koksma_status status;
    return absent(node, key, needed, &member, &status) ? status : koksma__json_flag(&member, out);
}

koksma_status koksma__json_get_text(const koksma__json_node *node, const char *key, bool needed, const char **out)
{
    koksma__json_node member;
    koksma_status status;
    return absent(node, key, needed, &member, &status) ? status : koksma__json_text(&member, out);
}

koksma_status koksma__json_get_numbers(const koksma__json_node *node, const char *key, bool needed, double min,
                                       double max, size_t n, double *out)
{
    koksma__json_node member;
    koksma_status status;
    return absent(node, key, needed, &member, &status) ? status : koksma__json_numbers(&member, min, max, n, out);
}
