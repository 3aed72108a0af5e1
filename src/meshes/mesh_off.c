/* SPDX-License-Identifier: Apache-2.0 */
/* OFF files before assimp reads them: some bring it down, of others it leaves out faces (those after a comment, and
   those of more than nine corners). What it gets has neither comments nor anything else that it makes nothing of, and
   polygons as fans of triangles, which mesh_gather.c would make of them anyway.
   Format: http://www.geomview.org/docs/html/OFF.html. */
#include <stdio.h>
#include <stdlib.h>

#include "core/c_locale.h"
#include "meshes/mesh_file.h"
#include "meshes/mesh_lines.h"

enum { HEADER = 64 };

typedef struct off {
    koksma__lines lines;
    size_t vertices, faces, triangles;
    koksma__bytes *out;
} off;

/* The next line that is not empty, without comments. */
static koksma_status next_full_line(koksma__lines *l)
{
    koksma_status status;
    do {
        status = koksma__line_next(l);
        if (!status) {
            l->line[strcspn(l->line, "#")] = '\0';
        }
    } while (!status && !l->line[strspn(l->line, " \t")]);
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

static koksma_status put(off *o, const char *text, size_t length)
{
    return koksma__bytes_put(o->out, o->out->size, text, length) ? KOKSMA_OK : koksma__fail_memory(o->out->size);
}

static koksma_status take_vertex(off *o)
{
    const char *start = o->lines.line + strspn(o->lines.line, " \t"), *text = start;
    for (int k = 0; k < 3; k++) {
        char *end;
        koksma__strtod(text, &end);
        if (end == text || !strchr(" \t", *end)) {
            return koksma__line_wrong(&o->lines, "a vertex is three numbers");
        }
        text = end;
    }
    const koksma_status status = put(o, start, (size_t)(text - start));
    return status ? status : put(o, "\n", 1);
}

static koksma_status put_triangle(off *o, size_t a, size_t b, size_t c)
{
    char line[96];
    o->triangles++;
    return put(o, line, (size_t)snprintf(line, sizeof line, "3 %zu %zu %zu\n", a, b, c));
}

static koksma_status take_face(off *o)
{
    const char *text = o->lines.line;
    size_t corners, vertex, first = 0, last = 0;
    koksma_status status = KOKSMA_OK;
    if (!take_whole(&text, &corners) || corners < 1) {
        return koksma__line_wrong(&o->lines, "a face is the number of its corners, and their vertices");
    }
    for (size_t i = 0; !status && i < corners; i++) {
        if (!take_whole(&text, &vertex) || vertex >= o->vertices) {
            return koksma__line_wrong(
                &o->lines, "a face is the number of its corners, and their vertices, each below the number of these");
        }
        first = i ? first : vertex;
        status = i < 2 ? KOKSMA_OK : put_triangle(o, first, last, vertex);
        last = vertex;
    }
    return status;
}

koksma_status koksma__off_clean(const char *path, const unsigned char *file, size_t size, koksma__bytes *out)
{
    off o = {.lines = {.path = path, .at = file, .end = file + size}, .out = out};
    char header[HEADER];
    koksma_status status = next_full_line(&o.lines);
    if (!status && strcmp(o.lines.line, "OFF") != 0) {
        status = koksma__line_wrong(&o.lines, "not 'OFF', with which such a file begins");
    }
    status = status ? status : next_full_line(&o.lines);
    const char *text = o.lines.line;
    if (!status && (!take_whole(&text, &o.vertices) || !take_whole(&text, &o.faces))) {
        status = koksma__line_wrong(&o.lines, "no numbers of vertices and faces");
    }
    const size_t length = (size_t)snprintf(header, sizeof header, "OFF\n%20zu %20d 0\n", o.vertices, 0);
    status = status ? status : put(&o, header, length);
    for (size_t i = 0; !status && i < o.vertices; i++) { /* ends with the file, whatever is claimed */
        status = next_full_line(&o.lines);
        status = status ? status : take_vertex(&o);
    }
    for (size_t i = 0; !status && i < o.faces; i++) {
        status = next_full_line(&o.lines);
        status = status ? status : take_face(&o);
    }
    if (!status) { /* now that the number is known */
        snprintf(header, sizeof header, "OFF\n%zu %zu 0", o.vertices, o.triangles);
        snprintf(header + strlen(header), sizeof header - strlen(header), "%*s\n", (int)(length - 1 - strlen(header)),
                 "");
        koksma__bytes_put(out, 0, header, length);
    }
    return status;
}
