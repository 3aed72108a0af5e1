/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Types and functions that all commands use. Each command is one file that defines one cli_command; its option table
 * parses the command line and prints the help. Results go to stdout, messages to stderr; exit codes are those of
 * koksma_status_exit_code(). A function that reads options returns false, or an exit code that is not 0, after an error
 * that it has printed.
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

typedef struct cli_args cli_args;

typedef struct cli_command {
    const char *name, *summary;
    const char *synopsis; /* operands and options after "koksma NAME", one line per usage */
    const char *details;  /* text for --help; its lines are joined into paragraphs (cli/texts.c); may be NULL */
    const char *
        examples; /* command lines for --help, one per line; tests run them, long ones shortened (tests/docs/readme.sh) */
    const cli_option *options;
    int (*run)(const cli_args *args); /* returns the exit code */
} cli_command;

struct cli_args {
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

/* cli_text returns the text of an option, or `fallback` when the option is not given; cli_flag returns whether it is. The
   option table must contain an option of that name; cli_given returns NULL where it does not. */
const char *cli_text(const cli_args *args, const char *name, const char *fallback);
const char *cli_given(const cli_args *args, const char *name);
bool cli_flag(const cli_args *args, const char *name);
const cli_option *cli_option_of(const cli_option *options, const char *name); /* NULL: none of that name */

/* Reads the whole number that text begins with, as in 100 or 1e5, and sets *end to what follows it. Returns false if it
   begins with none (then *end is text), or with one above 2^64 - 1. */
bool cli_digits(const char *text, uint64_t *out, const char **end);

/* Read an option as a number in [min, max], or take `fallback`. */
bool cli_whole(const cli_args *args, const char *name, uint64_t fallback, uint64_t min, uint64_t max, uint64_t *out);
bool cli_real(const cli_args *args, const char *name, double fallback, double min, double max, double *out);
/* Reads `text`, which is the value of the option `name` or a part of that value, as a whole number in [min, max]. */
bool cli_is_whole(const cli_args *args, const char *name, const char *text, uint64_t min, uint64_t max,
                  uint64_t *out);
/* Whether the seeds of so many trials, from `seed` on, are at most UINT64_MAX. */
bool cli_seeds_fit(const cli_args *args, uint64_t seed, uint64_t trials);
/* Reads --seed and --trials T, 1 to `max`. */
bool cli_trials(const cli_args *args, uint64_t fallback, uint64_t max, uint64_t *seed, uint64_t *trials);
/* Reads `list`, which is the value of the option `name`, as up to KOKSMA_MAX_SIZES different whole numbers in [1, max].
   also: for the error message, what else the option takes ("powers, or "), or "". */
bool cli_sizes(const cli_args *args, const char *name, const char *list, const char *also, uint64_t max,
               size_t sizes[KOKSMA_MAX_SIZES], size_t *n);
/* Reads --size WxH; without this option *width and *height do not change. */
bool cli_size(const cli_args *args, int *width, int *height);
/* Reads an option whose argument lists its choices, "all|one|power"; *choice is the index of the one that is given, and
   does not change if none is. */
bool cli_choice(const cli_args *args, const char *name, int *choice);
/* Writes the choices of an argument, "all|one|power", as "all, one or power", and returns the text. */
const char *cli_alternatives(const char *argument, char *text, size_t size);
/* Reads a list of at most `most` numbers from min to max. Returns how many there are, or 0 if it is no such list. */
size_t cli_reals(const char *list, double min, double max, double *out, size_t most);
/* Returns false, after an error "--NAME WHY", if one of the options `names`, which blanks separate, is given. */
bool cli_refuse(const cli_args *args, const char *names, const char *why, ...) KOKSMA_PRINTF(3, 4);

/* Says in text what is meant by -NAME or -N=VALUE, or by an option in place of a value. Returns whether
   it is such a slip. */
bool cli_slip(const cli_option *options, const char *word, const char *value, char text[128]);

/* Writes "did you mean --NAME? " for an option that a command lacks, or "", or what else would do; returns the text. */
const char *cli_meant_option(const cli_option *options, const char *name, char text[128]);

enum { CLI_KNOWN = 1024 };

/* Writes what else `word` is, and where it goes, "; 'sobol' is a pattern, as in '-p sobol'": the name of a member of
   another table, or a file; "" if it is unknown. args: those of the command, or NULL. Returns the text. */
const char *cli_known_as(const cli_args *args, const char *word, char text[CLI_KNOWN]);

/* Prints that `word` is no command, and what it is or means; `command`: as in cli_say. */
void cli_no_command(const char *command, const char *word);

/* What an operand too many is probably for: "; -o FILE ..", "; -n N ..", what it is (cli_known_as), or "". Returns `text`
   or a constant. */
const char *cli_operand_hint(const cli_args *args, const char *operand, char text[CLI_KNOWN]);

/* Writes "did you mean 'NAME'? " to `text` and returns it. NAME is the name of a list as messages write it, such as "auto,
   always or never", that is closest to `word`; if no name is close, or `word` is one, the text is empty. */
const char *cli_meant_of(const char *word, const char *list, char text[96]);

/* Whether `word` is one of `words`, which blanks separate. */
bool cli_has_word(const char *words, const char *word);

/* Writes the names of a table to `text`, with `comma` between them and `last` before the last one. Returns the text. */
const char *cli_join(koksma_name_at *name, const void *table, const char *comma, const char *last, char *text,
                     size_t size);

/* Reports that `word`, which may be NULL, is none of a list of names: "WHAT did you mean 'NAME'? it takes NAMES". */
int cli_takes(const cli_args *args, const char *what, const char *word, const char *names);

/* The nouns that stand for names of the library's tables: in the arguments of options, and where a name is in the wrong
   place. Ended by a row without a noun. */
typedef struct cli_noun {
    const char *noun; /* "": no argument has it */
    koksma_name_at *name;
    bool files; /* a file may be named, too */
    const char *what, *option, *before,
        *after; /* what a name is, the option that takes it, and an example around it */
} cli_noun;
extern const cli_noun cli_nouns[];

/* Finds a noun, in small letters or capitals, which is the first `length` bytes of the text; NULL: there is none. */
const cli_noun *cli_noun_of(const char *noun, size_t length);

/* Reports that `word` is no name of the table of a noun, such as "filter". Returns the exit code. */
int cli_no_member(const cli_args *args, const char *noun, const char *word);

/* Returns a name or path as one line of valid UTF-8 (koksma_text_escape), cut to 4095 bytes. The result is valid until
   the fourth next call. */
const char *cli_one_line(const char *text);

/* Prints "koksma NAME: text" on stderr, as one line of valid UTF-8; command: the NAME, or "" for a message of the program
   as a whole. cli_note prints nothing with --quiet. */
void cli_say(const char *command, const char *format, ...) KOKSMA_PRINTF(2, 3);
void cli_note(const cli_args *args, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Appends to a text in an array of `size` bytes. */
#define CLI_APPEND(text, size, ...) snprintf((text) + strlen(text), (size)-strlen(text), __VA_ARGS__)

/* Prints a message about a mistake in the command line, as cli_say does; under mpirun only rank 0 of `study` and
   `reproduce` does. Returns the exit code 2. */
int cli_error(const cli_args *args, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Prints the library's error text on stderr. Returns the exit code of `status`. */
int cli_fail(const cli_args *args, koksma_status status);

/* Prints that memory is exhausted, unless an error was printed before, which may have the same cause. */
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

/* Reads CLI_RUN_OPTIONS and starts the clock of the progress line. From this call on the first Ctrl-C makes keep_going
   return false. */
bool cli_work_begin(const cli_args *args, const char *what, cli_work *work);
/* Begins part i (0..) of n equal parts of the progress bar, or its last part, from `begin` to its end. */
void cli_work_part(cli_work *work, size_t i, size_t n);
void cli_work_rest(cli_work *work, double begin);
/* Begins work of unknown length, such as making the points of a part, up to the next call of cli_work_part. */
void cli_work_unknown(cli_work *work, const char *what);
/* Shows the progress line, cut to the terminal's width, because a wrapped line could not be cleared. */
void cli_show_line(const char *text);
/* Clears the progress line, as a message or a row does; cli_work_hide shows none from now on, because the output that
   follows would mix with it on the terminal. */
void cli_work_end(void);
void cli_work_hide(cli_work *work);
bool cli_interrupted(void);
double cli_seconds(void);                                        /* the monotonic clock's time, as in started_s */
const char *cli_duration(double seconds, char text[CLI_NUMBER]); /* writes "1 min 15 s" or so to `text`; returns it */

/* ---- Rows: aligned text, or one JSON object per line --------------------------------------------------- */

/* Writes a number to `text` as all text output shows it, and returns `text`. It is rounded to as many significant
   digits as --digits says, without zeros at the end; but below 1e15 all digits before the decimal point are written.
   Infinity and NaN are "-". */
const char *cli_number(double value, char text[CLI_NUMBER]);
void cli_set_style(int digits, bool all_columns); /* sets the values of --digits and --long */
enum { CLI_TEXT, CLI_CSV, CLI_LATEX, CLI_JSON };
void cli_set_format(int format); /* sets the value of --format, or CLI_JSON */

/* Adds cells to the row, which with --json is printed when it ends, else by cli_rows_close: pairs of a key and a
   conversion, as in "pattern %s n %zu value %g". %s: a text, NULL if there is none. %g: a number; all digits in JSON and
   CSV, cli_number() in text. %d, %lld, %llu, %zu: a whole number. "key? %d" is a flag, of which -1 says that it is
   unknown. A line's end at the end of `fields` ends the row. */
void cli_row(const char *fields, ...) KOKSMA_PRINTF(1, 2);

/* Cells whose keys are no constants, or with a JSON value of their own. */
void cli_row_text(const char *key, const char *value);
void cli_row_number(const char *key, double value);
void cli_row_json(const char *key, const char *json, const char *text);
void cli_row_end(void);
/* Prints the remaining rows and frees them. Returns the exit code: `code`, or 4 after a message on stderr when memory for
   the rows ran out and `code` is 0 or 1. */
int cli_rows_close(int code);

/* Returns the width of the terminal that the file descriptor `stream` is connected to, in columns (the environment
   variable COLUMNS overrides it), or 0 if the descriptor is no terminal. */
int cli_terminal_width(int stream);

/* ---- The help, and the run of a command (run.c, texts.c, command_help.c) ----------------------------------- */

/* Print a line for each command, as `koksma --help` does, and the help of one command on stdout. */
void cli_print_overview(FILE *stream);
void cli_print_help(const cli_command *command);
extern const char cli_overview_examples[]; /* command lines, one per line: the five examples of README.md */

/* Parses argv (argv[0] is the command's name) by the command's option table and runs the command, or prints its help. */
int cli_run(const cli_command *command, int argc, char **argv);

/* ---- Help texts: names of table members in them, and their lines of at most 80 columns (texts.c) ------ */

/* Returns `command`, which is command i of the table, with the placeholders in its texts replaced, which texts.c lists. */
const cli_command *cli_expand(const cli_command *command, size_t i);

/* Writes the names of the tables of `koksma list`, as cli_join does. */
const char *cli_list_names(const char *comma, char *text, size_t size);

enum { CLI_PARAGRAPH = 2048 };

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
   write follows the first one there, whereas it replaces a plain file. cli_is_stdout: whether it is standard output. */
bool cli_is_stream(const char *path);
bool cli_is_stdout(const char *path);

/* Returns whether two paths lead to the same file, which is there. */
bool cli_is_same_file(const char *a, const char *b);

/* Tries, before work that takes long, whether the file `path` can be written: its folder is there and allows new files.
   Makes nothing; NULL and streams are not tried. */
int cli_try_output(const cli_args *args, const char *path);

#endif
