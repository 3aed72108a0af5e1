/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writes the pages of the atlas from the rows of its commands: index.html, a page for each question, in the style of the
 * reports, without scripts. A page has the answer, a sentence with values of rows in it, then each command with its tables
 * and its picture. What a question shows is data (studies/README.md):
 *
 *     value     {ID|KEY=TEXT|..|least=KEY|KEY [LOW HIGH [%]]}: KEY of the one row of command ID where the others hold, with
 *               its interval; least and most: the row where KEY is the least or the largest
 *     list      {ID|KEY=TEXT|..|list=KEY}: KEY of all rows that fit; several are "not told apart"
 *     column    "KEY [LOW HIGH [%]]", "HEAD: KEY [LOW HIGH [%]]", or "HEAD: `text with {KEY}`"
 *
 * Numbers are shown with four digits, whole numbers with all, those with an interval with two digits of its width; the
 * element's title has all digits. A document that the text names is a link to a copy of it in docs/.
 */
#include "study/atlas/atlas.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/files.h"

enum { MAX_COLUMNS = 24, MAX_TABLES = 16, MAX_ROWS = 100000, MAX_PARTS = 8, TEXT = 512 };

typedef struct page {
    FILE *f;
    const koksma__atlas *atlas;
    const koksma__atlas_page *of;
    koksma__json *rows[KOKSMA__ATLAS_PAGE_JOBS]; /* of each job */
} page;

/* ---- Values ---------------------------------------------------------------------------------------------------- */

/* A member of a row as it is shown, and with all digits; "-" for null. number: NaN of what is no number. */
typedef struct value {
    char text[TEXT], full[TEXT];
    double number;
} value;

static koksma_status read_value(const koksma__json_node *row, const char *key, value *v)
{
    koksma__json_node node;
    const char *word;
    bool flag;
    v->number = NAN;
    KOKSMA__TRY(koksma__json_member(row, key, &node));
    if (koksma__json_is_text(&node)) {
        KOKSMA__TRY(koksma__json_text(&node, &word));
        snprintf(v->text, TEXT, "%s", word);
    } else if (!koksma__json_number(&node, -INFINITY, INFINITY, &v->number)) {
        const bool whole = v->number == floor(v->number) && fabs(v->number) < 1e15;
        koksma__snprintf(v->text, TEXT, whole ? "%.0f" : "%.4g", v->number);
        koksma__snprintf(v->full, TEXT, "%.17g", v->number);
        return KOKSMA_OK;
    } else {
        snprintf(v->text, TEXT, "%s", koksma__json_flag(&node, &flag) ? "-" : flag ? "yes" : "no");
    }
    memcpy(v->full, v->text, TEXT);
    return KOKSMA_OK;
}

/* Writes a number and the ends of its interval with as many decimals as give the interval's width two digits. */
static void print_interval(value v[3])
{
    const double width = v[2].number - v[1].number, largest = fmax(fabs(v[1].number), fabs(v[2].number));
    if (!(width > 0 && isfinite(width))) {
        return;
    }
    const int last = (int)floor(koksma__log10(width)) - 1, first = (int)floor(koksma__log10(largest));
    for (int i = 0; i < 3; i++) {
        char *text = v[i].text;
        koksma__snprintf(text, TEXT, first < -3 ? "%.*e" : "%.*f",
                         first < -3 ? first - last
                         : last < 0 ? -last
                                    : 0,
                         v[i].number);
        if (text[0] == '-' && !text[strspn(text, "-0.")]) {
            memmove(text, text + 1, strlen(text)); /* no -0 */
        }
    }
}

/* Writes "KEY [LOW HIGH [%]]" of a row. */
static koksma_status put_value(FILE *f, const koksma__json_node *row, const char *keys)
{
    char key[3][64], percent[2] = "";
    value v[3] = {{.number = NAN}, {.number = NAN}, {.number = NAN}};
    const int read = sscanf(keys, "%63s %63s %63s %1[%]", key[0], key[1], key[2], percent), n = read < 3 ? read : 3;
    KOKSMA__JSON_FAIL_IF(n != 1 && n != 3, row, "'%s' is not 'KEY' or 'KEY LOW HIGH'", keys);
    for (int i = 0; i < n; i++) {
        KOKSMA__TRY(read_value(row, key[i], &v[i]));
        v[i].number *= *percent ? 100 : 1;
    }
    print_interval(v);
    koksma__atlas_print(f, isnan(v[0].number) ? "%s" : "<data value=\"%s\" title=\"%s\">%s</data>%s",
                        isnan(v[0].number) ? v[0].text : v[0].full, v[0].full, v[0].text, *percent ? " %" : "");
    if (n == 3 && v[1].number < v[2].number) {
        koksma__atlas_print(f, " <span class=\"pm\">(%s to %s)</span>", v[1].text, v[2].text);
    }
    return KOKSMA_OK;
}

/* ---- Rows ------------------------------------------------------------------------------------------------------ */

/* The conditions KEY=TEXT on rows of a list. */
typedef struct selection {
    koksma__json_node list;
    size_t n_rows, n;
    char *conditions[MAX_PARTS];
} selection;

static koksma_status select_rows(const page *p, size_t job, selection *s)
{
    s->list = koksma__json_root(p->rows[job]);
    s->n = 0;
    return koksma__json_length(&s->list, MAX_ROWS, &s->n_rows);
}

/* The next row, from row *i on, that all conditions let pass; *i becomes the index after it. A row without the key of one
   does not. Returns false at the end. */
static bool next_row(const selection *s, size_t *i, koksma__json_node *row)
{
    while (*i < s->n_rows) {
        bool fits = true;
        *row = koksma__json_item(&s->list, (*i)++);
        for (size_t k = 0; fits && k < s->n; k++) {
            char key[TEXT];
            value v;
            const char *equals = strchr(s->conditions[k], '=');
            snprintf(key, sizeof key, "%.*s", (int)(equals - s->conditions[k]), s->conditions[k]);
            fits = koksma__json_has(row, key) && !read_value(row, key, &v) &&
                   (!strcmp(v.text, equals + 1) || !strcmp(v.full, equals + 1));
        }
        if (fits) {
            return true;
        }
    }
    return false;
}

static koksma_status find_job(const page *p, const char *id, const koksma__json_node *from, size_t *job)
{
    for (*job = 0; *job < p->of->n_jobs && strcmp(p->of->jobs[*job].id, id) != 0; ++*job) {
    }
    KOKSMA__JSON_FAIL_IF(*job == p->of->n_jobs, from, "there is no run '%s'", id);
    return KOKSMA_OK;
}

/* Writes KEY of all rows that fit: "A", or "A, B and C, not told apart". */
static koksma_status put_list(const page *p, const char *id, const selection *s, const char *key)
{
    koksma__json_node row;
    value v;
    size_t count = 0, shown = 0;
    for (size_t i = 0; next_row(s, &i, &row);) {
        count++;
    }
    for (size_t i = 0; next_row(s, &i, &row); shown++) {
        KOKSMA__TRY(read_value(&row, key, &v));
        koksma__atlas_print(p->f, "%s<code>%s</code>", !shown ? "" : shown + 1 < count ? ", " : " and ", v.text);
    }
    KOKSMA__JSON_FAIL_IF(!count, &p->of->node, "an answer lists rows of run '%s', %s, and finds none", id,
                         s->n ? s->conditions[0] : "*");
    koksma__atlas_print(p->f, count > 1 ? ", not told apart" : "");
    return KOKSMA_OK;
}

/* Finds the one row that the conditions leave. sign: -1: the row with the least `by` among these, 1: the largest. */
static koksma_status find_row(const page *p, const char *id, const selection *s, const char *by, int sign,
                              koksma__json_node *found)
{
    koksma__json_node row;
    size_t count = 0;
    double best = NAN;
    for (size_t i = 0; next_row(s, &i, &row);) {
        value v = {.number = NAN};
        KOKSMA__TRY(by ? read_value(&row, by, &v) : KOKSMA_OK);
        if (!by || (!isnan(v.number) && !(sign * v.number <= sign * best))) {
            best = v.number;
            count += !by || !count;
            *found = row;
        }
    }
    KOKSMA__JSON_FAIL_IF(count != 1, &p->of->node, "an answer asks for one row of run '%s', %s=..., and finds %zu",
                         id, s->n ? s->conditions[0] : "*", count);
    return KOKSMA_OK;
}

/* ---- Words ----------------------------------------------------------------------------------------------------- */

/* Writes the value that the text between { and } of an answer names. */
static koksma_status put_reference(const page *p, const char *text, size_t length)
{
    char copy[TEXT], *parts[MAX_PARTS], *at = copy;
    const char *by = NULL;
    int sign = 0;
    size_t n = 0, job;
    koksma__json_node row;
    selection s;
    snprintf(copy, sizeof copy, "%.*s", (int)length, text);
    while (at && n < MAX_PARTS) {
        parts[n++] = at;
        at = strchr(at, '|');
        if (at) {
            *at++ = '\0';
        }
    }
    KOKSMA__JSON_FAIL_IF(at || n < 2, &p->of->node, "'{%.*s}' is not '{ID|KEY=TEXT|..|KEY}'", (int)length, text);
    KOKSMA__TRY(find_job(p, parts[0], &p->of->node, &job));
    KOKSMA__TRY(select_rows(p, job, &s));
    for (size_t i = 1; i + 1 < n; i++) {
        const char *equals = strchr(parts[i], '=');
        KOKSMA__JSON_FAIL_IF(!equals, &p->of->node, "'%s' in '{%.*s}' is not KEY=TEXT", parts[i], (int)length, text);
        if (!strncmp(parts[i], "least=", 6) || !strncmp(parts[i], "most=", 5)) {
            sign = *parts[i] == 'm' ? 1 : -1;
            by = equals + 1;
        } else {
            s.conditions[s.n++] = parts[i];
        }
    }
    if (!strncmp(parts[n - 1], "list=", 5)) {
        return put_list(p, parts[0], &s, parts[n - 1] + 5);
    }
    KOKSMA__TRY(find_row(p, parts[0], &s, by, sign, &row));
    return put_value(p->f, &row, parts[n - 1]);
}

/* Writes words with `code`, links to documents, and values: of an answer, or of a row in whose cell the words stand. */
static koksma_status put_words(const page *p, const char *text, const koksma__json_node *row)
{
    bool code = false, is_link = false;
    while (*text) {
        const size_t length = strcspn(text, "`{");
        koksma__atlas_print(p->f, "%.*s", (int)length, text);
        text += length;
        if (*text == '`') {
            text++;
            KOKSMA__TRY(code ? KOKSMA_OK : koksma__atlas_begin_link(p->f, p->atlas->options->folder, text, &is_link));
            koksma__atlas_print(p->f, !code ? "<code>" : is_link ? "</code></a>" : "</code>");
            code = !code;
        } else if (*text == '{') {
            const char *end = strchr(text, '}');
            KOKSMA__JSON_FAIL_IF(!end, &p->of->node, "'{' without '}' in '%.60s'", text);
            const size_t inside = (size_t)(end - text - 1);
            if (row) {
                char key[TEXT];
                value v;
                snprintf(key, sizeof key, "%.*s", (int)inside, text + 1);
                KOKSMA__TRY(read_value(row, key, &v));
                koksma__atlas_print(p->f, "%s", v.full);
            } else {
                KOKSMA__TRY(put_reference(p, text + 1, inside));
            }
            text = end + 1;
        }
    }
    return KOKSMA_OK;
}

/* ---- Tables ---------------------------------------------------------------------------------------------------- */

static koksma_status text_at(const koksma__json_node *list, size_t i, const char **text)
{
    const koksma__json_node node = koksma__json_item(list, i);
    return koksma__json_text(&node, text);
}

/* What a column shows: a value, or words with {KEY} of the row in them; after its head, if it has one. */
static const char *what_of(const char *column)
{
    const char *colon = strstr(column, ": ");
    return colon ? colon + 2 : column;
}

/* Writes the rows of the kind that a table shows: those with the key of the first column. Commands may add rows of
   slopes. */
static koksma_status put_rows(const page *p, const koksma__json_node *columns, size_t n_columns, const selection *s)
{
    koksma__json_node row;
    const char *text;
    char key[64] = "";
    size_t shown = 0;
    KOKSMA__TRY(text_at(columns, 0, &text));
    sscanf(what_of(text), "%63s", key);
    const bool of_words = strchr(what_of(text), '{');
    for (size_t i = 0; next_row(s, &i, &row);) {
        if (!of_words && !koksma__json_has(&row, key)) {
            continue;
        }
        shown++;
        koksma__atlas_print(p->f, "<tr>");
        for (size_t k = 0; k < n_columns; k++) {
            KOKSMA__TRY(text_at(columns, k, &text));
            text = what_of(text);
            koksma__atlas_print(p->f, k ? "<td>" : "<th scope=\"row\">");
            KOKSMA__TRY(strchr(text, '{') ? put_words(p, text, &row) : put_value(p->f, &row, text));
            koksma__atlas_print(p->f, k ? "</td>" : "</th>");
        }
        koksma__atlas_print(p->f, "</tr>\n");
    }
    KOKSMA__JSON_FAIL_IF(!shown, columns, "no row of the run fits the table's 'where'");
    return KOKSMA_OK;
}

/* A table: {"run": ID, "columns": [..], "where": ["KEY=TEXT", ..]}. */
static koksma_status put_table(const page *p, const koksma__json_node *table, size_t job)
{
    koksma__json_node columns, where;
    size_t n_columns, n;
    char texts[MAX_PARTS][TEXT];
    const char *text;
    selection s;
    KOKSMA__TRY(koksma__json_member(table, "columns", &columns));
    KOKSMA__TRY(koksma__json_length(&columns, MAX_COLUMNS, &n_columns));
    KOKSMA__TRY(koksma__atlas_list(table, "where", MAX_PARTS, &where, &n));
    KOKSMA__TRY(select_rows(p, job, &s));
    for (; s.n < n; s.n++) {
        KOKSMA__TRY(text_at(&where, s.n, &text));
        KOKSMA__JSON_FAIL_IF(!strchr(text, '='), &where, "'%s' is not KEY=TEXT", text);
        snprintf(texts[s.n], TEXT, "%s", text);
        s.conditions[s.n] = texts[s.n];
    }
    koksma__atlas_print(p->f, "<div class=\"scroll\" tabindex=\"0\"><table class=\"many\">\n<thead><tr>");
    for (size_t k = 0; k < n_columns; k++) {
        KOKSMA__TRY(text_at(&columns, k, &text));
        const char *what = what_of(text);
        const size_t length = what > text ? (size_t)(what - text - 2) : strcspn(text, " ");
        koksma__atlas_print(p->f, "<th scope=\"col\">%.*s</th>", (int)length, text);
    }
    koksma__atlas_print(p->f, "</tr></thead>\n<tbody>\n");
    KOKSMA__TRY(put_rows(p, &columns, n_columns, &s));
    koksma__atlas_print(p->f, "</tbody></table></div>\n");
    return KOKSMA_OK;
}

/* The note on a command, such as what its columns mean, below its first run on the page. */
static koksma_status put_note(const page *p, size_t job)
{
    const koksma__json_node root = koksma__json_root(p->atlas->document);
    const koksma__atlas_job *jobs = p->of->jobs;
    koksma__json_node notes;
    char word[64] = "", before[64];
    const char *note = NULL;
    sscanf(jobs[job].command, "%*s %63s", word);
    for (size_t i = 0; i < job; i++) {
        if (sscanf(jobs[i].command, "%*s %63s", before) == 1 && !strcmp(before, word)) {
            return KOKSMA_OK;
        }
    }
    if (koksma__json_has(&root, "notes")) {
        KOKSMA__TRY(koksma__json_member(&root, "notes", &notes));
        KOKSMA__TRY(koksma__json_get_text(&notes, word, false, &note));
    }
    if (note) {
        koksma__atlas_print(p->f, "<p class=\"csv\">");
        KOKSMA__TRY(put_words(p, note, NULL));
        koksma__atlas_print(p->f, "</p>\n");
    }
    return KOKSMA_OK;
}

/* A command, the tables of its rows, and the picture that it draws. */
static koksma_status put_run(const page *p, size_t job)
{
    const koksma__atlas_job *j = &p->of->jobs[job];
    koksma__json_node runs, tables;
    const char *alt = "", *id;
    size_t n, k;
    selection all;
    koksma__atlas_print(p->f, "<section id=\"%s\">\n<div class=\"commands\"><pre><code>%s</code></pre></div>\n",
                        j->id, j->command);
    KOKSMA__TRY(put_note(p, job));
    KOKSMA__TRY(koksma__atlas_list(&p->of->node, "tables", MAX_TABLES, &tables, &n));
    for (size_t i = 0; i < n; i++) {
        const koksma__json_node table = koksma__json_item(&tables, i);
        KOKSMA__TRY(koksma__json_get_text(&table, "run", true, &id));
        KOKSMA__TRY(find_job(p, id, &table, &k));
        KOKSMA__TRY(k == job ? put_table(p, &table, job) : KOKSMA_OK);
    }
    KOKSMA__TRY(koksma__json_member(&p->of->node, "runs", &runs));
    const koksma__json_node run = koksma__json_item(&runs, job);
    KOKSMA__TRY(koksma__json_get_text(&run, "alt", false, &alt));
    if (j->output && *alt) {
        koksma__atlas_print(p->f, "<figure><img src=\"files/%s\" alt=\"%s\"><figcaption>%s</figcaption></figure>\n",
                            j->output, alt, alt);
    }
    KOKSMA__TRY(select_rows(p, job, &all));
    koksma__atlas_print(p->f, "<p class=\"csv\">");
    if (all.n_rows) {
        koksma__atlas_print(p->f, "<a href=\"%s\">all rows, all digits</a>%s", j->file, j->output ? ", " : "");
    }
    if (j->output) {
        koksma__atlas_print(p->f, "<a href=\"files/%s\">the file</a>", j->output);
    }
    koksma__atlas_print(p->f, "</p>\n</section>\n");
    return KOKSMA_OK;
}

/* ---- Pages ----------------------------------------------------------------------------------------------------- */

/* Puts the rows of a page's jobs, JSON Lines, into one JSON list for each. */
static koksma_status read_rows(page *p)
{
    for (size_t i = 0; i < p->of->n_jobs; i++) {
        unsigned char *bytes = NULL;
        size_t size = 0;
        char *path = koksma__path_below(p->atlas->options->folder, p->of->jobs[i].file);
        KOKSMA__REQUIRE_MEMORY(path, (size_t)TEXT);
        koksma_status status = koksma__read_file(path, KOKSMA__FILE_PARAMETERS, KOKSMA__BY_FILE, NULL, &bytes, &size);
        char *list = malloc(size + 3);
        if (!list && !status) {
            status = koksma__fail_memory(size + 3);
        }
        if (!status) {
            const bool lines = size && *bytes == '{';
            snprintf(list, size + 3, "[%s", lines ? (char *)bytes : "]");
            for (char *at = list; lines && (at = strchr(at, '\n')); at++) {
                *at = at[1] ? ',' : ']';
            }
            status = koksma__json_open("rows", path, list, strlen(list), &p->rows[i]);
        }
        free(list);
        free(bytes);
        free(path);
        KOKSMA__TRY(status);
    }
    return KOKSMA_OK;
}

static koksma_status put_page(const page *p)
{
    const koksma__atlas_page *q = p->of;
    const char *text = "", *answer = "", *thread;
    koksma__json_node threads;
    size_t n;
    KOKSMA__TRY(koksma__json_get_text(&q->node, "text", false, &text));
    KOKSMA__TRY(koksma__json_get_text(&q->node, "answer", true, &answer));
    koksma__atlas_put_head(p->f, q->title);
    koksma__atlas_print(p->f, "<p class=\"kicker\"><a href=\"index.html\">Atlas</a>");
    if (q->number) {
        koksma__atlas_print(p->f, ", question %zu", q->number);
    }
    koksma__atlas_print(p->f, "</p>\n<h1>%s</h1>\n<p class=\"decided\">", q->title);
    KOKSMA__TRY(put_words(p, answer, NULL));
    koksma__atlas_print(p->f, "</p>\n<p>");
    KOKSMA__TRY(put_words(p, text, NULL));
    koksma__atlas_print(p->f, "</p>\n");
    KOKSMA__TRY(koksma__atlas_list(&q->node, "threads", TEXT, &threads, &n));
    for (size_t i = 0; i < n; i++) {
        KOKSMA__TRY(text_at(&threads, i, &thread));
        koksma__atlas_print(p->f, i ? ", %s" : "<p class=\"csv\">Asked in %s", thread);
    }
    koksma__atlas_print(p->f, n ? "</p>\n" : "");
    for (size_t i = 0; i < q->n_jobs; i++) {
        KOKSMA__TRY(put_run(p, i));
    }
    koksma__atlas_print(p->f, "</main>\n</body>\n</html>\n");
    return KOKSMA_OK;
}

/* The item of a page on the index: its title, a link, and its answer. */
static koksma_status put_item(const page *p)
{
    const char *answer;
    KOKSMA__TRY(koksma__json_get_text(&p->of->node, "answer", true, &answer));
    koksma__atlas_print(p->f, "<dt><a href=\"%s.html\">", p->of->id);
    if (p->of->number) {
        koksma__atlas_print(p->f, "%zu. ", p->of->number);
    }
    koksma__atlas_print(p->f, "%s</a></dt>\n<dd>", p->of->title);
    KOKSMA__TRY(put_words(p, answer, NULL));
    koksma__atlas_print(p->f, "</dd>\n");
    return KOKSMA_OK;
}

static void put_sheets(FILE *f, const koksma__atlas *a)
{
    koksma__atlas_print(f, "<h2 id=\"patterns\">A datasheet for each pattern</h2>\n<ul>\n");
    for (size_t i = a->n_jobs - a->n_sheets; i < a->n_jobs; i++) {
        const koksma__atlas_job *job = &a->jobs[i];
        const char *what = koksma_pattern_find(job->id)->title;
        if (*job->failure) {
            koksma__atlas_print(f, "<li><code>%s</code>: %s <small>No datasheet: %s</small></li>\n", job->id, what,
                                job->failure);
        } else {
            koksma__atlas_print(f, "<li><a href=\"%s\"><code>%s</code></a>: %s</li>\n", job->file, job->id, what);
        }
    }
    koksma__atlas_print(f, "</ul>\n");
}

static koksma_status write_page(const koksma__atlas *a, const koksma__atlas_page *of, FILE *index)
{
    char name[KOKSMA_MAX_SPEC], *text = NULL;
    size_t size;
    page p = {.atlas = a, .of = of, .f = open_memstream(&text, &size)};
    KOKSMA__REQUIRE_MEMORY(p.f, (size_t)TEXT);
    snprintf(name, sizeof name, "%s.html", of->id);
    koksma_status status = read_rows(&p);
    status = status ? status : put_page(&p);
    status = koksma__atlas_close(p.f, a->options->folder, name, &text, status);
    p.f = index;
    status = status ? status : put_item(&p);
    for (size_t i = 0; i < of->n_jobs; i++) {
        koksma__json_close(p.rows[i]);
    }
    return status;
}

koksma_status koksma__atlas_write(const koksma__atlas *a, size_t *written)
{
    const koksma__json_node root = koksma__json_root(a->document);
    const char *title = "Koksma's atlas", *about = "";
    char *text = NULL;
    size_t size;
    KOKSMA__TRY(koksma__json_get_text(&root, "title", false, &title));
    KOKSMA__TRY(koksma__json_get_text(&root, "text", false, &about));
    FILE *f = open_memstream(&text, &size);
    KOKSMA__REQUIRE_MEMORY(f, (size_t)TEXT);
    koksma__atlas_put_head(f, title);
    koksma__atlas_print(f, "<h1>%s</h1>\n<p>%s</p>\n<p class=\"csv\">koksma %s%s</p>\n<dl>\n", title, about,
                        koksma_version(),
                        a->options->quick ? ", built with --quick: fewer trials, wider intervals" : "");
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < a->n_pages; i++) {
        status = write_page(a, &a->pages[i], f);
    }
    koksma__atlas_print(f, "</dl>\n");
    if (a->n_sheets) {
        put_sheets(f, a);
    }
    koksma__atlas_print(f, "</main>\n</body>\n</html>\n");
    *written = a->n_pages + 1;
    return koksma__atlas_close(f, a->options->folder, "index.html", &text, status);
}
