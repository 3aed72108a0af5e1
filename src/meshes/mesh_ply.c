/* SPDX-License-Identifier: Apache-2.0 */
/* PLY files before assimp reads them: some keep it for ever, and of one that is cut short, or whose lines begin with
   blanks, it makes other triangles without a word. So every number is looked at, and of a file of text it gets the
   elements as it takes them: one a line, as the format has it, numbers with one blank between them.
   Format: G. Turk, "The PLY Polygon File Format" (1994). */
#include <stdio.h>
#include <stdlib.h>

#include "meshes/mesh_file.h"
#include "meshes/mesh_lines.h"

enum { MAX_ELEMENTS = 64, MAX_PROPERTIES = 1024 };

typedef enum number_kind { WHOLE, NATURAL, REAL } number_kind;

typedef struct type {
    const char *name;
    size_t bytes;
    number_kind kind;
} type;

typedef struct property {
    const type *count, *item; /* count: of a list; else NULL */
    bool corners;             /* of a face: numbers of vertices */
} property;

typedef struct element {
    char name[64];
    size_t count;
    int first, n; /* of its properties */
    size_t bytes; /* that one takes at least */
    bool lists;   /* some of them take more */
} element;

typedef struct ply {
    koksma__lines lines;
    koksma__bytes *out;
    bool text, big_endian;
    size_t vertices;
    int n_elements, n_properties;
    element elements[MAX_ELEMENTS];
    property properties[MAX_PROPERTIES];
} ply;

/* ---- The header ------------------------------------------------------------------------------------------ */

static const type *find_type(const char *name)
{
    static const type types[] = {
        {"char", 1, WHOLE},  {"int8", 1, WHOLE},   {"uchar", 1, NATURAL},  {"uint8", 1, NATURAL},
        {"short", 2, WHOLE}, {"int16", 2, WHOLE},  {"ushort", 2, NATURAL}, {"uint16", 2, NATURAL},
        {"int", 4, WHOLE},   {"int32", 4, WHOLE},  {"uint", 4, NATURAL},   {"uint32", 4, NATURAL},
        {"float", 4, REAL},  {"float32", 4, REAL}, {"double", 8, REAL},    {"float64", 8, REAL},
    };
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (!strcmp(types[i].name, name)) {
            return &types[i];
        }
    }
    return NULL;
}

static koksma_status take_property(ply *p)
{
    char first[16], second[16], name[64], rest[2];
    if (!p->n_elements) {
        return koksma__line_wrong(&p->lines, "a property of no element");
    }
    if (p->n_properties == MAX_PROPERTIES) {
        return koksma__line_wrong(&p->lines, "more than 1024 properties");
    }
    element *e = &p->elements[p->n_elements - 1];
    property *to = &p->properties[p->n_properties];
    *to = (property){0};
    if (sscanf(p->lines.line, "property list %15s %15s %63s %1s", first, second, name, rest) == 3) {
        to->count = find_type(first);
        to->item = to->count && to->count->kind != REAL ? find_type(second) : NULL;
        to->corners = !strcmp(e->name, "face") && (!strcmp(name, "vertex_indices") || !strcmp(name, "vertex_index"));
        e->lists = true;
    } else if (sscanf(p->lines.line, "property %15s %63s %1s", second, name, rest) == 2) {
        to->item = find_type(second);
    }
    if (!to->item || (to->corners && to->item->kind == REAL)) {
        return koksma__line_wrong(&p->lines, "no property of a known type");
    }
    e->bytes += p->text ? 2 : to->count ? to->count->bytes : to->item->bytes; /* as text a digit and a blank */
    p->n_properties++;
    e->n++;
    return KOKSMA_OK;
}

static koksma_status take_element(ply *p)
{
    char name[64], digits[24], rest[2];
    if (sscanf(p->lines.line, "element %63s %23[0-9] %1s", name, digits, rest) != 2) {
        return koksma__line_wrong(&p->lines, "neither an element, nor a property, a comment or end_header");
    }
    if (p->n_elements == MAX_ELEMENTS) {
        return koksma__line_wrong(&p->lines, "more than 64 elements");
    }
    for (int i = 0; i < p->n_elements; i++) {
        if (!strcmp(p->elements[i].name, name)) {
            return koksma__line_wrong(&p->lines, "a second element of this name");
        }
    }
    const unsigned long long count = strtoull(digits, NULL, 10);
    element *e = &p->elements[p->n_elements++];
    *e = (element){.count = count > SIZE_MAX ? SIZE_MAX : (size_t)count, .first = p->n_properties};
    strcpy(e->name, name);
    p->vertices = strcmp(name, "vertex") ? p->vertices : e->count;
    return KOKSMA_OK;
}

static koksma_status take_header_line(ply *p)
{
    const char *line = p->lines.line;
    if (!strncmp(line, "comment", 7) || !strncmp(line, "obj_info", 8)) {
        return KOKSMA_OK;
    }
    return !strncmp(line, "property ", 9) ? take_property(p) : take_element(p);
}

static koksma_status take_header(ply *p)
{
    char format[24] = "", version[8], rest[2];
    koksma__lines *l = &p->lines;
    koksma_status status = koksma__line_next(l);
    if (!status && strcmp(l->line, "ply") != 0) {
        status = koksma__line_wrong(l, "not 'ply', with which such a file begins");
    }
    status = status ? status : koksma__line_next(l);
    if (!status &&
        (sscanf(l->line, "format %23s %7s %1s", format, version, rest) != 2 || strcmp(version, "1.0") != 0 ||
         (strcmp(format, "ascii") != 0 && strcmp(format, "binary_little_endian") != 0 &&
          strcmp(format, "binary_big_endian") != 0))) {
        status = koksma__line_wrong(l, "no format ascii, binary_little_endian or binary_big_endian 1.0");
    }
    p->text = !strcmp(format, "ascii");
    p->big_endian = !strcmp(format, "binary_big_endian");
    while (!status && !(status = koksma__line_next(l)) && strcmp(l->line, "end_header") != 0) {
        status = take_header_line(p);
    }
    return status;
}

/* Whether the file can be as long as its counts say: before time is spent on it. */
static koksma_status check_length(const ply *p)
{
    const koksma__lines *l = &p->lines;
    double bytes = 0;
    for (int i = 0; i < p->n_elements; i++) {
        const element *e = &p->elements[i];
        bytes += (double)e->count * (double)e->bytes;
        if (e->count && !e->n) {
            return koksma__fail(KOKSMA_MALFORMED, "%s: element '%s' has no properties", l->path, e->name);
        }
    }
    if (bytes > (double)(l->end - l->at) + 1) { /* the last blank may be missing */
        return koksma__fail(KOKSMA_MALFORMED,
                            "%s: its elements take %.0f bytes at least, and after the header are %td", l->path, bytes,
                            l->end - l->at);
    }
    return KOKSMA_OK;
}

/* Number i of element e names this vertex. */
static koksma_status check_corner(const ply *p, size_t i, long long vertex)
{
    char where[40] = "";
    if (vertex >= 0 && (unsigned long long)vertex < p->vertices) {
        return KOKSMA_OK;
    }
    if (p->text) {
        snprintf(where, sizeof where, "line %zu: ", p->lines.number);
    }
    return koksma__fail(KOKSMA_MALFORMED, "%s: %sface %zu names vertex %lld; there are %zu, from 0 on", p->lines.path,
                        where, i, vertex, p->vertices);
}

/* ---- Text ------------------------------------------------------------------------------------------------- */

typedef struct words {
    const unsigned char *at, *end;
    const unsigned char *word; /* the last one; NULL: none yet */
    size_t length;
} words;

static bool is_blank(unsigned char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static bool next_word(words *w)
{
    while (w->at < w->end && is_blank(*w->at)) {
        w->at++;
    }
    w->word = w->at;
    while (w->at < w->end && !is_blank(*w->at)) {
        w->at++;
    }
    w->length = (size_t)(w->at - w->word);
    return w->length > 0;
}

static size_t digits(const unsigned char *at, const unsigned char *end)
{
    size_t n = 0;
    while (at + n < end && at[n] >= '0' && at[n] <= '9') {
        n++;
    }
    return n;
}

/* Whether the word is a number of that kind; *value, unless it is a real one: cut at 10^18. */
static bool is_number(const words *w, number_kind kind, long long *value)
{
    const unsigned char *at = w->word, *end = w->word + w->length;
    const bool negative = *at == '-';
    at += kind != NATURAL && (*at == '-' || *at == '+');
    const size_t whole = digits(at, end);
    if (kind != REAL) {
        *value = 0;
        for (size_t i = 0; i < whole; i++) {
            *value = *value < 1000000000000000000 / 10 ? 10 * *value + (at[i] - '0') : 1000000000000000000;
        }
        *value = negative ? -*value : *value;
        return whole && at + whole == end;
    }
    if (end - at == 3 && (!memcmp(at, "nan", 3) || !memcmp(at, "inf", 3))) {
        return true; /* some properties are; where a vertex is, mesh.c says it */
    }
    at += whole;
    const bool point = at < end && *at == '.';
    const size_t after = point ? digits(at + 1, end) : 0;
    at += point ? 1 + after : 0;
    if (whole + after && at < end && (*at == 'e' || *at == 'E')) {
        at++;
        at += at < end && (*at == '-' || *at == '+');
        const size_t power = digits(at, end);
        return power && at + power == end;
    }
    return whole + after && at == end;
}

/* There is room: of every word, every blank between two and every line's end the file has at least as much, but for
   the last line's end. */
static void put(koksma__bytes *out, const void *text, size_t length)
{
    memcpy(out->data + out->size, text, length);
    out->size += length;
}

/* The next number of the line, into the output, too. */
static koksma_status take_number(ply *p, words *w, const type *of, long long *value)
{
    const bool first = !w->word;
    if (!next_word(w)) {
        return koksma__line_wrong(&p->lines, "fewer numbers than its element has");
    }
    if (!is_number(w, of->kind, value)) {
        return koksma__line_wrong(&p->lines, of->kind == REAL ? "a number was due" : "a whole number was due");
    }
    put(p->out, " ", first ? 0 : 1);
    put(p->out, w->word, w->length);
    return KOKSMA_OK;
}

/* The next line that is not empty. */
static koksma_status next_full_line(ply *p, words *w)
{
    size_t length = 0;
    for (;;) {
        const koksma_status status = koksma__line_span(&p->lines, &w->at, &length);
        if (status) {
            return status;
        }
        w->end = w->at + length;
        while (w->at < w->end && is_blank(*w->at)) {
            w->at++;
        }
        if (w->at < w->end) {
            return KOKSMA_OK;
        }
    }
}

static koksma_status take_text_item(ply *p, const element *e, size_t i)
{
    words w = {0};
    long long value = 0;
    koksma_status status = next_full_line(p, &w);
    for (int k = e->first; !status && k < e->first + e->n; k++) {
        const property *of = &p->properties[k];
        long long n = 1;
        if (of->count && !(status = take_number(p, &w, of->count, &n)) && n < 0) {
            status = koksma__line_wrong(&p->lines, "a list of less than nothing");
        }
        for (; !status && n > 0; n--) { /* ends with the line, whatever is claimed */
            status = take_number(p, &w, of->item, &value);
            status = status || !of->corners ? status : check_corner(p, i, value);
        }
    }
    if (!status && next_word(&w)) {
        status = koksma__line_wrong(&p->lines, "more numbers than its element has");
    }
    put(p->out, "\n", status ? 0 : 1);
    return status;
}

/* ---- Binary ----------------------------------------------------------------------------------------------- */

static long long whole_number(const ply *p, const type *of, const unsigned char *at)
{
    unsigned long long value = 0;
    for (size_t i = 0; i < of->bytes; i++) {
        value |= (unsigned long long)at[p->big_endian ? of->bytes - 1 - i : i] << 8 * i;
    }
    const unsigned long long sign = 1ull << (8 * of->bytes - 1);
    return of->kind == WHOLE && value & sign ? (long long)(value & (sign - 1)) - (long long)sign : (long long)value;
}

static koksma_status cut_short(const ply *p, const element *e, size_t i)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: the file ends within element '%s' number %zu of %zu", p->lines.path,
                        e->name, i, e->count);
}

static koksma_status take_binary_item(ply *p, const element *e, size_t i)
{
    const unsigned char **at = &p->lines.at, *end = p->lines.end;
    for (int k = e->first; k < e->first + e->n; k++) {
        const property *of = &p->properties[k];
        long long n = 1;
        if (of->count) {
            if ((size_t)(end - *at) < of->count->bytes) {
                return cut_short(p, e, i);
            }
            n = whole_number(p, of->count, *at);
            *at += of->count->bytes;
        }
        if (n < 0 || (size_t)n > (size_t)(end - *at) / of->item->bytes) {
            return cut_short(p, e, i);
        }
        for (long long j = 0; of->corners && j < n; j++) {
            const long long vertex = whole_number(p, of->item, *at + (size_t)j * of->item->bytes);
            const koksma_status status = check_corner(p, i, vertex);
            if (status) {
                return status;
            }
        }
        *at += (size_t)n * of->item->bytes;
    }
    return KOKSMA_OK;
}

koksma_status koksma__ply_clean(const char *path, const unsigned char *file, size_t size, koksma__bytes *out)
{
    ply *p = calloc(1, sizeof *p);
    if (!p) {
        return koksma__fail_memory(sizeof *p);
    }
    p->lines = (koksma__lines){.path = path, .at = file, .end = file + size};
    p->out = out;
    koksma_status status = take_header(p);
    status = status ? status : check_length(p);
    if (!status && p->text) {
        *out = (koksma__bytes){.data = malloc(size + 1), .room = size + 1};
        status = out->data ? KOKSMA_OK : koksma__fail_memory(size);
    }
    if (!status && p->text) {
        put(out, file, (size_t)(p->lines.at - file));
    }
    for (int k = 0; !status && k < p->n_elements; k++) {
        const element *e = &p->elements[k];
        for (size_t i = 0; !status && i < e->count; i++) {
            status = p->text ? take_text_item(p, e, i) : take_binary_item(p, e, i);
        }
    }
    free(p);
    return status;
}
