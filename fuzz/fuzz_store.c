/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Damaged and forged databases of studies. The first byte of the input chooses what is done with the database: export, run
 * and report, the same without the plan's file, or audit. The second chooses the kind of change, of which the other bytes
 * are a list:
 *   bytes    3 bytes of offset, one of length, the bytes that are put there; length 0 cuts the file off
 *   values   table, row, column, one byte each, and the kind of the new value, its length and its bytes
 */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <sqlite3.h>

#include <koksma/study.h>

#include "study/store/store_internal.h"
#include "target.h"

static const char plan[] =
    "{\"name\": \"f\", \"title\": \"f\", \"discrepancies\": [{\"id\": \"d\", \"patterns\": "
    "[\"random\", \"n-rooks\"], \"measures\": [\"star\", \"l2-star\", \"extreme\"], \"n\": [1, 4], "
    "\"trials\": 30}], \"questions\": [{\"id\": \"e\", \"kind\": \"table\", \"title\": \"t\", "
    "\"discrepancies\": \"d\"}]}";

enum { MAX_FILE = 1 << 18 };
typedef struct sound {
    size_t size;
    unsigned char bytes[MAX_FILE];
} sound;

static sound base;
static char folder[64], database[80], plan_path[80];

/* Removes the files of a folder below `folder`, and of `folder` if name is NULL, and the folder. */
static void remove_folder(const char *name)
{
    char path[400];
    snprintf(path, sizeof path, "%s%s%s", folder, name ? "/" : "", name ? name : "");
    DIR *entries = opendir(path);
    const size_t length = strlen(path);
    for (struct dirent *e; entries && (e = readdir(entries));) {
        if (e->d_name[0] == '.' && (!e->d_name[1] || e->d_name[1] == '.')) {
            continue;
        }
        snprintf(path + length, sizeof path - length, "/%s", e->d_name);
        if (unlink(path) && !name) {
            remove_folder(e->d_name);
        }
    }
    if (entries) {
        closedir(entries);
    }
    path[length] = '\0';
    rmdir(path);
}

static void clean_up(void)
{
    remove_folder(NULL);
}

static void write_file(const char *path, const void *bytes, size_t size)
{
    FILE *f = fopen(path, "wb");
    if (!f || fwrite(bytes, 1, size, f) != size || fclose(f)) {
        abort();
    }
}

static void read_base(const char *path, sound *to)
{
    FILE *f = fopen(path, "rb");
    if (!f) {
        abort();
    }
    to->size = fread(to->bytes, 1, sizeof to->bytes, f);
    if (fclose(f) || to->size == 0 || to->size == sizeof to->bytes) {
        abort();
    }
}

static bool a_while(void *context, double fraction)
{
    int *looks = context;
    (void)fraction;
    return ++*looks < 100000;
}

static void run_study(const char *with_plan)
{
    int looks = 0;
    const koksma_study_options options = {.plans = &with_plan, .n_plans = with_plan != NULL, .folder = folder};
    const koksma_run run = {.threads = 1, .time_limit_s = 0.5, .keep_going = a_while, .context = &looks};
    koksma_study *study = NULL;
    koksma_status status = koksma_study_open(&options, &study);
    fuzz_check_status(status);
    if (!status) {
        fuzz_check_status(koksma_study_run(study, &run, NULL));
        fuzz_check_status(koksma_study_report(study, &run));
    }
    fuzz_check_status(koksma_study_close(study));
}

static void audit(void)
{
    int looks = 0;
    const koksma_audit_options options = {.folder = folder, .rows = 10, .seed = 1};
    const koksma_run run = {.threads = 1, .time_limit_s = 0.5, .keep_going = a_while, .context = &looks};
    koksma_audit result;
    fuzz_check_status(koksma_study_audit(&options, &run, &result));
}

static void make_base(void)
{
    snprintf(folder, sizeof folder, "%s/koksma-fuzz-store-XXXXXX", fuzz_place());
    if (!mkdtemp(folder)) {
        abort();
    }
    atexit(clean_up);
    snprintf(database, sizeof database, "%s/results.sqlite", folder);
    snprintf(plan_path, sizeof plan_path, "%s/plan.json", folder);
    write_file(plan_path, plan, sizeof plan - 1);
    run_study(plan_path);
    read_base(database, &base);
}

/* Writes the file with its bytes changed as the input says. */
static void damage(const uint8_t *bytes, size_t size)
{
    static unsigned char damaged[MAX_FILE];
    memcpy(damaged, base.bytes, base.size);
    size_t left = base.size;
    for (size_t i = 0; i + 4 <= size;) {
        const size_t offset = (bytes[i] | (size_t)bytes[i + 1] << 8 | (size_t)bytes[i + 2] << 16) % (base.size + 1);
        size_t length = bytes[i + 3];
        i += 4;
        length = length < size - i ? length : size - i;
        if (length == 0) {
            left = offset;
        }
        length = length < base.size - offset ? length : base.size - offset;
        memcpy(damaged + offset, bytes + i, length);
        i += length;
    }
    write_file(database, damaged, left);
}

/* The tables with values, and the columns that lead to one row. */
static const struct {
    const char *name, *key;
} tables[] = {{"meta", "key"},    {"series", "id"},
              {"result", "id"},   {"failed", "id"},
              {"left_out", "id"}, {"reference", "scene, scene_hash, options, width, height, reference, made_by"}};
enum { N_TABLES = sizeof tables / sizeof *tables };

/* The kinds of a new value. A row is removed where it would be DELETE. */
enum { WHOLE, REAL, TEXT, NOTHING, DELETE, N_KINDS };

static const char *text_at(sqlite3_stmt *row, int column)
{
    const char *text = (const char *)sqlite3_column_text(row, column);
    return text ? text : "";
}

/* NULL: SQLite refuses the statement. */
static sqlite3_stmt *prepare(sqlite3 *store, const char *sql)
{
    sqlite3_stmt *row = NULL;
    sqlite3_prepare_v2(store, sql, -1, &row, NULL);
    return row;
}

static void bind_value(sqlite3_stmt *row, int kind, const uint8_t *bytes, size_t size)
{
    int64_t whole = 0;
    double real = 0;
    memcpy(&whole, bytes, size < sizeof whole ? size : sizeof whole);
    memcpy(&real, bytes, size < sizeof real ? size : sizeof real);
    if (kind == WHOLE) {
        sqlite3_bind_int64(row, 1, whole);
    } else if (kind == REAL) {
        sqlite3_bind_double(row, 1, real);
    } else if (kind == TEXT) {
        sqlite3_bind_text(row, 1, (const char *)bytes, (int)size, SQLITE_TRANSIENT);
    } /* else NULL */
}

/* Writes the file with values of its tables changed as the input says. What SQLite refuses (a value
   of another type, a key that is there) is left out. */
static void forge(const uint8_t *bytes, size_t size)
{
    write_file(database, base.bytes, base.size);
    sqlite3 *store;
    if (sqlite3_open(database, &store)) {
        abort();
    }
    sqlite3_exec(
        store, "PRAGMA journal_mode = DELETE; PRAGMA synchronous = OFF; PRAGMA ignore_check_constraints = ON; BEGIN",
        NULL, NULL, NULL);
    for (size_t i = 0; i + 5 <= size;) {
        const int table = bytes[i] % N_TABLES, kind = bytes[i + 3] % N_KINDS;
        const size_t left = size - i - 5, length = bytes[i + 4] < left ? bytes[i + 4] : left;
        char sql[400];
        snprintf(sql, sizeof sql, "SELECT name FROM pragma_table_info('%s') WHERE cid = %d", tables[table].name,
                 bytes[i + 2] % 16);
        sqlite3_stmt *row = prepare(store, sql);
        char column[40] = "";
        if (row && sqlite3_step(row) == SQLITE_ROW) {
            snprintf(column, sizeof column, "%s", text_at(row, 0));
        }
        sqlite3_finalize(row);
        snprintf(sql, sizeof sql, "WHERE (%s) = (SELECT %s FROM %s LIMIT 1 OFFSET %d)", tables[table].key,
                 tables[table].key, tables[table].name, bytes[i + 1]);
        char change[500];
        if (kind < DELETE) {
            snprintf(change, sizeof change, "UPDATE OR IGNORE %s SET %s = ? %s", tables[table].name, column, sql);
        } else {
            snprintf(change, sizeof change, "DELETE FROM %s %s", tables[table].name, sql);
        }
        row = *column ? prepare(store, change) : NULL;
        if (row) {
            bind_value(row, kind, bytes + i + 5, length);
            sqlite3_step(row);
            sqlite3_finalize(row);
        }
        i += 5 + length;
    }
    if (sqlite3_exec(store, "COMMIT", NULL, NULL, NULL) || sqlite3_close(store)) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (!base.size) {
        make_base();
    }
    if (size < 2) {
        return 0;
    }
    char side[96];
    snprintf(side, sizeof side, "%s-wal", database);
    remove(side);
    snprintf(side, sizeof side, "%s-journal", database);
    remove(side);
    if (bytes[1] % 2) {
        forge(bytes + 2, size - 2);
    } else {
        damage(bytes + 2, size - 2);
    }
    switch (bytes[0] % 4) {
    case 0:
        fuzz_check_status(koksma_study_export(folder, KOKSMA_EXPORT_CSV, "/dev/null"));
        break;
    case 1:
        run_study(plan_path);
        break;
    case 2:
        run_study(NULL);
        break;
    default:
        audit();
        break;
    }
    return 0;
}
