/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The report's document model, written as JSON while it is built: no tree is kept, because blocks are written in the
 * order in which they are shown. A block that is finished before one that is shown above it, such as a table before
 * the sentence that sums it up, is written into a separate document and appended later (koksma__doc_append). What a block
 * has open when the next one begins is closed by the depth of the JSON.
 * docs/report-format.md describes the members, and docs/report.schema.json checks them. Whoever changes the members
 * must change both files and the page.
 *
 * Words are a list of runs; a run is a text, or an object with a style or with the value of a number. A run is
 * extended as long as words of the same style follow. Long because all kinds of blocks share the state of the writer.
 */
#include "study/report/document.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/files.h"
#include "core/status.h"
#include "study/plan/plan.h"
#include "study/report/page_text.h"

void koksma__text_join(char *text, size_t size, const char *between, const char *more)
{
    const size_t used = strlen(text);
    if (used + strlen(between) + strlen(more) + 1 < size) {
        snprintf(text + used, size - used, "%s%s", used ? between : "", more);
    }
}

/* Writes a number with the fewest digits, from 15 to 17, that read back as the same number; null if it is not
   finite. */
static void put_number(koksma__document *d, const char *key, double value)
{
    int digits = 15;
    for (char text[40]; digits < 17; digits++) {
        koksma__snprintf(text, sizeof text, "%.*g", digits, value);
        if (koksma__strtod(text, NULL) == value) {
            break;
        }
    }
    koksma__json_write_rounded(&d->json, key, value, digits);
}

static void put_numbers(koksma__document *d, const char *key, const double *values, size_t n)
{
    koksma__json_begin_array(&d->json, key);
    for (size_t i = 0; i < n; i++) {
        put_number(d, NULL, values[i]);
    }
    koksma__json_end(&d->json);
}

static void put_text(koksma__document *d, const char *key, const char *text)
{
    if (text) {
        koksma__json_write_text(&d->json, key, text);
    }
}

static void put_flag(koksma__document *d, const char *key, bool flag)
{
    if (flag) {
        koksma__json_write_flag(&d->json, key, flag);
    }
}

/* ---- Words ------------------------------------------------------------------------------------------------- */

static void put_style(koksma__document *d)
{
    static const char marks[] = "`*_^";
    static const char *const names[] = {"code", "strong", "em", "sup"};
    put_text(d, "style", d->style ? names[strchr(marks, d->style) - marks] : NULL);
}

static void end_run(koksma__document *d)
{
    if (d->in_text) {
        koksma__json_end_text(&d->json);
        if (d->style) {
            koksma__json_end(&d->json);
        }
    }
    d->in_text = false;
}

static void add_words(koksma__document *d, const char *text)
{
    d->json.in_html = true;
    if (*text && !d->in_text) {
        if (d->style) {
            koksma__json_begin_object(&d->json, NULL);
            put_style(d);
        }
        koksma__json_begin_text(&d->json, d->style ? "text" : NULL);
        d->in_text = true;
    }
    koksma__json_add_text(&d->json, text);
}

static void add_value(koksma__document *d, double value, const char *text)
{
    end_run(d);
    koksma__json_begin_object(&d->json, NULL);
    put_style(d);
    koksma__json_write_text(&d->json, "text", text);
    put_number(d, "value", value);
    koksma__json_end(&d->json);
}

/* Writes the next argument as the conversion after a '%' specifies, such as +.2f, and returns the rest of the format. */
static const char *say_argument(koksma__document *d, const char *at, va_list *arguments)
{
    char text[400];
    const bool sign = *at == '+';
    const char *type = at + strcspn(at, "sfgdu"), *dot = memchr(at, '.', (size_t)(type - at));
    const int precision = dot ? (int)strtol(dot + 1, NULL, 10) : 6;
    if (*type == 's') {
        add_words(d, va_arg(*arguments, const char *));
    } else if (*type == 'f' || *type == 'g') {
        const double value = va_arg(*arguments, double);
        koksma__snprintf(text, sizeof text,
                         *type == 'f' ? sign ? "%+.*f" : "%.*f"
                         : sign       ? "%+.*g"
                                      : "%.*g",
                         precision, value);
        add_value(d, value, text);
    } else {
        const long long value = type[-1] == 'z'   ? (long long)va_arg(*arguments, size_t)
                                : type[-1] == 'l' ? va_arg(*arguments, long long)
                                                  : va_arg(*arguments, int);
        snprintf(text, sizeof text, sign ? "%+lld" : "%lld", value);
        add_value(d, (double)value, text);
    }
    return type + 1;
}

void koksma__doc_say(koksma__document *d, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    for (const char *at = format; *at;) {
        char plain[128];
        const size_t run = strcspn(at, "%`*_^");
        size_t n = run < sizeof plain ? run : sizeof plain - 1;
        /* a text that is too long must not be cut inside a UTF-8 character */
        while (n < run && (at[n] & 0xc0) == 0x80) {
            n--;
        }
        memcpy(plain, at, n);
        plain[n] = '\0';
        add_words(d, plain);
        at += n;
        if (n < run || !*at) {
            continue;
        }
        if (at[0] == '%' && at[1] == '%') {
            add_words(d, "%");
            at += 2;
        } else if (*at == '%') {
            at = say_argument(d, at + 1, &arguments);
        } else {
            end_run(d);
            d->style = d->style == *at ? 0 : *at;
            at++;
        }
    }
    va_end(arguments);
}

/* ---- Blocks ------------------------------------------------------------------------------------------------ */

/* Ends what is open beyond a depth of the JSON. */
static void close_to(koksma__document *d, int depth)
{
    end_run(d);
    d->style = 0;
    while (d->json.depth > depth && !d->json.status) {
        koksma__json_end(&d->json);
    }
}

/* Begins a member of the open block that is a list. */
static void begin_member(koksma__document *d, const char *key)
{
    close_to(d, d->level + 1);
    koksma__json_begin_array(&d->json, key);
}

/* Ends the open block, or the heading of a section, whose content begins. */
static void end_block(koksma__document *d)
{
    if (d->in_columns) { /* a table without rows */
        begin_member(d, "rows");
    } else if (d->in_heading) {
        begin_member(d, "content");
        d->level = d->json.depth;
    }
    d->in_columns = d->in_heading = false;
    close_to(d, d->level);
}

static void begin_block(koksma__document *d, const char *kind, const char *id)
{
    end_block(d);
    d->json.in_html = true;
    koksma__json_break(&d->json);
    koksma__json_begin_object(&d->json, NULL);
    koksma__json_write_text(&d->json, "kind", kind);
    put_text(d, "id", id);
}

/* Begins an item of the list that is a member of the open block. */
static void begin_item(koksma__document *d, bool is_object)
{
    close_to(d, d->level + 2);
    (is_object ? koksma__json_begin_object : koksma__json_begin_array)(&d->json, NULL);
}

static void append(koksma__document *d, koksma__document *part)
{
    if (part->json.status && !d->json.status) {
        d->json.status = part->json.status;
    }
    if (part->json.size && !part->json.status) {
        koksma__json_write_json(&d->json, NULL, part->json.text);
    }
    koksma__json_writer_fini(&part->json);
}

void koksma__doc_say_words(koksma__document *d, koksma__document *words)
{
    end_run(words);
    end_run(d);
    append(d, words);
}

void koksma__doc_append(koksma__document *d, koksma__document *part)
{
    end_block(part);
    end_block(d);
    append(d, part);
}

bool koksma__doc_is_empty(const koksma__document *d)
{
    return !d->json.size && !d->json.status;
}

void koksma__doc_head(koksma__document *d, const char *format, const char *title, const char *about, const char *plan)
{
    d->json.in_html = true;
    koksma__json_begin_object(&d->json, NULL);
    koksma__json_write_text(&d->json, "format", format);
    koksma__json_write_whole(&d->json, "version", 1);
    koksma__json_write_text(&d->json, "title", title);
    koksma__json_write_text(&d->json, "about", about);
    put_text(d, "plan", plan);
    koksma__json_write_text(&d->json, "koksma", koksma_version());
}

void koksma__doc_content(koksma__document *d)
{
    koksma__json_begin_array(&d->json, "content");
    d->level = d->json.depth;
}

void koksma__doc_close(koksma__document *d)
{
    end_block(d);
    if (d->level) {
        koksma__json_end(&d->json);
    }
}

void koksma__doc_begin_section(koksma__document *d, const char *id, bool collapsed)
{
    begin_block(d, "section", id);
    put_flag(d, "collapsed", collapsed);
    koksma__json_begin_array(&d->json, "heading");
    d->in_heading = true;
}

void koksma__doc_end(koksma__document *d)
{
    end_block(d);
    d->level -= 2;
    close_to(d, d->level);
}

void koksma__doc_begin(koksma__document *d, koksma__words_kind kind)
{
    static const char *const answers[] = {[KOKSMA__ANSWER_UNDECIDED] = "undecided",
                                          [KOKSMA__ANSWER_DECIDED] = "decided",
                                          [KOKSMA__ANSWER_HOLDS] = "holds",
                                          [KOKSMA__ANSWER_PARTLY] = "partly",
                                          [KOKSMA__ANSWER_FAILS] = "fails"};
    if (kind == KOKSMA__ITEM) {
        begin_item(d, false);
    } else if (kind == KOKSMA__CAPTION) {
        begin_member(d, "caption");
    } else {
        begin_block(d, "paragraph", NULL);
        put_text(d, "answer", kind <= KOKSMA__ANSWER_FAILS ? answers[kind] : NULL);
        put_flag(d, "warning", kind == KOKSMA__WARNING);
        koksma__json_begin_array(&d->json, "text");
    }
}

void koksma__doc_list(koksma__document *d, const char *id, bool numbered)
{
    begin_block(d, "list", id);
    koksma__json_write_flag(&d->json, "numbered", numbered);
    koksma__json_begin_array(&d->json, "items");
}

void koksma__doc_commands(koksma__document *d)
{
    begin_block(d, "commands", NULL);
    koksma__json_begin_array(&d->json, "lines");
}

void koksma__doc_command(koksma__document *d, const char *format, ...)
{
    char line[2 * KOKSMA__DOC_COMMAND];
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    koksma__json_write_text(&d->json, NULL, line);
}

/* ---- Tables ------------------------------------------------------------------------------------------------ */

void koksma__doc_table(koksma__document *d, const char *format, ...)
{
    char name[256];
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    begin_block(d, "table", NULL);
    koksma__json_write_text(&d->json, "name", name);
}

void koksma__doc_sort(koksma__document *d, const char *column, bool descending)
{
    koksma__json_begin_object(&d->json, "sort");
    koksma__json_write_text(&d->json, "column", column);
    put_flag(d, "descending", descending);
    koksma__json_end(&d->json);
}

/* Writes one of the heads of a column, which ends at '#' or ';', and returns the rest. */
static const char *put_head(koksma__document *d, const char *key, const char *at, va_list *arguments)
{
    char text[2 * KOKSMA_MAX_SPEC + 256] = "";
    const char *end = at + strcspn(at, "#;");
    if (end - at == 2 && !strncmp(at, "%s", 2)) {
        put_text(d, key, va_arg(*arguments, const char *));
        return end;
    }
    for (size_t used = 0; at < end && used < sizeof text; used = strlen(text)) {
        const size_t plain = strcspn(at, "%#;"), number = plain ? 0 : strspn(at, "%l");
        snprintf(text + used, sizeof text - used, "%.*s", (int)plain, at);
        at += plain;
        if (number == 3) {
            snprintf(text + used, sizeof text - used, "%lld", va_arg(*arguments, long long));
        } else if (!plain) {
            snprintf(text + used, sizeof text - used, "%s", number == 2 ? "%" : va_arg(*arguments, const char *));
        }
        at += plain ? 0 : number == 2 ? 2 : number + 1;
    }
    put_text(d, key, text[0] ? text : NULL);
    return end;
}

void koksma__doc_columns(koksma__document *d, const char *columns, ...)
{
    static const char letters[] = "tnisv";
    static const char *const types[] = {"text", "number", "interval", "spread", "verdict"};
    va_list arguments;
    va_start(arguments, columns);
    if (!d->in_columns) {
        koksma__json_begin_array(&d->json, "columns");
        d->in_columns = true;
    }
    for (const char *at = columns; *at; at += *at == ';') {
        const char *name = strchr(at, ' ') + 1, *type = strchr(letters, *at);
        const int digits = at[1] >= '1' && at[1] <= '9' ? at[1] - '0' : 0;
        const size_t n = (size_t)(name - at);
        const bool fixed = memchr(at, 'f', n), hidden = memchr(at, 'h', n), merged = memchr(at, 'm', n);
        koksma__json_begin_object(&d->json, NULL);
        at = put_head(d, "name", name, &arguments);
        koksma__json_write_text(&d->json, "type", types[type - letters]);
        at = *at == '#' ? put_head(d, "title", at + 1, &arguments) : at;
        at = *at == '#' ? put_head(d, "group", at + 1, &arguments) : at;
        if (digits) {
            put_number(d, fixed ? "decimals" : "digits", digits);
        }
        put_flag(d, "hidden", hidden);
        put_flag(d, "merged", merged);
        koksma__json_end(&d->json);
    }
    va_end(arguments);
}

void koksma__doc_begin_row(koksma__document *d)
{
    if (d->in_columns) {
        begin_member(d, "rows");
        d->in_columns = false;
    }
    begin_item(d, false);
}

void koksma__doc_cells(koksma__document *d, const char *types, ...)
{
    va_list arguments;
    va_start(arguments, types);
    for (; *types; types++) {
        if (*types == 't') {
            koksma__json_write_text(&d->json, NULL, va_arg(arguments, const char *));
        } else if (*types == 'i') {
            const koksma__estimate e = va_arg(arguments, koksma__estimate);
            put_numbers(d, NULL, (const double[]){e.value, e.low, e.high}, 3);
        } else {
            put_number(d, NULL,
                       *types == 'n'   ? va_arg(arguments, double)
                       : *types == 'z' ? (double)va_arg(arguments, size_t)
                                       : (double)va_arg(arguments, long long));
        }
    }
    va_end(arguments);
}

koksma__cell_data koksma__cell_of(double value)
{
    return (koksma__cell_data){.value = value, .low = NAN, .high = NAN, .sd = NAN, .z = NAN, .change = NAN};
}

static void put_known(koksma__document *d, const char *key, double value)
{
    if (!isnan(value)) {
        put_number(d, key, value);
    }
}

void koksma__doc_cell(koksma__document *d, const koksma__cell_data *c)
{
    koksma__json_begin_object(&d->json, NULL);
    put_known(d, "value", c->value);
    put_known(d, "low", c->low);
    put_known(d, "high", c->high);
    put_known(d, "sd", c->sd);
    put_known(d, "z", c->z);
    put_known(d, "change", c->change);
    put_known(d, "sets", c->sets ? (double)c->sets : (double)NAN);
    put_known(d, "note", c->note ? (double)c->note : (double)NAN);
    put_text(d, "text", c->text);
    put_text(d, "verdict", c->verdict);
    koksma__json_end(&d->json);
}

/* ---- Charts ------------------------------------------------------------------------------------------------ */

static void put_axis(koksma__document *d, const char *key, const char *title, bool is_log, int better)
{
    koksma__json_begin_object(&d->json, key);
    koksma__json_write_text(&d->json, "title", title);
    koksma__json_write_flag(&d->json, "log", is_log);
    if (better) {
        koksma__json_write_text(&d->json, "better", better > 0 ? "larger" : "smaller");
    }
    koksma__json_end(&d->json);
}

void koksma__doc_chart(koksma__document *d, const koksma__chart *c)
{
    begin_block(d, "chart", NULL);
    koksma__json_write_text(&d->json, "title", c->title);
    put_axis(d, "x", c->x_title, c->log_x, 0);
    put_axis(d, "y", c->y_title, c->log_y, c->better);
    koksma__json_begin_array(&d->json, "series");
    memset(d->curves, 0, sizeof d->curves);
}

void koksma__doc_series(koksma__document *d, const char *label, const char *pattern, koksma__series_style style)
{
    static const char *const styles[] = {[KOKSMA__SERIES_LINE] = "line",
                                         [KOKSMA__SERIES_MARKS] = "marks",
                                         [KOKSMA__SERIES_THEORY] = "theory",
                                         [KOKSMA__SERIES_HOLLOW] = "hollow"};
    const char *of = pattern ? pattern : label;
    begin_item(d, true);
    koksma__json_write_text(&d->json, "label", label);
    koksma__json_write_text(&d->json, "style", styles[style]);
    if (style == KOKSMA__SERIES_LINE || style == KOKSMA__SERIES_MARKS) {
        size_t colour = koksma__colour_of(of), least = 0;
        for (size_t c = 1; c < KOKSMA__COLOURS; c++) {
            least = d->curves[c] < d->curves[least] ? c : least;
        }
        colour = colour < KOKSMA__COLOURS ? colour : least;
        d->curves[colour]++;
        koksma__json_write_whole(&d->json, "colour", (long long)colour);
    }
    koksma__json_begin_array(&d->json, "points");
}

void koksma__doc_point(koksma__document *d, double x, double y, double low, double high)
{
    koksma__json_begin_array(&d->json, NULL);
    put_number(d, NULL, x);
    put_number(d, NULL, y);
    if (low < high) {
        put_number(d, NULL, low);
        put_number(d, NULL, high);
    }
    koksma__json_end(&d->json);
}

/* ---- Figures and pictures ---------------------------------------------------------------------------------- */

void koksma__doc_figure(koksma__document *d, const char *id)
{
    begin_block(d, "figure", id);
    koksma__json_begin_array(&d->json, "images");
}

/* Begins an image or drawing with the members that both have. */
static void begin_image(koksma__document *d, const char *type, int width, int height, const char *alt)
{
    begin_item(d, true);
    put_text(d, "type", type);
    put_number(d, "width", width);
    put_number(d, "height", height);
    put_text(d, "alt", alt);
}

void koksma__doc_svg(koksma__document *d, const unsigned char *svg, size_t size, int width, const char *alt)
{
    begin_image(d, "image/svg+xml", width, width, alt);
    koksma__json_write_bytes(&d->json, "data", svg, size);
}

koksma_status koksma__doc_image(koksma__document *d, const koksma_image *image, int scale, const char *alt)
{
    unsigned char *bytes;
    size_t size;
    KOKSMA__TRY(koksma_image_png_bytes(image, &bytes, &size));
    begin_image(d, "image/png", image->width * scale, image->height * scale, alt);
    koksma__json_write_bytes(&d->json, "data", bytes, size);
    free(bytes);
    return KOKSMA_OK;
}

void koksma__doc_drawing(koksma__document *d, int width, const double view[4], const char *alt)
{
    begin_image(d, "drawing", width, width, alt);
    put_numbers(d, "view", view, 4);
    koksma__json_begin_array(&d->json, "shapes");
}

void koksma__doc_line(koksma__document *d, double x0, double y0, double x1, double y1)
{
    put_numbers(d, NULL, (const double[]){x0, y0, x1, y1}, 4);
}

void koksma__doc_dot(koksma__document *d, double x, double y)
{
    put_numbers(d, NULL, (const double[]){x, y}, 2);
}

void koksma__doc_pictures(koksma__document *d, const char *scene, int width, int height)
{
    begin_block(d, "pictures", NULL);
    koksma__json_write_text(&d->json, "scene", scene);
    put_number(d, "width", width);
    put_number(d, "height", height);
    koksma__json_begin_array(&d->json, "images");
}

void koksma__doc_picture(koksma__document *d, const koksma_image *image, const char *name)
{
    const size_t n = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    unsigned char *bytes = malloc(4 * n);
    if (!bytes && !d->json.status) {
        d->json.status = koksma__fail_memory(4 * n);
    }
    for (size_t i = 0; bytes && i < n; i++) {
        uint32_t bits;
        memcpy(&bits, &image->pixels[i], sizeof bits);
        for (int k = 0; k < 4; k++) {
            bytes[4 * i + (size_t)k] = (unsigned char)(bits >> 8 * k);
        }
    }
    begin_item(d, true);
    koksma__json_write_text(&d->json, "name", name);
    put_number(d, "channels", image->channels);
    koksma__json_write_bytes(&d->json, "pixels", bytes, bytes ? 4 * n : 0);
    free(bytes);
}

/* ---- The page ---------------------------------------------------------------------------------------------- */

/* Joins a path of `size` characters, if it is absolute. */
static void join_path(char folder[KOKSMA__FOLDER], const char *path, size_t size)
{
    size_t same = 0;
    while (size && path[size - 1] != '/') {
        size--;
    }
    if (*path != '/' || size >= KOKSMA__FOLDER) {
        return;
    }
    if (!*folder) {
        snprintf(folder, KOKSMA__FOLDER, "%.*s", (int)size, path);
    }
    while (same < size && folder[same] == path[same]) {
        same++;
    }
    while (folder[same - 1] != '/') { /* both begin with one */
        same--;
    }
    folder[same] = '\0';
}

void koksma__folder_join(char folder[KOKSMA__FOLDER], const char *text)
{
    if (*text == '/') {
        join_path(folder, text, strlen(text));
        return;
    }
    for (size_t at = 0; (at = koksma__plan_path(text, at)) > 0;) {
        join_path(folder, text + at, strcspn(text + at, ";,"));
    }
}

void koksma__doc_hide_folder(koksma__document *d, const char folder[KOKSMA__FOLDER])
{
    koksma__json_writer w = {.in_html = d->json.in_html};
    if (strlen(folder) < 2 || !d->json.text) {
        return;
    }
    koksma__json_write_text(&w, NULL, folder); /* as the texts have it, without its quotes */
    const size_t length = w.status ? 0 : w.size - 2;
    char *to = d->json.text;
    for (const char *from = to; length && *from;) {
        if (!strncmp(from, w.text + 1, length)) {
            from += length;
        } else {
            *to++ = *from++;
        }
    }
    if (length) {
        *to = '\0';
        d->json.size = (size_t)(to - d->json.text);
    }
    koksma__json_writer_fini(&w);
}

void koksma__page_style(FILE *f)
{
    static const char end[] = "</style>\n";
    const char *style = strstr(koksma__page_head, "<style>");
    fwrite(style, 1, (size_t)(strstr(style, end) - style) + sizeof end - 1, f);
}

char *koksma__page_text(const char *json)
{
    const size_t size = strlen(json) + sizeof koksma__page_head + sizeof koksma__page_foot;
    char *text = malloc(size);
    if (text) {
        snprintf(text, size, "%s%s%s", koksma__page_head, json, koksma__page_foot);
    }
    return text;
}

static koksma_status put_file(const char *folder, const char *name, const char *head, const char *json,
                              const char *foot)
{
    koksma__atomic_file file;
    KOKSMA__TRY(koksma__atomic_open(folder, name, &file));
    fputs(head, file.stream);
    fputs(json, file.stream);
    fputs(foot, file.stream);
    return koksma__atomic_close(&file, true);
}

koksma_status koksma__page_write(const char *folder, const char *json)
{
    KOKSMA__TRY(put_file(folder, "report.json", "", json, "\n"));
    return put_file(folder, "report.html", koksma__page_head, json, koksma__page_foot);
}
