# The number in the sonames of the shared libraries: raised with every change that breaks a program built before
# (docs/abi.md).
set(KOKSMA_ABI 0)
configure_file(${PROJECT_SOURCE_DIR}/src/exports.map.in ${PROJECT_BINARY_DIR}/exports.map @ONLY)

# koksma_shared(LIBRARY): LIBRARY-shared, of the same objects as the static LIBRARY.
function(koksma_shared library)
  get_target_property(objects ${library} KOKSMA_OBJECTS)
  add_library(${library}-shared SHARED $<TARGET_OBJECTS:${library}> ${objects})
  set_target_properties(${library}-shared PROPERTIES OUTPUT_NAME ${library} LINKER_LANGUAGE C VERSION ${PROJECT_VERSION}
                        SOVERSION ${KOKSMA_ABI} LINK_DEPENDS ${PROJECT_BINARY_DIR}/exports.map)
  target_include_directories(${library}-shared INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                         $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if(WIN32 OR APPLE) # what is exported is declared so (koksma.h, core/visibility.h), and names have no versions there
    return()
  endif()
  target_link_options(${library}-shared PRIVATE -Wl,--version-script=${PROJECT_BINARY_DIR}/exports.map)
  if(NOT KOKSMA_SANITIZE AND NOT KOKSMA_THREAD_SANITIZER) # clang's sanitizers leave their own symbols to the program
    target_link_options(${library}-shared PRIVATE -Wl,--no-undefined)
  endif()
endfunction()
