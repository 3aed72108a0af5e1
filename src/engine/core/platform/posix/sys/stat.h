/* SPDX-License-Identifier: Apache-2.0 */
#include_next <sys/stat.h>
#ifdef __APPLE__
#define st_mtim st_mtimespec
#define st_ctim st_ctimespec
#endif
