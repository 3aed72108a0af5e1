# The outside libraries, all from Debian (scripts/setup installs them).
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)

find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
pkg_check_modules(CMOCKA IMPORTED_TARGET cmocka)
