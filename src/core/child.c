/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Runs a program as a child process, for samplers that are programs. Three processes take part:
 *
 *     caller   reads the output of the program, and checks the time limit and run->keep_going
 *     keeper   a fork of the caller, connected to it by a socket. It adopts all orphaned descendants
 *              (PR_SET_CHILD_SUBREAPER), so that no daemon, fork or new session of the program escapes. When the
 *              program ends, or the caller closes its end of the socket or dies, the keeper kills all its descendants
 *     program  in a process group of its own, with a limit on memory and no core file
 *
 * A separate keeper is needed because PR_SET_CHILD_SUBREAPER applies to a whole process, and a library must not set
 * it for its host program. Between fork and exec the child makes only calls that are safe after fork in a process of
 * several threads.
 */
#define _GNU_SOURCE /* pipe2, ppoll */
#include "core/child.h"

#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"

#ifdef __EMSCRIPTEN__

koksma_status koksma__child_run(const koksma__child *child, const koksma_run *run, char **output, size_t *size)
{
    (void)run, (void)output, (void)size;
    return koksma__fail(KOKSMA_UNSUPPORTED, "%s: a browser runs no programs", child->name);
}

#else

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

enum { OUT, ERR, KEEPER, N_ENDS, STEP_MS = 20, CHUNK = 1 << 16, SHOWN = 200, MOST_FILES = 1 << 16 };

/* The message that the keeper sends at its end, or that the program's process sends if it cannot start the
   program. */
typedef struct outcome {
    int error;  /* 0: the program was started; otherwise errno of the failed start */
    int status; /* the exit status that waitpid returned */
} outcome;

/* ---- The program and its keeper: these functions make only calls that are safe after fork ----------------- */

static void tell(int socket, int error, int status)
{
    const outcome o = {error, status};
    while (send(socket, &o, sizeof o, MSG_NOSIGNAL) < 0 && errno == EINTR) {
    }
}

static _Noreturn void become_program(const koksma__child *child, const int ends[N_ENDS])
{
    const struct rlimit memory = {(rlim_t)child->most_memory, (rlim_t)child->most_memory}, none = {0, 0};
    sigset_t no_signals;
    sigemptyset(&no_signals);
    setpgid(0, 0);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing >= 0 && dup2(nothing, 0) >= 0 && dup2(ends[OUT], 1) >= 0 && dup2(ends[ERR], 2) >= 0 &&
        !setrlimit(RLIMIT_CORE, &none) && !setrlimit(RLIMIT_DATA, &memory)) {
        signal(SIGPIPE, SIG_DFL);
        signal(SIGCHLD, SIG_DFL);
        sigprocmask(SIG_SETMASK, &no_signals, NULL);
        execv(child->arguments[0], child->arguments);
    }
    tell(ends[KEEPER], errno, 0);
    _exit(127);
}

/* Closes all files but the three of `ends`: the caller's files must not stay open in the keeper when the caller has
   died. */
static void close_others(const int ends[N_ENDS])
{
    unsigned first = 0;
    for (int round = 0; round <= N_ENDS; round++) { /* ends has the three descriptors in increasing order; close those
                                                       between them */
        unsigned next = ~0u;
        for (int e = 0; e < N_ENDS; e++) {
            next = (unsigned)ends[e] >= first && (unsigned)ends[e] < next ? (unsigned)ends[e] : next;
        }
        if (next > first && syscall(SYS_close_range, first, next - 1, 0)) { /* before Linux 5.9 */
            for (unsigned file = first; file < next && file < MOST_FILES; file++) {
                close((int)file);
            }
        }
        first = next + 1;
    }
}

/* Kills all children of this process, as listed by /proc. */
static void kill_children(void)
{
    char text[4096];
    const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
    const ssize_t length = file < 0 ? 0 : read(file, text, sizeof text);
    pid_t process = 0;
    for (ssize_t i = 0; i < length; i++) {
        if (text[i] >= '0' && text[i] <= '9') {
            process = 10 * process + (text[i] - '0');
        } else if (process) {
            kill(process, SIGKILL);
            process = 0;
        }
    }
    if (file >= 0) {
        close(file);
    }
}

static void on_child(int number)
{
    (void)number; /* an empty handler: the signal only has to end ppoll */
}

/* Waits until the program ends or the caller shuts its end of the socket. It does not reap the program yet, so that
   no other process can get its number. */
static void await(pid_t program, int socket)
{
    const struct sigaction action = {.sa_handler = on_child};
    sigset_t waiting;
    sigfillset(&waiting);
    sigdelset(&waiting, SIGCHLD);
    sigaction(SIGCHLD, &action, NULL);
    for (;;) {
        struct pollfd order = {.fd = socket, .events = POLLIN};
        siginfo_t ended = {0};
        if (waitid(P_PID, (id_t)program, &ended, WEXITED | WNOHANG | WNOWAIT) || ended.si_pid == program ||
            ppoll(&order, 1, NULL, &waiting) > 0) {
            return;
        }
    }
}

static _Noreturn void keep(const koksma__child *child, const int ends[N_ENDS])
{
    int status = 0;
    setpgid(0, 0);
    close_others(ends);
    prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
    const pid_t program = fork();
    if (program == 0) {
        become_program(child, ends);
    }
    if (program < 0) {
        tell(ends[KEEPER], errno, 0);
        _exit(1);
    }
    setpgid(program, program); /* both processes call setpgid, because either may run first */
    close(ends[OUT]);
    close(ends[ERR]);
    await(program, ends[KEEPER]);
    kill(-program, SIGKILL);
    kill(program, SIGKILL);
    waitpid(program, &status, 0);
    do {
        kill_children();
    } while (waitpid(-1, NULL, 0) > 0);
    tell(ends[KEEPER], 0, status);
    _exit(0);
}

/* ---- The caller ------------------------------------------------------------------------------------------- */

typedef struct conversation {
    const koksma__child *child;
    const koksma_run *run;
    int ends[N_ENDS]; /* -1: closed */
    double started_s;
    char *output;
    size_t size, capacity;
    char line[SHOWN], last[SHOWN]; /* the current line of standard error, and its last line that was not empty */
    size_t length;
    outcome outcome;
    bool heard;           /* true: the keeper or the program has sent an outcome */
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
    shutdown(c->ends[KEEPER], SHUT_WR);
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

static void take_outcome(conversation *c, const char *bytes, size_t count)
{
    /* only the first outcome counts: if the program can't be started, its process sends one before the keeper does */
    if (count >= sizeof c->outcome && !c->heard) {
        memcpy(&c->outcome, bytes, sizeof c->outcome);
        c->heard = true;
    }
}

static void take(conversation *c, int end, char *chunk)
{
    static void (*const takers[N_ENDS])(conversation * c, const char *bytes, size_t count) = {
        [OUT] = take_output, [ERR] = take_message, [KEEPER] = take_outcome};
    const ssize_t count = read(c->ends[end], chunk, CHUNK);
    if (count > 0) {
        takers[end](c, chunk, (size_t)count);
    } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
        shut(&c->ends[end]);
    }
}

/* Reads output until the keeper has ended; then no process is left that could still print. */
static void talk(conversation *c, char *chunk)
{
    while (c->ends[OUT] >= 0 || c->ends[ERR] >= 0 || c->ends[KEEPER] >= 0) {
        struct pollfd files[N_ENDS];
        for (int e = 0; e < N_ENDS; e++) {
            files[e] = (struct pollfd){.fd = c->ends[e], .events = POLLIN}; /* poll() ignores -1 */
        }
        const int ready = poll(files, N_ENDS, STEP_MS);
        for (int e = 0; e < N_ENDS && ready > 0; e++) {
            if (files[e].revents) {
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
}

static koksma_status judge(const conversation *c)
{
    const char *name = c->child->name;
    const int status = c->outcome.status;
    if (c->status) {
        return c->status; /* the error text was set where the status was */
    }
    KOKSMA__FAIL_IF(!c->heard, KOKSMA_SYSTEM, "%s: the process that supervises it was killed", name);
    KOKSMA__FAIL_IF(c->outcome.error == ENOEXEC, KOKSMA_MISSING,
                    "%s: it can't be run: it is not a program; a script begins with #!, as in #!/usr/bin/env python3",
                    name);
    KOKSMA__FAIL_IF(c->outcome.error, KOKSMA_MISSING, "%s: it can't be run: %s", name, strerror(c->outcome.error));
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

/* Makes pairs of connected files: one end for the caller, one for the child. */
static bool open_ends(int ours[N_ENDS], int theirs[N_ENDS])
{
    bool good = true;
    for (int e = 0; e < N_ENDS; e++) {
        int pair[2] = {-1, -1};
        const int failed =
            e == KEEPER ? socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) : pipe2(pair, O_CLOEXEC);
        ours[e] = failed ? -1 : pair[0];
        theirs[e] = failed ? -1 : pair[1];
        const bool lifted = lift(&ours[e]);
        good = lift(&theirs[e]) && lifted && good;
    }
    return good;
}

/* Forks the keeper and sets *keeper to its process number. All signals are blocked in the keeper from the start. */
static koksma_status start_keeper(conversation *c, pid_t *keeper)
{
    int theirs[N_ENDS];
    sigset_t all, before;
    const bool opened = open_ends(c->ends, theirs);
    int error = errno;
    *keeper = -1;
    if (opened) {
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before);
        *keeper = fork();
        error = errno;
        if (*keeper == 0) {
            keep(c->child, theirs);
        }
        pthread_sigmask(SIG_SETMASK, &before, NULL);
    }
    for (int e = 0; e < N_ENDS; e++) {
        shut(&theirs[e]);
    }
    return *keeper > 0
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_SYSTEM, "%s: can't start a process for it: %s", c->child->name, strerror(error));
}

koksma_status koksma__child_run(const koksma__child *child, const koksma_run *run, char **output, size_t *size)
{
    conversation c = {.child = child, .run = run, .started_s = koksma__now_s()};
    pid_t keeper;
    char *chunk = malloc(CHUNK);
    KOKSMA__REQUIRE_MEMORY(chunk, (size_t)CHUNK);
    koksma_status status = start_keeper(&c, &keeper);
    if (!status) {
        talk(&c, chunk);
        while (waitpid(keeper, NULL, 0) < 0 &&
               errno == EINTR) { /* the loop also ends with ECHILD, which waitpid returns if the host program ignores
                                    SIGCHLD */
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
