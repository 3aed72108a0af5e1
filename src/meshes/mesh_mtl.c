/* SPDX-License-Identifier: Apache-2.0 */
/* OBJ's material files before assimp reads them: text of lines of a sane length, and colours that are finite. What it
   gets has neither a byte order mark nor blanks before keywords, and colours with all three numbers: it would take a
   missing one for 0, where the format repeats the first.
   Format: Wavefront's "Advanced Visualizer Manual", section 2.3. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "meshes/mesh_file.h"

enum { MAX_NAME = 1000 /* assimp's strings end at 1024 */ };

typedef struct mtl {
    const char *path;
    size_t number; /* of the line */
    koksma__bytes *out;
    char line[MAX_NAME + 1];
} mtl;

static koksma_status wrong(const mtl *m, const char *reason)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: %s", m->path, m->number, reason);
}

static koksma_status put(mtl *m, const char *text, size_t length)
{
    return koksma__bytes_put(m->out, m->out->size, text, length) && koksma__bytes_put(m->out, m->out->size, "\n", 1)
               ? KOKSMA_OK
               : koksma__fail_memory(m->out->size);
}

/* "Kd" or "Ke": one to three numbers; the missing ones are as the first. */
static koksma_status take_colour(mtl *m, const char *word)
{
    char line[3 * 64 + 8];
    const char *parts[3];
    int lengths[3], n = 0;
    const char *text = word + 2 + strspn(word + 2, " \t");
    for (; n < 3 && *text && *text != '#'; n++) {
        char *stop;
        const double value = koksma__strtod(text, &stop);
        const size_t length = strspn(text, "0123456789+-.eE");
        if (!length || length > 60 || stop != text + length || !strchr(" \t", *stop) || !(fabs(value) < 1e38)) {
            return wrong(m, "a colour is one to three numbers below 1e38");
        }
        parts[n] = text;
        lengths[n] = (int)length;
        text = stop + strspn(stop, " \t");
    }
    if (!n) {
        return wrong(m, "a colour is one to three numbers below 1e38");
    }
    for (; n < 3; n++) {
        parts[n] = parts[0];
        lengths[n] = lengths[0];
    }
    const int length = snprintf(line, sizeof line, "%.2s %.*s %.*s %.*s", word, lengths[0], parts[0], lengths[1],
                                parts[1], lengths[2], parts[2]);
    return put(m, line, (size_t)length);
}

static koksma_status take_line(mtl *m, const unsigned char *at, size_t length)
{
    if (length > MAX_NAME || memchr(at, '\0', length)) {
        return wrong(m, length > MAX_NAME ? "longer than 1000 characters" : "not text (a zero byte)");
    }
    memcpy(m->line, at, length);
    while (length && strchr(" \t\r", m->line[length - 1])) {
        length--;
    }
    m->line[length] = '\0';
    const char *word = m->line + strspn(m->line, " \t");
    if (*word == 'K' && (word[1] == 'd' || word[1] == 'e') && (word[2] == ' ' || word[2] == '\t' || !word[2])) {
        return take_colour(m, word);
    }
    return *word && *word != '#' ? put(m, word, strlen(word)) : KOKSMA_OK;
}

koksma_status koksma__mtl_clean(const char *path, const unsigned char *file, size_t size, koksma__bytes *out)
{
    mtl m = {.path = path, .out = out};
    koksma_status status = KOKSMA_OK;
    for (size_t at = koksma__byte_order_mark(file, size); !status && at < size;) {
        const unsigned char *stop = memchr(file + at, '\n', size - at);
        const size_t length = stop ? (size_t)(stop - file) - at : size - at;
        m.number++;
        status = take_line(&m, file + at, length);
        at += length + 1;
    }
    return status;
}
