/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the commands share. A command is one file with one cli_command; its option table parses the command line and
 * prints the help. Results go to stdout, messages to stderr; exit codes are those of koksma_status_exit_code().
 */
#ifndef KOKSMA_CLI_CLI_H
#define KOKSMA_CLI_CLI_H

#include <koksma/koksma.h>

enum { CLI_MAX_OPTIONS = 32, CLI_YES = 0, CLI_NO = 1, CLI_USAGE = 2, CLI_DIGITS = 5, CLI_NUMBER = 32 };

typedef struct cli_option {
    char letter;      /* 0: none */
    const char *name; /* tables end at a NULL name */
    /* NULL: a flag. Its choices, "csv|json|npy", or a noun; "MEASURE,.." is a list. What ends in "..." may be given
       again: lines of one text. A file to write has its endings, "FILE.txt|.csv": others are refused. Completions
       know the nouns by their names. */
    const char *argument;
    const char *help;
} cli_option;

typedef struct cli_arguments cli_arguments;

typedef struct cli_command {
    const char *name, *summary;
    const char *synopsis; /* operands and options after "koksma NAME", a line for each use */
    const char *details;  /* of --help; lines are joined into paragraphs (cli/paragraphs.h); may be NULL */
    const char *examples; /* command lines, each with its end of line; tests run them (tests/cli/examples.py) */
    const cli_option *options;
    int (*run)(const cli_arguments *arguments); /* the exit code */
} cli_command;

struct cli_arguments {
    const cli_command *command;
    int n_operands;
    char **operands;
    const char *values[CLI_MAX_OPTIONS]; /* by option; "" for a flag that is set, NULL when not given */
    char *joined[CLI_MAX_OPTIONS];       /* owns the values of options that were given again */
    char **made;                         /* owns the operands where -p and -n may add some (cli/source.c) */
    int n_made;
};

#define COMMAND(name) extern const cli_command cli_command_##name;
#include "commands.def"
#undef COMMAND

/* Command i in the order of the help; NULL past the end. */
const cli_command *cli_command_at(size_t i);

/* NULL when there is none. */
const cli_command *cli_command_find(const char *name);

/* The options that most commands have, for the end of an option table. */
#define CLI_ROW_OPTIONS                                                                                              \
    {0, "json", NULL, "one JSON object a line instead of aligned text"},                                             \
        {0, "long", NULL, "all columns, also those that do not fit the terminal"},                                   \
    {                                                                                                                \
        0, "digits", "N", "significant digits of numbers as text, 1 to 17 (default: 5; JSON has all)"                \
    }
#define CLI_RUN_OPTIONS                                                                                              \
    {0, "threads", "T", "threads to use (default: all)"},                                                            \
        {0, "progress", "auto|always|never", "show progress (default: auto, when stderr is a terminal)"},            \
        {0, "allow-exec", NULL, "run the programs and libraries that exec:PROGRAM and plugin:LIBRARY name"},         \
        {0, "exec-seconds", "S", "with --allow-exec: the longest time of a program for a set (default: 60)"},        \
    {                                                                                                                \
        'q', "quiet", NULL, "print only errors to stderr"                                                            \
    }

/* An option's text, or fallback; whether a flag is set. The name must be in the table. */
const char *cli_text(const cli_arguments *arguments, const char *name, const char *fallback);
bool cli_flag(const cli_arguments *arguments, const char *name);

/* An option as a number in [min, max]; false after an error that names it. */
bool cli_whole(const cli_arguments *arguments, const char *name, uint64_t fallback, uint64_t min, uint64_t max,
               uint64_t *out);
/* A text, which is the value of the option `name` or a part of it, as a number in [min, max]; false after an error. */
bool cli_is_whole(const cli_arguments *arguments, const char *name, const char *text, uint64_t min, uint64_t max,
                  uint64_t *out);
/* --size WxH; without it both stay as they are. */
bool cli_size(const cli_arguments *arguments, int *width, int *height);
bool cli_real(const cli_arguments *arguments, const char *name, double fallback, double min, double max, double *out);

/* "did you mean 'NAME'? " with the nearest name of a table (koksma_closest_name()), or "". Returns text. */
const char *cli_meant(const char *word, koksma_name_at *name, const void *table, char text[96]);

/* The name of a command, an integrator or a filter, for cli_meant(); `table` is not used. */
const char *cli_command_name(const void *table, size_t i);
const char *cli_integrator_name(const void *table, size_t i);
const char *cli_filter_name(const void *table, size_t i);

/* "koksma NAME: text" on stderr, as one line of UTF-8 whatever the names in it hold. command: "" for none. */
void cli_say(const char *command, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Says what is wrong with the command line, as cli_say does; returns its exit code, 2. */
int cli_usage_error(const cli_arguments *arguments, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* The library's error text on stderr; returns the exit code of status. */
int cli_fail(const cli_arguments *arguments, koksma_status status);

/* Says that memory is exhausted, unless an error was said already, of which that may be a part; returns the exit code. */
int cli_no_memory(void);

/* Item i (0..) of a list "a,b:x=1,y=2,c": commas inside a spec's parameters don't split, because a parameter has '='
   and what follows it in a list of specs has none before its ':' or end. False past the end. */
bool cli_list_item(const char *list, size_t i, char *item, size_t size);

/* ---- Long work: threads, progress and Ctrl-C, from CLI_RUN_OPTIONS ------------------------------------ */

typedef struct cli_work {
    koksma_run run;      /* hand &work.run to the library */
    const char *what;    /* shown before the bar; may be changed while running */
    double begin, share; /* the part of the bar that run's fractions from 0 to 1 go over */
    double fraction;     /* shown; it never falls */
    double started_s, updated_s;
} cli_work;

/* False after an error. From here until cli_work_end, the first Ctrl-C makes keep_going false. */
bool cli_work_begin(const cli_arguments *arguments, const char *what, cli_work *work);
void cli_work_part(cli_work *work, size_t i, size_t n); /* what runs next is part i of n equal ones of the bar */
/* Clears the progress line, if there is one; messages and rows do so themselves. */
void cli_work_end(void);
bool cli_interrupted(void);
double cli_seconds(void);                                        /* on the clock of started_s */
const char *cli_duration(double seconds, char text[CLI_NUMBER]); /* "1 min 15 s". Returns text. */

/* Says that a study in this folder can go on; NULL: one of several ranks, of which another says it. The exit code. */
int cli_study_interrupted(const cli_arguments *arguments, const char *folder);

/* ---- Rows: aligned text, or a JSON object a line ------------------------------------------------------- */

typedef struct cli_rows cli_rows;

/* A number as all text shows it: to the digits of --digits, whole numbers and the part before the point in full, "-" for
   none. Returns text. */
const char *cli_number(double value, char text[CLI_NUMBER]);
void cli_set_style(int digits, bool all_columns); /* of --digits, --long */

/* With json, rows are printed as they end; as text, all of them at cli_rows_close. */
cli_rows *cli_rows_open(bool json);
void cli_row_text(cli_rows *rows, const char *key, const char *value);
void cli_row_number(cli_rows *rows, const char *key, double value); /* %.17g or null in JSON, else cli_number() */
void cli_row_whole(cli_rows *rows, const char *key, uint64_t value);
void cli_row_flag(cli_rows *rows, const char *key, bool value);
void cli_row_json(cli_rows *rows, const char *key, const char *json, const char *text); /* a ready JSON value */
void cli_row_end(cli_rows *rows);
/* The exit code: 0, or 4 after a line on stderr when there was no memory for the rows. */
int cli_rows_close(cli_rows *rows);

#endif
