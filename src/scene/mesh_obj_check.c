/* SPDX-License-Identifier: Apache-2.0 */
/* Whether an OBJ file is one, before assimp reads it: numbers that are numbers, and corners that name vertices which
   are there. Lines of other keywords are left to assimp, but must be text of a sane length; so must be those of the
   material files that it names.
   Formats: Wavefront's "Advanced Visualizer Manual", appendix B1 (OBJ) and 2.3 (MTL). */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "scene/mesh.h"

enum { MAX_LINE = 1 << 15, MAX_NAME = 1000 /* assimp's strings end at 1024 */ };

/* Kinds of numbers that corners name, in their order there. */
enum { PLACE, TEXTURE, NORMAL, KINDS };

typedef struct obj {
    const char *path;
    const unsigned char *at, *end;
    size_t number;         /* of the line that was read last */
    size_t count[KINDS];   /* so far */
    size_t highest[KINDS]; /* that was named, counted from 1 */
    char line[MAX_LINE];
} obj;

static koksma_status wrong(const obj *o, const char *reason)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: %s", o->path, o->number, reason);
}

/* The next line without its end; one that ends in a backslash goes on in the next. */
static koksma_status next_line(obj *o)
{
    size_t length = 0;
    bool goes_on = true;
    while (goes_on && o->at < o->end) {
        const unsigned char *stop = memchr(o->at, '\n', (size_t)(o->end - o->at));
        const size_t more = (size_t)((stop ? stop : o->end) - o->at);
        o->number++;
        if (more >= MAX_LINE - length) {
            return wrong(o, "longer than 32767 characters");
        }
        if (memchr(o->at, '\0', more)) {
            return wrong(o, "not text (a zero byte)");
        }
        memcpy(o->line + length, o->at, more);
        length += more;
        o->at = stop ? stop + 1 : o->end;
        length -= length && o->line[length - 1] == '\r';
        goes_on = length && o->line[length - 1] == '\\';
        if (goes_on) {
            o->line[length - 1] = ' ';
        }
    }
    o->line[length] = '\0';
    return goes_on && length ? wrong(o, "the last line ends in a backslash") : KOKSMA_OK;
}

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t");
}

/* Finite numbers up to the end of the line, or of what `most` of them take; their number, or -1 where one is none. */
static int take_numbers(const char *text, int most)
{
    int n = 0;
    for (text = skip_blanks(text); *text && *text != '#' && n < most; text = skip_blanks(text), n++) {
        const size_t length = strspn(text, "0123456789+-.eE");
        char *stop;
        const double value = koksma__strtod(text, &stop);
        if (!length || stop != text + length || (*stop && *stop != ' ' && *stop != '\t') || !(fabs(value) < 1e38)) {
            return -1;
        }
        text = stop;
    }
    return *text && *text != '#' ? -1 : n;
}

static koksma_status take_vertex(obj *o, int kind, const char *text)
{
    const int n = take_numbers(text, 7);
    o->count[kind]++;
    if (kind == PLACE && n != 3 && n != 4 && n != 6 && n != 7) {
        return wrong(o, "a vertex is three finite numbers, and maybe a weight and a colour");
    }
    if (kind == TEXTURE && (n < 1 || n > 3)) {
        return wrong(o, "a texture vertex is one to three finite numbers");
    }
    return kind == NORMAL && n != 3 ? wrong(o, "a normal is three finite numbers") : KOKSMA_OK;
}

/* One number of a corner: from 1 on, or from -1 backwards. */
static bool take_index(obj *o, int kind, const char **text)
{
    const bool back = **text == '-';
    const char *digits = *text + back;
    size_t value = 0;
    if (!isdigit((unsigned char)*digits)) {
        return false;
    }
    for (; isdigit((unsigned char)*digits) && value < KOKSMA__MAX_VERTICES; digits++) {
        value = 10 * value + (size_t)(*digits - '0');
    }
    *text = digits;
    o->highest[kind] = !back && value > o->highest[kind] ? value : o->highest[kind];
    return value && value < KOKSMA__MAX_VERTICES && (!back || value <= o->count[kind]);
}

/* One corner: v, v/t, v//n or v/t/n, some write v/ or v//; the kinds that it names as bits, or 0 where it is none. */
static int take_corner(obj *o, const char **text)
{
    int kinds = 0;
    for (int kind = PLACE; kind < KINDS; kind++) {
        const bool idle = kind != PLACE && strchr("/ \t", **text); /* a blank, or the end */
        if (!idle && !take_index(o, kind, text)) {
            return 0;
        }
        kinds |= idle ? 0 : 1 << kind;
        if (**text != '/') {
            break;
        }
        ++*text;
    }
    return strchr(" \t", **text) ? kinds : 0;
}

/* Corners of a face, line or point, all alike. */
static koksma_status take_corners(obj *o, const char *text)
{
    int corners = 0, first = 0;
    for (text = skip_blanks(text); *text && *text != '#'; text = skip_blanks(text), corners++) {
        const int kinds = take_corner(o, &text);
        if (!kinds) {
            return wrong(o, "a corner is v, v/t, v//n or v/t/n, numbers of vertices that are there");
        }
        first = corners ? first : kinds;
        if (kinds != first) {
            return wrong(o, "some corners have a texture vertex or a normal, others have none");
        }
    }
    return corners ? KOKSMA_OK : wrong(o, "a face, line or point without a corner");
}

static koksma_status take_line(obj *o)
{
    const char *word = skip_blanks(o->line), *rest = word + strcspn(word, " \t");
    const size_t length = (size_t)(rest - word);
    static const struct {
        const char *word;
        int kind;
    } vertices[] = {{"v", PLACE}, {"vt", TEXTURE}, {"vn", NORMAL}};
    for (size_t i = 0; i < KINDS; i++) {
        if (length == strlen(vertices[i].word) && !memcmp(word, vertices[i].word, length)) {
            return take_vertex(o, vertices[i].kind, rest);
        }
    }
    if (length == 1 && strchr("flp", *word)) {
        return take_corners(o, rest);
    }
    return *word != '#' && strlen(word) > MAX_NAME ? wrong(o, "longer than 1000 characters") : KOKSMA_OK;
}

koksma_status koksma__obj_check(const char *path, const unsigned char *file, size_t size)
{
    static const char *const names[] = {"vertex", "texture vertex", "normal"};
    koksma_status status = KOKSMA_OK;
    obj *o = malloc(sizeof *o);
    if (!o) {
        return koksma__fail_memory(sizeof *o);
    }
    *o = (obj){.path = path, .at = file, .end = file + size};
    while (!status && o->at < o->end) {
        status = next_line(o);
        status = status ? status : take_line(o);
    }
    for (int kind = 0; !status && kind < KINDS; kind++) {
        if (o->highest[kind] > o->count[kind]) {
            status = koksma__fail(KOKSMA_MALFORMED, "%s: a corner names %s %zu; there are %zu", path, names[kind],
                                  o->highest[kind], o->count[kind]);
        }
    }
    free(o);
    return status;
}

koksma_status koksma__mtl_check(const char *path, const unsigned char *file, size_t size)
{
    size_t number = 1, length = 0;
    for (size_t i = 0; i < size; i++) {
        length = file[i] == '\n' ? 0 : length + 1;
        if (!file[i] || length > MAX_NAME) {
            return koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: %s", path, number,
                                file[i] ? "longer than 1000 characters" : "not text (a zero byte)");
        }
        number += file[i] == '\n';
    }
    return KOKSMA_OK;
}
