/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Types and functions that all commands use. Each command is one file that defines one cli_command; its option table
 * parses the command line and prints the help. Results go to stdout, messages to stderr; exit codes are those of
 * koksma_status_exit_code().
 */
#ifndef KOKSMA_CLI_CLI_H
#define KOKSMA_CLI_CLI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <koksma/koksma.h>
#include <koksma/series.h>
#include <koksma/study.h>

enum { CLI_MAX_OPTIONS = 32, CLI_YES = 0, CLI_NO = 1, CLI_USAGE = 2, CLI_DIGITS = 5, CLI_NUMBER = 32 };

typedef struct cli_option {
    char letter;      /* 0: no short option */
    const char *name; /* an option table ends at a NULL name */
    /* NULL for a flag. Otherwise the text that --help shows for the argument: its choices ("csv|json|npy"), or a noun
       ("FILE"), with ",.." behind it for a list ("MEASURE,.."). If the text ends in "...", the option may be
       repeated; its values are joined, one per line. For a file to write the text has the endings that are accepted
       ("FILE.txt|.csv"). The noun decides which completions the completion scripts offer. */
    const char *argument;
    const char *help;
} cli_option;

typedef struct cli_arguments cli_arguments;

typedef struct cli_command {
    const char *name, *summary;
    const char *synopsis; /* operands and options after "koksma NAME", one line per usage */
    const char *details;  /* text for --help; its lines are joined into paragraphs (cli/paragraphs.c); may be NULL */
    const char *
        examples; /* command lines for --help, one per line; tests run them, long ones shortened (tests/docs/readme.sh) */
    const cli_option *options;
    int (*run)(const cli_arguments *arguments); /* returns the exit code */
} cli_command;

struct cli_arguments {
    const cli_command *command;
    int n_operands;
    char **operands;
    /* values[i] of option i: "" for a flag that is set, NULL when the option is not given */
    const char *values[CLI_MAX_OPTIONS];
    char *joined[CLI_MAX_OPTIONS]; /* the joined values of repeated options, to be freed */
    char **made;                   /* operands that the options -p and -n have added (cli/source.c), to be freed */
    int n_made;
};

#define COMMAND(name) extern const cli_command cli_command_##name;
#include "commands.def"
#undef COMMAND

/* Returns command i in the order of the help, or NULL past the end. */
const cli_command *cli_command_at(size_t i);

/* Finds a command by its name. Returns NULL when there is no such command. */
const cli_command *cli_command_find(const char *name);

/* Options that most commands have, for the end of an option table. */
#define CLI_ROW_OPTIONS                                                                                              \
    {0, "format", "text|csv|latex",                                                                                  \
     "print rows as CSV with all digits, or as a LaTeX table of the package booktabs (default: text)"},              \
        CLI_JSON_OPTIONS
#define CLI_JSON_OPTIONS                                                                                             \
    {0, "json", NULL, "print rows as JSON, one object per line, instead of aligned text"},                           \
        {0, "long", NULL, "print all columns, also those that do not fit the terminal"},                             \
    {                                                                                                                \
        0, "digits", "N",                                                                                            \
            "significant digits of numbers in text output, 1 to 17 (default: 5; JSON and CSV have all)"              \
    }
#define CLI_RUN_OPTIONS                                                                                              \
    {0, "threads", "T", "threads to use (default: all)"},                                                            \
        {0, "progress", "auto|always|never", "show progress (default: auto, when stderr is a terminal)"},            \
        {0, "allow-exec", NULL, "allow the patterns exec:PROGRAM and plugin:LIBRARY to run code of others"},         \
        {0, "exec-seconds", "S",                                                                                     \
         "with --allow-exec, or integrate --with: seconds a program may take for one set (default: 60)"},            \
    {                                                                                                                \
        'q', "quiet", NULL, "print only errors to stderr"                                                            \
    }

/* This option is read before the command runs, because it applies to every scene that the command opens. */
#define CLI_UNKNOWN_OPTION                                                                                           \
    {                                                                                                                \
        0, "unknown", "approximate|refuse",                                                                          \
            "unknown parts of pbrt, Mitsuba and model files cause a warning (approximate, default) or an error "     \
            "(refuse); in JSON they always are errors"                                                               \
    }

/* cli_text returns the text of an option, or `fallback` when the option is not given; cli_flag returns whether a flag
   is set. The option table must contain an option of that name. */
const char *cli_text(const cli_arguments *arguments, const char *name, const char *fallback);
const char *cli_given(const cli_arguments *arguments, const char *name); /* NULL, too, if there is no such option */
const cli_option *cli_option_of(const cli_option *options, const char *name); /* NULL: none of that name */
bool cli_flag(const cli_arguments *arguments, const char *name);

/* Reads the whole number that text begins with, as in 100 or 1e5, and sets *end to what follows it. Returns false if it
   begins with none (then *end is text), or with one above 2^64 - 1. */
bool cli_digits(const char *text, uint64_t *out, const char **end);

/* Reads an option as a whole number in [min, max], or takes `fallback`. Returns false after an error that names the
   option. */
bool cli_whole(const cli_arguments *arguments, const char *name, uint64_t fallback, uint64_t min, uint64_t max,
               uint64_t *out);
/* Reads `text`, which is the value of the option `name` or a part of that value, as a whole number in [min, max].
   Returns false after an error. */
bool cli_is_whole(const cli_arguments *arguments, const char *name, const char *text, uint64_t min, uint64_t max,
                  uint64_t *out);
/* Whether the seeds of so many trials, from `seed` on, are at most UINT64_MAX. Returns false after an error. */
bool cli_seeds_fit(const cli_arguments *arguments, uint64_t seed, uint64_t trials);
/* Reads --seed and --trials T, 1 to `max`. Returns false after an error, also where T is given and T seeds from the first
   on exceed UINT64_MAX. */
bool cli_trials(const cli_arguments *arguments, uint64_t fallback, uint64_t max, uint64_t *seed, uint64_t *trials);
/* Reads `list`, which is the value of the option `name`, as up to KOKSMA_MAX_SIZES different whole numbers in [1, max].
   also: for the error message, what else the option takes ("powers, or "), or "". Returns false after an error. */
bool cli_sizes(const cli_arguments *arguments, const char *name, const char *list, const char *also, uint64_t max,
               size_t sizes[KOKSMA_MAX_SIZES], size_t *n);
/* Reads --size WxH; without this option *width and *height do not change. Returns false after an error. */
bool cli_size(const cli_arguments *arguments, int *width, int *height);
/* Reads an option whose argument lists its choices, "all|one|power"; *choice is the index of the one that is given, and
   does not change if none is. Returns false after an error. */
bool cli_choice(const cli_arguments *arguments, const char *name, int *choice);
/* Returns false, after an error "--NAME WHY", if one of the options `names`, which blanks separate, is given. */
bool cli_refuse(const cli_arguments *arguments, const char *names, const char *why, ...) KOKSMA_PRINTF(3, 4);
bool cli_real(const cli_arguments *arguments, const char *name, double fallback, double min, double max, double *out);

/* Says in text what is meant by -NAME or -N=VALUE, or by an option in place of a value. Returns whether
   it is such a slip. */
bool cli_slip(const cli_option *options, const char *word, const char *value, char text[128]);

/* Writes "did you mean --NAME? " for an option that a command lacks, or "", or what else would do; returns the text. */
const char *cli_meant_option(const cli_option *options, const char *name, char text[128]);

/* Writes "did you mean 'NAME'? " to `text` and returns it. NAME is the name in a table that is closest to `word`
   (koksma_closest_name()); if no name is close, or `word` is one, the text is empty. */
const char *cli_meant(const char *word, koksma_name_at *name, const void *table, char text[96]);

enum { CLI_KNOWN = 1024 };

/* Writes what else `word` is, and where it goes, "; 'sobol' is a pattern, as in '-p sobol'": the name of a member of
   another table, or a file; "" if it is unknown. arguments: those of the command, or NULL. Returns the text. */
const char *cli_known_as(const cli_arguments *arguments, const char *word, char text[CLI_KNOWN]);

/* Writes to `known` what the word is that an error of the library is about, "no pattern 'star'" or a missing file, as
   cli_known_as does. Returns how much of the error's text stays before it. */
int cli_explain(const cli_arguments *arguments, koksma_status status, const char *text, char known[CLI_KNOWN]);

/* What would work where a command has an error of this text; "": unknown. */
const char *cli_remedy(const char *command, const char *text);

/* Prints that `word` is no command, and what it is or means; `command`: as in cli_say. */
void cli_no_command(const char *command, const char *word);

/* What an operand too many is probably for: "; -o FILE ..", "; -n N ..", what it is (cli_known_as), or "". Returns `text`
   or a constant. */
const char *cli_operand_hint(const cli_arguments *arguments, const char *operand, char text[CLI_KNOWN]);

/* Like cli_meant, for a list of names as messages write it, such as "auto, always or never". */
const char *cli_meant_of(const char *word, const char *list, char text[96]);

/* The three functions below return the name of command, integrator or filter i, or NULL past the end, for
   cli_meant(); `table` is not used. */
const char *cli_command_name(const void *table, size_t i);
const char *cli_integrator_name(const void *table, size_t i);
const char *cli_filter_name(const void *table, size_t i);

/* Returns a name or path as one line of valid UTF-8 (koksma_text_escape), cut to 4095 bytes. The result is valid until
   the fourth next call. */
const char *cli_one_line(const char *text);

/* Prints "koksma NAME: text" on stderr. The text becomes one line of valid UTF-8: koksma_text_escape() escapes other
   characters. command: the NAME, or "" for a message of the program as a whole. */
void cli_say(const char *command, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Prints a message about a mistake in the command line, as cli_say does; under mpirun only rank 0 of `study` and
   `reproduce` does. Returns the exit code 2. */
int cli_usage_error(const cli_arguments *arguments, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Prints the library's error text on stderr. Returns the exit code of `status`. */
int cli_fail(const cli_arguments *arguments, koksma_status status);

/* Prints that memory is exhausted. It prints nothing if an error was printed before, because that error may have the
   same cause. Returns the exit code. */
int cli_no_memory(void);

/* Copies item i (0..) of a list such as "a,b:x=1,y=2,c" to `item`: that list has the items "a", "b:x=1,y=2" and "c".
   A comma between two parameters of a spec does not separate items. Returns false past the end of the list. */
bool cli_list_item(const char *list, size_t i, char *item, size_t size);

/* ---- Long work: threads, progress and Ctrl-C, from CLI_RUN_OPTIONS ------------------------------------ */

typedef struct cli_work {
    koksma_run run;      /* the caller passes &work.run to the library */
    const char *what;    /* the text before the progress bar; may be changed while running */
    double begin, share; /* a progress p of `run`, 0 to 1, is shown as begin + share * p */
    double fraction;     /* the progress shown so far, 0 to 1; it never decreases */
    double reached;      /* the largest progress that `run` reported in this part */
    bool unknown;        /* the progress of this part is not known: the line shows the time so far */
    double part_s;       /* the start of this part */
    double limit_s;      /* the work takes at most this number of seconds; 0: unknown */
    bool visible;        /* there is a progress line */
    bool hidden;         /* show nothing */
    double started_s, updated_s;
} cli_work;

/* Reads CLI_RUN_OPTIONS and starts the clock of the progress line. Returns false after an error. From this call on
   the first Ctrl-C makes keep_going return false. */
bool cli_work_begin(const cli_arguments *arguments, const char *what, cli_work *work);
/* Begins part i (0..) of n equal parts of the progress bar. */
void cli_work_part(cli_work *work, size_t i, size_t n);
/* Begins the last part of the progress bar, from `begin` to its end. */
void cli_work_rest(cli_work *work, double begin);
/* Begins work of unknown length, such as making the points of a part, up to the next call of cli_work_part. */
void cli_work_unknown(cli_work *work, const char *what);
/* Clears the progress line and shows none from now on, because the output that follows would mix with it on the
   terminal. */
void cli_work_hide(cli_work *work);
/* Clears the progress line if one is shown. Printing a message or a row clears it, too. */
void cli_work_end(void);
bool cli_interrupted(void);
double cli_seconds(void);                                        /* the monotonic clock's time, as in started_s */
const char *cli_duration(double seconds, char text[CLI_NUMBER]); /* writes "1 min 15 s" or so to `text`; returns it */

/* ---- Rows: aligned text, or one JSON object per line --------------------------------------------------- */

typedef struct cli_rows cli_rows;

/* Writes a number to `text` as all text output shows it, and returns `text`. It is rounded to as many significant
   digits as --digits says, without zeros at the end; but below 1e15 all digits before the decimal point are written.
   Infinity and NaN are "-". */
const char *cli_number(double value, char text[CLI_NUMBER]);
void cli_set_style(int digits, bool all_columns); /* sets the values of --digits and --long */
enum { CLI_TEXT, CLI_CSV, CLI_LATEX };
void cli_set_format(int format); /* sets the value of --format */

/* Begins the output of rows. With json each row is printed when it ends; as text all rows are printed by
   cli_rows_close. */
cli_rows *cli_rows_open(bool json);
void cli_row_text(cli_rows *rows, const char *key, const char *value);
void cli_row_number(cli_rows *rows, const char *key, double value); /* a number: %.17g or null in JSON, cli_number()
                                                                       in text */
void cli_row_whole(cli_rows *rows, const char *key, uint64_t value);
void cli_row_flag(cli_rows *rows, const char *key, bool value);
/* json: a complete JSON value */
void cli_row_json(cli_rows *rows, const char *key, const char *json, const char *text);
void cli_row_end(cli_rows *rows);
/* Prints the remaining rows and frees them. Returns the exit code: `code`, or 4 after a message on stderr when memory for
   the rows ran out and `code` is 0 or 1. */
int cli_rows_close(cli_rows *rows, int code);

/* Returns the width of the terminal that the file descriptor `stream` is connected to, in columns (the environment
   variable COLUMNS overrides it), or 0 if the descriptor is no terminal. */
int cli_terminal_width(int stream);

/* ---- The help, and the run of a command (options.c, command_help.c) ----------------------------------- */

/* cli_print_overview prints a line for each command, as `koksma --help` does. cli_print_help prints the help of one
   command on stdout. */
void cli_print_overview(FILE *stream);
extern const char cli_overview_examples[]; /* command lines, one per line: the five examples of README.md */
void cli_print_help(const cli_command *command);

/* Parses argv (argv[0] is the command's name) by the command's option table and runs the command. --help and -h print
   its help instead. Returns the exit code. */
int cli_run(const cli_command *command, int argc, char **argv);

/* ---- Names of table members in help texts (texts.c) --------------------------------------------------- */

/* Returns `command`, which is command i of the table, with the placeholders in its texts replaced; texts.c lists the
   placeholders. Later calls for the same i return the same pointer. */
const cli_command *cli_expand(const cli_command *command, size_t i);

/* Writes the endings of image files to `text` and returns it, such as ".exr, .png, .pfm or .jpg". `comma` is put
   between the endings, and `last` before the last one. */
const char *cli_image_formats(const char *comma, const char *last, char *text, size_t size);

/* Writes the names of the tables that `koksma list` prints (command_list.c) to `text`, with `comma` between them, and
   returns `text`. */
const char *cli_list_names(const char *comma, char *text, size_t size);

/* ---- Help texts in lines of at most 80 columns (paragraphs.c) ----------------------------------------- */

enum { CLI_PARAGRAPH = 2048 };

/* Prints the words of `text` on stdout and ends the line. column: where the cursor is; indent: the column where
   further lines begin. */
void cli_fill(const char *text, size_t column, size_t indent);

/* Prints one usage of a synopsis like cli_fill, but keeps text in brackets, and an option with its argument, on one
   line. */
void cli_fill_use(const char *use, size_t column, size_t indent);

/* Returns whether a line begins with a word that ends in a colon. */
bool cli_is_heading(const char *line);

/* Copies the next paragraph of a text, as one line. A paragraph ends at an empty line, or before a line whose first
   word is a heading, "word:". *apart: whether an empty line precedes the paragraph. Returns the text that follows,
   or NULL past the end. */
const char *cli_next_paragraph(const char *text, char paragraph[CLI_PARAGRAPH], bool *apart);

/* ---- Standard output, whose errors are reported with the reason of the system, and files to write (output.c) ---- */

/* Called once, before anything is printed. */
void cli_begin_output(void);

/* Flushes stdout, because a full disk causes an error only when the buffer is written. Returns the final exit code:
   `code`, or 4 after a message on stderr if `code` is 0 or 1 but stdout could not be written. */
int cli_end_output(int code);

/* Returns whether the file `path` is a stream: "-" or another name of an open descriptor, a pipe or a device. A second
   write follows the first one there, whereas it replaces a plain file. */
bool cli_is_stream(const char *path);

/* Returns whether `path` is standard output: "-", /dev/stdout, or another name of the stream behind it. */
bool cli_is_stdout(const char *path);

/* Returns whether two paths lead to the same file, which is there. */
bool cli_is_same_file(const char *a, const char *b);

/* Returns whether a file to write has an ending that its option's argument lists, "FILE.txt|.csv", or no ending; else
   it prints an error. */
bool cli_ending_fits(const cli_arguments *arguments, const char *argument, const char *path);

/* Refuses an --output that is a file which the command reads, but that of --from, which a search continues. Returns false
   after an error. */
bool cli_keeps_inputs(const cli_arguments *arguments);

/* Tries, before work that takes long, whether the file `path` can be written: its folder is there and allows new files.
   Makes nothing; NULL and streams are not tried. Returns the exit code, which is not 0 after an error. */
int cli_try_output(const cli_arguments *arguments, const char *path);

/* Returns whether the paths name one file that is written, also by another spelling or a link. Streams are none: what is
   written to them follows what was written before. */
bool cli_is_same_output(const char *a, const char *b);

/* Returns false, after an error, if --json is given and the result is written to standard output, which has no place for
   rows then. */
bool cli_check_output(const cli_arguments *arguments, const char *path);

#endif
