/* SPDX-License-Identifier: Apache-2.0 */
/* Long work: threads, the progress line on stderr, and Ctrl-C, which stops the work between two blocks; finished work is
   kept. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli.h"

static volatile sig_atomic_t interrupted, asked; /* asked: the work knows that it is interrupted */
static volatile double busy_s;                   /* processor time when on_alarm last looked */

static double processor_seconds(void)
{
    struct timespec t = {0};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#ifndef _WIN32
/* Work asks every few milliseconds whether to go on, but a command that waits for a pipe or a terminal does not. So each
   second after a signal the program is ended if it has not asked and computes nothing. */
static void on_alarm(int number)
{
    const double now = processor_seconds();
    (void)number;
    if (!asked && now - busy_s < 0.01) {
        _exit(koksma_status_exit_code(KOKSMA_INTERRUPTED));
    }
    busy_s = now;
    alarm(asked ? 0 : 1);
}
#endif

static void on_signal(int number)
{
    (void)number;
    interrupted = 1;
    busy_s = processor_seconds();
#ifndef _WIN32
    alarm(1);
#endif
    signal(SIGINT, SIG_DFL); /* a second SIGINT or SIGTERM ends the program at once */
    signal(SIGTERM, SIG_DFL);
}

bool cli_interrupted(void)
{
    asked = interrupted;
    return interrupted != 0;
}

double cli_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

const char *cli_duration(double seconds, char text[CLI_NUMBER])
{
    const double whole = floor(seconds + 0.5);
    if (seconds < 9.95) {
        snprintf(text, CLI_NUMBER, "%.2g s", fmax(seconds, 0.1));
    } else if (whole < 60) {
        snprintf(text, CLI_NUMBER, "%.0f s", whole);
    } else if (whole < 3600) {
        snprintf(text, CLI_NUMBER, "%.0f min %.0f s", floor(whole / 60), fmod(whole, 60));
    } else {
        snprintf(text, CLI_NUMBER, "%.0f h %.0f min", floor(whole / 3600), floor(fmod(whole, 3600) / 60));
    }
    return text;
}

/* Notes the progress of the part. `run` reports several phases, each from 0: after a fall it says nothing of the part. */
static void note(cli_work *work, double fraction)
{
    work->unknown = work->unknown || fraction < work->reached - 0.05;
    work->reached = fmax(work->reached, fraction);
    if (!work->unknown) {
        work->fraction = fmax(work->fraction, fmin(work->begin + work->share * fraction, 1));
    }
}

/* The seconds left: those of this part, and for each later part the mean time of the parts up to this one. */
static double seconds_left(const cli_work *work, double now)
{
    const double in_part = now - work->part_s, part_s = in_part / work->reached;
    const double before = work->begin / work->share, after = (1 - work->begin - work->share) / work->share;
    return part_s - in_part + after * (work->part_s - work->started_s + part_s) / (before + 1);
}

/* Prints the progress line. */
static void show(cli_work *work, double fraction)
{
    const double now = cli_seconds(), elapsed = now - work->started_s;
    char text[256], left[CLI_NUMBER];
    note(work, fraction);
    if (work->hidden || now - work->updated_s < 1.0 / 6) {
        return;
    }
    work->updated_s = now;
    snprintf(text, sizeof text, "%.150s", work->what);
    if (!work->unknown) {
        CLI_APPEND(text, sizeof text, " %3.0f %%", 100 * work->fraction);
    }
    if (work->limit_s > 0) {
        CLI_APPEND(text, sizeof text, ", at most %s left", cli_duration(fmax(work->limit_s - elapsed, 0), left));
    } else if (work->unknown && elapsed > 1) {
        CLI_APPEND(text, sizeof text, ", %s so far", cli_duration(elapsed, left));
    } else if (work->reached > 0.01 && elapsed > 1) {
        CLI_APPEND(text, sizeof text, ", %s left", cli_duration(seconds_left(work, now), left));
    }
    cli_show_line(text);
}

static bool keep_going(void *context, double fraction)
{
    const cli_work *work = context;
    if (work->visible) {
        show(context, fraction);
    }
    return !cli_interrupted();
}

bool cli_work_begin(const cli_args *args, const char *what, cli_work *work)
{
    uint64_t threads;
    enum { AUTOMATIC, ALWAYS };
    int when = AUTOMATIC;
    if (!cli_whole(args, "threads", 0, 1, 256, &threads) || !cli_choice(args, "progress", &when)) {
        return false;
    }
    const bool visible = !cli_flag(args, "quiet") && (when == ALWAYS || (when == AUTOMATIC && isatty(STDERR_FILENO)));
    *work = (cli_work){.what = what, .share = 1, .visible = visible, .started_s = cli_seconds()};
    work->part_s = work->started_s;
    work->run = (koksma_run){.threads = (int)threads, .keep_going = keep_going, .context = work};
#ifndef _WIN32
    /* with SIGXFSZ ignored, a write beyond the limit on file sizes fails instead of killing the program */
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGALRM, on_alarm);
#endif
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
    return true;
}

void cli_work_part(cli_work *work, size_t i, size_t n)
{
    work->begin = (double)i / (double)n;
    work->share = 1 / (double)n;
    work->part_s = cli_seconds();
    work->reached = 0;
    work->unknown = false;
}

void cli_work_rest(cli_work *work, double begin)
{
    cli_work_part(work, 0, 1);
    work->begin = begin;
    work->share = 1 - begin;
}

void cli_work_unknown(cli_work *work, const char *what)
{
    work->what = what;
    work->unknown = true;
}

void cli_work_hide(cli_work *work)
{
    cli_work_end();
    work->hidden = true;
}
