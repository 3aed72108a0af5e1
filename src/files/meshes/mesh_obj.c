/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads OBJ files: polygons with their texture coordinates, normals and materials. Lines and points, curves and
 * surfaces, and smoothing groups are not read.
 *
 * A corner names a position and perhaps a texture vertex and a normal, by numbers that count from 1, or backwards
 * from the last one if they are negative. Numbers may refer to later lines, so the corners are stored until the end
 * of the file. Then each corner becomes a separate vertex, because OBJ files share positions, not vertices; corners of
 * meshes without normals keep their numbers, so that whoever smooths them knows what is one vertex. A polygon becomes a
 * fan of triangles. A new mesh begins where o or g name another object or group and where usemtl names another material;
 * polygons before the first usemtl are grey. A mesh has normals (or texture coordinates) if any of
 * its corners names one; corners without one get the value 0.
 *
 * Format: Wavefront's "Advanced Visualizer Manual", appendix B1.
 */
#include "meshes/readers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/hash.h"
#include "meshes/mesh_text.h"

enum { MAX_LINE = 1 << 15 };

/* The kinds of items that a corner names, in their order within a corner. */
enum { PLACE, TEXTURE, NORMAL, KINDS };

/* Number of floats of an item of each kind. */
static const size_t widths[KINDS] = {[PLACE] = 4, [TEXTURE] = 2, [NORMAL] = 3};

/* The numbers of the items that a corner names, one of each kind, from 1 on; 0: none. */
typedef struct corner {
    uint32_t names[KINDS];
} corner;

/* Start of one mesh's corners and indices, which end where the next mesh's begin. */
typedef struct part {
    size_t first_corner, first_index, material;
    int kinds; /* the kinds of items that its corners name, as bits */
} part;

typedef struct obj {
    koksma__text text;
    koksma__mesh_file *out;
    /* floats of positions (x y z, and 1 if the colour is not white), texture vertices (u v) and normals (x y z) */
    koksma__list vertices[KINDS];
    koksma__list corners, indices, parts;
    size_t highest[KINDS]; /* largest number that a corner names */
    size_t line_of[KINDS]; /* the line that first names that number */
    koksma__mtl_names names;
    koksma__list used;       /* indices of names (size_t) in the order in which the names were first used */
    size_t material;         /* material of the following polygons */
    bool split;              /* the next polygon begins a new mesh */
    uint64_t group, object;  /* hashes of the names of the current group and object */
    koksma__names libraries; /* what mtllib lines have named */
    koksma__names read;      /* the material files that were read, by koksma__file_key */
    bool own_library;        /* whether the material file with the same name as the model was read */
    char joined[MAX_LINE + 1];
} obj;

static koksma_status wrong(const obj *o, const char *reason)
{
    return koksma__text_wrong(&o->text, reason);
}

/* ---- Lines -------------------------------------------------------------------------------------------------- */

/* Appends the next line to the current one for as long as it ends in a backslash. */
static koksma_status join_lines(obj *o)
{
    koksma__text *t = &o->text;
    size_t length = 0;
    for (;;) {
        const size_t more = (size_t)(t->stop - t->at);
        if (more >= MAX_LINE - length) {
            return wrong(o, "longer than 32767 characters");
        }
        memcpy(o->joined + length, t->at, more);
        length += more;
        if (!length || o->joined[length - 1] != '\\') {
            break;
        }
        o->joined[length - 1] = ' ';
        if (!koksma__text_line(t)) {
            return wrong(o, "the last line ends in a backslash");
        }
    }
    o->joined[length] = '\0';
    t->at = o->joined;
    t->stop = o->joined + length;
    return KOKSMA_OK;
}

/* Removes a comment at the line's end. */
static void cut_comment(koksma__text *t)
{
    const char *comment = memchr(t->at, '#', (size_t)(t->stop - t->at));
    t->stop = comment ? comment : t->stop;
}

/* ---- Vertices ----------------------------------------------------------------------------------------------- */

/* Reads the numbers up to the line's end and returns their count; -1 if a word is not a number or not below 1e38, or
   if there are more than `most`. */
static int take_numbers(obj *o, int most, float *out)
{
    koksma__text *t = &o->text;
    const char *word;
    size_t length;
    int n = 0;
    for (cut_comment(t); koksma__text_word(t, &word, &length); n++) {
        if (n == most || !koksma__text_float(&word, t->at, &out[n]) || word != t->at || !(fabsf(out[n]) < 1e38f)) {
            return -1;
        }
    }
    return n;
}

static koksma_status take_vertex(obj *o, int kind)
{
    static const char *const rules[KINDS] = {[PLACE] =
                                                 "a vertex is three finite numbers, and maybe a weight and a colour",
                                             [TEXTURE] = "a texture vertex is one to three finite numbers",
                                             [NORMAL] = "a normal is three finite numbers"};
    float v[7] = {0};
    const int n = take_numbers(o, kind == PLACE ? 7 : 3, v);
    if (n < (kind == TEXTURE ? 1 : 3) || n == 5) {
        return wrong(o, rules[kind]);
    }
    float *to = koksma__list_add(&o->vertices[kind], widths[kind], sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    const float weight = kind == PLACE && (n == 4 || n == 7) ? v[3] : 1, *colour = v + n - 3;
    if (weight == 0) {
        return wrong(o, "a vertex of weight 0 is at infinity");
    }
    for (size_t k = 0; k < widths[kind] && k < 3; k++) {
        to[k] = v[k] / weight;
    }
    if (n >= 6) {
        to[3] = colour[0] != 1 || colour[1] != 1 || colour[2] != 1;
    }
    return KOKSMA_OK;
}

/* ---- Polygons ----------------------------------------------------------------------------------------------- */

/* The number of items of one kind (positions, texture vertices or normals) read so far. */
static size_t count_of(const obj *o, int kind)
{
    return o->vertices[kind].n / widths[kind];
}

/* Reads one number of a corner. */
static bool take_index(obj *o, int kind, const char **at, const char *end, uint32_t *out)
{
    const bool back = *at < end && **at == '-';
    const size_t count = count_of(o, kind);
    long long value = 0;
    *at += back;
    if (!koksma__text_whole(at, end, &value) || value < 1 || value >= (long long)KOKSMA__MAX_VERTICES ||
        (back && (size_t)value > count)) {
        return false;
    }
    if (!back && (size_t)value > o->highest[kind]) {
        o->highest[kind] = (size_t)value;
        o->line_of[kind] = o->text.number;
    }
    *out = (uint32_t)(back ? count + 1 - (size_t)value : (size_t)value);
    return true;
}

/* Reads a corner: v, v/t, v//n or v/t/n; some writers also use v/ or v//. Returns the kinds of items that the corner
   names, as bits, or 0 if it is not a corner. */
static int take_corner(obj *o, const char *at, const char *end, corner *out)
{
    int kinds = 0;
    for (int kind = PLACE; kind < KINDS; kind++) {
        const bool absent = kind != PLACE && (at == end || *at == '/');
        if (!absent && !take_index(o, kind, &at, end, &out->names[kind])) {
            return 0;
        }
        kinds |= absent ? 0 : 1 << kind;
        if (at == end || *at != '/') {
            break;
        }
        at++;
    }
    return at == end ? kinds : 0;
}

/* The mesh to which the next polygon belongs; NULL when memory runs out. */
static part *find_part(obj *o)
{
    part *last = o->parts.n ? (part *)o->parts.items + o->parts.n - 1 : NULL;
    if (last && !o->split && last->material == o->material) {
        return last;
    }
    part *new = koksma__list_add(&o->parts, 1, sizeof *new);
    if (new) {
        *new = (part){.first_corner = o->corners.n, .first_index = o->indices.n, .material = o->material};
        o->split = false;
    }
    return new;
}

/* Reads the corners of a face, line or point; all its corners must name the same kinds of items. A face becomes
   triangles. */
static koksma_status take_corners(obj *o, bool face)
{
    koksma__text *t = &o->text;
    const size_t before = o->corners.n;
    const char *word;
    size_t length;
    int first = 0;
    for (cut_comment(t); koksma__text_word(t, &word, &length);) {
        corner *to = koksma__list_add(&o->corners, 1, sizeof *to);
        const int kinds = to ? take_corner(o, word, t->at, to) : 0;
        if (!kinds) {
            return to ? wrong(o, "a corner must be v, v/t, v//n or v/t/n, with numbers of vertices that exist")
                      : KOKSMA_MEMORY;
        }
        first = first ? first : kinds;
        if (kinds != first) {
            return wrong(o, "some corners have a texture vertex or a normal, others have none");
        }
    }
    const size_t n = o->corners.n - before;
    if (!n) {
        return wrong(o, "a face, line or point without a corner");
    }
    o->corners.n = before;
    if (!face || n < 3) {
        return KOKSMA_OK;
    }
    part *p = find_part(o);
    KOKSMA__TRY(p ? KOKSMA_OK : KOKSMA_MEMORY);
    KOKSMA__FAIL_IF(before + n > KOKSMA__MAX_VERTICES, KOKSMA_MALFORMED, "%s: over %zu corners", o->text.path,
                    KOKSMA__MAX_VERTICES);
    p->kinds |= first;
    uint32_t *to = koksma__list_add(&o->indices, 3 * (n - 2), sizeof *to);
    for (size_t i = 2; to && i < n; i++, to += 3) {
        to[0] = (uint32_t)(before - p->first_corner);
        to[1] = to[0] + (uint32_t)i - 1;
        to[2] = to[0] + (uint32_t)i;
    }
    o->corners.n = before + n;
    return to ? KOKSMA_OK : KOKSMA_MEMORY;
}

/* ---- Names -------------------------------------------------------------------------------------------------- */

static koksma_status use_material(obj *o, const char *name, size_t length)
{
    if (!length) {
        return KOKSMA_OK;
    }
    const size_t known = o->names.names.n;
    const koksma__mtl_name *found = koksma__mtl_find(&o->names, o->out, name, length);
    KOKSMA__TRY(found ? KOKSMA_OK : KOKSMA_MEMORY);
    o->material = found->material;
    if (o->names.names.n > known) { /* a new name: no material file read so far defines it */
        size_t *to = koksma__list_add(&o->used, 1, sizeof *to);
        KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
        *to = known;
    }
    return KOKSMA_OK;
}

/* Reads a material file, once under whatever names; if it can't be opened, the message also names the model. */
static koksma_status read_library(obj *o, const char *path)
{
    char key[KOKSMA__FILE_KEY];
    size_t known;
    koksma__file_key(path, key);
    if (koksma__names_find(&o->read, key, strlen(key), &known)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__names_put(&o->read, key, strlen(key), 0));
    const koksma_status status = koksma__mtl_read(path, &o->names, o->out);
    return status == KOKSMA_MISSING ? koksma__fail_in(status, o->text.path) : status;
}

/* If a material file is missing, reads the material file that has the same name as the model. */
static koksma_status note_missing(obj *o, const char *name)
{
    char own[KOKSMA__MAX_PATH];
    koksma__unread *unread = &o->out->unread;
    if (!unread->libraries++) {
        snprintf(unread->library, sizeof unread->library, "%.255s", name);
    }
    if (o->own_library || strlen(o->text.path) >= sizeof own) {
        return KOKSMA_OK;
    }
    o->own_library = true;
    strcpy(own, o->text.path);
    strcpy(strrchr(own, '.'), ".mtl");
    return koksma__is_file(own) ? read_library(o, own) : KOKSMA_OK;
}

/* Reads the names after mtllib: one name that contains blanks, or several names. */
static koksma_status take_libraries(obj *o, const char *rest, size_t length)
{
    char name[KOKSMA__MAX_PATH], path[KOKSMA__MAX_PATH];
    size_t known;
    if (koksma__names_find(&o->libraries, rest, length, &known)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__names_put(&o->libraries, rest, length, 0));
    if (length >= sizeof name) {
        return wrong(o, "the name of a material file is longer than 4095 characters");
    }
    snprintf(name, sizeof name, "%.*s", (int)length, rest);
    if (koksma__find_named(o->text.path, name, path)) {
        return read_library(o, path);
    }
    koksma__text words = {.at = rest, .stop = rest + length};
    koksma_status status = KOKSMA_OK;
    while (!status && koksma__text_word(&words, &rest, &length)) {
        snprintf(name, sizeof name, "%.*s", (int)length, rest);
        status = koksma__find_named(o->text.path, name, path) ? read_library(o, path) : note_missing(o, name);
    }
    return status;
}

/* Begins a new mesh if the group's or object's name differs from the last one. */
static void take_group(obj *o, uint64_t *last, const char *name, size_t length)
{
    const uint64_t hash = koksma__hash(name, length);
    o->split |= hash != *last;
    *last = hash;
}

/* All keywords of the format, and those that ZBrush, MeshLab and old versions write; only a few are read. */
static const char *const keywords[] = {
    "v",        "vt",       "vn",   "f",      "usemtl", "mtllib",     "g",         "o",     "l",     "p",
    "s",        "vp",       "vc",   "vw",     "cstype", "deg",        "bmat",      "step",  "curv",  "curv2",
    "surf",     "parm",     "trim", "hole",   "scrv",   "sp",         "end",       "con",   "mg",    "bevel",
    "c_interp", "d_interp", "lod",  "usemap", "maplib", "shadow_obj", "trace_obj", "ctech", "stech", "call",
    "csh",      "bsp",      "bzp",  "cdc",    "cdp",    "res",        "fo",        NULL};

static koksma_status take_line(obj *o)
{
    koksma__text *t = &o->text;
    const char *word, *rest;
    size_t length;
    koksma_status status = KOKSMA_OK;
    if (t->stop > t->at && t->stop[-1] == '\\') {
        status = join_lines(o);
    }
    if (status || !koksma__text_word(t, &word, &length) || *word == '#') {
        return status;
    }
    if (memchr(word, '\0', (size_t)(t->stop - word))) {
        return wrong(o, "the file is not text: it contains a zero byte");
    }
    if (length == 1 && *word == 'v') {
        return take_vertex(o, PLACE);
    }
    if (length == 1 && (*word == 'f' || *word == 'l' || *word == 'p')) {
        return take_corners(o, *word == 'f');
    }
    if (length == 2 && *word == 'v' && (word[1] == 't' || word[1] == 'n')) {
        return take_vertex(o, word[1] == 't' ? TEXTURE : NORMAL);
    }
    const size_t left = koksma__text_rest(t, &rest);
    if (koksma__text_is(word, length, "usemtl")) {
        return use_material(o, rest, left);
    }
    if (koksma__text_is(word, length, "mtllib")) {
        return left ? take_libraries(o, rest, left) : KOKSMA_OK;
    }
    if (length == 1 && (*word == 'g' || *word == 'o')) {
        take_group(o, *word == 'g' ? &o->group : &o->object, rest, left);
        return KOKSMA_OK;
    }
    for (size_t i = 0; keywords[i]; i++) {
        if (koksma__text_is(word, length, keywords[i])) {
            return KOKSMA_OK;
        }
    }
    return koksma__name_word(t, word, length, "a keyword of OBJ files", keywords, o->out);
}

/* ---- The end ------------------------------------------------------------------------------------------------ */

static koksma_status check_corners(const obj *o)
{
    static const char *const names[KINDS] = {[PLACE] = "vertex", [TEXTURE] = "texture vertex", [NORMAL] = "normal"};
    for (int kind = 0; kind < KINDS; kind++) {
        KOKSMA__FAIL_IF(o->highest[kind] > count_of(o, kind), KOKSMA_MALFORMED,
                        "%s: line %zu: a corner names %s %zu, but there are %zu", o->text.path, o->line_of[kind],
                        names[kind], o->highest[kind], count_of(o, kind));
    }
    return KOKSMA_OK;
}

static koksma_status make_mesh(obj *o, const part *p, size_t end_corner, size_t end_index)
{
    const size_t n = end_corner - p->first_corner, n_indices = end_index - p->first_index;
    const corner *corners = (const corner *)o->corners.items + p->first_corner;
    koksma__mesh mesh = {0};
    bool coloured = false;
    koksma_status status =
        koksma__mesh_init(n, n_indices / 3, p->kinds & 1 << NORMAL, p->kinds & 1 << TEXTURE, &mesh);
    status = status || mesh.normals ? status : koksma__mesh_init_corners(&mesh);
    float *const to[KINDS] = {[PLACE] = mesh.vertices, [TEXTURE] = mesh.uvs, [NORMAL] = mesh.normals};
    for (size_t i = 0; !status && i < KINDS * n; i++) {
        const size_t kind = i % KINDS, width = kind == TEXTURE ? 2 : 3, named = corners[i / KINDS].names[kind];
        if (named) {
            const float *from = (const float *)o->vertices[kind].items + widths[kind] * (named - 1);
            memcpy(to[kind] + width * (i / KINDS), from, width * sizeof *from);
            coloured |= kind == PLACE && from[3] > 0;
        }
    }
    for (size_t i = 0; !status && mesh.corners && i < n; i++) {
        mesh.corners[2 * i] = corners[i].names[PLACE];
        mesh.corners[2 * i + 1] = corners[i].names[TEXTURE];
    }
    if (!status) {
        memcpy(mesh.indices, (const uint32_t *)o->indices.items + p->first_index, n_indices * sizeof *mesh.indices);
        o->out->unread.vertex_colours += coloured;
        status = koksma__file_take_mesh(o->out, &mesh, p->material);
    }
    koksma__mesh_fini(&mesh);
    return status;
}

static koksma_status finish(obj *o)
{
    const part *parts = o->parts.items;
    KOKSMA__TRY(check_corners(o));
    for (size_t i = 0; i < o->parts.n; i++) {
        const bool last = i + 1 == o->parts.n;
        KOKSMA__TRY(make_mesh(o, &parts[i], last ? o->corners.n : parts[i + 1].first_corner,
                              last ? o->indices.n : parts[i + 1].first_index));
        KOKSMA__TRY(koksma__file_add_placement(o->out, i, koksma__identity_matrix));
    }
    const size_t *used = o->used.items;
    koksma__unread *unread = &o->out->unread;
    for (size_t i = 0; i < o->used.n; i++) {
        const koksma__mtl_name *name = (koksma__mtl_name *)o->names.names.items + used[i];
        if (!name->made && !unread->materials++) {
            snprintf(unread->material, sizeof unread->material, "%s", name->name);
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__obj_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    koksma__file_material *grey;
    obj *o = calloc(1, sizeof *o);
    KOKSMA__REQUIRE_MEMORY(o, sizeof *o);
    o->out = out;
    o->text = koksma__text_open(out->path, bytes, size);
    o->group = o->object = koksma__hash("", 0);
    koksma_status status = koksma__file_add_material(out, 0.6f, &grey);
    while (!status && koksma__text_line(&o->text)) {
        status = take_line(o);
    }
    status = status ? status : finish(o);
    KOKSMA__FREE(o->vertices[PLACE].items, o->vertices[TEXTURE].items, o->vertices[NORMAL].items, o->corners.items,
                 o->indices.items, o->parts.items, o->used.items);
    koksma__mtl_names_fini(&o->names);
    koksma__names_fini(&o->libraries);
    koksma__names_fini(&o->read);
    free(o);
    return status;
}
