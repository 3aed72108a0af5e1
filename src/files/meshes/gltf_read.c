/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads a glTF 2.0 file, as JSON (.gltf) or binary (.glb): checks it (gltf_schema.c), loads its buffers, and reads what its
 * scene shows (gltf_scene.c). Parts of the file that are not supported are counted or named, for warnings. Specification:
 * Khronos, "glTF 2.0" (2021), and the extensions that gltf_schema.c lists.
 */
#include "meshes/gltf.h"

#include <stdio.h>
#include <string.h>

#include "core/capacity.h"
#include "meshes/readers.h"

typedef koksma__json_node field;

static size_t number_at(const unsigned char *at)
{
    return (size_t)koksma__bits_at(at, 4, false);
}

/* Splits a binary file, a header followed by chunks with length and kind, into the JSON's text and the binary chunk,
   if there is one. */
static koksma_status split(const char *path, koksma__gltf_bytes *text, koksma__gltf_bytes *binary)
{
    const unsigned char *file = text->bytes;
    const size_t size = text->size;
    if (size < 4 || memcmp(file, "glTF", 4) != 0) {
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF(size < 20 || number_at(file + 4) != 2 || memcmp(file + 16, "JSON", 4) != 0 ||
                        number_at(file + 12) > size - 20,
                    KOKSMA_MALFORMED, "%s: not a glTF 2 file in binary form, or cut short", path);
    *text = (koksma__gltf_bytes){file + 20, number_at(file + 12)};
    const size_t next = 20 + text->size;
    KOKSMA__FAIL_IF(number_at(file + 8) != size ||
                        (next < size && (size - next < 8 || number_at(file + next) > size - next - 8)),
                    KOKSMA_MALFORMED, "%s: the lengths of its chunks do not add up to the length of the file", path);
    KOKSMA__FAIL_IF(next < size && text->size % 4, KOKSMA_MALFORMED, /* glTF 2.0, section 4.4.3.1 */
                    "%s: its first chunk has %zu bytes, which is not a multiple of 4", path, text->size);
    if (next < size && !memcmp(file + next + 4, "BIN", 4)) {
        *binary = (koksma__gltf_bytes){file + next + 8, number_at(file + next)};
    }
    return KOKSMA_OK;
}

/* Records the names of unsupported extensions that the file uses, for a warning. */
static koksma_status note_extensions(koksma__gltf *g)
{
    koksma__unread *unread = &g->out->unread;
    field list;
    size_t n = 0;
    KOKSMA__TRY(koksma__gltf_list(&g->root, "extensionsUsed", &list, &n));
    for (size_t i = 0; i < n; i++) {
        const field item = koksma__json_item(&list, i);
        const char *name = "";
        KOKSMA__TRY(koksma__json_text(&item, &name));
        KOKSMA__TRY(koksma__names_put(&g->listed, name, strlen(name), i));
        if (!koksma__gltf_reads(name)) {
            const size_t used = strlen(unread->extension);
            snprintf(unread->extension + used, sizeof unread->extension - used, "%s%s", used ? ", " : "", name);
            unread->extensions++;
        }
    }
    return KOKSMA_OK;
}

static koksma_status read_all(koksma__gltf *g)
{
    koksma__unread *unread = &g->out->unread;
    field list;
    KOKSMA__TRY(note_extensions(g));
    KOKSMA__TRY(koksma__gltf_name_unknown(g));
    KOKSMA__TRY(koksma__gltf_check(g));
    KOKSMA__TRY(koksma__gltf_list(&g->root, "animations", &list, &unread->animations));
    unread->skins = g->n[KOKSMA__GLTF_SKINS];
    KOKSMA__TRY(koksma__gltf_load_buffers(g));
    return koksma__gltf_read_scene(g);
}

koksma_status koksma__gltf_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    koksma__gltf g = {.out = out};
    koksma__json *document;
    koksma__gltf_bytes text = {bytes, size};
    KOKSMA__TRY(split(out->path, &text, &g.binary));
    koksma_status status = koksma__json_open("glTF", out->path, (const char *)text.bytes, text.size, &document);
    if (!status) {
        g.root = koksma__json_root(document);
        g.text_size = text.size;
        status = read_all(&g);
    }
    koksma__json_close(document);
    koksma__names_fini(&g.listed);
    KOKSMA__FREE(g.buffers, g.images, g.views, g.accessors, g.has_parent, g.mesh_shown, g.material_used,
                 g.material_tinted, g.shown.items);
    return status;
}
