# The outside libraries, all from Debian (scripts/setup installs them).
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)

find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
pkg_check_modules(CMOCKA IMPORTED_TARGET cmocka)

# Of OpenEXR only its C library; pkg-config's list would link the C++ ones as well.
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo cairo-svg cairo-pdf)
pkg_check_modules(SQLITE REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(OPENEXR REQUIRED OpenEXR)
find_library(OPENEXR_CORE_LIBRARY NAMES OpenEXRCore-3_1 OpenEXRCore REQUIRED)
add_library(openexr-core INTERFACE)
target_include_directories(openexr-core SYSTEM INTERFACE ${OPENEXR_INCLUDE_DIRS})
target_link_libraries(openexr-core INTERFACE ${OPENEXR_CORE_LIBRARY})
set(OPENEXR_CORE openexr-core)

# Optional: studies on many machines. The sanitizers and MPI's own libraries don't go together.
if(KOKSMA_MPI AND NOT KOKSMA_SANITIZE)
  find_package(MPI COMPONENTS C QUIET)
endif()
