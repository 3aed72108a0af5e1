/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs a program as a child process, for samplers and integrands that are programs. The program leads a process group of
 * its own, with a limit on memory and no core file; at its end, or when the caller stops it, the whole group is killed.
 * A process that leaves the group (setsid) is not followed. Between fork and exec the child makes only calls that are
 * safe after fork in a process of several threads.
 */
#define _GNU_SOURCE /* pipe2 */
#include "core/platform/processes.h"

#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"

#if defined(__EMSCRIPTEN__) || defined(_WIN32)

koksma_status koksma__child_run(const koksma__child *child, const koksma_run *run, char **output, size_t *size)
{
    (void)run, (void)output, (void)size;
    return koksma__fail(KOKSMA_UNSUPPORTED, "%s: on this system Koksma runs no programs", child->name);
}

#else

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* OUT and ERR: the program's standard output and error. START: errno, if the program can't be started. IN: its standard
   input, which is the only end that the caller writes to. */
enum {
    OUT,
    ERR,
    START,
    N_READ,
    IN = N_READ,
    N_ENDS,
    STEP_MS = 20,
    LAST_STEP_MS = 1,
    FULL_PIPES = 16,
    CHUNK = 1 << 16,
    SHOWN = 200
};

static _Noreturn void become_program(const koksma__child *child, const int ends[N_ENDS])
{
    const struct rlimit memory = {(rlim_t)child->most_memory, (rlim_t)child->most_memory}, none = {0, 0};
    sigset_t no_signals;
    sigemptyset(&no_signals);
    setpgid(0, 0);
    const int input = child->input ? ends[IN] : open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (input >= 0 && dup2(input, 0) >= 0 && dup2(ends[OUT], 1) >= 0 && dup2(ends[ERR], 2) >= 0 &&
        !setrlimit(RLIMIT_CORE, &none) && (child->most_memory == UINT64_MAX || !setrlimit(RLIMIT_DATA, &memory))) {
        signal(SIGPIPE, SIG_DFL);
        signal(SIGCHLD, SIG_DFL);
        sigprocmask(SIG_SETMASK, &no_signals, NULL);
        execv(child->arguments[0], child->arguments);
    }
    const int error = errno;
    while (write(ends[START], &error, sizeof error) < 0 && errno == EINTR) {
    }
    _exit(127);
}

typedef struct conversation {
    const koksma__child *child;
    const koksma_run *run;
    pid_t program;
    int ends[N_ENDS]; /* -1: closed */
    double started_s;
    char *output;
    size_t size, capacity;
    size_t given;                  /* bytes of the input that were written */
    char line[SHOWN], last[SHOWN]; /* the current line of standard error, and its last line that was not empty */
    size_t length;
    int error;            /* errno of the start, 0: the program was started */
    int ended;            /* the exit status that waitpid returned; -1: lost, as the host program ignores SIGCHLD */
    koksma_status status; /* why the program is being stopped */
} conversation;

static void shut(int *end)
{
    if (*end >= 0) {
        close(*end);
    }
    *end = -1;
}

static void stop_program(conversation *c, koksma_status status)
{
    c->status = status;
    kill(-c->program, SIGKILL);
}

static void take_output(conversation *c, const char *bytes, size_t count)
{
    if (c->status) {
        return;
    }
    if (count > c->child->most_output - c->size) {
        stop_program(c, koksma__fail(KOKSMA_MALFORMED, "%s: it prints more than %zu bytes, more than the points need",
                                     c->child->name, c->child->most_output));
        return;
    }
    if (koksma__reserve(&c->output, &c->capacity, c->size + count, 1)) {
        stop_program(c, KOKSMA_MEMORY);
        return;
    }
    memcpy(c->output + c->size, bytes, count);
    c->size += count;
}

static void take_message(conversation *c, const char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (bytes[i] == '\n' || bytes[i] == '\r') {
            c->length = 0;
        } else if (c->length + 1 < SHOWN && (c->length || (bytes[i] != ' ' && bytes[i] != '\t'))) {
            c->line[c->length++] = bytes[i];
            c->line[c->length] = 0;
            memcpy(c->last, c->line, c->length + 1);
        }
    }
}

static void take_error(conversation *c, const char *bytes, size_t count)
{
    if (count == sizeof c->error) {
        memcpy(&c->error, bytes, count);
    }
}

/* Reads once from an end; returns whether there may be more. */
static bool take(conversation *c, int end, char *chunk)
{
    static void (*const takers[N_READ])(conversation * c, const char *bytes, size_t count) = {
        [OUT] = take_output, [ERR] = take_message, [START] = take_error};
    const ssize_t count = c->ends[end] < 0 ? 0 : read(c->ends[end], chunk, CHUNK);
    if (count > 0) {
        takers[end](c, chunk, (size_t)count);
    } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
        shut(&c->ends[end]);
    }
    return count > 0 || (count < 0 && errno == EINTR);
}

/* Writes what fits of the input, and closes it at its end or when the program has closed it. The SIGPIPE of that is
   blocked in this thread and taken, since its handler is the host program's. */
static void give(conversation *c)
{
    sigset_t broken, before, pending;
    sigemptyset(&broken);
    sigaddset(&broken, SIGPIPE);
    sigpending(&pending);
    pthread_sigmask(SIG_BLOCK, &broken, &before);
    const ssize_t count = write(c->ends[IN], c->child->input + c->given, c->child->input_size - c->given);
    const int error = count < 0 ? errno : 0;
    if (error == EPIPE && !sigismember(&pending, SIGPIPE)) {
#ifdef __APPLE__
        int taken;
        sigpending(&pending);
        if (sigismember(&pending, SIGPIPE)) {
            sigwait(&broken, &taken);
        }
#else
        while (sigtimedwait(&broken, NULL, &(struct timespec){0}) < 0 && errno == EINTR) {
        }
#endif
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    c->given += count > 0 ? (size_t)count : 0;
    if (c->given == c->child->input_size || (error && error != EAGAIN && error != EINTR)) {
        shut(&c->ends[IN]);
    }
}

/* Whether the program has ended. It is not reaped yet, so that its number remains that of its group. */
static bool has_ended(const conversation *c)
{
    siginfo_t info = {0};
    return waitid(P_PID, (id_t)c->program, &info, WEXITED | WNOHANG | WNOWAIT) ? errno == ECHILD
                                                                               : info.si_pid == c->program;
}

/* Reads output until the program has ended, and then what is left in the pipes: some times what a pipe holds at most, as a
   process that left the group may write on. */
static void talk(conversation *c, char *chunk)
{
    while (!has_ended(c)) {
        struct pollfd files[N_ENDS];
        for (int e = 0; e < N_ENDS; e++) {
            files[e] = (struct pollfd){.fd = c->ends[e], .events = e == IN ? POLLOUT : POLLIN}; /* -1 is ignored */
        }
        /* the pipes are closed a moment before the program has ended */
        const bool closed = c->ends[OUT] < 0 && c->ends[ERR] < 0;
        const int ready = poll(files, N_ENDS, closed ? LAST_STEP_MS : STEP_MS);
        for (int e = 0; e < N_ENDS && ready > 0; e++) {
            if (files[e].revents && e == IN) {
                give(c);
            } else if (files[e].revents) {
                take(c, e, chunk);
            }
        }
        if (!c->status && !koksma__keep_going(c->run, 0)) {
            stop_program(c, koksma__fail_interrupted());
        } else if (!c->status && koksma__now_s() - c->started_s > c->child->seconds) {
            stop_program(c, koksma__fail(KOKSMA_MALFORMED,
                                         "%s: it was ended after %g seconds; --exec-seconds allows more",
                                         c->child->name, c->child->seconds));
        }
    }
    kill(-c->program, SIGKILL);
    for (int e = 0; e < N_READ; e++) {
        for (int i = 0; i < FULL_PIPES && !c->status && take(c, e, chunk); i++) {
        }
    }
}

static koksma_status judge(const conversation *c)
{
    const char *name = c->child->name;
    const int status = c->ended;
    if (c->status) {
        return c->status; /* the error text was set where the status was */
    }
    KOKSMA__FAIL_IF(c->error == ENOEXEC, KOKSMA_MISSING,
                    "%s: it can't be run: it is not a program; a script begins with #!, as in #!/usr/bin/env python3",
                    name);
    KOKSMA__FAIL_IF(c->error, KOKSMA_MISSING, "%s: it can't be run: %s", name, strerror(c->error));
    KOKSMA__FAIL_IF(status < 0, KOKSMA_SYSTEM, "%s: its exit code is lost, as this process ignores SIGCHLD", name);
    KOKSMA__FAIL_IF(status, KOKSMA_MALFORMED, "%s: it ended with %s %d%s%s", name,
                    WIFSIGNALED(status) ? "signal" : "exit code",
                    WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), *c->last ? ": " : "", c->last);
    return KOKSMA_OK;
}

/* Moves a descriptor above those of the standard streams, which dup2 replaces in the program. */
static bool lift(int *end)
{
    const int low = *end;
    if (low >= 0 && low <= 2) {
        *end = fcntl(low, F_DUPFD_CLOEXEC, 3);
        close(low);
    }
    return *end >= 0;
}

/* Makes pipes: one end for the caller, which never waits in read() or write(), one for the child. */
static bool open_ends(int ours[N_ENDS], int theirs[N_ENDS])
{
    bool good = true;
    for (int e = 0; e < N_ENDS; e++) {
        int pair[2] = {-1, -1};
#ifdef __APPLE__
        /* a program that another thread starts in between gets the ends, too */
        const int failed = pipe(pair) || fcntl(pair[0], F_SETFD, FD_CLOEXEC) || fcntl(pair[1], F_SETFD, FD_CLOEXEC);
#else
        const int failed = pipe2(pair, O_CLOEXEC);
#endif
        ours[e] = failed ? -1 : pair[e == IN];
        theirs[e] = failed ? -1 : pair[e != IN];
        const bool lifted = lift(&ours[e]) && lift(&theirs[e]);
        good = good && lifted && !fcntl(ours[e], F_SETFL, O_NONBLOCK);
    }
    return good;
}

/* Forks; all signals are blocked in the child until the program begins. */
static koksma_status start(conversation *c)
{
    int theirs[N_ENDS];
    sigset_t all, before;
    const bool opened = open_ends(c->ends, theirs);
    int error = errno;
    if (opened) {
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before);
        c->program = fork();
        error = errno;
        if (c->program == 0) {
            become_program(c->child, theirs);
        }
        pthread_sigmask(SIG_SETMASK, &before, NULL);
    }
    for (int e = 0; e < N_ENDS; e++) {
        shut(&theirs[e]);
    }
    KOKSMA__FAIL_IF(c->program <= 0, KOKSMA_SYSTEM, "%s: can't start a process for it: %s", c->child->name,
                    strerror(error));
    if (!c->child->input) {
        shut(&c->ends[IN]);
    }
    setpgid(c->program, c->program); /* both processes call setpgid, because either may run first */
    return KOKSMA_OK;
}

koksma_status koksma__child_run(const koksma__child *child, const koksma_run *run, char **output, size_t *size)
{
    conversation c = {.child = child, .run = run, .program = -1, .started_s = koksma__now_s(), .ended = -1};
    char *chunk = malloc(CHUNK);
    KOKSMA__REQUIRE_MEMORY(chunk, (size_t)CHUNK);
    koksma_status status = start(&c);
    if (!status) {
        talk(&c, chunk);
        while (waitpid(c.program, &c.ended, 0) < 0 && errno == EINTR) {
        }
        status = judge(&c);
    }
    for (int e = 0; e < N_ENDS; e++) {
        shut(&c.ends[e]);
    }
    free(chunk);
    *output = status ? NULL : c.output;
    *size = status ? 0 : c.size;
    if (status) {
        free(c.output);
    }
    return status;
}

#endif
