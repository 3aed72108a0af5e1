/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs another renderer by a command line (koksma_rank_by_command). Every picture has its own temporary directory,
 * so that the program may write other files beside the picture. What the program prints goes to a file in that
 * directory; its last line is part of the error message if the program fails. The command runs in its own process
 * group, so that a stop kills all processes that the shell started. The library waits for this process alone,
 * because it must not reap its caller's other child processes. It polls waitpid every 10 ms, which is short compared
 * with rendering a picture, and asks the caller's keep_going in between.
 */
#include <koksma/study.h>

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/parallel.h"
#include "core/status.h"

extern char **environ;

enum { LONGEST = 1 << 16, STEP_NS = 10000000 };

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

/* ---- The process ---------------------------------------------------------------------------------------- */

static koksma_status start(const char *command, const char *log, pid_t *child)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    char *const arguments[] = {(char[]){"sh"}, (char[]){"-c"}, (char *)command, NULL};
    int error = posix_spawn_file_actions_init(&files);
    error = error ? error : posix_spawnattr_init(&attributes);
    error = error ? error : posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    error = error ? error : posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    error = error ? error : posix_spawn_file_actions_addopen(&files, 1, log, O_WRONLY | O_CREAT | O_EXCL, 0600);
    error = error ? error : posix_spawn_file_actions_adddup2(&files, 1, 2);
    error = error ? error : posix_spawn(child, "/bin/sh", &files, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    return error ? koksma__fail(KOKSMA_SYSTEM, "/bin/sh: %s", strerror(error)) : KOKSMA_OK;
}

/* Waits until the command has ended; kills it if keep_going asks for a stop. *outcome: its status from waitpid. */
static koksma_status wait_for(pid_t child, const koksma_run *run, int *outcome)
{
    bool stop = false;
    for (;;) {
        const pid_t ended = waitpid(child, outcome, stop ? 0 : WNOHANG);
        if (ended == child) {
            return stop ? koksma__fail_interrupted() : KOKSMA_OK;
        }
        KOKSMA__FAIL_IF(ended < 0 && errno != EINTR, KOKSMA_SYSTEM, "waiting for the command: %s", strerror(errno));
        stop = stop || !koksma__keep_going(run, 0);
        if (stop) {
            kill(-child, SIGKILL);
        } else {
            nanosleep(&(struct timespec){.tv_nsec = STEP_NS}, NULL);
        }
    }
}

/* Copies the last line of the log that is not blank, or its beginning if it is long. */
static void last_line(const char *log, char *line, size_t size)
{
    FILE *file = fopen(log, "r");
    char read[KOKSMA_RANK_REASON];
    bool begins = true; /* whether `read` holds the beginning of a line */
    line[0] = 0;
    while (file && fgets(read, sizeof read, file)) {
        const bool ends = strchr(read, '\n');
        read[strcspn(read, "\r\n")] = 0;
        if (begins && read[strspn(read, " \t")]) {
            snprintf(line, size, "%.*s", (int)size - 1, read);
        }
        begins = ends;
    }
    if (file) {
        fclose(file);
    }
}

static koksma_status explain(const char *log, int outcome)
{
    char line[KOKSMA_RANK_REASON - 48]; /* leaves room in the reason for the words before it */
    last_line(log, line, sizeof line);
    const bool killed = WIFSIGNALED(outcome);
    return koksma__fail(KOKSMA_IMPOSSIBLE, "the command ended with %s %d%s%s", killed ? "signal" : "exit code",
                        killed ? WTERMSIG(outcome) : WEXITSTATUS(outcome), line[0] ? ": " : "", line);
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

static koksma_status render_in(const char *folder, const char *template, const koksma_rank_picture *picture,
                               const koksma_run *run, koksma_image *image)
{
    char spp[16], seed[24], width[16], height[16], files[N_WORDS - OUT][KOKSMA_MAX_SPEC], log[KOKSMA_MAX_SPEC];
    char *command = malloc(LONGEST);
    int out, outcome = 0;
    pid_t child;
    KOKSMA__REQUIRE_MEMORY(command, LONGEST);
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
    snprintf(log, sizeof log, "%s/printed", folder);
    koksma_status status = expand(template, values, command, &out);
    status = status ? status : start(command, log, &child);
    status = status ? status : wait_for(child, run, &outcome);
    if (!status && outcome) {
        status = explain(log, outcome);
    }
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
