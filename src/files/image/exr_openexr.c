/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The module koksma-exr.so reads and writes EXR files by the C library OpenEXRCore. It reads a file's first part, in
 * scan lines or tiles, with channels R G B or Y (or a single channel of any name); it writes floats, ZIP-compressed.
 *
 * OpenEXRCore 3.1.5 lacks DWAA and DWAB, and decodes B44 and B44A wrongly without an error: those four are read by the C
 * interface of OpenEXR's C++ library. That interface opens files only by name, so the bytes are copied to a file in
 * memory (memfd). It returns half floats. It keeps its last error in a variable that all threads share: the text of
 * an error may be that of another thread, but the status is right.
 *
 * OpenEXRCore 3.1.5 loses a chunk whose ZIP stream is exactly as long as its pixels: it writes the stream, and every
 * reader takes such a stream for uncompressed pixels. So a file with a chunk of that length is written again without
 * compression: a rare one, as ZIP shortens the exponents of noise.
 */
#define _GNU_SOURCE /* memfd_create */
#include <errno.h>
#include <math.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <OpenEXR/ImfCRgbaFile.h>

#include "image/formats.h"
#include "modules/module_side.h"

enum { SHORT_NAME = 31 }; /* the longest channel name, in bytes, that every EXR reader accepts */

typedef struct source {
    const unsigned char *bytes;
    size_t size;
    koksma__bytes *out;
} source;

/* The text of the first error. It cannot be a member of the struct `source`: OpenEXRCore 3.1 calls the error handler
   while it holds the lock of the context, and reading `source` from the context would wait for that lock. */
static _Thread_local char message[256];

/* Whether malloc has failed. OpenEXRCore's own "out of memory" also means data that it cannot decompress. */
static _Thread_local bool exhausted;

static void *allocate(size_t size)
{
    void *memory = malloc(size);
    exhausted |= !memory;
    return memory;
}

static void on_error(exr_const_context_t file, exr_result_t code, const char *text)
{
    (void)file;
    (void)code;
    if (!*message) {
        strncpy(message, text, sizeof message - 1);
    }
}

/* Turns an error of OpenEXRCore into a status: MEMORY, or `otherwise` for all other errors. A failed write is MEMORY,
   because files are written into memory. */
static koksma_status fail(exr_result_t code, koksma_status otherwise)
{
    const char *text = *message ? message : exr_get_default_error_message(code);
    return koksma__fail(exhausted || code == EXR_ERR_WRITE_IO ? KOKSMA_MEMORY : otherwise, "as an EXR: %s", text);
}

/* ---- Reading ------------------------------------------------------------------------------------------ */

static int64_t read_bytes(exr_const_context_t file, void *user, void *buffer, uint64_t size, uint64_t offset,
                          exr_stream_error_func_ptr_t error)
{
    (void)file;
    (void)error;
    const source *s = user;
    if (offset >= s->size) {
        return 0;
    }
    const uint64_t left = s->size - offset, count = size < left ? size : left;
    memcpy(buffer, s->bytes + offset, count);
    return (int64_t)count;
}

static int64_t query_size(exr_const_context_t file, void *user)
{
    (void)file;
    return (int64_t)((const source *)user)->size;
}

/* The index of a channel in an image of 1 or 3 channels; -1: the channel is not part of the image. */
static int colour(const char *name, int channels)
{
    static const char *const names[] = {"R", "G", "B"};
    for (int k = 0; channels == 3 && k < 3; k++) {
        if (!strcmp(name, names[k])) {
            return k;
        }
    }
    return channels == 1 && !strcmp(name, "Y") ? 0 : -1;
}

/* The number of channels to read: 3, 1, or 0 if the file has no known colours. */
static int count_channels(const exr_attr_chlist_t *list)
{
    int rgb = 0, y = 0;
    for (int i = 0; i < list->num_channels; i++) {
        rgb += colour(list->entries[i].name.str, 3) >= 0;
        y += colour(list->entries[i].name.str, 1) >= 0;
    }
    return rgb == 3 ? 3 : y || list->num_channels == 1 ? 1 : 0;
}

/* ---- B44 and DWA ------------------------------------------------------------------------------------- */

/* Fails with the library's message, without the name of the file in memory, which it has in quotes. */
static koksma_status fail_rgba(const char *path)
{
    char name[72];
    const char *text = ImfErrorMessage();
    const int length = snprintf(name, sizeof name, " \"%s\"", path);
    const char *at = strstr(text, name);
    return koksma__fail(KOKSMA_MALFORMED, "as an EXR: %.*s%s", at ? (int)(at - text) : (int)strlen(text), text,
                        at ? at + length : "");
}

static koksma_status read_rgba_pixels(ImfInputFile *file, const char *path, size_t size, int channels, bool wide,
                                      koksma_image *out)
{
    int low_x, low_y, high_x, high_y;
    ImfHeaderDataWindow(ImfInputHeader(file), &low_x, &low_y, &high_x, &high_y);
    KOKSMA__TRY(KOKSMA__CODEC_HOST->image_claim((long long)high_x - low_x + 1, (long long)high_y - low_y + 1,
                                                channels, size, 4096, out));
    const size_t width = (size_t)out->width;
    ImfRgba *row = malloc(width * sizeof *row);
    KOKSMA__REQUIRE_MEMORY(row, width * sizeof *row);
    bool whole = true, fits = true;
    for (int y = low_y; whole && y <= high_y; y++) {
        /* the library expects the address that pixel (0, 0) would have */
        ImfRgba *base = (ImfRgba *)((uintptr_t)row - (uintptr_t)((ptrdiff_t)low_x * (ptrdiff_t)sizeof *row));
        whole = ImfInputSetFrameBuffer(file, base, 1, 0) && ImfInputReadPixels(file, y, y);
        for (size_t x = 0; whole && x < width; x++) {
            const float colour[3] = {ImfHalfToFloat(row[x].r), ImfHalfToFloat(row[x].g), ImfHalfToFloat(row[x].b)};
            const size_t at = width * (size_t)(y - low_y) + x;
            for (size_t k = 0; k < (size_t)channels; k++) {
                out->pixels[at * (size_t)channels + k] = colour[k];
                fits &= !wide || isfinite(colour[k]);
            }
        }
    }
    free(row);
    if (!whole) {
        return fail_rgba(path);
    }
    return fits ? KOKSMA_OK
                : koksma__fail(KOKSMA_MALFORMED, "as an EXR: numbers above 65504 in a B44 or DWA file are not read");
}

/* wide: whether the file's numbers are not halves; one that is too large for a half is then an error. */
static koksma_status read_halves(const unsigned char *bytes, size_t size, int channels, bool wide, koksma_image *out)
{
    char path[64];
    const int descriptor = memfd_create("koksma", MFD_CLOEXEC);
    ssize_t n = descriptor < 0 ? -1 : 0;
    for (size_t done = 0; n >= 0 && done < size; done += (size_t)(n > 0 ? n : 0)) {
        n = write(descriptor, bytes + done, size - done);
    }
    koksma_status status = KOKSMA_OK;
    if (n < 0) {
        status = koksma__fail(KOKSMA_SYSTEM, "as an EXR: can't make a file in memory: %s", strerror(errno));
    } else {
        snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
        ImfInputFile *file = ImfOpenInputFile(path);
        status = file ? read_rgba_pixels(file, path, size, channels, wide, out) : fail_rgba(path);
        if (file) {
            ImfCloseInputFile(file);
        }
    }
    if (descriptor >= 0) {
        close(descriptor);
    }
    return status;
}

/* Reads such a file. Y is accepted only as the single channel, because OpenEXR's library turns Y beside
   other channels into colours. */
static koksma_status read_rgba(const source *s, const exr_attr_chlist_t *list, int channels, koksma_image *out)
{
    bool y = false, others = false, wide = false;
    for (int i = 0; i < list->num_channels; i++) {
        const char *name = list->entries[i].name.str;
        y |= !strcmp(name, "Y");
        others |= !strcmp(name, "RY") || !strcmp(name, "BY") || (channels == 1 && colour(name, 3) >= 0);
        wide |= list->entries[i].pixel_type != EXR_PIXEL_HALF;
    }
    return others || y != (channels == 1)
               ? koksma__fail(KOKSMA_MALFORMED,
                              "as an EXR: of B44 and DWA files only those with R, G, B or with Y alone are read")
               : read_halves(s->bytes, s->size, channels, wide, out);
}

/* ---- All others --------------------------------------------------------------------------------------- */

/* Points the decoder's channels at the pixels of the chunk whose first pixel is (x, y). */
static void aim(exr_decode_pipeline_t *decoder, koksma_image *image, int x, int y)
{
    const size_t pixel = sizeof(float) * (size_t)image->channels;
    for (int c = 0; c < decoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &decoder->channels[c];
        const int k = decoder->channel_count == 1 ? 0 : colour(channel->channel_name, image->channels);
        channel->decode_to_ptr = NULL;
        if (k >= 0) {
            const size_t at = ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels + (size_t)k;
            channel->decode_to_ptr = (uint8_t *)(image->pixels + at);
            channel->user_bytes_per_element = sizeof(float);
            channel->user_data_type = EXR_PIXEL_FLOAT;
            channel->user_pixel_stride = (int32_t)pixel;
            channel->user_line_stride = (int32_t)(pixel * (size_t)image->width);
        }
    }
}

/* Chooses the routines that decode. If one of 3 or 4 channels of half floats is read, OpenEXRCore 3.1.5 would choose
   a routine that reads all channels, and write through the null pointers of the other channels. Therefore, during the
   choice, each channel that is not read has a pointer and asks to be converted to another type: the library then
   chooses its general routine, which skips channels without a pointer. */
static exr_result_t choose(exr_const_context_t file, exr_decode_pipeline_t *decoder, koksma_image *image)
{
    aim(decoder, image, 0, 0);
    for (int c = 0; c < decoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &decoder->channels[c];
        if (!channel->decode_to_ptr) {
            channel->decode_to_ptr = (uint8_t *)image->pixels;
            channel->user_data_type = channel->data_type == EXR_PIXEL_HALF ? EXR_PIXEL_UINT : EXR_PIXEL_HALF;
        }
    }
    return exr_decoding_choose_default_routines(file, 0, decoder);
}

static exr_result_t decode(exr_const_context_t file, const exr_chunk_info_t *chunk, exr_decode_pipeline_t *decoder,
                           bool first, koksma_image *image, int x, int y)
{
    exr_result_t r =
        first ? exr_decoding_initialize(file, 0, chunk, decoder) : exr_decoding_update(file, 0, chunk, decoder);
    if (!r && first) {
        r = choose(file, decoder, image);
    }
    if (!r) {
        aim(decoder, image, x, y);
    }
    return r ? r : exr_decoding_run(file, 0, decoder);
}

static exr_result_t read_lines(exr_const_context_t file, int top, exr_decode_pipeline_t *decoder, koksma_image *image)
{
    int32_t lines = 1;
    exr_chunk_info_t chunk;
    exr_result_t r = exr_get_scanlines_per_chunk(file, 0, &lines);
    for (int y = 0; !r && y < image->height; y += lines) {
        r = exr_read_scanline_chunk_info(file, 0, top + y, &chunk);
        /* checked before decoding, because the decoder writes as many pixels as the chunk claims */
        if (!r && (chunk.start_y != top + y || chunk.width != image->width || chunk.height > image->height - y)) {
            r = EXR_ERR_CORRUPT_CHUNK;
        }
        r = r ? r : decode(file, &chunk, decoder, y == 0, image, 0, y);
    }
    return r;
}

static exr_result_t read_tiles(exr_const_context_t file, exr_decode_pipeline_t *decoder, koksma_image *image)
{
    int32_t tile_x = 1, tile_y = 1;
    exr_chunk_info_t chunk;
    exr_result_t r = exr_get_tile_sizes(file, 0, 0, 0, &tile_x, &tile_y);
    if (!r && (tile_x < 1 || tile_y < 1)) {
        r = EXR_ERR_INVALID_ATTR;
    }
    for (int y = 0; !r && y < image->height; y += tile_y) {
        for (int x = 0; !r && x < image->width; x += tile_x) {
            r = exr_read_tile_chunk_info(file, 0, x / tile_x, y / tile_y, 0, 0, &chunk);
            if (!r && (chunk.width > image->width - x || chunk.height > image->height - y)) {
                r = EXR_ERR_CORRUPT_CHUNK;
            }
            r = r ? r : decode(file, &chunk, decoder, x == 0 && y == 0, image, x, y);
        }
    }
    return r;
}

/* Whether a tile is at most as large as the image, or at most 2048 x 2048 pixels: OpenEXR's C++ library allocates
   memory for whole tiles. */
static bool tiles_fit(exr_const_context_t file, const exr_attr_box2i_t *window)
{
    uint32_t width, height;
    exr_tile_level_mode_t levels;
    exr_tile_round_mode_t rounding;
    const double image = ((double)window->max.x - window->min.x + 1) * ((double)window->max.y - window->min.y + 1);
    return !exr_get_tile_descriptor(file, 0, &width, &height, &levels, &rounding) &&
           (double)width * height <= fmax(image, 2048.0 * 2048.0);
}

/* Whether a chunk, which is a tile or some lines, has at most 256 MiB, or at most 16 bytes for each pixel of the
   image: the libraries allocate memory for all its channels, also for those that are not read. */
static bool chunks_fit(exr_const_context_t file, bool tiled, const exr_attr_box2i_t *window,
                       const exr_attr_chlist_t *list)
{
    int32_t chunk_x = 1, chunk_y = 1;
    const double width = (double)window->max.x - window->min.x + 1,
                 height = (double)window->max.y - window->min.y + 1;
    double bytes = 0;
    for (int i = 0; i < list->num_channels; i++) {
        bytes += list->entries[i].pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    }
    if (tiled ? exr_get_tile_sizes(file, 0, 0, 0, &chunk_x, &chunk_y)
              : exr_get_scanlines_per_chunk(file, 0, &chunk_y)) {
        return false;
    }
    const double pixels = (tiled ? fmin(chunk_x, width) : width) * fmin(chunk_y, height);
    return bytes * pixels <= fmax(16 * width * height, 0x1p28);
}

static koksma_status read_part(exr_const_context_t file, const source *s, koksma_image *out)
{
    exr_storage_t storage;
    exr_attr_box2i_t window;
    exr_compression_t compression;
    const exr_attr_chlist_t *list;
    exr_result_t r = exr_get_storage(file, 0, &storage);
    r = r ? r : exr_get_compression(file, 0, &compression);
    r = r ? r : exr_get_data_window(file, 0, &window);
    r = r ? r : exr_get_channels(file, 0, &list);
    if (r) {
        return fail(r, KOKSMA_MALFORMED);
    }
    KOKSMA__FAIL_IF(storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED, KOKSMA_MALFORMED,
                    "as an EXR: deep images are not read");
    const int channels = count_channels(list);
    KOKSMA__FAIL_IF(!channels, KOKSMA_MALFORMED, "as an EXR: no channels R, G, B and no channel Y");
    for (int i = 0; i < list->num_channels; i++) {
        KOKSMA__FAIL_IF(list->entries[i].x_sampling != 1 || list->entries[i].y_sampling != 1, KOKSMA_MALFORMED,
                        "as an EXR: subsampled channels are not read");
    }
    KOKSMA__FAIL_IF(storage == EXR_STORAGE_TILED && !tiles_fit(file, &window), KOKSMA_MALFORMED,
                    "as an EXR: its tiles are larger than the image");
    KOKSMA__FAIL_IF(!chunks_fit(file, storage == EXR_STORAGE_TILED, &window, list), KOKSMA_MALFORMED,
                    "as an EXR: its chunks have more than 256 MiB");
    if (compression >= EXR_COMPRESSION_B44) { /* the last four: B44, B44A, DWAA, DWAB */
        return read_rgba(s, list, channels, out);
    }
    const koksma_status status =
        KOKSMA__CODEC_HOST->image_claim((long long)window.max.x - window.min.x + 1,
                                        (long long)window.max.y - window.min.y + 1, channels, s->size, 1032, out);
    if (status) {
        return status;
    }
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    r = storage == EXR_STORAGE_TILED ? read_tiles(file, &decoder, out)
                                     : read_lines(file, window.min.y, &decoder, out);
    exr_decoding_destroy(file, &decoder);
    return r ? fail(r, KOKSMA_MALFORMED) : KOKSMA_OK;
}

/* Sets up a context for reading or writing, and clears the last failure. */
static exr_context_initializer_t begin(source *s)
{
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = on_error;
    how.alloc_fn = allocate;
    how.user_data = s;
    exhausted = false;
    *message = 0;
    return how;
}

static koksma_status read_exr(const unsigned char *bytes, size_t size, koksma_image *out)
{
    source s = {.bytes = bytes, .size = size};
    exr_context_t file;
    exr_context_initializer_t how = begin(&s);
    how.read_fn = read_bytes;
    how.size_fn = query_size;
    how.max_image_width = how.max_image_height = KOKSMA_MAX_IMAGE_SIDE;
    const exr_result_t r = exr_start_read(&file, "image", &how);
    if (r) {
        return fail(r, KOKSMA_MALFORMED);
    }
    const koksma_status status = read_part(file, &s, out);
    exr_finish(&file);
    return status;
}

/* ---- Writing ------------------------------------------------------------------------------------------ */

static int64_t write_bytes(exr_const_context_t file, void *user, const void *buffer, uint64_t size, uint64_t offset,
                           exr_stream_error_func_ptr_t error)
{
    (void)file;
    (void)error;
    return KOKSMA__CODEC_HOST->bytes_put(((source *)user)->out, offset, buffer, size) ? (int64_t)size : -1;
}

static exr_result_t put_header(exr_context_t file, const koksma_layer *layers, size_t n, const char *metadata,
                               exr_compression_t compression)
{
    int part;
    char name[KOKSMA__CHANNEL_NAME];
    const koksma_image *image = layers->image;
    exr_result_t r = exr_add_part(file, NULL, EXR_STORAGE_SCANLINE, &part);
    r = r ? r : exr_initialize_required_attr_simple(file, 0, image->width, image->height, compression);
    for (size_t l = 0; l < n; l++) {
        for (int k = 0; !r && k < layers[l].image->channels; k++) {
            const exr_perceptual_treatment_t kind = l ? EXR_PERCEPTUALLY_LINEAR : EXR_PERCEPTUALLY_LOGARITHMIC;
            KOKSMA__CODEC_HOST->layer_channel(&layers[l], k, name);
            r = strlen(name) > SHORT_NAME ? exr_set_longname_support(file, 1) : r;
            r = r ? r : exr_add_channel(file, 0, name, EXR_PIXEL_FLOAT, kind, 1, 1);
        }
    }
    if (!r && *metadata) {
        r = exr_attr_set_string(file, 0, "comments", metadata);
    }
    return r ? r : exr_write_header(file);
}

static void aim_encoder(exr_encode_pipeline_t *encoder, const koksma_layer *layers, size_t n, int y)
{
    const size_t width = (size_t)layers->image->width;
    for (int c = 0; c < encoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &encoder->channels[c];
        int k;
        const koksma_image *image =
            layers[KOKSMA__CODEC_HOST->layers_find(layers, n, channel->channel_name, &k)].image;
        const size_t channels = (size_t)image->channels, pixel = sizeof(float) * channels;
        channel->encode_from_ptr = (const uint8_t *)(image->pixels + (size_t)k + (size_t)y * width * channels);
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_pixel_stride = (int32_t)pixel;
        channel->user_line_stride = (int32_t)(pixel * width);
    }
}

/* *doubtful becomes true if a chunk is as long as its pixels. */
static exr_result_t put_lines(exr_context_t file, const koksma_layer *layers, size_t n,
                              exr_encode_pipeline_t *encoder, bool *doubtful)
{
    int32_t lines = 1;
    exr_chunk_info_t chunk;
    exr_result_t r = exr_get_scanlines_per_chunk(file, 0, &lines);
    for (int y = 0; !r && y < layers->image->height; y += lines) {
        r = exr_write_scanline_chunk_info(file, 0, y, &chunk);
        r = r   ? r
            : y ? exr_encoding_update(file, 0, &chunk, encoder)
                : exr_encoding_initialize(file, 0, &chunk, encoder);
        if (!r) {
            aim_encoder(encoder, layers, n, y);
            r = y ? r : exr_encoding_choose_default_routines(file, 0, encoder);
        }
        r = r ? r : exr_encoding_run(file, 0, encoder);
        *doubtful |= encoder->compressed_bytes == encoder->packed_bytes;
    }
    return r;
}

static koksma_status encode(const koksma_layer *layers, size_t n, const char *metadata, exr_compression_t compression,
                            bool *doubtful, koksma__bytes *out)
{
    source s = {.out = out};
    exr_context_t file;
    exr_context_initializer_t how = begin(&s);
    how.write_fn = write_bytes;
    exr_result_t r = exr_start_write(&file, "image", EXR_WRITE_FILE_DIRECTLY, &how);
    if (!r) {
        exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
        r = put_header(file, layers, n, metadata, compression);
        r = r ? r : put_lines(file, layers, n, &encoder, doubtful);
        exr_encoding_destroy(file, &encoder);
        const exr_result_t finish = exr_finish(&file);
        r = r ? r : finish;
    }
    return r ? fail(r, KOKSMA_IO) : KOKSMA_OK;
}

static koksma_status write_exr(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    bool doubtful = false;
    KOKSMA__TRY(encode(layers, n, metadata, EXR_COMPRESSION_ZIP, &doubtful, out));
    if (!doubtful) {
        return KOKSMA_OK;
    }
    out->size = 0;
    return encode(layers, n, metadata, EXR_COMPRESSION_NONE, &doubtful, out);
}

static const koksma__codec functions = {read_exr, write_exr};
KOKSMA__MODULE(functions)
