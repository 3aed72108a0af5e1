/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads OFF files in their plain text form: "OFF", a line with the numbers of vertices and faces, then one line for
 * each vertex and each face. Comments go from # to the line's end; anything after a vertex's or face's numbers, such
 * as colours, is ignored. A face is given by the number of its corners and the indices of their vertices, from 0 on;
 * it becomes a fan of triangles. The variants with a prefix (COFF, NOFF, STOFF, 4OFF, nOFF) and the binary form are
 * recognised by their first line and rejected. Format: http://www.geomview.org/docs/html/OFF.html.
 */
#include "meshes/readers.h"

#include <stdlib.h>

#include "meshes/mesh_text.h"

typedef struct off {
    koksma__text text;
    long long vertices, faces;
    koksma__list positions, corners, indices; /* corners: those of one face; indices: three for each triangle */
} off;

/* Goes to the next line that is not empty and not only a comment. */
static koksma_status next_line(off *o)
{
    return koksma__text_full_line(&o->text, '#');
}

static bool take_whole(koksma__text *t, long long *value)
{
    const char *word;
    size_t length;
    return koksma__text_word(t, &word, &length) && koksma__text_whole(&word, t->at, value) && word == t->at;
}

static koksma_status take_header(off *o)
{
    const char *word = "";
    koksma_status status = next_line(o);
    const size_t length = status ? 0 : koksma__text_rest(&o->text, &word);
    if (!status && !koksma__text_is(word, length, "OFF")) {
        return koksma__text_wrong(&o->text, "the file does not begin with 'OFF'");
    }
    status = status ? status : next_line(o);
    if (!status && (!take_whole(&o->text, &o->vertices) || !take_whole(&o->text, &o->faces))) {
        return koksma__text_wrong(&o->text, "no numbers of vertices and faces");
    }
    return status;
}

static koksma_status take_vertex(off *o)
{
    float *to = koksma__list_add(&o->positions, 3, sizeof *to);
    for (int k = 0; to && k < 3; k++) {
        const char *word;
        size_t length;
        if (!koksma__text_word(&o->text, &word, &length) || !koksma__text_float(&word, o->text.at, &to[k]) ||
            word != o->text.at) {
            return koksma__text_wrong(&o->text, "a vertex is three numbers");
        }
    }
    return to ? KOKSMA_OK : KOKSMA_MEMORY;
}

static koksma_status take_face(off *o)
{
    long long corners = 0, vertex = 0;
    o->corners.n = 0;
    if (!take_whole(&o->text, &corners) || corners < 1) {
        return koksma__text_wrong(&o->text, "a face is the number of its corners, and their vertices");
    }
    for (long long i = 0; i < corners; i++) { /* stops at the line's end, even if more corners are claimed */
        if (!take_whole(&o->text, &vertex) || vertex >= o->vertices) {
            return koksma__text_wrong(
                &o->text,
                "a face must be the number of its corners, and the indices of their vertices, which must exist");
        }
        uint32_t *to = koksma__list_add(&o->corners, 1, sizeof *to);
        KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
        *to = (uint32_t)vertex;
    }
    return koksma__fan_add(o->text.path, &o->indices, o->corners.items, o->corners.n);
}

static koksma_status finish(off *o, koksma__mesh_file *out)
{
    koksma__mesh mesh = {0};
    koksma__file_material *grey;
    koksma_status status = koksma__mesh_init(o->positions.n / 3, 0, false, false, &mesh);
    if (!status) {
        if (o->positions.n) { /* a file without positions has nothing to copy */
            memcpy(mesh.vertices, o->positions.items, o->positions.n * sizeof *mesh.vertices);
        }
        koksma__fan_finish(&o->indices, &mesh);
        status = koksma__file_take_mesh(out, &mesh, 0);
    }
    koksma__mesh_fini(&mesh);
    status = status ? status : koksma__file_add_placement(out, 0, NULL);
    return status ? status : koksma__file_add_material(out, 0.6f, &grey);
}

koksma_status koksma__off_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    off o = {.text = koksma__text_open(out->path, bytes, size)};
    koksma_status status = take_header(&o);
    /* stops at the file's end, even if more vertices are claimed */
    for (long long i = 0; !status && i < o.vertices; i++) {
        status = next_line(&o);
        status = status ? status : take_vertex(&o);
    }
    for (long long i = 0; !status && i < o.faces; i++) {
        status = next_line(&o);
        status = status ? status : take_face(&o);
    }
    status = status ? status : finish(&o, out);
    free(o.positions.items);
    free(o.corners.items);
    free(o.indices.items);
    return status;
}
