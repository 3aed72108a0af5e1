/* SPDX-License-Identifier: Apache-2.0 */
/*
 * POSIX on Windows: paths in UTF-8 become wide ones, made absolute and with the prefix \\?\ where they are long, which
 * lifts the limit of 260 characters. A file's st_dev and st_ino are its volume's number and its index there.
 * Streams into memory are temporary files that the system removes when they are closed. Long because it has every call.
 */
#ifdef _WIN32
#include "core/platform/windows.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdbool.h>
#include <windows.h>

#undef stat
#undef fstat
#undef fopen
#undef open
#undef fclose

enum { LONG_PATH = 240, MODES = 8, MOST_OPEN = 64 };

/* ---- Paths and errors ---------------------------------------------------------------------------------- */

int koksma__set_errno(void)
{
    static const struct {
        DWORD code;
        int number;
    } known[] = {{ERROR_FILE_NOT_FOUND, ENOENT},
                 {ERROR_PATH_NOT_FOUND, ENOENT},
                 {ERROR_INVALID_NAME, ENOENT},
                 {ERROR_BAD_NETPATH, ENOENT},
                 {ERROR_ACCESS_DENIED, EACCES},
                 {ERROR_SHARING_VIOLATION, EACCES},
                 {ERROR_ALREADY_EXISTS, EEXIST},
                 {ERROR_FILE_EXISTS, EEXIST},
                 {ERROR_DIRECTORY, ENOTDIR},
                 {ERROR_DIR_NOT_EMPTY, ENOTEMPTY},
                 {ERROR_DISK_FULL, ENOSPC},
                 {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
                 {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG},
                 {ERROR_WRITE_PROTECT, EROFS}};
    const DWORD code = GetLastError();
    errno = EIO;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        errno = known[i].code == code ? known[i].number : errno;
    }
    return -1;
}

static wchar_t *wide_text(const char *text)
{
    const int length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text, -1, NULL, 0);
    wchar_t *wide = length > 0 ? malloc((size_t)length * sizeof *wide) : NULL;
    errno = length > 0 ? ENOMEM : EILSEQ;
    if (wide) {
        MultiByteToWideChar(CP_UTF8, 0, text, -1, wide, length);
    }
    return wide;
}

wchar_t *koksma__wide_path(const char *path)
{
    wchar_t *wide = wide_text(path);
    if (!wide || !wcsncmp(wide, L"\\\\", 2) || wcslen(wide) < LONG_PATH) {
        return wide;
    }
    const DWORD size = GetFullPathNameW(wide, 0, NULL, NULL);
    wchar_t *whole = malloc((size + 5) * sizeof *whole);
    if (whole) {
        wcscpy(whole, L"\\\\?\\");
        GetFullPathNameW(wide, size, whole + 4, NULL);
    }
    free(wide);
    errno = ENOMEM;
    return whole;
}

static char *utf8(const wchar_t *wide)
{
    const int length = WideCharToMultiByte(CP_UTF8, 0, wide, -1, NULL, 0, NULL, NULL);
    char *text = length > 0 ? malloc((size_t)length) : NULL;
    if (text) {
        WideCharToMultiByte(CP_UTF8, 0, wide, -1, text, length, NULL, NULL);
        for (char *s = text; *s; s++) {
            *s = *s == '\\' ? '/' : *s;
        }
    } else {
        errno = ENOMEM;
    }
    return text;
}

/* ---- Files --------------------------------------------------------------------------------------------- */

/* since_1601: in units of 100 ns */
static struct timespec unix_time(int64_t since_1601)
{
    const int64_t since_1970 = since_1601 - INT64_C(116444736000000000);
    return (struct timespec){.tv_sec = (time_t)(since_1970 / 10000000),
                             .tv_nsec = (long)(since_1970 % 10000000 * 100)};
}

static int describe(HANDLE file, struct koksma__stat *info)
{
    BY_HANDLE_FILE_INFORMATION about;
    FILE_BASIC_INFO times;
    const DWORD type = GetFileType(file);
    *info = (struct koksma__stat){.st_mode = type == FILE_TYPE_PIPE ? S_IFIFO : S_IFCHR};
    if (type != FILE_TYPE_DISK) {
        return 0;
    }
    if (!GetFileInformationByHandle(file, &about) ||
        !GetFileInformationByHandleEx(file, FileBasicInfo, &times, sizeof times)) {
        return koksma__set_errno();
    }
    const bool folder = about.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY;
    const bool link_ = about.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT;
    info->st_mode = (link_ ? 0xA000 : folder ? S_IFDIR : S_IFREG) | 0777;
    info->st_dev = about.dwVolumeSerialNumber;
    info->st_ino = (uint64_t)about.nFileIndexHigh << 32 | about.nFileIndexLow;
    info->st_size = (int64_t)((uint64_t)about.nFileSizeHigh << 32 | about.nFileSizeLow);
    info->st_mtim = unix_time(times.LastWriteTime.QuadPart);
    info->st_ctim = unix_time(times.ChangeTime.QuadPart);
    return 0;
}

/* Opens a file or folder to ask about it; flags: those of CreateFile, beside what folders need. */
static HANDLE open_to_look(const char *path, DWORD flags)
{
    wchar_t *wide = koksma__wide_path(path);
    HANDLE file = INVALID_HANDLE_VALUE;
    if (wide) {
        file = CreateFileW(wide, FILE_READ_ATTRIBUTES, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                           OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS | flags, NULL);
        if (file == INVALID_HANDLE_VALUE) {
            koksma__set_errno();
        }
    }
    free(wide);
    return file;
}

static int stat_of(const char *path, DWORD flags, struct koksma__stat *info)
{
    HANDLE file = open_to_look(path, flags);
    const int code = file == INVALID_HANDLE_VALUE ? -1 : describe(file, info);
    if (file != INVALID_HANDLE_VALUE) {
        CloseHandle(file);
    }
    return code;
}

int koksma__stat(const char *path, struct koksma__stat *info)
{
    return stat_of(path, 0, info);
}

int koksma__lstat(const char *path, struct koksma__stat *info)
{
    return stat_of(path, FILE_FLAG_OPEN_REPARSE_POINT, info);
}

int koksma__fstat(int descriptor, struct koksma__stat *info)
{
    return describe((HANDLE)_get_osfhandle(descriptor), info);
}

int koksma__open(const char *path, int flags, ...)
{
    wchar_t *wide = koksma__wide_path(path);
    const int descriptor = wide ? _wopen(wide, flags | _O_BINARY, _S_IREAD | _S_IWRITE) : -1;
    const int reason = errno;
    free(wide);
    errno = reason;
    return descriptor;
}

/* The letter e of glibc's modes, for O_CLOEXEC, is N here. */
FILE *koksma__fopen(const char *path, const char *mode)
{
    wchar_t *wide = koksma__wide_path(path), modes[MODES] = L"";
    size_t used = 0;
    for (const char *s = mode; *s && used + 3 < MODES; s++) {
        if (*s != 'b') {
            modes[used++] = *s == 'e' ? L'N' : (wchar_t)*s;
        }
    }
    modes[used] = L'b';
    FILE *stream = wide ? _wfopen(wide, modes) : NULL;
    const int reason = errno;
    free(wide);
    errno = reason;
    return stream;
}

int koksma__access(const char *path, int mode)
{
    wchar_t *wide = koksma__wide_path(path);
    const int code = wide ? _waccess(wide, mode & (R_OK | W_OK)) : -1;
    const int reason = errno;
    free(wide);
    errno = reason;
    return code;
}

int koksma__mkdir(const char *path, int mode)
{
    wchar_t *wide = koksma__wide_path(path);
    (void)mode;
    const int code = !wide ? -1 : CreateDirectoryW(wide, NULL) ? 0 : koksma__set_errno();
    free(wide);
    return code;
}

int koksma__unlink(const char *path)
{
    wchar_t *wide = koksma__wide_path(path);
    const int code = !wide ? -1 : DeleteFileW(wide) ? 0 : koksma__set_errno();
    free(wide);
    return code;
}

int koksma__rmdir(const char *path)
{
    wchar_t *wide = koksma__wide_path(path);
    const int code = !wide ? -1 : RemoveDirectoryW(wide) ? 0 : koksma__set_errno();
    free(wide);
    return code;
}

/* Replaces a file. Other programs, such as virus scanners, may hold a new file open for a moment. */
int koksma__rename(const char *from, const char *to)
{
    enum { TRIES = 20, PAUSE_MS = 20 };
    wchar_t *one = koksma__wide_path(from), *other = koksma__wide_path(to);
    bool done = false, held = one && other;
    for (int i = 0; held && !done && i < TRIES; i++) {
        Sleep(i ? PAUSE_MS : 0);
        done = MoveFileExW(one, other, MOVEFILE_WRITE_THROUGH | MOVEFILE_REPLACE_EXISTING);
        held = done || GetLastError() == ERROR_ACCESS_DENIED || GetLastError() == ERROR_SHARING_VIOLATION;
    }
    const int code = done ? 0 : one && other ? koksma__set_errno() : -1;
    free(one);
    free(other);
    return code;
}

char *koksma__realpath(const char *path, char *out)
{
    enum { MOST = 1 << 15 };
    HANDLE file = open_to_look(path, 0);
    wchar_t *wide = file == INVALID_HANDLE_VALUE ? NULL : malloc(MOST * sizeof *wide);
    char *real = NULL;
    if (wide) {
        const DWORD length = GetFinalPathNameByHandleW(file, wide, MOST, 0);
        real = length && length < MOST ? utf8(wide + (wcsncmp(wide, L"\\\\?\\", 4) ? 0 : 4)) : NULL;
    }
    if (file != INVALID_HANDLE_VALUE) {
        CloseHandle(file);
    }
    free(wide);
    if (real && out) {
        snprintf(out, PATH_MAX, "%s", real);
        free(real);
        return out;
    }
    return real;
}

char *koksma__getcwd(char *out, size_t size)
{
    wchar_t *wide = _wgetcwd(NULL, 0);
    char *here = wide ? utf8(wide) : NULL;
    const bool fits = here && strlen(here) < size;
    if (fits) {
        strcpy(out, here);
    }
    free(wide);
    free(here);
    errno = here ? ERANGE : errno;
    return fits ? out : NULL;
}

/* Windows follows its links itself. */
intptr_t koksma__readlink(const char *path, char *out, size_t size)
{
    (void)path, (void)out, (void)size;
    errno = EINVAL;
    return -1;
}

intptr_t koksma__pread(int descriptor, void *bytes, size_t size, int64_t offset)
{
    const int64_t before = _lseeki64(descriptor, 0, SEEK_CUR);
    if (before < 0 || _lseeki64(descriptor, offset, SEEK_SET) < 0) {
        return -1;
    }
    const int got = _read(descriptor, bytes, (unsigned)size);
    _lseeki64(descriptor, before, SEEK_SET);
    return got;
}

/* ---- The machine ---------------------------------------------------------------------------------------- */

long koksma__sysconf(int name)
{
    enum { PAGE = 4096 };
    MEMORYSTATUSEX memory = {.dwLength = sizeof memory};
    if (name == _SC_PHYS_PAGES) {
        return GlobalMemoryStatusEx(&memory) ? (long)(memory.ullTotalPhys / PAGE) : -1;
    }
    return name == _SC_PAGESIZE ? PAGE : (long)GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
}

int koksma__getentropy(void *bytes, size_t size)
{
    unsigned word;
    for (size_t i = 0; i < size; i++) {
        if (rand_s(&word)) {
            return -1;
        }
        ((unsigned char *)bytes)[i] = (unsigned char)word;
    }
    return 0;
}

struct tm *koksma__gmtime_r(const time_t *when, struct tm *out)
{
    return gmtime_s(out, when) ? NULL : out;
}

/* ---- Streams and texts --------------------------------------------------------------------------------- */

static FILE *temporary_file(void)
{
    wchar_t folder[MAX_PATH + 1], path[MAX_PATH + 1];
    return GetTempPathW(MAX_PATH, folder) && GetTempFileNameW(folder, L"kok", 0, path) ? _wfopen(path, L"w+bTDN")
                                                                                       : NULL;
}

/* The open streams into memory, and where their texts go. */
static struct memory_stream {
    FILE *stream;
    char **text;
    size_t *size;
} streams[MOST_OPEN];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

FILE *koksma__open_memstream(char **text, size_t *size)
{
    FILE *stream = temporary_file();
    struct memory_stream *at = NULL;
    pthread_mutex_lock(&lock);
    for (size_t i = 0; stream && !at && i < MOST_OPEN; i++) {
        at = streams[i].stream ? NULL : &streams[i];
    }
    if (at) {
        *at = (struct memory_stream){stream, text, size};
    }
    pthread_mutex_unlock(&lock);
    *text = NULL;
    *size = 0;
    if (stream && !at) {
        fclose(stream);
        errno = EMFILE;
    }
    return at ? stream : NULL;
}

static bool take_text(const struct memory_stream *from)
{
    const bool written = !fflush(from->stream) && !ferror(from->stream);
    const int64_t length = _ftelli64(from->stream);
    char *text = written && length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (!text) {
        return false;
    }
    rewind(from->stream);
    *from->size = fread(text, 1, (size_t)length, from->stream);
    text[*from->size] = '\0';
    *from->text = text;
    return *from->size == (size_t)length;
}

int koksma__fclose(FILE *stream)
{
    struct memory_stream found = {0};
    pthread_mutex_lock(&lock);
    for (size_t i = 0; i < MOST_OPEN; i++) {
        if (streams[i].stream == stream) {
            found = streams[i];
            streams[i].stream = NULL;
        }
    }
    pthread_mutex_unlock(&lock);
    const bool taken = !found.stream || take_text(&found);
    return fclose(stream) || !taken ? EOF : 0;
}

char *koksma__strndup(const char *text, size_t size)
{
    const size_t length = strnlen(text, size);
    char *copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

/* ---- Libraries ----------------------------------------------------------------------------------------- */

static _Thread_local char failure[160];

static void note_failure(void)
{
    const DWORD code = GetLastError();
    snprintf(failure, sizeof failure, "Windows's error %lu", (unsigned long)code);
    if (code == ERROR_MOD_NOT_FOUND || code == ERROR_BAD_EXE_FORMAT) {
        snprintf(failure, sizeof failure, "%s",
                 code == ERROR_MOD_NOT_FOUND ? "it, or a library that it needs, is missing"
                                             : "it is no library for this processor");
    }
}

void *koksma__dlopen(const char *path, int mode)
{
    wchar_t *wide = koksma__wide_path(path);
    (void)mode;
    for (wchar_t *s = wide; s && *s; s++) {
        *s = *s == L'/' ? L'\\' : *s;
    }
    HMODULE library = wide ? LoadLibraryW(wide) : NULL;
    if (!library) {
        note_failure();
    }
    free(wide);
    return (void *)library;
}

void *koksma__dlsym(void *library, const char *name)
{
    FARPROC symbol = GetProcAddress((HMODULE)library, name);
    void *out;
    if (!symbol) {
        note_failure();
    }
    memcpy(&out, &symbol, sizeof out);
    return out;
}

int koksma__dlclose(void *library)
{
    return FreeLibrary((HMODULE)library) ? 0 : -1;
}

const char *koksma__dlerror(void)
{
    return *failure ? failure : NULL;
}

char *koksma__this_file(void)
{
    static const char here = 0;
    wchar_t path[4096];
    HMODULE module = NULL;
    const bool found =
        GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                           (const wchar_t *)&here, &module);
    const DWORD length = found ? GetModuleFileNameW(module, path, 4096) : 0;
    return length && length < 4096 ? utf8(path) : NULL;
}

/* ---- glob(3) ------------------------------------------------------------------------------------------- */

/* Whether a name matches a part of a pattern: `*`, `?`, and `\` before a character that stands for itself. */
static bool matches(const char *pattern, const char *name)
{
    for (; *pattern && *pattern != '*'; pattern++, name++) {
        const bool wild = *pattern == '?' && *name;
        pattern += *pattern == '\\' && pattern[1];
        if (!wild && *pattern != *name) {
            return false;
        }
    }
    if (!*pattern) {
        return !*name;
    }
    do {
        if (matches(pattern + 1, name)) {
            return true;
        }
    } while (*name++);
    return false;
}

static bool add_path(koksma__glob_t *found, const char *path)
{
    char **larger = realloc(found->gl_pathv, (found->gl_pathc + 2) * sizeof *larger);
    char *copy = larger ? _strdup(path) : NULL;
    found->gl_pathv = larger ? larger : found->gl_pathv;
    if (copy) {
        larger[found->gl_pathc++] = copy;
        larger[found->gl_pathc] = NULL;
    }
    return copy != NULL;
}

static bool glob_in(const char *folder, const char *pattern, koksma__glob_t *found);

/* Goes on with the rest of a pattern at `path`, which is there; at its end, adds it. */
static bool go_on(const char *path, const char *rest, koksma__glob_t *found)
{
    char folder[PATH_MAX];
    struct koksma__stat info;
    if (!*rest) {
        return add_path(found, path);
    }
    const bool fits = snprintf(folder, sizeof folder, "%s/", path) < (int)sizeof folder;
    return !fits || koksma__stat(path, &info) || !S_ISDIR(info.st_mode) || glob_in(folder, rest + 1, found);
}

/* Adds what matches `pattern`, relative to `folder`, which is empty or ends in a slash. Returns false without memory. */
static bool glob_in(const char *folder, const char *pattern, koksma__glob_t *found)
{
    char part[PATH_MAX], path[PATH_MAX];
    WIN32_FIND_DATAW entry;
    size_t length = strcspn(pattern, "/");
    bool kept = true;
    if (!length && *pattern == '/') { /* the root, or two slashes */
        snprintf(path, sizeof path, "%s/", folder);
        return glob_in(path, pattern + 1, found);
    }
    snprintf(part, sizeof part, "%.*s", (int)length, pattern);
    if (!strpbrk(part, "*?\\")) {
        struct koksma__stat info;
        const bool fits = snprintf(path, sizeof path, "%s%s", folder, part) < (int)sizeof path;
        const bool drive = length == 2 && part[1] == ':';
        return !fits || (!drive && koksma__lstat(path, &info)) || go_on(path, pattern + length, found);
    }
    snprintf(path, sizeof path, "%s*", folder);
    wchar_t *wide = koksma__wide_path(path);
    HANDLE search = wide ? FindFirstFileW(wide, &entry) : INVALID_HANDLE_VALUE;
    kept = wide != NULL;
    free(wide);
    if (search == INVALID_HANDLE_VALUE) {
        return kept;
    }
    do {
        char *name = utf8(entry.cFileName);
        const bool hit = name && (*name != '.' || *part == '.') && matches(part, name);
        if (hit && snprintf(path, sizeof path, "%s%s", folder, name) < (int)sizeof path) {
            kept = go_on(path, pattern + length, found);
        }
        kept = kept && name;
        free(name);
    } while (kept && FindNextFileW(search, &entry));
    FindClose(search);
    return kept;
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

int koksma__glob(const char *pattern, int flags, void *unused, koksma__glob_t *found)
{
    (void)unused;
    *found = (koksma__glob_t){0};
    if (!glob_in("", pattern, found)) {
        koksma__globfree(found);
        return GLOB_NOSPACE;
    }
    if (!(flags & GLOB_NOSORT) && found->gl_pathc) {
        qsort(found->gl_pathv, found->gl_pathc, sizeof *found->gl_pathv, compare_paths);
    }
    return found->gl_pathc ? 0 : GLOB_NOMATCH;
}

void koksma__globfree(koksma__glob_t *found)
{
    for (size_t i = 0; i < found->gl_pathc; i++) {
        free(found->gl_pathv[i]);
    }
    free(found->gl_pathv);
    *found = (koksma__glob_t){0};
}

#endif
