/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma completion`: prints completion scripts for bash, zsh and fish. A script hands the words of the command line to
   `koksma completion words`, which prints what fits, from the option tables that parse the command line. The text of an
   option's argument tells what to offer: alternatives with | between them, or a noun of cli_nouns or `files`. All
   other nouns are numbers, for which nothing is offered. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/integrate.h>

#include "cli.h"

/* Nouns for which files are offered, besides those of cli_nouns. */
static const char files[] = "FILE DIR OUT PATH PLACES IMAGE REFERENCE RENDERER";

/* The word at the cursor. Its first `kept` characters stay, such as "--measures=star,"; the rest is completed. */
typedef struct cursor {
    const char *word;
    size_t kept;
    bool files;    /* files may be meant, too */
    size_t offers; /* number of words printed */
} cursor;

/* Prints a word of the given length if the rest of the word at the cursor begins it. ending: further characters of the
   word; help: its description, or NULL. */
static void offer(cursor *c, const char *word, size_t length, const char *ending, const char *help)
{
    const char *rest = c->word + c->kept;
    if (strlen(rest) <= length && !strncmp(word, rest, strlen(rest))) {
        printf("%.*s%.*s%s%s%s\n", (int)c->kept, c->word, (int)length, word, ending, help ? "\t" : "",
               help ? help : "");
        c->offers++;
    }
}

static void offer_noun(cursor *c, const char *text, size_t length)
{
    char noun[32];
    const char *name;
    const cli_noun *known = cli_noun_of(text, length);
    snprintf(noun, sizeof noun, "%.*s", (int)length, text);
    c->files = c->files || (known && known->files) || cli_has_word(files, noun);
    for (size_t k = 0; known && length && (name = known->name(NULL, k)); k++) {
        offer(c, name, strlen(name), "", NULL);
    }
}

static const char lower[] = "abcdefghijklmnopqrstuvwxyz0123456789-", upper[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* Returns the length of the literal word at `at`, one of the alternatives of a text, or 0 if it is a noun. */
static size_t literal(const char *at)
{
    const size_t length = strspn(at, lower), whole = strcspn(at, "| \n");
    return islower((unsigned char)*at) && strspn(at + length, "]") == whole - length ? length : 0;
}

/* Offers what the first word of `text` stands for: alternatives with | between them, each a literal word or a noun. In
   a list with commas ("MEASURE,..") the finished items stay. */
static void offer_text(cursor *c, const char *text)
{
    const char *end = text + strcspn(text, " \n"), *list = strstr(text, ",.."), *comma = strrchr(c->word, ',');
    if (list && list < end && comma && (size_t)(comma + 1 - c->word) > c->kept) {
        c->kept = (size_t)(comma + 1 - c->word);
    }
    for (const char *at = text + strspn(text, "["), *next; at < end; at = next + strspn(next, "|]")) {
        next = at + strcspn(at, "| \n");
        if (literal(at)) {
            offer(c, at, literal(at), "", NULL);
            continue;
        }
        for (const char *s = at; s < next; s += strspn(s, upper) ? strspn(s, upper) : 1) {
            offer_noun(c, s, strspn(s, upper));
        }
    }
}

/* ---- Specs: "sobol:scramble=owen" ---------------------------------------------------------------------- */

/* Returns the parameters of the pattern, measure, integrand or adaptive method `name`, or NULL if nothing has this
   name. */
static const koksma_param *params_of(const char *name)
{
    const koksma_pattern *pattern = koksma_pattern_find(name);
    const koksma_measure *measure = koksma_measure_find(name);
    const koksma_adaptive *adaptive = koksma_adaptive_find(name);
    const koksma_integrand *integrand = koksma_integrand_find(name);
    return pattern     ? pattern->params
           : measure   ? measure->params
           : integrand ? integrand->params
           : adaptive  ? adaptive->params
                       : NULL;
}

/* Completes a word that ends in an unfinished spec, such as "a,sobol:scr": offers "NAME=" for each parameter and
   modifier, or, after the "NAME=" of a parameter, its choices. After "pattern:" it offers the names of patterns. */
static void offer_specs(cursor *c)
{
    const char *colon = strrchr(c->word, ':'), *begin = colon;
    char name[64];
    while (begin && begin > c->word && strchr(lower, begin[-1])) {
        begin--;
    }
    if (!colon) {
        return;
    }
    snprintf(name, sizeof name, "%.*s", (int)(colon - begin), begin);
    const char *last = strrchr(colon, ',') ? strrchr(colon, ',') + 1 : colon + 1, *is = strchr(last, '=');
    c->kept = (size_t)((is ? is + 1 : last) - c->word);
    if (!strcmp(name, "pattern")) {
        offer_noun(c, "PATTERN", strlen("PATTERN"));
    }
    for (const koksma_param *p = params_of(name); p && p->name; p++) {
        if (!is) {
            offer(c, p->name, strlen(p->name), "=", NULL);
        }
        const bool named = is && strlen(p->name) == (size_t)(is - last) && !strncmp(p->name, last, strlen(p->name));
        for (size_t i = 0; named && p->choices && p->choices[i]; i++) {
            offer(c, p->choices[i], strlen(p->choices[i]), "", NULL);
        }
    }
    for (size_t i = 0; koksma_pattern_find(name) && !is && koksma_modifier_at(i); i++) {
        offer(c, koksma_modifier_at(i)->name, strlen(koksma_modifier_at(i)->name), "=", NULL);
    }
}

/* ---- Operands: the lines of a synopsis, "VERB FILE" or "FILE" ----------------------------------------- */

/* Returns whether a usage begins with literal words to choose from, such as "run|new", of which one is `word`. */
static bool is_verb(const char *usage, const char *word)
{
    const char *end = usage + strcspn(usage, " \n");
    for (const char *at = usage + strspn(usage, "["); at < end && literal(at); at += literal(at) + 1) {
        if (strlen(word) == literal(at) && !strncmp(at, word, literal(at))) {
            return true;
        }
    }
    return false;
}

/* Offers what follows a verb among the n earlier words or, if there is none, what may be the first operand. */
static void offer_operands(cursor *c, const cli_command *command, char **earlier, int n)
{
    for (int only_after_verbs = 1; only_after_verbs >= 0; only_after_verbs--) {
        for (const char *usage = command->synopsis; usage; usage = strchr(usage, '\n')) {
            usage += *usage == '\n';
            for (int i = 0; only_after_verbs && i < n; i++) {
                if (is_verb(usage, earlier[i])) {
                    const char *next = usage + strcspn(usage, " \n");
                    next += strspn(next, " ");
                    offer_text(c, !strncmp(next, "[-", 2) ? "" : next + strspn(next, "'"));
                    return;
                }
            }
            if (!only_after_verbs) {
                offer_text(c, usage);
            }
        }
    }
}

/* ---- Options ------------------------------------------------------------------------------------------- */

/* Returns the option that takes an argument and that `word` names, as -x or as --name up to an equals sign; else NULL. */
static const cli_option *with_argument(const cli_command *command, const char *word)
{
    const size_t length = strcspn(word, "=");
    for (const cli_option *o = command->options; o->name && *word == '-'; o++) {
        const bool is_long =
            word[1] == '-' && strlen(o->name) + 2 == length && !strncmp(word + 2, o->name, length - 2);
        if (o->argument && (is_long || (length == 2 && o->letter == word[1]))) {
            return o;
        }
    }
    return NULL;
}

static void offer_options(cursor *c, const cli_command *command)
{
    for (const cli_option *o = command->options; o->name; o++) {
        char name[64];
        if (o->letter) {
            offer(c, (char[]){'-', o->letter}, 2, "", o->help);
        }
        offer(c, name, (size_t)snprintf(name, sizeof name, "--%s", o->name), "", o->help);
    }
    offer(c, "-h", 2, "", "what it does");
    offer(c, "--help", 6, "", "what it does");
}

/* Prints what may stand for the last of the words behind "koksma", one a line, with a tab and a description where there
   is one; ":files" in the last line: files may be meant, too. */
static int put_words(char **words, int n)
{
    cursor c = {.word = n > 0 ? words[n - 1] : ""};
    const cli_command *command = n > 1 ? cli_command_find(words[0]) : NULL;
    const char *is = !strncmp(c.word, "--", 2) ? strchr(c.word, '=') : NULL;
    const cli_option *option = !command ? NULL
                               : is     ? with_argument(command, c.word)
                               : n > 2  ? with_argument(command, words[n - 2])
                                        : NULL;
    for (size_t i = 0; n < 2 && cli_command_at(i); i++) {
        offer(&c, cli_command_at(i)->name, strlen(cli_command_at(i)->name), "", cli_command_at(i)->summary);
    }
    if (!command) {
        return CLI_YES;
    }
    offer_specs(&c);
    if (c.offers) {
        return CLI_YES;
    }
    c.kept = is ? (size_t)(is + 1 - c.word) : 0;
    if (option) {
        offer_text(&c, option->argument);
    } else if (*c.word == '-') {
        offer_options(&c, command);
    } else {
        offer_operands(&c, command, words + 1, n - 2);
    }
    printf(c.files ? ":files\n" : "");
    return CLI_YES;
}

/* ---- The scripts --------------------------------------------------------------------------------------- */

/* Bash splits words at colons and equals signs and replaces only the part after the last of these, so the part before it
   goes from the words. */
static const struct {
    const char *name, *script;
} shells[] = {
    {"bash",
     "# bash completion for koksma, made by `koksma completion bash`.\n"
     "_koksma() {\n"
     "  local line=${COMP_LINE:0:COMP_POINT} words IFS=$' \\t\\n'\n"
     "  read -ra words <<<\"$line\"\n"
     "  [[ $line != *' ' ]] || words+=('')\n"
     "  local word=${words[${#words[@]}-1]} IFS=$'\\n'\n"
     "  COMPREPLY=($(koksma completion words -- \"${words[@]:1}\" 2>/dev/null | cut -f1))\n"
     "  local last=$((${#COMPREPLY[@]} - 1))\n"
     "  if [ \"${COMPREPLY[*]: -1}\" = :files ]; then unset \"COMPREPLY[last]\"; else compopt +o default; fi\n"
     "  if [[ ${COMPREPLY[0]} = *= ]]; then compopt -o nospace; fi\n"
     "  if [[ $COMP_WORDBREAKS = *:* ]]; then COMPREPLY=(\"${COMPREPLY[@]#\"${word%\"${word##*[:=]}\"}\"}\"); fi\n"
     "}\n"
     "complete -o default -F _koksma koksma\n"},
    {"zsh",
     "#compdef koksma\n# zsh completion for koksma, made by `koksma completion zsh`.\n"
     "local -a offers=(${(f)\"$(koksma completion words -- \"${(@)words[2,CURRENT]}\" 2>/dev/null | cut -f1)\"})\n"
     "local -a names=(${offers:#(*=|:files)}) keys=(${(M)offers:#*=})\n"
     "if (( $#keys )); then compadd -S '' -- $keys; fi\n"
     "if (( $#names )); then compadd -- $names; fi\n"
     "if [[ $offers[-1] = :files ]]; then _files; fi\n"},
    {"fish", "# fish completion for koksma, made by `koksma completion fish`.\n"
             "function __koksma\n"
             "    set -l words (commandline -opc) (commandline -ct)\n"
             "    for offer in (koksma completion words -- $words[2..-1] 2>/dev/null)\n"
             "        test $offer = :files; and __fish_complete_path (commandline -ct); or echo $offer\n"
             "    end\n"
             "end\n"
             "complete -c koksma -f -a '(__koksma)'\n"},
};

static int run(const cli_args *args)
{
    if (args->n_operands > 0 && !strcmp(args->operands[0], "words")) {
        return put_words(args->operands + 1, args->n_operands - 1);
    }
    for (size_t i = 0; args->n_operands == 1 && i < sizeof shells / sizeof *shells; i++) {
        if (!strcmp(args->operands[0], shells[i].name)) {
            fputs(shells[i].script, stdout);
            return CLI_YES;
        }
    }
    char meant[96] = "";
    return cli_error(args, "%sit takes one of bash, zsh, fish, or words -- WORD..",
                     args->n_operands ? cli_meant_of(args->operands[0], "bash, zsh, fish, words", meant) : "");
}

static const cli_option options[] = {{0}};

const cli_command cli_command_completion = {
    .name = "completion",
    .summary = "print a shell's completion script",
    .synopsis = "bash|zsh|fish\nwords -- [WORD]..",
    .details = "To use it in bash, run: source <(koksma completion bash). 'make install' installs the scripts in the "
               "folders in which the shells search.\n"
               "words: prints what may stand for the last word of a command line, for the scripts.",
    .examples = "koksma completion bash >koksma.bash\n",
    .options = options,
    .run = run,
};
