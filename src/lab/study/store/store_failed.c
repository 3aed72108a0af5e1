/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The list of failed jobs in a store, and its form for readers. The store has a text "failed" with one line for each task
 * that has failed jobs: label, n, number of failed trials, number of trials and reason, separated by tabs. For readers,
 * lines of equal label become one: "poisson-disk:d=0.3, N = 64 (100 of 100 trials), 256 (100 of 100 trials):
 * reason". Lines of equal n as well, which have different reasons, remain several. The text "left-out" has the lines on
 * the plan's blocks with `skip`, followed by these.
 */
#define _GNU_SOURCE /* tdestroy */
#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/store/store.h"

static const char failed_key[] = "failed", left_out_key[] = "left-out";

/* ---- Lines ---------------------------------------------------------------------------------------------- */

/* The fields of a line of the text "failed". Lines are found by trees of tsearch(3), because a damaged store, or a plan of
   100 KB, may have any number of them. */
typedef struct fields {
    const char *label, *reason;
    int label_length;
    long long n, failed, trials;
    size_t count; /* in a tree: the number of lines that compare as equal so far; or the rank of a line for readers */
    FILE *line;   /* a line for readers, and its text */
    char *text;
    size_t size;
} fields;

static bool read_line(const char *line, fields *out)
{
    int at = 0;
    *out = (fields){.label = line, .label_length = (int)strcspn(line, "\t")};
    const char *numbers = line + out->label_length;
    if (sscanf(numbers, "\t%lld\t%lld\t%lld%n", &out->n, &out->failed, &out->trials, &at) != 3 ||
        numbers[at] != '\t') {
        return false;
    }
    out->reason = numbers + at + 1;
    return true;
}

static int compare_labels(const fields *x, const fields *y)
{
    const int shorter = x->label_length < y->label_length ? x->label_length : y->label_length;
    const int order = memcmp(x->label, y->label, (size_t)shorter);
    return order ? order : (x->label_length > y->label_length) - (x->label_length < y->label_length);
}

static int by_n(const void *a, const void *b)
{
    const fields *x = a, *y = b;
    return x->n != y->n ? (x->n > y->n) - (x->n < y->n) : compare_labels(x, y);
}

static int by_reason(const void *a, const void *b)
{
    const int order = by_n(a, b);
    return order ? order : strcmp(((const fields *)a)->reason, ((const fields *)b)->reason);
}

static int by_rank(const void *a, const void *b)
{
    const fields *x = a, *y = b;
    return x->count != y->count ? (x->count > y->count) - (x->count < y->count) : compare_labels(x, y);
}

/* Finds the entry of a tree that compares as equal; adds a copy if there is none. Returns NULL if no memory is left. */
static fields *enter(void **tree, const fields *wanted, int (*compare)(const void *, const void *))
{
    fields *const *found = tfind(wanted, tree, compare);
    if (found) {
        return *found;
    }
    fields *added = malloc(sizeof *added);
    if (added) {
        *added = *wanted;
        added->count = 0;
        added->failed = -1;
    }
    if (added && !tsearch(added, tree, compare)) {
        free(added);
        added = NULL;
    }
    return added;
}

/* ---- The list for readers ------------------------------------------------------------------------------ */

/* Appends a text as one line of UTF-8: a pattern may name a file whose name has control characters. */
static koksma_status add_line(koksma__texts *lines, const char *text)
{
    const size_t size = 4 * strlen(text) + 1;
    char *line = malloc(size);
    KOKSMA__REQUIRE_MEMORY(line, size);
    strcpy(line, text);
    koksma_text_escape(line, size);
    const koksma_status status = koksma__texts_add(lines, line);
    free(line);
    return status;
}

/* A line for readers has one task for each label and n: the first of them, or that of the next rank, whose reason is
   another. It has the reason of its first task. */
static koksma_status show_task(void **tasks, void **lines, fields *task, fields ***order, size_t *n)
{
    fields *same_n = enter(tasks, task, by_n);
    KOKSMA__REQUIRE_MEMORY(same_n, sizeof *same_n);
    fields wanted = *task;
    wanted.count = same_n->count++;
    fields *const *found = tfind(&wanted, lines, by_rank);
    fields *line = found ? *found : malloc(sizeof *line);
    if (line && !found) {
        *line = wanted;
        line->line = open_memstream(&line->text, &line->size);
        fields **at = line->line && tsearch(line, lines, by_rank) ? koksma__add_one(order, n, sizeof *at) : NULL;
        KOKSMA__REQUIRE_MEMORY(at, sizeof *line);
        *at = line;
        fprintf(line->line, "%.*s, N =", task->label_length, task->label);
    }
    KOKSMA__REQUIRE_MEMORY(line, sizeof *line);
    fprintf(line->line, "%s %lld (%lld of %lld trial%s)", found ? "," : "", task->n, task->failed, task->trials,
            task->trials == 1 ? "" : "s");
    return KOKSMA_OK;
}

koksma_status koksma__left_out_show(const koksma__texts *stored, koksma__texts *lines)
{
    void *tasks = NULL, *tree = NULL;
    fields **order = NULL, task;
    size_t n = 0;
    koksma_status status = KOKSMA_OK;
    koksma__texts_fini(lines);
    for (size_t i = 0; !status && i < stored->n; i++) {
        status = read_line(stored->at[i], &task) ? show_task(&tasks, &tree, &task, &order, &n) : KOKSMA_OK;
    }
    for (size_t i = 0; i < n; i++) {
        fprintf(order[i]->line, ": %s", order[i]->reason);
        const bool whole = !fclose(order[i]->line);
        status = status ? status : whole ? add_line(lines, order[i]->text) : koksma__fail_memory(order[i]->size);
        free(order[i]->text);
    }
    tdestroy(tasks, free);
    tdestroy(tree, free);
    free(order);
    return status;
}

/* ---- Lines that others make superfluous ---------------------------------------------------------------- */

koksma_status koksma__left_out_thin(koksma__texts *lines)
{
    void *tree = NULL;
    fields task;
    size_t left = 0;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < lines->n; i++) {
        const bool is_line = read_line(lines->at[i], &task);
        fields *most = is_line ? enter(&tree, &task, by_reason) : NULL;
        if (most && most->failed < task.failed) {
            most->failed = task.failed;
            lines->at[left++] = lines->at[i];
        } else {
            free(lines->at[i]);
            status = most || !is_line ? status : koksma__fail_memory(sizeof *most);
        }
    }
    lines->n = left;
    tdestroy(tree, free);
    return status;
}

koksma_status koksma__left_out_add(const koksma__texts *lines, const koksma__texts *known, koksma__texts *to)
{
    void *tree = NULL;
    fields task;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < known->n; i++) {
        if (read_line(known->at[i], &task)) {
            fields *most = enter(&tree, &task, by_n);
            status = most ? KOKSMA_OK : koksma__fail_memory(sizeof *most);
            if (most && most->failed < task.failed) {
                most->failed = task.failed;
            }
        }
    }
    for (size_t i = 0; !status && i < lines->n; i++) {
        const bool is_line = read_line(lines->at[i], &task);
        fields *const *found = is_line ? tfind(&task, &tree, by_n) : NULL;
        status =
            is_line && (!found || (*found)->failed < task.failed) ? koksma__texts_add(to, lines->at[i]) : KOKSMA_OK;
    }
    tdestroy(tree, free);
    return status;
}

/* ---- The store ----------------------------------------------------------------------------------------- */

/* Reads a text of the store and passes each of its lines to `add`. */
static koksma_status each_line(koksma__store *store, const char *key, koksma__texts *lines,
                               koksma_status (*add)(koksma__texts *lines, const char *line))
{
    char *text = NULL;
    koksma_status status = koksma__store_get_text(store, key, &text);
    for (char *line = text; !status && line && *line;) {
        const size_t length = strcspn(line, "\n");
        const bool last = !line[length];
        line[length] = '\0';
        status = add(lines, line);
        line += length + !last;
    }
    free(text);
    return status;
}

koksma_status koksma__left_out_recall(koksma__store *store, koksma__texts *stored)
{
    return each_line(store, failed_key, stored, koksma__texts_add);
}

koksma_status koksma__left_out_count(koksma__store *store, size_t *trials)
{
    koksma__texts stored = {0};
    fields task;
    const koksma_status status = koksma__left_out_recall(store, &stored);
    *trials = 0;
    for (size_t i = 0; !status && i < stored.n; i++) {
        *trials += read_line(stored.at[i], &task) && task.failed > 0 ? (size_t)task.failed : 0;
    }
    koksma__texts_fini(&stored);
    return status;
}

/* Writes a text into the store unless its present value is the same; a missing text counts as empty. */
static koksma_status set_text(koksma__store *store, const char *key, const char *value)
{
    char *before = NULL;
    KOKSMA__TRY(koksma__store_get_text(store, key, &before));
    const bool same = !strcmp(before ? before : "", value);
    free(before);
    return same ? KOKSMA_OK : koksma__store_set_text(store, key, value);
}

/* Joins the lines; each ends with a newline. The caller frees *text, also after an error. */
static koksma_status join(const koksma__texts *lines, char **text)
{
    size_t size = 0;
    *text = NULL;
    FILE *f = open_memstream(text, &size);
    KOKSMA__REQUIRE_MEMORY(f, 1);
    for (size_t i = 0; i < lines->n; i++) {
        fprintf(f, "%s\n", lines->at[i]);
    }
    return fclose(f) ? koksma__fail_memory(size) : KOKSMA_OK;
}

/* Writes the lines into the store as one text. */
static koksma_status set_lines(koksma__store *store, const char *key, const koksma__texts *lines)
{
    char *text;
    koksma_status status = join(lines, &text);
    status = status ? status : set_text(store, key, text);
    free(text);
    return status;
}

koksma_status koksma__left_out_record(koksma__store *store, const koksma__texts *stored, const koksma__texts *lines)
{
    const koksma_status status = set_lines(store, failed_key, stored);
    return status ? status : set_lines(store, left_out_key, lines);
}

koksma_status koksma__left_out_text(koksma__store *store, char **lines)
{
    koksma__texts of = {0};
    koksma_status status = each_line(store, left_out_key, &of, add_line);
    *lines = NULL;
    status = status ? status : join(&of, lines);
    koksma__texts_fini(&of);
    if (status) {
        free(*lines);
        *lines = NULL;
    }
    return status;
}
