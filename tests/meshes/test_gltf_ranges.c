/* SPDX-License-Identifier: Apache-2.0 */
/* A glTF file with one number out of its range: each is refused in one line that names the file and the number's
   place, with exit code 3, wherever the buffer is. The file as it was opens. Without Embree all is
   skipped.
 */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/render.h>

#include "meshes.h"

/* A square: positions, texture coordinates, and six indices of one, two and four bytes. */
enum { POSITIONS = 0, COORDINATES = 48, INDICES_1 = 80, INDICES_2 = 88, INDICES_4 = 100, BYTES = 124 };

typedef enum container { BESIDE, WITHIN, BINARY, N_CONTAINERS } container;

static const char *const names[N_CONTAINERS] = {"./ranges.gltf", "./ranges.gltf", "./ranges.glb"};
static const char *const uris[N_CONTAINERS] = {"'uri': 'ranges.bin', ", NULL, ""};

static const char model[] =
    "{'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0, 1]}], 'nodes': [{'camera': 0}, {'mesh': 0}], "
    "'cameras': [{'type': 'perspective', 'perspective': {'yfov': 1, 'znear': 0.1}}], 'meshes': [{'primitives': "
    "[{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'indices': 2, 'material': 0}, {'attributes': {'POSITION': 0, "
    "'TEXCOORD_0': 1}, 'indices': 3, 'material': 0}, {'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'indices': 4, "
    "'material': 0}]}], 'materials': [{'pbrMetallicRoughness': {'metallicFactor': 0, 'baseColorTexture': {'index': "
    "0}}}], 'textures': [{'source': 0, 'sampler': 0}], 'images': [{'uri': 'none.png'}], 'samplers': [{}], "
    "'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3'}, {'bufferView': 1, "
    "'componentType': 5126, 'count': 4, 'type': 'VEC2'}, {'bufferView': 2, 'componentType': 5121, 'count': 6, "
    "'type': 'SCALAR'}, {'bufferView': 3, 'componentType': 5123, 'count': 6, 'type': 'SCALAR'}, {'bufferView': 3, "
    "'byteOffset': 12, 'componentType': 5125, 'count': 6, 'type': 'SCALAR'}], 'bufferViews': [{'buffer': 0, "
    "'byteLength': 48}, {'buffer': 0, 'byteOffset': 48, 'byteLength': 32}, {'buffer': 0, 'byteOffset': 80, "
    "'byteLength': 6}, {'buffer': 0, 'byteOffset': 88, 'byteLength': 36}], 'buffers': [{%s'byteLength': 124}]}";

static void fill(unsigned char bytes[BYTES])
{
    static const float numbers[20] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0};
    static const unsigned char corners[6] = {0, 1, 2, 0, 2, 3};
    memset(bytes, 0, BYTES);
    memcpy(bytes, numbers, sizeof numbers);
    for (int i = 0; i < 6; i++) {
        bytes[INDICES_1 + i] = bytes[INDICES_2 + 2 * i] = bytes[INDICES_4 + 4 * i] = corners[i];
    }
}

static void put_word(unsigned char *to, size_t value)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (unsigned char)(value >> 8 * i & 0xff);
    }
}

static void encode(const unsigned char *bytes, size_t size, char *out)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const unsigned bits = (unsigned)bytes[i] << 16 | (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? (unsigned)bytes[i + 2] : 0);
        for (size_t k = 0; k < 4; k++) {
            *out++ = k <= left ? digits[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    *out = '\0';
}

/* The model with `size` bytes of its buffer, `from` in its text replaced. */
static void put_model(container how, const unsigned char *bytes, size_t size, const char *from, const char *to)
{
    char text[4096], uri[512], changed[4096], binary[8192];
    strcpy(uri, "'uri': 'data:application/octet-stream;base64,");
    encode(bytes, size, uri + strlen(uri));
    strcat(uri, "', ");
    snprintf(text, sizeof text, model, how == WITHIN ? uri : uris[how]);
    const char *at = strstr(text, from);
    assert_non_null(at);
    snprintf(changed, sizeof changed - 4, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    json_of(changed);
    if (how != BINARY) {
        test_write_bytes("./ranges.bin", bytes, size);
        test_write_bytes(names[how], changed, strlen(changed));
        return;
    }
    while (strlen(changed) % 4) {
        strcat(changed, " ");
    }
    const size_t length = strlen(changed), whole = 28 + length + size;
    unsigned char *head = (unsigned char *)binary;
    memcpy(head, "glTF\2\0\0\0", 8);
    put_word(head + 8, whole);
    put_word(head + 12, length);
    memcpy(head + 16, "JSON", 4);
    memcpy(head + 20, changed, length);
    put_word(head + 20 + length, size);
    memcpy(head + 24 + length, "BIN\0", 4);
    memcpy(head + 28 + length, bytes, size);
    test_write_bytes(names[how], binary, whole);
}

static void expect_refusal(container how, const char *what, const char *reason)
{
    koksma_scene *scene = NULL;
    const koksma_status status = koksma_scene_open(names[how], &scene);
    const char *text = koksma_error_text();
    if (status != KOKSMA_MALFORMED || koksma_status_exit_code(status) != 3 || !strstr(text, names[how] + 2) ||
        !strstr(text, reason) || strchr(text, '\n')) {
        fail_msg("%s, container %d: status %d, '%s' does not have '%s'", what, (int)how, (int)status, text, reason);
    }
}

static void expect_opens(container how)
{
    koksma_scene *scene = NULL;
    assert_ok(koksma_scene_open(names[how], &scene));
    assert_int_equal(koksma_scene_count(scene).triangles, 6);
    koksma_scene_close(scene);
}

static int clean_up(void **state)
{
    (void)state;
    unlink("./ranges.gltf");
    unlink("./ranges.glb");
    unlink("./ranges.bin");
    return 0;
}

TEST_GROUP(NULL, clean_up)

/* Every index of every width, one beyond the vertices and the largest that there is. */
TEST_CASE(indices_beyond_vertices_are_refused)
{
    need_meshes();
    static const struct {
        int first, width;
    } widths[] = {{INDICES_1, 1}, {INDICES_2, 2}, {INDICES_4, 4}};
    unsigned char bytes[BYTES];
    for (int how = 0; how < N_CONTAINERS; how++) {
        fill(bytes);
        put_model((container)how, bytes, BYTES, "", "");
        expect_opens((container)how);
        for (int w = 0; w < 3; w++) {
            for (int i = 0; i < 12; i++) {
                unsigned char *at = bytes + widths[w].first + i / 2 * widths[w].width;
                char reason[128];
                fill(bytes);
                memset(at, i % 2 ? 0xff : 0, (size_t)widths[w].width);
                at[0] = i % 2 ? 0xff : 4;
                const char *largest = w == 0 ? "255" : w == 1 ? "65535" : "4294967295";
                snprintf(
                    reason, sizeof reason,
                    "meshes[0].primitives[%d]: indices: number %d of accessor %d is vertex %s, but accessor 0 has 4 ",
                    w, i / 2, w + 2, i % 2 ? largest : "4");
                put_model((container)how, bytes, BYTES, "", "");
                expect_refusal((container)how, "index", reason);
            }
        }
    }
}

TEST_CASE(numbers_out_of_range_are_refused)
{
    need_meshes();
    static const struct {
        const char *from, *to, *reason;
    } cases[] = {
        {"'indices': 3", "'indices': 5", "primitives[1]: indices: there is no accessor 5; the file has 5"},
        {"'indices': 3", "'indices': -1", "primitives[1].indices"},
        {"'indices': 3", "'indices': 1", "primitives[1]: indices: accessor 1 has VEC2"},
        {"'POSITION': 0", "'POSITION': 9", "primitives[0].attributes: POSITION: there is no accessor 9"},
        {"'TEXCOORD_0': 1", "'TEXCOORD_0': 9", "TEXCOORD_0: there is no accessor 9"},
        {"'material': 0", "'material': 1", "primitives[0]: material: there is no material 1; the file has 1"},
        {"{'mesh': 0}", "{'mesh': 1}", "nodes[1]: mesh: there is no mesh 1; the file has 1"},
        {"{'mesh': 0}", "{'mesh': 0, 'skin': 0}", "nodes[1]: skin: there is no skin 0"},
        {"{'mesh': 0}", "{'mesh': 0, 'children': [7]}", "nodes[1].children[0]: 7"},
        {"'camera': 0", "'camera': 3", "nodes[0]: camera: there is no camera 3"},
        {"'nodes': [0, 1]", "'nodes': [0, 2]", "scenes[0].nodes[1]: 2"},
        {"'scene': 0", "'scene': 1", "scene: there is no scene 1; the file has 1"},
        {"'index': 0", "'index': 1",
         "materials[0].pbrMetallicRoughness.baseColorTexture: index: there is no texture 1"},
        {"'pbrM", "'normalTexture': {'index': 4}, 'pbrM", "normalTexture: index: there is no texture 4"},
        {"'pbrM", "'occlusionTexture': {'index': 4}, 'pbrM", "occlusionTexture: index: there is no texture 4"},
        {"'pbrM", "'emissiveTexture': {'index': 4}, 'pbrM", "emissiveTexture: index: there is no texture 4"},
        {"'metallicF", "'metallicRoughnessTexture': {'index': 4}, 'metallicF", "index: there is no texture 4"},
        {"'source': 0", "'source': 1", "textures[0]: source: there is no image 1"},
        {"'sampler': 0", "'sampler': 1", "textures[0]: sampler: there is no sampler 1"},
        {"'uri': 'none.png'", "'bufferView': 4, 'mimeType': 'image/png'",
         "images[0]: bufferView: there is no buffer view 4"},
        {"{'bufferView': 2", "{'bufferView': 4",
         "accessors[2]: bufferView: there is no buffer view 4; the file has 4"},
        {"'count': 6", "'count': 7", "accessors[2]: 7 elements of 1 bytes lie beyond a view of 6 bytes"},
        {"'byteOffset': 12", "'byteOffset': 16", "accessors[4]: 6 elements of 4 bytes lie beyond a view of 36 bytes"},
        {"'count': 4", "'count': 3", "TEXCOORD_0: accessor 1 has 4 elements, but accessor 0 has 3 positions"},
        {"'byteOffset': 88", "'byteOffset': 89",
         "bufferViews[3]: its 36 bytes, from byte 89 on, go beyond the end of a buffer of 124 bytes"},
        {"'byteLength': 36", "'byteStride': 256, 'byteLength': 36", "byteStride is 256; it must be at most 252"},
        {"{'buffer': 0", "{'buffer': 1", "bufferViews[0]: buffer: there is no buffer 1; the file has 1"},
        {"'byteLength': 124", "'byteLength': 128", "buffers[0]: byteLength is 128, but there are only 124 bytes"},
    };
    unsigned char bytes[BYTES];
    fill(bytes);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        for (int how = 0; how < N_CONTAINERS; how++) {
            put_model((container)how, bytes, BYTES, cases[c].from, cases[c].to);
            expect_refusal((container)how, cases[c].to, cases[c].reason);
        }
    }
}

/* A buffer that is shorter than it should be, whichever bytes are missing. */
TEST_CASE(buffers_cut_short_are_refused)
{
    need_meshes();
    unsigned char bytes[BYTES];
    fill(bytes);
    for (int how = 0; how < N_CONTAINERS; how++) {
        for (size_t size = 0; size < BYTES; size += 31) {
            char reason[64];
            snprintf(reason, sizeof reason, "buffers[0]: byteLength is 124, but there are only %zu bytes", size);
            put_model((container)how, bytes, size, "", "");
            expect_refusal((container)how, "cut short", reason);
        }
    }
    put_model(WITHIN, bytes, BYTES, "base64,", "base64,*");
    expect_refusal(WITHIN, "no base64", "buffers[0]: uri: character 0 of the data is not base64");
    put_model(WITHIN, bytes, BYTES, ";base64,", ",");
    expect_refusal(WITHIN, "no base64", "buffers[0]: uri: only data in base64 can be read");
}
