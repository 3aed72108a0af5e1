/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The module koksma-jpeg.so reads and writes JPEG files by libjpeg-turbo: baseline and progressive, grey or in colour
 * (ITU-T T.81, T.871). Levels are read as sRGB, as in png.c; a colour profile in the file is not applied. Files are
 * written without subsampling at quality 100.
 *
 * libjpeg replaces what is damaged or missing by grey and only warns. Here such a warning is an error, and so are a file
 * that ends before all coefficients of all components came, and data that is left over after a scan (is_harmless says
 * which warnings are not). Arithmetic coding is refused, because its data has no end that a decoder could miss: a file
 * that is cut short could not be told from a whole one. So is a file with more than 100 scans, the limit of Chromium's
 * reader, because each scan takes as long as decoding the whole picture; encoders write at most about 20. When libjpeg
 * reports an error, on_error() returns to the caller by longjmp.
 */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#include <jerror.h>

#include "image/formats.h"
#include "modules/module_side.h"

enum { SCANS = 100, PADDING = 16 };

typedef struct errors {
    struct jpeg_error_mgr manager; /* must be first: the library sees only this member */
    jmp_buf back;
    char message[JMSG_LENGTH_MAX];
    bool no_memory;
} errors;

static void on_error(j_common_ptr jpeg)
{
    errors *e = (errors *)(void *)jpeg->err;
    e->no_memory = e->manager.msg_code == JERR_OUT_OF_MEMORY;
    e->manager.format_message(jpeg, e->message);
    longjmp(e->back, 1);
}

/* Ends with an error of our own. */
static void refuse(j_common_ptr jpeg, const char *text)
{
    errors *e = (errors *)(void *)jpeg->err;
    snprintf(e->message, sizeof e->message, "%s", text);
    longjmp(e->back, 1);
}

/* Whether bytes between two markers may be ignored: those before the first scan are in a part of the header that is
   not used, and cameras fill the end of the data with a few zeros. Others are pixels' data for which there was no place,
   as the data before them was damaged. */
static bool is_filling(j_common_ptr jpeg)
{
    const struct jpeg_decompress_struct *reader = (j_decompress_ptr)jpeg;
    const int count = jpeg->err->msg_parm.i[0];
    bool zeros = count <= PADDING;
    for (int i = 1; i <= count && zeros; i++) {
        zeros = !reader->src->next_input_byte[-i];
    }
    return zeros || !reader->input_scan_number;
}

/* Whether a warning is about something that changes no pixel. Warnings that are not listed are errors. */
static bool is_harmless(j_common_ptr jpeg)
{
    switch (jpeg->err->msg_code) {
    case JWRN_ADOBE_XFORM:    /* an unknown colour transform: YCbCr is assumed */
    case JWRN_JFIF_MAJOR:     /* a version of JFIF from the future */
    case JWRN_NOT_SEQUENTIAL: /* a baseline scan with numbers that only a progressive one uses */
        return true;
    case JWRN_EXTRANEOUS_DATA:
        return is_filling(jpeg);
    default:
        return !jpeg->is_decompressor;
    }
}

static void on_message(j_common_ptr jpeg, int level)
{
    if (level < 0 && !is_harmless(jpeg)) {
        on_error(jpeg);
    }
}

static void on_progress(j_common_ptr jpeg)
{
    char text[64];
    if (jpeg->is_decompressor && ((j_decompress_ptr)jpeg)->input_scan_number > SCANS) {
        snprintf(text, sizeof text, "more than %d scans", SCANS);
        refuse(jpeg, text);
    }
}

static void set_errors(errors *e)
{
    jpeg_std_error(&e->manager);
    e->manager.error_exit = on_error;
    e->manager.emit_message = on_message;
}

static koksma_status fail(const errors *e)
{
    return koksma__fail(e->no_memory ? KOKSMA_MEMORY : KOKSMA_MALFORMED, "as a JPEG: %s", e->message);
}

/* ---- Reading ------------------------------------------------------------------------------------------ */

/* Reads the header. This function and read_rows may be left by longjmp, and so own nothing that needs releasing. */
static bool read_head(struct jpeg_decompress_struct *jpeg, errors *e, const unsigned char *bytes, size_t size)
{
    if (setjmp(e->back)) {
        return false;
    }
    jpeg_create_decompress(jpeg);
    jpeg_mem_src(jpeg, bytes, size);
    jpeg_read_header(jpeg, TRUE);
    if (jpeg->arith_code) {
        refuse((j_common_ptr)jpeg, "its coding is arithmetic, which is not read: save it with Huffman coding");
    }
    jpeg->out_color_space = jpeg->num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    return true;
}

/* Whether every component has a scan and, in a progressive file, all bits of all coefficients. */
static bool is_whole(struct jpeg_decompress_struct *jpeg)
{
    bool whole = true;
    for (int c = 0; c < jpeg->num_components && jpeg_has_multiple_scans(jpeg); c++) {
        whole &= jpeg->comp_info[c].quant_table != NULL;
        for (int k = 0; k < DCTSIZE2 && jpeg->coef_bits; k++) {
            whole &= !jpeg->coef_bits[c][k];
        }
    }
    return whole;
}

/* Every block of 8 x 8 levels takes at least one bit: a Huffman code has one or more. Runs of empty blocks, which take
   less, are only in later scans of a progressive file. */
static double pixels_a_byte(const struct jpeg_decompress_struct *jpeg)
{
    double blocks = 0;
    for (int c = 0; c < jpeg->num_components; c++) {
        blocks += (double)jpeg->comp_info[c].width_in_blocks * (double)jpeg->comp_info[c].height_in_blocks;
    }
    return 8.0 * (double)jpeg->image_width * (double)jpeg->image_height / blocks;
}

static bool read_rows(struct jpeg_decompress_struct *jpeg, errors *e, unsigned char *row, koksma_image *out)
{
    const size_t count = (size_t)out->width * (size_t)out->channels;
    float table[256];
    for (int i = 0; i < 256; i++) {
        table[i] = (float)koksma__from_srgb(i / 255.0);
    }
    if (setjmp(e->back)) {
        return false;
    }
    jpeg_start_decompress(jpeg);
    while (jpeg->output_scanline < jpeg->output_height) {
        float *to = out->pixels + jpeg->output_scanline * count;
        jpeg_read_scanlines(jpeg, &row, 1);
        for (size_t i = 0; i < count; i++) {
            to[i] = table[row[i]];
        }
    }
    if (!is_whole(jpeg)) {
        refuse((j_common_ptr)jpeg, "cut short: scans are missing");
    }
    jpeg_finish_decompress(jpeg);
    return true;
}

static koksma_status read(const unsigned char *bytes, size_t size, koksma_image *out)
{
    struct jpeg_decompress_struct jpeg;
    struct jpeg_progress_mgr progress = {.progress_monitor = on_progress};
    errors e = {.no_memory = false};
    memset(&jpeg, 0, sizeof jpeg);
    set_errors(&e);
    jpeg.err = &e.manager;
    koksma_status status = read_head(&jpeg, &e, bytes, size) ? KOKSMA_OK : fail(&e);
    if (!status) {
        const int channels = jpeg.num_components == 1 ? 1 : 3;
        jpeg.progress = &progress;
        status = KOKSMA__CODEC_HOST->image_claim(jpeg.image_width, jpeg.image_height, channels, size,
                                                 pixels_a_byte(&jpeg), out);
        unsigned char *row = status ? NULL : malloc((size_t)out->width * (size_t)channels);
        if (!status && !row) {
            status = koksma__fail_memory((size_t)out->width * (size_t)channels);
        }
        status = status ? status : read_rows(&jpeg, &e, row, out) ? KOKSMA_OK : fail(&e);
        free(row);
    }
    jpeg_destroy_decompress(&jpeg);
    return status;
}

/* ---- Writing ------------------------------------------------------------------------------------------ */

static bool write_rows(struct jpeg_compress_struct *jpeg, errors *e, const koksma_image *image, const char *metadata,
                       unsigned char *row, unsigned char **bytes, unsigned long *size)
{
    const size_t count = (size_t)image->width * (size_t)image->channels, length = strlen(metadata);
    koksma__srgb_table levels;
    koksma__srgb_table_make(&levels);
    if (setjmp(e->back)) {
        return false;
    }
    jpeg_create_compress(jpeg);
    jpeg_mem_dest(jpeg, bytes, size);
    jpeg->image_width = (JDIMENSION)image->width;
    jpeg->image_height = (JDIMENSION)image->height;
    jpeg->input_components = image->channels;
    jpeg->in_color_space = image->channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, 100, TRUE);
    jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(jpeg, TRUE);
    jpeg_write_marker(jpeg, JPEG_COM, (const JOCTET *)metadata, (unsigned)(length < 65000 ? length : 65000));
    while (jpeg->next_scanline < jpeg->image_height) {
        for (size_t i = 0; i < count; i++) {
            row[i] = koksma__srgb_table_byte(&levels, image->pixels[jpeg->next_scanline * count + i]);
        }
        jpeg_write_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_compress(jpeg);
    return true;
}

static koksma_status write(const koksma_layer *layers, size_t n, const char *metadata, koksma__bytes *out)
{
    const koksma_image *image = layers->image; /* a file holds one layer */
    struct jpeg_compress_struct jpeg;
    errors e = {.no_memory = false};
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    const size_t count = (size_t)image->width * (size_t)image->channels;
    (void)n;
    if (image->width > JPEG_MAX_DIMENSION || image->height > JPEG_MAX_DIMENSION) {
        return koksma__fail(KOKSMA_ARGUMENT, "a JPEG has at most %ld pixels a side", (long)JPEG_MAX_DIMENSION);
    }
    unsigned char *row = malloc(count);
    if (!row) {
        return koksma__fail_memory(count);
    }
    memset(&jpeg, 0, sizeof jpeg);
    set_errors(&e);
    jpeg.err = &e.manager;
    koksma_status status = KOKSMA_OK;
    if (!write_rows(&jpeg, &e, image, metadata, row, &bytes, &size)) {
        status = fail(&e);
    } else if (!KOKSMA__CODEC_HOST->bytes_put(out, 0, bytes, size)) {
        status = koksma__fail_memory(size);
    }
    jpeg_destroy_compress(&jpeg);
    free(bytes);
    free(row);
    return status;
}

static const koksma__codec functions = {read, write};
KOKSMA__MODULE(functions)
