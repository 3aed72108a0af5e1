/* SPDX-License-Identifier: Apache-2.0 */
#include "study/report/html.h"
#include "core/c_locale.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool grow(koksma__html *html, size_t more)
{
    if (html->size + more + 1 > html->room) {
        const size_t room = 2 * (html->size + more + 1);
        char *text = html->failed ? NULL : realloc(html->text, room);
        if (!text) {
            html->failed = true;
            return false;
        }
        html->text = text;
        html->room = room;
    }
    return true;
}

static void append(koksma__html *html, const char *text, size_t size)
{
    if (grow(html, size)) {
        memcpy(html->text + html->size, text, size);
        html->size += size;
        html->text[html->size] = '\0';
    }
}

void koksma__html_add(koksma__html *html, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int size = koksma__vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (size >= 0 && grow(html, (size_t)size)) {
        koksma__vsnprintf(html->text + html->size, (size_t)size + 1, format, again);
        html->size += (size_t)size;
    }
    va_end(again);
}

void koksma__html_id(koksma__html *html, const char *kind, const char *name)
{
    const size_t before = html->size;
    koksma__html_add(html, " id=\"%s-%s\"", kind, name);
    for (int number = 2; !html->failed; number++) {
        const char *first = strstr(html->text, html->text + before);
        if (first == html->text + before) {
            return;
        }
        html->size = before;
        koksma__html_add(html, " id=\"%s-%s-%d\"", kind, name, number);
    }
}

void koksma__html_text(koksma__html *html, const char *text)
{
    for (; *text; text++) {
        const char *entity = *text == '&'   ? "&amp;"
                             : *text == '<' ? "&lt;"
                             : *text == '>' ? "&gt;"
                             : *text == '"' ? "&quot;"
                                            : NULL;
        append(html, entity ? entity : text, entity ? strlen(entity) : 1);
    }
}

void koksma__html_base64(koksma__html *html, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const unsigned long word = (unsigned long)bytes[i] << 16 | (left > 1 ? (unsigned long)bytes[i + 1] << 8 : 0) |
                                   (left > 2 ? bytes[i + 2] : 0);
        const char four[4] = {digits[word >> 18], digits[word >> 12 & 63], left > 1 ? digits[word >> 6 & 63] : '=',
                              left > 2 ? digits[word & 63] : '='};
        append(html, four, 4);
    }
}

static void add_embedded(koksma__html *html, const char *type, const unsigned char *bytes, size_t size, int width,
                         int height, const char *alt)
{
    koksma__html_add(html, "<img width=\"%d\" height=\"%d\" alt=\"", width, height);
    koksma__html_text(html, alt);
    koksma__html_add(html, "\" src=\"data:%s;base64,", type);
    koksma__html_base64(html, bytes, size);
    koksma__html_add(html, "\">");
}

koksma_status koksma__html_image(koksma__html *html, const koksma_image *image, int scale, const char *alt)
{
    unsigned char *bytes;
    size_t size;
    const koksma_status status = koksma_image_png_bytes(image, &bytes, &size);
    if (!status) {
        add_embedded(html, "image/png", bytes, size, image->width * scale, image->height * scale, alt);
        free(bytes);
    }
    return status;
}

void koksma__html_svg(koksma__html *html, const unsigned char *svg, size_t size, int width, const char *alt)
{
    add_embedded(html, "image/svg+xml", svg, size, width, width, alt);
}
