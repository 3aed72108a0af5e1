/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs another renderer, or what processes images, by a command line (koksma_rank_by_command). Every picture has its own
 * temporary directory, so that the program may write other files beside the picture. The shell leads a process group of
 * its own (core/platform/processes.h), so that a stop kills all processes that it started. What the command prints goes
 * to standard error, of which the last line is part of the error message if the command fails.
 */
#include <koksma/study.h>

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/platform/processes.h"
#include "core/status.h"

enum { LONGEST = 1 << 16 };

enum { OUT = 6, FORMATS = 3, N_WORDS = OUT + FORMATS };

/* The placeholders of a command. The last FORMATS are names of the file to write. */
typedef struct placeholders {
    const char *words[N_WORDS + 1];
    int n;
    const char *known;
} placeholders;

static const placeholders of_renderer = {
    {"scene", "pattern", "spp", "seed", "width", "height", "out", "out.pfm", "out.png"},
    N_WORDS,
    "{scene}, {pattern}, {spp}, {seed}, {width}, {height} and {out}, {out.pfm} or {out.png}"};
static const placeholders of_process = {{"in", "in.pfm", "in.png", "out", "out.pfm", "out.png"},
                                        2 * FORMATS,
                                        "{in}, {in.pfm} or {in.png} and {out}, {out.pfm} or {out.png}"};

static const char *const endings[FORMATS] = {"exr", "pfm", "png"};

/* ---- The command ---------------------------------------------------------------------------------------- */

/* Appends a text in single quotes, within which only the quote is special to the shell. Returns false if the command
   has no room for it. */
static bool append_quoted(char *command, size_t *length, const char *text)
{
    command[(*length)++] = '\'';
    for (; *text && *length < LONGEST - 8; text++) {
        const char *piece = *text == '\'' ? "'\\''" : (char[]){*text, 0};
        memcpy(command + *length, piece, strlen(piece));
        *length += strlen(piece);
    }
    command[(*length)++] = '\'';
    return !*text;
}

/* Index of the placeholder in braces that begins at `text`; N_WORDS: no placeholder begins here (as in
   ${HOME}, {1..3}, { ls; }); -1: an unknown placeholder. */
static int word_at(const placeholders *p, const char *template, const char *text, size_t *length)
{
    const size_t n = text[0] == '{' ? strspn(text + 1, "abcdefghijklmnopqrstuvwxyz.") : 0;
    if (!n || text[1 + n] != '}' || (text > template && text[-1] == '$')) {
        return N_WORDS;
    }
    *length = n + 2;
    for (int w = 0; w < p->n; w++) {
        if (strlen(p->words[w]) == n && !memcmp(p->words[w], text + 1, n)) {
            return w;
        }
    }
    return -1;
}

/* Replaces the placeholders of the template by their values. *out gets the index of the placeholder that names the
   picture's file. Errors: ARGUMENT. */
static koksma_status expand(const placeholders *p, const char *template, const char *const values[N_WORDS],
                            char *command, int *out)
{
    size_t length = 0, taken = 0;
    *out = -1;
    for (const char *at = template; *at; at += taken) {
        const int word = word_at(p, template, at, &taken);
        if (word < 0) {
            return koksma__fail(KOKSMA_ARGUMENT, "%.*s is unknown in the command; use %s", (int)taken, at, p->known);
        }
        bool fits = length < LONGEST - 8;
        if (word == N_WORDS && fits) {
            command[length++] = *at;
            taken = 1;
        } else if (fits) {
            *out = word >= p->n - FORMATS ? word : *out;
            fits = append_quoted(command, &length, values[word]);
        }
        KOKSMA__FAIL_IF(!fits, KOKSMA_ARGUMENT, "the command is longer than %d characters", LONGEST);
    }
    command[length] = 0;
    return *out >= 0 ? KOKSMA_OK
                     : koksma__fail(KOKSMA_ARGUMENT, "the command lacks {out}, the name of the picture to write");
}

/* ---- The directory -------------------------------------------------------------------------------------- */

#ifdef _WIN32

static void remove_folder(const char *folder)
{
    (void)folder;
}

static koksma_status make_folder(char *folder, size_t size)
{
    (void)folder, (void)size;
    return koksma__fail(KOKSMA_UNSUPPORTED, "the command: on this system Koksma runs no programs");
}

#else

static void remove_folder(const char *folder)
{
    DIR *entries = opendir(folder);
    for (const struct dirent *entry = entries ? readdir(entries) : NULL; entry; entry = readdir(entries)) {
        unlinkat(dirfd(entries), entry->d_name, 0); /* fails for "." and ".." */
    }
    if (entries) {
        closedir(entries);
    }
    rmdir(folder);
}

static koksma_status make_folder(char *folder, size_t size)
{
    const char *parent = getenv("TMPDIR");
    const int length = snprintf(folder, size, "%s/koksma-XXXXXX", parent && *parent ? parent : "/tmp");
    KOKSMA__FAIL_IF(length < 0 || (size_t)length >= size, KOKSMA_ARGUMENT, "TMPDIR is longer than %zu characters",
                    size - 16);
    return mkdtemp(folder) ? KOKSMA_OK : koksma__fail(KOKSMA_IO, "%s: %s", folder, strerror(errno));
}

#endif

static koksma_status run_command(char *command, const koksma_run *run)
{
    char *output;
    size_t size;
    char *const arguments[] = {(char[]){"/bin/sh"}, (char[]){"-c"}, command, NULL};
    const koksma__child child = {.name = "the command",
                                 .arguments = arguments,
                                 .seconds = (double)INFINITY,
                                 .most_output = LONGEST,
                                 .most_memory = UINT64_MAX};
    const koksma_status status = koksma__child_run(&child, run, &output, &size);
    free(output);
    return status == KOKSMA_MALFORMED ? KOKSMA_IMPOSSIBLE : status; /* the text is that of its end */
}

/* Runs the template with these values in place of its placeholders and reads the image that it writes. */
static koksma_status run_template(const placeholders *p, const char *template, const char *const values[N_WORDS],
                                  const koksma_run *run, koksma_image *image)
{
    static const char to_error[] = "exec >&2\n";
    char *command = malloc(sizeof to_error + LONGEST);
    int out;
    KOKSMA__REQUIRE_MEMORY(command, sizeof to_error + LONGEST);
    strcpy(command, to_error);
    koksma_status status = expand(p, template, values, command + strlen(to_error), &out);
    status = status ? status : run_command(command, run);
    if (!status && (status = koksma_image_read(values[out], image))) {
        status = koksma__fail(status == KOKSMA_MEMORY ? status : KOKSMA_IMPOSSIBLE,
                              "the picture that the command wrote can't be used: %s",
                              strrchr(koksma_error_text(), '/') ? strrchr(koksma_error_text(), '/') + 1
                                                                : koksma_error_text());
    }
    free(command);
    return status;
}

/* Names of files in the folder, one for each format. */
static void name_files(const char *folder, const char *name, char files[FORMATS][KOKSMA_MAX_SPEC])
{
    for (int e = 0; e < FORMATS; e++) {
        snprintf(files[e], KOKSMA_MAX_SPEC, "%s/%s.%s", folder, name, endings[e]);
    }
}

static koksma_status render_in(const char *folder, const char *template, const koksma_rank_picture *picture,
                               const koksma_run *run, koksma_image *image)
{
    char spp[16], seed[24], width[16], height[16], files[FORMATS][KOKSMA_MAX_SPEC];
    snprintf(spp, sizeof spp, "%d", picture->spp);
    snprintf(seed, sizeof seed, "%" PRIu64, picture->seed);
    snprintf(width, sizeof width, "%d", picture->width);
    snprintf(height, sizeof height, "%d", picture->height);
    name_files(folder, "picture", files);
    const char *const values[N_WORDS] = {picture->scene, picture->pattern, spp,      seed,    width,
                                         height,         files[0],         files[1], files[2]};
    return run_template(&of_renderer, template, values, run, image);
}

/* Writes the image in the formats that the template names, and runs it. */
static koksma_status process_in(const char *folder, const char *template, const koksma_image *image,
                                const koksma_run *run, koksma_image *out)
{
    char in[FORMATS][KOKSMA_MAX_SPEC], files[FORMATS][KOKSMA_MAX_SPEC];
    bool any = false;
    name_files(folder, "in", in);
    name_files(folder, "out", files);
    for (int e = 0; e < FORMATS; e++) {
        char word[16];
        snprintf(word, sizeof word, "{%s}", of_process.words[e]);
        if (strstr(template, word)) {
            any = true;
            KOKSMA__TRY(koksma_image_write(in[e], image, NULL));
        }
    }
    KOKSMA__FAIL_IF(!any, KOKSMA_ARGUMENT, "the command lacks {in}, the name of the image to process");
    const char *const values[N_WORDS] = {in[0], in[1], in[2], files[0], files[1], files[2]};
    return run_template(&of_process, template, values, run, out);
}

koksma_status koksma_rank_by_command(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                     koksma_image *image)
{
    KOKSMA__REQUIRE(context, picture, image);
    KOKSMA__REQUIRE(picture->scene, picture->pattern);
    KOKSMA__REQUIRE_RUN(run);
    char folder[KOKSMA_MAX_SPEC / 2];
    KOKSMA__TRY(make_folder(folder, sizeof folder));
    const koksma_status status = render_in(folder, context, picture, run, image);
    remove_folder(folder);
    return status;
}

koksma_status koksma_rank_process_by_command(void *context, const koksma_image *image, const koksma_run *run,
                                             koksma_image *out)
{
    KOKSMA__REQUIRE(context, image, out);
    KOKSMA__REQUIRE_RUN(run);
    char folder[KOKSMA_MAX_SPEC / 2];
    KOKSMA__TRY(make_folder(folder, sizeof folder));
    const koksma_status status = process_in(folder, context, image, run, out);
    remove_folder(folder);
    return status;
}
