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
#include "study/report/document.h"

enum { MAX_COLUMNS = 24, MAX_TABLES = 16, MAX_ROWS = 100000, TEXT = 512 };

typedef struct page {
    FILE *f;
    const koksma__atlas *atlas;
    const koksma__atlas_page *of;
    koksma__json *rows[KOKSMA__ATLAS_PAGE_JOBS]; /* of each job */
} page;

/* ---- Values ---------------------------------------------------------------------------------------------------- */

/* Writes the member `key` of a row to `text` as it is shown, and with all digits to `full`; "-" for null. *number: its
   number, or NaN. */
static koksma_status read_value(const koksma__json_node *row, const char *key, char text[TEXT], char full[TEXT],
                                double *number)
{
    koksma__json_node node;
    const char *word;
    bool flag;
    *number = NAN;
    KOKSMA__TRY(koksma__json_member(row, key, &node));
    if (koksma__json_is_text(&node)) {
        KOKSMA__TRY(koksma__json_text(&node, &word));
        snprintf(text, TEXT, "%s", word);
    } else if (!koksma__json_number(&node, -INFINITY, INFINITY, number)) {
        const bool whole = *number == floor(*number) && fabs(*number) < 1e15;
        koksma__snprintf(text, TEXT, whole ? "%.0f" : "%.4g", *number);
        koksma__snprintf(full, TEXT, "%.17g", *number);
        return KOKSMA_OK;
    } else {
        snprintf(text, TEXT, "%s", koksma__json_flag(&node, &flag) ? "-" : flag ? "yes" : "no");
    }
    snprintf(full, TEXT, "%s", text);
    return KOKSMA_OK;
}

/* Writes a number and the ends of its interval with as many decimals as give the interval's width two digits. */
static void print_interval(char text[3][TEXT], const double number[3])
{
    const double width = number[2] - number[1], largest = fmax(fabs(number[1]), fabs(number[2]));
    if (!(width > 0 && isfinite(width))) {
        return;
    }
    const int last = (int)floor(koksma__log10(width)) - 1, first = (int)floor(koksma__log10(largest));
    for (int i = 0; i < 3; i++) {
        koksma__snprintf(text[i], TEXT, first < -3 ? "%.*e" : "%.*f",
                         first < -3 ? first - last
                         : last < 0 ? -last
                                    : 0,
                         number[i]);
        if (text[i][0] == '-' && !text[i][strspn(text[i], "-0.")]) {
            memmove(text[i], text[i] + 1, strlen(text[i])); /* no -0 */
        }
    }
}

/* Writes "KEY [LOW HIGH [%]]" of a row. */
static koksma_status put_value(FILE *f, const koksma__json_node *row, const char *keys)
{
    char key[3][64] = {"", "", ""}, text[3][TEXT], full[3][TEXT], percent[2] = "";
    double number[3] = {NAN, NAN, NAN};
    const int read = sscanf(keys, "%63s %63s %63s %1[%]", key[0], key[1], key[2], percent), n = read < 3 ? read : 3;
    KOKSMA__JSON_FAIL_IF(n != 1 && n != 3, row, "'%s' is not 'KEY' or 'KEY LOW HIGH'", keys);
    for (int i = 0; i < n; i++) {
        KOKSMA__TRY(read_value(row, key[i], text[i], full[i], &number[i]));
        number[i] *= *percent ? 100 : 1;
    }
    print_interval(text, number);
    if (isnan(number[0])) {
        koksma__atlas_put(f, text[0]);
    } else {
        fprintf(f, "<data value=\"%s\" title=\"%s\">%s</data>%s", full[0], full[0], text[0], *percent ? " %" : "");
    }
    if (n == 3 && number[1] < number[2]) {
        fprintf(f, " <span class=\"pm\">(%s to %s)</span>", text[1], text[2]);
    }
    return KOKSMA_OK;
}

/* Whether a row has KEY=TEXT for each of n conditions. A row without the key does not. */
static bool fits(const koksma__json_node *row, char *const *conditions, size_t n)
{
    char key[TEXT], text[TEXT], full[TEXT];
    double number;
    for (size_t i = 0; i < n; i++) {
        const char *equals = strchr(conditions[i], '=');
        snprintf(key, sizeof key, "%.*s", (int)(equals - conditions[i]), conditions[i]);
        if (!koksma__json_has(row, key) || read_value(row, key, text, full, &number) ||
            (strcmp(text, equals + 1) != 0 && strcmp(full, equals + 1) != 0)) {
            return false;
        }
    }
    return true;
}

static koksma_status find_job(const page *p, const char *id, const koksma__json_node *from, size_t *job)
{
    for (*job = 0; *job < p->of->n_jobs && strcmp(p->of->jobs[*job].id, id) != 0; ++*job) {
    }
    KOKSMA__JSON_FAIL_IF(*job == p->of->n_jobs, from, "there is no run '%s'", id);
    return KOKSMA_OK;
}

/* Writes KEY of all rows that fit: "A", or "A, B and C, not told apart". */
static koksma_status put_list(const page *p, size_t job, char *const *conditions, size_t n, const char *key)
{
    const koksma__json_node list = koksma__json_root(p->rows[job]);
    char text[2][TEXT] = {"", ""}, full[TEXT];
    size_t n_rows, count = 0;
    double number;
    KOKSMA__TRY(koksma__json_length(&list, MAX_ROWS, &n_rows));
    for (size_t i = 0; i <= n_rows; i++) {
        const koksma__json_node row = i < n_rows ? koksma__json_item(&list, i) : list;
        if (i < n_rows && !fits(&row, conditions, n)) {
            continue;
        }
        if (count) { /* the row before */
            fputs(count == 1 ? "<code>" : i < n_rows ? ", <code>" : " and <code>", p->f);
            koksma__atlas_put(p->f, text[count % 2]);
            fputs("</code>", p->f);
        }
        count += i < n_rows;
        KOKSMA__TRY(i < n_rows ? read_value(&row, key, text[count % 2], full, &number) : KOKSMA_OK);
    }
    KOKSMA__JSON_FAIL_IF(!count, &p->of->node, "an answer lists rows of run '%s', %s, and finds none",
                         p->of->jobs[job].id, n ? conditions[0] : "*");
    fputs(count > 1 ? ", not told apart" : "", p->f);
    return KOKSMA_OK;
}

/* Finds the one row that the conditions leave. sign: -1: the row with the least `by` among these, 1: the largest. */
static koksma_status find_row(const page *p, size_t job, char *const *conditions, size_t n, const char *by, int sign,
                              koksma__json_node *found)
{
    const koksma__json_node list = koksma__json_root(p->rows[job]);
    size_t n_rows, count = 0;
    double best = NAN;
    KOKSMA__TRY(koksma__json_length(&list, MAX_ROWS, &n_rows));
    for (size_t i = 0; i < n_rows; i++) {
        char text[TEXT], full[TEXT];
        double number = NAN;
        const koksma__json_node row = koksma__json_item(&list, i);
        if (!fits(&row, conditions, n)) {
            continue;
        }
        if (by) {
            KOKSMA__TRY(read_value(&row, by, text, full, &number));
            if (isnan(number) || sign * number <= sign * best) {
                continue;
            }
            best = number;
        }
        count += !by || !count;
        *found = row;
    }
    KOKSMA__JSON_FAIL_IF(count != 1, &p->of->node, "an answer asks for one row of run '%s', %s=..., and finds %zu",
                         p->of->jobs[job].id, n ? conditions[0] : "*", count);
    return KOKSMA_OK;
}

/* Writes the value that the text between { and } of an answer names. */
static koksma_status put_reference(page *p, const char *text, size_t length)
{
    char copy[TEXT], *parts[8], *at = copy;
    const char *by = NULL;
    int sign = 0;
    size_t n = 0, job, n_conditions = 0;
    koksma__json_node row;
    snprintf(copy, sizeof copy, "%.*s", (int)length, text);
    while (at && n < sizeof parts / sizeof *parts) {
        parts[n++] = at;
        at = strchr(at, '|');
        if (at) {
            *at++ = '\0';
        }
    }
    KOKSMA__JSON_FAIL_IF(at || n < 2, &p->of->node, "'{%.*s}' is not '{ID|KEY=TEXT|..|KEY}'", (int)length, text);
    KOKSMA__TRY(find_job(p, parts[0], &p->of->node, &job));
    for (size_t i = 1; i + 1 < n; i++) {
        const char *equals = strchr(parts[i], '=');
        KOKSMA__JSON_FAIL_IF(!equals, &p->of->node, "'%s' in '{%.*s}' is not KEY=TEXT", parts[i], (int)length, text);
        if (!strncmp(parts[i], "least=", 6) || !strncmp(parts[i], "most=", 5)) {
            sign = *parts[i] == 'm' ? 1 : -1;
            by = equals + 1;
        } else {
            parts[1 + n_conditions++] = parts[i];
        }
    }
    if (!strncmp(parts[n - 1], "list=", 5)) {
        return put_list(p, job, parts + 1, n_conditions, parts[n - 1] + 5);
    }
    KOKSMA__TRY(find_row(p, job, parts + 1, n_conditions, by, sign, &row));
    return put_value(p->f, &row, parts[n - 1]);
}

/* Writes words with `code`, values, and links to documents. */
static koksma_status put_words(page *p, const char *text)
{
    bool code = false, is_link = false;
    while (*text) {
        const size_t length = strcspn(text, "`{");
        koksma__atlas_put_text(p->f, text, length);
        text += length;
        if (*text == '`') {
            text++;
            KOKSMA__TRY(code ? KOKSMA_OK : koksma__atlas_begin_link(p->f, p->atlas->options->folder, text, &is_link));
            fputs(!code ? "<code>" : is_link ? "</code></a>" : "</code>", p->f);
            code = !code;
        } else if (*text == '{') {
            const char *end = strchr(text, '}');
            KOKSMA__JSON_FAIL_IF(!end, &p->of->node, "'{' without '}' in '%.60s'", text);
            KOKSMA__TRY(put_reference(p, text + 1, (size_t)(end - text - 1)));
            text = end + 1;
        }
    }
    return KOKSMA_OK;
}

/* ---- Tables ---------------------------------------------------------------------------------------------------- */

/* A cell of the column `text`: a value, or words with {KEY} of the row in them. */
static koksma_status put_cell(FILE *f, const koksma__json_node *row, const char *text)
{
    const char *colon = strstr(text, ": ");
    const char *what = colon ? colon + 2 : text;
    if (!strchr(what, '{')) {
        return put_value(f, row, what);
    }
    bool code = false;
    for (; *what; what++) {
        const char *end = strchr(what, '}');
        if (*what == '`') {
            fputs(code ? "</code>" : "<code>", f);
            code = !code;
        } else if (*what == '{' && end) {
            char key[TEXT], shown[TEXT], full[TEXT];
            double number;
            snprintf(key, sizeof key, "%.*s", (int)(end - what - 1), what + 1);
            KOKSMA__TRY(read_value(row, key, shown, full, &number));
            koksma__atlas_put(f, full);
            what = end;
        } else {
            koksma__atlas_put_text(f, what, 1);
        }
    }
    return KOKSMA_OK;
}

/* Whether a row is of the kind that a table shows: it has the key of the first column. Commands may add rows of slopes. */
static bool is_of_kind(const koksma__json_node *row, const koksma__json_node *columns)
{
    char key[64] = "";
    const char *text = "";
    const koksma__json_node first = koksma__json_item(columns, 0);
    if (koksma__json_text(&first, &text)) {
        return true; /* the cell has the error */
    }
    const char *colon = strstr(text, ": ");
    sscanf(colon ? colon + 2 : text, "%63s", key);
    return strchr(colon ? colon + 2 : text, '{') || koksma__json_has(row, key);
}

static koksma_status put_rows(const page *p, const koksma__json_node *columns, size_t n_columns,
                              const koksma__json_node *list, char *const *conditions, size_t n_conditions)
{
    size_t n_rows, shown = 0;
    KOKSMA__TRY(koksma__json_length(list, MAX_ROWS, &n_rows));
    for (size_t i = 0; i < n_rows; i++) {
        const koksma__json_node row = koksma__json_item(list, i);
        if (!fits(&row, conditions, n_conditions) || !is_of_kind(&row, columns)) {
            continue;
        }
        shown++;
        fputs("<tr>", p->f);
        for (size_t k = 0; k < n_columns; k++) {
            const koksma__json_node node = koksma__json_item(columns, k);
            const char *text;
            KOKSMA__TRY(koksma__json_text(&node, &text));
            fputs(k ? "<td>" : "<th scope=\"row\">", p->f);
            KOKSMA__TRY(put_cell(p->f, &row, text));
            fputs(k ? "</td>" : "</th>", p->f);
        }
        fputs("</tr>\n", p->f);
    }
    KOKSMA__JSON_FAIL_IF(!shown, columns, "no row of the run fits the table's 'where'");
    return KOKSMA_OK;
}

/* A table: {"run": ID, "columns": [..], "where": ["KEY=TEXT", ..]}. */
static koksma_status put_table(const page *p, const koksma__json_node *table, size_t job)
{
    koksma__json_node columns, where;
    size_t n_columns, n_conditions = 0;
    char texts[8][TEXT], *conditions[8];
    KOKSMA__TRY(koksma__json_member(table, "columns", &columns));
    KOKSMA__TRY(koksma__json_length(&columns, MAX_COLUMNS, &n_columns));
    if (koksma__json_has(table, "where")) {
        KOKSMA__TRY(koksma__json_member(table, "where", &where));
        KOKSMA__TRY(koksma__json_length(&where, 8, &n_conditions));
    }
    for (size_t i = 0; i < n_conditions; i++) {
        const koksma__json_node node = koksma__json_item(&where, i);
        const char *text;
        KOKSMA__TRY(koksma__json_text(&node, &text));
        KOKSMA__JSON_FAIL_IF(!strchr(text, '='), &node, "'%s' is not KEY=TEXT", text);
        snprintf(texts[i], TEXT, "%s", text);
        conditions[i] = texts[i];
    }
    fputs("<div class=\"scroll\" tabindex=\"0\"><table class=\"many\">\n<thead><tr>", p->f);
    for (size_t k = 0; k < n_columns; k++) {
        const koksma__json_node node = koksma__json_item(&columns, k);
        const char *text;
        KOKSMA__TRY(koksma__json_text(&node, &text));
        const char *colon = strstr(text, ": ");
        fputs("<th scope=\"col\">", p->f);
        koksma__atlas_put_text(p->f, text, colon ? (size_t)(colon - text) : strcspn(text, " "));
        fputs("</th>", p->f);
    }
    fputs("</tr></thead>\n<tbody>\n", p->f);
    const koksma__json_node list = koksma__json_root(p->rows[job]);
    KOKSMA__TRY(put_rows(p, &columns, n_columns, &list, conditions, n_conditions));
    fputs("</tbody></table></div>\n", p->f);
    return KOKSMA_OK;
}

/* The note on a command, such as what its columns mean, below its first run on the page. */
static koksma_status put_note(page *p, size_t job)
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
        fputs("<p class=\"csv\">", p->f);
        KOKSMA__TRY(put_words(p, note));
        fputs("</p>\n", p->f);
    }
    return KOKSMA_OK;
}

/* A command, the tables of its rows, and the picture that it draws. */
static koksma_status put_run(page *p, size_t job)
{
    const koksma__atlas_job *j = &p->of->jobs[job];
    koksma__json_node runs, tables;
    const char *alt = "", *id;
    size_t n = 0, k;
    fprintf(p->f, "<section id=\"%s\">\n<div class=\"commands\"><pre><code>", j->id);
    koksma__atlas_put(p->f, j->command);
    fputs("</code></pre></div>\n", p->f);
    KOKSMA__TRY(put_note(p, job));
    if (koksma__json_has(&p->of->node, "tables")) {
        KOKSMA__TRY(koksma__json_member(&p->of->node, "tables", &tables));
        KOKSMA__TRY(koksma__json_length(&tables, MAX_TABLES, &n));
    }
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
        fprintf(p->f, "<figure><img src=\"files/%s\" alt=\"", j->output);
        koksma__atlas_put(p->f, alt);
        fputs("\"><figcaption>", p->f);
        koksma__atlas_put(p->f, alt);
        fputs("</figcaption></figure>\n", p->f);
    }
    const koksma__json_node list = koksma__json_root(p->rows[job]);
    KOKSMA__TRY(koksma__json_length(&list, MAX_ROWS, &n));
    fputs("<p class=\"csv\">", p->f);
    n ? fprintf(p->f, "<a href=\"%s\">all rows, all digits</a>%s", j->file, j->output ? ", " : "") : 0;
    j->output ? fprintf(p->f, "<a href=\"files/%s\">the file</a>", j->output) : 0;
    fputs("</p>\n</section>\n", p->f);
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

static koksma_status put_page(page *p)
{
    const koksma__atlas_page *q = p->of;
    const char *text = "", *answer = "";
    koksma__json_node threads;
    size_t n = 0;
    KOKSMA__TRY(koksma__json_get_text(&q->node, "text", false, &text));
    KOKSMA__TRY(koksma__json_get_text(&q->node, "answer", true, &answer));
    koksma__atlas_put_head(p->f, q->title);
    fputs("<p class=\"kicker\"><a href=\"index.html\">Atlas</a>", p->f);
    q->number ? fprintf(p->f, ", question %zu", q->number) : 0;
    fputs("</p>\n<h1>", p->f);
    koksma__atlas_put(p->f, q->title);
    fputs("</h1>\n<p class=\"decided\">", p->f);
    KOKSMA__TRY(put_words(p, answer));
    fputs("</p>\n<p>", p->f);
    KOKSMA__TRY(put_words(p, text));
    fputs("</p>\n", p->f);
    if (koksma__json_has(&q->node, "threads")) {
        KOKSMA__TRY(koksma__json_member(&q->node, "threads", &threads));
        KOKSMA__TRY(koksma__json_length(&threads, TEXT, &n));
    }
    for (size_t i = 0; i < n; i++) {
        const koksma__json_node node = koksma__json_item(&threads, i);
        const char *thread;
        KOKSMA__TRY(koksma__json_text(&node, &thread));
        fputs(i ? ", " : "<p class=\"csv\">Asked in ", p->f);
        koksma__atlas_put(p->f, thread);
    }
    fputs(n ? "</p>\n" : "", p->f);
    for (size_t i = 0; i < q->n_jobs; i++) {
        KOKSMA__TRY(put_run(p, i));
    }
    fputs("</main>\n</body>\n</html>\n", p->f);
    return KOKSMA_OK;
}

/* The item of a page on the index: its title, a link, and its answer. */
static koksma_status put_item(page *p)
{
    const char *answer;
    KOKSMA__TRY(koksma__json_get_text(&p->of->node, "answer", true, &answer));
    fprintf(p->f, "<dt><a href=\"%s.html\">", p->of->id);
    p->of->number ? fprintf(p->f, "%zu. ", p->of->number) : 0;
    koksma__atlas_put(p->f, p->of->title);
    fputs("</a></dt>\n<dd>", p->f);
    KOKSMA__TRY(put_words(p, answer));
    fputs("</dd>\n", p->f);
    return KOKSMA_OK;
}

static void put_sheets(FILE *f, const koksma__atlas *a)
{
    fputs("<h2 id=\"patterns\">A datasheet for each pattern</h2>\n<ul>\n", f);
    for (size_t i = a->n_jobs - a->n_sheets; i < a->n_jobs; i++) {
        const koksma__atlas_job *job = &a->jobs[i];
        const char *what = koksma_pattern_find(job->id)->title;
        fputs("<li>", f);
        *job->failure ? 0 : fprintf(f, "<a href=\"%s\">", job->file);
        fprintf(f, "<code>%s</code>%s: ", job->id, *job->failure ? "" : "</a>");
        koksma__atlas_put(f, what);
        fputs(*job->failure ? " <small>No datasheet: " : "", f);
        koksma__atlas_put(f, job->failure);
        fputs(*job->failure ? "</small></li>\n" : "</li>\n", f);
    }
    fputs("</ul>\n", f);
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
    fputs("<h1>", f);
    koksma__atlas_put(f, title);
    fputs("</h1>\n<p>", f);
    koksma__atlas_put(f, about);
    fprintf(f, "</p>\n<p class=\"csv\">koksma %s%s</p>\n<dl>\n", koksma_version(),
            a->options->quick ? ", built with --quick: fewer trials, wider intervals" : "");
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < a->n_pages; i++) {
        status = write_page(a, &a->pages[i], f);
    }
    fputs("</dl>\n", f);
    if (a->n_sheets) {
        put_sheets(f, a);
    }
    fputs("</main>\n</body>\n</html>\n", f);
    *written = a->n_pages + 1;
    return koksma__atlas_close(f, a->options->folder, "index.html", &text, status);
}
