/* SPDX-License-Identifier: Apache-2.0 */
/* OBJ files before assimp reads them: numbers must be numbers, and corners name vertices that are there. assimp
   passes by lines that begin with blanks, counts no number that begins with a point, and stumbles over comments at
   the ends of lines and a byte order mark; so it gets neither these, nor lines of keywords that nothing here is made
   of. Formats: Wavefront's "Advanced Visualizer Manual", appendix B1 (OBJ) and 2.3 (MTL). */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "meshes/mesh_file.h"
#include "meshes/mesh_obj_names.h"

enum { MAX_LINE = 1 << 15, MAX_NAME = 1000 /* assimp's strings end at 1024 */ };

/* Kinds of numbers that corners name, in their order there. */
enum { PLACE, TEXTURE, NORMAL, KINDS };

typedef struct obj {
    const char *path;
    const unsigned char *at, *end;
    size_t number;         /* of the line that was read last */
    size_t count[KINDS];   /* so far */
    size_t highest[KINDS]; /* that was named, counted from 1 */
    size_t line_of[KINDS]; /* that names it first */
    koksma__obj_names names;
    koksma__unread *unread;
    koksma__bytes *out;
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

static koksma_status take_vertex(obj *o, int kind, const char *text, int *count)
{
    const int n = *count = take_numbers(text, 7);
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
    if (!back && value > o->highest[kind]) {
        o->highest[kind] = value;
        o->line_of[kind] = o->number;
    }
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

static bool put(obj *o, const char *text, size_t length)
{
    return koksma__bytes_put(o->out, o->out->size, text, length);
}

/* The word and the numbers or corners after it, with a 0 before a point that would be first, and n more zeros. */
static koksma_status put_numbers(obj *o, const char *word, size_t length, int zeros)
{
    bool good = put(o, word, length);
    for (const char *text = skip_blanks(word + length); good && *text && *text != '#'; text = skip_blanks(text)) {
        const size_t digits = strcspn(text, " \t");
        good = put(o, " 0", *text == '.' ? 2 : 1) && put(o, text, digits);
        text += digits;
    }
    for (; good && zeros > 0; zeros--) {
        good = put(o, " 0", 2);
    }
    return good && put(o, "\n", 1) ? KOKSMA_OK : koksma__fail_memory(o->out->size);
}

/* "usemtl": names have blanks, but none at their ends. The first name that nobody makes is found in a second pass. */
static koksma_status take_name(obj *o, const char *word, const char *rest)
{
    if (!strncmp(word, "mtllib", 6)) {
        return *rest ? koksma__obj_take_libraries(o->path, rest, &o->names, o->unread, o->out) : KOKSMA_OK;
    }
    return koksma__obj_put_name("", word, strlen(word), o->out);
}

static void cut_blanks(char *text)
{
    size_t length = strlen(text);
    while (length && (text[length - 1] == ' ' || text[length - 1] == '\t' || text[length - 1] == '\r')) {
        text[--length] = '\0';
    }
}

static koksma_status take_line(obj *o)
{
    cut_blanks(o->line);
    const char *word = skip_blanks(o->line), *rest = word + strcspn(word, " \t");
    const size_t length = (size_t)(rest - word);
    static const char *const vertices[KINDS] = {[PLACE] = "v", [TEXTURE] = "vt", [NORMAL] = "vn"}, *const names[] = {
                                                                                                       "mtllib",
                                                                                                       "usemtl", "o",
                                                                                                       "g", "s"};
    for (int kind = 0; kind < KINDS; kind++) {
        if (length == strlen(vertices[kind]) && !memcmp(word, vertices[kind], length)) {
            int n = 0;
            const koksma_status status = take_vertex(o, kind, rest, &n);
            return status ? status : put_numbers(o, word, length, kind == TEXTURE && n == 1);
        }
    }
    if (length == 1 && strchr("flp", *word)) {
        const koksma_status status = take_corners(o, rest);
        return status ? status : put_numbers(o, word, length, 0);
    }
    if (*word != '#' && strlen(word) > MAX_NAME) {
        return wrong(o, "longer than 1000 characters");
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (length == strlen(names[i]) && !memcmp(word, names[i], length)) {
            return take_name(o, word, skip_blanks(rest));
        }
    }
    return KOKSMA_OK;
}

/* The materials that are used and that nobody makes, by the lines that assimp gets. */
static void note_unmade(obj *o)
{
    const unsigned char *at = o->out->data, *end = at + o->out->size;
    if (o->names.made.n >= KOKSMA__OBJ_NAMES / 2) {
        return; /* some were not noted */
    }
    while (at < end) {
        const unsigned char *stop = memchr(at, '\n', (size_t)(end - at)); /* ours all end so */
        if (stop - at > 7 && !memcmp(at, "usemtl", 6)) {
            const char *name = (const char *)at + 6;
            while (*name == ' ' || *name == '\t') {
                name++;
            }
            const size_t length = (size_t)((const char *)stop - name);
            const bool first = koksma__obj_set_add(&o->names.used, name, length);
            if (first && !koksma__obj_set_has(&o->names.made, name, length) && !o->unread->materials++) {
                snprintf(o->unread->material, sizeof o->unread->material, "%.*s", (int)length, name);
            }
        }
        at = stop + 1;
    }
}

koksma_status koksma__obj_clean(const char *path, const unsigned char *file, size_t size, koksma__unread *unread,
                                koksma__bytes *out)
{
    static const char *const names[KINDS] = {[PLACE] = "vertex", [TEXTURE] = "texture vertex", [NORMAL] = "normal"};
    koksma_status status = KOKSMA_OK;
    obj *o = calloc(1, sizeof *o);
    if (!o) {
        return koksma__fail_memory(sizeof *o);
    }
    const size_t mark = koksma__byte_order_mark(file, size);
    o->path = path;
    o->at = file + mark;
    o->end = file + size;
    o->unread = unread;
    o->out = out;
    static const char first[] = "# as assimp reads it\n"; /* of less than 16 bytes it says that they are too few */
    status = put(o, first, strlen(first)) ? KOKSMA_OK : koksma__fail_memory(sizeof first);
    while (!status && o->at < o->end) {
        status = next_line(o);
        status = status ? status : take_line(o);
    }
    for (int kind = 0; !status && kind < KINDS; kind++) {
        if (o->highest[kind] > o->count[kind]) {
            status = koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: a corner names %s %zu; there are %zu", path,
                                  o->line_of[kind], names[kind], o->highest[kind], o->count[kind]);
        }
    }
    if (!status) {
        note_unmade(o);
    }
    free(o);
    return status;
}
