/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The list of failed jobs in a store, and its form for readers. The store has a text "failed" with one line for each task
 * that has failed jobs: label, n, number of failed trials, number of trials and reason, separated by tabs. For readers,
 * lines of equal label become one: "poisson-disk:d=0.3, N = 64 (100 of 100 trials), 256 (100 of 100 trials):
 * reason". Lines of equal n as well, which have different reasons, remain several. The text "left-out" has the lines on
 * the plan's blocks with `skip`, followed by these.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/store/store.h"

static const char failed_key[] = "failed", left_out_key[] = "left-out";

/* ---- The list for readers ------------------------------------------------------------------------------ */

/* The fields of a line of the text "failed". */
typedef struct fields {
    const char *label, *reason;
    int label_length;
    long long n, failed, trials;
    size_t place; /* among the lines that were read */
    size_t rank;  /* number of earlier lines of equal label and n */
} fields;

static bool read_line(const char *line, fields *out)
{
    int at = 0;
    out->label = line;
    out->label_length = (int)strcspn(line, "\t");
    const char *numbers = line + out->label_length;
    if (sscanf(numbers, "\t%lld\t%lld\t%lld%n", &out->n, &out->failed, &out->trials, &at) != 3 ||
        numbers[at] != '\t') {
        return false;
    }
    out->reason = numbers + at + 1;
    return true;
}

static bool same_label(const fields *a, const fields *b)
{
    return a->label_length == b->label_length && !strncmp(a->label, b->label, (size_t)a->label_length);
}

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

static int compare_labels(const fields *x, const fields *y)
{
    const int shorter = x->label_length < y->label_length ? x->label_length : y->label_length;
    const int order = memcmp(x->label, y->label, (size_t)shorter);
    return order ? order : (x->label_length > y->label_length) - (x->label_length < y->label_length);
}

static int by_place(const fields *x, const fields *y)
{
    return (x->place > y->place) - (x->place < y->place);
}

static int compare_label_and_n(const fields *x, const fields *y)
{
    const int order = compare_labels(x, y);
    return order ? order : (x->n > y->n) - (x->n < y->n);
}

/* By label, n and place. */
static int compare_tasks(const void *a, const void *b)
{
    const int order = compare_label_and_n(a, b);
    return order ? order : by_place(a, b);
}

/* By label, rank and place. */
static int compare_ranks(const void *a, const void *b)
{
    const fields *x = a, *y = b;
    const int order = compare_labels(x, y);
    return order ? order : x->rank != y->rank ? (x->rank > y->rank) - (x->rank < y->rank) : by_place(x, y);
}

/* Sorts the tasks by label, rank and place; sets the ranks. */
static void sort(fields *tasks, size_t n)
{
    qsort(tasks, n, sizeof *tasks, compare_tasks);
    for (size_t i = 1; i < n; i++) {
        const bool again = same_label(&tasks[i - 1], &tasks[i]) && tasks[i - 1].n == tasks[i].n;
        tasks[i].rank = again ? tasks[i - 1].rank + 1 : 0;
    }
    qsort(tasks, n, sizeof *tasks, compare_ranks);
}

static bool same_line(const fields *a, const fields *b)
{
    return same_label(a, b) && a->rank == b->rank;
}

/* Appends to `lines` one line for the n tasks of one label and rank. */
static koksma_status show(const fields *tasks, size_t n, koksma__texts *lines)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    KOKSMA__REQUIRE_MEMORY(f, 1);
    fprintf(f, "%.*s, N =", tasks->label_length, tasks->label);
    for (size_t i = 0; i < n; i++) {
        fprintf(f, "%s %lld (%lld of %lld trial%s)", i ? "," : "", tasks[i].n, tasks[i].failed, tasks[i].trials,
                tasks[i].trials == 1 ? "" : "s");
    }
    fprintf(f, ": %s", tasks->reason);
    koksma_status status = fclose(f) ? koksma__fail_memory(size) : KOKSMA_OK;
    status = status ? status : add_line(lines, text);
    free(text);
    return status;
}

/* Makes the readers' lines of the store's lines: one for each label and rank, in the order of their first tasks. The
   tasks are sorted, because a damaged store may have any number of labels. */
koksma_status koksma__left_out_show(const koksma__texts *stored, koksma__texts *lines)
{
    fields *tasks = calloc(stored->n + 1, sizeof *tasks);
    size_t *sorted = calloc(stored->n + 1, sizeof *sorted);
    koksma_status status = tasks && sorted ? KOKSMA_OK : koksma__fail_memory(stored->n * sizeof *tasks);
    size_t n = 0;
    koksma__texts_fini(lines);
    for (size_t i = 0; !status && i < stored->n; i++) {
        tasks[n].place = n;
        n += read_line(stored->at[i], &tasks[n]);
    }
    if (n) {
        sort(tasks, n);
    }
    for (size_t i = 0; i < n; i++) {
        sorted[tasks[i].place] = i;
    }
    for (size_t i = 0; !status && i < n; i++) {
        const size_t first = sorted[i];
        size_t end = first + 1;
        if (first && same_line(&tasks[first - 1], &tasks[first])) {
            continue; /* it is on the line of an earlier one */
        }
        while (end < n && same_line(&tasks[first], &tasks[end])) {
            end++;
        }
        status = show(tasks + first, end - first, lines);
    }
    KOKSMA__FREE(tasks, sorted);
    return status;
}

/* ---- Lines that others make superfluous ---------------------------------------------------------------- */

/* A plan of 100 KB may have thousands of failed jobs, so that lines are sorted and not compared one by one. */

/* By label, n, reason and place. */
static int compare_reasons(const void *a, const void *b)
{
    const fields *x = a, *y = b;
    const int task = compare_label_and_n(x, y), order = task ? task : strcmp(x->reason, y->reason);
    return order ? order : by_place(x, y);
}

/* By label and n, then the most failed trials first. */
static int compare_failed(const void *a, const void *b)
{
    const fields *x = a, *y = b;
    const int task = compare_label_and_n(x, y);
    return task ? task : (x->failed < y->failed) - (x->failed > y->failed);
}

/* Reads the lines and sorts them; leaves out texts that are no line. The caller frees *sorted. */
static koksma_status read_sorted(const koksma__texts *lines, int (*compare)(const void *, const void *),
                                 fields **sorted, size_t *n)
{
    *n = 0;
    *sorted = calloc(lines->n + 1, sizeof **sorted);
    KOKSMA__REQUIRE_MEMORY(*sorted, (lines->n + 1) * sizeof **sorted);
    for (size_t i = 0; i < lines->n; i++) {
        (*sorted)[*n].place = i;
        *n += read_line(lines->at[i], &(*sorted)[*n]);
    }
    qsort(*sorted, *n, sizeof **sorted, compare);
    return KOKSMA_OK;
}

koksma_status koksma__left_out_thin(koksma__texts *lines)
{
    fields *sorted;
    size_t n, left = 0;
    long long most = 0;
    bool *keeps = calloc(lines->n + 1, sizeof *keeps);
    KOKSMA__REQUIRE_MEMORY(keeps, lines->n + 1);
    const koksma_status status = read_sorted(lines, compare_reasons, &sorted, &n);
    for (size_t i = 0; !status && i < n; i++) {
        const bool again =
            i && !compare_label_and_n(&sorted[i - 1], &sorted[i]) && !strcmp(sorted[i - 1].reason, sorted[i].reason);
        keeps[sorted[i].place] = !again || sorted[i].failed > most;
        most = keeps[sorted[i].place] ? sorted[i].failed : most;
    }
    for (size_t i = 0; !status && i < lines->n; i++) {
        if (keeps[i]) {
            lines->at[left++] = lines->at[i];
        } else {
            free(lines->at[i]);
        }
    }
    lines->n = status ? lines->n : left;
    KOKSMA__FREE(sorted, keeps);
    return status;
}

/* Whether `sorted`, in the order of compare_failed, has a line of equal label and n with at least as many failed trials. */
static bool knows(const fields *sorted, size_t n, const fields *task)
{
    size_t low = 0;
    for (size_t high = n; low < high;) { /* the first line of this label and n, or a later one's */
        const size_t middle = low + (high - low) / 2;
        if (compare_label_and_n(&sorted[middle], task) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < n && !compare_label_and_n(&sorted[low], task) && sorted[low].failed >= task->failed;
}

koksma_status koksma__left_out_add(const koksma__texts *lines, const koksma__texts *known, koksma__texts *to)
{
    fields *sorted, task;
    size_t n;
    koksma_status status = read_sorted(known, compare_failed, &sorted, &n);
    for (size_t i = 0; !status && i < lines->n; i++) {
        if (read_line(lines->at[i], &task) && !knows(sorted, n, &task)) {
            status = koksma__texts_add(to, lines->at[i]);
        }
    }
    free(sorted);
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
