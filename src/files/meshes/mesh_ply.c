/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads PLY files, as text and binary in either byte order. The header lists the kinds of elements, the number of
 * each, and their properties: numbers, or lists of numbers. The elements follow in that order; in a text file each
 * element is one line.
 *
 * Of the element "vertex" the properties x y z, nx ny nz and texture coordinates (u v, s t, tx ty, texture_u
 * texture_v) are read, and whether there are colours. Of "face" two lists are read: vertex_indices or vertex_index, a
 * fan of triangles; and texcoord, u and v for each corner. The latter become the texture coordinates of the vertices;
 * if faces that share a vertex disagree, the last face wins. A comment "TextureFile NAME" names the texture.
 * Everything else is skipped, but still checked: a file that is cut short, or that lacks a number where the header
 * requires one, is an error.
 *
 * Format: G. Turk, "The PLY Polygon File Format" (1994); texcoord and TextureFile are MeshLab's.
 */
#include "meshes/readers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "meshes/mesh_text.h"

enum { MAX_ELEMENTS = 64, MAX_PROPERTIES = 1024, NAME = 64 };

/* The meaning of a property: values before N_NUMBERS are numbers of each vertex, those after are lists of each
   face. */
typedef enum slot { X, Y, Z, NX, NY, NZ, U, V, RED, GREEN, BLUE, N_NUMBERS, CORNERS, WEDGES, UNUSED } slot;

typedef struct type {
    const char *names[2];
    size_t bytes;
    enum { WHOLE, NATURAL, REAL } kind;
    double full; /* the value of a colour component at full intensity */
} type;

typedef struct property {
    const type *count, *item; /* count: the type of a list's length; NULL: not a list */
    slot slot;
} property;

typedef struct element {
    char name[NAME];
    size_t count;
    int first, n; /* its properties are first .. first + n - 1 */
    size_t bytes; /* smallest size of one element in bytes */
} element;

typedef struct ply {
    koksma__text text;
    koksma__mesh_file *out;
    bool is_text, big_endian, coloured;
    size_t n_vertices;
    int n_elements, n_properties;
    element elements[MAX_ELEMENTS];
    property properties[MAX_PROPERTIES];
    char texture[1024];
    koksma__mesh mesh;
    koksma__list corners, indices; /* corners: those of one face; indices: three for each triangle */
} ply;

/* ---- The header ------------------------------------------------------------------------------------------ */

static const type *find_type(const char *name)
{
    static const type types[] = {
        {{"char", "int8"}, 1, WHOLE, 127},        {{"uchar", "uint8"}, 1, NATURAL, 255},
        {{"short", "int16"}, 2, WHOLE, 32767},    {{"ushort", "uint16"}, 2, NATURAL, 65535},
        {{"int", "int32"}, 4, WHOLE, 0x7fffffff}, {{"uint", "uint32"}, 4, NATURAL, 0xffffffff},
        {{"float", "float32"}, 4, REAL, 1},       {{"double", "float64"}, 8, REAL, 1}};
    for (size_t i = 0; i < 2 * (sizeof types / sizeof *types); i++) {
        if (!strcmp(types[i / 2].names[i % 2], name)) {
            return &types[i / 2];
        }
    }
    return NULL;
}

/* Finds a property's meaning by its name; the tables list the names of each meaning, separated by blanks. */
static slot find_slot(const char *of, const char *name, bool list)
{
    static const char *const names[] = {[X] = " x ",
                                        [Y] = " y ",
                                        [Z] = " z ",
                                        [U] = " u s tx texture_u ",
                                        [V] = " v t ty texture_v ",
                                        [NX] = " nx ",
                                        [NY] = " ny ",
                                        [NZ] = " nz ",
                                        [RED] = " red r ",
                                        [GREEN] = " green g ",
                                        [BLUE] = " blue b ",
                                        [N_NUMBERS] = "",
                                        [WEDGES] = " texcoord ",
                                        [CORNERS] = " vertex_indices vertex_index "};
    char wanted[NAME + 2];
    const slot first = list ? N_NUMBERS : X, last = list ? WEDGES : BLUE;
    snprintf(wanted, sizeof wanted, " %s ", name);
    for (slot i = first; i <= last && !strcmp(of, list ? "face" : "vertex"); i++) {
        if (strstr(names[i], wanted)) {
            return i;
        }
    }
    return UNUSED;
}

static koksma_status take_property(ply *p, const char *line)
{
    char first[16], second[16] = "", name[NAME], rest[2];
    if (!p->n_elements) {
        return koksma__text_wrong(&p->text, "a property comes before any element");
    }
    if (p->n_properties == MAX_PROPERTIES) {
        return koksma__text_wrong(&p->text, "more than 1024 properties");
    }
    element *e = &p->elements[p->n_elements - 1];
    property *to = &p->properties[p->n_properties];
    *to = (property){.slot = UNUSED};
    if (sscanf(line, "property list %15s %15s %63s %1s", first, second, name, rest) == 3) {
        to->count = find_type(first);
        to->item = to->count && to->count->kind != REAL ? find_type(second) : NULL;
        to->slot = find_slot(e->name, name, true);
    } else if (sscanf(line, "property %15s %63s %1s", second, name, rest) == 2) {
        to->item = find_type(second);
        to->slot = find_slot(e->name, name, false);
    }
    if (!to->item || (to->slot == CORNERS && to->item->kind == REAL)) {
        return koksma__text_wrong(&p->text, "the property has an unknown type");
    }
    /* the smallest number of bytes that a value can take: in a text file a digit and a blank */
    e->bytes += p->is_text ? 2 : to->count ? to->count->bytes : to->item->bytes;
    p->n_properties++;
    e->n++;
    return KOKSMA_OK;
}

static koksma_status take_element(ply *p, const char *line)
{
    char name[NAME], digits[24], rest[2];
    if (sscanf(line, "element %63s %23[0-9] %1s", name, digits, rest) != 2) {
        return koksma__text_wrong(&p->text, "expected an element, a property, a comment or end_header");
    }
    if (p->n_elements == MAX_ELEMENTS) {
        return koksma__text_wrong(&p->text, "more than 64 elements");
    }
    for (int i = 0; i < p->n_elements; i++) {
        if (!strcmp(p->elements[i].name, name)) {
            return koksma__text_wrong(&p->text, "a second element of this name");
        }
    }
    const unsigned long long count = strtoull(digits, NULL, 10);
    element *e = &p->elements[p->n_elements++];
    *e = (element){.count = count > SIZE_MAX ? SIZE_MAX : (size_t)count, .first = p->n_properties};
    strcpy(e->name, name);
    p->n_vertices = strcmp(name, "vertex") ? p->n_vertices : e->count;
    return KOKSMA_OK;
}

/* Reads the next line of the header into `line`. */
static koksma_status next_header_line(ply *p, char line[1024])
{
    if (!koksma__text_line(&p->text)) {
        p->text.number++;
        return koksma__text_wrong(&p->text, "the file ends before all data that it claims");
    }
    const size_t length = (size_t)(p->text.stop - p->text.at);
    if (length >= 1024 || memchr(p->text.at, '\0', length)) {
        return koksma__text_wrong(&p->text, length >= 1024 ? "longer than 1023 characters"
                                                           : "the file is not text: it contains a zero byte");
    }
    memcpy(line, p->text.at, length);
    line[length] = '\0';
    return KOKSMA_OK;
}

static koksma_status take_header_line(ply *p, const char *line)
{
    if (!strncmp(line, "comment", 7) || !strncmp(line, "obj_info", 8)) {
        sscanf(line, "comment TextureFile %1023[^\n]", p->texture);
        return KOKSMA_OK;
    }
    return !strncmp(line, "property ", 9) ? take_property(p, line) : take_element(p, line);
}

static koksma_status take_header(ply *p)
{
    char line[1024], format[24] = "", version[8], rest[2];
    KOKSMA__TRY(next_header_line(p, line));
    if (strcmp(line, "ply") != 0) {
        return koksma__text_wrong(&p->text, "the file does not begin with 'ply'");
    }
    KOKSMA__TRY(next_header_line(p, line));
    const bool whole = sscanf(line, "format %23s %7s %1s", format, version, rest) == 2 && !strcmp(version, "1.0");
    p->is_text = !strcmp(format, "ascii");
    p->big_endian = !strcmp(format, "binary_big_endian");
    if (!whole || (!p->is_text && !p->big_endian && strcmp(format, "binary_little_endian") != 0)) {
        return koksma__text_wrong(&p->text, "the format is not ascii, binary_little_endian or binary_big_endian 1.0");
    }
    for (;;) {
        KOKSMA__TRY(next_header_line(p, line));
        if (!strcmp(line, "end_header")) {
            return KOKSMA_OK;
        }
        KOKSMA__TRY(take_header_line(p, line));
    }
}

/* Checks that the file can be as long as its counts claim, before memory and time are spent on it. */
static koksma_status check_length(const ply *p)
{
    const koksma__text *t = &p->text;
    double bytes = 0;
    for (int i = 0; i < p->n_elements; i++) {
        const element *e = &p->elements[i];
        bytes += (double)e->count * (double)e->bytes;
        KOKSMA__FAIL_IF(e->count && !e->n, KOKSMA_MALFORMED, "%s: element '%s' has no properties", t->path, e->name);
    }
    if (bytes > (double)(t->end - t->next) + 1) { /* the blank after the last number may be missing */
        return koksma__fail(KOKSMA_MALFORMED,
                            "%s: its elements take %.0f bytes at least, but the file has only %td after its header",
                            t->path, bytes, t->end - t->next);
    }
    return KOKSMA_OK;
}

/* ---- Numbers ------------------------------------------------------------------------------------------------ */

/* Reads the next number of a text line. */
static koksma_status take_text(ply *p, const type *of, double *out)
{
    const char *word;
    size_t length;
    float value = 0;
    long long whole = 0;
    if (!koksma__text_word(&p->text, &word, &length)) {
        return koksma__text_wrong(&p->text, "the line has fewer numbers than its element");
    }
    const char *end = word + length, *at = word;
    const bool negative = *word == '-', sign = negative || *word == '+';
    if (of->kind != REAL) {
        at += of->kind == WHOLE && sign;
        if (!koksma__text_whole(&at, end, &whole) || at != end) {
            return koksma__text_wrong(&p->text, "expected a whole number");
        }
        *out = (double)(negative ? -whole : whole);
        return KOKSMA_OK;
    }
    if (length == 3u + sign && (!memcmp(word + sign, "nan", 3) || !memcmp(word + sign, "inf", 3))) {
        /* some files have "nan" for unused properties; koksma__mesh_check() rejects positions that are NaN */
        *out = NAN;
        return KOKSMA_OK;
    }
    if (!koksma__text_float(&at, end, &value) || at != end) {
        return koksma__text_wrong(&p->text, "expected a number");
    }
    *out = (double)value;
    return KOKSMA_OK;
}

/* The binary number at `at`; those of all types are doubles, too. */
static inline double number_at(const ply *p, const type *of, const unsigned char *at)
{
    const uint64_t value = koksma__bits_at(at, of->bytes, p->big_endian), sign = 1ull << (8 * of->bytes - 1);
    const uint32_t half = (uint32_t)value;
    double wide;
    float narrow;
    if (of->kind != REAL) {
        return (double)value - (of->kind == WHOLE && value & sign ? 2 * (double)sign : 0);
    }
    memcpy(&wide, &value, sizeof wide);
    memcpy(&narrow, &half, sizeof narrow);
    return of->bytes == 8 ? wide : (double)narrow;
}

/* Reads the next number of an element. For a binary file the caller has checked that enough bytes remain. */
static inline koksma_status take_number(ply *p, const type *of, double *out)
{
    if (p->is_text) {
        return take_text(p, of, out);
    }
    *out = number_at(p, of, (const unsigned char *)p->text.next);
    p->text.next += of->bytes;
    return KOKSMA_OK;
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

/* Checks that `vertex`, a number in item i of element e, is the index of a vertex. */
static koksma_status check_corner(const ply *p, const element *e, size_t i, long long vertex)
{
    char where[40] = "";
    if (vertex >= 0 && (unsigned long long)vertex < p->n_vertices) {
        return KOKSMA_OK;
    }
    if (p->is_text) {
        snprintf(where, sizeof where, "line %zu: ", p->text.number);
    }
    return koksma__fail(KOKSMA_MALFORMED, "%s: %s%s %zu names vertex %lld, but there are %zu, numbered from 0",
                        p->text.path, where, e->name, i, vertex, p->n_vertices);
}

/* The mesh's array for a property of its vertices, with entries *step numbers apart. NULL: the property is not stored
   (colours). */
static float *numbers_of(const ply *p, slot to, size_t *step)
{
    const koksma__mesh *m = &p->mesh;
    *step = to <= NZ ? 3 : 2;
    return to <= Z ? m->vertices + to : to <= NZ ? m->normals + (to - NX) : to <= V ? m->uvs + (to - U) : NULL;
}

static void put_vertex(ply *p, size_t i, slot to, const type *of, double value)
{
    size_t step;
    float *numbers = numbers_of(p, to, &step);
    if (numbers) {
        numbers[step * i] = (float)value;
    } else {
        p->coloured |= value != of->full;
    }
}

/* Stores item j of a face's list: the index of a corner, or a corner's texture coordinate. */
static koksma_status put_listed(ply *p, const element *e, size_t i, const property *of, long long n, long long j)
{
    double value = 0;
    KOKSMA__TRY(take_number(p, of->item, &value));
    if (of->slot == WEDGES) {
        const uint32_t *corners = p->corners.items;
        if ((size_t)n == 2 * p->corners.n && p->mesh.uvs) {
            p->mesh.uvs[2 * (size_t)corners[j / 2] + j % 2] = (float)value;
        }
    } else if (of->slot == CORNERS) {
        KOKSMA__TRY(check_corner(p, e, i, (long long)value));
        uint32_t *to = koksma__list_add(&p->corners, 1, sizeof *to);
        KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
        *to = (uint32_t)value;
    }
    return KOKSMA_OK;
}

static koksma_status cut_short(const ply *p, const element *e, size_t i)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: the file ends within element '%s' number %zu of %zu", p->text.path,
                        e->name, i, e->count);
}

static koksma_status take_list(ply *p, const element *e, size_t i, const property *of)
{
    const koksma__text *t = &p->text;
    double count = 0;
    if (!p->is_text && (size_t)(t->end - t->next) < of->count->bytes) {
        return cut_short(p, e, i);
    }
    KOKSMA__TRY(take_number(p, of->count, &count));
    long long n = (long long)count;
    if (p->is_text && n < 0) {
        return koksma__text_wrong(t, "a list has a negative length");
    }
    if (!p->is_text) {
        if (n < 0 || (size_t)n > (size_t)(t->end - t->next) / of->item->bytes) {
            return cut_short(p, e, i);
        }
        if (of->slot == UNUSED) {
            p->text.next += (size_t)n * of->item->bytes;
            n = 0;
        }
    }
    if (of->slot == WEDGES && n && !p->mesh.uvs) {
        p->mesh.uvs = calloc(2 * p->n_vertices + 1, sizeof *p->mesh.uvs);
        KOKSMA__REQUIRE_MEMORY(p->mesh.uvs, 2 * p->n_vertices * sizeof *p->mesh.uvs);
    }
    /* in text files a list ends with its line, even if its count is larger */
    for (long long j = 0; j < n; j++) {
        KOKSMA__TRY(put_listed(p, e, i, of, n, j));
    }
    return KOKSMA_OK;
}

/* Adds the corners of a face as a fan of triangles around its first corner: this is exact for convex polygons; for a
   concave polygon some triangles may reach outside of the polygon or overlap. */
static koksma_status add_fan(ply *p)
{
    const uint32_t *corners = p->corners.items;
    const size_t n = p->corners.n;
    if (n < 3) {
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF(p->indices.n / 3 + n > KOKSMA__MAX_TRIANGLES, KOKSMA_MALFORMED,
                    "%s: a mesh has at most %zu triangles", p->text.path, KOKSMA__MAX_TRIANGLES);
    uint32_t *to = koksma__list_add(&p->indices, 3 * (n - 2), sizeof *to);
    for (size_t i = 2; to && i < n; i++, to += 3) {
        to[0] = corners[0];
        to[1] = corners[i - 1];
        to[2] = corners[i];
    }
    return to ? KOKSMA_OK : KOKSMA_MEMORY;
}

static koksma_status take_item(ply *p, const element *e, size_t i, bool vertices)
{
    const char *word;
    size_t length;
    KOKSMA__TRY(p->is_text ? koksma__text_full_line(&p->text) : KOKSMA_OK);
    p->corners.n = 0;
    for (int k = e->first; k < e->first + e->n; k++) {
        const property *of = &p->properties[k];
        double value = 0;
        if (of->count) {
            KOKSMA__TRY(take_list(p, e, i, of));
            continue;
        }
        if (!p->is_text && (size_t)(p->text.end - p->text.next) < of->item->bytes) {
            return cut_short(p, e, i);
        }
        KOKSMA__TRY(take_number(p, of->item, &value));
        if (vertices && of->slot != UNUSED) {
            put_vertex(p, i, of->slot, of->item, value);
        }
    }
    if (p->is_text && koksma__text_word(&p->text, &word, &length)) {
        return koksma__text_wrong(&p->text, "the line has more numbers than its element");
    }
    return vertices ? KOKSMA_OK : add_fan(p);
}

/* Reads the property `of` of the binary vertices first .. first + n - 1; the first of them is at `at`, and each takes
   stride bytes. */
static void take_column(ply *p, const property *of, const unsigned char *at, size_t stride, size_t first, size_t n)
{
    size_t step;
    float *numbers = numbers_of(p, of->slot, &step);
    if (!numbers || of->item->kind != REAL || of->item->bytes != 4 || p->big_endian) {
        for (size_t i = 0; i < n; i++) {
            put_vertex(p, first + i, of->slot, of->item, number_at(p, of->item, at + stride * i));
        }
        return;
    }
    for (size_t i = 0; i < n; i++) {
        const uint32_t bits = (uint32_t)koksma__bits_at(at + stride * i, 4, false);
        memcpy(&numbers[step * (first + i)], &bits, sizeof bits);
    }
}

/* Reads binary vertices without lists, in blocks that fit the cache, one property after the other, so that a
   property's type is looked up once per block. Returns the number of vertices that the file holds in full. */
static size_t take_vertices(ply *p, const element *e)
{
    enum { BLOCK = 512 };
    size_t stride = 0;
    for (int k = e->first; k < e->first + e->n; k++) {
        if (p->properties[k].count) {
            return 0;
        }
        stride += p->properties[k].item->bytes;
    }
    /* stride 0: there are no vertices */
    const size_t there = (size_t)(p->text.end - p->text.next) / (stride ? stride : 1);
    const size_t n = there < e->count ? there : e->count;
    for (size_t i = 0; i < n; i += BLOCK) {
        const size_t block = n - i < BLOCK ? n - i : BLOCK;
        const unsigned char *at = (const unsigned char *)p->text.next;
        for (int k = e->first; k < e->first + e->n; at += p->properties[k++].item->bytes) {
            if (p->properties[k].slot != UNUSED) {
                take_column(p, &p->properties[k], at, stride, i, block);
            }
        }
        p->text.next += stride * block;
    }
    return n;
}

/* Reads the next triangles, at most 4096, of a binary file in the most common form: a count of one byte, and corners
   of 4 bytes. *taken is their number. The function stops before a face in another form or with an index out of range;
   take_item() handles these. */
static koksma_status take_triangles(ply *p, const element *e, size_t most, size_t *taken)
{
    enum { BYTES = 13, RUN = 4096 };
    const property *of = &p->properties[e->first];
    const unsigned char *at = (const unsigned char *)p->text.next;
    const size_t there = (size_t)(p->text.end - p->text.next) / BYTES, before = p->indices.n;
    size_t n = 0;
    *taken = 0;
    most = most < there ? most : there;
    if (p->is_text || e->n != 1 || of->slot != CORNERS || of->count->bytes != 1 || of->item->bytes != 4 ||
        before / 3 + RUN > KOKSMA__MAX_TRIANGLES) {
        return KOKSMA_OK;
    }
    if (!before) { /* reserve memory as if all faces were triangles: their corners take less memory than the file */
        KOKSMA__TRY(koksma__list_reserve(&p->indices, 3 * most, sizeof(uint32_t)) ? KOKSMA_OK : KOKSMA_MEMORY);
    }
    most = most < RUN ? most : RUN;
    while (n < most && at[BYTES * n] == 3) {
        n++;
    }
    if (!n) {
        return KOKSMA_OK;
    }
    uint32_t *to = koksma__list_add(&p->indices, 3 * n, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    for (bool there_are = true; *taken < n && there_are; at += BYTES, to += 3) {
        for (size_t c = 0; c < 3; c++) {
            to[c] = (uint32_t)koksma__bits_at(at + 1 + 4 * c, 4, p->big_endian);
            there_are &= to[c] < p->n_vertices;
        }
        *taken += there_are;
    }
    p->indices.n = before + 3 * *taken;
    p->text.next += BYTES * *taken;
    return KOKSMA_OK;
}

static koksma_status take_element_items(ply *p, const element *e)
{
    const bool vertices = !strcmp(e->name, "vertex");
    size_t taken = 0;
    for (size_t i = vertices && !p->is_text ? take_vertices(p, e) : 0; i < e->count; i += taken ? taken : 1) {
        KOKSMA__TRY(take_triangles(p, e, e->count - i, &taken));
        KOKSMA__TRY(taken ? KOKSMA_OK : take_item(p, e, i, vertices));
    }
    return KOKSMA_OK;
}

/* Allocates the vertices and the arrays for their properties. */
static koksma_status make_mesh(ply *p)
{
    bool normals = false, uvs = false;
    for (int k = 0; k < p->n_properties; k++) {
        const slot to = p->properties[k].slot;
        normals |= to >= NX && to <= NZ;
        uvs |= to == U || to == V;
    }
    const koksma_status status = koksma__mesh_init(p->n_vertices, 0, normals, uvs, &p->mesh);
    return status ? koksma__fail_in(status, p->text.path) : KOKSMA_OK;
}

static koksma_status finish(ply *p)
{
    koksma__file_material *white = NULL;
    if (p->indices.n) {
        uint32_t *exact = realloc(p->indices.items, p->indices.n * sizeof *exact);
        free(p->mesh.indices);
        p->mesh.indices = exact ? exact : p->indices.items;
        p->mesh.n_triangles = p->indices.n / 3;
        p->indices = (koksma__list){0};
    }
    p->out->unread.vertex_colours = p->coloured;
    KOKSMA__TRY(koksma__file_take_mesh(p->out, &p->mesh, 0));
    KOKSMA__TRY(koksma__file_add_placement(p->out, 0, koksma__identity_matrix));
    KOKSMA__TRY(koksma__file_add_material(p->out, 1, &white));
    white->colour_map.name = *p->texture ? strdup(p->texture) : NULL;
    return *p->texture && !white->colour_map.name ? koksma__fail_memory(sizeof p->texture) : KOKSMA_OK;
}

koksma_status koksma__ply_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    ply *p = calloc(1, sizeof *p);
    KOKSMA__REQUIRE_MEMORY(p, sizeof *p);
    p->out = out;
    p->text = (koksma__text){.path = out->path, .next = (const char *)bytes, .end = (const char *)bytes + size};
    koksma_status status = take_header(p);
    status = status ? status : check_length(p);
    status = status ? status : make_mesh(p);
    for (int k = 0; !status && k < p->n_elements; k++) {
        status = take_element_items(p, &p->elements[k]);
    }
    status = status ? status : finish(p);
    koksma__mesh_fini(&p->mesh);
    KOKSMA__FREE(p->corners.items, p->indices.items, p);
    return status;
}
