/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs another renderer by a command line (koksma_rank_by_command). Every picture has its own temporary directory,
 * so that the program may write other files beside the picture. The shell leads a process group of its own (core/child.h),
 * so that a stop kills all processes that it started. What the command prints goes to standard error, of which the last
 * line is part of the error message if the command fails.
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

#include "core/child.h"
#include "core/status.h"

enum { LONGEST = 1 << 16 };

static const char *const words[] = {"scene",  "pattern", "spp",     "seed",   "width",
                                    "height", "out",     "out.pfm", "out.png"};
enum { OUT = 6, N_WORDS = sizeof words / sizeof *words };

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

/* Index in `words` of the placeholder in braces that begins at `text`; N_WORDS: no placeholder begins here (as in
   ${HOME}, {1..3}, { ls; }); -1: an unknown placeholder. */
static int word_at(const char *template, const char *text, size_t *length)
{
    const size_t n = text[0] == '{' ? strspn(text + 1, "abcdefghijklmnopqrstuvwxyz.") : 0;
    if (!n || text[1 + n] != '}' || (text > template && text[-1] == '$')) {
        return N_WORDS;
    }
    *length = n + 2;
    for (int w = 0; w < N_WORDS; w++) {
        if (strlen(words[w]) == n && !memcmp(words[w], text + 1, n)) {
            return w;
        }
    }
    return -1;
}

/* Replaces the placeholders of the template by their values. *out gets the index of the placeholder that names the
   picture's file. Errors: ARGUMENT. */
static koksma_status expand(const char *template, const char *const values[N_WORDS], char *command, int *out)
{
    size_t length = 0, taken = 0;
    *out = -1;
    for (const char *at = template; *at; at += taken) {
        const int word = word_at(template, at, &taken);
        if (word < 0) {
            return koksma__fail(KOKSMA_ARGUMENT,
                                "%.*s is unknown in the command; use {scene}, {pattern}, {spp}, {seed}, {width}, "
                                "{height} and {out}, {out.pfm} or {out.png}",
                                (int)taken, at);
        }
        bool fits = length < LONGEST - 8;
        if (word == N_WORDS && fits) {
            command[length++] = *at;
            taken = 1;
        } else if (fits) {
            *out = word >= OUT ? word : *out;
            fits = append_quoted(command, &length, values[word]);
        }
        KOKSMA__FAIL_IF(!fits, KOKSMA_ARGUMENT, "the command is longer than %d characters", LONGEST);
    }
    command[length] = 0;
    return *out >= 0 ? KOKSMA_OK
                     : koksma__fail(KOKSMA_ARGUMENT, "the command lacks {out}, the name of the picture to write");
}

/* ---- The directory -------------------------------------------------------------------------------------- */

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

static koksma_status render_in(const char *folder, const char *template, const koksma_rank_picture *picture,
                               const koksma_run *run, koksma_image *image)
{
    static const char to_error[] = "exec >&2\n";
    char spp[16], seed[24], width[16], height[16], files[N_WORDS - OUT][KOKSMA_MAX_SPEC];
    char *command = malloc(sizeof to_error + LONGEST);
    int out;
    KOKSMA__REQUIRE_MEMORY(command, sizeof to_error + LONGEST);
    snprintf(spp, sizeof spp, "%d", picture->spp);
    snprintf(seed, sizeof seed, "%" PRIu64, picture->seed);
    snprintf(width, sizeof width, "%d", picture->width);
    snprintf(height, sizeof height, "%d", picture->height);
    static const char *const endings[] = {"exr", "pfm", "png"};
    for (int e = 0; e < N_WORDS - OUT; e++) {
        snprintf(files[e], sizeof files[e], "%s/picture.%s", folder, endings[e]);
    }
    const char *const values[] = {picture->scene, picture->pattern, spp,      seed,    width,
                                  height,         files[0],         files[1], files[2]};
    strcpy(command, to_error);
    koksma_status status = expand(template, values, command + strlen(to_error), &out);
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

koksma_status koksma_rank_by_command(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                     koksma_image *image)
{
    KOKSMA__REQUIRE(context, picture, image);
    KOKSMA__REQUIRE(picture->scene, picture->pattern);
    KOKSMA__REQUIRE_RUN(run);
    char folder[KOKSMA_MAX_SPEC / 2];
    koksma_status status = make_folder(folder, sizeof folder);
    if (!status) {
        status = render_in(folder, context, picture, run, image);
        remove_folder(folder);
    }
    return status;
}
