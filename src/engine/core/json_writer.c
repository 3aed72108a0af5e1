/* SPDX-License-Identifier: Apache-2.0 */
/* Writes JSON text for exports, reports and the program's option --json. For each value it writes a comma if another
   value precedes it, the key if it has one, and the text. A stack has the closing brackets of all open objects and
   arrays. Quotes, backslashes and control characters in texts are escaped. Bytes that are not valid UTF-8 (RFC 3629:
   no overlong forms, no surrogates, nothing above U+10FFFF) are replaced by U+FFFD, because file names may have any
   bytes and JSON may not. Numbers do not follow the host's locale. */
#include "core/json_writer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/status.h"

static void append(koksma__json_writer *w, const char *text, size_t size)
{
    w->status = w->status ? w->status : koksma__reserve(&w->text, &w->capacity, w->size + size + 1, 1);
    if (w->status) {
        return;
    }
    memcpy(w->text + w->size, text, size);
    w->size += size;
    w->text[w->size] = '\0';
}

void koksma__json_add_text(koksma__json_writer *w, const char *text)
{
    while (*text) {
        const size_t length = koksma__utf8_length((const unsigned char *)text);
        const unsigned char c = (unsigned char)*text;
        char escape[8] = {'\\', *text};
        if (!length) {
            append(w, "\xef\xbf\xbd", 3);
        } else if (c == '"' || c == '\\') {
            append(w, escape, 2);
        } else if (c < 0x20 || (w->in_html && strchr("<>&", c))) {
            append(w, escape, (size_t)snprintf(escape, sizeof escape, "\\u%04x", c));
        } else {
            append(w, text, length);
        }
        text += length ? length : 1;
    }
}

static void append_quoted(koksma__json_writer *w, const char *text)
{
    append(w, "\"", 1);
    koksma__json_add_text(w, text);
    append(w, "\"", 1);
}

/* Writes the comma and the key before a value. */
static void begin_value(koksma__json_writer *w, const char *key)
{
    if (w->comma) {
        append(w, ",", 1);
    }
    if (key) {
        append_quoted(w, key);
        append(w, ":", 1);
    }
    w->comma = true;
}

static void begin(koksma__json_writer *w, const char *key, const char *bracket, char end)
{
    begin_value(w, key);
    append(w, bracket, 1);
    if (w->depth == KOKSMA__JSON_DEPTH) {
        w->status = koksma__fail(KOKSMA_ARGUMENT, "JSON: objects and arrays are nested more than %d deep",
                                 KOKSMA__JSON_DEPTH);
        return;
    }
    w->ends[w->depth++] = end;
    w->comma = false;
}

void koksma__json_begin_object(koksma__json_writer *w, const char *key)
{
    begin(w, key, "{", '}');
}

void koksma__json_begin_array(koksma__json_writer *w, const char *key)
{
    begin(w, key, "[", ']');
}

void koksma__json_end(koksma__json_writer *w)
{
    if (w->depth > 0) {
        append(w, &w->ends[--w->depth], 1);
        w->comma = true;
    }
}

void koksma__json_write_json(koksma__json_writer *w, const char *key, const char *json)
{
    begin_value(w, key);
    append(w, json, strlen(json));
}

void koksma__json_write_text(koksma__json_writer *w, const char *key, const char *text)
{
    begin_value(w, key);
    if (text) {
        append_quoted(w, text);
    } else {
        append(w, "null", 4);
    }
}

void koksma__json_begin_text(koksma__json_writer *w, const char *key)
{
    begin_value(w, key);
    append(w, "\"", 1);
}

void koksma__json_end_text(koksma__json_writer *w)
{
    append(w, "\"", 1);
}

void koksma__json_write_bytes(koksma__json_writer *w, const char *key, const void *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *at = bytes;
    koksma__json_begin_text(w, key);
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const unsigned long word =
            (unsigned long)at[i] << 16 | (left > 1 ? (unsigned long)at[i + 1] << 8 : 0) | (left > 2 ? at[i + 2] : 0);
        const char four[4] = {digits[word >> 18], digits[word >> 12 & 63], left > 1 ? digits[word >> 6 & 63] : '=',
                              left > 2 ? digits[word & 63] : '='};
        append(w, four, 4);
    }
    koksma__json_end_text(w);
}

void koksma__json_write_rounded(koksma__json_writer *w, const char *key, double value, int digits)
{
    char text[40];
    koksma__snprintf(text, sizeof text, isfinite(value) ? "%.*g" : "null", digits, value);
    koksma__json_write_json(w, key, text);
}

void koksma__json_write_number(koksma__json_writer *w, const char *key, double value)
{
    koksma__json_write_rounded(w, key, value, 17);
}

void koksma__json_write_whole(koksma__json_writer *w, const char *key, int64_t value)
{
    char text[24];
    snprintf(text, sizeof text, "%lld", (long long)value);
    koksma__json_write_json(w, key, text);
}

void koksma__json_write_flag(koksma__json_writer *w, const char *key, bool value)
{
    koksma__json_write_json(w, key, value ? "true" : "false");
}

void koksma__json_break(koksma__json_writer *w)
{
    append(w, w->comma ? ",\n" : "\n", w->comma ? 2 : 1);
    w->comma = false;
}

koksma_status koksma__json_line(koksma__json_writer *w, FILE *stream)
{
    append(w, "\n", 1);
    if (!w->status) {
        fwrite(w->text, 1, w->size, stream);
    }
    w->size = 0;
    w->comma = false;
    return w->status;
}

koksma_status koksma__json_finish(koksma__json_writer *w, char **text, size_t *size)
{
    append(w, "", 0);
    const koksma_status status = w->status;
    if (!status) {
        *text = w->text;
        *size = w->size;
        w->text = NULL;
    }
    koksma__json_writer_fini(w);
    return status;
}

void koksma__json_writer_fini(koksma__json_writer *w)
{
    free(w->text);
    *w = (koksma__json_writer){.in_html = w->in_html};
}
