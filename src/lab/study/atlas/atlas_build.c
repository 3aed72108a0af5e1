/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Builds the atlas: lists the commands of all questions and datasheets, runs those whose results the folder lacks, and
 * has the pages written (atlas_page.c). A result is a file named by the digest of what it depends on: the command, the
 * version, the revisions of the members of tables that the command names, and the commands before it in its question that
 * write files. So a second build runs nothing, and a new pattern runs its datasheet alone. Every rank of an MPI run walks
 * all jobs from another start and leaves out those that have a result by then; no messages are needed.
 *
 * Commands run in the folder files/, so that one may read what another wrote, by a shell that lets exit code 1 (the answer
 * is no) pass and hides a launcher of MPI from the program.
 */
#include "study/atlas/atlas.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/datasheet.h>
#include <koksma/image.h>
#include <koksma/integrate.h>
#include <koksma/warp.h>

#include "core/files.h"
#include "core/platform/processes.h"
#include "study/plan/made_by.h"
#include "study/run/mpi.h"

#include "study/atlas/questions.h"

enum { MAX_PAGES = 64, MAX_WORDS = 200, COMMAND = 4096, MAX_RESULT = 1 << 26, MAX_SECONDS = 86400 };

/* ---- What a result depends on ---------------------------------------------------------------------------------- */

static void add_text(koksma__sha256 *hash, const char *text)
{
    koksma__sha256_add(hash, text, strlen(text) + 1);
}

static void add_revision(koksma__sha256 *hash, const char *name, int revision)
{
    char text[KOKSMA_MAX_SPEC + 16];
    snprintf(text, sizeof text, "%s %d", name, revision);
    add_text(hash, text);
}

/* Adds the revision of the pattern, measure, integrand, metric or warp of this name, if there is one. */
static void add_member(koksma__sha256 *hash, const char *name)
{
    const koksma_pattern *pattern = koksma_pattern_find(name);
    const koksma_measure *measure = koksma_measure_find(name);
    const koksma_integrand *integrand = koksma_integrand_find(name);
    const koksma_metric *metric = koksma_metric_find(name);
    const koksma_warp *warp = koksma_warp_find(name);
    if (pattern || measure || integrand || metric || warp) {
        add_revision(hash, name,
                     pattern     ? pattern->revision
                     : measure   ? measure->revision
                     : integrand ? integrand->revision
                     : metric    ? metric->revision
                                 : warp->revision);
    }
}

static void add_all_measures(koksma__sha256 *hash)
{
    for (size_t i = 0; koksma_measure_at(i); i++) {
        add_member(hash, koksma_measure_at(i)->name);
    }
    for (size_t i = 0; koksma_integrand_at(i); i++) {
        add_member(hash, koksma_integrand_at(i)->name);
    }
}

/* chain: the digest of the command before it that writes a file, or "". It becomes that of this one if this one does. */
static void find_digest(const char *command, const char *chain, char digest[KOKSMA__SHA256_TEXT])
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789-";
    koksma__sha256 hash;
    char word[KOKSMA_MAX_SPEC];
    koksma__sha256_init(&hash);
    add_text(&hash, koksma_version());
    add_text(&hash, command);
    add_text(&hash, chain);
    add_revision(&hash, "renderer", KOKSMA__RENDERER_REVISION);
    for (const char *at = command; *at;) {
        const size_t length = strspn(at, letters);
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        add_member(&hash, word);
        at += length ? length : 1;
    }
    if (strstr(command, " datasheet ")) { /* which measures everything, and compares with these by default */
        add_all_measures(&hash);
        add_member(&hash, "random");
        add_member(&hash, "jittered");
        add_member(&hash, "sobol");
        add_member(&hash, "mae");
    }
    koksma__sha256_finish(&hash, digest);
}

/* ---- The list of commands -------------------------------------------------------------------------------------- */

/* Copies a command with the quick or full part of each {quick|full}, and a pattern in place of {pattern}. Returns false if
   it is too long. */
static bool choose(const char *text, bool quick, const char *pattern, char out[COMMAND])
{
    size_t used = 0;
    while (*text && used < COMMAND) {
        const char *end = *text == '{' ? strchr(text, '}') : NULL;
        const char *bar = end ? memchr(text, '|', (size_t)(end - text)) : NULL;
        if (bar) {
            used += (size_t)snprintf(out + used, COMMAND - used, "%.*s",
                                     (int)(quick ? bar - text - 1 : end - bar - 1), quick ? text + 1 : bar + 1);
        } else if (end) {
            used += (size_t)snprintf(out + used, COMMAND - used, "%s", pattern);
        } else {
            out[used++] = *text;
        }
        text = end ? end + 1 : text + 1;
    }
    if (used < COMMAND) {
        out[used] = '\0';
    }
    return used < COMMAND;
}

/* Cuts a command into words at blanks, in place; single quotes hold a word together. Returns their number; 0: too many. */
static size_t cut_words(char *text, char *words[MAX_WORDS])
{
    size_t n = 0;
    while (*(text += strspn(text, " ")) && n < MAX_WORDS) {
        const bool quoted = *text == '\'';
        words[n++] = text += quoted;
        text += strcspn(text, quoted ? "'" : " ");
        if (*text) {
            *text++ = '\0';
        }
    }
    return *text ? 0 : n;
}

/* Whether a text can be part of a file's name and of a link as it is. */
static bool is_name(const char *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
    return *text && *text != '.' && !text[strspn(text, letters)];
}

static koksma_status add_job(koksma__atlas *a, const koksma__json_node *node, const char *text, const char *pattern,
                             const char *folder, char chain[KOKSMA__SHA256_TEXT])
{
    char command[COMMAND], digest[KOKSMA__SHA256_TEXT];
    koksma__atlas_job *job = &a->jobs[a->n_jobs];
    KOKSMA__JSON_FAIL_IF(!job->stored && strncmp(text, "koksma ", 7) != 0, node, "a command begins with 'koksma '");
    KOKSMA__JSON_FAIL_IF(!choose(text, a->options->quick, pattern, command), node, "the command is too long");
    find_digest(job->stored ? job->stored : command, chain, digest);
    const char *output = strstr(command, " -o ");
    job->command = strdup(command);
    KOKSMA__REQUIRE_MEMORY(job->command, strlen(command));
    a->n_jobs++;
    if (output) {
        job->output = job->command + (output - command) + 4;
        KOKSMA__JSON_FAIL_IF(!is_name(job->output), node,
                             "-o FILE ends the command, and FILE is a name without folders");
        snprintf(chain, KOKSMA__SHA256_TEXT, "%s", digest);
    }
    snprintf(job->file, sizeof job->file, *pattern ? "%s/%s-%.16s.html" : "%s/%s%.32s.json", folder, pattern, digest);
    return KOKSMA_OK;
}

static koksma_status add_page(koksma__atlas *a, const koksma__json_node *list, size_t i, bool numbered)
{
    koksma__json_node runs;
    size_t n, size;
    char chain[KOKSMA__SHA256_TEXT] = "";
    koksma__atlas_page *page = &a->pages[a->n_pages++];
    page->node = koksma__json_item(list, i);
    page->number = numbered ? i + 1 : 0;
    page->jobs = &a->jobs[a->n_jobs];
    KOKSMA__TRY(koksma__json_get_text(&page->node, "id", true, &page->id));
    KOKSMA__TRY(koksma__json_get_text(&page->node, "title", true, &page->title));
    KOKSMA__JSON_FAIL_IF(!is_name(page->id), &page->node,
                         "id: it has letters, digits, '-', '_' and '.', such as any-n");
    KOKSMA__TRY(koksma__json_member(&page->node, "runs", &runs));
    KOKSMA__TRY(koksma__json_length(&runs, KOKSMA__ATLAS_PAGE_JOBS, &n));
    for (size_t k = 0; k < n; k++) {
        const koksma__json_node node = koksma__json_item(&runs, k);
        const char *command, *rows = NULL;
        KOKSMA__TRY(koksma__json_get_text(&node, "command", true, &command));
        KOKSMA__TRY(koksma__json_get_text(&node, "rows", false, &rows));
        a->jobs[a->n_jobs].stored = rows ? koksma__atlas_text(rows, &size) : NULL;
        KOKSMA__JSON_FAIL_IF(rows && !a->jobs[a->n_jobs].stored, &node, "rows: the library has no rows '%s'", rows);
        KOKSMA__TRY(koksma__json_get_text(&node, "id", true, &a->jobs[a->n_jobs].id));
        KOKSMA__JSON_FAIL_IF(!is_name(a->jobs[a->n_jobs].id), &node, "id: it has letters, digits, '-', '_' and '.'");
        KOKSMA__TRY(add_job(a, &node, command, "", "rows", chain));
        page->n_jobs++;
    }
    return KOKSMA_OK;
}

static koksma_status add_pages(koksma__atlas *a, const char *key, bool numbered)
{
    const koksma__json_node root = koksma__json_root(a->document);
    koksma__json_node list;
    size_t n;
    KOKSMA__TRY(koksma__atlas_list(&root, key, MAX_PAGES, &list, &n));
    for (size_t i = 0; i < n; i++) {
        KOKSMA__TRY(add_page(a, &list, i, numbered));
    }
    return KOKSMA_OK;
}

/* A datasheet for each pattern that needs no file and no code of others. */
static koksma_status add_sheets(koksma__atlas *a)
{
    const koksma__json_node root = koksma__json_root(a->document);
    koksma__json_node slow;
    const char *command = NULL;
    const koksma_pattern *pattern;
    const bool has_slow = a->options->quick && koksma__json_has(&root, "slow");
    KOKSMA__TRY(koksma__json_get_text(&root, "sheets", false, &command));
    KOKSMA__TRY(has_slow ? koksma__json_member(&root, "slow", &slow) : KOKSMA_OK);
    for (size_t i = 0; command && (pattern = koksma_pattern_at(i)); i++) {
        char chain[KOKSMA__SHA256_TEXT] = "";
        if (!pattern->operand) {
            const char *reason = NULL;
            a->jobs[a->n_jobs].id = pattern->name;
            KOKSMA__TRY(has_slow ? koksma__json_get_text(&slow, pattern->name, false, &reason) : KOKSMA_OK);
            KOKSMA__TRY(add_job(a, &root, command, pattern->name, "sheets", chain));
            if (reason) {
                snprintf(a->jobs[a->n_jobs - 1].failure, sizeof a->jobs[0].failure,
                         "%s; a build without --quick has it", reason);
            }
            a->n_sheets++;
        }
    }
    return KOKSMA_OK;
}

static koksma_status read_questions(koksma__atlas *a)
{
    static const char *const keys[] = {"title", "text", "notes", "questions", "pages", "sheets", "slow", NULL};
    const char *path = a->options->questions, *text = koksma__atlas_questions;
    unsigned char *bytes = NULL;
    size_t size = sizeof koksma__atlas_questions - 1, n_jobs = 2 * MAX_PAGES * KOKSMA__ATLAS_PAGE_JOBS;
    if (path) {
        KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_PLAN, KOKSMA__BY_USER, koksma__check_text, &bytes, &size));
        text = (const char *)bytes;
    }
    koksma_status status = koksma__json_open("questions", path ? path : "atlas", text, size, &a->document);
    free(bytes);
    KOKSMA__TRY(status);
    const koksma__json_node root = koksma__json_root(a->document);
    KOKSMA__TRY(koksma__json_only(&root, keys));
    for (size_t i = 0; koksma_pattern_at(i); i++) {
        n_jobs++;
    }
    a->pages = calloc(2 * MAX_PAGES, sizeof *a->pages);
    a->jobs = calloc(n_jobs, sizeof *a->jobs);
    KOKSMA__REQUIRE_MEMORY(a->pages && a->jobs ? a : NULL, n_jobs * sizeof *a->jobs);
    KOKSMA__TRY(add_pages(a, "questions", true));
    KOKSMA__TRY(add_pages(a, "pages", false));
    return add_sheets(a);
}

/* ---- Running them ---------------------------------------------------------------------------------------------- */

static bool is_below(const char *folder, const char *part, const char *name)
{
    char below[KOKSMA__MAX_PATH];
    snprintf(below, sizeof below, "%s%s", part, name);
    char *path = koksma__path_below(folder, below);
    const bool is = path && !access(path, R_OK);
    free(path);
    return is;
}

/* The program's own words, then its threads, then NULL. */
static size_t put_arguments(const koksma__atlas *a, char *command, char *files, char threads[32], char **arguments)
{
    static char shell[] = "/bin/sh", option[] = "-c",
                script[] = "cd \"$0\" && unset OMPI_COMM_WORLD_SIZE PMI_SIZE PMIX_RANK && \"$@\" || [ $? -eq 1 ]";
    char *const head[] = {shell, option, script, files};
    const size_t n_head = sizeof head / sizeof *head, n = cut_words(command, arguments + n_head);
    memcpy(arguments, head, sizeof head);
    if (n < 2) {
        return 0;
    }
    union {
        const char *text;
        char *word;
    } program = {a->options->program};
    arguments[n_head] = program.word;
    arguments[n_head + n] = *threads && strcmp(arguments[n_head + 1], "list") != 0 ? threads : NULL;
    arguments[n_head + n + 1] = NULL;
    return n;
}

static koksma_status run_command(const koksma__atlas *a, const koksma__atlas_job *job, const koksma_run *run,
                                 char **output, size_t *size)
{
    char command[COMMAND], threads[32] = "", *arguments[MAX_WORDS + 8];
    char *files = koksma__path_below(a->options->folder, "files");
    KOKSMA__REQUIRE_MEMORY(files, strlen(a->options->folder));
    if (run && run->threads) {
        snprintf(threads, sizeof threads, "--threads=%d", run->threads);
    }
    snprintf(command, sizeof command, "%s", job->command);
    const koksma__child child = {.name = job->command,
                                 .arguments = arguments,
                                 .seconds = MAX_SECONDS,
                                 .most_output = MAX_RESULT,
                                 .most_memory = UINT64_MAX};
    const koksma_status status = put_arguments(a, command, files, threads, arguments)
                                     ? koksma__child_run(&child, run, output, size)
                                     : koksma__fail(KOKSMA_MALFORMED, "%.200s: too many words", job->command);
    free(files);
    KOKSMA__TRY(status);
    char *text = realloc(*output, *size + 1); /* as it has no zero at its end */
    if (!text) {
        free(*output);
        *output = NULL;
        return koksma__fail_memory(*size + 1);
    }
    text[*size] = '\0';
    *output = text;
    return KOKSMA_OK;
}

static koksma_status do_job(const koksma__atlas *a, koksma__atlas_job *job, bool is_sheet, const koksma_run *run,
                            koksma_atlas_summary *summary)
{
    const char *folder = a->options->folder;
    char *text = NULL, *page = NULL;
    size_t size = 0;
    if (is_below(folder, "", job->file) && (!job->output || is_below(folder, "files/", job->output))) {
        summary->kept++;
        return KOKSMA_OK;
    }
    if (job->stored) {
        summary->kept++;
        return koksma__atomic_put(folder, job->file, job->stored, strlen(job->stored));
    }
    if (*job->failure) {
        summary->failed++;
        return KOKSMA_OK;
    }
    koksma_status status = run_command(a, job, run, &text, &size);
    if (is_sheet && status && status != KOKSMA_INTERRUPTED && status != KOKSMA_MEMORY && status != KOKSMA_MISSING) {
        const char *text_of_program = strstr(koksma_error_text(), ": koksma datasheet: ");
        snprintf(job->failure, sizeof job->failure, "%s",
                 text_of_program ? text_of_program + sizeof ": koksma datasheet: " - 1 : koksma_error_text());
        summary->failed++;
        return KOKSMA_OK;
    }
    if (!status && is_sheet) {
        status = koksma_datasheet_page(text, &page);
        size = page ? strlen(page) : 0;
    }
    status = status ? status : koksma__atomic_put(folder, job->file, page ? page : text, size);
    free(page);
    free(text);
    summary->computed += !status;
    return status;
}

static koksma_status do_jobs(const koksma__atlas *a, const koksma_run *run, koksma_atlas_summary *summary)
{
    const koksma__mpi *mpi = koksma__mpi_get();
    const size_t first = a->n_jobs * (size_t)mpi->rank / (size_t)mpi->size;
    koksma_status status = KOKSMA_OK;
    for (size_t k = 0; !status && k < a->n_jobs; k++) {
        const size_t i = (first + k) % a->n_jobs;
        if (run && run->keep_going && !run->keep_going(run->context, (double)k / (double)a->n_jobs)) {
            return koksma__fail(KOKSMA_INTERRUPTED, "interrupted; finished results are kept");
        }
        status = do_job(a, &a->jobs[i], i >= a->n_jobs - a->n_sheets, run, summary);
    }
    return status;
}

static koksma_status make_folders(const char *folder)
{
    static const char *const below[] = {"rows", "sheets", "files", "docs"};
    KOKSMA__TRY(koksma__atomic_folder(folder));
    for (size_t i = 0; i < sizeof below / sizeof *below; i++) {
        char *path = koksma__path_below(folder, below[i]);
        KOKSMA__REQUIRE_MEMORY(path, strlen(folder));
        const koksma_status status = koksma__atomic_folder(path);
        free(path);
        KOKSMA__TRY(status);
    }
    return KOKSMA_OK;
}

koksma_status koksma_atlas_build(const koksma_atlas_options *options, const koksma_run *run,
                                 koksma_atlas_summary *summary)
{
    KOKSMA__REQUIRE(options, summary);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!options->folder || !*options->folder, KOKSMA_ARGUMENT,
                    "folder: it must be the path of a folder");
    KOKSMA__FAIL_IF(!options->program || *options->program != '/', KOKSMA_ARGUMENT,
                    "program: it must be the absolute path of the koksma program");
    koksma__atlas a = {.options = options};
    *summary = (koksma_atlas_summary){0};
    koksma_status status = koksma__mpi_check();
    status = status ? status : read_questions(&a);
    status = status ? status : make_folders(options->folder);
    status = status ? status : do_jobs(&a, run, summary);
    if (!status && !koksma__mpi_get()->rank) {
        koksma__mpi_release();
        status = koksma__atlas_write(&a, &summary->pages);
    }
    for (size_t i = 0; i < a.n_jobs; i++) {
        free(a.jobs[i].command);
    }
    free(a.jobs);
    free(a.pages);
    koksma__json_close(a.document);
    return status;
}
