/* SPDX-License-Identifier: Apache-2.0 */
/* Whether an OFF or PLY file is one, before assimp reads it: of the former some bring assimp down, of the latter some
   keep it for ever. What is checked: OFF whole, of PLY the header, and that the file is as long as its counts say.
   Formats: http://www.geomview.org/docs/html/OFF.html; G. Turk, "The PLY Polygon File Format" (1994). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "scene/mesh.h"

enum { MAX_LINE = 4096 };

typedef struct lines {
    const char *path;
    const unsigned char *at, *end;
    size_t number; /* of the line that was read last */
    char line[MAX_LINE];
} lines;

static koksma_status wrong(const lines *l, const char *reason)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: %s", l->path, l->number, reason);
}

/* The next line without its end; MALFORMED where there is none, or one that is too long or has a zero byte. */
static koksma_status next_line(lines *l)
{
    l->number++;
    if (l->at == l->end) {
        return wrong(l, "the file ends before what it claims");
    }
    const unsigned char *stop = memchr(l->at, '\n', (size_t)(l->end - l->at));
    size_t length = (size_t)((stop ? stop : l->end) - l->at);
    if (length >= MAX_LINE || memchr(l->at, '\0', length)) {
        return wrong(l, length >= MAX_LINE ? "longer than 4095 characters" : "not text (a zero byte)");
    }
    memcpy(l->line, l->at, length);
    l->at = stop ? stop + 1 : l->end;
    length -= length && l->line[length - 1] == '\r';
    l->line[length] = '\0';
    return KOKSMA_OK;
}

/* ---- OFF ----------------------------------------------------------------------------------------------- */

/* The next line that is neither empty nor a comment. */
static koksma_status next_full_line(lines *l)
{
    koksma_status status;
    do {
        status = next_line(l);
    } while (!status && strchr("#", l->line[strspn(l->line, " \t")]));
    return status;
}

static bool take_whole(const char **text, size_t *value)
{
    char *end;
    const char *start = *text + strspn(*text, " \t");
    if (*start < '0' || *start > '9') {
        return false;
    }
    const unsigned long long whole = strtoull(start, &end, 10);
    *value = whole > SIZE_MAX ? SIZE_MAX : (size_t)whole;
    *text = end;
    return *end == '\0' || *end == ' ' || *end == '\t';
}

static koksma_status check_vertex(const lines *l)
{
    const char *text = l->line;
    for (int k = 0; k < 3; k++) {
        char *end;
        koksma__strtod(text, &end);
        if (end == text || !strchr(" \t", *end)) {
            return wrong(l, "a vertex is three numbers");
        }
        text = end;
    }
    return KOKSMA_OK;
}

static koksma_status check_face(const lines *l, size_t n_vertices)
{
    const char *text = l->line;
    size_t corners, vertex;
    if (!take_whole(&text, &corners) || corners < 1) {
        return wrong(l, "a face is the number of its corners, and their vertices");
    }
    for (size_t i = 0; i < corners; i++) {
        if (!take_whole(&text, &vertex) || vertex >= n_vertices) {
            return wrong(l,
                         "a face is the number of its corners, and their vertices, each below the number of these");
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__off_check(const char *path, const unsigned char *file, size_t size)
{
    lines l = {.path = path, .at = file, .end = file + size};
    size_t vertices = 0, faces = 0;
    koksma_status status = next_full_line(&l);
    if (!status && strcmp(l.line, "OFF") != 0) {
        status = wrong(&l, "not 'OFF', with which such a file begins");
    }
    status = status ? status : next_full_line(&l);
    const char *text = l.line;
    if (!status && (!take_whole(&text, &vertices) || !take_whole(&text, &faces))) {
        status = wrong(&l, "no numbers of vertices and faces");
    }
    for (size_t i = 0; !status && i < vertices; i++) { /* ends with the file, whatever is claimed */
        status = next_full_line(&l);
        status = status ? status : check_vertex(&l);
    }
    for (size_t i = 0; !status && i < faces; i++) {
        status = next_full_line(&l);
        status = status ? status : check_face(&l, vertices);
    }
    return status;
}

/* ---- PLY ----------------------------------------------------------------------------------------------- */

typedef struct ply {
    bool text, in_element;
    size_t count, item_bytes; /* of the element at hand: its number, and the least that one of them takes */
    double bytes;             /* of all elements before it */
} ply;

/* Bytes of a scalar type; 0 when there is none of this name. */
static size_t type_bytes(const char *name)
{
    static const struct {
        const char *name;
        size_t bytes;
    } types[] = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
                 {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
                 {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (!strcmp(types[i].name, name)) {
            return types[i].bytes;
        }
    }
    return 0;
}

static void end_element(ply *p)
{
    p->bytes += (double)p->count * (double)p->item_bytes;
    p->item_bytes = 0;
}

static koksma_status take_property(const lines *l, ply *p)
{
    char first[16], second[16], third[16], name[64], rest[2];
    size_t bytes = 0;
    if (sscanf(l->line, "property list %15s %15s %63s %1s", first, second, name, rest) == 3) {
        bytes = type_bytes(second) ? type_bytes(first) : 0;
    } else if (sscanf(l->line, "property %15s %63s %1s", third, name, rest) == 2) {
        bytes = type_bytes(third);
    }
    if (!bytes || !p->in_element) {
        return wrong(l, p->in_element ? "no property of a known type" : "a property of no element");
    }
    p->item_bytes += p->text ? 2 : bytes; /* as text a digit and a blank, at least */
    return KOKSMA_OK;
}

static koksma_status take_header_line(const lines *l, ply *p)
{
    unsigned long long count;
    char name[64], digits[24], rest[2];
    if (!strncmp(l->line, "comment", 7) || !strncmp(l->line, "obj_info", 8)) {
        return KOKSMA_OK;
    }
    if (!strncmp(l->line, "property ", 9)) {
        return take_property(l, p);
    }
    if (sscanf(l->line, "element %63s %23[0-9] %1s", name, digits, rest) != 2) {
        return wrong(l, "neither an element, nor a property, a comment or end_header");
    }
    count = strtoull(digits, NULL, 10);
    end_element(p);
    p->in_element = true;
    p->count = count > SIZE_MAX ? SIZE_MAX : (size_t)count;
    return KOKSMA_OK;
}

koksma_status koksma__ply_check(const char *path, const unsigned char *file, size_t size)
{
    lines l = {.path = path, .at = file, .end = file + size};
    ply p = {0};
    char format[24] = "", version[8], rest[2];
    koksma_status status = next_line(&l);
    if (!status && strcmp(l.line, "ply") != 0) {
        status = wrong(&l, "not 'ply', with which such a file begins");
    }
    status = status ? status : next_line(&l);
    if (!status &&
        (sscanf(l.line, "format %23s %7s %1s", format, version, rest) != 2 || strcmp(version, "1.0") != 0 ||
         (strcmp(format, "ascii") != 0 && strcmp(format, "binary_little_endian") != 0 &&
          strcmp(format, "binary_big_endian") != 0))) {
        status = wrong(&l, "no format ascii, binary_little_endian or binary_big_endian 1.0");
    }
    p.text = !status && !strcmp(format, "ascii");
    while (!status && !(status = next_line(&l)) && strcmp(l.line, "end_header") != 0) {
        status = take_header_line(&l, &p);
    }
    end_element(&p);
    if (!status && p.bytes > (double)(l.end - l.at) + 1) { /* the last blank may be missing */
        status =
            koksma__fail(KOKSMA_MALFORMED, "%s: its elements take %.0f bytes at least, and after the header are %td",
                         path, p.bytes, l.end - l.at);
    }
    return status;
}
