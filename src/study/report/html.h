/* SPDX-License-Identifier: Apache-2.0 */
/* A growing HTML text. A failure to get memory is kept and comes out at the end. */
#ifndef KOKSMA_STUDY_REPORT_HTML_H
#define KOKSMA_STUDY_REPORT_HTML_H

#include <koksma/image.h>

typedef struct koksma__html {
    char *text;
    size_t size, room;
    bool failed;
} koksma__html;

/* Appends formatted markup; what comes from outside goes through koksma__html_text. */
void koksma__html_add(koksma__html *html, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Appends ` id="KIND-NAME"`, where the text has it already with a number behind, from 2 on. NAME needs no escapes. */
void koksma__html_id(koksma__html *html, const char *kind, const char *name);

/* Appends text with the characters of markup escaped. */
void koksma__html_text(koksma__html *html, const char *text);

/* Appends bytes in base 64. */
void koksma__html_base64(koksma__html *html, const unsigned char *bytes, size_t size);

/* <img> with the PNG of an image inside, `scale` CSS pixels a pixel, never smoothed. */
koksma_status koksma__html_image(koksma__html *html, const koksma_image *image, int scale, const char *alt);

/* <img> with an SVG inside. */
void koksma__html_svg(koksma__html *html, const unsigned char *svg, size_t size, int width, const char *alt);

#endif
